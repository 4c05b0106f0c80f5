/* A picture of what a forward-looking sonar hears.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SONAR_H
#define BT_RENDER_SONAR_H

#include <bight/bight.h>

#include "render/render.h"

/* Draw what a sonar at the bow of vehicle VEHICLE of DIVE hears within RANGE metres into PICTURE,
   made here, of the size of DRAWING: a fan of 130 degrees with a vertical aperture of 20, range
   rings and bearings for FIGURES true, with TITLE.  */
bt_status bt__sonar_picture (const bt_dive *dive, int vehicle, double range, const char *title,
                             int figures, const bt__drawing *drawing, bt__picture *picture,
                             bt_error *error);

#endif
