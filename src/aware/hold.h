/* What holds a taut line: where it bends, about which obstacle, by how much.

   Meant for a taut string.  On a slack line every wriggle near an obstacle counts as turning.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_HOLD_H
#define BT_AWARE_HOLD_H

#include "collide/scene.h"

/* A node that bends at an obstacle.  */
typedef struct bt__corner
{
  uint32_t node, object; /* object: its place in the scene */
  uint32_t triangle;     /* its id, or BT__NO_TRIANGLE */
  double angle;          /* radians, positive */
  double s;              /* m along the line from its start */
  bt_vec3 point, normal; /* on the obstacle; unit, to the line */
  double radius;         /* m, of the round member there; 0 at an edge, a face, a triangle */
  double bend;           /* m, radius of the line's arc there; 0 where it has a corner */
  double friction;       /* Coulomb, the object's; NaN: the line's own, which the caller puts in */
} bt__corner;

typedef struct bt__holds
{
  bt__corner *at;
  uint32_t n, room;
  uint32_t dropped; /* that found no room */
} bt__holds;

/* Fill LIST, in order, with the nodes of the polyline P of N points that turn by more than 1e-4
   within REACH, m, of an obstacle, each with the nearest obstacle.  CORE, m, is the clearance of
   the line.  */
void bt__holds_find (const bt__scene *scene, const bt__switches *on, const bt_vec3 *p, uint32_t n,
                     double core, double reach, bt__holds *list, bt__count *count);

/* Return the radians of contact with OBJECT.  */
double bt__holds_wrap (const bt__holds *list, uint32_t object);

/* Return the product of exp (mu theta) over the holds: the ratio of pulls a rope of no weight
   bears before it slides.  */
double bt__holds_lock (const bt__holds *list);

/* Return the length of the polyline with its corners at round members made arcs: each corner of
   angle t stands over an arc rho t by two tangents rho tan (t / 2).  Corners with links too short
   for their tangents stay.  */
double bt__holds_length (const bt__holds *list, const bt_vec3 *p, uint32_t n);

#endif
