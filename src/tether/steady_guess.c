/* The first guess for a line in a current: a catenary under the mean load.

   A neutral line in a uniform current is exactly a catenary sagging along the current, with the
   same tension q A all along; a weight in still water is exactly a catenary with tension q y.
   Between the two the guess takes the resultant load and blends the tensions by the share of the
   weight.

   A line near its full length or stretched is lengthened first by the tension of the cubic

   e T^3 + (1 - c) T^2 = k^2 / (24 c^2),

   T in units of the load, c the chord and k the part of the chord across, over the length, e = load
   / ea.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/steady.h"

/* The plane of the guess: y against the load.  */
typedef struct plane
{
  bt_vec3 across, against;
  double h, v;    /* the far end in the plane */
  double q, wet;  /* load, share of it that is weight, N/m */
  double stretch; /* 1 + strain */
  double tension; /* N, for the straight line */
} plane;

/* Any unit vector at right angles to the unit vector N, as near to WISH as can be.  */
static bt_vec3
normal_to (bt_vec3 n, bt_vec3 wish)
{
  bt_vec3 side = bt__off_axis (n, wish);
  if (bt__is_finite (side) && bt__norm (side) > 1e-6 * bt__norm (wish))
    return bt__unit_or (side, bt__vec (1, 0, 0));
  bt_vec3 other = fabs (n.x) < 0.7 ? bt__vec (1, 0, 0) : bt__vec (0, 1, 0);
  return bt__unit_or (bt__off_axis (n, other), other);
}

/* Solve the cubic of the head comment: Convex beyond its turning points: Newton from above falls
   monotonically onto the only positive root.  */
static double
taut_tension (double e, double c, double k)
{
  double d = k * k / (24 * c * c), s = 1 - c;
  double t = 2 * (fmax (-s, 0) / e + cbrt (d / e)) + 1e-300;
  if (s > 0 && d / s < t * t)
    t = sqrt (d / s);
  for (int i = 0; i < 60; i++)
    {
      double f = (e * t + s) * t * t - d, slope = (3 * e * t + 2 * s) * t;
      double step = slope > 0 ? f / slope : 0;
      t -= step;
      if (!(fabs (step) > 1e-10 * t))
        break;
    }
  return t;
}

/* Stiffness of the guess.  A line that cannot stretch but spans its whole length gets a little.  */
static double
guess_ea (const bt_line *line, double q)
{
  double most = 1e9 * q * line->length;
  return isfinite (line->ea) ? line->ea : fmax (most, 1e-300);
}

static void
stretch_plane (plane *p, const bt_line *line, double chord)
{
  double c = chord / line->length, ea = guess_ea (line, p->q), force = p->q * line->length;
  if (c < 0.5)
    return;
  if (force > 0)
    p->tension = force * taut_tension (force / ea, c, p->h / line->length);
  else
    p->tension = ea * fmax (c - 1, 0);
  if (isfinite (p->tension))
    p->stretch = 1 + p->tension / ea;
  else
    p->tension = force;
}

static void
set_load_plane (plane *p, const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b,
                bt_vec3 fallback)
{
  bt__loads k;
  bt__loads_set (&k, line, water, a);
  bt_vec3 u = bt_water_mean_velocity (water, a, b), chord = bt__sub (b, a);
  bt_vec3 load = bt__scale (k.kn * bt__norm (u), u);
  load.z -= k.w;
  if (!bt__is_finite (load))
    load = bt__vec (0, 0, 0);
  p->q = bt__norm (load);
  p->wet = p->q > 0 ? fabs (k.w) / p->q : 0;
  bt_vec3 ahead = bt__unit_or (chord, bt__vec (1, 0, 0));
  p->against = bt__scale (-1, bt__unit_or (load, normal_to (ahead, fallback)));
  p->v = bt__dot (chord, p->against);
  bt_vec3 side = bt__axpy (chord, -p->v, p->against);
  p->h = bt__norm (side);
  p->across
      = p->h > 1e-9 * line->length ? bt__scale (1 / p->h, side) : normal_to (p->against, fallback);
  p->stretch = 1;
  p->tension = 0;
  stretch_plane (p, line, bt__norm (chord));
}

/* A folded line has no direction of tension at all; open it a little so that it can be marched.  */
static double
opened (double h, double length)
{
  return fmax (h, 1e-3 * length);
}

static bt_vec3
into_space (const plane *p, bt_point2 at)
{
  return bt__axpy (bt__scale (at.x, p->across), at.y, p->against);
}

static bt_vec3
pull_at_anchor (const plane *p, const bt_catenary *c, bt_vec3 ahead)
{
  if (!isfinite (c->a))
    return bt__scale (p->tension, ahead);
  bt_vec3 t = into_space (p, bt_catenary_tangent (c, 0));
  return bt__scale (p->q * hypot (c->a, p->wet * c->sigma0), t);
}

void
bt__steady_guess (const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b,
                  bt_vec3 fallback, int n, bt_vec3 *r, bt_vec3 *pull)
{
  plane p;
  bt_catenary c;
  bt_vec3 chord = bt__sub (b, a);
  set_load_plane (&p, line, water, a, b, fallback);
  bt_status status
      = bt_catenary_solve (opened (p.h, line->length), p.v, line->length * p.stretch, &c, NULL);
  int straight = status != BT_OK || !isfinite (c.a);
  *pull = straight ? bt__scale (p.tension, bt__unit_or (chord, p.across))
                   : pull_at_anchor (&p, &c, chord);
  if (!bt__is_finite (*pull))
    *pull = bt__vec (0, 0, 0);
  for (int i = 0; r && i <= n; i++)
    {
      double u = (double)i / n;
      bt_vec3 on_chord = bt__axpy (a, u, chord);
      bt_vec3 on_curve
          = straight ? on_chord
                     : bt__add (
                         a, into_space (&p, bt_catenary_point (&c, u * line->length * p.stretch)));
      r[i] = bt__is_finite (on_curve) ? on_curve : on_chord;
    }
  if (r)
    r[n] = b;
}
