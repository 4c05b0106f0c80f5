/* The step within the planes: a quadratic programme, block-tridiagonal.

   Minimise half the sum of w_i |x_i+1 - x_i|^2 + prox |x - x_old|^2 + stiff (soft - n . x)^2, with
   the last term over the violated sides: a penalty method with an active set.  Each iteration
   eliminates anew from the first node whose active sides changed.  Afterwards a projection removes
   the violation left by the finite stiffness, and a step length towards the old place, which obeys
   all sides, removes the violation left by the projection.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "aware/taut_job.h"

enum
{
  SOLVES = 8,
  SWEEPS = 12
};

#define STIFF 1e4 /* over the mean link length */

/* The first of the sides of node J, up to t->first[j + 1] - 1; a mutant of the tests has another.
 */
#ifndef BT__FIRST_SIDE
#define BT__FIRST_SIDE(t, j) ((t)->first[(j)-1])
#endif

/* ---- Symmetric blocks ---- */

static bt_vec3
block_times (const bt__block *m, bt_vec3 v)
{
  return bt__vec (m->xx * v.x + m->xy * v.y + m->xz * v.z, m->xy * v.x + m->yy * v.y + m->yz * v.z,
                  m->xz * v.x + m->yz * v.y + m->zz * v.z);
}

static bt__block
inverse_of (const bt__block *m)
{
  double a = m->yy * m->zz - m->yz * m->yz, b = m->xz * m->yz - m->xy * m->zz;
  double c = m->xy * m->yz - m->xz * m->yy;
  double d = 1 / (m->xx * a + m->xy * b + m->xz * c);
  return (bt__block){ d * a,
                      d * b,
                      d * c,
                      d * (m->xx * m->zz - m->xz * m->xz),
                      d * (m->xy * m->xz - m->xx * m->yz),
                      d * (m->xx * m->yy - m->xy * m->xy) };
}

static void
add_outer_product (bt__block *m, double k, bt_vec3 n)
{
  m->xx += k * n.x * n.x;
  m->xy += k * n.x * n.y;
  m->xz += k * n.x * n.z;
  m->yy += k * n.y * n.y;
  m->yz += k * n.y * n.z;
  m->zz += k * n.z * n.z;
}

/* ---- Sides of a node ---- */

/* Node J obeys the sides of the link before the node, as end B, and of the link after, as end A.
 */
static inline uint8_t
ends_of_link (const bt__taut *t, uint32_t j, uint32_t k)
{
  return k < t->first[j] ? BT__ACTIVE_B : BT__ACTIVE_A;
}

/* Set which sides push at node J when it is at X; return true if that changed.  */
static int
set_active (bt__taut *t, uint32_t j, bt_vec3 x, double slack)
{
  int changed = 0;
  for (uint32_t k = BT__FIRST_SIDE (t, j); k < t->first[j + 1]; k++)
    {
      uint8_t place = ends_of_link (t, j, k);
      uint8_t is = bt__dot (t->side[k].normal, x) < t->side[k].soft + slack ? place : 0;
      changed |= (t->active[k] & place) != is;
      t->active[k] = (uint8_t)((t->active[k] & ~place) | is);
    }
  return changed;
}

/* ---- Elimination ---- */

static void
weigh_links (bt__taut *t, const bt__string *s, double mean)
{
  for (uint32_t i = 0; i + 1 < s->n; i++)
    t->weight[i] = 1 / fmax (bt__distance (s->x[i], s->x[i + 1]), 0.05 * mean);
}

