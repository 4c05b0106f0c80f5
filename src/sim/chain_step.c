/* A step of the moving line in a dive: asleep or awake, whole or in two, on its winch.

   The kernel is tether/dynamic.h; here it is given its ends, its winch and its sea.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"

/* How the chain follows the winch.  */
#define WINCH_REST 1e-5 /* m: what the lag leaves at last is paid in one step */
#define SLIPPED 1e-5    /* m: an end that is less far from its place holds it */
#define TURNS 0.1       /* of its rate: a winch that turns more slowly may be stalling */
enum
{
  STALLED_AFTER = 30, /* steps for which it hardly turned: a jerk alone stalls no winch */
  CALM_EVERY = 10     /* steps between looks at the error of a line that is solved ahead */
};

/* True if a vehicle turns a clamp of tether I in this step.  */
static int
is_turned (const bt_dive *dive, bt__state *state, int i)
{
  int any = 0;
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      if (vehicle >= 0 && bt__is_clamped (&dive->model->tethers[i], k))
        any |= bt__dive_vehicle (dive, dive->now, vehicle)->heading
               != bt__dive_vehicle (dive, state, vehicle)->heading;
    }
  return any;
}

static int
may_sleep_on (bt_dive *dive, bt__state *state, int i, const bt__tether *tether,
              const bt__ends *ends)
{
  return tether->quiet >= BT__SLEEP_AFTER && tether->winch_rate == 0
         && bt__is_unchanged (dive, state, tether, ends) && !bt__movers_move (dive)
         && bt__hulls_rest (dive, state, i) && !is_turned (dive, state, i);
}

bt_status
bt__step_part (bt_dive *dive, bt__state *state, int i, int part, const bt__dynamic_input *input,
               bt__dynamic_report *report, bt_error *error)
{
  bt_status status = bt__step_among (dive, state, i, part, input, report, error);
  if (status == BT_OK && bt__has_obstacles (dive))
    bt__wear_chain (dive, state, i, part);
  dive->profile.chain_parts += dive->contact_work.since > 0 || dive->contact_work.left > 0;
  dive->profile.chain_solves += (uint64_t)report->solves;
  dive->profile.chain_slips += (uint64_t)report->slips;
  dive->profile.chain_safeguarded += report->safeguarded != 0;
  dive->profile.chain_unconverged += !report->converged;
  return status;
}

/* The far part of a parted line: its new end is free, the other goes with the vehicle.  */
static bt_status
step_far_part (bt_dive *dive, bt__state *state, int i, bt__dynamic_input input,
               bt__dynamic_report *report, bt_error *error)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 1);
  bt__fastened fastened;
  bt__fasten (dive, i, 0, bt__dynamic_length (chain), &input, &fastened);
  input.end[0] = (bt__dynamic_end){ .free = 1 };
  return bt__step_part (dive, state, i, 1, &input, report, error);
}

/* The chain follows the winch with a lag, for a drum that starts or stops at once sends a wave of
   v sqrt (EA m) along the line.  TIME is left of the step, s.  */
static double
pay_of (const bt__tether *tether, const bt__dynamic *chain, double time)
{
  double owed = tether->length - bt__dynamic_length (chain);
  double lag = fabs (owed) < WINCH_REST ? 0 : tether->props.winch_lag;
  return owed / fmax (lag, time);
}

/* True if PAY hauls TETHER in and is more than the remainder of the winch's lag.  */
static int
is_hauled (const bt__tether *tether, double pay)
{
  return pay < 0 && (tether->winch_rate < 0 || -pay * BT__TIME_STEP > WINCH_REST);
}

/* The greatest length, m, that a line of P can draw off its drum in a step: no change runs along a
   line faster than its longitudinal wave.  Without this bound a brake weaker than the weight of the
   first metres would give out the whole drum.  */
static double
most_drawn (const bt_tether_props *p)
{
  return sqrt (p->ea / p->mass) * BT__TIME_STEP;
}

/* Give INPUT the action of the winch of tether I on CHAIN.  A hauling winch pulls with at most its
   greatest pull and then draws in less, or nothing.  A standing or paying-out winch holds with its
   brake, and beyond the brake gives line from the drum as fast as the line can draw.  */
static void
set_winch (const bt_dive *dive, bt__state *state, int i, const bt__tether *tether,
           const bt__dynamic *chain, bt__dynamic_input *input)
{
  double out = fmax (tether->length, bt__dynamic_length (chain));
  input->pay = pay_of (tether, chain, (1 - dive->contact_work.since) * BT__TIME_STEP);
  input->hold = tether->props.winch_brake;
  input->room = fmax (0, bt__most_out (dive, state, i) - out - input->pay * input->h);
  input->room = fmin (input->room, most_drawn (&tether->props));
  if (is_hauled (tether, input->pay))
    {
      input->hold = bt__winch_pull (&tether->props);
      input->room = -input->pay * input->h;
    }
  if (!isfinite (input->hold))
    input->hold = 0;
}

