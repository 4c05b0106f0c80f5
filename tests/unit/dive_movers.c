/* Worlds in which nothing stands: every kind of obstacle on a track, alone, among every model.  All
   that may be done is done there and all that may be asked is asked; what does not move holds
   nothing, what moves is met.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/dive_scene.h"
#include "math/vec.h"

enum
{
  WAY_MAX = 500,
  BEAMS = 16
};

/* ---- What goes to and fro ---- */

static const double gem[][3]
    = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
static const bt_vec3 corner[] = { { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 }, { 0, 0, 1 } };
static const uint32_t face[][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };

static const char *const kinds[] = { "sphere", "box", "cylinder", "capsule", "convex", "mesh" };

static void
shape (bt_obstacle_def *o)
{
  o->radius = 0.8;
  o->size = (bt_vec3){ 1, 2, 1 };
  o->from = (bt_vec3){ 0, -2, 0 };
  o->to = (bt_vec3){ 0, 2, 0 };
  if (o->kind == BT_OBSTACLE_CONVEX)
    o->points = (bt_rows){ gem[0], 6, 3 };
  if (o->kind == BT_OBSTACLE_MESH)
    o->mesh = (bt_triangles){ corner, 4, face, 4, NULL };
}

/* It crosses the line from the south and comes back.  */
static void
add_ferry (scene *s, const char *kind)
{
  static const double row[3][5]
      = { { 0, 0, -14, -6, 0 }, { 8, 0, 12, -6, 90 }, { 16, 0, -14, -6, 180 } };
  bt_obstacle_def *o = add (s, kind, "ferry");
  shape (o);
  memcpy (s->track[0], row, sizeof row);
  o->track = (bt_rows){ s->track[0], 3, 5 };
}

/* ---- All that may be asked ---- */

static void
ask_lengths (const bt_dive *dive)
{
  double x;
  int n, i;
  bt_vec3 way[WAY_MAX];
  assert_int_equal (bt_tether_taut_length (dive, 0, &x, NULL), BT_OK);
  assert_true (isfinite (x));
  assert_int_equal (bt_tether_free_length (dive, 0, &x, NULL), BT_OK);
  assert_true (isfinite (x));
  assert_int_equal (bt_tether_taut_string (dive, 0, way, WAY_MAX, &n, NULL), BT_OK);
  assert_int_equal (bt_tether_is_taut (dive, 0, &i, NULL), BT_OK);
  assert_int_equal (bt_tether_contact_length (dive, 0, -1, 0, &x, NULL), BT_OK);
  assert_int_equal (bt_tether_wrap_angle (dive, 0, -1, &x, NULL), BT_OK);
  assert_int_equal (bt_tether_capstan_lock (dive, 0, &x, NULL), BT_OK);
  assert_int_equal (bt_tether_turns (dive, 0, 0, &x, NULL), BT_OK);
  assert_int_equal (bt_tether_winding (dive, 0, 0, &i, NULL), BT_OK);
}

static void
ask_ways (const bt_dive *dive)
{
  static bt_class class;
  bt_vec3 way[WAY_MAX];
  bt_prospect prospect;
  bt_foresight ahead[16];
  bt_route route;
  bt_follow follow;
  bt_haul haul;
  bt_foul foul;
  int n;
  assert_int_equal (bt_tether_class (dive, 0, &class, NULL), BT_OK);
  bt_tether_knotted (dive, 0, &n, NULL); /* may be too much to tell */
  assert_int_equal (bt_tether_fouled (dive, 0, &foul, NULL), BT_OK);
  assert_int_equal (bt_tether_prospect (dive, 0, 500, &prospect, NULL), BT_OK);
  assert_int_equal (bt_tether_way_home (dive, 0, way, WAY_MAX, &n, &route, NULL), BT_OK);
  assert_int_equal (bt_tether_unwind_plan (dive, 0, way, WAY_MAX, &n, &route, NULL), BT_OK);
  assert_int_equal (bt_tether_foresee (dive, 0, 10, ahead, 16, &n, NULL), BT_OK);
  assert_int_equal (bt_tether_follow (dive, 0, &follow, NULL), BT_OK);
  assert_int_equal (bt_tether_haul (dive, 0, 0.5, 500, 1, &haul, NULL), BT_OK);
  assert_int_equal (bt_tether_haul (dive, 0, 0.5, 500, 1, &haul, NULL), BT_OK);
}

