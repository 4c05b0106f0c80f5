/* See dive_scene.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dive_scene.h"
#include "math/vec.h"

/* ---- Worlds ---- */

bt_obstacle_def *
add (scene *s, const char *head, const char *name)
{
  bt_obstacle_def *def = &s->obstacle[s->world.n_obstacles++];
  assert_true (s->world.n_obstacles <= OBSTACLES);
  bt_def_init (bt_head_find (head), def);
  assert_int_equal (bt_def_set_name (def->name, name, NULL), BT_OK);
  return def;
}

void
add_post (scene *s, const char *head, const char *name, bt_vec3 middle, bt_vec3 axis, double radius)
{
  bt_obstacle_def *def = add (s, head, name);
  def->from = bt__axpy (middle, -200, axis);
  def->to = bt__axpy (middle, 200, axis);
  def->radius = radius;
}

/* It goes to and fro by WAY from MIDDLE, a whole time in SECONDS.  */
static void
send (scene *s, bt_obstacle_def *def, int k, bt_vec3 middle, bt_vec3 way, double seconds)
{
  for (int i = 0; i < 12; i++)
    {
      bt_vec3 p = bt__axpy (middle, i % 2 ? 1 : -1, way);
      double *row = s->track[k] + 5 * i;
      row[0] = seconds / 2 * i;
      row[1] = p.x;
      row[2] = p.y;
      row[3] = p.z;
      row[4] = 0;
    }
  def->track = (bt_rows){ s->track[k], 12, 5 };
}

/* A slack line from (-8 -8 -6) to a vehicle 16 m east of there, in a current to the north.  */
void
begin_scene (scene *s, bt_model_kind model)
{
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  s->world.sea.depth = 300;
  s->world.sea.current.kind = BT_CURRENT_UNIFORM;
  s->world.sea.current.velocity[0] = (bt_vec3){ 0.05, 0.3, 0 };
  for (int i = 0; i < 2; i++)
    {
      bt_def_init (bt_head_find ("rov"), &s->vehicle[i]);
      bt_def_init (bt_head_find ("tether"), &s->tether[i]);
      s->tether[i].length = 30;
      s->tether[i].props.nodes = 24;
      s->tether[i].props.wet_weight = 0;
      s->tether[i].props.model = model;
      s->tether[i].props.response = BT_RESPONSE_THESIS;
    }
  bt_def_set_name (s->vehicle[0].name, "minnow", NULL);
  bt_def_set_name (s->vehicle[1].name, "garage", NULL);
  bt_def_set_name (s->tether[0].name, "line", NULL);
  bt_def_set_name (s->tether[1].name, "umbilical", NULL);
  bt_def_set_name (s->tether[0].to.part, "minnow", NULL);
  s->vehicle[0].at = (bt_vec3){ 8, -8, -6 };
  s->tether[0].from.at = (bt_vec3){ -8, -8, -6 };
  s->world.vehicles = s->vehicle;
  s->world.n_vehicles = 1;
  s->world.tethers = s->tether;
  s->world.n_tethers = 1;
  s->world.obstacles = s->obstacle;
}

/* Endless posts, so that whether a line has passed one is a number.  */
void
plant_wood (scene *s)
{
  bt_vec3 up = { 0, 0, 1 };
  add_post (s, "cylinder", "leg", bt__vec (0, 0, 0), up, 0.6);
  add_post (s, "capsule", "wire", bt__vec (3, -3, 0), up, 0.01);
  add_post (s, "capsule", "brace", bt__vec (0, 3, -4), bt__vec (0.8, 0, 0.6), 0.25);
  add_post (s, "cylinder", "pipe", bt__vec (0, -4, -9), bt__vec (1, 0, 0), 0.3);
  add_post (s, "capsule", "pile", bt__vec (-4, 4, 0), up, 0.45);
}

void
add_movers (scene *s)
{
  bt_vec3 up = { 0, 0, 1 };
  add_post (s, "capsule", "boom", bt__vec (5, 0, 0), up, 0.2);
  send (s, &s->obstacle[s->world.n_obstacles - 1], 0, bt__vec (5, 0, 0), bt__vec (2, 5, 0), 9);
  add_post (s, "cylinder", "chain", bt__vec (0, 0, -14), bt__vec (0, 1, 0), 0.1);
  send (s, &s->obstacle[s->world.n_obstacles - 1], 1, bt__vec (0, 0, -9), bt__vec (3, 0, 6), 14);
}

void
give_hull (scene *s, int i, bt_vec3 size)
{
  s->vehicle[i].size = size;
}

/* The line comes from a second vehicle, on an umbilical of its own.  */
void
hang_garage (scene *s)
{
  s->vehicle[1].at = (bt_vec3){ -8, -8, -6 };
  bt_def_set_name (s->tether[0].from.part, "garage", NULL);
  bt_def_set_name (s->tether[1].to.part, "garage", NULL);
  s->tether[1].from.at = (bt_vec3){ -12, -12, 2 };
  s->world.n_vehicles = s->world.n_tethers = 2;
}

/* A second line holds the same vehicle.  */
void
tie_twice (scene *s)
{
  bt_def_set_name (s->tether[1].to.part, "minnow", NULL);
  s->tether[1].from.at = (bt_vec3){ 12, -12, -2 };
  s->world.n_tethers = 2;
}

bt_dive *
enter (const scene *s)
{
  bt_model *model = NULL;
  bt_dive *dive = NULL;
  bt_error e = { 0 };
  if (bt_model_new (&s->world, &model, &e) != BT_OK
      || bt_dive_new (model, NULL, NULL, &dive, &e) != BT_OK)
    fail_msg ("%s", e.text);
  bt_model_release (model);
  return dive;
}

/* ---- What is done ---- */

bt_status
operate (bt_dive *dive, bt_op op, int subject, int n, const double *args)
{
  bt_error e = { 0 };
  bt_status status = bt_dive_do (dive, op, subject, args, n, &e);
  assert_true (status == BT_OK || strlen (e.text) > 0);
  if (getenv ("BIGHT_TELL"))
    printf ("# t %.3f op %s subject %d: %g %g %g %g -> %s\n", bt_dive_time (dive),
            bt_op_describe (op)->name, subject, n > 0 ? args[0] : 0, n > 1 ? args[1] : 0,
            n > 2 ? args[2] : 0, n > 3 ? args[3] : 0, status == BT_OK ? "ok" : e.text);
  return status;
}

/* Nonzero if it went; the thesis' search alone may find nothing, and the dive then stands.  */
int
step (bt_dive *dive)
{
  bt_error e = { 0 };
  bt_status status = bt_dive_step (dive, &e);
  if (status != BT_OK && !strstr (e.text, "search found no catenary"))
    fail_msg ("t = %g: %s", bt_dive_time (dive), e.text);
  return status == BT_OK;
}

static int
field_number (const char *head, const char *name)
{
  const bt_head *h = bt_head_find (head);
  const bt_field *field = bt_field_find (h, name);
  assert_non_null (field);
  return (int)(field - h->fields);
}

bt_status
take_model (bt_dive *dive, int i, bt_model_kind model)
{
  return operate (dive, BT_OP_ALTER, i, 3,
                  (double[]){ BT_PART_TETHER, field_number ("tether", "model"), model });
}
