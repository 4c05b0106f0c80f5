/* The current: the velocity of the water at a place and a time, without waves and lees.

   A current is plain data (bt_current), read by the step and never changed.  Speeds are limited to
   20 m/s, far beyond any sea, so that squares of velocities stay harmless in the solvers.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include <bight/water.h>

#include "base/error.h"
#include "math/vec.h"
#include "model/current.h"
#include "sea/waves_line.h"

#define SPEED_MAX 20.0
#define TURN_MAX 1e3 /* rad/m: beyond any meaning, well within the range of sin and cos */

static const bt_vec3 still = { 0, 0, 0 };

bt_vec3
bt_set_and_drift (double speed, double toward)
{
  return bt__vec (speed * sin (toward), speed * cos (toward), 0);
}

/* Return the row K, 0 <= K < n - 1, with Z between the rows K and K + 1.  Z lies within the
   profile.  */
static int
find_row (const bt_current *current, double z)
{
  int rising = current->z[current->n - 1] > current->z[0];
  int low = 0, high = (int)current->n - 1;
  while (high - low > 1)
    {
      int middle = (low + high) / 2;
      if ((current->z[middle] <= z) == rising)
        low = middle;
      else
        high = middle;
    }
  return low;
}

static bt_vec3
profile_velocity (const bt_current *current, double z)
{
  int last = (int)current->n - 1;
  if (last < 0)
    return still;
  int rising = current->z[last] > current->z[0];
  if (last == 0 || (rising ? z <= current->z[0] : z >= current->z[0]))
    return current->velocity[0];
  if (rising ? z >= current->z[last] : z <= current->z[last])
    return current->velocity[last];
  if (!isfinite (z))
    return bt__vec (NAN, NAN, NAN);
  int k = find_row (current, z);
  double u = (z - current->z[k]) / (current->z[k + 1] - current->z[k]);
  return bt__axpy (bt__scale (1 - u, current->velocity[k]), u, current->velocity[k + 1]);
}

/* A bearing grows clockwise, seen from above.  */
static bt_vec3
turning_velocity (const bt_current *current, double z)
{
  double c = cos (current->turn_rate * -z), s = sin (current->turn_rate * -z);
  bt_vec3 v = current->velocity[0];
  return bt__vec (c * v.x + s * v.y, c * v.y - s * v.x, v.z);
}

static bt_vec3
power_velocity (const bt_current *current, double depth, double z)
{
  if (z >= 0)
    return current->velocity[0];
  double share = 1 + z / depth;
  if (share <= 0)
    return still;
  return bt__scale (pow (share, current->exponent), current->velocity[0]);
}

int
bt__water_is_layered (const bt_water *water)
{
  const bt_current *current = water->current;
  return current && !(water->sea && (water->sea->lees || water->sea->waves))
         && (current->kind == BT_CURRENT_PROFILE || current->kind == BT_CURRENT_TURNING
             || current->kind == BT_CURRENT_POWER);
}

static int
is_rising (const bt_current *current)
{
  return current->kind != BT_CURRENT_PROFILE || current->z[current->n - 1] > current->z[0];
}

/* The heights at which the shear leaps, in the order of rows.  */
static int
leaps (const bt_current *current, const double **height)
{
  static const double surface[] = { 0 };
  *height = current->kind == BT_CURRENT_POWER ? surface : current->z;
  return current->kind == BT_CURRENT_POWER     ? 1
         : current->kind == BT_CURRENT_PROFILE ? (int)current->n
                                               : 0;
}

/* Layer K lies between the leaps K - 1 and K.  */
int
bt__water_layer_at (const bt_water *water, double z)
{
  const double *height;
  int k = 0, n = leaps (water->current, &height), rising = is_rising (water->current);
  while (k < n && (rising ? height[k] <= z : height[k] > z))
    k++;
  return k;
}

