/* A predicted vehicle, moved ahead without tether and obstacles (predicted.h).

   A kinematic vehicle goes to the goal at the ordered speed, or by the sticks: the velocity turns
   with the heading, half the turn before the way and half after, so a circle stays a circle for any
   step (the midpoint rule).  A vehicle with mass is stepped as in the dive (vehicle/body.h), by its
   thrusters, its autopilot and the water of the present time, in steps of at most 0.05 s.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "world/predicted.h"
#include "world/obstacles.h"

#define BODY_STEP 0.05 /* s, of a vehicle with mass: the least its autopilot asks for */

/* ---- Without mass ---- */

static int
has_goal (const bt__vehicle *v)
{
  return v->goal == BT__GOAL_POINT || v->goal == BT__GOAL_FLY;
}

bt__predicted
bt__predicted_of (const bt_dive *dive, int vehicle)
{
  bt__predicted predicted
      = { .dive = dive, .vehicle = vehicle, .v = *bt__dive_vehicle (dive, dive->now, vehicle) };
  bt__vehicle *v = &predicted.v;
  double ahead = v->sticks[0] * v->speeds[0], aside = v->sticks[1] * v->speeds[1];
  double s = sin (v->heading), c = cos (v->heading);
  predicted.yaw = has_goal (v) ? 0 : v->sticks[3] * v->speeds[3];
  if (!v->rigid && v->goal == BT__GOAL_NONE)
    v->velocity
        = bt__vec (ahead * s + aside * c, ahead * c - aside * s, v->sticks[2] * v->speeds[2]);
  return predicted;
}

static void
go_to_goal (bt__vehicle *v, double seconds)
{
  bt_vec3 way = bt__sub (v->target, v->position);
  double left = bt__norm (way), step = v->target_speed * seconds;
  v->position = left > step ? bt__axpy (v->position, step / left, way) : v->target;
}

/* Velocity turns with the heading, clockwise: half before the way, half after it.  */
static void
go_by_sticks (bt__vehicle *v, double yaw, double seconds)
{
  double turn = yaw * seconds, s = sin (0.5 * turn), c = cos (0.5 * turn);
  bt_vec3 u = v->velocity;
  for (int half = 0; half < 2; half++)
    {
      u = bt__vec (u.x * c + u.y * s, u.y * c - u.x * s, u.z);
      if (half == 0)
        v->position = bt__axpy (v->position, seconds, u);
    }
  v->velocity = u;
  v->heading += turn;
}

/* ---- With mass ---- */

static void
steer_predicted (bt__predicted *g, bt__rigid_input *in)
{
  const bt_model *model = g->dive->model;
  bt__vehicle *v = &g->v;
  int wanted = (v->pilot.holds & BT__HOLD_ALTITUDE) != 0;
  bt__fix fix
      = { .position = v->body.position,
          .velocity = v->velocity,
          .attitude = v->body.attitude,
          .spin = v->body.spin,
          .altitude = wanted ? bt__dive_altitude (g->dive, g->dive->now, v->position, NULL) : NAN };
  memcpy (v->pilot.sticks, v->sticks, sizeof v->pilot.sticks);
  v->pilot.yaw_rate = v->speeds[3];
  bt__pilot_steer (&model->types[g->vehicle], &model->rigs[g->vehicle], &v->pilot, &fix, in->h,
                   in->wish);
}

static void
mirror (bt__vehicle *v)
{
  v->position = v->body.position;
  v->velocity = bt__turn_out (v->body.attitude, v->body.velocity);
  v->heading = v->body.heading;
}

static void
step_body (bt__predicted *g, double h)
{
  bt__vehicle *v = &g->v;
  bt_water water = bt__dive_water (g->dive, g->dive->now);
  bt__rigid_input in = { .h = h,
                         .density = water.density,
                         .gravity = water.gravity,
                         .surface = bt_water_surface (&water, v->position),
                         .volts = v->volts,
                         .lost = (uint64_t)v->lost };
  bt_water_motion (&water, v->position, &in.flow, &in.flow_acceleration);
  steer_predicted (g, &in);
  if (bt__rigid_step (&g->dive->model->types[g->vehicle], &v->body, &in, NULL) == BT_OK)
    mirror (v);
}

void
bt__predicted_go_on (bt__predicted *g, double seconds)
{
  if (!g->v.rigid && has_goal (&g->v))
    go_to_goal (&g->v, seconds);
  else if (!g->v.rigid)
    go_by_sticks (&g->v, g->yaw, seconds);
  else
    for (int k = 0, n = (int)ceil (seconds / BODY_STEP - 1e-9); k < n; k++)
      step_body (g, seconds / n);
}

void
bt__predicted_stop (bt__predicted *g, bt_vec3 p, bt_vec3 normal)
{
  bt__vehicle *v = &g->v;
  double into = bt__dot (v->velocity, normal);
  if (into < 0)
    v->velocity = bt__axpy (v->velocity, -into, normal);
  v->position = v->body.position = p;
  if (v->rigid)
    v->body.velocity = bt__turn_in (v->body.attitude, v->velocity);
}
