/* Six equations.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_SOLVE_H
#define BT_VEHICLE_SOLVE_H

/* Eliminate A without pivoting, right when the symmetric part of A is positive definite.  A
   receives the factors below the diagonal, the reciprocals of the pivots on the diagonal, the
   eliminated rows above the diagonal.  Return zero when a pivot is next to nothing.  */
static inline int
bt__factor6 (double (*a)[6])
{
  double scale[6];
  for (int i = 0; i < 6; i++)
    scale[i] = a[i][i];
  for (int i = 0; i < 6; i++)
    {
      if (!(a[i][i] > 1e-10 * scale[i]))
        return 0;
      a[i][i] = 1 / a[i][i];
      for (int j = i + 1; j < 6; j++)
        {
          double k = a[j][i] *= a[i][i];
          for (int c = i + 1; c < 6; c++)
            a[j][c] -= k * a[i][c];
        }
    }
  return 1;
}

/* Solve for X, the right-hand side before, with the factors A.  Column by column: no row then waits
   for more than the one before.  */
static inline void
bt__substitute6 (double (*a)[6], double *x)
{
  for (int i = 0; i < 6; i++)
    for (int j = i + 1; j < 6; j++)
      x[j] -= a[j][i] * x[i];
  for (int i = 5; i >= 0; i--)
    {
      x[i] *= a[i][i];
      for (int j = 0; j < i; j++)
        x[j] -= a[j][i] * x[i];
    }
}

#endif
