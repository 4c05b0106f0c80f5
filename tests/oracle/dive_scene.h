/* Dives to be judged: worlds of endless posts, which a line has passed or has not, and what is done
   in them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_DIVE_SCENE_H
#define BT_ORACLE_DIVE_SCENE_H

#include <bight/bight.h>

enum
{
  OBSTACLES = 10, /* most */
  LINES = 2
};

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle[2];
  bt_tether_def tether[LINES];
  bt_obstacle_def obstacle[OBSTACLES];
  double track[2][60];
} scene;

/* An obstacle more, with the fields it has by default; a post of 400 m about MIDDLE.  */
bt_obstacle_def *add (scene *s, const char *head, const char *name);
void add_post (scene *s, const char *head, const char *name, bt_vec3 middle, bt_vec3 axis,
               double radius);

/* A slack line from (-8 -8 -6) to a vehicle 16 m east of there, in a current to the north; then,
   as one likes: five posts, two that go to and fro, a hull for the I-th vehicle, a garage that the
   line comes from on an umbilical of its own, a second line to the same vehicle.  */
void begin_scene (scene *s, bt_model_kind model);
void plant_wood (scene *s);
void add_movers (scene *s);
void give_hull (scene *s, int i, bt_vec3 size);
void hang_garage (scene *s);
void tie_twice (scene *s);

bt_dive *enter (const scene *s);

/* Do it; a refusal must say why.  With BIGHT_TELL in the environment it is printed.  */
bt_status operate (bt_dive *dive, bt_op op, int subject, int n, const double *args);
bt_status take_model (bt_dive *dive, int i, bt_model_kind model);

/* Step; return nonzero if it went: the thesis' search alone may find nothing, and the dive stands.
 */
int step (bt_dive *dive);

#endif
