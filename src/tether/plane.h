/* The checks of numbers common to all plane problems of <bight/statics.h>, and their taut limit.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_PLANE_H
#define BT_TETHER_PLANE_H

#include <math.h>

#include "base/error.h"

/* Sizes beyond these would overflow or vanish when squared twice.  No sea holds them.  */
#define BT__PLANE_HUGE 1e30
#define BT__PLANE_TINY 1e-30

/* Below this share of the length the distance across the load counts as nothing.  */
#define BT__PLANE_VERTICAL 1e-100

/* Explain what is wrong with the ends (0, 0), (H, V) and the length S.  */
bt_status bt__plane_refuse (double h, double v, double s, bt_error *error);

/* Return BT_OK if H, V, S pose a plane problem, else BT_ERR_DOMAIN.  NaN fails every comparison. */
static inline bt_status
bt__plane_check (double h, double v, double s, bt_error *error)
{
  int good = h >= 0 && h <= BT__PLANE_HUGE && fabs (v) <= BT__PLANE_HUGE && s >= BT__PLANE_TINY
             && s <= BT__PLANE_HUGE;
  return good ? BT_OK : bt__plane_refuse (h, v, s, error);
}

/* Return S^2 - H^2 - V^2, accurate to about 1e-32 of S^2: positive for a slack line of length S,
   zero or negative for a taut one.  */
double bt__plane_excess (double h, double v, double s);

#endif
