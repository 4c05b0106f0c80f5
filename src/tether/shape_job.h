/* One shape solve under way, shared by the files shape*.c.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_SHAPE_JOB_H
#define BT_TETHER_SHAPE_JOB_H

#include "base/error.h"
#include "math/vec.h"
#include "tether/plane.h"
#include "tether/shape.h"

/* The input, the place of the answer, and the plane problem once posed.  */
typedef struct bt__shape_job
{
  const bt__shape_input *in;
  const bt_tether_props *props;
  bt__shape_tools *tools;
  bt__shape_counts *counts;
  bt__shape *shape;
  bt__shape_memory *memory;
  bt_error *error;
  bt_vec3 chord;     /* b - a */
  bt_vec3 current;   /* unit and horizontal, or zero */
  double speed;      /* m/s, of the mean current, horizontal */
  double drag;       /* N/m by it on a line across it */
  double load;       /* N/m */
  bt_vec3 direction; /* unit, where the load points */
  double h, v;       /* the chord across and against the load */
} bt__shape_job;

/* Measure the mean current along the chord and the load it makes with the weight.  Only its
   horizontal part bends the line.  BT_ERR_DIVERGED when it is not finite.  */
bt_status bt__shape_measure_load (bt__shape_job *j);

/* Return the unit direction of the last load, else straight down.  */
bt_vec3 bt__shape_remembered (const bt__shape_job *j);

/* Return a unit vector square to the unit vector D: the part of WISH that is, else a level one.  */
bt_vec3 bt__shape_square_to (bt_vec3 d, bt_vec3 wish);

/* Span the plane of CHORD and J->direction: J->h, J->v and the shape's axes and load.  */
void bt__shape_span_plane (bt__shape_job *j, bt_vec3 chord);

/* Pose the plane problem of the depth rule: the load's direction, the plane, its share of the
   length and of the depth.  */
void bt__shape_pose (bt__shape_job *j);

/* True if no slack is left in space, and in the plane once it is posed.  */
int bt__shape_is_taut (const bt__shape_job *j);
int bt__shape_is_plane_taut (const bt__shape_job *j);

/* Make the shape straight with a constant TENSION.  */
void bt__shape_be_straight (bt__shape_job *j, double tension);

/* The thesis' models: rubber band, V, catenary by either way.  */
bt_status bt__shape_rubber_band (bt__shape_job *j);
bt_status bt__shape_v (bt__shape_job *j);
bt_status bt__shape_catenary (bt__shape_job *j);
bt_status bt__shape_catenary_simplex (bt__shape_job *j);

/* Take the form of catenary C, tension load times A.  */
void bt__shape_hang (bt__shape_job *j, const bt_catenary *c);

#endif
