/* Vehicles held by tethers and obstacles: the agreement of a step.

   A vehicle has up to three opinions on its new place: its own motion, the ends of its tethers, and
   its hull.  At the beginning of an attempt each vehicle is given a kinematic target, as far along
   its way as the hull comes (bt__pin_vehicles).  Tethers that stop short bring the vehicle to their
   ends (bt__bring_end).  At the end bt__vehicles_agree compares ends, vehicle and hull; where they
   differ, the target is drawn back to a place that suits all, and the step is attempted again.  In
   the last attempt vehicles stay at their old places, which suit everything.

   The accuracy of the comparison is 1e-9 m, and 5e-6 m at the end of a moving line, the accuracy of
   its own step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "world/line.h"

#define SAME 1e-9 /* m */
#define AT_END                                                                                     \
  5e-6 /* m: the accuracy with which the step of a moving line holds its end at its vehicle */

static int
is_at (bt_vec3 p, bt_vec3 q)
{
  return (p.x == q.x && p.y == q.y && p.z == q.z) || bt__distance (p, q) <= SAME;
}

static bt_vec3
place_before (const bt_dive *dive, int vehicle)
{
  return bt__dive_vehicle (dive, dive->now, vehicle)->position;
}

/* An operation takes no time: a moved vehicle is at rest.  A vehicle with mass has its motion from
   the bounce.  */
static void
stand (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 p)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt_vec3 way = bt__sub (p, place_before (dive, vehicle));
  int goes = state->step != dive->now->step;
  bt__put_vehicle (v, p, goes);
  if (goes && v->rigid)
    bt__mirror_body (v);
  else if (goes)
    v->velocity = bt__scale (1 / BT__TIME_STEP, way);
}

/* Let PIN, of V, be at P.  */
static void
put_pin (bt__pin *pin, const bt__vehicle *v, bt_vec3 p)
{
  pin->at = p;
  if (!v->rigid)
    return;
  pin->body = v->body;
  pin->body.position = p;
}

/* How far the hull of VEHICLE comes toward WANTED within the reach of its tethers: a sliding hull
   may leave the reach.  */
static bt_vec3
reach_within (bt_dive *dive, bt__state *state, int vehicle, bt_vec3 wanted)
{
  bt_vec3 before = place_before (dive, vehicle);
  for (int k = 0; k < 2; k++)
    {
      bt_vec3 p = bt__hull_reach (dive, state, vehicle, wanted);
      double share = is_at (p, wanted) ? 1 : bt__reach_along (dive, dive->now, vehicle, before, p);
      if (share >= 1)
        return p;
      wanted = bt__axpy (before, share, bt__sub (p, before));
    }
  return bt__hull_reach (dive, state, vehicle, before);
}

/* Bring the vehicle toward WANTED as far as the hull comes; a moving line that carries the vehicle
   decides later.  */
static void
come (bt_dive *dive, bt__state *state, int vehicle, bt_vec3 wanted)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt_vec3 reach = reach_within (dive, state, vehicle, wanted);
  put_pin (&dive->contact_work.pin[vehicle], v, reach);
  if (is_at (reach, v->position))
    return;
  stand (dive, state, vehicle, reach);
  v->held = 1;
}

/* Stay where and as it was.  */
static void
stay (bt_dive *dive, bt__state *state, int vehicle)
{
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  const bt__vehicle *before = bt__dive_vehicle (dive, dive->now, vehicle);
  v->heading = before->heading;
  v->body = before->body;
  v->body.velocity = v->body.spin = bt__vec (0, 0, 0);
  dive->contact_work.pin[vehicle] = (bt__pin){ BT__PIN_HARD, before->position, v->body };
  stand (dive, state, vehicle, before->position);
}

void
bt__pin_vehicles (bt_dive *dive, bt__state *state, int round)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      bt__pin *pin = &dive->contact_work.pin[i];
      const bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      if (round == 0)
        pin->how = BT__PIN_OFF;
      if (round >= BT__TRIES || bt__is_held_by_line (dive, i))
        stay (dive, state, i);
      else
        come (dive, state, i, pin->how ? pin->at : v->position);
    }
}

void
bt__unpin_vehicles (bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      const bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      dive->contact_work.pin[i].how = BT__PIN_OFF;
      put_pin (&dive->contact_work.pin[i], v, v->position);
    }
}

