/* The moving line: the linear solve of an iteration, by block elimination from both ends of the
   line to the middle, and back.

   The matrix is block tridiagonal, or block pentadiagonal where the line is stiff in bending. Where
   it is not symmetric the nodes in the middle are eliminated by Gauss (dynamic_lu.c).  Every
   pivot is factored as L D L^T: a pivot is a stiff direction plus a soft plane, and an inverse by
   cofactors would mix the two.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

#define HUGE_UPDATE 1e60 /* m2: not finite */

/* The divisions are those that can overlap.  */
static BT__HOT bt__factor
factorize (const bt__sym *a)
{
  bt__factor f;
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
resolve (const bt__factor *f, bt_vec3 b)
{
  double y = b.y - f->l10 * b.x, z = (b.z - f->l20 * b.x - f->l21 * y) * f->d2;
  y = y * f->d1 - f->l21 * z;
  return bt__vec (b.x * f->d0 - f->l10 * y - f->l20 * z, y, z);
}

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

/* ---- Without bending: from both ends to the middle and back, a pair of nodes at a time ----

   Of a pair with blocks A, right-hand sides R and blocks K toward the middle, G = A^-1 K and A^-1 R
   are kept.  What it passes on is had from L^-1 K and L^-1 R already, so that the next pair need
   not wait for them.  */

static BT__HOT bt__pair_factor
factorize_pair (const bt__pair_sym *a)
{
  bt__pair_factor f;
  bt__pair minor = a->xx * a->yy - a->xy * a->xy, mixed = a->xx * a->yz - a->xy * a->xz;
  bt__pair inverse = 1 / minor;
  f.d0 = 1 / a->xx;
  f.d1 = a->xx * inverse;
  f.l10 = a->xy * f.d0;
  f.l20 = a->xz * f.d0;
  f.l21 = mixed * inverse;
  f.d2 = 1 / (a->zz - f.l20 * a->xz - f.l21 * (mixed * f.d0));
  return f;
}

/* L^-1 B.  */
static BT__HOT bt__pair_vec
solve_lower (const bt__pair_factor *f, bt__pair_vec b)
{
  b.y -= f->l10 * b.x;
  b.z -= f->l20 * b.x + f->l21 * b.y;
  return b;
}

/* D^-1 Y.  */
static BT__HOT bt__pair_vec
weigh (const bt__pair_factor *f, bt__pair_vec y)
{
  return (bt__pair_vec){ y.x * f->d0, y.y * f->d1, y.z * f->d2 };
}

/* L^-T Y.  */
static BT__HOT bt__pair_vec
ascend (const bt__pair_factor *f, bt__pair_vec y)
{
  y.y -= f->l21 * y.z;
  y.x -= f->l10 * y.y + f->l20 * y.z;
  return y;
}

static BT__HOT void
put_pair_column (bt__pair_full *g, int c, bt__pair_vec v)
{
  g->m[0][c] = v.x;
  g->m[1][c] = v.y;
  g->m[2][c] = v.z;
}

/* Eliminate nodes I and J toward the nodes beyond the blocks RIGHT and LEFT.  KEEP: their pivots
   are kept.  */
static BT__HOT void
eliminate_pair (bt__dynamic_work *w, int i, int j, const bt__sym *right, const bt__sym *left,
                int keep, bt__passed *p)
{
  bt__pair_sym a = bt__pair_load_sym (w->diag + i, w->diag + j),
               k = bt__pair_load_sym (right, left);
  bt__pair_vec r = bt__pair_add (bt__pair_load (w->rhs + i, w->rhs + j), p->r);
  a.xx -= p->a.xx;
  a.xy -= p->a.xy;
  a.xz -= p->a.xz;
  a.yy -= p->a.yy;
  a.yz -= p->a.yz;
  a.zz -= p->a.zz;
  bt__pair_factor f = factorize_pair (&a);
  if (keep)
    w->pivot[i].two = f;
  bt__pair_vec y = solve_lower (&f, r), x = solve_lower (&f, (bt__pair_vec){ k.xx, k.xy, k.xz }),
               u = solve_lower (&f, (bt__pair_vec){ k.xy, k.yy, k.yz }),
               v = solve_lower (&f, (bt__pair_vec){ k.xz, k.yz, k.zz });
  bt__pair_vec dy = weigh (&f, y), dx = weigh (&f, x), du = weigh (&f, u), dv = weigh (&f, v);
  p->a = (bt__pair_sym){ bt__pair_dot (x, dx), bt__pair_dot (x, du), bt__pair_dot (x, dv),
                         bt__pair_dot (u, du), bt__pair_dot (u, dv), bt__pair_dot (v, dv) };
  p->r = (bt__pair_vec){ bt__pair_dot (x, dy), bt__pair_dot (u, dy), bt__pair_dot (v, dy) };
  bt__pair_store (w->d + i, w->d + j, ascend (&f, dy));
  put_pair_column (&w->up[i].two, 0, ascend (&f, dx));
  put_pair_column (&w->up[i].two, 1, ascend (&f, du));
  put_pair_column (&w->up[i].two, 2, ascend (&f, dv));
}

/* The node where both ways meet: P and Q are passed on from either side.  */
static void
solve_middle (bt__dynamic_work *w, int m, const bt__passed *p, const bt__passed *q)
{
  bt__sym a = w->diag[m];
  bt_vec3 r = w->rhs[m];
  a.xx -= p->a.xx[0] + q->a.xx[1];
  a.xy -= p->a.xy[0] + q->a.xy[1];
  a.xz -= p->a.xz[0] + q->a.xz[1];
  a.yy -= p->a.yy[0] + q->a.yy[1];
  a.yz -= p->a.yz[0] + q->a.yz[1];
  a.zz -= p->a.zz[0] + q->a.zz[1];
  r.x += p->r.x[0] + q->r.x[1];
  r.y += p->r.y[0] + q->r.y[1];
  r.z += p->r.z[0] + q->r.z[1];
  w->middle = factorize (&a);
  w->d[m] = resolve (&w->middle, r);
}

/* TO += G of the nodes nearer the middle, V.  Return the squares of their updates.  */
static BT__HOT bt__pair
substitute_pair (const bt__dynamic_work *w, bt_vec3 *to, int i, int j, bt__pair_vec *v)
{
  const bt__pair_full *g = &w->up[i].two;
  bt__pair_vec d = bt__pair_load (to + i, to + j);
  bt__pair_vec x = { g->m[0][0], g->m[0][1], g->m[0][2] },
               y = { g->m[1][0], g->m[1][1], g->m[1][2] },
               z = { g->m[2][0], g->m[2][1], g->m[2][2] };
  *v = (bt__pair_vec){ d.x + bt__pair_dot (x, *v), d.y + bt__pair_dot (y, *v),
                       d.z + bt__pair_dot (z, *v) };
  bt__pair_store (to + i, to + j, *v);
  return bt__pair_dot (*v, *v);
}

/* From the middle back to both ends.  Return the square of the largest update, infinity if any is
   not finite.  */
static BT__HOT double
substitute_plain (bt__dynamic_work *w)
{
  int lo = w->lo, hi = w->hi, m = lo + (hi - lo) / 2, up = m - lo, down = hi - m;
  bt__pair_vec v = bt__pair_load (w->d + m, w->d + m);
  if (down > up)
    {
      substitute_pair (w, w->d, m + 1, m + 1, &v);
      v = bt__pair_load (w->d + m, w->d + m + 1);
    }
  bt__pair most = bt__pair_dot (v, v), sum = most;
  for (int k = up - 1; k >= 0; k--)
    {
      bt__pair square = substitute_pair (w, w->d, lo + k, hi - k, &v);
      most = bt__pair_max (most, square);
      sum += square;
    }
  return sum[0] + sum[1] <= HUGE_UPDATE ? fmax (most[0], most[1]) : INFINITY;
}

static BT__HOT double
solve_plain (bt__dynamic_work *w, int keep)
{
  int lo = w->lo, hi = w->hi, m = lo + (hi - lo) / 2, up = m - lo, down = hi - m;
  bt__passed p = { 0 };
  for (int k = 0; k < up; k++)
    eliminate_pair (w, lo + k, hi - k, w->off + lo + k, w->off + hi - k - 1, keep, &p);
  bt__passed q = p;
  if (down > up)
    eliminate_pair (w, m + 1, m + 1, w->off + m, w->off + m, keep, &q);
  solve_middle (w, m, &p, &q);
  return substitute_plain (w);
}

/* With the pivots kept: right-hand sides X of nodes I and J, to which *R is passed on, are solved
   in place; *R is then what they pass on.  */
static BT__HOT void
pass_pair (const bt__dynamic_work *w, bt_vec3 *x, int i, int j, bt__pair_vec *passed)
{
  const bt__pair_factor *f = &w->pivot[i].two;
  const bt__pair_full *g = &w->up[i].two;
  bt__pair_vec r = bt__pair_add (bt__pair_load (x + i, x + j), *passed);
  bt__pair_store (x + i, x + j, ascend (f, weigh (f, solve_lower (f, r))));
  *passed = (bt__pair_vec){ g->m[0][0] * r.x + g->m[1][0] * r.y + g->m[2][0] * r.z,
                            g->m[0][1] * r.x + g->m[1][1] * r.y + g->m[2][1] * r.z,
                            g->m[0][2] * r.x + g->m[1][2] * r.y + g->m[2][2] * r.z };
}

static void
solve_plain_again (const bt__dynamic_work *w, bt_vec3 *x)
{
  int lo = w->lo, hi = w->hi, m = lo + (hi - lo) / 2, up = m - lo, down = hi - m;
  bt__pair_vec p = { .x = { 0, 0 } };
  for (int k = 0; k < up; k++)
    pass_pair (w, x, lo + k, hi - k, &p);
  bt__pair_vec q = p;
  if (down > up)
    pass_pair (w, x, m + 1, m + 1, &q);
  bt_vec3 r = bt__vec (p.x[0] + q.x[1], p.y[0] + q.y[1], p.z[0] + q.z[1]);
  x[m] = resolve (&w->middle, bt__add (x[m], r));
  p = bt__pair_load (x + m, x + m);
  if (down > up)
    {
      substitute_pair (w, x, m + 1, m + 1, &p);
      p = bt__pair_load (x + m, x + m + 1);
    }
  for (int k = up - 1; k >= 0; k--)
    substitute_pair (w, x, lo + k, hi - k, &p);
}

/* What one side (0: the nodes before, 1: the nodes after) passes on in P, as of two nodes.  */
static bt__passed
passed_by (const bt__passed *p, int side)
{
  bt__passed q;
  for (size_t k = 0; k < sizeof q / sizeof (bt__pair); k++)
    {
      double one = ((const bt__pair *)p)[k][side];
      ((bt__pair *)&q)[k] = (bt__pair){ one, one };
    }
  return q;
}

/* The nodes before and after the part from FIRST to LAST are eliminated toward it, a pair at a time
   while both sides have one, then those of the longer side alone: far fewer operations each than in
   dynamic_lu.c.  */
void
bt__dynamic_solve_around (bt__dynamic_work *w, int first, int last, double *flow)
{
  int lo = w->lo, hi = w->hi, before = first - lo, after = hi - last, longer = after > before;
  int pairs = longer ? before : after, all = longer ? after : before;
  bt__passed p = { 0 };
  w->d[0] = w->d[w->n] = bt__vec (0, 0, 0);
  for (int k = 0; k < pairs; k++)
    eliminate_pair (w, lo + k, hi - k, w->off + lo + k, w->off + hi - k - 1, 0, &p);
  bt__passed q = passed_by (&p, longer);
  for (int k = pairs; k < all; k++)
    {
      int i = longer ? hi - k : lo + k;
      eliminate_pair (w, i, i, w->off + i - longer, w->off + i - longer, 0, &q);
    }
  const bt__passed *from[2] = { longer ? &p : &q, longer ? &q : &p };
  memcpy (w->d + first, w->rhs + first, (size_t)(last - first + 1) * sizeof *w->d);
  for (int side = 0; side < 2; side++)
    {
      bt_vec3 *d = w->d + (side ? last : first);
      const bt__pair_vec *r = &from[side]->r;
      *d = bt__add (*d, bt__vec (r->x[side], r->y[side], r->z[side]));
    }
  bt__dynamic_lu_solve (w, first, last, from, flow);
  const bt_vec3 *beside = w->d + (longer ? last : first);
  bt__pair_vec v = bt__pair_load (beside, beside);
  for (int k = all - 1; k >= pairs; k--)
    {
      int i = longer ? hi - k : lo + k;
      substitute_pair (w, w->d, i, i, &v);
    }
  v = bt__pair_load (w->d + lo + pairs, w->d + hi - pairs);
  for (int k = pairs - 1; k >= 0; k--)
    substitute_pair (w, w->d, lo + k, hi - k, &v);
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
  bt__factor f = factorize (&s->a);
  bt__full *u1 = &w->up[i].one, *u2 = w->up2 + i;
  w->pivot[i].one = f;
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
substitute_stiff (const bt__dynamic_work *w, bt_vec3 *x)
{
  for (int i = w->hi - 1; i >= w->lo; i--)
    {
      x[i] = bt__sub (x[i], full_apply (&w->up[i].one, x[i + 1]));
      if (i + 2 <= w->hi)
        x[i] = bt__sub (x[i], full_apply (w->up2 + i, x[i + 2]));
    }
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
  substitute_stiff (w, w->d);
}

static void
solve_stiff_again (const bt__dynamic_work *w, bt_vec3 *x)
{
  for (int i = w->lo; i <= w->hi; i++)
    {
      bt_vec3 r = x[i];
      x[i] = resolve (&w->pivot[i].one, r);
      if (i + 1 <= w->hi)
        x[i + 1] = bt__sub (x[i + 1], transposed_apply (&w->up[i].one, r));
      if (i + 2 <= w->hi)
        x[i + 2] = bt__sub (x[i + 2], transposed_apply (w->up2 + i, r));
    }
  substitute_stiff (w, x);
}

double
bt__dynamic_largest (const bt__dynamic_work *w)
{
  double most = 0, sum = 0;
  for (int i = w->lo; i <= w->hi; i++)
    {
      double square = bt__dot (w->d[i], w->d[i]);
      sum += square;
      most = square > most ? square : most;
    }
  return sum <= HUGE_UPDATE ? sqrt (most) : INFINITY;
}

static BT__HOT double
solve (bt__dynamic_work *w, int keep)
{
  w->d[0] = w->d[w->n] = bt__vec (0, 0, 0);
  if (w->lo > w->hi)
    return 0;
  if (!(w->bends > 0))
    return sqrt (keep ? solve_plain (w, 1) : solve_plain (w, 0));
  solve_stiff (w);
  return bt__dynamic_largest (w);
}

double
bt__dynamic_solve_blocks (bt__dynamic_work *w)
{
  return solve (w, 1);
}

void
bt__dynamic_solve_again (bt__dynamic_work *w, bt_vec3 *x)
{
  for (int i = 0; i < w->lo; i++)
    x[i] = bt__vec (0, 0, 0);
  for (int i = w->hi + 1; i <= w->n; i++)
    x[i] = bt__vec (0, 0, 0);
  if (w->lo > w->hi)
    return;
  if (w->bends > 0)
    solve_stiff_again (w, x);
  else
    solve_plain_again (w, x);
}

double
bt__dynamic_solve (bt__dynamic_work *w)
{
  if ((w->bents > 0 && w->flows) || w->coupled)
    return bt__dynamic_couple_solve (w);
  return w->pairs > 0 ? bt__dynamic_pair_solve (w) : solve (w, 0);
}
