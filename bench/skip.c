/* bight-bench-skip: what each part of a scene costs, and that its absence costs nothing, as CSV
   rows on standard output.

   The bare scene is a vehicle without mass on a moving line of 100 intervals in still water,
   flown to and fro; every other scene is it and one part more.  All are flown by turns, a round of
   each at a time: the counter `times_bare' is the median over the rounds of what a step costs
   beside the bare one in the same round.  The error is the work that the profile counts for parts
   the scene lacks (parts.h).  The row `line alone' is the floor: the same line led along the same
   path by its own step, without a dive around it; what the bare dive costs more is all that a world
   costs that has nothing.  Rows of model `language' are dives run from the language, with and
   without what goes on between steps, and single calls.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/calibration.h"
#include "child.h"
#include "options.h"
#include "row.h"
#include "testbed/skip_scenes.h"
#include "tether/dynamic.h"

enum
{
  ROUNDS_MAX = 101,
  WARM = 60 /* steps before any is timed */
};

typedef struct flight
{
  bt_dive *dive[SKIP_CASES];
  uint64_t laying[SKIP_CASES]; /* work of absent parts before it is flown: a moving line is laid at
                                  rest */
  double seconds[SKIP_CASES][ROUNDS_MAX], alone[ROUNDS_MAX];
} flight;

/* ---- The line without a dive ---- */

typedef struct alone
{
  bt__dynamic *d;
  bt__dynamic_work *work;
  bt__dynamic_input in;
  bt_water water;
  bt_current none;
} alone;

/* A line as DIVE's is now.  */
static void
open_alone (alone *a, const bt_dive *dive)
{
  static bt_tether_view view;
  bt_vec3 shape[SKIP_NODES + 1];
  bt_error error;
  scene_must (bt_dive_tether (dive, 0, &view, &error), &error);
  scene_must (bt_tether_points (dive, 0, SKIP_NODES + 1, shape, &error), &error);
  a->d = malloc (bt__dynamic_size (SKIP_NODES));
  a->work = bt__dynamic_work_new (SKIP_NODES);
  if (!a->d || !a->work)
    exit (EXIT_FAILURE);
  a->water = (bt_water){ 1025, 9.81, 60, 0, &a->none, NULL, NULL, NULL };
  a->in = (bt__dynamic_input){ .line = &view.props, .water = &a->water, .h = 1.0 / 60 };
  a->in.end[0].at = shape[0];
  scene_must (bt__dynamic_init (a->d, SKIP_NODES, SKIP_NODES, shape, SKIP_NODES + 1, view.length,
                                view.props.ea, &error),
              &error);
}

/* Lead it along the N places TO, and return the CPU seconds of a step.  */
static double
lead (alone *a, const bt_vec3 *to, int n)
{
  bt__dynamic_report report;
  bt_error error;
  double begun = bench_now ();
  for (int i = 0; i < n; i++)
    {
      a->in.end[1].at = to[i];
      a->water.time += a->in.h;
      scene_must (bt__dynamic_step (a->d, a->work, &a->in, &report, &error), &error);
    }
  return (bench_now () - begun) / n;
}

/* Where the vehicle of a copy of DIVE goes in N steps, the pilot's count being FROM.  */
static void
trace (const bt_dive *dive, long from, bt_vec3 *to, int n)
{
  bt_dive *copy;
  bt_error error;
  bt_vehicle_view view;
  scene_must (bt_dive_fork (dive, &copy, &error), &error);
  for (int i = 0; i < n; i++)
    {
      scene_fly (copy, 1, from + i, 1);
      scene_must (bt_dive_vehicle (copy, 0, &view, &error), &error);
      to[i] = view.attachment;
    }
  bt_dive_free (copy);
}

/* ---- All by turns ---- */

static void
fly_all (flight *f, int rounds, int steps)
{
  alone a = { .d = NULL };
  bt_vec3 *to = malloc ((size_t)steps * sizeof *to);
  if (!to)
    exit (EXIT_FAILURE);
  for (int k = 0; k < SKIP_CASES; k++)
    {
      f->dive[k] = skip_begin (skip_cases + k, WARM);
      f->laying[k] = skip_stray_work (f->dive[k], skip_cases + k);
    }
  open_alone (&a, f->dive[0]);
  for (int r = 0; r < rounds; r++)
    {
      long from = WARM + (long)r * steps;
      trace (f->dive[0], from, to, steps);
      f->alone[r] = lead (&a, to, steps);
      for (int k = 0; k < SKIP_CASES; k++)
        f->seconds[k][r] = scene_fly (f->dive[k], skip_cases[k].flown, from, steps);
    }
  free (to);
  free (a.d);
  bt__dynamic_work_free (a.work);
}

/* The median of SECONDS over those of the bare scene in the same rounds.  */
static double
beside (const double *seconds, const double *bare, int rounds)
{
  double ratio[ROUNDS_MAX];
  for (int r = 0; r < rounds; r++)
    ratio[r] = seconds[r] / bare[r];
  return bench_median (ratio, rounds);
}

static void
say (bench_table *t, flight *f, int k, int rounds, const double *bare)
{
  bt_profile p;
  char counters[200];
  bt_dive_profile (f->dive[k], &p);
  snprintf (counters, sizeof counters,
            "times_bare=%.3f;steps=%llu;solves=%llu;sleeps=%llu;asked=%llu;touches=%llu",
            beside (f->seconds[k], bare, rounds), (unsigned long long)p.steps,
            (unsigned long long)p.chain_solves, (unsigned long long)p.chain_sleeps,
            (unsigned long long)p.links_asked, (unsigned long long)p.touches);
  bench_put (t, &(bench_row){ "scene", "dive", skip_cases[k].name, "work of absent parts",
                              (double)(skip_stray_work (f->dive[k], skip_cases + k) - f->laying[k]),
                              "none", 0, bench_median (f->seconds[k], rounds), counters });
  bt_dive_free (f->dive[k]);
}

