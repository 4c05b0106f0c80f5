/* A judge of dives among obstacles that shares nothing with what keeps lines out of them: exact
   predicates on what a line swept, linking numbers about what it may not pass, brute force for
   distances.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_DIVE_JUDGE_H
#define BT_ORACLE_DIVE_JUDGE_H

#include "collide/scene.h"
#include "dive_scene.h"
#include "testbed/solids.h"

/* The safe step finds its way from below, by casts to a hundredth of a micrometre.  */
#define ROUNDING 1e-9

enum
{
  PARTS = 2 * LINES, /* a parted line is two */
  POINTS = 2000
};

typedef struct sight
{
  int n[PARTS]; /* 0: there is no such part */
  bt_vec3 x[PARTS][POINTS];
  bt__frame mover[OBSTACLES];
} sight;

typedef struct judge
{
  const scene *scene;
  sight *was, *is;
  uint8_t excused[LINES][OBSTACLES]; /* the pair was off */
  uint8_t excused_hull[2][OBSTACLES];
  long looks, crossings, stretched, apart, not_finite;
  double least, least_hull; /* m: beyond half the radius; beyond touch */
  double stretch, most_stretch; /* of a link; what is allowed */
  int in_step; /* not an operation */
} judge;

void look (const bt_dive *dive, sight *sight);

/* The axis of post O as it was seen; the 6 m of it about P.  */
bt__link axis_of (const scene *s, const sight *sight, int o);
bt__link part_of_axis (const bt__link *axis, bt_vec3 p);

/* The hull of the I-th vehicle as it is turned: by heading, then bow up, then starboard down.  */
bt__box hull_of (const scene *s, int i, const bt_vehicle_view *v);

/* Begin; look after every step (IN_STEP) and every operation; fail the test unless all was well. */
void begin_judging (judge *j, const scene *s, const bt_dive *dive);
void look_again (judge *j, const bt_dive *dive, int in_step);
void acquit (const judge *j, const char *name);
void end_judging (judge *j);

#endif
