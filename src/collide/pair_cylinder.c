/* A link's axis against a solid cylinder with flat caps.

   In the cylinder's frame (axis z) the squared distance is convex along the link; half its slope is

   g = max (rho - R, 0) rho' + (excess of z over the caps) z',

   continuous and rising, with kinks where the link passes the side's radius and the caps' planes.
   The bracket of its root shrinks to between two kinks; between kinks the link is beside the side
   only (rho' = 0, closed), over a cap only (linear), or over a rim, where Newton's iteration within
   the bracket takes three to five steps.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/pair.h"

typedef struct local
{
  bt_vec3 p, d;
  double half, radius;
  double a, b; /* the slope of rho^2 is 2 (a t + b) */
} local;

static double
over (double z, double half)
{
  return z > half ? z - half : z < -half ? z + half : 0;
}

/* The square of rho, computed from the point: a polynomial in T would lose the radius of a long
   link to rounding.  */
static double
square_at (const local *k, double t)
{
  double x = k->p.x + t * k->d.x, y = k->p.y + t * k->d.y;
  return x * x + y * y;
}

static double
slope_to_cylinder (const local *k, double t)
{
  double x = k->p.x + t * k->d.x, y = k->p.y + t * k->d.y, square = x * x + y * y, g = 0;
  if (square > k->radius * k->radius)
    g = (x * k->d.x + y * k->d.y) * (1 - k->radius / sqrt (square));
  return g + over (k->p.z + t * k->d.z, k->half) * k->d.z;
}

typedef struct bracket
{
  double lo, hi, first, last; /* the slopes there: first < 0 < last */
} bracket;

static void
narrow (const local *k, double t, bracket *x)
{
  if (!(t > x->lo && t < x->hi))
    return;
  double g = slope_to_cylinder (k, t);
  if (g < 0)
    {
      x->lo = t;
      x->first = g;
    }
  else
    {
      x->hi = t;
      x->last = g;
    }
}

/* Where the link passes the side's radius: as far before as after the foot of the axis.  */
static void
narrow_by_side (const local *k, bracket *x)
{
  if (!(k->a > 0))
    return;
  double foot = -k->b / k->a, inside = k->radius * k->radius - square_at (k, foot);
  if (!(inside > 0))
    return;
  double half = sqrt (inside / k->a);
  narrow (k, foot - half, x);
  narrow (k, foot + half, x);
}

/* Over a rim of height Z: Newton on the slope, kept in the bracket.  */
static double
over_rim (const local *k, double z, bracket *x)
{
  double t = x->lo + (x->hi - x->lo) * (x->first / (x->first - x->last));
  for (int i = 0; i < 40; i++)
    {
      double px = k->p.x + t * k->d.x, py = k->p.y + t * k->d.y;
      double rho = sqrt (px * px + py * py), inverse = 1 / rho;
      double turn = (px * k->d.x + py * k->d.y) * inverse;
      double g = (rho - k->radius) * turn + (k->p.z + t * k->d.z - z) * k->d.z;
      double rise
          = turn * turn + (1 - k->radius * inverse) * (k->a - turn * turn) + k->d.z * k->d.z;
      if (g < 0)
        x->lo = t;
      else
        x->hi = t;
      double next = t - g / rise;
      if (!(next > x->lo && next < x->hi))
        next = 0.5 * (x->lo + x->hi);
      if (fabs (next - t) <= 1e-15)
        break;
      t = next;
    }
  return t;
}

static double
inner_root (const local *k, bracket *x)
{
  double t = 0.5 * (x->lo + x->hi), z = k->p.z + t * k->d.z;
  if (!(square_at (k, t) > k->radius * k->radius))
    return x->lo + (x->hi - x->lo) * (x->first / (x->first - x->last));
  if (fabs (z) <= k->half)
    return k->a > 0 ? bt__clamp (-k->b / k->a, x->lo, x->hi) : t;
  return over_rim (k, z > 0 ? k->half : -k->half, x);
}

