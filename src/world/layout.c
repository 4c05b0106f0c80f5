/* Offsets of all parts in the flat state of a dive, and the extent of the live bytes.

   The state is one block (state.h).  Sizes follow from the model alone, so every state of a dive
   has the same layout, and a pointer to a part is an offset from the block: bt__dive_nodes,
   bt__dive_chain and their neighbours are the views.

   The store of a tether is shared by forms that exclude each other.  A static shape keeps node and
   tension arrays there, followed by the polyline of a line that is split or held by obstacles; a
   moving line keeps its chain and contacts, then chain and contacts of the far part once the line
   has parted.  The wear of the line stands behind the larger of the two.

   Stores have room for the largest mesh, mostly unused, and the head has room for the longest
   current, most waves and 128 events.  live_ranges and head_in_use list the ranges in use; copies,
   hashes and sizes of checkpoints walk these lists alone, and bt__layout_fits checks the list of a
   state from outside against the size of the store before a byte is copied.

   Most of a state stands still from step to step: stores of tethers that sleep, friction and
   switches of obstacles.  dive->alike tells of each such part whether both buffers hold the same
   bytes there; whoever writes to a part says so first (bt__store_changes, bt__pairs_change), and
   bt__level copies the other parts alone.

   Two states are the same dive exactly if their live bytes are equal.  The assertions below keep
   padding out of the structs, since padding would have no defined value.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "world/form.h"
#include "world/layout.h"
#include "world/obstacles.h"

/* Byte-wise equality of states means equality of dives only if no byte is padding.  */
_Static_assert(sizeof (bt__rigid) == 29 * 8, "no padding in bt__rigid");
_Static_assert(sizeof (bt__pilot) == 20 * 8, "no padding in bt__pilot");
_Static_assert(sizeof (bt__instruments) == 13 * 8, "no padding in bt__instruments");
_Static_assert(sizeof (bt__vehicle) == (35 + 29 + 20 + 13) * 8, "no padding in bt__vehicle");
_Static_assert(sizeof (bt_event) == 5 * 8, "no padding in bt_event");
_Static_assert(sizeof (bt__mover_state) == 18 * 8, "no padding in bt__mover_state");
_Static_assert(sizeof (bt__subject) == (21 + 2 * BT__MEETINGS_MAX) * 8, "nor in bt__subject");
_Static_assert(sizeof (bt__state) % 8 == 0, "whole words in bt__state");
_Static_assert(sizeof (bt__tether) % 8 == 0, "whole words in bt__tether");

bt__layout
bt__layout_of (const bt_model *model)
{
  bt__layout l = { .tethers = sizeof (bt__vehicle) * (size_t)model->n_vehicles };
  l.section = l.tethers + sizeof (bt__tether) * (size_t)model->n_tethers;
  l.roughness = l.section + bt__roughness_at (model);
  l.subjects = l.section + bt__subjects_at (model);
  l.subject = bt__subject_size (model);
  l.stores = l.section + bt__obstacles_size (model);
  return l;
}

/* ---- The store of a tether ---- */

/* Room for the intervals of a moving line: four times the number in the world, more for coarse
   lines and twice the number for fine ones, since a longer or more bent line needs more intervals.
   The length on the drum has no influence: the mesh follows the paid-out length
   (tether/dynamic_mesh.c).  */
int
bt__chain_room (const bt_tether_def *tether)
{
  double n = (double)tether->props.nodes;
  return (int)fmax (2 * n, fmin (fmax (4 * n, 128), 2048));
}

int
bt__polyline_room (const bt_tether_def *tether)
{
  return (int)bt__thesis_room ((uint32_t)tether->props.nodes);
}

/* A shape that a chain is laid from may have as many points as the chain.  */
static int
node_points (const bt_tether_def *tether)
{
  return bt__chain_room (tether) + 1;
}

size_t
bt__arrays_size (const bt_tether_def *tether)
{
  return 2 * sizeof (bt_vec3) * (size_t)node_points (tether);
}

/* A line in a world without obstacles and hulls can touch only lines, in few places.  */
int
bt__contact_room (const bt_model *model, const bt_tether_def *tether)
{
  int chain = bt__chain_room (tether);
  return bt__model_among (model) == BT__AMONG_OBSTACLES ? 64 + 2 * chain : 24 + chain / 4;
}

bt__line_size
bt__line_size_of (const bt_model *model, int i)
{
  const bt_tether_def *tether = &model->tethers[i];
  bt__line_size size = { .chain = bt__dynamic_size (bt__chain_room (tether)) };
  size.part = size.chain + bt__contacts_size (bt__contact_room (model, tether));
  return size;
}

