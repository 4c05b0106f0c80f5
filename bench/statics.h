/* What the parts of bight-bench-statics share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_STATICS_H
#define BT_BENCH_STATICS_H

enum
{
  STATICS_ROUNDS = 5, /* of which the median counts */
  STATICS_STEADY_MOST = 1000
};

/* Return the next random number from 0 to 1.  */
double statics_uniform (void);

/* Print a row, as in row.h.  */
void statics_row (const char *name, const char *model, const char *setting, const char *metric,
                  double error, const char *reference, double uncertainty, double seconds,
                  const char *counters);

/* Measure the line in a current on so many cases, at most STATICS_STEADY_MOST.  */
void statics_steady (int cases);

#endif
