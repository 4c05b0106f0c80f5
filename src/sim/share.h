/* A step's tethers, shared out to the contexts of a dive.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_SHARE_H
#define BT_SIM_SHARE_H

#include "sim/sim.h"
#include "world/contexts.h"

/* Begin a try at a step of DIVE, which has contexts.  True if it has been refused: the try is to be
   made again, which is then not shared out.  */
void bt__share_begin (bt_dive *dive);
int bt__share_refused (bt_dive *dive);

/* Step the tethers of STATE, the order of which is known.  Zero if that is not worth while and
   nothing has been done; otherwise it is done or refused.  */
int bt__share_tethers (bt_dive *dive, bt__state *state);

/* bt__set_apart sorts the tethers of STATE into groups without influence on each other in the
   coming step: tethers of different groups are farther apart than their margins (apart.c).
   bt__were_apart returns true if the groups were right for the distances then asked for.  */
void bt__set_apart (const bt_dive *dive, bt__state *state, bt__contexts *contexts);
int bt__were_apart (const bt_dive *dive, bt__contexts *contexts);

#endif
