/* A link's axis against a solid box.

   In the box's frame half the slope of the squared distance along the link is the sum over the axes
   of the link's component d times the excess of the coordinate over the box: continuous, rising,
   with a kink where a coordinate passes a side.  The bracket of its root shrinks to between two
   kinks, where the slope is linear.

   A link that meets the box leaves the box along a side's normal or across an edge: the faces of
   the box plus the link's segment (a zonotope), six directions.  The direction of least depth is
   the normal, and minus the depth the distance.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/pair.h"

typedef struct local
{
  double p[3], d[3], h[3];
} local;

static double
beyond_side (double x, double h)
{
  return x > h ? x - h : x < -h ? x + h : 0;
}

static double
slope_to_box (const local *k, double t)
{
  double sum = 0;
  for (int i = 0; i < 3; i++)
    sum += k->d[i] * beyond_side (k->p[i] + t * k->d[i], k->h[i]);
  return sum;
}

/* The root of the slope, which is FIRST < 0 at 0 and LAST > 0 at 1.  */
static double
slope_root (const local *k, double first, double last)
{
  double lo = 0, hi = 1;
  for (int i = 0; i < 3; i++)
    {
      if (k->d[i] == 0)
        continue;
      double inverse = 1 / k->d[i];
      for (int side = -1; side <= 1; side += 2)
        {
          double t = (side * k->h[i] - k->p[i]) * inverse;
          if (!(t > lo && t < hi))
            continue;
          double at = slope_to_box (k, t);
          if (at < 0)
            {
              lo = t;
              first = at;
            }
          else
            {
              hi = t;
              last = at;
            }
        }
    }
  return lo + (hi - lo) * (first / (first - last));
}

/* Return the place on the link nearest to the box.  */
static double
nearest_to_box (const local *k)
{
  double first = slope_to_box (k, 0), last;
  if (first >= 0)
    return 0;
  last = slope_to_box (k, 1);
  return last <= 0 ? 1 : slope_root (k, first, last);
}

/* ---- Inside ---- */

typedef struct way_out
{
  double depth, n[3];
  int axis, edge; /* the side's or the edge's axis */
} way_out;

/* Leave through the sides across axis I.  */
static void
try_sides (const local *k, int i, way_out *best)
{
  double p = k->p[i], q = p + k->d[i];
  double high = k->h[i] - fmin (p, q), low = k->h[i] + fmax (p, q);
  double depth = fmin (high, low);
  if (!(depth < best->depth))
    return;
  *best = (way_out){ .depth = depth, .axis = i, .edge = 0 };
  best->n[i] = high <= low ? 1 : -1;
}

/* Leave across an edge along axis I.  */
static void
leave_across_edges (const local *k, int i, way_out *best)
{
  int j = (i + 1) % 3, l = (i + 2) % 3;
  double size = sqrt (k->d[j] * k->d[j] + k->d[l] * k->d[l]);
  if (!(size > 0))
    return;
  double nj = -k->d[l] / size, nl = k->d[j] / size, at = nj * k->p[j] + nl * k->p[l];
  double depth = fabs (nj) * k->h[j] + fabs (nl) * k->h[l] - fabs (at), turn = at < 0 ? -1 : 1;
  if (!(depth < best->depth))
    return;
  *best = (way_out){ .depth = depth, .axis = i, .edge = 1 };
  best->n[j] = turn * nj;
  best->n[l] = turn * nl;
}

/* Return the place on the link that touches the side: the deepest end, or, of a link along the
   side, a point within the box.  */
static double
place_on_side (const local *k, const way_out *way)
{
  double lo = 0, hi = 1, s = way->n[way->axis] * k->d[way->axis] < 0 ? 1 : 0;
  for (int i = 0; i < 3; i++)
    if (i != way->axis && k->d[i] != 0)
      {
        double t = (-k->h[i] - k->p[i]) / k->d[i], u = (k->h[i] - k->p[i]) / k->d[i];
        lo = fmax (lo, fmin (t, u));
        hi = fmin (hi, fmax (t, u));
      }
  return lo <= hi ? bt__clamp (s, lo, hi) : s;
}

static double
place_on_edge (const local *k, const way_out *way)
{
  double corner[3], s, t;
  for (int i = 0; i < 3; i++)
    corner[i] = i == way->axis ? -k->h[i] : way->n[i] < 0 ? -k->h[i] : k->h[i];
  bt_vec3 e = { way->axis == 0, way->axis == 1, way->axis == 2 };
  bt__closest_segments (bt__vec (k->p[0] - corner[0], k->p[1] - corner[1], k->p[2] - corner[2]),
                        bt__vec (k->d[0], k->d[1], k->d[2]), bt__scale (2 * k->h[way->axis], e), &s,
                        &t);
  return s;
}

static int
code (const double n[3])
{
  int sum = 0, place = 1;
  for (int i = 0; i < 3; i++, place *= 3)
    sum += place * (n[i] > 0 ? 2 : n[i] < 0 ? 0 : 1);
  return sum;
}

static void
leave_box (const local *k, const bt__box *box, const bt__link *link, bt__witness *out)
{
  way_out best = { .depth = INFINITY };
  for (int i = 0; i < 3; i++)
    try_sides (k, i, &best);
  for (int i = 0; i < 3; i++)
    leave_across_edges (k, i, &best);
  out->s = best.edge ? place_on_edge (k, &best) : place_on_side (k, &best);
  out->distance = -best.depth;
  out->normal = bt__out_of (&box->frame, bt__vec (best.n[0], best.n[1], best.n[2]));
  out->point = bt__axpy (bt__along (link, out->s), best.depth, out->normal);
  out->feature = code (best.n);
}

void
bt__pair_box (const bt__box *box, const bt__link *link, bt__witness *out)
{
  bt_vec3 p = bt__to_local (&box->frame, link->a);
  bt_vec3 d = bt__into (&box->frame, bt__sub (link->b, link->a)), h = box->half;
  local k = { { p.x, p.y, p.z }, { d.x, d.y, d.z }, { h.x, h.y, h.z } };
  double t = nearest_to_box (&k), e[3];
  for (int i = 0; i < 3; i++)
    e[i] = beyond_side (k.p[i] + t * k.d[i], k.h[i]);
  bt_vec3 gap = { e[0], e[1], e[2] };
  double distance = bt__norm (gap);
  if (!(distance > BT__TOUCHING * (bt__largest (p) + bt__largest (h))))
    {
      leave_box (&k, box, link, out);
      return;
    }
  out->s = t;
  out->distance = distance;
  out->normal = bt__out_of (&box->frame, bt__scale (1 / distance, gap));
  out->point = bt__to_world (&box->frame, bt__sub (bt__axpy (p, t, d), gap));
  out->feature = code (e);
}
