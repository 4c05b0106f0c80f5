/* Changing a live field of a vehicle, a tether or the sea, by its place in the table of fields.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/ops.h"
#include "world/obstacles.h"

static const bt_field *
live_field (const bt__call *c, const char *head_name)
{
  const bt_head *head = bt_head_find (head_name);
  double i = c->args[1];
  const bt_field *field = i >= 0 && i < (double)head->n_fields ? &head->fields[(size_t)i] : NULL;
  if (!field)
    bt__fail (c->error, BT_ERR_NAME, "a %s has no field number %g", head_name, i);
  else if (!field->live)
    bt__fail (c->error, BT_ERR_DOMAIN, "the %s of a %s is fixed while it dives", field->name,
              head_name);
  return field && field->live ? field : NULL;
}

static bt_status
alter_vehicle (const bt__call *c)
{
  bt__vehicle *v;
  bt_vehicle_def def = { 0 };
  const bt_field *field = live_field (c, "rov");
  bt_status status = bt__check_part (c->dive, BT_PART_VEHICLE, c->subject, c->error);
  if (status != BT_OK || !field)
    return status != BT_OK ? status : c->error->status;
  v = bt__dive_vehicle (c->dive, c->state, c->subject);
  def.surge_speed = v->speeds[0];
  def.sway_speed = v->speeds[1];
  def.heave_speed = v->speeds[2];
  def.yaw_rate = v->speeds[3] * (180 / BT__PI);
  def.pull = v->pull;
  def.volts = v->volts;
  status = bt_def_set_number (field, &def, c->args[2], c->error);
  if (status != BT_OK)
    return status;
  v->speeds[0] = def.surge_speed;
  v->speeds[1] = def.sway_speed;
  v->speeds[2] = def.heave_speed;
  v->speeds[3] = def.yaw_rate * (BT__PI / 180);
  v->pull = def.pull;
  v->volts = def.volts;
  return BT_OK;
}

/* Mass and wet weight follow each other and the diameter.  */
static void
forget_follower (const bt_field *field, bt_tether_props *props)
{
  if (strcmp (field->name, "wet-weight") == 0)
    props->mass = NAN;
  else if (strcmp (field->name, "mass") == 0 || strcmp (field->name, "diameter") == 0)
    props->wet_weight = NAN;
}

static bt_status
alter_tether (const bt__call *c)
{
  bt_tether_def def = { 0 };
  bt__tether *tether;
  bt__ends ends;
  const bt_field *field = live_field (c, "tether");
  bt_status status = bt__check_part (c->dive, BT_PART_TETHER, c->subject, c->error);
  if (status != BT_OK || !field)
    return status != BT_OK ? status : c->error->status;
  tether = bt__dive_tether (c->dive, c->state, c->subject);
  def.props = tether->props;
  status = bt_def_set_number (field, &def, c->args[2], c->error);
  if (status != BT_OK)
    return status;
  if (c->dive->model->tethers[c->subject].n_lumps > 0 && def.props.model < BT_MODEL_DYNAMIC)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "the tether has clumps or floats: only `dynamic' and `auto' move it");
  status = bt__bears_bends (&def.props, &c->dive->model->tethers[c->subject], c->error);
  if (status != BT_OK)
    return status;
  forget_follower (field, &def.props);
  bt_tether_props_complete (&def.props, c->state->density, c->state->gravity);
  status = bt__check_mass (&def.props, c->dive->model->tethers[c->subject].name, c->state->density,
                           c->state->gravity, c->error);
  if (status != BT_OK)
    return status;
  ends = bt__tether_ends (c->dive, c->state, c->subject);
  if (!tether->parted
      && bt__distance (ends.a, ends.b)
             > bt__longest_chord (&def.props, tether->length, INFINITY) * (1 + 1e-12))
    return bt__fail (c->error, BT_ERR_DOMAIN, "the tether is stretched, and would not reach so");
  tether->props = def.props;
  tether->stale = 1;
  return BT_OK;
}

/* Every line weighs what its mass does in the new water; BT_ERR_DOMAIN if a line is too light.  */
static bt_status
weigh_anew (const bt__call *c)
{
  bt_status status = BT_OK;
  for (int i = 0; i < c->dive->model->n_tethers && status == BT_OK; i++)
    {
      bt_tether_props *props = &bt__dive_tether (c->dive, c->state, i)->props;
      props->wet_weight = NAN;
      bt_tether_props_complete (props, c->state->density, c->state->gravity);
      status = bt__check_mass (props, c->dive->model->tethers[i].name, c->state->density,
                               c->state->gravity, c->error);
    }
  return status;
}

static bt_status
alter_sea (const bt__call *c)
{
  bt_sea_def def = { .depth = c->state->depth,
                     .density = c->state->density,
                     .gravity = c->state->gravity,
                     .wake = (double)c->state->wake };
  const bt_field *field = live_field (c, "sea");
  bt_status status
      = field ? bt_def_set_number (field, &def, c->args[2], c->error) : c->error->status;
  if (status != BT_OK)
    return status;
  c->state->density = def.density;
  c->state->gravity = def.gravity;
  c->state->wake = def.wake != 0;
  bt__mark_all_stale (c);
  return weigh_anew (c);
}

/* All that changes of an obstacle is its friction.  */
static bt_status
alter_obstacle (const bt__call *c)
{
  bt_obstacle_def def = { 0 };
  const bt_field *field;
  double *roughness;
  bt_status status = bt__check_part (c->dive, BT_PART_OBSTACLE, c->subject, c->error);
  if (status != BT_OK)
    return status;
  field = live_field (c, bt_obstacle_head (c->dive->model->obstacles[c->subject].kind)->name);
  if (!field)
    return c->error->status;
  roughness = &bt__dive_roughness (c->dive, c->state)[c->subject];
  def.friction = *roughness;
  status = bt_def_set_number (field, &def, c->args[2], c->error);
  bt__pairs_change (c->dive);
  *roughness = def.friction;
  bt__mark_all_stale (c);
  return status;
}

bt_status
bt__op_alter (const bt__call *c)
{
  if (c->args[0] == BT_PART_SEA)
    return alter_sea (c);
  if (c->args[0] == BT_PART_VEHICLE)
    return alter_vehicle (c);
  if (c->args[0] == BT_PART_TETHER)
    return alter_tether (c);
  if (c->args[0] == BT_PART_OBSTACLE)
    return alter_obstacle (c);
  return bt__fail (c->error, BT_ERR_NAME, "there is no part of the kind %g", c->args[0]);
}
