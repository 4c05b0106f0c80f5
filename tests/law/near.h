/* Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_NEAR_H
#define BT_LAW_NEAR_H

/* Fail unless IS, called WHAT, is WANTED within TOLERANCE.  */
static inline void
near (const char *what, double is, double wanted, double tolerance)
{
  if (!(fabs (is - wanted) <= tolerance))
    fail_msg ("%s is %.17g, not %.17g within %g", what, is, wanted, tolerance);
}

#endif
