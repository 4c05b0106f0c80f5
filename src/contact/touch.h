/* A tether among obstacles: what surrounds it, and where it touches.

   Flat records that the state of a dive keeps, whichever response made them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_TOUCH_H
#define BT_CONTACT_TOUCH_H

#include "collide/safe.h"

/* Of a length, or m: a smaller difference of lengths or places is none.  */
#define BT__SAME 1e-9

/* The obstacles around a tether in a step: the objects of SCENE stand still; kinematic obstacles
   move from one place to another, and their DONE receives the share of the motion taken.  The ids
   of objects are the numbers of the obstacles in the model.  */
typedef struct bt__surroundings
{
  const bt__scene *scene; /* empty, not NULL, where nothing stands */
  const bt__switches *on; /* of SCENE's objects, for this tether */
  bt__mover *mover;
  uint32_t movers;
} bt__surroundings;

typedef enum bt__touch_state
{
  BT__TOUCH_STICK = 0,
  BT__TOUCH_SLIDE
} bt__touch_state;

/* Where a tether touches an obstacle.  */
typedef struct bt__touch
{
  int64_t object;   /* the obstacle's id */
  int64_t triangle; /* its id on a mesh, or -1 */
  int64_t state;    /* bt__touch_state */
  double s;         /* m of arc length from the anchor */
  bt_vec3 point;    /* on the obstacle */
  bt_vec3 normal;   /* unit, from the obstacle to the line */
  bt_vec3 force;    /* N on the line */
} bt__touch;

/* The line's axis never comes nearer to an obstacle than this: half its radius.  */
static inline double
bt__core (double diameter)
{
  return diameter / 4;
}

#endif
