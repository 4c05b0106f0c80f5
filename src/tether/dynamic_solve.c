/* The moving line: the linear solve, block tridiagonal, or pentadiagonal where the line is stiff in
   bending.  Every pivot is factored as L D L^T: it is a stiff direction plus a soft plane, which
   cofactors would mix.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

/* A = L D L^T with unit L; inverse pivots.  The divisions are those that can overlap.  */
typedef struct factor
{
  double l10, l20, l21, d0, d1, d2;
} factor;

static BT__HOT factor
factorize (const bt__sym *a)
{
  factor f;
  double minor = a->xx * a->yy - a->xy * a->xy, mixed = a->xx * a->yz - a->xy * a->xz;
  double inverse = 1 / minor;
  f.d0 = 1 / a->xx;
  f.d1 = a->xx * inverse;
  f.l10 = a->xy * f.d0;
  f.l20 = a->xz * f.d0;
  f.l21 = mixed * inverse;
  f.d2 = 1 / (a->zz - f.l20 * a->xz - f.l21 * (mixed * f.d0));
  return f;
}

static BT__HOT bt_vec3
resolve (const factor *f, bt_vec3 b)
{
  double y = b.y - f->l10 * b.x, z = (b.z - f->l20 * b.x - f->l21 * y) * f->d2;
  y = y * f->d1 - f->l21 * z;
  return bt__vec (b.x * f->d0 - f->l10 * y - f->l20 * z, y, z);
}

/* ---- Without bending: G = A^-1 K is kept ---- */

static BT__HOT void
put_column (bt__full *g, int c, bt_vec3 v)
{
  g->m[0][c] = v.x;
  g->m[1][c] = v.y;
  g->m[2][c] = v.z;
}

static BT__HOT bt_vec3
full_apply (const bt__full *g, bt_vec3 v)
{
  return bt__vec (g->m[0][0] * v.x + g->m[0][1] * v.y + g->m[0][2] * v.z,
                  g->m[1][0] * v.x + g->m[1][1] * v.y + g->m[1][2] * v.z,
                  g->m[2][0] * v.x + g->m[2][1] * v.y + g->m[2][2] * v.z);
}

/* A -= K G, which is symmetric.  */
static BT__HOT void
subtract_product (bt__sym *a, const bt__sym *k, const bt__full *g)
{
  a->xx -= k->xx * g->m[0][0] + k->xy * g->m[1][0] + k->xz * g->m[2][0];
  a->xy -= k->xx * g->m[0][1] + k->xy * g->m[1][1] + k->xz * g->m[2][1];
  a->xz -= k->xx * g->m[0][2] + k->xy * g->m[1][2] + k->xz * g->m[2][2];
  a->yy -= k->xy * g->m[0][1] + k->yy * g->m[1][1] + k->yz * g->m[2][1];
  a->yz -= k->xy * g->m[0][2] + k->yy * g->m[1][2] + k->yz * g->m[2][2];
  a->zz -= k->xz * g->m[0][2] + k->yz * g->m[1][2] + k->zz * g->m[2][2];
}

/* Eliminate node I, reached from node FROM through the block LEFT, toward the node beyond RIGHT. */
static BT__HOT void
eliminate_node (bt__dynamic_work *w, int i, int from, const bt__sym *left, const bt__sym *right)
{
  bt__sym a = w->diag[i];
  bt_vec3 r = w->rhs[i];
  if (left)
    {
      subtract_product (&a, left, w->up + from);
      r = bt__add (r, bt__sym_apply (left, w->d[from]));
    }
  factor f = factorize (&a);
  w->d[i] = resolve (&f, r);
  put_column (w->up + i, 0, resolve (&f, bt__vec (right->xx, right->xy, right->xz)));
  put_column (w->up + i, 1, resolve (&f, bt__vec (right->xy, right->yy, right->yz)));
  put_column (w->up + i, 2, resolve (&f, bt__vec (right->xz, right->yz, right->zz)));
}

/* The node where both ways meet.  */
static void
solve_middle (bt__dynamic_work *w, int m)
{
  bt__sym a = w->diag[m];
  bt_vec3 r = w->rhs[m];
  if (m > w->lo)
    {
      subtract_product (&a, w->off + m - 1, w->up + m - 1);
      r = bt__add (r, bt__sym_apply (w->off + m - 1, w->d[m - 1]));
    }
  if (m < w->hi)
    {
      subtract_product (&a, w->off + m, w->up + m + 1);
      r = bt__add (r, bt__sym_apply (w->off + m, w->d[m + 1]));
    }
  factor f = factorize (&a);
  w->d[m] = resolve (&f, r);
}

/* From both ends to the middle and back: the two ways do not wait for each other.  */
static void
solve_plain (bt__dynamic_work *w)
{
  int lo = w->lo, hi = w->hi, m = lo + (hi - lo) / 2, up = m - lo, down = hi - m;
  for (int k = 0; k < down; k++)
    {
      int i = lo + k, j = hi - k;
      if (k < up)
        eliminate_node (w, i, i - 1, k ? w->off + i - 1 : NULL, w->off + i);
      eliminate_node (w, j, j + 1, k ? w->off + j : NULL, w->off + j - 1);
    }
  solve_middle (w, m);
  for (int k = 1; k <= down; k++)
    {
      int i = m - k, j = m + k;
      if (k <= up)
        w->d[i] = bt__add (w->d[i], full_apply (w->up + i, w->d[i + 1]));
      w->d[j] = bt__add (w->d[j], full_apply (w->up + j, w->d[j - 1]));
    }
}

/* ---- With bending: the coupling to the next node but one is a multiple E of the unit ---- */

