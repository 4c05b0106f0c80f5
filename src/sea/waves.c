/* Waves: linear (Airy) theory over a level bottom, one component or many.

   Waves are plain data, a table of components; surface and velocity at a place are sums of
   waves_sum.h.  A regular wave has one component.  An irregular sea has the JONSWAP spectrum
   (Hasselmann et al. 1973) between half and four times the peak frequency, cut into as many parts
   of equal energy as there are components.  Each component has the amplitude of one part, H / 4
   sqrt (2 / n), and a random phase.  The frequency is drawn within the part: a sea of such
   frequencies never repeats.  Numbers are drawn by SplitMix64 from the seed of the sea: equal
   definitions give equal seas.

   Wave numbers solve omega^2 = g k tanh (k depth).  A wave higher than Miche's limit 0.142 L tanh
   (k depth) breaks and is refused.  The factor of the bottom, e^(-2 k depth), is kept with each
   component, or 0 where the component feels no bottom.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/sea.h>

#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sea/waves_line.h"
#include "sea/waves_sum.h"

enum
{
  CELLS = 4000 /* of the integral of a spectrum */
};

#define PERIOD_LEAST 0.5
#define PERIOD_MOST 60.0
#define HEIGHT_MOST 40.0
#define MICHE 0.142
#define ACCURACY_LEAST 1e-6
#define ACCURACY_MOST 0.1
#define LOWEST 0.5 /* of the peak frequency */
#define HIGHEST 4.0
#define BOTTOMLESS 18.5 /* k times height from which on no bottom is felt, to 1e-16 */

double
bt_wave_number (double omega, double depth, double gravity)
{
  double deep = omega * omega / gravity * depth;
  double y = deep > 1 ? deep : sqrt (deep); /* y tanh y = deep */
  for (int i = 0; i < 30; i++)
    {
      double t = tanh (y), step = (y * t - deep) / (t + y * (1 - t * t));
      y -= step;
      if (fabs (step) <= 1e-15 * y)
        break;
    }
  return y / depth;
}

/* ---- Making them ---- */

static bt_status
check_waves (const bt_wave_def *def, double depth, double gravity, bt_error *error)
{
  if (!(def->period >= PERIOD_LEAST && def->period <= PERIOD_MOST))
    return bt__fail (error, BT_ERR_DOMAIN, "waves of %g s; %g to %g s are allowed", def->period,
                     PERIOD_LEAST, PERIOD_MOST);
  if (!(def->height >= 0 && def->height <= HEIGHT_MOST))
    return bt__fail (error, BT_ERR_DOMAIN, "waves of %g m; 0 to %g m are allowed", def->height,
                     HEIGHT_MOST);
  if (!(depth > 0 && gravity > 0 && isfinite (depth) && isfinite (gravity)))
    return bt__fail (error, BT_ERR_DOMAIN, "waves in %g m of water under %g m/s2", depth, gravity);
  if (!(isfinite (def->toward) && isfinite (def->phase)))
    return bt__fail (error, BT_ERR_DOMAIN, "waves toward %g rad of phase %g", def->toward,
                     def->phase);
  double k = bt_wave_number (2 * BT__PI / def->period, depth, gravity);
  double most = MICHE * 2 * BT__PI / k * tanh (k * depth);
  if (def->height > most)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "waves of %g m and %g s break; at most %.3g m is allowed", def->height,
                     def->period, most);
  if (def->kind == BT_WAVE_AIRY)
    return BT_OK;
  if (def->kind != BT_WAVE_JONSWAP)
    return bt__fail (error, BT_ERR_DOMAIN, "waves of unknown kind %ld", (long)def->kind);
  if (!(def->gamma >= 1 && def->gamma <= 10))
    return bt__fail (error, BT_ERR_DOMAIN, "a JONSWAP sea with gamma %g; 1 to 10 are allowed",
                     def->gamma);
  if (!(def->components >= 2 && def->components <= BT_WAVES_MAX))
    return bt__fail (error, BT_ERR_DOMAIN, "a sea of %g components; 2 to %d are allowed",
                     def->components, BT_WAVES_MAX);
  if (!(def->accuracy == 0 || (def->accuracy >= ACCURACY_LEAST && def->accuracy <= ACCURACY_MOST)))
    return bt__fail (error, BT_ERR_DOMAIN, "a sea within %g; 0, exact, or %g to %g are allowed",
                     def->accuracy, ACCURACY_LEAST, ACCURACY_MOST);
  return BT_OK;
}

/* A number in [0, 1) that follows from *SEED, which goes on (splitmix64).  */
static double
draw (uint64_t *seed)
{
  uint64_t z = *seed += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return (double)((z ^ z >> 31) >> 11) / 9007199254740992.0;
}

/* The JONSWAP spectrum at R times the peak frequency, but for a factor.  */
static double
density (double r, double gamma)
{
  double width = r <= 1 ? 0.07 : 0.09, s = (r - 1) / width;
  return pow (r, -5) * exp (-1.25 * pow (r, -4)) * pow (gamma, exp (-s * s / 2));
}

