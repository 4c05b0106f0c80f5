/* What surrounds the parts of a dive in a step: obstacles that stand, obstacles on their way.

   A mover goes along its track in the same time as vehicles and lines go theirs.  Each of those may
   hold it back; then all who went before know of it and the step is tried again with less
   (bt__around_agree).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_AROUND_H
#define BT_SIM_AROUND_H

#include "contact/touch.h"
#include "sim/sim.h"

/* So many tries at a step; in the last all vehicles and movers stand still, and winches stall that
   would draw at a vehicle which something else holds, with which everybody agrees.  */
enum
{
  BT__TRIES = 3
};

/* True if the world of DIVE has obstacles: nothing below is called else.  */
static inline int
bt__has_obstacles (const bt_dive *dive)
{
  return dive->model->n_obstacles > 0;
}

/* Aim the movers of STATE along their tracks for the step to come, ROUND tries at it having failed;
   or let them stand, for an operation takes no time.  */
void bt__aim_movers (bt_dive *dive, bt__state *state, int round);
void bt__rest_movers (bt_dive *dive, bt__state *state);

/* To be called when a subject has gone its way by what bt__surround gave (world/obstacles.h).  */
void bt__around_done (bt_dive *dive);

/* True if nobody had to hold a mover back after another had gone by its whole motion.  */
int bt__around_agrees (const bt_dive *dive);

/* ---- Vehicles that tethers and obstacles hold ----

   What moves a vehicle, its tethers and its hull must agree on where it comes to.  Where they do
   not, the step is tried again with the vehicle taken to where all of them may let it, and in the
   end left where it was.  */

/* Start a step, ROUND tries at it having failed: vehicles come as far as their hulls do.  In a world
   without obstacles the first try is begun by bt__unpin_vehicles.  */
void bt__pin_vehicles (bt_dive *dive, bt__state *state, int round);

/* Start an operation that has put vehicles where they may be.  */
void bt__unpin_vehicles (bt_dive *dive, bt__state *state);

/* True if VEHICLE is taken to a place whatever moves it.  */
int bt__pinned (const bt_dive *dive, int vehicle);

/* End K (0 the anchor) of tether I came to P and no farther: its vehicle stands there.  */
void bt__bring_end (const bt_dive *dive, bt__state *state, int i, int k, bt_vec3 p);

/* True if every end is where its vehicle is and every hull where it may be; else remember where
   to take the vehicles in the next try.  */
int bt__vehicles_agree (bt_dive *dive, bt__state *state);

/* Return how far VEHICLE, on its way to WANTED, comes with its hull; it turns no farther than that
   may, either.  */
bt_vec3 bt__hull_reach (bt_dive *dive, bt__state *state, int vehicle, bt_vec3 wanted);

/* ---- Afterwards ---- */

/* True if a mover is on its way.  */
int bt__movers_move (const bt_dive *dive);

/* Forget what vehicles and tethers met a while ago, with the event `left'.  */
void bt__note_all_partings (const bt_dive *dive, bt__state *state);

/* Twice a second look at what each tether of the present is wound about, with the events `wrapped'
   and `freed' (wound.c).  */
bt_status bt__note_windings (bt_dive *dive, bt_error *error);

/* Count for how long each tether has been stuck, with the event `stuck' (stuck.c).  */
void bt__note_stuck (const bt_dive *dive, bt__state *state);

/* Bring the movers of STATE to where they came; event `pinched'.  */
void bt__settle_movers (bt_dive *dive, bt__state *state);

#endif
