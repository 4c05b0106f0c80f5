/* The moving line in a dive: laid, stepped, carried along, put to sleep, parted.

   The kernel is tether/dynamic.h; here it is given its ends, its winch and its sea, and what it
   does is told as events.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/sim.h"
#include "world/line.h"

/* What counts as rest, m/s and m/s2; how the chain follows the winch; and what counts as a snap:
   from below 1 N to above 25 N within half a second.  */
#define REST_SPEED 1e-4
#define REST_ACCELERATION 1e-3
#define WINCH_LAG 0.25  /* s */
#define WINCH_REST 1e-5 /* m */
#define SNAP_FROM 1.0
#define SNAP_TO 25.0
enum
{
  SNAP_STEPS = 30,
  SETTLE_TRIES = 20
};

/* The vehicle with mass at the far end of tether I, which this line carries, or NULL.  */
static bt__vehicle *
carried (const bt_dive *dive, bt__state *state, int i)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  if (vehicle < 0 || bt__dive_vehicle (dive, state, vehicle)->mass == 0
      || bt__carrier (dive, state, vehicle) != i)
    return NULL;
  return bt__dive_vehicle (dive, state, vehicle);
}

/* ---- Laying ---- */

/* Put the present shape of tether I, N + 1 points of it, on the dive's polyline, and the tensions
   in the middle between them along it.  */
static void
trace (bt_dive *dive, bt__state *state, int i, int n)
{
  bt__line line = bt__line_of (dive, state, i);
  double length = bt__line_length (&line);
  for (int k = 0; k <= n; k++)
    {
      dive->polyline[k] = bt__line_point (&line, length * k / n);
      dive->along[k] = bt__line_tension (&line, length * fmin (k + 0.5, n) / n);
    }
}

/* Give a CHAIN of N intervals the tensions its shape had, so that it has them before its first
 * step.  */
static void
tense (const bt_dive *dive, bt__dynamic *chain, int n)
{
  const bt_vec3 *x = bt__dynamic_x (chain);
  bt_vec3 first = bt__unit_or (bt__sub (x[1], x[0]), bt__vec (0, 0, 0));
  bt_vec3 last = bt__unit_or (bt__sub (x[n - 1], x[n]), bt__vec (0, 0, 0));
  memcpy (bt__dynamic_tension (chain), dive->along, sizeof (double) * (size_t)n);
  chain->pull[0] = bt__scale (dive->along[0], first);
  chain->pull[1] = bt__scale (dive->along[n - 1], last);
}

/* Solve the shape of tether I with PROPS again and again while it still moves.  */
static bt_status
settle_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
              const bt_tether_props *props, bt_error *error)
{
  for (int k = 0;; k++)
    {
      uint64_t unsettled = dive->counts.unsettled;
      bt_status status = bt__solve_shape (dive, state, i, ends, props, 0, error);
      if (status != BT_OK || dive->counts.unsettled == unsettled || k == SETTLE_TRIES)
        return status;
    }
}

/* Give tether I a shape to begin with when it has none: its equilibrium, or, when that is not
   found, the catenary.  */
static bt_status
rest_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_tether_props props = tether->props;
  bt_status status;
  props.model = BT_MODEL_STEADY;
  if (tether->props.model == BT_MODEL_AUTO)
    props.nodes = bt__chain_room (&dive->model->tethers[i]);
  status = settle_shape (dive, state, i, ends, &props, error);
  if (status == BT_OK)
    return status;
  props.model = BT_MODEL_CATENARY;
  props.depth_rule = BT_DEPTH_SAG;
  memset (&tether->shape, 0, sizeof tether->shape);
  return bt__solve_shape (dive, state, i, ends, &props, 0, error);
}

bt_status
bt__lay_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt_tether_def *def = &dive->model->tethers[i];
  const bt__vehicle *v;
  int is_auto = tether->props.model == BT_MODEL_AUTO;
  int n = is_auto ? bt__chain_room (def) : (int)def->props.nodes;
  bt_status status = BT_OK;
  if (tether->shape.length == 0)
    status = rest_shape (dive, state, i, ends, error);
  if (status != BT_OK)
    return status;
  trace (dive, state, i, n);
  dive->polyline[0] = ends->a;
  dive->polyline[n] = ends->b;
  status = bt__dynamic_init (bt__dive_chain (dive, state, i, 0), bt__chain_room (def), n,
                             dive->polyline, n + 1, tether->length,
                             isfinite (tether->props.ea) ? tether->props.ea : 1e9, error);
  if (status != BT_OK)
    return status;
  tense (dive, bt__dive_chain (dive, state, i, 0), n);
  memset (&tether->shape, 0, sizeof tether->shape);
  tether->shape.form = BT__FORM_CHAIN;
  tether->shape.a = ends->a;
  tether->shape.b = ends->b;
  tether->shape.length = tether->length;
  tether->parted = tether->quiet = tether->settled = 0;
  v = carried (dive, state, i);
  if (v)
    bt__dynamic_v (bt__dive_chain (dive, state, i, 0))[n] = v->velocity;
  return is_auto ? bt__remesh_chain (dive, state, i, error) : BT_OK;
}

