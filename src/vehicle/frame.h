/* Attitude: unit quaternions, inline.

   A body's own axes are x to starboard, y ahead, z up; a quaternion turns them into the world's.
   Heading is clockwise from north (+y), pitch bow up, roll starboard down, in this order.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_FRAME_H
#define BT_VEHICLE_FRAME_H

#include "math/vec.h"

typedef struct bt__quat
{
  double w;
  bt_vec3 v;
} bt__quat;

static inline bt__quat
bt__quat_times (bt__quat a, bt__quat b)
{
  bt_vec3 v = bt__axpy (bt__axpy (bt__cross (a.v, b.v), a.w, b.v), b.w, a.v);
  return (bt__quat){ a.w * b.w - bt__dot (a.v, b.v), v };
}

static inline bt__quat
bt__quat_unit (bt__quat q)
{
  double k = 1 / sqrt (q.w * q.w + bt__dot (q.v, q.v));
  return (bt__quat){ k * q.w, bt__scale (k, q.v) };
}

/* V in the world's axes, V in the body's own.  */
static inline bt_vec3
bt__turn_out (bt__quat q, bt_vec3 v)
{
  bt_vec3 t = bt__scale (2, bt__cross (q.v, v));
  return bt__add (bt__axpy (v, q.w, t), bt__cross (q.v, t));
}

/* The same the other way.  */
static inline bt_vec3
bt__turn_in (bt__quat q, bt_vec3 v)
{
  q.v = bt__scale (-1, q.v);
  return bt__turn_out (q, v);
}

/* Q after a turn by Cayley's transform of ANGLE (rad, about the body's own axes), which keeps the
   momentum of the midpoint rule; no turn leaves every bit.  */
static inline bt__quat
bt__quat_turned (bt__quat q, bt_vec3 angle)
{
  if (angle.x == 0 && angle.y == 0 && angle.z == 0)
    return q;
  return bt__quat_unit (bt__quat_times (q, (bt__quat){ 1, bt__scale (0.5, angle) }));
}

static inline bt__quat
bt__quat_of (double heading, double pitch, double roll)
{
  bt__quat h = { cos (heading / 2), { 0, 0, -sin (heading / 2) } };
  bt__quat p = { cos (pitch / 2), { sin (pitch / 2), 0, 0 } };
  bt__quat r = { cos (roll / 2), { 0, sin (roll / 2), 0 } };
  return bt__quat_times (bt__quat_times (h, p), r);
}

static inline double
bt__pitch_of (bt__quat q)
{
  double rise = bt__turn_out (q, bt__vec (0, 1, 0)).z;
  return asin (fmax (-1, fmin (1, rise)));
}

static inline double
bt__roll_of (bt__quat q)
{
  return atan2 (-bt__turn_out (q, bt__vec (1, 0, 0)).z, bt__turn_out (q, bt__vec (0, 0, 1)).z);
}

/* The turn about the vertical that is left when the tilt is taken out by the shortest way,
   clockwise positive, rad.  The compass heading of anything level, pitched or rolled; defined but
   upside down.  */
static inline double
bt__twist_of (bt__quat q)
{
  return -2 * atan2 (q.v.z, q.w);
}

#endif
