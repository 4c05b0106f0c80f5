/* The moving line: the workspace and one step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "tether/dynamic_kernel.h"

/* A step that grows by more than this is backward Euler: just after a snap the second-order
   difference of a growing step gains energy, though it is stable up to 1 + sqrt (2).  */
#define HISTORY_RATIO 1.02
#define OWED_TIME 0.5     /* s in which the winch pays what it owes */
#define LEAST_REST 0.05   /* of a piece: the shortest an interval is hauled to, ... */
#define LEAST_LUMP 0.0005 /* ... where the node of a lump may be at the winch, ... */
#define LEAST_TURN 0.125  /* of what is enough for a stiff line, ... */
#define STUB 0.05         /* m: ... and the last of all */
/* Of the length, in steps of a sixtieth of a second and longer; what a step may leave undone must
   shrink with it, or short steps add it up.  */
#define DEFAULT_TOLERANCE 1e-5
#define DEFAULT_STEP (1.0 / 60)
#define TOUCHING_TOLERANCE 1e-4 /* m: with contacts, at most */
#define ALONE_TOLERANCE 1e-9    /* of the length: where energy would be gained otherwise */

/* ---- The workspace ---- */

/* The arrays that follow the number of intervals, those of bending among them.  */
static void
free_arrays (bt__dynamic_work *w)
{
  void *at[]
      = { &w->X,     &w->d,         &w->rhs,      &w->keep,      &w->last,    &w->lam,   &w->link,
          &w->node,  &w->extra,     &w->diag,     &w->off,       &w->up,      &w->up2,   &w->pivot,
          &w->bend,  &w->bend_diag, &w->bend_off, &w->bend_far,  &w->whole,   &w->spare, &w->crowd,
          &w->down,  &w->far,       &w->crumple,  &w->first_row, &w->natural, &w->twist, &w->felt,
          &w->round, &w->slip,      &w->twisted };
  for (size_t i = 0; i < sizeof at / sizeof *at; i++)
    {
      void *array, *none = NULL;
      memcpy (&array, at[i], sizeof array);
      free (array);
      memcpy (at[i], &none, sizeof none);
    }
  w->room = 0;
}

void
bt__dynamic_work_free (bt__dynamic_work *w)
{
  if (!w)
    return;
  free_arrays (w);
  free (w->kept);
  free (w);
}

/* Elements of each array: bending has a row for each clamp too.  */
static size_t
elements (const bt__dynamic_work *w)
{
  return (size_t)w->room + 3;
}

/* *AT, if it is not made yet: COUNT elements of SIZE.  */
static int
make (void *at, size_t count, size_t size)
{
  void **array = at;
  return *array || (*array = calloc (count, size));
}

/* The same without clearing, for large arrays of which a step uses little: the system gives no
   memory for untouched pages.  */
static int
make_untouched (void *at, size_t count, size_t size)
{
  void **array = at;
  return *array || (*array = malloc (count * size));
}

static int
make_arrays (bt__dynamic_work *w)
{
  size_t n = elements (w);
  return make (&w->X, n, sizeof *w->X) && make (&w->d, n, sizeof *w->d)
         && make (&w->rhs, n, sizeof *w->rhs) && make (&w->keep, n, sizeof *w->keep)
         && make (&w->last, n, sizeof *w->last) && make (&w->lam, n, sizeof *w->lam)
         && make (&w->link, n, sizeof *w->link) && make (&w->node, n, sizeof *w->node)
         && make (&w->extra, n, sizeof *w->extra) && make (&w->diag, n, sizeof *w->diag)
         && make (&w->off, n, sizeof *w->off) && make (&w->up, n, sizeof *w->up)
         && make (&w->pivot, n, sizeof *w->pivot) && make (&w->whole, n, sizeof *w->whole)
         && make (&w->spare, n, sizeof *w->spare) && make (&w->round, n, sizeof *w->round)
         && make_untouched (&w->crowd, BT__CROWD * n, sizeof *w->crowd)
         && make_untouched (&w->down, n, sizeof *w->down)
         && make_untouched (&w->first_row, n, sizeof *w->first_row);
}

static int
make_for_bending (bt__dynamic_work *w)
{
  size_t n = elements (w);
  return make (&w->up2, n, sizeof *w->up2) && make (&w->far, n, sizeof *w->far)
         && make (&w->bend, n, sizeof *w->bend) && make (&w->bend_diag, n, sizeof *w->bend_diag)
         && make (&w->bend_off, n, sizeof *w->bend_off)
         && make (&w->bend_far, n, sizeof *w->bend_far) && make (&w->natural, n, sizeof *w->natural)
         && make (&w->twist, n, sizeof *w->twist) && make (&w->felt, n, sizeof *w->felt)
         && make (&w->crumple, n, sizeof *w->crumple) && make (&w->slip, n, sizeof *w->slip)
         && (w->twisted || (w->twisted = bt__twisted_new (n)));
}

