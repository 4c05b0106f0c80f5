/* A taut tether holds its vehicle: the reach is the length of the tether plus its elastic stretch.

   The vehicle is kept inside a ball for each tether, about the tether's other end.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/sim.h"

#define SMOOTH 0.1    /* share of a step in a mean */
#define NO_FORCE 1e-6 /* N */

/* Where an anchor at the point P, that of tether I, is in the waves.  */
static bt_vec3
ride (const bt_dive *dive, const bt__state *state, int i, bt_vec3 p)
{
  bt_vec3 share = dive->model->tethers[i].ride;
  bt_rider rider = { share.x, share.y, share.z, state->wave.toward };
  if (state->waves.n == 0 || bt__norm (share) == 0)
    return p;
  return bt__add (p, bt_waves_ride (&state->waves, &rider, p, bt__state_time (state)));
}

bt__ends
bt__tether_ends (const bt_dive *dive, bt__state *state, int i)
{
  const bt__end *end = dive->model->ends[i];
  bt__ends ends = { end[0].at, end[1].at };
  if (end[0].vehicle < 0)
    ends.a = ride (dive, state, i, ends.a);
  else
    ends.a = bt__attachment (dive, state, end[0].vehicle);
  if (end[1].vehicle >= 0)
    ends.b = bt__attachment (dive, state, end[1].vehicle);
  return ends;
}

/* The far point of tether I as seen from VEHICLE; zero when the tether is not fastened to it.  */
static int
fastened (const bt_dive *dive, bt__state *state, int i, int vehicle, bt_vec3 *other)
{
  const bt__end *end = dive->model->ends[i];
  bt__ends ends;
  if ((end[0].vehicle != vehicle && end[1].vehicle != vehicle)
      || bt__dive_tether (dive, state, i)->parted)
    return 0;
  ends = bt__tether_ends (dive, state, i);
  *other = end[1].vehicle == vehicle ? ends.a : ends.b;
  return 1;
}

double
bt__pull_on (const bt_dive *dive, bt__state *state, int i)
{
  double pull = 0;
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      if (vehicle >= 0)
        pull = fmax (pull, bt__dive_vehicle (dive, state, vehicle)->pull);
    }
  return pull;
}

/* How far VEHICLE may be from OTHER on tether I: as far as it can pull it, and where it was in
 * FROM.  */
static double
reach_on_tether (const bt_dive *dive, const bt__state *from, bt__state *state, int i, int vehicle,
                 bt_vec3 other)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__vehicle *before = bt__dive_vehicle (dive, (bt__state *)from, vehicle);
  double pull = before->rigid && bt__is_spring (tether) ? INFINITY : before->pull;
  double most = bt__longest_chord (&tether->props, tether->length, pull);
  double there = bt__distance (bt__attachment (dive, (bt__state *)from, vehicle), other);
  double ever = bt__longest_chord (&tether->props, tether->length, INFINITY);
  return fmax (most, fmin (there, ever));
}

/* Stop VEHICLE, with mass, on a taut line that pulls along U: a jerk without a bounce, whose mean
   over some steps is the pull.  */
static void
stop_body (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 u)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt_vec3 jerk = bt__rigid_bounce (&dive->model->types[vehicle], &v->body,
                                   bt__attachment (dive, state, vehicle), u, 0, 0);
  double force = bt__norm (jerk) / BT__TIME_STEP;
  if (force > NO_FORCE) /* else the second look at one that stands */
    v->pull += SMOOTH * (force - v->pull);
}

/* True if VEHICLE of STATE, fastened at *P, is outside the ball of tether I: farther than *REACH
 *from OTHER, the far end.  */
static int
is_outside (const bt_dive *dive, const bt__state *from, bt__state *state, int i, int vehicle,
            bt_vec3 *p, bt_vec3 *other, double *reach)
{
  if (!fastened (dive, state, i, vehicle, other))
    return 0;
  *p = bt__attachment (dive, state, vehicle);
  *reach = reach_on_tether (dive, from, state, i, vehicle, *other);
  return bt__distance (*p, *other) > *reach;
}

