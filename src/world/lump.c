/* Clumps and floats: see lump.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "world/lump.h"

double
bt__lump_volume (const bt_lump *lump, const bt_water *water)
{
  double rho = water->density, g = water->gravity;
  return lump->mass > 0     ? lump->mass / 7850
         : rho > 0 && g > 0 ? lump->buoyancy / (0.7 * rho * g)
                            : 0;
}

double
bt__ball_radius (double volume)
{
  return cbrt (3 * volume / (4 * BT__PI));
}

/* A lump keeps its distance to the far end along the line, whatever the winch does.  */
int
bt__lump_place (const bt_dive *dive, int i, const bt__line *line, const bt_lump *lump, bt_vec3 *at)
{
  double from_end = dive->model->tethers[i].length - lump->at;
  bt__line part = line->tether->parted ? bt__line_tail (line) : *line;
  double length = bt__line_length (&part);
  if (line->tether->parted && from_end > length)
    {
      from_end -= length + line->tether->lost;
      part = *line;
      length = bt__line_length (&part);
    }
  if (from_end < 0 || from_end > length) /* lost with what lay between two breaks, or not out */
    return 0;
  *at = bt__line_point (&part, length - from_end);
  return 1;
}
