/* Predicted vehicle: a copy of a vehicle moved ahead of the dive, for forecasts and pictures.

   A kinematic vehicle goes on by its sticks, to its goal, or at its velocity; a vehicle with mass
   by its thrusters, its autopilot and the present water.  The prediction knows neither tethers nor
   obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_GHOST_H
#define BT_WORLD_GHOST_H

#include "world/dive.h"

typedef struct bt__ghost
{
  const bt_dive *dive;
  int vehicle;
  bt__vehicle v;
  double yaw; /* radians/s, of one without mass */
} bt__ghost;

/* The ghost of VEHICLE as it is now.  */
bt__ghost bt__ghost_of (const bt_dive *dive, int vehicle);

/* Let it go on by SECONDS.  */
void bt__ghost_go_on (bt__ghost *ghost, double seconds);

/* Put it to P, where something with the outward unit NORMAL stops it: it slides on.  */
void bt__ghost_stop (bt__ghost *ghost, bt_vec3 p, bt_vec3 normal);

#endif
