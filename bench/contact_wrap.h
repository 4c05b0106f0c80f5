/* What a line wound about a drum costs, by the number of contacts and the drum's radius.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_CONTACT_WRAP_H
#define BT_BENCH_CONTACT_WRAP_H

#include "row.h"

/* Put the rows to TABLE, fewer if QUICK.  Zero if a scene could not be made.  */
int contact_wrap (bench_table *table, int quick);

#endif
