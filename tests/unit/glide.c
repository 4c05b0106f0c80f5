/* A step that is taken in place, where all lines are ahead of the present, comes to the same bits
   as one taken aside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "math/vec.h"
#include "sim/sim.h"
#include "testbed/profile.h"
#include "testbed/scene.h"

enum
{
  SCENES = 40,
  STEPS = 900,
  KINDS = 9
};

static double
lot (uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

static int
one_of (uint64_t *seed, int n)
{
  return (int)lot (seed, 0, n);
}

/* A vehicle on a line that is now slack, now nearly taut, and one that has none, in water that
   flows; some lines can be twisted, some worlds have a second, static line.  */
static bt_dive *
begin (uint64_t *seed)
{
  static scene s;
  double length = lot (seed, 10, 40), way = length * lot (seed, 0.6, 0.99);
  scene_clear (&s);
  if (one_of (seed, 3))
    scene_current (&s, bt__vec (lot (seed, -0.2, 0.2), lot (seed, -0.2, 0.2), 0));
  scene_vehicle (&s, bt__vec (way, 0, -10))->pull = lot (seed, 5, 200);
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), length, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.accuracy = lot (seed, 0.02, 0.2);
  line->props.wet_weight = lot (seed, -0.05, 0.2);
  line->props.gj = one_of (seed, 4) ? 0 : 0.1;
  scene_vehicle (&s, bt__vec (5, 5, -20));
  if (!one_of (seed, 8))
    scene_line (&s, bt__vec (0, 5, -10), 30, 20)->props.model = BT_MODEL_CATENARY;
  return scene_begin (&s.world);
}

/* The same order to both dives: sticks, a flight, a track, a depth or a heading to keep, the winch,
   a vehicle let go, the current, a cut.  */
static void
order (bt_dive *dive[2], uint64_t *seed)
{
  int which = one_of (seed, KINDS), vehicle = one_of (seed, 4) == 0;
  double a = lot (seed, -1, 1), b = lot (seed, -1, 1), c = lot (seed, 0.02, 0.4);
  for (int k = 0; k < 2; k++)
    {
      bt_error error;
      bt_sticks sticks = { c, 0.3 * a, 0.2 * b, 0.2 * a };
      bt_vehicle_view v;
      scene_must (bt_dive_vehicle (dive[k], vehicle, &v, &error), &error);
      bt_flight flight = { bt__add (v.position, bt__vec (a, b, 0.3 * b)), c };
      const bt_current flows
          = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.2 * a, 0.2 * b, 0 } } };
      double t = 0, rows[8] = { t,     v.position.x,     v.position.y, v.position.z,
                                t + 9, v.position.x + a, v.position.y, v.position.z + c };
      bt_status status = BT_OK;
      switch (which)
        {
        case 0:
        case 1:
          status = bt_vehicle_move (dive[k], vehicle, &flight, &error);
          break;
        case 2:
          status = bt_vehicle_follow (dive[k], vehicle, &(bt_rows){ rows, 2, 4 }, &error);
          break;
        case 3:
          status = bt_tether_pay_out (dive[k], 0, &(bt_spooling){ 100, c }, &error);
          break;
        case 4:
          status
              = one_of (&(uint64_t){ *seed }, 9) ? BT_OK : bt_vehicle_release (dive[k], 0, &error);
          break;
        case 5:
          status = bt_sea_set_current (dive[k], &flows, &error);
          break;
        default:
          status = bt_vehicle_drive (dive[k], vehicle, &sticks, &error);
        }
      (void)status; /* one that is refused is refused to both */
    }
}

/* The kept events of KIND of DIVE.  */
static uint64_t
events_of (const bt_dive *dive, bt_event_kind kind)
{
  bt_event event[BT_EVENTS_KEPT];
  int n = bt_dive_events (dive, 0, event);
  uint64_t sum = 0;
  for (int e = 0; e < n; e++)
    sum += event[e].kind == (int64_t)kind;
  return sum;
}

