/* bight-bench-stability: where the moving line breaks, labours or errs, as CSV rows on standard
   output.

   Lines of any kind (2 to 2000 nodes, as many in every octave, EA 1e3 to 1e9 N, EI 0 to 1e3 N m2,
   damping 0 to 200 N s) are flown in random steps (1/1000 to 0.1 s, even or jittered), see
   campaign.h: half of the steps without teleports, half with, and a tenth more without water.  The
   column `reference' has what is asked.  Costs are CPU times of a step, by the number of nodes.

   The maps have a row for each cell, its place in the column `setting': mean linear solves of a
   step over the campaign; and the error in position, rms over eleven points and every half second
   of 5 s, of a 100 m line (10 mm, neutral, current .3 m/s, BA 20 N s) whose vehicle sets off at
   once (`map-error', by nodes and EA at 1/60 s, and `map-error-step', by step and EA at 100 nodes)
   or runs it taut (`map-error-taut'), against twice the nodes in half the steps, extrapolated.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"

#include "calibration.h"
#include "campaign.h"

static double calibration;

static void
row (const char *name, const char *setting, const char *metric, double value, const char *asked,
     double seconds, const char *counters)
{
  printf ("%s,dynamic,%s,%s,%.4g,%s,,%.1f,%.4g,%s\n", name, setting, metric, value, asked,
          1e9 * seconds, seconds / calibration, counters);
}

/* ---- Classes of lines ---- */

static const double node_edges[] = { 2, 3, 5, 10, 20, 50, 100, 200, 500, 1000, 2001 };
static const double ea_edges[] = { 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9 };
static const double step_edges[] = { 1e-3, 3e-3, 1e-2, 3e-2, 0.1 };
static const double ei_edges[] = { 0, 1e-3, 1e-2, 0.1, 1, 10, 100, 1e3 };

enum
{
  NODE_CLASSES = sizeof node_edges / sizeof *node_edges - 1,
  EA_CLASSES = sizeof ea_edges / sizeof *ea_edges - 1,
  STEP_CLASSES = sizeof step_edges / sizeof *step_edges - 1,
  EI_CLASSES = sizeof ei_edges / sizeof *ei_edges - 1,
  CLASSES_MAX = 16
};

/* The class of X among COUNT between EDGES.  */
static int
class_of (double x, const double *edges, int count)
{
  int k = 0;
  while (k < count - 1 && x >= edges[k + 1])
    k++;
  return k;
}

typedef struct survey
{
  campaign_tally kind[CAMPAIGN_KINDS];
  campaign_tally nodes[CAMPAIGN_KINDS][NODE_CLASSES];
  campaign_tally stiffness[NODE_CLASSES][EA_CLASSES];
  campaign_tally bending[STEP_CLASSES][EI_CLASSES];
  campaign_tally vacuo[4]; /* by EI > 0, and by jittered steps */
  long gaining[4];
} survey;

static void
clear (campaign_tally *t, int n)
{
  for (int k = 0; k < n; k++)
    t[k] = campaign_nothing;
}

static void
fly_kind (survey *s, campaign *c, campaign_kind kind, long steps)
{
  while (s->kind[kind].steps < steps)
    {
      campaign_tally t = campaign_nothing;
      campaign_fly (c, kind, &t);
      int n = class_of (c->nodes, node_edges, NODE_CLASSES);
      campaign_add (s->kind + kind, &t);
      campaign_add (s->nodes[kind] + n, &t);
      if (kind == CAMPAIGN_VACUO)
        {
          int k = 2 * (c->line.ei > 0) + c->jittered;
          campaign_add (s->vacuo + k, &t);
          s->gaining[k] += t.gain > 1e-9;
          continue;
        }
      campaign_add (s->stiffness[n] + class_of (c->line.ea, ea_edges, EA_CLASSES), &t);
      campaign_add (s->bending[class_of (c->step, step_edges, STEP_CLASSES)]
                        + class_of (c->line.ei, ei_edges, EI_CLASSES),
                    &t);
    }
}

