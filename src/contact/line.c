/* A step of the line among obstacles.

   A line far from everything takes the step of open water.  Otherwise: contact constraints
   (half-spaces) for everything touched, and a solve; then continuous collision detection, a cast of
   every link along its proposed move.  A hit adds a constraint at the place and time of the impact,
   and the step is solved again, four times at most.  Hits that remain are answered by the safe step
   (collide/safe.c).  Only casts and safe step decide on the accepted move, so no answer of the
   equations can break the promise that nothing is passed through.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "contact/line_job.h"

/* ---- The parts of a step ---- */

static bt_status
check_config (const bt__line_config *c, const bt__line_work *w, const bt__dynamic *d,
              bt_error *error)
{
  if (!(c->core > 0 && c->core < c->radius && isfinite (c->radius)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a line of radius %g m with a core of %g m; both must be positive, the core "
                     "the smaller",
                     c->radius, c->core);
  if (!(c->friction >= 0 && isfinite (c->friction)))
    return bt__fail (error, BT_ERR_DOMAIN, "a coefficient of friction of %g; it is 0 or more",
                     c->friction);
  if (!(c->pull[0] >= 0 && c->pull[1] >= 0))
    return bt__fail (error, BT_ERR_DOMAIN, "ends pulled by %g and %g N; 0 or more", c->pull[0],
                     c->pull[1]);
  for (int i = 0; i < c->strands; i++)
    if (c->strand[i].line->n > w->n_max)
      return bt__fail (error, BT_ERR_LIMIT, "another line of %d intervals; 1 to %d",
                       (int)c->strand[i].line->n, w->n_max);
  if (d->n > w->n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the workspace holds 1 to %d", (int)d->n,
                     w->n_max);
  return BT_OK;
}

static bt_status
lack (bt__line_work *w, bt_error *error)
{
  w->lacks = 0;
  return bt__fail (error, BT_ERR_LIMIT, "no memory for what a line touches");
}

static void
check_known (bt__line_job *k)
{
  bt__line_work *w = k->w;
  uint64_t version = k->on ? k->on->version : 0;
  const uint8_t *off = k->on ? k->on->off : NULL;
  if (w->serial != k->scene->serial || w->version != version || w->off != off)
    bt__line_work_forget (w);
  w->serial = k->scene->serial;
  w->version = version;
  w->off = off;
}

static void
prepare (bt__line_job *k)
{
  bt__line_work *w = k->w;
  bt__line_measure (k);
  k->olds = k->anchors->n < w->rows_max ? (int)k->anchors->n : w->rows_max;
  if (!bt__line_old_room (w, k->olds))
    k->olds = 0;
  memcpy (w->old, bt__contacts_at (k->anchors), (size_t)k->olds * sizeof *w->old);
  memset (w->restart, 0, (size_t)k->links + 1);
}

static void
solve (bt__line_job *k, int held, bt__dynamic_report *report)
{
  bt__dynamic_hold *hold = held ? k->w->hold : NULL;
  const bt__line_hook *hook = k->config->hook;
  k->watch = (bt__dynamic_watch){ 0 };
  if (k->rows > 0 || k->bents > 0 || held)
    bt__dynamic_iterate (k->kernel, k->w->row, k->rows, hold, report);
  else /* what begins once begins again */
    bt__dynamic_iterate_free (k->d, k->kernel, &k->watch, report, NULL);
  if (!isfinite (report->update))
    bt__dynamic_stay (k->d, k->kernel, report);
  if (hook && hook->spoil)
    hook->spoil (hook->user, k->x, k->X, k->links + 1);
}

/* Solve, and again for what is hit; then cut what still is.  A proposal that is no solution meets
   things that no solution would: constraints against those jam a heap of line for good, at five
   times the cost.  */
static void
propose (bt__line_job *k, int near, int held, bt__dynamic_report *report)
{
  static const bt__line_hook none;
  const bt__line_hook *hook = k->config->hook ? k->config->hook : &none;
  int rounds = hook->no_rounds || hook->no_contacts ? 0 : BT__LINE_ROUNDS, hits = 0;
  for (int i = 0;; i++)
    {
      solve (k, held, report);
      if (!bt__line_bound (k, near ? BT__STRIDE : INFINITY))
        report->converged = 0;
      bt__line_watch_moves (k);
      bt__self_watch_moves (k);
      if (hook->no_guard)
        return;
      int last = i == rounds || !report->converged || bt__dynamic_is_left (k->kernel);
      hits = bt__line_hits (k, !last);
      if (hits == 0 || last)
        break;
      bt__line_harden (k);
      k->report->rounds++;
    }
  k->report->rows = k->rows;
  if (hits > 0)
    bt__line_truncate (k);
}

/* The workspace may be made anew for it.  */
static bt_status
begin_proposal (bt__line_job *k, bt__dynamic_report *report, bt_error *error)
{
  bt_status status = bt__dynamic_begin (k->d, k->kernel, k->in, report, error);
  k->X = bt__dynamic_proposal (k->kernel);
  return status;
}

/* Nodes that met something go on without memory.  */
static void
mark_fresh (bt__line_job *k)
{
  for (int i = 0; i < k->rows; i++)
    {
      const bt__constraint *r = k->w->row + i;
      if (!k->w->of[i].fresh || !(r->load > 0))
        continue;
      k->w->restart[r->node] = k->w->restart[r->node + 1] = 1;
      if (r->pair > 0)
        k->w->restart[r->pair - 1] = k->w->restart[r->pair] = 1;
    }
}

/* True if there is but the line, which is clear of itself: what it meets cannot be why it is not
   solved.  */
static int
is_alone (const bt__line_job *k)
{
  return k->scene->n == 0 && k->movers == 0 && k->config->strands == 0 && k->w->self.clear;
}

/* Solve the step of a line that can meet nothing, its ends pulled by no more than may pull them. */
static bt_status
solve_held (bt__line_job *k, bt__dynamic_report *report, bt_error *error)
{
  bt_status status = begin_proposal (k, report, error);
  if (status)
    return status;
  k->watch = (bt__dynamic_watch){ 0 };
  bt__line_start_ends (k);
  bt__dynamic_iterate (k->kernel, NULL, 0, k->w->hold, report);
  return BT_OK;
}

/* The proposal is not taken: begin anew, each end at its place.  */
static void
give_up (bt__line_job *k, const bt__dynamic_report *report)
{
  k->report->vain += report->solves;
  bt__line_let_go (k);
}

/* Solve the step of a line that can meet nothing and whose end slipped in the step before, as if it
   slipped on.  Return true if it does; else each end is to be taken to its place.  */
static int
slips_on (bt__line_job *k, bt__dynamic_report *report)
{
  if (!bt__line_slipped (k) || !bt__line_hold_ends (k))
    return 0;
  if (solve_held (k, report, NULL) == BT_OK && report->converged && bt__line_slips (k))
    return 1;
  give_up (k, report);
  return 0;
}

/* Take the proposal of a line that is far from everything for any drift up to MAY; else *DONE is
   zero and nothing has happened.  */
static bt_status
take_far (bt__line_job *k, const bt__dynamic_drift *may, bt__dynamic_report *report, int *done,
          bt_error *error)
{
  bt_status status = BT_OK;
  *done = !bt__line_is_overpulled (k)
          && (is_alone (k) || (isfinite (report->update) && bt__self_stays_far (k)));
  if (k->w->lacks)
    return lack (k->w, error);
  if (*done)
    status = bt__dynamic_finish_within (k->d, k->kernel, may, done, report, error);
  if (!*done)
    give_up (k, report);
  if (!*done || status)
    return status;
  bt__dynamic_note_free (k->d, k->kernel, &k->watch);
  bt__self_note (k);
  k->anchors->n = 0;
  return BT_OK;
}

/* Take the proposal of a line that has nothing to meet.  An end that slips was first taken to its
   place.  */
static bt_status
take_open (bt__line_job *k, bt__dynamic_report *report, bt_error *error)
{
  bt_status status = BT_OK;
  k->anchors->n = 0;
  if (bt__line_is_overpulled (k) && bt__line_hold_ends (k))
    {
      k->report->vain += report->solves;
      status = solve_held (k, report, error);
    }
  return status ? status : bt__dynamic_take_free (k->d, k->kernel, k->in, &k->watch, report, error);
}

/* The step of a line that can meet nothing; with MAY not NULL, for any drift up to MAY: then *DONE
   is as of take_far.  */
static bt_status
step_free (bt__line_job *k, const bt__dynamic_drift *may, bt__dynamic_report *report, int *done,
           bt_error *error)
{
  int slips = slips_on (k, report);
  bt_status status = slips ? BT_OK : begin_proposal (k, report, error);
  *done = 1;
  if (!slips && !status)
    status = bt__dynamic_iterate_free (k->d, k->kernel, &k->watch, report, error);
  if (status)
    return status;
  return may ? take_far (k, may, report, done, error) : take_open (k, report, error);
}

/* Propose where the line is at the end of the step.  */
static bt_status
try_step (bt__line_job *k, int near, int held, bt__dynamic_report *report, bt_error *error)
{
  const bt__line_hook *hook = k->config->hook;
  bt_status status = begin_proposal (k, report, error);
  if (status)
    return status;
  if (held) /* else what is held is of another line's step */
    bt__line_start_ends (k);
  k->bents = 0;
  if (near && !(hook && hook->no_contacts))
    {
      bt__line_bends (k);
      bt__line_rows (k);
      bt__self_rows (k);
      bt__line_inherit (k);
      bt__line_harden (k);
    }
  else
    bt__line_round (k);
  propose (k, near, held, report);
  return BT_OK;
}

/* Begin the proposal anew, with another way to hold the line or its ends.  */
static bt_status
try_again (bt__line_job *k, int near, int held, bt__dynamic_report *report, bt_error *error)
{
  k->rows = 0;
  k->report->vain += report->solves;
  k->report->rounds = k->report->truncated = 0;
  prepare (k);
  return try_step (k, near, held, report, error);
}

/* As try_step; if corners about round members prevent a solution, half-spaces take their place.  */
static bt_status
try_both (bt__line_job *k, int near, int held, bt__dynamic_report *report, bt_error *error)
{
  bt__dynamic_hold before[2];
  memcpy (before, k->w->hold, sizeof before);
  bt_status status = try_step (k, near, held, report, error);
  if (status || report->converged || !bt__line_is_laid_round (k) || bt__dynamic_is_left (k->kernel))
    return status;
  memcpy (k->w->hold, before, sizeof before);
  k->plain = 1;
  return try_again (k, near, held, report, error);
}

static bt_status
step (bt__line_job *k, bt__dynamic_report *report, bt_error *error)
{
  const bt__line_hook *hook = k->config->hook;
  int beside = bt__line_watch (k), near = bt__self_watch (k) | beside;
  int held = near && bt__line_hold_ends (k);
  bt_status status = try_both (k, near, held, report, error);
  if (!status && !held && bt__line_is_overpulled (k) && bt__line_hold_ends (k))
    status = try_again (k, near, 1, report, error);
  if (status)
    return status;
  if (k->report->truncated || (hook && hook->spoil))
    bt__dynamic_bent_follow (k->kernel);
  mark_fresh (k);
  bt__line_keep (k);
  if (k->w->lacks)
    return lack (k->w, error);
  status = bt__dynamic_finish (k->d, k->kernel, k->w->restart, report, error);
  if (status)
    return status;
  if (!k->report->truncated)
    bt__dynamic_note_free (k->d, k->kernel, &k->watch);
  bt__line_store (k);
  k->unsolved = !report->converged || k->report->truncated;
  bt__line_note_near (k, beside);
  bt__self_note (k);
  bt__line_rebend (k);
  if (bt__dynamic_is_wound (k->d, k->in))
    bt__line_wind (k);
  return BT_OK;
}

bt_status
bt__line_step (bt__dynamic *d, bt__dynamic_work *work, bt__line_work *w,
               const bt__dynamic_input *input, const bt__surroundings *around,
               const bt__line_config *config, bt__contacts *anchors, bt__dynamic_report *report,
               bt__line_report *line_report, bt__count *count, bt_error *error)
{
  bt__line_job k = { .w = w,
                     .d = d,
                     .kernel = work,
                     .in = input,
                     .scene = around->scene,
                     .on = around->on,
                     .mover = around->mover,
                     .movers = around->movers,
                     .config = config,
                     .anchors = anchors,
                     .links = (int)d->n,
                     .margin = config->radius,
                     .h = input->h,
                     .x = bt__dynamic_x (d),
                     .report = line_report,
                     .count = count };
  *line_report = (bt__line_report){ 0 };
  for (uint32_t m = 0; m < k.movers; m++)
    k.mover[m].done = 1;
  for (int e = 0; e < 2; e++)
    w->hold[e].on = 0;
  bt_status status = check_config (config, w, d, error);
  if (status)
    return status;
  if (!bt__line_room (w, d, config))
    return lack (w, error);
  bt__line_aim_ends (&k);
  int done = 0;
  if (k.scene->n == 0 && k.movers == 0 && !bt__self_counts (&k) && !d->rounded)
    status = step_free (&k, NULL, report, &done, error);
  else
    {
      const bt__line_hook *hook = config->hook;
      bt__dynamic_drift may = { INFINITY, INFINITY, INFINITY };
      check_known (&k);
      k.core = config->core * 1.01;
      if (!d->rounded && bt__line_is_far (&k, &may.way) && bt__self_is_far (&k, &may)
          && !(hook && hook->spoil))
        status = step_free (&k, &may, report, &done, error);
      if (!done)
        {
          k.core = bt__cast_core (config->core, 1, k.x, (uint32_t)k.links + 1);
          prepare (&k);
          status = step (&k, report, error);
        }
      else if (status == BT_OK && bt__dynamic_is_wound (d, k.in))
        bt__line_wind (&k);
    }
  if (status == BT_OK)
    bt__line_tell_ends (&k, input);
  return status;
}