int
bt__is_pulled_back (const bt_dive *dive, const bt__state *from, bt__state *state, int i)
{
  int any = 0;
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      bt_vec3 p, other;
      double reach;
      any |= vehicle >= 0 && is_outside (dive, from, state, i, vehicle, &p, &other, &reach);
    }
  return any;
}

/* Pull VEHICLE back into the ball of tether I; return true if VEHICLE was outside.  */
static int
pull_back (const bt_dive *dive, const bt__state *from, bt__state *state, int i, int vehicle)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  double reach, chord;
  bt_vec3 p, other;
  if (!is_outside (dive, from, state, i, vehicle, &p, &other, &reach))
    return 0;
  chord = bt__distance (p, other);
  bt__put_vehicle (v, bt__axpy (v->position, reach / chord - 1, bt__sub (p, other)), 1);
  if (v->rigid)
    stop_body (dive, state, vehicle, bt__scale (1 / chord, bt__sub (other, p)));
  return 1;
}

int
bt__is_chord_taut (const bt__tether *tether, const bt__ends *ends)
{
  return bt__distance (ends->a, ends->b) >= tether->length * (1 - 1e-9);
}

void
bt__note_taut (bt__state *state, bt__tether *tether, int i, int taut)
{
  if (taut != tether->taut)
    bt__raise_event (state, taut ? BT_EVENT_TAUT : BT_EVENT_SLACK, i);
  tether->taut = taut;
}

/* Approach the common part of several balls by turns: two rounds bring a vehicle on several
   tethers, a rare case, within a millimetre, and the next steps the rest.  */
static int
hold_vehicle (const bt_dive *dive, const bt__state *from, bt__state *state, int vehicle)
{
  int held = 0;
  for (int round = 0; round < 2; round++)
    for (int i = 0; i < dive->model->n_tethers; i++)
      held |= pull_back (dive, from, state, i, vehicle);
  return held;
}

void
bt__hold_at_tethers (const bt_dive *dive, const bt__state *from, bt__state *state)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      bt_vec3 before = bt__dive_vehicle (dive, (bt__state *)from, i)->position;
      if (v->rigid && bt__carrier (dive, state, i) >= 0)
        continue; /* its line holds it by force */
      v->held = hold_vehicle (dive, from, state, i);
      if (v->held && v->rigid)
        bt__mirror_body (v);
      else if (v->held)
        v->velocity = bt__scale (1 / BT__TIME_STEP, bt__sub (v->position, before));
    }
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__ends ends = bt__tether_ends (dive, state, i);
      bt__tether *tether = bt__dive_tether (dive, state, i);
      if (tether->contact_form != BT__TETHER_SPANS) /* spans know by themselves */
        bt__note_taut (state, tether, i, !tether->parted && bt__is_chord_taut (tether, &ends));
    }
}

/* The largest K in [0, 1] for which A + K (B - A) lies within REACH of CENTRE, A being inside.  */
static double
ball_exit (bt_vec3 a, bt_vec3 b, bt_vec3 centre, double reach)
{
  bt_vec3 d = bt__sub (b, a), p = bt__sub (a, centre);
  double aa = bt__dot (d, d), half = bt__dot (p, d), c = bt__dot (p, p) - reach * reach;
  double root = half * half - aa * c;
  if (aa == 0 || bt__distance (b, centre) <= reach)
    return 1;
  return root <= 0 ? 0 : fmax (0, fmin (1, (-half + sqrt (root)) / aa));
}

double
bt__reach_along (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 a, bt_vec3 b)
{
  bt_vec3 arm = bt__sub (bt__attachment (dive, state, vehicle),
                         bt__dive_vehicle (dive, state, vehicle)->position);
  double k = 1;
  bt_vec3 other;
  a = bt__add (a, arm);
  b = bt__add (b, arm);
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (fastened (dive, state, i, vehicle, &other))
      k = fmin (k,
                ball_exit (a, b, other, reach_on_tether (dive, state, state, i, vehicle, other)));
  return k;
}
