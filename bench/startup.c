/* bight-bench-startup: what a start costs, as CSV rows on standard output.

   Programs are started afresh, each several times by turns: guile and bight without work, and bight
   with the first things one does.  Times are the CPU of the whole process and its children; the
   counters have the time by the clock, and the most memory it held.  Plain guile is the reference.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/calibration.h"
#include "child.h"
#include "options.h"
#include "row.h"

enum
{
  RUNS_MAX = 100
};

#define WORLD                                                                                      \
  "(enter! (world (sea (depth 60)) (rov (at 0 20 -10))"                                            \
  " (tether (from 0 0 0) (length 30) (model dynamic))))"

static const struct
{
  const char *name, *program, *option, *expression;
} starts[] = {
  { "guile -c 1", "guile", "-c", "1" },
  { "bight --version", "bight", "--version", NULL },
  { "bight -c 1", "bight", "-c", "1" },
  { "a world entered", "bight", "-c", WORLD },
  { "ten seconds of a dive", "bight", "-c", WORLD "(drive! #:surge 0.3) (run 10)" },
  { "a picture of it", "bight", "-c", WORLD "(snapshot \"picture.png\" #:size '(640 360))" },
};

enum
{
  OURS = 2, /* the one without which nothing is measured */
  STARTS = sizeof starts / sizeof *starts
};

typedef struct runs
{
  double seconds[RUNS_MAX], wall[RUNS_MAX];
  long memory;
  int failed;
} runs;

static void
start_once (const char *folder, int k, long i, runs *r)
{
  const char *const argv[] = { starts[k].program, starts[k].option, starts[k].expression, NULL };
  bench_child c = bench_run (folder, argv);
  r[k].failed |= c.status != 0;
  r[k].seconds[i] = c.seconds;
  r[k].wall[i] = c.wall;
  r[k].memory = c.memory;
}

static void
say (bench_table *t, int k, runs *r, int count)
{
  char counters[100];
  if (r[k].failed)
    {
      fprintf (stderr, "bight-bench-startup: left out, it fails here: %s\n", starts[k].name);
      return;
    }
  snprintf (counters, sizeof counters, "wall_ms=%.1f;memory_MB=%.1f",
            1e3 * bench_median (r[k].wall, count), 1e-6 * (double)r[k].memory);
  bench_put (t, &(bench_row){ "start", "process", starts[k].name, "cpu", NAN, NULL, 0,
                              bench_median (r[k].seconds, count), counters });
}

static int
run (const char *folder, int count)
{
  static runs r[STARTS];
  bench_table table;
  bench_open (&table);
  for (int i = 0; i < count; i++)
    for (int k = 0; k < STARTS; k++)
      start_once (folder, k, i, r);
  for (int k = 0; k < STARTS; k++)
    say (&table, k, r, count);
  return r[OURS].failed ? EXIT_FAILURE : bench_close (&table);
}

int
main (int argc, char **argv)
{
  long count = 9;
  const bench_option options[] = { { "runs", &count, 1, RUNS_MAX, 2, "starts of each" } };
  const bench_program program = { "startup", "Measure what a start costs", options, 1 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  char folder[] = "/tmp/bight-bench-XXXXXX";
  if (!mkdtemp (folder))
    return EXIT_FAILURE;
  status = run (folder, (int)count);
  bench_remove (folder, "picture.png");
  return status;
}
