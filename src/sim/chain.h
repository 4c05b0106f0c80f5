/* The moving line in a dive, as its files share it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_CHAIN_H
#define BT_SIM_CHAIN_H

#include "base/error.h"
#include "collide/bvh.h"
#include "sim/sim.h"
#include "world/line.h"

/* The vehicle with mass at the far end of tether I, which this line carries, or -1.  */
int bt__carried_vehicle (const bt_dive *dive, bt__state *state, int i);

/* What the kernel is told of tether I: ends, water, the vehicle it carries; no winch, no lumps.  */
bt__dynamic_input bt__chain_input (const bt_dive *dive, bt__state *state, int i,
                                   const bt_water *water, const bt__ends *ends);

/* Give INPUT what is fastened to tether I between FROM and TO metres from its far end, a distance
   that the winch does not change.  LUMPS has room for BT_LUMPS_MAX.  */
void bt__fasten (const bt_dive *dive, int i, double from, double to, bt__dynamic_input *input,
                 bt__dynamic_lump *lumps);

/* Let the vehicle that tether I carries follow its last node.  */
bt_status bt__bring_vehicle (const bt_dive *dive, bt__state *state, int i, bt_error *error);

/* What the number of intervals of tether I keeps to in a step (remesh.c).  */
bt__dynamic_mesh bt__chain_mesh (const bt_dive *dive, const bt__state *state,
                                 const bt__tether *tether, int i);

/* Lay what stands out of the water of a line of LENGTH with the N + 1 nodes X on it; return true if
   anything did.  The same of the still shape of tether I, which then is AFLOAT (afloat.c).  */
int bt__lay_afloat (bt_vec3 *x, int n, double length, const bt_water *water);
void bt__lay_shape_afloat (bt_dive *dive, bt__state *state, int i);

/* How many intervals a chain of TETHER begins with.  Put N + 1 points of its shape, or of its
   equilibrium when it has none, on the dive's polyline and the tensions along it.  Begin a chain of
   N intervals from there, at rest; with SHARE each has that share of the length, and no tension
   (chain.c).  */
int bt__rest_nodes (const bt_dive *dive, const bt__tether *tether, int i);
bt_status bt__trace_rest (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int n,
                          bt_error *error);
bt_status bt__begin_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int n,
                           const double *share, bt_error *error);

/* As bt__dynamic_step for a PART of tether I, which touches itself and, in a world with obstacles,
   those and other lines (chain_touch.c).  */
bt_status bt__step_among (bt_dive *dive, bt__state *state, int i, int part,
                          const bt__dynamic_input *input, bt__dynamic_report *report,
                          bt_error *error);

/* Put the tethers of a world with obstacles in the order in which they press on each other.  Of the
   order that there is put those first that carry vehicles, and static tethers last (order.c).  */
void bt__order_tethers (bt_dive *dive, bt__state *state);
void bt__put_carriers_first (bt_dive *dive, bt__state *state);

/* Draw the boxes about all moving lines as tethers begin to be resolved; draw those of tether I
   anew if it is no longer in them, and return nonzero (chain_box.c).  */
void bt__box_lines (bt_dive *dive, bt__state *state);
int bt__box_line (bt_dive *dive, bt__state *state, int i);

/* Wake the tethers that PART of tether I, which moves, touches.  */
void bt__wake_touched (const bt_dive *dive, bt__state *state, int i, int part);

/* Add what a PART of tether I did at its contacts in the last step to the wear of its jacket
   (chain_wear.c).  */
void bt__wear_chain (bt_dive *dive, bt__state *state, int i, int part);

/* Note what REPORT says of a step of TETHER, and what its twist does, as events.  */
void bt__watch_step (const bt_dive *dive, bt__state *state, bt__tether *tether, int i,
                     const bt__dynamic_report *report);
void bt__watch_twist (const bt_dive *dive, bt__state *state, bt__tether *tether, int i);

#endif
