/* Continuous collision detection of links against links: a line does not pass through itself, nor
   through another line.

   Two links whose ends move straight are cast against each other as a link and an obstacle are
   (collide/cast.c).  Whatever motion they share, the links approach by no more than the difference
   of their ends' moves; and as long as the ends of both stay on their sides of the plane through
   the closest points, the links do not meet.  Then a work list, as in the safe step: an unsafe part
   is cut from the moves of all four ends, and every pair of these links is asked again.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_job.h"

enum
{
  STEPS_MAX = 200,
  SWEEPS_SOFT = 20,
  SWEEPS_HARD = 60
};

/* ---- The cast ---- */

/* Two links, the moves of their ends, and how near they may come.  */
typedef struct meeting
{
  bt__link a, b;
  bt_vec3 da[2], db[2];
  double floor;
  bt__witness w; /* of A against B, at the start; then where it ends */
} meeting;

static bt__link
moved (const bt__link *link, const bt_vec3 d[2], double t)
{
  return (bt__link){ bt__axpy (link->a, t, d[0]), bt__axpy (link->b, t, d[1]) };
}

/* The greatest move of an end of one link against an end of the other link.  */
static double
speed_of (const meeting *m)
{
  double most = 0;
  for (int i = 0; i < 4; i++)
    {
      bt_vec3 d = bt__sub (m->da[i & 1], m->db[i >> 1]);
      most = fmax (most, bt__dot (d, d));
    }
  return sqrt (most);
}

/* With the links at A and B: the share of the move that keeps both on their sides of the plane
   between; INFINITY if both keep their sides for the whole LEFT share.  */
static double
planar (const meeting *m, const bt__link *a, const bt__link *b, double left)
{
  double best = INFINITY;
  bt_vec3 n = m->w.normal;
  for (int i = 0; i < 4; i++)
    {
      bt_vec3 p = i & 1 ? a->b : a->a, q = i >> 1 ? b->b : b->a;
      double v = bt__dot (n, bt__sub (m->da[i & 1], m->db[i >> 1]));
      double g = bt__dot (n, bt__sub (p, q)) - m->floor;
      if (v >= 0 || g + v * left >= 0)
        continue;
      best = fmin (best, g > BT__CAST_FLOOR * m->floor ? BT__CAST_SAFETY * g / -v : 0);
    }
  return best;
}

/* Return a share of the move known to be safe, 1 for the whole move.  */
static double
run (meeting *m, bt__count *count)
{
  double speed = speed_of (m), t = 0;
  if (m->floor == 0 || m->w.distance - m->floor > speed)
    return 1;
  count->casts++;
  for (int i = 0; i < STEPS_MAX; i++)
    {
      double gap = m->w.distance - m->floor;
      bt__link a = moved (&m->a, m->da, t), b = moved (&m->b, m->db, t);
      if (i > 0 && gap < BT__CAST_NEAR * m->floor)
        return t;
      double step = gap > BT__CAST_FLOOR * m->floor ? BT__CAST_SAFETY * gap / speed : 0;
      step = fmax (step, planar (m, &a, &b, 1 - t));
      if (!(step > 0))
        return t;
      if (t + step >= 1)
        return 1;
      t += step;
      a = moved (&m->a, m->da, t);
      b = moved (&m->b, m->db, t);
      m->w = bt__self_witness (&a, &b);
      count->cast_steps++;
    }
  return t;
}

/* The meeting of pair P, with node I taking the share SHARE[I] of its move; NULL: the whole move.
 */
static meeting
meeting_of (const bt__line_job *k, const bt__self_pair *p, const double *share)
{
  meeting m = {
    .a = bt__self_first (k->x, p), .b = bt__self_second (k, k->x, p), .floor = p->floor, .w = p->w
  };
  for (int e = 0; e < 2; e++)
    {
      uint32_t i = p->i + (uint32_t)e, j = p->j + (uint32_t)e;
      m.da[e] = bt__scale (share ? share[i] : 1, bt__sub (k->X[i], k->x[i]));
      if (p->strand < 0)
        m.db[e] = bt__scale (share ? share[j] : 1, bt__sub (k->X[j], k->x[j]));
    }
  return m;
}

/* ---- Hits ---- */

int
bt__self_hits (bt__line_job *k, int add)
{
  int hits = 0;
  for (int n = 0; n < k->w->self.pairs; n++)
    {
      const bt__self_pair *p = k->w->self.pair + n;
      meeting m = meeting_of (k, p, NULL);
      double t = run (&m, k->count);
      if (t >= 1)
        continue;
      hits++;
      if (!add)
        return hits;
      bt__self_add_hit (k, p, &m.w, t);
    }
  return hits;
}

/* ---- Truncation ---- */

static void
shrink (double *share, double t)
{
  *share *= t;
  if (*share < 1e-3)
    *share = 0;
}

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
          meeting m = meeting_of (k, p, share);
          double t = run (&m, k->count);
          if (t >= 1)
            continue;
          cut = 1;
          t = sweep < SWEEPS_SOFT ? t : 0;
          for (uint32_t e = 0; e < 2; e++)
            {
              shrink (share + p->i + e, t);
              if (p->strand < 0)
                shrink (share + p->j + e, t);
            }
        }
      if (sweep < SWEEPS_HARD)
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
  meeting m = { .a = bt__line_link (x, j),
                .b = bt__self_second (k, x, &(bt__self_pair){ .j = q, .strand = strand }) };
  m.da[e] = move;
  m.floor = bt__self_floor (k, strand, p.i, p.j);
  m.w = bt__self_witness (&m.a, &m.b);
  m.floor = bt__self_lowered (m.floor, m.w.distance);
  return run (&m, k->count) < 1;
}

int
bt__self_may_move (bt__line_job *k, int64_t i, bt_vec3 move)
{
  if (!bt__self_counts (k))
    return 1;
  bt__self_asks_more (k, bt__norm (move) + k->core);
  const double *rest = bt__dynamic_rest (k->d);
  int n = (int)k->d->n;
  double *from_end = k->w->from_end;
  from_end[n] = 0;
  for (int j = n - 1; j >= 0; j--)
    from_end[j] = from_end[j + 1] + rest[j];
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

int
bt__self_is_clear (const bt__line_job *k, int64_t j, double way)
{
  const bt_vec3 *x = bt__dynamic_x (k->d);
  bt__link a = bt__line_link (x, (uint32_t)j), b;
  bt__self_asks_more (k, way + k->core);
  for (int64_t q = 0; q < k->d->n && k->config->itself; q++)
    {
      b = bt__line_link (x, (uint32_t)q);
      if ((q < j - 1 || q > j + 1) && bt__self_witness (&a, &b).distance < way + 2 * k->core)
        return 0;
    }
  for (int s = 0; s < k->config->strands; s++)
    {
      const bt__strand *o = k->config->strand + s;
      for (int64_t q = 0; q < o->line->n; q++)
        {
          b = bt__line_link (bt__dynamic_x (o->line), (uint32_t)q);
          if (bt__self_witness (&a, &b).distance < way + k->core + o->core)
            return 0;
        }
    }
  return 1;
}
