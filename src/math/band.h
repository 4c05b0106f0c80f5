/* Linear equations whose matrix is a band, not symmetric, by Gauss with exchanges of rows.

   The band is kept by columns, HEIGHT numbers each: twice BELOW diagonals above the main diagonal,
   room for what exchanges of rows fill; the main diagonal; BELOW diagonals under the main diagonal.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MATH_BAND_H
#define BT_MATH_BAND_H

#include <stddef.h>

enum
{
  BT__BAND_BELOW = 8, /* two nodes of three coordinates, less the main diagonal */
  BT__BAND_ABOVE = 2 * BT__BAND_BELOW,
  BT__BAND_HEIGHT = BT__BAND_BELOW + BT__BAND_ABOVE + 1
};

/* The element at row I and column J of the band B.  */
static inline double *
bt__band_at (double *b, int i, int j)
{
  return b + (size_t)j * BT__BAND_HEIGHT + (BT__BAND_ABOVE + i - j);
}

/* Factorise the band B of N rows in place; EXCHANGED has N numbers and gets the row that was
   brought to each.  A matrix that is singular leaves factors that are not finite.  */
void bt__band_factorize (double *b, int n, int *exchanged);

/* Solve with these factors for the right-hand side X, in place.  */
void bt__band_solve (const double *b, int n, const int *exchanged, double *x);

#endif
