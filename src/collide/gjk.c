/* GJK distance (Gilbert, Johnson and Keerthi 1988).

   The simplex of up to four vertices lives in the Minkowski difference A - B, whose nearest point
   to 0 gives the distance.  A step asks the support of the difference against the present nearest
   point, adds the vertex to the simplex, and reduces the simplex to the face with the point nearest
   to 0.

   The reduction measures all faces that have the new vertex and takes the nearest: slower than
   walking Voronoi regions, but a nearly flat simplex cannot mislead the reduction.  Where rounding
   leaves nothing to gain, the simplex is replaced by its nearest point and grows again.

   The iteration ends when the support shows that no point is nearer by more than rounding, when a
   support repeats, or when even a restart gains nothing.  If 0 lies inside the tetrahedron by more
   than rounding, the shapes overlap and the distance is 0.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/gjk.h"
#include "collide/pair.h"

enum
{
  STEPS_MAX = 200
};

typedef struct vertex
{
  bt_vec3 w, a, b;
} vertex;

typedef struct simplex
{
  vertex v[4];
  double weight[4];
  int n;
} simplex;

/* A point of the simplex: indices into it and weights.  */
typedef struct part
{
  double square;
  int n, index[3];
  double weight[3];
} part;

static void
keep_smaller (part *best, const part *p, const simplex *x)
{
  bt_vec3 at = bt__scale (p->weight[0], x->v[p->index[0]].w);
  for (int i = 1; i < p->n; i++)
    at = bt__axpy (at, p->weight[i], x->v[p->index[i]].w);
  double square = bt__dot (at, at);
  if (square < best->square)
    {
      *best = *p;
      best->square = square;
    }
}

static void
try_vertex (const simplex *x, int i, part *best)
{
  part p = { 0, 1, { i, 0, 0 }, { 1, 0, 0 } };
  keep_smaller (best, &p, x);
}

static void
try_simplex_edge (const simplex *x, int i, int j, part *best)
{
  bt_vec3 a = x->v[i].w, d = bt__sub (x->v[j].w, a);
  double t = -bt__dot (a, d), dd = bt__dot (d, d);
  if (!(t > 0 && t < dd))
    return;
  part p = { 0, 2, { i, j, 0 }, { 1 - t / dd, t / dd, 0 } };
  keep_smaller (best, &p, x);
}

static void
try_face (const simplex *x, int i, int j, int k, part *best)
{
  bt_vec3 a = x->v[i].w, e = bt__sub (x->v[j].w, a), f = bt__sub (x->v[k].w, a);
  bt_vec3 n = bt__cross (e, f), m = bt__cross (n, a);
  double nn = bt__dot (n, n), u = -bt__dot (m, f), v = bt__dot (m, e);
  if (!(nn > 0 && u > 0 && v > 0 && u + v < nn))
    return;
  part p = { 0, 3, { i, j, k }, { 1 - (u + v) / nn, u / nn, v / nn } };
  keep_smaller (best, &p, x);
}

/* True if 0 and vertex I are on the same side of the opposite face of X, by more than rounding: by
   more than the roundings of the vertices make of the face's normal.  */
static int
is_inside_of (const simplex *x, int i, double scale)
{
  bt_vec3 a = x->v[(i + 1) & 3].w, b = x->v[(i + 2) & 3].w, c = x->v[(i + 3) & 3].w;
  bt_vec3 e = bt__sub (b, a), f = bt__sub (c, a), g = bt__sub (x->v[i].w, a), n = bt__cross (e, f);
  double own = bt__dot (n, g), zero = -bt__dot (n, a);
  double rough = 1e-14 * scale * (bt__largest (e) + bt__largest (f));
  return own * zero > 0 && fabs (own) > rough * bt__largest (g)
         && fabs (zero) > rough * bt__largest (a);
}

static int
holds_zero (const simplex *x, double scale)
{
  for (int i = 0; i < 4; i++)
    if (!is_inside_of (x, i, scale))
      return 0;
  return 1;
}

