/* bight-bench-accuracy: the error of a line of model `auto' against what was asked and against its
   own estimate, as CSV rows on standard output.

   Random flights are flown three times from the same begin: by a line of model `auto' to an
   accuracy drawn with the flight, by a line of model `dynamic' with FINE equal intervals, the
   reference, and by one with half as many.  A reference of half as many intervals was itself off by
   as much as lines in a current are, and made a third of their estimates look too large.  Once a
   second all are told at SCENE_PLACES places; the greatest distance from the reference is the true
   error of that look.  A look is left out where the two lines of model `dynamic' are farther apart
   than KNOWN of what was asked: in still water a slack line goes where chance has it.  The kinds of
   flights differ in what the vehicle does: it flies about within the reach of a slack line, in
   still water, in a current, or in a current and a wind sea whose waves reach the line; it runs the
   line taut and turns back, again and again; or it stands while the winch pays out and hauls in.

   For each kind three shares of looks are given: with a true error above what was asked; with one
   above twice that; and with an estimate that is off from the true error by a factor beyond 3.  An
   estimate and a true error that are both below NOTHING of what was asked agree.

   With --alone the same kinds of flights are flown without a reference, by lines of more kinds, for
   so many steps: how many were not solved, and how many looks found a line nowhere.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"
#include "options.h"
#include "row.h"
#include "testbed/calibration.h"
#include "testbed/scene.h"

enum
{
  FINE = 400,
  NODES = 200, /* that the line is laid for, of which it may have four times as many */
  LOOK = 60,   /* steps */
  LOOKS = 40,  /* of a flight */
  DIVES = 3,   /* the line, the reference, half of that */
  LEG = 4,     /* looks for which sticks stay */
  FLIGHTS = 2000
};

#define NOTHING 0.05
#define KNOWN 0.3

typedef enum kind
{
  STILL,
  CURRENT,
  TAUT,
  WINCH,
  WAVES,
  KINDS
} kind;

static const char *const names[KINDS] = { "flights, still water", "flights, current",
                                          "flights, taut", "flights, winch", "flights, waves" };

/* What was found in the looks of a kind of flights.  */
typedef struct found
{
  int looks, above, twice, off, under, unknown;
  double share[FLIGHTS * LOOKS]; /* of the true error in what was asked */
  double seconds;                /* of a step of model `auto' */
} found;

/* ---- Flights ---- */

