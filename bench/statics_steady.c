/* The line in a current: shooting and relaxation against their own fine solution.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <bight/statics.h>

#include "testbed/calibration.h"
#include "statics.h"
#include "tether/equilibrium.h"

enum
{
  FINE = 4096
};

typedef struct steady_case
{
  bt_vec3 b, moved, pull, next_pull;
  bt_vec3 fine[5], next_fine[5]; /* at quarters of the length */
} steady_case;

typedef struct sea
{
  bt_line line;
  bt_current current;
  bt_water water;
  bt_steady *steady;
  int cases;
  const char *name;
  int order;          /* of the equal steps: 4, less across the kinks of a profile */
  double uncertainty; /* of the fine solution, of the length */
  bt_vec3 r[FINE + 1], t[FINE + 1];
} sea;

/* 100 m of a sinking line in a current that fades with depth, 0.57 m/s at the anchor, 0.19 at 90 m.
 */
static void
fill_sea (sea *x)
{
  memset (x, 0, sizeof *x);
  x->name = "sheared";
  x->order = 4;
  x->line = (bt_line){ 100, 0.0076, 0.1, 2e5, 1.2, 0.01 };
  x->current.kind = BT_CURRENT_POWER;
  x->current.n = 1;
  x->current.exponent = 2;
  x->current.velocity[0] = (bt_vec3){ 0.6, 0.2, 0 };
  x->water = (bt_water){ .density = 1025, .gravity = 9.81, .depth = 200, .current = &x->current };
  x->steady = bt_steady_new (FINE);
}

/* The same line in three layers, whose kinks it crosses.  */
static void
fill_layers (sea *x)
{
  fill_sea (x);
  x->name = "layers";
  x->order = 2;
  x->current.kind = BT_CURRENT_PROFILE;
  x->current.n = 4;
  x->current.z[1] = -20;
  x->current.z[2] = -35;
  x->current.z[3] = -60;
  x->current.velocity[0] = (bt_vec3){ 0.6, 0.2, 0 };
  x->current.velocity[1] = (bt_vec3){ 0.3, 0.4, 0 };
  x->current.velocity[2] = (bt_vec3){ 0.4, -0.1, 0 };
}

static const bt_vec3 anchor = { 0, 0, -10 };

/* Sample the fine shape at quarters.  Return nonzero if it converged.  */
static int
solve_fine (sea *x, bt_vec3 b, bt_vec3 *pull, bt_vec3 out[5])
{
  bt_steady_report report = { 0 };
  bt_error error;
  bt_status status = bt_steady_shoot (x->steady, &x->line, &x->water, anchor, b, FINE, 0, pull,
                                      x->r, x->t, &report, &error);
  for (int k = 0; k < 5; k++)
    out[k] = x->r[k * FINE / 4];
  return status == BT_OK && report.converged;
}

/* Draw chords of 0.5 to 0.95 of the length; those whose fine solution fails are drawn anew and
   counted.  */
static int
draw_steady (sea *x, steady_case *c)
{
  int redrawn = 0;
  for (int i = 0; i < x->cases && redrawn < 500;)
    {
      double chord = 100 * (0.5 + 0.45 * statics_uniform ()),
             turn = 6.283185307179586 * statics_uniform (), dip = 0.8 * (statics_uniform () - 0.7);
      steady_case s;
      s.b = (bt_vec3){ chord * cos (dip) * cos (turn), chord * cos (dip) * sin (turn),
                       anchor.z + chord * sin (dip) };
      s.moved = (bt_vec3){ s.b.x + 0.02, s.b.y - 0.015, s.b.z };
      if (solve_fine (x, s.b, &s.pull, s.fine)
          && solve_fine (x, s.moved, &s.next_pull, s.next_fine))
        c[i++] = s;
      else
        redrawn++;
    }
  return redrawn;
}

static double
steady_miss (const sea *x, int n, const bt_vec3 fine[5])
{
  double worst = 0;
  for (int k = 1; k < 4; k++)
    {
      bt_vec3 p = x->r[k * n / 4], q = fine[k];
      worst = fmax (worst, sqrt ((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y)
                                 + (p.z - q.z) * (p.z - q.z)));
    }
  return worst / x->line.length;
}

static int
shoot (sea *x, const steady_case *c, int n, int warm)
{
  bt_steady_report report = { 0 };
  bt_error error;
  bt_vec3 pull = c->pull;
  bt_status status
      = bt_steady_shoot (x->steady, &x->line, &x->water, anchor, warm ? c->moved : c->b, n, warm,
                         &pull, x->r, x->t, &report, &error);
  return status == BT_OK && report.converged;
}

/* Cold from a parabola through the ends; warm from the shape before.  */
static void
lay (sea *x, const steady_case *c, int n)
{
  double sag = sqrt (fmax (1 - pow (hypot (c->b.x, c->b.y) / x->line.length, 2), 0.01));
  for (int i = 0; i <= n; i++)
    {
      double u = (double)i / n, bow = 0.5 * sag * x->line.length * 4 * u * (1 - u);
      x->r[i] = (bt_vec3){ u * c->b.x + 0.8 * bow, u * c->b.y,
                           anchor.z + u * (c->b.z - anchor.z) - 0.5 * bow };
    }
}

