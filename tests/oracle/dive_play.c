/* See dive_play.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dive_play.h"
#include "math/vec.h"

static void
switch_pair (bt_dive *dive, judge *j, dice *d)
{
  int o = dice_below (d, bt_dive_count (dive, BT_PART_OBSTACLE));
  int part = dice_below (d, 2) ? BT_PART_VEHICLE : BT_PART_TETHER;
  if (operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ part, o, dice_below (d, 2) }) != BT_OK)
    return;
  (part == BT_PART_VEHICLE ? j->excused_hull : j->excused)[0][o] = 1;
}

/* Anywhere, or right beside an obstacle, or in it.  */
static bt_vec3
somewhere (const judge *j, dice *d)
{
  int o = dice_below (d, j->scene->world.n_obstacles);
  bt__link axis = axis_of (j->scene, j->is, o);
  bt_vec3 p = dice_point (d, 12);
  p.z = dice_between (d, -16, 0);
  if (dice_below (d, 2))
    {
      axis = part_of_axis (&axis, p);
      p = bt__add (bt__scale (0.5, bt__add (axis.a, axis.b)), dice_point (d, 1.5));
    }
  return p;
}

/* Something a pilot might do, and things no pilot would.  */
static void
do_something (bt_dive *dive, judge *j, dice *d, habits h)
{
  int v = dice_below (d, bt_dive_count (dive, BT_PART_VEHICLE));
  int t = dice_below (d, bt_dive_count (dive, BT_PART_TETHER));
  bt_vec3 p = somewhere (j, d);
  if (h.models > 1 && dice_below (d, h.models) == 0)
    take_model (dive, t, (bt_model_kind)dice_below (d, BT_MODEL_AUTO + 1));
  switch (dice_below (d, 9))
    {
    case 0:
    case 1:
      operate (dive, BT_OP_DRIVE, v, 4,
               (double[]){ dice_between (d, -1, 1), dice_between (d, -1, 1),
                           dice_between (d, -1, 1), dice_between (d, -1, 1) });
      break;
    case 2:
      operate (dive, BT_OP_MOVE, v, 4, (double[]){ p.x, p.y, p.z, dice_below (d, 3) ? 2 : 20 });
      break;
    case 3:
      operate (dive, BT_OP_FLY_TO, v, 4, (double[]){ p.x, p.y, p.z, 3 });
      break;
    case 4:
      if (h.jumps)
        operate (dive, BT_OP_PLACE, v, 3, (double[]){ p.x, p.y, p.z });
      break;
    case 5:
      if (h.winch)
        operate (dive, dice_below (d, 2) ? BT_OP_PAY_OUT : BT_OP_HAUL_IN, t, 2,
                 (double[]){ dice_between (d, 0.1, 12), dice_between (d, 0.1, 2) });
      break;
    case 6:
      if (h.models)
        take_model (dive, t, (bt_model_kind)dice_below (d, BT_MODEL_AUTO + 1));
      break;
    case 7:
      if (h.cut && dice_below (d, 4) == 0)
        operate (dive, BT_OP_CUT, t, 1, (double[]){ dice_between (d, 1, 28) });
      break;
    default:
      if (h.pairs)
        switch_pair (dive, j, d);
    }
}

void
live (bt_dive *dive, judge *j, dice *d, habits h, int acts, int steps)
{
  for (int k = 0; k < acts; k++)
    {
      do_something (dive, j, d, h);
      look_again (j, dive, 0);
      for (int i = 0; i < steps && step (dive); i++)
        look_again (j, dive, 1);
    }
}

int
longer (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 20 : 1;
}

uint64_t
other_seeds (void)
{
  const char *wish = getenv ("BIGHT_SEED");
  return wish ? strtoull (wish, NULL, 10) : 0;
}

void
fly (const scene *s, uint64_t seed, habits h, int acts, int steps, const char *name)
{
  bt_dive *dive = enter (s);
  dice d = dice_new (seed + other_seeds ());
  judge j;
  begin_judging (&j, s, dive);
  if (h.models > 1)
    j.most_stretch = INFINITY; /* links of a shape that is still looked for may be any length */
  live (dive, &j, &d, h, acts * longer (), steps);
  print_message ("# %s: %ld looks, clearance beyond the core %.3g m, hull %.3g m, stretch %.6g\n",
                 name, j.looks, j.least, j.least_hull, j.stretch);
  acquit (&j, name);
  end_judging (&j);
  bt_dive_free (dive);
}
