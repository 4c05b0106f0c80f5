/* Remeshing: the number of nodes of a moving line, for the winch and for model `auto'.

   Model `auto' chooses the number of nodes by the accuracy asked for.  The discretisation error is
   estimated from the curvature of the line and falls with the square of the number of nodes.  The
   line gets more nodes if the estimate exceeds the accepted error, and fewer if the estimate is far
   below; the gap between the two bounds is the hysteresis.  The new nodes lie on a smooth curve
   through the old ones, but for what keeps the tensions (tether/dynamic_fit.c).

   The nodes are looked at every BT__REMESH_EVERY steps, and as soon as the line bends much more
   sharply than at the last look.  A taut line that is let go folds within a few steps.  The nodes
   of that moment decide about the fold, and nodes added later do not put the fold right.  Therefore
   even a straight line has some nodes (fewest_of), and the error of a line with few nodes counts
   for a while.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/lay.h"
#include "world/line.h"

/* Shares of the accuracy: the error aimed at, and the error below which nodes are saved.  An error
   once made persists, in still water for long, so the momentary estimate is kept well below the
   accepted error.  */
#define AIM 0.3
#define TOO_GOOD 0.06
#define SPARE 1.15 /* times the nodes the estimate asks for */

/* Greatest strain of a new interval relative to the old line.  A coarse line about a corner is no
   cubic: a cubic through its nodes swings out beside the corner, and may be longer than the line by
   a third.  */
#define STRETCH 0.01
enum
{
  FEWEST = 30, /* intervals of a line, ... */
  LEAST = 8    /* ... and of a line in open water, asked for less than usual */
};
#define STRAIGHT 0.97 /* of its length: the distance of its ends */

/* A bend so many times as sharp as the sharpest at the last look is looked at.  */
#define SHARPER 1.25

/* 1/s: the rate at which the error of fewer nodes is forgotten.  */
#define FORGETS 0.6

/* A line hauled in, or crumpled, is not cut into shorter intervals than this, m.  */
#define SHORTEST 0.05

#define WINCH_AIM 0.5 /* of the accuracy: the standard for nodes that come and go */

/* The fewest intervals of TETHER, of model `auto'.  The error of a fold falls with the square of
   the number.  A nearly straight line may be let go at any time; among obstacles contact takes
   hold of nodes.  */
static int
fewest_of (const bt_dive *dive, const bt__tether *tether)
{
  double chord = bt__distance (tether->shape.a, tether->shape.b);
  if (bt__has_obstacles (dive) || tether->parted || chord > STRAIGHT * tether->length)
    return FEWEST;
  double share = BT__ACCURATE_SHARE * tether->length / bt__accuracy (tether);
  return (int)fmax (LEAST, ceil (FEWEST * sqrt (fmin (1, share))));
}

/* The mesh of tether I; a line with its original length keeps its original nodes: its mesh has no
   error to keep to.  */
bt__dynamic_mesh
bt__chain_mesh (const bt_dive *dive, const bt__state *state, const bt__tether *tether, int i)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  int adapts = tether->props.model == BT_MODEL_AUTO, wound = tether->length != def->length;
  int wanted = adapts ? fewest_of (dive, tether) : (int)tether->props.nodes;
  int fewest = (int)fmax (1, fmin (wanted, tether->length / SHORTEST));
  return (bt__dynamic_mesh){ .fewest = fewest,
                             .most = (int)fmax (wanted, bt__mesh_room (def)),
                             .error
                             = wound ? WINCH_AIM * bt__accuracy (tether) / BT__CHAIN_ERROR : 0,
                             .shortest = SHORTEST,
                             .idle = !adapts && wound && state->step % BT__REMESH_EVERY == 0,
                             .corners = def->n_lumps > 0 };
}

/* How many intervals the chain of N with the estimated ERROR should have: FEWEST at least, and at
   most ROOM.  */
static int
wanted (int n, double error, double accuracy, int fewest, int room)
{
  double ideal = SPARE * n * sqrt (error / (AIM * accuracy));
  if (n >= fewest && error <= AIM * accuracy && error >= TOO_GOOD * accuracy)
    return n;
  return (int)fmax (fewest, fmin (room, ceil (ideal)));
}

