/* Which pairs of a vehicle or a tether and an obstacle, or of tethers, may meet.

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
