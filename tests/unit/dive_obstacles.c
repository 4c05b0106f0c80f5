/* Dives among obstacles: every model, hulls, masses, several tethers, jumps of 20 m, flights at
   20 m/s, winch, cuts, other models while wound.  No line passes through anything or comes nearer
   than its core, no hull touches.  With all pairs switched off the judge must cry out.

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

#include "../oracle/dive_play.h"
#include "math/vec.h"

static const char *const model_names[] = { "rubber-band", "v-shape", "catenary", "catenary-simplex",
                                           "elastic",     "steady",  "dynamic",  "auto" };

static void
every_model (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      begin_scene (&s, (bt_model_kind)model);
      plant_wood (&s);
      fly (&s, 10 + (uint64_t)model, (habits){ .jumps = 1, .winch = 1 }, 14, 50,
           model_names[model]);
    }
}

static void
hulls_and_movers (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      begin_scene (&s, (bt_model_kind)model);
      plant_wood (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      fly (&s, 30 + (uint64_t)model, (habits){ .jumps = 1, .winch = 1, .pairs = 1 }, 12, 50,
           model_names[model]);
    }
}

static void
masses (void **state)
{
  static const bt_model_kind models[]
      = { BT_MODEL_DYNAMIC, BT_MODEL_AUTO, BT_MODEL_STEADY, BT_MODEL_CATENARY };
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      begin_scene (&s, models[k]);
      plant_wood (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.4, 0.5, 0.3));
      assert_int_equal (bt_def_set_vehicle_type (&s.vehicle[0], "bluerov2-heavy", NULL), BT_OK);
      s.vehicle[0].volume = NAN;
      fly (&s, 50 + (uint64_t)k, (habits){ .jumps = 1, .winch = 1, .cut = 1 }, 12, 50,
           model_names[models[k]]);
    }
}

static void
two_tethers (void **state)
{
  static const bt_model_kind models[] = { BT_MODEL_DYNAMIC, BT_MODEL_CATENARY, BT_MODEL_STEADY };
  (void)state;
  for (int k = 0; k < 6; k++)
    {
      scene s;
      begin_scene (&s, models[k / 2]);
      plant_wood (&s);
      if (k % 2)
        tie_twice (&s);
      else
        hang_garage (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.4, 0.5, 0.3));
      fly (&s, 60 + (uint64_t)k, (habits){ .jumps = 1, .winch = 1 }, 10, 40,
           k % 2 ? "two lines" : "garage");
    }
}

static void
other_models_while_wound (void **state)
{
  (void)state;
  for (uint64_t k = 0; k < 4; k++)
    {
      scene s;
      begin_scene (&s, BT_MODEL_DYNAMIC);
      plant_wood (&s);
      add_movers (&s);
      fly (&s, 70 + k, (habits){ .winch = 1, .models = 1, .jumps = k % 2 == 0, .cut = k == 3 }, 16,
           40, "models");
    }
}

/* Members as thin as ropes among which a line of few nodes changes its model in flight: its new
   shape is nowhere near its old one.  */
static void
other_models_with_few_nodes (void **state)
{
  static const int nodes[] = { 2, 3, 4, 6, 8, 16, 32, 64 };
  (void)state;
  for (size_t k = 0; k < sizeof nodes / sizeof *nodes; k++)
    for (int model = 0; model <= BT_MODEL_AUTO; model++)
      {
        scene s;
        begin_scene (&s, (bt_model_kind)model);
        add_post (&s, "capsule", "rope", bt__vec (0, -5, -7), bt__vec (1, 0, 0), 0.02);
        add_post (&s, "cylinder", "rod", bt__vec (1, -2, 0), bt__vec (0, 0, 1), 0.05);
        add_post (&s, "capsule", "stay", bt__vec (-3, 0, -9), bt__vec (0.6, 0, 0.8), 0.03);
        s.tether[0].props.nodes = nodes[k];
        s.tether[0].props.wet_weight = 2 * ((int)k % 3 - 1);
        fly (&s, 5700 + 8 * k + (uint64_t)model,
             (habits){ .winch = 1, .models = 3, .jumps = model % 2 }, 24, 12, model_names[model]);
      }
}

