/* A convex body, the hull of a vehicle, on its way: how far it may go.

   From a start GAP clear of everything no point of the body comes nearer than GAP to an obstacle on
   the way it takes: straight, with an even turn about its frame's origin.  What is nearer at the
   start may come no nearer; what overlaps there holds the body where it is.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_SWEEP_H
#define BT_COLLIDE_SWEEP_H

#include "collide/safe.h"

/* In its own frame: CORE grown by ROUND.  What CORE refers to is borrowed.  */
typedef struct bt__body
{
  bt__convex core;
  double round;  /* m, 0 or more */
  double radius; /* m: of a ball about the frame's origin that holds all of it */
} bt__body;

bt__body bt__body_box (const bt__box *box, double round);
bt__body bt__body_ball (double radius);

/* What the body is near to, or what stopped it.  */
typedef struct bt__stop
{
  uint32_t mover;    /* whose scene, or UINT32_MAX: the one that stands still */
  uint32_t object;   /* its place in that scene */
  uint32_t slot;     /* the triangle in the mesh's order, or BT__NO_TRIANGLE */
  uint32_t triangle; /* its id, or BT__NO_TRIANGLE */
  double distance;   /* m between body and obstacle there; 0: they overlap */
  bt_vec3 point;     /* on the obstacle, in the world */
  bt_vec3 normal;    /* unit, from the obstacle to the body */
} bt__stop;

/* Return the largest share, 0 to 1, of MOTION (a turn less than pi) that BODY may take, found from
   below: head on the body is held between GAP (m, more than 0) and a hundredth more; SCENE may be
   NULL.  If the share is less than 1, *STOP tells the part in the way and the closest points at the
   place where the body is held.  A motion that is not finite is not taken: 0.

   A mover takes the share DONE of its motion in the same time; where the two would meet DONE is cut
   as well, by the same factor.  STOP may be NULL.  No allocation.  */
double bt__body_sweep (const bt__body *body, const bt__motion *motion, double gap,
                       const bt__scene *scene, const bt__switches *on, bt__mover *mover,
                       uint32_t movers, bt__stop *stop, bt__count *count);

/* Return true and *STOP, the part nearest to BODY standing at FRAME, if it is within CAP; movers
   stand where the share DONE of their motion brings them.  */
int bt__body_nearest (const bt__body *body, const bt__frame *frame, double cap,
                      const bt__scene *scene, const bt__switches *on, const bt__mover *mover,
                      uint32_t movers, bt__stop *stop, bt__count *count);

#endif
