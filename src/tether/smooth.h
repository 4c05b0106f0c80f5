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

/* The share of OFF that leaves CHORD + OFF no longer than REACH, which CHORD is not.  */
static inline double
bt__share_within (bt_vec3 chord, bt_vec3 off, double reach)
{
  double q = bt__dot (off, off), b = bt__dot (chord, off),
         left = reach * reach - bt__dot (chord, chord);
  return q + 2 * b > left ? (sqrt (b * b + q * left) - b) / q : 1;
}

/* The share of itself to which a cubic over CHORD, between nodes with REST metres of line, is taken
   toward the chord.  A and B: what its derivatives at either end, by the share of the interval,
   have beyond the chord.  It is fastest at an end, in the middle or a third from an end.  */
static inline double
bt__smooth_share (bt_vec3 chord, bt_vec3 a, bt_vec3 b, double rest)
{
  double reach = (1 + BT__SMOOTH_SPARE) * fmax (bt__norm (chord), rest), share = 1;
  bt_vec3 off[] = { a, b, bt__scale (-1.0 / 3, a), bt__scale (-1.0 / 3, b),
                    bt__scale (-0.25, bt__add (a, b)) };
  for (size_t k = 0; k < sizeof off / sizeof *off; k++)
    share = fmin (share, bt__share_within (chord, off[k], reach));
  return share;
}

#endif
