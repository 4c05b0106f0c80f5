/* Questions about obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include <bight/obstacle.h>

#include "world/obstacles.h"

/* What its shape is drawn in: the world, or where its track has it now.  */
static bt__frame
obstacle_frame (const bt_dive *dive, int i)
{
  int k = bt__model_carried (dive->model, i);
  return k >= 0 ? bt__dive_movers (dive, dive->now)[k].frame
                : bt__turned (bt__vec (0, 0, 0), 0, 0, 0);
}

static size_t
count_triangles (const bt__obstacle *shape)
{
  if (shape->kind == BT__OBSTACLE_MESH)
    return shape->shape.mesh->triangles;
  return shape->kind == BT__OBSTACLE_CONVEX ? (size_t)shape->shape.hull->faces : 0;
}

/* The sizes of SHAPE, drawn in FRAME.  */
static void
view_shape (const bt__obstacle *shape, const bt__frame *frame, bt_obstacle_view *view)
{
  const bt__box *box = &shape->shape.box;
  const bt__cylinder *c = &shape->shape.cylinder;
  const bt__capsule *p = &shape->shape.capsule;
  bt_vec3 half;
  if (shape->kind == BT__OBSTACLE_BOX)
    {
      view->size = bt__scale (2, box->half);
      view->axes[0] = bt__out_of (frame, box->frame.x);
      view->axes[1] = bt__out_of (frame, box->frame.y);
      view->axes[2] = bt__out_of (frame, box->frame.z);
    }
  else if (shape->kind == BT__OBSTACLE_SPHERE)
    view->radius = shape->shape.sphere.radius;
  else if (shape->kind == BT__OBSTACLE_CYLINDER)
    {
      half = bt__scale (c->half, c->axis);
      view->has_axis = 1;
      view->radius = c->radius;
      view->from = bt__to_world (frame, bt__sub (c->centre, half));
      view->to = bt__to_world (frame, bt__add (c->centre, half));
    }
  else if (shape->kind == BT__OBSTACLE_CAPSULE)
    {
      view->has_axis = 1;
      view->radius = p->radius;
      view->from = bt__to_world (frame, p->a);
      view->to = bt__to_world (frame, p->b);
    }
}

bt_status
bt_dive_obstacle (const bt_dive *dive, int i, bt_obstacle_view *view, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_OBSTACLE, i, error);
  const bt__obstacle *shape;
  bt__frame frame;
  bt__aabb box;
  if (status != BT_OK)
    return status;
  shape = bt__model_shape (dive->model, i);
  frame = obstacle_frame (dive, i);
  box = bt__model_carried (dive->model, i) >= 0 ? bt__framed_box (shape, &frame)
                                                : bt__obstacle_box (shape);
  memset (view, 0, sizeof *view);
  view->kind = dive->model->obstacles[i].kind;
  view->friction = bt__dive_roughness (dive, dive->now)[i];
  view->moves = bt__model_carried (dive->model, i) >= 0;
  view->axes[0] = frame.x;
  view->axes[1] = frame.y;
  view->axes[2] = frame.z;
  view->low = box.lo;
  view->high = box.hi;
  view->centre = shape->kind == BT__OBSTACLE_PLANE
                     ? bt__scale (shape->shape.plane.offset, shape->shape.plane.normal)
                     : bt__scale (0.5, bt__add (box.lo, box.hi));
  view->triangles = count_triangles (shape);
  view_shape (shape, &frame, view);
  return BT_OK;
}

/* Face K of HULL, counter-clockwise seen from outside.  */
static void
face_corners (const bt__hull *hull, size_t k, bt_vec3 corner[3])
{
  const int *c = hull->corner[k];
  bt_vec3 a = hull->v[c[0]], b = hull->v[c[1]], d = hull->v[c[2]];
  bt_vec3 n = bt__cross (bt__sub (b, a), bt__sub (d, a));
  int outward = bt__dot (n, hull->face[k].normal) >= 0;
  corner[0] = a;
  corner[1] = outward ? b : d;
  corner[2] = outward ? d : b;
}

static bt_facet
facet_of (const bt__obstacle *shape, const bt__frame *frame, size_t k)
{
  bt_facet facet = { .id = (int64_t)k };
  if (shape->kind == BT__OBSTACLE_MESH)
    {
      bt__triangle t = bt__mesh_triangle (shape->shape.mesh, (uint32_t)k);
      memcpy (facet.corner, t.v, sizeof facet.corner);
      facet.id = shape->shape.mesh->id[k];
    }
  else
    face_corners (shape->shape.hull, k, facet.corner);
  for (int j = 0; j < 3; j++)
    facet.corner[j] = bt__to_world (frame, facet.corner[j]);
  return facet;
}

size_t
bt_obstacle_triangles (const bt_dive *dive, int i, size_t first, size_t n, bt_facet *facets)
{
  const bt__obstacle *shape;
  bt__frame frame;
  size_t all, k = 0;
  if (bt__check_part (dive, BT_PART_OBSTACLE, i, NULL) != BT_OK)
    return 0;
  shape = bt__model_shape (dive->model, i);
  frame = obstacle_frame (dive, i);
  all = count_triangles (shape);
  for (; first < all && k < n && k < all - first; k++)
    facets[k] = facet_of (shape, &frame, first + k);
  return k;
}
