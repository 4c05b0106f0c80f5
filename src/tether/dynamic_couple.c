/* The moving line: the linear solve in which friction follows the loads.

   The quick way lags: friction takes the load of the iterate before, so that all blocks are
   symmetric.  Where a line is wound about something with much friction the load of every place
   depends on the tension, and the tension on the friction of the places before: the lagged
   iteration then runs about in a circle.  Here what friction gains with the load stands in the
   equations (the consistent tangent of Coulomb's law: P. Wriggers, Computational Contact Mechanics,
   2nd edition, chapter 9).  A row adds to the blocks of its two nodes the product of two vectors,
   and the matrix, no longer symmetric, is solved as a band.

   Rows of two places couple nodes that are not neighbours.  Their symmetric part is in the blocks
   with an excess, as dynamic_pair.c says; the excess is taken back, and what their friction gains
   is added, by BiCGSTAB with the band as preconditioner on the right (H. A. van der Vorst, SIAM J.
   Sci. Stat. Comput. 13, 1992, 631).  As a product of the matrix of the band with what it solved
   for is known, no other product is needed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "math/band.h"
#include "tether/dynamic_kernel.h"

enum
{
  TURNS = 3 /* of BiCGSTAB at most: Newton's iterations do the rest */
};

#define LITTLE 1e-6 /* of the square of the right-hand side: a residual that is solved */

/* ---- The band ---- */

static void
put_block (double *b, int i, int j, double m[3][3])
{
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      *bt__band_at (b, 3 * i + r, 3 * j + c) += m[r][c];
}

/* SIGN times A, and K on the diagonal, between nodes I and J.  */
static void
put_sym (double *b, int i, int j, double sign, const bt__sym *a, double k)
{
  double m[3][3] = { { sign * a->xx + k, sign * a->xy, sign * a->xz },
                     { sign * a->xy, sign * a->yy + k, sign * a->yz },
                     { sign * a->xz, sign * a->yz, sign * a->zz + k } };
  put_block (b, i, j, m);
}

static void
put_blocks (const bt__dynamic_work *w, double *b)
{
  static const bt__sym none = { 0 };
  int stiff = w->bends > 0, lo = w->lo;
  for (int i = lo; i <= w->hi; i++)
    {
      put_sym (b, i - lo, i - lo, 1, w->diag + i, stiff ? w->bend_diag[i] : 0);
      for (int k = 0; i < w->hi && k < 2; k++)
        put_sym (b, i - lo + k, i - lo + 1 - k, -1, w->off + i, stiff ? w->bend_off[i] : 0);
      for (int k = 0; stiff && i + 2 <= w->hi && k < 2; k++)
        put_sym (b, i - lo + 2 * k, i - lo + 2 - 2 * k, 1, &none, w->bend_far[i]);
    }
}

/* The force that friction of R gains by a newton of load.  */
static bt_vec3
gain_of (const bt__constraint *r)
{
  return bt__scale (-r->friction / fmax (bt__norm (r->drag), r->slip), r->drag);
}

static int
bears (const bt__constraint *r)
{
  return r->active > 0 && r->load > 0;
}

/* What friction of R gains with the load, at the nodes of its one place.  */
static void
put_gain (const bt__dynamic_work *w, double *b, const bt__constraint *r)
{
  bt_vec3 u = gain_of (r), v = bt__scale (r->stiffness, r->normal);
  double m[3][3] = { { u.x * v.x, u.x * v.y, u.x * v.z },
                     { u.y * v.x, u.y * v.y, u.y * v.z },
                     { u.z * v.x, u.z * v.y, u.z * v.z } };
  const double share[2] = { 1 - r->s, r->s };
  for (int p = 0; p < 2; p++)
    for (int q = 0; q < 2; q++)
      {
        int i = (int)r->node + p, j = (int)r->node + q;
        double part[3][3], k = share[p] * share[q];
        for (int e = 0; e < 9; e++)
          part[e / 3][e % 3] = k * m[e / 3][e % 3];
        if (i >= w->lo && i <= w->hi && j >= w->lo && j <= w->hi)
          put_block (b, i - w->lo, j - w->lo, part);
      }
}

