/* bight-bench-copy: what a dive pays for being a state that can be copied, as CSV rows on standard
   output.

   An order to a vehicle is written to the present state; the counter `times_copied' is its cost
   beside that of the same order as an operation on a copy of the whole state, by turns in the same
   run, and the error the number of rounds after which the two dives differ.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"
#include "options.h"
#include "row.h"
#include "testbed/calibration.h"
#include "testbed/order.h"
#include "testbed/scene.h"

enum
{
  ROUNDS_MAX = 101,
  WARM = 60,
  ORDERS = 20, /* in a row, before the next step */
  TURN = 40    /* steps */
};

/* ---- Orders ---- */

/* Give DIVE orders, at the K-th turn, in place or the long way; return the CPU seconds of one.  */
static double
give_orders (bt_dive *dive, long k, int copied)
{
  bt_error error;
  double begun = bench_now ();
  for (int m = 0; m < ORDERS; m++)
    {
      double sticks[] = { 0.3 * sin (k + m), NAN, 0, 0.1 };
      scene_must (copied ? order_drive_copy (dive, sticks, &error)
                         : bt_dive_do (dive, BT_OP_DRIVE, 0, sticks, 4, &error),
                  &error);
    }
  return (bench_now () - begun) / ORDERS;
}

static void
say_orders (bench_table *t, const char *setting, const scene *s, int rounds)
{
  static double in_place[ROUNDS_MAX], copied[ROUNDS_MAX], ratio[ROUNDS_MAX];
  bt_dive *a = scene_begin (&s->world), *b = scene_begin (&s->world);
  int differ = 0;
  char counters[160];
  scene_fly (a, 1, 0, WARM);
  scene_fly (b, 1, 0, WARM);
  for (int r = 0; r < rounds; r++)
    {
      in_place[r] = give_orders (a, r, 0);
      copied[r] = give_orders (b, r, 1);
      ratio[r] = in_place[r] / copied[r];
      scene_run (a, 2);
      scene_run (b, 2);
      differ += bt_dive_hash (a) != bt_dive_hash (b);
    }
  snprintf (counters, sizeof counters, "times_copied=%.4f;copied_ns=%.0f",
            bench_median (ratio, rounds), 1e9 * bench_median (copied, rounds));
  bench_put (t, &(bench_row){ "order", "dynamic", setting, "rounds that differ", differ,
                              "on a copy", 0, bench_median (in_place, rounds), counters });
  bt_dive_free (a);
  bt_dive_free (b);
}

static void
one_line (scene *s, int nodes)
{
  scene_clear (s);
  scene_vehicle (s, bt__vec (0, 12, -20));
  scene_line (s, bt__vec (-1, -12, 0), fmax (40, 0.01 * nodes), nodes)->props.mass = 0.05;
}

static void
fleet (scene *s, int n)
{
  scene_clear (s);
  for (int i = 0; i < n; i++)
    {
      bt_vec3 at = bt__vec (100 * (i % 8), 100 * (int)(i / 8), 0);
      scene_vehicle (s, bt__add (at, bt__vec (0, 12, -20)));
      scene_line (s, at, 30, 50);
    }
}

static void
all_orders (bench_table *t, long most, int rounds)
{
  static scene s;
  char setting[40];
  for (int n = 100; n <= most; n *= 10)
    {
      one_line (&s, n);
      snprintf (setting, sizeof setting, "a line of %d", n);
      say_orders (t, setting, &s, rounds);
    }
  fleet (&s, 64);
  say_orders (t, "64 lines of 50", &s, rounds);
}

int
main (int argc, char **argv)
{
  long rounds = 51, nodes = 10000;
  const bench_option options[] = {
    { "rounds", &rounds, 1, ROUNDS_MAX, 15, "rounds of each pair" },
    { "nodes", &nodes, 100, 100000, 1000, "most intervals of a line" },
  };
  const bench_program program
      = { "copy", "Measure what is copied of a state, and what is not", options, 2 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  bench_table table;
  bench_open (&table);
  all_orders (&table, nodes, (int)rounds);
  return bench_close (&table);
}
