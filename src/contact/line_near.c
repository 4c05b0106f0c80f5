/* Broad phase: the candidate pairs of links and parts of obstacles in a step.

   A link whose clearance, measured once, exceeds the ways of link and step since then is not asked.
   For the remaining links all parts within reach are listed, standing and moving; a full list
   shortens the reach, and in the end the move.

   The tree of what stands is asked for more than is needed: the parts found are kept as candidates,
   and only these are measured until the link has used up the difference.  Lists and casts see the
   same parts in the same order whether clearances and candidates are remembered or not: the memory
   saves time and changes nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/hash.h"
#include "contact/line_job.h"

/* m: how far a clear link looks, to ask less often; the whole line looks as far as a stride.  */
#define LOOK 0.5

/* How far link J has gone since CLEAR was measured, at most.  */
static double
gone (const bt__line_job *k, uint32_t j)
{
  const bt__link_watch *s = k->w->watch + j;
  bt_vec3 a = bt__sub (k->x[j], s->a), b = bt__sub (k->x[j + 1], s->b);
  double square = fmax (bt__dot (a, a), bt__dot (b, b));
  return sqrt (square) * (1 + BT__MARGIN);
}

/* What is left of the clearance measured last.  */
static double
known_clear (const bt__line_job *k, uint32_t j)
{
  return k->w->watch[j].clear - gone (k, j);
}

/* Measure how clear link J is, as far as LOOK.  KNOWN is what is left of what was measured last: A
   link may have gained as much clearance as it has lost, and hardly more.  */
static void
measure_clear (bt__line_job *k, uint32_t j, double known, double look)
{
  bt__link_watch *s = k->w->watch + j;
  bt__link link = bt__link_of (k->x, j);
  double likely = 2 * s->clear - known;
  bt__near nearest;
  s->a = link.a;
  s->b = link.b;
  for (double cap = likely < look ? likely : look;; cap = look)
    {
      s->clear = cap;
      if (bt__scene_nearest (k->scene, k->on, &link, cap, &nearest, k->count))
        s->clear = nearest.w.distance;
      else if (cap < look)
        continue;
      break;
    }
  s->reach = s->clear;
  s->span = -1;
}

/* ---- Candidates ---- */

static bt__candidate *
kept_of (const bt__line_job *k, uint32_t j)
{
  return k->w->list[j]->kept;
}

/* Let LIST be the list of link J, which is made if there is none.  */
static void
open_list (bt__line_job *k, uint32_t j, bt__nears *list)
{
  bt__link_list *own = bt__line_list (k->w, j);
  list->at = own ? own->near : NULL;
  list->room = own ? k->w->room : 0;
}

/* Drop from LIST what is farther than REACH.  */
static void
drop_beyond (bt__nears *list, double reach)
{
  uint32_t n = 0;
  for (uint32_t i = 0; i < list->n; i++)
    if (list->at[i].w.distance <= reach)
      list->at[n++] = list->at[i];
  list->n = n;
}

/* List the parts within REACH of link J, and keep as candidates what is within SPAN.  If that finds
   no room, the next smaller span is the distance of what was dropped.  */
static void
renew_candidates (bt__line_job *k, uint32_t j, double reach, double span, bt__nears *list)
{
  bt__link_watch *s = k->w->watch + j;
  bt__link link = bt__link_of (k->x, j);
  for (;; span = fmax (reach, nextafter (list->dropped, 0)))
    {
      list->n = 0;
      list->dropped = INFINITY;
      bt__scene_near (k->scene, k->on, &link, 0, span, list, k->count);
      if (span == reach || list->dropped == INFINITY)
        break;
    }
  s->a = link.a;
  s->b = link.b;
  s->clear = fmin (span, list->dropped);
  s->span = list->dropped == INFINITY ? span : -1;
  s->kept = list->n;
  for (uint32_t i = 0; i < list->n; i++)
    {
      s->clear = fmin (s->clear, list->at[i].w.distance);
      kept_of (k, j)[i] = (bt__candidate){ list->at[i].object, list->at[i].slot };
    }
  if (span > reach)
    drop_beyond (list, reach);
}

/* List the candidates of link J that are within REACH.  */
static void
measure_candidates (bt__line_job *k, uint32_t j, double reach, bt__nears *list)
{
  bt__link link = bt__link_of (k->x, j);
  for (uint32_t i = 0; i < k->w->watch[j].kept; i++)
    {
      bt__candidate c = kept_of (k, j)[i];
      bt__near *near = list->at + list->n;
      const bt__obstacle *o = k->scene->object + c.object;
      near->link = 0;
      near->object = c.object;
      near->slot = c.slot;
      near->triangle = c.slot == BT__NO_TRIANGLE ? BT__NO_TRIANGLE : o->shape.mesh->id[c.slot];
      list->n += bt__scene_pair_within (k->scene, near, &link, reach, &near->w, k->count) != 0;
    }
}

