/* See row.h.  Cells that hold commas or quotes are quoted as in RFC 4180.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "testbed/calibration.h"
#include "row.h"

#define FIRST 0.3  /* s of calibration at the start */
#define AGAIN 0.03 /* and beside rows, ... */
#define EVERY 0.4  /* ... when so much CPU was spent since */

static void
put_text (const char *text, char end)
{
  if (text && strpbrk (text, ",\"\n"))
    {
      putchar ('"');
      for (; *text; text++)
        {
          if (*text == '"')
            putchar ('"');
          putchar (*text);
        }
      putchar ('"');
    }
  else if (text)
    fputs (text, stdout);
  putchar (end);
}

static void
put_number (const char *format, double x)
{
  if (isfinite (x))
    printf (format, x);
  else if (isinf (x))
    fputs (x > 0 ? "inf" : "-inf", stdout);
  putchar (',');
}

static void
recalibrate (bench_table *t, double seconds)
{
  t->step = bench_calibrate (seconds);
  t->when = bench_now ();
  t->least = fmin (t->least, t->step);
  t->most = fmax (t->most, t->step);
}

void
bench_calibrate_table (bench_table *t)
{
  *t = (bench_table){ .least = INFINITY };
  recalibrate (t, FIRST);
}

void
bench_open (bench_table *t)
{
  bench_calibrate_table (t);
  puts ("case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns,calibration_ratio,"
        "counters");
}

/* The calibration step beside a row that ends now: the mean of before and after.  */
static double
step_now (bench_table *t)
{
  double before = t->step;
  if (bench_now () - t->when < EVERY)
    return before;
  recalibrate (t, AGAIN);
  return (before + t->step) / 2;
}

void
bench_put (bench_table *t, const bench_row *row)
{
  double seconds = row->seconds > 0 ? row->seconds : NAN, step = step_now (t);
  put_text (row->name, ',');
  put_text (row->model, ',');
  put_text (row->setting, ',');
  put_text (row->metric, ',');
  put_number ("%.4g", row->error);
  put_text (row->reference, ',');
  put_number ("%.2g", row->uncertainty > 0 ? row->uncertainty : NAN);
  put_number ("%.1f", 1e9 * seconds);
  put_number ("%.4g", seconds / step);
  put_text (row->counters, '\n');
  fflush (stdout);
}

int
bench_close (bench_table *t)
{
  recalibrate (t, FIRST / 3);
  char counters[80];
  snprintf (counters, sizeof counters, "least_us=%.2f;most_us=%.2f", 1e6 * t->least, 1e6 * t->most);
  bench_put (t, &(bench_row){ "calibration", "rk4 chain", "100 intervals", "spread in this run",
                              t->most / t->least - 1, NULL, 0, t->step, counters });
  return fflush (stdout) || ferror (stdout) ? EXIT_FAILURE : EXIT_SUCCESS;
}
