/* The moving line within a long step: places between the begin and the end of the step.

   The line can be told at any share of a long step.  Places are on the cubic through the places and
   velocities at both ends of the step, velocities are the slopes of the cubic (Hermite; Hairer,
   Norsett, Wanner, Solving Ordinary Differential Equations I, II.6), tensions and stretches go
   straight from one end of the step to the other.  The block at the end of the step knows
   enough: motion and former velocities lead back to the begin of the step.  A line of second
   order in space has no loads of fourth order: tensions at the begin stand in the place of loads.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

void
bt__dynamic_copy (bt__dynamic *to, const bt__dynamic *from)
{
  bt__range range[BT__DYNAMIC_RANGES];
  bt__dynamic_in_use (from->n, (int)from->n_max, range);
  for (int k = 0; k < BT__DYNAMIC_RANGES; k++)
    memcpy ((char *)to + range[k].at, (const char *)from + range[k].at, range[k].size);
}

void
bt__dynamic_reach_back (bt__dynamic *d, const bt__dynamic *begin)
{
  for (int64_t j = 0; j < d->n; j++)
    bt__dynamic_load (d)[j] = bt__vec (bt__dynamic_tension (begin)[j], 0, 0);
}

void
bt__dynamic_forget_back (bt__dynamic *d)
{
  memset (bt__dynamic_load (d), 0, (size_t)(d->n + 1) * sizeof (bt_vec3));
}

/* ---- How good is it? ---- */

double
bt__dynamic_surprise (const bt__dynamic *begin, const bt__dynamic *d)
{
  const bt_vec3 *v = bt__dynamic_v (begin), *vp = bt__dynamic_vp (begin), *dx = bt__dynamic_dx (d);
  double h = d->h, r = h / begin->h, most = 0;
  for (int64_t i = 1; i < d->n; i++)
    {
      bt_vec3 speed = bt__axpy (v[i], 0.5 * r, bt__sub (v[i], vp[i]));
      bt_vec3 off = bt__axpy (dx[i], -h, speed);
      most = fmax (most, bt__dot (off, off));
    }
  double backward = (1 + r) * (1 + r) / (6 * r * (1 + 2 * r)), ahead = 1.0 / 6 + 1 / (4 * r);
  return sqrt (most) * backward / ahead;
}

double
bt__dynamic_tension_bow (const bt__dynamic *begin, const bt__dynamic *d, double ea)
{
  const double *t0 = bt__dynamic_tension (begin), *t1 = bt__dynamic_tension (d),
               *de = bt__dynamic_dstretch (begin);
  double r = d->h / begin->h, most = 0;
  for (int64_t j = 0; j < d->n; j++)
    {
      double rate = t0[j] > 0 ? ea * r * de[j] : 0, off = fabs (t1[j] - t0[j] - rate);
      most = off > most ? off : most;
    }
  return most * r / (4 * (1 + r));
}

double
bt__dynamic_swing (const bt__dynamic *d)
{
  const bt_vec3 *v = bt__dynamic_v (d), *vp = bt__dynamic_vp (d), *dx = bt__dynamic_dx (d);
  double most = 0, rate = 1 / d->h;
  for (int64_t i = 0; i <= d->n; i++)
    most = fmax (most, bt__norm (bt__axpy (v[i], -rate, dx[i]))
                           + bt__norm (bt__axpy (vp[i], -rate, dx[i])));
  return 4.0 / 27 * d->h * most;
}

/* ---- Between ---- */

/* The weights, at the SHARE of a step of H seconds, of the motion of the whole step and of the
   velocities at begin and end: for the way left to go, and for the velocity.  */
typedef struct weights
{
  double left, begin, end;
  double rate, slope_begin, slope_end;
} weights;

