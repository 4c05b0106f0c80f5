/* One moving line by itself: its water, its ends, its steps.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_RIG_H
#define BT_TESTBED_RIG_H

#include "math/vec.h"
#include "tether/dynamic.h"

enum
{
  RIG_MAX = 2000 /* intervals */
};

typedef struct rig
{
  bt_tether_props line;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__dynamic_report report;
  bt__dynamic *d;
  bt__dynamic_work *work;
  long steps, solves, unconverged;
  bt_error error; /* of what was refused */
  int good;       /* zero once something was refused: nothing is to be read of the line then */
} rig;

/* Set R up, which stays where it is, with LINE of N intervals and LENGTH laid along the M points
   SHAPE, its ends held there, in water of DENSITY.  */
void rig_open (rig *r, bt_tether_props line, double density, int n, const bt_vec3 *shape, int m,
               double length);

/* Step R by H seconds.  */
void rig_step (rig *r, double h);

/* Let R come to rest where its ends are; no time passes.  */
void rig_settle (rig *r);

/* Return nonzero if all that R was asked for was done.  */
int rig_close (rig *r);

#endif
