/* The polyline of the spans: equal arcs within a span, a node at every split.

   A span that grew gets nodes in the middle of its longest links: the curve is unchanged.  A span
   that shrank loses nodes, each after a move to the chord of its neighbours.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/thesis_job.h"

#define COARSE 1.5 /* times the even arc: too long a link */
#define FINE 0.6   /* too short */

int64_t
bt__thesis_first (const bt__thesis_job *j, int64_t k)
{
  return k == 0 ? 0 : j->span[k - 1].end.node;
}

int64_t
bt__thesis_last (const bt__thesis_job *j, int64_t k)
{
  return k == j->state->spans - 1 ? j->line->n - 1 : j->span[k].end.node;
}

int64_t
bt__thesis_span_of (const bt__thesis_job *j, int64_t link)
{
  int64_t k = 0;
  while (k < j->state->spans - 1 && j->span[k].end.node <= link)
    k++;
  return k;
}

/* ---- More nodes ---- */

static int64_t
longest_link (const bt__thesis_job *j, int64_t k)
{
  const double *u = bt__polyline_u (j->line);
  int64_t best = bt__thesis_first (j, k);
  for (int64_t i = best + 1; i < bt__thesis_last (j, k); i++)
    if (u[i + 1] - u[i] > u[best + 1] - u[best])
      best = i;
  return best;
}

static void
refine (bt__thesis_job *j, int64_t k, int64_t links)
{
  const double *u = bt__polyline_u (j->line);
  while (bt__thesis_last (j, k) - bt__thesis_first (j, k) < links
         && j->line->n + BT__SPLITS_MAX < j->line->room)
    {
      int64_t i = longest_link (j, k);
      if (bt__polyline_insert (j->line, (u[i] + u[i + 1]) / 2, 0) != i + 1)
        return;
      for (int64_t m = k; m < j->state->spans - 1; m++)
        j->span[m].end.node++;
    }
}

/* ---- Where they are to go ---- */

/* On span K at the share F of its arc.  The thesis' search misses the end by up to its tolerance:
   that is shared out.  */
static bt_vec3
wanted (const bt__span *span, double f)
{
  const bt__shape *s = &span->shape;
  bt_vec3 miss = bt__sub (s->b, bt__shape_point (s, NULL, NULL, s->length));
  return bt__axpy (bt__shape_point (s, NULL, NULL, f * s->length), f, miss);
}

/* LINKS links of equal arc from node FIRST on, and a spare node in the middle of each of the first
   SPARES.  */
static void
aim_span (bt__thesis_job *j, int64_t k, double u0, int64_t links, int64_t spares)
{
  bt__polyline_work *w = j->way->work;
  const bt__span *span = j->span + k;
  int64_t i = bt__thesis_first (j, k);
  for (int64_t m = 0; m <= links; m++)
    {
      double f = (double)m / (double)links;
      bt_vec3 p = m == 0       ? bt__span_start (j, k)
                  : m == links ? bt__span_stop (j, k)
                               : wanted (span, f);
      if (m > 0 && m <= spares)
        {
          w->want[i] = bt__scale (0.5, bt__add (w->want[i - 1], p));
          w->arc[i] = u0 + (f - 0.5 / (double)links) * span->length;
          w->spare[i++] = 1;
        }
      w->want[i] = p;
      w->arc[i] = u0 + f * span->length;
      w->spare[i++] = 0;
    }
}

void
bt__thesis_aim (bt__thesis_job *j)
{
  double even = j->state->length / (double)j->state->nodes, u0 = 0;
  for (int64_t k = 0; k < j->state->spans; k++)
    {
      double size = j->span[k].length / even;
      int64_t have = bt__thesis_last (j, k) - bt__thesis_first (j, k), spares = 0;
      int64_t ask = (int64_t)fmin (fmax (1, round (size)), j->line->room);
      if (size > COARSE * (double)have)
        refine (j, k, ask);
      else if (size < FINE * (double)have && ask < have)
        spares = have - ask < have / 2 ? have - ask : have / 2;
      have = bt__thesis_last (j, k) - bt__thesis_first (j, k);
      aim_span (j, k, u0, have - spares, spares);
      u0 += j->span[k].length;
    }
}

void
bt__thesis_tidy (bt__thesis_job *j)
{
  bt__polyline_work *w = j->way->work;
  for (int64_t i = j->line->n - 2; i > 0; i--)
    if (w->spare[i])
      {
        bt__polyline_remove (j->line, i);
        for (int64_t k = 0; k < j->state->spans - 1; k++)
          j->span[k].end.node -= j->span[k].end.node > i;
      }
}
