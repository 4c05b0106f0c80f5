/* The life of a dive: allocation, the two state buffers, forks.  The first operation makes the
   spare state and the workspaces (ready.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "world/contexts.h"
#include "world/layout.h"
#include "world/obstacles.h"
#include "world/watch.h"

double
bt__state_time (const bt__state *state)
{
  return (double)state->step * BT__TIME_STEP;
}

/* What there is beside the current, or NULL.  */
static const bt_sea *
sea_of (const bt_dive *dive, const bt__state *state)
{
  bt_sea *sea = &dive->sea[state == dive->now];
  const bt_model *model = dive->model;
  *sea = (bt_sea){ .grid = model->sea.grid,
                   .waves = state->waves.n > 0 ? &state->waves : NULL,
                   .lees = state->wake ? model->lees : NULL };
  return sea->grid || sea->waves || sea->lees ? sea : NULL;
}

bt_water
bt__dive_water (const bt_dive *dive, const bt__state *state)
{
  return (bt_water){ .density = state->density,
                     .gravity = state->gravity,
                     .depth = state->depth,
                     .time = bt__state_time (state),
                     .current = &state->current,
                     .function = dive->function,
                     .user = dive->user,
                     .sea = sea_of (dive, state) };
}

/* ---- Life ---- */

static bt_status
make_layout (bt_dive *dive, bt_error *error)
{
  const bt_model *model = dive->model;
  dive->size = bt__state_size (model);
  dive->layout = bt__layout_of (model);
  dive->line = calloc ((size_t)model->n_tethers + 1, sizeof *dive->line);
  if (!dive->line)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the tethers of a dive");
  for (int i = 0; i < model->n_tethers; i++)
    dive->line[i] = bt__line_size_of (model, i);
  return BT_OK;
}

static void
lay_out (bt_dive *dive)
{
  int64_t at = 0;
  dive->now->magic = BT__STATE_MAGIC;
  dive->now->model_id = dive->model->id;
  dive->now->size = dive->size;
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__dive_tether (dive, dive->now, i)->store_at = at;
      at += (int64_t)bt__store_size (dive->model, i);
    }
}

/* The places of kinematic obstacles, of which questions read.  */
static int
make_courses (bt_dive *dive)
{
  size_t moving = (size_t)bt__courses (dive->model) + 1;
  bt__contact_work *shore = &dive->contact_work;
  return (shore->mover = calloc (moving, sizeof *shore->mover))
         && (shore->course = calloc (moving, sizeof *shore->course));
}

/* Make a dive with NOW, a state; NULL: without one.  */
static bt_status
make_dive (bt_model *model, bt__state *now, bt_dive **out, bt_error *error)
{
  bt_status status;
  bt_dive *dive = calloc (1, sizeof *dive);
  if (!dive)
    {
      free (now);
      return bt__fail (error, BT_ERR_LIMIT, "no memory for a dive");
    }
  dive->now = now;
  dive->model = bt_model_retain (model);
  status = make_layout (dive, error);
  dive->sea = calloc (2, sizeof *dive->sea);
  if (now)
    dive->alike = calloc (BT__STORES + (size_t)model->n_tethers + 1, sizeof *dive->alike);
  if (!dive->sea || (now && !dive->alike) || !make_courses (dive))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for the parts of a dive");
  if (status == BT_OK)
    *out = dive;
  else
    bt_dive_free (dive);
  return status;
}

static bt_status
no_memory_for (size_t size, bt_error *error)
{
  return bt__fail (error, BT_ERR_LIMIT, "no memory for a state of %zu bytes", size);
}

bt_status
bt__dive_alloc (bt_model *model, bt_dive **out, bt_error *error)
{
  size_t size = bt__state_size (model);
  bt__state *now = calloc (1, size);
  bt_status status = now ? make_dive (model, now, out, error) : no_memory_for (size, error);
  if (status == BT_OK)
    lay_out (*out);
  return status;
}

bt_status
bt__dive_alloc_lane (bt_model *model, bt__context *context, bt_error *error)
{
  bt_status status = make_dive (model, NULL, &context->dive, error);
  if (status != BT_OK)
    return status;
  context->dive->context = context;
  return bt__dive_ready (context->dive, error);
}

