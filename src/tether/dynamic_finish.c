/* The moving line: a solved step is judged and taken over.

   The judgement refuses a solution that is not finite and measures the largest moves; taking over
   commits nodes, intervals and ends.  Both halves of the line are gone through side by side, as in
   the assembly.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "tether/dynamic_kernel.h"

/* Say what is not finite in the solution.  */
static bt_status
refuse (const bt__dynamic_work *w, bt_error *error)
{
  const char *what = "motion";
  int at = 0;
  for (int i = w->n; i >= 0; i--)
    {
      const char *is = !bt__is_finite (w->node[i].current)                      ? "current"
                       : !bt__is_finite (w->X[i])                               ? "position"
                       : i >= w->lo && i <= w->hi && !bt__is_finite (w->rhs[i]) ? "force"
                                                                                : NULL;
      at = is ? i : at;
      what = is ? is : what;
    }
  return bt__fail (error, BT_ERR_DIVERGED, "the %s at node %d of the line is not finite at %g s",
                   what, at, w->in->water->time);
}

/* ---- Nodes ---- */

/* Of either half so far: the largest squares, the sum of all, the box of the moves.  */
typedef struct most
{
  bt__pair speed, acceleration, way, turned, sum;
  bt__pair_vec lo, hi;
} most;

/* Where a node goes on without memory its velocity is that of its move.  */
static bt__pair_vec
restarted (const bt__dynamic_work *w, const uint8_t *restart, int i, int j, bt__pair_vec move,
           bt__pair_vec v)
{
  bt_vec3 a = bt__vec (v.x[0], v.y[0], v.z[0]), b = bt__vec (v.x[1], v.y[1], v.z[1]);
  double rate = 1 / w->in->h;
  if (restart[i])
    a = bt__scale (rate, bt__vec (move.x[0], move.y[0], move.z[0]));
  if (restart[j])
    b = bt__scale (rate, bt__vec (move.x[1], move.y[1], move.z[1]));
  return bt__pair_load (&a, &b);
}

/* Moves of nodes I and J to D, velocities to SPEED; the most to M.  Return the moves.  */
static BT__HOT bt__pair_vec
judge_nodes (bt__dynamic_work *w, int i, int j, const uint8_t *restart, bt_vec3 *speed, most *m)
{
  const bt__node *p = w->node + i, *q = w->node + j;
  bt__pair rate = { w->b0, w->b0 };
  bt__pair_vec move
      = bt__pair_sub (bt__pair_load (w->X + i, w->X + j), bt__pair_load (w->x + i, w->x + j));
  bt__pair_vec v = bt__pair_axpy (bt__pair_load (&p->v0, &q->v0), rate, move),
               a = bt__pair_axpy (bt__pair_load (&p->a0, &q->a0), rate, v);
  if (restart && (restart[i] | restart[j]))
    v = restarted (w, restart, i, j, move, v);
  bt__pair vv = bt__pair_dot (v, v), aa = bt__pair_dot (a, a);
  bt__pair_store (speed + i, speed + j, v);
  bt__pair_store (w->d + i, w->d + j, move);
  m->sum += vv + aa;
  m->speed = bt__pair_max (vv, m->speed);
  m->acceleration = bt__pair_max (aa, m->acceleration);
  m->way = bt__pair_max (bt__pair_dot (move, move), m->way);
  m->lo = (bt__pair_vec){ bt__pair_min (move.x, m->lo.x), bt__pair_min (move.y, m->lo.y),
                          bt__pair_min (move.z, m->lo.z) };
  m->hi = (bt__pair_vec){ bt__pair_max (move.x, m->hi.x), bt__pair_max (move.y, m->hi.y),
                          bt__pair_max (move.z, m->hi.z) };
  return move;
}

static double
larger_of (bt__pair a)
{
  return a[0] > a[1] ? a[0] : a[1];
}

static double
smaller_of (bt__pair a)
{
  return a[0] < a[1] ? a[0] : a[1];
}

static bt__dynamic_drift
drift_of (const most *m)
{
  bt_vec3 hi = { larger_of (m->hi.x), larger_of (m->hi.y), larger_of (m->hi.z) },
          lo = { smaller_of (m->lo.x), smaller_of (m->lo.y), smaller_of (m->lo.z) };
  return (bt__dynamic_drift){ sqrt (larger_of (m->way)), sqrt (larger_of (m->turned)),
                              bt__distance (hi, lo) };
}

