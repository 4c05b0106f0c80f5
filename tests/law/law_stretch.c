/* A line of model `auto' is solved ahead where all is calm: within its accuracy, and to the same
   bits however it is asked.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "math/vec.h"
#include "testbed/profile.h"
#include "testbed/scene.h"

enum
{
  POINTS = 11,
  SECOND = 60, /* steps */
  FLIGHTS = 6,
  LEGS = 5 /* of a flight, between which the sticks change */
};

/* ---- Calm flights ---- */

static double
lot (uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* A vehicle without mass on a line that is neither tight nor heaped, in water that flows.  */
static void
draw (scene *s, uint64_t *seed, double accuracy)
{
  double length = lot (seed, 15, 60), way = length * lot (seed, 0.75, 0.92),
         bearing = lot (seed, 0, 6.28);
  scene_clear (s);
  scene_current (s, bt__vec (lot (seed, 0.05, 0.25), lot (seed, -0.1, 0.1), 0));
  scene_vehicle (s,
                 bt__vec (0.9 * way * cos (bearing), 0.9 * way * sin (bearing), -5 - 0.43 * way));
  bt_tether_def *line = scene_line (s, bt__vec (0, 0, -5), length, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.accuracy = accuracy;
  line->props.wet_weight = lot (seed, 0, 0.2);
}

static void
drive (bt_dive *dive, double surge, double sway, double heave, double yaw)
{
  bt_error error;
  bt_sticks sticks = { surge, sway, heave, yaw };
  scene_must (bt_vehicle_drive (dive, 0, &sticks, &error), &error);
}

static void
fly_leg (bt_dive *dive, uint64_t *seed)
{
  double speed = lot (seed, 0, 0.3);
  drive (dive, speed, lot (seed, -0.1, 0.1), lot (seed, -0.1, 0.1), lot (seed, -0.3, 0.3));
}

/* The flight SEED, at ACCURACY; as it was laid and no step taken.  */
static bt_dive *
begin (uint64_t *seed, double accuracy)
{
  static scene s;
  draw (&s, seed, accuracy);
  return scene_begin (&s.world);
}

/* How far the lines of two dives are apart, m, and the forces on their ends, as a share of 250 N at
   least; the larger of what was and is.  */
static void
compare (const bt_dive *a, const bt_dive *b, double *place, double *force)
{
  bt_vec3 p[POINTS], q[POINTS];
  bt_tether_view v, w;
  bt_error error;
  scene_must (bt_tether_points (a, 0, POINTS, p, &error), &error);
  scene_must (bt_tether_points (b, 0, POINTS, q, &error), &error);
  scene_must (bt_dive_tether (a, 0, &v, &error), &error);
  scene_must (bt_dive_tether (b, 0, &w, &error), &error);
  for (int k = 0; k < POINTS; k++)
    *place = fmax (*place, bt__distance (p[k], q[k]));
  double off
      = fmax (fabs (v.tension_end - w.tension_end), fabs (v.tension_anchor - w.tension_anchor));
  *force = fmax (*force, off / fmax (250, w.tension_max));
}

/* Where tensions are asked to no accuracy, no step is taken otherwise than whole.  */
static void
step_whole (bt_dive *dive)
{
  bt_error error;
  scene_must (bt_part_alter (dive, BT_PART_TETHER, 0, "tension-accuracy", INFINITY, &error),
              &error);
}

/* Beside the same flight in steps of a sixtieth of a second, half an accuracy at most is due to
   time, most of it where sticks jump; and the line was solved for fewer than half of the steps.  */
static void
test_error_is_below_what_is_asked (void **state)
{
  (void)state;
  for (uint64_t f = 1; f <= FLIGHTS; f++)
    {
      double accuracy = f % 2 ? 0.05 : 0.02, place = 0, force = 0;
      uint64_t one = 1000 * f, two = one;
      bt_dive *ahead = begin (&one, accuracy), *whole = begin (&two, accuracy);
      step_whole (whole);
      for (int leg = 0; leg < LEGS; leg++)
        {
          fly_leg (ahead, &one);
          fly_leg (whole, &two);
          for (int k = 0; k < 24; k++)
            {
              scene_run (ahead, 17); /* no divisor of any stretch */
              scene_run (whole, 17);
              compare (ahead, whole, &place, &force);
            }
        }
      bt_profile q = profile_of (whole);
      bt_dive_free (ahead);
      bt_dive_free (whole);
      assert_true (q.chain_stretched == 0);
      if (!(place < 0.5 * accuracy) || !(force < 0.02))
        fail_msg ("flight %d: %g m of %g, force %g", (int)f, place, accuracy, force);
    }
}

/* A vehicle that goes round in a circle: the finer, the better.  */
static void
test_error_follows_the_accuracy (void **state)
{
  static const double asked[] = { 0.2, 0.05, 0.01 };
  (void)state;
  for (int a = 0; a < 3; a++)
    {
      double place = 0, force = 0;
      bt_dive *dive[2];
      for (int k = 0; k < 2; k++)
        {
          uint64_t seed = 5;
          dive[k] = begin (&seed, asked[a]);
          if (k)
            step_whole (dive[k]);
          drive (dive[k], 0.2, 0, 0, 0.4);
          scene_run (dive[k], 20 * SECOND);
        }
      for (int k = 0; k < 60; k++)
        {
          scene_run (dive[0], 7);
          scene_run (dive[1], 7);
          compare (dive[0], dive[1], &place, &force);
        }

      assert_true (profile_of (dive[0]).chain_stretched > 20 * SECOND);
      if (!(place < 0.1 * asked[a]))
        fail_msg ("%g m asked: %g m", asked[a], place);
      bt_dive_free (dive[0]);
      bt_dive_free (dive[1]);
    }
}

/* A vehicle that comes back slackens its line, which bends more every second: nodes come in time,
   however long the line is solved ahead.  */
static void
test_nodes_come_in_time (void **state)
{
  (void)state;
  for (double speed = 0.3; speed < 0.65; speed += 0.1)
    {
      static scene s;
      bt_error error;
      double most = 0, estimate, accuracy = 0.03;
      scene_clear (&s);
      scene_vehicle (&s, bt__vec (0, 26, -14))->surge_speed = speed;
      bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -5), 31, 20);
      line->props.model = BT_MODEL_AUTO;
      line->props.accuracy = accuracy;
      line->props.wet_weight = 0.2;
      bt_dive *dive = scene_begin (&s.world);
      drive (dive, -1, 0, 0, 0);
      for (int k = 0; k < 240; k++)
        {
          scene_run (dive, 1);
          scene_must (bt_tether_error_estimate (dive, 0, &estimate, &error), &error);
          most = fmax (most, estimate);
        }
      uint64_t ahead = profile_of (dive).chain_stretched;
      bt_dive_free (dive);
      if (!(most < accuracy) || ahead == 0)
        fail_msg ("%g m/s: %g m of %g", speed, most, accuracy);
    }
}

