/* A line led by its two ends, without a dive: what measurements of a real line are held against.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_LEAD_H
#define BIGHT_LEAD_H

#include <bight/decls.h>
#include <bight/status.h>
#include <bight/tether.h>
#include <bight/vec.h>

BT_BEGIN_DECLS

/* The line and its water.  Of PROPS count diameter, mass, wet_weight, ea, ei, ba, bending_damping,
   gj, ei_stuck and slip_curvature, which are 0 of a line with sets, cdn, cdt, ca and friction. Sets
   and gj count with bending stiffness alone.  A clamp turns about its direction as little as it
   can; the line is gripped as it lies without twist.  */
typedef struct bt_lead_line
{
  bt_tether_props props;
  double length;      /* m, where the track tells no length that is out */
  int intervals;      /* 2 to BT_LEAD_INTERVALS */
  int clamped;        /* true: the line leaves its ends along the directions of the track */
  double density;     /* kg/m3 of the water, 0: none */
  double gravity;     /* m/s2 */
  bt_vec3 current;    /* m/s, the same everywhere */
  double floor;       /* m: height of a flat floor, on which the friction acts; NAN: none */
  double step;        /* s: no step of the solver is longer */
  const bt_set *sets; /* their planes counted at the winch end: 0 is north where the line begins to
                         be led straight down, and turns with the line the shortest way */
  int n_sets;
  double tilt[2][2]; /* radians: at each end, if clamped, the angle between line and track, toward 0
                        and toward 90 degrees of a plane of a set */
} bt_lead_line;

/* Where the ends are.  All arrays have ROWS elements, 2 or more.  */
typedef struct bt_lead_track
{
  int rows;
  const double *t;             /* s, rising */
  const bt_vec3 *end[2];       /* m: the winch end, the far end */
  const bt_vec3 *direction[2]; /* from the winch end toward the far end; used if clamped */
  const double *out;           /* m of line that is out, or NULL: the length, always */
  double clock;                /* s: the line is where the track was so much earlier */
  int last;                    /* rows to be led through; 0: all */
} bt_lead_track;

/* How the line begins: at rest if N is 0, else along the N places AT, moving by V; each is S metres
   from the winch end, rising from 0 to the length.  */
typedef struct bt_lead_start
{
  int n;
  const double *s;
  const bt_vec3 *at, *v;
} bt_lead_start;

enum
{
  BT_LEAD_INTERVALS = 2000
};

/* Lead LINE through TRACK.  At each row K that is led through, PLACES [K * N + I] receives the
   point of the line at MARKS [I] metres from the winch end, of N such places, and PULLS [2 * K + E]
   the force, N, of the line on end E.  BT_ERR_DOMAIN, BT_ERR_LIMIT, BT_ERR_DIVERGED, or
   BT_ERR_INTERRUPTED by POLL, which may be NULL; PLACES and PULLS are then not to be read.  */
bt_status bt_lead (const bt_lead_line *line, const bt_lead_track *track, const bt_lead_start *start,
                   const double *marks, int n, bt_vec3 *places, bt_vec3 *pulls, bt_poll poll,
                   void *user, bt_error *error);

BT_END_DECLS

#endif
