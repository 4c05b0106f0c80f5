/* The winch: pays out and hauls in at its rate, exactly as much as it was told, and stalls on a
   taut tether.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/sim.h"

/* The shortest length of tether I that the pull of its vehicles still lets reach between its ends.
 */
static double
shortest (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends ends = bt__tether_ends (dive, state, i);
  double pull = bt__pull_on (dive, state, i);
  return bt__distance (ends.a, ends.b) / bt__longest_chord (&tether->props, 1, pull);
}

static void
stop (bt__state *state, bt__tether *tether, int i, bt_event_kind why)
{
  tether->winch_rate = 0;
  bt__raise_event (state, why, i);
}

static void
turn_winch (const bt_dive *dive, bt__state *state, int i)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  double length = tether->length + tether->winch_rate * BT__TIME_STEP;
  int past
      = tether->winch_rate > 0 ? length >= tether->winch_target : length <= tether->winch_target;
  double floor = tether->winch_rate < 0 ? fmin (tether->length, shortest (dive, state, i)) : 0;
  if (past)
    length = tether->winch_target;
  if (length < floor)
    {
      tether->length = floor;
      stop (state, tether, i, BT_EVENT_STALLED);
      return;
    }
  tether->length = length;
  if (past)
    stop (state, tether, i, BT_EVENT_SPOOLED);
}

void
bt__turn_winches (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (bt__dive_tether (dive, state, i)->winch_rate != 0)
      turn_winch (dive, state, i);
}
