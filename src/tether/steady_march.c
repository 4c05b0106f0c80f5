/* The march along a line in a current: an initial-value problem in the arc length.

   State: position r and tension vector T.  Written in the tension vector the equations have no
   singular angle and no division but by the tension itself,
     dr/ds = t (1 + T/ea),  dT/ds = -load (r, t),  t = T/|T|,
   and compression cannot appear.  Classical fourth-order Runge-Kutta with equal steps.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "base/error.h"
#include "model/current.h"
#include "tether/steady.h"

void
bt__loads_set (bt__loads *loads, const bt_line *line, const bt_water *water, bt_vec3 at)
{
  loads->water = water;
  loads->kn = water->density / 2 * line->cdn * line->diameter;
  loads->kt = water->density / 2 * line->cdt * BT__PI * line->diameter;
  loads->w = line->wet_weight;
  loads->inv_ea = 1 / line->ea;
  loads->uniform = bt_water_is_uniform (water);
  loads->layered = bt__water_is_layered (water);
  loads->u = loads->uniform ? bt_water_velocity (water, at) : bt__vec (0, 0, 0);
}

double
bt__loads_scale (const bt__loads *loads, const bt_line *line, bt_vec3 a, bt_vec3 b)
{
  bt_vec3 u = bt_water_mean_velocity (loads->water, a, b);
  double load = fabs (loads->w) + loads->kn * bt__dot (u, u);
  if (!(load > 0) || !isfinite (load))
    load = loads->water->density * loads->water->gravity * BT__PI / 4 * line->diameter
           * line->diameter;
  return load > 0 && isfinite (load) ? load * line->length : line->length;
}

typedef struct state
{
  bt_vec3 r, t;
} state;

/* Return the derivative of S along the line.  A vanished tension gives NaN, which the march finds.
 */
static inline state
slope (const bt__loads *loads, bt_vec3 origin, state s)
{
  double tension = bt__norm (s.t);
  bt_vec3 t = bt__scale (1 / tension, s.t);
  bt_vec3 u = loads->uniform ? loads->u : bt_water_velocity (loads->water, bt__add (origin, s.r));
  return (state){ bt__scale (1 + tension * loads->inv_ea, t),
                  bt__scale (-1, bt__loads_at (loads, u, t)) };
}

static inline state
advance_state (state s, double h, state k)
{
  return (state){ bt__axpy (s.r, h, k.r), bt__axpy (s.t, h, k.t) };
}

static inline state
march_step (const bt__loads *loads, bt_vec3 origin, state s, double h)
{
  state k1 = slope (loads, origin, s);
  state k2 = slope (loads, origin, advance_state (s, h / 2, k1));
  state k3 = slope (loads, origin, advance_state (s, h / 2, k2));
  state k4 = slope (loads, origin, advance_state (s, h, k3));
  s = advance_state (s, h / 6, k1);
  s = advance_state (s, h / 3, k2);
  s = advance_state (s, h / 3, k3);
  return advance_state (s, h / 6, k4);
}

static void
store_state (bt_vec3 origin, state s, int i, bt_vec3 *r, bt_vec3 *t)
{
  if (r)
    r[i] = bt__add (origin, s.r);
  if (t)
    t[i] = s.t;
}

int
bt__march (const bt__loads *loads, bt_vec3 origin, bt_vec3 pull, double length, int n, bt_vec3 *end,
           bt_vec3 *r, bt_vec3 *t)
{
  double h = length / n;
  state s = { { 0, 0, 0 }, pull };
  store_state (origin, s, 0, r, t);
  for (int i = 1; i <= n; i++)
    {
      s = march_step (loads, origin, s, h);
      store_state (origin, s, i, r, t);
    }
  /* NaN survives every later step, so one look at the end is enough.  */
  *end = s.r;
  return bt__is_finite (s.r) && bt__is_finite (s.t);
}

bt_status
bt_steady_march (const bt_line *line, const bt_water *water, bt_vec3 start, bt_vec3 pull, int n,
                 bt_vec3 *r, bt_vec3 *t, bt_error *error)
{
  bt__loads loads;
  bt_vec3 end;
  if (n < 1)
    return bt__fail (error, BT_ERR_DOMAIN, "a march of %d steps; at least 1 is needed", n);
  bt__loads_set (&loads, line, water, start);
  if (!bt__march (&loads, start, pull, line->length, n, &end, r, t))
    return bt__fail (error, BT_ERR_DIVERGED,
                     "the march along the line found no finite answer: the tension vanishes or the "
                     "current is not finite");
  return BT_OK;
}
