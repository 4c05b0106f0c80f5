/* Sight: what a thing hides from a camera.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SIGHT_H
#define BT_RENDER_SIGHT_H

#include <bight/view.h>

/* True if a solid or the ground in VIEW is between the points FROM and TO.  */
int bt__hidden (const bt_view *view, bt_vec3 from, bt_vec3 to);

#endif
