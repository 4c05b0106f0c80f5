/* A smooth curve between two nodes, never longer than the line between them.

   Between nodes a line is interpolated by a cubic.  At sharp bends, or between uneven or slack
   nodes, a cubic swings out and is longer than the line: then only a share of the cubic's deviation
   from the chord is taken.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_SMOOTH_H
#define BT_TETHER_SMOOTH_H

#include "math/vec.h"

/* Greatest strain of a cubic relative to the line, anywhere in an interval.  A cubic through nodes
   of a smooth line is longer than the chord by a 24th of the square of its turning angle.  */
#define BT__SMOOTH_SPARE 0.01

enum
{
  BT__SMOOTH_LOOKS = 12
};

/* The largest share of OFF for which CHORD + share OFF is no longer than REACH; CHORD is shorter
   than REACH.  */
static inline double
bt__share_within (bt_vec3 chord, bt_vec3 off, double reach)
{
  double q = bt__dot (off, off), b = bt__dot (chord, off),
         left = reach * reach - bt__dot (chord, chord);
  return q + 2 * b > left ? (sqrt (b * b + q * left) - b) / q : 1;
}

/* The share of the deviation from CHORD to be taken of a cubic between nodes with REST metres of
   line.  A and B are the end derivatives of the cubic with respect to the share F of the interval,
   less CHORD; at F the deviation of the derivative is A (1 - 4 F + 3 F F) + B (3 F F - 2 F).  The
   derivative is sampled BT__SMOOTH_LOOKS times; between samples the speed exceeds the samples by at
   most an eighth of the squared spacing times 6 |a + b|: 1 % for a cubic with end speeds of twice
   the chord.  The weights of A and B are at most 1 together, so that a cubic that bends little is
   known to be short enough without a sample.  */
static inline double
bt__smooth_share (bt_vec3 chord, bt_vec3 a, bt_vec3 b, double rest)
{
  double reach = (1 + BT__SMOOTH_SPARE) * fmax (bt__norm (chord), rest), share = 1,
         most = fmax (bt__dot (a, a), bt__dot (b, b))
                + 2 * fmax (fabs (bt__dot (chord, a)), fabs (bt__dot (chord, b)));
  if (most <= reach * reach - bt__dot (chord, chord))
    return 1;
  for (int k = 0; k <= BT__SMOOTH_LOOKS; k++)
    {
      double f = (double)k / BT__SMOOTH_LOOKS;
      bt_vec3 off = bt__axpy (bt__scale (1 - 4 * f + 3 * f * f, a), 3 * f * f - 2 * f, b);
      share = fmin (share, bt__share_within (chord, off, reach));
    }
  return share;
}

#endif
