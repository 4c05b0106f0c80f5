/* How far a link may move against one part of a scene, or against another link: continuous
   collision detection.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_CAST_H
#define BT_COLLIDE_CAST_H

#include "collide/safe.h"

/* A promise is kept against rounding: by a core a little larger, and by coordinates.  */
#define BT__MARGIN 1e-6
#define BT__ROUNDING 1e-14

/* m: no node goes farther in a step, or a leg of it, in which anything is near.  */
#define BT__STRIDE 2.0

/* Lists of what is near save later ones: times what is needed, and m beyond that.  */
#define BT__NEAR_WIDER 1.1
#define BT__NEAR_AROUND 0.1

#define BT__CAST_SAFETY 0.9 /* of a bound: what is taken */
#define BT__CAST_NEAR 0.02  /* of the core: the advance stops here */
#define BT__CAST_FLOOR 1e-4 /* of the core: nearer than this nothing comes nearer */
#define BT__CAST_LEAST 1e-3 /* of a move: a smaller share is none */

/* A work list cuts moves sweep by sweep: after so many sweeps offenders stop at once, then all
   nodes.  */
enum
{
  BT__SWEEPS_SOFT = 20,
  BT__SWEEPS_HARD = 60
};

typedef struct bt__cast
{
  const bt__scene *scene;   /* or NULL: another link is met, OTHER */
  const bt__near *near;     /* the part of the scene */
  const bt__motion *motion; /* of the scene, or NULL */
  double share;             /* of that motion */
  double radius;            /* of the scene about the motion's origin */
  bt__link link, other;     /* at the start */
  bt_vec3 d[2], other_d[2]; /* the moves of their ends */
  double core;              /* 0: the link may go where it likes */
  bt__witness w;            /* at the start; then where the cast ended, in the frame of the scene */
} bt__cast;

/* Return a lower bound of the time of impact, as a share of the move: so far the axis of the link
   stays CORE away from the part or the other link, if it does at the start; 1 for the whole move.
 */
double bt__cast_run (bt__cast *cast, bt__count *count);

/* CORE, wider by TIMES the margin and the rounding of the farthest coordinate of the N points X.
 */
double bt__cast_core (double core, double times, const bt_vec3 *x, uint32_t n);

/* Cut *SHARE by the factor T; less than a thousandth of a move becomes 0.  */
static inline void
bt__cast_shrink (double *share, double t)
{
  *share *= t;
  if (*share < BT__CAST_LEAST)
    *share = 0;
}

#endif
