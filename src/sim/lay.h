/* Laying a tether among obstacles: along corners between which the straight way is clear.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_LAY_H
#define BT_SIM_LAY_H

#include "contact/touch.h"
#include "sim/sim.h"

/* Put the corners of tether I on the dive's polyline, and their number in *N: the corners of its
   shape, except corners with a clear triangle to their neighbours; or, for a tether without shape,
   the world's line of lay to ENDS.  BT_ERR_DEF if a tether without shape and line of lay has no
   clear straight line to its vehicle.  */
bt_status bt__corners (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int *n,
                       bt_error *error);

/* True if nothing is between PART of the moving line of tether I and the N + 1 points on the dive's
   polyline, equally spaced along it.  */
int bt__may_remesh (bt_dive *dive, bt__state *state, int i, int part, int n);

/* The distance of LINK to the nearest obstacle AROUND, at most CAP; *NEAR receives the part of an
   obstacle nearer than CAP.  */
double bt__room_about (bt_dive *dive, const bt__surroundings *around, const bt__link *link,
                       double cap, bt__near *near);

/* The farthest that a point of PART of tether I goes, m, if the part changes to the N intervals on
   the dive's polyline.  */
double bt__way_of_remesh (const bt_dive *dive, bt__state *state, int i, int part, int n);

/* Lead the N + 1 nodes X of tether I toward the points on the dive's polyline until the line has
   the length of the tether; *THERE: true if all nodes arrived (lay_way.c).  */
bt_status bt__lead_to_rest (bt_dive *dive, bt__state *state, int i, bt_vec3 *x, int n, int *there,
                            bt_error *error);

/* Lay aside on the bed all bights below the bed of the N + 1 points on the dive's polyline, the
   equilibrium of tether I without a bed; the line is then led from the clear WAY of as many points.
   Return true if there was a bight (lay_bed.c).  */
int bt__lay_on_bed (bt_dive *dive, bt__state *state, int i, const bt_vec3 *way, int n);

/* Let the moving line of tether I fall into place between ENDS, the clock standing (lay_fall.c). */
bt_status bt__fall (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error);

/* Let the moving line of tether I, laid at an equilibrium without bending in open water, come to
   rest between ENDS with its clamps and sets; a line that has neither stays (lay_settle.c).  */
bt_status bt__settle_bent (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                           bt_error *error);

/* Lay the moving line of tether I along its corners and let the line fall into place while the
   clock stands.  */
bt_status bt__lay_chain_among (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                               bt_error *error);

/* Take the ends of the moving line of tether I to ENDS through the water, as far as they come, the
   clock standing.  */
bt_status bt__drag_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                          bt_error *error);

#endif
