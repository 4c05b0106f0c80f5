/* Saved states without unused room, by run-length coding of zeros.

   A state has room for the largest meshes of its tethers; in a saved state unused room is zero.
   The packed form begins with a mark.  Then follow, repeatedly, the number of zero words of eight
   bytes, the number of other words, and the other words.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdint.h>
#include <string.h>

#include <bight/dive.h>

#include "base/error.h"
#include "world/layout.h"

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

/* ---- Packed without a whole state ---- */

enum
{
  WORD = sizeof (uint64_t)
};

/* What is being packed: up to word DONE of the state, in USED words of OUT, or with OUT NULL
   counted alone.  */
typedef struct packing
{
  uint64_t *out;
  size_t done, used;
} packing;

/* Pack the SIZE bytes DATA, AT bytes from the beginning of the state, after zeros up to there.  */
static void
pack_range (void *user, size_t at, const void *data, size_t size)
{
  packing *p = user;
  size_t first = at / WORD, words = (size + WORD - 1) / WORD;
  if (p->out)
    {
      p->out[p->used] = first - p->done;
      p->out[p->used + 1] = words;
      if (words > 0)
        p->out[p->used + 1 + words] = 0; /* whose last bytes may be none of DATA */
      if (words > 0)
        memcpy (p->out + p->used + 2, data, size);
    }
  p->used += 2 + words;
  p->done = first + words;
}

/* Pack the present state of DIVE into OUT; return the number of words.  */
static size_t
pack_live (const bt_dive *dive, uint64_t *out)
{
  packing p = { .out = out, .used = 1 };
  bt__walk_live (dive, dive->now, pack_range, &p);
  pack_range (&p, dive->size, NULL, 0);
  return p.used;
}

size_t
bt_dive_keep_size (const bt_dive *dive)
{
  return pack_live (dive, NULL) * WORD;
}

size_t
bt_dive_keep (const bt_dive *dive, void *packed)
{
  uint64_t *out = packed, checksum = bt_dive_hash (dive);
  out[0] = mark;
  size_t used = pack_live (dive, out);
  /* The first range begins with the head, behind the mark and the two numbers of the range.  */
  memcpy ((char *)(out + 3) + offsetof (bt__state, checksum), &checksum, sizeof checksum);
  return used * WORD;
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
