/* Vehicles without mass: they go exactly where sticks, autopilots and measured tracks lead.

   A step turns the heading first: by the yaw stick, towards the target of a flight, or towards the
   held heading, at most at the yaw rate.  Sticks move the vehicle along the heading in the middle
   of the turn (the midpoint rule, so a circle stays a circle), with a held depth or altitude for
   the vertical part.  A target is approached straight at the given speed, a track followed linearly
   between its rows; arrival raises the event `arrived'.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/sim.h"
#include "world/obstacles.h"

enum
{
  SURGE,
  SWAY,
  HEAVE,
  YAW
};

/* ANGLE brought to [-pi, pi].  */
static double
wrapped (double angle)
{
  return remainder (angle, 2 * BT__PI);
}

/* WANTED limited to MOST either way.  */
static double
limited (double wanted, double most)
{
  return fmax (-most, fmin (most, wanted));
}

/* ---- Heading ---- */

static double
bearing (bt_vec3 from, bt_vec3 to)
{
  return atan2 (to.x - from.x, to.y - from.y);
}

/* The turn of this step: toward what is faced or held, else as the stick says.  */
static double
turn_of_step (const bt__vehicle *v)
{
  double most = v->speeds[YAW] * BT__TIME_STEP;
  int faces = v->goal == BT__GOAL_FLY
              && hypot (v->target.x - v->position.x, v->target.y - v->position.y) > 0.05;
  if (v->sticks[YAW] != 0)
    return v->sticks[YAW] * most;
  if (faces)
    return limited (wrapped (bearing (v->position, v->target) - v->heading), most);
  if (v->hold_heading.on)
    return limited (wrapped (v->hold_heading.value - v->heading), most);
  return 0;
}

/* ---- Position ---- */

/* The vertical part, m, of this step towards the held depth or altitude; an altitude is measured at
   the end of the LEVEL part of the step.  */
static double
held_way (const bt_dive *dive, bt__state *state, const bt__vehicle *v, bt_vec3 level)
{
  double most = v->speeds[HEAVE] * BT__TIME_STEP;
  if (v->hold_depth.on)
    return limited (-v->hold_depth.value - v->position.z, most);
  if (!(v->pilot.holds & BT__HOLD_ALTITUDE))
    return 0;
  bt_vec3 there = bt__add (v->position, level);
  return limited (v->pilot.altitude - bt__dive_altitude (dive, state, there, NULL), most);
}

/* The way of this step by the sticks, heading in the middle of the turn.  */
static bt_vec3
stick_way (const bt_dive *dive, bt__state *state, const bt__vehicle *v, double heading)
{
  double ahead = v->sticks[SURGE] * v->speeds[SURGE] * BT__TIME_STEP;
  double aside = v->sticks[SWAY] * v->speeds[SWAY] * BT__TIME_STEP;
  double up = v->sticks[HEAVE] * v->speeds[HEAVE] * BT__TIME_STEP;
  bt_vec3 way = bt__vec (ahead * sin (heading) + aside * cos (heading),
                         ahead * cos (heading) - aside * sin (heading), 0);
  way.z = v->sticks[HEAVE] == 0 ? held_way (dive, state, v, way) : up;
  return way;
}

static void
arrive_at_goal (const bt_dive *dive, bt__state *state, bt__vehicle *v)
{
  v->goal = BT__GOAL_NONE;
  bt__raise_event (state, BT_EVENT_ARRIVED, (int)(v - bt__dive_vehicle (dive, state, 0)));
}

static bt_vec3
toward_target (const bt_dive *dive, bt__state *state, bt__vehicle *v)
{
  bt_vec3 way = bt__sub (v->target, v->position);
  double left = bt__norm (way), most = v->target_speed * BT__TIME_STEP;
  if (left > most)
    return bt__axpy (v->position, most / left, way);
  arrive_at_goal (dive, state, v);
  return v->target;
}

