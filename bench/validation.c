/* bight-bench-validation: the engine against measured tethers, other codes and published tables, as
   CSV rows on standard output.

   An error is the difference of a line of ours to theirs in what the metric says; the uncertainty
   is that of the reference, where it is stated; the counter `own' is what our own steps and
   intervals are estimated to add, from a run with half as many.  Where a reference does not say all
   that it rests on, what is not said is varied in further rows, so that it is seen what it may
   account for.  The curves go to another file, as rows of case, axes, line, x and y.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "moordyn.h"
#include "options.h"
#include "testbed/race.h"
#include "validation.h"

/* ---- Rows and curves ---- */

void
validation_row (validation *v, const char *name, const char *setting, const char *metric,
                double error, const char *reference, double uncertainty, double own)
{
  char counters[40] = "";
  if (isfinite (own))
    snprintf (counters, sizeof counters, "own=%.3g", own);
  bench_put (&v->table, &(bench_row){ name, v->model, setting, metric, error, reference,
                                      uncertainty, NAN, counters });
}

void
validation_varied (validation *v, const char *name, const char *setting, const char *metric,
                   double error, const char *reference)
{
  bench_put (&v->table,
             &(bench_row){ name, v->model, setting, metric, error, reference, 0, NAN, "varied=1" });
}

void
validation_point (validation *v, const char *name, const char *axes, const char *line, double x,
                  double y)
{
  if (v->curves)
    fprintf (v->curves, "%s,\"%s\",\"%s\",%.6g,%.8g\n", name, axes, line, x, y);
}

int
validation_counts (validation *v, const char *name, int result, const char *file)
{
  if (result == OUTSIDE_DONE)
    {
      v->done++;
      return 1;
    }
  v->absent += result == OUTSIDE_NO_DATA;
  bench_put (&v->table,
             &(bench_row){ name, v->model, file, result == OUTSIDE_NO_DATA ? "left out" : "failed",
                           result == OUTSIDE_NO_DATA ? NAN : HUGE_VAL, NULL, 0, 0, NULL });
  return 0;
}

/* ---- MoorDyn ---- */

/* The largest distance, and relative difference in tension, of what SHAPE holds to POINTS and PULL.
 */
static void
shape_apart (const outside_shape *shape, const bt_vec3 *points, const double *pull, double apart[2])
{
  apart[0] = apart[1] = 0;
  for (int k = 0; k < shape->rows; k++)
    {
      apart[0] = fmax (apart[0], bt__distance (shape->ours[k], points[k]));
      apart[1] = fmax (apart[1], fabs (shape->pull[k] / pull[k] - 1));
    }
}

static void
hang (validation *v, int which)
{
  static outside_shape coarse, shape;
  static const char *const names[] = { "moordyn-a", "moordyn-b" };
  static const char *const files[] = { "moordyn/A.csv", "moordyn/B.csv" };
  static const char *const references[] = { "elastic catenary", "collocation" };
  const char *name = names[which], *axes = which ? "y m over x m" : "z m over x m";
  double off[2], own[2], sure = which ? 1e-9 : 1e-12;
  if (!validation_counts (v, name, outside_moordyn_rest (which, 800, &shape), files[which])
      || outside_moordyn_rest (which, 400, &coarse) != OUTSIDE_DONE)
    return;
  shape_apart (&shape, shape.theirs, shape.their_pull, off);
  shape_apart (&shape, coarse.ours, coarse.pull, own);
  validation_row (v, name, "800 intervals", "largest distance m", off[0], references[which],
                  100 * sure, own[0] / 3);
  validation_row (v, name, "800 intervals", "largest difference of tension, relative", off[1],
                  references[which], sure, own[1] / 3);
  for (int k = 0; k < shape.rows; k++)
    for (int theirs = 0; theirs < 2; theirs++)
      {
        bt_vec3 p = theirs ? shape.theirs[k] : shape.ours[k];
        validation_point (v, name, axes, theirs ? references[which] : "bight", p.x,
                          which ? p.y : p.z);
      }
}

