/* Saved states without unused room, by run-length coding of zeros.

   A state has room for the largest meshes of its tethers; in a saved state unused room is zero.
   The packed form begins with a mark.  Then follow, repeatedly, the number of zero words of eight
   bytes, the number of other words, and the other words.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdint.h>
#include <string.h>

#include <bight/dive.h>

#include "base/error.h"

static const uint64_t mark = 0x31306b6361707462; /* "btpack01" */

/* The number of words from AT on, of N, in a row of zeros, or with ZERO false of words other than
   0.  */
static size_t
run_of (const uint64_t *word, size_t at, size_t n, int zero)
{
  size_t k = at;
  while (k < n && (word[k] == 0) == zero)
    k++;
  return k - at;
}

size_t
bt_state_pack (const void *state, size_t size, void *packed)
{
  const uint64_t *word = state;
  uint64_t *out = packed;
  size_t n = size / sizeof *word, used = 0;
  if (packed)
    out[used] = mark;
  used++;
  for (size_t at = 0; at < n;)
    {
      size_t none = run_of (word, at, n, 1), some = run_of (word, at + none, n, 0);
      if (packed)
        {
          out[used] = none;
          out[used + 1] = some;
          memcpy (out + used + 2, word + at + none, some * sizeof *word);
        }
      used += 2 + some;
      at += none + some;
    }
  return used * sizeof *word;
}

int
bt_state_is_packed (const void *bytes, size_t size)
{
  return size >= sizeof mark && memcmp (bytes, &mark, sizeof mark) == 0;
}

bt_status
bt_state_unpack (const void *packed, size_t n, void *state, size_t size, bt_error *error)
{
  const uint64_t *in = packed;
  uint64_t *out = state;
  size_t words = n / sizeof *in, room = size / sizeof *out, at = 1, put = 0;
  int good = n % sizeof *in == 0 && bt_state_is_packed (packed, n);
  while (good && at + 2 <= words)
    {
      uint64_t none = in[at], some = in[at + 1];
      at += 2;
      good = none <= room - put && some <= room - put - none && some <= words - at;
      if (!good)
        break;
      memset (out + put, 0, none * sizeof *out);
      memcpy (out + put + none, in + at, some * sizeof *out);
      put += none + some;
      at += some;
    }
  return good && at == words && put == room
             ? BT_OK
             : bt__fail (error, BT_ERR_STALE, "these bytes do not pack a state of %zu bytes", size);
}
