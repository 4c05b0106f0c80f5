/* What a moving line carries: the vehicle with mass at its far end, its clumps and floats.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "world/lump.h"

/* The vehicle with mass carried by the far end of tether I, or -1.  */
int
bt__carried_vehicle (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  if (vehicle < 0 || !bt__dive_vehicle (dive, state, vehicle)->rigid || bt__pinned (dive, vehicle)
      || bt__carrier (dive, state, vehicle) != i)
    return -1;
  return vehicle;
}

/* The far end of a line that carries VEHICLE: its body, as far as this step is concerned.  */
static bt__dynamic_end
vehicle_end (const bt_dive *dive, int vehicle)
{
  const bt__grip *grip = &dive->driven[vehicle].grip;
  bt__dynamic_end end = { .free = 1, .at = grip->at, .gripped = 1 };
  memcpy (end.stiffness, grip->stiffness, sizeof end.stiffness);
  return end;
}

/* A lump weighs what it has of mass less the water it displaces.  Steel and floats drag as spheres
 * (Cd 0.5) and add half of what they displace.  */
static bt__dynamic_lump
lump_of (const bt_lump *def, double from_end, const bt_water *water)
{
  double rho = water->density, volume = bt__lump_volume (def, water);
  double mass = def->mass > 0 ? def->mass : 0.3 * rho * volume;
  double radius = bt__ball_radius (volume);
  return (bt__dynamic_lump){ .from_end = from_end,
                             .span = def->span,
                             .mass = mass,
                             .added = 0.5 * rho * volume,
                             .wet_weight = (mass - rho * volume) * water->gravity,
                             .quadratic = 0.5 * rho * 0.5 * BT__PI * radius * radius };
}

void
bt__fasten (const bt_dive *dive, int i, double from, double to, bt__dynamic_input *input,
            bt__fastened *fastened)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  bt__dynamic_lump *lumps = fastened->lumps;
  input->lumps = lumps;
  input->n_lumps = 0;
  input->sets = fastened->sets;
  input->n_sets = bt__place_sets (def->sets, (int)def->n_sets, def->length, from, fastened->sets);
  for (int k = 0; k < (int)def->n_lumps; k++)
    {
      double from_end = def->length - def->lumps[k].at;
      if (from_end >= from && from_end < to)
        lumps[input->n_lumps++] = lump_of (&def->lumps[k], from_end - from, input->water);
    }
}

/* Clamp END, end K of tether I, if the tether is clamped there.  A line goes from the winch to the
   far end, and so comes to a clamp there against the direction of the clamp.  */
static void
clamp_end (const bt_dive *dive, bt__state *state, int i, int k, bt__dynamic_end *end)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  bt_vec3 along = dive->model->tethers[i].along[k];
  if (!bt__is_clamped (&dive->model->tethers[i], k))
    return;
  end->clamped = 1;
  end->direction = bt__scale ((k ? -1 : 1) / bt__norm (along), along);
  end->side = bt__set_side (end->direction);
  if (vehicle < 0)
    return;
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt__quat q = bt__quat_of (v->heading, v->pitch, v->roll);
  end->direction = bt__turn_out (q, end->direction);
  end->side = bt__turn_out (q, end->side);
}

bt__dynamic_input
bt__chain_input (const bt_dive *dive, bt__state *state, int i, const bt_water *water,
                 const bt__ends *ends)
{
  int vehicle = bt__carried_vehicle (dive, state, i);
  bt__dynamic_end far = { .at = ends->b };
  bt__dynamic_input input
      = { .line = &bt__dive_tether (dive, state, i)->props,
          .water = water,
          .end = { { .at = ends->a }, vehicle >= 0 ? vehicle_end (dive, vehicle) : far },
          .h = BT__TIME_STEP,
          .surfaced = 1 };
  for (int k = 0; k < 2; k++)
    clamp_end (dive, state, i, k, &input.end[k]);
  return input;
}

/* Let the vehicle that the line carries follow its last node.  */
bt_status
bt__bring_vehicle (const bt_dive *dive, bt__state *state, int i, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, tether->parted ? 1 : 0);
  int vehicle = bt__carried_vehicle (dive, state, i);
  bt_status status;
  if (vehicle < 0)
    {
      bt__note_pull (dive, state, i);
      return BT_OK;
    }
  status = bt__follow_line (dive, state, vehicle, bt__dynamic_x (chain)[chain->n], error);
  tether->shape.b = bt__attachment (dive, state, vehicle);
  return status;
}
