/* The values allowed in the contacts of a moving line from outside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "collide/mesh.h"
#include "contact/line.h"

/* An edge that has just been met again has an infinite LAG: nothing of it is gone round yet.  */
static const bt__member anchor[] = {
  BT__INDEX (bt__contact, object, 0, BT__BELOW_OBJECTS),
  BT__WITHIN (bt__contact, triangle, -1, UINT32_MAX),
  BT__INDEX (bt__contact, mover, BT__CONTACT_LINE, BT__BELOW_MOVERS),
  BT__WITHIN (bt__contact, state, BT__TOUCH_STICK, BT__TOUCH_SLIDE),
  BT__WITHIN (bt__contact, from_end, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, load, 0, BT__HUGE),
  BT__WITHIN (bt__contact, work, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__contact, step_work, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__contact, speed, 0, BT__HUGE),
  BT__WITHIN (bt__contact, point, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, normal, -2, 2),
  BT__WITHIN (bt__contact, force, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__contact, stick, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__contact, age, 0, BT__MANY),
  BT__WITHIN (bt__contact, bent, BT__BENT_NOT, BT__BENT_ROUND),
  BT__WITHIN (bt__contact, drag, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, side, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, flow, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__contact, thick, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, span, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, axis, -2, 2),
  BT__WITHIN (bt__contact, held, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, away, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, lag, -BT__FAR, INFINITY),
  BT__WITHIN (bt__contact, before, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, beyond, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__contact, after, -2, 2),
  BT__WITHIN (bt__contact, unsolved, 0, BT__MANY),
  BT__WITHIN (bt__contact, other, -BT__FAR, BT__FAR),
};
const bt__record bt__contact_record = BT__RECORD (bt__contact, "contact", anchor);

static const bt__member anchors[] = {
  BT__WITHIN (bt__contacts, n, 0, BT__MANY),
  BT__WITHIN (bt__contacts, room, 0, BT__MANY),
};
const bt__record bt__contacts_record = BT__RECORD (bt__contacts, "contacts", anchors);

/* They are sought by their place, from node 0 to node n.  */
static int
are_in_order (const bt__contacts *a)
{
  const bt__contact *at = bt__contacts_at (a);
  int64_t i = 1;
  while (i < a->n && at[i - 1].from_end >= at[i].from_end)
    i++;
  return i >= a->n;
}

bt_status
bt__contacts_judge (bt__judge *judge, const bt__contacts *a, int room)
{
  bt_status status = bt__judge_records (judge, &bt__contacts_record, a, 1);
  if (status == BT_OK)
    status = bt__judge_count (judge, "contacts of room", a->room, room, room);
  if (status == BT_OK)
    status = bt__judge_count (judge, "contacts", a->n, 0, room);
  if (status == BT_OK)
    status = bt__judge_records (judge, &bt__contact_record, bt__contacts_at (a), (size_t)a->n);
  if (status == BT_OK)
    status
        = bt__judge_that (judge, are_in_order (a), "its contacts stand in the order of the line");
  return status;
}
