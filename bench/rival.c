/* bight-bench-rival: a line in a dive beside MoorDyn at equal error, as CSV rows on standard
   output.

   Three races (testbed/race.h): a line led about in a current for a minute, MoorDyn's case C; a
   slack line run out until taut; a line let go level with one end free.  A dive of model `auto'
   flies each race at many accuracies.  MoorDyn flies each with every integrator at the largest
   sound step, its segments just enough for a target.  A row is the cheapest run of a code within a
   target: CPU time of a simulated second.  Errors are rms over eleven places and every half second;
   of both end tensions, relative to their own rms.

   Each code has a converged run: our chain of 200 and 400 equal intervals, MoorDyn of 100 and 200
   segments, both extrapolated.  The distance of the two converged runs is the uncertainty of a row,
   and each code is judged by the converged run of the other.  Without MoorDyn the dive stands
   alone, judged by our chain.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <bight/bight.h>

#include "math/vec.h"
#include "options.h"
#include "row.h"
#include "testbed/race.h"

#ifdef HAVE_MOORDYN
#include "rival_moordyn.h"
#endif

enum
{
  EVERY = 2, /* of the stations: eleven */
  NODES = 64,
  TARGETS = 4,
  TENSION = TARGETS - 1
};

/* What is to be reached, and how many times less CPU time than MoorDyn's it may take.  */
static const struct
{
  double error, ratio;
  const char *metric;
} targets[TARGETS] = { { 0.1, 200, "rms position m" },
                       { 0.01, 400, "rms position m" },
                       { 0.001, 1000, "rms position m" },
                       { 0.001, 400, "rms tension" } };

static long rounds = 3, theirs_too = 1, target_only = 0; /* options */

/* True if TARGET is asked for.  */
static int
is_wanted (int target)
{
  return target_only == 0 || target_only == target + 1;
}

/* The errors of a run, by target; its cost.  */
typedef struct run
{
  double position, tension, seconds;
  char model[24], setting[64];
} run;

static double
error_of (const run *r, int target)
{
  return target == TENSION ? r->tension : r->position;
}

/* The cheapest runs within each target.  */
typedef struct front
{
  run best[TARGETS];
} front;

static void
front_clear (front *f)
{
  for (int t = 0; t < TARGETS; t++)
    f->best[t] = (run){ NAN, NAN, HUGE_VAL, "", "" };
}

static void
front_add (front *f, const run *r)
{
  for (int t = 0; t < TARGETS; t++)
    if (error_of (r, t) <= targets[t].error && r->seconds < f->best[t].seconds)
      f->best[t] = *r;
}

/* ---- The dive ---- */

static void
fly_dive (const race *r, const outside_flight *by, double accuracy, double tension, front *f)
{
  static outside_flight flight;
  run once = { .seconds = HUGE_VAL, .model = "dive auto" };
  const race_dive how = { BT_MODEL_AUTO, NODES, accuracy, tension };
  for (int k = 0; k < rounds; k++)
    {
      double seconds;
      race_in_dive (r, &how, &flight, &seconds);
      once.seconds = fmin (once.seconds, seconds);
    }
  once.position = outside_apart (&flight, by, EVERY, &once.tension);
  snprintf (once.setting, sizeof once.setting, "accuracy=%.3g tension-accuracy=%.3g", accuracy,
            tension);
  front_add (f, &once);
}

/* Fly R at accuracies from two metres down, as asked and in whole steps.  */
static void
fly_dives (const race *r, const outside_flight *by, front *f)
{
  static const double tension[] = { 0.2, 0.02, 0.002, INFINITY };
  for (double accuracy = 2; accuracy > 4e-4; accuracy *= 0.7)
    for (size_t k = 0; k < sizeof tension / sizeof *tension; k++)
      fly_dive (r, by, accuracy, tension[k], f);
}

/* ---- MoorDyn ---- */

#ifdef HAVE_MOORDYN

#define SOUND 1.05 /* times the error of a run with far smaller steps: a step is sound */
#define SOUND_TENSION 1.3
#define SHORTER 0.85 /* times the step, for the next one tried */
#define WORTH 2      /* times the cheapest integrator at FIRST segments: dearer are left out */

