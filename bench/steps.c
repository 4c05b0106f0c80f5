/* bight-bench-steps: what the accuracy of tension asked for gives and costs, as CSV rows on
   standard output.

   A vehicle of 20 kg runs lines of 5 to 60 m taut: the error is that of the peak against the exact
   wave (testbed/impact.h), the time that of the whole snap.  Flights are flown by turns as asked
   and in whole steps (`none'): the counters of the first tell by how much the CPU time of a median
   pair and the linear solves exceed those of the second.  Calm flights of the model `auto' are
   flown so too: there the line is solved ahead, and the error is how far it is from that of whole
   steps.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/calibration.h"
#include "math/vec.h"
#include "options.h"
#include "row.h"
#include "testbed/impact.h"
#include "testbed/profile.h"

enum
{
  ROUNDS = 5,
  NODES = 64
};

static const struct
{
  const char *name;
  double accuracy;
} settings[] = { { "none", INFINITY }, { "0.1", 0.1 }, { "0.02", 0.02 }, { "0.005", 0.005 } };

/* ---- Peaks ---- */

static void
put_peak (bench_table *t, const impact *i, double exact, const char *name, double accuracy)
{
  static scene s;
  double seconds[ROUNDS], peak = 0;
  char of[60], counters[120];
  bt_profile p = { 0 };
  impact_scene (&s, i, NODES);
  s.tether[0].props.tension_accuracy = accuracy;
  for (int r = 0; r < ROUNDS; r++)
    {
      bt_dive *dive = impact_begin (&s);
      double start = bench_now ();
      peak = impact_found (dive, impact_time (i));
      seconds[r] = bench_now () - start;
      p = profile_of (dive);
      bt_dive_free (dive);
    }
  snprintf (of, sizeof of, "peak, EA %g, %g m", i->ea, i->length);
  snprintf (counters, sizeof counters, "exact=%.5g;found=%.5g;steps=%d;parts=%d;solves=%d", exact,
            peak, (int)p.chain_steps, (int)p.chain_parts, (int)p.chain_solves);
  bench_put (t, &(bench_row){ of, "dynamic", name, "share of the peak tension",
                              fabs (peak / exact - 1), "exact wave", 1e-3,
                              bench_median (seconds, ROUNDS), counters });
}

static void
put_peaks (bench_table *t)
{
  for (int i = 0; i < IMPACTS; i++)
    {
      double exact = impact_exact (&impacts[i]);
      for (size_t k = 0; k < sizeof settings / sizeof *settings; k++)
        put_peak (t, &impacts[i], exact, settings[k].name, settings[k].accuracy);
    }
}

/* ---- Flights ---- */

enum
{
  CURRENT = 1,
  MASS = 2,
  BARS = 4
};

/* A vehicle on a line of 40 m; four bars stand about it.  */
static void
draw (scene *s, int has, double accuracy)
{
  scene_clear (s);
  if (has & CURRENT)
    scene_current (s, bt__vec (0.3, 0, 0));
  bt_vehicle_def *v = scene_vehicle (s, bt__vec (0, 0, -30));
  bt_error error;
  if (has & MASS)
    scene_must (bt_def_set_vehicle_type (v, "bluerov2-heavy", &error), &error);
  scene_line (s, bt__vec (-1, -12, 0), 40, 100)->props.tension_accuracy = accuracy;
  for (int k = 0; k < 4 && has & BARS; k++)
    scene_bar (s, bt__vec (k % 2 ? 2 : -2, -3 - 2 * (k / 2), 0),
               bt__vec (k % 2 ? 2 : -2, -3 - 2 * (k / 2), -60), 0.3);
}

static void
put_flight (bench_table *t, const char *name, int has, int steps)
{
  static scene s;
  double seconds[2][ROUNDS], ratio[ROUNDS];
  char counters[160];
  bt_profile p[2];
  for (int r = 0; r < ROUNDS; r++)
    {
      for (int k = 0; k < 2; k++)
        {
          draw (&s, has, k ? INFINITY : 0.02);
          bt_dive *dive = scene_begin (&s.world);
          scene_fly (dive, 1, 0, 60);
          seconds[k][r] = scene_fly (dive, 1, 60, steps);
          p[k] = profile_of (dive);
          bt_dive_free (dive);
        }
      ratio[r] = seconds[0][r] / seconds[1][r];
    }
  snprintf (counters, sizeof counters, "times_whole=%.3g;solves_times_whole=%.3g;steps=%d;parts=%d",
            bench_median (ratio, ROUNDS), (double)p[0].chain_solves / (double)p[1].chain_solves,
            (int)p[0].chain_steps, (int)p[0].chain_parts);
  bench_put (t, &(bench_row){
                    name, "dynamic", "0.02", "unsolved share of steps",
                    (double)p[0].chain_unconverged / (double)(p[0].chain_steps + p[0].chain_parts),
                    "tolerance of the step", 0, bench_median (seconds[0], ROUNDS), counters });
}

