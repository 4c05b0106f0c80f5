/* The parts of a dive by their numbers: how many there are, what each is called.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "base/error.h"
#include "world/dive.h"

int
bt_dive_count (const bt_dive *dive, bt_part part)
{
  switch (part)
    {
    case BT_PART_SEA:
      return 1;
    case BT_PART_VEHICLE:
      return dive->model->n_vehicles;
    case BT_PART_TETHER:
      return dive->model->n_tethers;
    case BT_PART_OBSTACLE:
      return dive->model->n_obstacles;
    }
  return 0;
}

const char *
bt_dive_name (const bt_dive *dive, bt_part part, int i)
{
  int n = bt_dive_count (dive, part);
  int lines = bt_dive_count (dive, BT_PART_TETHER);
  if (part == BT_PART_OBSTACLE && i >= n + lines)
    return bt_dive_name (dive, BT_PART_VEHICLE, i - n - lines);
  if (part == BT_PART_OBSTACLE && i >= n)
    return bt_dive_name (dive, BT_PART_TETHER, i - n);
  if (i < 0 || i >= n)
    return NULL;
  if (part == BT_PART_SEA)
    return "sea";
  if (part == BT_PART_OBSTACLE)
    return dive->model->obstacles[i].name;
  return part == BT_PART_VEHICLE ? dive->model->vehicles[i].name : dive->model->tethers[i].name;
}

bt_status
bt__check_part (const bt_dive *dive, bt_part part, int i, bt_error *error)
{
  static const char *const words[] = { "sea", "vehicle", "tether", "obstacle" };
  int n = bt_dive_count (dive, part);
  if (i < 0 || i >= n)
    return bt__fail (error, BT_ERR_NAME, "there is no %s number %d; this dive has %d", words[part],
                     i, n);
  return BT_OK;
}
