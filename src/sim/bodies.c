/* Vehicles with mass: rigid bodies that thrusters, water and tethers move.

   The step of a body is vehicle/body.h's.  A line that is stiff must be solved together with the
   body it pulls.  On a moving line the body is a spring at the line's end (bt__rigid_grip), which
   the line's own implicit step takes up (chain_load.c); then the body follows.  The end force f of
   a static line grows without bound as the line comes taut; along the line it is taken linear in
   the place X of its end over the step, with the stiffness k that a shallow bow has, f / 2 (L - c)
   for a chord c of a length L, and X is linear in f:
     f = f0 + k (X - x0),   X = AT - y f   hence   f = (f0 + k (AT - x0)) / (1 + k y).
   Other tethers pull with the force they had.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "world/obstacles.h"

#define SHALLOWEST 1e-6 /* of the length: what a bow is at least short by */

static const bt__vehicle_type *
type_of (const bt_dive *dive, int vehicle)
{
  return &dive->model->types[vehicle];
}

/* ---- Places ---- */

void
bt__mirror_body (bt__vehicle *v)
{
  v->position = v->body.position;
  v->velocity = bt__turn_out (v->body.attitude, v->body.velocity);
  v->heading = v->body.heading;
  v->pitch = bt__pitch_of (v->body.attitude);
  v->roll = bt__roll_of (v->body.attitude);
}

void
bt__put_vehicle (bt__vehicle *v, bt_vec3 p, int keeps)
{
  v->position = v->body.position = p;
  if (keeps)
    return;
  v->velocity = v->body.velocity = v->body.spin = bt__vec (0, 0, 0);
}

void
bt__deaden_vehicle (bt__vehicle *v)
{
  if (v->rigid)
    return;
  v->rigid = 1;
  bt__rigid_place (&v->body, v->position, v->heading, v->pitch, v->roll);
  v->body.heading = v->heading;
}

/* ---- Lines ---- */

int
bt__carrier (const bt_dive *dive, bt__state *state, int vehicle)
{
  const bt_model *model = dive->model;
  for (int i = model->led[vehicle]; i >= 0; i = model->led_too[i])
    {
      const bt__tether *tether = bt__dive_tether (dive, state, i);
      if (bt__is_cable (tether) && bt__is_moving_model (tether))
        return i;
    }
  return -1;
}

/* The moving line that carries VEHICLE in the present try at a step, or -1.  */
static int
carried_by (const bt_dive *dive, bt__state *state, int vehicle)
{
  return bt__pinned (dive, vehicle) ? -1 : bt__carrier (dive, state, vehicle);
}

/* True if TETHER, static, is at its end, where reach.c holds a vehicle.  */
static int
is_at_its_end (const bt__tether *tether)
{
  return tether->taut && !bt__is_spring (tether);
}

/* The static line with its far end at VEHICLE that pulls VEHICLE by a force, or -1.  */
static int
slack_line (const bt_dive *dive, bt__state *state, int vehicle)
{
  const bt_model *model = dive->model;
  for (int i = model->led[vehicle]; i >= 0; i = model->led_too[i])
    {
      const bt__tether *tether = bt__dive_tether (dive, state, i);
      if (!bt__is_cable (tether) && !is_at_its_end (tether))
        return i;
    }
  return -1;
}

/* The pull, N, of tether I at the start of the step on the attachment of its end K.  */
static bt_vec3
pull_at (const bt_dive *dive, bt__state *state, int i, int k)
{
  bt__line line = bt__line_of (dive, state, i);
  if (is_at_its_end (line.tether) && !bt__is_cable (line.tether))
    return bt__vec (0, 0, 0);
  return bt__line_pull (&line, k);
}

/* Add the pulls of all tethers of VEHICLE but tether BUT at its far end.  */
static void
add_pulls (const bt_dive *dive, bt__state *state, int vehicle, int but, bt__rigid_input *in)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt_vec3 arm = bt__turn_out (v->body.attitude, type_of (dive, vehicle)->attached);
  for (int i = 0; i < dive->model->n_tethers; i++)
    for (int k = 0; k < 2; k++)
      if (dive->model->ends[i][k].vehicle == vehicle && !(i == but && k == 1)
          && bt__dive_tether (dive, state, i)->shape.length > 0)
        {
          bt_vec3 f = pull_at (dive, state, i, k);
          in->force = bt__add (in->force, f);
          in->moment = bt__add (in->moment, bt__cross (arm, f));
        }
}

