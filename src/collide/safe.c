/* The safe step: continuous collision detection of a whole line, by a work list.

   A round has three parts.  Every link lists the parts of obstacles within reach of its move
   (safe_list.c).  Then the work list: each link is cast against the link's list (cast.c), both
   ends' moves are cut to the share found, and the link and both neighbours are queued again, since
   a node belongs to two links.  A kinematic obstacle that is met is held back by the same share,
   and then all links are queued again.  Finally the shares are taken.

   Shares only shrink, and a share below 1/1000 becomes 0, so the list empties.  After 20 casts that
   cut, per link, offenders stop at once; after 60, all nodes and obstacles do: not to move is safe
   always.  After a round in which some node moved by more than 1 % of the core radius, a new round
   goes towards the same goal: nodes go on from where they were stopped and slide round corners.
   Kinematic obstacles move in the first round only.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "base/error.h"
#include "collide/cast.h"
#include "collide/safe_job.h"

/* Times the margin of a step: the margin of a common share, for the step by the share to be safe.
 */
enum
{
  STRICTER = 4
};

/* ---- Memory ---- */

void
bt__safe_free (bt__safe *s)
{
  if (!s)
    return;
  free (s->d);
  free (s->known);
  free (s->t);
  free (s->clear);
  free (s->queue);
  free (s->queued);
  free (s->near);
  free (s->found);
  free (s);
}

void
bt__safe_forget (bt__safe *s)
{
  for (uint32_t i = 0; i < s->nodes; i++)
    s->clear[i] = -INFINITY;
}

bt_status
bt__safe_new (uint32_t nodes, uint32_t room, bt__safe **out, bt_error *error)
{
  size_t n = (size_t)nodes + 1;
  bt__safe *s = calloc (1, sizeof *s);
  if (s)
    {
      *s = (bt__safe){ .nodes = nodes, .room = room };
      s->d = calloc (n, sizeof *s->d);
      s->known = calloc (2 * n, sizeof *s->known);
      s->t = calloc (n, sizeof *s->t);
      s->clear = calloc (n, sizeof *s->clear);
      s->queue = calloc (n, sizeof *s->queue);
      s->queued = calloc (n, sizeof *s->queued);
      s->near = calloc (n * room + 1, sizeof *s->near);
      s->found = calloc (n, sizeof *s->found);
    }
  if (!s || !s->d || !s->known || !s->t || !s->clear || !s->queue || !s->queued || !s->near
      || !s->found)
    {
      bt__safe_free (s);
      return bt__fail (error, BT_ERR_LIMIT, "no memory to keep a tether of %u nodes clear",
                       (unsigned)nodes);
    }
  bt__safe_forget (s);
  *out = s;
  return BT_OK;
}

/* ---- Truncation ---- */

static void
enqueue (bt__job *k, uint32_t j)
{
  bt__safe *s = k->safe;
  if (j >= k->links || s->queued[j] || s->found[j] == 0)
    return;
  s->queued[j] = 1;
  s->queue[(k->head + k->waiting++) % k->links] = j;
}

static uint32_t
dequeue (bt__job *k)
{
  uint32_t j = k->safe->queue[k->head];
  k->head = (k->head + 1) % k->links;
  k->waiting--;
  k->safe->queued[j] = 0;
  return j;
}

/* Return the safe share of the remaining move of link J; less than 1: *MET is the part in the way,
   with the closest points where the link is stopped.  */
static double
cast_safe_link (bt__job *k, uint32_t j, bt__near *met)
{
  const bt__safe *s = k->safe;
  double best = 1;
  bt__cast c = { .link = bt__link_of (k->x, j),
                 .d = { bt__scale (s->t[j], s->d[j]), bt__scale (s->t[j + 1], s->d[j + 1]) },
                 .core = k->core };
  for (uint32_t i = 0; i < s->found[j] && best > 0; i++)
    {
      c.near = s->near + (size_t)j * s->room + i;
      c.w = c.near->w;
      const bt__mover *m = c.near->link ? k->mover + c.near->link - 1 : NULL;
      bt__motion still;
      c.scene = m ? m->body : k->scene;
      c.motion = m ? &m->motion : NULL;
      c.share = m ? m->done : 0;
      c.radius = m ? m->radius : 0;
      if (m && !k->moving)
        {
          still = (bt__motion){ .from = bt__motion_at (&m->motion, m->done) };
          c.motion = &still;
        }
      double t = bt__cast_run (&c, k->count);
      if (t < best)
        {
          best = t;
          *met = *c.near;
          met->w = c.w;
        }
    }
  return best;
}

static void
stop_all (bt__job *k)
{
  for (uint32_t i = 0; i <= k->links; i++)
    k->safe->t[i] = 0;
  for (uint32_t m = 0; m < k->movers && k->moving; m++)
    k->mover[m].done = 0;
}

