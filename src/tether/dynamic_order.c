/* The moving line: fourth order in space by deferred correction.

   The arc differs from the chord, and the load of a cell from its middle value, by a 24th of second
   differences.  They follow the shape with a delay, held while a step is solved: taken at once they
   blow up.  Next to slack or uneven intervals, and with lumps and contacts, the corrections fade
   away.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

#define DELAY 0.25 /* s */
#define EVEN 1e-6  /* of a rest length: intervals no more different are even */
#define MOST 0.02  /* of a rest length: a larger correction is none */

/* True if intervals FROM to TO are taut and even.  */
static int
is_regular (const bt__dynamic_work *w, int from, int to)
{
  if (from < 0 || to >= w->n || w->lumped || bt__dynamic_touches (w))
    return 0;
  for (int j = from; j <= to; j++)
    if (!(w->lam[j] > 0) || fabs (w->link[j].rest - w->link[from].rest) > EVEN * w->link[j].rest)
      return 0;
  return 1;
}

static bt_vec3
second_difference (const bt__dynamic_work *w, int j)
{
  const bt_vec3 *X = w->X;
  return bt__axpy (bt__sub (X[j + 2], X[j - 1]), -3, bt__sub (X[j + 1], X[j]));
}

/* The correction interval J should have.  */
static bt_vec3
chord_defect (const bt__dynamic_work *w, int j)
{
  int n = w->n, k = j < 1 ? 1 : j > n - 2 ? n - 2 : j, next = j < 1 ? 2 : n - 3;
  bt_vec3 zero = { 0, 0, 0 };
  if (n < 6 || !is_regular (w, k - 1, k + 1))
    return zero;
  bt_vec3 c = bt__scale (-1.0 / 24, second_difference (w, k));
  if (k != j)
    {
      if (!is_regular (w, next - 1, next + 1))
        return zero;
      c = bt__axpy (bt__scale (2, c), 1.0 / 24, second_difference (w, next));
    }
  return bt__dot (c, c) <= MOST * MOST * w->link[j].rest * w->link[j].rest ? c : zero;
}

/* The load of a whole cell at node I.  */
static bt_vec3
cell_load (bt__dynamic_work *w, int i)
{
  return bt__scale (i > 0 && i < w->n ? 1 : 2, bt__dynamic_node_load (w, i));
}

void
bt__dynamic_correct (bt__dynamic *d, bt__dynamic_work *w)
{
  double share = fmin (1, w->in->h / DELAY);
  bt_vec3 *chord = bt__dynamic_chord (d), *load = bt__dynamic_load (d);
  for (int j = 0; j < w->n; j++)
    chord[j] = bt__axpy (chord[j], share, bt__sub (chord_defect (w, j), chord[j]));
  for (int i = 0; i <= w->n; i++)
    w->rhs[i] = cell_load (w, i);
  for (int i = 1; i < w->n; i++)
    {
      bt_vec3 q = { 0, 0, 0 };
      if (w->n >= 6 && is_regular (w, i - 1, i))
        q = bt__scale (1.0 / 24, bt__axpy (bt__add (w->rhs[i - 1], w->rhs[i + 1]), -2, w->rhs[i]));
      load[i] = bt__axpy (load[i], share, bt__sub (q, load[i]));
    }
}
