/* The compiled model, as the rooms above see it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MODEL_MODEL_H
#define BT_MODEL_MODEL_H

#include <stdatomic.h>
#include <stdint.h>

#include <bight/model.h>

enum
{
  BT__NOT_A_VEHICLE = -1 /* an end that is a point */
};

/* An end with its name looked up.  */
typedef struct bt__end
{
  bt_vec3 at;
  int vehicle; /* index, or BT__NOT_A_VEHICLE */
} bt__end;

struct bt_model
{
  atomic_int references;
  uint64_t id; /* hash of the content: equal worlds, equal ids */
  bt_sea_def sea;
  int n_vehicles, n_tethers;
  bt_vehicle_def *vehicles;
  bt_tether_def *tethers; /* props complete */
  bt__end (*ends)[2];     /* per tether: anchor, far end */
};

/* The longest chord that LENGTH metres of a tether with PROPS span when pulled with at most PULL
   newtons: the length, and more if it stretches, up to its breaking load or a tenth.  */
double bt__longest_chord (const bt_tether_props *props, double length, double pull);

#endif
