/* Making shadows: crossings, cuts, relations, the choice of a direction.

   The method is the Wirtinger presentation, as for knots, of a graph of members instead of a closed
   curve (shadow.h).  Vertices are projected on the plane (u, z) across a horizontal direction; w is
   the depth along the direction.  Steps of the construction:

   1. jitter moves every vertex a little, from a fixed seed: then no three edges cross in a point of
   the picture, and no two edges lie on each other.  Without the jitter the horizontals of a jacket
   cover each other, and wrong relations are left.

   2. find_shadow_crossings tests all pairs of edges that share no vertex.  At a crossing the edge
   with the greater depth passes behind.

   3. make_cuts cuts every edge where the edge passes behind another edge.  The pieces are the
   generators; an edge with k cuts has k + 1 letters in a row, from the edge's first vertex on.

   4. relate_crossing writes, for the edge f in front and the letters g and g' of the edge behind
   before and after the cut, f g' f^-1 g^-1 = 1, or the mirror image f g^-1 f^-1 g' = 1.
   relate_vertex writes for every inner vertex: the letters of the vertex's edges, sorted by angle
   in the picture, multiply to 1; an edge that arrives counts inverted.  A vertex in the ground or
   in the air (a boundary) gives no relation: a loop cannot be drawn off over such an end.

   5. tietze.c eliminates letters. choose_direction repeats steps 2 to 5 for several angles and
   keeps the angle with the fewest relations left over, then the shortest words, then the fewest
   crossings.

   A group without relations left over is free, and reduced words then decide the class.  The rank
   must be the first Betti number of the graph modulo its boundary; `decided' is true only if rank
   and relations agree with this and no obstacle went undescribed.  Edges are finally sorted into
   square bins of the picture: a question looks at a few edges only.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/shadow_job.h"
#include "base/error.h"
#include "base/hash.h"

/* ---- Crossings and cuts ---- */

static int
keep_crossing (bt__shadow *x, const bt__crossing *c)
{
  if (x->crosses == x->room)
    {
      uint32_t room = x->room ? 2 * x->room : 256;
      bt__crossing *cross = realloc (x->cross, room * sizeof *cross);
      if (!cross)
        return 0;
      x->cross = cross;
      x->room = room;
    }
  x->cross[x->crosses++] = *c;
  return 1;
}

static int
share_vertex (const uint32_t *e, const uint32_t *f)
{
  return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
}

static int
find_shadow_crossings (bt__shadow *x)
{
  x->crosses = 0;
  for (uint32_t e = 0; e < x->edges && !bt__ask (x->asker); e++)
    for (uint32_t f = e + 1; f < x->edges; f++)
      {
        const uint32_t *i = x->edge[e], *j = x->edge[f];
        bt__flat a = x->at[i[0]], b = x->at[i[1]], c = x->at[j[0]], d = x->at[j[1]];
        double s, t;
        if (share_vertex (i, j) || !bt__do_cross (a, b, c, d, &s, &t))
          continue;
        int left = bt__side_of (a, b, d) > bt__side_of (a, b, c); /* F goes to the left of E */
        int behind = bt__depth_at (c, d, t) > bt__depth_at (a, b, s);
        bt__crossing one
            = behind ? (bt__crossing){ e, f, s, t, left } : (bt__crossing){ f, e, t, s, !left };
        if (!keep_crossing (x, &one))
          return 0;
      }
  return 1;
}

static int
by_edge_and_share (const void *a, const void *b)
{
  const bt__cut *x = a, *y = b;
  if (x->edge != y->edge)
    return x->edge < y->edge ? -1 : 1;
  return x->s < y->s ? -1 : x->s > y->s;
}

static int
make_cuts (bt__shadow *x)
{
  bt__cut *cuts = realloc (x->cut, (x->crosses + 1) * sizeof *cuts);
  if (!cuts)
    return 0;
  x->cut = cuts;
  for (uint32_t i = 0; i < x->crosses; i++)
    cuts[i] = (bt__cut){ x->cross[i].t, x->cross[i].back };
  qsort (cuts, x->crosses, sizeof *cuts, by_edge_and_share);
  for (uint32_t e = 0, i = 0; e <= x->edges; e++)
    {
      while (i < x->crosses && cuts[i].edge < e)
        i++;
      x->first[e] = i;
    }
  return 1;
}

int32_t
bt__letter_at (const bt__shadow *x, uint32_t e, double s)
{
  uint32_t i = x->first[e];
  while (i < x->first[e + 1] && x->cut[i].s < s)
    i++;
  return (int32_t)(e + i + 1);
}

static int32_t
last_letter (const bt__shadow *x, uint32_t e)
{
  return (int32_t)(e + x->first[e + 1] + 1);
}

/* ---- Relations ---- */

/* A small loop round the crossing, counter-clockwise and deeper than both edges, encloses nothing:
   the product of the letters on the way is 1.  */
