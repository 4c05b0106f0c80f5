/* Hashes of long data: as told lane by lane, and never the same after a bit was changed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/hash.h"

enum
{
  LONGEST = 700,
  BLOCK = 8 * BT__HASH_LANES
};

static void
fill (unsigned char *p, size_t n, uint64_t seed)
{
  for (size_t i = 0; i < n; i++)
    {
      seed = seed * 6364136223846793005u + 1442695040888963407u;
      p[i] = (unsigned char)(seed >> 56);
    }
}

static uint64_t
hash_of (const void *data, size_t n)
{
  bt__hash_lanes lanes;
  bt__hash_begin (&lanes);
  bt__hash_add (&lanes, data, n);
  return bt__hash_end (&lanes);
}

/* One lane after the other, a word at a time: block by block, the last block at the end.  */
static void
mix_plainly (uint64_t *lane, const unsigned char *p, size_t n)
{
  for (size_t at = 0;; at = at + 2 * BLOCK > n ? n - BLOCK : at + BLOCK)
    {
      for (size_t k = 0; k < BT__HASH_LANES; k++)
        {
          uint64_t word;
          memcpy (&word, p + at + 8 * k, sizeof word);
          word ^= lane[k];
          lane[k] = (word & 0xffffffff) * 0x9e3779b1 + (word >> 32);
        }
      if (at + BLOCK == n)
        return;
    }
}

static void
lanes_are_mixed_as_told (void **state)
{
  unsigned char data[LONGEST + 1];
  (void)state;
  fill (data, sizeof data, 1);
  for (size_t n = BLOCK; n <= LONGEST; n++)
    {
      bt__hash_lanes lanes, plain;
      bt__hash_begin (&lanes);
      plain = lanes;
      bt__hash_add (&lanes, data + 1, n);
      mix_plainly (plain.lane, data + 1, n);
      plain.n += n;
      if (memcmp (&lanes, &plain, sizeof lanes) != 0)
        fail_msg ("%zu bytes", n);
    }
}

static void
every_bit_counts (void **state)
{
  static const size_t sizes[] = { 1, 7, 8, 16, 127, 128, 129, 200, 255, 256, 264, LONGEST };
  unsigned char data[LONGEST];
  (void)state;
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    {
      fill (data, sizes[i], i);
      uint64_t was = hash_of (data, sizes[i]);
      for (size_t bit = 0; bit < 8 * sizes[i]; bit++)
        {
          data[bit / 8] ^= (unsigned char)(1u << bit % 8);
          if (hash_of (data, sizes[i]) == was)
            fail_msg ("bit %zu of %zu bytes", bit, sizes[i]);
          data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        }
      assert_true (hash_of (data, sizes[i]) == was);
    }
}

/* Numbers with the opposite sign, in any two places, are no others' hash.  */
static void
signs_do_not_cancel (void **state)
{
  double x[64];
  (void)state;
  for (int i = 0; i < 64; i++)
    x[i] = 0.5 * (i + 1);
  uint64_t was = hash_of (x, sizeof x);
  for (int i = 0; i < 64; i++)
    for (int k = 0; k < i; k++)
      {
        x[i] = -x[i];
        x[k] = -x[k];
        if (hash_of (x, sizeof x) == was)
          fail_msg ("numbers %d and %d", k, i);
        x[i] = -x[i];
        x[k] = -x[k];
      }
}

/* What stands before counts, and how much there is: zeros more, the same pieces the other way
   round.  */
static void
length_and_order_count (void **state)
{
  static const unsigned char zeros[3 * BLOCK];
  uint64_t seen[3 * BLOCK];
  (void)state;
  for (size_t n = 0; n < sizeof zeros; n++)
    {
      seen[n] = hash_of (zeros, n);
      for (size_t k = 0; k < n; k++)
        if (seen[k] == seen[n])
          fail_msg ("%zu and %zu zeros", k, n);
    }
  unsigned char data[2 * BLOCK];
  bt__hash_lanes a, b;
  fill (data, sizeof data, 3);
  bt__hash_begin (&a);
  bt__hash_begin (&b);
  bt__hash_add (&a, data, BLOCK);
  bt__hash_add (&a, data + BLOCK, BLOCK);
  bt__hash_add (&b, data + BLOCK, BLOCK);
  bt__hash_add (&b, data, BLOCK);
  assert_true (bt__hash_end (&a) != bt__hash_end (&b));
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (lanes_are_mixed_as_told),
    cmocka_unit_test (every_bit_counts),
    cmocka_unit_test (signs_do_not_cancel),
    cmocka_unit_test (length_and_order_count),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
