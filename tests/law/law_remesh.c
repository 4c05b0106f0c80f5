/* Nodes of a line of model `auto' come and go without moving its tension.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "math/vec.h"
#include "testbed/profile.h"
#include "testbed/race.h"
#include "testbed/scene.h"

enum
{
  LINES = 24,
  SECOND = 60 /* steps */
};

/* N, and a share of the tension: less counts as nothing.  A line as laid is measured beside them.
 */
#define LEAST 5.0
#define SHARE 0.02

static double
lot (uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* A line that hangs or lies in a current between a point and a vehicle, from slack to nearly
   straight, from soft to stiff.  */
static bt_dive *
begin (uint64_t seed, double accuracy)
{
  static scene s;
  uint64_t r = seed;
  double length = lot (&r, 10, 100), way = length * (1 - pow (10, lot (&r, -3, -0.5))),
         rise = lot (&r, -0.5, 0.5);
  scene_clear (&s);
  s.world.sea.depth = 500;
  scene_current (&s, bt__vec (lot (&r, -0.3, 0.3), lot (&r, 0.05, 0.6), 0));
  scene_vehicle (&s, bt__vec (way * sqrt (1 - rise * rise), 0, -150 + way * rise))->pull = 1e7;
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -150), length, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.ea = pow (10, lot (&r, 3.5, 7));
  line->props.wet_weight = lot (&r, 0, 1);
  line->props.accuracy = accuracy;
  return scene_begin (&s.world);
}

static void
ask (bt_dive *dive, bt_tether_view *v)
{
  bt_error error;
  scene_must (bt_dive_tether (dive, 0, v, &error), &error);
}

/* The most that either end's tension is off FIRST in the next COUNT steps, as a share of what it
   may be off.  */
static double
largest_jump (bt_dive *dive, const bt_tether_view *first, int count)
{
  double most = 0;
  for (int k = 0; k < count; k++)
    {
      bt_tether_view v;
      scene_run (dive, 1);
      ask (dive, &v);
      double may = fmax (LEAST, SHARE * first->tension_max);
      most = fmax (most, fabs (v.tension_end - first->tension_end) / may);
      most = fmax (most, fabs (v.tension_anchor - first->tension_anchor) / may);
    }
  return most;
}

static void
ask_for (bt_dive *dive, double accuracy)
{
  bt_error error;
  scene_must (bt_part_alter (dive, BT_PART_TETHER, 0, "accuracy", accuracy, &error), &error);
}

/* Let the vehicle creep across the line, lest the line sleep.  */
static void
creep (bt_dive *dive)
{
  bt_error error;
  bt_vehicle_view v;
  scene_must (bt_dive_vehicle (dive, 0, &v, &error), &error);
  bt_flight flight = { bt__add (v.position, bt__vec (0, 1, 0)), 5e-4 };
  scene_must (bt_vehicle_move (dive, 0, &flight, &error), &error);
}

/* At rest, all but, with few nodes and many by turns.  */
static void
test_at_rest (void **state)
{
  int remeshed = 0, wrong = 0;
  (void)state;
  for (uint64_t f = 1; f <= LINES; f++)
    {
      bt_dive *dive = begin (f, 0.002);
      creep (dive);
      scene_run (dive, 60 * SECOND);
      for (int turn = 0; turn < 4; turn++)
        {
          bt_tether_view first, then;
          ask (dive, &first);
          ask_for (dive, turn % 2 ? 0.002 : 0.1);
          double most = largest_jump (dive, &first, 2 * SECOND);
          ask (dive, &then);
          remeshed += then.nodes != first.nodes;
          if (most > 1)
            {
              wrong++;
              print_message ("line %d, turn %d: %d to %d nodes, %g times as much, of %g N\n",
                             (int)f, turn, first.nodes, then.nodes, most, first.tension_max);
            }
        }
      bt_dive_free (dive);
    }
  print_message ("%d remeshed\n", remeshed);
  assert_true (remeshed > 2 * LINES);
  assert_int_equal (wrong, 0);
}

