/* Sharing out the tethers of a step over threads, by speculation on islands.

   Within a step a tether depends on other tethers in three ways: through a common vehicle, through
   contact between two lines, and through a kinematic obstacle held back by one tether for all.
   Tethers bound by the first two ways form a group, an island (apart.c), and step one after
   another.  Groups step at the same time, each in a worker context: a dive with its own workspaces,
   working on the common state, on the tethers and vehicles of a single group.  Of other groups a
   worker sees the present state, which nobody writes.  Each worker keeps its events until they are
   raised in the order of the tethers; counters are added up.

   The independence of the groups is assumed before the step and verified afterwards.  The
   assumption held if no line asked for lines as far away as a line of another group, no line left
   its box (chain_box.c), no kinematic obstacle was held back, no vehicle of several groups was
   moved, and nothing failed.  Otherwise the try is discarded and one thread repeats it: the result
   of a step is always the result of a single thread.  Margins follow the distances asked for in the
   last steps, and after consecutive refusals the next attempt is put off longer and longer.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "sim/around.h"
#include "sim/share.h"

_Static_assert(sizeof (bt_profile) % sizeof (uint64_t) == 0, "counters and nothing else");

#define SLACK 0.05     /* m: what a margin has beyond twice what was asked for */
#define MOST_ASKED 2.0 /* m: that is doubled */
#define SHRINK 0.9     /* a try */
enum
{
  LEAST_WORK = 400, /* intervals in open water: with less to do threads gain nothing */
  AMONG = 4,        /* times as much is to be done among obstacles */
  PATIENCE = 64     /* steps that it is waited at most */
};

/* ---- Tries ---- */

static size_t
pins_size (const bt_dive *dive)
{
  return sizeof (bt__pin) * (size_t)dive->model->n_vehicles;
}

void
bt__share_begin (bt_dive *dive)
{
  memcpy (dive->contexts->pin, dive->contact_work.pin, pins_size (dive));
  dive->contexts->refused = 0;
}

int
bt__share_refused (bt_dive *dive)
{
  if (dive->contexts->refused)
    memcpy (dive->contact_work.pin, dive->contexts->pin, pins_size (dive));
  return dive->contexts->refused;
}

/* ---- Is it worth while? ---- */

/* An estimate of the work for tether I, in intervals of a moving line.  */
static int64_t
work_of (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends ends;
  if (bt__is_ahead (tether) && tether->stretch.gone + 1 < tether->stretch.span)
    return 0;
  if (bt__is_awake (tether))
    return bt__chain_in_use (dive, state, i)->n;
  ends = bt__tether_ends (dive, state, i);
  return bt__is_unchanged (dive, state, tether, &ends) ? 0 : dive->model->tethers[i].props.nodes;
}

/* A line that is laid goes many steps in one.  */
static int
is_to_be_laid (const bt__tether *tether)
{
  return bt__is_moving_model (tether) && !bt__is_cable (tether);
}

static int
has_work (const bt_dive *dive, bt__state *state)
{
  int64_t work = 0;
  int times = bt__has_obstacles (dive) ? AMONG : 1;
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      if (is_to_be_laid (bt__dive_tether (dive, state, i)))
        return 0;
      work += times * work_of (dive, state, i);
    }
  return work >= LEAST_WORK;
}

/* True if two groups have something to do.  */
static int
can_share (const bt_dive *dive, bt__state *state, const bt__contexts *l)
{
  int busy = 0;
  for (int g = 0; g < l->groups && busy < 2; g++)
    {
      int64_t work = 0;
      for (int i = l->first[g]; i >= 0; i = l->after[i])
        work += work_of (dive, state, i);
      busy += work > 0;
    }
  return busy == 2;
}

/* ---- On the contexts ---- */

static void
step_tether (bt__contexts *l, int w, int i)
{
  bt__context *context = &l->context[w];
  bt_dive *dive = context->dive;
  bt_status status;
  bt_error unused;
  l->raised[i] = (bt__raised){ .context = w, .from = dive->next->events };
  status = bt__resolve_tether (dive, dive->next, i, 1, &unused);
  l->raised[i].to = dive->next->events;
  if (dive->contact_work.line)
    l->asked[i] = fmax (l->asked[i], bt__line_work_asked (dive->contact_work.line));
  if (status != BT_OK || dive->next->events > BT_EVENTS_KEPT)
    context->refused = 1;
}

static void
step_group (void *user, int w, int g)
{
  bt__contexts *l = user;
  for (int i = l->first[g]; i >= 0 && !l->context[w].refused; i = l->after[i])
    step_tether (l, w, i);
}

