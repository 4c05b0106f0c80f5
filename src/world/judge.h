/* A state from outside, judged before it is used: composed of what the rooms below say of theirs.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_JUDGE_H
#define BT_WORLD_JUDGE_H

#include "base/record.h"
#include "world/dive.h"

/* Judge STATE, whose layout fits DIVE (bt__layout_fits): every live byte by the table of its
   struct, then the relations between members.  BT_ERR_FORMAT names the part, the member, its value
   and the allowed values.  A state that passes can be stepped and asked.  Perhaps no dive ever
   comes to such a state, but every count, index, length and word is valid.  */
bt_status bt__state_judge (bt_dive *dive, bt__state *state, bt_error *error);

/* Return all tables of structs that a state holds, *N of them.  */
const bt__record *const *bt__state_records (size_t *n);

/* judge_parts.c: of its sea, a vehicle, a tether, and what those know of obstacles.  */
bt_status bt__judge_sea (bt__judge *judge, const bt_dive *dive, const bt__state *state);
bt_status bt__judge_vehicle (bt__judge *judge, const bt_dive *dive, bt__state *state, int i);
bt_status bt__judge_tether (bt__judge *judge, const bt_dive *dive, bt__state *state, int i);
bt_status bt__judge_subject (bt__judge *judge, const bt_dive *dive, bt__state *state, bt_part part,
                             int i);
bt_status bt__judge_obstacles (bt__judge *judge, const bt_dive *dive, bt__state *state);

#endif
