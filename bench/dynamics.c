/* bight-bench-dynamics: time against error of the moving line, as CSV rows on standard output.

   Two scenes of a 100 m line (EA 2e5 N, BA 20 N s, 10 mm, neutral, current .3 m/s), each 20 s:
   `smooth', a vehicle set off at once on a Lissajous path of at most 1.5 m/s, and
   `snap', a slack line run out at 1.5 m/s until it is taut and held.  Errors are rms over eleven
   points and every half second, and of the tension at the vehicle relative to its own rms, against
   a converged run: 400 and 800 intervals in steps of 1/480 s, extrapolated.  The base line is an
   explicit fourth-order Runge-Kutta chain with the same forces, at the largest step it bears.
   A vehicle of 20 kg that runs its line taut at 1 m/s is flown in dives: the largest tension
   against that of the exact wave.  Times are CPU times; the calibration ratio is per simulated
   second in units of one calibration step, per step where it says so.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"
#include "tether/dynamic.h"

#include "testbed/calibration.h"
#include "testbed/chance.h"
#include "impacts.h"
#include "moordyn.h"
#include "options.h"
#include "row.h"

enum
{
  N_MAX = 800,
  SECONDS = 20,
  SAMPLES = 2 * SECONDS,
  POINTS = 11,
  PILOT_SEEDS = 30,
  PILOT_STEPS = 1800
};

#define LENGTH 100.0
#define DENSITY 1025.0

static bench_table table;
static long every = 1, finest = 800, rounds = 3, seeds = PILOT_SEEDS; /* options */
static const bt_vec3 current_velocity = { -0.2, 0.2, 0.1 };
static bt_tether_props line = {
  .diameter = 0.01, .mass = 0.0805033117, .ea = 2e5, .ba = 20, .cdn = 1.2, .cdt = 0.02, .ca = 1
};

/* ---- Scenes ---- */

typedef enum scene
{
  SMOOTH,
  SNAP,
  SCENES
} scene;

static const char *const scene_names[SCENES] = { "smooth", "snap" };

/* Where the vehicle is, T seconds after the start.  */
static bt_vec3
vehicle (scene k, double t)
{
  if (k == SNAP)
    return bt__vec (fmin (85 + 1.5 * t, 100.02), 0, 0);
  return bt__vec (90 + 4 * sin (0.3 * t), 3 * sin (0.2 * t), 2 * sin (0.4 * t));
}

/* What a run gives: points at tenths of the line and the tension at the vehicle.  */
typedef struct record
{
  bt_vec3 at[SAMPLES][POINTS];
  double tension[SAMPLES];
} record;

/* ---- The implicit line ---- */

typedef struct chain
{
  bt__dynamic *d;
  bt__dynamic_work *work;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__dynamic_report report;
  long solves, unsolved;
} chain;

static void
chain_step (chain *c, double h)
{
  c->in.h = h;
  c->water.time += h;
  if (bt__dynamic_step (c->d, c->work, &c->in, &c->report, NULL))
    abort ();
  c->solves += c->report.solves;
  c->unsolved += !c->report.converged;
}

/* The equilibrium in the current from which every run starts.  */
static void
chain_start (chain *c, scene k, int n)
{
  bt_vec3 from = { 0, 0, 0 }, to = vehicle (k, 0);
  bt_vec3 shape[3] = { from, { to.x / 2 - 10, 22, 12 }, to };
  c->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { current_velocity } };
  c->water = (bt_water){ DENSITY, 9.81, 100, 0, &c->current, NULL, NULL, NULL };
  c->in = (bt__dynamic_input){ .line = &line, .water = &c->water, .tolerance = 1e-8 };
  c->in.end[0].at = from;
  c->in.end[1].at = to;
  if (bt__dynamic_init (c->d, N_MAX, n, shape, 3, LENGTH, line.ea, NULL))
    abort ();
  double h = 0.05;
  for (int i = 0; i < 90; i++)
    {
      chain_step (c, h);
      bt__dynamic_still (c->d);
      h = c->report.converged ? fmin (1.3 * h, 300) : fmax (h / 4, 0.01);
    }
  c->in.tolerance = 0;
  c->water.time = 0;
  c->solves = c->unsolved = 0;
}

static int
chain_open (chain *c)
{
  c->d = malloc (bt__dynamic_size (N_MAX));
  c->work = bt__dynamic_work_new (N_MAX);
  return c->d && c->work;
}

/* Fly scene K with N intervals in PER steps each half second.  Return the CPU seconds of a
   simulated second.  */