/* The stiffness, N/m, of the moving line I at its far end: the stiffness of the last interval, plus
   the inertia of the last node, with the mass of half an interval, whose acceleration in H seconds
   is (1.5 / H)2 times its displacement.  */
static double
stiffness_of (const bt_dive *dive, bt__state *state, int i, double h)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt_tether_props *p = &tether->props;
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, tether->parted ? 1 : 0);
  double piece = bt__dynamic_rest (chain)[chain->n - 1], rate = 1.5 / h;
  double displaced = state->density * BT__PI / 4 * p->diameter * p->diameter;
  return bt__stiffness (p->ea) / piece + rate * rate * (p->mass + p->ca * displaced) * piece / 2;
}

/* ---- What a body is given ---- */

/* The water in the middle of the step that ends now.  */
static void
sample_water (const bt_dive *dive, bt__state *state, bt_vec3 p, bt__rigid_input *in)
{
  bt_water water = bt__dive_water (dive, state);
  water.time -= BT__TIME_STEP / 2;
  in->density = water.density;
  in->gravity = water.gravity;
  in->surface = bt_water_surface (&water, p);
  bt_water_motion (&water, p, &in->flow, &in->flow_acceleration);
}

static bt__fix
fix_of (const bt_dive *dive, bt__state *state, int vehicle)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  int wanted = (v->pilot.holds & BT__HOLD_ALTITUDE) != 0;
  return (bt__fix){ .position = v->body.position,
                    .velocity = v->velocity,
                    .attitude = v->body.attitude,
                    .spin = v->body.spin,
                    .altitude = wanted ? bt__dive_altitude (dive, state, v->position, NULL) : NAN };
}

/* A flight that has arrived goes on as a stay.  */
static void
look_for_arrival (bt__state *state, bt__vehicle *v, int vehicle, const bt__fix *fix)
{
  if (v->goal == BT__GOAL_NONE || !bt__pilot_arrived (&v->pilot, fix))
    return;
  v->goal = BT__GOAL_NONE;
  if (!v->hold_heading.on)
    v->pilot.heading = v->heading;
  v->pilot.holds = (v->pilot.holds & ~(int64_t)BT__HOLD_WAYPOINT) | BT__HOLD_POSITION;
  bt__raise_event (state, BT_EVENT_ARRIVED, vehicle);
}

static void
steer (const bt_dive *dive, bt__state *state, int vehicle, bt__rigid_input *in)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt__fix fix = fix_of (dive, state, vehicle);
  look_for_arrival (state, v, vehicle, &fix);
  memcpy (v->pilot.sticks, v->sticks, sizeof v->pilot.sticks);
  v->pilot.yaw_rate = v->speeds[3];
  bt__pilot_steer (type_of (dive, vehicle), &dive->model->rigs[vehicle], &v->pilot, &fix,
                   BT__TIME_STEP, in->wish);
  in->volts = v->volts;
  in->lost = (uint64_t)v->lost;
}

bt_status
bt__grip_body (const bt_dive *dive, bt__state *state, int vehicle, int carrier, double h,
               bt_error *error)
{
  bt__driven *d = &dive->driven[vehicle];
  d->in.h = h;
  d->in.gripped = 1;
  d->in.stiffness = stiffness_of (dive, state, carrier, h);
  return bt__rigid_grip (type_of (dive, vehicle), &bt__dive_vehicle (dive, state, vehicle)->body,
                         &d->in, &d->grip, error);
}

bt_status
bt__steer_bodies (const bt_dive *dive, bt__state *state, bt_error *error)
{
  bt_status status = BT_OK;
  for (int i = 0; i < dive->model->n_vehicles && status == BT_OK; i++)
    {
      const bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      bt__driven *d = &dive->driven[i];
      int carrier = carried_by (dive, state, i);
      if (!v->rigid)
        continue;
      *d = (bt__driven){ .in = { .h = BT__TIME_STEP } };
      sample_water (dive, state, v->position, &d->in);
      steer (dive, state, i, &d->in);
      add_pulls (dive, state, i, carrier >= 0 ? carrier : slack_line (dive, state, i), &d->in);
      bt__add_line_loads (dive, state, i, &d->in);
      if (carrier >= 0)
        status = bt__grip_body (dive, state, i, carrier, BT__TIME_STEP, error);
    }
  return status;
}

/* ---- Steps ---- */