/* ---- Between steps ---- */

/* Become nodes of a static model, which looks for the equilibrium from there.  */
void
bt__still_chain (bt_dive *dive, bt__state *state, int i)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  int n = (int)dive->model->tethers[i].props.nodes;
  trace (dive, state, i, n);
  memcpy (bt__dive_nodes (dive, state, i), dive->polyline, sizeof (bt_vec3) * (size_t)(n + 1));
  memset (bt__dive_tensions (dive, state, i), 0, sizeof (bt_vec3) * (size_t)(n + 1));
  memset (&tether->memory.pull, 0, sizeof tether->memory.pull);
  tether->shape.form = BT__FORM_NODES;
  tether->shape.n = n;
}

/* A part of a parted line goes along with its held end as it is.  */
static void
shift_part (bt__dynamic *chain, bt_vec3 from, bt_vec3 to)
{
  bt_vec3 way = bt__sub (to, from), *x = bt__dynamic_x (chain);
  for (int64_t k = 0; k <= chain->n; k++)
    x[k] = bt__add (x[k], way);
}

static int
is_same (bt_vec3 a, bt_vec3 b)
{
  return memcmp (&a, &b, sizeof a) == 0;
}

/* An end was put elsewhere in no time: the line takes the equilibrium that it comes to from where
 * it is.  */
bt_status
bt__carry_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends before = { tether->shape.a, tether->shape.b };
  bt_status status;
  if (is_same (before.a, ends->a) && is_same (before.b, ends->b))
    return BT_OK;
  if (tether->parted)
    {
      shift_part (bt__dive_chain (dive, state, i, 0), before.a, ends->a);
      shift_part (bt__dive_chain (dive, state, i, 1), before.b, ends->b);
      tether->shape.a = ends->a;
      tether->shape.b = ends->b;
      tether->quiet = 0;
      return BT_OK;
    }
  bt__still_chain (dive, state, i);
  status = rest_shape (dive, state, i, ends, error);
  return status == BT_OK ? bt__lay_chain (dive, state, i, ends, error) : status;
}

/* ---- Parting ---- */

void
bt__part_chain (bt_dive *dive, bt__state *state, int i, int interval)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__dynamic *whole = bt__dive_chain (dive, state, i, 0),
              *far = bt__dive_chain (dive, state, i, 1);
  bt__dynamic_cut (whole, interval, whole, far);
  tether->parted = 1;
  tether->length = bt__dynamic_length (whole);
  tether->winch_rate = 0;
  tether->quiet = 0;
  bt__raise_event (state, BT_EVENT_PARTED, i);
}

/* ---- A step ---- */

static int
may_sleep_on (const bt__state *state, const bt__tether *tether, const bt__ends *ends)
{
  return tether->quiet >= BT__SLEEP_AFTER && !tether->stale && tether->winch_rate == 0
         && tether->shape.length == tether->length && is_same (tether->shape.a, ends->a)
         && is_same (tether->shape.b, ends->b) && !bt_current_is_unsteady (&state->current);
}

static bt_status
step_part (bt_dive *dive, bt__dynamic *chain, bt__dynamic_input *input, bt__dynamic_report *report,
           bt_error *error)
{
  bt_status status = bt__dynamic_step (chain, dive->work, input, report, error);
  dive->profile.chain_steps++;
  dive->profile.chain_solves += (uint64_t)report->solves;
  dive->profile.chain_safeguarded += report->safeguarded != 0;
  dive->profile.chain_unconverged += !report->converged;
  return status;
}

static void
note_snap (bt__state *state, bt__tether *tether, int i, double tension)
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

/* The twist that the vehicle's turns put into the line throws a loop where the torque exceeds what
   tension, bending and length hold: T < M^2/(4 EI) - pi^2 EI/L^2 (Greenhill 1883).  */
static void
note_hockle (const bt_dive *dive, bt__state *state, bt__tether *tether, int i)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  int vehicle = dive->model->ends[i][1].vehicle;
  double turn, torque, most, least = INFINITY, ei = tether->props.ei, length = tether->length;
  if (tether->props.gj == 0 || ei == 0 || vehicle < 0 || tether->parted)
    return;
  turn = bt__dive_vehicle (dive, state, vehicle)->heading
         - bt__dive_vehicle (dive, state, vehicle)->heading0;
  torque = tether->props.gj * turn / length;
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

static void
note_rest (bt__tether *tether, const bt__dynamic_report *report)
{
  int rests = report->speed < REST_SPEED && report->acceleration < REST_ACCELERATION;
  tether->quiet = rests ? tether->quiet + 1 : 0;
  tether->settled = report->speed < 1e-3;
}

static bt__dynamic_end
vehicle_end (const bt__vehicle *v)
{
  return (bt__dynamic_end){ .free = 1,
                            .at = v->position,
                            .body = { .mass = v->mass,
                                      .added = v->added_mass,
                                      .linear = v->drag,
                                      .quadratic = v->quadratic_drag,
                                      .force = bt__thrust (v) } };
}

