/* Where a process spends time: a clock of CPU time interrupts the process, and notes the running
   function and the callers of the function.

   The sampler is an extension, loaded by the bench alone: without the extension a process pays
   nothing.  The kernel's clock of CPU time (ITIMER_PROF) sends SIGPROF as often as the kernel's
   tick allows; the handler, on the thread that was running, writes return addresses to memory laid
   out before.  A stack ends where code without unwinding tables begins, such as the code made by
   Guile at run time.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/time.h>

#include "guile/guile.h"

enum
{
  MOST = 100000, /* samples */
  DEEP = 24,     /* frames of one */
  OURS = 2,      /* frames that are the handler's and the kernel's, before what was interrupted */
  EVERY = 1000   /* us of CPU time between samples; the kernel's tick may be longer */
};

typedef struct sample
{
  void *frame[DEEP];
  int n;
} sample;

static sample *taken; /* NULL before the first start; kept, since a late signal may yet write */
static atomic_int n_taken;

static void
take_sample (int number)
{
  int i = atomic_fetch_add (&n_taken, 1);
  (void)number;
  if (i < MOST)
    taken[i].n = backtrace (taken[i].frame, DEEP);
}

static void
set_clock (long us)
{
  struct itimerval every = { { 0, us }, { 0, us } };
  setitimer (ITIMER_PROF, &every, NULL);
}

static SCM
start_samples (void)
{
  struct sigaction on = { .sa_handler = take_sample, .sa_flags = SA_RESTART };
  bt_error none = { BT_ERR_LIMIT, "no memory for samples" };
  void *first[1];
  if (!taken && !(taken = calloc (MOST, sizeof *taken)))
    bt__raise ("bench", &none);
  backtrace (first, 1); /* loads the unwinder, which a handler must not */
  atomic_store (&n_taken, 0);
  sigaction (SIGPROF, &on, NULL);
  set_clock (EVERY);
  return SCM_UNSPECIFIED;
}

/* The file of the code at ADDRESS and where in the file, or #f and 0 for code of no file.  */
static SCM
place_of (void *address)
{
  Dl_info info;
  if (!dladdr (address, &info) || !info.dli_fname)
    return scm_cons (SCM_BOOL_F, SCM_INUM0);
  return scm_cons (scm_from_locale_string (info.dli_fname),
                   scm_from_uintptr_t ((uintptr_t)address - (uintptr_t)info.dli_fbase));
}

/* The places of S, what was interrupted first.  The address of a caller is that of the call.  */
static SCM
places_of (const sample *s)
{
  SCM list = SCM_EOL;
  for (int k = s->n; k-- > OURS;)
    list = scm_cons (place_of ((char *)s->frame[k] - (k > OURS)), list);
  return list;
}

static SCM
stop_samples (void)
{
  SCM list = SCM_EOL;
  set_clock (0);
  int n = atomic_load (&n_taken);
  for (int i = n < MOST ? n : MOST; i-- > 0;)
    list = scm_cons (places_of (taken + i), list);
  return list;
}

void bight_sampler_init (void);

__attribute__ ((visibility ("default"))) void
bight_sampler_init (void)
{
  static const bt__procedure table[] = {
    { "%start-samples!", 0, 0, (scm_t_subr)start_samples,
      "From now on note which code is running, as CPU time passes." },
    { "%stop-samples!", 0, 0, (scm_t_subr)stop_samples,
      "Stop that, and return the samples since: of each the places that were running, the callers "
      "after what they called, pairs of a file, or #f, and an address in the file." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
