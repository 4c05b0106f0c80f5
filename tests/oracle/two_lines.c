/* See two_lines.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "math/vec.h"
#include "two_lines.h"

void
begin_two_lines (scene *s, bt_model_kind model)
{
  begin_scene (s, model);
  s->world.n_vehicles = s->world.n_tethers = 2;
  bt_def_set_name (s->tether[1].to.part, "garage", NULL);
}

void
draw_line_of_two (scene *s, int i, dice *d, double below, double ahead, int mass)
{
  bt_tether_def *line = &s->tether[i];
  double toward = dice_between (d, 0, 0.5) + i * BT__PI / 2;
  bt_vec3 u = { cos (toward), sin (toward), 0 };
  bt_vec3 middle = { 0, 0, -6 - below * i - dice_between (d, 0, 0.5) };
  line->from.at = bt__axpy (middle, -6, u);
  s->vehicle[i].at = bt__axpy (middle, ahead, u);
  line->length = dice_between (d, 12.1, 16) - (6 - ahead);
  line->props.wet_weight = dice_between (d, -0.1, 0.3);
  line->props.friction = dice_between (d, 0, 0.6);
  line->props.breaking_load = 1e9;
  if (mass)
    assert_int_equal (bt_def_set_vehicle_type (&s->vehicle[i], "bluerov2-heavy", NULL), BT_OK);
}

void
act_on_two (bt_dive *dive, dice *d, int v, bt_vec3 p, double speed, int mass, int cut)
{
  if (cut && dice_below (d, 6) == 0)
    operate (dive, BT_OP_CUT, v, 1, (double[]){ dice_between (d, 3, 10) });
  else if (dice_below (d, 4) == 0)
    operate (dive, BT_OP_DRIVE, v, 4,
             (double[]){ dice_between (d, -1, 1), dice_between (d, -1, 1), dice_between (d, -1, 1),
                         dice_between (d, -1, 1) });
  else if (mass)
    operate (dive, BT_OP_FLY_TO, v, 4, (double[]){ p.x, p.y, p.z, 2 });
  else
    operate (dive, BT_OP_MOVE, v, 4, (double[]){ p.x, p.y, p.z, dice_below (d, 3) ? speed : 20 });
}
