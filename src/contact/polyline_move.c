/* How a polyline moves: all nodes by one share of their way, carried out by the safe step.

   A long way is taken in legs.  A leg is first tried as a whole on a copy.  If the safe step cuts
   the leg, all nodes take the least share that a link was left, and the safe step carries the
   shortened leg out: never is more committed than the safe step allowed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "collide/cast.h"
#include "contact/polyline.h"

enum
{
  LEGS_MAX = 64,
  HALVINGS = 10
};

#define STRETCH 0.005 /* of its arc: a link is drawn longer by a nudge at most */
#define NUDGE 0.1     /* a smaller share is not worth it */

/* ---- Surroundings ---- */

void
bt__polyline_let_pass (bt__polyline *line, const bt__way *way)
{
  const bt__surroundings *s = way->around;
  bt__safe_config config = { way->core, INFINITY, 1 };
  bt__safe_report report;
  if (s->movers == 0)
    return;
  bt_vec3 *x = bt__polyline_x (line), *want = way->work->want;
  memcpy (want, x, (size_t)line->n * sizeof *x);
  bt__safe_step (way->safe, &config, s->scene, s->on, s->mover, s->movers, x, want,
                 (uint32_t)line->n, &report, way->count);
  for (uint32_t m = 0; m < s->movers; m++)
    {
      way->work->still[m] = s->mover[m];
      way->work->still[m].motion
          = (bt__motion){ .from = bt__motion_at (&s->mover[m].motion, s->mover[m].done) };
    }
}

const bt__scene *
bt__way_scene (const bt__way *way, uint32_t mover, const bt__switches **on)
{
  const bt__mover *m = mover ? way->work->still + mover - 1 : NULL;
  *on = m ? m->on : way->around->on;
  return m ? m->body : way->around->scene;
}

int64_t
bt__hit_object (const bt__way *way, const bt__hit *hit)
{
  const bt__switches *on;
  const bt__scene *scene = bt__way_scene (way, hit->mover, &on);
  return hit->links ? (int64_t)scene->object[hit->near.object].id : -1;
}

/* ---- A leg ---- */

/* Move a copy of X to TO; true if all of it arrives.  */
static int
arrives (const bt__way *way, const bt_vec3 *x, const bt_vec3 *to, uint32_t n)
{
  bt__safe_config config = { way->core, INFINITY, 1 };
  bt__safe_report report;
  memcpy (way->work->trial, x, n * sizeof *x);
  bt__safe_step (way->safe, &config, way->around->scene, way->around->on, way->work->still,
                 way->around->movers, way->work->trial, to, n, &report, way->count);
  return report.held == 0;
}

static void
commit (const bt__way *way, bt_vec3 *x, const bt_vec3 *to, uint32_t n)
{
  if (way->watch)
    way->watch (way->user, x, to, n);
  memcpy (x, to, n * sizeof *x);
}

static void
interpolate (const bt_vec3 *x, const bt_vec3 *to, double t, bt_vec3 *out, uint32_t n)
{
  for (uint32_t i = 0; i < n; i++)
    out[i] = t < 1 ? bt__axpy (x[i], t, bt__sub (to[i], x[i])) : to[i];
}

/* Go as much of the way from X to work->leg as all can; return the share.  */
static double
take_leg (const bt__way *way, bt_vec3 *x, uint32_t n, bt__hit *hit)
{
  bt_vec3 *to = way->work->leg;
  if (arrives (way, x, to, n))
    {
      commit (way, x, to, n);
      return 1;
    }
  double done = 1, t = bt__safe_common (way->safe, way->around->scene, way->work->still, way->core,
                                        x, n, hit, way->count);
  for (int k = 0; k < HALVINGS && t * done > 0; k++)
    {
      interpolate (x, to, t, to, n);
      done *= t;
      if (arrives (way, x, to, n))
        {
          commit (way, x, to, n);
          return done < 1 ? done : 1 - 1e-15;
        }
      t = 0.5;
    }
  return 0;
}

/* ---- The move ---- */

static int
is_usable (const bt_vec3 *want, const double *arc, uint32_t n)
{
  int good = 1;
  for (uint32_t i = 0; i < n; i++)
    good = good && bt__is_finite (want[i]) && isfinite (arc[i]);
  return good;
}

static double
longest_move (const bt_vec3 *x, const bt_vec3 *want, uint32_t n)
{
  double most = 0;
  for (uint32_t i = 0; i < n; i++)
    most = fmax (most, bt__distance (x[i], want[i]));
  return most;
}

static double
take_legs (const bt__way *way, bt_vec3 *x, uint32_t n, bt__hit *hit)
{
  const bt_vec3 *want = way->work->want;
  double legs = ceil (longest_move (x, want, n) / BT__STRIDE), gone = 0;
  legs = legs < 1 ? 1 : legs < LEGS_MAX ? legs : LEGS_MAX;
  for (double k = legs; k >= 1; k--)
    {
      if (bt__ask (way->asker))
        return gone;
      interpolate (x, want, 1 / k, way->work->leg, n);
      double t = take_leg (way, x, n, hit);
      gone += t * (1 - gone) / k;
      if (t < 1)
        return gone < 1 ? gone : 1 - 1e-15;
    }
  return 1;
}

