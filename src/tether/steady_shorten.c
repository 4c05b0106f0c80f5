/* Making an unfinished shape of relaxation a possible shape of the line.

   The work of relaxation is bounded, so relaxation may stop with some links many times as long as
   their intervals.  Long links are drawn in by sweeps from end to end and back: each node is moved
   within reach of its neighbour, and the rest of the shape stays.  As long as the ends are nearer
   than the length of the line, the excess decreases with each sweep.  The excess left in the end,
   in a nearly taut line, is removed by blending with the straight line between the ends: the links
   of a mean of two shapes are no longer than the mean of the links.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/steady.h"

enum
{
  SWEEPS = 40
};

/* The share of the way to the straight line on which no link of the N + 1 nodes R is longer than
   REACH; 0 if none is.  */
static double
share_to_chord (const bt_vec3 *r, int n, double reach)
{
  double straight = bt__distance (r[0], r[n]) / n, share = 0;
  for (int i = 0; i < n; i++)
    {
      double length = bt__distance (r[i], r[i + 1]);
      if (length > reach)
        share = fmax (share, (length - reach) / (length - straight));
    }
  return fmin (share, 1);
}

/* P, or, if P is farther than REACH from BY, the point at distance REACH from BY towards P.  */
static bt_vec3
drawn (bt_vec3 p, bt_vec3 by, double reach)
{
  double length = bt__distance (p, by);
  return length > reach ? bt__axpy (by, reach / length, bt__sub (p, by)) : p;
}

int
bt__steady_shorten (bt_vec3 *r, int n, double reach)
{
  double share = share_to_chord (r, n, reach);
  if (!(share > 0))
    return 0;
  for (int k = 0; k < SWEEPS && share > 0; k++)
    {
      for (int i = 1; i < n; i++)
        r[i] = drawn (r[i], r[i - 1], reach);
      for (int i = n - 1; i > 0; i--)
        r[i] = drawn (r[i], r[i + 1], reach);
      share = share_to_chord (r, n, reach);
    }
  for (int i = 1; share > 0 && i < n; i++)
    r[i] = bt__axpy (bt__scale (1 - share, r[i]), share,
                     bt__axpy (r[0], (double)i / n, bt__sub (r[n], r[0])));
  return 1;
}
