/* A glide: a step of the dive in which all its lines are ahead of the present, or all at rest,
   taken in place.

   Where every line was solved ahead, or none moves, what is left of a step in open water is to move
   the vehicles, to see that they are where the lines were told, or where they were, and to count.
   A copy of the state for that is dearer than all the rest, so the present itself is written to,
   once nothing can refuse the step any more.  Any doubt (an end elsewhere, an arrival, a line about
   to be taut or slack) leaves the present as it was, and the step is taken aside, with the same
   outcome to the bit: both ways find each quantity by the same function.

   An operation on the sea, a tether or an obstacle ends all stretches (ops.c), so that within one
   only vehicles and their orders can have changed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/form_step.h"

/* ---- May it be? ---- */

/* True if every tether of the present is ahead of it beyond the next step.  */
static int
are_all_ahead (const bt_dive *dive)
{
  int all = 1;
  for (int i = 0; all && i < dive->model->n_tethers; i++)
    {
      const bt__tether *tether = bt__dive_tether (dive, dive->now, i);
      all = bt__is_ahead (tether) && tether->stretch.gone + 1 < tether->stretch.span;
    }
  return all;
}

/* True if no vehicle at an end of tether I moved in the last step.  */
static int
do_ends_stand (const bt_dive *dive, int i)
{
  int all = 1;
  for (int k = 0; k < 2; k++)
    {
      int v = dive->model->ends[i][k].vehicle;
      bt_vec3 u = v < 0 ? bt__vec (0, 0, 0) : bt__dive_vehicle (dive, dive->now, v)->velocity;
      all &= u.x == 0 && u.y == 0 && u.z == 0;
    }
  return all;
}

/* True if TETHER, I of the present, is asleep, its winch still, and it touches nothing; or has a
   static shape that is no spring, which could slip.  */
static int
may_rest (const bt_dive *dive, const bt__tether *tether, int i)
{
  if (bt__tether_form_of (tether) != bt__wanted_form (dive, tether) || tether->winch_rate != 0
      || !do_ends_stand (dive, i))
    return 0;
  if (!bt__is_cable (tether))
    return !bt__is_spring (tether);
  return tether->quiet >= BT__SLEEP_AFTER && !tether->parted && !bt__is_ahead (tether)
         && bt__dive_anchors (dive, dive->now, i, 0)->n == 0;
}

static int
may_all_rest (const bt_dive *dive)
{
  int all = 1;
  for (int i = 0; all && i < dive->model->n_tethers; i++)
    all = may_rest (dive, bt__dive_tether (dive, dive->now, i), i);
  return all;
}

static int
are_all_kinematic (const bt_dive *dive)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    if (bt__dive_vehicle (dive, dive->now, i)->rigid)
      return 0;
  return 1;
}

/* ---- Vehicles ---- */

/* Move the vehicles of the present by a step, the spare state keeping them as they were; return
   true if that brought no event about.  */
static int
move (bt_dive *dive)
{
  bt__state *now = dive->now;
  size_t size = sizeof (bt__vehicle) * (size_t)dive->model->n_vehicles;
  memcpy (bt__dive_vehicle (dive, dive->next, 0), bt__dive_vehicle (dive, now, 0), size);
  int64_t events = now->events;
  bt_event slot = now->event[events % BT_EVENTS_KEPT];
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      bt__move_vehicle (dive, now, i);
      bt__dive_vehicle (dive, now, i)->held = 0;
      if (now->events != events)
        {
          now->event[events % BT_EVENTS_KEPT] = slot;
          now->events = events;
          return 0;
        }
    }
  return 1;
}

static void
move_back (bt_dive *dive)
{
  size_t size = sizeof (bt__vehicle) * (size_t)dive->model->n_vehicles;
  memcpy (bt__dive_vehicle (dive, dive->now, 0), bt__dive_vehicle (dive, dive->next, 0), size);
}

/* ---- Lines ---- */

/* True if no end of tether I has another heading than before the vehicles moved.  */
static int
keeps_headings (const bt_dive *dive, int i)
{
  int all = 1;
  for (int k = 0; k < 2; k++)
    {
      int v = dive->model->ends[i][k].vehicle;
      all &= v < 0
             || bt__dive_vehicle (dive, dive->now, v)->heading
                    == bt__dive_vehicle (dive, dive->next, v)->heading;
    }
  return all;
}

/* True if tether I goes on with its ends at ENDS, where the moved vehicles have them.  Its stretch
   holds, or, at REST and not taut, nothing has changed.  */
static int
does_hold (const bt_dive *dive, int i, const bt__ends *ends, int rest)
{
  const bt__tether *tether = bt__dive_tether (dive, dive->now, i);
  int taut = bt__is_chord_taut (tether, ends);
  if (!rest)
    return taut == (tether->taut != 0)
           && !(taut && bt__is_pulled_back (dive, dive->next, dive->now, i))
           && bt__are_ends_foreseen (dive, dive->now, i, ends);
  return !taut && !tether->taut && keeps_headings (dive, i)
         && (bt__is_cable (tether) ? bt__is_unchanged (dive, dive->now, tether, ends)
                                   : bt__step_shape.rests (dive, dive->now, i, ends));
}

/* The same of all tethers; ENDS receives where their ends are.  */
static int
do_all_hold (const bt_dive *dive, bt__ends *ends, int rest)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      ends[i] = bt__tether_ends (dive, dive->now, i);
      if (!does_hold (dive, i, &ends[i], rest))
        return 0;
    }
  return 1;
}

/* Take tether I, its ends at ENDS, on.  */
static void
take_on (bt_dive *dive, int i, const bt__ends *ends, int rest)
{
  if (!rest)
    bt__go_on_within (dive, dive->now, i, ends);
  else if (!bt__is_cable (bt__dive_tether (dive, dive->now, i)))
    dive->profile.shape_skips++;
  else
    dive->profile.chain_sleeps++;
}

/* Take the present on by a step in place and return true; or leave the present as it is.  A line
   ahead, or at rest without contacts, ends no meeting.  */
static int
glides (bt_dive *dive)
{
  bt__state *now = dive->now;
  bt__ends ends[BT_TETHERS_MAX];
  if (dive->model->n_obstacles > 0 || dive->model->n_hulls > 0)
    return 0;
  int rest = !are_all_ahead (dive);
  if ((rest && !may_all_rest (dive)) || !are_all_kinematic (dive) || bt__ask (&dive->asker))
    return 0;
  now->step++;
  if (!move (dive) || !do_all_hold (dive, ends, rest))
    {
      now->step--;
      move_back (dive);
      return 0;
    }
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      take_on (dive, i, &ends[i], rest);
      bt__note_stuck (dive, now, i, &ends[i]);
    }
  dive->changes++;
  dive->profile.steps++;
  return 1;
}

bt_status
bt_dive_step (bt_dive *dive, bt_error *error)
{
  bt_status status = bt__dive_ready (dive, error);
  if (status != BT_OK)
    return status;
  return glides (dive) ? BT_OK : bt__step_aside (dive, error);
}
