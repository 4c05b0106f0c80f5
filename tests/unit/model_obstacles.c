/* Obstacles in a model: what the validator lets through and what it refuses, that everything is
   copied, that the id knows every number, where what is carried is, and that a line is laid clear.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/obstacle.h>

#include "model/model.h"

/* ---- Refusing allocations ---- */

#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__
#define CAN_REFUSE 1

void *__libc_malloc (size_t);
void *__libc_calloc (size_t, size_t);

static long allocations;  /* since it was last set to 0 */
static long fail_at = -1; /* the allocation of this number is refused; -1: none */

void *
malloc (size_t n)
{
  return allocations++ == fail_at ? NULL : __libc_malloc (n);
}

void *
calloc (size_t n, size_t size)
{
  return allocations++ == fail_at ? NULL : __libc_calloc (n, size);
}
#endif

#define COUNT_OF(array) (sizeof (array) / sizeof *(array))

/* ---- Making worlds ---- */

enum
{
  ROOM = 8
};

typedef struct stage
{
  bt_world world;
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_obstacle_def obstacle[ROOM];
} stage;

/* A vehicle at (10 0 -5) on a tether from (0 0 -5), 12 m long, in a sea 50 m deep.  */
static stage *
new_stage (void)
{
  stage *s = calloc (1, sizeof *s);
  assert_non_null (s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  bt_def_init (bt_head_find ("rov"), &s->vehicle);
  bt_def_init (bt_head_find ("tether"), &s->tether);
  s->world.sea.depth = 50;
  bt_def_set_name (s->vehicle.name, "minnow", NULL);
  s->vehicle.at = (bt_vec3){ 10, 0, -5 };
  bt_def_set_name (s->tether.name, "line", NULL);
  s->tether.from.at = (bt_vec3){ 0, 0, -5 };
  bt_def_set_name (s->tether.to.part, "minnow", NULL);
  s->tether.length = 12;
  s->tether.props.diameter = 0.1;
  s->world.vehicles = &s->vehicle;
  s->world.n_vehicles = 1;
  s->world.tethers = &s->tether;
  s->world.n_tethers = 1;
  s->world.obstacles = s->obstacle;
  return s;
}

static bt_obstacle_def *
add (stage *s, const char *head, const char *name)
{
  bt_obstacle_def *def = &s->obstacle[s->world.n_obstacles++];
  assert_true (s->world.n_obstacles <= ROOM);
  bt_def_init (bt_head_find (head), def);
  assert_int_equal (bt_def_set_name (def->name, name, NULL), BT_OK);
  return def;
}

static bt_obstacle_def *
add_box (stage *s, const char *name, bt_vec3 at, bt_vec3 size)
{
  bt_obstacle_def *def = add (s, "box", name);
  def->at = at;
  def->size = size;
  return def;
}

static bt_obstacle_def *
add_sphere (stage *s, const char *name, bt_vec3 at, double radius)
{
  bt_obstacle_def *def = add (s, "sphere", name);
  def->at = at;
  def->radius = radius;
  return def;
}

static bt_obstacle_def *
add_round (stage *s, const char *head, const char *name, bt_vec3 from, bt_vec3 to, double radius)
{
  bt_obstacle_def *def = add (s, head, name);
  def->from = from;
  def->to = to;
  def->radius = radius;
  return def;
}

static const double corner_points[][3]
    = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 0.1, 0.1, 0.1 } };