static void
relate_crossing (bt__shadow *x, const bt__crossing *c)
{
  int32_t f = bt__letter_at (x, c->front, c->s), before = bt__letter_at (x, c->back, c->t);
  int32_t left[4] = { f, before + 1, -f, -before }, right[4] = { f, -before, -f, before + 1 };
  bt__group_relate (&x->group, c->left ? left : right, 4);
}

typedef struct ray
{
  double angle;
  int32_t letter;
} ray;

static int
by_angle (const void *a, const void *b)
{
  const ray *x = a, *y = b;
  return x->angle < y->angle ? -1 : x->angle > y->angle;
}

/* Once round an inner vertex.  */
static void
relate_vertex (bt__shadow *x, uint32_t v, ray *rays, int32_t *letters)
{
  uint32_t n = 0;
  for (uint32_t e = 0; e < x->edges; e++)
    for (int end = 0; end < 2; end++)
      if (x->edge[e][end] == v)
        {
          bt__flat o = x->at[v], p = x->at[x->edge[e][1 - end]];
          int32_t letter = end ? -last_letter (x, e) : (int32_t)(e + x->first[e] + 1);
          rays[n++] = (ray){ atan2 (p.z - o.z, p.u - o.u), letter };
        }
  qsort (rays, n, sizeof *rays, by_angle);
  for (uint32_t i = 0; i < n; i++)
    letters[i] = rays[i].letter;
  bt__group_relate (&x->group, letters, n);
}

static void
relate_vertices (bt__shadow *x)
{
  ray *rays = malloc ((2 * x->edges + 1) * sizeof *rays);
  int32_t *letters = malloc ((2 * x->edges + 1) * sizeof *letters);
  x->group.failed |= !rays || !letters;
  for (uint32_t v = 0; v < x->vertices && !x->group.failed && !bt__ask (x->asker); v++)
    if (!x->boundary[v])
      relate_vertex (x, v, rays, letters);
  free (rays);
  free (letters);
}

/* Look along ANGLE; the group is simplified.  */
static bt_status
look_along (bt__shadow *x, double angle, bt_error *error)
{
  x->angle = angle;
  x->cosine = cos (angle);
  x->sine = sin (angle);
  for (uint32_t v = 0; v < x->vertices; v++)
    x->at[v] = bt__flatten (x, x->v[v]);
  bt__group_free (&x->group);
  if (!find_shadow_crossings (x) || !make_cuts (x))
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the shadows of %u edges",
                     (unsigned)x->edges);
  bt__group_begin (&x->group, x->edges + x->crosses);
  x->group.asker = x->asker;
  for (uint32_t i = 0; i < x->crosses && !x->group.failed; i++)
    relate_crossing (x, x->cross + i);
  relate_vertices (x);
  return bt__group_simplify (&x->group, error);
}

/* ---- Making ---- */