static void
test_in_place_and_aside_are_alike (void **state)
{
  uint64_t stretched = 0, arrived = 0;
  (void)state;
  for (uint64_t f = 1; f <= SCENES; f++)
    {
      uint64_t one = f, two = f;
      bt_dive *dive[2] = { begin (&one), begin (&two) };
      for (int k = 0; k < STEPS; k++)
        {
          bt_error error;
          if (k % 75 == 0 && k % 300 < 150)
            order (dive, &one);
          scene_must (bt_dive_step (dive[0], &error), &error);
          scene_must (bt__step_aside (dive[1], &error), &error);
          if (bt_dive_hash (dive[0]) != bt_dive_hash (dive[1]))
            fail_msg ("scene %d, step %d", (int)f, k);
        }
      bt_profile p = profile_of (dive[0]), q = profile_of (dive[1]);
      assert_memory_equal (&p, &q, sizeof p);
      stretched += p.chain_stretched;
      arrived += events_of (dive[0], BT_EVENT_ARRIVED);
      bt_dive_free (dive[0]);
      bt_dive_free (dive[1]);
    }
  assert_true (stretched > SCENES * STEPS / 4);
  assert_true (arrived > SCENES / 8);
}

/* A line led along a track: past its length, where it stays a while, and back.  */
static bt_dive *
begin_led (double beyond)
{
  static scene s;
  bt_error error;
  const double rows[]
      = { 0, 29.5, 0, -10, 5, 30 + beyond, 0, -10, 12, 30 + beyond, 0.5, -10, 16, 29, 0, -10 };
  scene_clear (&s);
  scene_current (&s, bt__vec (0.1, 0.3, 0));
  scene_vehicle (&s, bt__vec (29.5, 0, -10))->pull = 50;
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -10), 30, 20);
  line->props.model = BT_MODEL_AUTO;
  line->props.accuracy = 0.05;
  bt_dive *dive = scene_begin (&s.world);
  scene_must (bt_vehicle_follow (dive, 0, &(bt_rows){ rows, 4, 4 }, &error), &error);
  return dive;
}

/* Where a line is taut too; the vehicle is held back where it pulls too little to go on.  */
static void
test_taut_in_place_and_aside_are_alike (void **state)
{
  static const double beyond[] = { 0.001, 0.004, 0.02, 0.2 };
  int taut = 0, held = 0;
  (void)state;
  for (int f = 0; f < 4; f++)
    {
      bt_dive *dive[2] = { begin_led (beyond[f]), begin_led (beyond[f]) };
      for (int k = 0; k < STEPS; k++)
        {
          bt_error error;
          const bt__state *was = dive[0]->now;
          scene_must (bt_dive_step (dive[0], &error), &error);
          scene_must (bt__step_aside (dive[1], &error), &error);
          if (bt_dive_hash (dive[0]) != bt_dive_hash (dive[1]))
            fail_msg ("%g m beyond, step %d", beyond[f], k);
          taut += dive[0]->now == was && bt__dive_tether (dive[0], dive[0]->now, 0)->taut;
          held += bt__dive_vehicle (dive[0], dive[0]->now, 0)->held != 0;
        }
      assert_true (events_of (dive[0], BT_EVENT_TAUT) > 0);
      bt_dive_free (dive[0]);
      bt_dive_free (dive[1]);
    }
  print_message ("%d taut in place, %d held\n", taut, held);
  assert_true (taut > STEPS / 4 && held > STEPS / 4);
}

/* A vehicle on a line that hangs: asleep, of few intervals, twisted or clamped; static; or none. */
static bt_dive *
begin_at_rest (uint64_t *seed)
{
  static scene s;
  int kind = one_of (seed, 4);
  scene_clear (&s);
  scene_vehicle (&s, bt__vec (12, 0, -20));
  if (kind > 0)
    {
      bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -20), lot (seed, 13, 20), 4);
      line->props.wet_weight = 0.2;
      line->props.model = kind == 1 ? BT_MODEL_CATENARY : BT_MODEL_DYNAMIC;
      line->props.ei = kind == 3 ? 0.02 : 0;
      line->props.gj = kind == 3 ? 1 : 0;
      if (kind == 3)
        line->along[0] = bt__vec (0.5, 0, -1);
    }
  scene_vehicle (&s, bt__vec (5, 5, -20));
  if (one_of (seed, 2))
    scene_line (&s, bt__vec (0, 5, -20), 30, 20)->props.model = BT_MODEL_CATENARY;
  return scene_begin (&s.world);
}

