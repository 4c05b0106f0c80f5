/* A 64-bit hash: words mixed by multiplication and rotation, after the finaliser of MurmurHash3.
   Not for secrets: for telling states apart.

   One word waits for the word before.  Of long data sixteen lanes, each of every sixteenth word,
   are mixed side by side.  A lane is xored with the word; the lower half of the lane is then
   multiplied by a factor and the upper half added, as by the generators called multiply with carry
   (G. Marsaglia, 1994).  SSE2 does two lanes at once, since the product of two halves is all that
   it multiplies; of two words that differ one in 2^64 others leaves the same lane.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

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

/* ---- Lanes ---- */

enum
{
  BLOCK = 8 * BT__HASH_LANES /* bytes: a word for each lane */
};

static const uint64_t factor = 0x9e3779b1; /* prime, the golden section of 2^32 */

static size_t
least (size_t a, size_t b)
{
  return a < b ? a : b;
}

/* Some lanes side by side, H, mixed with the words at P.  */
#ifdef __SSE2__
typedef __m128i part;

static inline part
mix_part (part h, const unsigned char *p)
{
  h = _mm_xor_si128 (h, _mm_loadu_si128 ((const __m128i *)(const void *)p));
  return _mm_add_epi64 (_mm_mul_epu32 (h, _mm_set1_epi64x ((long long)factor)),
                        _mm_srli_epi64 (h, 32));
}
#else
typedef uint64_t part;

static inline part
mix_part (part h, const unsigned char *p)
{
  uint64_t word;
  memcpy (&word, p, sizeof word);
  h ^= word;
  return (h & 0xffffffff) * factor + (h >> 32);
}
#endif

/* Mix the block at P into the lanes L, and then, while more than a block of N bytes is left, the
   next; the last block ends where the bytes end, and may begin within the block before.  */
static void
mix_blocks (uint64_t *l, const unsigned char *p, size_t n)
{
  part h[BLOCK / sizeof (part)];
  memcpy (h, l, sizeof h);
  for (size_t step = 1; step > 0; p += step, n -= step)
    {
      /* Unrolled, or else the lanes would be kept in memory, at half the speed.  */
#pragma GCC unroll 16
      for (size_t k = 0; k < BLOCK / sizeof (part); k++)
        h[k] = mix_part (h[k], p + k * sizeof (part));
      step = least (BLOCK, n - BLOCK);
    }
  memcpy (l, h, sizeof h);
}

void
bt__hash_begin (bt__hash_lanes *lanes)
{
  for (uint64_t k = 0; k < BT__HASH_LANES; k++)
    lanes->lane[k] = k + 1;
  lanes->little = lanes->n = 0;
}

void
bt__hash_add (bt__hash_lanes *lanes, const void *data, size_t n)
{
  lanes->n += n;
  if (n >= BLOCK)
    mix_blocks (lanes->lane, data, n);
  else
    lanes->little = mix_bytes (lanes->little, data, n);
}

uint64_t
bt__hash_end (const bt__hash_lanes *lanes)
{
  uint64_t h = mix (lanes->little, lanes->n);
  for (int k = 0; k < BT__HASH_LANES; k++)
    {
      h = (h ^ lanes->lane[k]) * 0x9fb21c651e98df25ULL;
      h = h << 29 | h >> 35;
    }
  return mix (h, 0);
}
