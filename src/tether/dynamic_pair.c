/* The moving line: two of its places that push each other apart.

   A contact K between places u and v of one line adds K (u - v) to the equation of u, and the
   negative to the equation of v, and so couples nodes that are not neighbours.  The blocks of the
   line take up 2 K at either place instead, an upper bound because

     (u - v) K (u - v) <= 2 u K u + 2 v K v,

   and keep their form.  The excess, K (u + v) at both places, is taken back by conjugate gradients:
   an iteration is a solution of the blocks, and a crossing needs one or two.  Left in, the excess
   would not spoil the solution of the step, but two places moving together would be slow, as if
   heavy.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

enum
{
  ITERATIONS = 6
};

/* Of the square of the first residual: the step's own iterations do the rest.  */
#define ENOUGH 1e-3

/* ---- Blocks ---- */

static void
add_at (bt__dynamic_work *w, int64_t i, double s, const bt__sym *k, bt_vec3 f)
{
  double a = 1 - s;
  bt__sym_axpy (w->diag + i, 2 * a * a, k);
  bt__sym_axpy (w->diag + i + 1, 2 * s * s, k);
  bt__sym_axpy (w->off + i, -2 * a * s, k);
  w->rhs[i] = bt__axpy (w->rhs[i], a, f);
  w->rhs[i + 1] = bt__axpy (w->rhs[i + 1], s, f);
}

void
bt__dynamic_pair_add (bt__dynamic_work *w, bt__constraint *r, const bt__sym *k)
{
  memcpy (r->block, k, sizeof r->block);
  add_at (w, r->node, r->s, k, r->force);
  add_at (w, r->pair - 1, r->t, k, bt__scale (-1, r->force));
  w->pairs += r->active > 0 || r->load > 0;
}

/* ---- The solution ---- */

static void
take_from (bt_vec3 *q, int64_t i, double s, bt_vec3 f)
{
  q[i] = bt__axpy (q[i], s - 1, f);
  q[i + 1] = bt__axpy (q[i + 1], -s, f);
}

void
bt__dynamic_pair_take_back (const bt__dynamic_work *w, const bt_vec3 *p, bt_vec3 *q)
{
  for (int k = 0; k < w->rows; k++)
    {
      const bt__constraint *r = w->row + k;
      bt__sym block;
      if (r->pair == 0)
        continue;
      memcpy (&block, r->block, sizeof block);
      bt_vec3 both = bt__add (bt__between (p + r->node, r->s), bt__between (p + r->pair - 1, r->t));
      bt_vec3 f = bt__sym_apply (&block, both);
      take_from (q, r->node, r->s, f);
      take_from (q, r->pair - 1, r->t, f);
    }
}

double
bt__dynamic_product (const bt__dynamic_work *w, const bt_vec3 *a, const bt_vec3 *b)
{
  double sum = 0;
  for (int i = w->lo; i <= w->hi; i++)
    sum += bt__dot (a[i], b[i]);
  return sum;
}

void
bt__dynamic_sum (const bt__dynamic_work *w, bt_vec3 *to, const bt_vec3 *a, double share,
                 const bt_vec3 *b)
{
  for (int i = w->lo; i <= w->hi; i++)
    to[i] = bt__axpy (a[i], share, b[i]);
}

/* Refine X, the solution of the blocks for the right-hand side R, to that of the equations; R is
   spent.  In the notation of conjugate gradients: SUM is the solution so far, P the direction, MP
   the blocks times the direction.  */
static void
refine (bt__dynamic_work *w, bt_vec3 *r, bt_vec3 *x)
{
  size_t nodes = (size_t)w->n + 1, size = nodes * sizeof *x;
  bt_vec3 *sum = w->whole, *p = w->spare, *mp = w->crowd, *q = mp + nodes;
  double rz = bt__dynamic_product (w, r, x), enough = ENOUGH * rz;
  memset (sum, 0, size);
  memcpy (p, x, size);
  memcpy (mp, r, size);
  for (int i = 0; i < ITERATIONS; i++)
    {
      memcpy (q, mp, size);
      bt__dynamic_pair_take_back (w, p, q);
      double curve = bt__dynamic_product (w, p, q);
      if (!(curve > 0))
        break;
      bt__dynamic_sum (w, sum, sum, rz / curve, p);
      bt__dynamic_sum (w, r, r, -rz / curve, q);
      if (i + 1 == ITERATIONS)
        break;
      memcpy (x, r, size);
      bt__dynamic_solve_again (w, x);
      double next = bt__dynamic_product (w, r, x);
      if (!(next > enough))
        break;
      bt__dynamic_sum (w, p, x, next / rz, p);
      bt__dynamic_sum (w, mp, r, next / rz, mp);
      rz = next;
    }
  memcpy (x, sum, size);
}

double
bt__dynamic_pair_solve (bt__dynamic_work *w)
{
  double most = bt__dynamic_solve_blocks (w);
  if (w->lo > w->hi || !isfinite (most) || w->pairs == 0)
    return most;
  refine (w, w->rhs, w->d);
  return bt__dynamic_largest (w);
}