static double
nearest_to_cylinder (const local *k)
{
  bracket x = { 0, 1, slope_to_cylinder (k, 0), 0 };
  if (x.first >= 0)
    return 0;
  x.last = slope_to_cylinder (k, 1);
  if (x.last <= 0)
    return 1;
  if (k->d.z != 0)
    {
      narrow (k, (k->half - k->p.z) / k->d.z, &x);
      narrow (k, (-k->half - k->p.z) / k->d.z, &x);
    }
  narrow_by_side (k, &x);
  return x.last > 0 ? inner_root (k, &x) : x.hi;
}

/* x, y any two axes that with z are orthonormal.  */
static void
cylinder_frame (const bt__cylinder *c, bt__frame *f)
{
  bt_vec3 z = c->axis;
  /* Duff et al. 2017: no square root.  */
  double sign = z.z < 0 ? -1 : 1, a = -1 / (sign + z.z), b = z.x * z.y * a;
  f->origin = c->centre;
  f->x = bt__vec (1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
  f->y = bt__vec (b, sign + z.y * z.y * a, -z.y);
  f->z = z;
}

static void
finish_outside (const bt__frame *f, const bt__link *link, bt__witness *out)
{
  out->normal = bt__out_of (f, out->normal);
  if (!(out->distance > 0)) /* from the deep case */
    out->point = bt__axpy (bt__along (link, out->s), -out->distance, out->normal);
  else
    out->point = bt__to_world (f, out->point);
}

/* The point ON of LINK nearest to CYLINDER, in the cylinder's frame.  */
typedef struct nearest
{
  bt__frame f;
  local k;
  double s, rho, beside, above, distance;
  bt_vec3 on;
} nearest;

static void
find_nearest (const bt__cylinder *cylinder, const bt__link *link, nearest *x)
{
  local *k = &x->k;
  cylinder_frame (cylinder, &x->f);
  k->half = cylinder->half;
  k->radius = cylinder->radius;
  k->p = bt__to_local (&x->f, link->a);
  k->d = bt__into (&x->f, bt__sub (link->b, link->a));
  k->a = k->d.x * k->d.x + k->d.y * k->d.y;
  k->b = k->p.x * k->d.x + k->p.y * k->d.y;
  x->s = nearest_to_cylinder (k);
  x->on = bt__axpy (k->p, x->s, k->d);
  x->rho = sqrt (x->on.x * x->on.x + x->on.y * x->on.y);
  x->beside = x->rho > k->radius ? x->rho - k->radius : 0;
  x->above = over (x->on.z, k->half);
  x->distance = sqrt (x->beside * x->beside + x->above * x->above);
}

/* True if the link meets the cylinder, as far as distances are sure.  */
static int
does_meet (const nearest *x)
{
  return !(x->distance > BT__TOUCHING * (bt__largest (x->k.p) + x->k.half + x->k.radius));
}

void
bt__pair_cylinder (const bt__cylinder *cylinder, const bt__link *link, bt__witness *out)
{
  nearest x;
  find_nearest (cylinder, link, &x);
  out->s = x.s;
  if (does_meet (&x))
    bt__cylinder_deep (x.k.p, bt__add (x.k.p, x.k.d), x.k.half, x.k.radius, out);
  else
    {
      double above = x.above, out_of_axis = x.beside > 0 ? x.beside / (x.rho * x.distance) : 0;
      out->distance = x.distance;
      out->normal = bt__vec (x.on.x * out_of_axis, x.on.y * out_of_axis, above / x.distance);
      out->point = bt__axpy (x.on, -x.distance, out->normal);
      out->feature
          = above == 0 ? BT__SIDE : (x.beside > 0 ? BT__RIM_LOW : BT__CAP_LOW) + (above > 0);
    }
  finish_outside (&x.f, link, out);
}

int
bt__cylinder_within (const bt__cylinder *cylinder, const bt__link *link, double reach)
{
  nearest x;
  find_nearest (cylinder, link, &x);
  return x.distance <= reach || does_meet (&x);
}
