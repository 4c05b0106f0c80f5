/* Equations of a band, also with zeros on the main diagonal: what is solved for gives the
   right-hand side again.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "math/band.h"

enum
{
  MOST = 90
};

static double
draw (uint64_t *seed)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)*seed / 9223372036854775808.0;
}

/* A matrix of N rows, dense in M and as a band in B; every third diagonal element is zero.  */
static void
fill (int n, uint64_t *seed, double m[MOST][MOST], double *b)
{
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      {
        int near = i - j <= BT__BAND_BELOW && j - i <= BT__BAND_BELOW;
        m[i][j] = near && (i != j || i % 3) ? draw (seed) : 0;
        if (near)
          *bt__band_at (b, i, j) = m[i][j];
      }
}

static double
residual (int n, double m[MOST][MOST], const double *x, const double *wanted)
{
  double most = 0;
  for (int i = 0; i < n; i++)
    {
      double sum = -wanted[i], size = fabs (wanted[i]);
      for (int j = 0; j < n; j++)
        {
          sum += m[i][j] * x[j];
          size += fabs (m[i][j] * x[j]);
        }
      most = fmax (most, fabs (sum) / size);
    }
  return most;
}

static void
any_band (void **state)
{
  (void)state;
  static double m[MOST][MOST], b[MOST * BT__BAND_HEIGHT], x[MOST], wanted[MOST];
  static int exchanged[MOST];
  uint64_t seed = 5;
  double most = 0;
  for (int n = 2; n <= MOST; n++)
    {
      memset (b, 0, sizeof b);
      fill (n, &seed, m, b);
      bt__band_factorize (b, n, exchanged);
      for (int again = 0; again < 2; again++)
        {
          for (int i = 0; i < n; i++)
            wanted[i] = draw (&seed);
          memcpy (x, wanted, sizeof x);
          bt__band_solve (b, n, exchanged, x);
          most = fmax (most, residual (n, m, x, wanted));
        }
    }
  print_message ("# worst residual %.2g\n", most);
  assert_true (most < 1e-12);
}

static void
singular (void **state)
{
  (void)state;
  static double b[3 * BT__BAND_HEIGHT];
  int exchanged[3];
  double x[3] = { 1, 1, 1 };
  *bt__band_at (b, 0, 0) = *bt__band_at (b, 2, 2) = 1;
  bt__band_factorize (b, 3, exchanged);
  bt__band_solve (b, 3, exchanged, x);
  assert_false (isfinite (x[1]));
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (any_band), cmocka_unit_test (singular) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
