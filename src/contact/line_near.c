/* What the links of a line could meet in a step.

   A link whose clearance, measured once, exceeds what it and the step need is not asked.  For the
   others all parts within reach are listed, standing and moving; a list that is full shortens the
   reach, and in the end the move.  Lists and casts see the same parts whether clearances are
   remembered or not: these save time alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/line_job.h"

#define AHEAD 1.2  /* of the present speed: how far a link may go in the step */
#define WIDER 1.1  /* of what is needed: what is listed */
#define LOOK 0.5   /* m: how far a clear link looks, so as not to ask again soon, ... */
#define FAR 10.0   /* ... and the whole line, ... */
#define OFTEN 0.3  /* m: ... whenever it has gone so far and half of what was clear */
#define CLOSE 1e-6 /* for rounding */

/* What is left of the clearance measured last.  */
static double
known_clear (const bt__line_job *k, uint32_t j)
{
  const bt__link_watch *s = k->w->watch + j;
  bt_vec3 a = bt__sub (k->x[j], s->a), b = bt__sub (k->x[j + 1], s->b);
  double square = fmax (bt__dot (a, a), bt__dot (b, b));
  return s->clear - sqrt (square) * (1 + CLOSE);
}

/* The farthest a point of MOVER goes.  */
static double
motion_of (const bt__mover *m)
{
  return bt__norm (m->motion.travel) + fabs (m->motion.angle) * m->radius;
}

/* Measure the clearance of a link that was clear; return nonzero if it is more than NEED.  */
static int
is_clear (bt__line_job *k, const bt__link *link, bt__link_watch *s, double need, double look)
{
  bt__near nearest;
  s->clear = fmax (look, 2 * need);
  if (bt__scene_nearest (k->scene, k->on, link, s->clear, &nearest, k->count))
    s->clear = nearest.w.distance;
  s->reach = s->clear;
  return s->clear > need;
}

static void
list_static (bt__line_job *k, uint32_t j, double need, bt__nears *list)
{
  bt__link_watch *s = k->w->watch + j;
  bt__link link = bt__line_link (k->x, j);
  double known = known_clear (k, j);
  int was_clear = !(s->clear <= need);
  if (known > need)
    {
      k->count->skipped_clear++;
      s->reach = known;
      return;
    }
  s->a = link.a;
  s->b = link.b;
  if (was_clear && is_clear (k, &link, s, need, LOOK))
    return;
  s->reach = WIDER * need;
  bt__scene_near (k->scene, k->on, &link, 0, s->reach, list, k->count);
  s->full = list->dropped < s->reach;
  s->reach = fmin (s->reach, list->dropped);
  s->clear = s->reach;
  for (uint32_t i = 0; i < list->n; i++)
    s->clear = fmin (s->clear, list->at[i].w.distance);
}

static void
list_mover (bt__line_job *k, uint32_t j, uint32_t m, bt__nears *list)
{
  bt__link_watch *s = k->w->watch + j;
  const bt__mover *mover = k->mover + m;
  const bt__frame *at = &mover->motion.from;
  bt__link link = bt__line_link (k->x, j);
  bt__witness ball;
  double own = motion_of (mover), dropped = list->dropped;
  bt__pair_point (at->origin, &link, &ball);
  double away = ball.distance - mover->radius - own;
  if (away * (1 - CLOSE) > s->reach)
    return;
  link = (bt__link){ bt__to_local (at, link.a), bt__to_local (at, link.b) };
  bt__scene_near (mover->body, mover->on, &link, m + 1, (s->reach + own) * (1 + CLOSE), list,
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
  bt__nears list = { bt__line_near (k, j), 0, BT__LINE_ROOM, INFINITY };
  s->full = 0;
  s->reach = WIDER * need;
  if (k->scene->n > 0)
    list_static (k, j, need, &list);
  for (uint32_t m = 0; m < k->movers; m++)
    list_mover (k, j, m, &list);
  s->found = list.n;
}

/* ---- All links ---- */

/* Measure how clear the whole line is, unless it has hardly moved since that was done.  */
static void
look_far (bt__line_job *k)
{
  bt__line_work *w = k->w;
  double spare = FAR;
  if (w->still == k->links + 1
      && bt__dynamic_stray (k->x, w->stood, k->links + 1) < 0.5 * w->spare + OFTEN)
    return;
  for (uint32_t j = 0; j < (uint32_t)k->links; j++)
    {
      bt__link link = bt__line_link (k->x, j);
      bt__link_watch *s = w->watch + j;
      is_clear (k, &link, s, 0, FAR);
      s->a = link.a;
      s->b = link.b;
      spare = fmin (spare, s->clear);
    }
  w->spare = spare;
  w->still = k->links + 1;
  memcpy (w->stood, k->x, (size_t)w->still * sizeof *k->x);
}

/* Nonzero if a part that link J lists is within NEED.  */
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
      any |= near[i].w.distance <= need + (m ? motion_of (m) : 0);
    }
  k->report->overlaps += least < k->config->core;
  return any;
}

static double
move_of_ends (const bt__line_job *k)
{
  double most = 0;
  for (int e = 0; e < 2; e++)
    if (!k->in.end[e].free)
      most = fmax (most, bt__distance (k->in.end[e].at, k->x[e ? k->links : 0]));
  return fmin (most, BT__LINE_STRIDE);
}

int
bt__line_watch (bt__line_job *k)
{
  const bt_vec3 *v = bt__dynamic_v (k->d);
  double touch = k->config->radius + k->margin, ends = move_of_ends (k);
  int any = 0;
  double before = bt__dot (v[0], v[0]);
  for (int j = 0; j < k->links; j++)
    {
      double after = bt__dot (v[j + 1], v[j + 1]);
      double move = fmax (k->h * sqrt (fmax (before, after)), ends);
      double need = fmax (touch, AHEAD * fmin (move, BT__LINE_STRIDE) + k->core);
      list_link (k, (uint32_t)j, need);
      any |= is_near (k, (uint32_t)j, need);
      before = after;
    }
  if (!any && k->movers == 0)
    look_far (k);
  return any;
}

/* ---- The line as a whole ---- */

static double
strayed (const bt__line_job *k, const bt_vec3 *x)
{
  return bt__dynamic_stray (x, k->w->stood, k->links + 1);
}

/* What a link needs is no more than what the stride does.  */
int
bt__line_is_far (const bt__line_job *k)
{
  bt__line_work *w = k->w;
  double need = fmax (k->config->radius + k->margin, AHEAD * BT__LINE_STRIDE + k->core);
  double spare = (1 - CLOSE) * w->spare - need;
  if (k->movers > 0 || w->still != k->links + 1 || !(spare > 0))
    return 0;
  if (!k->resumes || !(w->moved < spare))
    w->moved = strayed (k, k->x);
  return w->moved < spare;
}

/* After that; NaN is not far.  */
int
bt__line_stays_far (const bt__line_job *k)
{
  bt__line_work *w = k->w;
  double spare = (1 - CLOSE) * w->spare - k->core;
  w->moved += k->stride;
  if (!(w->moved < spare))
    w->moved = strayed (k, k->X);
  return w->moved < spare;
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
      if (need * (1 + CLOSE) <= s->reach)
        continue;
      if (!s->full)
        list_link (k, j, need * (1 + CLOSE));
      if (need <= s->reach)
        continue;
      k->report->overflows++;
      cut_move (k, j, 0.999 * (s->reach - k->core));
      cut_move (k, j + 1, 0.999 * (s->reach - k->core));
    }
}
