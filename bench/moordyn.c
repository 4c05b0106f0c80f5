/* The moving line beside MoorDyn: see moordyn.h.

   Case C: a line of 100 m (EA 2e5 N, BA 50 N s, 10 mm, neutral) in a current of .5 m/s across, its
   far end moved smoothly by up to 20 m, for 60 s.  Errors are rms over eleven points and every half
   second against MoorDyn's own converged run.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"
#include "tether/dynamic.h"

#include "calibration.h"
#include "moordyn.h"
#include "reference.h"

/* s: an explicit base-line step of 100 nodes on the machine of MoorDyn's table; a
   step of MoorDyn's own rk4 takes 40e-6 there.  */
#define THEIR_CALIBRATION 19e-6

enum
{
  SAMPLES = 121, /* half seconds */
  POINTS = 11,
  N_MAX = 400,
  LEVELS_MAX = 8
};

static bt_vec3 best[SAMPLES][POINTS];

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

/* Read case C's points: t, TA, TB, then 21 points, of which every second is wanted.  */
static int
read_best (void)
{
  static char text[4096];
  FILE *f = bench_open_reference ("moordyn/C.csv");
  int rows = 0;
  while (f && rows < SAMPLES && fgets (text, sizeof text, f))
    {
      double x[66];
      int count = 0;
      char *end;
      for (char *p = text; count < 66; p = end + 1)
        {
          x[count] = strtod (p, &end);
          if (end == p)
            break;
          count++;
        }
      if (count < 66)
        continue; /* a heading */
      for (int i = 0; i < POINTS; i++)
        best[rows][i] = bt__vec (x[3 + 6 * i], x[4 + 6 * i], x[5 + 6 * i]);
      rows++;
    }
  if (f)
    fclose (f);
  return rows == SAMPLES;
}

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

/* The far end of case C, T seconds after the start.  */
static bt_vec3
end_at (double t)
{
  double u = fmin (t / 10, 1);
  double a = 10 * (1 - cos (0.1 * t)) * u * u * u * (10 - 15 * u + 6 * u * u);
  return bt__vec (70 + 0.8 * a, 0, -100 + 0.6 * a);
}

/* Fly it with N intervals in PER steps each half second.  Return the error; *SECONDS receives CPU
   seconds of a simulated second.  */
static double
fly (bt__dynamic *d, bt__dynamic_work *work, int n, int per, int order, double *seconds)
{
  static const bt_tether_props line = {
    .diameter = 0.01, .mass = 0.0805033117, .ea = 2e5, .ba = 50, .cdn = 1.2, .cdt = 0.02, .ca = 1
  };
  bt_vec3 shape[3] = { { 0, 0, -100 }, { 35, 32, -100 }, end_at (0) };
  bt_current current = { .kind = BT_CURRENT_UNIFORM, .velocity = { bt__vec (0, 0.5, 0) } };
  bt_water water = { 1025, 9.81, 1000, 0, &current, NULL, NULL, NULL };
  bt__dynamic_input in = { .line = &line, .water = &water, .tolerance = 1e-8, .h = 0.05 };
  bt__dynamic_report report;
  double sum = 0;
  in.end[0].at = shape[0];
  in.end[1].at = shape[2];
  if (bt__dynamic_init (d, N_MAX, n, shape, 3, 100, line.ea, NULL))
    abort ();
  for (int i = 0; i < 90; i++) /* the equilibrium in the current */
    {
      if (bt__dynamic_step (d, work, &in, &report, NULL))
        abort ();
      bt__dynamic_still (d);
      in.h = report.converged ? fmin (1.3 * in.h, 300) : fmax (in.h / 4, 0.01);
    }
  in.tolerance = 0;
  in.order = order;
  in.h = 0.5 / per;
  *seconds = 0;
  for (int s = 0; s < SAMPLES; s++)
    {
      double start = bench_now ();
      for (int i = 1; i <= per && s > 0; i++)
        {
          in.end[1].at = end_at (0.5 * (s - 1) + i * in.h);
          if (bt__dynamic_step (d, work, &in, &report, NULL))
            abort ();
        }
      *seconds += (bench_now () - start) / (0.5 * (SAMPLES - 1));
      for (int p = 0; p < POINTS; p++)
        {
          bt_vec3 off = bt__sub (bt__dynamic_point (d, 100.0 * p / (POINTS - 1)), best[s][p]);
          sum += bt__dot (off, off);
        }
    }
  return sqrt (sum / (SAMPLES * POINTS));
}

static void
fly_all (bt__dynamic *d, bt__dynamic_work *work, level *levels, int count)
{
  static const int intervals[] = { 5, 7, 10, 14, 20, 28, 40, 57, 80, 113, 160, 226 };
  static const int rates[] = { 60, 30, 15, 10, 5, 3, 2, 1 }; /* steps in half a second */
  for (size_t i = 0; i < sizeof intervals / sizeof *intervals; i++)
    for (size_t q = 0; q < sizeof rates / sizeof *rates; q++)
      for (int order = 2; order <= 4; order += 2)
        {
          double seconds = HUGE_VAL, error = 0, once;
          for (int round = 0; round < 3; round++)
            {
              error = fly (d, work, intervals[i], rates[q], order, &once);
              seconds = fmin (seconds, once);
            }
          for (int k = 0; k < count; k++)
            if (error <= levels[k].error && seconds < levels[k].ours)
              {
                levels[k].ours = seconds;
                snprintf (levels[k].setting, sizeof levels[k].setting, "n=%d h=%.3g order=%d",
                          intervals[i], 0.5 / rates[q], order);
              }
        }
}

void
bench_moordyn (double calibration)
{
  level levels[LEVELS_MAX] = { { 0 } };
  bt__dynamic *d = malloc (bt__dynamic_size (N_MAX));
  bt__dynamic_work *work = bt__dynamic_work_new (N_MAX);
  int count = read_levels (levels);
  if (count == 0 || !read_best ())
    puts ("MoorDyn: skipped, the reference data are not here");
  else if (d && work)
    {
      printf (
          "MoorDyn 2.7.1's case C, in base-line steps for a simulated second (theirs of %.0f us,"
          " ours of %.2f us):\n",
          1e6 * THEIR_CALIBRATION, 1e6 * calibration);
      fly_all (d, work, levels, count);
      for (int k = 0; k < count; k++)
        {
          double theirs = levels[k].seconds / THEIR_CALIBRATION,
                 ours = levels[k].ours / calibration;
          printf ("  %.2g m: MoorDyn %8.1f (N=%d, %s), ours %6.2f (%s): 1/%.0f\n", levels[k].error,
                  theirs, levels[k].n, levels[k].scheme, ours, levels[k].setting, theirs / ours);
        }
    }
  free (d);
  bt__dynamic_work_free (work);
}
