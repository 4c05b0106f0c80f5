/* The hull of a vehicle as the obstacles see it: a box, or, without a size, a point.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_HULL_H
#define BT_WORLD_HULL_H

#include "collide/sweep.h"
#include "world/dive.h"

/* How near it comes to them, m.  */
#define BT__HULL_GAP 1e-3

typedef struct bt__hull_body
{
  bt__box box;
  bt__body body; /* refers to BOX */
} bt__hull_body;

/* Make *HULL that of DEF, in its own frame.  */
void bt__hull_of (const bt_vehicle_def *def, bt__hull_body *hull);

/* Where V stands and how it is turned.  */
bt__frame bt__vehicle_frame (const bt__vehicle *v);

/* Where the bow of V is, a vehicle of DEF: there are its camera and its sonar.  */
bt_vec3 bt__vehicle_bow (const bt_vehicle_def *def, const bt__vehicle *v);

/* The number of the obstacle that STOP is about.  */
int bt__stop_obstacle (const bt_model *model, const bt__stop *stop);

#endif
