/* Continuous collision detection (CCD) of a line against obstacles: casts along the proposed move,
   and the safe step.

   Each link is cast along the proposed straight paths of both nodes against the candidate pairs of
   the link (line_near.c), by conservative advancement (collide/cast.c).  A part farther from the
   link than the link moves is not cast.  A cast that stops short of the proposed place is a hit;
   line.c says how hits are answered.  The last answer always ends: the safe step (collide/safe.c)
   and the guard of self-contact shorten the move of each node, by turns, and after CUTS turns the
   line stays where it is.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/line_job.h"

enum
{
  CUTS = 6 /* times a move is cut for obstacles and for lines */
};

int
bt__line_bound (bt__line_job *k, double most)
{
  int finite = 1;
  for (int i = 0; i <= k->links; i++)
    {
      double size = bt__distance (k->x[i], k->X[i]);
      if (isfinite (size) && size <= most)
        continue;
      finite &= isfinite (size);
      k->X[i]
          = isfinite (size) ? bt__axpy (k->x[i], most / size, bt__sub (k->X[i], k->x[i])) : k->x[i];
    }
  return finite;
}

/* ---- Casts ---- */

static bt__cast
cast_of (const bt__line_job *k, uint32_t j, const bt__near *near)
{
  const bt__mover *m = bt__line_mover (k, near);
  return (bt__cast){ .scene = bt__line_scene (k, near),
                     .near = near,
                     .motion = m ? &m->motion : NULL,
                     .share = 1,
                     .radius = m ? m->radius : 0,
                     .link = bt__link_of (k->x, j),
                     .d = { bt__sub (k->X[j], k->x[j]), bt__sub (k->X[j + 1], k->x[j + 1]) },
                     .core = k->core,
                     .w = near->w };
}

int
bt__line_hits (bt__line_job *k, int add)
{
  int hits = 0;
  double before = bt__distance (k->x[0], k->X[0]);
  for (uint32_t j = 0; j < (uint32_t)k->links; j++)
    {
      const bt__near *near = bt__line_near (k, j);
      double after = bt__distance (k->x[j + 1], k->X[j + 1]), move = fmax (before, after);
      before = after;
      for (uint32_t i = 0; i < k->w->watch[j].found; i++)
        {
          if (near[i].link == 0 && near[i].w.distance - k->core > move)
            continue;
          bt__cast c = cast_of (k, j, near + i);
          double t = bt__cast_run (&c, k->count);
          if (t >= 1)
            continue;
          hits++;
          if (!add)
            return hits;
          bt__line_add_hit (k, j, near + i, &c.w, t);
        }
    }
  return hits + bt__self_hits (k, add);
}

/* ---- The safe step ---- */

/* What the safe step leaves of the proposal.  */
static void
cut_at_obstacles (bt__line_job *k)
{
  bt__safe_config config = { k->config->core, BT__STRIDE, 1 };
  bt__safe_report safe;
  size_t size = (size_t)(k->links + 1) * sizeof *k->x;
  bt__safe *work = bt__line_safe (k->w);
  if (!work)
    return;
  memcpy (k->w->to, k->x, size);
  bt__safe_step (work, &config, k->scene, k->on, k->mover, k->movers, k->w->to, k->X,
                 (uint32_t)k->links + 1, &safe, k->count);
  memcpy (k->X, k->w->to, size);
}

/* Each cut breaks the promise of the other cut, given for the moves before; both make them shorter
   only.  In the end the line stays, with which everybody agrees.  */
void
bt__line_truncate (bt__line_job *k)
{
  k->report->truncated = k->links + 1;
  memset (k->w->restart, 1, (size_t)k->links + 1);
  for (int i = 0; i <= CUTS; i++)
    {
      if (i == CUTS)
        memcpy (k->X, k->x, (size_t)(k->links + 1) * sizeof *k->x);
      bt__self_truncate (k);
      cut_at_obstacles (k);
      if (bt__self_hits (k, 0) == 0)
        break;
    }
  for (uint32_t m = 0; m < k->movers; m++)
    k->report->pinched += k->mover[m].done < 1;
}

/* ---- One node alone ---- */

int
bt__line_may_move (bt__line_job *k, const bt_vec3 *p, bt_vec3 move)
{
  bt__near part[BT__LINE_ROOM];
  double need = bt__norm (move) + k->core;
  for (uint32_t j = 0; j < 2; j++)
    {
      bt__nears list = { part, 0, BT__LINE_ROOM, INFINITY };
      bt__link link = bt__link_of (p, j);
      for (uint32_t m = 0; m < k->movers; m++) /* beside what moves it can wait */
        {
          bt__frame f = bt__motion_at (&k->mover[m].motion, k->mover[m].done);
          bt__link local = bt__link_into (&f, link);
          bt__near unused;
          if (bt__scene_nearest (k->mover[m].body, k->mover[m].on, &local, need, &unused, k->count))
            return 0;
        }
      bt__scene_near (k->scene, k->on, &link, 0, need, &list, k->count);
      if (list.dropped < need)
        return 0;
      for (uint32_t i = 0; i < list.n; i++)
        {
          bt__cast c = {
            .scene = k->scene, .near = part + i, .link = link, .core = k->core, .w = part[i].w
          };
          c.d[!j] = move;
          if (bt__cast_run (&c, k->count) < 1)
            return 0;
        }
    }
  return bt__self_may_move (k, p - bt__dynamic_x (k->d) + 1, move);
}