static uint64_t
stir (uint64_t *seed)
{
  *seed += 0x9e3779b97f4a7c15u;
  uint64_t z = *seed;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static double
random_share (uint64_t *seed)
{
  return (double)(stir (seed) >> 11) * 0x1p-52 - 1; /* -1 to 1 */
}

static void
jitter (bt__shadow *x, const bt__graph *g, double share)
{
  uint64_t seed = 1;
  for (uint32_t v = 0; v < x->vertices; v++)
    {
      double size = fmin (share * g->radius[v], 0.03);
      bt_vec3 by = bt__vec (random_share (&seed), random_share (&seed), random_share (&seed));
      x->v[v] = bt__axpy (g->v[v], size / sqrt (3), by);
    }
}

static int
copy (bt__shadow *x, const bt__graph *g)
{
  size_t n = g->vertices, m = g->edges;
  x->vertices = g->vertices;
  x->edges = g->edges;
  x->v = malloc ((n + 1) * sizeof *x->v);
  x->at = malloc ((n + 1) * sizeof *x->at);
  x->boundary = malloc (n + 1);
  x->edge = malloc ((m + 1) * sizeof *x->edge);
  x->object = malloc ((m + 1) * sizeof *x->object);
  x->first = malloc ((m + 1) * sizeof *x->first);
  if (!x->v || !x->at || !x->boundary || !x->edge || !x->object || !x->first)
    return 0;
  memcpy (x->boundary, g->boundary, n);
  memcpy (x->edge, g->edge, m * sizeof *x->edge);
  memcpy (x->object, g->object, m * sizeof *x->object);
  return 1;
}

/* Look along one direction after the other, last along the best.  */
static bt_status
choose_direction (bt__shadow *x, uint32_t tries, bt_error *error)
{
  double best = INFINITY, kept = 0;
  bt_status status = BT_OK;
  for (uint32_t i = 0; i < tries && !status; i++)
    {
      double angle = 0.1234567 + BT__PI * i / tries;
      status = look_along (x, angle, error);
      double cost = 1e6 * x->group.leftover + 1e3 * x->group.longest + x->crosses;
      if (cost < best)
        {
          best = cost;
          kept = angle;
        }
    }
  return status ? status : look_along (x, kept, error);
}

static uint8_t
shadow_bin (const bt__shadow *x, int axis, double at)
{
  return (uint8_t)bt__clamp (floor ((at - x->lo[axis]) / x->wide[axis]), 0, BT__SHADOW_BINS - 1);
}

bt__area
bt__area_of (const bt__shadow *x, bt__flat a, bt__flat b)
{
  return (bt__area){ { shadow_bin (x, 0, fmin (a.u, b.u)), shadow_bin (x, 1, fmin (a.z, b.z)) },
                     { shadow_bin (x, 0, fmax (a.u, b.u)), shadow_bin (x, 1, fmax (a.z, b.z)) } };
}

static void
size_bins (bt__shadow *x)
{
  double lo[2] = { INFINITY, INFINITY }, hi[2] = { -INFINITY, -INFINITY };
  for (uint32_t v = 0; v < x->vertices; v++)
    {
      lo[0] = fmin (lo[0], x->at[v].u);
      hi[0] = fmax (hi[0], x->at[v].u);
      lo[1] = fmin (lo[1], x->at[v].z);
      hi[1] = fmax (hi[1], x->at[v].z);
    }
  for (int a = 0; a < 2; a++)
    {
      x->lo[a] = x->vertices ? lo[a] : 0;
      x->wide[a] = fmax ((x->vertices ? hi[a] - lo[a] : 0) / BT__SHADOW_BINS, 1e-6);
    }
}

/* Sort the edges into bins: count them, then put them where the counts say; the last pass leaves
   every bin's end where its start must be.  */
static int
fill_shadow_bins (bt__shadow *x)
{
  uint32_t bins = BT__SHADOW_BINS * BT__SHADOW_BINS, n = 0;
  size_bins (x);
  x->area = malloc ((x->edges + 1) * sizeof *x->area);
  if (!x->area)
    return 0;
  for (int pass = 0; pass < 2; pass++)
    {
      for (uint32_t e = 0; e < x->edges; e++)
        {
          bt__area r = bt__area_of (x, x->at[x->edge[e][0]], x->at[x->edge[e][1]]);
          x->area[e] = r;
          for (uint32_t j = r.from[1]; j <= r.to[1]; j++)
            for (uint32_t i = r.from[0]; i <= r.to[0]; i++)
              {
                uint32_t *bin = x->bin + i + BT__SHADOW_BINS * j;
                if (pass == 0)
                  ++*bin;
                else
                  x->in[--*bin] = e;
              }
        }
      for (uint32_t i = 0; i < bins && pass == 0; i++)
        n = x->bin[i] += n;
      if (pass == 0 && !(x->in = malloc ((n + 1) * sizeof *x->in)))
        return 0;
    }
  x->bin[bins] = n;
  return 1;
}

bt_status
bt__shadow_new (const bt__graph *graph, const bt__shadow_config *config, bt__shadow **out,
                bt_error *error)
{
  bt__shadow *x = calloc (1, sizeof *x);
  bt_status status = BT_OK;
  *out = NULL;
  if (!x || !copy (x, graph))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for the shadows of %u edges",
                       (unsigned)graph->edges);
  if (!status)
    {
      x->asker = config->asker;
      jitter (x, graph, config->jitter);
      status = choose_direction (x, config->tries ? config->tries : 1, error);
    }
  if (!status && !fill_shadow_bins (x))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for the shadows of %u edges",
                       (unsigned)graph->edges);
  if (status)
    {
      bt__shadow_free (x);
      return status;
    }
  bt__group *g = &x->group;
  x->asker = g->asker = NULL;
  uint32_t expected = bt__graph_rank (graph);
  x->report = (bt__shadow_report){
    x->crosses,  g->rank,    expected,
    g->leftover, g->longest, !g->leftover && g->rank == expected && !graph->undescribed
  };
  x->world = bt__hash (x->v, x->vertices * sizeof *x->v, 1);
  x->world = bt__hash (x->edge, x->edges * sizeof *x->edge, x->world);
  x->world = bt__hash (&x->angle, sizeof x->angle, x->world);
  *out = x;
  return BT_OK;
}

void
bt__shadow_free (bt__shadow *x)
{
  if (!x)
    return;
  bt__group_free (&x->group);
  free (x->v);
  free (x->at);
  free (x->boundary);
  free (x->edge);
  free (x->object);
  free (x->first);
  free (x->cross);
  free (x->cut);
  free (x->in);
  free (x->area);
  free (x);
}

uint32_t
bt__shadow_object (const bt__shadow *x, int32_t generator)
{
  uint32_t g = (uint32_t)abs (generator);
  if (g == 0 || g > x->group.rank)
    return UINT32_MAX;
  uint32_t letter = (uint32_t)x->group.origin[g - 1] - 1, e = 0;
  while (e + 1 < x->edges && e + 1 + x->first[e + 1] <= letter)
    e++;
  return x->object[e];
}
