/* Autopilots: the forces asked of the thrusters, from sticks, held values and measurements.

   Every hold is a cascade: the error asks for a speed, limited, and the lack of speed for a force,
   scaled by the mass or inertia in motion, with critical damping at FREQUENCY rad/s.  An integral
   takes steady loads (current, tether, trim), stands still while a limit is reached or a stick
   overrides, and is bounded by the force of the thrusters.

   A stick off its centre overrides the hold of its axis for as long.  When the stick is let go the
   vehicle returns to the held value, or, with CAPTURES, holds its present value from then on.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_PILOT_H
#define BT_VEHICLE_PILOT_H

#include <stdint.h>

#include "base/record.h"
#include "vehicle/frame.h"
#include "vehicle/type.h"

typedef enum bt__hold_kind
{
  BT__HOLD_LEVEL = 1, /* stabilise: no pitch, no roll; the yaw stick sets a rate */
  BT__HOLD_HEADING = 2,
  BT__HOLD_DEPTH = 4,
  BT__HOLD_ALTITUDE = 8, /* above what is below it; instead of a depth */
  BT__HOLD_POSITION = 16,
  BT__HOLD_WAYPOINT = 32, /* the same at SPEED, facing the way */
  BT__HOLD_CAPTURES = 64
} bt__hold_kind;

enum
{
  BT__STICKS = 4 /* surge, sway, heave, yaw */
};

/* All of an autopilot: flat.  */
typedef struct bt__pilot
{
  double sticks[BT__STICKS]; /* -1 to 1 */
  int64_t holds;             /* sum of bt__hold_kind */
  double heading;            /* rad: any turn of it means the same */
  double height;             /* m: z to keep for DEPTH */
  double altitude;           /* m */
  bt_vec3 place;             /* m */
  double speed;              /* m/s: the fastest toward PLACE; 0: as it can */
  double yaw_rate;           /* rad/s of a full yaw stick; 0: the stick is a moment */
  double sum[BT__AXES];      /* integrals: N along x, y, z of the world, N m of roll, pitch, yaw */
  int64_t full;              /* true: the thrusters gave all they could in the last step */
} bt__pilot;

extern const bt__record bt__pilot_record;

/* What a pilot knows of the vehicle: from its state, or from its instruments.  */
typedef struct bt__fix
{
  bt_vec3 position, velocity; /* m, m/s over ground; world */
  bt__quat attitude;
  bt_vec3 spin;    /* rad/s, own axes */
  double altitude; /* m above what is below; NAN: not known */
} bt__fix;

/* Write to WISH the force asked of each thruster, N, and go on with the integrals of PILOT.  */
void bt__pilot_steer (const bt__vehicle_type *type, const bt__rig *rig, bt__pilot *pilot,
                      const bt__fix *fix, double h, double *wish);

/* True when PILOT is within 5 cm of its place at less than 5 cm/s.  */
int bt__pilot_arrived (const bt__pilot *pilot, const bt__fix *fix);

#endif
