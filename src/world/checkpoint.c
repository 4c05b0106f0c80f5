/* Checkpoints: a state as bytes, and a dive taken back to them once they are judged.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "world/judge.h"
#include "world/layout.h"
#include "world/obstacles.h"

size_t
bt_dive_state_size (const bt_dive *dive)
{
  return dive->size;
}

uint64_t
bt_dive_hash (const bt_dive *dive)
{
  return bt__hash_state (dive, dive->now);
}

void
bt_dive_save (const bt_dive *dive, void *state)
{
  uint64_t checksum = bt_dive_hash (dive); /* the field itself is zero in a living state */
  memset (state, 0, dive->size);
  bt__copy_state (dive, state, dive->now);
  memcpy ((char *)state + offsetof (bt__state, checksum), &checksum, sizeof checksum);
}

/* False if STATE follows a track unknown to DIVE: a fork may have read the track and saved STATE.
 */
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

static bt_status
take_whole (bt_dive *dive, const void *state, size_t size, bt_error *error)
{
  if (size != dive->size)
    return bt__fail (error, BT_ERR_STALE, "a state of this dive has %zu bytes, not %zu", dive->size,
                     size);
  memcpy (dive->next, state, size);
  return BT_OK;
}

bt_status
bt_dive_restore (bt_dive *dive, const void *state, size_t size, bt_error *error)
{
  bt__state *next;
  uint64_t checksum;
  bt_status status = bt__dive_ready (dive, error);
  if (status != BT_OK)
    return status;
  next = dive->next;
  memset (dive->alike, 0, BT__STORES + (size_t)dive->model->n_tethers);
  if (bt_state_is_packed (state, size))
    status = bt_state_unpack (state, size, next, dive->size, error);
  else
    status = take_whole (dive, state, size, error);
  if (status != BT_OK)
    return status;
  checksum = next->checksum;
  next->checksum = 0;
  if (next->magic != BT__STATE_MAGIC || next->size != dive->size || !bt__layout_fits (dive, next)
      || checksum != bt__hash_state (dive, next))
    return bt__fail (error, BT_ERR_FORMAT, "these bytes are not a state as it was saved");
  if (next->model_id != dive->model->id)
    return bt__fail (error, BT_ERR_STALE, "this checkpoint belongs to another dive");
  status = bt__state_judge (dive, next, error);
  if (status == BT_OK && !knows_tracks (dive, next))
    status = bt__fail (error, BT_ERR_STALE, "this checkpoint belongs to another dive");
  return status == BT_OK ? bt__dive_become (dive, error) : status;
}
