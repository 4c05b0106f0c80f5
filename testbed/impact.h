/* A vehicle that runs its line taut: the exact wave in the line, and a dive of it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_IMPACT_H
#define BT_TESTBED_IMPACT_H

#include "testbed/scene.h"

#define IMPACT_MASS 20.0 /* kg: of the vehicle */
#define IMPACT_SPEED 1.0 /* m/s: of it, when the line comes taut */

typedef struct impact
{
  double ea, ba, mass, length; /* N, N s, kg/m, m: of the line */
} impact;

enum
{
  IMPACTS = 8
};

/* Lines of 5 to 60 m, of two stiffnesses.  */
extern const impact impacts[IMPACTS];

/* Return the time, s, for which the line of I is taut, a little more than half a swing.  */
double impact_time (const impact *i);

/* Return the largest tension, N, at either end of the line of I while it is taut.  */
double impact_exact (const impact *i);

/* Make S a scene of almost nothing: a vehicle at the end of the line of I, of NODES intervals,
   which is straight and not yet tense; begin a dive in S with the vehicle under way.  */
void impact_scene (scene *s, const impact *i, int nodes);
bt_dive *impact_begin (const scene *s);

/* Step DIVE for SECONDS and return the largest tension that it tells, N.  */
double impact_found (bt_dive *dive, double seconds);

#endif
