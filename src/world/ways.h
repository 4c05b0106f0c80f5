/* What ways that a vehicle is to fly have in common: the vehicle at the far end of a tether, how
   much room its hull asks for, and the points that are handed out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_WAYS_H
#define BT_WORLD_WAYS_H

#include "world/watch.h"

/* Put into *VEHICLE the vehicle at the far end of tether I.  BT_ERR_NAME; BT_ERR_UNSUPPORTED if
   there is none.  */
bt_status bt__vehicle_at_end (const bt_dive *dive, int i, int *vehicle, bt_error *error);

/* How far the hull reaches from its middle, m: what flies turns as it likes.  */
double bt__way_reach (const bt_dive *dive, int vehicle);

/* How far a way keeps off obstacles where there is room, m, for a hull that reaches REACH.  */
double bt__way_room (double reach);

/* Return the obstacle at PLACE in the scene; -1 for UINT32_MAX, none.  */
int bt__obstacle_at (const bt_dive *dive, uint32_t place);

/* Put up to MAX nodes of S into POINTS; return how many.  */
int bt__put_points (const bt__string *s, bt_vec3 *points, int max);

#endif
