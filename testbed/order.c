/* See order.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "sim/around.h"
#include "sim/ops.h"
#include "testbed/order.h"

bt_status
order_drive_copy (bt_dive *dive, const double *sticks, bt_error *error)
{
  memset (dive->alike, 0, BT__STORES + (size_t)dive->model->n_tethers);
  bt__call c = { dive, bt__dive_begin (dive), 0, sticks, 4, error };
  bt_status status = bt__op_drive (&c);
  if (status != BT_OK)
    return status;
  if (bt__has_obstacles (dive))
    {
      bt__rest_movers (dive, c.state);
      bt__pin_vehicles (dive, c.state, 0);
    }
  else
    bt__unpin_vehicles (dive, c.state);
  bt__wake_lines (&c);
  status = bt__resolve_tethers (dive, c.state, 0, error);
  if (status == BT_OK)
    bt__dive_commit (dive);
  return status;
}
