/* A slack line that trails behind its end, without forces: for a look at what it will touch.

   A neutral line in still water stays in place until pulled; then each point follows the next point
   along their link: a chain of tractrices.  A link that meets an obstacle is pushed out and slides.
   The model has no weight, current or friction; the taut string tells the end of slack.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_TRAIL_H
#define BT_AWARE_TRAIL_H

#include "collide/scene.h"

/* The line as it lies: N nodes, and after each but the last the length of its link, m.  */
typedef struct bt__trail
{
  bt_vec3 *x;
  double *link;
  uint32_t n;
} bt__trail;

/* Lay TRAIL, with room for N, along the nodes P.  */
void bt__trail_lay (bt__trail *trail, const bt_vec3 *p, uint32_t n);

/* Lead its last node to END; the first one stays.  Return the first of the links that moved: those
   from it on did.  */
uint32_t bt__trail_lead (bt__trail *trail, bt_vec3 end);

/* Push link K to the distance RADIUS, m, from the nearest object, and return true, with the object
   in *NEAR, if an object was nearer.  */
int bt__trail_meet (bt__trail *trail, uint32_t k, const bt__scene *scene, const bt__switches *on,
                    double radius, bt__near *near, bt__count *count);

#endif