static void
ask_contacts (const bt_dive *dive)
{
  bt_clearance clearance;
  bt_contact contact[8];
  bt_segment segment[8];
  double worn;
  assert_true (bt_tether_contacts (dive, 0, contact, 8) >= 0);
  assert_true (bt_tether_segments (dive, 0, segment, 8) >= 1);
  assert_int_equal (bt_tether_wear (dive, 0, &worn, NULL), BT_OK);
  assert_int_equal (bt_vehicle_clearance (dive, 0, -1, &clearance, NULL), BT_OK);
  assert_int_equal (clearance.object, 0);
  assert_int_equal (bt_tether_clearance (dive, 0, -1, &clearance, NULL), BT_OK);
  assert_int_equal (clearance.object, 0);
  assert_true (clearance.distance > -0.5 * 0.016);
}

static void
ask_instruments (const bt_dive *dive)
{
  double range[BEAMS];
  bt_readings readings;
  bt_sighting sighting;
  bt_sonar sonar = { 2, 0, 60, BEAMS, 0.05 };
  bt_eye eye = { 1.5, 1.2, 0, 40 };
  bt_obstacle_view view;
  assert_int_equal (bt_dive_instruments (dive, 0, &readings, NULL), BT_OK);
  assert_int_equal (bt_dive_sonar (dive, 0, &sonar, range, NULL), BT_OK);
  assert_int_equal (bt_dive_sight (dive, 0, &eye, 0, &sighting, NULL), BT_OK);
  assert_int_equal (bt_dive_obstacle (dive, 0, &view, NULL), BT_OK);
}

static void
ask (const bt_dive *dive)
{
  ask_lengths (dive);
  ask_ways (dive);
  ask_contacts (dive);
  ask_instruments (dive);
}

/* ---- All that may be done ---- */

static void
run (bt_dive *dive, int steps)
{
  for (int k = 0; k < steps; k++)
    step (dive);
}

static void
handle (bt_dive *dive)
{
  operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 9, -6, -7, 1 });
  run (dive, 60);
  operate (dive, BT_OP_PLACE, 0, 3, (double[]){ 7, -7, -5 });
  operate (dive, BT_OP_LAY, 0, 3, (double[]){ 8, -6, -6 });
  operate (dive, BT_OP_PAY_OUT, 0, 2, (double[]){ 2, 0.5 });
  operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ BT_PART_TETHER, 0, 0 });
  run (dive, 10);
  operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ BT_PART_TETHER, 0, 1 });
  operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 3, -10, -6, 1 });
  run (dive, 180);
  operate (dive, BT_OP_DRIFT, 0, 3, (double[]){ 0.2, -0.3, -0.1 });
  run (dive, 180);
}

static void
every_kind_and_model (void **state)
{
  (void)state;
  for (size_t kind = 0; kind < sizeof kinds / sizeof *kinds; kind++)
    for (int model = 0; model <= BT_MODEL_AUTO; model++)
      {
        scene s;
        begin_scene (&s, (bt_model_kind)model);
        add_ferry (&s, kinds[kind]);
        s.tether[0].props.nodes = 40;
        bt_dive *dive = enter (&s);
        ask (dive);
        handle (dive);
        ask (dive);
        take_model (dive, 0, (bt_model_kind)((model + 3) % (BT_MODEL_AUTO + 1)));
        run (dive, 20);
        ask (dive);
        bt_dive_free (dive);
      }
}

/* Whatever it is, what comes across a line is touched.  */
static void
it_is_met (void **state)
{
  (void)state;
  for (size_t kind = 0; kind < sizeof kinds / sizeof *kinds; kind++)
    {
      int met = 0;
      scene s;
      begin_scene (&s, BT_MODEL_DYNAMIC);
      s.tether[0].props.response = BT_RESPONSE_PHYSICAL;
      add_ferry (&s, kinds[kind]);
      bt_dive *dive = enter (&s);
      for (int k = 0; k < 480 && !met; k++)
        {
          step (dive);
          met = bt_dive_collided (dive, BT_PART_TETHER, 0, 0);
        }
      assert_true (met);
      bt_dive_free (dive);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (every_kind_and_model),
    cmocka_unit_test (it_is_met),
  };
  return cmocka_run_group_tests_name ("dive_movers", tests, NULL, NULL);
}
