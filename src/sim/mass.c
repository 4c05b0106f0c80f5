/* A vehicle with mass: a point that thrust, water and tethers move.

   On the far end of a moving line it is part of the line's own implicit step (chain.c).  Anywhere
   else it is stepped here, the drag taken implicitly, with the end forces its tethers had.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/sim.h"
#include "world/line.h"

enum
{
  SURGE,
  SWAY,
  HEAVE
};

/* What the autopilot to a place wants, N/m of way and N s/m of speed for each kg that moves.  */
#define STIFFNESS 1.0
#define DAMPING 2.0

int
bt__carrier (const bt_dive *dive, bt__state *state, int vehicle)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      const bt__tether *tether = bt__dive_tether (dive, state, i);
      if (dive->model->ends[i][1].vehicle == vehicle && tether->shape.form == BT__FORM_CHAIN
          && bt__is_moving_model (tether))
        return i;
    }
  return -1;
}

static bt_vec3
limited (bt_vec3 force, double most)
{
  double size = bt__norm (force);
  return size > most ? bt__scale (most / size, force) : force;
}

static bt_vec3
stick_thrust (const bt__vehicle *v)
{
  double ahead = v->sticks[SURGE] * v->thrust, aside = v->sticks[SWAY] * v->thrust;
  return bt__vec (ahead * sin (v->heading) + aside * cos (v->heading),
                  ahead * cos (v->heading) - aside * sin (v->heading),
                  v->sticks[HEAVE] * v->thrust);
}

/* Toward the target, no faster than told: what the drag will take at the speed wished for, and a
   damped spring.  */
static bt_vec3
goal_thrust (const bt__vehicle *v)
{
  double moving = v->mass + v->added_mass;
  bt_vec3 wish = limited (bt__scale (STIFFNESS / DAMPING, bt__sub (v->target, v->position)),
                          v->target_speed);
  double c = v->drag + v->quadratic_drag * bt__norm (wish);
  bt_vec3 push = bt__scale (DAMPING * moving, bt__sub (wish, v->velocity));
  return limited (bt__axpy (push, c, wish), v->thrust);
}

bt_vec3
bt__thrust (const bt__vehicle *v)
{
  bt_vec3 force = v->goal == BT__GOAL_NONE ? stick_thrust (v) : goal_thrust (v);
  double moving = v->mass + v->added_mass;
  if (v->goal == BT__GOAL_NONE && v->hold_depth.on && v->sticks[HEAVE] == 0)
    force.z = fmax (-v->thrust,
                    fmin (v->thrust, moving
                                         * (STIFFNESS * (-v->hold_depth.value - v->position.z)
                                            - DAMPING * v->velocity.z)));
  return force;
}

/* The sum of the forces of the static tethers on VEHICLE, as they were after the last step.  */
static bt_vec3
tether_force (const bt_dive *dive, bt__state *state, int vehicle)
{
  bt_vec3 sum = { 0, 0, 0 };
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (dive->model->ends[i][1].vehicle == vehicle)
      {
        bt__line line = bt__line_of (dive, state, i);
        sum = bt__add (sum, bt__line_force (&line));
      }
  return sum;
}

static void
drift (const bt_dive *dive, bt__state *state, int vehicle)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt_water water = bt__dive_water (dive, state);
  bt_vec3 flow = bt_water_velocity (&water, v->position);
  double moving = v->mass + v->added_mass, h = BT__TIME_STEP;
  double speed = bt__norm (bt__sub (flow, v->velocity));
  double c = v->drag + v->quadratic_drag * speed;
  bt_vec3 force = bt__add (bt__thrust (v), tether_force (dive, state, vehicle));
  bt_vec3 push = bt__axpy (force, c, flow);
  v->velocity
      = bt__scale (1 / (moving + h * c), bt__axpy (bt__scale (moving, v->velocity), h, push));
  v->position = bt__axpy (v->position, h, v->velocity);
}

static void
look_for_arrival (bt__state *state, bt__vehicle *v, int vehicle)
{
  int there = bt__distance (v->position, v->target) < 0.05 && bt__norm (v->velocity) < 0.05;
  if ((v->goal == BT__GOAL_POINT || v->goal == BT__GOAL_FLY) && there)
    {
      v->goal = BT__GOAL_NONE;
      bt__raise_event (state, BT_EVENT_ARRIVED, vehicle);
    }
}

void
bt__drift_vehicles (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      if (v->mass == 0)
        continue;
      look_for_arrival (state, v, i);
      if (bt__carrier (dive, state, i) < 0)
        drift (dive, state, i);
    }
}
