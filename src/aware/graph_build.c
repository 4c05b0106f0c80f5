/* From points on members to a graph, and the rank of its group.

   Points of one member are sorted along its axis.  Neighbouring points with water between them
   become an edge; a stretch in the ground, in the air or in a mesh becomes none.  Points of one
   joint are united by union-find (bt__unite, bt__joint_of) and make one vertex.  Boundary vertices,
   where a member enters the ground or leaves the water, get an edge that leads on far past
   everything.

   The complement of an unknotted graph has a free group; the rank of the group is the number of
   edges less the number of inner vertices, plus one for every component that touches no boundary.
   bt__graph_rank counts this number; shadow.c compares it with the rank that is left after the
   elimination.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "aware/graph_job.h"

#define DEEP 10.0 /* m: how far past everything */

static int
by_member_and_s (const void *a, const void *b)
{
  const bt__point *const *x = a, *const *y = b;
  if ((*x)->member != (*y)->member)
    return (*x)->member < (*y)->member ? -1 : 1;
  if ((*x)->s != (*y)->s)
    return (*x)->s < (*y)->s ? -1 : 1;
  return *x < *y ? -1 : *x > *y;
}

/* Give each meeting the medium of its stretch, and unite the points of a member that form one
   joint.  */
static void
settle_points (bt__graph_job *k, bt__point **at, uint32_t n)
{
  for (uint32_t i = 1; i < n; i++)
    {
      bt__point *x = at[i - 1], *y = at[i];
      if (x->member != y->member || x->member == BT__NO_MEMBER)
        continue;
      if (!y->boundary)
        y->dry = x->dry;
      if (!x->dry && bt__distance (x->at, y->at) <= x->radius + k->c->gap)
        bt__unite (k, (uint32_t)(x - k->p), (uint32_t)(y - k->p));
    }
}

static void
place_vertices (bt__graph_job *k, bt__graph *g, uint32_t *vertex)
{
  double *weight = calloc (k->n + 1, sizeof *weight);
  k->failed |= !weight;
  for (uint32_t i = 0; i < k->n && weight; i++)
    {
      uint32_t j = bt__joint_of (k, i);
      vertex[i] = j == i ? g->vertices++ : vertex[j];
      uint32_t v = vertex[i];
      double w = k->p[i].radius * k->p[i].radius + 1e-12;
      g->v[v] = bt__axpy (j == i ? bt__vec (0, 0, 0) : g->v[v], w, k->p[i].at);
      g->radius[v] = j == i ? k->p[i].radius : fmin (g->radius[v], k->p[i].radius);
      g->boundary[v] = g->boundary[v] ? g->boundary[v] : k->p[i].boundary;
      weight[v] += w;
    }
  for (uint32_t v = 0; v < g->vertices && weight; v++)
    g->v[v] = bt__scale (1 / weight[v], g->v[v]);
  free (weight);
}

static void
lay_edges (bt__graph_job *k, bt__graph *g, bt__point **at, uint32_t n, const uint32_t *vertex)
{
  for (uint32_t i = 1; i < n; i++)
    {
      const bt__point *x = at[i - 1], *y = at[i];
      uint32_t a = vertex[x - k->p], b = vertex[y - k->p];
      if (x->member != y->member || x->member == BT__NO_MEMBER || x->dry || a == b)
        continue;
      g->edge[g->edges][0] = a;
      g->edge[g->edges][1] = b;
      g->object[g->edges++] = x->member;
    }
}

/* Lead every vertex in the ground straight down, every vertex in the air straight up.  */
static void
lead_away (bt__graph *g)
{
  uint32_t vertices = g->vertices, edges = g->edges;
  double low = INFINITY, high = -INFINITY;
  for (uint32_t v = 0; v < vertices; v++)
    {
      low = fmin (low, g->v[v].z - DEEP);
      high = fmax (high, g->v[v].z + DEEP);
    }
  for (uint32_t e = 0; e < edges; e++)
    for (int end = 0; end < 2; end++)
      {
        uint32_t v = g->edge[e][end], far = g->vertices;
        if (g->boundary[v] == BT__WATER || g->boundary[v] == BT__MESH || v >= vertices)
          continue;
        g->v[far] = bt__vec (g->v[v].x, g->v[v].y, g->boundary[v] == BT__AIR ? high : low);
        g->radius[far] = g->radius[v];
        g->boundary[far] = g->boundary[v];
        g->boundary[v] = BT__WATER;
        g->vertices++;
        g->edge[g->edges][0] = v;
        g->edge[g->edges][1] = far;
        g->object[g->edges++] = g->object[e];
      }
}

void
bt__graph_build (bt__graph_job *k, bt__graph *g)
{
  uint32_t n = k->n;
  bt__point **at = malloc ((n + 1) * sizeof *at);
  uint32_t *vertex = malloc ((n + 1) * sizeof *vertex);
  g->v = malloc ((2 * n + 1) * sizeof *g->v);
  g->radius = malloc ((2 * n + 1) * sizeof *g->radius);
  g->boundary = calloc (2 * n + 1, 1);
  g->edge = malloc ((2 * n + 1) * sizeof *g->edge);
  g->object = malloc ((2 * n + 1) * sizeof *g->object);
  k->failed |= !at || !vertex || !g->v || !g->radius || !g->boundary || !g->edge || !g->object;
  if (!k->failed)
    {
      for (uint32_t i = 0; i < n; i++)
        at[i] = k->p + i;
      qsort (at, n, sizeof *at, by_member_and_s);
      settle_points (k, at, n);
      place_vertices (k, g, vertex);
      lay_edges (k, g, at, n, vertex);
      g->own = g->edges;
      lead_away (g);
    }
  free (at);
  free (vertex);
}

/* ---- Its rank ---- */

static uint32_t
union_root (const uint32_t *up, uint32_t v)
{
  while (up[v] != v)
    v = up[v];
  return v;
}

uint32_t
bt__graph_rank (const bt__graph *g)
{
  uint32_t inner = 0, floating = 0, *up = malloc ((g->vertices + 1) * sizeof *up);
  uint8_t *held = calloc (g->vertices + 1, 1);
  for (uint32_t v = 0; up && v < g->vertices; v++)
    up[v] = v;
  for (uint32_t e = 0; up && e < g->edges; e++)
    up[union_root (up, g->edge[e][0])] = union_root (up, g->edge[e][1]);
  for (uint32_t v = 0; up && held && v < g->vertices; v++)
    {
      inner += !g->boundary[v];
      held[union_root (up, v)] |= g->boundary[v];
    }
  for (uint32_t v = 0; up && held && v < g->vertices; v++)
    floating += up[v] == v && !held[v];
  free (up);
  free (held);
  return up && held ? g->edges + floating - inner : UINT32_MAX;
}