static double
chain_fly (chain *c, scene k, int n, int per, int order, double tolerance, record *r)
{
  double h = 0.5 / per, spent = 0;
  chain_start (c, k, n);
  c->in.order = order;
  c->in.tolerance = tolerance;
  for (int s = 0; s < SAMPLES; s++)
    {
      double start = bench_now ();
      for (int i = 1; i <= per; i++)
        {
          c->in.end[1].at = vehicle (k, (s * per + i) * h);
          chain_step (c, h);
        }
      spent += bench_now () - start;
      for (int p = 0; p < POINTS; p++)
        r->at[s][p] = bt__dynamic_point (c->d, LENGTH * p / (POINTS - 1));
      r->tension[s] = bt__dynamic_node_tension (c->d, n);
    }
  return spent / SECONDS;
}

/* ---- The explicit base line ---- */

typedef struct explicit_state
{
  bt_vec3 r[N_MAX + 1], v[N_MAX + 1];
} explicit_state;

typedef struct explicit_chain
{
  int n;
  scene k;
  double l, time;
  explicit_state now, a, b, at, sum;
} explicit_chain;

static inline double
explicit_tension (const explicit_chain *c, const explicit_state *s, int j, bt_vec3 *t)
{
  bt_vec3 d = bt__sub (s->r[j + 1], s->r[j]);
  double length = bt__norm (d), inverse = 1 / length;
  *t = bt__scale (inverse, d);
  double rate = bt__dot (*t, bt__sub (s->v[j + 1], s->v[j])) / c->l;
  double pull = line.ea * (length / c->l - 1) + line.ba * rate;
  return pull > 0 ? pull : 0;
}

/* Acceleration of a node of L metres of line between tangents P and Q under F.  */
static inline bt_vec3
explicit_acceleration (double l, bt_vec3 f, bt_vec3 p, bt_vec3 q, bt_vec3 v)
{
  bt_vec3 tau = bt__add (p, q), u = bt__sub (current_velocity, v);
  tau = bt__scale (1 / sqrt (bt__dot (tau, tau)), tau);
  double along = bt__dot (u, tau), half = 0.5 * DENSITY * line.diameter * l;
  bt_vec3 across = bt__axpy (u, -along, tau);
  double kn = half * line.cdn * sqrt (bt__dot (across, across));
  double kt = half * line.cdt * BT__PI * fabs (along);
  f = bt__axpy (bt__axpy (f, kn, across), kt * along, tau);
  double m = line.mass * l, n = 1 / (m + half * BT__PI / 2 * line.diameter * line.ca);
  return bt__axpy (bt__scale (n, f), bt__dot (f, tau) * (1 / m - n), tau);
}

/* The speed of the vehicle, by its path.  */
static bt_vec3
vehicle_speed (scene k, double t)
{
  const double h = 1e-6;
  return bt__scale (1 / h, bt__sub (vehicle (k, t + h), vehicle (k, t)));
}

static void
explicit_rates (const explicit_chain *c, double t, const explicit_state *s, explicit_state *d)
{
  bt_vec3 p, q, zero = { 0, 0, 0 };
  double before = explicit_tension (c, s, 0, &p);
  d->r[0] = d->v[0] = d->v[c->n] = zero;
  d->r[c->n] = vehicle_speed (c->k, t);
  for (int i = 1; i < c->n; i++)
    {
      double after = explicit_tension (c, s, i, &q);
      bt_vec3 f = bt__axpy (bt__scale (after, q), -before, p);
      d->r[i] = s->v[i];
      d->v[i] = explicit_acceleration (c->l, f, p, q, s->v[i]);
      before = after;
      p = q;
    }
}

static void
explicit_advance (const explicit_chain *c, const explicit_state *from, double k,
                  const explicit_state *d, explicit_state *to)
{
  for (int i = 0; i <= c->n; i++)
    {
      to->r[i] = bt__axpy (from->r[i], k, d->r[i]);
      to->v[i] = bt__axpy (from->v[i], k, d->v[i]);
    }
}

