/* bight-bench-contact: the moving line among obstacles, as CSV rows on standard output.

   drag: 100 links hauled at 0.1, 1 and 3 m/s through a right angle over a box's edge, a drum, a
   wire of 10 mm, a weight on the near end; the error is the mean of T2 / T1 against e^(mu theta),
   the counters say what share of steps was held back or cut, and how far T2 swings.  jacket: a
   pilot who aims through the members: percentiles of the step, towed and with a mass of its own, at
   0.1, 1 and 3 m/s.  wrap: a line about a drum, by the number of contacts and the drum's radius,
   beside its capstan.  ground: a line on a bottom, by the number of places it touches.  alone: how
   many times its own step a line takes that has a scene far away to look out for, or itself,
   hanging, folded, in a coil (contact_alone.c).  quiet: the most energy a line that falls over a
   beam gains in a step, and how fast contacts of lines at rest slip.  knot: an overhand knot about
   a beam runs up and is pulled tight, laid 20 ways; the error is the most tension at the end
   against that of a mass stopped by a spring.

   Crossings are counted by an outside judge; times leave him out.  Times are CPU; the calibration
   ratio is per step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/calibration.h"
#include "contact_alone.h"
#include "contact_quiet.h"
#include "testbed/contact_scene.h"
#include "contact_wrap.h"
#include "options.h"
#include "row.h"

enum
{
  LINKS = 100,
  MOST_STEPS = 200000
};

static const double frame = 1.0 / 60;
static bench_table table;
static double times[MOST_STEPS];
static reef place;
static rope line;

static void
row (const char *name, const char *setting, const char *metric, double error, double seconds,
     const char *counters)
{
  bench_put (&table, &(bench_row){ name, "dynamic", setting, metric, error, "closed form", 0,
                                   seconds, counters });
}

static int
ascending (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* One step, timed without its judge.  */
static double
timed_step (int judged)
{
  double start = bench_now ();
  rope_step (&line, frame, 0);
  double time = bench_now () - start;
  if (judged)
    rope_judge (&line);
  return time;
}

static void
fail (void)
{
  fputs ("bight-bench-contact: a scene could not be made\n", stderr);
  exit (EXIT_FAILURE);
}

static void
close_scene (void)
{
  rope_close (&line);
  reef_close (&place);
}

/* ---- Hauled through a right angle ---- */

typedef enum corner
{
  BOX_EDGE,
  DRUM,
  WIRE,
  CORNERS
} corner;

static const char *const corner_names[CORNERS] = { "box edge", "drum .6 m", "wire 10 mm" };

static void
open_corner (corner k, double mu)
{
  double radius = k == DRUM   ? 0.6
                  : k == WIRE ? 0.005
                              : 0,
         bend = radius + (k == DRUM ? 0.006 : 0.4);
  bt_vec3 shape[12] = { { -bend, 0, -14 } };
  if (!reef_open (&place))
    fail ();
  if (k == BOX_EDGE)
    reef_box (&place, bt__vec (15, 0, -1), bt__vec (15, 3, 1), 0);
  else if (k == DRUM)
    reef_cylinder (&place, bt__vec (0, -3, 0), bt__vec (0, 3, 0), radius);
  else
    reef_wire (&place, bt__vec (0, -3, 0), bt__vec (0, 3, 0), radius);
  for (int i = 0; i < 10; i++)
    {
      double a = BT__PI / 2 * i / 9, r = 1.03 * bend;
      shape[i + 1] = bt__vec (-r * cos (a), 0, r * sin (a));
    }
  shape[11] = bt__vec (15, 0, shape[10].z);
  double length = bt__length (shape, 12);
  if (!reef_raise (&place) || !rope_open (&line, &place, LINKS, shape, 12, length, mu))
    fail ();
  line.line.cdt = 0;
  line.config.pull[1] = INFINITY;
  line.in.end[0]
      = (bt__dynamic_end){ .free = 1, .body = { .mass = 1, .linear = 5, .force = { 0, 0, -30 } } };
}

