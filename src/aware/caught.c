/* The sum with the fewest loops, by steepest descent on an L-natural-convex function.

   At first there is a loop about every edge through the surface.  Each inner vertex then gets an
   integer, the number of loops slid over the vertex; vertices at the boundary have 0.  The loops
   left about an edge number |loops + integer at the first vertex - integer at the second|.  The
   cost is a weighted sum over the edges.  The cost is least where no set of vertices gains by
   raising or lowering its integers by one (Murota 2003; Kolmogorov and Shioura 2009).  The best set
   is a least cut, found by augmenting paths.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/caught.h"
#include "base/error.h"

/* Costs of a loop.  One loop less outweighs what is favoured, and that what breaks a tie.  */
enum
{
  COST = 1 << 20,
  FAVOUR = 1 << 8, /* less for an edge that is favoured */
  APART = 1 << 26, /* more for the edge that leads away from where a member ends */
  TIES = 1 << 6
};

typedef bt__caught job;

#define NOWHERE UINT32_MAX
#define START (UINT32_MAX - 1)

/* Make the lists of edges at each vertex.  */
static void
list_edges (job *k)
{
  const bt__graph *g = k->graph;
  for (uint32_t e = 0; e < g->edges; e++)
    for (int end = 0; end < 2; end++)
      k->at[g->edge[e][end] + 1]++;
  for (uint32_t v = 0; v < g->vertices; v++)
    k->at[v + 1] += k->at[v];
  for (uint32_t e = g->edges; e-- > 0;)
    for (int end = 0; end < 2; end++)
      k->edge[--k->at[g->edge[e][end] + 1]] = e;
  /* each list now begins one place later in AT than its vertex */
  memmove (k->at, k->at + 1, g->vertices * sizeof *k->at);
  k->at[g->vertices] = 2 * g->edges;
}

static void
set_costs (job *k, const uint8_t *favoured)
{
  for (uint32_t e = 0; e < k->graph->edges; e++)
    k->cost[e] = COST - (favoured && favoured[e] ? FAVOUR : 0) + (e < k->graph->own ? 0 : APART)
                 + (int64_t)((e * 2654435761u) >> 26) % TIES;
}

/* ---- The best set of vertices ---- */

/* The gain of each vertex if its integer changes by WAY, 1 or -1, and its neighbours' stay: summed
   over the edges with loops.  An edge without loops costs for either sign and is left to the cut.
 */
static void
set_gains (job *k, int way)
{
  const bt__graph *g = k->graph;
  memset (k->gain, 0, g->vertices * sizeof *k->gain);
  memset (k->flow, 0, g->edges * sizeof *k->flow);
  for (uint32_t e = 0; e < g->edges; e++)
    {
      int64_t by = k->loops[e] > 0 ? -way * k->cost[e] : k->loops[e] < 0 ? way * k->cost[e] : 0;
      k->gain[g->edge[e][0]] += by;
      k->gain[g->edge[e][1]] -= by;
    }
}

/* What can still flow along edge E out of vertex V.  */
static int64_t
left_out_of (const job *k, uint32_t e, uint32_t v)
{
  if (k->loops[e] != 0)
    return 0;
  return k->cost[e] - (k->graph->edge[e][0] == v ? k->flow[e] : -k->flow[e]);
}

static uint32_t
other_end (const job *k, uint32_t e, uint32_t v)
{
  return k->graph->edge[e][0] == v ? k->graph->edge[e][1] : k->graph->edge[e][0];
}