static void
list_static (bt__line_job *k, uint32_t j, double need, bt__nears *list)
{
  bt__link_watch *s = k->w->watch + j;
  double way = gone (k, j), known = s->clear - way, reach = BT__NEAR_WIDER * need;
  if (known > need)
    {
      k->count->skipped_clear++;
      s->reach = known;
      return;
    }
  if (reach + way <= s->span)
    {
      open_list (k, j, list);
      measure_candidates (k, j, reach, list);
    }
  else
    {
      if (!(s->clear <= need)) /* it was clear */
        {
          measure_clear (k, j, known, fmax (LOOK, 2 * need));
          if (s->clear > need)
            return;
        }
      open_list (k, j, list);
      renew_candidates (k, j, reach, reach + BT__NEAR_AROUND, list);
    }
  s->full = list->dropped < reach;
  s->reach = fmin (reach, list->dropped);
}

static void
list_mover (bt__line_job *k, uint32_t j, uint32_t m, bt__nears *list)
{
  bt__link_watch *s = k->w->watch + j;
  const bt__mover *mover = k->mover + m;
  const bt__frame *at = &mover->motion.from;
  bt__link link = bt__link_of (k->x, j);
  bt__witness ball;
  double own = bt__motion_way (&mover->motion, mover->radius), dropped = list->dropped;
  bt__pair_point (at->origin, &link, &ball);
  double away = ball.distance - mover->radius - own;
  if (away * (1 - BT__MARGIN) > s->reach)
    return;
  open_list (k, j, list);
  link = bt__link_into (at, link);
  bt__scene_near (mover->body, mover->on, &link, m + 1, (s->reach + own) * (1 + BT__MARGIN), list,
                  k->count);
  if (!(list->dropped < dropped))
    return;
  s->full = 1;
  s->reach = fmin (s->reach, list->dropped - own);
}

static void
list_link (bt__line_job *k, uint32_t j, double need)
{
  bt__link_watch *s = k->w->watch + j;
  bt__nears list = { NULL, 0, 0, INFINITY };
  s->full = 0;
  s->reach = BT__NEAR_WIDER * need;
  if (k->scene->n > 0)
    list_static (k, j, need, &list);
  for (uint32_t m = 0; m < k->movers; m++)
    list_mover (k, j, m, &list);
  s->found = list.n;
}

/* ---- All links ---- */

/* True if a part that link J lists is within NEED.  */
static int
is_near (const bt__line_job *k, uint32_t j, double need)
{
  const bt__near *near = bt__line_near (k, j);
  double least = INFINITY;
  int any = 0;
  for (uint32_t i = 0; i < k->w->watch[j].found; i++)
    {
      const bt__mover *m = bt__line_mover (k, near + i);
      least = fmin (least, near[i].w.distance);
      any |= near[i].w.distance <= need + (m ? bt__motion_way (&m->motion, m->radius) : 0);
    }
  k->report->overlaps += least < k->config->core;
  return any;
}

static double
move_of_ends (const bt__line_job *k)
{
  double most = 0;
  for (int e = 0; e < 2; e++)
    if (!k->in->end[e].free)
      most = fmax (most, bt__distance (k->in->end[e].at, k->x[e ? k->links : 0]));
  return fmin (most, BT__STRIDE);
}

int
bt__line_watch (bt__line_job *k)
{
  const bt_vec3 *v = bt__dynamic_v (k->d);
  double touch = k->config->radius + k->margin, ends = move_of_ends (k);
  int any = 0;
  double before = bt__dot (v[0], v[0]);
  if (k->w->room == 0 && k->scene->n == 0 && k->movers == 0)
    return 0; /* nor was anything ever listed */
  for (int j = 0; j < k->links; j++)
    {
      double after = bt__dot (v[j + 1], v[j + 1]);
      double move = fmax (k->h * sqrt (fmax (before, after)), ends);
      double need = fmax (touch, BT__LINE_AHEAD * fmin (move, BT__STRIDE) + k->core);
      list_link (k, (uint32_t)j, need);
      any |= is_near (k, (uint32_t)j, need);
      before = after;
    }
  return any;
}

/* ---- The line as a whole ---- */

/* How clear link J is, m, at least: what was measured while that is more than LEAST.  */
static double
clear_by (bt__line_job *k, uint32_t j, double least)
{
  double known = known_clear (k, j);
  if (known >= least)
    return known;
  measure_clear (k, j, known, fmin (least + LOOK, BT__STRIDE));
  return k->w->watch[j].clear;
}

