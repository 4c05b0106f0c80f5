/* The moving line: the iterations of a step.

   The quick way is a mixed primal-dual active set: each interval's multiplier, the linearised
   tension, sets the geometric stiffness and decides, together with the stretch, whether the
   interval is taut.  In ordinary motion a single iteration is enough.

   Friction follows the loads within each iteration (dynamic_couple.c: Newton's own).  Where places
   of the line push each other apart that costs ten times as much: friction takes the loads of the
   iterate before, so the blocks are symmetric, and iterations in which friction follows the loads
   are tried where the others do not settle.

   If neither settles, the safe way restarts from the better of predictor and present shape and
   descends on the incremental potential: no step gains energy out of nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

enum
{
  QUICK = 150, /* a front of tension walks along a slack line by some intervals in each */
  TURNING = 2, /* iterations in which the node tangents follow */
  SAFE = 60,
  HALVINGS = 8,
  WALKING = 1,  /* iterations before fronts of tension are sent ahead */
  PRESSED = 3,  /* iterations more, for the loads */
  SWINGING = 2, /* iterations before an update is held back */
  /* With contacts: a step that needs more is better restarted, but for LINKS fronts have so far to
     walk.  */
  QUICK_TOUCHING = 60,
  SAFE_TOUCHING = 40,
  LINKS = 120,
  /* Iterations with friction of the loads before, then also such that friction follows the loads
     within: after every AGAIN, COUPLED of them at most.  */
  LAGGING = 30,
  AGAIN = 4,
  COUPLED = 7,
  FOLLOWING = 4 /* iterations of the safe way until friction follows the loads */
};

#define LOST 1e3          /* of the length: an update that has left every shape */
#define FRONT 5e-4        /* m: what a front of tension may still move in the last iteration */
#define LOST_TOUCHING 1e3 /* m: the same among contacts, ... */
#define LOST_HELD 0.3     /* ... and where an end is held */
#define REACH 0.1         /* m: what is taken at most of one among contacts, see quick */
#define STRAYS 0.3        /* m: an update of these that is lost */
#define LEAST_SHARE 0.1   /* of an update that is held back */
#define MORE 2.0         /* times that, when updates do not go back that differ by as much as ... */
#define WALKS_LEAST 2e-3 /* m: ... fronts that walk, at least ... */
#define WALKS_MOST 2e-2  /* ... and at most */
#define STRIDE 0.3       /* m: what is taken at most of one in the safe way */

/* The most iterations among contacts: FEW for LINKS intervals, and more for more.  */
static int
touching (const bt__dynamic_work *w, int few)
{
  return w->n > LINKS ? few * w->n / LINKS : few;
}

/* Take over SHARE of the update: the multipliers and the places.  True if that hardly changed
   what presses.  */
static int
take (bt__dynamic_work *w, double share)
{
  bt_vec3 before = w->d[0];
  w->X[0] = bt__axpy (w->X[0], share, before);
  for (int j = 0; j < w->n; j++)
    {
      const bt__link *k = w->link + j;
      bt_vec3 after = w->d[j + 1];
      double closing = bt__dot (k->t, bt__sub (after, before));
      double lam = k->active > 0 ? k->tension + k->ka * closing : 0;
      w->lam[j] = share < 1 ? w->lam[j] + share * (lam - w->lam[j]) : lam;
      w->X[j + 1] = bt__axpy (w->X[j + 1], share, after);
      before = after;
    }
  return !bt__dynamic_touches (w) || bt__dynamic_contact_take (w, share);
}

/* The direction of interval J at its present place, and its excess over the length without tension.
 */
static double
excess_of (const bt__dynamic_work *w, int j, bt_vec3 *t)
{
  bt_vec3 c = bt__sub (w->X[j + 1], w->X[j]);
  double length = bt__norm (w->chord ? bt__add (c, w->chord[j]) : c);
  *t = length > 0 ? bt__scale (1 / length, c) : w->link[j].t;
  return length - w->link[j].zero;
}

/* A front of tension would walk along a slack line an interval an iteration, each pulling on the
   next.  So what an interval that ran taut is too long is handed on at once, from interval FROM on,
   BY to the next: those it makes taut are given the tension that a node's inertia makes of it.  */
static void
pull_on (bt__dynamic_work *w, int from, int by)
{
  bt_vec3 before = { 0, 0, 0 }, t;
  double pull = 0;
  for (int j = from; j >= 0 && j < w->n; j += by)
    {
      if (w->link[j].active > 0)
        {
          pull = 0;
          continue;
        }
      double excess = excess_of (w, j, &t);
      double handed = pull > 0 ? pull * fmax (bt__dot (before, t), 0) : 0;
      if (handed > 0 && excess <= 0 && excess + handed > 0)
        w->lam[j] = fmax (w->lam[j], w->rho * w->link[j].rest * handed);
      pull = fmax (excess + handed, 0);
      before = t;
    }
}

static void
move (bt__dynamic_work *w, const bt_vec3 *from, double share)
{
  for (int i = w->lo; i <= w->hi; i++)
    w->X[i] = bt__axpy (from[i], share, w->d[i]);
}

