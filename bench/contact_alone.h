/* What contact costs a line that touches nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_CONTACT_ALONE_H
#define BT_BENCH_CONTACT_ALONE_H

#include "row.h"

/* Put rows of what a far scene, and looking out for itself, add to a line's own step: of ROUNDS
   rounds, in each of which both lines are flown.  Zero if a scene could not be made.  */
int contact_alone (bench_table *table, int rounds);

#endif