/* ---- A yard: walls, boxes, balls, a bed, triangles ---- */

static const bt_vec3 sheet_point[]
    = { { -40, 0, -30 }, { 40, 0, -30 }, { 40, 0, 10 }, { -40, 0, 10 } };
static const uint32_t sheet_corner[][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const double gem_points[][3]
    = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };

#define BED 12.0

static void
build_yard (scene *s)
{
  bt_obstacle_def *o;
  s->world.sea.depth = BED;
  add (s, "seabed", "bed");
  o = add (s, "box", "wall");
  o->at = (bt_vec3){ 0, 2, -8 };
  o->size = (bt_vec3){ 60, 1, 60 };
  o = add (s, "mesh", "net"); /* not to be passed, though it has no inside */
  o->at = (bt_vec3){ 0, -14, 0 };
  o->mesh = (bt_triangles){ sheet_point, 4, sheet_corner, 2, NULL };
  o = add (s, "sphere", "buoy");
  o->at = (bt_vec3){ 0, -6, -6 };
  o->radius = 1;
  o = add (s, "convex", "gem");
  o->at = (bt_vec3){ 3, -4, -9 };
  o->points = (bt_rows){ gem_points[0], 6, 3 };
}

/* The line stays between bed, wall and net, and out of the buoy and the gem.  */
static double
yard_clearance (const sight *sight, int parts)
{
  double least = INFINITY;
  for (int p = 0; p < parts; p++)
    for (int i = 0; i + 1 < sight->n[p]; i++)
      {
        bt_vec3 a = sight->x[p][i], b = sight->x[p][i + 1], c = bt__vec (0, -6, -6);
        bt__link link = { a, b };
        solid buoy = { .kind = SOLID_SPHERE, .sphere = { c, 1 } };
        least = fmin (least, fmin (a.z + BED, 1.5 - a.y));
        least = fmin (least, a.y + 14);
        least = fmin (least, solid_brute (&buoy, &link));
        for (int k = 0; k <= 16; k++)
          {
            bt_vec3 q = bt__axpy (a, k / 16.0, bt__sub (b, a));
            double in = fabs (q.x - 3) + fabs (q.y + 4) + fabs (q.z + 9) - 1;
            least = fmin (least, in / sqrt (3.0));
          }
      }
  return least;
}

static double
yard_hull (const scene *s, const bt_dive *dive)
{
  bt_vehicle_view view;
  assert_int_equal (bt_dive_vehicle (dive, 0, &view, NULL), BT_OK);
  solid hull = { .kind = SOLID_BOX, .box = hull_of (s, 0, &view) };
  double down = solid_support (&hull, bt__vec (0, 0, -1)),
         north = solid_support (&hull, bt__vec (0, 1, 0)),
         south = solid_support (&hull, bt__vec (0, -1, 0));
  double walls = fmin (BED - down, fmin (1.5 - north, 14 - south));
  return fmin (walls, solid_point (&hull, bt__vec (0, -6, -6)) - 1);
}

static void
yard (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      static sight seen;
      scene s;
      begin_scene (&s, (bt_model_kind)model);
      build_yard (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      s.tether[0].props.wet_weight = 0.05;
      bt_dive *dive = enter (&s);
      dice d = dice_new (80 + (uint64_t)model + other_seeds ());
      double least = INFINITY, hull = INFINITY;
      for (int k = 0; k < 14 * longer (); k++)
        {
          bt_vec3 p = dice_point (&d, 20);
          double to[] = { p.x, p.y, p.z, 4 };
          operate (dive, k % 4 ? BT_OP_MOVE : BT_OP_PLACE, 0, k % 4 ? 4 : 3, to);
          operate (dive, BT_OP_HOLD_HEADING, 0, 1, (double[]){ dice_between (&d, 0, 6) });
          if (k == 9 && model == BT_MODEL_DYNAMIC)
            operate (dive, BT_OP_CUT, 0, 1, (double[]){ 12 });
          for (int i = 0; i < 60 && step (dive); i++)
            {
              look (dive, &seen);
              least = fmin (least, yard_clearance (&seen, 2));
              hull = fmin (hull, yard_hull (&s, dive));
            }
        }
      print_message ("# %s: line %.3g m, hull %.3g m\n", model_names[model], least, hull);
      assert_true (least > s.tether[0].props.diameter / 4 - ROUNDING);
      assert_true (hull > 0);
      bt_dive_free (dive);
    }
}