static void
haul (corner k, double mu, double speed)
{
  open_corner (k, mu);
  bt_vec3 at = line.in.end[1].at;
  int steps = (int)fmin (9 / speed / frame, 1200);
  double low = 0, high = 0, least = INFINITY, most = 0, sum = 0, under = INFINITY, over = 0;
  for (int i = 0; i < steps; i++)
    {
      const double *t = bt__dynamic_tension (line.d);
      at.x += speed * frame * fmin (1, i / 60.0);
      line.in.end[1].at = at;
      sum += timed_step (1);
      if (i < steps / 2)
        continue;
      low += t[1];
      high += t[line.d->n - 2];
      least = fmin (least, t[line.d->n - 2]);
      most = fmax (most, t[line.d->n - 2]);
      under = fmin (under, t[line.d->n - 2] / t[1]);
      over = fmax (over, t[line.d->n - 2] / t[1]);
    }
  char setting[80], counters[240];
  snprintf (setting, sizeof setting, "%s mu=%g %g m/s", corner_names[k], mu, speed);
  snprintf (
      counters, sizeof counters,
      "T2=%.1f..%.1f N;T2/T1=%.3f;from=%.3f;to=%.3f;exactly=%.3f;truncated=%.3g;unsolved=%.3g;"
      "crossings=%ld;solves=%.2f",
      least, most, high / low, under, over, exp (mu * BT__PI / 2), (double)line.truncated / steps,
      (double)line.unconverged / steps, line.crossings, (double)line.solves / steps);
  row ("drag", setting, "T2/T1 against capstan", fabs (high / low / exp (mu * BT__PI / 2) - 1),
       sum / steps, counters);
  close_scene ();
}

/* ---- A pilot in a jacket ---- */

static void
thrust (bt_vec3 target, double speed)
{
  bt_vec3 way = bt__sub (target, bt__dynamic_x (line.d)[line.d->n]);
  double far = bt__norm (way), most = speed > 1.5 ? 600 : 150;
  bt_vec3 want = bt__scale (fmin (speed, far) / fmax (far, 1e-9), way);
  bt_vec3 f = bt__scale (200, bt__sub (want, bt__dynamic_v (line.d)[line.d->n]));
  double size = bt__norm (f);
  line.in.end[1].body.force = size > most ? bt__scale (most / size, f) : f;
}