/* Moves of the solution to D, its velocities to SPEED; note the largest.  Return true if all is
   finite.  */
static int
judge_moves (bt__dynamic_work *w, const uint8_t *restart, bt_vec3 *speed,
             bt__dynamic_report *report)
{
  int nodes = w->n + 1, half = (nodes + 1) / 2, other = nodes - half;
  most m = { .lo = { .x = { 0, 0 } } };
  bt__pair_vec before = judge_nodes (w, 0, other, restart, speed, &m);
  m.lo = m.hi = before;
  for (int k = 1; k < half; k++)
    {
      bt__pair_vec now = judge_nodes (w, k, other + k, restart, speed, &m);
      bt__pair_vec turn = bt__pair_sub (now, before);
      m.turned = bt__pair_max (bt__pair_dot (turn, turn), m.turned);
      before = now;
    }
  if (other == half) /* between the halves */
    {
      bt_vec3 turn = bt__sub (w->d[half], w->d[half - 1]);
      m.turned[0] = fmax (m.turned[0], bt__dot (turn, turn));
    }
  report->speed = sqrt (larger_of (m.speed));
  report->acceleration = sqrt (larger_of (m.acceleration));
  report->drift = drift_of (&m);
  return isfinite (m.sum[0] + m.sum[1]);
}

/* Note the tightest bend.  */
static void
judge_bends (const bt__dynamic_work *w, bt__dynamic_report *report)
{
  double bend = 0;
  report->bend_at = 0;
  for (int i = 1; i < w->n; i++)
    {
      bt_vec3 turn = bt__sub (w->link[i].t, w->link[i - 1].t);
      double k = bt__dot (turn, turn), cell = w->node[i].cell;
      if (k > bend * cell * cell)
        {
          bend = k / (cell * cell);
          report->bend_at = i;
        }
    }
  report->bend_radius = bend > 0 ? 1 / sqrt (bend) : HUGE_VAL;
}

/* Take the solution over: its moves are in D, its velocities in SPEED.  */
static void
commit_nodes (bt__dynamic *d, const bt__dynamic_work *w, const bt_vec3 *speed,
              const uint8_t *restart)
{
  bt_vec3 *v = bt__dynamic_v (d), *vp = bt__dynamic_vp (d);
  size_t size = (size_t)(w->n + 1) * sizeof *v;
  memcpy (bt__dynamic_dx (d), w->d, size);
  memcpy (bt__dynamic_x (d), w->X, size);
  memcpy (vp, v, size);
  memcpy (v, speed, size);
  for (int i = 0; restart && i <= w->n; i++)
    if (restart[i])
      vp[i] = speed[i];
}

/* ---- Intervals ---- */

/* Stretch of intervals I and J of D, whose nodes have been taken over.  */
static BT__HOT void
commit_pair (bt__dynamic *d, const bt__dynamic_work *w, int i, int j, const bt_vec3 *x, double *e,
             double *de)
{
  bt__pair_vec c
      = bt__pair_sub (bt__pair_load (x + i + 1, x + j + 1), bt__pair_load (x + i, x + j));
  if (w->chord)
    c = bt__pair_add (c, bt__pair_load (w->chord + i, w->chord + j));
  bt__pair rest = { w->link[i].rest, w->link[j].rest }, was = { e[i], e[j] };
  bt__pair next = bt__pair_sqrt (bt__pair_dot (c, c)) / rest, change = next - was;
  de[i] = change[0];
  de[j] = change[1];
  e[i] = next[0];
  e[j] = next[1];
  (void)d;
}

/* Take the surplus of the chords out of the stretch.  */
static void
commit_rounds (bt__dynamic *d, const bt__dynamic_work *w)
{
  double *e = bt__dynamic_stretch (d), *de = bt__dynamic_dstretch (d);
  bt_vec3 *chord = bt__dynamic_chord (d);
  for (int j = 0; j < w->n; j++)
    {
      chord[j].z = w->round[j];
      if (w->round[j] == 0)
        continue;
      double less = w->round[j] / w->link[j].rest;
      e[j] -= less;
      de[j] -= less;
      d->rounded = 1;
    }
}

