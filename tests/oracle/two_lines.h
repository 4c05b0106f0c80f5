/* Two lines across each other and their two vehicles, drawn at random, and what is done there.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_TWO_LINES_H
#define BT_ORACLE_TWO_LINES_H

#include "dive_scene.h"
#include "testbed/solids.h"

/* Begin S: two lines of MODEL, each to a vehicle of its own.  */
void begin_two_lines (scene *s, bt_model_kind model);

/* Draw line I of S, the second BELOW metres below the first, its vehicle AHEAD metres from its
   middle and with mass if MASS.  */
void draw_line_of_two (scene *s, int i, dice *d, double below, double ahead, int mass);

/* Do something to vehicle V, which has mass if MASS: mostly send it to P, at SPEED m/s or so fast
   that it is there at once; with CUT sometimes part its line.  */
void act_on_two (bt_dive *dive, dice *d, int v, bt_vec3 p, double speed, int mass, int cut);

#endif