/* A line that is run out until it is nearly taut: its tension grows to several times the accuracy
   within many a stretch, and is told as well as in steps of a sixtieth of a second.  */
static void
test_a_tension_that_grows (void **state)
{
  (void)state;
  for (int f = 0; f < 4; f++)
    {
      double place = 0, force = 0, accuracy = f % 2 ? 0.2 : 0.05, to = 40, rate = 0.3 + 0.2 * f;
      bt_tether_view first, last;
      bt_dive *dive[2];
      for (int k = 0; k < 2; k++)
        {
          static scene s;
          scene_clear (&s);
          scene_current (&s, bt__vec (-0.2, 0.4, 0.1));
          scene_vehicle (&s, bt__vec (34, 0, -10))->pull = 1e6;
          bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), to, 20);
          line->props.model = BT_MODEL_AUTO;
          line->props.accuracy = accuracy;
          dive[k] = scene_begin (&s.world);
          scene_run (dive[k], 2 * SECOND);
        }
      step_whole (dive[1]);
      bt_error error;
      scene_must (bt_dive_tether (dive[0], 0, &first, &error), &error);
      uint64_t before = profile_of (dive[0]).chain_steps;
      int steps = (int)(0.148 * to / rate * SECOND), told = 0;
      for (int k = 0; k < 2; k++)
        scene_must (
            bt_vehicle_move (dive[k], 0, &(bt_flight){ bt__vec (to, 0, -10), rate }, &error),
            &error);
      for (; told < steps; told += 17)
        {
          scene_run (dive[0], 17);
          scene_run (dive[1], 17);
          compare (dive[0], dive[1], &place, &force);
        }
      scene_must (bt_dive_tether (dive[0], 0, &last, &error), &error);
      uint64_t solved = profile_of (dive[0]).chain_steps - before;
      bt_dive_free (dive[0]);
      bt_dive_free (dive[1]);
      if (!(last.tension_max > 4 * first.tension_max) || !(place < 0.2 * accuracy)
          || !(force < 0.02) || (int)solved * 4 > told)
        fail_msg ("%g m/s: %g to %g N, %g m of %g, force %g, %d solves in %d steps", rate,
                  first.tension_max, last.tension_max, place, accuracy, force, (int)solved, told);
    }
}

