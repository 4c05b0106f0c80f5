/* Errors as values: the words for them and how one is filled.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdarg.h>
#include <stdio.h>

#include "base/error.h"

const char *
bt_status_name (bt_status status)
{
  static const char *const names[]
      = { "ok",       "domain", "name",   "stale",   "def",         "limit",
          "diverged", "io",     "format", "version", "unsupported", "interrupted" };
  unsigned i = (unsigned)status;
  return i < sizeof names / sizeof *names ? names[i] : "unknown";
}

bt_status
bt__fail (bt_error *error, bt_status status, const char *format, ...)
{
  if (error)
    {
      va_list args;
      va_start (args, format);
      error->status = status;
      vsnprintf (error->text, sizeof error->text, format, args);
      va_end (args);
    }
  return status;
}
