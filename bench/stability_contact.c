/* Campaigns among obstacles: see stability_flight.h.  Every other case is of a pilot, in the four
   scenes by turns; the others mean harm.  Rows by scene and by harm.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "stability_tell.h"

typedef struct survey
{
  flight_tally kind[FLIGHT_KINDS], harm[HARMS];
} survey;

static const flight_tally nothing = { .nearest = HUGE_VAL };

/* ---- Rows ---- */

static double
share (long part, long whole)
{
  return (double)part / fmax ((double)whole, 1);
}

static void
report_tally (bench_table *table, const char *name, const flight_tally *t, double cut,
              double unsolved)
{
  char counters[240], asked[32];
  long through = t->faults[FLIGHT_CROSSING] + t->faults[FLIGHT_TOO_NEAR];
  double each = t->seconds / fmax ((double)t->steps, 1);
  snprintf (
      counters, sizeof counters,
      "flights=%ld;jammed=%ld;steps=%ld;refused=%ld;not_finite=%ld;nearest=%.7g cores;solves=%.2f;"
      "touches=%.1f;fastest=%.3g m/s;tension=%.3g N;unsolved_for=%.2g s",
      t->flights, t->jammed, t->steps, t->faults[FLIGHT_REFUSED], t->faults[FLIGHT_NOT_FINITE],
      t->nearest, share (t->solves, t->steps), share (t->touches, t->steps), t->fastest, t->tension,
      t->unsolved_for);
  bench_put (table, &(bench_row){ "contact", "dynamic", name, "crossings or too near",
                                  (double)through, "outside judge, asked: 0", 0, each, counters });
  snprintf (asked, sizeof asked, "asked: %g", cut);
  bench_put (table,
             &(bench_row){ "contact", "dynamic", name, "share of steps cut by the guard",
                           share (t->truncated, t->steps), cut < 1 ? asked : NULL, 0, 0, NULL });
  snprintf (asked, sizeof asked, "asked: %g", unsolved);
  bench_put (table, &(bench_row){ "contact", "dynamic", name, "share of steps not solved",
                                  share (t->unsolved, t->steps), unsolved < 1 ? asked : NULL, 0, 0,
                                  NULL });
}

static void
report (bench_table *table, const survey *s)
{
  char name[64];
  for (int k = 0; k < FLIGHT_HARM; k++)
    if (s->kind[k].flights)
      report_tally (table, flight_kind_names[k], s->kind + k, 1e-4,
                    k == FLIGHT_CANYON ? 1.5e-2 : 1e-3);
  for (int k = 0; k < HARMS; k++)
    if (s->harm[k].flights)
      {
        snprintf (name, sizeof name, "harm: %s", flight_harm_names[k]);
        report_tally (table, name, s->harm + k, 1, 1);
      }
}

/* ---- Cases ---- */

/* Add what came of F to what it belongs to.  */
static void
enter (survey *s, stability_log *l, const flight *f, const flight_tally *t)
{
  flight_add (s->kind + f->kind, t);
  if (f->kind == FLIGHT_HARM)
    flight_add (s->harm + f->harm, t);
  l->steps += t->steps;
  l->cpu += t->seconds;
  if (f->kind != FLIGHT_HARM)
    {
      l->solves += t->solves;
      l->unsolved += t->unsolved;
      l->unsolved_for = fmax (l->unsolved_for, t->unsolved_for);
      l->worst = fmax (l->worst, t->fastest);
    }
}

int
stability_contact (const stability_plan *plan, bench_table *table, stability_log *l)
{
  static flight f;
  survey s;
  const flight_rules rules = { plan->tension > 0 ? plan->tension : INFINITY, plan->mutant };
  for (int k = 0; k < FLIGHT_KINDS; k++)
    s.kind[k] = nothing;
  for (int k = 0; k < HARMS; k++)
    s.harm[k] = nothing;
  stability_begin (l, plan, "steps", flight_fault_names, FLIGHT_FAULTS, "fastest m/s");
  for (long number; (number = stability_next (l)) >= 0;)
    {
      flight_tally t;
      flight_draw (&f, (uint64_t)plan->seed, number);
      int fault = flight_play (&f, &rules, &t);
      if (fault < 0)
        return 0;
      enter (&s, l, &f, &t);
      for (int k = 0; k < FLIGHT_FAULTS; k++)
        if (t.faults[k])
          stability_fault (l, number, k);
      if (fault != FLIGHT_SOUND && plan->folder)
        stability_tell_flight (l, &f, number, fault);
    }
  report (table, &s);
  return 1;
}