/* A stick that is never still: its vehicle is never where it was foreseen, by less than counts or
   by more, and each time the line goes on as it was told, without a jerk.  */
static void
test_sticks_are_never_still (void **state)
{
  static const int every[] = { 1, 2, 5, 20 };
  uint64_t stretched = 0;
  (void)state;
  for (int e = 0; e < 4; e++)
    {
      uint64_t one = 7, two = 7, sticks = 9;
      double place = 0, force = 0, surge = 0, yaw = 0;
      bt_dive *ahead = begin (&one, 0.05), *whole = begin (&two, 0.05);
      step_whole (whole);
      for (int k = 0; k < 1500; k += every[e])
        {
          double follows = every[e] / (every[e] + 10.0);
          surge += follows * (lot (&sticks, -0.1, 0.4) - surge);
          yaw += follows * (lot (&sticks, -0.3, 0.3) - yaw);
          drive (ahead, surge, 0, 0, yaw);
          drive (whole, surge, 0, 0, yaw);
          scene_run (ahead, every[e]);
          scene_run (whole, every[e]);
          compare (ahead, whole, &place, &force);
        }
      stretched += profile_of (ahead).chain_stretched;
      if (!(place < 0.2 * 0.05)) /* forces jump in either, where nodes come and go */
        fail_msg ("sticks every %d steps: %g m", every[e], place);
      bt_dive_free (ahead);
      bt_dive_free (whole);
    }
  assert_true (stretched > 100);
}

/* ---- The same bits ---- */

/* Step DIVE until it has gone a step into a stretch and the stretch goes on; it is asked for
   nothing.  */
static void
run_into_a_stretch (bt_dive *dive)
{
  uint64_t before, stretched;
  int k = 0;
  for (int in = 0; in < 2; k++)
    {
      before = profile_of (dive).chain_solves;
      stretched = profile_of (dive).chain_stretched;
      scene_run (dive, 1);
      in = profile_of (dive).chain_solves == before && profile_of (dive).chain_stretched > stretched
               ? in + 1
               : 0;
      assert_true (k < 600);
    }
}

static bt_dive *
begin_calm (uint64_t seed)
{
  bt_dive *dive = begin (&seed, 0.05);
  drive (dive, 0.2, 0, 0, 0.1);
  return dive;
}

/* All that can be asked of a line; of its energies, if it moves.  */
static void
ask_all (const bt_dive *dive)
{
  bt_vec3 p[POINTS];
  bt_tether_view v;
  bt_energy e;
  bt_error error;
  double radius;
  scene_must (bt_tether_points (dive, 0, POINTS, p, &error), &error);
  scene_must (bt_dive_tether (dive, 0, &v, &error), &error);
  if (v.props.model >= BT_MODEL_DYNAMIC)
    scene_must (bt_tether_energy (dive, 0, &e, &error), &error);
  scene_must (bt_tether_tightest_bend (dive, 0, &radius, &error), &error);
}

