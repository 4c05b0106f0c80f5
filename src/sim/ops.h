/* Shared by the files of operations: the call of an operation, and its checks.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_OPS_H
#define BT_SIM_OPS_H

#include "base/error.h"
#include "sim/sim.h"

/* What an operation is given.  */
typedef struct bt__call
{
  bt_dive *dive;
  bt__state *state; /* to change */
  int subject;
  const double *args;
  int n;
  bt_error *error; /* never NULL */
} bt__call;

/* The first three arguments as a point; BT_ERR_DOMAIN unless all three are finite.  */
bt_vec3 bt__point_of (const bt__call *c);
bt_status bt__check_point (const bt__call *c);

/* BT_ERR_DOMAIN unless the I-th argument, called WHAT, lies in [LOW, HIGH].  */
bt_status bt__check_range (const bt__call *c, int i, const char *what, double low, double high);

/* Have every tether solved anew.  */
void bt__mark_all_stale (const bt__call *c);

/* ops_vehicle.c */
bt_status bt__op_drive (const bt__call *c);
bt_status bt__op_release (const bt__call *c);
bt_status bt__op_place (const bt__call *c);
bt_status bt__op_lay (const bt__call *c);
bt_status bt__op_move (const bt__call *c);
bt_status bt__op_fly_to (const bt__call *c);
bt_status bt__op_hold_heading (const bt__call *c);
bt_status bt__op_hold_depth (const bt__call *c);
bt_status bt__op_hold_altitude (const bt__call *c);
bt_status bt__op_hold_position (const bt__call *c);
bt_status bt__op_follow (const bt__call *c);
bt_status bt__op_stabilise (const bt__call *c);
bt_status bt__op_fault (const bt__call *c);

/* ops_tether.c */
bt_status bt__op_pay_out (const bt__call *c);
bt_status bt__op_haul_in (const bt__call *c);
bt_status bt__op_cut (const bt__call *c);

/* ops_sea.c */
bt_status bt__op_current (const bt__call *c);
bt_status bt__op_waves (const bt__call *c);
bt_status bt__op_drift (const bt__call *c);

/* ops_collide.c */
bt_status bt__op_collide (const bt__call *c);

/* ops_alter.c */
bt_status bt__op_alter (const bt__call *c);

/* Do WHICH, whose arguments were checked as far as their number goes, on a copy of the state of
   DIVE, which becomes the present if all of it is solved.  */
bt_status bt__operate_on_copy (bt_dive *dive, bt_op which, int subject, const double *args, int n,
                               bt_error *error);

/* Give the order WHICH of the call C, which APPLY writes after its last check: to the present state
   where all tethers rest, else on a copy (rest.c).  */
bt_status bt__give_order (const bt__call *c, bt_op which, bt_status (*apply) (const bt__call *c));

/* Wake the lines made fast to the vehicle of the operation (ops.c).  */
void bt__wake_lines (const bt__call *c);

#endif
