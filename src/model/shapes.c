/* An obstacle as declared, checked and drawn: its shape in the world or, with a track, in its own
   frame.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/compile.h"

#define FAR 1e7 /* m, as in the table of fields */

int
bt__has_axis (const bt_obstacle_def *def)
{
  return def->kind == BT_OBSTACLE_CYLINDER || def->kind == BT_OBSTACLE_CAPSULE;
}

int
bt__has_heading (const bt_obstacle_def *def)
{
  return def->kind == BT_OBSTACLE_BOX || def->kind == BT_OBSTACLE_CONVEX
         || def->kind == BT_OBSTACLE_MESH;
}

int
bt__is_carried (const bt_obstacle_def *def)
{
  return def->kind != BT_OBSTACLE_SEABED && def->track.n > 0;
}

/* Where the shape is drawn: in the world, or in its own frame.  */
static bt__frame
drawing_frame (const bt_obstacle_def *def)
{
  int carried = bt__is_carried (def);
  bt_vec3 at = carried ? bt__vec (0, 0, 0) : def->at;
  return bt__has_heading (def) ? bt__turned (at, carried ? 0 : def->heading, def->pitch, def->roll)
                               : bt__turned (at, 0, 0, 0);
}

/* ---- A shape of each kind ---- */

static bt_status
draw_box (const bt_obstacle_def *def, bt__obstacle *out)
{
  out->kind = BT__OBSTACLE_BOX;
  out->shape.box = (bt__box){ drawing_frame (def), bt__scale (0.5, def->size) };
  return BT_OK;
}

static bt_status
draw_sphere (const bt_obstacle_def *def, bt__obstacle *out)
{
  out->kind = BT__OBSTACLE_SPHERE;
  out->shape.sphere = (bt__sphere){ drawing_frame (def).origin, def->radius };
  return BT_OK;
}

/* The axis, about its middle when it is carried.  */
static bt_status
draw_round (const bt_obstacle_def *def, bt__obstacle *out, bt_error *error)
{
  double length = bt__distance (def->from, def->to);
  bt_vec3 middle = bt__scale (0.5, bt__add (def->from, def->to));
  bt_vec3 shift = bt__is_carried (def) ? middle : bt__vec (0, 0, 0);
  if (!(length > 1e-9 * def->radius))
    return bt__fail (error, BT_ERR_DEF,
                     "its axis goes from (%g %g %g) to the same point: it has no length",
                     def->from.x, def->from.y, def->from.z);
  if (def->kind == BT_OBSTACLE_CAPSULE)
    {
      out->kind = BT__OBSTACLE_CAPSULE;
      out->shape.capsule
          = (bt__capsule){ bt__sub (def->from, shift), bt__sub (def->to, shift), def->radius };
      return BT_OK;
    }
  out->kind = BT__OBSTACLE_CYLINDER;
  out->shape.cylinder = (bt__cylinder){ bt__sub (middle, shift),
                                        bt__scale (1 / length, bt__sub (def->to, def->from)),
                                        length / 2, def->radius };
  return BT_OK;
}

/* Copy N points, each SCALE times as far from the origin, drawn in FRAME.  */
static bt_vec3 *
drawn_points (const bt__frame *frame, double scale, const bt_vec3 *p, size_t n)
{
  bt_vec3 *out = malloc (n * sizeof *out + 1);
  for (size_t i = 0; out && i < n; i++)
    out[i] = bt__to_world (frame, bt__scale (scale, p[i]));
  return out;
}

static bt_status
no_memory (size_t n, bt_error *error)
{
  return bt__fail (error, BT_ERR_LIMIT, "no memory for its %zu points", n);
}

static bt_status
draw_convex (const bt_obstacle_def *def, bt__obstacle *out, bt_error *error)
{
  bt__frame frame = drawing_frame (def);
  bt_vec3 *p;
  bt_status status;
  if (def->points.n < 4)
    return bt__fail (error, BT_ERR_DEF, "a solid has four points or more, not %zu", def->points.n);
  p = drawn_points (&frame, 1, (const bt_vec3 *)(const void *)def->points.at, def->points.n);
  if (!p)
    return no_memory (def->points.n, error);
  out->kind = BT__OBSTACLE_CONVEX;
  status = bt__hull_new (p, (int)def->points.n, &out->shape.hull, error);
  free (p);
  return status;
}

