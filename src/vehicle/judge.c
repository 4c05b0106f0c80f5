/* The values allowed in the flat records of a vehicle from outside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "vehicle/body.h"
#include "vehicle/instruments.h"
#include "vehicle/pilot.h"

static const bt__member quat[] = {
  BT__WITHIN (bt__quat, w, -2, 2),
  BT__WITHIN (bt__quat, v, -2, 2),
};
const bt__record bt__quat_record = BT__RECORD (bt__quat, "attitude", quat);

static const bt__member rigid[] = {
  BT__WITHIN (bt__rigid, position, -BT__FAR, BT__FAR),
  BT__OF (bt__rigid, attitude, bt__quat_record),
  BT__WITHIN (bt__rigid, velocity, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__rigid, spin, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__rigid, heading, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__rigid, thrust, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__rigid, pull, -BT__HUGE, BT__HUGE),
};
const bt__record bt__rigid_record = BT__RECORD (bt__rigid, "body", rigid);

static const bt__member pilot[] = {
  BT__WITHIN (bt__pilot, sticks, -1, 1),
  BT__WITHIN (bt__pilot, holds, 0, 2 * BT__HOLD_CAPTURES - 1),
  BT__WITHIN (bt__pilot, heading, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__pilot, height, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__pilot, altitude, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__pilot, place, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__pilot, speed, 0, BT__FAR),
  BT__WITHIN (bt__pilot, yaw_rate, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__pilot, sum, -BT__HUGE, BT__HUGE),
  BT__TRUTH (bt__pilot, full),
};
const bt__record bt__pilot_record = BT__RECORD (bt__pilot, "autopilot", pilot);

static const bt__member instruments[] = {
  BT__WITHIN (bt__instruments, seed, -BT__MANY, BT__MANY),
  BT__WITHIN (bt__instruments, faults, 0, 2 * BT_FAULT_THRUSTER - 1),
  BT__WITHIN (bt__instruments, drift, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__instruments, since, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__instruments, frozen, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__instruments, compass_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, depth_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, speed_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, altitude_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, range_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, bearing_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, tension_noise, 0, BT__FAR),
  BT__WITHIN (bt__instruments, counter_noise, 0, BT__FAR),
};
const bt__record bt__instruments_record = BT__RECORD (bt__instruments, "instruments", instruments);
