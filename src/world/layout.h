/* The layout of a state: sizes, copies, hashes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_LAYOUT_H
#define BT_WORLD_LAYOUT_H

#include "world/dive.h"

/* Where everything lies in a state of MODEL.  */
bt__layout bt__layout_of (const bt_model *model);

/* What its tether I takes of its store as a moving line.  */
bt__line_size bt__line_size_of (const bt_model *model, int i);

/* Bytes of a state of MODEL, and of the store of its tether I.  */
size_t bt__state_size (const bt_model *model);
size_t bt__store_size (const bt_model *model, int i);

/* Bytes of the nodes and tensions of a static shape of TETHER, at the beginning of its store.  */
size_t bt__arrays_size (const bt_tether_def *tether);

/* How many places a chain of TETHER may touch.  */
int bt__contact_room (const bt_model *model, const bt_tether_def *tether);

/* Make dive->next what dive->now is.  */
void bt__level (bt_dive *dive);

/* Copy the live part of the store of tether I from FROM to TO, whose store is as large.  */
void bt__copy_store (const bt_dive *dive, bt__state *to, const bt__state *from, int i);

/* Copy what is live of the head of FROM to TO.  */
void bt__copy_head (bt__state *to, const bt__state *from);

/* Copy what is live of FROM to TO; hash it.  */
void bt__copy_state (const bt_dive *dive, bt__state *to, const bt__state *from);
uint64_t bt__hash_state (const bt_dive *dive, const bt__state *state);

/* Call WALK with USER for each range in use of STATE, from the first on: AT bytes from the
   beginning of the state lie SIZE bytes DATA.  Return the number of ranges.  */
typedef void bt__walk (void *user, size_t at, const void *data, size_t size);
size_t bt__walk_live (const bt_dive *dive, const bt__state *state, bt__walk *walk, void *user);

/* Return how many bytes that are; how many of them are of the head, a bt__state.  */
size_t bt__live_size (const bt_dive *dive, const bt__state *state);
size_t bt__live_head (const bt__state *state);

/* True if all that STATE says is live lies within it: to be asked before it is hashed, of bytes
   that came from elsewhere.  */
int bt__layout_fits (const bt_dive *dive, const bt__state *state);

#endif
