/* Worker contexts: partial dives, a workspace each, among which sim/share.c shares out a step.

   The contexts are made when a dive is given more than one thread.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_LANES_H
#define BT_WORLD_LANES_H

#include "base/workers.h"
#include "collide/pair.h"
#include "world/dive.h"

enum
{
  BT__LANE_LEAF = 4 /* intervals of a chain in a box */
};

/* What a tether raised in a step: events FROM to TO, less one, of a context.  */
typedef struct bt__raised
{
  int64_t from, to;
  int context;
} bt__raised;

typedef struct bt__contexts
{
  int n;
  bt__context *context;
  bt__workers *workers;
  /* Groups of tethers, in the order in which they step: of each group the first, of each tether the
     next one, or -1.  */
  int groups;
  int *group, *first, *after, *last;
  char *shared;           /* of each vehicle, as in bt__context */
  double *margin, *asked; /* of each tether, m: what it may ask for, and what it did */
  bt__raised *raised;     /* of each tether */
  bt__aabb *whole, *box;  /* of each tether; of its leaves, from BOX_AT on */
  int *box_at, *boxes;
  bt__pin *pin;     /* of each vehicle, as a try at the step began */
  int refused;      /* what was begun cannot be done apart */
  bt__asker *asker; /* of the dive whose step it is */
  atomic_int left;  /* true: it said that the step is to be left */
  int alone;        /* steps to come that are not shared out */
  int patience;     /* how many they will be next time */
} bt__contexts;

/* Borrow the shared members of DIVE for LANE, whose thread does a part of NEXT; give them back; add
   the counters of LANE to the counters of DIVE.  */
void bt__context_enter (bt__context *context, const bt_dive *dive, bt__state *next);
void bt__context_leave (bt__context *context);
void bt__context_count (const bt__context *context, bt_dive *dive);

void bt__contexts_free (bt__contexts *contexts); /* NULL is nothing */

#endif
