/* The moving line beside MoorDyn, as others measured that.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_MOORDYN_H
#define BT_BENCH_MOORDYN_H

#include "row.h"

/* Put rows of MoorDyn's work and precision on its case C and of ours beside it into TABLE: theirs
   in steps of the base line of the machine they were measured on, ours in every EVERY-th number of
   intervals, the quickest of ROUNDS runs.  In words, if QUIET: what either costs for an error.
   Without the reference data nothing, or QUIET, a line that says so.  */
void bench_moordyn (bench_table *table, int every, int rounds, int quiet);

#endif