static void
make_band (bt__dynamic_work *w)
{
  int rows = 3 * (w->hi - w->lo + 1);
  double *b = (double *)w->by_flow;
  memset (b, 0, (size_t)rows * BT__BAND_HEIGHT * sizeof *b);
  put_blocks (w, b);
  for (int k = 0; k < w->rows; k++)
    if (w->row[k].pair == 0 && bears (w->row + k))
      put_gain (w, b, w->row + k);
  bt__band_factorize (b, rows, w->exchanged);
}

/* TO = what the band makes of the right-hand side FROM.  */
static void
solve_with_band (const bt__dynamic_work *w, const bt_vec3 *from, bt_vec3 *to)
{
  int nodes = w->hi - w->lo + 1;
  memcpy (to + w->lo, from + w->lo, (size_t)nodes * sizeof *to);
  bt__band_solve ((const double *)w->by_flow, 3 * nodes, w->exchanged, (double *)(to + w->lo));
}

/* ---- Pairs ---- */

static void
add_pair_gains (const bt__dynamic_work *w, const bt_vec3 *p, bt_vec3 *q)
{
  for (int k = 0; k < w->rows; k++)
    {
      const bt__constraint *r = w->row + k;
      if (r->pair == 0 || !bears (r))
        continue;
      const int64_t node[4] = { r->node, r->node + 1, r->pair - 1, r->pair };
      const double share[4] = { 1 - r->s, r->s, r->t - 1, -r->t };
      double rise = 0;
      for (int i = 0; i < 4; i++)
        rise += share[i] * bt__dot (r->normal, p[node[i]]);
      bt_vec3 f = bt__scale (r->stiffness * rise, gain_of (r));
      for (int i = 0; i < 4; i++)
        q[node[i]] = bt__axpy (q[node[i]], share[i], f);
    }
}

/* Q = the whole matrix times what the band makes of Y, which is left in P.  */
static void
multiply (const bt__dynamic_work *w, const bt_vec3 *y, bt_vec3 *p, bt_vec3 *q)
{
  solve_with_band (w, y, p);
  memcpy (q, y, (size_t)(w->n + 1) * sizeof *q);
  bt__dynamic_pair_take_back (w, p, q);
  add_pair_gains (w, p, q);
}

/* BiCGSTAB in the notation of van der Vorst; the shadow residual is the right-hand side.  */
static void
solve_with_pairs (bt__dynamic_work *w)
{
  size_t nodes = (size_t)w->n + 1;
  bt_vec3 *r = (bt_vec3 *)w->up, *p = r + nodes, *v = p + nodes, *ph = v + nodes, *sh = ph + nodes,
          *t = sh + nodes;
  double rho = bt__dynamic_product (w, w->rhs, w->rhs), enough = LITTLE * rho;
  memset (w->up, 0, 6 * nodes * sizeof *r);
  memcpy (r, w->rhs, nodes * sizeof *r);
  memcpy (p, r, nodes * sizeof *r);
  for (int turn = 0; turn < TURNS; turn++)
    {
      multiply (w, p, ph, v);
      double alpha = rho / bt__dynamic_product (w, w->rhs, v);
      bt__dynamic_sum (w, w->d, w->d, alpha, ph);
      bt__dynamic_sum (w, r, r, -alpha, v);
      multiply (w, r, sh, t);
      double size = bt__dynamic_product (w, t, t),
             omega = size > 0 ? bt__dynamic_product (w, t, r) / size : 0;
      bt__dynamic_sum (w, w->d, w->d, omega, sh);
      bt__dynamic_sum (w, r, r, -omega, t);
      double next = bt__dynamic_product (w, w->rhs, r);
      if (!(bt__dynamic_product (w, r, r) > enough) || next == 0 || omega == 0)
        return;
      double beta = next / rho * alpha / omega;
      for (int i = w->lo; i <= w->hi; i++)
        p[i] = bt__axpy (r[i], beta, bt__axpy (p[i], -omega, v[i]));
      rho = next;
    }
}

double
bt__dynamic_couple_solve (bt__dynamic_work *w)
{
  memset (w->d, 0, (size_t)(w->n + 1) * sizeof *w->d);
  if (w->lo > w->hi)
    return 0;
  make_band (w);
  if (w->pairs > 0)
    solve_with_pairs (w);
  else
    solve_with_band (w, w->rhs, w->d);
  return bt__dynamic_largest (w);
}
