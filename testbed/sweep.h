/* Did a tether pass through something?  Told by exact predicates on the surface it swept and by
   linking numbers, without any of the engine's code.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_SWEEP_H
#define BT_TESTBED_SWEEP_H

#include <bight/vec.h>

typedef struct sweep_segment
{
  bt_vec3 a, b;
} sweep_segment;

typedef struct sweep_triangle
{
  bt_vec3 v[3];
} sweep_triangle;

/* Return the sign of the volume of A, B, C, D: filtered in double, then in 113 bits.  */
int sweep_orient (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d);

/* Return how often the polyline of N points crosses segment S with sign while every node goes
   straight from FROM to TO, all at once; link by link, absolute values added.  */
int sweep_crossings (const bt_vec3 *from, const bt_vec3 *to, int n, const sweep_segment *s);

/* The same for a sheet: its edges as above, the nodes' paths through its face, and links that are
   left sticking in it.  */
int sweep_sheet (const bt_vec3 *from, const bt_vec3 *to, int n, const sweep_triangle *t);

/* Return the linking number of RING, a closed polygon of M points, with the closed line FROM, its
   last node's path, TO backwards, its first node's path; not rounded.  */
double sweep_linking (const bt_vec3 *from, const bt_vec3 *to, int n, const bt_vec3 *ring, int m);

#endif
