/* A smooth curve between two nodes of a line that is no longer than the line.

   Between nodes a line is read off a cubic.  Where the line turns sharply, or its nodes lie
   unevenly or slack, a cubic swings out beside them and is longer than the line that is there: what
   it is off the chord is then taken by a share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_SMOOTH_H
#define BT_TETHER_SMOOTH_H

#include "math/vec.h"

/* Of an interval: how much longer a cubic may be read anywhere than the line is.  One through the
   nodes of a smooth line is longer than their chords by a 24th of the square of what it turns.  */
#define BT__SMOOTH_SPARE 0.01

enum
{
  BT__SMOOTH_LOOKS = 12
};

/* The share of OFF that leaves CHORD + OFF no longer than REACH, which CHORD is not.  */
static inline double
bt__share_within (bt_vec3 chord, bt_vec3 off, double reach)
{
  double q = bt__dot (off, off), b = bt__dot (chord, off),
         left = reach * reach - bt__dot (chord, chord);
  return q + 2 * b > left ? (sqrt (b * b + q * left) - b) / q : 1;
}

/* The share of itself to which a cubic over CHORD, between nodes with REST metres of line, is taken
   toward the chord.  A and B: what its derivatives at either end, by the share F of the interval,
   have beyond the chord; at F that is A (1 - 4 F + 3 F F) + B (3 F F - 2 F).  It is looked at
   BT__SMOOTH_LOOKS times from one end to the other: in between it is faster by at most an eighth of
   the squared distance times 6 |A + B|, 1 % of a cubic that is twice as fast at its ends as its
   chord.  */
static inline double
bt__smooth_share (bt_vec3 chord, bt_vec3 a, bt_vec3 b, double rest)
{
  double reach = (1 + BT__SMOOTH_SPARE) * fmax (bt__norm (chord), rest), share = 1;
  for (int k = 0; k <= BT__SMOOTH_LOOKS; k++)
    {
      double f = (double)k / BT__SMOOTH_LOOKS;
      bt_vec3 off = bt__axpy (bt__scale (1 - 4 * f + 3 * f * f, a), 3 * f * f - 2 * f, b);
      share = fmin (share, bt__share_within (chord, off, reach));
    }
  return share;
}

#endif
