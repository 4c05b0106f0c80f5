/* The trees of large meshes: made by one thread and by two, and taken from disk.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BENCH_SCALE_TREES_H
#define BENCH_SCALE_TREES_H

#include "row.h"

/* Put rows of a jacket in 1e5 and MOST triangles, its tree made and found by turns, ROUNDS of them.
   The error is how many of the trees have other bits than the first.  */
void scale_trees (bench_table *t, long most, int rounds);

#endif
