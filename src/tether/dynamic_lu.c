/* The moving line: block elimination of a part of the line whose equations are not symmetric, from
   its first node to its last, and back.

   Line flows through sliding nodes, and friction may follow the loads.  A flow is one more unknown:
   its equation has the sliding node and the nodes before and after it, as those of the nodes have
   the flow.  Eliminated as soon as the node before is, the flow leaves behind no more than couples
   the sliding node and the next anyway.

   The three equations of a node are three rows of four numbers, the fourth of which is the
   right-hand side.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "math/wide.h"
#include "tether/dynamic_kernel.h"

/* ---- Rows ---- */

typedef bt__four rows[3];

static BT__HOT void
put_block (rows to, double sign, const bt__sym *a, double k, bt_vec3 right)
{
  to[0] = (bt__four){ sign * a->xx + k, sign * a->xy, sign * a->xz, right.x };
  to[1] = (bt__four){ sign * a->xy, sign * a->yy + k, sign * a->yz, right.y };
  to[2] = (bt__four){ sign * a->xz, sign * a->yz, sign * a->zz + k, right.z };
}

static BT__HOT bt__four
four (bt_vec3 v, double right)
{
  return (bt__four){ v.x, v.y, v.z, right };
}

/* A += K u B.  */
static BT__HOT void
add_dyad (rows a, double k, bt_vec3 u, bt__four b)
{
  a[0] += (k * u.x) * b;
  a[1] += (k * u.y) * b;
  a[2] += (k * u.z) * b;
}

/* A -= B C, of which B is a block.  */
static BT__HOT void
take_product (rows a, const rows b, const rows c)
{
  for (int i = 0; i < 3; i++)
    a[i] -= b[i][0] * c[0] + b[i][1] * c[1] + b[i][2] * c[2];
}

static BT__HOT void
take_multiple (rows a, double k, const rows b)
{
  for (int i = 0; i < 3; i++)
    a[i] -= k * b[i];
}

static BT__HOT bt_vec3
times (const rows a, bt_vec3 v)
{
  return bt__vec (a[0][0] * v.x + a[0][1] * v.y + a[0][2] * v.z,
                  a[1][0] * v.x + a[1][1] * v.y + a[1][2] * v.z,
                  a[2][0] * v.x + a[2][1] * v.y + a[2][2] * v.z);
}

static BT__HOT bt_vec3
right_of (const rows a)
{
  return bt__vec (a[0][3], a[1][3], a[2][3]);
}

/* The sum of rows A, each V times.  */
static BT__HOT bt__four
sum_of (const rows a, bt_vec3 v)
{
  return v.x * a[0] + v.y * a[1] + v.z * a[2];
}

/* ---- Pivots ---- */

/* By Gauss with exchanges of rows: friction that follows the loads may leave little on the
   diagonal.  */
static BT__HOT bt__lu
lu_of (const rows a)
{
  bt__lu f = { .row = { 0, 1, 2 } };
  for (int i = 1; i < 3; i++)
    if (fabs (a[i][0]) > fabs (a[f.row[0]][0]))
      f.row[0] = i;
  f.row[f.row[0]] = 0;
  const double *p = (const double *)(a + f.row[0]), *q = (const double *)(a + f.row[1]),
               *r = (const double *)(a + f.row[2]);
  f.d0 = 1 / p[0];
  f.l10 = q[0] * f.d0;
  f.l20 = r[0] * f.d0;
  f.u01 = p[1];
  f.u02 = p[2];
  double q1 = q[1] - f.l10 * p[1], q2 = q[2] - f.l10 * p[2];
  double r1 = r[1] - f.l20 * p[1], r2 = r[2] - f.l20 * p[2];
  if (fabs (r1) > fabs (q1))
    {
      int row = f.row[1];
      double l = f.l10, t1 = q1, t2 = q2;
      f.row[1] = f.row[2];
      f.row[2] = row;
      f.l10 = f.l20;
      f.l20 = l;
      q1 = r1;
      q2 = r2;
      r1 = t1;
      r2 = t2;
    }
  f.d1 = 1 / q1;
  f.u12 = q2;
  f.l21 = r1 * f.d1;
  f.d2 = 1 / (r2 - f.l21 * q2);
  return f;
}

