/* Laying a tether among obstacles: along corners between which the straight way is clear.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_LAY_H
#define BT_SIM_LAY_H

#include "sim/sim.h"

/* Put the corners of tether I on the dive's polyline: of the shape it has, a corner left out where
   what it spans with its neighbours is clear, or of the world's line of lay to ENDS.  Return in *N
   how many.  BT_ERR_DEF if it has none yet and a straight line to its vehicle meets an obstacle. */
bt_status bt__corners (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int *n,
                       bt_error *error);

/* Nonzero if nothing is between the moving line of tether I and the N + 1 points on the dive's
   polyline, equally spaced along it.  */
int bt__may_remesh (bt_dive *dive, bt__state *state, int i, int n);

/* Lay the moving line of tether I along its corners and let it fall into place, the clock
   standing.  */
bt_status bt__lay_chain_among (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                               bt_error *error);

/* Take the ends of the moving line of tether I to ENDS through the water, as far as they come, the
   clock standing.  */
bt_status bt__drag_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                          bt_error *error);

#endif
