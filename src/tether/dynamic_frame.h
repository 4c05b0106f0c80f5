/* The directors of a moving line's cross-section, from node to node.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_DYNAMIC_FRAME_H
#define BT_TETHER_DYNAMIC_FRAME_H

#include "tether/dynamic_kernel.h"

/* A line as it lies at X; of REST and LINK one tells its rest lengths.  EDGE, NULL of a line
   without twist, holds the angles of the intervals' directors against the frame of parallel
   transport, rad, STRIDE doubles apart; FAR is the angle of a clamp at node n.  */
typedef struct bt__frame_line
{
  const bt__dynamic_input *in;
  const bt_vec3 *x;
  int n;
  const double *rest;
  const bt__link *link;
  const double *edge;
  int stride;
  double far;
} bt__frame_line;

/* The rest length of interval J, m.  */
static inline double
bt__frame_rest (const bt__frame_line *l, int j)
{
  return l->rest ? l->rest[j] : l->link[j].rest;
}

/* On the way along a line: where, the tangent and the first director of the interval before.  */
typedef struct bt__walk
{
  double left; /* m of rest length to node n */
  bt_vec3 t, u;
  double cos, sin; /* of the angle of the material's directors against the frame */
} bt__walk;

/* A node on the way.  */
typedef struct bt__station
{
  bt_vec3 w, d;   /* turn, natural turn */
  bt_vec3 middle; /* unit tangent: half the way between the two */
  bt_vec3 swept;  /* product of the tangents before and after */
  double k, half; /* EI / cell; 1 + cos of the turn, halved */
  double cell;    /* m */
} bt__station;

/* The nodes that bend, from the first to the last.  */
int bt__first_station (const bt__frame_line *l);
int bt__last_station (const bt__frame_line *l);

/* At the start of L; on to node I, from the first station on one after the other.  */
bt__walk bt__set_out (const bt__frame_line *l);
bt__station bt__next_station (const bt__frame_line *l, bt__walk *s, int i);

/* Minus the derivative of a station's energy of bending by the angle of its directors, N m.  */
double bt__moment_of (const bt__station *at);

/* True if the clamps at both ends of the line of IN hold the material.  */
static inline int
bt__is_gripped (const bt__dynamic_input *in)
{
  return in->end[0].clamped && in->end[1].clamped;
}

/* The angles of the directors before and after station I.  */
static inline double
bt__angle_before (const bt__frame_line *l, int i)
{
  return i > 0 ? l->edge[(i - 1) * l->stride] : 0;
}

static inline double
bt__angle_after (const bt__frame_line *l, int i)
{
  return i < l->n ? l->edge[i * l->stride] : l->far;
}

#endif
