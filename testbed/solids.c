/* See solids.h.  The distance to a hull is by its own small search over faces and edges.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "testbed/solids.h"

const char *const solid_names[SOLID_KINDS]
    = { "sphere", "capsule", "box", "cylinder", "triangle", "hull" };

/* ---- Dice ---- */

dice
dice_new (uint64_t seed)
{
  dice d = { { seed * 0x9e3779b97f4a7c15u + 1, seed ^ 0xbf58476d1ce4e5b9u } };
  for (int i = 0; i < 20; i++)
    dice_uniform (&d);
  return d;
}

double
dice_uniform (dice *d)
{
  uint64_t x = d->s[0], y = d->s[1];
  d->s[0] = y;
  x ^= x << 23;
  d->s[1] = x ^ y ^ (x >> 17) ^ (y >> 26);
  return (double)((d->s[1] + y) >> 11) * 0x1p-53;
}

double
dice_between (dice *d, double a, double b)
{
  return a + (b - a) * dice_uniform (d);
}

int
dice_below (dice *d, int n)
{
  return (int)(dice_uniform (d) * n);
}

bt_vec3
dice_point (dice *d, double half)
{
  double x = dice_between (d, -half, half), y = dice_between (d, -half, half);
  return bt__vec (x, y, dice_between (d, -half, half));
}

bt_vec3
dice_direction (dice *d)
{
  for (;;)
    {
      bt_vec3 p = dice_point (d, 1);
      double n = bt__norm (p);
      if (n > 0.1 && n < 1)
        return bt__scale (1 / n, p);
    }
}

/* ---- Drawing ---- */

