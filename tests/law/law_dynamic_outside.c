/* The moving line against what others computed or measured.  The reference data are not part of the
   package: without them these tests are skipped.

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

#include "testbed/race.h"
#include "testbed/reference.h"

/* The test is skipped when the data are not there, and fails when a step is refused.  */
static void
must (outside_result result)
{
  if (result == OUTSIDE_NO_DATA)
    {
      puts ("# no reference data");
      skip ();
    }
  assert_int_equal (result, OUTSIDE_DONE);
}

/* ---- MoorDyn ---- */

static void
test_moordyn_rest (void **state)
{
  (void)state;
  static outside_shape shape;
  for (int which = 0; which < 2; which++)
    {
      double miss[2] = { 0, 0 };
      must (outside_moordyn_rest (which, 800, &shape));
      for (int k = 0; k < shape.rows; k++)
        {
          miss[0] = fmax (miss[0], bt__distance (shape.ours[k], shape.theirs[k]));
          miss[1] = fmax (miss[1], fabs (shape.pull[k] / shape.their_pull[k] - 1));
        }
      printf ("# MoorDyn %s, 800 intervals: %.2g m, tension %.2g\n", which ? "B" : "A", miss[0],
              miss[1]);
      assert_true (miss[0] < 1e-4 && miss[1] < 1e-4);
    }
}

/* The reference's own uncertainty: 1.12e-5 m and 2e-5 of the tension, rms.  */
static void
test_moordyn_flight (void **state)
{
  (void)state;
  static outside_flight theirs, coarse, fine, best;
  double miss[2], own[2], best_miss[2];
  must (outside_moordyn_theirs (&theirs));
  must (race_by_chain (&races[RACE_LED], &(outside_setting){ 100, 50, 2, 1e-9 }, &coarse, NULL));
  must (race_by_chain (&races[RACE_LED], &(outside_setting){ 200, 100, 2, 1e-9 }, &fine, NULL));
  outside_extrapolate (&coarse, &fine, &best);
  miss[0] = outside_apart (&fine, &theirs, 1, miss + 1);
  own[0] = outside_apart (&fine, &best, 1, own + 1);
  best_miss[0] = outside_apart (&best, &theirs, 1, best_miss + 1);
  printf ("# MoorDyn C, 200 intervals: %.2g m rms (own error %.2g), tension %.2g (%.2g);"
          " extrapolated %.2g m, %.2g\n",
          miss[0], own[0], miss[1], own[1], best_miss[0], best_miss[1]);
  assert_true (miss[0] <= own[0] + 1.2e-5 && miss[1] <= own[1] + 2e-5);
  assert_true (best_miss[0] < 1e-4 && best_miss[1] < 1e-4);
}

/* ---- Lowe & Langley: a flexible jumper ---- */

/* Ours is periodic from the start of the history.  The reference's first cycle is below its later
   ones at the same phase for this long: what is left of its own start.  */
#define RUN_UP 3.0

static void
test_lowe_langley (void **state)
{
  (void)state;
  static outside_history h;
  for (int which = 1; which <= 2; which++)
    {
      double worst = 0, early = 0, sum = 0;
      must (outside_jumper (which, 100, 1, &h));
      printf ("# Lowe & Langley: static %.2f %.2f kN of 11.40 45.71\n", h.rest[0], h.rest[1]);
      for (int k = 0; k < h.rows; k++)
        {
          double off = fabs (h.ours[k] - h.theirs[k]);
          *(h.t[k] < RUN_UP ? &early : &worst) = fmax (h.t[k] < RUN_UP ? early : worst, off);
          sum += off * off;
        }
      printf ("# Lowe & Langley case %d: top tension off by %.2f kN at most, %.2f rms;"
              " %.2f in the reference's first %.1f s\n",
              which, worst, sqrt (sum / h.rows), early, RUN_UP);
      assert_true (h.rows > 500 && worst < 0.5 && early < 0.7);
    }
}

/* ---- OrcaFlex: a chain that lies on the seabed ---- */

/* At rest to a thousandth, the chain lying as high as chain of its bar does.  The friction of the
   reference is not known, and the large motion leaves a third of the tension at its lowest.  */
static void
test_orcaflex (void **state)
{
  (void)state;
  static outside_history h;
  for (int which = 1; which <= 2; which++)
    {
      double worst = 0, most = 0, sum = 0, scale = 0, peaks[2] = { 0, 0 }, lows[2] = { 1e9, 1e9 };
      must (outside_chain (which, &outside_plain_bottom, &h));
      printf ("# OrcaFlex chain, static: fairlead %.1f kN of 991.6, anchor %.1f of 826.2\n",
              h.rest[0], h.rest[1]);
      assert_true (fabs (h.rest[0] / 991.6 - 1) < 1e-3 && fabs (h.rest[1] / 826.2 - 1) < 1e-3);
      for (int k = 0; k < h.rows; k++)
        {
          double off = h.ours[k] - h.theirs[k];
          worst = fmax (worst, fabs (off / h.theirs[k]));
          most = fmax (most, fabs (off) / 991.6);
          sum += off * off;
          scale += h.theirs[k] * h.theirs[k];
          peaks[0] = fmax (peaks[0], h.ours[k]);
          peaks[1] = fmax (peaks[1], h.theirs[k]);
          lows[0] = fmin (lows[0], h.ours[k]);
          lows[1] = fmin (lows[1], h.theirs[k]);
        }
      printf (
          "# OrcaFlex A%d, fairlead: off by %.1f %% of the static tension at most, %.1f %% of its"
          " own, %.1f %% rms; %.0f to %.0f kN of %.0f to %.0f\n",
          which, 100 * most, 100 * worst, 100 * sqrt (sum / scale), lows[0], peaks[0], lows[1],
          peaks[1]);
      assert_true (h.rows > 150 && most < 0.05 && worst < 0.07);
    }
}

