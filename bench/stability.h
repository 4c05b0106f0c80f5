/* A campaign: cases of a family, one after another, until a budget of steps or hours is spent; what
   came of them as rows, as text and as JSON.

   Case K with a seed is the same alone, in any shard and beside any others.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_STABILITY_H
#define BT_BENCH_STABILITY_H

#include <stdint.h>
#include <stdio.h>

#include "row.h"

enum
{
  STABILITY_FAULTS = 7
};

typedef struct stability_plan
{
  const char *family;
  long seed, steps;   /* steps: states or steps to be taken, if HOURS is 0 */
  double hours;       /* by the clock on the wall */
  int shard, shards;  /* this one of so many, from 1 */
  long one;           /* the only case, or -1 */
  const char *folder; /* where the summary and reproducers go, or NULL */
  long tension;       /* N: a tighter line is a fault, too; 0: it is not */
  long mutant;        /* nonzero: without the guard, which the judge must notice */
} stability_plan;

/* What a family counts.  */
typedef struct stability_log
{
  const stability_plan *plan;
  const char *unit; /* what STEPS are */
  const char *const *fault_names;
  int kinds; /* of faults */
  long next, cases, steps, solves, unsolved;
  long faults[STABILITY_FAULTS];
  double unsolved_for, worst; /* s; the worst of WORST_NAME */
  const char *worst_name;
  double began, cpu; /* s on the wall; CPU s of the steps alone */
} stability_log;

/* Begin a log of PLAN, of UNITS, with the NAMES of KINDS faults.  */
void stability_begin (stability_log *l, const stability_plan *plan, const char *unit,
                      const char *const *names, int kinds, const char *worst_name);

/* From now on an interrupt, or a request to end, ends a campaign after its case, with its summary.
 */
void stability_stoppable (void);

/* Return the next case, or -1 when the budget is spent.  */
long stability_next (stability_log *l);

/* Case NUMBER has fault KIND: count it and say on standard error how to repeat it.  */
void stability_fault (stability_log *l, long number, int kind);

/* Open NAME-SEED-NUMBER.txt in the folder of L to write to, NULL without one; NAME.KIND.  */
FILE *stability_file (const stability_log *l, const char *name, long number);
FILE *stability_open (const stability_log *l, const char *name, const char *kind);

/* Write the summary of L to its folder, as text and JSON, and return nonzero if that was done; its
   rows go to TABLE.  */
int stability_end (stability_log *l, bench_table *table);

/* Families: each runs its PLAN, puts rows into TABLE and returns the log.  NUMBERs of faults are in
   the log; zero is returned when memory is out.  */
int stability_statics (const stability_plan *plan, bench_table *table, stability_log *l);
int stability_contact (const stability_plan *plan, bench_table *table, stability_log *l);
int stability_dynamics (const stability_plan *plan, bench_table *table, stability_log *l);

/* Tell what a fixed set of cases comes to in this build; with TRAPS end at an invalid operation.
   Return the status to exit with.  */
int stability_agree (int traps);

/* Where the moving line errs: maps, some minutes of them.  */
int stability_maps (bench_table *table);

#endif