static int
relax (sea *x, bt_vec3 b, int n)
{
  bt_steady_report report = { 0 };
  bt_error error;
  bt_status status = bt_steady_relax (x->steady, &x->line, &x->water, anchor, b, n, 400, x->r, x->t,
                                      &report, &error);
  return status == BT_OK && report.converged;
}

/* What a dive does: from nothing, or from the shape and the tension of the step before.  */
static int
refine (sea *x, const steady_case *c, int n, int warm, bt__reaction *reaction)
{
  bt__shape_counts counts = { 0 };
  bt_vec3 down = { 0, 0, -1 };
  bt_status status
      = bt__equilibrium_solve (x->steady, &x->line, &x->water, anchor, warm ? c->moved : c->b, n,
                               warm, down, reaction, x->r, x->t, &counts, NULL);
  return status == BT_OK && counts.unsettled == 0;
}

/* One timed solve of C by MODEL, and what comes before it.  */
static double
time_steady (sea *x, const steady_case *c, const char *model, int n, int warm, int *good)
{
  int shooting = !strcmp (model, "steady-shoot"), refining = !strcmp (model, "steady");
  bt__reaction reaction = { 0, { 0, 0, 0 }, { { 0, 0, 0 } } };
  if (!shooting && !refining)
    lay (x, c, n);
  if (refining && warm)
    refine (x, c, n, 0, &reaction);
  else if (!shooting && warm)
    relax (x, c->b, n);
  double start = bench_now ();
  *good = refining   ? refine (x, c, n, warm, &reaction)
          : shooting ? shoot (x, c, n, warm)
                     : relax (x, warm ? c->moved : c->b, n);
  return bench_now () - start;
}

/* Time all cases one by one, each the median of STATICS_ROUNDS, and hand the median and the worst
 * out.  */
static void
report_steady (sea *x, const steady_case *c, const char *model, int n, int warm)
{
  double seconds[STATICS_STEADY_MOST], misses[STATICS_STEADY_MOST], times[STATICS_ROUNDS];
  int failures = 0, kept = 0;
  for (int i = 0; i < x->cases; i++)
    {
      int good = 0;
      for (int k = 0; k < STATICS_ROUNDS; k++)
        times[k] = time_steady (x, c + i, model, n, warm, &good);
      failures += !good;
      seconds[i] = bench_median (times, STATICS_ROUNDS);
      if (good)
        misses[kept++] = steady_miss (x, n, warm ? c[i].next_fine : c[i].fine);
    }
  char setting[40], counters[80];
  snprintf (setting, sizeof setting, "%s n=%d", warm ? "warm" : "cold", n);
  snprintf (counters, sizeof counters, "cases=%d;failures=%d", x->cases, failures);
  double median = kept ? bench_median (misses, kept) : NAN,
         middle = bench_median (seconds, x->cases);
  statics_row (x->name, model, setting, "median position/length", median, "shooting n=4096",
               x->uncertainty, middle, counters);
  statics_row (x->name, model, setting, "worst position/length", kept ? misses[kept - 1] : NAN,
               "shooting n=4096", x->uncertainty, middle, counters);
}

/* How far half as many steps are from the fine solution tells its error, by the order.  */
static double
worst_doubt (sea *x, const steady_case *c)
{
  double worst = 0;
  for (int i = 0; i < x->cases; i++)
    if (shoot (x, c + i, FINE / 2, 0))
      worst = fmax (worst, steady_miss (x, FINE / 2, c[i].fine) / (exp2 (x->order) - 1));
  return worst;
}

/* A dive's step and the same line by equal steps, one after the other, cold and warm.  */
static void
report_pair (sea *x, const steady_case *c)
{
  for (int warm = 0; warm < 2; warm++)
    {
      report_steady (x, c, "steady-shoot", 64, warm);
      report_steady (x, c, "steady", 64, warm);
    }
}

/* Draw COUNT lines in X; return false where nothing can be measured.  */
static int
begin_sea (sea *x, steady_case *cases, int count)
{
  char counters[80];
  x->cases = count;
  if (!x->steady)
    return 0;
  int redrawn = draw_steady (x, cases);
  x->uncertainty = worst_doubt (x, cases);
  snprintf (counters, sizeof counters, "cases=%d;redrawn=%d", x->cases, redrawn);
  statics_row (x->name, "steady-shoot", "cold n=4096", "fine solutions that failed", redrawn,
               "none", 0, 0, counters);
  return 1;
}

void
statics_steady (int count)
{
  static sea x;
  static steady_case cases[STATICS_STEADY_MOST];
  static const int shots[] = { 8, 32, 128, 256 }, chains[] = { 16, 128, 512 };
  fill_layers (&x);
  if (begin_sea (&x, cases, count))
    report_pair (&x, cases);
  bt_steady_free (x.steady);
  fill_sea (&x);
  if (!begin_sea (&x, cases, count))
    return;
  report_pair (&x, cases);
  for (size_t k = 0; k < sizeof shots / sizeof *shots; k++)
    for (int warm = 0; warm < 2; warm++)
      report_steady (&x, cases, "steady-shoot", shots[k], warm);
  for (size_t k = 0; k < sizeof chains / sizeof *chains; k++)
    for (int warm = 0; warm < 2; warm++)
      report_steady (&x, cases, "steady-relax", chains[k], warm);
  bt_steady_free (x.steady);
}
