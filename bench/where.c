/* bight-bench-where: which part of bight has the CPU time of five dives, as CSV rows on standard
   output.

   Each dive is evaluated in a process of its own, in which a clock of CPU time notes a few hundred
   times a second which code is running (scheme/bight/bench/where.scm); nothing is counted in the
   code itself, and a process that nobody looks into has no such clock.  A row is a part of a dive:
   its time is the part's share of the samples times the CPU time of what was flown.  The counter
   `give_or_take' is the standard error of the share, in percent of the whole as the share is; what
   was looked at less than that often is not told from nothing.  What comes before, building the
   world and loading what the language needs for it, is not looked at.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "child.h"
#include "options.h"
#include "row.h"

enum
{
  PARTS = 16,
  NAME = 24
};

#define JACKET                                                                                     \
  "(enter! (world (sea (depth 36) (current 0.3 90) (wake #t)"                                      \
  " (waves (jonswap (height 1.5) (period 7) (seed 3))))"                                           \
  " (splice (make-jacket #:depth 36 #:bays 2 #:top 2))"                                            \
  " (rov (named minnow) (type bluerov2-heavy) (at -2 -14 -8))"                                     \
  " (tether (named line) (type fathom) (wet-weight 0) (friction 0.6) (model dynamic) (nodes 100)"  \
  "  (from 0 -22 -3) (ride 1 1 1) (to minnow) (length 40))))"                                      \
  " (fly-to! '(0 0 -14) #:speed 0.3) (run-until arrived? #:at-most 120) (hold-position!)"

static const struct
{
  const char *name, *before, *flown;
} dives[] = {
  { "a calm line, 600 s",
    "(enter! (world (sea (depth 60)) (rov (at 0 12 -20))"
    " (tether (from -1 -12 0) (length 40) (nodes 100) (model dynamic))))"
    " (drive! #:surge 0.3 #:yaw 0.1) (run 1)",
    "(run 600)" },
  { "the same, recorded",
    "(enter! (world (sea (depth 60)) (rov (at 0 12 -20))"
    " (tether (from -1 -12 0) (length 40) (nodes 100) (model dynamic))))"
    " (drive! #:surge 0.3 #:yaw 0.1) (run 1)",
    "(begin (record! \"dive.story\") (run 600))" },
  { "a pilot in a jacket", "(enter! 'jacket) (run 1)",
    "(for-each (lambda (to) (fly-to! to #:speed 0.4) (run-until arrived? #:at-most 90))"
    " '((0 -9 -14) (0 0 -14) (4.5 4.5 -14) (0 0 -14) (-9 0 -14) (-9 6 -14) (-10 -10 -14)))" },
  { "a coupled dive in waves, 300 s", JACKET, "(run 300)" },
  { "a lesson with its coach", "(run-lesson 'read-the-bow #:coached #t)",
    "(run-lesson 'one-pile #:coached #t)" },
  { "a dive of a sweep",
    "(use-modules (bight study case) (bight study sweep-file))"
    " (define jacket-risk (load-study (study-file \"jacket-risk\")))",
    "(fly-case jacket-risk 0)" },
};

enum
{
  DIVES = sizeof dives / sizeof *dives
};

typedef struct share
{
  char name[NAME];
  double samples;
} share;

typedef struct account
{
  share part[PARTS];
  int n;
  double cpu; /* s */
} account;

static share *
part_called (account *a, const char *name)
{
  int i = 0;
  while (i < a->n && strcmp (a->part[i].name, name) != 0)
    i++;
  if (i == PARTS)
    return NULL;
  if (i == a->n)
    snprintf (a->part[a->n++].name, NAME, "%s", name);
  return &a->part[i];
}

/* Add to A what the process of a dive printed: lines of a name and a number, CPU time the first.
   Return false if that is not there.  */
static int
add_told (account *a, const char *text)
{
  char name[NAME];
  double x;
  int whole = 0;
  for (text = strstr (text, "\ncpu "); text; text = strchr (text, '\n'))
    {
      text++;
      share *part = NULL;
      if (sscanf (text, "%23s %lf", name, &x) != 2)
        continue;
      if (strcmp (name, "cpu") == 0)
        a->cpu += 1e-9 * x;
      else if ((part = part_called (a, name)))
        part->samples += x;
      whole |= part != NULL;
    }
  return whole;
}

static void
say_account (bench_table *t, const char *dive, const account *a)
{
  double all = 0;
  for (int i = 0; i < a->n; i++)
    all += a->part[i].samples;
  for (int i = 0; i < a->n; i++)
    {
      char counters[120];
      double p = a->part[i].samples / all;
      snprintf (counters, sizeof counters, "share_percent=%.2f;give_or_take=%.2f;samples=%.0f",
                100 * p, 100 * sqrt (p * (1 - p) / all), a->part[i].samples);
      bench_put (
          t, &(bench_row){ dive, a->part[i].name, "", "cpu", NAN, NULL, 0, p * a->cpu, counters });
    }
}

static int
look_into (bench_table *t, const char *folder, int k, long times)
{
  static char expression[2000];
  account a = { .n = 0 };
  snprintf (expression, sizeof expression,
            "(use-modules (bight bench where)) %s (say-where (lambda () %s))", dives[k].before,
            dives[k].flown);
  for (long i = 0; i < times; i++)
    {
      bench_child c = bench_evaluate (folder, expression);
      if (c.status || !add_told (&a, c.out))
        {
          fprintf (stderr, "bight-bench-where: left out, it fails here: %s\n", dives[k].name);
          return 0;
        }
    }
  say_account (t, dives[k].name, &a);
  return 1;
}

int
main (int argc, char **argv)
{
  long times = 4;
  const bench_option options[] = { { "times", &times, 1, 1000, 1, "times each dive is flown" } };
  const bench_program program
      = { "where", "Tell which part of bight has the CPU time of a dive", options, 1 };
  int status = bench_options (&program, argc, argv), seen = 0;
  if (status != BENCH_GO_ON)
    return status;
  bench_table table;
  char folder[] = "/tmp/bight-bench-XXXXXX";
  if (!mkdtemp (folder))
    return EXIT_FAILURE;
  bench_open (&table);
  for (int k = 0; k < DIVES; k++)
    seen += look_into (&table, folder, k, times);
  bench_remove (folder, "dive.story");
  status = bench_close (&table);
  return seen > 0 ? status : EXIT_FAILURE;
}
