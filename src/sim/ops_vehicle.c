/* Operations on a vehicle: drive, place, fly, hold, follow a track, faults.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/ops.h"
#include "world/hull.h"
#include "world/obstacles.h"

static bt__vehicle *
called_vehicle (const bt__call *c)
{
  return bt__dive_vehicle (c->dive, c->state, c->subject);
}

bt_status
bt__op_drive (const bt__call *c)
{
  static const char *const names[] = { "surge", "sway", "heave", "yaw" };
  bt__vehicle *v = called_vehicle (c);
  for (int i = 0; i < 4; i++)
    if (!isnan (c->args[i]) && bt__check_range (c, i, names[i], -1, 1) != BT_OK)
      return BT_ERR_DOMAIN;
  for (int i = 0; i < 4; i++)
    if (!isnan (c->args[i]))
      v->sticks[i] = c->args[i];
  v->goal = BT__GOAL_NONE; /* hands on the sticks end a flight to a place */
  v->pilot.holds &= ~(int64_t)BT__HOLD_WAYPOINT;
  return BT_OK;
}

bt_status
bt__op_release (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  memset (v->sticks, 0, sizeof v->sticks);
  v->goal = BT__GOAL_NONE;
  v->hold_heading.on = v->hold_depth.on = 0;
  v->pilot.holds &= BT__HOLD_LEVEL;
  memset (v->pilot.sum, 0, sizeof v->pilot.sum);
  return BT_OK;
}

bt_status
bt__op_stabilise (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  if (c->args[0] != 0)
    v->pilot.holds |= BT__HOLD_LEVEL;
  else
    v->pilot.holds &= ~(int64_t)BT__HOLD_LEVEL;
  return BT_OK;
}

/* Thruster NUMBER of the subject dies, or lives again.  */
static bt_status
break_thruster (const bt__call *c, int on, double number)
{
  int n = (int)c->dive->model->types[c->subject].n;
  bt__vehicle *v = called_vehicle (c);
  if (!v->rigid || !(number >= 0 && number < n) || number != floor (number))
    return bt__fail (c->error, BT_ERR_DOMAIN, "`%s' has %d thrusters, counted from 0, and no %g",
                     c->dive->model->vehicles[c->subject].name, v->rigid ? n : 0, number);
  v->lost = on ? v->lost | (int64_t)1 << (int)number : v->lost & ~((int64_t)1 << (int)number);
  return BT_OK;
}

bt_status
bt__op_fault (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  int64_t fault = c->args[0] >= 1 && c->args[0] <= BT_FAULT_THRUSTER ? (int64_t)c->args[0] : 0;
  int on = c->args[1] != 0;
  if (!bt_fault_name ((bt_fault)fault))
    return bt__fail (c->error, BT_ERR_NAME, "there is no fault number %g", c->args[0]);
  if (bt__check_range (c, 2, "the value of a fault", -1e6, 1e6) != BT_OK)
    return BT_ERR_DOMAIN;
  if (fault == BT_FAULT_THRUSTER)
    return break_thruster (c, on, c->args[2]);
  if (fault == BT_FAULT_COMPASS && on)
    {
      v->instruments.drift = c->args[2];
      v->instruments.since = bt__state_time (c->state);
    }
  if (fault == BT_FAULT_DEPTH && on)
    v->instruments.frozen = -v->position.z;
  v->instruments.faults = on ? v->instruments.faults | fault : v->instruments.faults & ~fault;
  return BT_OK;
}

static void
stand_at (bt__vehicle *v, bt_vec3 p)
{
  bt__put_vehicle (v, p, 0);
  v->goal = BT__GOAL_NONE;
  v->pilot.holds &= ~(int64_t)(BT__HOLD_WAYPOINT | BT__HOLD_POSITION);
}

