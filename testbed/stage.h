/* Scenes to throw a tether about in, with what the oracle must know of them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_STAGE_H
#define BT_TESTBED_STAGE_H

#include "collide/safe.h"
#include "testbed/solids.h"
#include "testbed/sweep.h"

enum
{
  NODES = 41,
  OBSTACLES = 120,
  SHEETS = 300,
  RING = 24,
  MOVERS = 3
};

typedef struct stage
{
  bt__scene *scene;
  bt__safe *safe;
  bt__count count;
  int solids, bones, sheets;
  solid solid[OBSTACLES];
  sweep_segment bone[16 * OBSTACLES];
  sweep_triangle sheet[SHEETS];
  bt_vec3 ring[RING];
  int has_ring;
  int movers; /* bars, all alike */
  bt__scene *bar;
  solid bar_solid;
  sweep_segment bar_bone;
  double bar_radius;
  bt__mover mover[MOVERS];
  bt__frame at[MOVERS];
  bt_vec3 x[NODES];
} stage;

solid capsule_between (bt_vec3 a, bt_vec3 b, double radius);

/* Thin wires everywhere, one of radius 0.  */
void draw_wires (stage *g, dice *d);

/* A lattice of bars, and a ring the linking number knows.  */
void draw_cage (stage *g, dice *d);

/* Corners: boxes, cylinders and balls that overlap.  */
void draw_corners (stage *g, dice *d);

/* Triangles.  */
void draw_sheets (stage *g, dice *d);

/* Three bars that move, among wires.  */
void draw_movers (stage *g, dice *d);

/* Make scene, safe step and a tether clear of everything; nonzero on success.  */
int raise_stage (stage *g);

void strike (stage *g);

#endif