static BT__HOT void
resolve_rows (const bt__lu *f, const rows b, rows x)
{
  bt__four p = b[f->row[0]], q = b[f->row[1]] - f->l10 * p;
  bt__four z = (b[f->row[2]] - f->l20 * p - f->l21 * q) * f->d2;
  q = (q - f->u12 * z) * f->d1;
  x[0] = (p - f->u01 * q - f->u02 * z) * f->d0;
  x[1] = q;
  x[2] = z;
}

static BT__HOT bt_vec3
lu_resolve (const bt__lu *f, bt_vec3 b)
{
  const double v[3] = { b.x, b.y, b.z };
  double p = v[f->row[0]], q = v[f->row[1]] - f->l10 * p;
  double z = (v[f->row[2]] - f->l20 * p - f->l21 * q) * f->d2;
  q = (q - f->u12 * z) * f->d1;
  return bt__vec ((p - f->u01 * q - f->u02 * z) * f->d0, q, z);
}

/* ---- The nodes under elimination ---- */

/* A node and the next, with bending stiffness the next two: the rows of each, and the blocks of
   each to the next and back.  What couples the first and the third is a multiple of the unit.  */
typedef struct window
{
  rows a[3], up[2], down[2];
  int flow, side; /* the next that is eliminated; whose node comes */
} window;

/* What R gains with the load at its nodes: which of the window they are, -1 if none.  */
static void
add_gain (window *s, const bt__constraint *r, int node, int next)
{
  bt_vec3 gain[2];
  bt__four v = four (bt__scale (r->stiffness, r->normal), 0);
  double p = 1 - r->s, q = r->s;
  bt__dynamic_load_gains (r, 0, gain);
  if (node >= 0)
    add_dyad (s->a[node], p, gain[0], v);
  if (next >= 0)
    add_dyad (s->a[next], q, gain[1], v);
  if (node >= 0 && next >= 0)
    {
      add_dyad (s->up[node], q, gain[0], v);
      add_dyad (s->down[node], p, gain[1], v);
    }
}

static void
add_gains (const bt__dynamic_work *w, window *s, int64_t i, int node, int next)
{
  for (int64_t k = w->first_row[i]; k > 0; k = w->row[k - 1].next)
    add_gain (s, w->row + k - 1, node, next);
}

/* Node I comes into the window, the AT-th there.  */
static BT__HOT void
enter (const bt__dynamic_work *w, window *s, int stiff, int i, int at, int first, int last)
{
  static const bt__sym unit = { 1, 0, 0, 1, 0, 1 }, none = { 0 };
  static const bt_vec3 nothing = { 0, 0, 0 };
  int inside = i <= last;
  put_block (s->a[at], 1, inside ? w->diag + i : &unit, stiff && inside ? w->bend_diag[i] : 0,
             inside ? w->d[i] : nothing);
  if (at > 0)
    {
      put_block (s->up[at - 1], -1, inside ? w->off + i - 1 : &none,
                 stiff && inside ? w->bend_off[i - 1] : 0, nothing);
      for (int k = 0; k < 3; k++)
        s->down[at - 1][k] = s->up[at - 1][k];
    }
  if (!w->coupled || !inside)
    return;
  if (s->side < w->bents && w->flow[s->side].node == i)
    {
      const bt__flow *f = w->flow + s->side++;
      add_dyad (s->a[at], 1, f->gain, four (f->press, 0));
    }
  if (i > 0)
    add_gains (w, s, i - 1, i > first ? at - 1 : -1, at);
  if (i == last)
    add_gains (w, s, i, at, -1);
}

/* ---- Elimination ---- */