static survey *
fly (campaign *c, long steps)
{
  survey *s = malloc (sizeof *s);
  if (!s)
    return NULL;
  *s = (survey){ .gaining = { 0 } };
  clear (s->kind, CAMPAIGN_KINDS);
  clear (s->nodes[0], CAMPAIGN_KINDS * NODE_CLASSES);
  clear (s->stiffness[0], NODE_CLASSES * EA_CLASSES);
  clear (s->bending[0], STEP_CLASSES * EI_CLASSES);
  clear (s->vacuo, 4);
  fly_kind (s, c, CAMPAIGN_PLAIN, steps / 2);
  fly_kind (s, c, CAMPAIGN_TELEPORTS, steps / 2);
  fly_kind (s, c, CAMPAIGN_VACUO, steps / 10);
  return s;
}

/* ---- What came of it ---- */

static const char *const kind_names[CAMPAIGN_KINDS] = { "plain", "teleports", "vacuo" };

static double
share (long part, long of)
{
  return of > 0 ? (double)part / (double)of : 0;
}

static void
report_kind (const char *name, const campaign_tally *t, const char *asked)
{
  char counters[120];
  snprintf (counters, sizeof counters, "lines=%ld;steps=%ld;solves=%ld;unsolved=%ld", t->lines,
            t->steps, t->solves, t->unsolved);
  row (name, "all", "NaN or refused lines", (double)t->broken, "0", 0, counters);
  row (name, "all", "blown up lines", (double)t->blown, "0", 0, counters);
  row (name, "all", "unsolved share %", 100 * share (t->unsolved, t->steps), asked, 0, counters);
  row (name, "all", "longest unsolved s", t->unsolved_for, "at most 3", 0, counters);
  row (name, "all", "unrecovered lines", (double)t->unrecovered, "0", 0, counters);
  row (name, "all", "fastest m/s", t->fastest, "", 0, counters);
  row (name, "all", "fastest by what drove it", t->ratio, "at most 20", 0, counters);
  row (name, "all", "fastest after 3 s m/s", t->settled, "", 0, counters);
}

static void
report_nodes (const char *name, const campaign_tally *t)
{
  for (int k = 0; k < NODE_CLASSES; k++)
    {
      char setting[48], counters[120];
      double each = t[k].steps ? t[k].seconds / (double)t[k].steps : 0;
      if (t[k].steps == 0)
        continue;
      snprintf (setting, sizeof setting, "nodes %g to %g", node_edges[k], node_edges[k + 1] - 1);
      snprintf (counters, sizeof counters, "lines=%ld;steps=%ld;unsolved=%ld;slowest_us=%.0f",
                t[k].lines, t[k].steps, t[k].unsolved, 1e6 * t[k].slowest);
      row (name, setting, "solves per step", share (t[k].solves, t[k].steps), "", each, counters);
    }
}

static void
report_vacuo (const survey *s)
{
  static const char *const settings[4]
      = { "EI=0, even steps", "EI=0, jittered steps", "EI>0, even steps", "EI>0, jittered steps" };
  for (int k = 0; k < 4; k++)
    {
      char counters[120];
      const campaign_tally *t = s->vacuo + k;
      snprintf (counters, sizeof counters, "lines=%ld;steps=%ld;unsolved=%ld;gaining=%ld", t->lines,
                t->steps, t->unsolved, s->gaining[k]);
      row ("vacuo", settings[k], "energy gained", fmax (t->gain, 0), "0", 0, counters);
    }
}

/* Maps of ROWS by COLUMNS classes, the lower edges of which are their places.  */
static void
report_map (const char *name, const campaign_tally *t, const char *row_name,
            const double *row_edges, int rows, const char *column_name, const double *column_edges,
            int columns)
{
  for (int i = 0; i < rows; i++)
    for (int j = 0; j < columns; j++, t++)
      {
        char setting[64], counters[80];
        if (t->steps == 0)
          continue;
        snprintf (setting, sizeof setting, "%s=%g;%s=%g", row_name, row_edges[i], column_name,
                  column_edges[j]);
        snprintf (counters, sizeof counters, "lines=%ld;steps=%ld;unsolved=%ld", t->lines, t->steps,
                  t->unsolved);
        row (name, setting, "solves per step", share (t->solves, t->steps), "",
             t->seconds / (double)t->steps, counters);
      }
}

