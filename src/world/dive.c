/* The life of a dive: allocation, the two state buffers, forks, checkpoints, parts.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "world/dive.h"

/* The first bytes of a state: layout version 2.  */
static const uint64_t magic = 0x3154484749420002ULL;

/* Byte-wise equality of states means equality of dives only if no byte is padding.  */
_Static_assert(sizeof (bt__vehicle) == 36 * 8, "no padding in bt__vehicle");
_Static_assert(sizeof (bt_event) == 3 * 8, "no padding in bt_event");
_Static_assert(sizeof (bt__state) % 8 == 0, "whole words in bt__state");
_Static_assert(sizeof (bt__tether) % 8 == 0, "whole words in bt__tether");

/* ---- Layout ---- */

static size_t
fixed_size (const bt_model *model)
{
  return sizeof (bt__state) + sizeof (bt__vehicle) * (size_t)model->n_vehicles
         + sizeof (bt__tether) * (size_t)model->n_tethers;
}

/* A shape that a chain is laid from may have as many points as the chain.  */
static int
node_points (const bt_tether_def *tether)
{
  return bt__chain_room (tether) + 1;
}

static size_t
arrays_size (const bt_tether_def *tether)
{
  return 2 * sizeof (bt_vec3) * (size_t)node_points (tether);
}

static size_t
chain_size (const bt_tether_def *tether)
{
  return bt__dynamic_size (bt__chain_room (tether));
}

/* Arrays or up to two chains.  */
static size_t
store_size (const bt_tether_def *tether)
{
  size_t arrays = arrays_size (tether), chains = 2 * chain_size (tether);
  return arrays > chains ? arrays : chains;
}

/* The winch may double the line before its intervals grow longer.  */
int
bt__chain_room (const bt_tether_def *tether)
{
  return 2 * (int)tether->props.nodes;
}

static size_t
state_size (const bt_model *model)
{
  size_t size = fixed_size (model);
  for (int i = 0; i < model->n_tethers; i++)
    size += store_size (&model->tethers[i]);
  return size;
}

bt__vehicle *
bt__dive_vehicle (const bt_dive *dive, bt__state *state, int i)
{
  (void)dive;
  return bt__vehicles (state) + i;
}

bt__tether *
bt__dive_tether (const bt_dive *dive, bt__state *state, int i)
{
  return bt__tethers (state, dive->model->n_vehicles) + i;
}

static char *
store_of (const bt_dive *dive, const bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  return (char *)state + fixed_size (dive->model) + tether->store_at;
}

bt_vec3 *
bt__dive_nodes (const bt_dive *dive, bt__state *state, int i)
{
  return (bt_vec3 *)(void *)store_of (dive, state, i);
}

bt_vec3 *
bt__dive_tensions (const bt_dive *dive, bt__state *state, int i)
{
  return bt__dive_nodes (dive, state, i) + node_points (&dive->model->tethers[i]);
}

bt__dynamic *
bt__dive_chain (const bt_dive *dive, bt__state *state, int i, int part)
{
  size_t offset = part ? chain_size (&dive->model->tethers[i]) : 0;
  return (bt__dynamic *)(void *)(store_of (dive, state, i) + offset);
}

/* How many bytes of the store of tether I are in use.  */
static size_t
live_size (const bt_dive *dive, const bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  if (tether->shape.form == BT__FORM_NODES)
    return arrays_size (&dive->model->tethers[i]);
  if (tether->shape.form == BT__FORM_CHAIN)
    return chain_size (&dive->model->tethers[i]) * (tether->parted ? 2 : 1);
  return 0;
}

static void
copy_state (const bt_dive *dive, bt__state *to, const bt__state *from)
{
  memcpy (to, from, fixed_size (dive->model));
  for (int i = 0; i < dive->model->n_tethers; i++)
    memcpy (store_of (dive, to, i), store_of (dive, from, i), live_size (dive, from, i));
}

