/* The version, from the one place that knows it: configure.ac.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <bight/status.h>

const char *
bt_version (void)
{
  return PACKAGE_VERSION;
}