static double
frequency_of_cell (double cell)
{
  return LOWEST + (HIGHEST - LOWEST) * cell / CELLS;
}

/* Complete component I of W, whose frequency is set.  The bottom enters only where the component
   feels the bottom at some depth at which the component is not negligible.  */
static void
complete (bt_waves *w, int i, double gravity)
{
  double k = bt_wave_number (w->omega[i], w->depth, gravity), deep = k * w->depth;
  w->k[i] = k;
  w->bed[i] = deep < BT__UNFELT + BOTTOMLESS ? exp (-2 * deep) : 0;
  w->speed[i] = w->amplitude[i] * w->omega[i] / -expm1 (-2 * deep);
}

/* Each part has the same energy; its frequency is drawn from within it.  */
static void
draw_sea (const bt_wave_def *def, bt_waves *w)
{
  double whole = 0, below = 0, peak = 2 * BT__PI / def->period;
  uint64_t seed = (uint64_t)def->seed;
  int cell = 0;
  for (int i = 0; i < CELLS; i++)
    whole += density (frequency_of_cell (i + 0.5), def->gamma);
  for (int i = 0; i < w->n; i++)
    {
      double wish = (i + draw (&seed)) / (double)w->n * whole;
      double here = density (frequency_of_cell (cell + 0.5), def->gamma);
      while (below + here < wish && cell < CELLS - 1)
        {
          below += here;
          here = density (frequency_of_cell (++cell + 0.5), def->gamma);
        }
      double share = fmax (0, fmin (1, (wish - below) / here));
      w->omega[i] = peak * frequency_of_cell (cell + share);
      w->amplitude[i] = def->height / 4 * sqrt (2 / (double)w->n);
      w->phase[i] = 2 * BT__PI * draw (&seed);
    }
}

bt_status
bt_waves_make (const bt_wave_def *def, double depth, double gravity, bt_waves *waves,
               bt_error *error)
{
  memset (waves, 0, sizeof *waves);
  if (def->kind == BT_WAVE_NONE)
    return BT_OK;
  bt_status status = check_waves (def, depth, gravity, error);
  if (status != BT_OK)
    return status;
  waves->n = def->kind == BT_WAVE_AIRY ? 1 : (int64_t)def->components;
  waves->depth = depth;
  waves->east = sin (def->toward);
  waves->north = cos (def->toward);
  if (def->kind == BT_WAVE_JONSWAP)
    draw_sea (def, waves);
  else
    {
      waves->omega[0] = 2 * BT__PI / def->period;
      waves->amplitude[0] = def->height / 2;
      waves->phase[0] = def->phase;
    }
  for (int i = 0; i < waves->n; i++)
    complete (waves, i, gravity);
  if (def->kind == BT_WAVE_JONSWAP)
    waves->accuracy = def->accuracy;
  bt__waves_reaches (waves);
  return BT_OK;
}

/* ---- Asking them ---- */

static BT__WIDE bt__orbit
orbit_at (const bt_waves *w, double way, double z, double t)
{
  return bt__waves_orbit (w, way, z, t);
}

static BT__WIDE bt__orbit
surface_at (const bt_waves *w, double way, double t)
{
  return bt__waves_surface (w, way, t);
}

static double
wave_way (const bt_waves *w, double x, double y)
{
  return w->east * x + w->north * y;
}

double
bt_waves_elevation (const bt_waves *w, double x, double y, double t)
{
  return surface_at (w, wave_way (w, x, y), t).up;
}

void
bt_waves_motion (const bt_waves *w, bt_vec3 p, double t, bt_vec3 *velocity, bt_vec3 *acceleration)
{
  double z = p.z < 0 ? bt__clamp (p.z, -w->depth, 0) : 0;
  double lost = 0 * p.x + 0 * p.y + 0 * p.z + 0 * t; /* NaN, where nothing felt would hide it */
  bt__orbit o = orbit_at (w, wave_way (w, p.x, p.y), z, t);
  if (velocity)
    *velocity = bt__vec (o.along * w->east, o.along * w->north, o.up + lost);
  if (acceleration)
    *acceleration = bt__vec (o.along2 * w->east, o.along2 * w->north, o.up2 + lost);
}

bt_vec3
bt_waves_ride (const bt_waves *w, const bt_rider *rider, bt_vec3 p, double t)
{
  bt__orbit o = surface_at (w, wave_way (w, p.x, p.y), t);
  double ahead_e = sin (rider->yaw), ahead_n = cos (rider->yaw);
  double ahead = rider->surge * o.along * (w->east * ahead_e + w->north * ahead_n);
  double aside = rider->sway * o.along * (w->east * ahead_n - w->north * ahead_e);
  return bt__vec (ahead * ahead_e + aside * ahead_n, ahead * ahead_n - aside * ahead_e,
                  rider->heave * o.up);
}
