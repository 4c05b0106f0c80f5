/* Clumps and floats of a tether: how large they are, and where.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_LUMP_H
#define BT_WORLD_LUMP_H

#include "world/line.h"

/* The volume of LUMP in WATER, m3: of steel, or of a float that weighs three tenths of what it
 * displaces.  */
double bt__lump_volume (const bt_lump *lump, const bt_water *water);

/* The radius, m, of a sphere of VOLUME, m3.  */
double bt__ball_radius (double volume);

/* Return true and *AT, where the middle of LUMP is on tether I, of which LINE is the part at the
   anchor; false if LUMP lies on the drum.  */
int bt__lump_place (const bt_dive *dive, int i, const bt__line *line, const bt_lump *lump,
                    bt_vec3 *at);

#endif
