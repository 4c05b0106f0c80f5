/* Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_RIGID_ENERGY_H
#define BT_ORACLE_RIGID_ENERGY_H

#include "vehicle/inertia.h"

/* The kinetic energy of BODY and the water that goes with it, seen from water that moves at FLOW,
   J.  */
static inline double
rigid_energy (const bt__vehicle_type *type, const bt__rigid *body, bt_vec3 flow)
{
  bt_vec3 v = bt__sub (body->velocity, bt__turn_in (body->attitude, flow));
  bt_vec3 p = bt__times (bt__masses (type), v), l = bt__times (bt__inertias (type), body->spin);
  return (bt__dot (p, v) + bt__dot (l, body->spin)) / 2;
}

#endif
