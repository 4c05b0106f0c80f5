/* The wear of a tether's jacket; see wear.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/wear.h"

#include <math.h>

#define SPOT 0.1 /* m: what a contact wears at a time, hardly more than a jacket's corner */

enum
{
  SPOTS_MAX = 1024
};

int
bt__wear_spots (double length)
{
  return (int)fmin (fmax (ceil (2 * length / SPOT), 1), SPOTS_MAX);
}

double
bt__wear_width (double length)
{
  return 2 * length / bt__wear_spots (length);
}

/* The spot at FROM_END; what lies beyond an end belongs to the last.  */
static int
spot_of (const bt__wear *w, double from_end)
{
  return (int)fmin (fmax (floor (from_end / w->width), 0), w->n - 1);
}

double
bt__wear_add (const bt__wear *w, double from_end, double span, double work)
{
  double whole = w->n * w->width, wide = fmin (fmax (span, w->width), whole), most = 0;
  double from = fmin (fmax (from_end - wide / 2, 0), whole - wide), to = from + wide;
  for (int i = spot_of (w, from), last = spot_of (w, to); i <= last; i++)
    {
      double share = fmin (to, (i + 1) * w->width) - fmax (from, i * w->width);
      w->spot[i] += fmax (share, 0) / wide * work / w->width;
      most = fmax (most, w->spot[i]);
    }
  return most;
}

double
bt__wear_at (const bt__wear *w, double from_end)
{
  return w->spot[spot_of (w, from_end)];
}