/* The row of TRACK at or before time T, by bisection from a guess: most tracks have even rows.  */
static int
row_at (const bt__track *track, double t)
{
  int low = 0, high = track->n - 1;
  double first = track->row[0][0], last = track->row[high][0];
  double guess = (t - first) / (last - first) * high;
  if (high > 1 && guess >= 1 && guess < high - 1)
    {
      int at = (int)guess; /* 1 to high - 2 */
      if (track->row[at - 1][0] <= t)
        low = at - 1;
      if (track->row[at + 2 < high ? at + 2 : high][0] > t)
        high = at + 2 < high ? at + 2 : high;
    }
  while (high - low > 1)
    {
      int middle = (low + high) / 2;
      if (track->row[middle][0] <= t)
        low = middle;
      else
        high = middle;
    }
  return low;
}

static bt_vec3
track_point (const bt__track *track, double t)
{
  int i = row_at (track, t);
  const double *p = track->row[i], *q = track->row[i + 1];
  double k = fmax (0, fmin (1, (t - p[0]) / (q[0] - p[0])));
  return bt__vec (p[1] + k * (q[1] - p[1]), p[2] + k * (q[2] - p[2]), p[3] + k * (q[3] - p[3]));
}

/* The time by its track of V, LATER steps after that of STATE.  */
static double
track_time (const bt_dive *dive, const bt__state *state, const bt__vehicle *v, int later)
{
  double t = (double)(state->step + later) * BT__TIME_STEP;
  return t - v->track_start + dive->tracks[v->track]->row[0][0];
}

static int
is_beyond (const bt__track *track, double t)
{
  return t >= track->row[track->n - 1][0];
}

static bt_vec3
along_track (const bt_dive *dive, bt__state *state, bt__vehicle *v)
{
  const bt__track *track = dive->tracks[v->track];
  double t = track_time (dive, state, v, 0);
  if (is_beyond (track, t))
    arrive_at_goal (dive, state, v);
  return track_point (track, t);
}

void
bt__move_vehicle (const bt_dive *dive, bt__state *state, int vehicle)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  double angle = turn_of_step (v);
  bt_vec3 from = v->position, to;
  switch (v->goal)
    {
    case BT__GOAL_POINT:
    case BT__GOAL_FLY:
      to = toward_target (dive, state, v);
      break;
    case BT__GOAL_TRACK:
      to = along_track (dive, state, v);
      break;
    default:
      to = bt__add (from, stick_way (dive, state, v, v->heading + angle / 2));
    }
  v->heading += angle;
  v->position = to;
  v->velocity = bt__scale (1 / BT__TIME_STEP, bt__sub (to, from));
}

/* True if V follows a track that does not end within STEPS steps; *TO is then where it comes to. */
static int
stays_on_track (const bt_dive *dive, const bt__state *state, const bt__vehicle *v, int steps,
                bt_vec3 *to)
{
  if (v->goal != BT__GOAL_TRACK)
    return 0;
  const bt__track *track = dive->tracks[v->track];
  double t = track_time (dive, state, v, steps);
  *to = track_point (track, t);
  return !is_beyond (track, t);
}

int
bt__foresee_vehicle (const bt_dive *dive, bt__state *state, int vehicle, int steps, bt_vec3 *to)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle), before = *v;
  int64_t step = state->step, events = state->events;
  int n = 0;
  if (stays_on_track (dive, state, v, steps, to))
    return steps;
  for (; n < steps && state->events == events; n++)
    {
      state->step++;
      bt__move_vehicle (dive, state, vehicle);
    }
  *to = v->position;
  n -= state->events != events;
  bt__forget_events (dive, state, events);
  state->step = step;
  *v = before;
  return n;
}

/* Those with mass are moved by forces (bodies.c).  */
void
bt__move_vehicles (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    if (!bt__dive_vehicle (dive, state, i)->rigid)
      bt__move_vehicle (dive, state, i);
}
