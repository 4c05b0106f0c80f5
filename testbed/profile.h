/* The counters of a dive, as a value.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_PROFILE_H
#define BT_TESTBED_PROFILE_H

#include <bight/bight.h>

static inline bt_profile
profile_of (const bt_dive *dive)
{
  bt_profile p;
  bt_dive_profile (dive, &p);
  return p;
}

#endif
