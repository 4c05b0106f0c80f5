/* Ways found in a tree of free ways: the best of the tree's points in sight, and the string laid
   along the way to it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "aware/free_job.h"

typedef struct candidates
{
  uint32_t n, cell[2 * BT__FREE_NEAR_MOST];
  double g[2 * BT__FREE_NEAR_MOST]; /* the way to P through it, if P sees it */
} candidates;

static void
add_candidate (const bt__free *t, candidates *c, uint32_t cell, bt_vec3 p)
{
  for (uint32_t i = 0; i < c->n; i++)
    if (c->cell[i] == cell)
      return;
  double base = cell == t->root ? 0 : t->g[cell];
  c->cell[c->n] = cell;
  c->g[c->n++] = base + bt__distance (bt__free_point (t, cell), p);
}

/* Return the candidate in sight of P with the shortest way through it, or BT__NOWHERE.  */
static uint32_t
best_in_sight (const bt__free *t, candidates *c, bt_vec3 p, double clear, bt__count *count)
{
  while (c->n > 0)
    {
      uint32_t best = 0;
      for (uint32_t i = 1; i < c->n; i++)
        if (c->g[i] < c->g[best])
          best = i;
      uint32_t cell = c->cell[best];
      if (bt__free_sees (&t->c, bt__free_point (t, cell), p, clear, count))
        return cell;
      c->cell[best] = c->cell[--c->n];
      c->g[best] = c->g[c->n];
    }
  return BT__NOWHERE;
}

/* Return what is best to come from to P, found among the N cells NEAR.  */
static uint32_t
last_corner (const bt__free *t, bt_vec3 p, double clear, const uint32_t *near, uint32_t n,
             bt__count *count)
{
  candidates c = { .n = 0 };
  for (uint32_t i = 0; i < n; i++)
    if (t->closed[near[i]])
      {
        add_candidate (t, &c, t->parent[near[i]], p);
        add_candidate (t, &c, near[i], p);
      }
  return best_in_sight (t, &c, p, clear, count);
}

/* Grow T as far as P needs, and return the last corner of a way from the anchor to P; BT__NOWHERE
   if there is none, or if ASKER said to leave the search.  */
static uint32_t
reach_for (bt__free *t, bt_vec3 p, bt__asker *asker, bt__count *count)
{
  uint32_t near[BT__FREE_NEAR_MOST], n = 0, corner = BT__NOWHERE;
  if (bt__free_sees (&t->c, t->anchor, p, t->c.clear, count))
    return t->root;
  if (!t->sprouted)
    bt__free_sprout (t);
  for (int radius = 1; corner == BT__NOWHERE && radius <= BT__FREE_WIDE; radius++)
    {
      n = bt__free_neighbours (t, p, radius, near);
      if (!bt__free_grow_to (t, near, n, asker, count))
        return BT__NOWHERE;
      corner = last_corner (t, p, t->c.clear, near, n, count);
    }
  if (corner == BT__NOWHERE) /* P itself is near something */
    corner = last_corner (t, p, 0.2 * t->c.clear, near, n, count);
  return corner;
}

/* Put into WAY (BT__FREE_WAY_MAX points of room) the corners of a way from the anchor to P; return
   their number, 0 if none was found.  */
static uint32_t
trace_way (bt__free *t, bt_vec3 p, bt_vec3 *way, bt__asker *asker, bt__count *count)
{
  uint32_t corner = reach_for (t, p, asker, count), n = 0;
  if (corner == BT__NOWHERE)
    return 0;
  for (uint32_t at = corner; n < BT__FREE_WAY_MAX; at = t->parent[at])
    {
      way[n++] = bt__free_point (t, at);
      if (at == t->root)
        break;
    }
  if (n == BT__FREE_WAY_MAX) /* P needs room too */
    return 0;
  for (uint32_t i = 0; i < n / 2; i++)
    {
      bt_vec3 swap = way[i];
      way[i] = way[n - 1 - i];
      way[n - 1 - i] = swap;
    }
  way[n] = p;
  return n + 1;
}

double
bt__string_length (const bt__taut_config *config, const bt__string *s, bt__count *count)
{
  bt__corner hold[512];
  bt__holds list = { hold, 0, 512, 0 };
  bt__holds_find (config->scene, config->on, s->x, s->n, config->core, 0.05, &list, count);
  return bt__holds_length (&list, s->x, s->n);
}

int
bt__free_way (bt__free *t, bt_vec3 from, bt_vec3 p, bt__string *string, bt__asker *asker,
              bt__count *count)
{
  bt_vec3 room[BT__FREE_WAY_MAX + 1] = { from };
  pthread_mutex_lock (&t->lock);
  uint32_t ahead = bt__distance (from, t->anchor) > 0, n = trace_way (t, p, room + 1, asker, count);
  pthread_mutex_unlock (&t->lock);
  return n > 0 && bt__string_lay (string, room + 1 - ahead, n + ahead);
}

double
bt__free_tighten (bt__taut *taut, const bt__taut_config *config, uint32_t steps, bt__string *way,
                  bt__count *count)
{
  if (way->n > 2)
    bt__taut_relax (taut, config, way, steps, count);
  return bt__string_length (config, way, count);
}
