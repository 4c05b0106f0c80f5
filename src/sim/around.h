/* The surroundings of vehicles and lines in a step: standing obstacles and kinematic obstacles.

   A kinematic obstacle moves along its track at the same time as vehicles and lines.  A vehicle or
   line may hold the obstacle back.  The parts stepped before then went by too large a motion, and
   the step is tried again with a smaller one (bt__around_agrees).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_AROUND_H
#define BT_SIM_AROUND_H

#include "contact/touch.h"
#include "sim/sim.h"

/* Number of further tries at a step.  In the last try all vehicles and kinematic obstacles stand
   still, and a winch stalls that hauls at a held vehicle: all parts agree with such a step.  */
enum
{
  BT__TRIES = 3
};

/* True if the world of DIVE has obstacles.  */
static inline int
bt__has_obstacles (const bt_dive *dive)
{
  return dive->model->n_obstacles > 0;
}

/* Aim the kinematic obstacles of STATE along their tracks for the coming step, after ROUND failed
   tries; or let the obstacles stand during an operation, which takes no time.  */
void bt__aim_movers (bt_dive *dive, bt__state *state, int round);
void bt__rest_movers (bt_dive *dive, bt__state *state);

/* Call this after moving a subject within the surroundings of bt__surround (world/obstacles.h).  */
void bt__around_done (bt_dive *dive);

/* True unless a kinematic obstacle was held back after another subject had gone by the obstacle's
   larger motion.  */
int bt__around_agrees (const bt_dive *dive);

/* ---- Vehicles that tethers and obstacles hold ----

   The vehicle's own motion, its tethers and its hull must agree on the vehicle's new place.  In
   case of disagreement the step is tried again with the vehicle pinned to a place that suits all,
   and in the last try at its old place.  */

/* Start a step, ROUND tries at it having failed: vehicles come as far as their hulls do.  In a
   world without obstacles the first try is begun by bt__unpin_vehicles.  */
void bt__pin_vehicles (bt_dive *dive, bt__state *state, int round);

/* Start an operation that has put vehicles where they may be.  */
void bt__unpin_vehicles (bt_dive *dive, bt__state *state);

/* True if VEHICLE is taken to a place whatever moves it.  */
int bt__pinned (const bt_dive *dive, int vehicle);

/* End K (0 the anchor) of tether I came to P and no farther: its vehicle stands there.  */
void bt__bring_end (const bt_dive *dive, bt__state *state, int i, int k, bt_vec3 p);

/* True if both ends of tether I are at their vehicles.  */
int bt__holds_ends (const bt_dive *dive, bt__state *state, int i);

/* True if every end is at its vehicle and every hull at an allowed place; else remember the
   vehicles' targets for the next try.  */
int bt__vehicles_agree (bt_dive *dive, bt__state *state);

/* Return how far VEHICLE, on its way to WANTED, comes with its hull; it turns no farther than that
   may, either.  */
bt_vec3 bt__hull_reach (bt_dive *dive, bt__state *state, int vehicle, bt_vec3 wanted);

/* ---- Hulls that moving lines meet (hulls.c) ---- */

/* Start a step, ROUND tries at it having failed.  */
void bt__aim_hulls (bt_dive *dive, int round);

/* Decide which lines may meet which hulls, from the boxes about the lines.  With PASSES false no
   time passes and no line meets a hull.  */
void bt__near_hulls (bt_dive *dive, bt__state *state, int passes);

/* True if tether I may meet the hull of VEHICLE in this step; any hull.  */
int bt__is_by_hull (const bt_dive *dive, int i, int vehicle);
int bt__is_by_a_hull (const bt_dive *dive, int i);

/* Add to AROUND, of bt__surround for tether I, the hulls that I may meet, behind the movers; call
   bt__hulls_done after the step of I.  */
void bt__surround_by_hulls (bt_dive *dive, bt__state *state, int i, bt__surroundings *around);
void bt__hulls_done (bt_dive *dive, int i);

/* True if every hull that tether I may meet stands in this step.  */
int bt__hulls_rest (bt_dive *dive, bt__state *state, int i);

/* True if a line could not yield to the hull of VEHICLE in a try at this step.  */
int bt__is_held_by_line (const bt_dive *dive, int vehicle);

/* Add to IN the contact forces of lines on the hull of VEHICLE in the last step.  */
void bt__add_line_loads (const bt_dive *dive, bt__state *state, int vehicle, bt__rigid_input *in);

/* True if all lines were shown the motion that each hull made; else remember for the next try where
   the vehicles came.  */
int bt__hulls_agree (bt_dive *dive, bt__state *state);

/* ---- Afterwards ---- */

/* True if a mover is on its way.  */
int bt__movers_move (const bt_dive *dive);

/* Forget what vehicles and tethers met a while ago, with the event `left'.  */
void bt__note_all_partings (const bt_dive *dive, bt__state *state);

/* Twice a second look at what each tether of the present is wound about, with the events `wrapped'
   and `freed' (wound.c).  */
bt_status bt__note_windings (bt_dive *dive, bt_error *error);

/* Count the steps for which tether I, with ends at ENDS, has been stuck, with the event `stuck';
   bt__note_all_stuck does so for all tethers (stuck.c).  */
void bt__note_stuck (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends);
void bt__note_all_stuck (const bt_dive *dive, bt__state *state);

/* Bring the movers of STATE to where they came; event `pinched'.  */
void bt__settle_movers (bt_dive *dive, bt__state *state);

#endif
