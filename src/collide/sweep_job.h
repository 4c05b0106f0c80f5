/* Inside the sweep of a body: one convex part at a time.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_SWEEP_JOB_H
#define BT_COLLIDE_SWEEP_JOB_H

#include "collide/sweep.h"

/* A convex core grown by ROUND that goes the way of MOTION; RADIUS of a ball about its frame's
   origin that holds it.  */
typedef struct bt__flier
{
  bt__convex core;
  double round, radius;
  bt__motion motion;
} bt__flier;

/* A body and a part on their ways.  */
typedef struct bt__chase
{
  bt__flier body, part;
  const bt__plane *plane; /* stands in for the part, or NULL */
  double gap;
} bt__chase;

/* The nearest points of the two at the share T of both ways.  */
typedef struct bt__apart
{
  double distance; /* 0 or less: they overlap by that */
  bt_vec3 point;   /* on the part, in the world */
  bt_vec3 normal;  /* unit, from the part to the body; 0 where the cores meet */
} bt__apart;

/* Return the largest share, at most MOST, of both ways that keeps the two apart; *OUT is how they
   stand there if it is less than MOST.  */
double bt__chase_run (const bt__chase *chase, double most, bt__apart *out, bt__count *count);

/* Return the core SHAPE, as seen from outside the frame it stands in.  */
typedef struct bt__placed
{
  const bt__convex *core;
  bt__frame frame;
} bt__placed;

/* A bt__support; SHAPE is a bt__placed.  */
bt_vec3 bt__placed_support (const void *shape, bt_vec3 direction, int *hint);

/* Return MOTION cut to its first SHARE.  */
bt__motion bt__motion_cut (const bt__motion *motion, double share);

#endif