/* The share to take of the update, if SHARE was of the last: less where it goes back on that one,
   as Aitken would have it.  Friction goes by the load of the iterate before; where the line turns
   about thin things, that swings to and fro.  The update of a front of tension that walks on is one
   of other nodes and does not go back; nearer the solution what rests would be stirred up.  */
static double
calm (bt__dynamic_work *w, double share)
{
  double along = 0, size = 0, back = 0;
  for (int i = 0; i <= w->n; i++)
    {
      bt_vec3 change = bt__sub (w->d[i], w->last[i]);
      back += bt__dot (w->last[i], w->d[i]);
      along += bt__dot (w->last[i], change);
      size += bt__dot (change, change);
    }
  if (back >= 0 && size > WALKS_LEAST * WALKS_LEAST && size < WALKS_MOST * WALKS_MOST)
    return fmin (1, MORE * share);
  return size > 0 ? fmin (fmax (-share * along / size, LEAST_SHARE), 1) : 1;
}

/* What was slack or taut has changed: send fronts of tension ahead from both ends.  */
static void
send_fronts (bt__dynamic_work *w)
{
  pull_on (w, 0, 1);
  pull_on (w, w->n - 1, -1);
}

/* Iterate with friction that follows the loads (dynamic_couple.c).  Return true if that settles;
   else the iterate is what it was.  */
static int
couple (bt__dynamic_work *w, bt__dynamic_report *report)
{
  size_t nodes = (size_t)(w->n + 1) * sizeof *w->X, intervals = (size_t)w->n * sizeof *w->lam;
  int solved = 0;
  memcpy (w->whole, w->X, nodes);
  memcpy (w->spare, w->lam, intervals);
  for (int k = 0; k < w->rows; k++)
    w->row[k].before = w->row[k].load;
  w->coupled = 1;
  for (int i = 0; i < COUPLED && !solved && !bt__ask (w->asker); i++)
    {
      int changed = bt__dynamic_assemble (w, BT__FROZEN);
      double most = bt__dynamic_solve (w);
      report->solves++;
      report->update = most;
      if (!(most <= STRAYS))
        break;
      int settled = take (w, fmin (1, REACH / most));
      if (changed)
        send_fronts (w);
      solved = most <= w->tolerance && !changed && settled;
    }
  w->coupled = 0;
  if (solved)
    return 1;
  memcpy (w->X, w->whole, nodes);
  memcpy (w->lam, w->spare, intervals);
  for (int k = 0; k < w->rows; k++)
    w->row[k].load = w->row[k].before;
  return 0;
}

/* True if places of the line may push each other apart.  */
static int
has_pairs (const bt__dynamic_work *w)
{
  for (int k = 0; k < w->rows; k++)
    if (w->row[k].pair > 0)
      return 1;
  return 0;
}

/* True when the quick way is to be left for `couple' after iteration I.  */
static int
lags (const bt__dynamic_work *w, int i)
{
  return !w->coupled && i >= LAGGING && i % AGAIN == 0 && w->rows > 0 && w->bents == 0 && !w->hold;
}

/* Contacts are stiff: places that are solved for may press with too much, and a line that lies be
   thrown up in every step, unless the loads are too; but they need not settle at all costs.

   Among contacts tension walks along a slack line an interval at a time, each time by less: what is
   left of that is taken for solved.  LAST holds an update of this step once one has been taken:
   a held end that arrives lets the first iterations go by without.

   Where a loop runs tight within the step the load of a place that is solved for may be many times
   what it will be; without its fellows the next update then throws the line metres away.  Of that
   only the direction is good: taken a little way it changes who bears.  Not so where an end is
   held, which has mass only when it is pulled: thrown far it would not come back.  */
static int
quick (bt__dynamic_work *w, bt__dynamic_report *report)
{
  int touches = bt__dynamic_touches (w), last = touches ? touching (w, QUICK_TOUCHING) : QUICK;
  double lost = w->hold ? LOST_HELD : touches ? LOST_TOUCHING : LOST / 1e-5 * w->tolerance;
  double share = 1;
  int pressed = 0, moved = 0;
  for (int i = 0; i < last && !bt__ask (w->asker); i++)
    {
      int changed = bt__dynamic_assemble (w, i < TURNING ? BT__QUICK : BT__FROZEN);
      double most = bt__dynamic_solve (w);
      report->solves++;
      report->update = most;
      if (touches && bt__dynamic_hold_arrives (w))
        continue;
      if (!(most <= lost))
        return 0;
      if (touches)
        {
          share = fmin (i < SWINGING || !moved ? 1 : calm (w, share), REACH / most);
          moved = 1;
          memcpy (w->last, w->d, (size_t)(w->n + 1) * sizeof *w->d);
        }
      int settled = take (w, share);
      if (changed && i >= WALKING)
        send_fronts (w);
      if (lags (w, i) && couple (w, report))
        return 1;
      if (touches)
        report->update = most = fmax (most, w->flowed);
      if (!(most <= w->tolerance && (i == 0 || !changed)))
        continue;
      if (settled || ++pressed > PRESSED)
        return 1;
    }
  return touches && report->update <= FRONT;
}

