/* The view of a dive.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SCENE_OF_DIVE_H
#define BT_RENDER_SCENE_OF_DIVE_H

#include <bight/bight.h>
#include <bight/view.h>

/* By what tethers are painted.  */
typedef enum bt__paint
{
  BT__PAINT_PLAIN = 0,
  BT__PAINT_TENSION,
  BT__PAINT_CURVATURE,
  BT__PAINT_MODEL,
  BT__PAINTS
} bt__paint;

/* What is drawn over the scene for who wants to look closer.  */
enum
{
  BT__SHOW_CONTACTS = 1, /* every contact, with the force or the normal there */
  BT__SHOW_TURNS = 2,    /* turns of tethers about obstacles */
  BT__SHOW_STRING = 4,   /* the taut strings */
  BT__SHOW_BOXES = 8,    /* the boxes about the obstacles */
  BT__SHOW_FLOW = 16     /* the current as streamlines */
};

typedef struct bt__show
{
  bt__paint paint;
  unsigned more; /* of the above */
  int level;     /* of the boxes; -1: the first few levels */
} bt__show;

/* Return the word for PAINT, or NULL.  */
const char *bt__paint_name (bt__paint paint);

/* Put the present state of DIVE into VIEW, an empty view: sea and bottom, obstacles, painted
   tethers with their touches and anchors, vehicles, the current, and the additions of SHOW.  */
bt_status bt__scene_of_dive (const bt_dive *dive, const bt__show *show, bt_view *view,
                             bt_error *error);

/* Add the vehicles and tethers of DIVE, another fate of the dive in VIEW, pale.  No camera aims at
   them.  */
bt_status bt__scene_ghost (const bt_dive *dive, bt_view *view, bt_error *error);

#endif