static void
fly_moordyn (validation *v)
{
  static outside_flight theirs, coarse, fine, best;
  const char *name = "moordyn-c";
  double pull[3], apart[3];
  if (!validation_counts (v, name, outside_moordyn_theirs (&theirs), "moordyn/C.csv")
      || race_by_chain (&races[RACE_LED], &(outside_setting){ 100, 50, 2, 1e-9 }, &coarse, NULL)
             != OUTSIDE_DONE
      || race_by_chain (&races[RACE_LED], &(outside_setting){ 200, 100, 2, 1e-9 }, &fine, NULL)
             != OUTSIDE_DONE)
    return;
  outside_extrapolate (&coarse, &fine, &best);
  apart[0] = outside_apart (&fine, &theirs, 1, pull);
  apart[1] = outside_apart (&fine, &best, 1, pull + 1);
  apart[2] = outside_apart (&best, &theirs, 1, pull + 2);
  validation_row (v, name, "200 intervals", "rms distance m", apart[0], "MoorDyn 2.7.1", 1.12e-5,
                  apart[1]);
  validation_row (v, name, "200 intervals", "rms difference of tension, relative", pull[0],
                  "MoorDyn 2.7.1", 2e-5, pull[1]);
  /* Sixteen to one is what fourth order leaves of the difference that was extrapolated.  */
  validation_row (v, name, "extrapolated", "rms distance m", apart[2], "MoorDyn 2.7.1", 1.12e-5,
                  apart[1] / 15);
  validation_row (v, name, "extrapolated", "rms difference of tension, relative", pull[2],
                  "MoorDyn 2.7.1", 2e-5, pull[1] / 15);
  for (int k = 0; k < theirs.rows; k++)
    {
      validation_point (v, name, "tension at the vehicle N over time s", "bight", fine.t[k],
                        fine.pull[k][1]);
      validation_point (v, name, "tension at the vehicle N over time s", "MoorDyn", theirs.t[k],
                        theirs.pull[k][1]);
    }
}

/* ---- ---- */

static int
complain (const char *what, const char *which)
{
  fprintf (stderr, "bight-bench-validation: %s%s\n", what, which);
  return EXIT_FAILURE;
}

static int
is_folder (const char *name)
{
  struct stat s;
  return stat (name, &s) == 0 && S_ISDIR (s.st_mode);
}

static int
run (validation *v)
{
  bench_open (&v->table);
  v->model = "dynamic";
  validation_tank (v);
  validation_cables (v);
  for (int which = 0; which < 2; which++)
    hang (v, which);
  fly_moordyn (v);
  bench_moordyn (&v->table, v->quick ? 6 : 3, 1, 0);
  validation_histories (v);
  validation_tables (v);
  return bench_close (&v->table);
}

int
main (int argc, char **argv)
{
  static validation v;
  const char *data = NULL, *curves = NULL;
  long quick = 0;
  const bench_option options[]
      = { { "few", &quick, 0, 0, 1, "vary nothing that the references leave open" } };
  const bench_word words[] = {
    { "data", &data, "DIR", "the folder of the reference data; it must be given" },
    { "curves", &curves, "FILE", "where the curves go; nowhere when left out" },
  };
  const bench_program program
      = { "validation", "Hold the engine against measurements, other codes and tables", options,
          1 };
  int status = bench_options_and_words (&program, words, 2, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  if (!data)
    return complain ("--data DIR is needed, the folder of the reference data", "");
  if (!is_folder (data))
    return complain ("there is no folder ", data);
  if (setenv ("BIGHT_REFERENCE_DATA", data, 1))
    return complain ("memory is out", "");
  v.quick = quick != 0;
  v.curves = curves ? fopen (curves, "w") : NULL;
  if (curves && !v.curves)
    return complain ("cannot write ", curves);
  if (v.curves)
    fputs ("case,axes,line,x,y\n", v.curves);
  status = run (&v);
  if (v.curves && fclose (v.curves))
    return complain ("cannot write ", curves);
  if (v.done == 0)
    return complain ("none of the data that are known are in ", data);
  return status;
}