/* ---- Is it to go on? ---- */

/* The caller's thread alone asks whoever called; the others hear what was answered.  */
static int
ask_caller (void *user, double share)
{
  bt__contexts *l = user;
  int left = bt__ask (l->asker);
  (void)share;
  if (left)
    l->left = 1;
  return left;
}

static void
ask_meanwhile (void *user)
{
  ask_caller (user, 0);
}

static int
hear_asker (void *user, double share)
{
  const bt__contexts *l = user;
  (void)share;
  return l->left;
}

static void
run_groups (bt_dive *dive, bt__contexts *l)
{
  int asks = dive->asker.poll != NULL;
  l->asker = &dive->asker;
  l->left = 0;
  for (int w = 0; w < l->n; w++)
    l->context[w].dive->asker = (bt__asker){ .poll = !asks    ? NULL
                                                     : w == 0 ? ask_caller
                                                              : hear_asker,
                                             .user = l };
  bt__workers_run (l->workers, l->groups, step_group, asks ? ask_meanwhile : NULL, l);
}

/* ---- Afterwards ---- */

/* True if LANE had to hold an obstacle back.  */
static int
held_back (const bt_dive *dive, const bt__context *context)
{
  for (int k = 0; k < bt__courses (dive->model); k++)
    if (context->dive->contact_work.course[k].share != dive->contact_work.course[k].share)
      return 1;
  return 0;
}

/* True if a line asked for others farther off than it might.  */
static int
asked_too_far (const bt_dive *dive, const bt__contexts *l)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (!(l->asked[i] <= l->margin[i]))
      return 1;
  return 0;
}

static int
is_done (const bt_dive *dive, bt__contexts *l)
{
  for (int w = 0; w < l->n; w++)
    if (l->context[w].refused || held_back (dive, &l->context[w]))
      return 0;
  return !asked_too_far (dive, l) || bt__were_apart (dive, l);
}

static void
raise_events (const bt_dive *dive, bt__state *state, const bt__contexts *l)
{
  for (int p = 0; p < dive->model->n_tethers; p++)
    {
      int i = dive->contact_work.order[p];
      const bt__raised *raised = &l->raised[i];
      const bt_event *event = l->context[raised->context].dive->next->event;
      for (int64_t k = raised->from; k < raised->to; k++)
        state->event[state->events++ % BT_EVENTS_KEPT] = event[k];
    }
}

static void
take_over_groups (bt_dive *dive, bt__state *state, bt__contexts *l)
{
  raise_events (dive, state, l);
  for (int w = 0; w < l->n; w++)
    {
      bt__context_count (&l->context[w], dive);
      dive->contact_work.disagree |= l->context[w].dive->contact_work.disagree;
      for (int k = 0; k < bt__courses (dive->model); k++)
        if (l->context[w].dive->contact_work.course[k].gone)
          dive->contact_work.course[k] = l->context[w].dive->contact_work.course[k];
    }
  l->patience = 0;
}

static void
refuse_sharing (bt_dive *dive, bt__contexts *l)
{
  l->refused = 1;
  l->alone = l->patience;
  l->patience = l->patience < PATIENCE / 2 ? 2 * l->patience + 1 : PATIENCE;
  dive->profile.shared_again++;
}

/* What a line asked for it may ask for twice; what it did not again shrinks.  */
static void
set_margins (const bt_dive *dive, bt__contexts *l)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      l->asked[i] = fmin (l->asked[i], MOST_ASKED);
      l->margin[i] = 2 * l->asked[i] + SLACK;
      l->asked[i] *= SHRINK;
    }
}

int
bt__share_tethers (bt_dive *dive, bt__state *state)
{
  bt__contexts *l = dive->contexts;
  if (l->refused || state->current.kind == BT_CURRENT_FUNCTION)
    return 0;
  if (l->alone > 0)
    {
      l->alone--;
      return 0;
    }
  if (!has_work (dive, state))
    return 0;
  set_margins (dive, l);
  bt__set_apart (dive, state, l);
  if (!can_share (dive, state, l))
    return 0;
  dive->profile.shared_steps++;
  for (int w = 0; w < l->n; w++)
    bt__context_enter (&l->context[w], dive, state);
  run_groups (dive, l);
  if (is_done (dive, l))
    take_over_groups (dive, state, l);
  else
    refuse_sharing (dive, l);
  for (int w = 0; w < l->n; w++)
    bt__context_leave (&l->context[w]);
  return 1;
}