static bt__frame
draw_frame (dice *d, double scale)
{
  bt__frame f = { dice_point (d, 0.3 * scale), { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  if (dice_below (d, 4) == 0)
    return f; /* along the axes: ties */
  f.x = dice_direction (d);
  f.y = bt__across (f.x);
  f.z = bt__cross (f.x, f.y);
  f.z = bt__scale (1 / bt__norm (f.z), f.z);
  return f;
}

static bt__triangle
draw_triangle (dice *d, double scale)
{
  bt__triangle t;
  for (int i = 0; i < 3; i++)
    t.v[i] = dice_point (d, scale);
  int kind = dice_below (d, 40);
  if (kind == 0)
    t.v[2] = t.v[1]; /* an edge */
  else if (kind == 1)
    t.v[2] = t.v[1] = t.v[0]; /* a point */
  else if (kind == 2)
    t.v[2] = bt__axpy (t.v[0], 0.25, bt__sub (t.v[1], t.v[0])); /* three on a line */
  return t;
}

solid
solid_draw (dice *d, solid_kind kind, double scale, bt__hull *const *pool, int pools)
{
  solid x = { .kind = kind };
  bt__frame f = draw_frame (d, scale);
  x.sphere = (bt__sphere){ f.origin, scale * dice_between (d, 0.05, 0.6) };
  x.capsule = (bt__capsule){ f.origin, bt__axpy (f.origin, scale, f.z), 0.3 * x.sphere.radius };
  x.box = (bt__box){ f, { 0, 0, 0 } };
  x.box.half = bt__vec (scale * dice_between (d, 0.02, 0.6), scale * dice_between (d, 0.02, 0.6),
                        scale * dice_between (d, 0.02, 0.6));
  x.cylinder
      = (bt__cylinder){ f.origin, f.z, scale * dice_between (d, 0.02, 0.8), x.sphere.radius };
  x.triangle = draw_triangle (d, scale);
  x.hull = pools ? pool[dice_below (d, pools)] : NULL;
  return x;
}

bt__witness
solid_pair (const solid *x, const bt__link *link)
{
  bt__witness w = { 0 };
  switch (x->kind)
    {
    case SOLID_SPHERE:
      bt__pair_sphere (&x->sphere, link, &w);
      break;
    case SOLID_CAPSULE:
      bt__pair_capsule (&x->capsule, link, &w);
      break;
    case SOLID_BOX:
      bt__pair_box (&x->box, link, &w);
      break;
    case SOLID_CYLINDER:
      bt__pair_cylinder (&x->cylinder, link, &w);
      break;
    case SOLID_TRIANGLE:
      bt__pair_triangle (&x->triangle, link, &w);
      break;
    default:
      bt__pair_hull (x->hull, link, &w);
    }
  return w;
}

/* ---- Distance of a point ---- */

static double
to_segment (bt_vec3 a, bt_vec3 b, bt_vec3 p)
{
  bt_vec3 d = bt__sub (b, a), r = bt__sub (p, a);
  double dd = bt__dot (d, d), t = dd > 0 ? bt__dot (d, r) / dd : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return bt__norm (bt__axpy (r, -t, d));
}

static double
to_triangle (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 p)
{
  double best = fmin (to_segment (a, b, p), fmin (to_segment (b, c, p), to_segment (c, a, p)));
  bt_vec3 e = bt__sub (b, a), f = bt__sub (c, a), n = bt__cross (e, f), r = bt__sub (p, a);
  double nn = bt__dot (n, n), u = bt__dot (bt__cross (r, f), n), v = bt__dot (bt__cross (e, r), n);
  if (nn > 0 && u >= 0 && v >= 0 && u + v <= nn)
    best = fmin (best, bt__norm (bt__axpy (bt__axpy (r, -u / nn, e), -v / nn, f)));
  return best;
}

static double
beyond (double x, double h)
{
  return fmax (fabs (x) - h, 0);
}

static double
to_hull (const bt__hull *h, bt_vec3 p)
{
  double best = INFINITY;
  int inside = 1;
  for (int i = 0; i < h->faces; i++)
    {
      const int *c = h->corner[i];
      inside &= bt__dot (h->face[i].normal, p) <= h->face[i].offset;
      best = fmin (best, to_triangle (h->v[c[0]], h->v[c[1]], h->v[c[2]], p));
    }
  return inside ? 0 : best;
}

double
solid_point (const solid *x, bt_vec3 p)
{
  bt_vec3 q;
  switch (x->kind)
    {
    case SOLID_SPHERE:
      return fmax (bt__distance (p, x->sphere.centre) - x->sphere.radius, 0);
    case SOLID_CAPSULE:
      return fmax (to_segment (x->capsule.a, x->capsule.b, p) - x->capsule.radius, 0);
    case SOLID_BOX:
      q = bt__to_local (&x->box.frame, p);
      return hypot (hypot (beyond (q.x, x->box.half.x), beyond (q.y, x->box.half.y)),
                    beyond (q.z, x->box.half.z));
    case SOLID_CYLINDER:
      q = bt__sub (p, x->cylinder.centre);
      double z = bt__dot (q, x->cylinder.axis);
      double rho = bt__norm (bt__axpy (q, -z, x->cylinder.axis));
      return hypot (fmax (rho - x->cylinder.radius, 0), beyond (z, x->cylinder.half));
    case SOLID_TRIANGLE:
      return to_triangle (x->triangle.v[0], x->triangle.v[1], x->triangle.v[2], p);
    default:
      return to_hull (x->hull, p);
    }
}

double
solid_brute (const solid *x, const bt__link *link)
{
  const double g = 0.6180339887498949;
  double lo = 0, hi = 1, s = 1 - g, t = g, best = INFINITY;
  double fs = solid_point (x, bt__along (link, s)), ft = solid_point (x, bt__along (link, t));
  for (int i = 0; i < 90 && best > 0; i++)
    {
      if (fs <= ft)
        {
          hi = t;
          t = s;
          ft = fs;
          s = hi - g * (hi - lo);
          fs = solid_point (x, bt__along (link, s));
        }
      else
        {
          lo = s;
          s = t;
          fs = ft;
          t = lo + g * (hi - lo);
          ft = solid_point (x, bt__along (link, t));
        }
      best = fmin (best, fmin (fs, ft));
    }
  return fmin (best, fmin (solid_point (x, link->a), solid_point (x, link->b)));
}

/* ---- Supports ---- */

static bt_vec3
farther (bt_vec3 a, bt_vec3 b, bt_vec3 d)
{
  return bt__dot (bt__sub (b, a), d) > 0 ? b : a;
}

static bt_vec3
core_support (const void *shape, bt_vec3 d, int *hint)
{
  const solid *x = shape;
  bt_vec3 q, p;
  (void)hint;
  switch (x->kind)
    {
    case SOLID_SPHERE:
      return x->sphere.centre;
    case SOLID_CAPSULE:
      return farther (x->capsule.a, x->capsule.b, d);
    case SOLID_BOX:
      q = bt__into (&x->box.frame, d);
      p = bt__vec (copysign (x->box.half.x, q.x), copysign (x->box.half.y, q.y),
                   copysign (x->box.half.z, q.z));
      return bt__to_world (&x->box.frame, p);
    case SOLID_CYLINDER:
      p = x->cylinder.axis;
      q = bt__axpy (d, -bt__dot (d, p), p);
      q = bt__axpy (q, -bt__dot (q, p), p); /* what rounding left along the axis */
      q = bt__norm (q) > 1e-12 * bt__norm (d) ? bt__unit_or (q, q) : bt__vec (0, 0, 0);
      return bt__axpy (bt__axpy (x->cylinder.centre, x->cylinder.radius, q),
                       copysign (x->cylinder.half, bt__dot (d, p)), p);
    case SOLID_TRIANGLE:
      return farther (farther (x->triangle.v[0], x->triangle.v[1], d), x->triangle.v[2], d);
    default:
      return bt__hull_support (x->hull, d, hint);
    }
}

static bt_vec3
link_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__link *link = shape;
  (void)hint;
  return farther (link->a, link->b, d);
}

bt__convex
solid_core (const solid *x, double *radius)
{
  *radius = x->kind == SOLID_SPHERE    ? x->sphere.radius
            : x->kind == SOLID_CAPSULE ? x->capsule.radius
                                       : 0;
  return (bt__convex){ core_support, x };
}

bt__convex
solid_link_core (const bt__link *link)
{
  return (bt__convex){ link_support, link };
}

double
solid_support (const solid *x, bt_vec3 n)
{
  double radius;
  int hint = 0;
  if (x->kind == SOLID_CYLINDER)
    {
      double z = bt__dot (n, x->cylinder.axis);
      bt_vec3 level = bt__axpy (n, -z, x->cylinder.axis);
      return bt__dot (n, x->cylinder.centre) + x->cylinder.half * fabs (z)
             + x->cylinder.radius * bt__norm (level);
    }
  solid_core (x, &radius);
  return bt__dot (n, core_support (x, n, &hint)) + radius;
}

/* ---- For the engine ---- */

bt__obstacle
obstacle_of_solid (const solid *x)
{
  bt__obstacle o = { .kind = BT__OBSTACLE_SPHERE, .shape.sphere = x->sphere };
  if (x->kind == SOLID_BOX)
    o = (bt__obstacle){ .kind = BT__OBSTACLE_BOX, .shape.box = x->box };
  else if (x->kind == SOLID_CAPSULE)
    o = (bt__obstacle){ .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = x->capsule };
  else if (x->kind == SOLID_CYLINDER)
    o = (bt__obstacle){ .kind = BT__OBSTACLE_CYLINDER, .shape.cylinder = x->cylinder };
  else if (x->kind == SOLID_HULL)
    o = (bt__obstacle){ .kind = BT__OBSTACLE_CONVEX, .shape.hull = x->hull };
  return o;
}

bt__frame
squared_frame (bt__frame f)
{
  f.z = bt__unit_or (bt__cross (f.x, f.y), f.z);
  f.x = bt__unit_or (f.x, f.x);
  f.y = bt__cross (f.z, f.x);
  return f;
}
