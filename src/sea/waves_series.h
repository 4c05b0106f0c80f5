/* The motion of the water about a place: power series of the sums of waves_sum.h.

   The flow of the components has a potential.  So the velocity, seen as the complex number along +
   i up over the plane of z + i way, is analytic: of one component of waves_sum.h

     speed (e^(k (z + i way)) E + B e^(-k (z + i way)) E*),  E = e^(i (phase - omega t)).

   So is the acceleration, -up + i along, with omega speed in place of speed and -B in place of B.
   About a centre either is a power series; its coefficients are sums over the components, once for
   all places near the centre.  After ORDER terms |w|^ORDER / ORDER! / (1 - |w| / (ORDER + 1)) of a
   component at most is left, w = k times the distance from the centre, times the component's own
   size at the centre (Taylor's theorem for e^w).

   In a header because waves_line.c and its test compile the sums for more than one machine.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SEA_WAVES_SERIES_H
#define BT_SEA_WAVES_SERIES_H

#include "sea/waves_sum.h"

enum
{
  BT__WAVES_ORDER = 8
};

/* Coefficients: velocity along, up, minus acceleration up, acceleration along, side by side.  */
typedef struct bt__waves_series
{
  bt__four c[BT__WAVES_ORDER];
} bt__waves_series;

/* Where a series is made, and the heights between which it is asked.  */
typedef struct bt__waves_centre
{
  double way, z, t;
  double low, top; /* m */
  double felt;     /* k times the way from the surface, or by the bottom, where none counts */
} bt__waves_centre;

/* What is summed up: exponentials of wave number K, and how much of each in the velocity, RE + i
   IM, and in the acceleration, RE2 + i IM2.  */
typedef struct bt__waves_terms
{
  int n; /* a multiple of FOUR */
  double k[2 * BT_WAVES_MAX], re[2 * BT_WAVES_MAX], im[2 * BT_WAVES_MAX], re2[2 * BT_WAVES_MAX],
      im2[2 * BT_WAVES_MAX];
} bt__waves_terms;

/* Add four terms to TERMS.  */
static BT__HOT void
bt__waves_terms_add (bt__waves_terms *terms, bt__four k, bt__four re, bt__four im, bt__four re2,
                     bt__four im2)
{
  int n = terms->n;
  bt__four_store (terms->k + n, k);
  bt__four_store (terms->re + n, re);
  bt__four_store (terms->im + n, im);
  bt__four_store (terms->re2 + n, re2);
  bt__four_store (terms->im2 + n, im2);
  terms->n += BT__FOUR;
}

/* Find the TERMS of W at the centre AT.  */
static BT__HOT void
bt__waves_terms_find (const bt_waves *w, const bt__waves_centre *at, bt__waves_terms *terms)
{
  double low = 2 * w->depth + at->low;
  terms->n = 0;
  for (int i = 0; i < w->n && w->k[i] * -at->top < at->felt; i += BT__FOUR)
    {
      bt__four s, c, fall, climb, k = bt__four_load (w->k + i),
                                  omega = bt__four_load (w->omega + i);
      bt__four_mask here = k * -at->top < at->felt;
      bt__four bed = bt__four_where (k * low < at->felt, bt__four_load (w->bed + i));
      bt__waves_turn (w, i, at->way, at->t, &s, &c);
      bt__four_exp (bt__four_where (here, k * at->z), &fall, &climb);
      bt__four speed = bt__four_where (here, bt__four_load (w->speed + i));
      bt__four re = speed * fall * c, im = speed * fall * s;
      bt__waves_terms_add (terms, k, re, im, re * omega, im * omega);
      if (!bt__four_which (bed > 0))
        continue;
      re = speed * bed * climb * c;
      im = speed * bed * climb * s;
      bt__waves_terms_add (terms, -k, re, -im, -re * omega, im * omega);
    }
}

/* Write the sums of A K^M / M! over N terms to SUM, M below ORDER.  ORDER is 8: they stay in
 * registers.
 */
