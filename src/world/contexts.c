/* The life of worker contexts: made, lent the state of a step, freed.

   A context is a partial dive with solver workspaces of its own, one for each thread.  For a step a
   context is lent the state (bt__context_enter): the present buffer is shared and only read; the
   head of the next buffer is copied, so that events of a context stay apart; vehicles, tethers and
   stores of the next buffer are shared, since every island is stepped by one context alone.

   Afterwards the counters of all contexts are added up in order (bt__context_count); the sum is the
   same for any number of threads.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "world/contexts.h"
#include "world/layout.h"

/* ---- Life ---- */

static void
free_arrays (bt__contexts *l)
{
  free (l->group);
  free (l->first);
  free (l->after);
  free (l->last);
  free (l->shared);
  free (l->margin);
  free (l->asked);
  free (l->raised);
  free (l->whole);
  free (l->box);
  free (l->box_at);
  free (l->boxes);
  free (l->pin);
}

void
bt__contexts_free (bt__contexts *l)
{
  if (!l)
    return;
  bt__workers_free (l->workers);
  for (int i = 0; l->context && i < l->n; i++)
    bt_dive_free (l->context[i].dive);
  free (l->context);
  free_arrays (l);
  free (l);
}

/* Boxes for both parts of each tether.  */
static int
make_boxes (bt__contexts *l, const bt_model *model)
{
  int boxes = 0;
  size_t tethers = (size_t)model->n_tethers + 1;
  if (!(l->box_at = calloc (tethers, sizeof *l->box_at))
      || !(l->boxes = calloc (tethers, sizeof *l->boxes))
      || !(l->whole = calloc (tethers, sizeof *l->whole)))
    return 0;
  for (int i = 0; i < model->n_tethers; i++)
    {
      l->box_at[i] = boxes;
      boxes += 2 * (bt__chain_room (&model->tethers[i]) / BT__LANE_LEAF + 1);
    }
  return (l->box = calloc ((size_t)boxes + 1, sizeof *l->box)) != NULL;
}

static int
make_arrays (bt__contexts *l, const bt_model *model)
{
  size_t tethers = (size_t)model->n_tethers + 1, vehicles = (size_t)model->n_vehicles + 1;
  return (l->group = calloc (tethers, sizeof *l->group))
         && (l->first = calloc (tethers, sizeof *l->first))
         && (l->after = calloc (tethers, sizeof *l->after))
         && (l->last = calloc (tethers, sizeof *l->last))
         && (l->shared = calloc (vehicles, sizeof *l->shared))
         && (l->margin = calloc (tethers, sizeof *l->margin))
         && (l->asked = calloc (tethers, sizeof *l->asked))
         && (l->raised = calloc (tethers, sizeof *l->raised))
         && (l->pin = calloc (vehicles, sizeof *l->pin)) && make_boxes (l, model);
}

static bt_status
make_lanes (bt_model *model, int n, bt__contexts **out, bt_error *error)
{
  bt__contexts *l = calloc (1, sizeof *l);
  bt_status status = BT_OK;
  if (l && (l->context = calloc ((size_t)n, sizeof *l->context)))
    l->n = n;
  if (!l || l->n == 0 || !(l->workers = bt__workers_new (n)) || !make_arrays (l, model))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for %d threads", n);
  for (int i = 0; status == BT_OK && i < n; i++)
    {
      l->context[i].group = l->group;
      l->context[i].shared = l->shared;
      status = bt__dive_alloc_lane (model, &l->context[i], error);
    }
  if (status == BT_OK)
    *out = l;
  else
    bt__contexts_free (l);
  return status;
}

bt_status
bt_dive_set_threads (bt_dive *dive, int n, bt_error *error)
{
  bt__contexts *contexts = NULL;
  bt_status status = BT_OK;
  if (n < 1 || n > BT_THREADS_MAX)
    return bt__fail (error, BT_ERR_DOMAIN, "a dive is stepped by 1 to %d threads, not %d",
                     BT_THREADS_MAX, n);
  if (n == bt_dive_threads (dive))
    return BT_OK;
  if (n > 1)
    status = make_lanes (dive->model, n, &contexts, error);
  if (status != BT_OK)
    return status;
  if (dive->contexts)
    dive->profile.threads += (uint64_t)bt__workers_started (dive->contexts->workers);
  bt__contexts_free (dive->contexts);
  dive->contexts = contexts;
  return BT_OK;
}

int
bt_dive_threads (const bt_dive *dive)
{
  return dive->contexts ? dive->contexts->n : 1;
}

/* ---- Lending ---- */

void
bt__context_enter (bt__context *context, const bt_dive *dive, bt__state *next)
{
  bt_dive *own = context->dive;
  context->body = bt__state_body (dive, next);
  context->refused = 0;
  own->now = dive->now;
  bt__copy_head (own->next, next);
  own->next->events = 0;
  own->driven = dive->driven;
  own->alike = dive->alike;
  own->contact_work.pin = dive->contact_work.pin;
  own->contact_work.place = dive->contact_work.place;
  own->contact_work.barred = dive->contact_work.barred;
  memcpy (own->contact_work.course, dive->contact_work.course,
          sizeof *own->contact_work.course * (size_t)bt__courses (dive->model));
  memcpy (own->contact_work.by_hull, dive->contact_work.by_hull,
          (size_t)dive->model->n_tethers * (size_t)dive->model->n_hulls);
  memcpy (own->contact_work.box, dive->contact_work.box,
          2 * sizeof *own->contact_work.box * (size_t)dive->model->n_tethers);
  own->contact_work.disagree = 0;
  own->profile = (bt_profile){ 0 };
  own->counts = (bt__shape_counts){ 0 };
  own->contact_work.count = (bt__count){ 0 };
  own->contact_work.thesis = (bt__thesis_counts){ 0 };
}

void
bt__context_leave (bt__context *context)
{
  bt_dive *own = context->dive;
  context->body = NULL;
  own->now = NULL;
  own->driven = NULL;
  own->alike = NULL;
  own->contact_work.pin = NULL;
  own->contact_work.place = NULL;
  own->contact_work.barred = NULL;
}

/* Add to SUM the counters MORE, both records of nothing but 64-bit counters.  */
static void
add_up_counters (void *sum, const void *more, size_t size)
{
  uint64_t *a = sum;
  const uint64_t *b = more;
  for (size_t i = 0; i < size / sizeof *a; i++)
    a[i] += b[i];
}

void
bt__context_count (const bt__context *context, bt_dive *dive)
{
  const bt_dive *own = context->dive;
  add_up_counters (&dive->profile, &own->profile, sizeof dive->profile);
  add_up_counters (&dive->counts, &own->counts, sizeof dive->counts);
  add_up_counters (&dive->contact_work.count, &own->contact_work.count,
                   sizeof dive->contact_work.count);
  add_up_counters (&dive->contact_work.thesis, &own->contact_work.thesis,
                   sizeof dive->contact_work.thesis);
}
