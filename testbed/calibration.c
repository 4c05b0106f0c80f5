/* The calibration kernel: an honest explicit step of a lumped chain.

   One pass over the segments and one over the nodes per stage, no allocation, no division that can
   be shared, four stages.  A fathom of today: 100 m, 7.6 mm, neutral but for 0.05 N/m, EA 2e5 N, BA
   20 N s. The step is well inside its stability limit, so that the chain stays alive however long
   it is run.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "testbed/calibration.h"

enum
{
  SEGMENTS = 100,
  NODES = SEGMENTS + 1,
  BATCH = 200,
  BATCHES_MAX = 400
};

#define LENGTH 100.0
#define PIECE (LENGTH / SEGMENTS)
#define DIAMETER 0.0076
#define MASS 0.0465
#define DENSITY 1025.0
#define STEP 1e-4

typedef struct vec
{
  double x, y, z;
} vec;

typedef struct chain
{
  vec r[NODES], v[NODES];
} chain;

double
bench_now (void)
{
  struct timespec t;
  clock_gettime (CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int
compare (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

double
bench_median (double *x, int n)
{
  qsort (x, (size_t)n, sizeof *x, compare);
  return n % 2 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

static vec
minus (vec a, vec b)
{
  return (vec){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static vec
plus (vec a, double k, vec b)
{
  return (vec){ a.x + k * b.x, a.y + k * b.y, a.z + k * b.z };
}

static double
dot (vec a, vec b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The tension vector of the segment from node A to B and its unit tangent: Hooke and dashpot.  */
static vec
tension (const chain *c, int i, vec *tangent)
{
  vec d = minus (c->r[i + 1], c->r[i]);
  double l = sqrt (dot (d, d)), inverse = 1 / l;
  *tangent = (vec){ d.x * inverse, d.y * inverse, d.z * inverse };
  double rate = dot (*tangent, minus (c->v[i + 1], c->v[i]));
  double t = fmax (2e5 * (l / PIECE - 1) + 20 * rate / PIECE, 0);
  return (vec){ t * tangent->x, t * tangent->y, t * tangent->z };
}

/* The acceleration of a node between tangents P and Q under the force F: drag on both parts of the
   flow, added mass across the line alone.  */
static vec
accelerate (vec f, vec p, vec q, vec v)
{
  vec tau = plus (p, 1, q);
  double inverse = 1 / sqrt (dot (tau, tau));
  tau = (vec){ tau.x * inverse, tau.y * inverse, tau.z * inverse };
  vec u = { 0.5 - v.x, -v.y, -v.z };
  double along = dot (u, tau);
  vec across = plus (u, -along, tau);
  double kn = 0.5 * DENSITY * 1.2 * DIAMETER * PIECE * sqrt (dot (across, across));
  double kt = 0.5 * DENSITY * 0.01 * 3.14159265358979 * DIAMETER * PIECE * fabs (along);
  f = plus (plus (f, kn, across), kt * along, tau);
  const double m = MASS * PIECE,
               added = DENSITY * 0.25 * 3.14159265358979 * DIAMETER * DIAMETER * PIECE;
  double ft = dot (f, tau), n = 1 / (m + added);
  vec a = { f.x * n, f.y * n, f.z * n };
  return plus (a, ft * (1 / m - n), tau);
}

/* The rates of C: its speeds and accelerations, its ends held.  */
static void
rates (const chain *c, chain *d)
{
  vec p, q, before = tension (c, 0, &p);
  d->r[0] = d->v[0] = d->r[SEGMENTS] = d->v[SEGMENTS] = (vec){ 0, 0, 0 };
  for (int i = 1; i < SEGMENTS; i++)
    {
      vec after = tension (c, i, &q), f = minus (after, before);
      f.z -= 0.05 * PIECE;
      d->r[i] = c->v[i];
      d->v[i] = accelerate (f, p, q, c->v[i]);
      before = after;
      p = q;
    }
}

/* OUT = C + K D.  */
static void
advance (const chain *c, double k, const chain *d, chain *out)
{
  for (int i = 0; i < NODES; i++)
    {
      out->r[i] = plus (c->r[i], k, d->r[i]);
      out->v[i] = plus (c->v[i], k, d->v[i]);
    }
}

static void
step (chain *c)
{
  chain a, b, at, sum;
  rates (c, &a);
  advance (c, STEP / 6, &a, &sum);
  advance (c, STEP / 2, &a, &at);
  rates (&at, &b);
  advance (&sum, STEP / 3, &b, &sum);
  advance (c, STEP / 2, &b, &at);
  rates (&at, &a);
  advance (&sum, STEP / 3, &a, &sum);
  advance (c, STEP, &a, &at);
  rates (&at, &b);
  advance (&sum, STEP / 6, &b, c);
}

/* A slack bow between ends 80 m apart.  */
static void
lay (chain *c)
{
  for (int i = 0; i < NODES; i++)
    {
      double u = (double)i / SEGMENTS;
      c->r[i] = (vec){ 80 * u * (1 - u) + 1, 80 * u, -5 * u };
      c->v[i] = (vec){ 0, 0, 0 };
    }
}

double
bench_calibrate (double seconds)
{
  static double times[BATCHES_MAX];
  chain c;
  int n = 0;
  lay (&c);
  for (double start = bench_now (), t = start; n < BATCHES_MAX && t < start + seconds; n++)
    {
      for (int i = 0; i < BATCH; i++)
        step (&c);
      double now = bench_now ();
      times[n] = (now - t) / BATCH;
      t = now;
    }
  return isfinite (c.r[SEGMENTS / 2].x) && n > 0 ? bench_median (times, n) : NAN;
}
