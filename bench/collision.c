/* bight-bench-collision: time and error of the collision queries, as CSV rows on standard output.

   Pairs (collision_pairs.c); a tether at a jacket of up to 1e6 triangles, beside other libraries
   (collision_meshes.c); a tether among up to 1e5 objects, and the long form of the stress test of
   the safe step (collision_fields.c).  Times are CPU, medians of several rounds.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "calibration.h"
#include "collision.h"

void
bench_row (const bench *b, const char *name, const char *model, const char *setting,
           const char *metric, double error, const char *reference, double uncertainty,
           double seconds, const char *counters)
{
  printf ("%s,%s,%s,%s,%.3g,%s,%.2g,%.1f,%.4g,%s\n", name, model, setting, metric, error, reference,
          uncertainty, 1e9 * seconds, seconds / b->calibration, counters);
  fflush (stdout);
}

static const char usage[]
    = "usage: bight-bench-collision [--cases N] [--triangles N] [--seed N]\n"
      "                             [--stress N] [--help]\n"
      "Print time and error of the collision queries as CSV rows.\n"
      "  --cases N      pairs of each kind; 20000\n"
      "  --triangles N  the largest mesh; 1000000\n"
      "  --seed N       of the random numbers; 1\n"
      "  --stress N     instead, N steps of junk on every stage, judged; the figures asked: 20000\n"
      "  --help         this text\n";

static int
run (long cases, long triangles, unsigned long seed, long stress)
{
  bench b = { dice_new (seed), bench_calibrate (0.3) };
  puts ("case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns,calibration_ratio,"
        "counters");
  if (stress > 0)
    return bench_stress (&b, stress) ? EXIT_SUCCESS : EXIT_FAILURE;
  bench_pairs (&b, cases);
  bench_meshes (&b, (uint32_t)triangles);
  bench_field (&b, 0);
  for (uint32_t k = 100; k <= 100000; k *= 10)
    bench_field (&b, k);
  return EXIT_SUCCESS;
}

int
main (int argc, char **argv)
{
  static const struct option options[]
      = { { "cases", required_argument, NULL, 'c' }, { "triangles", required_argument, NULL, 't' },
          { "seed", required_argument, NULL, 's' },  { "stress", required_argument, NULL, 'j' },
          { "help", no_argument, NULL, 'h' },        { NULL, 0, NULL, 0 } };
  long cases = 20000, triangles = 1000000, stress = 0;
  unsigned long seed = 1;
  int c;
  while ((c = getopt_long (argc, argv, "", options, NULL)) != -1)
    switch (c)
      {
      case 'c':
        cases = strtol (optarg, NULL, 10);
        break;
      case 't':
        triangles = strtol (optarg, NULL, 10);
        break;
      case 's':
        seed = strtoul (optarg, NULL, 10);
        break;
      case 'j':
        stress = strtol (optarg, NULL, 10);
        break;
      case 'h':
        fputs (usage, stdout);
        return EXIT_SUCCESS;
      default:
        fputs (usage, stderr);
        return EXIT_FAILURE;
      }
  if (cases < 1 || cases > 10000000 || triangles < 10000 || triangles > 100000000 || stress < 0)
    {
      fputs ("bight-bench-collision: --cases takes 1 to 10000000, --triangles 10000 to 100000000\n",
             stderr);
      return EXIT_FAILURE;
    }
  return run (cases, triangles, seed, stress);
}