/* How far the attachment yields to one newton along the unit vector U, m/N: u K^-1 u.  */
static double
yield_along (const bt__grip *grip, bt_vec3 u)
{
  const double (*k)[3] = grip->stiffness;
  bt_vec3 a = bt__vec (k[0][0], k[0][1], k[0][2]), b = bt__vec (k[1][0], k[1][1], k[1][2]);
  bt_vec3 c = bt__vec (k[2][0], k[2][1], k[2][2]), bc = bt__cross (b, c), ca = bt__cross (c, a);
  bt_vec3 x = bt__axpy (bt__axpy (bt__scale (u.x, bc), u.y, ca), u.z, bt__cross (a, b));
  return bt__dot (u, x) / bt__dot (a, bc);
}

/* The pull of the slack static line I on VEHICLE over the coming step.  */
static bt_status
pull_of_slack (const bt_dive *dive, bt__state *state, int vehicle, int i, bt_error *error)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__driven *d = &dive->driven[vehicle];
  bt__line line = bt__line_of (dive, state, i);
  bt_vec3 force = bt__line_pull (&line, 1), x0 = bt__attachment (dive, state, vehicle);
  bt__ends ends = bt__tether_ends (dive, state, i);
  bt_vec3 way = bt__sub (x0, ends.a);
  bt_vec3 u = bt__unit_or (way, bt__vec (0, 0, 0));
  double f0 = -bt__dot (force, u), f;
  double left = fmax (tether->length - bt__norm (way), SHALLOWEST * tether->length);
  double k = fmin (fmax (f0, 0) / (2 * left), bt__stiffness (tether->props.ea) / tether->length);
  bt_status status = bt__rigid_grip (type_of (dive, vehicle), &v->body, &d->in, &d->grip, error);
  if (status != BT_OK)
    return status;
  f = (f0 + k * bt__dot (bt__sub (d->grip.at, x0), u)) / (1 + k * yield_along (&d->grip, u));
  /* Where it would come taut within the step, the stretch is what counts.  */
  if (bt__is_spring (tether))
    {
      double ea = tether->props.ea / tether->length;
      double over = bt__dot (bt__sub (d->grip.at, ends.a), u) - tether->length;
      double taut = ea * over / (1 + ea * yield_along (&d->grip, u));
      k = taut > f ? ea : k;
      f = fmax (f, taut);
    }
  d->in.gripped = 1;
  d->in.stiffness = k;
  d->in.pull = bt__axpy (force, f0 - f, u);
  return BT_OK;
}

static bt_status
step_free (const bt_dive *dive, bt__state *state, int vehicle, bt_error *error)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  int i = slack_line (dive, state, vehicle);
  bt_status status = BT_OK;
  bt__driven *d = &dive->driven[vehicle];
  int gripped = i >= 0 && bt__dive_tether (dive, state, i)->shape.length > 0;
  if (gripped)
    status = pull_of_slack (dive, state, vehicle, i, error);
  if (status == BT_OK)
    status = bt__rigid_follow (type_of (dive, vehicle), &v->body, &d->in, gripped ? &d->grip : NULL,
                               error);
  bt__mirror_body (v);
  return status;
}

bt_status
bt__step_bodies (const bt_dive *dive, bt__state *state, bt_error *error)
{
  bt_status status = BT_OK;
  for (int i = 0; i < dive->model->n_vehicles && status == BT_OK; i++)
    {
      bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      if (!v->rigid)
        continue;
      if (bt__pinned (dive, i))
        v->body = dive->contact_work.pin[i].body;
      else if (carried_by (dive, state, i) < 0)
        status = step_free (dive, state, i, error);
      bt__mirror_body (v);
    }
  return status;
}

/* The step of the line took the body for a spring with small rotations.  After a larger rotation
   the attachment is not quite at X, so the body is moved until it is.  */
bt_status
bt__follow_line (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 x, bt_error *error)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt__driven *d = &dive->driven[vehicle];
  bt_status status;
  d->in.pull = bt__grip_pull (&d->grip, x);
  status = bt__rigid_follow (type_of (dive, vehicle), &v->body, &d->in, &d->grip, error);
  bt__mirror_body (v);
  if (status == BT_OK)
    bt__put_vehicle (v, bt__add (v->position, bt__sub (x, bt__attachment (dive, state, vehicle))),
                     1);
  return status;
}

void
bt__note_pull (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  if (vehicle < 0 || bt__carrier (dive, state, vehicle) != i)
    return;
  bt__line line = bt__line_of (dive, state, i);
  bt__dive_vehicle (dive, state, vehicle)->body.pull = bt__line_pull (&line, 1);
}
