/* Predicted vehicle: a copy of a vehicle moved ahead of the dive, for forecasts and pictures.

   A kinematic vehicle moves on by sticks, to a goal, or at constant velocity; a vehicle with mass
   by thrusters, autopilot and the present water.  The prediction knows neither tethers nor
   obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_PREDICTED_H
#define BT_WORLD_PREDICTED_H

#include "world/dive.h"

typedef struct bt__predicted
{
  const bt_dive *dive;
  int vehicle;
  bt__vehicle v;
  double yaw; /* radians/s, of one without mass */
} bt__predicted;

/* The predicted of VEHICLE as it is now.  */
bt__predicted bt__predicted_of (const bt_dive *dive, int vehicle);

/* Let it go on by SECONDS.  */
void bt__predicted_go_on (bt__predicted *predicted, double seconds);

/* Put it to P, where something with the outward unit NORMAL stops it: it slides on.  */
void bt__predicted_stop (bt__predicted *predicted, bt_vec3 p, bt_vec3 normal);

#endif
