/* Dives to be measured: a sea, vehicles, each on a moving line of its own, and obstacles, put
   together part by part.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_SCENE_H
#define BT_TESTBED_SCENE_H

#include <bight/bight.h>

enum
{
  SCENE_BARS = 64
};

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle[BT_VEHICLES_MAX];
  bt_tether_def tether[BT_TETHERS_MAX];
  bt_obstacle_def obstacle[SCENE_BARS];
} scene;

/* Exit with a line on standard error unless STATUS is BT_OK.  */
void scene_must (bt_status status, const bt_error *error);

/* Return the greatest distance, m, of the first line of A from that of B, at as many places of
   each.  */
enum
{
  SCENE_PLACES = 41
};
double scene_apart (const bt_dive *a, const bt_dive *b);

/* Make S a still, empty sea of 60 m.  */
void scene_clear (scene *s);

/* Add to S, and return to be altered: a vehicle without mass at AT; a moving line of NODES
   intervals and LENGTH metres, neutral, from ANCHOR to the last vehicle; an obstacle of a kind by
   its name; a round bar.  */
bt_vehicle_def *scene_vehicle (scene *s, bt_vec3 at);
bt_tether_def *scene_line (scene *s, bt_vec3 anchor, double length, int nodes);
bt_obstacle_def *scene_obstacle (scene *s, const char *kind);
bt_obstacle_def *scene_bar (scene *s, bt_vec3 from, bt_vec3 to, double radius);

/* Let the water of S flow at U; let it have a wind sea.  */
void scene_current (scene *s, bt_vec3 u);
void scene_waves (scene *s);

/* Begin a dive in WORLD, such as that of a scene or of the gallery.  */
bt_dive *scene_begin (const bt_world *world);

/* Step DIVE so often and return the CPU seconds of a step.  */
double scene_run (bt_dive *dive, int steps);

/* The same, with the first FLOWN vehicles sent to and fro by a pilot, whose own count of steps
   begins at FROM: equal counts, equal sticks.  */
double scene_fly (bt_dive *dive, int flown, long from, int steps);

#endif