/* The flow of the first node of the window, node I: the node before has been eliminated.  */
static void
eliminate_flow (bt__dynamic_work *w, window *s, int i, int last)
{
  bt__flow *f = w->flow + s->flow++;
  int beside = s->flow < w->bents && f[1].node == i + 1;
  f->own = 1 / f->own;
  f->right *= f->own;
  f->by[0] = bt__scale (f->own, f->row[1]);
  f->by[1] = i < last ? bt__scale (f->own, f->row[2]) : bt__vec (0, 0, 0);
  f->by_next = beside ? f->own * f->beside[1] : 0;
  f->back = beside ? f[1].beside[0] : 0;
  bt__four at = four (f->by[0], f->right), after = four (f->by[1], 0);
  add_dyad (s->a[0], -1, f->column[1], at);
  if (i < last)
    {
      add_dyad (s->up[0], -1, f->column[1], after);
      add_dyad (s->down[0], -1, f->column[2], at);
      add_dyad (s->a[1], -1, f->column[2], four (f->by[1], f->right));
    }
  if (!beside)
    return;
  for (int k = 0; k < 2; k++)
    {
      f[1].column[k] = bt__axpy (f[1].column[k], -f->by_next, f->column[k + 1]);
      f[1].row[k] = bt__axpy (f[1].row[k], -f->back, f->by[k]);
    }
  f[1].own -= f->back * f->by_next;
  f[1].right -= f->back * f->right;
}

/* The equation F of the flow of the second node, after the first has been eliminated with pivot P:
   UP and FAR are what the first is by the second and third.  */
static void
pass_on_flow (bt__flow *f, const window *s, const bt__lu *p, const rows up, const rows far,
              double e)
{
  bt_vec3 push = lu_resolve (p, f->column[0]);
  bt__four by = sum_of (up, f->row[0]);
  f->own -= bt__dot (f->row[0], push);
  f->right -= by[3];
  f->column[1] = bt__sub (f->column[1], times (s->down[0], push));
  f->row[1] = bt__sub (f->row[1], bt__vec (by[0], by[1], by[2]));
  f->column[0] = push;
  if (e == 0)
    return;
  by = sum_of (far, f->row[0]);
  f->column[2] = bt__axpy (f->column[2], -e, push);
  f->row[2] = bt__sub (f->row[2], bt__vec (by[0], by[1], by[2]));
}

/* Node I, the first of the window.  */
static BT__HOT void
eliminate_node (bt__dynamic_work *w, window *s, int stiff, int i, int last)
{
  bt__lu p = lu_of (s->a[0]);
  bt__four *up = w->up[i].rows, *far = stiff ? w->far[i] : NULL;
  double e = stiff && i + 2 <= last ? w->bend_far[i] : 0;
  if (w->pairs > 0)
    {
      w->pivot[i].lu = p;
      for (int k = 0; k < 3; k++)
        w->down[i][k] = s->down[0][k];
    }
  for (int k = 0; k < 3; k++)
    s->up[0][k][3] = s->a[0][k][3];
  resolve_rows (&p, s->up[0], up);
  take_product (s->a[1], s->down[0], up);
  if (stiff)
    {
      const rows unit = { { e, 0, 0, 0 }, { 0, e, 0, 0 }, { 0, 0, e, 0 } };
      resolve_rows (&p, unit, far);
      take_product (s->up[1], s->down[0], far);
      take_multiple (s->down[1], e, up);
      take_multiple (s->a[2], e, far);
      for (int k = 0; k < 3; k++)
        s->a[2][k][3] -= e * up[k][3];
    }
  if (s->flow < w->bents && w->flow[s->flow].node == i + 1)
    pass_on_flow (w->flow + s->flow, s, &p, up, far, e);
}

static void
take_passed (rows a, const bt__passed *p, int k)
{
  const bt__sym taken = { p->a.xx[k], p->a.xy[k], p->a.xz[k], p->a.yy[k], p->a.yz[k], p->a.zz[k] };
  rows b;
  put_block (b, 1, &taken, 0, bt__vec (0, 0, 0));
  take_multiple (a, 1, b);
}

