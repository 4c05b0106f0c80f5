/* Several lines are solved ahead together where they do not meet: as many steps of each in one as
   of a line alone, to the same bits for any number of threads, and through nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "collide/pair.h"
#include "math/vec.h"
#include "testbed/profile.h"
#include "testbed/scene.h"

enum
{
  POINTS = 11,
  FINE = 97,
  SECOND = 60, /* steps */
  LINES = 6
};

#define ACCURACY 0.02
#define DIAMETER 0.01
#define OFF_CHORD 0.1 /* m: points are told on smooth curves, contact is between chords */

/* ---- Fleets ---- */

static double
lot (uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

static bt_tether_def *
add_line (scene *s, bt_vec3 anchor, bt_vec3 vehicle, double length)
{
  scene_vehicle (s, vehicle);
  bt_tether_def *line = scene_line (s, anchor, length, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.accuracy = ACCURACY;
  line->props.diameter = DIAMETER;
  line->props.wet_weight = 0.1;
  return line;
}

/* N lines side by side, SPACING metres apart, slack, in water that flows along them.  */
static void
draw_fleet (scene *s, int n, double spacing)
{
  scene_clear (s);
  scene_current (s, bt__vec (0.1, 0.02, 0));
  for (int i = 0; i < n; i++)
    add_line (s, bt__vec (0, spacing * i, -5), bt__vec (22, spacing * i, -14), 30);
}

static void
drive (bt_dive *dive, int i, double surge, double sway, double heave, double yaw)
{
  bt_error error;
  bt_sticks sticks = { surge, sway, heave, yaw };
  scene_must (bt_vehicle_drive (dive, i, &sticks, &error), &error);
}

/* Give each of the N vehicles sticks, and many of them the same as before.  */
static void
drive_all (bt_dive *dive, int n, uint64_t *seed)
{
  for (int i = 0; i < n; i++)
    if (lot (seed, 0, 1) < 0.5)
      drive (dive, i, lot (seed, -0.1, 0.2), lot (seed, -0.1, 0.1), 0, lot (seed, -0.3, 0.3));
}

/* What is asked of a line is not to be remembered by it.  */
static void
ask (const bt_dive *dive, int i)
{
  bt_vec3 p[POINTS];
  bt_tether_view v;
  bt_error error;
  scene_must (bt_tether_points (dive, i, POINTS, p, &error), &error);
  scene_must (bt_dive_tether (dive, i, &v, &error), &error);
}

/* ---- The gain ---- */

/* How often the N lines of a fleet were solved in half a minute of calm flight, for each line.  */
static double
solves_of (int n, double spacing)
{
  static scene s;
  draw_fleet (&s, n, spacing);
  bt_dive *dive = scene_begin (&s.world);
  for (int i = 0; i < n; i++)
    drive (dive, i, 0.1, 0, 0, 0.05);
  scene_run (dive, 30 * SECOND);
  bt_profile p = profile_of (dive);
  bt_dive_free (dive);
  return (double)p.chain_solves / n;
}

/* Lines that are far apart cost each what one alone does; a second that runs 5 cm beside it, within
   the space that both sweep, may not be solved ahead.  */
static void
test_each_gains_what_one_alone_does (void **state)
{
  (void)state;
  double one = solves_of (1, 0), two = solves_of (2, 4), many = solves_of (LINES, 4);
  assert_true (one < 0.3 * 30 * SECOND);
  assert_true (two < 1.1 * one && many < 1.1 * one);
  assert_true (solves_of (2, 0.05) > 3 * one);
}

/* Each line of a fleet goes as it does alone, to the bit: far from others nothing of them counts.
 */
static void
test_each_goes_as_alone (void **state)
{
  static scene s;
  bt_dive *alone, *fleet;
  bt_vec3 p[POINTS], q[POINTS];
  bt_error error;
  (void)state;
  draw_fleet (&s, 1, 0);
  alone = scene_begin (&s.world);
  draw_fleet (&s, 3, 4);
  fleet = scene_begin (&s.world);
  drive (alone, 0, 0.1, 0.1, 0, 0.05);
  drive (fleet, 0, 0.1, 0.1, 0, 0.05);
  drive (fleet, 1, 0.3, 0, 0, 0.2);
  for (int k = 0; k < 40; k++)
    {
      scene_run (alone, 17);
      scene_run (fleet, 17);
      drive (fleet, 2, 0.02 * (k % 5), 0, 0, 0);
      scene_must (bt_tether_points (alone, 0, POINTS, p, &error), &error);
      scene_must (bt_tether_points (fleet, 0, POINTS, q, &error), &error);
      assert_memory_equal (p, q, sizeof p);
    }
  bt_dive_free (alone);
  bt_dive_free (fleet);
}

/* ---- The same bits ---- */

/* Posts that stand between the lines of a fleet 4 m apart, beside them or in the way.  */
static void
add_posts (scene *s, double beside)
{
  for (int i = 0; i + 1 < LINES; i++)
    scene_bar (s, bt__vec (12, 4 * i + beside, 0), bt__vec (12, 4 * i + beside, -60), 0.2);
}

/* A fleet is asked about after each step, or after many, by one thread or three, and saved and
   forked between.  */
static void
check_bits (const scene *s, uint64_t first, uint64_t *stretched, uint64_t *shared)
{
  bt_error error;
  bt_dive *dive[3], *fork = NULL;
  uint64_t seed[3] = { first, first, first };
  for (int d = 0; d < 3; d++)
    dive[d] = scene_begin (&s->world);
  scene_must (bt_dive_set_threads (dive[2], 3, &error), &error);
  for (int k = 0; k < 40; k++)
    {
      for (int d = 0; d < 3; d++)
        drive_all (dive[d], LINES, &seed[d]);
      for (int n = 0; n < 23; n++)
        {
          scene_run (dive[0], 1);
          for (int i = 0; i < LINES; i++)
            ask (dive[0], i);
        }
      scene_run (dive[1], 23);
      scene_run (dive[2], 23);
      assert_true (bt_dive_hash (dive[0]) == bt_dive_hash (dive[1]));
      assert_true (bt_dive_hash (dive[2]) == bt_dive_hash (dive[1]));
      if (k % 10 != 5)
        continue;
      scene_must (bt_dive_fork (dive[1], &fork, &error), &error);
      bt_dive_free (dive[1]);
      dive[1] = fork;
    }
  *stretched += profile_of (dive[0]).chain_stretched;
  *shared += profile_of (dive[2]).shared_steps;
  for (int d = 0; d < 3; d++)
    bt_dive_free (dive[d]);
}

static void
test_the_same_on_threads (void **state)
{
  static const double spacing[] = { 4, 4, 4, 0.5, 0.05 }, beside[] = { 0, 1.5, 0.5, 0, 0 };
  static scene s;
  uint64_t stretched = 0, shared = 0;
  (void)state;
  for (uint64_t k = 0; k < 5; k++)
    {
      draw_fleet (&s, LINES, spacing[k]);
      if (beside[k] > 0)
        add_posts (&s, beside[k]);
      check_bits (&s, 100 + k, &stretched, &shared);
    }
  assert_true (stretched > 5000 && shared > 500);
}

/* ---- Through nothing ---- */

/* How far line 1 is above line 0 where they cross, seen from above.  */
static double
height_at_crossing (const bt_dive *dive)
{
  bt_vec3 p[FINE], q[FINE];
  bt_error error;
  double least = INFINITY, height = 0;
  scene_must (bt_tether_points (dive, 0, FINE, p, &error), &error);
  scene_must (bt_tether_points (dive, 1, FINE, q, &error), &error);
  for (int k = 0; k + 1 < FINE; k++)
    for (int m = 0; m + 1 < FINE; m++)
      {
        double u, v;
        bt_vec3 d = bt__sub (p[k + 1], p[k]), e = bt__sub (q[m + 1], q[m]),
                r = bt__sub (p[k], q[m]);
        bt__closest_segments (bt__vec (r.x, r.y, 0), bt__vec (d.x, d.y, 0), bt__vec (e.x, e.y, 0),
                              &u, &v);
        bt_vec3 off = bt__axpy (bt__axpy (r, u, d), -v, e);
        double plan = hypot (off.x, off.y);
        height = plan < least ? -off.z : height;
        least = fmin (least, plan);
      }
  return height;
}

/* Two lines cross, the second some way above the first; its vehicle sinks at SPEED until the second
   hangs over the first.  Return in how many steps they touched; *AHEAD: for how many a line was
   ahead before.  */
static int
touches_of (double speed, uint64_t *ahead)
{
  static scene s;
  int touched = 0;
  scene_clear (&s);
  add_line (&s, bt__vec (0, 0, -10), bt__vec (16, 0, -10), 16.4);
  add_line (&s, bt__vec (8, -10, -5), bt__vec (8, 6, -5), 20);
  bt_dive *dive = scene_begin (&s.world);
  scene_run (dive, 5 * SECOND);
  drive (dive, 1, 0, 0, -speed, 0);
  for (int k = 0; k < 11.5 * SECOND / speed; k++)
    {
      uint64_t before = profile_of (dive).touches;
      scene_run (dive, 1);
      touched += profile_of (dive).touches > before;
      *ahead = touched ? *ahead : profile_of (dive).chain_stretched;
      if (k % 10 == 0 && !(height_at_crossing (dive) > -OFF_CHORD))
        fail_msg ("%g m/s, step %d: %g m above", speed, k, height_at_crossing (dive));
    }
  bt_dive_free (dive);
  return touched;
}

static void
test_lines_do_not_pass_through_each_other (void **state)
{
  static const double speed[] = { 0.2, 0.35, 0.5 };
  (void)state;
  for (int v = 0; v < 3; v++)
    {
      uint64_t ahead = 0;
      int touched = touches_of (speed[v], &ahead);
      if (!(touched > SECOND && ahead > SECOND))
        fail_msg ("%g m/s: %d steps of touch, %d ahead", speed[v], touched, (int)ahead);
    }
}

/* A vehicle that is put elsewhere takes its line to where another was told to go.  */
static void
test_a_line_is_put_in_the_way (void **state)
{
  static scene s;
  bt_error error;
  (void)state;
  draw_fleet (&s, 2, 4);
  bt_dive *dive = scene_begin (&s.world);
  drive (dive, 0, 0, 0.3, 0, 0);
  scene_run (dive, 200);
  assert_true (profile_of (dive).chain_stretched > 100);
  scene_must (bt_vehicle_place (dive, 1, bt__vec (18, -3, -12), &error), &error);
  for (int k = 0; k < 20 * SECOND; k++)
    scene_run (dive, 1);
  assert_true (profile_of (dive).chain_unconverged == 0);
  bt_dive_free (dive);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_each_gains_what_one_alone_does),
    cmocka_unit_test (test_each_goes_as_alone),
    cmocka_unit_test (test_the_same_on_threads),
    cmocka_unit_test (test_lines_do_not_pass_through_each_other),
    cmocka_unit_test (test_a_line_is_put_in_the_way),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
