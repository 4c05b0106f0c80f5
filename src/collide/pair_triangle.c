/* A link's axis against a two-sided triangle.

   Either the link crosses the face, or the nearest pair is an end over the face or a pair of the
   link and an edge.  An edge with the whole link on its inner side is not asked.  Every candidate
   is a point of the link with a point of the triangle, so the answer is too large by rounding at
   most, also for slivers; a triangle without area has its edges only.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/pair.h"

/* In coordinates from vertex 0.  */
typedef struct local
{
  bt_vec3 p, d;      /* the link: start, direction */
  bt_vec3 e1, e2, n; /* the edges from vertex 0, their cross product */
  double nn, ee;     /* n . n; e1 . e1 e2 . e2 */
  double w[2][3];    /* of both ends, nn times the barycentric weight of each vertex */
  int fat;           /* a sliver's normal is too rough to say which side of an edge is inner */
} local;

typedef struct found
{
  double square, s;
  bt_vec3 on, gap; /* on the triangle; from there to the link */
  int feature;
} found;

static void
weigh_corners (const local *k, bt_vec3 p, double w[3])
{
  bt_vec3 m = bt__cross (k->n, p);
  w[1] = bt__dot (m, k->e2);
  w[2] = -bt__dot (m, k->e1);
  w[0] = k->nn - w[1] - w[2];
}

/* The crossing of the face, if there is one: all three edges turn the same way round the link.  A
   link in the plane, but for rounding, has an end over the face or an edge near instead.  */
static int
crosses (const local *k, double start, double end, double *s)
{
  double drop = start - end, size = bt__dot (k->p, k->p) + bt__dot (k->d, k->d);
  if (!(start * end <= 0 && drop * drop > 1e-28 * size * k->ee))
    return 0;
  bt_vec3 moment = bt__cross (k->p, k->d);
  double det = drop, u = bt__dot (k->e2, moment), v = -bt__dot (k->e1, moment);
  if (det < 0)
    {
      det = -det;
      u = -u;
      v = -v;
    }
  *s = start / drop;
  return u >= 0 && v >= 0 && u + v <= det;
}

static int
is_over (const double w[3])
{
  return w[0] >= 0 && w[1] >= 0 && w[2] >= 0;
}

static void
offer_gap (found *best, bt_vec3 at, double s, bt_vec3 on, int feature)
{
  bt_vec3 gap = bt__sub (at, on);
  double square = bt__dot (gap, gap);
  if (square < best->square)
    *best = (found){ square, s, on, gap, feature };
}

static void
try_end (const local *k, int end, found *best)
{
  const double *w = k->w[end];
  if (!(k->nn > 0) || !is_over (w))
    return;
  bt_vec3 on = bt__axpy (bt__scale (w[1] / k->nn, k->e1), w[2] / k->nn, k->e2);
  offer_gap (best, end ? bt__add (k->p, k->d) : k->p, end, on, 0);
}

static void
try_triangle_edge (const local *k, int i, found *best)
{
  static const bt_vec3 zero = { 0, 0, 0 };
  bt_vec3 from = i == 0 ? zero : i == 1 ? k->e1 : k->e2;
  bt_vec3 e = i == 0 ? k->e1 : i == 1 ? bt__sub (k->e2, k->e1) : bt__scale (-1, k->e2);
  double s, t;
  bt__closest_segments (bt__sub (k->p, from), k->d, e, &s, &t);
  int feature = t <= 0 ? 4 + i : t >= 1 ? 4 + (i + 1) % 3 : 1 + i;
  offer_gap (best, bt__axpy (k->p, s, k->d), s, bt__axpy (from, t, e), feature);
}

static void
try_all_edges (const local *k, found *best)
{
  for (int i = 0; i < 3; i++)
    {
      int across = (i + 2) % 3; /* the vertex across edge I */
      if (!(k->fat && k->w[0][across] > 0 && k->w[1][across] > 0))
        try_triangle_edge (k, i, best);
    }
}

/* The normal where the two touch: the face's, to the side where more of the link is.  */
static bt_vec3
face_normal (const local *k)
{
  double start = bt__dot (k->n, k->p), end = start + bt__dot (k->n, k->d);
  bt_vec3 e = bt__dot (k->e1, k->e1) > bt__dot (k->e2, k->e2) ? k->e1 : k->e2;
  bt_vec3 n = bt__unit_or (k->n, bt__unit_or (bt__cross (k->d, e), bt__across (e)));
  return start + end < 0 ? bt__scale (-1, n) : n;
}

static void
touch (const local *k, double s, bt_vec3 origin, int feature, bt__witness *out)
{
  out->distance = 0;
  out->s = s;
  out->point = bt__add (origin, bt__axpy (k->p, s, k->d));
  out->normal = face_normal (k);
  out->feature = feature;
}

static void
prepare_triangle (local *k, const bt__triangle *f, const bt__link *link)
{
  k->p = bt__sub (link->a, f->v[0]);
  k->d = bt__sub (link->b, link->a);
  k->e1 = bt__sub (f->v[1], f->v[0]);
  k->e2 = bt__sub (f->v[2], f->v[0]);
  k->n = bt__cross (k->e1, k->e2);
  k->nn = bt__dot (k->n, k->n);
  k->ee = bt__dot (k->e1, k->e1) * bt__dot (k->e2, k->e2);
  k->fat = k->nn > 1e-8 * k->ee;
}

void
bt__pair_triangle (const bt__triangle *f, const bt__link *link, bt__witness *out)
{
  local k;
  prepare_triangle (&k, f, link);
  bt_vec3 q = bt__add (k.p, k.d);
  double start = bt__dot (k.n, k.p), end = bt__dot (k.n, q), s;
  if (crosses (&k, start, end, &s))
    {
      touch (&k, s, f->v[0], 0, out);
      return;
    }
  weigh_corners (&k, k.p, k.w[0]);
  weigh_corners (&k, q, k.w[1]);
  found best = { .square = INFINITY };
  int near = fabs (end) < fabs (start);
  try_end (&k, near, &best);
  /* The end nearer the plane and over the face is the answer, unless rounding chose the end.  */
  if (!k.fat || !(best.square < INFINITY) || start * end <= 0)
    {
      try_end (&k, !near, &best);
      try_all_edges (&k, &best);
    }
  double distance = sqrt (best.square);
  if (!(distance > BT__TOUCHING * (bt__largest (k.p) + bt__largest (k.e1) + bt__largest (k.e2))))
    {
      touch (&k, best.s, f->v[0], best.feature, out);
      return;
    }
  out->distance = distance;
  out->s = best.s;
  out->point = bt__add (f->v[0], best.on);
  out->normal = bt__scale (1 / distance, best.gap);
  out->feature = best.feature;
}
