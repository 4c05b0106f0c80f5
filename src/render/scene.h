/* What the files that make the view of a dive share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SCENE_H
#define BT_RENDER_SCENE_H

#include "render/scene_of_dive.h"

/* A view in the making.  STATUS keeps the first failure, after which nothing is added.  */
typedef struct bt__scene
{
  const bt_dive *dive;
  bt_view *view;
  bt__show show;
  bt_sea_view sea;
  bt_status status;
  bt_error *error;
  bt_vec3 low, high; /* of the tethers */
  int any;
  bt_vec3 *points; /* of all tethers, one after the other */
  double *values;
  size_t n;
} bt__scene;

/* Add THING unless something failed before.  */
void bt__scene_add (bt__scene *scene, const bt_thing *thing);

void bt__scene_tethers (bt__scene *scene);   /* scene_tether.c */
void bt__scene_obstacles (bt__scene *scene); /* scene_obstacle.c */
void bt__scene_flow (bt__scene *scene);      /* scene_flow.c */
void bt__scene_more (bt__scene *scene);      /* scene_more.c */

#endif
