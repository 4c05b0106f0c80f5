/* The moving line: the block, its life and one step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "tether/dynamic_kernel.h"

#define HISTORY_RATIO 2.4 /* steps may grow by less than 1 + sqrt (2), else backward Euler */
#define OWED_TIME 0.5     /* s in which the winch pays what it owes */
#define LEAST_REST 0.05   /* of a piece: the shortest an interval is hauled to */
#define DEFAULT_TOLERANCE 1e-5

/* ---- The block ---- */

enum
{
  NODE_ARRAYS = 5,     /* x, v, dx, vp, load */
  INTERVAL_ARRAYS = 4, /* tension, rest, stretch, dstretch; and chord, of vectors */
  VECTOR = sizeof (bt_vec3) / sizeof (double)
};

static size_t
node_size (int64_t n_max)
{
  return (size_t)(n_max + 1) * VECTOR;
}

size_t
bt__dynamic_size (int n_max)
{
  size_t doubles = NODE_ARRAYS * node_size (n_max) + (size_t)n_max * (INTERVAL_ARRAYS + VECTOR);
  return sizeof (bt__dynamic) + doubles * sizeof (double);
}

static bt_vec3 *
node_array (const bt__dynamic *d, int k)
{
  return (bt_vec3 *)((double *)(d + 1) + (size_t)k * node_size (d->n_max));
}

static double *
interval_array (const bt__dynamic *d, int k)
{
  return (double *)(d + 1) + NODE_ARRAYS * node_size (d->n_max) + (size_t)(k * d->n_max);
}

bt_vec3 *
bt__dynamic_x (const bt__dynamic *d)
{
  return node_array (d, 0);
}

bt_vec3 *
bt__dynamic_v (const bt__dynamic *d)
{
  return node_array (d, 1);
}

bt_vec3 *
bt__dynamic_dx (const bt__dynamic *d)
{
  return node_array (d, 2);
}

bt_vec3 *
bt__dynamic_vp (const bt__dynamic *d)
{
  return node_array (d, 3);
}

bt_vec3 *
bt__dynamic_load (const bt__dynamic *d)
{
  return node_array (d, 4);
}

double *
bt__dynamic_tension (const bt__dynamic *d)
{
  return interval_array (d, 0);
}

double *
bt__dynamic_rest (const bt__dynamic *d)
{
  return interval_array (d, 1);
}

double *
bt__dynamic_stretch (const bt__dynamic *d)
{
  return interval_array (d, 2);
}

double *
bt__dynamic_dstretch (const bt__dynamic *d)
{
  return interval_array (d, 3);
}

bt_vec3 *
bt__dynamic_chord (const bt__dynamic *d)
{
  return (bt_vec3 *)interval_array (d, INTERVAL_ARRAYS);
}

/* Lay N + 1 points X evenly along SHAPE.  */
static void
resample (const bt_vec3 *shape, int m, double length, int n, bt_vec3 *x)
{
  double behind = 0, piece = bt__distance (shape[0], shape[1]);
  for (int i = 0, k = 0; i <= n; i++)
    {
      double s = length * i / n;
      while (k < m - 2 && behind + piece < s)
        {
          behind += piece;
          k++;
          piece = bt__distance (shape[k], shape[k + 1]);
        }
      double u = piece > 0 ? fmin ((s - behind) / piece, 1) : 0;
      x[i] = bt__axpy (bt__scale (1 - u, shape[k]), u, shape[k + 1]);
    }
  x[n] = shape[m - 1];
}