static void
test_the_same_however_it_is_asked (void **state)
{
  (void)state;
  bt_error error;
  bt_dive *asked = begin_calm (3), *left = begin_calm (3), *three = begin_calm (3);
  scene_must (bt_dive_set_threads (three, 3, &error), &error);
  for (int k = 0; k < 20; k++)
    {
      for (int n = 0; n < 31; n++)
        {
          scene_run (asked, 1);
          ask_all (asked);
        }
      scene_run (left, 31);
      scene_run (three, 31);
      assert_true (bt_dive_hash (asked) == bt_dive_hash (left));
      assert_true (bt_dive_hash (three) == bt_dive_hash (left));
    }
  assert_true (profile_of (left).chain_stretched > 300);
  bt_dive_free (asked);
  bt_dive_free (left);
  bt_dive_free (three);
}

static void
test_the_same_from_within (void **state)
{
  (void)state;
  bt_error error;
  bt_dive *dive = begin_calm (4), *fork;
  run_into_a_stretch (dive);
  size_t size = bt_dive_state_size (dive), packed = bt_dive_keep_size (dive);
  void *saved = malloc (size), *kept = malloc (packed);
  bt_dive_save (dive, saved);
  packed = bt_dive_keep (dive, kept);
  scene_must (bt_dive_fork (dive, &fork, &error), &error);
  bt_vec3 p[3][POINTS];
  scene_must (bt_tether_points (dive, 0, POINTS, p[0], &error), &error);
  scene_must (bt_tether_points (fork, 0, POINTS, p[1], &error), &error);
  scene_run (dive, 100);
  scene_run (fork, 100);
  uint64_t hash = bt_dive_hash (dive);
  assert_true (bt_dive_hash (fork) == hash);
  scene_must (bt_dive_restore (dive, saved, size, &error), &error);
  scene_must (bt_tether_points (dive, 0, POINTS, p[2], &error), &error);
  assert_memory_equal (p[0], p[1], sizeof p[0]);
  assert_memory_equal (p[0], p[2], sizeof p[0]);
  scene_run (dive, 100);
  assert_true (bt_dive_hash (dive) == hash);
  scene_must (bt_dive_restore (fork, kept, packed, &error), &error);
  scene_run (fork, 100);
  assert_true (bt_dive_hash (fork) == hash);
  free (saved);
  free (kept);
  bt_dive_free (fork);
  bt_dive_free (dive);
}

/* ---- What ends it ---- */

/* The operations that find a line in the midst of a stretch.  */
static bt_status
do_one (bt_dive *dive, int which, bt_error *error)
{
  static const bt_current flows = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0, 0.3, 0 } } };
  switch (which)
    {
    case 0:
      return bt_tether_cut (dive, 0, 8, error);
    case 1:
      return bt_tether_pay_out (dive, 0, &(bt_spooling){ 100, 0.5 }, error);
    case 2:
      return bt_tether_haul_in (dive, 0, &(bt_spooling){ 12, 0.2 }, error);
    case 3:
      return bt_sea_set_current (dive, &flows, error);
    case 4:
      return bt_part_alter (dive, BT_PART_TETHER, 0, "mass", 0.2, error);
    case 5:
      return bt_part_choose (dive, BT_PART_TETHER, 0, "model", "dynamic", error);
    case 6:
      return bt_part_choose (dive, BT_PART_TETHER, 0, "model", "catenary", error);
    case 7:
      return bt_vehicle_place (dive, 0, bt__vec (1, 1, -8), error);
    case 8:
      return bt_vehicle_lay (dive, 0, bt__vec (2, 1, -9), error);
    case 9:
      return bt_vehicle_release (dive, 0, error);
    default:
      return bt_part_alter (dive, BT_PART_TETHER, 0, "accuracy", 0.01, error);
    }
}

enum
{
  DONE = 11
};

/* Whatever is done in the midst of a stretch is done to the line where it is told to be: nothing
   that takes no time moves it, unless that is what it does; and it goes on alike in a fork.  */