static void
fly (int body, double speed, int steps, uint64_t seed, int judged)
{
  static const double shares[] = { 0.5, 0.99, 0.999, 1 };
  static const char *const names[] = { "p50", "p99", "p99.9", "max" };
  const bt_vec3 shape[] = { { -14, 0, -5 }, { -16, -20, -8 }, { -12, -20, -8 }, { -9, 0, -8 } };
  dice d = dice_new (7 * seed + 1);
  bt_vec3 target = { 0, 0, -8 };
  double sum = 0, busy = 0;
  int until = 0, busy_steps = 0;
  long held = 0;
  if (!reef_jacket (&place, seed) || !rope_open (&line, &place, LINKS, shape, 4, 60, 0.3))
    fail ();
  line.current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { { -0.15, 0.1, 0 } } };
  if (body)
    line.in.end[1] = (bt__dynamic_end){ .free = 1, .body = { .mass = 20, .quadratic = 60 } };
  for (int i = 0; i < steps; i++)
    {
      if (i >= until || bt__distance (bt__dynamic_x (line.d)[line.d->n], target) < 0.3)
        {
          target = bt__vec (dice_between (&d, -9, 9), dice_between (&d, -9, 9),
                            dice_between (&d, -28, -1));
          until = i + 900;
        }
      if (body)
        thrust (target, speed);
      else
        rope_tow (&line, target, speed, frame);
      times[i] = timed_step (judged);
      sum += times[i];
      held += line.touch.held[1];
      if (line.touch.touches >= 15 && line.touch.touches <= 25)
        {
          busy += times[i];
          busy_steps++;
        }
    }
  qsort (times, (size_t)steps, sizeof *times, ascending);
  char setting[80], counters[240];
  snprintf (
      counters, sizeof counters,
      "steps=%d;held=%.3g;truncated=%.3g;unsolved=%.3g;crossings=%ld;solves=%.2f;touches=%.1f;"
      "most=%ld;tension=%.0f N",
      steps, (double)held / steps, (double)line.truncated / steps, (double)line.unconverged / steps,
      line.crossings, (double)line.solves / steps, (double)line.touches / steps, line.most_touches,
      line.tension);
  snprintf (setting, sizeof setting, "%s %g m/s mean", body ? "20 kg" : "towed", speed);
  row ("jacket", setting, "crossings", (double)line.crossings, sum / steps, counters);
  for (int k = 0; k < 4; k++)
    {
      snprintf (setting, sizeof setting, "%s %g m/s %s", body ? "20 kg" : "towed", speed, names[k]);
      row ("jacket", setting, "crossings", (double)line.crossings,
           times[(int)(shares[k] * (steps - 1))], "");
    }
  if (busy_steps)
    {
      snprintf (setting, sizeof setting, "%s %g m/s at 15 to 25", body ? "20 kg" : "towed", speed);
      row ("jacket", setting, "crossings", (double)line.crossings, busy / busy_steps, "");
    }
  close_scene ();
}

/* ---- On the ground ---- */

static void
lie (int links, double height, int mesh)
{
  dice d = dice_new (3);
  const bt_vec3 shape[] = { { 0, 0, height - 10 }, { 10, 0, -9.9 }, { 20, 0, height - 10 } };
  if (!reef_open (&place))
    fail ();
  if (mesh)
    reef_bottom (&place, &d, -10, 0.5, 110, mesh > 1 ? 0.1 : 0);
  else
    reef_plane (&place, -10);
  if (!reef_raise (&place) || !rope_open (&line, &place, links, shape, 3, 34, 0.3))
    fail ();
  line.line.wet_weight = 0.5;
  line.line.mass += 0.5 / 9.81;
  double sum = 0;
  long touches = 0, solves = 0;
  int steps = 900;
  for (int i = 0; i < 1200; i++)
    timed_step (0);
  long before = line.solves;
  for (int i = 0; i < steps; i++)
    {
      line.in.end[1].at.y += 0.5 * frame;
      sum += timed_step (0);
      touches += line.touch.touches;
    }
  solves = line.solves - before;
  char setting[80], counters[120];
  snprintf (setting, sizeof setting, "%s %d links %ld touches",
            mesh > 1 ? "rough mesh"
            : mesh   ? "flat mesh"
                     : "plane",
            links, touches / steps);
  snprintf (counters, sizeof counters, "solves=%.2f;unsolved=%.3g;truncated=%ld",
            (double)solves / steps, (double)line.unconverged / (double)line.steps, line.truncated);
  row ("ground", setting, "truncated", (double)line.truncated, sum / steps, counters);
  close_scene ();
}

/* ---- Knotted ---- */

/* Lay an overhand knot of LINKS about a beam, its held end ASIDE, pulled by FORCE on a body of
   MASS.  */
static void
tie (int links, double force, double mass, double aside)
{
  if (!rope_tie (&line, &place, links, 0.15, 0.3, aside))
    fail ();
  line.in.end[1] = (bt__dynamic_end){
    .free = 1, .body = { .mass = mass, .quadratic = 60, .force = { force, -0.3 * force, 0 } }
  };
}

/* What came of knots.  */
typedef struct knots
{
  long steps, unsolved, truncated, crossings, solves;
  int meets;
  double time, load, tension, end, snap;
} knots;