/* Make room for N intervals of a line of P; false when memory is out.  */
static int
make_room (bt__dynamic_work *w, int n, const bt_tether_props *p)
{
  if (n > w->room)
    {
      free_arrays (w);
      w->room = n + n / 8 < w->n_max ? n + n / 8 : w->n_max;
      if (!make_arrays (w))
        {
          free_arrays (w);
          return 0;
        }
    }
  return !(p->ei > 0 || p->bending_damping > 0) || make_for_bending (w);
}

bt__dynamic_work *
bt__dynamic_work_new (int n_max)
{
  if (n_max < 1)
    return NULL;
  bt__dynamic_work *w = calloc (1, sizeof *w);
  if (!w)
    return NULL;
  w->n_max = n_max;
  w->kept = calloc ((size_t)n_max + 1, sizeof *w->kept);
  if (w->kept)
    return w;
  free (w);
  return NULL;
}

void
bt__dynamic_ask (bt__dynamic_work *w, bt__asker *asker)
{
  w->asker = asker;
}

int
bt__dynamic_is_left (bt__dynamic_work *w)
{
  return bt__ask (w->asker);
}

/* ---- A step ---- */

static bt_status
check_input (const bt__dynamic *d, const bt__dynamic_work *w, const bt__dynamic_input *in,
             bt_error *error)
{
  const bt_tether_props *p = in->line;
  if (d->n < 1 || d->n > w->n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the workspace holds 1 to %d", (int)d->n,
                     w->n_max);
  if (!(in->h > 0 && isfinite (in->h)))
    return bt__fail (error, BT_ERR_DOMAIN, "a step of %g s; it must be positive and finite", in->h);
  if (!(p->mass > 0 && isfinite (p->mass) && p->ea > 0 && p->ei >= 0 && isfinite (p->ei)
        && p->gj >= 0 && isfinite (p->gj) && p->ba >= 0 && isfinite (p->ba)
        && p->bending_damping >= 0 && isfinite (p->bending_damping) && p->diameter >= 0
        && isfinite (p->diameter) && isfinite (p->wet_weight) && p->cdn >= 0 && p->cdt >= 0
        && p->ca >= 0))
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "the line has mass %g kg/m, EA %g N, EI %g N m2, damping %g N s, diameter %g m;"
        " mass and EA must be positive, nothing negative",
        p->mass, p->ea, p->ei, p->ba, p->diameter);
  if (bt__layers_slip (p) && (in->n_sets > 0 || in->order == 4))
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "a line whose layers slip has no set and is stepped in the second order");
  for (int k = 0; k < 2; k++)
    if (!in->end[k].free && !bt__is_finite (in->end[k].at))
      return bt__fail (error, BT_ERR_DOMAIN, "end %d of the line is not at a finite place", k);
  if (!isfinite (in->pay))
    return bt__fail (error, BT_ERR_DOMAIN, "the winch pays out %g m/s; it must be finite", in->pay);
  return BT_OK;
}

/* Return the rest length of the first interval at the end of the step; *OWED what is then left. The
   only interval may be hauled in until it is a stub.  */
static double
wind_first (const bt__dynamic *d, const bt__dynamic_input *in, double *owed)
{
  double rest = bt__dynamic_rest (d)[0], part = d->owed * fmin (1, in->h / OWED_TIME);
  double least = LEAST_REST * d->piece;
  if (in->mesh.corners)
    least = fmax (LEAST_LUMP * d->piece, LEAST_TURN * bt__dynamic_blunt (d, in->line));
  least = d->n > 1 ? least : fmin (least, STUB);
  double next = fmax (rest + in->pay * in->h + part, fmin (rest, least));
  *owed = d->owed - part;
  return next;
}

static double
tolerance_of (const bt__dynamic_input *in)
{
  return in->tolerance > 0 ? in->tolerance : DEFAULT_TOLERANCE * fmin (1, in->h / DEFAULT_STEP);
}

/* ---- Its parts ---- */