/* The polyline of a static line, split or held.  */
static size_t
contact_form_size (const bt_model *model, const bt_tether_def *tether)
{
  size_t spans = bt__thesis_size ((uint32_t)tether->props.nodes);
  size_t held = bt__polyline_size ((uint32_t)bt__polyline_room (tether));
  if (model->n_obstacles == 0)
    return 0;
  return spans > held ? spans : held;
}

/* The size of the shape, still or moving; the wear begins behind the shape.  */
static size_t
shape_size (const bt_model *model, int i)
{
  const bt_tether_def *tether = &model->tethers[i];
  size_t still = bt__arrays_size (tether) + contact_form_size (model, tether);
  size_t moving = 2 * bt__line_size_of (model, i).part;
  return still > moving ? still : moving;
}

static size_t
wear_size (const bt_tether_def *tether)
{
  return sizeof (double) * (size_t)bt__wear_spots (tether->length);
}

size_t
bt__store_size (const bt_model *model, int i)
{
  const bt_tether_def *tether = &model->tethers[i];
  return shape_size (model, i) + (model->n_obstacles > 0 ? wear_size (tether) : 0);
}

size_t
bt__state_size (const bt_model *model)
{
  size_t size = sizeof (bt__state) + bt__layout_of (model).stores;
  for (int i = 0; i < model->n_tethers; i++)
    size += bt__store_size (model, i);
  return size;
}

/* ---- Views ---- */

bt_vec3
bt__attachment (const bt_dive *dive, bt__state *state, int vehicle)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  return v->rigid ? bt__rigid_point (&v->body, dive->model->types[vehicle].attached) : v->position;
}

static char *
store_of (const bt_dive *dive, const bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  return bt__state_body (dive, (bt__state *)state) + dive->layout.stores + tether->store_at;
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

void
bt__clear_unused_nodes (const bt_dive *dive, bt__state *state, int i)
{
  size_t n = (size_t)bt__dive_tether (dive, state, i)->shape.n + 1;
  size_t unused = sizeof (bt_vec3) * ((size_t)node_points (&dive->model->tethers[i]) - n);
  memset (bt__dive_nodes (dive, state, i) + n, 0, unused);
  memset (bt__dive_tensions (dive, state, i) + n, 0, unused);
}

bt__dynamic *
bt__dive_chain (const bt_dive *dive, bt__state *state, int i, int part)
{
  size_t offset = part ? dive->line[i].part : 0;
  return (bt__dynamic *)(void *)(store_of (dive, state, i) + offset);
}

double
bt__beyond_chain (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  return tether->parted ? tether->lost + bt__dynamic_length (bt__dive_chain (dive, state, i, 1))
                        : 0;
}

bt__contacts *
bt__dive_anchors (const bt_dive *dive, bt__state *state, int i, int part)
{
  char *chain = (char *)bt__dive_chain (dive, state, i, part);
  return (bt__contacts *)(void *)(chain + dive->line[i].chain);
}

bt__wear
bt__dive_wear (const bt_dive *dive, bt__state *state, int i)
{
  const bt_tether_def *tether = &dive->model->tethers[i];
  char *at = store_of (dive, state, i) + shape_size (dive->model, i);
  return (bt__wear){ (double *)(void *)at, bt__wear_spots (tether->length),
                     bt__wear_width (tether->length) };
}

bt__thesis *
bt__dive_thesis (const bt_dive *dive, bt__state *state, int i)
{
  return (bt__thesis *)(void *)(store_of (dive, state, i)
                                + bt__arrays_size (&dive->model->tethers[i]));
}

bt__polyline *
bt__dive_held (const bt_dive *dive, bt__state *state, int i)
{
  return (bt__polyline *)(void *)bt__dive_thesis (dive, state, i);
}

/* ---- What is live ---- */

enum
{
  HEAD_RANGES = 4
};

/* The ranges of the head of STATE in use, in order.  STATE may come from outside: no number in it
   is believed.  */
static void
head_in_use (const bt__state *state, bt__range out[HEAD_RANGES])
{
  const size_t current = offsetof (bt__state, current), waves = offsetof (bt__state, waves);
  size_t rows = state->current.kind == BT_CURRENT_PROFILE ? BT_PROFILE_MAX : 0;
  int64_t events = state->events < 0                ? 0
                   : state->events < BT_EVENTS_KEPT ? state->events
                                                    : BT_EVENTS_KEPT;
  out[0] = (bt__range){ 0, current + offsetof (bt_current, z) + rows * sizeof (double) };
  out[1] = (bt__range){ current + offsetof (bt_current, velocity),
                        sizeof (bt_vec3) * (rows > 0 ? rows : 1) };
  out[2] = (bt__range){ waves, state->waves.n != 0 ? sizeof (bt_waves) : sizeof state->waves.n };
  out[3] = (bt__range){ offsetof (bt__state, event), sizeof (bt_event) * (size_t)events };
}

void
bt__copy_head (bt__state *to, const bt__state *from)
{
  bt__range live[HEAD_RANGES];
  head_in_use (from, live);
  for (int k = 0; k < HEAD_RANGES; k++)
    memcpy ((char *)to + live[k].at, (const char *)from + live[k].at, live[k].size);
}

/* The parts of tether I's store in use, in the order of the store.  */
static int
live_ranges (const bt_dive *dive, const bt__state *state, int i, bt__range *out)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  int n = bt__form_of (tether)->ranges (dive, state, i, out);
  if (tether->wear != 0)
    out[n++] = (bt__range){ shape_size (dive->model, i), wear_size (&dive->model->tethers[i]) };
  return n;
}

