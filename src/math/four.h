/* Four numbers side by side, their sines, cosines and exponentials: vectors of GNU C, on any
   machine, with no table and no branch but one.  Each lane comes out as it would alone, whatever
   the registers are.

   Sine and cosine: pi/2 is taken off in two parts, of which the first times any whole number below
   2^20 is exact (W. J. Cody and W. Waite, Software Manual for the Elementary Functions, 1980), then
   the polynomials of fdlibm, good to 2^-58 up to pi/4.  Exponentials: ln 2 likewise, then the even
   and the odd half of Taylor's series to the 13th power, good to 2^-57 up to ln (2) / 2; the sum of
   the halves is e^x, their difference e^-x.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MATH_FOUR_H
#define BT_MATH_FOUR_H

#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined __SSE2__
#include <emmintrin.h>
#endif

#include "math/wide.h"

enum
{
  BT__FOUR = 4
};

typedef double bt__four __attribute__ ((vector_size (32)));
typedef uint64_t bt__four_bits __attribute__ ((vector_size (32)));
typedef int64_t bt__four_mask __attribute__ ((vector_size (32))); /* -1 yes, 0 no */

#define BT__FOUR_TURN 1e6 /* rad: beyond, sines are libm's */

static BT__HOT bt__four
bt__four_load (const double *a)
{
  bt__four v;
  memcpy (&v, a, sizeof v);
  return v;
}

static BT__HOT void
bt__four_store (double *a, bt__four v)
{
  memcpy (a, &v, sizeof v);
}

static BT__HOT bt__four
bt__four_all (double a)
{
  return (bt__four){ a, a, a, a };
}

/* A where M says so, else 0.  */
static BT__HOT bt__four
bt__four_where (bt__four_mask m, bt__four a)
{
  return (bt__four)((bt__four_mask)a & m);
}

/* Bit K is set where lane K of M says so.  */
static BT__HOT int
bt__four_which (bt__four_mask m)
{
#if defined __SSE2__
  __m128i low = { m[0], m[1] }, high = { m[2], m[3] };
  return _mm_movemask_pd ((__m128d)low) | _mm_movemask_pd ((__m128d)high) << 2;
#else
  return (m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8);
#endif
}

/* A where M says so, else B.  */
static BT__HOT bt__four
bt__four_either (bt__four_mask m, bt__four a, bt__four b)
{
  return (bt__four)(((bt__four_mask)a & m) | ((bt__four_mask)b & ~m));
}

static BT__HOT bt__four
bt__four_min (bt__four a, bt__four b)
{
  return bt__four_either (a < b, a, b);
}

static BT__HOT bt__four
bt__four_max (bt__four a, bt__four b)
{
  return bt__four_either (a > b, a, b);
}

static BT__HOT bt__four
bt__four_sqrt (bt__four a)
{
#if defined __SSE2__
  __m128d low = _mm_sqrt_pd ((__m128d){ a[0], a[1] }), high = _mm_sqrt_pd ((__m128d){ a[2], a[3] });
  return (bt__four){ low[0], low[1], high[0], high[1] };
#else
  return (bt__four){ sqrt (a[0]), sqrt (a[1]), sqrt (a[2]), sqrt (a[3]) };
#endif
}

static BT__HOT double
bt__four_sum (bt__four a)
{
  return (a[0] + a[2]) + (a[1] + a[3]);
}

/* The whole number nearest to A, below 2^51: as a number, and in the low bits of *BITS.  */
static BT__HOT bt__four
bt__four_round (bt__four a, bt__four_bits *bits)
{
  bt__four shifted = a + 0x1.8p52;
  *bits = (bt__four_bits)shifted;
  return shifted - 0x1.8p52;
}

/* The sines and cosines of Y up to a little more than pi/4.  */
static BT__HOT bt__four
bt__four_sin_near (bt__four y)
{
  bt__four z = y * y, z2 = z * z;
  bt__four low = -1.66666666666666324348e-01 + z * 8.33333333332248946124e-03;
  bt__four middle = -1.98412698298579493134e-04 + z * 2.75573137070700676789e-06;
  bt__four high = -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10;
  return y + y * z * (low + z2 * (middle + z2 * high));
}

static BT__HOT bt__four
bt__four_cos_near (bt__four y)
{
  bt__four z = y * y, z2 = z * z;
  bt__four low = 4.16666666666666019037e-02 + z * -1.38888888888741095749e-03;
  bt__four middle = 2.48015872894767294178e-05 + z * -2.75573143513906633035e-07;
  bt__four high = 2.08757232129817482790e-09 + z * -1.13596475577881948265e-11;
  return 1.0 - (0.5 * z - z2 * (low + z2 * (middle + z2 * high)));
}

/* The sines and cosines of X to 1.5e-16; NaN where X is not finite.  */
static BT__HOT void
bt__four_sincos (bt__four x, bt__four *sine, bt__four *cosine)
{
  bt__four_bits quarter;
  bt__four n = bt__four_round (x * 0x1.45f306dc9c883p-1, &quarter);  /* 2 / pi */
  bt__four y = (x - n * 0x1.921fb544p0) - n * 0x1.0b4611a626331p-34; /* pi / 2 */
  bt__four_bits s = (bt__four_bits)bt__four_sin_near (y), c = (bt__four_bits)bt__four_cos_near (y);
  bt__four_bits swap = (s ^ c) & -(quarter & 1);
  *sine = (bt__four)(s ^ swap ^ ((quarter & 2) << 62));
  *cosine = (bt__four)(c ^ swap ^ (((quarter + 1) & 2) << 62));
  int far = bt__four_which (~((x < BT__FOUR_TURN) & (x > -BT__FOUR_TURN)));
  for (int i = 0; far != 0 && i < BT__FOUR; i++)
    if (far >> i & 1)
      {
        (*sine)[i] = sin (x[i]);
        (*cosine)[i] = cos (x[i]);
      }
}

/* e^X and e^-X of X from -700 to 700, to 2^-52 of themselves.  */
static BT__HOT void
bt__four_exp (bt__four x, bt__four *plus, bt__four *minus)
{
  bt__four_bits power;
  bt__four n = bt__four_round (x * 0x1.71547652b82fep0, &power); /* 1 / ln 2 */
  bt__four r = (x - n * 0x1.62e42feep-1) - n * 0x1.a39ef35793c76p-33;
  bt__four z = r * r, z2 = z * z, z4 = z2 * z2;
  bt__four even = (1 / 2. + z * (1 / 24.)) + z2 * (1 / 720. + z * (1 / 40320.))
                  + z4 * (1 / 3628800. + z * (1 / 479001600.));
  bt__four odd = (1 / 6. + z * (1 / 120.)) + z2 * (1 / 5040. + z * (1 / 362880.))
                 + z4 * (1 / 39916800. + z * (1 / 6227020800.));
  even *= z;
  odd *= r * z;
  power <<= 52;
  *plus = (bt__four)((bt__four_bits)(1 + (r + (even + odd))) + power);
  *minus = (bt__four)((bt__four_bits)(1 - (r - (even - odd))) - power);
}

#endif