void
bt__water_layer_bounds (const bt_water *water, int layer, double *low, double *high)
{
  const double *height;
  int n = leaps (water->current, &height), rising = is_rising (water->current);
  double before = layer > 0 ? height[layer - 1] : rising ? -INFINITY : INFINITY;
  double after = layer < n ? height[layer] : rising ? INFINITY : -INFINITY;
  *low = rising ? before : after;
  *high = rising ? after : before;
}

int
bt__water_next_layer (const bt_water *water, int layer, int up)
{
  return layer + (is_rising (water->current) == (up != 0) ? 1 : -1);
}

static bt_vec3
in_profile_layer (const bt_current *current, int layer, double z, bt_vec3 *shear)
{
  int last = (int)current->n - 1;
  *shear = still;
  if (layer == 0 || layer > last)
    return last < 0 ? still : current->velocity[layer == 0 ? 0 : last];
  double height = current->z[layer] - current->z[layer - 1];
  bt_vec3 v = current->velocity[layer - 1];
  *shear = bt__scale (1 / height, bt__sub (current->velocity[layer], v));
  return bt__axpy (v, z - current->z[layer - 1], *shear);
}

bt_vec3
bt__water_in_layer (const bt_water *water, int layer, double z, bt_vec3 *shear)
{
  const bt_current *current = water->current;
  if (current->kind == BT_CURRENT_PROFILE)
    return in_profile_layer (current, layer, z, shear);
  if (current->kind == BT_CURRENT_TURNING)
    {
      bt_vec3 v = turning_velocity (current, z);
      *shear = bt__scale (current->turn_rate, bt__vec (-v.y, v.x, 0));
      return v;
    }
  double share = layer == 0 ? 1 + z / water->depth : 1;
  *shear = still;
  if (share <= 0)
    return still;
  bt_vec3 v = bt__scale (pow (share, current->exponent), current->velocity[0]);
  if (layer == 0)
    *shear = bt__scale (current->exponent / (water->depth + z), v);
  return v;
}

static bt_vec3
function_velocity (const bt_water *water, bt_vec3 p)
{
  bt_vec3 v = still;
  if (water->function)
    water->function (water->user, p, water->time, &v);
  return v;
}

static bt_vec3
grid_velocity (const bt_water *water, bt_vec3 p)
{
  if (!water->sea || !water->sea->grid)
    return water->current->velocity[0];
  return bt_current_grid_velocity (water->sea->grid, p, water->time);
}

/* The current as if nothing stood in it.  */
static bt_vec3
open_current (const bt_water *water, bt_vec3 p)
{
  const bt_current *current = water->current;
  if (!current)
    return still;
  switch (current->kind)
    {
    case BT_CURRENT_UNIFORM:
      return current->velocity[0];
    case BT_CURRENT_PROFILE:
      return profile_velocity (current, p.z);
    case BT_CURRENT_TURNING:
      return turning_velocity (current, p.z);
    case BT_CURRENT_POWER:
      return power_velocity (current, water->depth, p.z);
    case BT_CURRENT_TIDE:
      return bt__scale (cos (2 * BT__PI * water->time / current->period), current->velocity[0]);
    case BT_CURRENT_FUNCTION:
      return function_velocity (water, p);
    case BT_CURRENT_GRID:
      return grid_velocity (water, p);
    default:
      return still;
    }
}

static int
water_has_waves (const bt_water *water)
{
  return water->sea && water->sea->waves && water->sea->waves->n > 0;
}

bt_vec3
bt_water_current (const bt_water *water, bt_vec3 p)
{
  bt_vec3 v = open_current (water, p);
  const bt_sea *sea = water->sea;
  if (!sea || !sea->lees || (v.x == 0 && v.y == 0 && v.z == 0))
    return v;
  return bt__scale (bt_lees_share (sea->lees, v, p), v);
}

bt_vec3
bt_water_velocity (const bt_water *water, bt_vec3 p)
{
  bt_vec3 v = bt_water_current (water, p), orbit;
  if (!water_has_waves (water))
    return v;
  bt_waves_motion (water->sea->waves, p, water->time, &orbit, NULL);
  return bt__add (v, orbit);
}