static bt_status
draw_mesh (const bt_obstacle_def *def, bt__asker *asker, bt__obstacle *out, bt_error *error)
{
  const bt_triangles *mesh = &def->mesh;
  bt__frame frame = drawing_frame (def);
  bt_vec3 *p = drawn_points (&frame, def->kind == BT_OBSTACLE_MESH ? def->scale : 1, mesh->vertex,
                             mesh->vertices);
  bt__soup soup
      = { (uint32_t)mesh->vertices, (uint32_t)mesh->triangles, p, mesh->corner, mesh->id, 0 };
  bt_status status;
  if (!p)
    return no_memory (mesh->vertices, error);
  out->kind = BT__OBSTACLE_MESH;
  status = bt__mesh_new (&soup, NULL, asker, &out->shape.mesh, error);
  free (p);
  return status;
}

static bt_status
draw_grid (const bt_obstacle_def *def, bt__asker *asker, bt__obstacle *out, bt_error *error)
{
  const bt_heights *h = &def->grid;
  bt__grid grid = { (uint32_t)h->nx, (uint32_t)h->ny, h->x, h->y, h->dx, h->dy, h->z };
  bt__place place = { def->at, 0, 1 };
  out->kind = BT__OBSTACLE_MESH;
  return bt__mesh_from_grid (&grid, &place, asker, &out->shape.mesh, error);
}

static bt_status
draw_seabed (const bt_obstacle_def *def, double depth, bt__asker *asker, bt__obstacle *out,
             bt_error *error)
{
  int of_grid = def->grid.z != NULL, of_mesh = def->mesh.triangles > 0;
  if (of_grid && of_mesh)
    return bt__fail (error, BT_ERR_DEF, "it has a grid and a mesh; one of them is enough");
  if (of_grid || of_mesh)
    return of_grid ? draw_grid (def, asker, out, error) : draw_mesh (def, asker, out, error);
  if (bt__norm (def->at) > 0)
    return bt__fail (error, BT_ERR_DEF,
                     "it is level, at the depth of the sea: `at' is for a grid or a mesh");
  out->kind = BT__OBSTACLE_PLANE;
  out->shape.plane = (bt__plane){ { 0, 0, 1 }, -depth };
  return BT_OK;
}

static bt_status
draw (const bt_obstacle_def *def, double depth, bt__asker *asker, bt__obstacle *out,
      bt_error *error)
{
  switch (def->kind)
    {
    case BT_OBSTACLE_SEABED:
      return draw_seabed (def, depth, asker, out, error);
    case BT_OBSTACLE_BOX:
      return draw_box (def, out);
    case BT_OBSTACLE_SPHERE:
      return draw_sphere (def, out);
    case BT_OBSTACLE_CONVEX:
      return draw_convex (def, out, error);
    case BT_OBSTACLE_MESH:
      return draw_mesh (def, asker, out, error);
    default:
      return draw_round (def, out, error);
    }
}

void
bt__free_shape (bt__obstacle *shape)
{
  if (shape->kind == BT__OBSTACLE_CONVEX)
    bt__hull_free (shape->shape.hull);
  else if (shape->kind == BT__OBSTACLE_MESH)
    bt__mesh_free (shape->shape.mesh);
}

/* No scene is larger than the sea.  */
static bt_status
check_extent (const bt__obstacle *shape, bt_error *error)
{
  bt__aabb b = bt__obstacle_box (shape);
  double far = fmax (bt__largest (b.lo), bt__largest (b.hi));
  if (shape->kind == BT__OBSTACLE_PLANE || far <= 2 * FAR)
    return BT_OK;
  return bt__fail (error, BT_ERR_DOMAIN, "it reaches %g m from the origin; %g m is the limit", far,
                   2 * FAR);
}

bt_status
bt__draw_obstacle (bt_obstacle_def *def, int i, double depth, bt__asker *asker, bt__obstacle *out,
                   bt_error *error)
{
  const bt_head *head = bt_obstacle_head (def->kind);
  bt_error here;
  bt_status status;
  memset (out, 0, sizeof *out);
  if (!head)
    return bt__fail (error, BT_ERR_DEF, "there is no kind of obstacle number %d", (int)def->kind);
  status = bt__check_name (head->name, def->name, error);
  if (status == BT_OK)
    status = bt__check_def (head, def->name, def, error);
  if (status != BT_OK)
    return status;
  out->id = (uint32_t)i;
  out->friction = isnan (def->friction) ? 0 : def->friction;
  status = draw (def, depth, asker, out, &here);
  if (status == BT_OK)
    status = check_extent (out, &here);
  if (status == BT_OK)
    return BT_OK;
  bt__free_shape (out);
  memset (out, 0, sizeof *out);
  return bt__about (head->name, def->name, error, &here);
}