/* ---- Calm ---- */

enum
{
  POINTS = 11,
  LOOK = 37 /* steps between looks at the error */
};

static const struct
{
  const char *name;
  double surge, yaw; /* sticks */
  double pause;      /* s of each 30 without them */
} calms[] = { { "calm, straight on", 0.2, 0, 0 },
              { "calm, round and round", 0.3, 0.3, 0 },
              { "calm, to and fro", 0.3, 0.5, 20 } };

/* A dive of a vehicle without mass on a line of 40 m in a current, at ACCURACY.  */
static bt_dive *
begin_calm (double accuracy, int whole)
{
  static scene s;
  draw (&s, CURRENT, whole ? INFINITY : 0.02);
  s.tether[0].props.model = BT_MODEL_AUTO;
  s.tether[0].props.nodes = 40;
  s.tether[0].props.accuracy = accuracy;
  return scene_begin (&s.world);
}

/* Fly it by turns, ahead and in whole steps, in WAYS as long as LOOK; *APART is how far the lines
   were from each other.  */
static void
fly_calm (bt_dive *const dive[2], int which, int looks, double spent[2], double *apart)
{
  for (int k = 0; k < looks; k++)
    {
      double phase = fmod (k * LOOK / 60.0, 30);
      int rests = phase < calms[which].pause;
      bt_sticks sticks
          = { .surge = rests ? 0 : calms[which].surge, .yaw = rests ? 0 : calms[which].yaw };
      bt_vec3 at[2][POINTS];
      bt_error error;
      for (int w = 0; w < 2; w++)
        {
          scene_must (bt_vehicle_drive (dive[w], 0, &sticks, &error), &error);
          spent[w] += LOOK * scene_run (dive[w], LOOK);
          scene_must (bt_tether_points (dive[w], 0, POINTS, at[w], &error), &error);
        }
      for (int n = 0; n < POINTS; n++)
        *apart = fmax (*apart, bt__distance (at[0][n], at[1][n]));
    }
}

static void
put_calm (bench_table *t, int which, double accuracy, int steps)
{
  double seconds[ROUNDS], ratio[ROUNDS], apart = 0;
  char setting[24], counters[160];
  bt_profile p[2];
  for (int r = 0; r < ROUNDS; r++)
    {
      double spent[2] = { 0, 0 };
      bt_dive *dive[2] = { begin_calm (accuracy, 0), begin_calm (accuracy, 1) };
      fly_calm (dive, which, steps / LOOK, spent, &apart);
      for (int w = 0; w < 2; w++)
        {
          p[w] = profile_of (dive[w]);
          bt_dive_free (dive[w]);
        }
      seconds[r] = spent[0] / (steps / LOOK * LOOK);
      ratio[r] = spent[0] / spent[1];
    }
  snprintf (setting, sizeof setting, "accuracy=%g", accuracy);
  snprintf (counters, sizeof counters,
            "times_whole=%.3g;solves_times_whole=%.3g;steps=%d;ahead=%d;sleeps=%d",
            bench_median (ratio, ROUNDS), (double)p[0].chain_solves / (double)p[1].chain_solves,
            (int)p[0].steps, (int)p[0].chain_stretched, (int)p[0].chain_sleeps);
  bench_put (t, &(bench_row){ calms[which].name, "auto", setting, "share of the accuracy",
                              apart / accuracy, "the same in whole steps", 0,
                              bench_median (seconds, ROUNDS), counters });
}

static int
run (int steps)
{
  bench_table table;
  bench_open (&table);
  put_peaks (&table);
  put_flight (&table, "flight, still water", 0, steps);
  put_flight (&table, "flight, current", CURRENT, steps);
  put_flight (&table, "flight, mass", CURRENT | MASS, steps);
  put_flight (&table, "flight, bars", CURRENT | BARS, steps);
  put_flight (&table, "flight, mass, bars", CURRENT | MASS | BARS, steps);
  for (size_t k = 0; k < sizeof calms / sizeof *calms; k++)
    {
      put_calm (&table, (int)k, 0.05, steps);
      put_calm (&table, (int)k, 0.01, steps);
    }
  return bench_close (&table);
}

int
main (int argc, char **argv)
{
  long steps = 3600;
  const bench_option options[]
      = { { "steps", &steps, 1, 10000000, 240, "steps of each of ten flights" } };
  const bench_program program
      = { "steps", "Measure what the accuracy of tension gives and costs", options, 1 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run ((int)steps) : status;
}