static void
explicit_step (explicit_chain *c, double h)
{
  c->now.v[c->n] = vehicle_speed (c->k, c->time);
  explicit_rates (c, c->time, &c->now, &c->a);
  explicit_advance (c, &c->now, h / 6, &c->a, &c->sum);
  explicit_advance (c, &c->now, h / 2, &c->a, &c->at);
  explicit_rates (c, c->time + h / 2, &c->at, &c->b);
  explicit_advance (c, &c->sum, h / 3, &c->b, &c->sum);
  explicit_advance (c, &c->now, h / 2, &c->b, &c->at);
  explicit_rates (c, c->time + h / 2, &c->at, &c->a);
  explicit_advance (c, &c->sum, h / 3, &c->a, &c->sum);
  explicit_advance (c, &c->now, h, &c->a, &c->at);
  c->time += h;
  explicit_rates (c, c->time, &c->at, &c->b);
  explicit_advance (c, &c->sum, h / 6, &c->b, &c->now);
  c->now.r[c->n] = vehicle (c->k, c->time);
}

/* Fly with the nodes of START; return the CPU seconds of a simulated second, NaN if it blew up.  */
static double
explicit_fly (explicit_chain *c, const chain *start, scene k, int n, int per, record *r)
{
  double h = 0.5 / per, spent = 0;
  memset (&c->now, 0, sizeof c->now);
  *c = (explicit_chain){ .n = n, .k = k, .l = LENGTH / n, .now = c->now };
  memcpy (c->now.r, bt__dynamic_x (start->d), (size_t)(n + 1) * sizeof *c->now.r);
  bt__dynamic *copy = start->d;
  for (int s = 0; s < SAMPLES; s++)
    {
      double from = bench_now (), fastest = 0;
      for (int i = 0; i < per; i++)
        explicit_step (c, h);
      spent += bench_now () - from;
      for (int i = 0; i <= n; i++)
        fastest += bt__dot (c->now.v[i], c->now.v[i]);
      if (!(fastest < 400 * n))
        return NAN;
      memcpy (bt__dynamic_x (copy), c->now.r, (size_t)(n + 1) * sizeof *c->now.r);
      for (int p = 0; p < POINTS; p++)
        r->at[s][p] = bt__dynamic_point (copy, LENGTH * p / (POINTS - 1));
      r->tension[s] = NAN;
    }
  return spent / SECONDS;
}

/* ---- Errors ---- */

typedef struct misses
{
  double position, tension; /* m rms; of the rms tension */
} misses;

static misses
compare (const record *a, const record *b)
{
  double p = 0, t = 0, scale = 0;
  for (int s = 0; s < SAMPLES; s++)
    {
      for (int i = 0; i < POINTS; i++)
        {
          bt_vec3 d = bt__sub (a->at[s][i], b->at[s][i]);
          p += bt__dot (d, d);
        }
      double d = a->tension[s] - b->tension[s];
      t += d * d;
      scale += b->tension[s] * b->tension[s];
    }
  return (misses){ sqrt (p / (SAMPLES * POINTS)), sqrt (t / scale) };
}

/* The converged run of scene K and its uncertainty, from two of second order in both.  */
static misses
converge (chain *c, scene k, record *r)
{
  static record coarse;
  int n = (int)finest, per = (int)(240 * finest / N_MAX);
  chain_fly (c, k, n / 2, per / 2, 2, 1e-8, &coarse);
  chain_fly (c, k, n, per, 2, 1e-8, r);
  misses m = compare (&coarse, r);
  for (int s = 0; s < SAMPLES; s++)
    {
      for (int p = 0; p < POINTS; p++)
        r->at[s][p] = bt__axpy (r->at[s][p], 1.0 / 3, bt__sub (r->at[s][p], coarse.at[s][p]));
      r->tension[s] += (r->tension[s] - coarse.tension[s]) / 3;
    }
  return (misses){ m.position / 15, m.tension / 15 };
}

/* ---- Work and precision ---- */

static const int intervals[] = { 5, 7, 10, 14, 20, 28, 40, 57, 80, 113, 160, 226 };
static const int rates[] = { 30, 15, 10, 5, 3, 2 }; /* steps in half a second */

enum
{
  SIZES = sizeof intervals / sizeof *intervals,
  RATES = sizeof rates / sizeof *rates,
  TARGETS = 4
};

/* What is to be reached, of the smooth scene.  */
static const struct
{
  double error, ratio;
} targets[TARGETS] = { { 0.2, 25 }, { 0.07, 50 }, { 0.01, 100 }, { 0.003, 250 } };

/* The cheapest run of each kind within each target.  */
typedef struct front
{
  double seconds[TARGETS];
  char setting[TARGETS][48];
} front;

static void
front_clear (front *f)
{
  for (int k = 0; k < TARGETS; k++)
    {
      f->seconds[k] = HUGE_VAL;
      f->setting[k][0] = '\0';
    }
}