/* Put the subject at P, or as far towards P as its tethers allow.  */
static void
place_at (const bt__call *c, bt_vec3 p)
{
  bt__vehicle *v = called_vehicle (c);
  double k = bt__reach_along (c->dive, c->state, c->subject, v->position, p);
  bt_vec3 to = k < 1 ? bt__axpy (v->position, k, bt__sub (p, v->position)) : p;
  stand_at (v, to);
  bt__hold_at_tethers (c->dive, c->dive->now, c->state);
  v->held = bt__distance (to, p) > 0;
}

bt_status
bt__op_place (const bt__call *c)
{
  if (bt__check_point (c) != BT_OK)
    return BT_ERR_DOMAIN;
  place_at (c, bt__point_of (c));
  return BT_OK;
}

/* BT_ERR_DOMAIN if the hull of the subject, where it stands now, is in an obstacle.  */
static bt_status
check_hull (const bt__call *c)
{
  const bt__vehicle *v = called_vehicle (c);
  bt__frame frame = bt__vehicle_frame (v);
  bt__surroundings around = bt__standing (c->dive, c->state, BT_PART_VEHICLE, c->subject);
  bt__hull_body hull;
  bt__stop stop;
  bt__hull_of (&c->dive->model->vehicles[c->subject], &hull);
  if (!bt__body_nearest (&hull.body, &frame, BT__HULL_GAP, around.scene, around.on, around.mover,
                         around.movers, &stop, &c->dive->contact_work.count))
    return BT_OK;
  return bt__fail (c->error, BT_ERR_DOMAIN, "`%s' cannot be put at (%g %g %g): `%s' is there",
                   c->dive->model->vehicles[c->subject].name, v->position.x, v->position.y,
                   v->position.z,
                   c->dive->model->obstacles[bt__stop_obstacle (c->dive->model, &stop)].name);
}

/* True if tether I is one that the world fastens to the subject.  */
static int
is_of_subject (const bt__call *c, int i)
{
  const bt__end *end = c->dive->model->ends[i];
  return end[0].vehicle == c->subject || end[1].vehicle == c->subject;
}

/* What is left of a parted line is not fastened to the subject, and so is not laid to it.  */
static bt_status
check_whole (const bt__call *c)
{
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    if (is_of_subject (c, i) && bt__dive_tether (c->dive, c->state, i)->parted)
      return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                       "tether `%s' has parted: what is left of it is not laid anew",
                       c->dive->model->tethers[i].name);
  return BT_OK;
}

/* Lay tether I anew if it is fastened to the subject.  */
static void
forget_shape (const bt__call *c, int i)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, i);
  if (!is_of_subject (c, i))
    return;
  memset (&tether->memory, 0, sizeof tether->memory);
  memset (&tether->shape, 0, sizeof tether->shape);
  tether->contact_form = BT__TETHER_SHAPE;
  tether->relaid = tether->stale = 1;
}

bt_status
bt__op_lay (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  bt_vec3 p;
  if (bt__check_point (c) != BT_OK)
    return BT_ERR_DOMAIN;
  if (check_whole (c) != BT_OK)
    return BT_ERR_UNSUPPORTED;
  p = bt__point_of (c);
  if (bt__reach_along (c->dive, c->state, c->subject, v->position, p) < 1)
    return bt__fail (c->error, BT_ERR_DOMAIN, "the tether does not reach to (%g %g %g)", p.x, p.y,
                     p.z);
  stand_at (v, p);
  if (bt__has_obstacles (c->dive) && check_hull (c) != BT_OK)
    return BT_ERR_DOMAIN;
  bt__hold_at_tethers (c->dive, c->dive->now, c->state);
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    forget_shape (c, i);
  return BT_OK;
}

/* Let the autopilot of one with mass hold KIND instead of all of INSTEAD.  */
static void
hold_instead (bt__vehicle *v, int64_t kind, int64_t instead)
{
  v->pilot.holds = (v->pilot.holds & ~instead) | kind;
}

static void
keep_heading (bt__vehicle *v, double heading)
{
  v->pilot.heading = heading;
  v->pilot.holds |= BT__HOLD_HEADING;
}

