/* Compile the obstacles of a world.

   All standing obstacles become a single scene with a tree over the obstacles; each kinematic
   obstacle gets a scene in the obstacle's own frame, a track, and the radius of a ball about the
   origin of the frame.  A bed from a grid or a mesh has an edge and perhaps holes, so a level floor
   at the depth of the sea, or 1 m below the lowest point of the bed, goes with it; bed and floor
   count as one obstacle. where[i] is the place of obstacle i in the scene, or -1 - k for kinematic
   obstacle k.

   Memory borrowed by definitions (points, meshes, grids, tracks) is copied, and the pointers of the
   copied definitions are cleared.  Limits hold for each obstacle and for the sum of triangles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "model/compile.h"

/* ---- What is carried ---- */

/* The radius of the ball about the origin that holds SHAPE, a hair more.  */
static double
ball_about (const bt__obstacle *shape)
{
  bt__aabb b = bt__obstacle_box (shape);
  bt_vec3 far = bt__vec (fmax (fabs (b.lo.x), fabs (b.hi.x)), fmax (fabs (b.lo.y), fabs (b.hi.y)),
                         fmax (fabs (b.lo.z), fabs (b.hi.z)));
  double r = bt__norm (far);
  if (shape->kind == BT__OBSTACLE_SPHERE)
    r = shape->shape.sphere.radius;
  else if (shape->kind == BT__OBSTACLE_BOX)
    r = bt__norm (shape->shape.box.half);
  else if (shape->kind == BT__OBSTACLE_CYLINDER)
    r = hypot (shape->shape.cylinder.half, shape->shape.cylinder.radius);
  else if (shape->kind == BT__OBSTACLE_CAPSULE)
    r = bt__norm (shape->shape.capsule.a) + shape->shape.capsule.radius;
  return r * (1 + 1e-9);
}

/* Copy the track of DEF; a row without a heading keeps the obstacle's own.  */
static bt_status
copy_track (const bt_obstacle_def *def, bt__carried *out, bt_error *error)
{
  size_t n = def->track.n;
  double own = bt__has_heading (def) ? def->heading : 0;
  out->row = malloc (n * sizeof *out->row);
  if (!out->row)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a track of %zu rows", n);
  memcpy (out->row, def->track.at, n * sizeof *out->row);
  for (size_t k = 0; k < n; k++)
    if (isnan (out->row[k][4]))
      out->row[k][4] = own;
  out->n = (int)n;
  return BT_OK;
}

/* Take over SHAPE, number I, also on failure.  */
static bt_status
add_carried (bt_model *model, const bt_obstacle_def *def, int i, bt__obstacle *shape,
             bt_error *error)
{
  int k = model->n_carried;
  bt__carried *out = &model->carried[k];
  bt_status status = bt__scene_new (shape, 1, 0, &out->body, error);
  if (status != BT_OK)
    {
      bt__free_shape (shape);
      return status;
    }
  model->n_carried++;
  out->obstacle = i;
  out->radius = ball_about (shape);
  model->where[i] = -1 - k;
  return copy_track (def, out, error);
}

/* ---- All of them ---- */

/* The triangles of DEF; 0 for an obstacle too large by itself, refused elsewhere.  */
static size_t
obstacle_triangles (const bt_obstacle_def *def)
{
  const bt_heights *grid = &def->grid;
  int of_grid = def->kind == BT_OBSTACLE_SEABED && grid->z && grid->ny > 0;
  if (of_grid)
    return grid->nx <= BT_POSTS_MAX / grid->ny ? 2 * grid->nx * grid->ny : 0;
  if (def->kind != BT_OBSTACLE_MESH && def->kind != BT_OBSTACLE_SEABED)
    return 0;
  return def->mesh.triangles <= BT_TRIANGLES_MAX ? def->mesh.triangles : 0;
}

/* Check the sum over all obstacles: each is within its own limit, but they share one memory.  */
static bt_status
check_triangles (const bt_world *world, bt_error *error)
{
  size_t n = 0;
  for (int i = 0; i < world->n_obstacles; i++)
    n += obstacle_triangles (&world->obstacles[i]);
  if (n <= BT_TRIANGLES_MAX)
    return BT_OK;
  return bt__fail (error, BT_ERR_LIMIT,
                   "the meshes and grids of a world have at most %d triangles together, two for a "
                   "post of a grid; a coarser `spacing' or mesh has fewer",
                   BT_TRIANGLES_MAX);
}

