/* A moving line among obstacles, and a judge who knows them without the engine's help: what the
   bench and the laws of contact share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_CONTACT_SCENE_H
#define BT_TESTBED_CONTACT_SCENE_H

#include "testbed/solids.h"
#include "testbed/sweep.h"
#include "contact/line.h"

enum
{
  REEF_SOLIDS = 160, /* obstacles of any kind */
  REEF_SHEETS = 40000,
  REEF_ANCHORS = 2000
};

/* Where the judge finds what is near: contact_judge.c.  */
typedef struct reef_bins reef_bins;

/* Obstacles, as the engine and as the judge have them.  */
typedef struct reef
{
  bt__scene *scene;
  reef_bins *bins;
  int obstacles, solids, bones, sheets;
  bt__obstacle obstacle[REEF_SOLIDS];
  solid solid[REEF_SOLIDS];
  sweep_segment bone[16 * REEF_SOLIDS];                            /* segments inside solids */
  sweep_triangle *sheet;                                           /* triangles of meshes */
  int of_solid[REEF_SOLIDS], of_bone[16 * REEF_SOLIDS], *of_sheet; /* which obstacle they are of */
} reef;

/* Make R, without obstacles; add some; raise it.  Nonzero on success.  */
int reef_open (reef *r);
void reef_close (reef *r);
void reef_box (reef *r, bt_vec3 centre, bt_vec3 half, double turn); /* about the vertical */
void reef_cylinder (reef *r, bt_vec3 a, bt_vec3 b, double radius);
void reef_wire (reef *r, bt_vec3 a, bt_vec3 b, double radius); /* a capsule */
void reef_plane (reef *r, double z);
/* A rough bottom at Z about the origin: N by N squares of SIDE metres.  */
int reef_bottom (reef *r, dice *d, double z, double side, int n, double rough);
/* Any triangles; any grid of heights.  */
int reef_soup (reef *r, const bt__soup *soup);
int reef_grid (reef *r, const bt__grid *grid);
int reef_raise (reef *r);

/* A jacket: 4 legs of 1.2 m 12 m apart, 4 levels and crossed braces, 24 wires of 10 mm, 6 boxes, a
   caisson of 2880 triangles, a rough bottom of 7200.  */
int reef_jacket (reef *r, uint64_t seed);

/* The obstacles of the world NAME of testbed/gallery.h, raised: its boxes are one surface of
   triangles.  Zero for a world with an obstacle of another kind than box, cylinder, capsule, bed.
 */
int reef_world (reef *r, const char *name);

/* The nearest any link of the polyline X of N points comes to anything, by brute force.  */
double reef_clearance (const reef *r, const bt_vec3 *x, int n);

/* How often the move of the polyline passes through something.  */
int reef_crossings (const reef *r, const bt_vec3 *from, const bt_vec3 *to, int n);

/* Make the judge's bins of what R has, at reef_raise; nonzero on success.  */
int reef_bin (reef *r);
void reef_bins_free (reef_bins *bins);

/* ---- A line in it ---- */

enum
{
  ROPE_PARTS = 40
};

/* What happened to the line in a part of a step, see bt__line_hook.  */
typedef struct rope_part
{
  int node, by, nodes;
} rope_part;

typedef struct rope
{
  reef *reef;
  bt_tether_props line;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__line_config config;
  bt__line_hook hook;
  bt__surroundings around;
  bt__dynamic *d;
  bt__dynamic_work *work;
  bt__line_work *contact;
  bt__contacts *anchors;
  bt__dynamic_report report;
  bt__line_report touch;
  bt__count count;
  bt_vec3 *before, *after; /* the line before a part of the last step, and after it */
  rope_part part[ROPE_PARTS];
  bt_vec3 *shown; /* of each part, ROOM nodes */
  int parts, room;
  int nodes;
  /* what came of it */
  long steps, solves, worst, unconverged, crossings, truncated, rounds, nan, touches, refused;
  long most_touches;
  double fastest, load, tension;
} rope;

/* Lay N intervals of LENGTH along the M points SHAPE in R, ends held there, without water's motion:
   10 mm, EA 2e5 N, BA 20 N s, neutral, friction MU.  Nonzero on success.  */
int rope_open (rope *p, reef *r, int n, const bt_vec3 *shape, int m, double length, double mu);
void rope_close (rope *p);

/* Let P be of 20 mm and touch itself.  */
void rope_set_itself (rope *p);

/* Raise R, a beam along z of radius BEAM, and lay P of N intervals about it in an overhand knot:
   two turns about the beam and three about a ring; it touches itself.  The ends lead away along x,
   the held one ASIDE metres aside.  Nonzero on success.  */
int rope_tie (rope *p, reef *r, int n, double beam, double mu, double aside);

/* One step, judged if JUDGED.  Zero if it was refused.  */
int rope_step (rope *p, double h, int judged);

/* Judge the last step, if it was not: add to the crossings.  */
void rope_judge (rope *p);

/* Take end 1 toward TARGET at SPEED for a step of H.  */
void rope_tow (rope *p, bt_vec3 target, double speed, double h);

#endif