/* Look from all vertices with gains for one that takes them; return it, or NOWHERE.  */
static uint32_t
find_path (job *k)
{
  const bt__graph *g = k->graph;
  uint32_t n = 0;
  memset (k->seen, 0, g->vertices);
  for (uint32_t v = 0; v < g->vertices; v++)
    if (k->gain[v] > 0 && !g->boundary[v])
      {
        k->seen[v] = 1;
        k->from[v] = START;
        k->queue[n++] = v;
      }
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = k->at[k->queue[i]]; j < k->at[k->queue[i] + 1]; j++)
      {
        uint32_t v = k->queue[i], e = k->edge[j], w = other_end (k, e, v);
        if (k->seen[w] || left_out_of (k, e, v) <= 0)
          continue;
        k->seen[w] = 1;
        k->from[w] = e;
        if (g->boundary[w] || k->gain[w] < 0)
          return w;
        k->queue[n++] = w;
      }
  return NOWHERE;
}

/* Let flow what can along the path to END.  */
static void
augment (job *k, uint32_t end)
{
  int64_t most = k->graph->boundary[end] ? INT64_MAX : -k->gain[end];
  uint32_t v = end;
  for (; k->from[v] != START; v = other_end (k, k->from[v], v))
    {
      int64_t left = left_out_of (k, k->from[v], other_end (k, k->from[v], v));
      most = left < most ? left : most;
    }
  most = k->gain[v] < most ? k->gain[v] : most;
  k->gain[v] -= most;
  if (!k->graph->boundary[end])
    k->gain[end] += most;
  for (v = end; k->from[v] != START; v = other_end (k, k->from[v], v))
    k->flow[k->from[v]] += k->graph->edge[k->from[v]][1] == v ? most : -most;
}

/* Slide loops by WAY over the set of vertices that gains most; return true if one does.  */
static int
slide_loops (job *k, int way)
{
  const bt__graph *g = k->graph;
  uint32_t end;
  int gained = 0;
  set_gains (k, way);
  while (!bt__ask (k->asker) && (end = find_path (k)) != NOWHERE)
    augment (k, end);
  for (uint32_t v = 0; v < g->vertices; v++)
    gained |= k->seen[v];
  for (uint32_t e = 0; gained && e < g->edges; e++)
    k->loops[e] += way * (k->seen[g->edge[e][0]] - k->seen[g->edge[e][1]]);
  return gained;
}

void
bt__caught_find (bt__caught *k, const bt_vec3 *p, uint32_t n, const bt_vec3 *q, uint32_t m,
                 const uint8_t *favoured)
{
  k->any = 0;
  if (!bt__caught_crossings (k->graph, p, n, q, m, k->loops))
    return;
  set_costs (k, favoured);
  while (!bt__ask (k->asker) && (slide_loops (k, 1) || slide_loops (k, -1)))
    ;
  for (uint32_t e = 0; e < k->graph->edges; e++)
    k->any |= k->loops[e] != 0;
}

bt_status
bt__caught_new (const bt__graph *graph, bt__caught *k, bt_error *error)
{
  size_t v = (size_t)graph->vertices + 2, e = (size_t)graph->edges + 1;
  *k = (bt__caught){ .graph = graph };
  k->loops = calloc (e, sizeof *k->loops);
  k->cost = malloc (e * sizeof *k->cost);
  k->at = calloc (v, sizeof *k->at);
  k->edge = malloc (2 * e * sizeof *k->edge);
  k->gain = malloc (v * sizeof *k->gain);
  k->flow = malloc (e * sizeof *k->flow);
  k->from = malloc (v * sizeof *k->from);
  k->queue = malloc (v * sizeof *k->queue);
  k->seen = malloc (v);
  if (k->loops && k->cost && k->at && k->edge && k->gain && k->flow && k->from && k->queue
      && k->seen)
    {
      list_edges (k);
      return BT_OK;
    }
  bt__caught_free (k);
  return bt__fail (error, BT_ERR_LIMIT, "no memory for what a tether goes about");
}

void
bt__caught_free (bt__caught *k)
{
  free (k->loops);
  free (k->cost);
  free (k->at);
  free (k->edge);
  free (k->gain);
  free (k->flow);
  free (k->from);
  free (k->queue);
  free (k->seen);
  *k = (bt__caught){ 0 };
}
