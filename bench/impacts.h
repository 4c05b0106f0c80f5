/* The peak of tension of a vehicle that runs its line taut, beside the exact wave.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_IMPACTS_H
#define BT_BENCH_IMPACTS_H

#include "row.h"

/* Put rows of the impacts of testbed/impact.h into TABLE, flown by the models `dynamic' and `auto'
   at the default accuracy of tension; in words, if QUIET.  */
void bench_impacts (bench_table *table, int quiet);

#endif
