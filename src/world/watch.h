/* The awareness cache of a dive: taut strings, free ways and words of its tethers, made on demand.

   The cache belongs to a dive and is no part of the state.  The dive's count of changes, remembered
   for each tether, tells the state of the answers; the answers depend on the state alone.  A chart
   depends on the world and the switches, answers whoever asks alike, and is shared by forks.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_WATCH_H
#define BT_WORLD_WATCH_H

#include <bight/aware.h>

#include "aware/caught.h"
#include "aware/free.h"
#include "aware/haul.h"
#include "aware/shadow.h"
#include "aware/voxel.h"
#include "world/line.h"

/* The one rule for a taut tether among obstacles: the slack left by a string of LENGTH m is less
   than the share BT_TAUT_SLACK of the paid-out length OUT, m.  */
static inline int
bt__is_taut (double length, double out)
{
  return length >= (1 - BT_TAUT_SLACK) * out;
}

/* The world as charted for a tether.  A tree of free ways belongs to an anchor and a reach, a graph
   with words to a gap.  */
typedef struct bt__chart
{
  atomic_int references;
  uint64_t version; /* of the switches */
  double reach;     /* m */
  bt_vec3 anchor;
  double gap; /* m */
  uint8_t *off;
  bt__switches on;
  bt__free *tree;   /* NULL: nothing is within reach */
  atomic_int asked; /* true if the tree was */
  bt__graph graph;
  bt__shadow *shadow;
  bt__voxels *voxels;
} bt__chart;

/* One tether as last looked at.  */
typedef struct bt__awareness
{
  uint64_t change; /* the dive's count then, plus 1; 0: never */
  int open;        /* nothing stands in its water: the string is the chord */
  int has_taut, has_free, has_class, has_wound;
  uint32_t n, node_room;
  uint32_t followed; /* calls since the live string was last seeded */
  bt_vec3 *node;     /* the tether's own */
  double out;        /* m */
  bt__taut_config config;
  bt__string *taut, *shortest, *live;
  bt__corner *hold;
  bt__holds holds;
  double taut_length, free_length;
  bt__word word;                   /* the tether's, then the free way back */
  int32_t *wound;                  /* windings about each obstacle; NULL: never asked for */
  int is_wound;                    /* true if one of them is not 0 */
  bt__chart *ways, *words, *frame; /* frame: the graph */
  bt__caught loops;                /* about its edges */
  uint8_t *favoured;               /* which of them hold the string */
} bt__awareness;

struct bt__watch
{
  uint32_t room; /* nodes of every string */
  bt__taut *taut;
  bt__count count;
  int n;
  int ready; /* true: bt__watch_prepare was called */
  bt__awareness tether[];
};

/* Return tether I of DIVE as it is now: its nodes, and what it is among.  */
bt_status bt__watch_look (const bt_dive *dive, int i, bt__awareness **out, bt_error *error);

/* The same, with its string solved.  */
bt_status bt__watch_taut (const bt_dive *dive, int i, bt__awareness **out, bt_error *error);

/* bt__watch_lay_way puts into WAY the shortest way known from the anchor of tether I, of which G is
   known, to P: the chord where the chord is clear, else the tree's way; *FOUND tells success.
   bt__watch_tighten_way tightens WAY within its homotopy class; *LENGTH receives the length, m.  */
bt_status bt__watch_lay_way (const bt_dive *dive, int i, bt__awareness *g, bt_vec3 p,
                             bt__string *way, int *found, bt_error *error);
bt_status bt__watch_tighten_way (const bt_dive *dive, const bt__awareness *g, bt__string *way,
                                 double *length, bt_error *error);

/* As bt__watch_taut, with the free way; and with the word.  */
bt_status bt__watch_free (const bt_dive *dive, int i, bt__awareness **out, bt_error *error);
bt_status bt__watch_class (const bt_dive *dive, int i, bt__awareness **out, bt_error *error);

/* Fail for want of memory.  */
bt_status bt__watch_no_memory (bt_error *error);

/* The greatest paid-out length, m, of tether I before its winch gets another order.  */
double bt__watch_longest (const bt_dive *dive, int i);

/* watch_wound.c: have memory for windings about what G's tether is among.  */
bt_status bt__watch_wind_ready (const bt_dive *dive, int i, bt__awareness *g, bt_error *error);

/* As bt__watch_look, with the windings; the string and the way only where they are needed.
   bt__watch_wound first asks whether the windings are still those told last, bt__watch_wind does
   not.  */
bt_status bt__watch_wind (const bt_dive *dive, int i, bt__awareness **out, bt_error *error);
bt_status bt__watch_wound (const bt_dive *dive, int i, bt__awareness **out, bt_error *error);

/* A winding as a state keeps it, in a byte.  */
static inline int8_t
bt__told (int32_t winding)
{
  return (int8_t)(winding > 127 ? 127 : winding < -127 ? -127 : winding);
}

/* Set *SAME if the windings are known to be still those told last, by the events of the state,
   without solving the taut string.  */
bt_status bt__watch_wound_still (const bt_dive *dive, int i, int *same, bt_error *error);

/* Put into BERTH the root of the charts of tether I, for the state to keep.  */
bt_status bt__watch_berth (const bt_dive *dive, int i, bt_vec3 *berth, bt_error *error);

/* Allocate the memory for looks at the windings of every tether, so that steps need not allocate.
   Two exceptions remain: a hauling winch or a moving anchor may bring a tether to another chart,
   and the homotopy class about a mesh has memory of its own.  Without enough memory the looks tell
   nothing; the only failure is BT_ERR_INTERRUPTED.  A fork, often short-lived, allocates at its
   first operation.  */
bt_status bt__watch_prepare (const bt_dive *dive, bt_error *error);
/* The same unless done before: for what changes nothing that the tethers are among.  */
bt_status bt__watch_make_ready (const bt_dive *dive, bt_error *error);

/* A new string with the room of those of the watch; NULL: no memory.  */
bt__string *bt__watch_string (const bt_dive *dive);

void bt__watch_free_all (struct bt__watch *watch); /* NULL is nothing */

/* Let FORK share the charts of DIVE.  Without memory it makes its own.  */
void bt__watch_share (const bt_dive *dive, bt_dive *fork);

/* watch_chart.c: have G's chart of ways, without its tree; with its tree; its graph; its chart of
   words.  */
bt_status bt__chart_ways (const bt_dive *dive, int i, bt__awareness *g, bt_error *error);
bt_status bt__chart_plant (const bt_dive *dive, int i, bt__awareness *g, bt_error *error);
bt_status bt__chart_frame (const bt_dive *dive, int i, bt__awareness *g, bt_error *error);
bt_status bt__chart_words (const bt_dive *dive, int i, bt__awareness *g, bt_error *error);
void bt__chart_release (bt__chart *chart); /* NULL is nothing */

#endif