static void
say_scenes (bench_table *t, int rounds, int steps)
{
  static flight f;
  static double bare[ROUNDS_MAX];
  char counters[80];
  fly_all (&f, rounds, steps);
  for (int r = 0; r < rounds; r++)
    bare[r] = f.seconds[0][r];
  snprintf (counters, sizeof counters, "times_bare=%.3f", beside (f.alone, bare, rounds));
  bench_put (t, &(bench_row){ "scene", "line alone", "bare", "cpu", NAN, NULL, 0,
                              bench_median (f.alone, rounds), counters });
  for (int k = 0; k < SKIP_CASES; k++)
    say (t, &f, k, rounds, bare);
}

/* ---- From the language ---- */

#define WORLD                                                                                      \
  "(enter! (world (sea (depth 60)) (rov (at 0 12 -20)) (tether (from -1 -12 0) (length 40)"        \
  " (nodes 100) (model dynamic)))) (drive! #:surge 0.3 #:yaw 0.1) (run 1) "

/* Print the CPU nanoseconds of evaluating FORM.  */
#define TIMED_OF(form)                                                                             \
  "(let ((t (get-internal-run-time))) " form                                                       \
  " (display (round (* 1e9 (/ (- (get-internal-run-time) t) internal-time-units-per-second)))))"   \
  "(newline)"
#define TIMED TIMED_OF ("(run 20)")

/* The same of 400 calls of FORM.  */
#define CALLED(form) WORLD TIMED_OF ("(do ((i 0 (+ i 1))) ((= i 400)) " form ")")

enum
{
  STEPS = 1200, /* in 20 s */
  CALLS = 400
};

static const struct
{
  const char *name, *expression;
  int of; /* what the time is shared by */
} told[] = {
  { "bare", WORLD TIMED, STEPS },
  { "and a recorder", WORLD "(record! \"dive.story\")" TIMED, STEPS },
  { "and a task ten times a second", WORLD "(every 0.1 (tether-length))" TIMED, STEPS },
  { "and a checkpoint ten times a second", WORLD "(every 0.1 (checkpoint))" TIMED, STEPS },
  { "and a claim after each step",
    "(use-modules (bight test scenario)) " WORLD TIMED_OF ("(always (< (rov-depth) 100) (run 20))"),
    STEPS },
  { "and a picture a second", WORLD "(every 1 (snapshot \"dive.png\" #:size '(320 180)))" TIMED,
    STEPS },
  { "one status", CALLED ("(status)"), CALLS },
  { "one look", CALLED ("(look)"), CALLS },
  { "one tether-length", CALLED ("(tether-length)"), CALLS },
  { "one checkpoint", CALLED ("(checkpoint)"), CALLS },
  { "one what-if", CALLED ("(what-if #t)"), CALLS },
};

enum
{
  TOLD = sizeof told / sizeof *told
};

/* The last line that is a number.  */
static double
number_in (const char *text)
{
  double x = NAN;
  for (const char *line = text; *line;)
    {
      char *end;
      double is = strtod (line, &end);
      if (end != line && *end == '\n')
        x = is;
      while (*line && *line != '\n')
        line++;
      line += *line == '\n';
    }
  return x;
}

static void
say_told (bench_table *t, int rounds)
{
  static double seconds[TOLD][ROUNDS_MAX], bare[ROUNDS_MAX];
  char folder[] = "/tmp/bight-bench-XXXXXX", counters[80];
  if (!mkdtemp (folder))
    return;
  for (int r = 0; r < rounds; r++)
    for (int k = 0; k < TOLD; k++)
      {
        bench_child c = bench_evaluate (folder, told[k].expression);
        seconds[k][r] = c.status ? NAN : number_in (c.out) * 1e-9 / told[k].of;
        bare[r] = seconds[0][r];
      }
  for (int k = 0; k < TOLD; k++)
    {
      double ratio = beside (seconds[k], bare, rounds);
      snprintf (counters, sizeof counters, "times_bare=%.3f", ratio);
      if (isfinite (ratio))
        bench_put (t, &(bench_row){ "scene", "language", told[k].name, "cpu", NAN, NULL, 0,
                                    bench_median (seconds[k], rounds), counters });
      else
        fprintf (stderr, "bight-bench-skip: left out, it fails here: %s\n", told[k].name);
    }
  bench_remove (folder, "dive.story");
  bench_remove (folder, "dive.png");
}

int
main (int argc, char **argv)
{
  long rounds = 21, steps = 600, starts = 5;
  const bench_option options[] = {
    { "rounds", &rounds, 1, ROUNDS_MAX, 5, "rounds of all scenes" },
    { "steps", &steps, 1, 100000, 300, "steps of a round" },
    { "starts", &starts, 1, ROUNDS_MAX, 1, "rounds of dives from the language" },
  };
  const bench_program program
      = { "skip", "Measure what each part of a scene costs, and its absence", options, 3 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  bench_table table;
  bench_open (&table);
  say_scenes (&table, (int)rounds, (int)steps);
  say_told (&table, (int)starts);
  return bench_close (&table);
}
