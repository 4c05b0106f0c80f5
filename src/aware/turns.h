/* Turns of a line about an axis, and linking of two lines.

   Pure geometry: the line is a polyline, an axis has no ends, and turns need not hold.  Clockwise
   in the view along the axis is positive, so the axis of a pile must point down.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_TURNS_H
#define BT_AWARE_TURNS_H

#include "collide/scene.h"

typedef struct bt__axis
{
  bt_vec3 at, along; /* along: unit */
} bt__axis;

/* Return true and *OUT, the axis of an obstacle: from end to end of a capsule, along a cylinder,
   down through the middle of what has none.  A plane has no middle: 0.  */
int bt__axis_of (const bt__obstacle *obstacle, bt__axis *out);

/* Return the signed turns of the polyline P of N points about AXIS: the angle swept, over 2 pi;
   continuous in P while no link meets the axis.  A link through the axis counts nothing.  */
double bt__turns (const bt__axis *axis, const bt_vec3 *p, uint32_t n);

/* Return the winding number about AXIS of the polyline closed by its straight chord.  The chord
   sweeps less than half a turn, so the winding number is the turns rounded to an integer; half a
   turn, if the chord meets the axis, is rounded towards zero.  */
int bt__winding (const bt__axis *axis, const bt_vec3 *p, uint32_t n);

#endif
