/* How a step grows with obstacles far away, with contacts, and with forks stepped side by side.

   The counter `n' of a row is what there are so many of.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_SCALE_MANY_H
#define BT_BENCH_SCALE_MANY_H

#include "row.h"

/* The bare dive of the bench skip beside 1 to MOST obstacles 500 m away and farther.  */
void scale_obstacles (bench_table *t, long most, int rounds);

/* A line laid out on a slab, of 10 to MOST intervals: nearly each touches it.  */
void scale_contacts (bench_table *t, long most, double work);

/* 1 to MOST forks of one dive, stepped side by side on one thread, as the members of a belief are.
 */
void scale_members (bench_table *t, long most, double work);

/* The memory of forks of a dive, in open water and pressed to a bar, and what making one takes. The
   error is what the system gave of memory, in bytes for an interval, after five steps.  Call this
   first: memory that was used before is not seen to be given.  */
void scale_forks (bench_table *t);

#endif
