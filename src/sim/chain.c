/* The moving line between steps: laid, carried along with ends put elsewhere, made still, parted.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/lay.h"
#include "world/layout.h"
#include "world/line.h"

/* The equilibrium to lay a line from may take several searches.  */
enum
{
  SETTLE_TRIES = 20
};

/* Of the room of a chain: what the mesh takes of it, for contact puts in nodes, too.  */
#define MESH_SHARE 0.875

/* ---- Laying ---- */

/* Put N + 1 points of the present shape of tether I on the dive's polyline, and the tensions in the
   middles between the points along the polyline.  */
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

/* Give a CHAIN of N intervals the tensions of its shape, valid until its first step.  */
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
      if (status == BT_OK)
        status = bt__poll (dive, (double)k / SETTLE_TRIES, error);
      if (status != BT_OK || dive->counts.unsettled == unsettled || k == SETTLE_TRIES)
        return status;
    }
}

int
bt__mesh_room (const bt_tether_def *def)
{
  return (int)(MESH_SHARE * bt__chain_room (def));
}

int
bt__adaptive_room (const bt_dive *dive, int i)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  return bt__has_obstacles (dive) ? bt__mesh_room (def) : bt__chain_room (def);
}

/* How many intervals the equilibrium that tether I is laid from has.  */
int
bt__rest_nodes (const bt_dive *dive, const bt__tether *tether, int i)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  return tether->props.model == BT_MODEL_AUTO ? bt__adaptive_room (dive, i) : (int)def->props.nodes;
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
  props.nodes = bt__rest_nodes (dive, tether, i);
  status = settle_shape (dive, state, i, ends, &props, error);
  if (status == BT_OK || status == BT_ERR_INTERRUPTED)
    return status;
  props.model = BT_MODEL_CATENARY;
  props.depth_rule = BT_DEPTH_SAG;
  memset (&tether->shape, 0, sizeof tether->shape);
  return bt__solve_shape (dive, state, i, ends, &props, 0, error);
}

bt_status
bt__trace_rest (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int n,
                bt_error *error)
{
  bt_status status = BT_OK;
  bt_water water;
  if (bt__dive_tether (dive, state, i)->shape.length == 0)
    status = rest_shape (dive, state, i, ends, error);
  if (status != BT_OK)
    return status;
  trace (dive, state, i, n);
  dive->polyline[0] = ends->a;
  dive->polyline[n] = ends->b;
  water = bt__dive_water (dive, state);
  bt__lay_afloat (dive->polyline, dive->over, n, bt__dive_tether (dive, state, i)->length, &water);
  return BT_OK;
}

/* Rest lengths in the SHARE of the whole that each interval spans.  */
static void
share_out (bt__dynamic *chain, const double *share, double length)
{
  for (int64_t k = 0; k < chain->n; k++)
    {
      double chord = bt__distance (bt__dynamic_x (chain)[k], bt__dynamic_x (chain)[k + 1]);
      bt__dynamic_rest (chain)[k] = share[k] * length;
      bt__dynamic_stretch (chain)[k] = chord / (share[k] * length);
    }
}

bt_status
bt__begin_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int n,
                 const double *share, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt_tether_def *def = &dive->model->tethers[i];
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  int vehicle;
  bt__store_changes (dive, i);
  bt_status status = bt__dynamic_init (chain, bt__chain_room (def), n, dive->polyline, n + 1,
                                       tether->length, tether->props.ea, error);
  if (status != BT_OK)
    return status;
  if (share)
    {
      memcpy (bt__dynamic_x (chain), dive->polyline, sizeof (bt_vec3) * (size_t)(n + 1));
      share_out (chain, share, tether->length);
      memset (bt__dynamic_tension (chain), 0, sizeof (double) * (size_t)n);
    }
  else
    tense (dive, chain, n);
  bt__contacts_init (bt__dive_anchors (dive, state, i, 0), bt__contact_room (dive->model, def));
  memset (&tether->shape, 0, sizeof tether->shape);
  tether->shape.form = BT__FORM_CHAIN;
  tether->shape.a = ends->a;
  tether->shape.b = ends->b;
  tether->shape.length = tether->length;
  tether->contact_form = BT__TETHER_SHAPE;
  tether->parted = tether->quiet = tether->settled = tether->blocked = tether->fine = 0;
  tether->lost = tether->shed = 0;
  tether->peak = tether->unsure = 0;
  tether->stretch = (bt__stretch){ 0 };
  tether->look = (bt__look){ 0 };
  vehicle = bt__carried_vehicle (dive, state, i);
  if (vehicle >= 0)
    bt__dynamic_v (chain)[n] = bt__rigid_point_velocity (
        &bt__dive_vehicle (dive, state, vehicle)->body, dive->model->types[vehicle].attached);
  return BT_OK;
}

