/* Continuous collision detection of links against links: a line does not pass through itself, nor
   through another line.

   Two links whose ends move straight are cast against each other as a link and an obstacle are
   (collide/cast.c).  Then a work list, as in the safe step: an unsafe part is cut from the moves of
   all four ends, and every pair of these links is asked again.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_job.h"

/* The cast of pair P, with node I taking the share SHARE[I] of its move; NULL: the whole move.  */
static bt__cast
cast_of_pair (const bt__line_job *k, const bt__self_pair *p, const double *share)
{
  bt__cast c = { .link = bt__link_of (k->x, p->i),
                 .other = bt__self_second (k, k->x, p),
                 .core = p->floor,
                 .w = p->w };
  for (int e = 0; e < 2; e++)
    {
      uint32_t i = p->i + (uint32_t)e, j = p->j + (uint32_t)e;
      c.d[e] = bt__scale (share ? share[i] : 1, bt__sub (k->X[i], k->x[i]));
      if (p->strand < 0)
        c.other_d[e] = bt__scale (share ? share[j] : 1, bt__sub (k->X[j], k->x[j]));
    }
  return c;
}

/* ---- Hits ---- */

int
bt__self_hits (bt__line_job *k, int add)
{
  int hits = 0;
  for (int n = 0; n < k->w->self.pairs; n++)
    {
      const bt__self_pair *p = k->w->self.pair + n;
      bt__cast c = cast_of_pair (k, p, NULL);
      double t = bt__cast_run (&c, k->count);
      if (t >= 1)
        continue;
      hits++;
      if (!add)
        return hits;
      bt__self_add_hit (k, p, &c.w, t);
    }
  return hits;
}

/* ---- Truncation ---- */

/* Go through all pairs until none objects; the shares only shrink.  */
static void
agree (bt__line_job *k, double *share)
{
  for (int sweep = 0, cut = 1; cut; sweep++)
    {
      cut = 0;
      for (int n = 0; n < k->w->self.pairs; n++)
        {
          const bt__self_pair *p = k->w->self.pair + n;
          bt__cast c = cast_of_pair (k, p, share);
          double t = bt__cast_run (&c, k->count);
          if (t >= 1)
            continue;
          cut = 1;
          t = sweep < BT__SWEEPS_SOFT ? t : 0;
          for (uint32_t e = 0; e < 2; e++)
            {
              bt__cast_shrink (share + p->i + e, t);
              if (p->strand < 0)
                bt__cast_shrink (share + p->j + e, t);
            }
        }
      if (sweep < BT__SWEEPS_HARD)
        continue;
      for (int i = 0; i <= k->links; i++)
        share[i] = 0;
      return;
    }
}

void
bt__self_truncate (bt__line_job *k)
{
  double *share = k->w->self.reach;
  if (k->w->self.pairs == 0)
    return;
  for (int i = 0; i <= k->links; i++)
    share[i] = 1;
  agree (k, share);
  for (int i = 0; i <= k->links; i++)
    if (share[i] < 1)
      k->X[i] = bt__axpy (k->x[i], share[i], bt__sub (k->X[i], k->x[i]));
}

/* ---- A single node ---- */

/* True if link J of the line, whose end E goes by MOVE, meets link Q of STRAND.  */
static int
meets (bt__line_job *k, uint32_t j, int e, bt_vec3 move, int strand, uint32_t q)
{
  const bt_vec3 *x = bt__dynamic_x (k->d);
  bt__self_pair p
      = { .i = j < q || strand >= 0 ? j : q, .j = j < q || strand >= 0 ? q : j, .strand = strand };
  bt__cast c = { .link = bt__link_of (x, j),
                 .other = bt__self_second (k, x, &(bt__self_pair){ .j = q, .strand = strand }) };
  c.d[e] = move;
  bt__pair_links (&c.other, &c.link, &c.w);
  c.core = bt__self_lowered (bt__self_floor (k, strand, p.i, p.j), c.w.distance);
  return bt__cast_run (&c, k->count) < 1;
}

int
bt__self_may_move (bt__line_job *k, int64_t i, bt_vec3 move)
{
  if (!bt__self_counts (k))
    return 1;
  bt__self_asks_more (k, bt__norm (move) + k->core);
  int64_t n = k->d->n;
  bt__line_measure (k);
  for (int e = 0; e < 2; e++)
    {
      int64_t j = i - 1 + e;
      for (int64_t q = 0; q < n && k->config->itself; q++)
        if ((q < j - 1 || q > j + 1) && meets (k, (uint32_t)j, !e, move, -1, (uint32_t)q))
          return 0;
      for (int s = 0; s < k->config->strands; s++)
        for (int64_t q = 0; q < k->config->strand[s].line->n; q++)
          if (meets (k, (uint32_t)j, !e, move, s, (uint32_t)q))
            return 0;
    }
  return 1;
}

/* True if link J is nearer to link B than WAY more than KEEP.  */
static int
is_within (const bt__line_job *k, int64_t j, bt__link b, double way, double keep)
{
  bt__link a = bt__link_of (bt__dynamic_x (k->d), (uint32_t)j);
  bt__witness w;
  bt__pair_links (&b, &a, &w);
  return w.distance < way + keep;
}

int
bt__self_is_clear (const bt__line_job *k, int64_t j, double way)
{
  const bt_vec3 *x = bt__dynamic_x (k->d);
  bt__self_asks_more (k, way + k->core);
  for (int64_t q = 0; q < k->d->n && k->config->itself; q++)
    if ((q < j - 1 || q > j + 1)
        && is_within (k, j, bt__link_of (x, (uint32_t)q), way, 2 * k->core))
      return 0;
  for (int s = 0; s < k->config->strands; s++)
    {
      const bt__strand *o = k->config->strand + s;
      for (int64_t q = 0; q < o->line->n; q++)
        if (is_within (k, j, bt__link_of (bt__dynamic_x (o->line), (uint32_t)q), way + k->core,
                       o->core))
          return 0;
    }
  return 1;
}
