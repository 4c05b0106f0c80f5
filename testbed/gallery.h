/* The worlds of worlds/ and of testbed/worlds/, for programs in C: the parts that `enter!' gives to
   the engine, written down by gallery.scm when the testbed is built.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_GALLERY_H
#define BT_TESTBED_GALLERY_H

#include <bight/bight.h>

/* A world whose parts may be altered before a model is made of them.  The arrays have room for the
   parts that the world has.  */
typedef struct gallery_world
{
  bt_world world;
  bt_vehicle_def *vehicle;
  bt_tether_def *tether;
  bt_obstacle_def *obstacle;
} gallery_world;

/* Return the name of the I-th world, or NULL beyond the last.  */
const char *gallery_name (int i);

/* Return the world called NAME, to be freed by gallery_close.  The program ends with a line on
   standard error if no world is called so.  */
gallery_world *gallery_open (const char *name);
void gallery_close (gallery_world *w);

/* Begin a dive in the world called NAME.  */
bt_dive *gallery_begin (const char *name);

#endif
