/* The winch: pays out and hauls in at its rate, by exactly the ordered length, and stalls if the
   line pulls with the winch's greatest pull.

   This file turns the drum.  A static line follows at once; a moving line follows in its own step,
   with a lag and by force (chain_step.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "world/line.h"

/* The default pull of a winch: N, and at most a share of the breaking load.  */
#define USUAL_PULL 500.0
#define BREAKING_SHARE 0.5

#define MOST_OUT 1e6 /* m */

double
bt__winch_pull (const bt_tether_props *props)
{
  return props->winch_pull != BT_WINCH_AUTO
             ? props->winch_pull
             : fmin (USUAL_PULL, BREAKING_SHARE * props->breaking_load);
}

double
bt__most_out (const bt_dive *dive, bt__state *state, int i)
{
  return fmin (dive->model->tethers[i].drum - bt__beyond_chain (dive, state, i), MOST_OUT);
}

/* True if tether I is a moving line drawing along the vehicle at its end.  */
static int
draws_a_body (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  return vehicle >= 0 && bt__dive_vehicle (dive, state, vehicle)->rigid
         && bt__carrier (dive, state, vehicle) == i;
}

/* What the ends of tether I hold against: the pull of its vehicles, or, between points, anything.
 */
static double
held_with (const bt_dive *dive, bt__state *state, int i)
{
  const bt__end *end = dive->model->ends[i];
  return end[0].vehicle < 0 && end[1].vehicle < 0 ? INFINITY : bt__pull_on (dive, state, i);
}

/* The shortest length, m, of tether I for the distance of its ends under the pulls of winch and
   vehicles; 0 if the line draws a body or a free end along.  */
static double
shortest (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends ends = bt__tether_ends (dive, state, i);
  double pull = fmin (held_with (dive, state, i), bt__winch_pull (&tether->props));
  if (tether->parted || draws_a_body (dive, state, i))
    return 0;
  return bt__distance (ends.a, ends.b) / bt__longest_chord (&tether->props, 1, pull);
}

/* True if LINE, a static shape, pulls harder than its winch can; for a moving line the step itself
   decides.  */
static int
is_overloaded (const bt__line *line)
{
  return !bt__is_cable (line->tether)
         && bt__line_tension (line, 0) > bt__winch_pull (&line->tether->props);
}

static void
stop (bt__state *state, bt__tether *tether, int i, bt_event_kind why)
{
  tether->winch_rate = 0;
  tether->stalling = 0;
  bt__raise_event (state, why, i);
}

void
bt__stall_winch (bt__state *state, bt__tether *tether, int i, double length)
{
  tether->length = length;
  stop (state, tether, i, BT_EVENT_STALLED);
}

/* Stop, for WHY, with LENGTH out; a moving line has yet to follow.  */
static void
stop_at (const bt_dive *dive, bt__state *state, int i, double length, bt_event_kind why)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__line line;
  tether->length = length;
  line = bt__line_of (dive, state, i);
  if (bt__line_has_followed (&line))
    stop (state, tether, i, why);
}

static void
haul_in (const bt_dive *dive, bt__state *state, int i, double length)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__line line = bt__line_of (dive, state, i);
  double floor = fmin (tether->length, shortest (dive, state, i));
  if (is_overloaded (&line))
    bt__stall_winch (state, tether, i, bt__line_out (&line));
  else if (fmax (length, tether->winch_target) < floor)
    stop_at (dive, state, i, floor, BT_EVENT_STALLED);
  else if (length <= tether->winch_target)
    stop_at (dive, state, i, tether->winch_target, BT_EVENT_SPOOLED);
  else
    tether->length = length;
}

/* Set the paid-out length of tether I to LENGTH; a moving line that drew more off the drum keeps
   the greater length.  */
static void
pay (const bt_dive *dive, bt__state *state, int i, double length)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  if (length >= tether->winch_target)
    stop_at (dive, state, i, fmax (tether->length, tether->winch_target), BT_EVENT_SPOOLED);
  else
    tether->length = length;
}

void
bt__stall_where_held (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__tether *tether = bt__dive_tether (dive, state, i);
      int held = 0;
      for (int k = 0; k < 2; k++)
        {
          int vehicle = dive->model->ends[i][k].vehicle;
          held |= vehicle >= 0 && bt__pinned (dive, vehicle);
        }
      if (held && tether->winch_rate < 0 && !bt__is_moving_model (tether))
        bt__stall_winch (state, tether, i, tether->length);
    }
}

void
bt__turn_winches (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__tether *tether = bt__dive_tether (dive, state, i);
      double speed = fmin (fabs (tether->winch_rate), tether->props.winch_rate);
      if (tether->winch_rate < 0)
        haul_in (dive, state, i, tether->length - speed * BT__TIME_STEP);
      else if (tether->winch_rate > 0)
        pay (dive, state, i, tether->length + speed * BT__TIME_STEP);
    }
}
