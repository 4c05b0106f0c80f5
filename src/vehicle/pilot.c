/* Autopilots: cascades of position, speed and force (pilot.h).

   One axis (drive): the wished speed is frequency / 2 times the error, at most the fastest; the
   force is 2 frequency times the lack of speed times the moving mass, plus the drag expected at the
   wished speed, plus the integral.  With w the frequency the loop has the poles of s^2 + 2 w s +
   w^2.  The integral grows only while the wish is below the fastest, and not further while the
   thrusters have reached their limit (anti-windup).

   Position and waypoint limit the level way and the level force as vectors, so that a vehicle goes
   straight.  A waypoint more than half a metre away is faced.  Order of the axes: level forces,
   heave, roll and pitch to level, yaw; the wrench then goes to the allocation of rig.c.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "vehicle/inertia.h"
#include "vehicle/pilot.h"

/* rad/s: how quickly each kind of error is taken out.  */
#define LEVEL_FREQUENCY 6.0
#define HEADING_FREQUENCY 2.5
#define PLACE_FREQUENCY 1.0
#define INTEGRAL 0.15 /* of the frequency: how quickly the integral follows */
#define FASTEST 1.0   /* m/s to a place when nothing else is said */
#define TURN_RATE 1.0 /* rad/s toward a heading */
#define FACING 0.5    /* m: nearer than this a waypoint is not faced */
#define ARRIVED 0.05  /* m and m/s */

/* One axis of a cascade.  */
typedef struct loop
{
  double frequency, moving, most, fastest; /* rad/s, kg or kg m2, N or N m, m/s or rad/s */
  double linear, quadratic;                /* of the drag */
} loop;

static loop
loop_of (const bt__vehicle_type *type, const bt__rig *rig, int axis, double frequency,
         double moving, double fastest)
{
  const bt__hydro *hydro = &type->hydro;
  return (loop){ frequency,           moving,
                 rig->most[axis],     fastest,
                 hydro->linear[axis], hydro->quadratic[axis] };
}

static double
limited (double value, double most)
{
  return fmax (-most, fmin (most, value));
}

/* The force for ERROR at SPEED.  The integral stands still while the error asks for the fastest
   speed, and does not grow while the thrusters are at their limit.  */
static double
drive (loop l, double error, double speed, double h, int full, double *sum)
{
  double wish = limited (l.frequency / 2 * error, l.fastest);
  double drag = (l.linear + l.quadratic * fabs (wish)) * wish;
  double force = l.moving * 2 * l.frequency * (wish - speed) + drag + *sum;
  double step = INTEGRAL * l.frequency * l.frequency * l.frequency * l.moving * error * h;
  int outside = full || fabs (force) > l.most;
  if (fabs (wish) < l.fastest && !(outside && step * force > 0))
    *sum = limited (*sum + step, l.most);
  return limited (force, l.most);
}

static int
is_axis_held (const bt__pilot *p, int64_t kind)
{
  return (p->holds & kind) != 0;
}

/* ---- Attitude ---- */

/* The rest of the moments: pitch and roll level, in the papers' order.  */
static void
level (const bt__vehicle_type *type, const bt__rig *rig, bt__pilot *p, const bt__fix *fix, double h,
       double *wrench)
{
  bt_vec3 inertia = bt__inertias (type);
  loop roll = loop_of (type, rig, BT__ROLL, LEVEL_FREQUENCY, inertia.y, TURN_RATE);
  loop pitch = loop_of (type, rig, BT__PITCH, LEVEL_FREQUENCY, inertia.x, TURN_RATE);
  if (!is_axis_held (p, BT__HOLD_LEVEL))
    return;
  if (type->steers[BT__ROLL])
    wrench[BT__ROLL]
        = drive (roll, -bt__roll_of (fix->attitude), fix->spin.y, h, 0, &p->sum[BT__ROLL]);
  if (type->steers[BT__PITCH])
    wrench[BT__PITCH]
        = drive (pitch, -bt__pitch_of (fix->attitude), fix->spin.x, h, 0, &p->sum[BT__PITCH]);
}

/* Return true and the heading to keep, if any: towards the waypoint, or the held heading.  */
static int
heading_wish (const bt__pilot *p, const bt__fix *fix, double *heading)
{
  bt_vec3 way = bt__sub (p->place, fix->position);
  if (is_axis_held (p, BT__HOLD_WAYPOINT) && hypot (way.x, way.y) > FACING)
    {
      *heading = atan2 (way.x, way.y);
      return 1;
    }
  *heading = p->heading;
  return is_axis_held (p, BT__HOLD_HEADING);
}

