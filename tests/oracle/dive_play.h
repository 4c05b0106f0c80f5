/* A pilot who does anything, under the eyes of the judge.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_DIVE_PLAY_H
#define BT_ORACLE_DIVE_PLAY_H

#include "dive_judge.h"

/* What he does besides driving, moving at 20 m/s and flying to places: jumps of 20 m, the winch,
   other models, N above 1: before one act in N besides, cuts, pairs off and on (which the judge
   then leaves alone).  */
typedef struct habits
{
  int jumps, winch, models, cut, pairs;
} habits;

/* So many acts, each followed by so many steps.  */
void live (bt_dive *dive, judge *j, dice *d, habits h, int acts, int steps);

/* The same as a dive of its own, and the verdict.  */
void fly (const scene *s, uint64_t seed, habits h, int acts, int steps, const char *name);

/* BIGHT_LONG=1: twenty times as long.  BIGHT_SEED: what is added to every seed.  */
int longer (void);
uint64_t other_seeds (void);

#endif
