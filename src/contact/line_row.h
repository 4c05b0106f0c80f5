/* Contact constraints in the making: shared by the files that find half-spaces.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_LINE_ROW_H
#define BT_CONTACT_LINE_ROW_H

#include "contact/line_job.h"

#define BT__ROW_NEAREST 0.01 /* of the radius: an end that is so little farther is as near */
#define BT__ROW_TURNED 0.9   /* of two normals: the least product of one that turned */

/* Link J against NEAR, in its frame: as the step starts, and as it is expected to end.  */
typedef struct bt__pass
{
  const bt__near *near;
  bt__link from, to;
} bt__pass;

bt__pass bt__row_pass (const bt__line_job *k, uint32_t j, const bt__near *near);

/* True if LINK lies along the plane of W.  */
int bt__row_lies_along (const bt__line_job *k, const bt__link *link, const bt__witness *w);

/* Set the constraint NUMBER: the place S of link J is pushed off NEAR, by the closest points W in
   the frame of NEAR; START is the distance at the start of the step.  */
void bt__row_set (bt__line_job *k, int number, uint32_t j, double s, const bt__near *near,
                  const bt__witness *w, double start);

/* Take the constraint just set.  Of two like constraints the lower stays, or the constraint at a
   node: else the two would change places with every step.  */
void bt__row_take (bt__line_job *k, int flat);

/* Add the constraint at the place of link J nearest to the part of P, of RADIUS along the link, m.
 */
void bt__row_between (bt__line_job *k, uint32_t j, const bt__pass *p, double radius);

/* line_facet.c: what triangle NEAR of a mesh gives link J.  */
void bt__row_facet (bt__line_job *k, uint32_t j, const bt__near *near);

#endif
