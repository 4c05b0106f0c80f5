/* See order.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "sim/ops.h"
#include "testbed/order.h"

bt_status
order_drive_copy (bt_dive *dive, const double *sticks, bt_error *error)
{
  memset (dive->alike, 0, BT__STORES + (size_t)dive->model->n_tethers);
  return bt__operate_on_copy (dive, BT_OP_DRIVE, 0, sticks, 4, error);
}
