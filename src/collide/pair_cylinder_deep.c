/* The way out of a solid cylinder for a link that meets it: the nearest face of the cylinder plus
   the link's segment.

   Those faces are the caps, the side (with the flats of a segment dragged along the axis), and the
   two rims dragged along the segment.  A rim seen along the segment is half of an ellipse with half
   axes R and R |d_z|; the segment is seen as a point, and the way out leads to the nearest point of
   the half ellipse: the distance to the ellipse's point at angle w is stationary where

   F (w) = R u sin w - b v cos w - (R^2 - b^2) sin w cos w = 0,

   u >= 0 and v the segment's place, b = R |d_z|.  From w = pi / 2 downwards the last root is the
   least distance; it is bracketed and found by Newton's iteration within the bracket.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/pair.h"

typedef struct deep
{
  bt_vec3 p, q;
  double half, radius;
} deep;

static void
offer_depth (bt__witness *best, double depth, double s, bt_vec3 normal, int feature)
{
  if (depth < -best->distance)
    *best = (bt__witness){ -depth, s, normal, normal, feature };
}

/* The end to leave through a cap by; of a link along the cap the middle of what is over it.  */
static void
try_caps (const deep *k, bt__witness *best)
{
  double low = k->half + fmax (k->p.z, k->q.z), high = k->half - fmin (k->p.z, k->q.z);
  double dx = k->q.x - k->p.x, dy = k->q.y - k->p.y, a = dx * dx + dy * dy;
  double s = 0.5, middle = bt__share (-(k->p.x * dx + k->p.y * dy), a);
  if (fabs (k->p.z - k->q.z) <= 1e-14 * (k->half + k->radius))
    s = middle;
  offer_depth (best, high, s == middle ? s : k->q.z < k->p.z, bt__vec (0, 0, 1), BT__CAP_HIGH);
  offer_depth (best, low, s == middle ? s : k->q.z > k->p.z, bt__vec (0, 0, -1), BT__CAP_LOW);
}

/* S, moved to where the link is between the caps: a link along the side touches only there.  */
static double
between_caps (const deep *k, double s)
{
  double dz = k->q.z - k->p.z;
  if (dz == 0)
    return s;
  double t = (-k->half - k->p.z) / dz, u = (k->half - k->p.z) / dz;
  double lo = fmax (0, fmin (t, u)), hi = fmin (1, fmax (t, u));
  return lo <= hi ? bt__clamp (s, lo, hi) : s;
}

/* Seen along the axis the segment is a segment in a disc.  */
static void
try_side (const deep *k, bt__witness *best)
{
  double dx = k->q.x - k->p.x, dy = k->q.y - k->p.y, a = dx * dx + dy * dy;
  double s = bt__share (-(k->p.x * dx + k->p.y * dy), a);
  if (a <= 1e-28 * k->radius * k->radius) /* along the axis: any place between the caps */
    s = bt__share (-k->p.z, k->q.z - k->p.z) + bt__share (k->p.z, k->p.z - k->q.z);
  double x = k->p.x + s * dx, y = k->p.y + s * dy, rho = sqrt (x * x + y * y);
  bt_vec3 n = bt__vec (1, 0, 0);
  if (rho < 1e-3 * sqrt (a) && s > 0 && s < 1)
    { /* the direction of the link has more digits than what is left of the place */
      double turn = (x * dy - y * dx > 0 ? 1 : -1) / sqrt (a);
      n = bt__vec (turn * dy, -turn * dx, 0);
    }
  else if (rho > BT__TOUCHING * k->radius)
    n = bt__vec (x / rho, y / rho, 0);
  offer_depth (best, k->radius - rho, between_caps (k, s), n, BT__SIDE);
}

/* Return the angle on the ellipse R, B nearest to (U >= 0, V), least distance; see above.  */
static double
nearest_angle (double r, double b, double u, double v)
{
  const double top = 0.5 * BT__PI;
  double c = r * r - b * b, lo = 0, hi = top;
  if (v < 0)
    {
      if (u == 0)
        return -b * v < c ? top : 0;
      /* F / (sin w cos w) is least at LO; HI is right of its last root, if there is one.  */
      lo = atan2 (cbrt (-b * v), cbrt (r * u));
      hi = r * u < c ? acos (r * u / c) : 0;
      if (hi <= lo || r * u / cos (lo) - b * v / sin (lo) >= c)
        return 0;
    }
  double w = 0.5 * (lo + hi);
  for (int i = 0; i < 100; i++)
    {
      double sine = sin (w), cosine = cos (w);
      double f = r * u * sine - b * v * cosine - c * sine * cosine;
      double rise = r * u * cosine + b * v * sine - c * (cosine * cosine - sine * sine);
      if (f < 0)
        lo = w;
      else
        hi = w;
      double next = rise > 0 ? w - f / rise : -1;
      if (!(next > lo && next < hi))
        next = 0.5 * (lo + hi);
      if (fabs (next - w) <= 1e-16)
        break;
      w = next;
    }
  return w;
}

/* The rim at height SIGN half, dragged along the segment's direction D (unit).  */
static void
try_rim (const deep *k, bt_vec3 d, double sign, bt__witness *best)
{
  double flat = hypot (d.x, d.y);
  if (!(flat > 0))
    return;
  /* Across D: e level, g as high as can be.  */
  bt_vec3 e = bt__vec (-d.y / flat, d.x / flat, 0), g = bt__cross (d, e);
  if (g.z * sign < 0)
    g = bt__scale (-1, g);
  double b = k->radius * fabs (d.z), u = bt__dot (e, k->p);
  double v = bt__dot (g, k->p) - g.z * sign * k->half;
  double w = nearest_angle (k->radius, b, fabs (u), v);
  if (!(w > 0))
    return; /* it leaves by the side */
  /* The normal of the ellipse there, and how far the support plane is.  */
  double ne = b * cos (w), ng = k->radius * sin (w), size = hypot (ne, ng);
  ne /= size;
  ng /= size;
  double depth = hypot (k->radius * ne, b * ng) - ne * fabs (u) - ng * v;
  bt_vec3 n = bt__axpy (bt__scale (u < 0 ? -ne : ne, e), ng, g);
  bt_vec3 out = bt__vec (n.x, n.y, 0), link = bt__sub (k->q, k->p);
  out = bt__unit_or (out, bt__vec (0, 0, 0));
  bt_vec3 rim = bt__vec (k->radius * out.x, k->radius * out.y, sign * k->half);
  double s = bt__share (bt__dot (bt__sub (rim, k->p), link), bt__dot (link, link));
  offer_depth (best, depth, s, n, sign < 0 ? BT__RIM_LOW : BT__RIM_HIGH);
}

void
bt__cylinder_deep (bt_vec3 p, bt_vec3 q, double half, double radius, bt__witness *out)
{
  deep k = { p, q, half, radius };
  out->distance = -INFINITY;
  try_caps (&k, out);
  try_side (&k, out);
  bt_vec3 d = bt__sub (q, p);
  double length = bt__norm (d);
  if (length > 0)
    {
      d = bt__scale (1 / length, d);
      try_rim (&k, d, 1, out);
      try_rim (&k, d, -1, out);
    }
  if (out->distance > 0) /* a rounding outside */
    out->distance = -0.0;
  out->point = p; /* the caller places it */
}