void
bt__copy_store (const bt_dive *dive, bt__state *to, const bt__state *from, int i)
{
  bt__range live[BT__STORE_RANGES];
  for (int k = live_ranges (dive, from, i, live); k-- > 0;)
    memcpy (store_of (dive, to, i) + live[k].at, store_of (dive, from, i) + live[k].at,
            live[k].size);
}

/* Copy all that comes before the stores.  */
static void
copy_fixed (const bt_dive *dive, bt__state *to, const bt__state *from)
{
  bt__copy_head (to, from);
  memcpy (to + 1, from + 1, dive->layout.stores);
}

void
bt__copy_state (const bt_dive *dive, bt__state *to, const bt__state *from)
{
  copy_fixed (dive, to, from);
  for (int i = 0; i < dive->model->n_tethers; i++)
    bt__copy_store (dive, to, from, i);
}

/* Copy what comes before the stores but for the friction of obstacles, and what a subject's bytes
   tell of each obstacle.  */
static void
copy_without_pairs (const bt_dive *dive, bt__state *to, const bt__state *from)
{
  const bt__layout *l = &dive->layout;
  bt__copy_head (to, from);
  memcpy (to + 1, from + 1, l->roughness);
  for (size_t at = l->subjects; at < l->stores; at += l->subject)
    memcpy ((char *)(to + 1) + at, (const char *)(from + 1) + at, sizeof (bt__subject));
}

void
bt__level (bt_dive *dive)
{
  if (dive->alike[BT__PAIRS])
    copy_without_pairs (dive, dive->next, dive->now);
  else
    copy_fixed (dive, dive->next, dive->now);
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (!dive->alike[BT__STORES + i])
      bt__copy_store (dive, dive->next, dive->now, i);
  memset (dive->alike, 1, BT__STORES + (size_t)dive->model->n_tethers);
}

size_t
bt__walk_live (const bt_dive *dive, const bt__state *state, bt__walk *walk, void *user)
{
  bt__range live[BT__STORE_RANGES], head[HEAD_RANGES];
  size_t count = HEAD_RANGES + 1;
  head_in_use (state, head);
  for (int k = 0; k < HEAD_RANGES; k++)
    walk (user, head[k].at, (const char *)state + head[k].at, head[k].size);
  walk (user, sizeof *state, state + 1, dive->layout.stores);
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      const char *store = store_of (dive, state, i);
      int n = live_ranges (dive, state, i, live);
      for (int k = 0; k < n; k++, count++)
        walk (user, (size_t)(store - (const char *)state) + live[k].at, store + live[k].at,
              live[k].size);
    }
  return count;
}

static void
hash_range (void *lanes, size_t at, const void *data, size_t size)
{
  (void)at;
  bt__hash_add (lanes, data, size);
}

uint64_t
bt__hash_state (const bt_dive *dive, const bt__state *state)
{
  bt__hash_lanes lanes;
  bt__hash_begin (&lanes);
  bt__walk_live (dive, state, hash_range, &lanes);
  return bt__hash_end (&lanes);
}

static void
add_size (void *sum, size_t at, const void *data, size_t size)
{
  (void)at;
  (void)data;
  *(size_t *)sum += size;
}

size_t
bt__live_size (const bt_dive *dive, const bt__state *state)
{
  size_t size = 0;
  bt__walk_live (dive, state, add_size, &size);
  return size;
}

size_t
bt__live_head (const bt__state *state)
{
  bt__range live[HEAD_RANGES];
  size_t size = 0;
  head_in_use (state, live);
  for (int k = 0; k < HEAD_RANGES; k++)
    size += live[k].size;
  return size;
}

int
bt__layout_fits (const bt_dive *dive, const bt__state *state)
{
  bt__range live[BT__STORE_RANGES];
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      size_t store = bt__store_size (dive->model, i);
      if (bt__dive_tether (dive, (bt__state *)state, i)->store_at
          != bt__dive_tether (dive, dive->now, i)->store_at)
        return 0;
      for (int k = live_ranges (dive, state, i, live); k-- > 0;)
        if (live[k].at > store || live[k].size > store - live[k].at)
          return 0;
    }
  return 1;
}
