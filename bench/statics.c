/* bight-bench-statics: time against error of the static shapes, as CSV rows on standard output.

   Families of plane problems, each solved by every model, cold and warm.  The error of a plane
   model is max (endpoint, length) / length of the curve it hands out; an answer that misses by more
   than 1 % is a failure.  The steady solvers are measured against their own fine solution.  Times
   are CPU times over whole batches, medians of several; the calibration ratio is the time in units
   of one explicit step of a 100-node chain measured in the same run (calibration.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>

#include <bight/statics.h>

#include "testbed/calibration.h"
#include "testbed/chance.h"
#include "options.h"
#include "row.h"
#include "statics.h"

enum
{
  STEPS = 500 /* the most a search may take */
};

#define FAILURE 0.01

static bench_table table;

/* ---- Cases ---- */

typedef struct problem
{
  double h, v, s;
} problem;

typedef struct family
{
  const char *name;
  double size[2];  /* decades of the length */
  double slack[2]; /* decades of length / chord - 1 */
  int steep;       /* nearly vertical */
} family;

/* The families of cases.  */
static const family families[] = {
  { "ordinary", { 0, 2.30103 }, { -2, 0 }, 0 },
  { "near-taut", { 0, 2.30103 }, { -8, -2 }, 0 },
  { "very-slack", { 0, 2.30103 }, { 0.30103, 3 }, 0 },
  { "near-vertical", { 0, 2.30103 }, { -2, 0 }, 1 },
  { "1-5-m", { 0, 0.69897 }, { -2, 0 }, 0 },
  { "1e-6..1e7-m", { -6, 7 }, { -2, 0 }, 0 },
};

enum
{
  FAMILIES = sizeof families / sizeof *families
};

static uint64_t state;

double
statics_uniform (void)
{
  return chance (&state);
}

static double
decades (const double range[2])
{
  return pow (10, range[0] + (range[1] - range[0]) * statics_uniform ());
}

static problem
draw (const family *f)
{
  static const double steepness[2] = { -6, -2 };
  double s = decades (f->size), chord = s / (1 + decades (f->slack));
  double angle = f->steep ? acos (0.0) - decades (steepness) : 1.4 * statics_uniform ();
  double v = chord * sin (angle);
  return (problem){ chord * cos (angle), statics_uniform () < 0.5 ? -v : v, s };
}

/* The next problem of a vehicle under way: the end moves by 0.3 % of the length, still slack.  */
static problem
move (problem p)
{
  double turn = 6.283185307179586 * statics_uniform (), d = 0.003 * p.s;
  problem q = { fabs (p.h + d * cos (turn)), p.v + d * sin (turn), p.s };
  double chord = hypot (q.h, q.v);
  if (chord >= p.s)
    {
      q.h *= hypot (p.h, p.v) / chord;
      q.v *= hypot (p.h, p.v) / chord;
    }
  return q;
}

/* ---- Models: each solves case I and can say how far it missed ---- */

typedef struct bench
{
  long n;
  problem *now, *next;
  bt_search *search;
  bt_search_result *found, *start;
  bt_catenary *catenary;
  bt_v_shape *v;
  bt_elastic *elastic;
  gsl_multimin_fminimizer *simplex;
} bench;

typedef void (*solver) (bench *b, long i);
typedef double (*misser) (const bench *b, long i);

static double
end_miss (bt_point2 p, const problem *to, double s)
{
  return hypot (p.x - to->h, p.y - to->v) / s;
}

static void
solve_catenary (bench *b, long i)
{
  bt_catenary_solve (b->now[i].h, b->now[i].v, b->now[i].s, b->catenary + i, NULL);
}

static void
solve_catenary_next (bench *b, long i)
{
  bt_catenary_solve (b->next[i].h, b->next[i].v, b->next[i].s, b->catenary + i, NULL);
}

static double
miss_catenary (const bench *b, long i)
{
  return end_miss (bt_catenary_point (b->catenary + i, b->now[i].s), b->now + i, b->now[i].s);
}

static double
miss_catenary_next (const bench *b, long i)
{
  return end_miss (bt_catenary_point (b->catenary + i, b->next[i].s), b->next + i, b->next[i].s);
}

static void
solve_search (bench *b, long i)
{
  bt_search_catenary (b->search, b->now[i].h, b->now[i].v, b->now[i].s, 0.005, STEPS, 0,
                      b->found + i, NULL);
}