static const double flat_points[][3] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 1, 1, 0 } };
static const bt_vec3 square[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
static const uint32_t square_corner[][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

static bt_rows
rows_of (const double (*p)[3], size_t n)
{
  return (bt_rows){ p[0], n, 3 };
}

static bt_triangles
square_mesh (void)
{
  return (bt_triangles){ square, 4, square_corner, 2, NULL };
}

static bt_model *
compile (const stage *s)
{
  bt_model *model = NULL;
  bt_error error = { 0 };
  if (bt_model_new (&s->world, &model, &error) != BT_OK)
    fail_msg ("%s", error.text);
  return model;
}

/* Compile, release, free.  */
static void
taken (stage *s)
{
  bt_model_release (compile (s));
  free (s);
}

/* Nothing comes of it but STATUS and a sentence with both words in it.  */
static void
refused (stage *s, bt_status status, const char *one, const char *other)
{
  bt_model *model = NULL;
  bt_error error = { 0 };
  bt_status got = bt_model_new (&s->world, &model, &error);
  if (got != status || model || !strstr (error.text, one) || !strstr (error.text, other))
    fail_msg ("expected %s, `%s' and `%s'; got %s: %s", bt_status_name (status), one, other,
              bt_status_name (got), error.text);
  free (s);
}

static double
distance_to (const bt_model *model, bt_vec3 a, bt_vec3 b)
{
  bt__link link = { a, b };
  bt__count count = { 0 };
  bt__near near;
  return bt__scene_nearest (model->scene, NULL, &link, 1e6, &near, &count) ? near.w.distance
                                                                           : INFINITY;
}

static void
assert_point (bt_vec3 p, bt_vec3 q, double within)
{
  if (!(bt__distance (p, q) <= within))
    fail_msg ("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", p.x, p.y, p.z, q.x, q.y, q.z);
}

/* ---- What is there ---- */

static void
no_obstacles_no_scene (void **state)
{
  stage *s = new_stage ();
  bt_model *model = compile (s);
  (void)state;
  assert_int_equal (model->scene->n, 0);
  assert_null (model->obstacles);
  assert_null (model->where);
  assert_null (model->carried);
  assert_int_equal (model->n_obstacles, 0);
  assert_int_equal (bt__model_obstacle (model, "minnow"), BT__NO_OBSTACLE);
  bt_model_release (model);
  free (s);
}

/* One of each kind, in every order of still and carried.  */
static stage *
one_of_each (void)
{
  static const double track[][5] = { { 0, 0, 50, -5, 0 }, { 10, 10, 50, -5, 90 } };
  stage *s = new_stage ();
  bt_obstacle_def *def;
  add (s, "seabed", "bottom");
  add_box (s, "manifold", (bt_vec3){ 0, 30, -10 }, (bt_vec3){ 4, 2, 1 });
  add_sphere (s, "buoy", (bt_vec3){ 0, 0, 0 }, 0.5)->track = (bt_rows){ track[0], 2, 5 };
  add_round (s, "cylinder", "leg", (bt_vec3){ 20, 20, 0 }, (bt_vec3){ 20, 20, -50 }, 0.6);
  add_round (s, "capsule", "brace", (bt_vec3){ -20, 20, 0 }, (bt_vec3){ -20, 30, 0 }, 0.25);
  def = add (s, "convex", "anode");
  def->points = rows_of (corner_points, 5);
  def->at = (bt_vec3){ 100, 0, -5 };
  def = add (s, "mesh", "wreck");
  def->mesh = square_mesh ();
  def->at = (bt_vec3){ 0, -100, -5 };
  def->scale = 3;
  return s;
}

/* The box about obstacle I at the time T; without end for a level seabed.  */
static bt__aabb
box_at (const bt_model *model, int i, double t)
{
  const bt__obstacle *shape = bt__model_shape (model, i);
  int k = bt__model_carried (model, i);
  bt__frame frame;
  if (k < 0)
    return bt__obstacle_box (shape);
  frame = bt__carried_frame (model, k, t);
  return bt__framed_box (shape, &frame);
}

static void
every_kind (void **state)
{
  static const bt__obstacle_kind kinds[]
      = { BT__OBSTACLE_PLANE,   BT__OBSTACLE_BOX,    BT__OBSTACLE_SPHERE, BT__OBSTACLE_CYLINDER,
          BT__OBSTACLE_CAPSULE, BT__OBSTACLE_CONVEX, BT__OBSTACLE_MESH };
  stage *s = one_of_each ();
  bt_model *model = compile (s);
  (void)state;
  assert_int_equal (model->n_obstacles, 7);
  assert_int_equal (model->scene->n, 6);
  assert_int_equal (model->n_carried, 1);
  for (int i = 0; i < 7; i++)
    {
      assert_int_equal (bt__model_obstacle (model, s->obstacle[i].name), i);
      assert_int_equal (bt__model_shape (model, i)->kind, kinds[i]);
      assert_int_equal (bt__model_shape (model, i)->id, i);
      assert_int_equal (bt__model_carried (model, i), i == 2 ? 0 : -1);
    }
  assert_int_equal (bt__model_obstacle (model, "no-such"), BT__NO_OBSTACLE);
  assert_int_equal (bt__model_obstacle (model, "manifol"), BT__NO_OBSTACLE);
  /* The level bottom, and the mesh three times as large.  */
  assert_float_equal (distance_to (model, (bt_vec3){ 500, 500, -40 }, (bt_vec3){ 500, 501, -40 }),
                      10, 1e-12);
  bt__aabb box = box_at (model, 6, 0);
  assert_point (box.lo, (bt_vec3){ 0, -100, -5 }, 0);
  assert_point (box.hi, (bt_vec3){ 3, -97, -5 }, 1e-12);
  assert_true (isinf (box_at (model, 0, 0).hi.x));
  bt_model_release (model);
  free (s);
}

/* A box turned by heading, pitch and roll is where its axes are said to be.  */
static void
turned_axes (void **state)
{
  bt_vec3 at = { 1, 2, 3 };
  bt__frame f = bt__turned (at, 90, 0, 0);
  (void)state;
  assert_point (f.y, (bt_vec3){ 1, 0, 0 }, 0); /* its front looks east */
  assert_point (f.x, (bt_vec3){ 0, -1, 0 }, 0);
  assert_point (f.origin, at, 0);
  f = bt__turned (at, 0, 30, 0);
  assert_float_equal (f.y.z, 0.5, 1e-15); /* bow up */
  f = bt__turned (at, 0, 0, 30);
  assert_float_equal (f.x.z, -0.5, 1e-15); /* starboard down */
  for (int i = 0; i < 200; i++)
    {
      f = bt__turned (at, 17.3 * i, 90 - 1.1 * i, 3.7 * i);
      assert_point (bt__cross (f.x, f.y), f.z, 1e-14);
      assert_float_equal (bt__norm (f.x), 1, 1e-14);
      assert_float_equal (bt__dot (f.x, f.y), 0, 1e-14);
      /* The front points where heading and pitch say.  */
      double h = 17.3 * i * (BT__PI / 180), p = (90 - 1.1 * i) * (BT__PI / 180);
      assert_point (f.y, (bt_vec3){ sin (h) * cos (p), cos (h) * cos (p), sin (p) }, 1e-12);
    }
}

/* Distances to a turned box are those of the line, turned back, to an upright one.  */
static void
turned_box_distances (void **state)
{
  stage *s = new_stage ();
  bt_obstacle_def *def = add_box (s, "box", (bt_vec3){ 40, 5, -20 }, (bt_vec3){ 4, 2, 1 });
  bt_model *model;
  bt__frame f;
  bt__box upright = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 2, 1, 0.5 } };
  (void)state;
  def->heading = 30;
  def->pitch = 20;
  def->roll = -40;
  model = compile (s);
  f = bt__turned (def->at, 30, 20, -40);
  for (int i = 0; i < 500; i++)
    {
      bt_vec3 a = { 40 + 6 * sin (i * 1.7), 5 + 6 * cos (i * 2.3), -20 + 6 * sin (i * 0.9) };
      bt_vec3 b = { 40 + 6 * sin (i * 3.1), 5 + 6 * cos (i * 0.7), -20 + 6 * sin (i * 1.3) };
      bt__link own = { bt__to_local (&f, a), bt__to_local (&f, b) };
      bt__witness w;
      bt__pair_box (&upright, &own, &w);
      assert_float_equal (distance_to (model, a, b), w.distance, 1e-12);
    }
  bt_model_release (model);
  free (s);
}