/* ---- The safe way ---- */

static void
save (bt__dynamic_work *w)
{
  memcpy (w->keep, w->X, (size_t)(w->n + 1) * sizeof *w->X);
}

/* Start where the potential is lower: the predictor, in KEEP, or the present shape.  */
static double
start (bt__dynamic_work *w)
{
  double here, there;
  for (int i = w->lo; i <= w->hi; i++)
    w->X[i] = w->x[i];
  here = bt__dynamic_potential (w);
  memcpy (w->X + w->lo, w->keep + w->lo, (size_t)(w->hi - w->lo + 1) * sizeof *w->X);
  there = bt__dynamic_potential (w);
  if (there < here)
    return there;
  for (int i = w->lo; i <= w->hi; i++)
    w->X[i] = w->x[i];
  return here;
}

/* Move along D until the potential is no larger than PHI; return it, or infinity, which compares
   without being an invalid operation, as NaN does not.  */
static double
descend (bt__dynamic_work *w, double most, double phi)
{
  int touches = bt__dynamic_touches (w), last = touches ? 2 * HALVINGS : HALVINGS;
  double share = touches && most > STRIDE ? STRIDE / most : 1;
  save (w);
  for (int i = 0; i < last; i++, share *= i < HALVINGS / 2 ? 0.5 : touches ? 0.2 : 0.5)
    {
      move (w, w->keep, share);
      double next = bt__dynamic_potential (w);
      if (next <= phi)
        return next;
    }
  move (w, w->keep, 0);
  return INFINITY;
}

/* The tangents of the present shape: the quick way may have left any.  */
static void
keep_tangents (bt__dynamic_work *w)
{
  for (int i = 0; i <= w->n; i++)
    {
      bt_vec3 chord = bt__sub (w->x[i < w->n ? i + 1 : i], w->x[i > 0 ? i - 1 : i]);
      w->node[i].tau = bt__unit_or (chord, bt__vec (0, 0, -1));
    }
}

/* Where Newton's direction does not descend it swings nodes too far across a tight line, or runs a
   slack one taut.  As stiff in every direction as a taut interval along, slack or not, its block is
   nowhere less than its energy's curvature, and every step descends; so the least stiffness is
   raised until one does.  */
static double
stiffer (double now)
{
  return now > 0 ? fmin (30 * now, 1) : 1e-3;
}

static double
softer (double now)
{
  return now > 1e-3 ? now / 10 : 0;
}

/* Friction follows the loads now and then only: on the way down a place may press with a hundred
   times what it will, and friction after that would hold the line where it is.  Where nothing but
   fronts of tension walks, and friction has followed in between, that is taken for solved.  */
static int
safe (bt__dynamic_work *w, bt__dynamic_report *report)
{
  int touches = bt__dynamic_touches (w), last = touches ? touching (w, SAFE_TOUCHING) : SAFE;
  keep_tangents (w);
  if (touches)
    bt__dynamic_contact_load (w, 1);
  double phi = start (w);
  int settled = 0, followed = !touches, fronts = 0;
  for (int i = 0; i < last && !settled && !bt__ask (w->asker); i++)
    {
      bt__dynamic_assemble (w, BT__SAFE);
      report->update = bt__dynamic_solve (w);
      report->solves++;
      if (!isfinite (report->update) || !isfinite (phi))
        {
          report->update = INFINITY;
          return 0;
        }
      int small = report->update <= w->tolerance && !(w->stiffen > 0);
      fronts = touches && report->update <= FRONT && !(w->stiffen > 0) ? fronts + 1 : 0;
      settled = (small && followed) || fronts > FOLLOWING;
      double next = descend (w, report->update, phi);
      if (!(next <= phi) && w->stiffen >= 1)
        break;
      w->stiffen = next <= phi ? softer (w->stiffen) : stiffer (w->stiffen);
      phi = next <= phi ? next : phi;
      followed = !touches || small || i % FOLLOWING == 0;
      if (touches && followed)
        {
          bt__dynamic_contact_load (w, 0);
          phi = bt__dynamic_potential (w);
        }
    }
  w->stiffen = 0;
  bt__dynamic_assemble (w, BT__SAFE);
  for (int j = 0; j < w->n; j++)
    w->lam[j] = w->link[j].tension;
  return settled;
}

int
bt__dynamic_newton (bt__dynamic_work *w, bt__dynamic_report *report)
{
  if (w->lo > w->hi)
    {
      keep_tangents (w);
      bt__dynamic_assemble (w, BT__SAFE);
      w->lam[0] = w->link[0].tension;
      return 1;
    }
  save (w); /* the predictor, for the safe way */
  w->coupled = bt__dynamic_touches (w) && !has_pairs (w);
  int solved = quick (w, report);
  w->coupled = 0;
  if (!solved)
    {
      report->safeguarded = 1;
      solved = safe (w, report);
    }
  report->loose = solved && report->update > w->tolerance;
  return solved;
}