static void
commit_links (bt__dynamic *d, const bt__dynamic_work *w, bt__dynamic_report *report)
{
  double *e = bt__dynamic_stretch (d), *de = bt__dynamic_dstretch (d), most = 0;
  const bt_vec3 *x = bt__dynamic_x (d);
  int half = w->n / 2, at = 0;
  for (int k = 0; k < half; k++)
    commit_pair (d, w, k, half + k, x, e, de);
  if (2 * half < w->n)
    commit_pair (d, w, w->n - 1, w->n - 1, x, e, de);
  d->rounded = 0;
  if (w->rounded)
    commit_rounds (d, w);
  memcpy (bt__dynamic_tension (d), w->lam, (size_t)w->n * sizeof *w->lam);
  for (int j = 0; j < w->n; j++)
    if (w->lam[j] > most)
      {
        most = w->lam[j];
        at = j;
      }
  report->tension = most;
  report->at = at;
  for (int j = 0; j < (w->bents > 0 ? w->n : 1); j++)
    bt__dynamic_rest (d)[j] = w->link[j].rest;
}

/* True if something holds end K: what pulls there is its tension.  */
static int
is_fast (const bt__dynamic_work *w, int k)
{
  const bt__dynamic_end *end = w->in->end + k;
  return !end->free || end->gripped || end->body.mass > 0 || (w->hold && w->hold[k].on);
}

/* The holder of an end bears the whole equation of the end node (dynamic_ends.c), more than the
   tension of the last interval.  A free end pulls at nothing.  */
static void
commit_ends (bt__dynamic *d, const bt__dynamic_work *w, const bt_vec3 *pull,
             bt__dynamic_report *report)
{
  for (int k = 0; k < 2; k++)
    {
      d->pull[k] = is_fast (w, k) ? pull[k] : bt__vec (0, 0, 0);
      if (!(bt__norm (d->pull[k]) > report->tension))
        continue;
      report->tension = bt__norm (d->pull[k]);
      report->at = k ? w->n - 1 : 0;
    }
}

/* ---- All ---- */

static void
take_from_spare (bt__dynamic *d, const bt__dynamic_report *report)
{
  d->step = report->drift;
  d->spare.way -= report->drift.way;
  d->spare.turned -= report->drift.turned;
  d->spare.apart -= report->drift.apart;
  d->fastest = report->speed;
}

static void
take_over (bt__dynamic *d, bt__dynamic_work *w, const uint8_t *restart, const bt_vec3 *pull,
           bt__dynamic_report *report)
{
  if (w->in->order == 4)
    bt__dynamic_correct (d, w);
  else if (w->in->line->ei > 0)
    for (int j = 0; j < w->n; j++)
      bt__dynamic_chord (d)[j] = bt__vec (w->crumple[j], BT__BEARS, bt__dynamic_chord (d)[j].z);
  if (w->slips > 0)
    bt__dynamic_slip_take (d, w);
  if (w->twists)
    bt__dynamic_twist_take (d, w);
  else
    bt__twist_forget (d);
  commit_nodes (d, w, w->keep, restart);
  commit_links (d, w, report);
  commit_ends (d, w, pull, report);
  report->given = w->given;
  take_from_spare (d, report);
  d->h = w->in->h;
  d->history = report->converged;
  d->owed = w->owed;
}

static bt_status
judge (bt__dynamic_work *w, const uint8_t *restart, bt_vec3 *pull, bt__dynamic_report *report,
       bt_error *error)
{
  pull[0] = bt__dynamic_end_pull (w, 0);
  pull[1] = bt__dynamic_end_pull (w, 1);
  int finite = judge_moves (w, restart, w->keep, report);
  if (!finite || !bt__is_finite (pull[0]) || !bt__is_finite (pull[1]) || !isfinite (report->update))
    return refuse (w, error);
  judge_bends (w, report);
  report->slips = w->slips;
  return BT_OK;
}

bt_status
bt__dynamic_finish (bt__dynamic *d, bt__dynamic_work *w, const uint8_t *restart,
                    bt__dynamic_report *report, bt_error *error)
{
  bt_vec3 pull[2];
  bt_status status = judge (w, restart, pull, report, error);
  if (status == BT_OK)
    take_over (d, w, restart, pull, report);
  return status;
}

bt_status
bt__dynamic_finish_within (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_drift *most,
                           int *taken, bt__dynamic_report *report, bt_error *error)
{
  bt_vec3 pull[2];
  bt_status status = judge (w, NULL, pull, report, error);
  const bt__dynamic_drift *is = &report->drift;
  *taken = 1;
  if (status)
    return status;
  *taken = is->way <= most->way && is->turned <= most->turned && is->apart <= most->apart;
  if (*taken)
    take_over (d, w, NULL, pull, report);
  return BT_OK;
}