/* ---- Refusals ---- */

static void
bad_numbers (void **state)
{
  static const double bad[] = { 0, -1, NAN, INFINITY, 2e7 };
  (void)state;
  for (size_t i = 0; i < COUNT_OF (bad); i++)
    {
      stage *s = new_stage ();
      add_sphere (s, "ball", (bt_vec3){ 0, 30, 0 }, bad[i]);
      refused (s, BT_ERR_DOMAIN, "`ball'", "radius");
      s = new_stage ();
      add_box (s, "crate", (bt_vec3){ 0, 30, 0 }, (bt_vec3){ 1, bad[i], 1 });
      refused (s, BT_ERR_DOMAIN, "`crate'", "size");
      s = new_stage ();
      add_round (s, "capsule", "pipe", (bt_vec3){ 0, 30, 0 }, (bt_vec3){ 0, 40, 0 }, bad[i]);
      refused (s, BT_ERR_DOMAIN, "`pipe'", "radius");
      s = new_stage ();
      add (s, "mesh", "wreck")->mesh = square_mesh ();
      s->obstacle[0].scale = bad[i];
      refused (s, BT_ERR_DOMAIN, "`wreck'", "scale");
      if (i < 2)
        continue;
      s = new_stage ();
      add_sphere (s, "ball", (bt_vec3){ 0, bad[i], 0 }, 1);
      refused (s, BT_ERR_DOMAIN, "`ball'", "`at'");
    }
  stage *s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 30, 0 }, 1)->friction = -0.1;
  refused (s, BT_ERR_DOMAIN, "`ball'", "friction");
}

