/* Convex hulls of points: a solid with vertices, neighbours, faces and edges.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_HULL_H
#define BT_COLLIDE_HULL_H

#include <bight/status.h>

#include "collide/pair.h"

enum
{
  BT__HULL_CLIMB = 64, /* more vertices than this: the support climbs */
  BT__HULL_POINTS_MAX = 1000000
};

typedef struct bt__hull_face
{
  bt_vec3 normal; /* outward, unit; the solid is below normal . p = offset */
  double offset;
} bt__hull_face;

typedef struct bt__hull_edge
{
  int v[2], face[2];
} bt__hull_edge;

struct bt__hull
{
  int vertices, faces, edges;
  bt_vec3 *v;
  bt__hull_face *face;
  bt__hull_edge *edge;
  int (*corner)[3];   /* of each face, a triangle */
  int *first, *other; /* the neighbours of vertex i: other[first[i]] to other[first[i + 1] - 1] */
};

/* Return in *OUT the convex hull of N POINTS.  BT_ERR_DOMAIN if a point is not finite or all points
   are (nearly) in one plane; BT_ERR_LIMIT if there are too many or memory runs out.  Free it with
   bt__hull_free.  */
bt_status bt__hull_new (const bt_vec3 *points, int n, bt__hull **out, bt_error *error);

void bt__hull_free (bt__hull *hull); /* NULL is nothing */

/* A bt__support; SHAPE is a bt__hull, the hint a vertex.  */
bt_vec3 bt__hull_support (const void *shape, bt_vec3 direction, int *hint);

#endif
