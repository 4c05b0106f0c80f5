/* A surface between two lines with the same ends, and its crossings by the edges of a graph.

   The surface is a strip of triangles with rungs from line to line; at each rung the strip goes on
   along the line that is behind, by shares of the lengths.  An edge across the surface contributes
   1 or -1, by the side from which the edge comes: the crossings of all edges are a sum of loops in
   the class of the closed curve of both lines (caught.h).

   Crossings are exact as a whole: the side on which an edge passes a rung is the sign of a product,
   computed by the same expression for both triangles at the rung.  So an edge near a rung crosses
   exactly one of the two triangles, whatever the rounding.  Blocks of triangles have boxes, so a
   distant edge costs one comparison.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "aware/caught.h"
#include "math/vec.h"

enum
{
  BLOCK = 16,     /* triangles of a box */
  BLOCKS_MAX = 64 /* boxes at most; in a long strip a box covers more */
};

/* A place on the strip: the rung from P[I] to Q[J].  The triangle from there has the next point of
   P or of Q. Places are found by walking on from the first place of a block.  */
typedef struct place
{
  uint32_t i, j;
  double s, t; /* m along P and Q */
} place;

typedef struct strip
{
  const bt_vec3 *p, *q;
  uint32_t n, m;
  double along, back; /* m: lengths of P and Q */
  uint32_t block;     /* triangles of a block */
  uint32_t blocks;
  place first[BLOCKS_MAX];
  bt__aabb box[BLOCKS_MAX], all;
} strip;

static double
polyline_length (const bt_vec3 *p, uint32_t n)
{
  double sum = 0;
  for (uint32_t i = 1; i < n; i++)
    sum += bt__distance (p[i - 1], p[i]);
  return sum;
}

/* True if the triangle at AT goes on along P.  */
static int
goes_along (const strip *s, const place *at)
{
  if (at->i + 1 >= s->n || at->j + 1 >= s->m)
    return at->i + 1 < s->n;
  double next = at->s + bt__distance (s->p[at->i], s->p[at->i + 1]);
  double other = at->t + bt__distance (s->q[at->j], s->q[at->j + 1]);
  return next * s->back <= other * s->along;
}

static void
go_on_strip (const strip *s, place *at)
{
  if (goes_along (s, at))
    {
      at->s += bt__distance (s->p[at->i], s->p[at->i + 1]);
      at->i++;
    }
  else
    {
      at->t += bt__distance (s->q[at->j], s->q[at->j + 1]);
      at->j++;
    }
}

static bt__aabb
empty_box (void)
{
  return (bt__aabb){ bt__vec (INFINITY, INFINITY, INFINITY),
                     bt__vec (-INFINITY, -INFINITY, -INFINITY) };
}

static uint32_t
count_triangles (const strip *s)
{
  return s->n + s->m - 2;
}

static void
lay_strip (strip *s)
{
  uint32_t count = count_triangles (s);
  place at = { 0, 0, 0, 0 };
  s->along = polyline_length (s->p, s->n);
  s->back = polyline_length (s->q, s->m);
  s->block = BLOCK > count / BLOCKS_MAX + 1 ? BLOCK : count / BLOCKS_MAX + 1;
  s->blocks = 0;
  s->all = empty_box ();
  for (uint32_t k = 0; k < count; k++)
    {
      uint32_t b = k / s->block;
      if (k % s->block == 0)
        {
          s->first[b] = at;
          s->box[b] = empty_box ();
          s->blocks++;
        }
      s->box[b] = bt__box_with (bt__box_with (s->box[b], s->p[at.i]), s->q[at.j]);
      go_on_strip (s, &at);
      s->box[b] = bt__box_with (bt__box_with (s->box[b], s->p[at.i]), s->q[at.j]);
    }
  for (uint32_t b = 0; b < s->blocks; b++)
    s->all = bt__box_with (bt__box_with (s->all, s->box[b].lo), s->box[b].hi);
}

