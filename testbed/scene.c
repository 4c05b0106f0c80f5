/* See scene.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"
#include "testbed/calibration.h"
#include "testbed/scene.h"

enum
{
  THINKS = 600 /* steps between two thoughts of the pilot */
};

void
scene_must (bt_status status, const bt_error *error)
{
  if (status == BT_OK)
    return;
  fprintf (stderr, "bight bench: %s\n", error->text);
  exit (EXIT_FAILURE);
}

double
scene_apart (const bt_dive *a, const bt_dive *b)
{
  bt_vec3 p[SCENE_PLACES], q[SCENE_PLACES];
  bt_error error;
  double most = 0;
  scene_must (bt_tether_points (a, 0, SCENE_PLACES, p, &error), &error);
  scene_must (bt_tether_points (b, 0, SCENE_PLACES, q, &error), &error);
  for (int k = 0; k < SCENE_PLACES; k++)
    most = fmax (most, bt__distance (p[k], q[k]));
  return most;
}

void
scene_clear (scene *s)
{
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  s->world.sea.depth = 60;
  s->world.vehicles = s->vehicle;
  s->world.tethers = s->tether;
  s->world.obstacles = s->obstacle;
}

/* The name STEM-NUMBER of a part.  */
static void
name_part (char *name, const char *stem, int number)
{
  char text[24];
  bt_error error;
  snprintf (text, sizeof text, "%s-%d", stem, number);
  scene_must (bt_def_set_name (name, text, &error), &error);
}

bt_vehicle_def *
scene_vehicle (scene *s, bt_vec3 at)
{
  bt_vehicle_def *v = &s->vehicle[s->world.n_vehicles];
  bt_def_init (bt_head_find ("rov"), v);
  name_part (v->name, "rov", s->world.n_vehicles++);
  v->at = at;
  return v;
}

bt_tether_def *
scene_line (scene *s, bt_vec3 anchor, double length, int nodes)
{
  bt_tether_def *t = &s->tether[s->world.n_tethers];
  bt_def_init (bt_head_find ("tether"), t);
  name_part (t->name, "line", s->world.n_tethers++);
  name_part (t->to.part, "rov", s->world.n_vehicles - 1);
  t->from.at = anchor;
  t->length = length;
  t->props.mass = 0.043;
  t->props.ea = 1e5;
  t->props.nodes = nodes;
  t->props.model = BT_MODEL_DYNAMIC;
  return t;
}

bt_obstacle_def *
scene_obstacle (scene *s, const char *kind)
{
  bt_obstacle_def *o = &s->obstacle[s->world.n_obstacles];
  bt_def_init (bt_head_find (kind), o);
  name_part (o->name, "obstacle", s->world.n_obstacles++);
  return o;
}

bt_obstacle_def *
scene_bar (scene *s, bt_vec3 from, bt_vec3 to, double radius)
{
  bt_obstacle_def *o = scene_obstacle (s, "capsule");
  o->from = from;
  o->to = to;
  o->radius = radius;
  return o;
}

void
scene_current (scene *s, bt_vec3 u)
{
  s->world.sea.current.kind = BT_CURRENT_UNIFORM;
  s->world.sea.current.velocity[0] = u;
}

void
scene_waves (scene *s)
{
  s->world.sea.waves = (bt_wave_def){ .kind = BT_WAVE_JONSWAP,
                                      .height = 1.5,
                                      .period = 7,
                                      .gamma = 3.3,
                                      .components = 32,
                                      .seed = 3,
                                      .accuracy = 1e-4 };
}

bt_dive *
scene_begin (const bt_world *world)
{
  bt_model *model;
  bt_dive *dive;
  bt_error error;
  scene_must (bt_model_new (world, &model, &error), &error);
  scene_must (bt_dive_new (model, NULL, NULL, &dive, &error), &error);
  bt_model_release (model);
  return dive;
}

double
scene_run (bt_dive *dive, int steps)
{
  bt_error error;
  double start = bench_now ();
  for (int k = 0; k < steps; k++)
    scene_must (bt_dive_step (dive, &error), &error);
  return (bench_now () - start) / steps;
}

/* The K-th thought of the pilot.  */
static void
steer (bt_dive *dive, int flown, long k)
{
  const double sticks[4] = { k % 2 ? -0.3 : 0.3, k % 3 ? 0.2 : -0.2, 0, 0.1 };
  bt_error error;
  for (int i = 0; i < flown; i++)
    scene_must (bt_dive_do (dive, BT_OP_DRIVE, i, sticks, 4, &error), &error);
}

double
scene_fly (bt_dive *dive, int flown, long from, int steps)
{
  bt_error error;
  double start = bench_now ();
  for (long k = from; k < from + steps; k++)
    {
      if (k % THINKS == 0)
        steer (dive, flown, k / THINKS);
      scene_must (bt_dive_step (dive, &error), &error);
    }
  return (bench_now () - start) / steps;
}