static bt_status
check_obstacle_counts (const bt_world *world, bt_error *error)
{
  int seabeds = 0;
  if (world->n_obstacles < 0 || world->n_obstacles > BT_OBSTACLES_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a world has at most %d obstacles, not %d",
                     BT_OBSTACLES_MAX, world->n_obstacles);
  for (int i = 0; i < world->n_obstacles; i++)
    seabeds += world->obstacles[i].kind == BT_OBSTACLE_SEABED;
  if (seabeds > 1)
    return bt__fail (error, BT_ERR_DEF, "a world has one seabed, not %d", seabeds);
  return check_triangles (world, error);
}

/* Clear the pointers to borrowed memory, copied into scenes and tracks by now.  An obstacle with an
   axis gets its middle as its place.  */
static void
forget_borrowed (bt_obstacle_def *def)
{
  if (bt__has_axis (def))
    def->at = bt__scale (0.5, bt__add (def->from, def->to));
  memset (&def->points, 0, sizeof def->points);
  memset (&def->mesh, 0, sizeof def->mesh);
  memset (&def->grid, 0, sizeof def->grid);
  memset (&def->track, 0, sizeof def->track);
}

#define BELOW_BED 1.0 /* m: a bed and the bottom about it never touch a line at once */

/* A bed from a grid or a mesh has an edge and perhaps holes.  Put into *OUT the level floor beyond
   edge and holes, at the depth of the sea or below the lowest point of the bed.  Return false if
   the bed needs no floor.  */
static int
floor_about (const bt_obstacle_def *def, const bt__obstacle *bed, double depth, bt__obstacle *out)
{
  if (def->kind != BT_OBSTACLE_SEABED || bed->kind == BT__OBSTACLE_PLANE)
    return 0;
  double level = fmin (-depth, bt__obstacle_box (bed).lo.z - BELOW_BED);
  *out = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE,
                         .id = bed->id,
                         .friction = bed->friction,
                         .shape.plane = { { 0, 0, 1 }, level } };
  return 1;
}

static double
lowest_of (const bt__obstacle *shape)
{
  return shape->kind == BT__OBSTACLE_PLANE ? shape->shape.plane.offset
                                           : bt__obstacle_box (shape).lo.z;
}

/* Draw every obstacle; those that stand still into STILL, *N of them, the floor last.  */
static bt_status
draw_all (bt_model *model, bt__obstacle *still, uint32_t *n, bt_error *error)
{
  bt_status status = BT_OK;
  bt__obstacle bottom;
  for (int i = 0; status == BT_OK && i < model->n_obstacles; i++)
    {
      bt_obstacle_def *def = &model->obstacles[i];
      bt__obstacle shape;
      status = bt__draw_obstacle (def, i, model->sea.depth, model->asker, &shape, error);
      if (status == BT_OK && bt__is_carried (def))
        status = add_carried (model, def, i, &shape, error);
      else if (status == BT_OK)
        {
          model->where[i] = (int)*n;
          still[(*n)++] = shape;
          model->n_floors |= floor_about (def, &shape, model->sea.depth, &bottom);
        }
      forget_borrowed (def);
    }
  if (status == BT_OK && model->n_floors)
    still[(*n)++] = bottom;
  model->lowest = INFINITY;
  for (uint32_t i = 0; i < *n; i++)
    model->lowest = fmin (model->lowest, lowest_of (&still[i]));
  return status;
}

static bt_status
compile_still (bt_model *model, bt__obstacle *still, bt_error *error)
{
  uint32_t n = 0;
  bt_status status = draw_all (model, still, &n, error);
  if (status == BT_OK)
    status = bt__scene_new (still, n, 0, &model->scene, error);
  for (uint32_t i = 0; status != BT_OK && i < n; i++)
    bt__free_shape (&still[i]);
  return status;
}

