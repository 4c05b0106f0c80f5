/* Shapes for the collision tests: drawn at random, their distance to a link by brute force, their
   supports.  Nothing here calls the pairs it checks, but for solid_pair.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_SOLIDS_H
#define BT_TESTBED_SOLIDS_H

#include <stdint.h>

#include "collide/gjk.h"
#include "collide/hull.h"
#include "collide/pair.h"
#include "collide/scene.h"

typedef enum solid_kind
{
  SOLID_SPHERE,
  SOLID_CAPSULE,
  SOLID_BOX,
  SOLID_CYLINDER,
  SOLID_TRIANGLE,
  SOLID_HULL,
  SOLID_KINDS
} solid_kind;

typedef struct solid
{
  solid_kind kind;
  bt__sphere sphere;
  bt__capsule capsule;
  bt__box box;
  bt__cylinder cylinder;
  bt__triangle triangle;
  bt__hull *hull; /* borrowed, of a pool */
} solid;

/* xorshift128+; the same everywhere.  */
typedef struct dice
{
  uint64_t s[2];
} dice;

dice dice_new (uint64_t seed);
double dice_uniform (dice *d); /* 0 to 1 */
double dice_between (dice *d, double a, double b);
int dice_below (dice *d, int n);
bt_vec3 dice_point (dice *d, double half); /* in a cube */
bt_vec3 dice_direction (dice *d);

extern const char *const solid_names[SOLID_KINDS];

/* Return a shape of size about SCALE round 0.  POOL: hulls of that scale to draw from.  */
solid solid_draw (dice *d, solid_kind kind, double scale, bt__hull *const *pool, int pools);

bt__witness solid_pair (const solid *x, const bt__link *link);

/* The distance of P from the solid, 0 inside.  */
double solid_point (const solid *x, bt_vec3 p);

/* The largest n . p over the solid.  */
double solid_support (const solid *x, bt_vec3 n);

/* The distance of LINK by golden section over its points, 0 where they meet.  */
double solid_brute (const solid *x, const bt__link *link);

/* The core for GJK, and what to subtract.  */
bt__convex solid_core (const solid *x, double *radius);
bt__convex solid_link_core (const bt__link *link);

/* X, anything but a triangle, as the obstacle that the engine knows.  */
bt__obstacle obstacle_of_solid (const solid *x);

/* A frame made right angled again.  */
bt__frame squared_frame (bt__frame f);

#endif
