/* The windings of a tether, looked at twice a second for the events `wrapped' and `freed'.

   A line passes through nothing, so only motion of the ends can change its windings: while both
   ends rest there is no look.  After motion of an end, the line itself and the last known way home
   mostly suffice to prove the windings unchanged; otherwise the question is asked in full.  The
   taut string becomes shorter by at most the motion of the ends.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "world/line.h"
#include "world/obstacles.h"
#include "world/watch.h"

enum
{
  LOOK_EVERY = 30 /* steps */
};

/* Note the places of the ends of tether I; return true if the ends have moved, or the enabled
   obstacles have changed, since the last note.  */
static int
has_moved (const bt_dive *dive, bt__subject *subject, int i)
{
  bt__line line = bt__line_of (dive, dive->now, i);
  bt_vec3 ends[2] = { bt__line_node (&line, 0), bt__line_node (&line, bt__line_nodes (&line) - 1) };
  if (subject->looked && subject->then == subject->version
      && memcmp (ends, subject->seen, sizeof ends) == 0)
    return 0;
  memcpy (subject->seen, ends, sizeof ends);
  subject->then = subject->version;
  return 1;
}

/* Note the present windings of tether I of DIVE, and raise the events unless SILENT.  */
static bt_status
tell_windings (bt_dive *dive, int i, bt__subject *subject, int8_t *told, int silent,
               bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_wind (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  subject->string = g->has_taut ? g->taut_length : 0;
  memcpy (subject->there, subject->seen, sizeof subject->there);
  for (int k = 0; k < dive->model->n_obstacles; k++)
    {
      int8_t now = bt__told (g->wound[k]);
      int more = (now > 0 ? now : -now) > (told[k] > 0 ? told[k] : -told[k]);
      if (!silent && more)
        bt__raise_event_at (dive->now, BT_EVENT_WRAPPED, BT_PART_TETHER, i, k);
      else if (!silent && now == 0 && told[k] != 0)
        bt__raise_event_at (dive->now, BT_EVENT_FREED, BT_PART_TETHER, i, k);
      if (told[k] != now)
        bt__pairs_change (dive);
      told[k] = now;
    }
  return BT_OK;
}

/* A failed look, such as for want of memory, tells nothing; an interrupted look is reported.  */
bt_status
bt__note_windings (bt_dive *dive, bt_error *error)
{
  bt_status status = BT_OK;
  if (dive->now->step % LOOK_EVERY != 0)
    return BT_OK;
  for (int i = 0; i < dive->model->n_tethers && status != BT_ERR_INTERRUPTED; i++)
    {
      bt__subject *subject = bt__dive_subject (dive, dive->now, BT_PART_TETHER, i);
      int8_t *told = bt__dive_told (dive, dive->now, i);
      int first = !subject->looked, same = 0;
      if (!has_moved (dive, subject, i))
        continue;
      subject->looked = 1;
      status = bt__watch_berth (dive, i, &subject->berth, error);
      if (status != BT_OK)
        continue;
      subject->berthed = 1;
      status = bt__watch_wound_still (dive, i, &same, error);
      if (status == BT_OK && !same)
        status = tell_windings (dive, i, subject, told, first, error);
    }
  return status == BT_ERR_INTERRUPTED ? status : BT_OK;
}
