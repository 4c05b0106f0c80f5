/* Where the data of others are.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "testbed/reference.h"

FILE *
bench_open_reference (const char *file)
{
  char path[1024];
  const char *folder = getenv ("BIGHT_REFERENCE_DATA"), *source = getenv ("top_srcdir");
  if (folder)
    snprintf (path, sizeof path, "%s/%s", folder, file);
  else
    snprintf (path, sizeof path, "%s/../shared/data/%s", source ? source : ".", file);
  return fopen (path, "r");
}
