/* An order to a vehicle the long way: as an operation on a copy of the whole state, which is what an
   order written in place (sim/rest.c) is to come to.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_ORDER_H
#define BT_TESTBED_ORDER_H

#include <bight/bight.h>

/* Set the four STICKS of vehicle 0 of DIVE.  */
bt_status order_drive_copy (bt_dive *dive, const double *sticks, bt_error *error);

#endif
