/* Distance of two convex shapes given by their supports, by the Gilbert-Johnson-Keerthi algorithm.

   Give it cores: shapes without their radius.  Exact for polytopes; a curved support converges
   linearly, to about 1e-10.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_GJK_H
#define BT_COLLIDE_GJK_H

#include "math/vec.h"

/* Return the point of SHAPE farthest in DIRECTION.  *HINT is the search's memory between calls: a
   number of the shape's own, at first 0.  */
typedef bt_vec3 (*bt__support) (const void *shape, bt_vec3 direction, int *hint);

typedef struct bt__convex
{
  bt__support support;
  const void *shape;
} bt__convex;

typedef struct bt__gap
{
  double distance; /* 0 if they meet */
  bt_vec3 a, b;    /* the nearest points */
  int hint[2];     /* the last support of each: vertices */
  int steps;
} bt__gap;

void bt__gjk (const bt__convex *a, const bt__convex *b, bt__gap *out);

#endif
