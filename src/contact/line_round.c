/* The surplus of chords: by how much a chord is longer than the line about a round member.

   The corners of a polygon about a round member lie outside, and the polygon is longer than the arc
   on which the line really lies: by a tenth where a corner turns by a radian.  The line is measured
   along the arc: the solver leaves the surplus of every chord (bt__turn_round) out of the stretch.

   The surplus follows a corner at once as the corner moves.  Where corners come or go, however, the
   length of the line would jump, and the tension with it, by EA times the jump over an interval.
   Therefore a chord keeps the surplus; chords of a wrap with too much of a surplus hand over to
   chords with too little; and the rest of the error decays slowly.  A taut line without corners
   still lies about the member: only slack is taken from the surplus.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define RATE 0.05 /* m/s: how fast a surplus grows, or shrinks where the line is slack */
/* Times the tension of the neighbours: the most that a tightened interval bears.  */
#define MORE 1.02
#define MOST 0.3 /* of an interval: the largest surplus */

/* True if interval J touches no obstacle.  */
static int
lies_on_nothing (const bt__line_job *k, uint32_t j)
{
  const bt__near *near = bt__line_near (k, j);
  for (uint32_t i = 0; i < k->w->watch[j].found; i++)
    if (near[i].w.distance < k->config->radius + k->margin)
      return 0;
  return 1;
}

/* By how much the surplus of the taut interval J may shrink in this step, m: the tension rises, but
   not above the tension of the neighbours.  */
static double
may_tighten (const bt__line_job *k, int j)
{
  const double *t = bt__dynamic_tension (k->d) + j;
  double beside = fmax (j > 0 ? t[-1] : 0, j + 1 < k->links ? t[1] : 0);
  double more = fmax (MORE * beside - t[0], 0) + BT__LINE_SLIGHT;
  return fmin (more * bt__dynamic_rest (k->d)[j] / k->in->line->ea, BT__LINE_CREEP * k->h);
}

/* The surplus of interval J in this step, after WAS in the last; wanted is SHOULD.  */
static double
next_round (const bt__line_job *k, int j, double was, double should)
{
  double e = bt__dynamic_stretch (k->d)[j], slack = (1 - e) * bt__dynamic_rest (k->d)[j];
  int tightens = should > 0 || lies_on_nothing (k, (uint32_t)j);
  double less = fmin (fmax (slack, tightens ? may_tighten (k, j) : 0), RATE * k->h);
  return fmin (fmax (should, was - less), was + RATE * k->h);
}

/* The surplus of interval J wanted by the sliding nodes at its ends, of which Q is the first; *GAIN
   receives the gain of the wanted surplus in the step.  */
static double
wanted_round (const bt__line_job *k, int j, int q, double *gain)
{
  double should = 0;
  *gain = 0;
  for (int i = q; i < k->bents && k->w->bent[i].node <= j + 1; i++)
    {
      int after = k->w->bent[i].node == j;
      should += after ? k->w->bend[i].beyond : k->w->bend[i].before;
      *gain += k->w->gain[i][after];
    }
  return should;
}

/* Tell the solver the surplus of interval J; Q is the first sliding node that is not before J.  */
static void
tell_round (bt__line_job *k, int j, int q)
{
  double gain, should = wanted_round (k, j, q, &gain);
  double was = bt__dynamic_chord (k->d)[j].z + gain;
  double most = MOST * bt__dynamic_rest (k->d)[j];
  if (was != 0 || should != 0)
    bt__dynamic_round (k->kernel, j, fmin (fmax (next_round (k, j, was, should), -most), most));
}

void
bt__line_round (bt__line_job *k)
{
  const bt_vec3 *chord = bt__dynamic_chord (k->d);
  if (!k->d->rounded && k->bents == 0)
    return;
  int q = 0;
  for (int j = 0; j < k->links; j++)
    {
      while (q < k->bents && k->w->bent[q].node < j)
        q++;
      if (chord[j].z != 0 || (q < k->bents && k->w->bent[q].node <= j + 1))
        tell_round (k, j, q);
    }
}

/* ---- Corners that came elsewhere ---- */

/* Sums over intervals: surplus above and below the wanted surplus, m.  */
typedef struct excess
{
  double much, little;
} excess;

/* The chords of the line and the sliding nodes between them, followed from interval to interval. */
typedef struct chords
{
  const bt_vec3 *chord;
  const bt__sliding *s;
  int64_t n;
  int q; /* the first sliding node that is not before the interval */
} chords;

/* The surplus of interval J beyond the wanted surplus, m, to *OVER; zero if interval J has
   none and wants none.  Of one call and the next of the same C, J does not fall.  */
static int
find_excess (chords *c, int64_t j, double *over)
{
  const bt__sliding *s = c->s;
  double should = 0;
  while (c->q < s->n && s->node[c->q] < j)
    c->q++;
  for (int q = c->q; q < s->n && s->node[q] <= j + 1; q++)
    should += s->node[q] == j ? s->anchor[q].beyond : s->anchor[q].before;
  *over = c->chord[j].z - should;
  return c->chord[j].z != 0 || should != 0;
}

/* Take LESS metres off the surplus of interval J: the line of the interval becomes longer.  The
   tension stays, for which the change of line is LESS over the stretch; a slack interval, which has
   none, stays slack by LESS itself, so that the line of all stays the same but for strains.  */
static void
hand_over (bt__line_job *k, int64_t j, double less)
{
  bt__dynamic_chord (k->d)[j].z -= less;
  bt__dynamic_rest (k->d)[j] += less / fmax (bt__dynamic_stretch (k->d)[j], 1);
  k->d->rounded = 1;
}

/* How much of the sum that an interval with the excess OVER counts to.  */
static double
counted (const excess *sum, double over)
{
  return over > 0 ? sum->much : sum->little;
}

/* The surplus that chords with too much in the run from FROM, where C is, to before TO hand over to
   those with too little, of the sums SUM, m: so much that each has its part, and no
   interval becomes longer or shorter by more than a share.  */
static double
handed_over (const bt__line_job *k, chords c, int64_t from, int64_t to, const excess *sum)
{
  double moved = fmin (sum->much, sum->little), over;
  for (int64_t j = from; moved > 0 && j < to; j++)
    if (find_excess (&c, j, &over) && over != 0)
      moved = fmin (moved, MOST * bt__dynamic_rest (k->d)[j] * counted (sum, over) / fabs (over));
  return moved;
}

/* Even out the surplus of the intervals from FROM, where C is, to before TO, with the sums SUM.  */
static void
even_out_run (bt__line_job *k, chords c, int64_t from, int64_t to, const excess *sum)
{
  double moved = handed_over (k, c, from, to, sum), over;
  for (int64_t j = from; moved > 0 && j < to; j++)
    if (find_excess (&c, j, &over) && over != 0)
      hand_over (k, j, moved * over / counted (sum, over));
}

void
bt__sliding_even_rounds (bt__line_job *k, const bt__sliding *s)
{
  chords c = { bt__dynamic_chord (k->d), s, k->d->rounded || s->n > 0 ? k->d->n : 0, 0 };
  for (int64_t j = 0; j < c.n; j++)
    {
      chords run = c;
      int64_t from = j;
      excess sum = { 0, 0 };
      for (double over; j < c.n && find_excess (&c, j, &over); j++)
        {
          sum.much += fmax (over, 0);
          sum.little += fmax (-over, 0);
        }
      if (j > from)
        even_out_run (k, run, from, j, &sum);
    }
}
