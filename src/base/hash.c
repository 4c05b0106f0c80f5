/* A 64-bit hash: words mixed by multiplication and rotation, after the finaliser of MurmurHash3.
   Not for secrets: for telling states apart.

   One word waits for the word before.  Of long data eight lanes, each of every eighth word, are
   mixed side by side: a lane is xored with the word, multiplied by an odd number and rotated.  Each
   step can be undone, so two data with one differing word always differ in a lane.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/hash.h"

static uint64_t
mix (uint64_t h, uint64_t word)
{
  h ^= word;
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

/* H with N bytes from P on.  */
static uint64_t
mix_bytes (uint64_t h, const unsigned char *p, size_t n)
{
  for (; n >= 8; n -= 8, p += 8)
    {
      uint64_t word;
      memcpy (&word, p, 8);
      h = mix (h, word);
    }
  if (n > 0)
    {
      uint64_t word = 0;
      memcpy (&word, p, n);
      h = mix (h, word);
    }
  return h;
}

static uint64_t
start_hash (size_t n, uint64_t seed)
{
  return mix (seed ^ 0x9e3779b97f4a7c15ULL, n);
}

uint64_t
bt__hash (const void *data, size_t n, uint64_t seed)
{
  return mix_bytes (start_hash (n, seed), data, n);
}

uint64_t
bt__hash_rows (const void *data, size_t rows, size_t used, size_t stride, uint64_t seed)
{
  const unsigned char *p = data;
  uint64_t h = start_hash (rows * used, seed);
  for (size_t i = 0; i < rows; i++)
    h = mix_bytes (h, p + i * stride, used);
  return h;
}

static uint64_t
mix_fast (uint64_t h, const unsigned char *p)
{
  uint64_t word;
  memcpy (&word, p, sizeof word);
  h = (h ^ word) * 0x9fb21c651e98df25ULL;
  return h << 29 | h >> 35;
}

void
bt__hash_begin (bt__hash_lanes *lanes)
{
  for (uint64_t k = 0; k < BT__HASH_LANES; k++)
    lanes->lane[k] = k + 1;
  lanes->n = 0;
}

void
bt__hash_add (bt__hash_lanes *lanes, const void *data, size_t n)
{
  const unsigned char *p = data;
  uint64_t *l = lanes->lane, a = l[0], b = l[1], c = l[2], d = l[3], e = l[4], f = l[5], g = l[6],
           h = l[7];
  lanes->n += n;
  /* Not a loop over the lanes: of those gcc makes an array in memory, at half the speed.  */
  for (; n >= 8 * BT__HASH_LANES; n -= 8 * BT__HASH_LANES, p += 8 * BT__HASH_LANES)
    {
      a = mix_fast (a, p);
      b = mix_fast (b, p + 8);
      c = mix_fast (c, p + 16);
      d = mix_fast (d, p + 24);
      e = mix_fast (e, p + 32);
      f = mix_fast (f, p + 40);
      g = mix_fast (g, p + 48);
      h = mix_fast (h, p + 56);
    }
  const uint64_t mixed[BT__HASH_LANES] = { a, b, c, d, e, f, g, h };
  memcpy (l, mixed, sizeof mixed);
  for (; n >= 8; n -= 8, p += 8, l++)
    *l = mix_fast (*l, p);
  *l = mix_bytes (*l, p, n);
}

uint64_t
bt__hash_end (const bt__hash_lanes *lanes)
{
  return bt__hash (lanes->lane, sizeof lanes->lane, lanes->n);
}