static void
bad_shapes (void **state)
{
  static const bt_vec3 nan_vertex[] = { { 0, 0, 0 }, { 1, NAN, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  static const uint32_t wild_corner[][3] = { { 0, 1, 2 }, { 0, 2, 4 } };
  bt_vec3 p = { 0, 30, -5 };
  stage *s = new_stage ();
  (void)state;
  add_round (s, "cylinder", "leg", p, p, 1);
  refused (s, BT_ERR_DEF, "`leg'", "no length");
  s = new_stage ();
  add_round (s, "capsule", "leg", p, p, 1);
  refused (s, BT_ERR_DEF, "`leg'", "no length");
  s = new_stage ();
  add (s, "convex", "anode")->points = rows_of (corner_points, 3);
  refused (s, BT_ERR_DEF, "`anode'", "four points");
  s = new_stage ();
  add (s, "convex", "anode");
  refused (s, BT_ERR_DEF, "`anode'", "four points");
  s = new_stage ();
  add (s, "convex", "anode")->points = rows_of (flat_points, 4);
  refused (s, BT_ERR_DOMAIN, "`anode'", "plane");
  s = new_stage ();
  add (s, "mesh", "wreck");
  refused (s, BT_ERR_DOMAIN, "`wreck'", "empty");
  s = new_stage ();
  add (s, "mesh", "wreck")->mesh = (bt_triangles){ nan_vertex, 4, square_corner, 2, NULL };
  refused (s, BT_ERR_DOMAIN, "`wreck'", "vertex 1");
  s = new_stage ();
  add (s, "mesh", "wreck")->mesh = (bt_triangles){ square, 4, wild_corner, 2, NULL };
  refused (s, BT_ERR_DOMAIN, "`wreck'", "corner 4");
  s = new_stage ();
  add (s, "mesh", "wreck")->mesh
      = (bt_triangles){ square, 4, square_corner, (size_t)BT_TRIANGLES_MAX + 1, NULL };
  refused (s, BT_ERR_LIMIT, "`wreck'", "at most");
  s = new_stage ();
  add (s, "mesh", "wreck")->mesh = (bt_triangles){ NULL, 4, NULL, 2, NULL };
  refused (s, BT_ERR_DOMAIN, "`wreck'", "no vertices");
}

static void
bad_seabeds (void **state)
{
  static const double z[] = { -40, -41, -42, -43 }, wild[] = { -40, -41, INFINITY, -43 };
  stage *s = new_stage ();
  (void)state;
  add (s, "seabed", "one");
  add (s, "seabed", "two");
  refused (s, BT_ERR_DEF, "one seabed", "2");
  s = new_stage ();
  add (s, "seabed", "bottom")->at = (bt_vec3){ 0, 0, -5 };
  refused (s, BT_ERR_DEF, "`bottom'", "level");
  s = new_stage ();
  add (s, "seabed", "bottom")->grid = (bt_heights){ z, 2, 2, 0, 0, 1, 1 };
  s->obstacle[0].mesh = square_mesh ();
  refused (s, BT_ERR_DEF, "`bottom'", "a grid and a mesh");
  s = new_stage ();
  add (s, "seabed", "bottom")->grid = (bt_heights){ wild, 2, 2, 0, 0, 1, 1 };
  refused (s, BT_ERR_DOMAIN, "`bottom'", "post 0 east, 1 north");
  s = new_stage ();
  add (s, "seabed", "bottom")->grid = (bt_heights){ z, 1, 4, 0, 0, 1, 1 };
  refused (s, BT_ERR_DOMAIN, "`bottom'", "1 by 4 posts");
  s = new_stage ();
  add (s, "seabed", "bottom")->grid = (bt_heights){ z, 2, 2, 0, 0, 1, 0 };
  refused (s, BT_ERR_DOMAIN, "`bottom'", "apart");
  s = new_stage ();
  add (s, "seabed", "bottom")->grid = (bt_heights){ z, (size_t)-1, 2, 0, 0, 1, 1 };
  refused (s, BT_ERR_LIMIT, "`bottom'", "at most");
}

static void
bad_tracks (void **state)
{
  static const double back[][5] = { { 0, 0, 30, 0, 0 }, { 0, 1, 30, 0, 0 } };
  static const double wild[][5] = { { 0, 0, 30, 0, 0 }, { 1, NAN, 30, 0, 0 } };
  static const double early[][5] = { { -1, 0, 30, 0, 0 } };
  static const double dizzy[][5] = { { 0, 0, 30, 0, INFINITY } };
  stage *s = new_stage ();
  (void)state;
  add_sphere (s, "ball", (bt_vec3){ 0, 0, 0 }, 1)->track = (bt_rows){ back[0], 2, 5 };
  refused (s, BT_ERR_DOMAIN, "`ball'", "not later");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 0, 0 }, 1)->track = (bt_rows){ wild[0], 2, 5 };
  refused (s, BT_ERR_DOMAIN, "`ball'", "row 2");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 0, 0 }, 1)->track = (bt_rows){ early[0], 1, 5 };
  refused (s, BT_ERR_DOMAIN, "`ball'", "row 1");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 0, 0 }, 1)->track = (bt_rows){ dizzy[0], 1, 5 };
  refused (s, BT_ERR_DOMAIN, "`ball'", "row 1");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 0, 0 }, 1)->track = (bt_rows){ back[0], 2, 3 };
  refused (s, BT_ERR_DOMAIN, "`ball'", "5 numbers");
}

static void
bad_names (void **state)
{
  stage *s = new_stage ();
  (void)state;
  add_sphere (s, "ball", (bt_vec3){ 0, 30, 0 }, 1);
  add_box (s, "ball", (bt_vec3){ 0, 60, 0 }, (bt_vec3){ 1, 1, 1 });
  refused (s, BT_ERR_DEF, "two parts", "`ball'");
  s = new_stage ();
  add_sphere (s, "minnow", (bt_vec3){ 0, 30, 0 }, 1);
  refused (s, BT_ERR_DEF, "two parts", "`minnow'");
  s = new_stage ();
  add_sphere (s, "line", (bt_vec3){ 0, 30, 0 }, 1);
  refused (s, BT_ERR_DEF, "two parts", "`line'");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 30, 0 }, 1)->name[0] = 0;
  refused (s, BT_ERR_DEF, "sphere", "name");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 30, 0 }, 1)->kind = (bt_obstacle_kind)99;
  refused (s, BT_ERR_DEF, "kind", "99");
  s = new_stage ();
  s->world.n_obstacles = BT_OBSTACLES_MAX + 1;
  refused (s, BT_ERR_LIMIT, "100000", "100001");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 30, 0 }, 1);
  bt_def_set_name (s->tether.from.part, "ball", NULL);
  refused (s, BT_ERR_DEF, "`line'", "an obstacle");
}

/* ---- Copies ---- */

/* A copy of N bytes that can be spoilt.  */
static void *
lent (const void *data, size_t n)
{
  void *copy = malloc (n);
  assert_non_null (copy);
  memcpy (copy, data, n);
  return copy;
}

static void
spoil (void *data, size_t n)
{
  memset (data, 0xa5, n);
  free (data);
}

