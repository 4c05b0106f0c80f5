/* Six equations.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_SOLVE_H
#define BT_VEHICLE_SOLVE_H

/* Solve A X = B by elimination without pivoting, which is right when the symmetric part of A is
   positive definite; A and B are used up.  Return zero when a pivot is next to nothing.  */
static inline int
bt__solve6 (double (*a)[6], double *b, double *x)
{
  double scale[6];
  for (int i = 0; i < 6; i++)
    scale[i] = a[i][i];
  for (int i = 0; i < 6; i++)
    {
      if (!(a[i][i] > 1e-10 * scale[i]))
        return 0;
      for (int j = i + 1; j < 6; j++)
        {
          double k = a[j][i] / a[i][i];
          for (int c = i + 1; c < 6; c++)
            a[j][c] -= k * a[i][c];
          b[j] -= k * b[i];
        }
    }
  for (int i = 5; i >= 0; i--)
    {
      x[i] = b[i];
      for (int c = i + 1; c < 6; c++)
        x[i] -= a[i][c] * x[c];
      x[i] /= a[i][i];
    }
  return 1;
}

#endif
