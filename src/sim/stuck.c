/* Is a tether stuck: it is pulled, and its vehicle has hardly moved for a while.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "world/line.h"

/* What hardly moving is, and what a pull, N.  */
#define SLOW 0.02 /* m/s */
#define PULL 1.0

/* A parted line is stuck where its winch hauls and its new end stays.  */
static int
stands_parted (const bt_dive *dive, bt__state *state, int i)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  bt__line line = bt__line_of (dive, state, i);
  return bt__dive_tether (dive, state, i)->winch_rate < 0 && bt__line_tension (&line, 0) > PULL
         && bt__norm (bt__dynamic_v (chain)[chain->n]) < SLOW;
}

/* Nonzero if somebody at the far end of tether I, or its winch, pulls.  */
static int
is_pulled (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  int vehicle = dive->model->ends[i][1].vehicle;
  const bt__vehicle *v = vehicle < 0 ? NULL : bt__dive_vehicle (dive, state, vehicle);
  bt__line line = bt__line_of (dive, state, i);
  int wants = v
              && (v->goal != BT__GOAL_NONE || v->sticks[0] != 0 || v->sticks[1] != 0
                  || v->sticks[2] != 0);
  return (wants || tether->winch_rate < 0) && bt__norm (bt__line_force (&line)) > PULL;
}

static int
hardly_moves (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  if (vehicle < 0)
    return 1;
  return bt__distance (bt__dive_vehicle (dive, state, vehicle)->position,
                       bt__dive_vehicle (dive, dive->now, vehicle)->position)
         < SLOW * BT__TIME_STEP;
}

void
bt__note_stuck (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__tether *tether = bt__dive_tether (dive, state, i);
      int stands = tether->parted ? stands_parted (dive, state, i)
                                  : hardly_moves (dive, state, i) && is_pulled (dive, state, i);
      tether->caught = stands ? tether->caught + 1 : 0;
      if (tether->caught == BT__STUCK_AFTER)
        bt__raise_event (state, BT_EVENT_STUCK, i);
    }
}