bt_status
bt__dynamic_begin (const bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in,
                   bt__dynamic_report *report, bt_error *error)
{
  *report = (bt__dynamic_report){ .bend_radius = HUGE_VAL };
  bt_status status = check_input (d, w, in, error);
  if (status)
    return status;
  if (!make_room (w, (int)d->n, in->line))
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a line of %d intervals", (int)d->n);
  w->tolerance = tolerance_of (in) * bt__dynamic_length (d);
  double rest0 = wind_first (d, in, &w->owed), r = d->history ? in->h / d->h : 0;
  if (r > fmax (in->growth, HISTORY_RATIO))
    r = 0;
  w->b0 = (1 + 2 * r) / ((1 + r) * in->h);
  w->b2 = r * r / ((1 + r) * in->h);
  w->b1 = -(w->b0 + w->b2);
  bt__dynamic_prepare (w, d, in, rest0);
  w->given = 0;
  return BT_OK;
}

bt_vec3 *
bt__dynamic_proposal (bt__dynamic_work *w)
{
  return w->X;
}

int
bt__dynamic_iterate (bt__dynamic_work *w, bt__constraint *rows, int n, bt__dynamic_hold *hold,
                     bt__dynamic_report *report)
{
  w->row = rows;
  w->rows = n;
  w->hold = hold;
  if (bt__dynamic_touches (w))
    w->tolerance = fmin (w->tolerance, TOUCHING_TOLERANCE);
  report->converged = bt__dynamic_settle (w, report);
  return report->converged;
}

void
bt__dynamic_stay (const bt__dynamic *d, bt__dynamic_work *w, bt__dynamic_report *report)
{
  memcpy (w->X, w->x, (size_t)(w->n + 1) * sizeof *w->X);
  memcpy (w->lam, bt__dynamic_tension (d), (size_t)w->n * sizeof *w->lam);
  bt__dynamic_bent_stop (w);
  bt__dynamic_give_nothing (w);
  for (int j = 0; j < w->n; j++)
    w->link[j].t = bt__unit_or (bt__sub (w->x[j + 1], w->x[j]), bt__vec (0, 0, -1));
  report->converged = 0;
  report->update = 0;
}

/* Solve the step of D, a line alone, so that it has no more than MOST energy: what is not solved is
   a force that does work.  *SLOWED: it had to be slowed down.  */
static bt_status
solve_alone (bt__dynamic *d, bt__dynamic_work *w, double most, bt__dynamic_report *report,
             int *slowed, bt_error *error)
{
  int64_t history = d->history;
  report->converged = bt__dynamic_settle (w, report);
  if (!bt__dynamic_gains (d, w, most))
    return BT_OK;
  int solves = report->solves;
  d->history = 0;
  bt_status status = bt__dynamic_begin (d, w, w->in, report, error);
  d->history = history;
  if (status)
    return status;
  w->tolerance = fmin (w->tolerance, ALONE_TOLERANCE * bt__dynamic_length (d));
  report->converged = bt__dynamic_settle (w, report);
  report->solves += solves;
  *slowed = bt__dynamic_slow_down (d, w, most, report);
  return BT_OK;
}

bt_status
bt__dynamic_iterate_free (bt__dynamic *d, bt__dynamic_work *w, bt__dynamic_watch *watch,
                          bt__dynamic_report *report, bt_error *error)
{
  *watch = (bt__dynamic_watch){ .alone = bt__dynamic_is_alone (d, w->in) };
  if (watch->alone)
    {
      watch->most = bt__dynamic_most (d, w);
      return solve_alone (d, w, watch->most, report, &watch->slowed, error);
    }
  report->converged = bt__dynamic_settle (w, report);
  return BT_OK;
}

void
bt__dynamic_note_free (bt__dynamic *d, const bt__dynamic_work *w, const bt__dynamic_watch *watch)
{
  if (watch->alone)
    bt__dynamic_note (d, w, watch->most);
  if (watch->slowed)
    d->history = 0;
}

bt_status
bt__dynamic_take_free (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in,
                       const bt__dynamic_watch *watch, bt__dynamic_report *report, bt_error *error)
{
  bt_status status = bt__dynamic_finish (d, w, NULL, report, error);
  if (status)
    return status;
  bt__dynamic_note_free (d, w, watch);
  if (bt__dynamic_is_wound (d, in))
    bt__dynamic_wind (d, w, in);
  return BT_OK;
}

bt_status
bt__dynamic_step (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in,
                  bt__dynamic_report *report, bt_error *error)
{
  bt__dynamic_watch watch;
  bt_status status = bt__dynamic_begin (d, w, in, report, error);
  if (!status)
    status = bt__dynamic_iterate_free (d, w, &watch, report, error);
  return status ? status : bt__dynamic_take_free (d, w, in, &watch, report, error);
}
