/* The persistent contacts of sliding nodes: whether a node bears, its load, drag and work.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

enum
{
  PATIENCE = 6, /* steps: for so long a slack line is held, ... */
  AT_ONCE = 1   /* ... and about an edge */
};

/* True if the I-th node held and the next are of one member.  */
static int
is_followed (const bt__line_job *k, int i)
{
  if (i < 0 || i + 1 >= k->bents)
    return 0;
  const bt__dynamic_bent *b = k->w->bent + i;
  return b[0].node + 1 == b[1].node && bt__bend_goes_on (k->w->bend + i, k->w->bend + i + 1);
}

/* A line slack for a moment and not drawn off will bear at the same node again; about a wire it is
   soon held again anyway.  */
static int
is_slack (const bt__line_job *k, int i)
{
  const bt__dynamic_bent *b = k->w->bent + i;
  const bt__contact *a = k->w->bend + i;
  int is_thin = bt__edge_is_thin (k, a->thick);
  int patience = !is_thin ? PATIENCE : a->bent == BT__BENT_ROUND ? 0 : AT_ONCE;
  return a->age < patience && fmax (b->pull[0], b->pull[1]) < BT__LINE_SLIGHT;
}

int
bt__bend_bears (const bt__line_job *k, int i)
{
  int first = i, last = i;
  while (is_followed (k, first - 1))
    first--;
  while (is_followed (k, last))
    last++;
  for (int q = first; q <= last; q++)
    if (k->w->bent[q].load > 0 || is_slack (k, q))
      return 1;
  return 0;
}

bt__contact
bt__line_bent_anchor (const bt__line_job *k, int i)
{
  const bt__dynamic_bent *b = k->w->bent + i;
  bt__contact a = k->w->bend[i];
  double drag = b->drag + b->flow, side = b->side_now, size = hypot (drag, side);
  double keep = size > BT__LINE_SLIP ? BT__LINE_SLIP / size : 1;
  double pull = fabs (b->pull[1] - b->pull[0]), slid = drag - a.drag;
  a.state = size > BT__LINE_SLIP ? BT__TOUCH_SLIDE : BT__TOUCH_STICK;
  a.step_work = (1 - keep) * (pull * fabs (drag) + b->friction * b->load * fabs (side));
  a.work += a.step_work;
  a.drag = keep * drag;
  a.side = keep * side;
  a.flow = b->flow / k->h;
  a.speed = hypot (slid, side - b->side) / k->h;
  a.load = b->load;
  a.age = b->load > 0 ? 0 : a.age + 1;
  a.force = b->force;
  a.from_end = k->w->from_end[b->node] + b->flow;
  a.stick = bt__vec (0, 0, 0);
  return a;
}
