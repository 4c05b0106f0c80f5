/* The verbs with named arguments do what their operations do, bit for bit, and teach when they
   cannot; types of tether are known to C by name.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/dive_scene.h"
#include "math/vec.h"

/* Two dives in one world: what a verb does to the first an operation does to the second.  */
typedef struct pair
{
  scene s;
  bt_dive *verb, *op;
  bt_error error;
} pair;

/* A vehicle of TYPE, or without mass if that is NULL, on a moving line among posts.  */
static int
launch (void **state, const char *type)
{
  static pair p;
  memset (&p, 0, sizeof p);
  begin_scene (&p.s, BT_MODEL_DYNAMIC);
  plant_wood (&p.s);
  if (type)
    assert_int_equal (bt_def_set_vehicle_type (&p.s.vehicle[0], type, NULL), BT_OK);
  p.verb = enter (&p.s);
  p.op = enter (&p.s);
  *state = &p;
  return 0;
}

static int
without_mass (void **state)
{
  return launch (state, NULL);
}

static int
with_mass (void **state)
{
  return launch (state, "bluerov2-heavy");
}

static int
tear_down (void **state)
{
  pair *p = *state;
  bt_dive_free (p->verb);
  bt_dive_free (p->op);
  return 0;
}

/* Both dives are in one state now, and in another than WAS.  */
static void
are_one (const pair *p, uint64_t was)
{
  assert_true (bt_dive_hash (p->verb) == bt_dive_hash (p->op));
  assert_true (bt_dive_hash (p->verb) != was);
}

/* CALL, a verb on p->verb, is OP on SUBJECT with the numbers that follow.  */
#define SAME(call, op_, subject, ...)                                                              \
  do                                                                                               \
    {                                                                                              \
      const double args[] = { __VA_ARGS__ };                                                       \
      uint64_t was = bt_dive_hash (p->verb);                                                       \
      assert_int_equal (call, BT_OK);                                                              \
      assert_int_equal (                                                                           \
          bt_dive_do (p->op, op_, subject, args, (int)(sizeof args / sizeof *args), &p->error),    \
          BT_OK);                                                                                  \
      are_one (p, was);                                                                            \
    }                                                                                              \
  while (0)

static void
a_vehicle_is_flown (void **state)
{
  pair *p = *state;
  bt_error *e = &p->error;
  bt_dive *d = p->verb;
  bt_vec3 near = bt__vec (7, -8, -6.5);
  SAME (bt_vehicle_drive (d, 0, &(bt_sticks){ .surge = 0.5, .yaw = -0.25 }, e), BT_OP_DRIVE, 0, 0.5,
        0, 0, -0.25);
  SAME (bt_vehicle_drive (d, 0, &(bt_sticks){ NAN, 0.1, NAN, NAN }, e), BT_OP_DRIVE, 0, NAN, 0.1,
        NAN, NAN);
  SAME (bt_vehicle_hold_heading (d, 0, 1, e), BT_OP_HOLD_HEADING, 0, 1);
  SAME (bt_vehicle_hold_depth (d, 0, 6, e), BT_OP_HOLD_DEPTH, 0, 6);
  SAME (bt_vehicle_hold_altitude (d, 0, 20, e), BT_OP_HOLD_ALTITUDE, 0, 20);
  SAME (bt_vehicle_move (d, 0, &(bt_flight){ near, 0.5 }, e), BT_OP_MOVE, 0, 7, -8, -6.5, 0.5);
  SAME (bt_vehicle_fly_to (d, 0, &(bt_flight){ near, 0.4 }, e), BT_OP_FLY_TO, 0, 7, -8, -6.5, 0.4);
  SAME (bt_vehicle_place (d, 0, near, e), BT_OP_PLACE, 0, 7, -8, -6.5);
  SAME (bt_vehicle_lay (d, 0, bt__vec (6, -8, -6), e), BT_OP_LAY, 0, 6, -8, -6);
  assert_int_equal (bt_vehicle_release (d, 0, e), BT_OK);
  assert_int_equal (bt_dive_do (p->op, BT_OP_RELEASE, 0, NULL, 0, e), BT_OK);
  assert_int_equal (bt_vehicle_hold_position (d, 0, e), BT_OK);
  assert_int_equal (bt_dive_do (p->op, BT_OP_HOLD_POSITION, 0, NULL, 0, e), BT_OK);
  are_one (p, 0);
}

