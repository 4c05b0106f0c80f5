/* Events of a moving line: snaps, kinks, loops; and whether the line rests.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/chain.h"

/* What counts as rest, m/s and m/s2, and as a snap: from below 1 N to above 25 N within half a
   second.  */
#define REST_SPEED 1e-4
#define REST_ACCELERATION 1e-3
#define SNAP_FROM 1.0
#define SNAP_TO 25.0
enum
{
  SNAP_STEPS = 30
};

void
bt__watch_tension (bt__state *state, bt__tether *tether, int i, double tension)
{
  if (tension < SNAP_FROM)
    tether->slack_at = state->step;
  else if (tension > SNAP_TO && tether->slack_at >= 0
           && state->step - tether->slack_at <= SNAP_STEPS)
    {
      bt__raise_event (state, BT_EVENT_SNAPPED, i);
      tether->slack_at = -1;
    }
}

/* Raise the event `hockled' if the twist of the line, put in by the vehicle's turns, is unstable:
   T < M^2/(4 EI) - pi^2 EI/L^2 with the torque M (Greenhill 1883).  */
void
bt__watch_twist (const bt_dive *dive, bt__state *state, bt__tether *tether, int i)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  int vehicle = dive->model->ends[i][1].vehicle;
  double turn, torque, most, least = INFINITY, ei = tether->props.ei, length = tether->length;
  if (tether->props.gj == 0 || ei == 0 || vehicle < 0 || tether->parted)
    return;
  turn = bt__dive_vehicle (dive, state, vehicle)->heading
         - bt__dive_vehicle (dive, state, vehicle)->heading0;
  torque = chain->gripped ? chain->torque[1] : tether->props.gj * turn / length;
  most = torque * torque / (4 * ei) - BT__PI * BT__PI * ei / (length * length);
  for (int64_t j = 0; j < chain->n; j++)
    least = fmin (least, bt__dynamic_tension (chain)[j]);
  if (least < most && !tether->hockled)
    bt__raise_event (state, BT_EVENT_HOCKLED, i);
  tether->hockled = least < most;
}

static void
note_kink (bt__state *state, bt__tether *tether, int i, double radius)
{
  int kinked = radius < tether->props.min_bend_radius;
  if (kinked && !tether->kinked)
    bt__raise_event (state, BT_EVENT_KINKED, i);
  tether->kinked = kinked;
}

/* True if the vehicle carried by tether I rests, and no other tether that may move is fastened to
   the vehicle.  */
static int
vehicle_rests (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = bt__carried_vehicle (dive, state, i);
  const bt__rigid *now, *before;
  if (vehicle < 0)
    return 1;
  for (int k = 0; k < dive->model->n_tethers; k++)
    if (k != i
        && (dive->model->ends[k][0].vehicle == vehicle
            || dive->model->ends[k][1].vehicle == vehicle))
      return 0;
  now = &bt__dive_vehicle (dive, state, vehicle)->body;
  before = &bt__dive_vehicle (dive, dive->now, vehicle)->body;
  return bt__norm (now->velocity) < REST_SPEED && bt__norm (now->spin) < REST_SPEED
         && bt__distance (now->velocity, before->velocity) < REST_ACCELERATION * BT__TIME_STEP
         && bt__distance (now->spin, before->spin) < REST_ACCELERATION * BT__TIME_STEP;
}

static void
note_rest (const bt_dive *dive, bt__state *state, bt__tether *tether, int i,
           const bt__dynamic_report *report)
{
  int rests = report->speed < REST_SPEED && report->acceleration < REST_ACCELERATION
              && vehicle_rests (dive, state, i);
  tether->quiet = rests ? tether->quiet + 1 : 0;
  tether->settled = report->speed < 1e-3;
}

void
bt__watch_step (const bt_dive *dive, bt__state *state, bt__tether *tether, int i,
                const bt__dynamic_report *report)
{
  note_rest (dive, state, tether, i, report);
  bt__watch_tension (state, tether, i, report->tension);
  note_kink (state, tether, i, report->bend_radius);
}