/* Note that the winch of tether I was held back while hauling CHAIN from BEFORE metres for H
   seconds: the winch goes on from its actual speed, and stalls when it has hardly turned for a
   while.  */
static void
hold_back (const bt_dive *dive, bt__state *state, int i, const bt__dynamic *chain, double before,
           double h)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  int ended = dive->contact_work.left == 0;
  double length = fmin (bt__dynamic_length (chain), before);
  double speed = (before - length) / h, rate = -tether->winch_rate;
  tether->length = fmax (tether->length, length - speed * tether->props.winch_lag);
  tether->stalling
      = speed < TURNS * fmin (rate, tether->props.winch_rate) ? tether->stalling + ended : 0;
  if (tether->stalling > STALLED_AFTER || tether->winch_rate == 0)
    bt__stall_winch (state, tether, i, length);
}

/* After a step of CHAIN from BEFORE metres: a hauling winch was held back if the line pulled with
   the winch's greatest pull, or if nothing came in; any other winch counts the length drawn off its
   drum.  */
static void
heed_winch (const bt_dive *dive, bt__state *state, int i, const bt__dynamic *chain, double before,
            const bt__dynamic_input *input, const bt__dynamic_report *report)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  if (!is_hauled (tether, input->pay))
    tether->length = fmin (tether->length + report->given, bt__most_out (dive, state, i));
  else if (report->given > 0 || bt__dynamic_length (chain) >= before)
    hold_back (dive, state, i, chain, before, input->h);
  else
    tether->stalling = 0;
}

/* The interval of CHAIN with the greatest tension, the first or the last if an end pulls harder;
   and that tension, N.  The report of the step tells an interval of the mesh before nodes came or
   went.  */
static int
most_tense (const bt__dynamic *chain, double *greatest)
{
  const double *tension = bt__dynamic_tension (chain);
  double most = -INFINITY;
  int at = 0;
  for (int j = 0; j < chain->n; j++)
    if (tension[j] > most)
      {
        most = tension[j];
        at = j;
      }
  for (int k = 0; k < 2; k++)
    if (bt__norm (chain->pull[k]) > most)
      {
        most = bt__norm (chain->pull[k]);
        at = k ? (int)chain->n - 1 : 0;
      }
  *greatest = most;
  return at;
}

/* Part tether I in the middle of the interval that bears most, if beyond its breaking load: a whole
   tether by the greatest tension of the step, TENSION, each part of a parted one by the part's own
   at the end.  A part of one interval parts no more.  */
static void
part_overloaded (bt_dive *dive, bt__state *state, int i, double tension)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  for (int part = bt__chains (tether) - 1; part >= 0; part--)
    {
      const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
      double own;
      int at = most_tense (chain, &own), stub = tether->parted && chain->n == 1;
      if (!stub && (tether->parted ? own : tension) > tether->props.breaking_load)
        bt__part_chain (dive, state, i, part, at, 0.5);
    }
}

/* Where end K of tether I is to be at the share GONE of the step, which takes the end FROM a place
   TO another.  Away along the line it goes straight: an end that starts at once sends a wave of
   m c V, however many parts.  Otherwise its speed grows out of that of the step before, for half an
   interval would pull against a start at once by the more, the more parts, and leave a vehicle
   behind that pulls with no more than its pull.  */
static bt_vec3
end_within (const bt_dive *dive, int i, int k, double gone, bt_vec3 from, bt_vec3 to)
{
  const bt__tether *now = bt__dive_tether (dive, dive->now, i);
  const bt__dynamic *chain = bt__dive_chain (dive, dive->now, i, k && now->parted);
  bt_vec3 way = bt__sub (to, from);
  if (!bt__is_cable (now))
    return bt__axpy (from, gone, way);
  const bt_vec3 *x = bt__dynamic_x (chain), *v = bt__dynamic_v (chain);
  int64_t end = k ? chain->n : 0, next = k ? end - 1 : 1;
  bt_vec3 out = bt__unit_or (bt__sub (x[end], x[next]), bt__vec (0, 0, 0));
  bt_vec3 late = bt__axpy (way, -BT__TIME_STEP, v[end]);
  late = bt__axpy (late, -fmax (0, bt__dot (late, out)), out);
  return bt__axpy (bt__axpy (from, gone, way), -gone * (1 - gone) * (1 - gone), late);
}

/* By how much end K of tether I, which slips, is not where it was to be at the start of the present
   part, on its way from FROM to TO.  */