static void
everything_is_copied (void **state)
{
  static const double z[] = { -40, -41, -42, -43 };
  static const double rows[][5] = { { 0, 0, 50, -5, 350 }, { 10, 10, 50, -5, 10 } };
  static const uint32_t numbers[] = { 70, 71 };
  bt_vec3 *vertex = lent (square, sizeof square);
  uint32_t (*corner)[3] = lent (square_corner, sizeof square_corner);
  uint32_t *id = lent (numbers, sizeof numbers);
  double *points = lent (corner_points, sizeof corner_points);
  double *heights = lent (z, sizeof z), *track = lent (rows, sizeof rows);
  stage *s = new_stage ();
  bt_obstacle_def *def = add (s, "seabed", "bottom");
  bt_model *model, *same;
  uint64_t before;
  (void)state;
  def->grid = (bt_heights){ heights, 2, 2, 100, 200, 10, 10 };
  def = add (s, "convex", "anode");
  def->points = (bt_rows){ points, 5, 3 };
  def->at = (bt_vec3){ 0, 300, 0 };
  def = add (s, "mesh", "wreck");
  def->mesh = (bt_triangles){ vertex, 4, (const uint32_t (*)[3])corner, 2, id };
  def->at = (bt_vec3){ 0, 0, 20 };
  add_sphere (s, "ball", (bt_vec3){ 0, 0, 0 }, 1)->track = (bt_rows){ track, 2, 5 };
  model = compile (s);
  same = compile (s);
  before = model->id;
  assert_true (model->id == same->id);
  spoil (vertex, sizeof square);
  spoil (corner, sizeof square_corner);
  spoil (id, sizeof numbers);
  spoil (points, sizeof corner_points);
  spoil (heights, sizeof z);
  spoil (track, sizeof rows);
  memset (s->obstacle, 0xa5, sizeof s->obstacle);
  assert_true (model->id == before);
  /* Above the slope of the grid, beside the hull, above the square.  */
  assert_float_equal (
      distance_to (model, (bt_vec3){ 105, 205, -39.5 }, (bt_vec3){ 105, 205, -39.5 }),
      2 * cos (atan (hypot (0.1, 0.2))), 1e-12);
  assert_float_equal (distance_to (model, (bt_vec3){ -1, 300, 0.1 }, (bt_vec3){ -1, 301, 0.1 }), 1,
                      1e-9);
  assert_float_equal (distance_to (model, (bt_vec3){ 0.6, 0.3, 25 }, (bt_vec3){ 0.6, 0.3, 26 }), 5,
                      1e-12);
  assert_int_equal (bt__model_shape (model, 2)->shape.mesh->id[0] / 2, 35);
  assert_point (bt__carried_frame (model, 0, 5).origin, (bt_vec3){ 5, 50, -5 }, 1e-12);
  bt_model_release (model);
  bt_model_release (same);
  free (s);
}

/* Whichever allocation fails, there is an error and no model; then there is one.  */
static void
memory_running_out (void **state)
{
  (void)state;
#ifdef CAN_REFUSE
  static const double z[] = { -40, -41, -42, -43 };
  stage *s = one_of_each ();
  bt_model *model = NULL;
  bt_error error;
  bt_status status = BT_ERR_LIMIT;
  long refusals = 0;
  s->obstacle[0].grid = (bt_heights){ z, 2, 2, 100, 200, 10, 10 };
  for (long k = 0; status != BT_OK; k++)
    {
      allocations = 0;
      fail_at = k;
      status = bt_model_new (&s->world, &model, &error);
      fail_at = -1;
      refusals += status != BT_OK;
      assert_true (status == BT_OK || !model);
      assert_true (k < 10000);
    }
  assert_true (refusals > 20);
  bt_model_release (model);
  free (s);
#else
  skip ();
#endif
}

/* ---- What a dive tells ---- */

static void
views (void **state)
{
  stage *s = one_of_each ();
  bt_model *model = compile (s);
  bt_dive *dive;
  bt_error error = { 0 };
  bt_obstacle_view v;
  bt_facet facet[8];
  double volume = 0;
  (void)state;
  if (bt_dive_new (model, NULL, NULL, &dive, &error) != BT_OK)
    fail_msg ("%s", error.text);
  assert_int_equal (bt_dive_count (dive, BT_PART_OBSTACLE), 7);
  assert_string_equal (bt_dive_name (dive, BT_PART_OBSTACLE, 3), "leg");
  assert_string_equal (bt_dive_name (dive, BT_PART_OBSTACLE, 7),
                       bt_dive_name (dive, BT_PART_TETHER, 0));
  assert_string_equal (bt_dive_name (dive, BT_PART_OBSTACLE, 8),
                       bt_dive_name (dive, BT_PART_VEHICLE, 0));
  assert_null (bt_dive_name (dive, BT_PART_OBSTACLE, 9));
  assert_int_equal (bt_dive_obstacle (dive, 7, &v, &error), BT_ERR_NAME);
  assert_int_equal (bt_dive_obstacle (dive, -1, &v, &error), BT_ERR_NAME);
  assert_int_equal (bt_dive_obstacle (dive, 3, &v, &error), BT_OK);
  assert_true (v.has_axis && v.kind == BT_OBSTACLE_CYLINDER && isnan (v.friction));
  assert_point (v.from, (bt_vec3){ 20, 20, 0 }, 1e-12);
  assert_point (v.to, (bt_vec3){ 20, 20, -50 }, 1e-12);
  assert_int_equal (bt_dive_obstacle (dive, 2, &v, &error), BT_OK);
  assert_true (v.moves && v.radius == 0.5);
  assert_point (v.centre, (bt_vec3){ 0, 50, -5 }, 1e-12);
  /* A hull's faces look outward: they enclose its volume, a tetrahedron's of sides 2, 2, 2.  */
  assert_int_equal (bt_dive_obstacle (dive, 5, &v, &error), BT_OK);
  assert_int_equal (v.triangles, 4);
  assert_int_equal (bt_obstacle_triangles (dive, 5, 0, 8, facet), 4);
  for (int k = 0; k < 4; k++)
    volume += bt__dot (bt__sub (facet[k].corner[0], v.centre),
                       bt__cross (bt__sub (facet[k].corner[1], v.centre),
                                  bt__sub (facet[k].corner[2], v.centre)))
              / 6;
  assert_float_equal (volume, 8.0 / 6, 1e-12);
  /* A mesh by pieces: each triangle once, by its own id.  */
  assert_int_equal (bt_obstacle_triangles (dive, 6, 0, 1, facet), 1);
  assert_int_equal (bt_obstacle_triangles (dive, 6, 1, 8, facet + 1), 1);
  assert_int_equal (bt_obstacle_triangles (dive, 6, 2, 8, facet), 0);
  assert_int_equal (facet[0].id + facet[1].id, 1);
  for (int k = 0; k < 2; k++)
    for (int j = 0; j < 3; j++)
      assert_point (
          facet[k].corner[j],
          bt__add ((bt_vec3){ 0, -100, -5 }, bt__scale (3, square[square_corner[facet[k].id][j]])),
          1e-12);
  assert_int_equal (bt_obstacle_triangles (dive, 1, 0, 8, facet), 0);
  assert_int_equal (bt_obstacle_triangles (dive, 99, 0, 8, facet), 0);
  bt_dive_free (dive);
  bt_model_release (model);
  free (s);
}

