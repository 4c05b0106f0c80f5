/* Three lines in open water that other codes can fly too: by the engine's chain alone, and in a
   dive.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_RACE_H
#define BT_TESTBED_RACE_H

#include "testbed/outside.h"

typedef struct race
{
  const char *name;
  bt_tether_props line; /* its figures alone */
  double length;        /* m */
  bt_vec3 anchor, flow; /* m; m/s of the water */
  int rows;             /* half a second apart, the first at the beginning */
  int loose;            /* true: begun straight, unstretched and at rest, the far end free; else at
                           rest in the flow, the far end led */
  bt_vec3 (*led) (double t); /* m: where the far end is T seconds after the beginning */
} race;

typedef enum race_kind
{
  RACE_LED,    /* MoorDyn's case C: outside.h */
  RACE_RAMP,   /* a slack line of 100 m run out at 1.5 m/s until it is taut, and held so */
  RACE_LET_GO, /* 30 m of line let go level, one end free: it falls and swings about its anchor */
  RACES
} race_kind;

extern const race races[RACES];

#define RACE_DENSITY 1025.0 /* kg/m3 */

/* Fly R by a chain of its own as HOW says.  *SECONDS, unless it is NULL, receives the CPU seconds
   of a simulated one.  */
outside_result race_by_chain (const race *r, const outside_setting *how, outside_flight *f,
                              double *seconds);

/* How R is to be flown in a dive; RACE_LED and RACE_RAMP by a vehicle without mass on a track.  */
typedef struct race_dive
{
  int model;                         /* BT_MODEL_DYNAMIC or BT_MODEL_AUTO */
  int nodes;                         /* intervals of its world */
  double accuracy, tension_accuracy; /* m; a share */
} race_dive;

/* Fly R in a dive.  What goes wrong ends the program.  */
void race_in_dive (const race *r, const race_dive *how, outside_flight *f, double *seconds);

/* Extrapolate two flights of R of second order, with 200 and 400 intervals, to *BEST.  */
outside_result race_converged (const race *r, outside_flight *best);

#endif
