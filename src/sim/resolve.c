/* Solve anew the tethers that changed, and only those.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/form_step.h"
#include "sim/share.h"

/* Greatest number of calls, for solvers that do bounded work in each call.  */
enum
{
  TRIES = 20
};

int
bt__are_ends (const bt__ends *ends, const bt__shape *shape)
{
  return memcmp (&ends->a, &shape->a, sizeof ends->a) == 0
         && memcmp (&ends->b, &shape->b, sizeof ends->b) == 0;
}

int
bt__is_unchanged (const bt_dive *dive, const bt__state *state, const bt__tether *tether,
                  const bt__ends *ends)
{
  bt_water water = bt__dive_water (dive, state);
  return !tether->stale && bt__are_ends (ends, &tether->shape)
         && tether->shape.length == tether->length && !bt_water_is_unsteady (&water);
}

/* The largest tension among the places where the models can have it: ends, middle, nodes.  */
static double
largest_tension (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions)
{
  int known = bt__has_nodes (shape->form), n = known ? (int)shape->n : 2;
  double most = 0;
  for (int k = 0; k <= n; k++)
    {
      double t = known ? bt__norm (tensions[k])
                       : bt__shape_tension (shape, nodes, tensions, shape->length * k / n);
      if (t > most)
        most = t;
    }
  return most;
}

static int
is_good_shape (const bt__shape *shape, const bt__tether *tether, const bt_vec3 *nodes)
{
  int good = isfinite (tether->tension_max);
  for (int k = 0; bt__has_nodes (shape->form) && k <= shape->n; k++)
    good = good && bt__is_finite (nodes[k]);
  return good;
}

bt_status
bt__solve_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                 const bt_tether_props *props, double pull, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_water water = bt__dive_water (dive, state);
  bt__store_changes (dive, i);
  bt__shape_input input = { .a = ends->a,
                            .b = ends->b,
                            .length = tether->length,
                            .pull = pull,
                            .props = props,
                            .water = &water };
  bt_status status = bt__shape_solve (&input, &dive->tools, &dive->counts, &tether->shape,
                                      &tether->memory, bt__dive_nodes (dive, state, i),
                                      bt__dive_tensions (dive, state, i), error);
  return status == BT_OK ? bt__stopped (&dive->asker, error) : status;
}

/* The pull, N, that the static shape of tether I is solved with.  */
static double
pull_for_solve (const bt_dive *dive, bt__state *state, int i)
{
  return bt__dive_tether (dive, state, i)->taut ? bt__pull_on (dive, state, i) : 0;
}

/* Those models know no surface.  The thesis' are as the thesis has them.  */
static int
may_float (const bt__tether *tether)
{
  int model = (int)tether->props.model;
  return (model == BT_MODEL_ELASTIC || model == BT_MODEL_STEADY) && tether->props.wet_weight < 0;
}

/* An operation takes no time: its answer is the shape at rest.  */
static int
is_operation (const bt_dive *dive, const bt__state *state)
{
  return state->step == dive->now->step;
}

/* Solve tether I between ENDS.  A shape laid on the surface is no start for the solver, so its
   equilibrium is found anew.  In a step, a shape not yet at rest goes on relaxing in the next step.
 */
static bt_status
solve_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, double pull,
             bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  int tries = tether->shape.form == BT__FORM_AFLOAT || is_operation (dive, state) ? TRIES : 1;
  uint64_t before;
  bt_status status;
  for (int k = 0;; k++)
    {
      before = dive->counts.unsettled;
      status = bt__solve_shape (dive, state, i, ends, &tether->props, pull, error);
      if (status != BT_OK || k == tries - 1 || dive->counts.unsettled == before)
        break;
      if (is_operation (dive, state) && bt__poll (dive, (double)k / tries, error) != BT_OK)
        return BT_ERR_INTERRUPTED;
    }
  tether->settled = dive->counts.unsettled == before;
  return status;
}

bt_status
bt__solve_static (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  double pull = pull_for_solve (dive, state, i);
  bt_vec3 *nodes = bt__dive_nodes (dive, state, i);
  int had_nodes = bt__has_nodes (tether->shape.form);
  bt_status status = solve_shape (dive, state, i, ends, pull, error);
  if (status != BT_OK)
    return status;
  if (may_float (tether))
    bt__lay_shape_afloat (dive, state, i);
  if (!had_nodes && bt__has_nodes (tether->shape.form))
    bt__clear_unused_nodes (dive, state, i);
  tether->tension_max = largest_tension (&tether->shape, nodes, bt__dive_tensions (dive, state, i));
  tether->pull = pull;
  tether->stale = !tether->settled; /* a shape that still moves goes on next step */
  if (!is_good_shape (&tether->shape, tether, nodes))
    return bt__fail (error, BT_ERR_DIVERGED, "the shape of tether `%s' is not finite at t = %g s",
                     dive->model->tethers[i].name, bt__state_time (state));
  dive->profile.current_samples_skipped += state->current.kind == BT_CURRENT_STILL;
  return BT_OK;
}