static void
solve_search_fine (bench *b, long i)
{
  bt_search_catenary (b->search, b->now[i].h, b->now[i].v, b->now[i].s, 1e-12, STEPS, 0,
                      b->found + i, NULL);
}

/* Warm: from the right answer to the case before.  */
static void
solve_search_warm (bench *b, long i)
{
  b->found[i] = b->start[i];
  bt_search_catenary (b->search, b->next[i].h, b->next[i].v, b->next[i].s, 0.005, STEPS, 1,
                      b->found + i, NULL);
}

/* An upside-down curve (A < 0) is none.  */
static double
miss_of (const bt_search_result *r, const problem *p)
{
  double a = r->a, end = (p->h - r->xs) / a, start = -r->xs / a;
  double y = fabs (a * (cosh (end) - cosh (start)) - p->v) / p->s;
  double l = fabs (a * (sinh (end) - sinh (start)) - p->s) / p->s;
  return a > 0 && isfinite (y) && isfinite (l) ? fmax (y, l) : INFINITY;
}

static double
miss_search (const bench *b, long i)
{
  return miss_of (b->found + i, b->now + i);
}

static double
miss_search_next (const bench *b, long i)
{
  return miss_of (b->found + i, b->next + i);
}

/* ---- The same search stopped by the size of its simplex ---- */

static double
square_miss (double is, double wanted)
{
  double e = fabs (wanted) > 1 ? 1 - is / wanted : wanted - is;
  return e * e;
}

static double
error_of (const gsl_vector *x, void *user)
{
  const problem *p = user;
  double a = gsl_vector_get (x, 0), xs = gsl_vector_get (x, 1), q = (p->h - xs) / a, o = -xs / a;
  double e = square_miss (a * cosh (q) - a * cosh (o), p->v)
             + square_miss (a * (sinh (q) - sinh (o)), p->s);
  return e < 1e200 ? e : 1e200;
}

/* Stopped where the simplex is smaller than 0.005 (m): quick, and often not there yet.
 */
static void
search_by_size (bench *b, const problem *p, bt_search_result from, bt_search_result *found)
{
  double place[2] = { from.a, from.xs }, reach[2];
  for (int k = 0; k < 2; k++)
    reach[k] = place[k] != 0 ? 0.1 * fabs (place[k]) : 0.1 * p->s;
  gsl_vector_view x = gsl_vector_view_array (place, 2), step = gsl_vector_view_array (reach, 2);
  gsl_multimin_function f = { error_of, 2, (void *)p };
  int n = 0;
  if (!gsl_multimin_fminimizer_set (b->simplex, &f, &x.vector, &step.vector))
    while (n++ < STEPS && !gsl_multimin_fminimizer_iterate (b->simplex)
           && gsl_multimin_fminimizer_size (b->simplex) >= 0.005)
      continue;
  const gsl_vector *best = gsl_multimin_fminimizer_x (b->simplex);
  *found = (bt_search_result){ gsl_vector_get (best, 0), gsl_vector_get (best, 1), n, 1 };
}

static void
solve_size (bench *b, long i)
{
  double root = (3 * log10 (b->now[i].s) + log2 (b->now[i].s)) / 4, xs = root * root * root;
  search_by_size (b, b->now + i, (bt_search_result){ xs / 2, xs, 0, 0 }, b->found + i);
}

static void
solve_size_warm (bench *b, long i)
{
  search_by_size (b, b->next + i, b->start[i], b->found + i);
}

/* ---- V and elastic ---- */

static void
solve_v (bench *b, long i)
{
  bt_v_shape_solve (b->now[i].h, b->now[i].v, b->now[i].s, b->v + i, NULL);
}

static double
miss_v (const bench *b, long i)
{
  const problem *p = b->now + i;
  bt_point2 q = b->v[i].bend;
  return fabs (hypot (q.x, q.y) + hypot (p->h - q.x, p->v - q.y) - p->s) / p->s;
}

/* A line as heavy as 1e-4 of its stiffness.  */
static void
solve_elastic (bench *b, long i)
{
  b->elastic[i].H = NAN;
  bt_elastic_solve (b->now[i].h, b->now[i].v, b->now[i].s, 0.1, 1e3 * b->now[i].s, b->elastic + i,
                    NULL);
}

static double
miss_elastic (const bench *b, long i)
{
  return isfinite (b->elastic[i].H)
             ? end_miss (bt_elastic_point (b->elastic + i, b->now[i].s), b->now + i, b->now[i].s)
             : INFINITY;
}

/* ---- Measuring ---- */

