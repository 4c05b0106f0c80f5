/* Triple buffer: the copies of the state that a live dive publishes.

   Of three copies the first is the latest state, the second belongs to a reader, and the third is
   written by the stepping thread.  Publishing writes the unused copy without a lock, then makes the
   copy the latest under the lock; a reader marks the latest copy as read for the time of reading.
   So the lock is held for an exchange of roles alone, and no reader, however slow, delays a step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "live/live.h"

bt_status
bt__shelf_init (bt__shelf *shelf, const bt_dive *dive, int moments, bt_error *error)
{
  int lacking = 0;
  memset (shelf, 0, sizeof *shelf);
  pthread_mutex_init (&shelf->readers, NULL);
  pthread_mutex_init (&shelf->lock, NULL);
  shelf->size = bt_dive_state_size (dive);
  shelf->room = moments;
  shelf->read = -1;
  shelf->moments = moments > 0 ? malloc ((size_t)moments * shelf->size) : NULL;
  shelf->labels = calloc ((size_t)moments + 1, sizeof *shelf->labels);
  lacking = !shelf->labels || (moments > 0 && !shelf->moments);
  for (int i = 0; i < 3; i++)
    lacking |= !(shelf->copy[i] = malloc (shelf->size));
  if (lacking)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the copies of a state of %zu bytes",
                     shelf->size);
  bt__shelf_publish (shelf, dive);
  return BT_OK;
}

void
bt__shelf_free (bt__shelf *shelf)
{
  for (int i = 0; i < 3; i++)
    free (shelf->copy[i]);
  free (shelf->moments);
  free (shelf->labels);
  pthread_mutex_destroy (&shelf->readers);
  pthread_mutex_destroy (&shelf->lock);
}

static int
unused_copy (bt__shelf *shelf)
{
  int i = 0;
  pthread_mutex_lock (&shelf->lock);
  while (i == shelf->latest || i == shelf->read)
    i++;
  pthread_mutex_unlock (&shelf->lock);
  return i;
}

void
bt__shelf_publish (bt__shelf *shelf, const bt_dive *dive)
{
  int i = unused_copy (shelf);
  bt_dive_save (dive, shelf->copy[i]);
  pthread_mutex_lock (&shelf->lock);
  shelf->latest = i;
  shelf->steps = bt_dive_steps (dive);
  shelf->edition++;
  pthread_mutex_unlock (&shelf->lock);
}

void
bt__shelf_keep (bt__shelf *shelf, const bt_dive *dive)
{
  int i;
  if (shelf->room == 0)
    return;
  i = (shelf->oldest + shelf->kept) % shelf->room;
  pthread_mutex_lock (&shelf->lock);
  bt_dive_save (dive, shelf->moments + (size_t)i * shelf->size);
  shelf->labels[i] = (bt__moment){ bt_dive_steps (dive), bt_dive_hash (dive) };
  if (shelf->kept < shelf->room)
    shelf->kept++;
  else
    shelf->oldest = (shelf->oldest + 1) % shelf->room;
  pthread_mutex_unlock (&shelf->lock);
}

bt_status
bt__shelf_read (bt__shelf *shelf, bt_dive *view, bt_error *error)
{
  bt_status status;
  int i;
  pthread_mutex_lock (&shelf->readers);
  pthread_mutex_lock (&shelf->lock);
  i = shelf->read = shelf->latest;
  pthread_mutex_unlock (&shelf->lock);
  status = bt_dive_restore (view, shelf->copy[i], shelf->size, error);
  pthread_mutex_lock (&shelf->lock);
  shelf->read = -1;
  pthread_mutex_unlock (&shelf->lock);
  pthread_mutex_unlock (&shelf->readers);
  return status;
}

int
bt_live_moments (bt_live *live)
{
  int kept;
  pthread_mutex_lock (&live->shelf.lock);
  kept = live->shelf.kept;
  pthread_mutex_unlock (&live->shelf.lock);
  return kept;
}

size_t
bt_live_moment (bt_live *live, int i, int64_t *step, uint64_t *hash, void *state)
{
  bt__shelf *shelf = &live->shelf;
  size_t size = 0;
  pthread_mutex_lock (&shelf->lock);
  if (i >= 0 && i < shelf->kept)
    {
      size_t at = (size_t)((shelf->oldest + i) % shelf->room);
      size = shelf->size;
      *step = shelf->labels[at].step;
      *hash = shelf->labels[at].hash;
      if (state)
        memcpy (state, shelf->moments + at * size, size);
    }
  pthread_mutex_unlock (&shelf->lock);
  return size;
}
