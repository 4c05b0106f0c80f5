/* One tether, whatever model moves it, ready to be asked.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_LINE_H
#define BT_WORLD_LINE_H

#include "world/dive.h"

struct bt__form;

typedef struct bt__line
{
  const bt__tether *tether;
  const struct bt__form *form;     /* whose functions answer (world/form.h) */
  const bt_vec3 *nodes, *tensions; /* of a static shape */
  const bt__dynamic *chain;        /* of the moving line, from the anchor on; else NULL */
  const bt__dynamic *far_chain;    /* what hangs from the far end: CHAIN, or its other part */
  const bt__contacts *contacts, *far_contacts; /* of these chains */
  const bt__thesis *split;                     /* of a static line split at obstacles, else NULL */
  const bt__polyline *held; /* of a static line that an obstacle holds off its shape */
} bt__line;

/* Return tether I of STATE.  */
bt__line bt__line_of (const bt_dive *dive, bt__state *state, int i);

/* Return the other part of LINE, which has parted: from its new end to the far end.  */
bt__line bt__line_tail (const bt__line *line);

/* Arc length from the anchor to the far end, or to where the line has parted, m.  */
double bt__line_length (const bt__line *line);

/* The paid-out length, m; for a moving line the length past the winch so far, behind the ordered
   length by a lag.  True if no lag is left.  */
double bt__line_out (const bt__line *line);
int bt__line_has_followed (const bt__line *line);

/* The error in position that TETHER accepts, m; the most that is accepted where none is asked for,
   as a share of what is out.  */
#define BT__ACCURATE_SHARE 0.002
double bt__accuracy (const bt__tether *tether);

/* The model's own points: how many there are, and place and tension of the K-th.  */
int bt__line_nodes (const bt__line *line);
bt_vec3 bt__line_node (const bt__line *line, int k);
double bt__line_node_tension (const bt__line *line, int k);

/* Point, unit tangent toward the far end, and tension (N) at arc length S.  */
bt_vec3 bt__line_point (const bt__line *line, double s);
bt_vec3 bt__line_tangent (const bt__line *line, double s);
double bt__line_tension (const bt__line *line, double s);

/* The largest tension anywhere along LINE, its ends included, N; of a parted one in either part.
   Where the last step was taken in several parts, the largest of all of these.  */
double bt__line_tension_max (const bt__line *line);

/* Return an upper estimate of the error in position that comes of the nodes of CHAIN, m: the
   estimator of bt__dynamic_space_error times the most it was seen to fall short by.  */
#define BT__CHAIN_ERROR 2.5
double bt__chain_error (const bt__dynamic *chain);

/* The error in position of LINE, m: the common error of its nodes, a share of the upper estimate,
   the rest of the error with fewer nodes before, or the length by which the intervals differ from
   what is out since nodes came or went, whichever is largest; NAN if LINE has no chain.  */
#define BT__COMMON_ERROR 0.8
double bt__line_error (const bt__line *line);

/* The energies of tether I of STATE, a moving line, of both its parts.  */
bt_energy bt__line_energy (const bt_dive *dive, bt__state *state, int i);

/* Where end K of LINE is, 0 the anchor and 1 the far end; the force of LINE on what the end is
   fastened to, N.  */
bt_vec3 bt__line_end (const bt__line *line, int k);
bt_vec3 bt__line_pull (const bt__line *line, int k);

#endif
