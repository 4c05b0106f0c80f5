/* What fails, told as scenarios: stability_tell.c.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_STABILITY_TELL_H
#define BT_BENCH_STABILITY_TELL_H

#include "testbed/campaign.h"
#include "stability_flight.h"

/* Tell the case NUMBER, the flight F with FAULT, as FAMILY-SEED-NUMBER.scm in the folder of L, its
   meshes beside it.  */
void stability_tell_flight (const stability_log *l, const flight *f, long number, int fault);

/* The same of a line by itself, which DRIVEN m/s can move.  */
void stability_tell_line (const stability_log *l, const campaign_flight *f, double driven,
                          long number, campaign_fault fault);

#endif
