/* Throwing a tether about on a stage, judged at every step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_PLAY_H
#define BT_TESTBED_PLAY_H

#include "testbed/stage.h"

typedef struct verdict
{
  long crossings, too_near, unlinked, truncated, overflows, pinched;
  double least; /* m: the smallest clearance seen */
} verdict;

/* Propose N moves, jumps of 20 m, 1e9 m and what is not finite among them, take what the safe step
   leaves of each, and return what the oracle says of it.  */
verdict play (stage *g, dice *d, long n, double core);

/* How often a tether that goes from FROM to TO passes through what stands on the stage.  */
int crossings (const stage *g, const bt_vec3 *from, const bt_vec3 *to);

/* The distance of tether X from what stands there.  */
double clearance (const stage *g, const bt_vec3 *x);

#endif