/* Among obstacles a line is refined by whole multiples: its nodes stay.  */
static int
multiple (int n, int m, int room)
{
  int times = (m + n - 1) / n;
  return m < n ? m : times * n <= room ? times * n : n;
}

/* The weight of the chords in a blend of chords and cubic: the least weight for which no interval
   between the N + 1 points P of CHAIN, of LENGTH m, is strained by more than STRETCH beyond the
   chords.  */
static double
share_of_chords (const bt__dynamic *chain, double length, const bt_vec3 *p, int n)
{
  double share = 0, most = (1 + STRETCH) * length / n;
  bt_vec3 last = p[0];
  for (int k = 1; k <= n; k++)
    {
      bt_vec3 next = bt__dynamic_chord_point (chain, length * k / n);
      double straight = bt__distance (last, next), bent = bt__distance (p[k - 1], p[k]);
      double allowed = fmax (most, straight);
      if (bent > allowed)
        share = fmax (share, (bent - allowed) / (bent - straight));
      last = next;
    }
  return share;
}

/* Blend the N + 1 points P of CHAIN, of LENGTH m, with the chords by the weight above.  */
static void
straighten (const bt__dynamic *chain, double length, bt_vec3 *p, int n)
{
  double share = share_of_chords (chain, length, p, n);
  for (int k = 1; k < n && share > 0; k++)
    {
      bt_vec3 to = bt__dynamic_chord_point (chain, length * k / n);
      p[k] = bt__axpy (p[k], share, bt__sub (to, p[k]));
    }
}

/* Take N + 1 points, velocities and tensions off LINE.  */
static void
sample (bt_dive *dive, const bt__line *line, int n)
{
  double length = bt__line_length (line);
  for (int k = 0; k <= n; k++)
    {
      double s = length * k / n;
      dive->polyline[k] = bt__dynamic_point (line->chain, s);
      dive->motion[k] = bt__dynamic_velocity (line->chain, s);
      dive->along[k] = bt__line_tension (line, length * fmin (k + 0.5, n) / n);
    }
  straighten (line->chain, length, dive->polyline, n);
}

/* Take N + 1 points off LINE that keep its tensions; where there are none, points of its curve.  */
static void
sample_tensions (bt_dive *dive, const bt__line *line, int n)
{
  sample (dive, line, n);
  bt__dynamic_measure (line->chain, n, dive->fit);
  if (!bt__dynamic_fit (dive->polyline, dive->motion, n, dive->fit))
    sample (dive, line, n);
}

/* True if no obstacle, no line, and no other part of a parted tether is on the way of PART of
   tether I to N intervals.  */
static int
has_way (bt_dive *dive, bt__state *state, int i, int part, int n)
{
  if (bt__has_obstacles (dive))
    return bt__may_remesh (dive, state, i, part, n);
  double way = bt__way_of_remesh (dive, state, i, part, n);
  return bt__has_room_about (dive, state, i, way)
         && (!bt__dive_tether (dive, state, i)->parted
             || way < bt__spare_among_lines (dive, state, i, part));
}

static bt_status
lay_anew (bt_dive *dive, bt__state *state, int i, int part, int n, bt_error *error)
{
  bt__line whole = bt__line_of (dive, state, i);
  bt__line line = part ? bt__line_tail (&whole) : whole;
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  bt_vec3 pull[2] = { chain->pull[0], chain->pull[1] };
  double length = bt__line_length (&line);
  bt_status status;
  bt__dynamic twisted = *chain;
  int keeps = bt__layers_slip (&tether->props) || tether->props.gj * tether->props.ei > 0;
  sample_tensions (dive, &line, n);
  if (keeps)
    bt__slipped_along (chain, n, dive->corner);
  if (!has_way (dive, state, i, part, n))
    return BT_OK;
  status = bt__dynamic_init (chain, bt__chain_room (&dive->model->tethers[i]), n, dive->polyline,
                             n + 1, length, tether->props.ea, error);
  if (status != BT_OK)
    return status;
  memcpy (bt__dynamic_v (chain), dive->motion, sizeof (bt_vec3) * (size_t)(n + 1));
  memcpy (bt__dynamic_tension (chain), dive->along, sizeof (double) * (size_t)n);
  if (keeps)
    memcpy (bt__dynamic_load (chain), dive->corner, sizeof (bt_vec3) * (size_t)(n + 1));
  bt__twist_copy (chain, &twisted);
  chain->pull[0] = pull[0];
  chain->pull[1] = pull[1];
  dive->profile.chain_remeshes++;
  return BT_OK;
}