/* Steel sinks by its weight less the water it displaces; a float is a hull that weighs three tenths
   of what it displaces.  Both drag as spheres (Cd 0.5) and add half of what they displace.  */
static bt__dynamic_lump
lump_of (const bt_lump *def, double from_end, const bt_water *water)
{
  double rho = water->density, g = water->gravity;
  double volume = def->mass > 0      ? def->mass / 7850
                  : rho > 0 && g > 0 ? def->buoyancy / (0.7 * rho * g)
                                     : 0;
  double mass = def->mass > 0 ? def->mass : 0.3 * rho * volume;
  double radius = cbrt (3 * volume / (4 * BT__PI));
  return (bt__dynamic_lump){ .from_end = from_end,
                             .span = def->span,
                             .mass = mass,
                             .added = 0.5 * rho * volume,
                             .wet_weight = (mass - rho * volume) * g,
                             .quadratic = 0.5 * rho * 0.5 * BT__PI * radius * radius };
}

/* Give INPUT what is fastened to tether I between FROM and TO metres from its far end, a distance
   that the winch does not change.  */
static void
fasten (const bt_dive *dive, int i, double from, double to, bt__dynamic_input *input,
        bt__dynamic_lump *lumps)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  input->lumps = lumps;
  input->n_lumps = 0;
  for (int k = 0; k < (int)def->n_lumps; k++)
    {
      double from_end = def->length - def->lumps[k].at;
      if (from_end >= from && from_end < to)
        lumps[input->n_lumps++] = lump_of (&def->lumps[k], from_end - from, input->water);
    }
}

static bt__dynamic_input
input_of (const bt_dive *dive, bt__state *state, int i, const bt_water *water, const bt__ends *ends)
{
  const bt__vehicle *v = carried (dive, state, i);
  bt__dynamic_end far = { .at = ends->b };
  return (bt__dynamic_input){ .line = &bt__dive_tether (dive, state, i)->props,
                              .water = water,
                              .end = { { .at = ends->a }, v ? vehicle_end (v) : far },
                              .h = BT__TIME_STEP };
}

/* Give the vehicle that the last node of the line carries its place and velocity.  */
static void
bring_vehicle (const bt_dive *dive, bt__state *state, int i)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, tether->parted ? 1 : 0);
  bt__vehicle *v = carried (dive, state, i);
  if (!v)
    return;
  v->position = bt__dynamic_x (chain)[chain->n];
  v->velocity = bt__dynamic_v (chain)[chain->n];
  tether->shape.b = v->position;
}

/* The far part of a parted line: its new end is free, the other goes with the vehicle.  */
static bt_status
step_far_part (bt_dive *dive, bt__state *state, int i, bt__dynamic_input input, bt_error *error)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 1);
  bt__dynamic_lump lumps[BT_LUMPS_MAX];
  bt__dynamic_report report = { 0 };
  fasten (dive, i, 0, bt__dynamic_length (chain), &input, lumps);
  input.end[0] = (bt__dynamic_end){ .free = 1 };
  input.pay = 0;
  return step_part (dive, chain, &input, &report, error);
}

/* The chain follows the winch with a lag, for a drum that starts or stops at once sends a wave of
   v sqrt (EA m) along the line.  */
static double
pay_of (const bt__tether *tether, const bt__dynamic *chain)
{
  double owed = tether->length - bt__dynamic_length (chain);
  return owed / (fabs (owed) < WINCH_REST ? BT__TIME_STEP : WINCH_LAG);
}

bt_status
bt__step_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  bt_water water = bt__dive_water (dive, state);
  bt__dynamic_input input = input_of (dive, state, i, &water, ends);
  bt__dynamic_lump lumps[BT_LUMPS_MAX];
  bt__dynamic_report report = { 0 };
  double far_length = 0;
  bt_status status;
  note_hockle (dive, state, tether, i); /* a sleeping line can be twisted too */
  if (may_sleep_on (state, tether, ends))
    {
      dive->profile.chain_sleeps++;
      return BT_OK;
    }
  if (tether->parted)
    {
      far_length = bt__dynamic_length (bt__dive_chain (dive, state, i, 1));
      status = step_far_part (dive, state, i, input, error);
      if (status != BT_OK)
        return status;
      input.end[1] = (bt__dynamic_end){ .free = 1 };
    }
  fasten (dive, i, far_length, INFINITY, &input, lumps);
  input.pay = pay_of (tether, chain);
  status = step_part (dive, chain, &input, &report, error);
  if (status != BT_OK)
    return status;
  tether->shape.a = ends->a;
  tether->shape.b = ends->b;
  tether->shape.length = tether->length;
  tether->stale = 0;
  bring_vehicle (dive, state, i);
  tether->tension_max = report.tension;
  note_rest (tether, &report);
  note_snap (state, tether, i, report.tension);
  note_kink (state, tether, i, report.bend_radius);
  if (!tether->parted && report.tension > tether->props.breaking_load)
    bt__part_chain (dive, state, i, report.at);
  else if (tether->props.model == BT_MODEL_AUTO && state->step % BT__REMESH_EVERY == 0)
    return bt__remesh_chain (dive, state, i, error);
  return BT_OK;
}
