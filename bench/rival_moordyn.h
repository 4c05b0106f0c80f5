/* MoorDyn at a race, where it is installed: by its own functions in C.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_RIVAL_MOORDYN_H
#define BT_BENCH_RIVAL_MOORDYN_H

#include "testbed/race.h"

enum
{
  MOORDYN_SEGMENTS_MAX = 1000
};

/* How MoorDyn is to fly.  */
typedef struct moordyn_setting
{
  const char *scheme; /* its tScheme */
  int segments;
  double step; /* s: at most; half a second is so many equal steps */
} moordyn_setting;

/* Fly R from the first row of BEGIN, at rest.  An end tension is a line through the tensions of the
   last two segments, read at the end.  Return zero where MoorDyn refuses or blows up.  *SECONDS
   receives the CPU seconds of a simulated one.  */
int moordyn_fly (const race *r, const moordyn_setting *how, const outside_flight *begin,
                 outside_flight *f, double *seconds);

#endif
