/* What the laws of contact share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_CONTACT_LAW_H
#define BT_LAW_CONTACT_LAW_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/contact_scene.h"

static const double frame = 1.0 / 60;

static inline int
is_long (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1';
}

static inline void
assert_near (double is, double wanted, double tolerance, const char *what)
{
  if (!(fabs (is - wanted) <= tolerance))
    fail_msg ("%s: %.10g is not %.10g within %.3g", what, is, wanted, tolerance);
}

static inline void
assert_below (double is, double limit, const char *what)
{
  if (!(is < limit))
    fail_msg ("%s: %.10g is not below %.10g", what, is, limit);
}

/* The promise, as an independent judge sees it.  */
static inline void
assert_kept (const rope *p, const char *what)
{
  const bt_vec3 *x = bt__dynamic_x (p->d);
  double clear = reef_clearance (p->reef, x, (int)p->d->n + 1);
  if (p->crossings || p->nan || p->refused || !(clear >= p->config.core))
    fail_msg ("%s: %ld crossings, %ld not finite, %ld refused, clearance %.9g m", what,
              p->crossings, p->nan, p->refused, clear);
}

#endif
