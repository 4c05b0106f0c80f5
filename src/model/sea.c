/* The sea of a model: waves as components, and the obstacles that cast a lee.  A pile has the lee
   of its cylinder; a box or a ball has the lee of an upright pile of its mean width.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "model/compile.h"
#include "sea/grid.h"

/* ---- Lee ---- */

/* A block counts as the upright pile as wide as it is in the mean.  */
static bt_wake
block_wake (bt_vec3 at, double width, double height)
{
  bt_vec3 up = { 0, 0, height / 2 };
  return bt_wake_of (bt__sub (at, up), bt__add (at, up), width / 2);
}

/* True and *WAKE if DEF stands in the current.  */
static int
wake_of (const bt_obstacle_def *def, bt_wake *wake)
{
  switch (def->kind)
    {
    case BT_OBSTACLE_CYLINDER:
    case BT_OBSTACLE_CAPSULE:
      *wake = bt_wake_of (def->from, def->to, def->radius);
      return 1;
    case BT_OBSTACLE_SPHERE:
      *wake = block_wake (def->at, 2 * def->radius, 2 * def->radius);
      return 1;
    case BT_OBSTACLE_BOX:
      *wake = block_wake (def->at, (def->size.x + def->size.y) / 2, def->size.z);
      return 1;
    default:
      return 0;
    }
}

static bt_status
find_lees (bt_model *model, bt_error *error)
{
  size_t n = 0;
  bt_status status;
  bt_wake *wakes;
  if (model->n_obstacles == 0)
    return BT_OK;
  wakes = malloc ((size_t)model->n_obstacles * sizeof *wakes);
  if (!wakes)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the lee of obstacles");
  for (int i = 0; i < model->n_obstacles; i++)
    if (bt__model_carried (model, i) < 0 && wake_of (&model->obstacles[i], &wakes[n]))
      n++;
  status = bt_lees_new (wakes, n, &model->lees, error);
  free (wakes);
  return status;
}

/* ---- All of it ---- */

bt_status
bt__compile_sea (bt_model *model, bt_error *error)
{
  bt_sea_def *sea = &model->sea;
  bt_error inner;
  bt_status status = bt_waves_make (&sea->waves, sea->depth, sea->gravity, &model->waves, &inner);
  if (status != BT_OK)
    return bt__about ("sea", "", error, &inner);
  if (sea->current.kind == BT_CURRENT_GRID && !sea->grid)
    return bt__fail (error, BT_ERR_DEF, "this world's current is a grid, and none was given");
  return find_lees (model, error);
}

uint64_t
bt__hash_sea (const bt_sea_def *sea, uint64_t h)
{
  bt_sea_def plain = *sea;
  plain.grid = NULL;
  h = bt__hash (&plain, sizeof plain, h);
  return sea->grid ? bt__current_grid_hash (sea->grid, h) : h;
}