static double
yaw_moment (const bt__vehicle_type *type, const bt__rig *rig, bt__pilot *p, const bt__fix *fix,
            double h)
{
  double inertia = bt__inertias (type).z, rate = -fix->spin.z, stick = p->sticks[3], heading;
  loop l = loop_of (type, rig, BT__YAW, HEADING_FREQUENCY, inertia, TURN_RATE);
  int damped = is_axis_held (p, BT__HOLD_LEVEL) && p->yaw_rate > 0;
  if (stick != 0 && is_axis_held (p, BT__HOLD_CAPTURES))
    p->heading = bt__twist_of (fix->attitude);
  if (stick != 0 && !damped)
    return stick * l.most;
  if (stick == 0 && heading_wish (p, fix, &heading))
    return drive (l, remainder (heading - bt__twist_of (fix->attitude), 2 * BT__PI), rate, h, 0,
                  &p->sum[BT__YAW]);
  if (!damped)
    return 0;
  double wish = stick * p->yaw_rate;
  double drag = wish * (type->hydro.linear[BT__YAW] + type->hydro.quadratic[BT__YAW] * fabs (wish));
  return limited (drag + inertia * 2 * l.frequency * (wish - rate), l.most);
}

/* ---- Position ---- */

static double
vertical_force (loop l, bt__pilot *p, const bt__fix *fix, double h)
{
  int placed = is_axis_held (p, BT__HOLD_POSITION | BT__HOLD_WAYPOINT);
  int above = is_axis_held (p, BT__HOLD_ALTITUDE) && isfinite (fix->altitude);
  double error = above    ? p->altitude - fix->altitude
                 : placed ? p->place.z - fix->position.z
                          : p->height - fix->position.z;
  if (p->sticks[2] != 0)
    {
      if (is_axis_held (p, BT__HOLD_CAPTURES))
        {
          p->height = p->place.z = fix->position.z;
          p->altitude = fix->altitude;
        }
      return 0;
    }
  if (!above && !placed && !is_axis_held (p, BT__HOLD_DEPTH))
    return 0;
  return drive (l, error, fix->velocity.z, h, p->full, &p->sum[BT__HEAVE]);
}

/* The force for the wished level speed WISH, with the integral.  */
static double
level_part (loop l, double wish, double size, double speed, double sum)
{
  double drag = (l.linear + l.quadratic * size) * wish;
  return l.moving * 2 * l.frequency * (wish - speed) + drag + sum;
}

/* Level forces toward the place: the same cascade, with way and force limited as vectors.  */
static bt_vec3
level_force (loop l, bt__pilot *p, const bt__fix *fix, double h)
{
  bt_vec3 way = bt__sub (p->place, fix->position), v = fix->velocity;
  double speed = l.frequency / 2 * hypot (way.x, way.y), share = fmin (1, l.fastest / speed);
  if (!is_axis_held (p, BT__HOLD_POSITION | BT__HOLD_WAYPOINT))
    return bt__vec (0, 0, 0);
  if (p->sticks[0] != 0 || p->sticks[1] != 0)
    {
      if (is_axis_held (p, BT__HOLD_CAPTURES))
        p->place = bt__vec (fix->position.x, fix->position.y, p->place.z);
      return bt__vec (0, 0, 0);
    }
  double *sum[2] = { &p->sum[BT__SWAY], &p->sum[BT__SURGE] };
  double k = share * l.frequency / 2, size = fmin (speed, l.fastest);
  double x = level_part (l, k * way.x, size, v.x, *sum[0]);
  double y = level_part (l, k * way.y, size, v.y, *sum[1]), force = hypot (x, y);
  double grow = INTEGRAL * l.frequency * l.frequency * l.frequency * l.moving * h;
  if (share >= 1 && !p->full && force <= l.most)
    {
      *sum[0] = limited (*sum[0] + grow * way.x, l.most);
      *sum[1] = limited (*sum[1] + grow * way.y, l.most);
    }
  double cut = force > l.most ? l.most / force : 1;
  return bt__vec (cut * x, cut * y, 0);
}

void
bt__pilot_steer (const bt__vehicle_type *type, const bt__rig *rig, bt__pilot *p, const bt__fix *fix,
                 double h, double *wish)
{
  bt_vec3 mass = bt__masses (type);
  double wrench[BT__AXES] = { 0 }, fastest = p->speed > 0 ? p->speed : FASTEST;
  loop level_loop = loop_of (type, rig, BT__SURGE, PLACE_FREQUENCY, fmax (mass.x, mass.y), fastest);
  loop height_loop = loop_of (type, rig, BT__HEAVE, PLACE_FREQUENCY, mass.z, fastest);
  bt_vec3 force = level_force (level_loop, p, fix, h);
  force.z = vertical_force (height_loop, p, fix, h);
  force = bt__turn_in (fix->attitude, force);
  wrench[BT__SURGE] = force.y + p->sticks[0] * rig->most[BT__SURGE];
  wrench[BT__SWAY] = force.x + p->sticks[1] * rig->most[BT__SWAY];
  wrench[BT__HEAVE] = force.z + p->sticks[2] * rig->most[BT__HEAVE];
  level (type, rig, p, fix, h, wrench);
  wrench[BT__YAW] = yaw_moment (type, rig, p, fix, h);
  p->full = bt__rig_share (type, rig, wrench, wish);
}

int
bt__pilot_arrived (const bt__pilot *p, const bt__fix *fix)
{
  return bt__distance (p->place, fix->position) < ARRIVED && bt__norm (fix->velocity) < ARRIVED;
}
