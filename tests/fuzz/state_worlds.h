/* Dives whose states are spoilt: every model, alone and among obstacles, and what else a state
   holds.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_FUZZ_STATE_WORLDS_H
#define BT_FUZZ_STATE_WORLDS_H

#include <bight/bight.h>

/* How many there are, what the I-th is, and that dive, flown until there is something in it; a dive
   of the caller's.  */
int state_worlds (void);
const char *state_world_name (int i);
bt_dive *state_world (int i);

#endif
