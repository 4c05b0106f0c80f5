/* A moving line falling into place, or dragged into place through the water, while the clock
   stands.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/lay.h"

/* Limits of a fall into place: time, steps times nodes, and linear solves times nodes, whichever is
   reached first; and the speed below which the line rests.  Mostly a step takes three or four
   solves, one that is not solved a hundred and more.  */
#define FALL 20.0       /* s */
#define FALL_WORK 2e5   /* steps times nodes */
#define FALL_SOLVES 4e6 /* solves times nodes */
#define AT_REST 5e-3    /* m/s */

#define DRAG_SPEED 3.0 /* m/s */
enum
{
  DRAG_TRIES = 30 /* steps without getting nearer */
};
#define DRAG_LEAST 1e-4 /* m a step */

/* ---- Falling into place ---- */

static void
pin_ends (bt_dive *dive, bt__state *state, int i, int how)
{
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      if (vehicle >= 0)
        {
          const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
          dive->contact_work.pin[vehicle] = (bt__pin){ how, v->position, v->body };
        }
    }
}

/* Restore the pins of the ends of tether I from KEPT if TAKE is true, else save them to KEPT.  */
static void
keep_pins (bt_dive *dive, int i, bt__pin kept[2], int take)
{
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      if (vehicle >= 0 && take)
        dive->contact_work.pin[vehicle] = kept[k];
      else if (vehicle >= 0)
        kept[k] = dive->contact_work.pin[vehicle];
    }
}

/* The part of a parted line that hangs from the far end.  */
static bt_status
fall_far_part (bt_dive *dive, bt__state *state, int i, bt__dynamic_input input,
               bt__dynamic_report *report, bt_error *error)
{
  bt__fastened fastened;
  double length = bt__dynamic_length (bt__dive_chain (dive, state, i, 1));
  bt__fasten (dive, i, 0, length, &input, &fastened);
  input.end[0] = (bt__dynamic_end){ .free = 1 };
  return bt__step_among (dive, state, i, 1, &input, report, error);
}

static bt_status
step_to (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt__dynamic_report *report,
         bt_error *error)
{
  bt_water water = bt__dive_water (dive, state);
  bt__fastened fastened;
  bt__dynamic_input input = bt__chain_input (dive, state, i, &water, ends);
  bt__dynamic_report far = { 0 };
  bt_status status = BT_OK;
  if (bt__dive_tether (dive, state, i)->parted)
    {
      status = fall_far_part (dive, state, i, input, &far, error);
      input.end[1] = (bt__dynamic_end){ .free = 1 };
    }
  bt__fasten (dive, i, bt__beyond_chain (dive, state, i), INFINITY, &input, &fastened);
  if (status == BT_OK)
    status = bt__step_among (dive, state, i, 0, &input, report, error);
  report->speed = fmax (report->speed, far.speed);
  report->solves += far.solves;
  return status;
}

bt_status
bt__fall (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__pin kept[2];
  bt__dynamic_report report = { .speed = INFINITY };
  bt_status status = BT_OK;
  int64_t nodes = 0, solves = 0;
  for (int part = 0; part < bt__chains (tether); part++)
    nodes += bt__dive_chain (dive, state, i, part)->n + 1;
  int steps = (int)fmin (FALL / BT__TIME_STEP, ceil (FALL_WORK / (double)nodes));
  double most = ceil (FALL_SOLVES / (double)nodes);
  keep_pins (dive, i, kept, 0);
  pin_ends (dive, state, i, BT__PIN_HARD);
  for (int k = 0; status == BT_OK && k < steps && (double)solves < most && report.speed > AT_REST;
       k++)
    {
      status = step_to (dive, state, i, ends, &report, error);
      solves += report.solves;
      if (status == BT_OK)
        status = bt__poll (dive, (double)k / steps, error);
    }
  keep_pins (dive, i, kept, 1);
  for (int part = 0; part < bt__chains (tether); part++)
    bt__dynamic_still (bt__dive_chain (dive, state, i, part));
  tether->shape.a = ends->a;
  tether->shape.b = ends->b;
  tether->quiet = 0;
  return status;
}

/* ---- Dragging ---- */

static bt_vec3
toward (bt_vec3 from, bt_vec3 to)
{
  double way = bt__distance (from, to), most = DRAG_SPEED * BT__TIME_STEP;
  return way <= most ? to : bt__axpy (from, most / way, bt__sub (to, from));
}

static double
way_left (const bt__ends *at, const bt__ends *to)
{
  return bt__distance (at->a, to->a) + bt__distance (at->b, to->b);
}

/* Whether the vehicle at end K of tether I is held back: to WAS, or to true if the end at AT is not
   where it was wanted.  Dragging brings a vehicle along, which is not to hold it.  */
static void
note_held (const bt_dive *dive, bt__state *state, int i, int k, int was, bt_vec3 at, bt_vec3 wanted)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  if (vehicle >= 0 && !bt__is_shared (dive, vehicle))
    bt__dive_vehicle (dive, state, vehicle)->held = was || bt__distance (at, wanted) > 0;
}

static int
is_end_held (const bt_dive *dive, bt__state *state, int i, int k)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  return vehicle >= 0 && bt__dive_vehicle (dive, state, vehicle)->held;
}

bt_status
bt__drag_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends at = { tether->shape.a, tether->shape.b };
  bt__dynamic_report report;
  bt_status status = BT_OK;
  bt__pin kept[2];
  double whole = way_left (&at, ends), least = INFINITY, left;
  int idle = 0, was[] = { is_end_held (dive, state, i, 0), is_end_held (dive, state, i, 1) };
  keep_pins (dive, i, kept, 0);
  for (int k = 0; k < 2; k++)
    bt__bring_end (dive, state, i, k, k == 0 ? at.a : at.b);
  pin_ends (dive, state, i, BT__PIN_SOFT);
  while (status == BT_OK && idle < DRAG_TRIES && (left = way_left (&at, ends)) > 0)
    {
      idle = left > least - DRAG_LEAST ? idle + 1 : 0;
      least = fmin (least, left);
      bt__ends next = { toward (at.a, ends->a), toward (at.b, ends->b) };
      bt__bring_end (dive, state, i, 0, next.a);
      bt__bring_end (dive, state, i, 1, next.b);
      status = step_to (dive, state, i, &next, &report, error);
      if (status == BT_OK)
        status = bt__poll (dive, 1 - left / whole, error);
      at = bt__tether_ends (dive, state, i);
    }
  keep_pins (dive, i, kept, 1);
  note_held (dive, state, i, 0, was[0], at.a, ends->a);
  note_held (dive, state, i, 1, was[1], at.b, ends->b);
  return status == BT_OK ? bt__fall (dive, state, i, &at, error) : status;
}