static void
test_what_is_done_within (void **state)
{
  (void)state;
  for (int which = 0; which < DONE; which++)
    {
      bt_error error;
      bt_dive *dive = begin_calm (6), *fork;
      bt_vec3 before[POINTS], after[POINTS];
      run_into_a_stretch (dive);
      scene_must (bt_dive_fork (dive, &fork, &error), &error);
      scene_must (bt_tether_points (dive, 0, POINTS, before, &error), &error);
      scene_must (do_one (dive, which, &error), &error);
      scene_must (do_one (fork, which, &error), &error);
      scene_must (bt_tether_points (dive, 0, POINTS, after, &error), &error);
      if (which >= 1 && which <= 5)
        assert_memory_equal (before, after, sizeof before);
      assert_true (bt_dive_hash (dive) == bt_dive_hash (fork));
      for (int k = 0; k < 90; k++)
        {
          scene_run (dive, 1);
          ask_all (dive);
        }
      scene_run (fork, 90);
      assert_true (bt_dive_hash (dive) == bt_dive_hash (fork));
      bt_dive_free (dive);
      bt_dive_free (fork);
    }
}

/* A vehicle arrives in the step in which it would without.  */
static void
test_events_come_when_they_should (void **state)
{
  (void)state;
  int64_t step[2];
  for (int k = 0; k < 2; k++)
    {
      uint64_t seed = 3;
      bt_error error;
      bt_vehicle_view v;
      bt_dive *dive = begin (&seed, 0.05);
      if (k)
        step_whole (dive);
      scene_must (bt_dive_vehicle (dive, 0, &v, &error), &error);
      bt_flight flight = { bt__scale (0.93, v.position), 0.1 };
      scene_must (bt_vehicle_move (dive, 0, &flight, &error), &error);
      do
        {
          scene_run (dive, 1);
          scene_must (bt_dive_vehicle (dive, 0, &v, &error), &error);
        }
      while (!v.arrived && bt_dive_steps (dive) < 6000);
      step[k] = bt_dive_steps (dive);
      assert_true (v.arrived && (k || profile_of (dive).chain_stretched > 100));
      bt_dive_free (dive);
    }
  assert_true (step[0] == step[1]);
}

/* The largest pull on a vehicle that gives way at PULL newtons and runs a line of stiffness EA taut
   at 1 m/s, N.  */
static double
largest_pull (double pull, double ea, double wet_weight)
{
  static scene s;
  bt_error error;
  bt_tether_view v;
  double most = 0;
  scene_clear (&s);
  scene_vehicle (&s, bt__vec (17, 0, -12))->pull = pull;
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), 20, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.accuracy = 0.05;
  line->props.ea = ea;
  line->props.wet_weight = wet_weight;
  bt_dive *dive = scene_begin (&s.world);
  drive (dive, 1, 0, 0, 0);
  for (int k = 0; k < 16 * SECOND; k++)
    {
      scene_run (dive, 1);
      scene_must (bt_dive_tether (dive, 0, &v, &error), &error);
      most = fmax (most, v.tension_end);
    }
  assert_true (profile_of (dive).chain_stretched > 3 * SECOND);
  bt_dive_free (dive);
  return most;
}

/* Nor does a vehicle that gives way hold a line that was to be solved ahead.  */
static void
test_no_vehicle_pulls_harder (void **state)
{
  static const double ea[] = { 1e4, 3e4, 1e5 };
  (void)state;
  for (int k = 0; k < 6; k++)
    {
      double most = largest_pull (100, ea[k % 3], k < 3 ? 0 : 0.1);
      if (!(most < 104))
        fail_msg ("EA %g N: %g N", ea[k % 3], most);
    }
}

/* ---- Conservation, obstacles ---- */

/* A line that comes to rest in still water, its vehicle having stopped: energy goes, and none
   comes.  */
