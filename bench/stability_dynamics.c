/* Campaigns of the moving line: lines of any kind (2 to 2000 nodes, as many in every octave, EA 1e3
   to 1e9 N, EI 0 to 1e3 N m2, damping 0 to 200 N s) flown in random steps (1/1000 to 0.1 s, even or
   jittered), see campaign.h.  Rows by kind, by nodes, and maps of the mean linear solves of a step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/calibration.h"
#include "testbed/campaign.h"
#include "stability_tell.h"

static bench_table *table;

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

/* Add what came of the flight of C, *T, to all it belongs to.  */
static void
enter (survey *s, const campaign *c, const campaign_tally *t)
{
  const campaign_flight *f = &c->flight;
  int n = class_of (f->nodes, node_edges, NODE_CLASSES);
  campaign_add (s->kind + f->kind, t);
  campaign_add (s->nodes[f->kind] + n, t);
  if (f->kind == CAMPAIGN_VACUO)
    {
      int k = 2 * (f->line.ei > 0) + f->jittered;
      campaign_add (s->vacuo + k, t);
      s->gaining[k] += t->gained;
      return;
    }
  campaign_add (s->stiffness[n] + class_of (f->line.ea, ea_edges, EA_CLASSES), t);
  campaign_add (s->bending[class_of (f->step, step_edges, STEP_CLASSES)]
                    + class_of (f->line.ei, ei_edges, EI_CLASSES),
                t);
}

static void
survey_clear (survey *s)
{
  *s = (survey){ .gaining = { 0 } };
  clear (s->kind, CAMPAIGN_KINDS);
  clear (s->nodes[0], CAMPAIGN_KINDS * NODE_CLASSES);
  clear (s->stiffness[0], NODE_CLASSES * EA_CLASSES);
  clear (s->bending[0], STEP_CLASSES * EI_CLASSES);
  clear (s->vacuo, 4);
}

/* Of 22 cases 10 are without and 10 with teleports, two without water.  */
static campaign_kind
kind_of (long number)
{
  return number % 22 < 10 ? CAMPAIGN_PLAIN : number % 22 < 20 ? CAMPAIGN_TELEPORTS : CAMPAIGN_VACUO;
}

/* Keep the flight of C, which has FAULT: for --replay, and as a scenario.  */
static void
keep_flight (const stability_log *l, campaign *c, long number, campaign_fault fault)
{
  FILE *file = stability_file (l, "flight", number);
  if (!file)
    return;
  fprintf (stderr, "  again with --replay %s/flight-%ld-%ld.txt\n", l->plan->folder, l->plan->seed,
           number);
  campaign_write (file, &c->flight);
  fclose (file);
  stability_tell_line (l, &c->flight, c->driven, number, fault);
}

static void
fly_cases (stability_log *l, campaign *c, survey *s)
{
  for (long number; (number = stability_next (l)) >= 0;)
    {
      campaign_tally t = campaign_nothing;
      campaign_seed (c, (uint64_t)l->plan->seed, number);
      campaign_fault fault = campaign_fly (c, kind_of (number), &t);
      enter (s, c, &t);
      l->steps += t.steps;
      l->solves += t.solves;
      l->unsolved += t.unsolved;
      l->cpu += t.seconds;
      l->unsolved_for = fmax (l->unsolved_for, t.unsolved_for);
      l->worst = fmax (l->worst, t.ratio);
      if (fault == CAMPAIGN_SOUND)
        continue;
      stability_fault (l, number, (int)fault - 1);
      keep_flight (l, c, number, fault);
    }
}

/* ---- What came of it ---- */

static void
row (const char *name, const char *setting, const char *metric, double value, const char *asked,
     double seconds, const char *counters)
{
  bench_put (table,
             &(bench_row){ name, "dynamic", setting, metric, value, asked, 0, seconds, counters });
}

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
  static const char *const settings[4] = { "limp, even steps", "limp, jittered steps",
                                           "stiff, even steps", "stiff, jittered steps" };
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
      report_kind (campaign_kind_names[k], s->kind + k, asked[k]);
      report_nodes (campaign_kind_names[k], s->nodes[k]);
    }
  report_vacuo (s);
  report_map ("map-solves", s->stiffness[0], "nodes", node_edges, NODE_CLASSES, "EA", ea_edges,
              EA_CLASSES);
  report_map ("map-solves-bending", s->bending[0], "step", step_edges, STEP_CLASSES, "EI", ei_edges,
              EI_CLASSES);
}

int
stability_dynamics (const stability_plan *plan, bench_table *to, stability_log *l)
{
  campaign c;
  survey *s = malloc (sizeof *s);
  int good = campaign_open (&c, 1) && s;
  table = to;
  c.clock = bench_now;
  c.tension = (double)plan->tension;
  if (good)
    {
      survey_clear (s);
      stability_begin (l, plan, "steps", campaign_fault_names + 1, CAMPAIGN_FAULTS - 1,
                       "fastest by what drove it");
      fly_cases (l, &c, s);
      report (s);
    }
  free (s);
  campaign_close (&c);
  return good;
}