static BT__HOT void
eliminate (bt__dynamic_work *w, int stiff, int first, int last, const bt__passed *const passed[2])
{
  window s = { .flow = 0 };
  int ahead = stiff ? 2 : 1;
  for (int i = first - ahead; i <= last; i++)
    {
      int comes = i + ahead, at = comes - first < ahead ? comes - first : ahead;
      enter (w, &s, stiff, comes, at, first, last);
      if (comes == first)
        take_passed (s.a[at], passed[0], 0);
      if (comes == last)
        take_passed (s.a[at], passed[1], 1);
      if (i < first)
        continue;
      if (s.flow < w->bents && w->flow[s.flow].node == i)
        eliminate_flow (w, &s, i, last);
      eliminate_node (w, &s, stiff, i, last);
      for (int k = 0; k < 3; k++)
        {
          s.a[0][k] = s.a[1][k];
          s.a[1][k] = s.a[2][k];
          s.up[0][k] = s.up[1][k];
          s.down[0][k] = s.down[1][k];
        }
    }
}

static BT__WIDE void
eliminate_narrow (bt__dynamic_work *w, int first, int last, const bt__passed *const passed[2])
{
  eliminate (w, 0, first, last, passed);
}

static BT__WIDE void
eliminate_wide (bt__dynamic_work *w, int first, int last, const bt__passed *const passed[2])
{
  eliminate (w, 1, first, last, passed);
}

/* ---- Back from the last node to the first ---- */

static void
substitute (const bt__dynamic_work *w, int first, int last, bt_vec3 *x, double *flow)
{
  int k = w->bents;
  for (int i = last; i >= first; i--)
    {
      if (i < last)
        x[i] = bt__sub (x[i], times (w->up[i].rows, x[i + 1]));
      if (w->bends > 0 && i + 2 <= last)
        x[i] = bt__sub (x[i], times (w->far[i], x[i + 2]));
      if (k < w->bents && w->flow[k].node == i + 1)
        x[i] = bt__axpy (x[i], -flow[k], w->flow[k].column[0]);
      if (k == 0 || w->flow[k - 1].node != i)
        continue;
      const bt__flow *f = w->flow + --k;
      flow[k] -= bt__dot (f->by[0], x[i]);
      if (i < last)
        flow[k] -= bt__dot (f->by[1], x[i + 1]);
      if (k + 1 < w->bents)
        flow[k] -= f->by_next * flow[k + 1];
    }
}

void
bt__dynamic_lu_solve (bt__dynamic_work *w, int first, int last, const bt__passed *const passed[2],
                      double *flow)
{
  if (w->bends > 0)
    eliminate_wide (w, first, last, passed);
  else
    eliminate_narrow (w, first, last, passed);
  for (int i = first; i <= last; i++)
    w->d[i] = right_of (w->up[i].rows);
  for (int k = 0; k < w->bents; k++)
    flow[k] = w->flow[k].right;
  substitute (w, first, last, w->d, flow);
}

void
bt__dynamic_lu_solve_again (const bt__dynamic_work *w, int first, int last, bt_vec3 *x,
                            double *flow)
{
  int k = 0;
  for (int i = first; i <= last; i++)
    {
      const bt__flow *f = w->flow + k;
      if (k < w->bents && f->node == i)
        {
          flow[k] *= f->own;
          x[i] = bt__axpy (x[i], -flow[k], f->column[1]);
          if (i < last)
            x[i + 1] = bt__axpy (x[i + 1], -flow[k], f->column[2]);
          if (++k < w->bents)
            flow[k] -= f->back * flow[k - 1];
        }
      x[i] = lu_resolve (&w->pivot[i].lu, x[i]);
      if (i < last)
        x[i + 1] = bt__sub (x[i + 1], times (w->down[i], x[i]));
      if (w->bends > 0 && i + 2 <= last)
        x[i + 2] = bt__axpy (x[i + 2], -w->bend_far[i], x[i]);
      if (k < w->bents && w->flow[k].node == i + 1)
        flow[k] -= bt__dot (w->flow[k].row[0], x[i]);
    }
  substitute (w, first, last, x, flow);
}
