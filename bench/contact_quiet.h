/* Lines that come to rest on what they touch.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_CONTACT_QUIET_H
#define BT_BENCH_CONTACT_QUIET_H

#include "row.h"

/* Put the rows to TABLE, of one rough bed if QUICK, else of 24.  Zero if a scene could not be
   made.  */
int contact_quiet (bench_table *table, int quick);

#endif
