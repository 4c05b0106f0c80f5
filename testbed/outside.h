/* Lines that others computed or measured, flown here as they did it.  The laws hold the engine to
   them, the validation page shows both.  All data are read from the folder of the reference data
   (reference.h); a case whose file is not there, or is cut short, is told as such.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_OUTSIDE_H
#define BT_TESTBED_OUTSIDE_H

#include <bight/tether.h>

#include "math/vec.h"

enum
{
  OUTSIDE_COLUMNS = 70,
  OUTSIDE_ROWS = 1000,
  OUTSIDE_STATIONS = 21, /* of case C, evenly along the line */
  OUTSIDE_HALVES = 121   /* rows of case C, half a second apart */
};

/* The numbers of a file.  */
typedef struct outside_table
{
  int rows, columns; /* columns: of the last row */
  double at[OUTSIDE_ROWS][OUTSIDE_COLUMNS];
} outside_table;

/* Read the rows of FILE that begin with a number.  Return nonzero if there is one, and each has
   COLUMNS numbers at least.  */
int outside_load (const char *file, int columns, outside_table *t);

/* What came of a case.  */
typedef enum outside_result
{
  OUTSIDE_DONE,
  OUTSIDE_NO_DATA,
  OUTSIDE_FAILED /* a step was refused, or memory is out */
} outside_result;

/* A quantity over time, theirs and ours at the same moments.  */
typedef struct outside_history
{
  int rows;
  double t[OUTSIDE_ROWS], ours[OUTSIDE_ROWS], theirs[OUTSIDE_ROWS];
  double rest[2]; /* ours before it begins: see the case */
} outside_history;

/* ---- MoorDyn 2.7.1 ---- */

/* A: hung in still water; B: in a current across it.  Both at rest.  */
typedef struct outside_shape
{
  int rows;
  double s[OUTSIDE_ROWS];                              /* m along it */
  bt_vec3 ours[OUTSIDE_ROWS], theirs[OUTSIDE_ROWS];    /* m */
  double pull[OUTSIDE_ROWS], their_pull[OUTSIDE_ROWS]; /* N */
} outside_shape;

/* Lay case A (WHICH 0) or B (1) with N intervals.  */
outside_result outside_moordyn_rest (int which, int n, outside_shape *shape);

/* C: B's line, its far end led by up to 20 m and back within a minute.  */
typedef struct outside_flight
{
  int rows;
  double t[OUTSIDE_ROWS];
  bt_vec3 at[OUTSIDE_ROWS][OUTSIDE_STATIONS]; /* m */
  double pull[OUTSIDE_ROWS][2];               /* N, at its ends */
} outside_flight;

/* How it is to be flown.  */
typedef struct outside_setting
{
  int intervals, per; /* steps in half a second */
  int order;          /* 4, else 2, in space */
  double tolerance;   /* of a step; 0: the engine's own */
} outside_setting;

/* Read what MoorDyn gave for C; race.h flies it.  */
outside_result outside_moordyn_theirs (outside_flight *theirs);

/* The far end of C, T seconds after the start.  */
bt_vec3 outside_moordyn_led (double t);

/* The flight that COARSE and FINE, of second order with half the step and interval, tend to.  */
void outside_extrapolate (const outside_flight *coarse, const outside_flight *fine,
                          outside_flight *best);

/* Rms distance of A to B over every EVERY-th station, m, and, unless PULL is NULL, rms difference
   of the end tensions relative to that of B.  */
double outside_apart (const outside_flight *a, const outside_flight *b, int every, double *pull);

/* ---- Lowe and Langley (2006): a flexible jumper ---- */

/* Top tension, kN, of case 1 or 2 (the top moved along x, y by 10 m in 27 s) or 6 (waves of 10 m in
   10 s across it); the REST is the force at the top along x and z, kN.  N: intervals; CD:
   normal drag coefficient, theirs is 1.  */
outside_result outside_jumper (int which, int n, double cd, outside_history *h);

/* ---- OrcaFlex: a chain on the bottom ---- */

/* What is not said of the reference.  */
typedef struct outside_bottom
{
  int intervals;
  double stiffness, damping; /* Pa/m, Pa s/m */
  double along;    /* share of its axial drag coefficient that is ours on the circumference */
  double friction; /* coefficient, in full from 0.1 m/s on */
  double contact;  /* m: the diameter with which the chain touches */
} outside_bottom;

extern const outside_bottom outside_plain_bottom;

/* Fairlead tension, kN, of WD0050 in motion A1 or A2 (WHICH 1, 2); the REST is the tension at the
   fairlead and at the anchor.  */
outside_result outside_chain (int which, const outside_bottom *bottom, outside_history *h);

/* ---- Filliung et al. (ICRA 2024): a tether in a tank ---- */

/* What the rope may be; all zero but CD: a limp rope in still water that has no memory.  */
typedef struct outside_rope
{
  double cd;          /* normal drag coefficient */
  int plumb;          /* true: upward as the rope hung before the vehicle set out, else as told */
  bt_vec3 drift;      /* m/s of the water */
  double wake, fades; /* the share of a node's speed that its water takes on, over so many diameters
                         of way */
  double ei, curvature; /* N m2; 1/m of a set */
} outside_rope;

extern const outside_rope outside_plain_rope;

/* All but T in mm, means over the 16 markers.  Their markers are a turned catenary's, the nearest
   to what was seen.  */
typedef struct outside_tank
{
  int rows;
  double t[OUTSIDE_ROWS];
  double off[OUTSIDE_ROWS];    /* our line beside their markers */
  double drawn[OUTSIDE_ROWS];  /* the turned catenary nearest to our line beside their markers */
  double misses[OUTSIDE_ROWS]; /* the turned catenary nearest to our line beside our line, ... */
  double doubt[OUTSIDE_ROWS];  /* ... and theirs beside what was seen */
  double plain[OUTSIDE_ROWS];  /* a catenary in still water beside their markers */
} outside_tank;

/* Fly cable 6, surge run.  */
outside_result outside_in_tank (const outside_rope *rope, outside_tank *tank);

/* ---- Chen et al. (CoRL 2024): cables swung in air by two robot arms ---- */

typedef struct outside_swing
{
  double stiffness;   /* EI by mass per length, m4/s2: not told */
  double mass;        /* kg/m: not told, matters against the air alone */
  int intervals, per; /* steps in a hundredth of a second */
} outside_swing;

/* Swing the cable of FILE: H's OURS is the mean distance to the markers that are not held, mm.  */
outside_result outside_cable (const char *file, const outside_swing *how, outside_history *h);

/* A frame moves when a catenary is off by more than 20 mm in it.  */
#define OUTSIDE_MOVING 20.0

#endif