static bt_status
check_shape (int n_max, int n, const bt_vec3 *shape, int m, double length, bt_error *error)
{
  if (n < 1 || n > n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the line has room for 1 to %d", n, n_max);
  if (!(length > 0 && isfinite (length)))
    return bt__fail (error, BT_ERR_DOMAIN, "a line of %g m; its length must be positive", length);
  if (m < 2)
    return bt__fail (error, BT_ERR_DOMAIN, "a line laid along %d points; it takes two", m);
  for (int i = 0; i < m; i++)
    if (!bt__is_finite (shape[i]))
      return bt__fail (error, BT_ERR_DOMAIN, "point %d of the line is not at a finite place", i);
  return BT_OK;
}

bt_status
bt__dynamic_init (bt__dynamic *d, int n_max, int n, const bt_vec3 *shape, int m, double length,
                  double ea, bt_error *error)
{
  bt_status status = check_shape (n_max, n, shape, m, length, error);
  if (status)
    return status;
  memset (d, 0, bt__dynamic_size (n_max));
  d->n = n;
  d->n_max = n_max;
  d->piece = length / n;
  double along = 0;
  for (int i = 0; i + 1 < m; i++)
    along += bt__distance (shape[i], shape[i + 1]);
  bt_vec3 *x = bt__dynamic_x (d);
  if (m == n + 1)
    memcpy (x, shape, (size_t)m * sizeof *x);
  else
    resample (shape, m, along, n, x);
  for (int j = 0; j < n; j++)
    {
      double e = bt__distance (x[j], x[j + 1]) / d->piece;
      bt__dynamic_rest (d)[j] = d->piece;
      bt__dynamic_stretch (d)[j] = e;
      bt__dynamic_tension (d)[j] = e > 1 && isfinite (ea) ? ea * (e - 1) : 0;
    }
  return BT_OK;
}

void
bt__dynamic_still (bt__dynamic *d)
{
  size_t size = (size_t)(d->n + 1) * sizeof (bt_vec3);
  memset (bt__dynamic_v (d), 0, size);
  memset (bt__dynamic_dx (d), 0, size);
  memset (bt__dynamic_vp (d), 0, size);
  memset (bt__dynamic_dstretch (d), 0, (size_t)d->n * sizeof (double));
  d->history = 0;
}

double
bt__dynamic_length (const bt__dynamic *d)
{
  double sum = d->owed;
  for (int j = 0; j < d->n; j++)
    sum += bt__dynamic_rest (d)[j];
  return sum;
}

/* ---- The workspace ---- */

void
bt__dynamic_work_free (bt__dynamic_work *w)
{
  if (!w)
    return;
  void *arrays[] = { w->X,    w->d,   w->rhs, w->keep, w->lam,  w->link,      w->node,    w->extra,
                     w->diag, w->off, w->up,  w->up2,  w->bend, w->bend_diag, w->bend_off, w->bend_far };
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
    free (arrays[i]);
  free (w);
}

bt__dynamic_work *
bt__dynamic_work_new (int n_max)
{
  if (n_max < 1)
    return NULL;
  size_t n = (size_t)n_max + 3; /* bending has a row for each clamp too */
  bt__dynamic_work *w = calloc (1, sizeof *w);
  if (!w)
    return NULL;
  w->n_max = n_max;
  int whole = (w->X = calloc (n, sizeof *w->X)) && (w->d = calloc (n, sizeof *w->d))
              && (w->rhs = calloc (n, sizeof *w->rhs)) && (w->keep = calloc (n, sizeof *w->keep))
              && (w->lam = calloc (n, sizeof *w->lam)) && (w->link = calloc (n, sizeof *w->link))
              && (w->node = calloc (n, sizeof *w->node))
              && (w->extra = calloc (n, sizeof *w->extra))
              && (w->diag = calloc (n, sizeof *w->diag)) && (w->off = calloc (n, sizeof *w->off))
              && (w->up = calloc (n, sizeof *w->up)) && (w->up2 = calloc (n, sizeof *w->up2))
              && (w->bend = calloc (n, sizeof *w->bend))
              && (w->bend_diag = calloc (n, sizeof *w->bend_diag))
              && (w->bend_off = calloc (n, sizeof *w->bend_off))
              && (w->bend_far = calloc (n, sizeof *w->bend_far));
  if (whole)
    return w;
  bt__dynamic_work_free (w);
  return NULL;
}

/* ---- A step ---- */

static bt_status
check_input (const bt__dynamic *d, const bt__dynamic_work *w, const bt__dynamic_input *in,
             bt_error *error)
{
  const bt_tether_props *p = in->line;
  if (d->n < 1 || d->n > w->n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the workspace holds 1 to %d", (int)d->n,
                     w->n_max);
  if (!(in->h > 0 && isfinite (in->h)))
    return bt__fail (error, BT_ERR_DOMAIN, "a step of %g s; it must be positive and finite", in->h);
  if (!(p->mass > 0 && isfinite (p->mass) && p->ea > 0 && p->ei >= 0 && isfinite (p->ei)
        && p->ba >= 0 && isfinite (p->ba) && p->diameter >= 0 && isfinite (p->diameter)
        && isfinite (p->wet_weight) && p->cdn >= 0 && p->cdt >= 0 && p->ca >= 0))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "the line has mass %g kg/m, EA %g N, EI %g N m2, damping %g N s, diameter %g m;"
                     " mass and EA must be positive, nothing negative",
                     p->mass, p->ea, p->ei, p->ba, p->diameter);
  for (int k = 0; k < 2; k++)
    if (!in->end[k].free && !bt__is_finite (in->end[k].at))
      return bt__fail (error, BT_ERR_DOMAIN, "end %d of the line is not at a finite place", k);
  if (!isfinite (in->pay))
    return bt__fail (error, BT_ERR_DOMAIN, "the winch pays out %g m/s; it must be finite", in->pay);
  return BT_OK;
}

/* Return the rest length of the first interval at the end of the step; *OWED what is then left.  */
static double
wind_first (const bt__dynamic *d, const bt__dynamic_input *in, double *owed)
{
  double rest = bt__dynamic_rest (d)[0], part = d->owed * fmin (1, in->h / OWED_TIME);
  double next = fmax (rest + in->pay * in->h + part, fmin (rest, LEAST_REST * d->piece));
  *owed = d->owed - part;
  return next;
}