static uint64_t
hash_state (const bt_dive *dive, const bt__state *state)
{
  uint64_t h = bt__hash (state, fixed_size (dive->model), 0);
  for (int i = 0; i < dive->model->n_tethers; i++)
    h = bt__hash (store_of (dive, state, i), live_size (dive, state, i), h);
  return h;
}

double
bt__state_time (const bt__state *state)
{
  return (double)state->step * BT__TIME_STEP;
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
                     .user = dive->user };
}

/* ---- Life ---- */

/* Make the workspaces any tether of the model may come to need: its model may change while it
 * dives.  */
static bt_status
make_tools (bt_dive *dive, bt_error *error)
{
  int most = 0;
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (dive->model->tethers[i].props.nodes > most)
      most = (int)dive->model->tethers[i].props.nodes;
  if (most == 0)
    return BT_OK;
  dive->tools.search = bt_search_new ();
  dive->tools.steady = bt_steady_new (2 * most); /* as many as a chain comes to */
  dive->work = bt__dynamic_work_new (2 * most);
  dive->polyline = calloc ((size_t)(2 * most + 1), sizeof *dive->polyline);
  dive->along = calloc ((size_t)(2 * most + 1), sizeof *dive->along);
  dive->motion = calloc ((size_t)(2 * most + 1), sizeof *dive->motion);
  if (!dive->tools.search || !dive->tools.steady || !dive->work || !dive->polyline || !dive->motion
      || !dive->along)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the solvers of a dive");
  return BT_OK;
}

static void
lay_out (bt_dive *dive)
{
  int64_t at = 0;
  dive->now->magic = magic;
  dive->now->model_id = dive->model->id;
  dive->now->size = dive->size;
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__dive_tether (dive, dive->now, i)->store_at = at;
      at += (int64_t)store_size (&dive->model->tethers[i]);
    }
}

bt_status
bt__dive_alloc (bt_model *model, bt_dive **out, bt_error *error)
{
  bt_status status = BT_OK;
  bt_dive *dive = calloc (1, sizeof *dive);
  if (!dive)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a dive");
  dive->model = bt_model_retain (model);
  dive->size = state_size (model);
  dive->now = calloc (1, dive->size);
  dive->next = calloc (1, dive->size);
  if (!dive->now || !dive->next)
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a state of %zu bytes", dive->size);
  else
    status = make_tools (dive, error);
  if (status != BT_OK)
    {
      bt_dive_free (dive);
      return status;
    }
  lay_out (dive);
  *out = dive;
  return BT_OK;
}

static void
release_track (bt__track *track)
{
  if (atomic_fetch_sub (&track->references, 1) == 1)
    free (track);
}

void
bt_dive_free (bt_dive *dive)
{
  if (!dive)
    return;
  for (int i = 0; i < dive->n_tracks; i++)
    release_track (dive->tracks[i]);
  bt_search_free (dive->tools.search);
  bt_steady_free (dive->tools.steady);
  bt__dynamic_work_free (dive->work);
  free (dive->polyline);
  free (dive->motion);
  free (dive->along);
  free (dive->now);
  free (dive->next);
  bt_model_release (dive->model);
  free (dive);
}

bt_status
bt_dive_fork (const bt_dive *dive, bt_dive **copy, bt_error *error)
{
  bt_dive *fork;
  bt_status status = bt__dive_alloc (dive->model, &fork, error);
  if (status != BT_OK)
    return status;
  copy_state (dive, fork->now, dive->now);
  fork->function = dive->function;
  fork->user = dive->user;
  fork->n_tracks = dive->n_tracks;
  for (int i = 0; i < dive->n_tracks; i++)
    {
      fork->tracks[i] = dive->tracks[i];
      atomic_fetch_add (&fork->tracks[i]->references, 1);
    }
  *copy = fork;
  return BT_OK;
}

