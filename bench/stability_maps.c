/* Where the moving line errs: the error in position, rms over eleven points and every half second
   of 5 s, of a 100 m line (10 mm, neutral, current .3 m/s, BA 20 N s) whose vehicle sets off at
   once
   (`map-error', by nodes and EA at 1/60 s, and `map-error-step', by step and EA at 100 nodes) or
   runs it taut (`map-error-taut'), against twice the nodes in half the steps, extrapolated.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"

#include "testbed/calibration.h"
#include "testbed/campaign.h"
#include "stability.h"

static const double stiffnesses[] = { 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9 };

enum
{
  STIFFNESSES = sizeof stiffnesses / sizeof *stiffnesses,
  SAMPLES = 10, /* half seconds */
  POINTS = 11
};

#define LENGTH 100.0

typedef struct record
{
  bt_vec3 at[SAMPLES][POINTS];
} record;

static bt_vec3
vehicle (int taut, double t)
{
  if (taut)
    return bt__vec (fmin (97 + 1.5 * t, 100.02), 0, 0);
  return bt__vec (90 + 4 * sin (0.3 * t), 3 * sin (0.2 * t), 2 * sin (0.4 * t));
}

/* Step C by H to END; the CPU seconds of it are added to *SPENT.  */
static void
advance (campaign *c, double h, bt_vec3 end, double *spent)
{
  c->in.h = h;
  c->in.end[1].at = end;
  c->water.time += h;
  double start = bench_now ();
  if (bt__dynamic_step (c->d, c->work, &c->in, &c->report, NULL))
    abort ();
  *spent += bench_now () - start;
}

/* Fly a line of EA with N intervals in PER steps each half second.  Return the CPU seconds of a
   step.  */
static double
fly_error (campaign *c, int taut, int n, double ea, int per, record *r)
{
  bt_vec3 to = vehicle (taut, 0), shape[3] = { { 0, 0, 0 }, { to.x / 2 - 10, 22, 12 }, to };
  double h = 0.05, spent = 0;
  c->flight.line = (bt_tether_props){
    .diameter = 0.01, .mass = 0.0805033117, .ea = ea, .ba = 20, .cdn = 1.2, .cdt = 0.02, .ca = 1
  };
  c->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { bt__vec (-0.2, 0.2, 0.1) } };
  c->water = (bt_water){ 1025, 9.81, 100, 0, &c->current, NULL, NULL, NULL };
  c->in = (bt__dynamic_input){ .line = &c->flight.line, .water = &c->water, .tolerance = 1e-8 };
  if (bt__dynamic_init (c->d, CAMPAIGN_NODES, n, shape, 3, LENGTH, ea, NULL))
    abort ();
  for (int i = 0; i < 90; i++) /* the equilibrium in the current */
    {
      advance (c, h, to, &spent);
      bt__dynamic_still (c->d);
      h = c->report.converged ? fmin (1.3 * h, 300) : fmax (h / 4, 0.01);
    }
  c->in.tolerance = 0;
  spent = 0;
  for (int s = 0; s < SAMPLES; s++)
    {
      for (int i = 1; i <= per; i++)
        advance (c, 0.5 / per, vehicle (taut, 0.5 * (s * per + i) / per), &spent);
      for (int p = 0; p < POINTS; p++)
        r->at[s][p] = bt__dynamic_point (c->d, LENGTH * p / (POINTS - 1));
    }
  return spent / (SAMPLES * per);
}

/* One cell: the error is four thirds of the difference to half of everything.  */
static void
map_error (bench_table *table, campaign *c, const char *name, const char *setting, int taut, int n,
           double ea, int per)
{
  static record is, finer;
  double sum = 0, each = fly_error (c, taut, n, ea, per, &is);
  fly_error (c, taut, 2 * n, ea, 2 * per, &finer);
  for (int s = 0; s < SAMPLES; s++)
    for (int p = 0; p < POINTS; p++)
      {
        bt_vec3 d = bt__sub (is.at[s][p], finer.at[s][p]);
        sum += bt__dot (d, d);
      }
  bench_put (table, &(bench_row){ name, "dynamic", setting, "rms position m",
                                  4.0 / 3 * sqrt (sum / (SAMPLES * POINTS)), "half of everything",
                                  0, each, NULL });
}

static void
map_errors (bench_table *table, campaign *c)
{
  static const int nodes[] = { 3, 6, 11, 21, 51, 101, 201, 501, 1001 };
  static const int rates[] = { 250, 100, 50, 30, 15, 5 }; /* steps in half a second */
  char setting[64];
  for (int taut = 0; taut < 2; taut++)
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++)
      for (int j = 0; j < STIFFNESSES; j++)
        {
          snprintf (setting, sizeof setting, "nodes=%d;EA=%g", nodes[i], stiffnesses[j]);
          map_error (table, c, taut ? "map-error-taut" : "map-error", setting, taut, nodes[i] - 1,
                     stiffnesses[j], 30);
        }
  for (size_t i = 0; i < sizeof rates / sizeof *rates; i++)
    for (int j = 0; j < STIFFNESSES; j++)
      {
        snprintf (setting, sizeof setting, "step=%.3g;EA=%g", 0.5 / rates[i], stiffnesses[j]);
        map_error (table, c, "map-error-step", setting, 0, 100, stiffnesses[j], rates[i]);
      }
}

int
stability_maps (bench_table *table)
{
  campaign c;
  int good = campaign_open (&c, 1);
  if (good)
    map_errors (table, &c);
  campaign_close (&c);
  return good;
}
