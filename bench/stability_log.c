/* The budget of a campaign and its summary: see stability.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <signal.h>
#include <string.h>
#include <time.h>

#include "stability.h"

static double
wall (void)
{
  struct timespec t;
  clock_gettime (CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void
stability_begin (stability_log *l, const stability_plan *plan, const char *unit,
                 const char *const *names, int kinds, const char *worst_name)
{
  *l = (stability_log){ .plan = plan,
                        .unit = unit,
                        .fault_names = names,
                        .kinds = kinds,
                        .worst_name = worst_name,
                        .next = plan->one >= 0 ? plan->one : plan->shard - 1,
                        .began = wall () };
}

static volatile sig_atomic_t stopped;

static void
stop (int signal)
{
  (void)signal;
  stopped = 1;
}

void
stability_stoppable (void)
{
  signal (SIGINT, stop);
  signal (SIGTERM, stop);
}

long
stability_next (stability_log *l)
{
  const stability_plan *p = l->plan;
  long number = l->next;
  if (stopped)
    return -1;
  if (p->one >= 0 ? l->cases > 0
                  : (p->hours > 0 ? wall () - l->began >= 3600 * p->hours : l->steps >= p->steps))
    return -1;
  l->next += p->shards;
  l->cases++;
  return number;
}

void
stability_fault (stability_log *l, long number, int kind)
{
  l->faults[kind]++;
  fprintf (stderr,
           "bight-bench-stability: %s case %ld: %s; again with --family %s --seed %ld --case %ld\n",
           l->plan->family, number, l->fault_names[kind], l->plan->family, l->plan->seed, number);
}

static FILE *
open_in (const stability_log *l, const char *name)
{
  char path[1024];
  if (!l->plan->folder)
    return NULL;
  snprintf (path, sizeof path, "%s/%s", l->plan->folder, name);
  return fopen (path, "w");
}

FILE *
stability_file (const stability_log *l, const char *name, long number)
{
  char file[128];
  snprintf (file, sizeof file, "%s-%ld-%ld.txt", name, l->plan->seed, number);
  return open_in (l, file);
}

static long
faults_of (const stability_log *l)
{
  long sum = 0;
  for (int k = 0; k < l->kinds; k++)
    sum += l->faults[k];
  return sum;
}

/* What is asked of the family in the long run.  */
static double
goal (const stability_log *l)
{
  return strcmp (l->plan->family, "statics") == 0 ? 1e8 : 1e7;
}

static void
write_text (const stability_log *l, FILE *f, double hours, double each)
{
  const stability_plan *p = l->plan;
  fprintf (f, "%s, seed %ld, shard %d of %d: %ld cases, %ld %s in %.3f hours", p->family, p->seed,
           p->shard, p->shards, l->cases, l->steps, l->unit, hours);
  fprintf (f, " (%.3g us of CPU each; %.0e would take %.2g hours on one core)\n", 1e6 * each,
           goal (l), goal (l) * each / 3600);
  for (int k = 0; k < l->kinds; k++)
    fprintf (f, "  %s: %ld\n", l->fault_names[k], l->faults[k]);
  if (l->solves)
    fprintf (f, "  solves: %.3f each; not solved to tolerance: %ld (%.4f %%), for %.3g s at most\n",
             (double)l->solves / (double)l->steps, l->unsolved,
             100 * (double)l->unsolved / (double)l->steps, l->unsolved_for);
  fprintf (f, "  %s: %.4g\n", l->worst_name, l->worst);
}

static void
write_json (const stability_log *l, FILE *f, double hours, double each)
{
  const stability_plan *p = l->plan;
  fprintf (f, "{\"format\": \"bight-stability 1\", \"family\": \"%s\", \"seed\": %ld,\n", p->family,
           p->seed);
  fprintf (f, " \"shard\": %d, \"shards\": %d, \"hours\": %.6g, \"cpu_hours\": %.6g,\n", p->shard,
           p->shards, hours, l->cpu / 3600);
  fprintf (f, " \"cases\": %ld, \"%s\": %ld, \"solves\": %ld, \"unsolved\": %ld,\n", l->cases,
           l->unit, l->steps, l->solves, l->unsolved);
  fprintf (f, " \"longest_unsolved_s\": %.6g, \"cpu_us_each\": %.6g, \"hours_for_%.0e\": %.6g,\n",
           l->unsolved_for, 1e6 * each, goal (l), goal (l) * each / 3600);
  fprintf (f, " \"worst\": {\"%s\": %.6g},\n \"faults\": {", l->worst_name, l->worst);
  for (int k = 0; k < l->kinds; k++)
    fprintf (f, "%s\"%s\": %ld", k ? ", " : "", l->fault_names[k], l->faults[k]);
  fputs ("}}\n", f);
}

FILE *
stability_open (const stability_log *l, const char *name, const char *kind)
{
  char file[256];
  snprintf (file, sizeof file, "%s.%s", name, kind);
  return open_in (l, file);
}

static int
write_both (const stability_log *l, double hours, double each)
{
  char name[64];
  int good = 1;
  for (int json = 0; json < 2 && l->plan->folder; json++)
    {
      snprintf (name, sizeof name, "%s-%ld-%dof%d.%s", l->plan->family, l->plan->seed,
                l->plan->shard, l->plan->shards, json ? "json" : "txt");
      FILE *f = open_in (l, name);
      if (f)
        (json ? write_json : write_text) (l, f, hours, each);
      good &= f && fclose (f) == 0;
    }
  return good;
}

int
stability_end (stability_log *l, bench_table *table)
{
  char setting[64], counters[160];
  double hours = (wall () - l->began) / 3600, each = l->steps ? l->cpu / (double)l->steps : 0;
  snprintf (setting, sizeof setting, "seed %ld, shard %d of %d", l->plan->seed, l->plan->shard,
            l->plan->shards);
  snprintf (counters, sizeof counters, "cases=%ld;%s=%ld;hours=%.4g;hours_for_%.0e=%.3g", l->cases,
            l->unit, l->steps, hours, goal (l), goal (l) * each / 3600);
  bench_put (table, &(bench_row){ "campaign", l->plan->family, setting, "faults",
                                  (double)faults_of (l), "none asked", 0, each, counters });
  bench_put (table, &(bench_row){ "campaign", l->plan->family, setting, l->worst_name, l->worst,
                                  NULL, 0, each, counters });
  return write_both (l, hours, each);
}
