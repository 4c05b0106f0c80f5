/* Linear equations whose matrix is a band: G. H. Golub and C. F. Van Loan, Matrix Computations, 4th
   edition, section 4.3.

   Away from the last columns the innermost loop of the factors has as many turns as there are
   diagonals under the main one, of which compilers make vectors.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/band.h"
#include "math/wide.h"

static inline int
last_of (int n, int j, int more)
{
  return j + more < n ? j + more : n - 1;
}

/* Bring the largest element of column J from the main diagonal down on to it; return its row.  */
static int
exchange_rows (double *b, int n, int j)
{
  const double *column = bt__band_at (b, j, j);
  int p = j, below = last_of (n, j, BT__BAND_BELOW) - j;
  double most = fabs (column[0]);
  for (int i = 1; i <= below; i++)
    if (fabs (column[i]) > most)
      {
        p = j + i;
        most = fabs (column[i]);
      }
  for (int c = j; p != j && c <= last_of (n, j, BT__BAND_ABOVE); c++)
    {
      double t = *bt__band_at (b, j, c);
      *bt__band_at (b, j, c) = *bt__band_at (b, p, c);
      *bt__band_at (b, p, c) = t;
    }
  return p;
}

/* TO less UNDER times FACTOR, N numbers.  */
static BT__HOT void
take_times (double *restrict to, const double *restrict under, double factor, int n)
{
  for (int i = 0; i < n; i++)
    to[i] -= under[i] * factor;
}

BT__WIDE void
bt__band_factorize (double *b, int n, int *exchanged)
{
  for (int j = 0; j < n; j++)
    {
      exchanged[j] = exchange_rows (b, n, j);
      double *under = bt__band_at (b, j, j), inverse = 1 / *under;
      int below = last_of (n, j, BT__BAND_BELOW) - j;
      for (int i = 1; i <= below; i++)
        under[i] *= inverse;
      for (int c = j + 1; c <= last_of (n, j, BT__BAND_ABOVE); c++)
        {
          double *to = bt__band_at (b, j, c);
          if (*to != 0 && below == BT__BAND_BELOW)
            take_times (to + 1, under + 1, *to, BT__BAND_BELOW);
          else if (*to != 0)
            take_times (to + 1, under + 1, *to, below);
        }
    }
}

void
bt__band_solve (const double *b, int n, const int *exchanged, double *x)
{
  for (int j = 0; j < n; j++)
    {
      const double *under = b + (size_t)j * BT__BAND_HEIGHT + BT__BAND_ABOVE;
      double t = x[exchanged[j]];
      x[exchanged[j]] = x[j];
      x[j] = t;
      for (int i = j + 1; i <= last_of (n, j, BT__BAND_BELOW); i++)
        x[i] -= under[i - j] * t;
    }
  for (int j = n - 1; j >= 0; j--)
    {
      const double *column = b + (size_t)j * BT__BAND_HEIGHT + BT__BAND_ABOVE;
      x[j] /= column[0];
      for (int i = j - 1; i >= 0 && i >= j - BT__BAND_ABOVE; i--)
        x[i] -= column[i - j] * x[j];
    }
}