/* At the end of its tether and pushed along a slanting wall, a vehicle must not creep away.  */
static void
taut_along_a_wall (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      bt_vehicle_view view;
      begin_scene (&s, (bt_model_kind)model);
      bt_obstacle_def *wall = add (&s, "box", "wall");
      wall->at = (bt_vec3){ 8, 14, 0 };
      wall->size = (bt_vec3){ 200, 2, 60 };
      wall->heading = 20;
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      bt_dive *dive = enter (&s);
      operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 60, 40, -6, 2 });
      for (int i = 0; i < 1800; i++)
        assert_true (step (dive));
      assert_int_equal (bt_dive_vehicle (dive, 0, &view, NULL), BT_OK);
      double out = bt__distance (view.position, s.tether[0].from.at);
      print_message ("# %s: %.6g m out of 30\n", model_names[model], out);
      assert_true (out < 30 * 1.02);
      bt_dive_free (dive);
    }
}

/* A moving line that pulls a vehicle about among posts is solved once a step, but where it is held
   back.  */
static void
solved_once (void **state)
{
  (void)state;
  for (int model = BT_MODEL_DYNAMIC; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      bt_profile work;
      dice d = dice_new (5);
      begin_scene (&s, (bt_model_kind)model);
      plant_wood (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      s.tether[0].props.response = BT_RESPONSE_PHYSICAL;
      bt_dive *dive = enter (&s);
      for (int k = 0; k < 20; k++)
        {
          bt_vec3 p = dice_point (&d, 8);
          operate (dive, BT_OP_MOVE, 0, 4, (double[]){ p.x, p.y, p.z - 8, 1.5 });
          for (int i = 0; i < 60; i++)
            assert_true (step (dive));
        }
      bt_dive_profile (dive, &work);
      print_message ("# %s: solved %.3f times a step\n", model_names[model],
                     (double)work.chain_tries / (double)work.steps);
      assert_true (work.chain_steps + work.chain_sleeps + work.chain_stretched == work.steps);
      assert_true ((double)work.chain_tries < 1.25 * (double)work.steps);
      bt_dive_free (dive);
    }
}

/* ---- Mutants ---- */

static void
judge_can_say_no (void **state)
{
  static const bt_model_kind models[]
      = { BT_MODEL_RUBBER_BAND, BT_MODEL_CATENARY, BT_MODEL_STEADY, BT_MODEL_DYNAMIC };
  double hull = INFINITY;
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      judge j;
      begin_scene (&s, models[k]);
      plant_wood (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      bt_dive *dive = enter (&s);
      dice d = dice_new (7);
      operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ BT_PART_SEA, -1, 0 });
      begin_judging (&j, &s, dive);
      live (dive, &j, &d, (habits){ .jumps = 1 }, 16, 40);
      operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 0, 0, -6, 3 }); /* into the leg */
      for (int i = 0; i < 600; i++)
        {
          assert_true (step (dive));
          look_again (&j, dive, 1);
        }
      print_message ("# %s, all pairs off: %ld crossings, line %.3g m, hull %.3g m\n",
                     model_names[models[k]], j.crossings, j.least, j.least_hull);
      assert_true (j.crossings > 3);
      assert_true (j.least < -0.05);
      hull = fmin (hull, j.least_hull);
      end_judging (&j);
      bt_dive_free (dive);
    }
  assert_true (hull < -0.05);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (judge_can_say_no),
    cmocka_unit_test (every_model),
    cmocka_unit_test (hulls_and_movers),
    cmocka_unit_test (masses),
    cmocka_unit_test (two_tethers),
    cmocka_unit_test (other_models_while_wound),
    cmocka_unit_test (other_models_with_few_nodes),
    cmocka_unit_test (yard),
    cmocka_unit_test (taut_along_a_wall),
    cmocka_unit_test (solved_once),
  };
  return cmocka_run_group_tests_name ("dive_obstacles", tests, NULL, NULL);
}
