/* The moving line in a dive, as its files share it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_CHAIN_H
#define BT_SIM_CHAIN_H

#include "base/error.h"
#include "sim/sim.h"
#include "world/line.h"

/* The vehicle with mass at the far end of tether I, which this line carries, or NULL.  */
bt__vehicle *bt__carried (const bt_dive *dive, bt__state *state, int i);

/* What the kernel is told of tether I: ends, water, the vehicle it carries; no winch, no lumps.  */
bt__dynamic_input bt__chain_input (const bt_dive *dive, bt__state *state, int i,
                                   const bt_water *water, const bt__ends *ends);

/* Give INPUT what is fastened to tether I between FROM and TO metres from its far end, a distance
   that the winch does not change.  LUMPS has room for BT_LUMPS_MAX.  */
void bt__fasten (const bt_dive *dive, int i, double from, double to, bt__dynamic_input *input,
                 bt__dynamic_lump *lumps);

/* Give the vehicle that the last node of tether I carries its place and velocity.  */
void bt__bring_vehicle (const bt_dive *dive, bt__state *state, int i);

/* Note what REPORT says of a step of TETHER, and what its twist does, as events.  */
void bt__watch_step (bt__state *state, bt__tether *tether, int i, const bt__dynamic_report *report);
void bt__watch_twist (const bt_dive *dive, bt__state *state, bt__tether *tether, int i);

#endif
