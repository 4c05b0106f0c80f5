/* The static models that know no contact: their shape is the wish, the polyline what comes of it.

   It moves there as far as all of it can; then it stops, and its vehicle with it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_HELD_H
#define BT_CONTACT_HELD_H

#include "contact/polyline.h"
#include "tether/shape.h"

typedef struct bt__held_report
{
  bt_vec3 a, b;             /* where the ends really are */
  double share;             /* of the last move that was taken */
  int held;                 /* an obstacle stopped it */
  int64_t object, triangle; /* that one's id, or -1 */
} bt__held_report;

/* Move LINE to SHAPE (NODES and TENSIONS as solved with it).  */
void bt__held_step (bt__polyline *line, const bt__way *way, const bt__shape *shape,
                    const bt_vec3 *nodes, const bt_vec3 *tensions, bt__held_report *report);

/* Fill TOUCH, of ROOM, with where LINE, of DIAMETER m, touches: one for each obstacle; return how
   many.  Nothing is known of forces.  */
int bt__held_touches (const bt__polyline *line, const bt__way *way, double diameter,
                      bt__touch *touch, int room);

#endif