/* Say what is not finite in the solution.  */
static bt_status
refuse (const bt__dynamic_work *w, bt_error *error)
{
  const char *what = "motion";
  int at = 0;
  for (int i = w->n; i >= 0; i--)
    {
      const char *is = !bt__is_finite (w->node[i].current)                        ? "current"
                       : !bt__is_finite (w->X[i])                                 ? "position"
                       : i >= w->lo && i <= w->hi && !bt__is_finite (w->rhs[i]) ? "force"
                                                                                  : NULL;
      at = is ? i : at;
      what = is ? is : what;
    }
  return bt__fail (error, BT_ERR_DIVERGED, "the %s at node %d of the line is not finite at %g s", what,
                   at, w->in->water->time);
}

/* Velocities of the solution, to SPEED; note the fastest node and the tightest bend.  */
static int
judge (const bt__dynamic_work *w, const bt_vec3 *pull, bt_vec3 *speed, bt__dynamic_report *report)
{
  double fastest = 0, hardest = 0, bend = 0, sum = 0;
  for (int i = 0; i <= w->n; i++)
    {
      bt_vec3 v = bt__node_v (w, i), a = bt__node_a (w, i, v);
      double vv = bt__dot (v, v), aa = bt__dot (a, a);
      speed[i] = v;
      sum += vv + aa;
      fastest = vv > fastest ? vv : fastest;
      hardest = aa > hardest ? aa : hardest;
      if (i == 0 || i == w->n)
        continue;
      bt_vec3 turn = bt__sub (w->link[i].t, w->link[i - 1].t);
      double k = bt__dot (turn, turn);
      if (k > bend * w->node[i].cell * w->node[i].cell)
        {
          bend = k / (w->node[i].cell * w->node[i].cell);
          report->bend_at = i;
        }
    }
  report->speed = sqrt (fastest);
  report->acceleration = sqrt (hardest);
  report->bend_radius = bend > 0 ? 1 / sqrt (bend) : HUGE_VAL;
  return isfinite (sum) && bt__is_finite (pull[0]) && bt__is_finite (pull[1]);
}

/* Take the solution over, its velocities in SPEED.  */
static void
commit_nodes (bt__dynamic *d, const bt__dynamic_work *w, const bt_vec3 *speed)
{
  bt_vec3 *x = bt__dynamic_x (d), *v = bt__dynamic_v (d), *dx = bt__dynamic_dx (d),
          *vp = bt__dynamic_vp (d);
  for (int i = 0; i <= w->n; i++)
    {
      dx[i] = bt__sub (w->X[i], x[i]);
      x[i] = w->X[i];
      vp[i] = v[i];
      v[i] = speed[i];
    }
}

static void
commit_links (bt__dynamic *d, const bt__dynamic_work *w, bt__dynamic_report *report)
{
  double *e = bt__dynamic_stretch (d), *de = bt__dynamic_dstretch (d);
  const bt_vec3 *x = bt__dynamic_x (d);
  for (int j = 0; j < w->n; j++)
    {
      bt_vec3 c = bt__sub (x[j + 1], x[j]);
      if (w->chord)
        c = bt__add (c, w->chord[j]);
      double next = bt__norm (c) / w->link[j].rest;
      de[j] = next - e[j];
      e[j] = next;
      bt__dynamic_tension (d)[j] = w->lam[j];
      if (w->lam[j] > report->tension)
        {
          report->tension = w->lam[j];
          report->at = j;
        }
    }
  bt__dynamic_rest (d)[0] = w->link[0].rest;
}

static bt_status
commit (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in,
        bt__dynamic_report *report, bt_error *error)
{
  bt_vec3 pull[2] = { bt__dynamic_end_pull (w, 0), bt__dynamic_end_pull (w, 1) };
  if (!judge (w, pull, w->keep, report) || !isfinite (report->update))
    return refuse (w, error);
  d->pull[0] = pull[0];
  d->pull[1] = pull[1];
  if (in->order == 4)
    bt__dynamic_correct (d, w);
  commit_nodes (d, w, w->keep);
  commit_links (d, w, report);
  d->h = in->h;
  d->history = report->converged;
  return BT_OK;
}

bt_status
bt__dynamic_step (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in,
                  bt__dynamic_report *report, bt_error *error)
{
  double owed;
  *report = (bt__dynamic_report){ .bend_radius = HUGE_VAL };
  bt_status status = check_input (d, w, in, error);
  if (status)
    return status;
  w->tolerance = (in->tolerance > 0 ? in->tolerance : DEFAULT_TOLERANCE) * bt__dynamic_length (d);
  double rest0 = wind_first (d, in, &owed), r = d->history ? in->h / d->h : 0;
  if (r > HISTORY_RATIO)
    r = 0;
  w->b0 = (1 + 2 * r) / ((1 + r) * in->h);
  w->b2 = r * r / ((1 + r) * in->h);
  w->b1 = -(w->b0 + w->b2);
  bt__dynamic_prepare (w, d, in, rest0);
  report->converged = bt__dynamic_newton (w, report);
  status = commit (d, w, in, report, error);
  if (status)
    return status;
  d->owed = owed;
  if (in->pay != 0 || owed != 0)
    bt__dynamic_wind (d);
  return BT_OK;
}