/* In motion: beside the same line that keeps its nodes, and with its kinetic energy.  */
static void
test_in_motion (void **state)
{
  int remeshed = 0, wrong = 0;
  (void)state;
  for (uint64_t f = 1; f <= LINES; f++)
    {
      bt_dive *dive[2];
      bt_tether_view v[2];
      bt_energy e[2];
      for (int k = 0; k < 2; k++)
        {
          bt_error error;
          bt_vehicle_view at;
          dive[k] = begin (f, 0.01);
          scene_must (bt_dive_vehicle (dive[k], 0, &at, &error), &error);
          bt_flight flight = { bt__axpy (at.position, -0.2, bt__vec (20, 30, 10)), 0.3 };
          scene_must (bt_vehicle_move (dive[k], 0, &flight, &error), &error);
          scene_run (dive[k], 10 * SECOND);
        }
      ask_for (dive[1], 0.1);
      double most = 0;
      for (int n = 0; n < SECOND; n++)
        {
          for (int k = 0; k < 2; k++)
            {
              bt_error error;
              scene_run (dive[k], 1);
              ask (dive[k], &v[k]);
              scene_must (bt_tether_energy (dive[k], 0, &e[k], &error), &error);
            }
          double may = fmax (LEAST, SHARE * v[0].tension_max);
          most = fmax (most, fabs (v[1].tension_end - v[0].tension_end) / may);
          most = fmax (most, fabs (v[1].tension_anchor - v[0].tension_anchor) / may);
          if (fabs (e[1].kinetic - e[0].kinetic) > 0.05 * e[0].kinetic + 0.01)
            most = fmax (most, 100);
        }
      remeshed += v[1].nodes != v[0].nodes;
      if (most > 1)
        {
          wrong++;
          print_message ("line %d: %d to %d nodes, %g times as much, of %g N; %g J of %g\n", (int)f,
                         v[0].nodes, v[1].nodes, most, v[0].tension_max, e[1].kinetic,
                         e[0].kinetic);
        }
      bt_dive_free (dive[0]);
      bt_dive_free (dive[1]);
    }
  print_message ("%d remeshed\n", remeshed);
  assert_true (remeshed > LINES / 2);
  assert_int_equal (wrong, 0);
}

/* ---- A taut line let go ---- */

enum
{
  TAUT_LINES = 24,
  LOOKS = 4, /* of each, half a second apart */
  FINE = 400 /* intervals of the line beside it */
};

/* A line nearly straight, of MODEL with NODES, between a point and a vehicle; *ACCURACY receives
   the error in position accepted of it.  */
static bt_dive *
begin_straight (uint64_t seed, int model, int nodes, double *accuracy)
{
  static scene s;
  uint64_t r = seed;
  lot (&r, 0, 1);
  double length = lot (&r, 15, 40);
  scene_clear (&s);
  scene_current (&s, bt__vec (lot (&r, -0.2, 0.2), lot (&r, 0.05, 0.3), 0));
  scene_vehicle (&s, bt__vec (0.97 * length, 0, -10));
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), length, nodes);
  line->props.model = model;
  line->props.ea = pow (10, lot (&r, 4, 6));
  line->props.wet_weight = lot (&r, 0, 0.3);
  line->props.accuracy = *accuracy = lot (&r, 0.02, 0.08);
  return scene_begin (&s.world);
}

static void
surge (bt_dive *dive, double stick)
{
  bt_error error;
  scene_must (bt_vehicle_drive (dive, 0, &(bt_sticks){ .surge = stick }, &error), &error);
}

/* Let line SEED be drawn taut and go; return how many looks find its estimated error off from the
   true one by a factor beyond 3.  Less than a tenth of what is accepted counts as nothing.  */
static int
count_misjudged (uint64_t seed)
{
  double accuracy, estimate;
  bt_error error;
  bt_dive *dive = begin_straight (seed, BT_MODEL_AUTO, FINE / 2, &accuracy),
          *fine = begin_straight (seed, BT_MODEL_DYNAMIC, FINE, &accuracy);
  int count = 0;
  for (int k = -1; k < LOOKS; k++)
    {
      surge (dive, k < 0 ? 0.9 : -0.9);
      surge (fine, k < 0 ? 0.9 : -0.9);
      scene_run (dive, k < 0 ? 6 * SECOND : SECOND / 2);
      scene_run (fine, k < 0 ? 6 * SECOND : SECOND / 2);
      scene_must (bt_tether_error_estimate (dive, 0, &estimate, &error), &error);
      double off = fmax (0.1 * accuracy, scene_apart (dive, fine));
      count += k >= 0 && (off > 3 * estimate || estimate > 3 * off);
    }
  bt_dive_free (dive);
  bt_dive_free (fine);
  return count;
}

