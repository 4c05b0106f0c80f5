/* A slack line that trails behind its end, without forces: for a look at what it will touch.

   A neutral line in still water stays where it is until it is pulled, and then each point follows
   the next one along their link: a chain of tractrices.  It is pushed out of what it meets and
   slides there.  No weight, no current, no friction; the string says when it is taut.

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

/* Push link K out of what is within RADIUS of it, and return nonzero and *NEAR, that, if there is
   something.  */
int bt__trail_meet (bt__trail *trail, uint32_t k, const bt__scene *scene, const bt__switches *on,
                    double radius, bt__near *near, bt__count *count);

#endif