enum
{
  FIRST = 20,
  CALM = 100, /* segments of the coarser converged run */
  TRIES = 12, /* steps, and numbers of segments */
  MOST = 250, /* segments: what is not reached with so many is not reached */
  SCHEMES = 10
};

static const char *const schemes[SCHEMES]
    = { "rk4", "rk2", "heun", "euler", "ab2", "ab3", "ab4", "midpoint5", "aca5", "beuler5" };

/* A race of MoorDyn's.  */
typedef struct stable
{
  const race *r;
  const outside_flight *by; /* which begins as the race does */
  double courant[SCHEMES];  /* steps over the time of a wave through a segment; 0: left out */
} stable;

/* The time in which a wave runs through one of N segments, s.  */
static double
passing (const race *r, int n)
{
  return r->length / n / sqrt (r->line.ea / r->line.mass);
}

/* Fly with N segments by scheme K at COURANT; true if all of the race was flown.  */
static int
moordyn_once (const stable *s, int k, int n, double courant, outside_flight *f, run *out)
{
  const moordyn_setting how = { schemes[k], n, courant * passing (s->r, n) };
  *out = (run){ .seconds = HUGE_VAL };
  snprintf (out->model, sizeof out->model, "moordyn %s", schemes[k]);
  snprintf (out->setting, sizeof out->setting, "n=%d h=%.3g", n, how.step);
  if (!moordyn_fly (s->r, &how, s->by, f, &out->seconds))
    return 0;
  out->position = outside_apart (f, s->by, EVERY, &out->tension);
  return isfinite (out->position + out->tension);
}

/* Find the cheapest sound run with N segments by scheme K, beside CALM of far smaller steps; the
   next search begins at the step found.  */
static int
moordyn_sound (stable *s, int k, int n, const run *calm, run *out)
{
  static outside_flight f;
  for (int t = 0; t < TRIES; t++, s->courant[k] *= SHORTER)
    if (moordyn_once (s, k, n, s->courant[k], &f, out) && out->position <= SOUND * calm->position
        && out->tension <= SOUND_TENSION * calm->tension)
      return 1;
  return 0;
}

/* The error that MoorDyn has with N segments, by steps far smaller than sound.  */
static int
moordyn_calm (stable *s, int n, run *out)
{
  static outside_flight f;
  return moordyn_once (s, 0, n, 0.5, &f, out) || moordyn_once (s, 0, n, 0.15, &f, out);
}

/* Leave out the integrators that are dear.  */
static void
choose_schemes (stable *s)
{
  run calm, sound[SCHEMES];
  double least = HUGE_VAL;
  if (!moordyn_calm (s, FIRST, &calm))
    return;
  for (int k = 0; k < SCHEMES; k++)
    {
      s->courant[k] = 3;
      if (!moordyn_sound (s, k, FIRST, &calm, &sound[k]))
        sound[k].seconds = HUGE_VAL;
      least = fmin (least, sound[k].seconds);
    }
  for (int k = 0; k < SCHEMES; k++)
    if (sound[k].seconds > WORTH * least)
      s->courant[k] = 0;
}

/* With about as few segments as reach TARGET add sound runs to F.  */
static void
reach (stable *s, int target, front *f)
{
  run calm, sound;
  int n = FIRST;
  double aim = targets[target].error;
  if (!moordyn_calm (s, n, &calm))
    return;
  for (int t = 0; t < TRIES; t++)
    {
      double error = error_of (&calm, target), ratio = sqrt (error / aim);
      int next = (int)ceil (n * (t == 0 ? ratio : fmax (1.02, ratio)));
      if (t > 0 && error <= 0.98 * aim)
        break;
      n = next < 5 ? 5 : next;
      if (n > MOST || !moordyn_calm (s, n, &calm))
        return;
    }
  for (int k = 0; k < SCHEMES; k++)
    {
      double courant = s->courant[k];
      if (courant > 0 && moordyn_sound (s, k, n, &calm, &sound))
        front_add (f, &sound);
      s->courant[k] = courant;
    }
}

/* Their converged run.  */
static int
moordyn_converged (stable *s, outside_flight *best)
{
  static outside_flight coarse, fine;
  run once;
  if (!moordyn_once (s, 0, CALM, 0.4, &coarse, &once)
      || !moordyn_once (s, 0, 2 * CALM, 0.4, &fine, &once))
    return 0;
  outside_extrapolate (&coarse, &fine, best);
  return 1;
}