static weights
weights_at (double share, double h)
{
  double t = share, u = 1 - share;
  return (weights){ .left = u * u * (1 + 2 * t),
                    .begin = h * t * u * u,
                    .end = -h * t * t * u,
                    .rate = 6 * t * u / h,
                    .slope_begin = u * (1 - 3 * t),
                    .slope_end = t * (1 - 3 * u) };
}

bt_vec3
bt__dynamic_node_between (const bt__dynamic *d, double share, int64_t i)
{
  weights w = weights_at (share, d->h);
  bt_vec3 x = bt__axpy (bt__dynamic_x (d)[i], -w.left, bt__dynamic_dx (d)[i]);
  return bt__axpy (bt__axpy (x, w.begin, bt__dynamic_vp (d)[i]), w.end, bt__dynamic_v (d)[i]);
}

static void
move_between (const bt__dynamic *d, double share, bt__dynamic *out)
{
  const bt_vec3 *x = bt__dynamic_x (d), *v = bt__dynamic_v (d), *vp = bt__dynamic_vp (d),
                *dx = bt__dynamic_dx (d);
  bt_vec3 *at = bt__dynamic_x (out), *speed = bt__dynamic_v (out);
  weights w = weights_at (share, d->h);
  for (int64_t i = 0; i <= d->n; i++)
    {
      bt_vec3 p = bt__axpy (x[i], -w.left, dx[i]);
      at[i] = bt__axpy (bt__axpy (p, w.begin, vp[i]), w.end, v[i]);
      speed[i] = bt__axpy (bt__axpy (bt__scale (w.rate, dx[i]), w.slope_begin, vp[i]), w.slope_end,
                           v[i]);
    }
}

void
bt__dynamic_lead_ends (bt__dynamic *d, const bt_vec3 end[2])
{
  bt_vec3 *x = bt__dynamic_x (d);
  bt_vec3 first = bt__sub (end[0], x[0]), last = bt__sub (end[1], x[d->n]);
  for (int64_t i = 0; i <= d->n; i++)
    {
      double share = (double)i / (double)d->n;
      x[i] = bt__axpy (bt__axpy (x[i], 1 - share, first), share, last);
    }
  x[0] = end[0];
  x[d->n] = end[1];
}

void
bt__dynamic_between (const bt__dynamic *d, double share, bt__dynamic *out)
{
  size_t intervals = (size_t)d->n * sizeof (double);
  *out = *d;
  move_between (d, share, out);
  bt__dynamic_forget_back (out);
  memcpy (bt__dynamic_chord (out), bt__dynamic_chord (d), (size_t)d->n * sizeof (bt_vec3));
  memcpy (bt__dynamic_rest (out), bt__dynamic_rest (d), intervals);
  for (int64_t j = 0; j < d->n; j++)
    {
      double begun = bt__dynamic_load (d)[j].x, change = bt__dynamic_dstretch (d)[j];
      bt__dynamic_tension (out)[j] = begun + share * (bt__dynamic_tension (d)[j] - begun);
      bt__dynamic_stretch (out)[j] = bt__dynamic_stretch (d)[j] - (1 - share) * change;
    }
}

void
bt__dynamic_resume (const bt__dynamic *d, double before, double share, bt__dynamic *out)
{
  size_t nodes = (size_t)(d->n + 1) * sizeof (bt_vec3);
  double part = share - before;
  *out = *d; /* OUT may be blank: its arrays have no place before */
  move_between (d, before, out);
  bt_vec3 *dx = bt__dynamic_dx (out);
  memcpy (dx, bt__dynamic_x (out), nodes);
  memcpy (bt__dynamic_vp (out), bt__dynamic_v (out), nodes);
  bt__dynamic_between (d, share, out);
  for (int64_t i = 0; i <= d->n; i++)
    dx[i] = bt__sub (bt__dynamic_x (out)[i], dx[i]);
  for (int64_t j = 0; j < d->n; j++)
    bt__dynamic_dstretch (out)[j] = part * bt__dynamic_dstretch (d)[j];
  out->h = part * d->h;
  out->most = out->left = 0;
}
