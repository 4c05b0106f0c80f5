/* What a scene does not have costs nothing: its counters stay at zero while it is flown.

   The scenes are those that the bench `skip' times.  That a counter counts is seen in the scene
   that has the part.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "testbed/skip_scenes.h"

enum
{
  WARM = 60,
  STEPS = 600
};

static const skip_case *
case_called (const char *name)
{
  for (int k = 0; k < SKIP_CASES; k++)
    if (!strcmp (skip_cases[k].name, name))
      return skip_cases + k;
  fail_msg ("no scene `%s'", name);
  return NULL;
}

/* What C counts in STEPS of flight, all together after some of them.  */
typedef struct flight
{
  bt_profile before, after;
  uint64_t stray;
} flight;

static flight
fly (const skip_case *c)
{
  flight f;
  bt_dive *dive = skip_begin (c, WARM);
  f.stray = skip_stray_work (dive, c);
  bt_dive_profile (dive, &f.before);
  scene_fly (dive, c->flown, WARM, STEPS);
  bt_dive_profile (dive, &f.after);
  f.stray = skip_stray_work (dive, c) - f.stray;
  bt_dive_free (dive);
  return f;
}

static void
test_absent_parts_do_nothing (void **state)
{
  (void)state;
  for (int k = 0; k < SKIP_CASES; k++)
    {
      flight f = fly (skip_cases + k);
      if (f.stray)
        fail_msg ("%s: %llu counts of parts it lacks", skip_cases[k].name,
                  (unsigned long long)f.stray);
    }
}

/* Or else nothing would be seen above.  */
static void
test_present_parts_are_counted (void **state)
{
  static const struct
  {
    const char *name;
    part part;
  } present[] = { { "bare", PART_MOVING_LINE },
                  { "and waves", PART_WAVES },
                  { "and an obstacle beside it", PART_OBSTACLES },
                  { "and a current with a lee", PART_LEE },
                  { "and mass of the vehicle", PART_BODY } };
  (void)state;
  for (size_t k = 0; k < sizeof present / sizeof *present; k++)
    {
      flight f = fly (case_called (present[k].name));
      if (part_work (&f.after, (int)present[k].part) == part_work (&f.before, (int)present[k].part))
        fail_msg ("%s: what it has counts nothing", present[k].name);
    }
}

/* Of a scene far from everything no box is looked into, no pair measured, no link asked: the line
   is held against the cube about all of it.  */
static void
test_far_obstacles_are_not_looked_at (void **state)
{
  (void)state;
  flight f = fly (case_called ("and 64 obstacles so far"));
  assert_int_equal (f.after.pairs_measured, f.before.pairs_measured);
  assert_int_equal (f.after.boxes_visited, f.before.boxes_visited);
  assert_int_equal (f.after.links_asked, f.before.links_asked);
  assert_int_equal (f.after.links_clear, f.before.links_clear);
  assert_int_equal (f.after.casts, f.before.casts);
}

/* A line that is clear of itself measures a few pairs of its links now and then, and is solved as
   often as one that does not look.  */
static void
test_a_clear_line_hardly_looks_at_itself (void **state)
{
  (void)state;
  bt_error error;
  const double off[] = { BT_PART_TETHER, 0, 0 };
  bt_profile p[2];
  for (int k = 0; k < 2; k++)
    {
      bt_dive *dive = skip_begin (case_called ("bare"), 0);
      if (k)
        scene_must (bt_dive_do (dive, BT_OP_COLLIDE, 0, off, 3, &error), &error);
      scene_fly (dive, 1, 0, 2 * STEPS);
      bt_dive_profile (dive, p + k);
      bt_dive_free (dive);
    }
  assert_true (p[0].line_pairs > 0 && p[0].line_pairs < STEPS / 4);
  assert_int_equal (p[1].line_pairs, 0);
  assert_int_equal (p[0].chain_solves, p[1].chain_solves);
}

/* The points of the line of C after a flight.  */
static void
end_of_flight (const skip_case *c, bt_vec3 *points)
{
  bt_error error;
  bt_dive *dive = skip_begin (c, WARM);
  scene_fly (dive, c->flown, WARM, STEPS);
  scene_must (bt_tether_points (dive, 0, SKIP_NODES + 1, points, &error), &error);
  bt_dive_free (dive);
}

/* What is far away changes no bit.  */
static void
test_far_obstacles_change_nothing (void **state)
{
  (void)state;
  bt_vec3 bare[SKIP_NODES + 1], far[SKIP_NODES + 1];
  end_of_flight (case_called ("bare"), bare);
  end_of_flight (case_called ("and 64 obstacles so far"), far);
  assert_memory_equal (bare, far, sizeof bare);
}

static void
test_a_sleeping_line_is_not_solved (void **state)
{
  (void)state;
  flight f = fly (case_called ("asleep"));
  assert_int_equal (f.after.chain_solves, f.before.chain_solves);
  assert_int_equal (f.after.chain_sleeps - f.before.chain_sleeps, STEPS);
}

/* Of two lines the sleeping one leaves as many solves as one alone has.  */
static void
test_one_of_two_sleeps (void **state)
{
  (void)state;
  flight one = fly (case_called ("bare")), two = fly (case_called ("and a second line asleep"));
  assert_int_equal (two.after.chain_sleeps - two.before.chain_sleeps, STEPS);
  assert_int_equal (two.after.chain_steps - two.before.chain_steps,
                    one.after.chain_steps - one.before.chain_steps);
}

static void
test_a_still_shape_is_not_solved_again (void **state)
{
  (void)state;
  flight f = fly (case_called ("catenary, vehicle still"));
  assert_int_equal (f.after.shape_solves, f.before.shape_solves);
  assert_int_equal (f.after.shape_skips - f.before.shape_skips, STEPS);
  f = fly (case_called ("catenary"));
  assert_int_equal (f.after.shape_solves - f.before.shape_solves, STEPS);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (test_absent_parts_do_nothing),
                                      cmocka_unit_test (test_present_parts_are_counted),
                                      cmocka_unit_test (test_far_obstacles_are_not_looked_at),
                                      cmocka_unit_test (test_a_clear_line_hardly_looks_at_itself),
                                      cmocka_unit_test (test_far_obstacles_change_nothing),
                                      cmocka_unit_test (test_a_sleeping_line_is_not_solved),
                                      cmocka_unit_test (test_one_of_two_sleeps),
                                      cmocka_unit_test (test_a_still_shape_is_not_solved_again) };
  return cmocka_run_group_tests_name ("skip", tests, NULL, NULL);
}