/* ---- Crossings ---- */

/* Six times the volume of the tetrahedron A, B, C, D: positive if D is where the normal of A, B, C
   points.  */
static double
volume_of_tetrahedron (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  return bt__dot (bt__cross (bt__sub (b, a), bt__sub (c, a)), bt__sub (d, a));
}

static int
sign_of (double x)
{
  return x >= 0 ? 1 : -1;
}

/* On which side the line from X to Y passes the rung from P to Q.  */
static int
passes_rung (bt_vec3 x, bt_vec3 y, bt_vec3 p, bt_vec3 q)
{
  return sign_of (volume_of_tetrahedron (x, y, p, q));
}

/* 1 or -1 if the edge X to Y goes through the triangle of S at AT, along or against the normal of
   the triangle; else 0.  */
static int
through (const strip *s, const place *at, bt_vec3 x, bt_vec3 y)
{
  bt_vec3 p = s->p[at->i], q = s->q[at->j];
  int along = goes_along (s, at);
  bt_vec3 next = along ? s->p[at->i + 1] : s->q[at->j + 1];
  bt_vec3 b = along ? next : q, c = along ? q : p, a = along ? p : next;
  int from = sign_of (volume_of_tetrahedron (a, b, c, x)),
      to = sign_of (volume_of_tetrahedron (a, b, c, y));
  if (from == to)
    return 0;
  int first = passes_rung (x, y, p, q);
  int last = along ? passes_rung (x, y, next, q) : passes_rung (x, y, p, next);
  int rim = along ? sign_of (volume_of_tetrahedron (x, y, p, next))
                  : sign_of (volume_of_tetrahedron (x, y, next, q));
  return last == rim && first == -rim ? to : 0;
}

static int
crossings_in_block (const strip *s, uint32_t b, bt_vec3 x, bt_vec3 y)
{
  uint32_t last = (b + 1) * s->block;
  place at = s->first[b];
  int sum = 0;
  last = last < count_triangles (s) ? last : count_triangles (s);
  for (uint32_t k = b * s->block; k < last; k++, go_on_strip (s, &at))
    sum += through (s, &at, x, y);
  return sum;
}

/* A count of crossings.  */
typedef struct crossings
{
  const bt__graph *graph;
  const strip *strip;
  int32_t *loops; /* of each edge */
  int any;
} crossings;

/* Count how often the edge at SLOT of the tree goes through the strip.  */
static double
cross_edge (void *user, uint32_t slot, double reach)
{
  crossings *c = user;
  const strip *s = c->strip;
  uint32_t e = c->graph->tree.order[slot];
  bt_vec3 x = c->graph->v[c->graph->edge[e][0]], y = c->graph->v[c->graph->edge[e][1]];
  bt__aabb box = bt__box_with ((bt__aabb){ x, x }, y);
  if (!bt__boxes_are_near (&box, &s->all, 0))
    return reach;
  for (uint32_t b = 0; b < s->blocks; b++)
    if (bt__boxes_are_near (&box, &s->box[b], 0))
      c->loops[e] += crossings_in_block (s, b, x, y);
  c->any |= c->loops[e] != 0;
  return reach;
}

int
bt__caught_crossings (const bt__graph *graph, const bt_vec3 *p, uint32_t n, const bt_vec3 *q,
                      uint32_t m, int32_t *loops)
{
  strip s = { .p = p, .q = q, .n = n, .m = m };
  crossings c = { .graph = graph, .strip = &s, .loops = loops };
  bt__count unused = { 0 };
  lay_strip (&s);
  bt__link diagonal = { s.all.lo, s.all.hi };
  /* No point of a box is farther from the diagonal than half the diagonal's length.  */
  double reach = 0.5 * bt__distance (s.all.lo, s.all.hi);
  memset (loops, 0, graph->edges * sizeof *loops);
  bt__bvh_query (&graph->tree, &diagonal, reach, 0, cross_edge, &c, &unused);
  return c.any;
}