/* Step DIVE aside until its first line sleeps, if it is one that moves, and it does so soon.  */
static void
put_to_sleep (bt_dive *dive)
{
  bt_error error;
  for (int k = 0; k < 60 * STEPS; k++)
    {
      const bt__tether *line
          = dive->model->n_tethers > 0 ? bt__dive_tether (dive, dive->now, 0) : NULL;
      if (!line || !bt__is_awake (line))
        return;
      scene_must (bt__step_aside (dive, &error), &error);
    }
}

/* True if the last step of DIVE was taken in place: WAS is the present before it.  */
static int
is_in_place (const bt_dive *dive, const bt__state *was)
{
  return dive->now == was;
}

static void
test_rest_in_place_and_aside_are_alike (void **state)
{
  (void)state;
  uint64_t in_place = 0, slept = 0, skipped = 0, hockled = 0;
  for (uint64_t f = 1; f <= SCENES; f++)
    {
      uint64_t one = f, two = f;
      bt_dive *dive[2] = { begin_at_rest (&one), begin_at_rest (&two) };
      put_to_sleep (dive[0]);
      put_to_sleep (dive[1]);
      for (int k = 0; k < 6 * STEPS; k++)
        {
          bt_error error;
          if (f % 4 != 0 && k % (3 * STEPS) == 2 * STEPS)
            order (dive, &one);
          for (int m = 0; m < 2; m++)
            if (k % (3 * STEPS) == 2 * STEPS + 60)
              (void)bt_vehicle_drive (dive[m], 0, &(bt_sticks){ 0 }, &error);
            else if (f % 4 == 0 && k == STEPS) /* it turns on the spot */
              (void)bt_vehicle_drive (dive[m], 0, &(bt_sticks){ .yaw = 0.5 }, &error);
          const bt__state *was = dive[0]->now;
          scene_must (bt_dive_step (dive[0], &error), &error);
          scene_must (bt__step_aside (dive[1], &error), &error);
          in_place += (uint64_t)is_in_place (dive[0], was);
          if (k % 10 == 0 && bt_dive_hash (dive[0]) != bt_dive_hash (dive[1]))
            fail_msg ("scene %d, step %d", (int)f, k);
        }
      bt_profile p = profile_of (dive[0]), q = profile_of (dive[1]);
      assert_memory_equal (&p, &q, sizeof p);
      slept += p.chain_sleeps;
      skipped += p.shape_skips;
      hockled += events_of (dive[0], BT_EVENT_HOCKLED);
      bt_dive_free (dive[0]);
      bt_dive_free (dive[1]);
    }
  assert_true (in_place > SCENES * STEPS && slept > SCENES * STEPS / 4);
  assert_true (skipped > SCENES * STEPS && hockled > 0);
}

/* Who is asked whether to go on is asked in such steps too.  */
static int
no_more (void *user, double share)
{
  (void)share;
  return *(int *)user;
}

static void
test_it_can_be_interrupted (void **state)
{
  (void)state;
  uint64_t seed = 3;
  int stop = 0;
  bt_error error;
  bt_dive *dive = begin (&seed);
  bt_dive_set_poll (dive, no_more, &stop);
  for (int k = 0; k < 200; k++)
    {
      stop = k % 3 == 2;
      uint64_t hash = bt_dive_hash (dive);
      bt_status status = bt_dive_step (dive, &error);
      assert_int_equal (status, stop ? BT_ERR_INTERRUPTED : BT_OK);
      assert_true ((bt_dive_hash (dive) == hash) == stop);
    }
  bt_dive_free (dive);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_in_place_and_aside_are_alike),
    cmocka_unit_test (test_taut_in_place_and_aside_are_alike),
    cmocka_unit_test (test_rest_in_place_and_aside_are_alike),
    cmocka_unit_test (test_it_can_be_interrupted),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
