/* A tether with the thesis' response among obstacles, flown by its end, and watched: everything it
   does is seen by the oracle.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_THESIS_RIG_H
#define BT_LAW_THESIS_RIG_H

#include "testbed/solids.h"
#include "testbed/sweep.h"
#include "contact/held.h"
#include "contact/thesis.h"

enum
{
  RIG_OBSTACLES = 64,
  RIG_NODES = 32,
  RIG_MOVERS = 4
};

typedef struct rig
{
  bt__obstacle obstacle[RIG_OBSTACLES];
  uint32_t n;
  bt__scene *scene;
  bt__switches on;
  uint8_t off[RIG_OBSTACLES];
  bt__mover mover[RIG_MOVERS];
  uint32_t movers;
  bt__surroundings around;
  bt__safe *safe;
  bt__polyline_work *work;
  bt__count count;
  bt__way way;
  bt_tether_props props;
  bt__thesis_rules rules;
  bt_current current;
  bt_water water;
  bt__shape_tools tools;
  bt__shape_counts shapes;
  bt__thesis *state;
  bt__thesis_counts counts;
  bt__thesis_report report;
  bt_error error;
  bt_vec3 a, b; /* where the ends are wanted */
  double length, pull, stretch;
  /* What the oracle looks for: skeletons nothing may cross.  */
  sweep_segment bone[1024];
  int bones;
  const sweep_triangle *sheet;
  int sheets;
  long crossings, legs;
} rig;

/* A rig without obstacles: a catenary of diameter 10 mm, neutral, in a current toward the east of
   0.25 m/s; the thesis' defaults.  */
rig *rig_new (void);
void rig_free (rig *r);

/* Obstacles; each returns its id, its number.  */
uint32_t rig_box (rig *r, bt_vec3 centre, bt_vec3 half, double heading);
uint32_t rig_pile (rig *r, bt_vec3 from, bt_vec3 to, double radius);
uint32_t rig_ball (rig *r, bt_vec3 centre, double radius);
uint32_t rig_bar (rig *r, bt_vec3 from, bt_vec3 to, double radius);
uint32_t rig_hull (rig *r, const bt_vec3 *points, int n);
uint32_t rig_mesh (rig *r, bt__mesh *mesh); /* taken over */

/* Make the scene and lay the tether of LENGTH from A to B, and let it take its shape.  */
void rig_start (rig *r, bt_vec3 a, bt_vec3 b, double length);

/* Let it rest for a number of steps in which the sea counts as new.  */
void rig_rest (rig *r, int steps);

/* One step with the vehicle's end wanted at B.  Return nonzero if it is there.  */
int rig_step (rig *r, bt_vec3 b);

/* Fly to B in steps of STRIDE m; return how many of them fell short.  */
int rig_fly (rig *r, bt_vec3 b, double stride);

/* Fly round CENTRE by ANGLE (radians, counterclockwise seen from above), the radius going evenly to
   RADIUS.  */
int rig_round (rig *r, bt_vec3 centre, double angle, double radius, double stride);

/* How often the polyline goes round the vertical axis through CENTRE, in turns.  */
double rig_turns (const rig *r, bt_vec3 centre);

/* The least distance of the axis to anything, by brute force of the engine's pairs.  */
double rig_clearance (const rig *r);

/* Fail the test unless nothing was passed, no link is nearer than the core, none was stretched.  */
void rig_check (const rig *r);

bt__span *rig_span (const rig *r, int k);

/* The largest of length / arc over the links of LINE.  */
double rig_stretch (const bt__polyline *line);

/* Contacts now.  */
int rig_contacts (const rig *r);

bt_vec3 *rig_x (const rig *r);
int64_t rig_n (const rig *r);

#endif
