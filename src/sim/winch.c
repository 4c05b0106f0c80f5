/* The winch: pays out and hauls in at its rate, exactly as much as it was told, and stalls on a
   taut tether.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/sim.h"
#include "world/line.h"

/* What a winch pulls at most: N, and a share of what parts the line.  */
#define MOST_PULL 500.0
#define BREAKING_SHARE 0.5

/* Nonzero if tether I is a moving line with a vehicle at its end that it pulls along.  */
static int
draws_a_body (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  return vehicle >= 0 && bt__dive_vehicle (dive, state, vehicle)->rigid
         && bt__carrier (dive, state, vehicle) == i;
}

/* The shortest length of tether I that the pull of its vehicles still lets reach between its ends;
   a body is drawn along.  */
static double
shortest (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends ends = bt__tether_ends (dive, state, i);
  double pull = bt__pull_on (dive, state, i);
  if (draws_a_body (dive, state, i))
    return 0;
  return bt__distance (ends.a, ends.b) / bt__longest_chord (&tether->props, 1, pull);
}

/* Nonzero if the winch of tether I, which draws a body along, pulls as hard as it can.  */
static int
is_overloaded (const bt_dive *dive, bt__state *state, int i)
{
  bt__line line = bt__line_of (dive, state, i);
  double most = fmin (MOST_PULL, BREAKING_SHARE * line.tether->props.breaking_load);
  return draws_a_body (dive, state, i) && bt__line_tension (&line, 0) > most;
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
  if (tether->winch_rate < 0 && is_overloaded (dive, state, i))
    {
      stop (state, tether, i, BT_EVENT_STALLED);
      return;
    }
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