/* Run it up.  A body that FORCE pulls at its speed is stopped by what of the line is beyond the
   beam as a mass by a spring.  */
static void
run_up (int links, double force, double mass, double aside, knots *k)
{
  double fastest = 0, end = 0;
  tie (links, force, mass, aside);
  for (int i = 0; i < 600; i++)
    {
      k->time += timed_step (1);
      k->load = fmax (k->load, line.touch.load);
      fastest = fmax (fastest, bt__norm (bt__dynamic_v (line.d)[line.d->n]));
      end = fmax (end, bt__dynamic_tension (line.d)[line.d->n - 1]);
    }
  bt_vec3 x = bt__dynamic_x (line.d)[line.d->n];
  double length = hypot (x.x, x.y), pull = bt__norm (line.in.end[1].body.force);
  double stiffness = line.line.ea / length, moved = mass + length * line.line.mass / 3;
  double snap = pull + sqrt (pull * pull + stiffness * moved * fastest * fastest);
  k->end = fmax (k->end, end);
  k->snap = fmax (k->snap, end / snap);
  k->tension = fmax (k->tension, line.tension);
  k->steps += line.steps;
  k->unsolved += line.unconverged;
  k->truncated += line.truncated;
  k->crossings += line.crossings;
  k->solves += line.solves;
  k->meets = line.touch.meets;
  close_scene ();
}

static void
knot (int links, double force, double mass)
{
  enum
  {
    WAYS = 20
  };
  knots k = { 0 };
  for (int i = 0; i < WAYS; i++)
    run_up (links, force, mass, 0.4 * i / WAYS, &k);
  double steps = (double)k.steps;
  char setting[80], counters[240];
  snprintf (setting, sizeof setting, "overhand %d links %g N %g kg", links, force, mass);
  snprintf (counters, sizeof counters,
            "unsolved=%.3g;truncated=%.3g;crossings=%ld;solves=%.2f;meets=%d;load=%.0f N;"
            "at the end=%.0f N;anywhere=%.0f N",
            (double)k.unsolved / steps, (double)k.truncated / steps, k.crossings,
            (double)k.solves / steps, k.meets, k.load, k.end, k.tension);
  row ("knot", setting, "most tension at the end, of the snap load", k.snap, k.time / steps,
       counters);
}

/* ---- ---- */

static int
run (long steps, uint64_t seed, int rounds)
{
  static const double speeds[] = { 0.1, 1, 3 };
  bench_open (&table);
  for (int k = 0; k < CORNERS; k++)
    for (int i = 0; i < 3; i++)
      haul ((corner)k, 0.3, speeds[i]);
  for (int i = 0; i < 3; i++)
    fly (1, speeds[i], (int)steps, seed, 1);
  for (int i = 0; i < 3; i++)
    fly (0, speeds[i], (int)steps, seed, 1);
  if (!contact_wrap (&table, steps < 1000))
    fail ();
  for (int mesh = 0; mesh < 3; mesh++)
    for (int links = 50; links <= 200; links *= 2)
      lie (links, 1, mesh);
  lie (100, 5, 0);
  if (!contact_alone (&table, rounds) || !contact_quiet (&table, steps < 1000))
    fail ();
  knot (120, 60, 20);
  knot (120, 300, 20);
  knot (120, 60, 0.2);
  knot (120, 300, 0.2);
  return bench_close (&table);
}

int
main (int argc, char **argv)
{
  long steps = 6000, seed = 3, rounds = 41;
  const bench_option options[] = {
    { "steps", &steps, 1, MOST_STEPS, 900, "steps of a pilot in the jacket" },
    { "seed", &seed, 0, LONG_MAX, 0, "seed of the jacket and the pilot" },
    { "rounds", &rounds, 1, 201, 11, "rounds of lines that touch nothing" },
  };
  const bench_program program
      = { "contact", "Measure the moving line among obstacles", options, 3 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run (steps, (uint64_t)seed, (int)rounds) : status;
}
