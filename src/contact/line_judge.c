/* What the contacts of a moving line may be when they come from outside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "collide/mesh.h"
#include "contact/line.h"

/* An edge that has just been met again has an infinite LAG: nothing of it is gone round yet.  */
static const bt__member anchor[] = {
  BT__INDEX (bt__anchor, object, 0, BT__BELOW_OBJECTS),
  BT__WITHIN (bt__anchor, triangle, -1, UINT32_MAX),
  BT__INDEX (bt__anchor, mover, BT__ANCHOR_LINE, BT__BELOW_MOVERS),
  BT__WITHIN (bt__anchor, state, BT__TOUCH_STICK, BT__TOUCH_SLIDE),
  BT__WITHIN (bt__anchor, from_end, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, load, 0, BT__HUGE),
  BT__WITHIN (bt__anchor, work, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__anchor, step_work, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__anchor, speed, 0, BT__HUGE),
  BT__WITHIN (bt__anchor, point, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, normal, -2, 2),
  BT__WITHIN (bt__anchor, force, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__anchor, stick, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__anchor, age, 0, BT__MANY),
  BT__WITHIN (bt__anchor, bent, BT__BENT_NOT, BT__BENT_ROUND),
  BT__WITHIN (bt__anchor, drag, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, side, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, flow, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__anchor, thick, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, span, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, axis, -2, 2),
  BT__WITHIN (bt__anchor, held, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, away, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__anchor, lag, -BT__FAR, INFINITY),
  BT__WITHIN (bt__anchor, after, -2, 2),
  BT__WITHIN (bt__anchor, unsolved, 0, BT__MANY),
  BT__WITHIN (bt__anchor, other, -BT__FAR, BT__FAR),
};
const bt__record bt__anchor_record = BT__RECORD (bt__anchor, "contact", anchor);

static const bt__member anchors[] = {
  BT__WITHIN (bt__anchors, n, 0, BT__MANY),
  BT__WITHIN (bt__anchors, room, 0, BT__MANY),
};
const bt__record bt__anchors_record = BT__RECORD (bt__anchors, "contacts", anchors);

/* They are sought by their place, from node 0 to node n.  */
static int
are_in_order (const bt__anchors *a)
{
  const bt__anchor *at = bt__anchors_at (a);
  int64_t i = 1;
  while (i < a->n && at[i - 1].from_end >= at[i].from_end)
    i++;
  return i >= a->n;
}

bt_status
bt__anchors_judge (bt__judge *judge, const bt__anchors *a, int room)
{
  bt_status status = bt__judge_records (judge, &bt__anchors_record, a, 1);
  if (status == BT_OK)
    status = bt__judge_count (judge, "contacts of room", a->room, room, room);
  if (status == BT_OK)
    status = bt__judge_count (judge, "contacts", a->n, 0, room);
  if (status == BT_OK)
    status = bt__judge_records (judge, &bt__anchor_record, bt__anchors_at (a), (size_t)a->n);
  if (status == BT_OK)
    status
        = bt__judge_that (judge, are_in_order (a), "its contacts stand in the order of the line");
  return status;
}