/* Reduce X to the smallest part that has its point nearest to 0; return that point.  */
static bt_vec3
reduce (simplex *x)
{
  part best = { .square = INFINITY };
  int last = x->n - 1; /* without the new vertex nothing is gained */
  try_vertex (x, last, &best);
  for (int i = 0; i < last; i++)
    try_simplex_edge (x, i, last, &best);
  for (int i = 0; i < last; i++)
    for (int j = i + 1; j < last; j++)
      try_face (x, i, j, last, &best);
  simplex small = { .n = best.n };
  bt_vec3 at = { 0, 0, 0 };
  for (int i = 0; i < best.n; i++)
    {
      small.v[i] = x->v[best.index[i]];
      small.weight[i] = best.weight[i];
      at = bt__axpy (at, best.weight[i], small.v[i].w);
    }
  *x = small;
  return at;
}

static int
has_vertex (const simplex *x, bt_vec3 w)
{
  for (int i = 0; i < x->n; i++)
    if (x->v[i].w.x == w.x && x->v[i].w.y == w.y && x->v[i].w.z == w.z)
      return 1;
  return 0;
}

static vertex
support_of_difference (const bt__convex *a, const bt__convex *b, bt_vec3 direction, int hint[2])
{
  vertex v;
  v.a = a->support (a->shape, direction, hint);
  v.b = b->support (b->shape, bt__scale (-1, direction), hint + 1);
  v.w = bt__sub (v.a, v.b);
  return v;
}

static void
finish_gap (const simplex *x, double distance, bt__gap *out)
{
  out->distance = distance;
  out->a = out->b = bt__vec (0, 0, 0);
  for (int i = 0; i < x->n; i++)
    {
      out->a = bt__axpy (out->a, x->weight[i], x->v[i].a);
      out->b = bt__axpy (out->b, x->weight[i], x->v[i].b);
    }
}

/* The point of X as a simplex of its own.  */
static simplex
collapsed (const simplex *x, bt_vec3 at)
{
  bt__gap gap;
  finish_gap (x, 0, &gap);
  return (simplex){ .v = { { at, gap.a, gap.b } }, .weight = { 1 }, .n = 1 };
}

/* Add NEXT to X and reduce; return true if the nearest point, *V at *SIZE, came nearer.  */
static int
gain (simplex *x, const vertex *next, bt_vec3 *v, double *size)
{
  simplex grown = *x;
  grown.v[grown.n++] = *next;
  bt_vec3 nearer = reduce (&grown);
  double now = bt__norm (nearer);
  if (!(now < *size))
    return 0;
  *x = grown;
  *v = nearer;
  *size = now;
  return 1;
}

static int
would_hold_zero (const simplex *x, const vertex *next, double scale)
{
  simplex grown = *x;
  grown.v[3] = *next;
  return x->n == 3 && holds_zero (&grown, scale);
}

void
bt__gjk (const bt__convex *a, const bt__convex *b, bt__gap *out)
{
  simplex x = { .n = 1, .weight = { 1 } };
  out->hint[0] = out->hint[1] = out->steps = 0;
  x.v[0] = support_of_difference (a, b, bt__vec (1, 0, 0), out->hint);
  bt_vec3 v = x.v[0].w;
  double size = bt__norm (v), scale = size;
  while (out->steps++ < STEPS_MAX && size > 1e-15 * scale)
    {
      vertex next = support_of_difference (a, b, bt__scale (-1 / size, v), out->hint);
      scale = fmax (scale, bt__norm (next.w));
      if (size - bt__dot (v, next.w) / size <= 1e-15 * scale || has_vertex (&x, next.w))
        break;
      if (would_hold_zero (&x, &next, scale))
        {
          size = 0;
          break;
        }
      if (gain (&x, &next, &v, &size))
        continue;
      /* Stalled: a way down leads from the nearest point straight towards the new vertex.  */
      x = collapsed (&x, v);
      if (!gain (&x, &next, &v, &size))
        break;
    }
  finish_gap (&x, size > 1e-15 * scale ? size : 0, out);
}
