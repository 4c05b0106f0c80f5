/* Other programs, run and timed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_CHILD_H
#define BT_BENCH_CHILD_H

typedef struct bench_child
{
  int status;     /* what it exited with; -1: it could not be run, or was killed */
  double seconds; /* CPU of it and of what it waited for */
  double wall;    /* s from its start to its end */
  long memory;    /* bytes: the most it had resident */
  char out[2000];  /* the beginning of its standard output */
} bench_child;

/* Run ARGV, found as the shell finds it, in FOLDER (NULL: here), without input, its errors unseen.
 */
bench_child bench_run (const char *folder, const char *const *argv);

/* The same of bight -c EXPRESSION.  */
bench_child bench_evaluate (const char *folder, const char *expression);

/* Remove FOLDER and the one FILE that may be in it.  */
void bench_remove (const char *folder, const char *file);

#endif