static void
truncate_moves (bt__job *k)
{
  bt__safe *s = k->safe;
  uint64_t asked = 0, cut = 0;
  for (uint32_t j = 0; j < k->links; j++)
    enqueue (k, j);
  while (k->waiting > 0)
    {
      bt__near met;
      uint32_t j = dequeue (k);
      double t = cast_safe_link (k, j, &met);
      if (t >= 1)
        continue;
      uint32_t hit = met.link;
      cut++;
      if (++asked > (uint64_t)BT__SWEEPS_SOFT * k->links)
        t = 0;
      bt__cast_shrink (s->t + j, t);
      bt__cast_shrink (s->t + j + 1, t);
      if (hit && k->moving)
        bt__cast_shrink (&k->mover[hit - 1].done, t);
      if (asked > (uint64_t)BT__SWEEPS_HARD * k->links)
        {
          stop_all (k);
          while (k->waiting > 0)
            dequeue (k);
          break;
        }
      enqueue (k, j);
      enqueue (k, j + 1);
      if (j > 0)
        enqueue (k, j - 1);
      for (uint32_t i = 0; hit && k->moving && i < k->links; i++)
        enqueue (k, i);
    }
  k->report->truncated += cut > 0;
}

/* ---- Rounds ---- */

/* Fill the moves; return true if there is one.  */
static int
set_moves (bt__job *k, const bt_vec3 *want)
{
  int any = 0;
  for (uint32_t i = 0; i <= k->links; i++)
    {
      bt_vec3 d = bt__sub (want[i], k->x[i]);
      if (!bt__is_finite (want[i]) || !isfinite (bt__norm (d)))
        d = bt__vec (0, 0, 0);
      k->safe->d[i] = d;
      k->safe->t[i] = 1;
      bt__cut_move (k, i, k->stride);
      any |= bt__norm (d) > 0;
    }
  return any;
}

/* Take the moves; return the longest.  */
static double
take_moves (bt__job *k, const bt_vec3 *want)
{
  double most = 0;
  for (uint32_t i = 0; i <= k->links; i++)
    {
      bt_vec3 d = bt__scale (k->safe->t[i], k->safe->d[i]), to = bt__add (k->x[i], d);
      double size = bt__norm (d);
      most = fmax (most, size);
      /* Arrived, but for rounding: exactly.  */
      k->x[i] = size > 0 && bt__distance (to, want[i]) <= BT__ROUNDING * bt__largest (to) ? want[i]
                                                                                          : to;
    }
  return most;
}

static int
round_of (bt__job *k, const bt_vec3 *want)
{
  if (!set_moves (k, want) && !(k->moving && k->movers))
    return 0;
  for (uint32_t j = 0; j < k->links; j++)
    bt__list_link (k, j);
  truncate_moves (k);
  k->report->rounds++;
  double most = take_moves (k, want);
  return most > 0.01 * k->core;
}

/* Without anything to hit: go.  */
static void
move_freely (bt__job *k, const bt_vec3 *want)
{
  for (uint32_t i = 0; i <= k->links; i++)
    if (bt__is_finite (want[i]))
      k->x[i] = want[i];
  k->count->skipped_empty++;
}

static void
check_known (bt__job *k)
{
  uint64_t version = k->on ? k->on->version : 0;
  if (k->safe->serial != k->scene->serial || k->safe->version != version)
    bt__safe_forget (k->safe);
  k->safe->serial = k->scene->serial;
  k->safe->version = version;
}

void
bt__safe_step (bt__safe *safe, const bt__safe_config *config, const bt__scene *scene,
               const bt__switches *on, bt__mover *mover, uint32_t movers, bt_vec3 *x,
               const bt_vec3 *want, uint32_t n, bt__safe_report *report, bt__count *count)
{
  bt__job k = { .safe = safe,
                .scene = scene,
                .on = on,
                .mover = mover,
                .movers = movers,
                .links = n - 1,
                .x = x,
                .stride = config->stride,
                .report = report,
                .count = count };
  *report = (bt__safe_report){ 0 };
  for (uint32_t m = 0; m < movers; m++)
    mover[m].done = 1;
  if (n < 2 || (scene->n == 0 && movers == 0))
    {
      if (n > 0)
        move_freely (&k, want);
      return;
    }
  check_known (&k);
  k.moving = 1;
  for (uint32_t i = 0; i < config->rounds; i++)
    {
      k.core = bt__cast_core (config->core, 1, x, n);
      if (!round_of (&k, want))
        break;
      k.moving = 0;
    }
  for (uint32_t i = 0; i < n; i++)
    report->held += bt__is_finite (want[i]) && bt__distance (x[i], want[i]) > 0;
}

double
bt__safe_common (bt__safe *safe, const bt__scene *scene, bt__mover *still, double core,
                 const bt_vec3 *x, uint32_t n, bt__hit *hit, bt__count *count)
{
  bt__job k = { .safe = safe,
                .scene = scene,
                .mover = still,
                .x = (bt_vec3 *)x,
                .core = bt__cast_core (core, STRICTER, x, n),
                .count = count };
  double share = 1;
  *hit = (bt__hit){ 0 };
  for (uint32_t j = 0; j + 1 < n; j++)
    {
      bt__near met;
      safe->t[j] = safe->t[j + 1] = share;
      double t = cast_safe_link (&k, j, &met);
      share *= t;
      if (t < 1)
        *hit = (bt__hit){ j, met.link, hit->links + 1, met };
    }
  if (hit->mover)
    {
      const bt__frame *f = &still[hit->mover - 1].motion.from;
      hit->near.w.point = bt__to_world (f, hit->near.w.point);
      hit->near.w.normal = bt__out_of (f, hit->near.w.normal);
    }
  return share;
}