static bt__aabb
box_of (const bt__line_job *k)
{
  bt__aabb b = { k->x[0], k->x[0] };
  for (int i = 1; i <= k->links; i++)
    b = bt__box_with (b, k->x[i]);
  return b;
}

/* How clear the line is of what stands, at least: by the box about the line if the box is far, else
   by the least clearance of a link; at most BT__STRIDE.  What is remembered spares links that have
   more, and changes nothing else: this is kept in the state.  */
static double
clearance (bt__line_job *k)
{
  bt__aabb box = box_of (k);
  double least = BT__STRIDE, known = INFINITY, all = bt__scene_apart (k->scene, &box);
  uint32_t nearest = 0;
  if (all > BT__STRIDE)
    return all;
  for (uint32_t j = 0; j < (uint32_t)k->links; j++)
    {
      double this = known_clear (k, j);
      if (this < known)
        nearest = j;
      known = fmin (known, this);
    }
  least = fmin (least, clear_by (k, nearest, least));
  for (uint32_t j = 0; j < (uint32_t)k->links; j++)
    least = fmin (least, clear_by (k, j, least));
  return least;
}

static double
fastest (const bt__line_job *k)
{
  const bt_vec3 *v = bt__dynamic_v (k->d);
  double most = 0;
  for (int i = 0; i <= k->links; i++)
    most = fmax (most, bt__dot (v[i], v[i]));
  return sqrt (most);
}

/* Key of the spared clearance: valid for this scene, these switches and this radius alone.  */
static int64_t
seal_of (const bt__line_job *k)
{
  uint64_t parts[] = { k->scene->serial, k->on ? k->on->version : 0, 0 };
  int64_t seal;
  memcpy (parts + 2, &k->config->radius, sizeof parts[2]);
  parts[0] = bt__hash (parts, sizeof parts, 1);
  memcpy (&seal, parts, sizeof seal);
  return seal;
}

static void
check_spare (bt__line_job *k)
{
  int64_t seal = seal_of (k);
  if (k->d->seen != seal)
    k->d->spare = (bt__dynamic_drift){ 0, 0, 0 };
  k->d->seen = seal;
}

/* True if the clearance of the whole line exceeds the touching distance and the way of the fastest
   node: no link needs more.  */
static int
is_enough (const bt__line_job *k, double clear)
{
  double fast = k->h * k->d->fastest;
  if (!(clear > k->config->radius + k->margin))
    return 0;
  return clear > BT__LINE_AHEAD * BT__STRIDE + k->core
         || clear > BT__LINE_AHEAD * fmin (fmax (fast, move_of_ends (k)), BT__STRIDE) + k->core;
}

int
bt__line_is_far (bt__line_job *k, double *may)
{
  bt__dynamic *d = k->d;
  check_spare (k);
  *may = INFINITY;
  if (k->movers > 0)
    return 0;
  if (k->scene->n == 0)
    return 1;
  for (int looked = 0;; looked++)
    {
      double clear = (1 - BT__MARGIN) * d->spare.way;
      *may = clear - k->core;
      if (is_enough (k, clear))
        return 1;
      if (looked || d->spare.way < 0)
        return 0;
      d->spare.way = clearance (k);
      d->fastest = fastest (k);
    }
}

void
bt__line_note_near (bt__line_job *k, int near)
{
  if (k->scene->n > 0 || k->movers > 0)
    k->d->spare.way = near ? -1 : fmax (k->d->spare.way, 0);
}

static void
cut_move (bt__line_job *k, uint32_t i, double most)
{
  double size = bt__distance (k->x[i], k->X[i]);
  if (size > most)
    k->X[i] = bt__axpy (k->x[i], fmax (most, 0) / size, bt__sub (k->X[i], k->x[i]));
}

void
bt__line_watch_moves (bt__line_job *k)
{
  double before = bt__distance (k->x[0], k->X[0]);
  for (uint32_t j = 0; j < (uint32_t)k->links; j++)
    {
      const bt__link_watch *s = k->w->watch + j;
      double after = bt__distance (k->x[j + 1], k->X[j + 1]), need = fmax (before, after) + k->core;
      before = after;
      if (need * (1 + BT__MARGIN) <= s->reach)
        continue;
      if (!s->full)
        list_link (k, j, need * (1 + BT__MARGIN));
      if (need <= s->reach)
        continue;
      k->report->overflows++;
      cut_move (k, j, (1 - BT__CAST_LEAST) * (s->reach - k->core));
      cut_move (k, j + 1, (1 - BT__CAST_LEAST) * (s->reach - k->core));
    }
}
