/* A tether is stuck if the line is pulled and its end has hardly moved for a while.

   The speed of the end is the mean over the last 5 to 6 s.  A shorter mean would see the trembling
   of a body that comes to rest on a taut line; a creeping end leaves its place all the same.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "world/line.h"

/* Limits of hardly moving, and of a pull, N.  */
#define SLOW 0.02 /* m/s */
#define PULL 1.0

/* True if a winch hauls at the rest of tether I, parted.  */
static int
is_pulled_parted (const bt_dive *dive, bt__state *state, int i)
{
  bt__line line = bt__line_of (dive, state, i);
  return line.tether->winch_rate < 0 && bt__line_tension (&line, 0) > PULL;
}

/* The force on what the far end of tether I is fastened to, N.  */
static bt_vec3
pull_of (const bt_dive *dive, bt__state *state, int i)
{
  if (bt__is_ahead (bt__dive_tether (dive, state, i)))
    return bt__pull_within (dive, state, i, 1);
  bt__line line = bt__line_of (dive, state, i);
  return bt__line_pull (&line, 1);
}

/* True if somebody at the far end of tether I, or its winch, pulls.  */
static int
is_pulled (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  int vehicle = dive->model->ends[i][1].vehicle;
  const bt__vehicle *v = vehicle < 0 ? NULL : bt__dive_vehicle (dive, state, vehicle);
  int wants = v
              && (v->goal != BT__GOAL_NONE || v->sticks[0] != 0 || v->sticks[1] != 0
                  || v->sticks[2] != 0);
  if (tether->parted)
    return is_pulled_parted (dive, state, i);
  return (wants || tether->winch_rate < 0) && bt__norm (pull_of (dive, state, i)) > PULL;
}

/* Where tether I, with ends at ENDS, ends; a parted tether, where it has parted.  */
static bt_vec3
end_of_line (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  if (!bt__dive_tether (dive, state, i)->parted)
    return ends->b;
  bt__line line = bt__line_of (dive, state, i);
  return bt__line_node (&line, bt__line_nodes (&line) - 1);
}

/* True if TETHER, pulled for a while and its end at HERE, hardly moves.  */
static int
hardly_moves (const bt__tether *tether, bt_vec3 here)
{
  int64_t then = (tether->pulled - BT__STUCK_AFTER) / BT__STUCK_EVERY;
  double seconds = (double)(tether->pulled - then * BT__STUCK_EVERY) * BT__TIME_STEP;
  return tether->pulled >= BT__STUCK_AFTER
         && bt__distance (here, tether->was[then % BT__STUCK_PLACES]) < SLOW * seconds;
}

static void
look_at_end (bt__state *state, bt__tether *tether, bt_vec3 here, int i)
{
  int was_stuck = tether->stuck != 0;
  if (tether->pulled % BT__STUCK_EVERY == 0)
    tether->was[tether->pulled / BT__STUCK_EVERY % BT__STUCK_PLACES] = here;
  tether->stuck = hardly_moves (tether, here);
  tether->pulled++;
  if (tether->stuck && !was_stuck)
    bt__raise_event (state, BT_EVENT_STUCK, i);
}

void
bt__note_stuck (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  if (is_pulled (dive, state, i))
    look_at_end (state, tether, end_of_line (dive, state, i, ends), i);
  else
    tether->pulled = tether->stuck = 0;
}

void
bt__note_all_stuck (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__ends ends = bt__tether_ends (dive, state, i);
      bt__note_stuck (dive, state, i, &ends);
    }
}