static bt_status
go_to_goal (const bt__call *c, bt__goal goal)
{
  bt__vehicle *v = called_vehicle (c);
  if (bt__check_point (c) != BT_OK || bt__check_range (c, 3, "a speed in m/s", 1e-6, 1000) != BT_OK)
    return BT_ERR_DOMAIN;
  v->goal = goal;
  v->target = bt__point_of (c);
  v->target_speed = c->args[3];
  memset (v->sticks, 0, v->rigid ? sizeof v->sticks : 0);
  v->pilot.place = v->target;
  v->pilot.speed = v->target_speed;
  hold_instead (v, goal == BT__GOAL_FLY ? BT__HOLD_WAYPOINT : BT__HOLD_POSITION,
                BT__HOLD_WAYPOINT | BT__HOLD_POSITION);
  if (v->rigid && !(v->pilot.holds & BT__HOLD_HEADING))
    keep_heading (v, v->heading);
  return BT_OK;
}

bt_status
bt__op_move (const bt__call *c)
{
  return go_to_goal (c, BT__GOAL_POINT);
}

bt_status
bt__op_fly_to (const bt__call *c)
{
  return go_to_goal (c, BT__GOAL_FLY);
}

bt_status
bt__op_hold_heading (const bt__call *c)
{
  bt_status status = bt__check_range (c, 0, "a heading in radians", -1e6, 1e6);
  if (status != BT_OK)
    return status;
  called_vehicle (c)->hold_heading = (bt__hold){ 1, c->args[0] };
  keep_heading (called_vehicle (c), c->args[0]);
  return BT_OK;
}

bt_status
bt__op_hold_depth (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  bt_status status = bt__check_range (c, 0, "a depth in m", -1e7, 1e7);
  if (status != BT_OK)
    return status;
  v->hold_depth = (bt__hold){ 1, c->args[0] };
  v->pilot.height = -c->args[0];
  hold_instead (v, BT__HOLD_DEPTH, BT__HOLD_ALTITUDE);
  return BT_OK;
}

bt_status
bt__op_hold_altitude (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  bt_status status
      = bt__check_range (c, 0, "an altitude in m", 0, bt__dive_altitude_max (c->dive, c->state));
  if (status != BT_OK)
    return status;
  v->hold_depth.on = 0;
  v->pilot.altitude = c->args[0];
  hold_instead (v, BT__HOLD_ALTITUDE, BT__HOLD_DEPTH);
  return BT_OK;
}

bt_status
bt__op_hold_position (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  memset (v->sticks, 0, sizeof v->sticks);
  v->goal = BT__GOAL_NONE;
  v->hold_heading = (bt__hold){ 1, v->heading };
  v->hold_depth = (bt__hold){ 1, -v->position.z };
  v->pilot.place = v->position;
  v->pilot.speed = 0;
  keep_heading (v, v->heading);
  hold_instead (v, BT__HOLD_POSITION, BT__HOLD_WAYPOINT);
  return BT_OK;
}

/* A track that begins elsewhere is begun by being placed there.  What the vehicle goes in a step by
   itself is no place elsewhere: its tethers go along with that as they move.  */
static void
go_to_begin (const bt__call *c, const bt__track *track)
{
  const bt__vehicle *v = called_vehicle (c);
  bt_vec3 begin = bt__vec (track->row[0][1], track->row[0][2], track->row[0][3]);
  if (bt__distance (v->position, begin) > v->speeds[0] * BT__TIME_STEP)
    place_at (c, begin);
}

bt_status
bt__op_follow (const bt__call *c)
{
  bt__vehicle *v = called_vehicle (c);
  if (v->rigid)
    return bt__fail (
        c->error, BT_ERR_UNSUPPORTED,
        "a vehicle with mass goes where forces take it; only one without follows a track");
  int track;
  bt_status status = bt_dive_add_track (c->dive, c->args, c->n, &track, c->error);
  if (status != BT_OK)
    return status;
  go_to_begin (c, c->dive->tracks[track]);
  v->goal = BT__GOAL_TRACK;
  v->track = track;
  v->track_start = bt__state_time (c->state);
  return BT_OK;
}
