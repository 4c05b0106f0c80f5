/* Filling a bt_error.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_ERROR_H
#define BT_BASE_ERROR_H

#include <bight/status.h>

#if defined __GNUC__
#define BT__PRINTF(m, n) __attribute__ ((format (printf, m, n)))
#else
#define BT__PRINTF(m, n)
#endif

/* Fill *ERROR (may be NULL) with STATUS and the formatted sentence, cut at the capacity of ERROR,
   and return STATUS: a function can fail in a line.  */
bt_status bt__fail (bt_error *error, bt_status status, const char *format, ...) BT__PRINTF (3, 4);

#endif
