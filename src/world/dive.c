/* The life of a dive: allocation, the two state buffers, forks.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "tether/equilibrium.h"
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

/* Make the arrays for bending and for the steady model, if a tether of the model has these.  The
   first step of a tether altered to have them makes them too.  */
static bt_status
make_room (bt_dive *dive, int most, bt_error *error)
{
  bt_status status = BT_OK;
  for (int i = 0; i < dive->model->n_tethers && status == BT_OK; i++)
    {
      const bt_tether_props *p = &dive->model->tethers[i].props;
      if (!bt__dynamic_work_room (dive->work, p))
        status = bt__fail (error, BT_ERR_LIMIT, "no memory for the bending of a dive's lines");
      else if (p->model == BT_MODEL_STEADY)
        status = bt__steady_room (dive->tools.steady, most, error);
    }
  return status;
}

/* Make the workspaces any tether of the model may come to need: its model may change while it
   dives.  */
static bt_status
make_tools (bt_dive *dive, bt_error *error)
{
  int most = 0;
  size_t points;
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (bt__chain_room (&dive->model->tethers[i]) > most)
      most = bt__chain_room (&dive->model->tethers[i]);
  if (most == 0)
    return BT_OK;
  dive->tools.search = bt_search_new ();
  dive->tools.steady = bt_steady_new (most); /* as many as a chain comes to */
  dive->work = bt__dynamic_work_new (most);
  points = (size_t)most + 1 + 2 * BT__SPLITS_MAX;
  dive->polyline = calloc (points, sizeof *dive->polyline);
  dive->along = calloc (points, sizeof *dive->along);
  dive->motion = calloc (points, sizeof *dive->motion);
  dive->corner = calloc (points, sizeof *dive->corner);
  dive->fit = calloc (points, sizeof *dive->fit);
  if (!dive->tools.search || !dive->tools.steady || !dive->work || !dive->polyline || !dive->motion
      || !dive->corner || !dive->along || !dive->fit)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the solvers of a dive");
  bt__steady_ask (dive->tools.steady, &dive->asker);
  bt__dynamic_ask (dive->work, &dive->asker);
  return make_room (dive, most, error);
}

/* What a step has of each vehicle and each tether: contexts borrow it.  */
static bt_status
make_rows (bt_dive *dive, bt_error *error)
{
  const bt_model *model = dive->model;
  bt__contact_work *shore = &dive->contact_work;
  size_t vehicles = (size_t)model->n_vehicles + 1, tethers = (size_t)model->n_tethers + 1;
  int whole = (dive->driven = calloc (vehicles, sizeof *dive->driven))
              && (dive->alike = calloc (BT__STORES + tethers, sizeof *dive->alike));
  whole = whole && (shore->pin = calloc (vehicles, sizeof *shore->pin))
          && (shore->order = calloc (tethers, sizeof *shore->order))
          && (shore->place = calloc (tethers, sizeof *shore->place))
          && (shore->barred = calloc (tethers, sizeof *shore->barred));
  return whole ? BT_OK : bt__fail (error, BT_ERR_LIMIT, "no memory for the parts of a dive");
}

/* Make the workspaces of contact: for lines with each other; then those for obstacles, for the
   longest tether and all kinematic obstacles.  */
