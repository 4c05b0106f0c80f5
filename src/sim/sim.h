/* The parts of a step, in the order it takes them.  Each works on a state that is not yet the present.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_SIM_H
#define BT_SIM_SIM_H

#include "world/dive.h"

/* Move the vehicles of STATE by one step as sticks, autopilots and tracks say (kinematics.c).  */
void bt__move_vehicles (const bt_dive *dive, bt__state *state);

/* Turn the winches of STATE by one step (winch.c).  */
void bt__turn_winches (const bt_dive *dive, bt__state *state);

/* Hold the vehicles of STATE, which moved from where they are in FROM, at the ends of their tethers
   (reach.c).  */
void bt__hold_at_tethers (const bt_dive *dive, const bt__state *from, bt__state *state);

/* Return how far along the straight way from A to B, 0 to 1, vehicle I of STATE gets before a tether
   stops it (reach.c).  */
double bt__reach_along (const bt_dive *dive, bt__state *state, int i, bt_vec3 a, bt_vec3 b);

/* Solve the tethers of STATE whose ends, length, properties or current changed (resolve.c).  */
bt_status bt__resolve_tethers (bt_dive *dive, bt__state *state, bt_error *error);

/* The ends of tether I of STATE.  */
typedef struct bt__ends
{
  bt_vec3 a, b;
} bt__ends;
bt__ends bt__tether_ends (const bt_dive *dive, bt__state *state, int i);

/* Return the strongest pull of the vehicles at the ends of tether I, N; 0 when both are points.  */
double bt__pull_on (const bt_dive *dive, bt__state *state, int i);

#endif
