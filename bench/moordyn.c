/* The moving line beside MoorDyn: see moordyn.h, and outside.h for case C.  Errors are rms over
   eleven points and every half second against MoorDyn's own converged run.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "moordyn.h"
#include "testbed/race.h"
#include "testbed/reference.h"

/* s: an explicit base-line step of 100 nodes on the machine of MoorDyn's table; a
   step of MoorDyn's own rk4 takes 40e-6 there.  */
#define THEIR_CALIBRATION 19e-6

/* m: how sure their converged run is, by an integration of another kind.  */
#define SURE 1.12e-5

enum
{
  LEVELS_MAX = 8,
  EVERY = 2 /* of its stations: eleven */
};

/* What of either can be had within an error.  */
typedef struct level
{
  int n;           /* theirs */
  double error;    /* m */
  double seconds;  /* of theirs, for a simulated second */
  char scheme[16]; /* theirs */
  double ours;     /* s */
  char setting[48];
} level;

/* Read the cheapest sound run of every number of segments.  */
static int
read_levels (level *levels)
{
  char text[512];
  FILE *f = bench_open_reference ("moordyn/workprecision.csv");
  int count = 0;
  while (f && fgets (text, sizeof text, f))
    {
      level l = { .ours = HUGE_VAL };
      char status[16];
      if (sscanf (text, "C,%d,%15[^,],%*f,%*d,%*f,%lf,%15[^,],%lf", &l.n, l.scheme, &l.seconds,
                  status, &l.error)
              != 5
          || strcmp (status, "ok") != 0)
        continue;
      int k = 0;
      while (k < count && levels[k].n != l.n)
        k++;
      if (k == LEVELS_MAX || (k < count && levels[k].seconds <= l.seconds))
        continue;
      levels[k] = l;
      count += k == count;
    }
  if (f)
    fclose (f);
  return count;
}

static void
row (bench_table *table, const char *model, const char *setting, double error, double seconds)
{
  bench_put (table, &(bench_row){ "moordyn-c", model, setting, "rms position m", error,
                                  "MoorDyn's converged run", SURE, seconds, NULL });
}

static void
put_theirs (bench_table *table, const level *l)
{
  char model[32], setting[16];
  snprintf (model, sizeof model, "moordyn %s", l->scheme);
  snprintf (setting, sizeof setting, "n=%d", l->n);
  row (table, model, setting, l->error, l->seconds / THEIR_CALIBRATION * table->step);
}

/* Fly it as HOW says; LEVELS learn what it costs.  */
static void
fly_ours (bench_table *table, const outside_flight *best, const outside_setting *how, int rounds,
          int quiet, level *levels, int count)
{
  static outside_flight flight;
  char setting[48];
  double seconds = HUGE_VAL, once;
  for (int round = 0; round < rounds; round++)
    if (race_by_chain (&races[RACE_LED], how, &flight, &once) == OUTSIDE_DONE)
      seconds = fmin (seconds, once);
  if (!isfinite (seconds))
    return;
  double error = outside_apart (&flight, best, EVERY, NULL);
  snprintf (setting, sizeof setting, "n=%d h=%.3g order=%d", how->intervals, 0.5 / how->per,
            how->order);
  if (!quiet)
    row (table, "dynamic", setting, error, seconds);
  for (int k = 0; k < count; k++)
    if (error <= levels[k].error && seconds < levels[k].ours)
      {
        levels[k].ours = seconds;
        memcpy (levels[k].setting, setting, sizeof setting);
      }
}

static void
say (const bench_table *table, const level *levels, int count)
{
  printf ("MoorDyn 2.7.1's case C, in base-line steps for a simulated second (theirs of %.0f us,"
          " ours of %.2f us):\n",
          1e6 * THEIR_CALIBRATION, 1e6 * table->step);
  for (int k = 0; k < count; k++)
    {
      double theirs = levels[k].seconds / THEIR_CALIBRATION, ours = levels[k].ours / table->step;
      printf ("  %.2g m: MoorDyn %8.1f (N=%d, %s), ours %6.2f (%s): 1/%.0f\n", levels[k].error,
              theirs, levels[k].n, levels[k].scheme, ours, levels[k].setting, theirs / ours);
    }
}

void
bench_moordyn (bench_table *table, int every, int rounds, int quiet)
{
  static const int intervals[] = { 5, 7, 10, 14, 20, 28, 40, 57, 80, 113, 160, 226 };
  static const int rates[] = { 60, 30, 15, 10, 5, 3, 2, 1 }; /* steps in half a second */
  static outside_flight best;
  level levels[LEVELS_MAX] = { { 0 } };
  int count = read_levels (levels);
  if (count == 0 || outside_moordyn_theirs (&best) != OUTSIDE_DONE)
    {
      if (quiet)
        puts ("MoorDyn: skipped, the reference data are not here");
      return;
    }
  for (int k = 0; k < count && !quiet; k++)
    put_theirs (table, levels + k);
  for (size_t i = 0; i < sizeof intervals / sizeof *intervals; i += (size_t)every)
    for (size_t q = 0; q < sizeof rates / sizeof *rates; q++)
      for (int order = 2; order <= 4; order += 2)
        fly_ours (table, &best, &(outside_setting){ intervals[i], rates[q], order, 0 }, rounds,
                  quiet, levels, count);
  if (quiet)
    say (table, levels, count);
}