static bt_status
make_shore (bt_dive *dive, bt_error *error)
{
  const bt_model *model = dive->model;
  bt__contact_work *shore = &dive->contact_work;
  int chain = 0, room = 0;
  size_t moving = (size_t)bt__courses (model);
  size_t pairs = (size_t)model->n_tethers * (size_t)model->n_hulls;
  bt_status status;
  for (int i = 0; i < model->n_tethers; i++)
    {
      chain = chain > bt__chain_room (&model->tethers[i]) ? chain
                                                          : bt__chain_room (&model->tethers[i]);
      room = room > bt__polyline_room (&model->tethers[i]) ? room
                                                           : bt__polyline_room (&model->tethers[i]);
    }
  shore->line_of = -1;
  shore->line = bt__line_work_new (chain + 1, bt__model_among (model));
  shore->strand = calloc (2 * (size_t)model->n_tethers + 1, sizeof *shore->strand);
  shore->box = calloc (2 * (size_t)model->n_tethers + 1, sizeof *shore->box);
  shore->mover = calloc (moving + 1, sizeof *shore->mover);
  shore->course = calloc (moving + 1, sizeof *shore->course);
  shore->by_hull = calloc (pairs + 1, sizeof *shore->by_hull);
  if (!shore->line || !shore->strand || !shore->box || !shore->mover || !shore->course
      || !shore->by_hull)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for what the lines of a dive touch");
  if (model->n_obstacles == 0)
    return BT_OK;
  shore->safe_of = -1;
  shore->node = calloc ((size_t)chain + 1, sizeof *shore->node);
  shore->share = calloc ((size_t)chain + 1, sizeof *shore->share);
  if (!shore->node || !shore->share)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the obstacles of a dive");
  status = bt__polyline_work_new ((uint32_t)room + 1, (uint32_t)model->n_carried, &shore->polyline,
                                  error);
  /* A chain is taken by the safe step to where it is laid, as a polyline is.  */
  return status == BT_OK ? bt__safe_new ((uint32_t)(chain > room ? chain : room) + 1, BT__PARTS_MAX,
                                         &shore->safe, error)
                         : status;
}

static void
free_shore (bt__contact_work *shore)
{
  free (shore->mover);
  free (shore->course);
  free (shore->by_hull);
  free (shore->pin);
  free (shore->strand);
  free (shore->box);
  free (shore->order);
  free (shore->place);
  free (shore->barred);
  free (shore->node);
  free (shore->share);
  bt__line_work_free (shore->line);
  bt__polyline_work_free (shore->polyline);
  bt__safe_free (shore->safe);
}

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

/* Make a dive with NOW and NEXT bytes of its states; 0: none.  */
static bt_status
make_dive_of_size (bt_model *model, size_t now, size_t next, bt_dive **out, bt_error *error)
{
  bt_status status = BT_OK;
  bt_dive *dive = calloc (1, sizeof *dive);
  if (!dive)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a dive");
  dive->model = bt_model_retain (model);
  status = make_layout (dive, error);
  dive->now = now > 0 ? calloc (1, now) : NULL;
  dive->next = calloc (1, next);
  dive->sea = calloc (2, sizeof *dive->sea);
  if ((now > 0 && !dive->now) || !dive->next || !dive->sea)
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a state of %zu bytes", dive->size);
  if (status == BT_OK)
    status = make_tools (dive, error);
  if (status == BT_OK)
    status = make_shore (dive, error);
  if (status == BT_OK)
    *out = dive;
  else
    bt_dive_free (dive);
  return status;
}

bt_status
bt__dive_alloc (bt_model *model, bt_dive **out, bt_error *error)
{
  size_t size = bt__state_size (model);
  bt_dive *dive;
  bt_status status = make_dive_of_size (model, size, size, &dive, error);
  if (status != BT_OK)
    return status;
  status = make_rows (dive, error);
  if (status != BT_OK)
    {
      bt_dive_free (dive);
      return status;
    }
  lay_out (dive);
  *out = dive;
  return BT_OK;
}

bt_status
bt__dive_alloc_lane (bt_model *model, bt__context *context, bt_error *error)
{
  bt_status status = make_dive_of_size (model, 0, sizeof (bt__state), &context->dive, error);
  if (status == BT_OK)
    context->dive->context = context;
  return status;
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
  bt_search_free (dive->tools.search);
  bt_steady_free (dive->tools.steady);
  bt__dynamic_work_free (dive->work);
  free (dive->polyline);
  free (dive->motion);
  free (dive->corner);
  free (dive->along);
  free (dive->fit);
  free (dive->driven);
  free (dive->sea);
  free (dive->line);
  free (dive->alike);
  free_shore (&dive->contact_work);
  bt__watch_free_all (dive->watch);
  bt__contexts_free (dive->contexts);
  free (dive->now);
  free (dive->next);
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
  bt_status status = bt__dive_alloc (dive->model, copy, error);
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
