/* How a dive grows with what moves its water: components of waves, lees of obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BENCH_SCALE_SEA_H
#define BENCH_SCALE_SEA_H

#include "row.h"

/* Put rows of a line of 100 flown in seas of 2 to 64 components, beside the same line in calm water
   by turns, ROUNDS of them.  The error is how far, in metres at most, the line comes to lie from
   the line in the exact sea.  */
void scale_waves (bench_table *t, int rounds);

/* Put rows of the same line in a current among 10 to MOST piles with lees, beside the same piles
   without lees and a sea without piles; LOAD_S is what a new dive takes.  */
void scale_lees (bench_table *t, long most, int rounds);

#endif