bt_vec3
bt_water_acceleration (const bt_water *water, bt_vec3 p)
{
  bt_vec3 a = still;
  if (water_has_waves (water))
    bt_waves_motion (water->sea->waves, p, water->time, NULL, &a);
  return a;
}

void
bt_water_motion (const bt_water *water, bt_vec3 p, bt_vec3 *velocity, bt_vec3 *acceleration)
{
  bt_vec3 orbit = still;
  *acceleration = still;
  if (water_has_waves (water))
    bt_waves_motion (water->sea->waves, p, water->time, &orbit, acceleration);
  *velocity = bt__add (bt_water_current (water, p), orbit);
}

enum
{
  CHUNK = 64
};

/* True if the current is the same everywhere but for lees.  */
static int
is_open_uniform (const bt_current *current)
{
  return !current || current->kind == BT_CURRENT_STILL || current->kind == BT_CURRENT_UNIFORM
         || current->kind == BT_CURRENT_TIDE;
}

/* The current at N places P, CHUNK at most.  */
static void
currents (const bt_water *water, const bt_vec3 *p, size_t n, bt_vec3 *velocity)
{
  double share[CHUNK];
  int same = is_open_uniform (water->current);
  bt_vec3 v = same ? open_current (water, p[0]) : still;
  int lees = same && water->sea && water->sea->lees && (v.x != 0 || v.y != 0 || v.z != 0);
  if (lees)
    bt_lees_shares (water->sea->lees, v, p, n, share);
  for (size_t i = 0; i < n; i++)
    velocity[i] = lees ? bt__scale (share[i], v) : same ? v : bt_water_current (water, p[i]);
}

void
bt_water_motions (const bt_water *water, const bt_vec3 *p, size_t n, bt_vec3 *velocity,
                  bt_vec3 *acceleration)
{
  bt_vec3 v[CHUNK];
  int waves = water_has_waves (water);
  if (waves)
    bt_waves_motions (water->sea->waves, p, n, water->time, velocity, acceleration);
  if (waves && (!water->current || water->current->kind == BT_CURRENT_STILL))
    return;
  for (size_t i = 0; i < n; i += CHUNK)
    {
      size_t count = n - i < CHUNK ? n - i : CHUNK;
      currents (water, p + i, count, v);
      for (size_t k = 0; k < count; k++)
        velocity[i + k] = waves ? bt__add (v[k], velocity[i + k]) : v[k];
    }
}

double
bt_water_surface (const bt_water *water, bt_vec3 p)
{
  return water_has_waves (water) ? bt_waves_elevation (water->sea->waves, p.x, p.y, water->time)
                                 : 0;
}

void
bt__water_surfaces (const bt_water *water, const bt_vec3 *p, size_t n, double *height)
{
  if (water_has_waves (water))
    bt__waves_elevations (water->sea->waves, p, n, water->time, height);
  else
    memset (height, 0, n * sizeof *height);
}

double
bt_water_crest (const bt_water *water)
{
  double sum = 0;
  for (int i = 0; water_has_waves (water) && i < water->sea->waves->n; i++)
    sum += water->sea->waves->amplitude[i];
  return sum;
}

int
bt_water_is_uniform (const bt_water *water)
{
  return !water_has_waves (water) && !(water->sea && water->sea->lees)
         && is_open_uniform (water->current);
}

bt_vec3
bt_water_mean_velocity (const bt_water *water, bt_vec3 a, bt_vec3 b)
{
  static const double place[5]
      = { 0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155, 0.953089922969332 };
  static const double weight[5] = { 0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                    0.23931433524968324, 0.11846344252809454 };
  if (bt_water_is_uniform (water))
    return bt_water_velocity (water, a);
  bt_vec3 mean = still;
  for (int i = 0; i < 5; i++)
    {
      bt_vec3 p = bt__axpy (a, place[i], bt__sub (b, a));
      mean = bt__axpy (mean, weight[i], bt_water_velocity (water, p));
    }
  return mean;
}