int
bt__pinned (const bt_dive *dive, int vehicle)
{
  return dive->contact_work.pin && dive->contact_work.pin[vehicle].how;
}

/* Where VEHICLE is when its tether ends at P.  */
static bt_vec3
place_for (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 p)
{
  bt_vec3 at = bt__dive_vehicle (dive, state, vehicle)->position;
  return bt__add (p, bt__sub (at, bt__attachment (dive, state, vehicle)));
}

void
bt__bring_end (const bt_dive *dive, bt__state *state, int i, int k, bt_vec3 p)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  bt__vehicle *v;
  if (vehicle < 0 || bt__is_shared (dive, vehicle))
    return;
  v = bt__dive_vehicle (dive, state, vehicle);
  stand (dive, state, vehicle, place_for (dive, state, vehicle, p));
  v->held = 1;
  if (!v->rigid)
    return;
  v->body.velocity = bt__vec (0, 0, 0);
  bt__mirror_body (v);
}

/* Take *AT back to P if that is less far from BEFORE; return true if P is another place.  */
static int
draw_back (bt_vec3 p, bt_vec3 before, bt_vec3 *at)
{
  if (is_at (p, *at))
    return 0;
  if (bt__distance (p, before) < bt__distance (*at, before))
    *at = p;
  return 1;
}

/* True if tether I, a moving line, has its end at END for HERE: so near to its vehicle that the
   step need not be taken again.  */
static int
holds_end (const bt_dive *dive, bt__state *state, int i, bt_vec3 end, bt_vec3 here)
{
  return bt__is_cable (bt__dive_tether (dive, state, i)) && bt__distance (end, here) <= AT_END;
}

/* Where end K of tether I is.  A line that is ahead of the present is told by its ends alone.  */
static bt_vec3
place_of_end (const bt_dive *dive, bt__state *state, int i, int k)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  if (bt__is_ahead (tether))
    return k ? tether->shape.b : tether->shape.a;
  bt__line line = bt__line_of (dive, state, i);
  return bt__line_end (&line, k);
}

/* True if end K of tether I, made fast to a vehicle, is elsewhere than the vehicle: at *END.  */
static int
has_left (const bt_dive *dive, bt__state *state, int i, int k, bt_vec3 *end)
{
  bt_vec3 here = bt__attachment (dive, state, dive->model->ends[i][k].vehicle);
  *end = place_of_end (dive, state, i, k);
  return !is_at (*end, here) && !holds_end (dive, state, i, *end, here);
}

int
bt__holds_ends (const bt_dive *dive, bt__state *state, int i)
{
  bt_vec3 end;
  for (int k = 0; k < 2; k++)
    if (dive->model->ends[i][k].vehicle >= 0 && has_left (dive, state, i, k, &end))
      return 0;
  return 1;
}

/* Draw *AT back to where the ends of the tethers of VEHICLE let it be; true if that is another
   place.  */
static int
draw_back_to_ends (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 before, bt_vec3 *at)
{
  int differ = 0;
  bt_vec3 end;
  for (int i = 0; i < dive->model->n_tethers; i++)
    for (int k = 0; k < 2; k++)
      if (dive->model->ends[i][k].vehicle == vehicle && has_left (dive, state, i, k, &end))
        differ |= draw_back (place_for (dive, state, vehicle, end), before, at);
  return differ;
}

static int
agrees (bt_dive *dive, bt__state *state, int vehicle)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt__pin *pin = &dive->contact_work.pin[vehicle];
  bt_vec3 before = place_before (dive, vehicle), at = v->position;
  int differ = draw_back_to_ends (dive, state, vehicle, before, &at);
  int turned = v->rigid && memcmp (&pin->body.attitude, &v->body.attitude, sizeof (bt__quat)) != 0;
  if (bt__has_obstacles (dive)
      && (turned || !is_at (pin->at, v->position))) /* its hull has not gone there yet */
    differ |= draw_back (bt__hull_reach (dive, state, vehicle, v->position), before, &at);
  if (differ)
    {
      *pin = (bt__pin){ BT__PIN_HARD, at, v->body };
      pin->body.position = at;
    }
  return !differ;
}

int
bt__vehicles_agree (bt_dive *dive, bt__state *state)
{
  int agree = 1;
  for (int i = 0; i < dive->model->n_vehicles; i++)
    agree &= agrees (dive, state, i);
  return agree;
}
