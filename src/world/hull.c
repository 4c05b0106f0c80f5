/* The hull of a vehicle: see hull.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "math/vec.h"
#include "world/hull.h"

void
bt__hull_of (const bt_vehicle_def *def, bt__hull_body *hull)
{
  bt_vec3 half = bt__scale (0.5, def->size);
  if (half.x <= 0 || half.y <= 0 || half.z <= 0)
    {
      hull->body = bt__body_ball (0);
      return;
    }
  hull->box = (bt__box){ .frame = bt__turned (bt__vec (0, 0, 0), 0, 0, 0), .half = half };
  hull->body = bt__body_box (&hull->box, 0);
}

bt__frame
bt__vehicle_frame (const bt__vehicle *v)
{
  double degrees = 180 / BT__PI;
  bt__quat q = v->body.attitude;
  if (v->rigid)
    return (bt__frame){ v->position, bt__turn_out (q, bt__vec (1, 0, 0)),
                        bt__turn_out (q, bt__vec (0, 1, 0)), bt__turn_out (q, bt__vec (0, 0, 1)) };
  return bt__turned (v->position, v->heading * degrees, v->pitch * degrees, v->roll * degrees);
}

bt_vec3
bt__vehicle_bow (const bt_vehicle_def *def, const bt__vehicle *v)
{
  return bt__axpy (v->position, def->size.y / 2, bt__vehicle_frame (v).y);
}

int
bt__stop_obstacle (const bt_model *model, const bt__stop *stop)
{
  return stop->mover == UINT32_MAX ? (int)model->scene->object[stop->object].id
                                   : model->carried[stop->mover].obstacle;
}