static void
front_add (front *f, double error, double seconds, const char *setting)
{
  for (int k = 0; k < TARGETS; k++)
    if (error <= targets[k].error && seconds < f->seconds[k])
      {
        f->seconds[k] = seconds;
        snprintf (f->setting[k], sizeof f->setting[k], "%s", setting);
      }
}

static void
row (const char *name, const char *model, const char *setting, const char *metric, double error,
     double uncertainty, double seconds, const char *counters)
{
  bench_put (&table, &(bench_row){ name, model, setting, metric, error, "converged run",
                                   uncertainty, seconds, counters });
}

static void
report (scene k, const char *model, const char *setting, misses m, misses doubt, double seconds,
        const char *counters, int quiet)
{
  if (quiet)
    return;
  row (scene_names[k], model, setting, "rms position m", m.position, doubt.position, seconds,
       counters);
  if (isfinite (m.tension))
    row (scene_names[k], model, setting, "rms tension", m.tension, doubt.tension, seconds,
         counters);
}

static void
bench_implicit (chain *c, scene k, const record *best, misses doubt, front *f, int quiet)
{
  static record r;
  for (int i = 0; i < SIZES; i += (int)every)
    for (int q = 0; q < RATES; q++)
      for (int order = 2; order <= 4; order += 2)
        {
          char setting[48], counters[80];
          double seconds = HUGE_VAL;
          for (int round = 0; round < rounds; round++)
            seconds = fmin (seconds, chain_fly (c, k, intervals[i], rates[q], order, 0, &r));
          misses m = compare (&r, best);
          snprintf (setting, sizeof setting, "n=%d h=%.3g order=%d", intervals[i], 0.5 / rates[q],
                    order);
          snprintf (counters, sizeof counters, "steps=%d;solves=%ld;unsolved=%ld",
                    rates[q] * SAMPLES, c->solves, c->unsolved);
          report (k, "dynamic", setting, m, doubt, seconds, counters, quiet);
          front_add (f, m.position, seconds, setting);
        }
}

/* The largest step, by tenths, that is worth having: a smaller one by a fifth is not better by a
   tenth (a step at the very limit is finite, but rings).  Return CPU seconds, NaN if there is none.
 */
static double
largest_step (chain *c, explicit_chain *e, scene k, int n, const record *best, int *per, misses *m)
{
  static record r;
  double h = 2.1 * LENGTH / n / sqrt (line.ea / line.mass);
  double seconds[2] = { NAN, NAN }; /* of the last two steps, and what goes with them */
  misses miss[2] = { { NAN, NAN }, { NAN, NAN } };
  int steps[2] = { 0, 0 };
  for (int trial = 0; trial < 40; trial++, h *= 0.9)
    {
      int now = (int)ceil (0.5 / h);
      chain_start (c, k, n);
      double spent = explicit_fly (e, c, k, n, now, &r);
      misses is = compare (&r, best);
      *per = steps[0];
      *m = miss[0];
      if (isfinite (spent) && miss[0].position <= 1.1 * is.position)
        return seconds[0];
      seconds[0] = seconds[1];
      miss[0] = miss[1];
      steps[0] = steps[1];
      seconds[1] = spent;
      miss[1] = isfinite (spent) ? is : (misses){ NAN, NAN };
      steps[1] = now;
    }
  return NAN;
}

static void
bench_explicit (chain *c, explicit_chain *e, scene k, const record *best, misses doubt, front *f,
                int quiet)
{
  for (int i = 0; i < SIZES; i += (int)every)
    {
      char setting[48], counters[80];
      int n = intervals[i];
      int per = 0;
      misses m = { 0, 0 };
      double seconds = largest_step (c, e, k, n, best, &per, &m);
      snprintf (setting, sizeof setting, "n=%d h=%.3g", n, 0.5 / per);
      snprintf (counters, sizeof counters, "steps=%d", per * SAMPLES);
      report (k, "rk4", setting, m, doubt, seconds, counters, quiet);
      front_add (f, m.position, seconds, setting);
    }
}

static int
run_scene (chain *c, explicit_chain *e, scene k, int quiet)
{
  static record best;
  front ours, theirs;
  front_clear (&ours);
  front_clear (&theirs);
  misses doubt = converge (c, k, &best);
  bench_implicit (c, k, &best, doubt, &ours, quiet);
  bench_explicit (c, e, k, &best, doubt, &theirs, quiet);
  for (int t = 0; t < TARGETS && quiet; t++)
    {
      printf ("%-6s %5.3f m: %7.2f us per simulated second (%s), base line %8.1f us (%s): 1/%.0f",
              scene_names[k], targets[t].error, 1e6 * ours.seconds[t], ours.setting[t],
              1e6 * theirs.seconds[t], theirs.setting[t], theirs.seconds[t] / ours.seconds[t]);
      printf (k == SMOOTH ? ", to reach 1/%.0f\n" : "\n", targets[t].ratio);
    }
  return 0;
}