static void
test_energy_is_not_gained (void **state)
{
  (void)state;
  static scene s;
  bt_error error;
  bt_energy e;
  scene_clear (&s);
  scene_vehicle (&s, bt__vec (22, 0, -12));
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), 30, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.wet_weight = 0.1;
  bt_dive *dive = scene_begin (&s.world);
  drive (dive, 0, 0.3, 0, 0);
  scene_run (dive, 5 * SECOND);
  drive (dive, 0, 0, 0, 0);
  scene_run (dive, SECOND);
  uint64_t stretched = profile_of (dive).chain_stretched;
  double least = INFINITY, most = 0, first = 0;
  for (int k = 0; k < 40 * SECOND; k++)
    {
      scene_must (bt_tether_energy (dive, 0, &e, &error), &error);
      double all = e.kinetic + e.strain + e.gravity + e.bending;
      first = k ? first : all;
      most = fmax (most, all - least);
      least = fmin (least, all);
      scene_run (dive, 1);
    }
  assert_true (profile_of (dive).chain_stretched - stretched > 10 * SECOND);
  if (!(most < 1e-3 * (first - least)))
    fail_msg ("of %g J that were lost, %g J came back", first - least, most);
  bt_dive_free (dive);
}

/* How often a line of ACCURACY touches that is drawn on to a post at SPEED, with a BALL that comes
   down on it or none; it passes through neither in any step, and touches nothing within a
   stretch.  *AHEAD: for how many steps it was solved ahead before.  */
static int
touches_of (double accuracy, double speed, int ball, uint64_t *ahead)
{
  static scene s;
  double track[] = { 0, 9, 1, -3, 0, 20, 9, 1, -10, 0 }; /* t x y z heading */
  int touched = 0;
  scene_clear (&s);
  scene_vehicle (&s, bt__vec (17, 0, -12));
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), 20, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.accuracy = accuracy;
  line->props.diameter = 0.01;
  scene_bar (&s, bt__vec (12, 2.5, 0), bt__vec (12, 2.5, -30), 0.3);
  if (ball)
    {
      bt_obstacle_def *o = scene_obstacle (&s, "sphere");
      o->radius = 0.8;
      o->track = (bt_rows){ track, 2, 5 };
    }
  bt_dive *dive = scene_begin (&s.world);
  drive (dive, speed, 0, 0, 0);
  for (int k = 0; k < 8.5 * SECOND / speed; k++)
    {
      bt_clearance c;
      bt_error error;
      uint64_t before = profile_of (dive).chain_stretched;
      scene_run (dive, 1);
      int told = profile_of (dive).chain_stretched > before;
      scene_must (bt_tether_clearance (dive, 0, -1, &c, &error), &error);
      touched += c.distance < 0.001;
      *ahead = touched ? *ahead : profile_of (dive).chain_stretched;
      if (!(c.distance > (told ? line->props.diameter : -0.0045)))
        fail_msg ("%g m, %g m/s, step %d: %g m from obstacle %d", accuracy, speed, k, c.distance,
                  c.object);
    }
  bt_dive_free (dive);
  return touched;
}

/* Nor does it where so little accuracy is asked that its way alone keeps a stretch short.  */
static void
test_nothing_is_passed_through (void **state)
{
  static const double accuracy[] = { 0.05, 1, 100 }, speed[] = { 0.15, 0.4, 1 };
  uint64_t ahead = 0, none;
  (void)state;
  for (int a = 0; a < 3; a++)
    for (int v = 0; v < 3; v++)
      assert_true (touches_of (accuracy[a], speed[v], 0, &ahead) > 0 && ahead > 4 * SECOND);
  assert_true (touches_of (0.05, 0.15, 1, &none) > touches_of (0.05, 0.15, 0, &ahead));
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_error_is_below_what_is_asked),
    cmocka_unit_test (test_error_follows_the_accuracy),
    cmocka_unit_test (test_nodes_come_in_time),
    cmocka_unit_test (test_a_tension_that_grows),
    cmocka_unit_test (test_sticks_are_never_still),
    cmocka_unit_test (test_the_same_however_it_is_asked),
    cmocka_unit_test (test_the_same_from_within),
    cmocka_unit_test (test_what_is_done_within),
    cmocka_unit_test (test_events_come_when_they_should),
    cmocka_unit_test (test_no_vehicle_pulls_harder),
    cmocka_unit_test (test_energy_is_not_gained),
    cmocka_unit_test (test_nothing_is_passed_through),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
