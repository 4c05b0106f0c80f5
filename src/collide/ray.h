/* Rays: what a beam of a sonar meets first.

   Obstacles are seen from outside: a ray that starts inside a solid meets it at once, at range 0.
   Meshes are two-sided and have no inside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_RAY_H
#define BT_COLLIDE_RAY_H

#include "collide/safe.h"

#define BT__NO_MOVER UINT32_MAX

typedef struct bt__ray
{
  bt_vec3 from, direction; /* direction: unit */
  double range;            /* m: no farther than this; finite */
} bt__ray;

typedef struct bt__ray_hit
{
  double range;          /* m from the start */
  bt_vec3 point, normal; /* normal: unit, of the surface, against the ray */
  uint32_t mover;        /* whose scene, or BT__NO_MOVER: the one that stands still */
  uint32_t object;       /* its place in that scene */
  uint32_t slot;         /* the triangle in the mesh's order, or BT__NO_TRIANGLE */
  uint32_t triangle;     /* its id, or BT__NO_TRIANGLE */
} bt__ray_hit;

/* Return true and *OUT, the first thing RAY meets in SCENE, or of kinematic obstacles, each at the
   share DONE of its motion.  Ranges are good to 1e-12 of the largest length involved but for
   grazing rays: no point of the ray before the range is deeper in a solid than that.  A ray that is
   not finite meets nothing.  */
int bt__ray_cast (const bt__scene *scene, const bt__switches *on, const bt__mover *mover,
                  uint32_t movers, const bt__ray *ray, bt__ray_hit *out, bt__count *count);

#endif
