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

/* What is summed up: exponentials of wave number RATE, and how much of each.  */
typedef struct bt__waves_terms
{
  int n;
  double rate[2 * BT_WAVES_MAX];
  bt__four amount[2 * BT_WAVES_MAX];
} bt__waves_terms;

/* Add four terms to TERMS: of wave numbers K, velocities RE + i IM, accelerations RE2 + i IM2.  */
static BT__HOT void
bt__waves_terms_add (bt__waves_terms *terms, bt__four k, bt__four re, bt__four im, bt__four re2,
                     bt__four im2)
{
  for (int j = 0; j < BT__FOUR; j++)
    {
      terms->rate[terms->n] = k[j];
      terms->amount[terms->n++] = (bt__four){ re[j], im[j], re2[j], im2[j] };
    }
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

/* Make *S of TERMS.  ORDER is 8: the sums stay in registers.  */
static BT__HOT void
bt__waves_series_make (const bt__waves_terms *terms, bt__waves_series *s)
{
  bt__four c0 = bt__four_all (0), c1 = c0, c2 = c0, c3 = c0, c4 = c0, c5 = c0, c6 = c0, c7 = c0;
  for (int i = 0; i < terms->n; i++)
    {
      bt__four a = terms->amount[i];
      double k = terms->rate[i];
      c0 += a, a *= k;
      c1 += a, a *= k;
      c2 += a, a *= k;
      c3 += a, a *= k;
      c4 += a, a *= k;
      c5 += a, a *= k;
      c6 += a, a *= k;
      c7 += a;
    }
  *s = (bt__waves_series){ { c0, c1, c2 * (1 / 2.), c3 * (1 / 6.), c4 * (1 / 24.), c5 * (1 / 120.),
                             c6 * (1 / 720.), c7 * (1 / 5040.) } };
}

/* The value of S at UP + i ALONG from the centre.  */
static BT__HOT bt__orbit
bt__waves_series_at (const bt__waves_series *s, double up, double along)
{
  const bt__four turned = { -along, along, -along, along };
  bt__four sum = s->c[BT__WAVES_ORDER - 1];
  for (int n = BT__WAVES_ORDER - 2; n >= 0; n--)
    sum = s->c[n] + (up * sum + turned * (bt__four){ sum[1], sum[0], sum[3], sum[2] });
  return (bt__orbit){ sum[0], sum[1], sum[3], -sum[2] };
}

#endif
