/* The sea: density, gravity, depth and a current that depends on place and time.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_WATER_H
#define BIGHT_WATER_H

#include <stdint.h>

#include <bight/decls.h>
#include <bight/sea.h>
#include <bight/status.h>
#include <bight/vec.h>

BT_BEGIN_DECLS

enum
{
  BT_PROFILE_MAX = 64 /* rows of a current profile */
};

typedef enum bt_current_kind
{
  BT_CURRENT_STILL = 0, /* no current: nothing is sampled */
  BT_CURRENT_UNIFORM,   /* velocity[0] everywhere */
  BT_CURRENT_PROFILE,   /* rows by height z; the velocity vector is linear between rows, constant
                           beyond */
  BT_CURRENT_TURNING,   /* constant speed, the set turns with depth */
  BT_CURRENT_POWER,     /* velocity[0] (1 + z/depth)^exponent over the depth of the sea */
  BT_CURRENT_TIDE,      /* velocity[0] cos (2 pi t / period) */
  BT_CURRENT_FUNCTION,  /* asked of bt_water.function */
  BT_CURRENT_GRID       /* asked of the grid of bt_water.sea; velocity[0] without one */
} bt_current_kind;

/* A current as plain data, without pointers, fit for the state of a dive.  */
typedef struct bt_current
{
  int64_t kind;                     /* bt_current_kind */
  int64_t n;                        /* rows in use, PROFILE only */
  double turn_rate;                 /* TURNING: clockwise radians per metre of depth */
  double exponent;                  /* POWER */
  double period;                    /* TIDE: s */
  double z[BT_PROFILE_MAX];         /* PROFILE: heights, m, strictly decreasing or increasing */
  bt_vec3 velocity[BT_PROFILE_MAX]; /* m/s; [0] alone for the other kinds */
} bt_current;

/* A velocity in m/s at P metres and T seconds, written to *V.  Non-finite values are refused by the
   solvers as `diverged'.  */
typedef void (*bt_current_function) (void *user, bt_vec3 p, double t, bt_vec3 *v);

/* Water as the solvers see it.  CURRENT and USER are borrowed.  */
typedef struct bt_water
{
  double density; /* kg/m3 */
  double gravity; /* m/s2 */
  double depth;   /* m */
  double time;    /* s */
  const bt_current *current;
  bt_current_function function; /* for BT_CURRENT_FUNCTION, else NULL */
  void *user;
  const bt_sea *sea; /* what there is beside the current, borrowed; NULL: nothing */
} bt_water;

/* Return the horizontal velocity of a current of SPEED m/s that flows TOWARD the compass bearing,
   in radians clockwise from north.  */
bt_vec3 bt_set_and_drift (double speed, double toward);

/* Return the velocity of WATER at P, m/s: the current, less in the lee of what stands in it, and
   waves.  */
bt_vec3 bt_water_velocity (const bt_water *water, bt_vec3 p);

/* Return the same without waves: what carries a tether on the whole.  */
bt_vec3 bt_water_current (const bt_water *water, bt_vec3 p);

/* Return the acceleration of WATER by waves at P, m/s2.  */
bt_vec3 bt_water_acceleration (const bt_water *water, bt_vec3 p);

/* Return both at once, which costs waves but once: VELOCITY and ACCELERATION.  */
void bt_water_motion (const bt_water *water, bt_vec3 p, bt_vec3 *velocity, bt_vec3 *acceleration);

/* Write the same at the N places P of a line, in order, to VELOCITY and, if there are waves, to
   ACCELERATION: waves as bt_waves_motions has them, lees as bt_lees_shares has them.  */
void bt_water_motions (const bt_water *water, const bt_vec3 *p, size_t n, bt_vec3 *velocity,
                       bt_vec3 *acceleration);

/* Return the height of the surface of WATER over P, m: 0 without waves.  */
double bt_water_surface (const bt_water *water, bt_vec3 p);

/* Return a bound, m, on the height of the surface of WATER above and below its mean.  */
double bt_water_crest (const bt_water *water);

/* Return true if the velocity of WATER is the same everywhere, at any one time.  */
int bt_water_is_uniform (const bt_water *water);

/* Return true if WATER changes with time though nothing else does.  */
int bt_water_is_unsteady (const bt_water *water);

/* Return the mean velocity of WATER over the straight line from A to B, m/s (5-point Gauss rule;
   the value at A when the current is the same everywhere).  */
bt_vec3 bt_water_mean_velocity (const bt_water *water, bt_vec3 a, bt_vec3 b);

/* Return true if CURRENT changes with time though nothing else does.  */
int bt_current_is_unsteady (const bt_current *current);

/* Check CURRENT: finite, at most 20 m/s, rows in order, period positive.  BT_ERR_DOMAIN says what
   is wrong.  */
bt_status bt_current_check (const bt_current *current, bt_error *error);

BT_END_DECLS

#endif
