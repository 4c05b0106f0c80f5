/* Broad phase of the safe step: the parts of obstacles within reach of a link.  The reach is the
   longer move of the two ends plus the core, since no point of a link moves farther than the
   farther end.  Where the list overflows, the ends' moves are cut to the distance of the nearest
   dropped part, so that nothing unlisted can be reached.

   A link whose clearance is known to exceed its move needs no query: the known clearance is the
   clearance measured last, less the way of the ends since.  Static parts are asked for with a
   longer reach than needed, so that a known clearance lasts for some steps.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "collide/safe_job.h"

static double
move_of (const bt__job *k, uint32_t j)
{
  const bt_vec3 *d = k->safe->d;
  return fmax (bt__norm (d[j]), bt__norm (d[j + 1]));
}

void
bt__cut_move (bt__job *k, uint32_t node, double most)
{
  double size = bt__norm (k->safe->d[node]);
  if (size > most)
    k->safe->d[node] = bt__scale (fmax (most, 0) / size, k->safe->d[node]);
}

/* Return the remainder of the clearance measured last.  */
static double
known_clear (const bt__job *k, uint32_t j)
{
  const bt__safe *s = k->safe;
  double a = bt__distance (k->x[j], s->known[2 * j]);
  double b = bt__distance (k->x[j + 1], s->known[2 * j + 1]);
  return s->clear[j] - fmax (a, b) * (1 + BT__MARGIN);
}

static void
remember_clearance (bt__job *k, uint32_t j, const bt__nears *list, double reach)
{
  bt__safe *s = k->safe;
  s->known[2 * j] = k->x[j];
  s->known[2 * j + 1] = k->x[j + 1];
  s->clear[j] = fmin (reach, list->dropped);
  for (uint32_t i = 0; i < list->n; i++)
    s->clear[j] = fmin (s->clear[j], list->at[i].w.distance);
}

/* Cut the ends' moves, so that no dropped part can be reached.  */
static void
yield_to_dropped (bt__job *k, uint32_t j, double dropped, double need, double share)
{
  if (!(dropped < need))
    return;
  k->report->overflows++;
  bt__cut_move (k, j, share * (dropped - k->core));
  bt__cut_move (k, j + 1, share * (dropped - k->core));
}

static void
list_static (bt__job *k, uint32_t j, bt__nears *list)
{
  double need = move_of (k, j) + k->core;
  if (known_clear (k, j) > need)
    {
      k->count->skipped_clear++;
      return;
    }
  bt__link link = bt__link_of (k->x, j);
  double reach = BT__NEAR_WIDER * need + BT__NEAR_AROUND;
  bt__scene_near (k->scene, k->on, &link, j, reach, list, k->count);
  remember_clearance (k, j, list, reach);
  yield_to_dropped (k, j, list->dropped, need, 1 - BT__CAST_LEAST);
}

static void
list_mover (bt__job *k, uint32_t j, uint32_t m, bt__nears *list)
{
  bt__mover *mover = k->mover + m;
  bt__frame at = bt__motion_at (&mover->motion, k->moving ? 0 : mover->done);
  bt__link link = bt__link_into (&at, bt__link_of (k->x, j));
  double own = k->moving ? bt__motion_way (&mover->motion, mover->radius) : 0,
         dropped = list->dropped;
  double need = move_of (k, j) + k->core + own * mover->done;
  bt__scene_near (mover->body, mover->on, &link, m + 1, need * (1 + BT__MARGIN), list, k->count);
  if (!(list->dropped < dropped) || !(list->dropped < need))
    return;
  yield_to_dropped (k, j, list->dropped, need, 0.5 * (1 - BT__CAST_LEAST));
  if (k->moving && own > 0)
    mover->done = fmin (mover->done,
                        fmax (0.5 * (1 - BT__CAST_LEAST) * (list->dropped - k->core), 0) / own);
}

void
bt__list_link (bt__job *k, uint32_t j)
{
  bt__safe *s = k->safe;
  bt__nears list = { s->near + (size_t)j * s->room, 0, s->room, INFINITY };
  if (k->scene->n > 0)
    list_static (k, j, &list);
  uint32_t n = list.n;
  for (uint32_t i = 0; i < n; i++)
    {
      list.at[i].link = 0;
      k->report->overlaps += list.at[i].w.distance < k->core && k->report->rounds == 0;
    }
  for (uint32_t m = 0; m < k->movers; m++)
    list_mover (k, j, m, &list);
  s->found[j] = list.n;
}