double
bt__polyline_move (bt__polyline *line, const bt__way *way, bt__hit *hit)
{
  bt_vec3 *x = bt__polyline_x (line);
  double *u = bt__polyline_u (line), t = 1;
  const double *arc = way->work->arc;
  uint32_t n = (uint32_t)line->n;
  *hit = (bt__hit){ 0 };
  if (!is_usable (way->work->want, arc, n))
    return 0;
  if (way->around->scene->n == 0 && way->around->movers == 0)
    {
      way->count->skipped_empty++;
      commit (way, x, way->work->want, n);
    }
  else
    t = take_legs (way, x, n, hit);
  for (uint32_t i = 0; i < n; i++)
    u[i] = t < 1 ? u[i] + t * (arc[i] - u[i]) : arc[i];
  return t;
}

/* ---- Creeping ---- */

/* The nodes' shares made even wherever a link would be stretched or turned round: between two
   polylines that do neither a common share does neither.  */
static void
even_shares_out (const bt__polyline *line, const bt__polyline_work *w)
{
  const bt_vec3 *x = bt__polyline_x ((bt__polyline *)line);
  const double *u = bt__polyline_u ((bt__polyline *)line);
  double *s = w->share;
  for (int changed = 1; changed;)
    {
      changed = 0;
      for (int64_t i = 0; i + 1 < line->n; i++)
        {
          bt_vec3 p = bt__axpy (x[i], s[i], bt__sub (w->want[i], x[i]));
          bt_vec3 q = bt__axpy (x[i + 1], s[i + 1], bt__sub (w->want[i + 1], x[i + 1]));
          double du = u[i + 1] + s[i + 1] * (w->arc[i + 1] - u[i + 1]);
          du -= u[i] + s[i] * (w->arc[i] - u[i]);
          if (s[i] == s[i + 1] || (du > 0 && bt__distance (p, q) <= du * (1 + BT__SAME)))
            continue;
          s[i] = s[i + 1] = fmin (s[i], s[i + 1]);
          changed = 1;
        }
    }
}

/* Cut the shares to what the safe step allowed.  */
static void
cut_shares (const bt__way *way, const bt_vec3 *x, uint32_t n)
{
  const bt__polyline_work *w = way->work;
  for (uint32_t i = 0; i < n; i++)
    {
      double asked = bt__distance (x[i], w->leg[i]);
      if (asked > 0)
        w->share[i] *= fmin (1, bt__distance (x[i], w->trial[i]) / asked);
    }
}

int
bt__polyline_creep (bt__polyline *line, const bt__way *way)
{
  const bt__polyline_work *w = way->work;
  bt_vec3 *x = bt__polyline_x (line);
  double *u = bt__polyline_u (line), most = 0;
  uint32_t n = (uint32_t)line->n;
  if (!is_usable (w->want, w->arc, n))
    return 0;
  for (uint32_t i = 0; i < n; i++)
    w->share[i] = fmin (1, BT__STRIDE / fmax (bt__distance (x[i], w->want[i]), BT__STRIDE));
  for (int k = 0; k < HALVINGS; k++)
    {
      even_shares_out (line, w);
      for (uint32_t i = 0; i < n; i++)
        w->leg[i] = bt__axpy (x[i], w->share[i], bt__sub (w->want[i], x[i]));
      if (arrives (way, x, w->leg, n))
        break;
      cut_shares (way, x, n);
      if (k == HALVINGS - 1)
        return 0;
    }
  commit (way, x, w->leg, n);
  for (uint32_t i = 0; i < n; i++)
    {
      u[i] += w->share[i] * (w->arc[i] - u[i]);
      most = fmax (most, w->share[i]);
    }
  return most > 0;
}

void
bt__polyline_nudge (bt__polyline *line, const bt__way *way, int64_t i, bt_vec3 to)
{
  bt_vec3 *x = bt__polyline_x (line), *leg = way->work->leg;
  const double *u = bt__polyline_u (line);
  memcpy (leg, x, (size_t)line->n * sizeof *x);
  for (double t = 1; t > NUDGE; t /= 2)
    {
      leg[i] = bt__axpy (x[i], t, bt__sub (to, x[i]));
      if (bt__distance (leg[i], x[i - 1]) > (u[i] - u[i - 1]) * (1 + STRETCH)
          || bt__distance (leg[i], x[i + 1]) > (u[i + 1] - u[i]) * (1 + STRETCH)
          || !arrives (way, x, leg, (uint32_t)line->n))
        continue;
      commit (way, x, leg, (uint32_t)line->n);
      return;
    }
}