int
bt_current_is_unsteady (const bt_current *current)
{
  return current->kind == BT_CURRENT_TIDE || current->kind == BT_CURRENT_FUNCTION;
}

int
bt_water_is_unsteady (const bt_water *water)
{
  const bt_current *current = water->current;
  if (water_has_waves (water))
    return 1;
  if (current && current->kind == BT_CURRENT_GRID)
    return water->sea && water->sea->grid && bt_current_grid_is_unsteady (water->sea->grid);
  return current && bt_current_is_unsteady (current);
}

static bt_status
check_velocity (bt_vec3 v, bt_error *error)
{
  double speed = bt__norm (v);
  if (!(speed <= SPEED_MAX))
    return bt__fail (error, BT_ERR_DOMAIN, "a current of %g m/s; at most %g m/s is allowed", speed,
                     SPEED_MAX);
  return BT_OK;
}

static bt_status
check_order (const bt_current *current, bt_error *error)
{
  int rising = current->n > 1 && current->z[1] > current->z[0];
  for (int i = 0; i < current->n; i++)
    {
      if (!isfinite (current->z[i]))
        return bt__fail (error, BT_ERR_DOMAIN, "row %d of the profile lies at a height of %g m",
                         i + 1, current->z[i]);
      if (i > 0
          && !(rising ? current->z[i] > current->z[i - 1] : current->z[i] < current->z[i - 1]))
        return bt__fail (
            error, BT_ERR_DOMAIN,
            "row %d of the profile (z = %g m) does not follow row %d (z = %g m); heights "
            "must all rise or all fall",
            i + 1, current->z[i], i, current->z[i - 1]);
    }
  return BT_OK;
}

static bt_status
check_profile (const bt_current *current, bt_error *error)
{
  if (current->n < 1 || current->n > BT_PROFILE_MAX)
    return bt__fail (error, BT_ERR_DOMAIN, "a profile of %ld rows; 1 to %d are allowed",
                     (long)current->n, BT_PROFILE_MAX);
  bt_status status = check_order (current, error);
  for (int i = 0; i < current->n && status == BT_OK; i++)
    status = check_velocity (current->velocity[i], error);
  return status;
}

static bt_status
check_turning (const bt_current *current, bt_error *error)
{
  if (!(fabs (current->turn_rate) <= TURN_MAX))
    return bt__fail (error, BT_ERR_DOMAIN, "a current that turns by %g rad per metre; at most %g",
                     current->turn_rate, TURN_MAX);
  return check_velocity (current->velocity[0], error);
}

static bt_status
check_power (const bt_current *current, bt_error *error)
{
  if (!(current->exponent >= 0 && isfinite (current->exponent)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a power current with the exponent %g; it must be finite and not negative",
                     current->exponent);
  return check_velocity (current->velocity[0], error);
}

static bt_status
check_tide (const bt_current *current, bt_error *error)
{
  if (!(current->period > 0 && isfinite (current->period)))
    return bt__fail (error, BT_ERR_DOMAIN, "a tide with a period of %g s; it must be positive",
                     current->period);
  return check_velocity (current->velocity[0], error);
}

bt_status
bt_current_check (const bt_current *current, bt_error *error)
{
  switch (current->kind)
    {
    case BT_CURRENT_STILL:
    case BT_CURRENT_FUNCTION:
      return BT_OK;
    case BT_CURRENT_UNIFORM:
    case BT_CURRENT_GRID:
      return check_velocity (current->velocity[0], error);
    case BT_CURRENT_PROFILE:
      return check_profile (current, error);
    case BT_CURRENT_TURNING:
      return check_turning (current, error);
    case BT_CURRENT_POWER:
      return check_power (current, error);
    case BT_CURRENT_TIDE:
      return check_tide (current, error);
    default:
      return bt__fail (error, BT_ERR_DOMAIN, "a current of unknown kind %ld", (long)current->kind);
    }
}