/* The line folds with the few nodes of a straight one, and is off by what these made of the fold
   long after more have come.  */
static void
test_what_few_nodes_did_is_told (void **state)
{
  int misjudged = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= TAUT_LINES; seed++)
    misjudged += count_misjudged (seed);
  if (misjudged > TAUT_LINES * LOOKS / 10)
    fail_msg ("%d of %d estimates are off by more than 3", misjudged, TAUT_LINES * LOOKS);
}

/* A line cut at the far end and let go level folds about the anchor, as accurately as asked.  200
   equal intervals are 3 mm off.  */
static void
test_a_cut_line_keeps_to_what_is_asked (void **state)
{
  static const double asked[] = { 0.05, 0.02 };
  static outside_flight fine, flight;
  const race *r = &races[RACE_LET_GO];
  (void)state;
  assert_int_equal (race_by_chain (r, &(outside_setting){ 200, 60, 2, 0 }, &fine, NULL),
                    OUTSIDE_DONE);
  for (size_t k = 0; k < sizeof asked / sizeof *asked; k++)
    {
      double seconds;
      race_in_dive (r, &(race_dive){ BT_MODEL_AUTO, 64, asked[k], 0.02 }, &flight, &seconds);
      double off = outside_apart (&flight, &fine, 1, NULL);
      if (!(off <= asked[k]))
        fail_msg ("%g m were asked, %g m is a cut line off", asked[k], off);
    }
}

/* ---- Little asked ---- */

/* A line of 60 m in a current, of MODEL with NODES at most, that a vehicle leads about.  */
static bt_dive *
begin_slack (int model, int nodes, double accuracy)
{
  static scene s;
  bt_error error;
  scene_clear (&s);
  scene_current (&s, bt__vec (0.1, 0.4, 0));
  scene_vehicle (&s, bt__vec (48, 0, -10))->pull = 1e6;
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), 60, nodes);
  line->props.model = model;
  line->props.accuracy = accuracy;
  bt_dive *dive = scene_begin (&s.world);
  bt_sticks sticks = { 0.2, 0.1, 0, 0.1 };
  scene_must (bt_vehicle_drive (dive, 0, &sticks, &error), &error);
  return dive;
}

/* Where a centimetre is asked, a line has dozens of nodes; where half a metre is, a dozen or two,
   and is no farther off.  Drawn nearly straight it has 30 again, for it may be let go.  */
static void
test_little_asked_takes_few_nodes (void **state)
{
  static const double asked[] = { 0.25, 0.5, 1 };
  int nodes = 1000;
  (void)state;
  for (int a = 0; a < 3; a++)
    {
      bt_dive *dive = begin_slack (BT_MODEL_AUTO, 200, asked[a]),
              *fine = begin_slack (BT_MODEL_DYNAMIC, 200, asked[a]);
      bt_tether_view v;
      double most = 0;
      for (int k = 0; k < 20; k++)
        {
          scene_run (dive, SECOND);
          scene_run (fine, SECOND);
          most = fmax (most, scene_apart (dive, fine));
        }
      ask (dive, &v);
      if (!(most < asked[a]) || !(v.nodes < 30) || !(v.nodes < nodes))
        fail_msg ("%g m of %g with %d nodes", most, asked[a], v.nodes);
      nodes = v.nodes;
      bt_error error;
      bt_flight flight = { bt__vec (59.5, 0, -10), 1 };
      scene_must (bt_vehicle_move (dive, 0, &flight, &error), &error);
      scene_run (dive, 20 * SECOND);
      ask (dive, &v);
      assert_true (v.nodes >= 30);
      bt_dive_free (dive);
      bt_dive_free (fine);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_at_rest),
    cmocka_unit_test (test_in_motion),
    cmocka_unit_test (test_what_few_nodes_did_is_told),
    cmocka_unit_test (test_a_cut_line_keeps_to_what_is_asked),
    cmocka_unit_test (test_little_asked_takes_few_nodes),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