static inline bt__full
full_of (const bt__sym *a, double sign, double k)
{
  return (bt__full){ { { sign * a->xx + k, sign * a->xy, sign * a->xz },
                       { sign * a->xy, sign * a->yy + k, sign * a->yz },
                       { sign * a->xz, sign * a->yz, sign * a->zz + k } } };
}

static inline bt_vec3
column (const bt__full *a, int c)
{
  return bt__vec (a->m[0][c], a->m[1][c], a->m[2][c]);
}

/* A^T V.  */
static inline bt_vec3
transposed_apply (const bt__full *a, bt_vec3 v)
{
  return bt__vec (bt__dot (column (a, 0), v), bt__dot (column (a, 1), v),
                  bt__dot (column (a, 2), v));
}

/* The blocks of the two rows under elimination: A diagonal, B to the next.  */
typedef struct rows
{
  bt__sym a, next_a;
  bt__full b, next_b;
  bt_vec3 r, next_r, third_r;
  bt__sym third_a;
} rows;

static inline void
subtract_symmetric (bt__sym *a, const bt__full *b, const bt__full *u)
{
  a->xx -= bt__dot (column (b, 0), column (u, 0));
  a->xy -= bt__dot (column (b, 0), column (u, 1));
  a->xz -= bt__dot (column (b, 0), column (u, 2));
  a->yy -= bt__dot (column (b, 1), column (u, 1));
  a->yz -= bt__dot (column (b, 1), column (u, 2));
  a->zz -= bt__dot (column (b, 2), column (u, 2));
}

/* Eliminate node I from the next two rows: U1 = A^-1 B, U2 = A^-1 E are kept.  */
static inline void
eliminate_stiff (bt__dynamic_work *w, int i, rows *s, double e)
{
  factor f = factorize (&s->a);
  bt__full *u1 = w->up + i, *u2 = w->up2 + i;
  bt_vec3 unit[3] = { { e, 0, 0 }, { 0, e, 0 }, { 0, 0, e } };
  for (int c = 0; c < 3; c++)
    {
      put_column (u1, c, resolve (&f, column (&s->b, c)));
      put_column (u2, c, resolve (&f, unit[c]));
    }
  w->d[i] = resolve (&f, s->r);
  subtract_symmetric (&s->next_a, &s->b, u1);
  for (int c = 0; c < 3; c++)
    {
      bt_vec3 fill = transposed_apply (&s->b, column (u2, c));
      s->next_b.m[0][c] -= fill.x;
      s->next_b.m[1][c] -= fill.y;
      s->next_b.m[2][c] -= fill.z;
    }
  s->third_a.xx -= e * u2->m[0][0];
  s->third_a.xy -= e * u2->m[0][1];
  s->third_a.xz -= e * u2->m[0][2];
  s->third_a.yy -= e * u2->m[1][1];
  s->third_a.yz -= e * u2->m[1][2];
  s->third_a.zz -= e * u2->m[2][2];
  s->next_r = bt__sub (s->next_r, transposed_apply (&s->b, w->d[i]));
  s->third_r = bt__axpy (s->third_r, -e, w->d[i]);
}

static inline bt__sym
stiff_diagonal (const bt__dynamic_work *w, int i)
{
  bt__sym a = { 0 };
  if (i > w->hi)
    return (bt__sym){ 1, 0, 0, 1, 0, 1 };
  a = w->diag[i];
  a.xx += w->bend_diag[i];
  a.yy += w->bend_diag[i];
  a.zz += w->bend_diag[i];
  return a;
}

static inline bt__full
stiff_off (const bt__dynamic_work *w, int i)
{
  return i < w->hi ? full_of (w->off + i, -1, w->bend_off[i]) : (bt__full){ { { 0 } } };
}

static void
solve_stiff (bt__dynamic_work *w)
{
  const bt_vec3 zero = { 0, 0, 0 };
  int lo = w->lo, hi = w->hi;
  rows s = { .a = stiff_diagonal (w, lo),
             .b = stiff_off (w, lo),
             .r = w->rhs[lo],
             .next_a = stiff_diagonal (w, lo + 1),
             .next_b = stiff_off (w, lo + 1),
             .next_r = lo < hi ? w->rhs[lo + 1] : zero };
  for (int i = lo; i <= hi; i++)
    {
      s.third_a = stiff_diagonal (w, i + 2);
      s.third_r = i + 2 <= hi ? w->rhs[i + 2] : zero;
      eliminate_stiff (w, i, &s, i + 2 <= hi ? w->bend_far[i] : 0);
      s.a = s.next_a;
      s.b = s.next_b;
      s.r = s.next_r;
      s.next_a = s.third_a;
      s.next_b = stiff_off (w, i + 2);
      s.next_r = s.third_r;
    }
  for (int i = hi - 1; i >= lo; i--)
    {
      w->d[i] = bt__sub (w->d[i], full_apply (w->up + i, w->d[i + 1]));
      if (i + 2 <= hi)
        w->d[i] = bt__sub (w->d[i], full_apply (w->up2 + i, w->d[i + 2]));
    }
}

double
bt__dynamic_solve (bt__dynamic_work *w)
{
  double most = 0;
  w->d[0] = w->d[w->n] = bt__vec (0, 0, 0);
  if (w->lo > w->hi)
    return 0;
  if (w->bends > 0)
    solve_stiff (w);
  else
    solve_plain (w);
  for (int i = w->lo; i <= w->hi; i++)
    {
      double square = bt__dot (w->d[i], w->d[i]);
      if (!(square <= 1e60))
        return NAN;
      most = square > most ? square : most;
    }
  return sqrt (most);
}