/* True if, in a world without obstacles, PART of tether I is too near to itself for a change of
   nodes.  */
static int
is_near_itself (const bt_dive *dive, bt__state *state, int i, int part)
{
  return !bt__has_obstacles (dive)
         && (bt__dive_chain (dive, state, i, part)->wait > 0
             || bt__dive_anchors (dive, state, i, part)->n > 0);
}

/* ---- Looks ---- */

/* The curvature, 1/m, that adds no error to be heeded even along all of a part of tether I.  */
static double
harmless_bend (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  double error = AIM * bt__accuracy (tether) / BT__CHAIN_ERROR, least = INFINITY;
  for (int part = 0; part < bt__chains (tether); part++)
    {
      const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
      double length = bt__dynamic_length (chain), h = length / (double)chain->n;
      least = fmin (least, sqrt (24 * error / length) / h);
    }
  return least;
}

int
bt__is_look_due (const bt_dive *dive, bt__state *state, int i, double bend)
{
  double last = bt__dive_tether (dive, state, i)->look.bend;
  return state->step % BT__REMESH_EVERY == 0
         || (bend > SHARPER * last && bend > SHARPER * harmless_bend (dive, state, i));
}

/* Note a look at tether I: the tightest bend BEND, and MOST, an upper estimate of the error of the
   nodes.  */
static void
note_look (const bt_dive *dive, bt__state *state, int i, double bend, double most)
{
  bt__look *look = &bt__dive_tether (dive, state, i)->look;
  double gone = fmax (0, (double)(state->step - look->step)) * BT__TIME_STEP,
         error = BT__COMMON_ERROR * most,
         left = fmax (0, look->error - error) * exp (-FORGETS * gone);
  *look = (bt__look){ .step = state->step, .error = error + left, .bend = bend };
}

/* Give PART of tether I as many intervals as the accuracy asks for, unless contacts forbid a
   change; MOST is the upper estimate of the error with the present nodes.  */
static bt_status
remesh (bt_dive *dive, bt__state *state, int i, int part, double most, bt_error *error)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  int n = (int)chain->n, room = bt__adaptive_room (dive, i);
  int m = wanted (n, most, bt__accuracy (tether), fewest_of (dive, tether), room);
  if (tether->parted) /* hauled home it is short */
    m = (int)fmax (1, fmin (m, bt__dynamic_length (chain) / SHORTEST));
  if (bt__has_obstacles (dive))
    m = multiple (n, m, room);
  return m == n || chain->rounded || is_near_itself (dive, state, i, part)
                 || bt__is_by_a_hull (dive, i)
             ? BT_OK
             : lay_anew (dive, state, i, part, m, error);
}

bt_status
bt__remesh_chain (bt_dive *dive, bt__state *state, int i, bt_error *error)
{
  return remesh (dive, state, i, 0, bt__chain_error (bt__dive_chain (dive, state, i, 0)), error);
}

bt_status
bt__look_at_nodes (bt_dive *dive, bt__state *state, int i, double bend, bt_error *error)
{
  int parts = bt__chains (bt__dive_tether (dive, state, i));
  double most[2] = { 0, 0 };
  bt_status status = BT_OK;
  for (int part = 0; part < parts; part++)
    most[part] = bt__chain_error (bt__dive_chain (dive, state, i, part));
  note_look (dive, state, i, bend, fmax (most[0], most[1]));
  for (int part = 0; part < parts && status == BT_OK; part++)
    status = remesh (dive, state, i, part, most[part], error);
  return status;
}
