/* bight-bench-collision: time and error of the collision queries, as CSV rows on standard output.

   Pairs (collision_pairs.c); a tether at a jacket of up to 1e6 triangles, beside other libraries
   (collision_meshes.c); a tether among up to 1e5 objects, and the long form of the stress test of
   the safe step (collision_fields.c).  Times are CPU, medians of several rounds.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <limits.h>
#include <stdlib.h>

#include "collision.h"
#include "options.h"

void
bench_say (bench *b, const char *name, const char *model, const char *setting, const char *metric,
           double error, const char *reference, double uncertainty, double seconds,
           const char *counters)
{
  bench_put (&b->table, &(bench_row){ name, model, setting, metric, error, reference, uncertainty,
                                      seconds, counters });
}

static int
run (long cases, long triangles, long seed, long stress)
{
  bench b = { .dice = dice_new ((uint64_t)seed) };
  bench_open (&b.table);
  if (stress > 0)
    return bench_stress (&b, stress) ? bench_close (&b.table) : EXIT_FAILURE;
  bench_pairs (&b, cases);
  bench_meshes (&b, (uint32_t)triangles);
  bench_field (&b, 0);
  for (uint32_t k = 100; k <= 100000; k *= 10)
    bench_field (&b, k);
  return bench_close (&b.table);
}

int
main (int argc, char **argv)
{
  long cases = 20000, triangles = 1000000, seed = 1, stress = 0;
  const bench_option options[] = {
    { "cases", &cases, 1, 10000000, 2000, "pairs of each kind" },
    { "triangles", &triangles, 10000, 100000000, 100000, "triangles of the largest mesh" },
    { "seed", &seed, 0, LONG_MAX, 0, "seed of the random numbers" },
    { "stress", &stress, 0, LONG_MAX, 0, "steps of junk on every stage, judged, instead of all" },
  };
  const bench_program program
      = { "collision", "Measure time and error of the collision queries", options, 4 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run (cases, triangles, seed, stress) : status;
}
