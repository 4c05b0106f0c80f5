/* Data of others, which are not part of the package: in the folder that BIGHT_REFERENCE_DATA names,
   else beside the source tree.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_REFERENCE_H
#define BT_TESTBED_REFERENCE_H

#include <stdio.h>

/* Open FILE, a path within the reference data, to be read; NULL when it is not there.  */
FILE *bench_open_reference (const char *file);

#endif