static void
eliminate_string (bt__taut *t, const bt__string *s, double prox, double stiff, uint32_t from)
{
  for (uint32_t j = from; j + 1 < s->n; j++)
    {
      double w = t->weight[j - 1], d = w + t->weight[j] + prox;
      bt__block m = { d, 0, 0, d, 0, d };
      bt_vec3 r = bt__scale (prox, s->x[j]);
      for (uint32_t k = BT__FIRST_SIDE (t, j); k < t->first[j + 1]; k++)
        if (t->active[k] & ends_of_link (t, j, k))
          {
            add_outer_product (&m, stiff, t->side[k].normal);
            r = bt__axpy (r, stiff * t->side[k].soft, t->side[k].normal);
          }
      if (j == 1)
        r = bt__axpy (r, w, s->x[0]);
      else
        {
          const bt__block *u = t->inverse + j - 1;
          r = bt__axpy (r, w, block_times (u, t->right[j - 1]));
          m.xx -= w * w * u->xx;
          m.xy -= w * w * u->xy;
          m.xz -= w * w * u->xz;
          m.yy -= w * w * u->yy;
          m.yz -= w * w * u->yz;
          m.zz -= w * w * u->zz;
        }
      t->inverse[j] = inverse_of (&m);
      t->right[j] = r;
    }
}

static void
substitute_back (bt__taut *t, const bt__string *s)
{
  t->y[0] = s->x[0];
  t->y[s->n - 1] = s->x[s->n - 1];
  for (uint32_t j = s->n - 2; j > 0; j--)
    t->y[j] = block_times (t->inverse + j, bt__axpy (t->right[j], t->weight[j], t->y[j + 1]));
}

void
bt__taut_solve (bt__taut *t, const bt__string *s, double prox)
{
  double mean = bt__length (s->x, s->n) / (s->n - 1), stiff = STIFF / mean;
  uint32_t from = 1;
  weigh_links (t, s, mean);
  for (uint32_t k = 0; k < t->first[s->n - 1]; k++)
    t->active[k] = 0;
  for (uint32_t j = 1; j + 1 < s->n; j++)
    set_active (t, j, s->x[j], 1e-5 * mean);
  for (int pass = 0; pass < SOLVES && from < s->n; pass++)
    {
      eliminate_string (t, s, prox, stiff, from);
      substitute_back (t, s);
      from = s->n;
      for (uint32_t j = s->n - 2; j > 0; j--)
        if (set_active (t, j, t->y[j], 0))
          from = j;
    }
}

/* ---- Obeying ---- */

/* The side of node J that X respects least, by which measure; -1 if it respects all.  */
static int
least_respected (const bt__taut *t, uint32_t j, bt_vec3 x, double *lack)
{
  int worst = -1;
  *lack = 0;
  for (uint32_t k = BT__FIRST_SIDE (t, j); k < t->first[j + 1]; k++)
    {
      double by = t->side[k].hard - bt__dot (t->side[k].normal, x);
      if (by > *lack)
        {
          *lack = by;
          worst = (int)k;
        }
    }
  return worst;
}

static bt_vec3
project (const bt__taut *t, uint32_t j, bt_vec3 x)
{
  double lack;
  for (int sweep = 0; sweep < SWEEPS; sweep++)
    {
      int k = least_respected (t, j, x, &lack);
      if (k < 0)
        break;
      x = bt__axpy (x, lack + 1e-15, t->side[k].normal);
    }
  return x;
}

/* The greatest share of D by which X, a point that obeys all sides, may move and still obey.  */
static double
share_that_obeys (const bt__taut *t, uint32_t j, bt_vec3 x, bt_vec3 d)
{
  double share = 1;
  for (uint32_t k = BT__FIRST_SIDE (t, j); k < t->first[j + 1]; k++)
    {
      double slope = bt__dot (t->side[k].normal, d);
      double gap = bt__dot (t->side[k].normal, x) - t->side[k].hard;
      if (slope < 0 && gap + share * slope < 0)
        share = fmax (gap, 0) / -slope;
    }
  return share;
}

void
bt__taut_obey (bt__taut *t, const bt__string *s)
{
  for (uint32_t j = 1; j + 1 < s->n; j++)
    {
      bt_vec3 d = bt__sub (project (t, j, t->y[j]), s->x[j]);
      double size = bt__norm (d);
      if (!isfinite (size))
        d = bt__vec (0, 0, 0);
      else if (size > t->most[j])
        d = bt__scale (t->most[j] / size, d);
      t->y[j] = bt__axpy (s->x[j], share_that_obeys (t, j, s->x[j], d), d);
    }
}
