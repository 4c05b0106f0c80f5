/* Four sines, cosines and exponentials side by side are those of libm, on any machine the same.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "clones.h"
#include "math/four.h"
#include "math/vec.h"

enum
{
  N = 400000
};

/* What is asked of X: sines and cosines, and of X as far as it may be e^X and e^-X.  */
typedef struct values
{
  double sine[4], cosine[4], plus[4], minus[4];
} values;

static BT__HOT values
ask (const double *x)
{
  values v;
  bt__four a = bt__four_load (x), s, c, plus, minus;
  bt__four_sincos (a, &s, &c);
  bt__four_exp (bt__four_where ((a <= 700.0) & (a >= -700.0), a), &plus, &minus);
  memcpy (v.sine, &s, sizeof s);
  memcpy (v.cosine, &c, sizeof c);
  memcpy (v.plus, &plus, sizeof plus);
  memcpy (v.minus, &minus, sizeof minus);
  return v;
}

CLONES (values, ask, (const double *x), (x))

/* In [-1, 1), from *SEED, which goes on.  */
static double
draw (uint64_t *seed)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)(*seed >> 11 << 11) / 9223372036854775808.0;
}

/* Numbers of every kind: near 0, near quarter turns, up to the last that is taken, beyond.  */
static double
pick (int i, uint64_t *seed)
{
  static const double odd[] = { 0, -0.0, 5e-324, 1e-300, -1e-9, 1e6, -1e6, 999999.9, 709, -746 };
  double u = draw (seed);
  if (i < (int)(sizeof odd / sizeof *odd))
    return odd[i];
  switch (i % 5)
    {
    case 0:
      return u * 4;
    case 1:
      return floor (u * 6e5) * (BT__PI / 2);
    case 2:
      return u * 1e6;
    case 3:
      return u * 700;
    default:
      return u * pow (10, 300 * draw (seed));
    }
}

static void
assert_within (double value, long double expected, double tolerance, double x, const char *what)
{
  if (!(fabsl (value - expected) <= tolerance))
    fail_msg ("%s of %.17g: %.17g is %.3Lg from the truth", what, x, value,
              fabsl (value - expected));
}

/* Sines and cosines within 1.5e-16, of which 0.55e-16 is the rounding of any number below 1;
   exponentials within 2^-52 of themselves.  */
static void
test_values (void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int i = 0; i < N; i += 4)
    {
      double x[4];
      for (int k = 0; k < 4; k++)
        x[k] = pick (i + k, &seed);
      values v = ask_default (x);
      for (int k = 0; k < 4; k++)
        {
          assert_within (v.sine[k], sinl (x[k]), 1.5e-16, x[k], "sine");
          assert_within (v.cosine[k], cosl (x[k]), 1.5e-16, x[k], "cosine");
          long double e = fabs (x[k]) <= 700 ? expl (x[k]) : 1;
          assert_within (v.plus[k], e, 0x1p-52 * (double)e, x[k], "exponential");
          assert_within (v.minus[k], 1 / e, 0x1p-52 / (double)e, x[k], "inverse exponential");
        }
    }
}

static void
test_ends (void **state)
{
  (void)state;
  double x[4] = { INFINITY, -INFINITY, NAN, 2 };
  values v = ask_default (x);
  for (int k = 0; k < 3; k++)
    assert_true (isnan (v.sine[k]) && isnan (v.cosine[k]));
  assert_within (v.sine[3], sinl (2), 1.5e-16, 2, "sine");
  double zero[4] = { 0, -0.0, 0, 0 };
  v = ask_default (zero);
  assert_true (v.sine[0] == 0 && v.cosine[1] == 1 && v.plus[2] == 1 && v.minus[3] == 1);
}

/* A lane does not know what stands beside it.  */
static void
test_lanes (void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int i = 0; i < 4000; i += 4)
    {
      double x[4];
      for (int k = 0; k < 4; k++)
        x[k] = pick (i + k, &seed);
      values v = ask_default (x);
      for (int k = 0; k < 4; k++)
        {
          double alone[4] = { x[k], x[k], x[k], x[k] };
          values w = ask_default (alone);
          assert_true (v.sine[k] == w.sine[k] && v.cosine[k] == w.cosine[k]);
          assert_true (v.plus[k] == w.plus[k] && v.minus[k] == w.minus[k]);
        }
    }
}

/* To the bit the same on every machine.  */
static void
test_clones (void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int i = 0; i < N; i += 4)
    {
      double x[4];
      for (int k = 0; k < 4; k++)
        x[k] = pick (i + k, &seed);
      values v = ask_default (x);
      for (int c = 1; c < N_CLONES; c++)
        if (clone_runs (c))
          {
            values w = ask_clones[c](x);
            assert_memory_equal (&v, &w, sizeof v);
          }
    }
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (test_values), cmocka_unit_test (test_ends),
          cmocka_unit_test (test_lanes), cmocka_unit_test (test_clones) };
  return cmocka_run_group_tests_name ("four", tests, NULL, NULL);
}