bt_status
bt__lay_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  int n = bt__rest_nodes (dive, tether, i);
  bt_status status;
  if (bt__has_obstacles (dive))
    return bt__lay_chain_among (dive, state, i, ends, error);
  status = bt__trace_rest (dive, state, i, ends, n, error);
  if (status == BT_OK)
    status = bt__begin_chain (dive, state, i, ends, n, NULL, error);
  if (status == BT_OK)
    status = bt__settle_bent (dive, state, i, ends, error);
  if (status != BT_OK)
    return status;
  return tether->props.model == BT_MODEL_AUTO ? bt__remesh_chain (dive, state, i, error) : BT_OK;
}

/* ---- Between steps ---- */

/* Become nodes of a static model, which looks for the equilibrium from there.  */
void
bt__still_chain (bt_dive *dive, bt__state *state, int i)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  int n = bt__rest_nodes (dive, tether, i);
  trace (dive, state, i, n);
  bt__store_changes (dive, i);
  memcpy (bt__dive_nodes (dive, state, i), dive->polyline, sizeof (bt_vec3) * (size_t)(n + 1));
  memset (bt__dive_tensions (dive, state, i), 0, sizeof (bt_vec3) * (size_t)(n + 1));
  memset (&tether->memory.reaction, 0, sizeof tether->memory.reaction);
  tether->shape.form = BT__FORM_NODES;
  tether->shape.n = n;
  bt__clear_unused_nodes (dive, state, i);
}

/* Move a part of a parted line, unchanged in shape, along with its held end.  */
static void
shift_part (bt__dynamic *chain, bt_vec3 from, bt_vec3 to)
{
  bt_vec3 way = bt__sub (to, from), *x = bt__dynamic_x (chain);
  for (int64_t k = 0; k <= chain->n; k++)
    x[k] = bt__add (x[k], way);
  chain->spare = (bt__dynamic_drift){ 0, 0, 0 };
}

/* An end was put elsewhere in no time: the line takes the equilibrium that it comes to from
   there.  */
bt_status
bt__carry_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends before = { tether->shape.a, tether->shape.b };
  bt_status status;
  if (bt__are_ends (ends, &tether->shape))
    return BT_OK;
  bt__leave_stretches (dive, state); /* the line may come to lie where another was told to go */
  bt__store_changes (dive, i);
  if (bt__has_obstacles (dive))
    return bt__drag_chain (dive, state, i, ends, error);
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

/* Cut tether I, which is whole: chain 1 becomes what hangs from its far end.  */
static void
cut_whole (bt_dive *dive, bt__state *state, int i, int interval, double share)
{
  bt__dynamic *near = bt__dive_chain (dive, state, i, 0), *far = bt__dive_chain (dive, state, i, 1);
  bt__contacts *anchors = bt__dive_anchors (dive, state, i, 0);
  int id = dive->model->n_obstacles + i;
  bt__dynamic_cut (near, interval, share, near, far);
  memcpy (bt__dive_anchors (dive, state, i, 1), anchors, bt__contacts_live (anchors));
  bt__contacts_cut (anchors, bt__dynamic_length (far), INFINITY, id);
  bt__contacts_cut (bt__dive_anchors (dive, state, i, 1), 0, bt__dynamic_length (far), id);
}

/* Cut PART of tether I, which has parted: the piece between both cuts drifts off.  */
static void
cut_part (bt_dive *dive, bt__state *state, int i, int part, int interval, double share)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  bt__contacts *anchors = bt__dive_anchors (dive, state, i, part);
  double length = bt__dynamic_length (chain), lost;
  int id = dive->model->n_obstacles + i;
  bt__dynamic_cut (chain, interval, share, part ? NULL : chain, part ? chain : NULL);
  lost = length - bt__dynamic_length (chain);
  bt__contacts_cut (anchors, part ? 0 : lost, part ? length - lost : INFINITY, id);
  bt__dive_tether (dive, state, i)->lost += lost;
}

static double
energy_left (const bt_dive *dive, bt__state *state, int i)
{
  bt_energy e = bt__line_energy (dive, state, i);
  return e.kinetic + e.strain + e.gravity + e.bending;
}

void
bt__part_chain (bt_dive *dive, bt__state *state, int i, int part, int interval, double share)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  double energy = energy_left (dive, state, i);
  bt__store_changes (dive, i);
  if (tether->parted)
    cut_part (dive, state, i, part, interval, share);
  else
    cut_whole (dive, state, i, interval, share);
  tether->parted = 1;
  tether->shed += energy - energy_left (dive, state, i);
  tether->quiet = 0;
  if (part == 0)
    {
      tether->length = bt__dynamic_length (bt__dive_chain (dive, state, i, 0));
      tether->winch_rate = 0;
    }
  bt__raise_event (state, BT_EVENT_PARTED, i);
  bt__note_taut (state, tether, i, 0);
}