/* ---- Identity ---- */

static uint64_t
id_of (const stage *s)
{
  bt_model *model = compile (s);
  uint64_t id = model->id;
  bt_model_release (model);
  return id;
}

/* Change one thing of S after another; every id is another.  */
static void
identity_of_content (void **state)
{
  static const double other_points[][3]
      = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2.5 }, { 0.1, 0.1, 0.1 } };
  static const double other_track[][5] = { { 0, 0, 50, -5, 0 }, { 10, 10, 50, -5, 91 } };
  static const uint32_t other_corner[][3] = { { 0, 1, 2 }, { 0, 3, 2 } }, ids[] = { 5, 6 };
  static const bt_vec3 other_square[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0.5 }, { 0, 1, 0 } };
  uint64_t id[11];
  stage *s = one_of_each ();
  (void)state;
  id[0] = id_of (s);
  assert_true (id[0] == id_of (s));
  s->obstacle[1].friction = 0.5;
  id[1] = id_of (s);
  s->obstacle[1].size.x += 1e-9;
  id[2] = id_of (s);
  s->obstacle[5].points = rows_of (other_points, 5);
  id[3] = id_of (s);
  s->obstacle[2].track.at = other_track[0];
  id[4] = id_of (s);
  s->obstacle[6].mesh.corner = other_corner;
  id[5] = id_of (s);
  s->obstacle[6].mesh.vertex = other_square;
  id[6] = id_of (s);
  s->obstacle[6].mesh.id = ids;
  id[7] = id_of (s);
  s->obstacle[6].name[0] = 'W';
  id[8] = id_of (s);
  s->obstacle[4].kind = BT_OBSTACLE_CYLINDER;
  id[9] = id_of (s);
  s->tether.via = (bt_via){ 1, { { 5, 1, -5 } } };
  id[10] = id_of (s);
  for (size_t i = 0; i < COUNT_OF (id); i++)
    for (size_t j = 0; j < i; j++)
      if (id[i] == id[j])
        fail_msg ("changes %zu and %zu have the same id", i, j);
  free (s);
}

/* ---- What is carried ---- */

static void
frames_on_a_track (void **state)
{
  static const double rows[][5]
      = { { 10, 0, 50, -5, 350 }, { 20, 10, 50, -5, 10 }, { 22, 10, 54, -6, 190 } };
  stage *s = new_stage ();
  bt_model *model;
  bt__frame f;
  (void)state;
  add_box (s, "crate", (bt_vec3){ 9, 9, 9 }, (bt_vec3){ 1, 2, 3 })->track
      = (bt_rows){ rows[0], 3, 5 };
  model = compile (s);
  f = bt__carried_frame (model, 0, 0); /* before the first row as there */
  assert_point (f.origin, (bt_vec3){ 0, 50, -5 }, 0);
  assert_point (f.y, bt__turned (f.origin, 350, 0, 0).y, 1e-15);
  f = bt__carried_frame (model, 0, 15); /* the shorter way from 350 to 10 is by 0 */
  assert_point (f.origin, (bt_vec3){ 5, 50, -5 }, 1e-12);
  assert_point (f.y, (bt_vec3){ 0, 1, 0 }, 1e-12);
  f = bt__carried_frame (model, 0, 17.5);
  assert_point (f.y, bt__turned (f.origin, 5, 0, 0).y, 1e-12);
  f = bt__carried_frame (model, 0, 20);
  assert_point (f.origin, (bt_vec3){ 10, 50, -5 }, 1e-12);
  f = bt__carried_frame (model, 0, 21);
  assert_point (f.origin, (bt_vec3){ 10, 52, -5.5 }, 1e-12);
  f = bt__carried_frame (model, 0, 1e6); /* after the last as there */
  assert_point (f.origin, (bt_vec3){ 10, 54, -6 }, 0);
  assert_point (f.y, bt__turned (f.origin, 190, 0, 0).y, 1e-15);
  f = bt__carried_frame (model, 0, NAN);
  assert_true (bt__is_finite (f.origin));
  /* No jump anywhere: a step of 1e-6 s moves less than the speed says.  */
  for (double t = 9; t < 23; t += 0.0371)
    assert_true (bt__distance (bt__carried_frame (model, 0, t).origin,
                               bt__carried_frame (model, 0, t + 1e-6).origin)
                 <= 2.5e-6);
  bt_model_release (model);
  free (s);
}