typedef struct figures
{
  double seconds, median, worst;
  long failures;
} figures;

static figures
measure (bench *b, solver solve, misser miss)
{
  double times[STATICS_ROUNDS], *misses = malloc ((size_t)b->n * sizeof *misses);
  figures f = { 0, 0, 0, 0 };
  for (int k = 0; k < STATICS_ROUNDS; k++)
    {
      double start = bench_now ();
      for (long i = 0; i < b->n; i++)
        solve (b, i);
      times[k] = (bench_now () - start) / (double)b->n;
    }
  f.seconds = bench_median (times, STATICS_ROUNDS);
  if (!misses)
    return f;
  for (long i = 0; i < b->n; i++)
    {
      misses[i] = miss (b, i);
      f.failures += !(misses[i] <= FAILURE);
      f.worst = fmax (f.worst, misses[i]);
    }
  f.median = bench_median (misses, (int)b->n);
  free (misses);
  return f;
}

void
statics_row (const char *name, const char *model, const char *setting, const char *metric,
             double error, const char *reference, double uncertainty, double seconds,
             const char *counters)
{
  bench_put (&table, &(bench_row){ name, model, setting, metric, error, reference, uncertainty,
                                   seconds, counters });
}

static void
report (const char *name, const char *model, const char *setting, const figures *f, long n)
{
  char counters[80];
  snprintf (counters, sizeof counters, "cases=%ld;failures=%ld", n, f->failures);
  statics_row (name, model, setting, "median miss/length", f->median, "ends and length", 1e-16,
               f->seconds, counters);
  statics_row (name, model, setting, "worst miss/length", f->worst, "ends and length", 1e-16,
               f->seconds, counters);
  statics_row (name, model, setting, "failed share", (double)f->failures / (double)n, "miss > 1 %",
               0, f->seconds, counters);
}

typedef struct way
{
  const char *model, *setting;
  solver solve;
  misser miss;
} way;

enum
{
  CLOSED,
  CLOSED_MOVED,
  SEARCH,
  SEARCH_FINE,
  SEARCH_WARM,
  SIZE,
  SIZE_WARM,
  V,
  ELASTIC,
  WAYS
};

static const way ways[WAYS] = {
  { "catenary", "cold", solve_catenary, miss_catenary },
  { "catenary", "moved 0.3 %", solve_catenary_next, miss_catenary_next },
  { "catenary-simplex", "cold 0.5 %", solve_search, miss_search },
  { "catenary-simplex", "cold 1e-12", solve_search_fine, miss_search },
  { "catenary-simplex", "warm 0.5 %", solve_search_warm, miss_search_next },
  { "simplex-by-size", "cold 0.5 %", solve_size, miss_search },
  { "simplex-by-size", "warm 0.5 %", solve_size_warm, miss_search_next },
  { "v-shape", "cold", solve_v, miss_v },
  { "elastic", "cold", solve_elastic, miss_elastic },
};

/* Draw the cases of F, and the right answers a warm search may start from.  */
static void
prepare (bench *b, const family *f)
{
  for (long i = 0; i < b->n; i++)
    {
      bt_catenary c;
      b->now[i] = draw (f);
      b->next[i] = move (b->now[i]);
      bt_catenary_solve (b->now[i].h, b->now[i].v, b->now[i].s, &c, NULL);
      b->start[i] = (bt_search_result){ c.a, -c.a * asinh (c.sigma0 / c.a), 0, 0 };
    }
}

static void
run_family (bench *b, const family *f, figures out[WAYS], int quiet)
{
  prepare (b, f);
  for (int k = 0; k < WAYS; k++)
    {
      out[k] = measure (b, ways[k].solve, ways[k].miss);
      if (!quiet)
        report (f->name, ways[k].model, ways[k].setting, out + k, b->n);
    }
}

/* ---- The closed catenary over everything ---- */

/* One line of CSV for N cases over 13 decades of size, slack 1e-15 to 1e6, slopes 1e-16 to 1e16. */
static void
run_torture (long n)
{
  static const double size[2] = { -6, 7 }, slack[2] = { -15, 6 }, slope[2] = { -16, 16 };
  double worst = 0, start = bench_now ();
  long failures = 0;
  for (long i = 0; i < n; i++)
    {
      double s = decades (size), chord = s / (1 + decades (slack)), k = decades (slope);
      problem p = { chord * (k / hypot (1, k)), chord / hypot (1, k), s };
      bt_catenary c;
      if (i & 1)
        p.v = -p.v;
      bt_status status = bt_catenary_solve (p.h, p.v, p.s, &c, NULL);
      double miss = status ? INFINITY : end_miss (bt_catenary_point (&c, s), &p, s);
      failures += !(miss < 1e-14);
      worst = fmax (worst, miss);
    }
  char counters[80];
  snprintf (counters, sizeof counters, "cases=%ld;failures=%ld", n, failures);
  statics_row ("everything", "catenary", "drawn and checked", "worst miss/length", worst, "end",
               1e-16, (bench_now () - start) / (double)n, counters);
}