/* ---- A tether in a tank ---- */

static int
ascending (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The frames of a kind: how many, the mean and median distance, the same drawn as theirs, what our
   line and their markers are beside their turned catenaries, mm.  */
typedef struct frames
{
  int count;
  double mean, median, drawn, misses, doubt;
} frames;

static frames
frames_of (const outside_tank *t, int moving, double surer_than)
{
  static double off[OUTSIDE_ROWS];
  frames f = { 0 };
  for (int k = 0; k < t->rows; k++)
    if ((t->plain[k] > OUTSIDE_MOVING) == moving && t->doubt[k] < surer_than)
      {
        f.mean += t->off[k];
        f.drawn += t->drawn[k];
        f.misses += t->misses[k];
        f.doubt += t->doubt[k];
        off[f.count++] = t->off[k];
      }
  assert_true (f.count > 0);
  qsort (off, (size_t)f.count, sizeof *off, ascending);
  f.median = off[f.count / 2];
  f.mean /= f.count;
  f.drawn /= f.count;
  f.misses /= f.count;
  f.doubt /= f.count;
  return f;
}

static frames
fly_tank (const outside_rope *rope, frames *sure, frames *resting)
{
  static outside_tank tank;
  must (outside_in_tank (rope, &tank));
  frames moving = frames_of (&tank, 1, HUGE_VAL);
  *sure = frames_of (&tank, 1, 20);
  *resting = frames_of (&tank, 0, HUGE_VAL);
  printf (
      "# tank, Cd %.1f%s: %d moving frames, mean %.1f mm, median %.1f (uncertainty %.1f), drawn "
      "as theirs %.1f; %d sure ones, mean %.1f, median %.1f, drawn as theirs %.1f; at rest %.1f\n",
      rope->cd, rope->plumb ? ", vertical as it hung" : "", moving.count, moving.mean,
      moving.median, moving.doubt, moving.drawn, sure->count, sure->mean, sure->median, sure->drawn,
      resting->mean);
  assert_int_equal (moving.count, 144);
  assert_int_equal (sure->count, 32);
  return moving;
}

/* The published figures for the moving frames, 30 mm of a simple model and 36 mm of uncertainty,
   are medians: the mean uncertainty of the 144 frames is 42.6 mm, their median 35.9.  So 32 mm is
   asked of the median, and of the mean that it is within the mean uncertainty.  */
static void
test_tank (void **state)
{
  (void)state;
  for (int k = 12; k <= 14; k++)
    {
      const outside_rope rope = { .cd = k / 10.0 };
      frames sure, resting, moving = fly_tank (&rope, &sure, &resting);
      if (k == 13)
        assert_true (moving.median <= 32 && moving.mean <= moving.doubt && sure.mean <= 14
                     && resting.mean <= 10);
    }
}

/* The reference is not the markers, but turned catenaries nearest to the markers.  Drawn by the
   same rule our line is as near in the moving frames as at rest, and lies beside its catenary by
   what the markers lie beside theirs.  The vertical as the rope hung before it was moved, which is
   told by other frames than the moving ones, is worth 2 mm more.  */
static void
test_tank_as_drawn (void **state)
{
  (void)state;
  const outside_rope hung = { .cd = 1.2, .plumb = 1 };
  frames sure, resting, moving = fly_tank (&outside_plain_rope, &sure, &resting);
  assert_true (moving.drawn <= 11 && sure.drawn <= 7.5 && resting.drawn <= 7.5);
  assert_true (fabs (moving.misses - moving.doubt) <= 7);
  assert_true (resting.misses <= 2);
  moving = fly_tank (&hung, &sure, &resting);
  assert_true (moving.mean <= 36 && sure.mean <= 9.5);
  assert_true (moving.drawn <= 11 && sure.drawn <= 5);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_moordyn_rest), cmocka_unit_test (test_moordyn_flight),
    cmocka_unit_test (test_lowe_langley), cmocka_unit_test (test_orcaflex),
    cmocka_unit_test (test_tank),         cmocka_unit_test (test_tank_as_drawn),
  };
  FILE *readme = bench_open_reference ("README.md");
  if (!readme)
    {
      puts ("1..0 # SKIP the reference data are not here");
      return 0;
    }
  fclose (readme);
  return cmocka_run_group_tests (tests, NULL, NULL);
}
