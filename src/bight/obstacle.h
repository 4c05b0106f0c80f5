/* What a dive tells of its obstacles: kind, place, size, and their surfaces as triangles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_OBSTACLE_H
#define BIGHT_OBSTACLE_H

#include <bight/dive.h>

BT_BEGIN_DECLS

/* An obstacle as it is now.  */
typedef struct bt_obstacle_view
{
  bt_obstacle_kind kind;
  double friction;   /* Coulomb; NAN: the tether's own */
  bt_vec3 centre;    /* m: of its bounding box; of a level seabed below the origin */
  bt_vec3 axes[3];   /* its own x, y and z, unit */
  int has_axis;      /* cylinders and capsules: FROM and TO are its ends */
  bt_vec3 from, to;  /* m */
  bt_vec3 size;      /* m: of a box along its own axes; 0 of others */
  double radius;     /* m: of a sphere, cylinder, capsule; 0 of others */
  bt_vec3 low, high; /* m: its bounding box; infinite for a level seabed */
  int moves;         /* true: it has a track */
  size_t triangles;  /* that bt_obstacle_triangles knows: of meshes, grids and hulls */
} bt_obstacle_view;

/* BT_ERR_NAME unless I counts an obstacle of DIVE.  */
bt_status bt_dive_obstacle (const bt_dive *dive, int i, bt_obstacle_view *view, bt_error *error);

/* A triangle of an obstacle's surface.  */
typedef struct bt_facet
{
  bt_vec3 corner[3]; /* m; of a hull counter-clockwise seen from outside */
  int64_t id;        /* as given, or sequential */
} bt_facet;

/* Write up to N triangles of obstacle I, from the FIRST on in an order of its own, to FACETS and
   return how many; 0 when there are no more, or no such obstacle.  */
size_t bt_obstacle_triangles (const bt_dive *dive, int i, size_t first, size_t n, bt_facet *facets);

/* A box of the tree over an obstacle's triangles, its sides along the axes of the obstacle's view.
 */
typedef struct bt_tree_box
{
  bt_vec3 centre, half; /* m */
} bt_tree_box;

/* Return how many levels the tree over the triangles of obstacle I has, the box about all of them
   the first; 0 when it has no tree, or there is no such obstacle.  Meshes and grids have one.  */
int bt_obstacle_levels (const bt_dive *dive, int i);

/* Write up to N boxes of the tree's LEVEL (0: the one about all) of obstacle I, from the FIRST on,
   to BOXES and return how many; 0 when there are no more.  Where a branch ends above LEVEL its last
   box is there: the boxes of every level hold all triangles.  */
size_t bt_obstacle_boxes (const bt_dive *dive, int i, int level, size_t first, size_t n,
                          bt_tree_box *boxes);

BT_END_DECLS

#endif
