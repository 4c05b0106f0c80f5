/* Masses of a body along and about its own axes, inline.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_INERTIA_H
#define BT_VEHICLE_INERTIA_H

#include "math/vec.h"
#include "vehicle/type.h"

/* The papers' six along (first three) and about the own axes.  */
static inline bt_vec3
bt__along_axes (const double *six)
{
  return bt__vec (six[BT__SWAY], six[BT__SURGE], six[BT__HEAVE]);
}

static inline bt_vec3
bt__about (const double *six)
{
  return bt__vec (six[BT__PITCH], six[BT__ROLL], six[BT__YAW]);
}

static inline bt_vec3
bt__times (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline bt_vec3
bt__over (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (a.x / b.x, a.y / b.y, a.z / b.z);
}

/* Mass and moments of inertia, those of the added mass included.  */
static inline bt_vec3
bt__masses (const bt__vehicle_type *t)
{
  return bt__add (bt__vec (t->mass, t->mass, t->mass), bt__along_axes (t->hydro.added));
}

static inline bt_vec3
bt__inertias (const bt__vehicle_type *t)
{
  bt_vec3 own = { t->inertia.y, t->inertia.x, t->inertia.z };
  return bt__add (own, bt__about (t->hydro.added));
}

#endif
