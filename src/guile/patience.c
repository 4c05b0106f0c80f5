/* Long calls: Between pieces of work the asyncs of the thread are run, ^C among them, and Scheme is
   told the progress.

   No exception jumps over frames of the engine: an exception thrown by an async is kept, the engine
   gives up, and the returning call throws the exception.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <time.h>

#include "guile/guile.h"

#define EVERY 0.02 /* s */

/* Holds the procedure that is told, or #f.  */
static SCM reporter;

/* Time is asked for thousands of times a second.  The coarse clock is a look into memory, and right
   to some milliseconds.  */
#ifdef CLOCK_MONOTONIC_COARSE
#define CLOCK CLOCK_MONOTONIC_COARSE
#else
#define CLOCK CLOCK_MONOTONIC
#endif

static double
seconds (void)
{
  struct timespec t;
  clock_gettime (CLOCK, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void
report (SCM share)
{
  SCM procedure = scm_variable_ref (reporter);
  if (scm_is_true (procedure))
    scm_call_1 (procedure, share);
}

static SCM
let_in (void *share)
{
  SCM_TICK;
  report (scm_from_double (*(double *)share));
  return SCM_BOOL_F;
}

static SCM
keep (void *handle, SCM key, SCM args)
{
  ((bt__handle *)handle)->thrown = scm_cons (key, args);
  return SCM_BOOL_F;
}

int
bt__ask_guile (void *user, double share)
{
  bt__handle *handle = user;
  int asking = handle->asking;
  double now = seconds ();
  if (now - handle->looked < EVERY)
    return 0;
  handle->looked = now;
  handle->told = 1;
  handle->asking = 1;
  scm_internal_catch (SCM_BOOL_T, let_in, &share, keep, handle);
  handle->asking = asking;
  return scm_is_true (handle->thrown);
}

void
bt__check_long (const char *who, bt__handle *handle, bt_status status, const bt_error *error)
{
  SCM thrown = handle->thrown;
  handle->thrown = SCM_BOOL_F;
  if (handle->told)
    {
      handle->told = 0;
      report (SCM_BOOL_F);
    }
  if (status == BT_ERR_INTERRUPTED && scm_is_true (thrown))
    scm_throw (SCM_CAR (thrown), SCM_CDR (thrown));
  bt__check (who, status, error);
}

static SCM
set_reporter (SCM procedure)
{
  scm_variable_set_x (reporter, procedure);
  return SCM_UNSPECIFIED;
}

void
bt__define_patience (void)
{
  static const bt__procedure table[] = {
    { "%set-reporter!", 1, 0, (scm_t_subr)set_reporter,
      "Let calls that last tell PROCEDURE which share of their work is done, and at the end #f." },
  };
  reporter = scm_permanent_object (scm_make_variable (SCM_BOOL_F));
  bt__define_procedures (table, sizeof table / sizeof *table);
}