static void
race_moordyn (stable *s, front *f)
{
  front_clear (f);
  choose_schemes (s);
  for (int t = 0; t < TARGETS; t++)
    if (is_wanted (t))
      reach (s, t, f);
}

#endif

/* ---- Rows ---- */

/* What there is to say of a race.  */
typedef struct outcome
{
  front ours, theirs;
  run doubt; /* how far the converged runs are apart */
} outcome;

static void
put (bench_table *t, const race *r, const outcome *o, const front *f, int target)
{
  const run *b = &f->best[target];
  char metric[48];
  if (!is_wanted (target) || !isfinite (b->seconds))
    return;
  snprintf (metric, sizeof metric, "%s, at most %g", targets[target].metric, targets[target].error);
  bench_put (t, &(bench_row){ r->name, b->model, b->setting, metric, error_of (b, target),
                              "converged run", error_of (&o->doubt, target), b->seconds, NULL });
}

static void
say (const race *r, const outcome *o)
{
  printf ("%s: converged runs differ by %.2g m, %.2g of tension\n", r->name, o->doubt.position,
          o->doubt.tension);
  for (int t = 0; t < TARGETS; t++)
    {
      const run *a = &o->ours.best[t], *b = &o->theirs.best[t];
      if (!is_wanted (t))
        continue;
      printf ("  %g %s: ", targets[t].error, targets[t].metric);
      if (isfinite (a->seconds))
        printf ("dive %.2f us (%.2g, %s)", 1e6 * a->seconds, error_of (a, t), a->setting);
      else
        printf ("not by a dive");
      if (isfinite (b->seconds))
        printf ("; %s %.0f us (%.2g, %s): 1/%.0f, asked 1/%.0f", b->model, 1e6 * b->seconds,
                error_of (b, t), b->setting, b->seconds / a->seconds, targets[t].ratio);
      puts ("");
    }
}

static int
fly (const race *r, outcome *o)
{
  static outside_flight ours, theirs;
  const outside_flight *judge = &ours;
  front_clear (&o->ours);
  front_clear (&o->theirs);
  o->doubt = (run){ 0 };
  if (race_converged (r, &ours) != OUTSIDE_DONE)
    return 0;
#ifdef HAVE_MOORDYN
  static stable s;
  s = (stable){ .r = r, .by = &ours };
  if (!moordyn_converged (&s, &theirs))
    return 0;
  judge = &theirs;
  o->doubt.position = outside_apart (&theirs, &ours, EVERY, &o->doubt.tension);
  if (theirs_too)
    race_moordyn (&s, &o->theirs);
#else
  (void)theirs;
#endif
  fly_dives (r, judge, &o->ours);
  return 1;
}

static int
run_all (int quiet, long only)
{
  bench_table table;
  static outcome o;
  int good = 1;
  if (quiet)
    bench_calibrate_table (&table);
  else
    bench_open (&table);
  for (int k = 0; k < RACES && good; k++)
    {
      if (only > 0 && only != k + 1)
        continue;
      good = fly (&races[k], &o);
      if (good && quiet)
        say (&races[k], &o);
      for (int t = 0; t < TARGETS && good && !quiet; t++)
        {
          put (&table, &races[k], &o, &o.ours, t);
          put (&table, &races[k], &o, &o.theirs, t);
        }
    }
  if (!good)
    fputs ("bight-bench-rival: a converged run failed\n", stderr);
  return quiet || !good ? good ? EXIT_SUCCESS : EXIT_FAILURE : bench_close (&table);
}

int
main (int argc, char **argv)
{
  long quiet = 0, only = 0;
  const bench_option options[]
      = { { "rounds", &rounds, 1, 100, 1, "runs of a dive, of which the quickest counts" },
          { "race", &only, 0, RACES, 1, "the number of the only race; 0: all" },
          { "target", &target_only, 0, TARGETS, 0, "the number of the only target; 0: all" },
          { "moordyn", &theirs_too, 0, 1, 0, "0: of MoorDyn its converged runs alone" },
          { "summary", &quiet, 0, 0, 0, "each target with both codes in words, instead of rows" } };
  const bench_program program
      = { "rival", "Measure a line in a dive beside MoorDyn at equal error", options, 5 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run_all ((int)quiet, only) : status;
}
