/* The hulls of vehicles as what tethers meet: a box about each vehicle that has a size.

   A tether never meets the hull of a vehicle at either end of the tether: the end lies inside.  The
   boxes are drawn only in a world with a tether and a hull of a vehicle elsewhere.  All other
   worlds pay nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "model/compile.h"

static int
has_hull (const bt_vehicle_def *def)
{
  return def->size.x > 0 && def->size.y > 0 && def->size.z > 0;
}

/* True if a tether of MODEL is not made fast to VEHICLE.  */
static int
is_strange_to_a_tether (const bt_model *model, int vehicle)
{
  for (int i = 0; i < model->n_tethers; i++)
    if (model->ends[i][0].vehicle != vehicle && model->ends[i][1].vehicle != vehicle)
      return 1;
  return 0;
}

static int
can_be_met (const bt_model *model, int vehicle)
{
  return has_hull (&model->vehicles[vehicle]) && is_strange_to_a_tether (model, vehicle);
}

bt_status
bt__compile_hulls (bt_model *model, bt_error *error)
{
  int n = model->n_vehicles, any = 0;
  bt_status status = BT_OK;
  for (int v = 0; v < n; v++)
    any = any || can_be_met (model, v);
  if (!any)
    return BT_OK;
  model->hull = calloc ((size_t)n, sizeof (bt__scene *));
  if (!model->hull)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the hulls of %d vehicles", n);
  model->n_hulls = n;
  for (int v = 0; v < n && status == BT_OK; v++)
    {
      bt__obstacle box = { .kind = BT__OBSTACLE_BOX,
                           .id = (uint32_t)bt__hull_number (model, v),
                           .shape.box = { .frame = bt__turned (bt__vec (0, 0, 0), 0, 0, 0),
                                          .half = bt__scale (0.5, model->vehicles[v].size) } };
      if (can_be_met (model, v))
        status = bt__scene_new (&box, 1, 0, &model->hull[v], error);
    }
  return status;
}

void
bt__release_hulls (bt_model *model)
{
  for (int v = 0; v < model->n_hulls; v++)
    bt__scene_free (model->hull[v]);
  free (model->hull);
}
