/* The one row format of the benchmarks: what was measured, how wrong it is, what it costs.

   A bench prints rows of CSV under one header.  The error is a number that is better when it is
   smaller, in what the metric says; it is empty where there is none, as is the CPU time of a row
   that costs nothing to speak of.  Every time also stands as a multiple of the calibration kernel
   (calibration.h), which is measured anew beside the rows it serves, so that a machine that changes
   its pace changes both.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_ROW_H
#define BT_BENCH_ROW_H

typedef struct bench_row
{
  const char *name, *model, *setting, *metric;
  double error;          /* NAN: none */
  const char *reference; /* what the error is against; NULL: nothing */
  double uncertainty;    /* of the reference, in what the error is in */
  double seconds;        /* CPU; 0 or NAN: not measured */
  const char *counters;  /* NAME=NUMBER;..., or NULL */
} bench_row;

typedef struct bench_table
{
  double step;        /* s of CPU of a calibration step, when last measured */
  double when;        /* bench_now of it */
  double least, most; /* steps in this run */
} bench_table;

/* Calibrate T and print the header.  */
void bench_open (bench_table *t);

/* Calibrate T without a header, for a summary in words.  */
void bench_calibrate_table (bench_table *t);

/* Print ROW of T.  */
void bench_put (bench_table *t, const bench_row *row);

/* Print the last row, how far the calibration of T strayed in this run, and return the status to
   exit with: failure if not all could be written.  */
int bench_close (bench_table *t);

#endif
