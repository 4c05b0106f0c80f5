/* Which counters of a dive's profile belong to which part of its scene: those of a part that a
   scene lacks are zero, or its absence has cost something.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_PARTS_H
#define BT_TESTBED_PARTS_H

#include <bight/dive.h>

typedef enum part
{
  PART_MOVING_LINE = 1, /* stepped and solved */
  PART_STATIC_LINE = 2, /* of models without motion: searched, shot, marched, relaxed */
  PART_THESIS = 4,      /* the response of the thesis */
  PART_OBSTACLES = 8,
  PART_BODY = 16, /* vehicles with mass */
  PART_WAVES = 32,
  PART_LEE = 64,
  PART_QUESTIONS = 128, /* strings, charts and words of what a tether is doing */
  PART_ALL = 255
} part;

/* Return the work P counts for PARTS, an or of them.  */
uint64_t part_work (const bt_profile *p, int parts);

#endif