static void
a_vehicle_follows_a_track (void **state)
{
  pair *p = *state;
  const double rows[8] = { 0, 8, -8, -6, 5, 7, -8, -6 };
  SAME (bt_vehicle_follow (p->verb, 0, &(bt_rows){ rows, 2, 4 }, &p->error), BT_OP_FOLLOW, 0, 0, 8,
        -8, -6, 5, 7, -8, -6);
}

static void
things_break_and_are_mended (void **state)
{
  pair *p = *state;
  bt_failure drift = { .fault = BT_FAULT_COMPASS, .drift = 0.01 };
  bt_failure dead = { .fault = BT_FAULT_THRUSTER, .thruster = 3 };
  SAME (bt_vehicle_stabilise (p->verb, 0, false, &p->error), BT_OP_STABILISE, 0, 0);
  SAME (bt_vehicle_break (p->verb, 0, &drift, &p->error), BT_OP_FAULT, 0, BT_FAULT_COMPASS, 1,
        0.01);
  SAME (bt_vehicle_break (p->verb, 0, &dead, &p->error), BT_OP_FAULT, 0, BT_FAULT_THRUSTER, 1, 3);
  SAME (bt_vehicle_mend (p->verb, 0, &dead, &p->error), BT_OP_FAULT, 0, BT_FAULT_THRUSTER, 0, 3);
  int64_t lost;
  assert_true (bt_dive_faults (p->verb, 0, &lost) == BT_FAULT_COMPASS && lost == 0);
}

static void
a_tether_is_worked (void **state)
{
  pair *p = *state;
  bt_error *e = &p->error;
  const bt_head *head = bt_head_find ("tether");
  double friction = (double)(bt_field_find (head, "friction") - head->fields);
  double model = (double)(bt_field_find (head, "model") - head->fields);
  SAME (bt_tether_pay_out (p->verb, 0, &(bt_spooling){ 5, 0.5 }, e), BT_OP_PAY_OUT, 0, 5, 0.5);
  SAME (bt_tether_haul_in (p->verb, 0, &(bt_spooling){ 2, 0.4 }, e), BT_OP_HAUL_IN, 0, 2, 0.4);
  SAME (bt_part_alter (p->verb, BT_PART_TETHER, 0, "friction", 0.7, e), BT_OP_ALTER, 0,
        BT_PART_TETHER, friction, 0.7);
  SAME (bt_part_collide (p->verb, BT_PART_TETHER, 0, -1, false, e), BT_OP_COLLIDE, 0,
        BT_PART_TETHER, -1, 0);
  SAME (bt_tether_cut (p->verb, 0, 7, e), BT_OP_CUT, 0, 7);
  SAME (bt_part_choose (p->verb, BT_PART_TETHER, 0, "model", "auto", e), BT_OP_ALTER, 0,
        BT_PART_TETHER, model, BT_MODEL_AUTO);
}

static void
the_sea_changes (void **state)
{
  pair *p = *state;
  bt_current current = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.3, 0.1, 0 } } };
  bt_wave_def waves = { .kind = BT_WAVE_AIRY, .height = 1, .period = 8 };
  double args[BT_CURRENT_ARGS];
  int n = bt_current_pack (&current, args);
  uint64_t was = bt_dive_hash (p->verb);
  assert_int_equal (bt_sea_set_current (p->verb, &current, &p->error), BT_OK);
  assert_int_equal (bt_dive_do (p->op, BT_OP_CURRENT, 0, args, n, &p->error), BT_OK);
  are_one (p, was);
  was = bt_dive_hash (p->verb);
  n = bt_waves_pack (&waves, args);
  assert_int_equal (bt_sea_set_waves (p->verb, &waves, &p->error), BT_OK);
  assert_int_equal (bt_dive_do (p->op, BT_OP_WAVES, 0, args, n, &p->error), BT_OK);
  are_one (p, was);
}

/* STATUS is WANT, and its text has WORDS.  */
static void
is_told (const bt_error *error, bt_status status, bt_status want, const char *words)
{
  assert_int_equal (status, want);
  if (!strstr (error->text, words))
    fail_msg ("`%s' says nothing of `%s'", error->text, words);
}

