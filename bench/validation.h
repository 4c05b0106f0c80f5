/* What the validation page is made of: rows, and curves to be drawn.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_VALIDATION_H
#define BT_BENCH_VALIDATION_H

#include <stdio.h>

#include "row.h"

typedef struct validation
{
  bench_table table;
  const char *model; /* of the rows to come */
  FILE *curves;      /* or NULL */
  int quick;         /* nonzero: fewer settings */
  int done, absent;  /* cases held against their data; left out */
} validation;

/* A row of V.  OWN: what our own steps and intervals are estimated to add, NAN if that is not
   known.  */
void validation_row (validation *v, const char *name, const char *setting, const char *metric,
                     double error, const char *reference, double uncertainty, double own);

/* A row that is not held against anything: what the error would be if something were otherwise.  */
void validation_varied (validation *v, const char *name, const char *setting, const char *metric,
                        double error, const char *reference);

/* A point of LINE among those of case NAME that are drawn together, over AXES: "Y over X".  */
void validation_point (validation *v, const char *name, const char *axes, const char *line,
                       double x, double y);

/* Count case NAME; nonzero if it was flown.  If its FILE is not there it is left out: a row says
   so.  A case that failed is a row with an error without bounds.  */
int validation_counts (validation *v, const char *name, int result, const char *file);

/* A rope in a tank.  */
void validation_tank (validation *v);

/* Jumpers and chains over time.  */
void validation_histories (validation *v);

/* Cables swung in air.  */
void validation_cables (validation *v);

/* The analytic tables.  */
void validation_tables (validation *v);

#endif