/* A row without a heading keeps the box as it is turned; what has an axis is drawn about its
   middle.  */
static void
carried_as_drawn (void **state)
{
  static const double rows[][5] = { { 0, 1, 50, -5, NAN }, { 9, 4, 50, -5, NAN } };
  stage *s = new_stage ();
  bt_obstacle_def *def = add_box (s, "crate", (bt_vec3){ 0, 0, 0 }, (bt_vec3){ 2, 8, 2 });
  bt_model *model;
  bt__aabb box;
  (void)state;
  def->heading = 90;
  def->track = (bt_rows){ rows[0], 2, 5 };
  def = add_round (s, "cylinder", "pipe", (bt_vec3){ 100, 0, 0 }, (bt_vec3){ 100, 0, 6 }, 0.5);
  def->track = (bt_rows){ rows[0], 2, 5 };
  model = compile (s);
  box = box_at (model, 0, 3); /* at (2 50 -5), long from west to east */
  assert_point (box.lo, (bt_vec3){ -2, 49, -6 }, 1e-9);
  assert_point (box.hi, (bt_vec3){ 6, 51, -4 }, 1e-9);
  box = box_at (model, 1, 3);
  assert_point (box.lo, (bt_vec3){ 1.5, 49.5, -8 }, 1e-9);
  assert_point (box.hi, (bt_vec3){ 2.5, 50.5, -2 }, 1e-9);
  assert_float_equal (model->carried[0].radius, sqrt (1 + 16 + 1), 1e-7);
  assert_float_equal (model->carried[1].radius, hypot (3, 0.5), 1e-7);
  assert_true (model->carried[0].body->serial != model->carried[1].body->serial);
  bt_model_release (model);
  free (s);
}

/* The ball about a carried body holds all of it.  */
static void
ball_holds_the_body (void **state)
{
  static const double rows[][5] = { { 0, 0, 80, -5, 0 } };
  stage *s = new_stage ();
  bt_obstacle_def *def = add (s, "mesh", "sail");
  bt_model *model;
  const bt__mesh *mesh;
  (void)state;
  def->mesh = square_mesh ();
  def->scale = 7;
  def->track = (bt_rows){ rows[0], 1, 5 };
  def = add (s, "convex", "rock");
  def->points = rows_of (corner_points, 5);
  def->track = (bt_rows){ rows[0], 1, 5 };
  model = compile (s);
  mesh = model->carried[0].body->object[0].shape.mesh;
  for (uint32_t i = 0; i < mesh->vertices; i++)
    assert_true (bt__norm (mesh->v[i]) <= model->carried[0].radius);
  assert_true (model->carried[0].radius >= 7 * sqrt (2));
  assert_true (model->carried[1].radius >= 2);
  bt_model_release (model);
  free (s);
}

/* ---- Laying ---- */

static void
clear_of_everything (void **state)
{
  double r = 0.05; /* the tether's radius */
  stage *s = new_stage ();
  (void)state;
  add_box (s, "wall", (bt_vec3){ 5, 0, -5 }, (bt_vec3){ 1, 4, 4 });
  refused (s, BT_ERR_DEF, "`line'", "box `wall'");
  for (int side = -1; side <= 1; side += 2)
    {
      /* A box whose face is at y = 0.05 + gap: what touches may touch, nearer may not.  */
      s = new_stage ();
      add_box (s, "wall", (bt_vec3){ 5, side * (r + 1), -5 }, (bt_vec3){ 1, 2, 4 });
      taken (s);
      s = new_stage ();
      add_box (s, "wall", (bt_vec3){ 5, side * (r + 1 - 1e-6), -5 }, (bt_vec3){ 1, 2, 4 });
      refused (s, BT_ERR_DEF, "`line'", "`wall'");
    }
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 0, 0.5, -5 }, 0.5 - 0.04);
  refused (s, BT_ERR_DEF, "anchor", "sphere `ball'");
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 10.4, 0, -5 }, 0.5);
  refused (s, BT_ERR_DEF, "rov `minnow'", "sphere `ball'");
  s = new_stage ();
  s->tether.from.at.z = -50;
  s->tether.length = 60;
  add (s, "seabed", "bottom");
  refused (s, BT_ERR_DEF, "anchor", "seabed `bottom'");
  s = new_stage ();
  s->tether.from.at.z = -50 + r;
  s->tether.length = 60;
  add (s, "seabed", "bottom");
  taken (s);
}

/* What moves is where its track begins.  */
static void
clear_of_what_moves (void **state)
{
  static const double away[][5] = { { 0, 5, 40, -5, 0 }, { 10, 5, 0, -5, 0 } };
  static const double near[][5] = { { 5, 5, 0, -5, 0 }, { 10, 5, 40, -5, 0 } };
  stage *s = new_stage ();
  (void)state;
  add_sphere (s, "ball", (bt_vec3){ 5, 0, -5 }, 1)->track = (bt_rows){ away[0], 2, 5 };
  taken (s);
  s = new_stage ();
  add_sphere (s, "ball", (bt_vec3){ 5, 40, -5 }, 1)->track = (bt_rows){ near[0], 2, 5 };
  refused (s, BT_ERR_DEF, "`line'", "sphere `ball'");
}