void
bt_dive_set_current_function (bt_dive *dive, bt_current_function function, void *user)
{
  dive->function = function;
  dive->user = user;
}

bt_status
bt__dive_add_track (bt_dive *dive, bt__track *track, bt_error *error)
{
  if (dive->n_tracks == BT__TRACKS_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a dive follows at most %d tracks", BT__TRACKS_MAX);
  dive->tracks[dive->n_tracks++] = track;
  return BT_OK;
}

bt__state *
bt__dive_begin (bt_dive *dive)
{
  copy_state (dive, dive->next, dive->now);
  return dive->next;
}

void
bt__dive_commit (bt_dive *dive)
{
  bt__state *old = dive->now;
  dive->now = dive->next;
  dive->next = old;
}

/* ---- Checkpoints ---- */

size_t
bt_dive_state_size (const bt_dive *dive)
{
  return dive->size;
}

uint64_t
bt_dive_hash (const bt_dive *dive)
{
  return hash_state (dive, dive->now);
}

void
bt_dive_save (const bt_dive *dive, void *state)
{
  uint64_t checksum = bt_dive_hash (dive); /* the field itself is zero in a living state */
  memset (state, 0, dive->size);
  copy_state (dive, state, dive->now);
  memcpy ((char *)state + offsetof (bt__state, checksum), &checksum, sizeof checksum);
}

/* A state saved by a fork may follow a track that this dive never read.  */
static int
knows_tracks (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      const bt__vehicle *vehicle = bt__dive_vehicle (dive, state, i);
      if (vehicle->goal == BT__GOAL_TRACK && vehicle->track >= dive->n_tracks)
        return 0;
    }
  return 1;
}

/* The offsets are looked at before the checksum, which they are needed for.  */
static int
stores_fit (const bt_dive *dive, const bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (bt__dive_tether (dive, (bt__state *)state, i)->store_at
        != bt__dive_tether (dive, dive->now, i)->store_at)
      return 0;
  return 1;
}

bt_status
bt_dive_restore (bt_dive *dive, const void *state, size_t size, bt_error *error)
{
  bt__state *next = dive->next;
  uint64_t checksum;
  if (size != dive->size)
    return bt__fail (error, BT_ERR_STALE, "a state of this dive has %zu bytes, not %zu", dive->size,
                     size);
  memcpy (next, state, size);
  checksum = next->checksum;
  next->checksum = 0;
  if (next->magic != magic || next->size != size || !stores_fit (dive, next)
      || checksum != hash_state (dive, next))
    return bt__fail (error, BT_ERR_FORMAT, "these bytes are not a state as it was saved");
  if (next->model_id != dive->model->id || !knows_tracks (dive, next))
    return bt__fail (error, BT_ERR_STALE, "this checkpoint belongs to another dive");
  bt__dive_commit (dive);
  return BT_OK;
}

/* ---- Parts ---- */

int
bt_dive_count (const bt_dive *dive, bt_part part)
{
  switch (part)
    {
    case BT_PART_SEA:
      return 1;
    case BT_PART_VEHICLE:
      return dive->model->n_vehicles;
    case BT_PART_TETHER:
      return dive->model->n_tethers;
    }
  return 0;
}

const char *
bt_dive_name (const bt_dive *dive, bt_part part, int i)
{
  if (i < 0 || i >= bt_dive_count (dive, part))
    return NULL;
  if (part == BT_PART_SEA)
    return "sea";
  return part == BT_PART_VEHICLE ? dive->model->vehicles[i].name : dive->model->tethers[i].name;
}

bt_status
bt__check_part (const bt_dive *dive, bt_part part, int i, bt_error *error)
{
  static const char *const words[] = { "sea", "vehicle", "tether" };
  int n = bt_dive_count (dive, part);
  if (i < 0 || i >= n)
    return bt__fail (error, BT_ERR_NAME, "there is no %s number %d; this dive has %d", words[part],
                     i, n);
  return BT_OK;
}
