/* Which pairs of a vehicle or a tether and an obstacle, of tethers, or of a tether and the hull of
   another's vehicle, may meet.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "sim/ops.h"
#include "world/obstacles.h"

/* The tether that a tether is to meet, or -1: an obstacle.  */
static int
other_tether (const bt__call *c)
{
  int i = (int)c->args[1] - c->dive->model->n_obstacles;
  return i >= 0 && i < c->dive->model->n_tethers ? i : -1;
}

/* The vehicle whose hull a tether is to meet, or -1: none.  */
static int
met_vehicle (const bt__call *c)
{
  double v = c->args[1] - bt__hull_number (c->dive->model, 0);
  return v >= 0 && v < c->dive->model->n_vehicles && v == floor (v) ? (int)v : -1;
}

/* BT_ERR_NAME unless the tether can meet the hull of VEHICLE.  */
static bt_status
check_meets_hull (const bt__call *c, int vehicle)
{
  const bt_model *model = c->dive->model;
  if (c->args[0] != BT_PART_TETHER)
    return bt__fail (c->error, BT_ERR_NAME,
                     "a tether meets the hulls of vehicles, a vehicle does not");
  if (bt__check_part (c->dive, BT_PART_TETHER, c->subject, c->error) != BT_OK)
    return BT_ERR_NAME;
  if (model->n_hulls > 0 && bt__may_meet_hull (model, c->subject, vehicle))
    return BT_OK;
  return bt__fail (c->error, BT_ERR_NAME,
                   "tether `%s' cannot meet `%s', which has no size or is made fast to it",
                   model->tethers[c->subject].name, model->vehicles[vehicle].name);
}

static bt_status
check_numbers (const bt__call *c)
{
  double part = c->args[0];
  int objects = bt__objects (c->dive->model);
  if (part != BT_PART_SEA && part != BT_PART_VEHICLE && part != BT_PART_TETHER)
    return bt__fail (c->error, BT_ERR_NAME, "a vehicle or a tether meets obstacles, not a part %g",
                     part);
  if (c->args[2] != 0 && c->args[2] != 1)
    return bt__fail (c->error, BT_ERR_DOMAIN, "a pair is on, 1, or off, 0, not %g", c->args[2]);
  if (met_vehicle (c) >= 0)
    return check_meets_hull (c, met_vehicle (c));
  if (!(c->args[1] >= -1 && c->args[1] < objects) || c->args[1] != floor (c->args[1]))
    return bt__fail (c->error, BT_ERR_NAME,
                     "what is met is an obstacle or a tether, 0 to %d, or all of them, -1, not %g",
                     objects - 1, c->args[1]);
  if (part != BT_PART_SEA && bt__check_part (c->dive, (bt_part)part, c->subject, c->error) != BT_OK)
    return BT_ERR_NAME;
  if (other_tether (c) >= 0)
    return part == BT_PART_TETHER
               ? BT_OK
               : bt__fail (c->error, BT_ERR_NAME, "a tether meets tethers, a vehicle does not");
  return c->args[1] == -1 ? BT_OK
                          : bt__check_part (c->dive, BT_PART_OBSTACLE, (int)c->args[1], c->error);
}

static void
switch_all (const bt__call *c, bt_part part, int n)
{
  for (int i = 0; i < n; i++)
    bt__switch_pair (c->dive, c->state, part, i, (int)c->args[1], c->args[2] != 0);
}

bt_status
bt__op_collide (const bt__call *c)
{
  bt_status status = check_numbers (c);
  bt_part part;
  if (status != BT_OK)
    return status;
  part = (bt_part)c->args[0];
  if (part != BT_PART_SEA)
    bt__switch_pair (c->dive, c->state, part, c->subject, (int)c->args[1], c->args[2] != 0);
  if (part == BT_PART_TETHER && other_tether (c) >= 0) /* the other way round it is the same */
    bt__switch_pair (c->dive, c->state, part, other_tether (c),
                     c->dive->model->n_obstacles + c->subject, c->args[2] != 0);
  if (part == BT_PART_SEA)
    {
      switch_all (c, BT_PART_VEHICLE, c->dive->model->n_vehicles);
      switch_all (c, BT_PART_TETHER, c->dive->model->n_tethers);
    }
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    bt__dive_tether (c->dive, c->state, i)->quiet = 0; /* what it lay on may be gone */
  bt__mark_all_stale (c);
  return BT_OK;
}