/* ---- The program ---- */

static void
summarize (const family *f, const figures g[WAYS], long n)
{
  double cold = g[CLOSED].seconds, moved = g[CLOSED_MOVED].seconds, all = 100.0 / (double)n;
  printf ("%-14s closed %5.1f ns; search/closed cold %5.0fx warm %4.0fx, by size cold %5.0fx warm "
          "%4.0fx\n",
          f->name, 1e9 * cold, g[SEARCH].seconds / cold, g[SEARCH_WARM].seconds / moved,
          g[SIZE].seconds / cold, g[SIZE_WARM].seconds / moved);
  printf (
      "%-14s worst miss %.1e of the length, failed: closed %ld, search %.1f %%, at 1e-12 %.1f %%,"
      " warm %.1f %%, by size %.1f %%, warm %.1f %%\n",
      "", g[CLOSED].worst, g[CLOSED].failures, all * (double)g[SEARCH].failures,
      all * (double)g[SEARCH_FINE].failures, all * (double)g[SEARCH_WARM].failures,
      all * (double)g[SIZE].failures, all * (double)g[SIZE_WARM].failures);
}

static int
allocate (bench *b, long n)
{
  size_t k = (size_t)n;
  gsl_set_error_handler_off ();
  *b = (bench){ .n = n,
                .now = calloc (k, sizeof *b->now),
                .next = calloc (k, sizeof *b->next),
                .search = bt_search_new (),
                .found = calloc (k, sizeof *b->found),
                .start = calloc (k, sizeof *b->start),
                .catenary = calloc (k, sizeof *b->catenary),
                .v = calloc (k, sizeof *b->v),
                .elastic = calloc (k, sizeof *b->elastic),
                .simplex = gsl_multimin_fminimizer_alloc (gsl_multimin_fminimizer_nmsimplex2, 2) };
  return b->now && b->next && b->search && b->found && b->start && b->catenary && b->v && b->elastic
         && b->simplex;
}

static void
release (bench *b)
{
  free (b->now);
  free (b->next);
  bt_search_free (b->search);
  free (b->found);
  free (b->start);
  free (b->catenary);
  free (b->v);
  free (b->elastic);
  if (b->simplex)
    gsl_multimin_fminimizer_free (b->simplex);
}

static int
run (long cases, long torture, int steady, int quiet)
{
  bench b;
  figures g[WAYS];
  if (!allocate (&b, cases))
    {
      release (&b);
      return EXIT_FAILURE;
    }
  if (quiet)
    bench_calibrate_table (&table);
  else
    bench_open (&table);
  if (quiet)
    printf ("one calibration step: %.2f us\n", 1e6 * table.step);
  for (int k = 0; k < FAMILIES; k++)
    {
      run_family (&b, families + k, g, quiet);
      if (quiet)
        summarize (families + k, g, cases);
    }
  release (&b);
  run_torture (torture);
  if (quiet)
    return EXIT_SUCCESS;
  statics_steady (steady);
  return bench_close (&table);
}

int
main (int argc, char **argv)
{
  long cases = 4000, torture = 1000000, steady = 24, seed = 1, quiet = 0;
  const bench_option options[] = {
    { "cases", &cases, 1, 10000000, 500, "cases of each family" },
    { "torture", &torture, 1, LONG_MAX, 100000, "cases of the closed catenary over everything" },
    { "steady", &steady, 1, STATICS_STEADY_MOST, 4, "cases in a current" },
    { "seed", &seed, 0, LONG_MAX, 0, "seed of the cases" },
    { "summary", &quiet, 0, 0, 0, "the ratios to the thesis' search instead of rows" },
  };
  const bench_program program
      = { "statics", "Measure time against error of the static shapes", options, 5 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  state = 0x9e3779b97f4a7c15u * ((uint64_t)seed + 1);
  return run (cases, torture, (int)steady, (int)quiet);
}