static void
mistakes_teach_and_change_nothing (void **state)
{
  pair *p = *state;
  bt_error *e = &p->error;
  bt_dive *d = p->verb;
  double rows[6] = { 0 };
  uint64_t was = bt_dive_hash (d);
  is_told (e, bt_vehicle_drive (d, 0, &(bt_sticks){ .surge = 2 }, e), BT_ERR_DOMAIN, "-1 to 1");
  is_told (e, bt_vehicle_release (d, 9, e), BT_ERR_NAME, "9");
  is_told (e, bt_vehicle_move (d, 0, &(bt_flight){ .speed = 0 }, e), BT_ERR_DOMAIN, "speed");
  is_told (e, bt_vehicle_follow (d, 0, &(bt_rows){ rows, 2, 3 }, e), BT_ERR_DOMAIN, "t x y z");
  is_told (e, bt_part_choose (d, BT_PART_TETHER, 0, "model", "dynamical", e), BT_ERR_NAME,
           "dynamic, auto");
  is_told (e, bt_part_choose (d, BT_PART_TETHER, 0, "length", "long", e), BT_ERR_NAME,
           "takes no word");
  is_told (e, bt_part_alter (d, BT_PART_SEA, 0, "densty", 1, e), BT_ERR_NAME, "densty");
  is_told (e, bt_obstacle_drift (d, 0, bt__vec (1, 0, 0), e), BT_ERR_UNSUPPORTED,
           "(track (0 X Y Z))");
  is_told (e, bt_obstacle_drift (d, 99, bt__vec (1, 0, 0), e), BT_ERR_NAME, "99");
  is_told (e, bt_part_alter (d, BT_PART_OBSTACLE, 99, "friction", 1, e), BT_ERR_NAME, "99");
  assert_true (bt_dive_hash (d) == was);
}

static void
types_of_tether_have_names (void **state)
{
  bt_tether_def def;
  bt_error e;
  int n = 0;
  (void)state;
  for (; bt_tether_type_name (n); n++)
    {
      bt_def_init (bt_head_find ("tether"), &def);
      assert_int_equal (bt_def_set_tether_type (&def, bt_tether_type_name (n), &e), BT_OK);
      bt_tether_props_complete (&def.props, 1025, 9.81);
      assert_true (def.props.mass > 0 && isfinite (def.props.wet_weight));
      assert_true (strlen (bt_tether_type_text (n)) > 20);
    }
  assert_true (n >= 6 && !bt_tether_type_text (n) && !bt_tether_type_name (-1));
  assert_string_equal (bt_tether_type_origin (0, "diameter"), "published");
  assert_string_equal (bt_tether_type_origin (0, "ea"), "assumed");
  assert_string_equal (bt_tether_type_origin (0, "load"), "assumed"); /* no field */
  assert_string_equal (bt_tether_type_origin (5, "cdn"), "fitted");
  assert_true (!bt_tether_type_origin (n, "ea") && !bt_tether_type_origin (-1, "ea"));
  bt_def_init (bt_head_find ("tether"), &def);
  assert_int_equal (bt_def_set_tether_type (&def, "fathom", &e), BT_OK);
  assert_true (def.props.diameter == 0.0076 && def.props.breaking_load == 1557);
  is_told (&e, bt_def_set_tether_type (&def, "fathum", &e), BT_ERR_NAME, "fathom");
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test_setup_teardown (a_vehicle_is_flown, with_mass, tear_down),
    cmocka_unit_test_setup_teardown (a_vehicle_follows_a_track, without_mass, tear_down),
    cmocka_unit_test_setup_teardown (things_break_and_are_mended, with_mass, tear_down),
    cmocka_unit_test_setup_teardown (a_tether_is_worked, without_mass, tear_down),
    cmocka_unit_test_setup_teardown (the_sea_changes, without_mass, tear_down),
    cmocka_unit_test_setup_teardown (mistakes_teach_and_change_nothing, without_mass, tear_down),
    cmocka_unit_test (types_of_tether_have_names),
  };
  return cmocka_run_group_tests_name ("verbs", tests, NULL, NULL);
}