static void
laid_through_points (void **state)
{
  stage *s = new_stage ();
  bt_vec3 p[BT_VIA_MAX + 2];
  bt_model *model;
  (void)state;
  add_box (s, "wall", (bt_vec3){ 5, 0, -5 }, (bt_vec3){ 1, 2, 4 });
  s->tether.via = (bt_via){ 2, { { 4, 2, -5 }, { 6, 2, -5 } } };
  model = compile (s);
  assert_int_equal (bt__lay_points (model, 0, p), 4);
  assert_point (p[0], (bt_vec3){ 0, 0, -5 }, 0);
  assert_point (p[2], (bt_vec3){ 6, 2, -5 }, 0);
  assert_point (p[3], (bt_vec3){ 10, 0, -5 }, 0);
  bt_model_release (model);
  s->tether.length = 2 * sqrt (20) + 2; /* just the way */
  bt_model_release (compile (s));
  s->tether.length -= 1e-6;
  s->tether.props.model = BT_MODEL_CATENARY; /* it does not stretch */
  refused (s, BT_ERR_DEF, "`line'", "`via'");
  s = new_stage ();
  add_box (s, "wall", (bt_vec3){ 5, 2, -5 }, (bt_vec3){ 1, 2, 4 });
  s->tether.via = (bt_via){ 2, { { 4, 2, -5 }, { 6, 2, -5 } } };
  s->tether.length = 30;
  refused (s, BT_ERR_DEF, "(4 2 -5)", "`wall'");
  s = new_stage ();
  s->tether.via.n = BT_VIA_MAX + 1;
  refused (s, BT_ERR_LIMIT, "`line'", "via");
  s = new_stage ();
  s->tether.via = (bt_via){ 1, { { 4, NAN, -5 } } };
  refused (s, BT_ERR_DOMAIN, "`line'", "via");
}

/* ---- Setting fields ---- */

static void
setters (void **state)
{
  const bt_head *head = bt_head_find ("sphere"), *convex = bt_head_find ("convex");
  const bt_field *friction = bt_field_find (head, "friction");
  static const double points[][3] = { { 1, 2, 3 } };
  bt_rows rows = { points[0], 1, 3 };
  bt_obstacle_def def;
  bt_tether_def tether;
  (void)state;
  bt_def_init (head, &def);
  assert_int_equal (def.kind, BT_OBSTACLE_SPHERE);
  assert_true (isnan (def.friction));
  assert_int_equal (bt_def_set_number (friction, &def, 0.4, NULL), BT_OK);
  assert_int_equal (bt_def_set_number (friction, &def, -1, NULL), BT_ERR_DOMAIN);
  assert_true (def.friction == 0.4);
  assert_int_equal (bt_def_set_word (friction, &def, "tether", NULL), BT_OK);
  assert_true (isnan (def.friction));
  assert_int_equal (bt_def_set_rows (friction, &def, &rows, NULL), BT_ERR_NAME);
  assert_int_equal (bt_def_set_rows (bt_field_find (convex, "points"), &def, &rows, NULL), BT_OK);
  assert_ptr_equal (def.points.at, points[0]);
  bt_def_init (bt_head_find ("tether"), &tether);
  assert_int_equal (
      bt_def_set_rows (bt_field_find (bt_head_find ("tether"), "via"), &tether, &rows, NULL),
      BT_OK);
  assert_true (tether.via.n == 1);
  assert_point (tether.via.at[0], (bt_vec3){ 1, 2, 3 }, 0);
  assert_true (isnan (tether.props.mass)); /* no word stands for that */
  assert_int_equal (
      bt_def_set_number (bt_field_find (bt_head_find ("tether"), "mass"), &tether, NAN, NULL),
      BT_ERR_DOMAIN);
  assert_ptr_equal (bt_obstacle_head (BT_OBSTACLE_MESH), bt_head_find ("mesh"));
  assert_null (bt_obstacle_head ((bt_obstacle_kind)-1));
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (no_obstacles_no_scene),
    cmocka_unit_test (every_kind),
    cmocka_unit_test (turned_axes),
    cmocka_unit_test (turned_box_distances),
    cmocka_unit_test (bad_numbers),
    cmocka_unit_test (bad_shapes),
    cmocka_unit_test (bad_seabeds),
    cmocka_unit_test (bad_tracks),
    cmocka_unit_test (bad_names),
    cmocka_unit_test (everything_is_copied),
    cmocka_unit_test (memory_running_out),
    cmocka_unit_test (views),
    cmocka_unit_test (identity_of_content),
    cmocka_unit_test (frames_on_a_track),
    cmocka_unit_test (carried_as_drawn),
    cmocka_unit_test (ball_holds_the_body),
    cmocka_unit_test (clear_of_everything),
    cmocka_unit_test (clear_of_what_moves),
    cmocka_unit_test (laid_through_points),
    cmocka_unit_test (setters),
  };
  return cmocka_run_group_tests_name ("obstacles in a model", tests, NULL, NULL);
}
