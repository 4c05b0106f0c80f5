/* How far a link may move against one part of a scene: continuous collision detection.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_CAST_H
#define BT_COLLIDE_CAST_H

#include "collide/safe.h"

/* A promise is kept against rounding: by a core a little larger, and by coordinates.  */
#define BT__MARGIN 1e-6
#define BT__ROUNDING 1e-14

/* Conservative advancement, of links against parts and of links against links.  */
#define BT__CAST_SAFETY 0.9 /* of a bound: what is taken */
#define BT__CAST_NEAR 0.02  /* of the core: the advance stops here */
#define BT__CAST_FLOOR 1e-4 /* of the core: nearer than this nothing comes nearer */

typedef struct bt__cast
{
  const bt__scene *scene;
  const bt__near *near;     /* what, and its distance at the start */
  const bt__motion *motion; /* of the scene, or NULL */
  double share;             /* of that motion */
  double radius;            /* of the scene about the motion's origin */
  bt__link link;            /* at the start */
  bt_vec3 da, db;           /* the moves of its ends */
  double core;
} bt__cast;

/* Return a lower bound of the time of impact, as a share of the move: so far the axis of the link
   stays CORE away from the part, if it does at the start; 1 for the whole move.  */
double bt__cast_run (const bt__cast *cast, bt__count *count);

#endif
