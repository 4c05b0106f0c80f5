/* What every plane problem of <bight/statics.h> asks of its numbers, and the taut limit they share.

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

/* Return S^2 - H^2 - V^2, right to about 1e-32 of S^2: its sign says whether a line of length S is
   taut, and its size how far from it.  */
double bt__plane_excess (double h, double v, double s);

#endif