static void
release_track (bt__track *track)
{
  if (atomic_fetch_sub (&track->references, 1) == 1)
    free (track);
}

static void
release_tracks (bt_dive *dive)
{
  for (int i = 0; i < dive->n_tracks; i++)
    release_track (dive->tracks[i]);
  dive->n_tracks = 0;
}

void
bt_dive_free (bt_dive *dive)
{
  if (!dive)
    return;
  release_tracks (dive);
  bt__dive_clear_up (dive);
  free (dive->contact_work.mover);
  free (dive->contact_work.course);
  free (dive->sea);
  free (dive->line);
  free (dive->alike);
  bt__watch_free_all (dive->watch);
  bt__contexts_free (dive->contexts);
  free (dive->now);
  bt_model_release (dive->model);
  free (dive);
}

/* Copy to FORK the state of DIVE, tracks and knowledge of the scene.  */
static void
take_after (bt_dive *fork, const bt_dive *dive)
{
  bt__copy_state (dive, fork->now, dive->now);
  fork->function = dive->function;
  fork->user = dive->user;
  fork->wished = dive->wished;
  fork->n_tracks = dive->n_tracks;
  for (int i = 0; i < dive->n_tracks; i++)
    {
      fork->tracks[i] = dive->tracks[i];
      atomic_fetch_add (&fork->tracks[i]->references, 1);
    }
  bt__watch_share (dive, fork);
}

bt_status
bt_dive_fork (const bt_dive *dive, bt_dive **copy, bt_error *error)
{
  bt__state *now = malloc (dive->size); /* unused room is never read */
  bt_status status
      = now ? make_dive (dive->model, now, copy, error) : no_memory_for (dive->size, error);
  if (status == BT_OK)
    take_after (*copy, dive);
  return status;
}

bt_status
bt_dive_fork_again (bt_dive *fork, const bt_dive *dive, bt_error *error)
{
  if (fork->model != dive->model)
    return bt__fail (error, BT_ERR_STALE, "a fork of one dive cannot become that of another");
  bt_status status = bt_dive_set_threads (fork, 1, error);
  if (status != BT_OK)
    return status;
  release_tracks (fork);
  bt__watch_free_all (fork->watch);
  fork->watch = NULL;
  memset (fork->alike, 0, BT__STORES + (size_t)dive->model->n_tethers);
  memset (&fork->counts, 0, sizeof fork->counts);
  memset (&fork->profile, 0, sizeof fork->profile);
  memset (&fork->contact_work.count, 0, sizeof fork->contact_work.count);
  fork->contact_work.thesis.solves = fork->contact_work.thesis.skips = 0;
  bt_dive_set_poll (fork, NULL, NULL);
  fork->changes++;
  take_after (fork, dive);
  return BT_OK;
}

void
bt_dive_set_current_function (bt_dive *dive, bt_current_function function, void *user)
{
  dive->function = function;
  dive->user = user;
}

void
bt_dive_set_poll (bt_dive *dive, bt_poll poll, void *user)
{
  dive->asker = (bt__asker){ .poll = poll, .user = user };
}

bt_status
bt__poll (const bt_dive *dive, double share, bt_error *error)
{
  bt__asker *asker = bt__asker_of (dive);
  asker->share = share;
  bt__ask (asker);
  return bt__stopped (asker, error);
}

int
bt_dive_asks (const bt_dive *dive)
{
  return dive->now->current.kind == BT_CURRENT_FUNCTION;
}

bt__state *
bt__dive_begin (bt_dive *dive)
{
  bt__level (dive);
  return dive->next;
}

void
bt__dive_commit (bt_dive *dive)
{
  bt__state *old = dive->now;
  dive->now = dive->next;
  dive->next = old;
  dive->changes++;
}

bt_status
bt__dive_become (bt_dive *dive, bt_error *error)
{
  bt__dive_commit (dive);
  bt_status status = bt__watch_prepare (dive, error);
  if (status != BT_OK)
    bt__dive_commit (dive); /* the state before it is the present again */
  return status;
}
