/* The parts of bight-bench-collision and what they share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_COLLISION_H
#define BT_BENCH_COLLISION_H

#include "testbed/solids.h"
#include "row.h"

enum
{
  BENCH_FRAMES = 30,  /* of which the median is reported */
  BENCH_REPEATS = 5,  /* of each */
  BENCH_ROOM = 200000 /* pairs */
};

#define BENCH_RADIUS 0.01 /* m, of a link */
#define BENCH_REACH 0.06  /* m from its axis: the radius and 5 cm */

typedef struct bench
{
  dice dice;
  bench_table table;
} bench;

/* A link against shapes, N of each kind.  */
void bench_pairs (bench *b, long n);

/* A tether at a jacket of 1e4 to MOST triangles, beside the rivals.  */
void bench_meshes (bench *b, uint32_t most);

/* A tether among N capsules of one density.  */
void bench_field (bench *b, uint32_t n);

/* Print a row of B.  */
void bench_say (bench *b, const char *name, const char *model, const char *setting,
                const char *metric, double error, const char *reference, double uncertainty,
                double seconds, const char *counters);

/* N steps of junk on every stage, judged by the oracle.  Return nonzero if it found nothing.  */
int bench_stress (bench *b, long n);

#endif