/* ---- A jerky pilot ---- */

static uint64_t seed;

static int
ascending (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* One seed: jerks at any moment, run-outs to 100.02 m.  */
static void
fly_pilot (chain *c, int n, double *times)
{
  bt_vec3 v = { 0, 0, 0 };
  chain_start (c, SMOOTH, n);
  for (int i = 0; i < PILOT_STEPS; i++)
    {
      bt_vec3 *at = &c->in.end[1].at;
      if (chance_between (&seed, 0, 1) < 0.02)
        v = bt__vec (chance_between (&seed, -1.5, 1.5), chance_between (&seed, -1.5, 1.5),
                     chance_between (&seed, -0.7, 0.7));
      *at = bt__axpy (*at, 1.0 / 60, v);
      double far = bt__norm (*at);
      if (far > 100.02)
        *at = bt__scale (100.02 / far, *at);
      double start = bench_now ();
      chain_step (c, 1.0 / 60);
      times[i] = bench_now () - start;
    }
}

static void
run_pilot (chain *c, int n, double ei, int quiet)
{
  static double times[PILOT_SEEDS * PILOT_STEPS];
  static const double shares[] = { 0.5, 0.99, 0.999, 1 };
  static const char *const names[] = { "p50", "p99", "p99.9", "max" };
  int all = (int)seeds * PILOT_STEPS;
  long solves = 0, unsolved = 0;
  line.ei = ei;
  seed = 0x9e3779b97f4a7c15u;
  for (int k = 0; k < seeds; k++)
    {
      fly_pilot (c, n, times + k * PILOT_STEPS);
      solves += c->solves;
      unsolved += c->unsolved;
    }
  line.ei = 0;
  qsort (times, (size_t)all, sizeof *times, ascending);
  if (quiet)
    printf ("pilot, %d intervals, EI %g: ", n, ei);
  for (int k = 0; k < 4; k++)
    {
      char setting[48], counters[80];
      double t = times[(int)(shares[k] * (all - 1))];
      snprintf (setting, sizeof setting, "n=%d h=1/60 EI=%g %s per step", n, ei, names[k]);
      snprintf (counters, sizeof counters, "steps=%d;solves=%ld;unsolved=%ld", all, solves,
                unsolved);
      if (quiet)
        printf ("%s %.1f us (%.2f), ", names[k], 1e6 * t, t / table.step);
      else
        row ("pilot", "dynamic", setting, "unsolved share", (double)unsolved / all, 0, t, counters);
    }
  if (quiet)
    printf ("%.2f solves a step, %ld of %d unsolved\n", (double)solves / all, unsolved, all);
}

/* ---- ---- */

static int
run (int quiet)
{
  chain c;
  explicit_chain *e = malloc (sizeof *e);
  if (!chain_open (&c) || !e)
    return EXIT_FAILURE;
  if (quiet)
    bench_calibrate_table (&table);
  else
    bench_open (&table);
  if (quiet)
    printf ("one calibration step: %.2f us\n", 1e6 * table.step);
  run_pilot (&c, 100, 0, quiet);
  run_pilot (&c, 100, 0.1, quiet);
  bench_impacts (&table, quiet);
  for (int k = 0; k < SCENES; k++)
    run_scene (&c, e, (scene)k, quiet);
  if (quiet)
    bench_moordyn (&table, 1, 3, quiet);
  free (e);
  free (c.d);
  bt__dynamic_work_free (c.work);
  return quiet ? EXIT_SUCCESS : bench_close (&table);
}

int
main (int argc, char **argv)
{
  long quiet = 0;
  const bench_option options[] = {
    { "every", &every, 1, SIZES, 3, "only every N-th of the numbers of intervals" },
    { "finest", &finest, 100, N_MAX, 320, "intervals of the converged run" },
    { "rounds", &rounds, 1, 100, 1, "runs, of which the quickest counts" },
    { "pilots", &seeds, 1, PILOT_SEEDS, 4, "jerky pilots" },
    { "summary", &quiet, 0, 0, 0,
      "the ratios to the explicit base line, and to MoorDyn through it, instead of rows" },
  };
  const bench_program program
      = { "dynamics", "Measure time against error of the moving line", options, 5 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run ((int)quiet) : status;
}
