/* bight-bench-stability: campaigns that abuse the engine, as CSV rows on standard output.

   By itself: the moving line, so many random steps, and maps of where it errs; without the maps for
   a budget of hours, or when a summary is kept. Cases are numbered, and each is the same alone: a
   campaign can be cut into shards, and a case that fails repeated by its number.  What fails is
   said on standard error; with --log it is cut down and told as a scenario, and a line by itself as
   a flight that --replay repeats, too.

   --tension and --mutant plant faults, to see what becomes of them.  --agree and --traps run a
   fixed set of cases, for tests/agree.sh.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "testbed/campaign.h"
#include "options.h"
#include "stability.h"

static const struct
{
  const char *name;
  int (*run) (const stability_plan *, bench_table *, stability_log *);
} families[] = {
  { "dynamics", stability_dynamics },
  { "statics", stability_statics },
  { "contact", stability_contact },
};

enum
{
  FAMILIES = sizeof families / sizeof *families
};

static int
complain (const char *what, const char *which)
{
  fprintf (stderr, "bight-bench-stability: %s%s\n", what, which);
  return EXIT_FAILURE;
}

static int
family_of (const char *name)
{
  int k = 0;
  while (k < FAMILIES && strcmp (families[k].name, name) != 0)
    k++;
  return k;
}

/* "I/N" in P; zero if it is none.  */
static int
read_shard (const char *text, stability_plan *p)
{
  char end;
  return sscanf (text, "%d/%d%c", &p->shard, &p->shards, &end) == 2 && p->shards >= 1
         && p->shard >= 1 && p->shard <= p->shards;
}

static int
read_hours (const char *text, stability_plan *p)
{
  char *end;
  p->hours = strtod (text, &end);
  return end != text && *end == '\0' && p->hours > 0 && p->hours < 1e5;
}

/* Fly what FILE holds, and say what came of it.  */
static int
replay (const char *file)
{
  campaign c;
  campaign_tally t;
  FILE *f = fopen (file, "r");
  int good = campaign_open (&c, 1) && f && campaign_read (f, &c.flight);
  campaign_fault fault = good ? campaign_play (&c, &t) : CAMPAIGN_SOUND;
  if (f)
    fclose (f);
  campaign_close (&c);
  if (!good)
    return complain ("no flight can be read from ", file);
  fprintf (fault ? stderr : stdout, "%s, %d nodes, %d steps: %s\n",
           campaign_kind_names[c.flight.kind], c.flight.nodes, c.flight.moves,
           campaign_fault_names[fault]);
  return fault == CAMPAIGN_SOUND ? EXIT_SUCCESS : EXIT_FAILURE;
}

static int
run (const stability_plan *plan, int family, int maps)
{
  bench_table table;
  stability_log l;
  long faults = 0;
  stability_stoppable ();
  bench_open (&table);
  if (!families[family].run (plan, &table, &l))
    return complain ("memory is out, or a scene could not be made", "");
  int written = stability_end (&l, &table);
  for (int k = 0; k < l.kinds; k++)
    faults += l.faults[k];
  if (maps && !stability_maps (&table))
    return complain ("memory is out", "");
  int status = bench_close (&table);
  if (!written)
    return complain ("cannot write to ", plan->folder);
  return faults && (plan->hours > 0 || plan->one >= 0) ? EXIT_FAILURE : status;
}

int
main (int argc, char **argv)
{
  stability_plan plan = { .seed = 1, .steps = 200000, .shard = 1, .shards = 1, .one = -1 };
  long agree = 0, traps = 0;
  const char *hours = NULL, *shard = NULL, *family = "dynamics", *flight = NULL;
  const bench_option options[] = {
    { "steps", &plan.steps, 1, LONG_MAX, 20000, "steps, or states, to be taken" },
    { "seed", &plan.seed, 0, LONG_MAX, 0, "of the cases" },
    { "case", &plan.one, 0, LONG_MAX, 0,
      "one case alone, by its number; all of them when it is -1" },
    { "tension", &plan.tension, 0, LONG_MAX, 0,
      "N: a tighter line is a fault, too; to try what becomes of faults; 0: it is none" },
    { "agree", &agree, 0, 0, 0,
      "run a fixed set of cases and tell what they come to; for builds to be compared by" },
    { "traps", &traps, 0, 0, 0, "the same, and stop at an invalid floating-point operation" },
    { "mutant", &plan.mutant, 0, 0, 0, "fly without the guard, which the judge must notice" },
  };
  const bench_word words[] = {
    { "hours", &hours, "H", "go on for so long, in place of --steps" },
    { "shard", &shard, "I/N", "every N-th case alone, from the I-th on" },
    { "family", &family, "NAME",
      "dynamics, statics or contact, dynamics when left out; bight bench flies worlds, too" },
    { "log", &plan.folder, "DIR", "where a summary, as text and JSON, and what fails go" },
    { "replay", &flight, "FILE", "fly what failed, and was cut down, again" },
  };
  const bench_program program
      = { "stability", "Abuse the engine and map where it labours", options, 7 };
  int status = bench_options_and_words (&program, words, 5, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  if (agree || traps)
    return stability_agree ((int)traps);
  int k = family_of (family);
  if (k == FAMILIES)
    return complain ("a family is dynamics, statics or contact, not ", family);
  if (hours && !read_hours (hours, &plan))
    return complain ("--hours takes a number above 0, not ", hours);
  if (shard && !read_shard (shard, &plan))
    return complain ("--shard takes I/N, I from 1 to N, not ", shard);
  plan.family = families[k].name;
  if (flight)
    return replay (flight);
  return run (&plan, k, k == 0 && !hours && !plan.folder && plan.one < 0);
}
