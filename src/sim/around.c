/* Surroundings of a step: see around.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "sim/around.h"

#include "math/vec.h"
#include "world/obstacles.h"

/* Where the kinematic obstacle K wants to be SECONDS from NOW: on its track, or, adrift, as far as
   the drift takes it.  */
static bt__frame
wanted_frame (const bt_dive *dive, int k, const bt__mover_state *now, double seconds)
{
  bt__frame frame = now->frame;
  if (!now->adrift)
    return bt__carried_frame (dive->model, k, now->clock + seconds);
  frame.origin = bt__axpy (frame.origin, seconds, now->drift);
  return frame;
}

static void
aim (bt_dive *dive, bt__state *state, int k, double seconds)
{
  const bt__mover_state *now = &bt__dive_movers (dive, state)[k];
  bt__frame to = wanted_frame (dive, k, now, seconds);
  bt__course *course = &dive->contact_work.course[k];
  course->whole = bt__motion_between (&now->frame, seconds > 0 ? &to : &now->frame);
  course->seconds = seconds;
}

void
bt__aim_movers (bt_dive *dive, bt__state *state, int round)
{
  dive->contact_work.disagree = 0;
  for (int k = 0; k < dive->model->n_carried; k++)
    {
      bt__course *course = &dive->contact_work.course[k];
      /* What a try before came to is as far as this one aims.  */
      course->share = round == 0 ? 1 : round < BT__TRIES ? course->share : 0;
      course->gone = 0;
      aim (dive, state, k, BT__TIME_STEP);
    }
}

void
bt__rest_movers (bt_dive *dive, bt__state *state)
{
  dive->contact_work.disagree = 0;
  for (int k = 0; k < dive->model->n_carried; k++)
    {
      dive->contact_work.course[k].share = 0;
      dive->contact_work.course[k].gone = 0;
      aim (dive, state, k, 0);
    }
}

void
bt__around_done (bt_dive *dive)
{
  for (int k = 0; k < dive->model->n_carried; k++)
    {
      bt__course *course = &dive->contact_work.course[k];
      double done = dive->contact_work.mover[k].done;
      if (dive->contact_work.since > 0 || dive->contact_work.left > 0)
        {
          dive->contact_work.balked |= done < 1;
          course->gone
              |= dive->contact_work.left == 0 && !dive->contact_work.balked && course->share > 0;
          continue;
        }
      dive->contact_work.disagree |= done < 1 && course->gone;
      course->share *= done;
      course->gone = course->share > 0;
    }
}

int
bt__around_agrees (const bt_dive *dive)
{
  return !dive->contact_work.disagree;
}

void
bt__settle_movers (bt_dive *dive, bt__state *state)
{
  for (int k = 0; k < dive->model->n_carried; k++)
    {
      const bt__course *course = &dive->contact_work.course[k];
      bt__mover_state *mover = &bt__dive_movers (dive, state)[k];
      int pinched = course->share < 1;
      mover->frame = bt__motion_at (&course->whole, course->share);
      mover->clock += course->share * course->seconds;
      if (pinched && !mover->pinched)
        bt__raise_event (state, BT_EVENT_PINCHED, dive->model->carried[k].obstacle);
      mover->pinched = pinched;
    }
}

int
bt__movers_move (const bt_dive *dive)
{
  for (int k = 0; k < dive->model->n_carried; k++)
    {
      const bt__course *course = &dive->contact_work.course[k];
      int moves = bt__norm (course->whole.travel) > 0 || course->whole.angle != 0;
      if (moves && course->share > 0)
        return 1;
    }
  return 0;
}

static void
note_partings (const bt_dive *dive, bt__state *state, bt_part part, int n)
{
  for (int i = 0; i < n; i++)
    bt__note_partings (state, bt__dive_subject (dive, state, part, i), part, i);
}

void
bt__note_all_partings (const bt_dive *dive, bt__state *state)
{
  note_partings (dive, state, BT_PART_VEHICLE, dive->model->n_vehicles);
  note_partings (dive, state, BT_PART_TETHER, dive->model->n_tethers);
}
