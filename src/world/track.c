/* Measured tracks that the vehicles of a dive follow.

   Tracks are large and never change, so they are kept beside the state, and the state holds the
   number of a track.  Equal rows are kept once: following a track anew, after going back in time,
   then leads to the same state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "world/dive.h"

static bt_status
check_track_rows (const double *rows, int n, bt_error *error)
{
  if (!rows || n < 8 || n % 4 != 0)
    return bt__fail (error, BT_ERR_FORMAT, "a track has rows of t x y z, not %d numbers", n);
  for (int i = 0; i < n; i++)
    if (!(fabs (rows[i]) <= 1e7))
      return bt__fail (error, BT_ERR_FORMAT, "row %d of the track has %g", i / 4 + 1, rows[i]);
  for (int i = 4; i < n; i += 4)
    if (rows[i] <= rows[i - 4])
      return bt__fail (error, BT_ERR_FORMAT, "row %d of the track does not come later than row %d",
                       i / 4 + 1, i / 4);
  return BT_OK;
}

static int
find_track (const bt_dive *dive, const double *rows, int n)
{
  for (int i = 0; i < dive->n_tracks; i++)
    if (dive->tracks[i]->n == n / 4
        && memcmp (dive->tracks[i]->row, rows, sizeof *rows * (size_t)n) == 0)
      return i;
  return -1;
}

bt_status
bt_dive_add_track (bt_dive *dive, const double *rows, int n, int *index, bt_error *error)
{
  bt_status status = check_track_rows (rows, n, error);
  size_t bytes = sizeof *rows * (size_t)n;
  bt__track *track;
  if (status != BT_OK)
    return status;
  *index = find_track (dive, rows, n);
  if (*index >= 0)
    return BT_OK;
  if (dive->n_tracks == BT__TRACKS_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a dive follows at most %d tracks", BT__TRACKS_MAX);
  track = malloc (sizeof *track + bytes);
  if (!track)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a track of %d rows", n / 4);
  atomic_init (&track->references, 1);
  track->n = n / 4;
  memcpy (track->row, rows, bytes);
  *index = dive->n_tracks;
  dive->tracks[dive->n_tracks++] = track;
  return BT_OK;
}

int
bt_dive_track (const bt_dive *dive, int i, const double **rows)
{
  if (i < 0 || i >= dive->n_tracks)
    return 0;
  *rows = dive->tracks[i]->row[0];
  return 4 * dive->tracks[i]->n;
}
