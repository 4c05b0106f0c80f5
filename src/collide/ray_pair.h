/* A ray against one shape: closed forms.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_RAY_PAIR_H
#define BT_COLLIDE_RAY_PAIR_H

#include "collide/scene.h"

/* Where a ray enters a shape.  */
typedef struct bt__entry
{
  double range;   /* m; 0 if it starts inside */
  bt_vec3 normal; /* unit, of the surface; against the ray if it starts inside */
} bt__entry;

/* Return true and *OUT if the ray from FROM along DIRECTION, unit, enters the obstacle, which is
   no mesh, no farther than REACH.  */
int bt__ray_obstacle (const bt__obstacle *obstacle, bt_vec3 from, bt_vec3 direction, double reach,
                      bt__entry *out);

/* The same for a triangle, two-sided.  No ray slips between two that share an edge.  */
int bt__ray_triangle (const bt__triangle *triangle, bt_vec3 from, bt_vec3 direction, double reach,
                      bt__entry *out);

#endif
