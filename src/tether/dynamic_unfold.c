/* The moving line: a crumpled line unfolds.

   A line with bending stiffness keeps its length, but may be given shorter than its length: laid on
   nodes along a curve, of which the chords are shorter, or slack until it was given its stiffness.
   Set free at once such a line would burst.  So where a line begins anew, and where an interval has
   no tension at all, an interval that is shorter than its tension tells is crumpled by the
   difference: its length of no tension is so much less, and grows to the rest length in time.

   What is left of a crumple is kept in the state in place of the fourth-order part of a chord; a
   line of the fourth order unfolds at once.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

#define ROUNDING 1e-9    /* of the rest length: less is no crumple */
#define UNFOLD_TIME 0.5  /* s in which a crumple falls to a third, ... */
#define GENTLE_SPEED 0.1 /* m/s: ... but a large one no faster than so, ... */
#define GENTLE_TIME 20.0 /* s: ... or than in such a time: it pushes line and water aside */

/* What is left of CRUMPLE after H seconds, m.  */
static double
left_of_crumple (double crumple, double h)
{
  double gentle = fmax (GENTLE_SPEED * h, crumple * (h / GENTLE_TIME));
  return fmax (fmax (0, 1 - h / UNFOLD_TIME) * crumple, crumple - gentle);
}

void
bt__dynamic_unfold (bt__dynamic_work *w, const bt__dynamic *d)
{
  if (w->in->order == 4 || !(w->in->line->ei > 0))
    return;
  for (int j = 0; j < w->n; j++)
    {
      bt__link *k = w->link + j;
      double shorter = k->rest * (1 + w->lam[j] / w->ea) - k->start;
      double crumple = bt__dynamic_chord (d)[j].x;
      if (d->history == 0 || w->lam[j] == 0)
        crumple = fmax (crumple, shorter);
      w->crumple[j] = crumple > ROUNDING * k->rest ? left_of_crumple (crumple, w->in->h) : 0;
      k->zero -= w->crumple[j] * w->ea / (k->ka * k->rest);
    }
}