bt_status
bt__compile_obstacles (bt_model *model, const bt_world *world, bt_error *error)
{
  size_t n = (size_t)world->n_obstacles;
  bt__obstacle *still;
  bt_status status = check_obstacle_counts (world, error);
  if (status != BT_OK)
    return status;
  if (n == 0)
    return bt__scene_new (NULL, 0, 0, &model->scene, error);
  still = malloc ((n + 1) * sizeof *still); /* and a floor */
  model->obstacles = malloc (n * sizeof *model->obstacles);
  model->where = calloc (n, sizeof *model->where);
  model->carried = calloc (n, sizeof *model->carried);
  if (still && model->obstacles && model->where && model->carried)
    {
      model->n_obstacles = world->n_obstacles;
      memcpy (model->obstacles, world->obstacles, n * sizeof *model->obstacles);
      status = compile_still (model, still, error);
    }
  else
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for %zu obstacles", n);
  free (still);
  return status;
}

void
bt__release_obstacles (bt_model *model)
{
  for (int k = 0; k < model->n_carried; k++)
    {
      bt__scene_free (model->carried[k].body);
      free (model->carried[k].row);
    }
  bt__scene_free (model->scene);
  free (model->carried);
  free (model->where);
  free (model->obstacles);
}

void
bt__number_scenes (bt_model *model)
{
  model->scene->serial = model->id;
  for (int k = 0; k < model->n_carried; k++)
    model->carried[k].body->serial = model->id + 1 + (uint64_t)k;
  for (int v = 0; v < model->n_hulls; v++)
    if (model->hull[v])
      model->hull[v]->serial = model->id + 1 + (uint64_t)(model->n_carried + v);
}

/* ---- Identity ---- */

#define NUMBERS (offsetof (bt_obstacle_def, points) - offsetof (bt_obstacle_def, at))
_Static_assert(NUMBERS == 19 * sizeof (double), "no padding among an obstacle's numbers");

static uint64_t
hash_rows (const bt_rows *rows, uint64_t h)
{
  h = bt__hash (&rows->n, sizeof rows->n, h);
  return rows->at ? bt__hash (rows->at, rows->n * rows->width * sizeof *rows->at, h) : h;
}

static uint64_t
hash_mesh (const bt_triangles *mesh, uint64_t h)
{
  h = bt__hash (&mesh->triangles, sizeof mesh->triangles, h);
  if (!mesh->vertex || !mesh->corner)
    return h;
  h = bt__hash (mesh->vertex, mesh->vertices * sizeof *mesh->vertex, h);
  h = bt__hash (mesh->corner, mesh->triangles * sizeof *mesh->corner, h);
  return mesh->id ? bt__hash (mesh->id, mesh->triangles * sizeof *mesh->id, h) : h;
}

static uint64_t
hash_grid (const bt_heights *grid, uint64_t h)
{
  double where[4] = { grid->x, grid->y, grid->dx, grid->dy };
  size_t posts[2] = { grid->nx, grid->ny };
  if (!grid->z)
    return h;
  h = bt__hash (posts, sizeof posts, bt__hash (where, sizeof where, h));
  return bt__hash (grid->z, grid->nx * grid->ny * sizeof *grid->z, h);
}

/* What its kind does not know of is not looked at.  */
static uint64_t
hash_obstacle (const bt_obstacle_def *def, uint64_t h)
{
  int64_t kind = def->kind;
  h = bt__hash (def->name, BT_NAME_SIZE, bt__hash (&kind, sizeof kind, h));
  h = bt__hash (&def->at, NUMBERS, h);
  if (def->kind == BT_OBSTACLE_CONVEX)
    h = hash_rows (&def->points, h);
  if (def->kind == BT_OBSTACLE_MESH || def->kind == BT_OBSTACLE_SEABED)
    h = hash_mesh (&def->mesh, h);
  if (def->kind == BT_OBSTACLE_SEABED)
    h = hash_grid (&def->grid, h);
  return bt__is_carried (def) ? hash_rows (&def->track, h) : h;
}

uint64_t
bt__hash_obstacles (const bt_world *world, uint64_t h)
{
  for (int i = 0; i < world->n_obstacles; i++)
    h = hash_obstacle (&world->obstacles[i], h);
  return h;
}

/* ---- Which kind ---- */

const bt_head *
bt_obstacle_head (bt_obstacle_kind kind)
{
  size_t n;
  const bt_head *heads = bt_heads (&n);
  for (size_t i = 0; i < n; i++)
    if (heads[i].obstacle >= 0 && heads[i].obstacle == (int)kind)
      return &heads[i];
  return NULL;
}