static double
lot (uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* Draw the world of flight SEED of a kind; return the accuracy asked for.  */
static double
draw (scene *s, kind what, uint64_t *seed)
{
  double length = lot (seed, 10, 60), way = length * lot (seed, 0.4, 0.9),
         bearing = lot (seed, 0, 6.28);
  scene_clear (s);
  if (what != STILL)
    scene_current (s, bt__vec (lot (seed, -0.3, 0.3), lot (seed, -0.3, 0.3), 0));
  scene_vehicle (s, bt__vec (0.9 * way * cos (bearing), 0.9 * way * sin (bearing), -5 - 0.4 * way));
  bt_tether_def *line = scene_line (s, bt__vec (0, 0, -5), length, NODES);
  line->props.wet_weight = lot (seed, 0, 1) < 0.3 ? 0 : lot (seed, -0.05, 0.4);
  line->props.diameter = lot (seed, 0.006, 0.02);
  line->props.ea = pow (10, lot (seed, 4, 6));
  if (what == WAVES)
    {
      scene_waves (s);
      bt_wave_def *w = &s->world.sea.waves;
      w->height = lot (seed, 0.3, 2);
      w->period = lot (seed, 4, 9);
      w->seed = (uint64_t)lot (seed, 1, 1000);
    }
  return pow (10, lot (seed, -2, -1));
}

/* The sticks of a leg: about, or straight away and back.  */
static bt_sticks
steer (kind what, int leg, uint64_t *seed)
{
  double fast = what == TAUT ? 0.9 : 0.3;
  bt_sticks s = { lot (seed, -fast, fast), lot (seed, -fast, fast), lot (seed, -0.1, 0.1),
                  lot (seed, -0.3, 0.3) };
  if (what == TAUT)
    s.surge = leg % 4 < 2 ? fast : -fast;
  if (what == WINCH)
    s = (bt_sticks){ 0 };
  return s;
}

static void
fly_leg (bt_dive *dive, kind what, int leg, uint64_t *seed, double length)
{
  bt_error error;
  bt_sticks sticks = steer (what, leg, seed);
  double rate = lot (seed, 0.05, 0.4);
  scene_must (bt_vehicle_drive (dive, 0, &sticks, &error), &error);
  if (what == WINCH && leg % 2 == 0)
    scene_must (bt_tether_pay_out (dive, 0, &(bt_spooling){ 0.5 * length, rate }, &error), &error);
  else if (what == WINCH)
    scene_must (bt_tether_haul_in (dive, 0, &(bt_spooling){ 0.5 * length, rate }, &error), &error);
}

/* ---- Looks ---- */

static void
note (found *f, double off, double estimate, double asked)
{
  int tiny = off < NOTHING * asked && estimate < NOTHING * asked;
  f->share[f->looks++] = off / asked;
  f->above += off > asked;
  f->twice += off > 2 * asked;
  f->under += !tiny && off > 3 * estimate;
  f->off += !tiny && (estimate > 3 * off || off > 3 * estimate);
}

static void
fly (found *f, kind what, uint64_t first)
{
  static scene s;
  bt_error error;
  uint64_t seed[DIVES] = { first, first, first };
  bt_dive *dive[DIVES];
  double asked = 0;
  for (int d = 0; d < DIVES; d++)
    {
      asked = draw (&s, what, &seed[d]);
      s.tether[0].props.model = d ? BT_MODEL_DYNAMIC : BT_MODEL_AUTO;
      s.tether[0].props.accuracy = asked;
      s.tether[0].props.nodes = d == 0 ? NODES : d == 1 ? FINE : FINE / 2;
      dive[d] = scene_begin (&s.world);
    }
  for (int k = 0; k < LOOKS; k++)
    {
      double estimate;
      for (int d = 0; d < DIVES; d++)
        {
          if (k % LEG == 0)
            fly_leg (dive[d], what, k / LEG, &seed[d], s.tether[0].length);
          f->seconds += (d ? 0 : LOOK) * scene_run (dive[d], LOOK);
        }
      scene_must (bt_tether_error_estimate (dive[0], 0, &estimate, &error), &error);
      if (scene_apart (dive[1], dive[2]) > KNOWN * asked)
        f->unknown++;
      else
        note (f, scene_apart (dive[0], dive[1]), estimate, asked);
    }
  for (int d = 0; d < DIVES; d++)
    bt_dive_free (dive[d]);
}

/* ---- Rows ---- */

static int
by_size (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void
put (bench_table *t, kind what, found *f)
{
  static const char *const metrics[]
      = { "share of looks above what was asked", "share of looks above twice that",
          "share of estimates off by more than 3" };
  const int counts[] = { f->above, f->twice, f->off };
  char counters[120];
  if (f->looks == 0)
    return;
  qsort (f->share, (size_t)f->looks, sizeof *f->share, by_size);
  snprintf (counters, sizeof counters,
            "looks=%d;unknown=%d;under=%d;p50=%.3g;p95=%.3g;p99=%.3g;most=%.3g", f->looks,
            f->unknown, f->under, f->share[f->looks / 2], f->share[f->looks * 95 / 100],
            f->share[f->looks * 99 / 100], f->share[f->looks - 1]);
  for (int m = 0; m < 3; m++)
    bench_put (t, &(bench_row){ names[what], "auto", "accuracy 1 cm to 10 cm", metrics[m],
                                (double)counts[m] / f->looks, "dynamic, 400 intervals", 0,
                                f->seconds / (LOOK * (f->looks + f->unknown)), counters });
}

/* ---- Alone ---- */

/* What so many steps of lines that are flown alone came to.  */
typedef struct endured
{
  uint64_t steps, unsolved, parts, ahead, faults;
} endured;

/* True if a point of the line is not finite, or farther from the anchor than twice its length.  */
static int
is_nowhere (const bt_dive *dive, double length)
{
  bt_vec3 p[SCENE_PLACES];
  bt_error error;
  int any = 0;
  scene_must (bt_tether_points (dive, 0, SCENE_PLACES, p, &error), &error);
  for (int k = 0; k < SCENE_PLACES; k++)
    any |= !(bt__distance (p[k], p[0]) < 2 * length);
  return any;
}

/* Fly a line of any stiffness through flight SEED of a kind; add to *E what came of it.  */
static void
fly_alone (endured *e, kind what, uint64_t seed)
{
  static scene s;
  bt_profile did;
  double asked = draw (&s, what, &seed);
  bt_tether_props *props = &s.tether[0].props;
  props->model = BT_MODEL_AUTO;
  props->accuracy = asked;
  props->ea = pow (10, lot (&seed, 3, 7.4));
  props->ei = lot (&seed, 0, 1) < 0.5 ? 0 : pow (10, lot (&seed, -3, 1));
  bt_dive *dive = scene_begin (&s.world);
  for (int k = 0; k < LOOKS; k++)
    {
      if (k % LEG == 0)
        fly_leg (dive, what, k / LEG, &seed, s.tether[0].length);
      scene_run (dive, LOOK);
      e->faults += (uint64_t)is_nowhere (dive, 1.5 * s.tether[0].length);
    }
  bt_dive_profile (dive, &did);
  bt_dive_free (dive);
  e->steps += did.steps;
  e->unsolved += did.chain_unconverged;
  e->parts += did.chain_parts;
  e->ahead += did.chain_stretched;
}

static int
run_alone (uint64_t steps, uint64_t first)
{
  endured e = { 0 };
  bench_table table;
  char counters[120];
  bench_open (&table);
  for (uint64_t f = first; e.steps < steps; f++)
    fly_alone (&e, (kind)(f % KINDS), 7919 * f + 13);
  snprintf (counters, sizeof counters, "steps=%.0f;parts=%.0f;ahead=%.0f", (double)e.steps,
            (double)e.parts, (double)e.ahead);
  bench_put (&table, &(bench_row){ "flights alone", "auto", "accuracy 1 cm to 10 cm",
                                   "share of steps that are not solved",
                                   (double)e.unsolved / (double)e.steps, "0", 0, NAN, counters });
  bench_put (&table,
             &(bench_row){ "flights alone", "auto", "accuracy 1 cm to 10 cm",
                           "looks with a line nowhere", (double)e.faults, "0", 0, NAN, counters });
  return bench_close (&table);
}

static int
run (int flights, uint64_t first)
{
  static found f;
  bench_table table;
  bench_open (&table);
  for (int what = 0; what < KINDS; what++)
    {
      f = (found){ 0 };
      for (int k = 0; k < flights; k++)
        fly (&f, (kind)what, (uint64_t)(1000 * what + k) + first);
      put (&table, (kind)what, &f);
    }
  return bench_close (&table);
}

int
main (int argc, char **argv)
{
  long flights = 50, alone = 0, first = 1;
  const bench_option options[]
      = { { "flights", &flights, 1, FLIGHTS, 2, "random flights of each of five kinds" },
          { "alone", &alone, 0, 1000000000, 0,
            "steps to be flown without a reference, in place of the flights" },
          { "first", &first, 1, 1000000000, 0, "number of the first flight" } };
  const bench_program program
      = { "accuracy", "Measure the error of lines against what is asked and estimated", options,
          3 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  return alone > 0 ? run_alone ((uint64_t)alone, (uint64_t)first)
                   : run ((int)flights, (uint64_t)first);
}
