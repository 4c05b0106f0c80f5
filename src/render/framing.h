/* What a camera that aims itself must have in the picture.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_FRAMING_H
#define BT_RENDER_FRAMING_H

#include <bight/view.h>

typedef void bt__visit_point (void *user, bt_vec3 p);

/* Call VISIT for the points that must be in the picture of VIEW.  */
void bt__framed_points (const bt_view *view, bt__visit_point *visit, void *user);

/* True if anything in VIEW must be seen.  */
int bt__frames_any (const bt_view *view);

/* Let obstacles be what must be seen, in a view without vehicle and tether.  */
void bt__frame_obstacles (bt_view *view);

#endif