static bt_vec3
slipped (const bt_dive *dive, bt__state *state, int i, int k, bt_vec3 from, bt_vec3 to)
{
  const bt__dynamic *chain
      = bt__dive_chain (dive, state, i, k && bt__dive_tether (dive, state, i)->parted);
  bt_vec3 planned = end_within (dive, i, k, dive->contact_work.since, from, to);
  bt_vec3 off = bt__sub (bt__dynamic_x (chain)[k ? chain->n : 0], planned);
  return bt__slips_at (dive, state, i, k) && bt__norm (off) > SLIPPED ? off : bt__vec (0, 0, 0);
}

/* What the kernel is told of tether I for the present part of the step, which began with its ends
   at FROM.  */
static bt_status
input_of_part (const bt_dive *dive, bt__state *state, int i, const bt__ends *from,
               const bt__ends *to, bt_water *water, bt__dynamic_input *input, bt_error *error)
{
  const bt__contact_work *part = &dive->contact_work;
  int vehicle = bt__carried_vehicle (dive, state, i);
  double h = BT__TIME_STEP * (1 - part->since - part->left), gone = 1 - part->left;
  bt__ends ends = *to;
  bt_status status = BT_OK;
  *water = bt__dive_water (dive, state);
  if (part->left > 0)
    {
      water->time -= part->left * BT__TIME_STEP;
      ends.a = end_within (dive, i, 0, gone, from->a, to->a);
      ends.b = end_within (dive, i, 1, gone, from->b, to->b);
    }
  if (part->since > 0)
    {
      ends.a = bt__add (ends.a, slipped (dive, state, i, 0, from->a, to->a));
      ends.b = bt__add (ends.b, slipped (dive, state, i, 1, from->b, to->b));
    }
  if (vehicle >= 0 && (part->since > 0 || dive->driven[vehicle].in.h != h))
    status = bt__grip_body (dive, state, vehicle, i, h, error);
  *input = bt__chain_input (dive, state, i, water, &ends);
  input->h = h;
  return status;
}

bt_status
bt__advance_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *from, const bt__ends *to,
                   bt__dynamic_report *report, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  double beyond = bt__beyond_chain (dive, state, i), before = bt__dynamic_length (chain);
  bt_water water;
  bt__dynamic_input input;
  bt__dynamic_report far = { .converged = 1, .bend_radius = HUGE_VAL };
  bt__fastened fastened;
  bt_status status = input_of_part (dive, state, i, from, to, &water, &input, error);
  if (status == BT_OK && tether->parted)
    {
      status = step_far_part (dive, state, i, input, &far, error);
      input.end[1] = (bt__dynamic_end){ .free = 1 };
    }
  if (status != BT_OK)
    return status;
  bt__fasten (dive, i, beyond, INFINITY, &input, &fastened);
  set_winch (dive, state, i, tether, chain, &input);
  input.mesh = bt__chain_mesh (dive, state, tether, i);
  input.mesh.idle &= dive->contact_work.left == 0;
  status = bt__step_part (dive, state, i, 0, &input, report, error);
  if (status != BT_OK)
    return status;
  heed_winch (dive, state, i, chain, before, &input, report);
  bt__add_report (&far, report);
  *report = far;
  bt__ends here = bt__tether_ends (dive, state, i); /* where obstacles let the ends come */
  tether->shape.a = here.a;
  tether->shape.b = here.b;
  tether->shape.length = tether->length;
  tether->stale = 0;
  return bt__bring_vehicle (dive, state, i, error);
}

bt_status
bt__step_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__dynamic_report report = { 0 };
  bt_status status;
  bt__watch_twist (dive, state, tether, i); /* a sleeping line can be twisted too */
  if (may_sleep_on (dive, state, i, tether, ends))
    {
      dive->profile.chain_sleeps++;
      for (int part = 0; part < bt__chains (tether); part++)
        bt__note_line_meetings (dive, state, i, part);
      return BT_OK;
    }
  int64_t begun = state->step - 1 - tether->stretch.gone;
  if (bt__rides_stretch (dive, state, i, ends))
    {
      bt__watch_tension (state, tether, i, bt__stretch_tension (tether));
      return !bt__is_ahead (tether) && state->step / CALM_EVERY != begun / CALM_EVERY
                 ? bt__look_at_nodes (dive, state, i, tether->look.bend, error)
                 : BT_OK;
    }
  status = bt__advance_as_asked (dive, state, i, ends, &report, error);
  if (status != BT_OK)
    return status;
  bt__watch_step (dive, state, tether, i, &report);
  if (tether->quiet == 0)
    for (int part = 0; part < bt__chains (tether); part++)
      bt__wake_touched (dive, state, i, part);
  /* The tensions of a step that did not converge prove nothing.  */
  if (report.converged && report.tension > tether->props.breaking_load)
    part_overloaded (dive, state, i, report.tension);
  else if (tether->props.model == BT_MODEL_AUTO
           && bt__is_look_due (dive, state, i, 1 / report.bend_radius))
    return bt__look_at_nodes (dive, state, i, 1 / report.bend_radius, error);
  return BT_OK;
}