static BT__HOT void
bt__waves_sums (int n, const double *k, const double *a, double *sum)
{
  bt__four s0 = bt__four_all (0), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
  for (int i = 0; i < n; i += BT__FOUR)
    {
      bt__four x = bt__four_load (a + i), y = bt__four_load (k + i);
      s0 += x, x *= y;
      s1 += x, x *= y;
      s2 += x, x *= y;
      s3 += x, x *= y;
      s4 += x, x *= y;
      s5 += x, x *= y;
      s6 += x, x *= y;
      s7 += x;
    }
  sum[0] = bt__four_sum (s0);
  sum[1] = bt__four_sum (s1);
  sum[2] = bt__four_sum (s2) * (1 / 2.);
  sum[3] = bt__four_sum (s3) * (1 / 6.);
  sum[4] = bt__four_sum (s4) * (1 / 24.);
  sum[5] = bt__four_sum (s5) * (1 / 120.);
  sum[6] = bt__four_sum (s6) * (1 / 720.);
  sum[7] = bt__four_sum (s7) * (1 / 5040.);
}

/* Make *S of TERMS.  */
static BT__HOT void
bt__waves_series_make (const bt__waves_terms *terms, bt__waves_series *s)
{
  double re[BT__WAVES_ORDER], im[BT__WAVES_ORDER], re2[BT__WAVES_ORDER], im2[BT__WAVES_ORDER];
  bt__waves_sums (terms->n, terms->k, terms->re, re);
  bt__waves_sums (terms->n, terms->k, terms->im, im);
  bt__waves_sums (terms->n, terms->k, terms->re2, re2);
  bt__waves_sums (terms->n, terms->k, terms->im2, im2);
  for (int m = 0; m < BT__WAVES_ORDER; m++)
    s->c[m] = (bt__four){ re[m], im[m], re2[m], im2[m] };
}

/* The value of S at UP + i ALONG from the centre: what is left of the division by the real
   polynomial of which that place is a root (Knuth, The Art of Computer Programming, 4.6.4), so that
   all but the last product are with real numbers.  */
static BT__HOT bt__orbit
bt__waves_series_at (const bt__waves_series *s, double up, double along)
{
  const bt__four turned = { -along, along, -along, along }, *c = s->c;
  bt__four p = bt__four_all (2 * up), q = bt__four_all (up * up + along * along);
  bt__four b7 = c[7], b6 = c[6] + p * b7, b5 = c[5] + p * b6 - q * b7;
  bt__four b4 = c[4] + p * b5 - q * b6, b3 = c[3] + p * b4 - q * b5;
  bt__four b2 = c[2] + p * b3 - q * b4, b1 = c[1] + p * b2 - q * b3;
  bt__four sum = c[0] - q * b2 + (up * b1 + turned * (bt__four){ b1[1], b1[0], b1[3], b1[2] });
  return (bt__orbit){ sum[0], sum[1], sum[3], -sum[2] };
}

/* The series of the height of the surface about WAY at T: cosines and sines by turns, since it is
   asked along the surface alone.  */
static BT__HOT void
bt__waves_height_make (const bt_waves *w, double way, double t, double *c)
{
  double re[BT_WAVES_MAX + BT__FOUR], im[BT_WAVES_MAX + BT__FOUR];
  double even[BT__WAVES_ORDER], odd[BT__WAVES_ORDER];
  for (int i = 0; i < w->n; i += BT__FOUR)
    {
      bt__four sine, cosine, amplitude = bt__four_load (w->amplitude + i);
      bt__waves_turn (w, i, way, t, &sine, &cosine);
      bt__four_store (re + i, amplitude * cosine);
      bt__four_store (im + i, amplitude * sine);
    }
  bt__waves_sums (w->n, w->k, re, even);
  bt__waves_sums (w->n, w->k, im, odd);
  for (int m = 0; m < BT__WAVES_ORDER; m++)
    c[m] = (m + 1) & 2 ? -(m & 1 ? odd : even)[m] : (m & 1 ? odd : even)[m];
}

/* The height by the series C at ALONG from its centre.  */
static BT__HOT double
bt__waves_height_at (const double *c, double along)
{
  double sum = c[BT__WAVES_ORDER - 1];
  for (int m = BT__WAVES_ORDER - 2; m >= 0; m--)
    sum = c[m] + along * sum;
  return sum;
}

#endif
