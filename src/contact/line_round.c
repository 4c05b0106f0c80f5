/* How much longer than the line its chords are where the line is laid round something.

   The corners of a polygon about a round member lie outside, and the polygon is longer than the arc
   on which the line really lies: by a tenth where a corner turns by a radian.  The line is measured
   along the arc: each chord is longer than its line by what its two ends have too much
   (bt__turn_round), and the solver leaves that out of the stretch.

   What a corner has too much follows the corner at once as the corner moves.  Where corners come or
   go, however, the length of the line would jump, and the tension with it, by EA times the jump
   over an interval.  So a chord keeps what the chord had, and comes slowly to what the chord should
   have.  A line in tension that has lost its corners still lies about the member: there only slack
   is taken.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define RATE 0.05 /* m/s: how fast a chord becomes longer than its line, or slack is taken; ... */
#define TIGHTENS 0.02 /* m/s: ... and how fast a taut one becomes less */
#define MOST 0.3      /* of an interval: no chord is longer than its line by more */

/* True if interval J touches nothing that stands or moves.  */
static int
lies_on_nothing (const bt__line_job *k, uint32_t j)
{
  const bt__near *near = bt__line_near (k, j);
  for (uint32_t i = 0; i < k->w->watch[j].found; i++)
    if (near[i].w.distance < k->config->radius + k->margin)
      return 0;
  return 1;
}

/* By how much the chord of interval J, longer than its line by WAS, is longer in this step, if that
   should be SHOULD.  */
static double
next_round (const bt__line_job *k, uint32_t j, double was, double should)
{
  double e = bt__dynamic_stretch (k->d)[j], slack = (1 - e) * bt__dynamic_rest (k->d)[j];
  int tightens = should > 0 || lies_on_nothing (k, j);
  double less = fmin (fmax (slack, tightens ? TIGHTENS * k->h : 0), RATE * k->h);
  return fmin (fmax (should, was - less), was + RATE * k->h);
}

/* What sliding nodes at the ends of interval J tell: by how much longer than the line its chord
   should be, and to *GAIN what that gains in the step; Q is the first of them from there on.  */
static double
wanted_round (const bt__line_job *k, int j, int q, double *gain)
{
  double should = 0;
  *gain = 0;
  for (int i = q; i < k->bents && k->w->bent[i].node <= j + 1; i++)
    {
      should += k->w->bend[i].round;
      *gain += k->w->rounder[i];
    }
  return should;
}

void
bt__line_round (bt__line_job *k)
{
  if (!k->d->rounded && k->bents == 0)
    return;
  int q = 0;
  for (int j = 0; j < k->links; j++)
    {
      while (q < k->bents && k->w->bent[q].node < j)
        q++;
      double gain, should = wanted_round (k, j, q, &gain);
      double was = bt__dynamic_chord (k->d)[j].z + gain;
      double most = MOST * bt__dynamic_rest (k->d)[j];
      if (was != 0 || should != 0)
        bt__dynamic_round (k->kernel, j,
                           fmin (fmax (next_round (k, (uint32_t)j, was, should), -most), most));
    }
}