static void
report (const survey *s)
{
  static const char *const asked[CAMPAIGN_KINDS] = { "at most 0.15", "at most 0.5", "" };
  for (int k = 0; k < CAMPAIGN_KINDS; k++)
    {
      report_kind (kind_names[k], s->kind + k, asked[k]);
      report_nodes (kind_names[k], s->nodes[k]);
    }
  report_vacuo (s);
  report_map ("map-solves", s->stiffness[0], "nodes", node_edges, NODE_CLASSES, "EA", ea_edges,
              EA_CLASSES);
  report_map ("map-solves-bending", s->bending[0], "step", step_edges, STEP_CLASSES, "EI", ei_edges,
              EI_CLASSES);
}

/* ---- Where it errs ---- */

enum
{
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
  c->line = (bt_tether_props){
    .diameter = 0.01, .mass = 0.0805033117, .ea = ea, .ba = 20, .cdn = 1.2, .cdt = 0.02, .ca = 1
  };
  c->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { bt__vec (-0.2, 0.2, 0.1) } };
  c->water = (bt_water){ 1025, 9.81, 100, 0, &c->current, NULL, NULL, NULL };
  c->in = (bt__dynamic_input){ .line = &c->line, .water = &c->water, .tolerance = 1e-8 };
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
map_error (campaign *c, const char *name, const char *setting, int taut, int n, double ea, int per)
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
  row (name, setting, "rms position m", 4.0 / 3 * sqrt (sum / (SAMPLES * POINTS)), "", each, "");
}

static void
map_errors (campaign *c)
{
  static const int nodes[] = { 3, 6, 11, 21, 51, 101, 201, 501, 1001 };
  static const int rates[] = { 250, 100, 50, 30, 15, 5 }; /* steps in half a second */
  char setting[64];
  for (int taut = 0; taut < 2; taut++)
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++)
      for (int j = 0; j <= EA_CLASSES; j++)
        {
          snprintf (setting, sizeof setting, "nodes=%d;EA=%g", nodes[i], ea_edges[j]);
          map_error (c, taut ? "map-error-taut" : "map-error", setting, taut, nodes[i] - 1,
                     ea_edges[j], 30);
        }
  for (size_t i = 0; i < sizeof rates / sizeof *rates; i++)
    for (int j = 0; j <= EA_CLASSES; j++)
      {
        snprintf (setting, sizeof setting, "step=%.3g;EA=%g", 0.5 / rates[i], ea_edges[j]);
        map_error (c, "map-error-step", setting, 0, 100, ea_edges[j], rates[i]);
      }
}

/* ---- ---- */

static const char usage[]
    = "Usage: bight-bench-stability [OPTION]...\n"
      "Abuse the moving line and map where it labours; rows of CSV on standard output.\n\n"
      "  --steps N  random steps in water, half of them with teleports; otherwise 200000\n"
      "  --seed N   of the random numbers; otherwise 1\n"
      "  --help     this text\n";

static int
run (long steps, long seed)
{
  campaign c;
  if (!campaign_open (&c, (uint64_t)seed))
    return EXIT_FAILURE;
  c.clock = bench_now;
  calibration = bench_calibrate (0.3);
  puts ("case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns,"
        "calibration_ratio,counters");
  survey *s = fly (&c, steps);
  if (s)
    {
      report (s);
      map_errors (&c);
    }
  free (s);
  campaign_close (&c);
  return s ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* The number TEXT in *N; zero when it is not one above zero.  */
static int
number (const char *text, long *n)
{
  char *end;
  *n = strtol (text, &end, 10);
  return end != text && *end == '\0' && *n > 0;
}

int
main (int argc, char **argv)
{
  static const struct option options[] = { { "steps", required_argument, NULL, 'n' },
                                           { "seed", required_argument, NULL, 's' },
                                           { "help", no_argument, NULL, 'h' },
                                           { NULL, 0, NULL, 0 } };
  long steps = 200000, seed = 1;
  int c, good = 1;
  while ((c = getopt_long (argc, argv, "", options, NULL)) != -1)
    switch (c)
      {
      case 'n':
        good &= number (optarg, &steps);
        break;
      case 's':
        good &= number (optarg, &seed);
        break;
      case 'h':
        fputs (usage, stdout);
        return EXIT_SUCCESS;
      default:
        good = 0;
      }
  if (!good)
    {
      fputs (usage, stderr);
      return EXIT_FAILURE;
    }
  return run (steps, seed);
}