/* ---- Forms ---- */

/* The nodes of the chain that tether I was become those of a shape.  */
static bt_status
lay_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  (void)ends, (void)error;
  bt__still_chain (dive, state, i);
  return BT_OK;
}

static int
shape_rests (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  return tether->pull == pull_for_solve (dive, state, i)
         && bt__is_unchanged (dive, state, tether, ends);
}

static bt_status
step_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  if (!shape_rests (dive, state, i, ends))
    return bt__solve_static (dive, state, i, ends, error);
  dive->profile.shape_skips++;
  return BT_OK;
}

const bt__form_step bt__step_shape = { lay_shape, step_shape, step_shape, shape_rests };

static bt_status
carry_cable (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt_status status = bt__carry_chain (dive, state, i, ends, error);
  if (status == BT_OK)
    bt__note_pull (dive, state, i);
  return status;
}

static int
cable_rests (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  (void)dive, (void)state, (void)i, (void)ends;
  return 1; /* CARRY leaves a line that has its ends where they are to be */
}

const bt__form_step bt__step_cable = { bt__lay_chain, carry_cable, bt__step_chain, cable_rests };

bt__tether_form
bt__wanted_form (const bt_dive *dive, const bt__tether *tether)
{
  if (bt__is_moving_model (tether))
    return BT__TETHER_CABLE;
  if (!bt__has_obstacles (dive))
    return BT__TETHER_SHAPE;
  return tether->props.model < BT_MODEL_ELASTIC ? BT__TETHER_SPANS : BT__TETHER_HELD;
}

const bt__form_step *
bt__form_step_of (bt__tether_form form)
{
  static const bt__form_step *const steps[BT__TETHER_FORMS] = {
    [BT__TETHER_SHAPE] = &bt__step_shape,
    [BT__TETHER_SPANS] = &bt__step_spans,
    [BT__TETHER_HELD] = &bt__step_held,
    [BT__TETHER_CABLE] = &bt__step_cable,
  };
  return steps[form];
}

/* ---- One tether, all tethers ---- */

/* Give tether I the wanted form and bring the tether to ENDS.  */
static bt_status
bring_to_ends (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int passes,
               bt_error *error)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__tether_form wanted = bt__wanted_form (dive, tether);
  const bt__form_step *form = bt__form_step_of (wanted);
  bt_status status = BT_OK;
  if (tether->parted && wanted != BT__TETHER_CABLE)
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "tether `%s' has parted: only the model `dynamic' moves it",
                     dive->model->tethers[i].name);
  if (bt__tether_form_of (tether) != wanted)
    status = form->lay (dive, state, i, ends, error);
  if (status != BT_OK)
    return status;
  if (!passes || wanted == BT__TETHER_CABLE)
    return (passes ? form->step : form->carry) (dive, state, i, ends, error);
  return bt__slip_to_ends (dive, state, i, ends, form->step, error);
}

/* True if tethers could meet each other, or hulls.  */
static int
are_others (const bt_dive *dive)
{
  return dive->model->n_tethers > 1 || dive->model->n_hulls > 0;
}

bt_status
bt__resolve_tether (bt_dive *dive, bt__state *state, int i, int passes, bt_error *error)
{
  bt__ends ends = bt__tether_ends (dive, state, i);
  bt_status status = bring_to_ends (dive, state, i, &ends, passes, error);
  if (are_others (dive) && bt__box_line (dive, state, i) && dive->context)
    dive->context->refused = 1; /* others were told that it is where it was */
  if (status == BT_OK)
    bt__ask (&dive->asker);
  /* What an equation left half solved says is no error of the dive.  */
  bt_status left = dive->context ? BT_OK : bt__stopped (&dive->asker, error);
  return left != BT_OK ? left : status;
}

/* Say in which order the tethers of STATE are to be resolved.  */
static void
line_up (bt_dive *dive, bt__state *state)
{
  if (are_others (dive))
    bt__order_tethers (dive, state);
  else
    for (int i = 0; i < dive->model->n_tethers; i++)
      dive->contact_work.order[i] = i;
  bt__put_carriers_first (dive, state);
}

bt_status
bt__resolve_tethers (bt_dive *dive, bt__state *state, int passes, bt_error *error)
{
  bt_status status = BT_OK;
  if (passes)
    bt__leave_barred (dive, state);
  if (are_others (dive))
    bt__box_lines (dive, state);
  bt__near_hulls (dive, state, passes);
  line_up (dive, state);
  if (passes && dive->contexts && bt__share_tethers (dive, state))
    return bt__stopped (&dive->asker, error);
  for (int i = 0; status == BT_OK && i < dive->model->n_tethers; i++)
    status = bt__resolve_tether (dive, state, dive->contact_work.order[i], passes, error);
  return status;
}
