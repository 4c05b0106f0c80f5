/* Elimination of a part of a line whose equations are not symmetric: what is solved for gives the
   right-hand side again, with flows through sliding nodes, one beside another too, with bending
   stiffness, with friction that follows the loads, and again for another right-hand side.  The same
   of the whole line, whose other nodes are eliminated as the symmetric ones that they are.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tether/dynamic_kernel.h"

enum
{
  NODES = 40,
  ROWS = NODES
};

/* The arrays of a workspace, all that elimination touches.  */
typedef struct equations
{
  bt__dynamic_work w;
  bt__sym diag[NODES], off[NODES];
  double bend_diag[NODES], bend_off[NODES], bend_far[NODES];
  bt_vec3 d[NODES], rhs[NODES];
  bt__factors up[NODES];
  bt__four far[NODES][3], down[NODES][3];
  bt__pivot pivot[NODES];
  bt__constraint row[ROWS];
  int64_t first_row[NODES];
  bt__flow flow[BT__BENTS]; /* as drawn: the elimination works on those of W */
} equations;

static double
draw (uint64_t *seed)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)*seed / 9223372036854775808.0;
}

static bt_vec3
draw_vector (uint64_t *seed)
{
  double x = draw (seed), y = draw (seed);
  return bt__vec (x, y, draw (seed));
}

/* A symmetric block of which each row outweighs what stands beside it by DIAGONAL.  */
static bt__sym
draw_block (uint64_t *seed, double diagonal)
{
  bt__sym a = { .xy = draw (seed), .xz = draw (seed), .yz = draw (seed) };
  a.xx = diagonal + draw (seed);
  a.yy = diagonal + draw (seed);
  a.zz = diagonal + draw (seed);
  return a;
}

/* Flows through some of the nodes from FIRST to LAST, in order, often beside each other.  */
static void
draw_flows (equations *s, int first, int last, uint64_t *seed)
{
  for (int i = first; i <= last && s->w.bents < BT__BENTS; i++)
    {
      bt__flow *f = &s->flow[s->w.bents];
      if (draw (seed) < 0)
        continue;
      *f = (bt__flow){ .node = i, .own = 8 + draw (seed), .right = draw (seed) };
      for (int k = 0; k < 3; k++)
        {
          f->column[k] = draw_vector (seed);
          f->row[k] = draw_vector (seed);
        }
      for (int k = 0; k < 2; k++)
        f->beside[k] = draw (seed);
      f->gain = draw_vector (seed);
      f->press = draw_vector (seed);
      s->w.bents++;
    }
  memcpy (s->w.flow, s->flow, sizeof s->flow);
}

/* Contacts whose friction follows their loads between nodes FIRST and LAST, at most one in an
   interval.  */
static void
draw_rows (equations *s, int first, int last, uint64_t *seed)
{
  for (int i = first; i < last; i++)
    if (draw (seed) > 0)
      {
        s->row[s->w.rows] = (bt__constraint){ .node = i,
                                              .s = (1 + draw (seed)) / 2,
                                              .normal = draw_vector (seed),
                                              .stiffness = 1,
                                              .friction = 0.6,
                                              .slip = 1e-3,
                                              .active = 1,
                                              .roll = 1,
                                              .shift = draw (seed),
                                              .drag = draw_vector (seed) };
        s->first_row[i] = ++s->w.rows;
      }
}

static void
draw_equations (equations *s, int n, int bends, int coupled, uint64_t *seed)
{
  memset (s, 0, sizeof *s);
  s->w = (bt__dynamic_work){ .n = n - 1,
                             .hi = n - 1,
                             .bends = bends,
                             .pairs = 1, /* so the pivots are kept */
                             .coupled = coupled,
                             .row = s->row,
                             .diag = s->diag,
                             .off = s->off,
                             .bend_diag = s->bend_diag,
                             .bend_off = s->bend_off,
                             .bend_far = s->bend_far,
                             .d = s->d,
                             .rhs = s->rhs,
                             .up = s->up,
                             .far = s->far,
                             .down = s->down,
                             .pivot = s->pivot,
                             .first_row = s->first_row };
  for (int i = 0; i < n; i++)
    {
      s->diag[i] = draw_block (seed, 12);
      s->off[i] = draw_block (seed, 1);
      s->bend_diag[i] = bends ? 2 + draw (seed) : 0;
      s->bend_off[i] = bends ? draw (seed) : 0;
      s->bend_far[i] = bends ? draw (seed) : 0;
    }
  for (int i = 0; i < n; i++)
    s->rhs[i] = draw_vector (seed);
}

/* ---- The whole matrix times what was solved for ---- */

static bt_vec3
times (const bt__sym *a, bt_vec3 v)
{
  return bt__vec (a->xx * v.x + a->xy * v.y + a->xz * v.z, a->xy * v.x + a->yy * v.y + a->yz * v.z,
                  a->xz * v.x + a->yz * v.y + a->zz * v.z);
}

/* Add to Q what nodes A and B are to each other: a block, and a multiple of the unit.  */
static void
add_couple (bt_vec3 *q, const bt_vec3 *x, int a, int b, const bt__sym *block, double unit)
{
  q[a] = bt__axpy (bt__add (q[a], times (block, x[b])), unit, x[b]);
  if (a != b)
    q[b] = bt__axpy (bt__add (q[b], times (block, x[a])), unit, x[a]);
}

static void
add_rows (const equations *s, const bt_vec3 *x, int first, int last, bt_vec3 *q)
{
  for (int k = 0; k < s->w.rows; k++)
    {
      const bt__constraint *r = &s->row[k];
      double rise = 0, share[2] = { 1 - r->s, r->s };
      for (int e = 0; e < 2; e++)
        if (r->node + e >= first && r->node + e <= last)
          rise += share[e] * bt__dot (r->normal, x[r->node + e]);
      bt_vec3 gain[2];
      bt__dynamic_load_gains (r, 0, gain);
      for (int e = 0; e < 2; e++)
        q[r->node + e] = bt__axpy (q[r->node + e], r->stiffness * rise, gain[e]);
    }
}

static void
add_flows (const equations *s, const bt_vec3 *x, const double *flow, int first, int last,
           bt_vec3 *q, double *own)
{
  for (int k = 0; k < s->w.bents; k++)
    {
      const bt__flow *f = &s->flow[k];
      own[k] = f->own * flow[k];
      if (s->w.coupled)
        q[f->node] = bt__axpy (q[f->node], bt__dot (f->press, x[f->node]), f->gain);
      for (int e = 0; e < 3; e++)
        if (f->node + e - 1 >= first && f->node + e - 1 <= last)
          {
            bt_vec3 *to = &q[f->node + e - 1];
            *to = bt__axpy (*to, flow[k], f->column[e]);
            own[k] += bt__dot (f->row[e], x[f->node + e - 1]);
          }
      if (k > 0 && f[-1].node == f->node - 1)
        own[k] += f->beside[0] * flow[k - 1];
      if (k + 1 < s->w.bents && f[1].node == f->node + 1)
        own[k] += f->beside[1] * flow[k + 1];
    }
}

/* How far the matrix times X and FLOW is from the right-hand sides D and RIGHT.  */
static double
residual (const equations *s, int first, int last, const bt_vec3 *x, const double *flow,
          const bt_vec3 *d, const double *right)
{
  static bt_vec3 q[NODES];
  double own[BT__BENTS], most = 0;
  memset (q, 0, sizeof q);
  for (int i = first; i <= last; i++)
    {
      const bt__sym *off = &s->off[i];
      bt__sym minus = { -off->xx, -off->xy, -off->xz, -off->yy, -off->yz, -off->zz }, none = { 0 };
      add_couple (q, x, i, i, &s->diag[i], s->bend_diag[i]);
      if (i < last)
        add_couple (q, x, i, i + 1, &minus, s->bend_off[i]);
      if (i + 2 <= last)
        add_couple (q, x, i, i + 2, &none, s->bend_far[i]);
    }
  add_rows (s, x, first, last, q);
  add_flows (s, x, flow, first, last, q, own);
  for (int i = first; i <= last; i++)
    most = fmax (most, bt__norm (bt__sub (q[i], d[i])));
  for (int k = 0; k < s->w.bents; k++)
    most = fmax (most, fabs (own[k] - right[k]));
  return most;
}

/* ---- The law ---- */

/* The worst residual of the part from FIRST to LAST, solved once and again.  */
static double
solve_twice (equations *s, int first, int last, uint64_t *seed)
{
  static const bt__passed none;
  const bt__passed *nothing[2] = { &none, &none };
  static bt_vec3 d[NODES], x[NODES];
  double right[BT__BENTS] = { 0 }, flow[BT__BENTS];
  for (int i = first; i <= last; i++)
    d[i] = s->d[i] = draw_vector (seed);
  for (int k = 0; k < s->w.bents; k++)
    right[k] = s->flow[k].right;
  bt__dynamic_lu_solve (&s->w, first, last, nothing, flow);
  double most = residual (s, first, last, s->d, flow, d, right);
  for (int i = first; i <= last; i++)
    x[i] = d[i] = draw_vector (seed);
  for (int k = 0; k < s->w.bents; k++)
    flow[k] = right[k] = draw (seed);
  bt__dynamic_lu_solve_again (&s->w, first, last, x, flow);
  return fmax (most, residual (s, first, last, x, flow, d, right));
}

static void
any_part (void **state)
{
  (void)state;
  static equations s;
  uint64_t seed = 7;
  for (int kind = 0; kind < 8; kind++)
    {
      int bends = kind & 1, coupled = kind >> 1 & 1, flows = kind >> 2 & 1, most_flows = 0;
      double most = 0;
      for (int n = 1; n <= NODES; n++)
        {
          int first = n / 5, last = n - 1 - n / 7;
          draw_equations (&s, n, bends, coupled, &seed);
          if (coupled)
            draw_rows (&s, 0, n - 1, &seed);
          if (flows)
            draw_flows (&s, first, last, &seed);
          most_flows = s.w.bents > most_flows ? s.w.bents : most_flows;
          most = fmax (most, solve_twice (&s, first, last, &seed));
        }
      print_message ("# bending %d, friction %d, up to %d flows: worst residual %.2g\n", bends,
                     coupled, most_flows, most);
      assert_true (most < 1e-13);
    }
}

/* The worst residual of a line of N nodes, those from FIRST to LAST of which are not symmetric.  */
static double
solve_line (equations *s, int n, int first, int last, int flows, uint64_t *seed)
{
  double right[BT__BENTS] = { 0 }, flow[BT__BENTS];
  draw_equations (s, n, 0, 1, seed);
  s->w.pairs = 0;
  draw_rows (s, first, last, seed);
  if (flows)
    draw_flows (s, first + (first > 0), last - (last < n - 1), seed);
  for (int k = 0; k < s->w.bents; k++)
    right[k] = s->flow[k].right;
  bt__dynamic_solve_around (&s->w, first, last, flow);
  return residual (s, 0, n - 1, s->d, flow, s->rhs, right);
}

static void
whole_line (void **state)
{
  (void)state;
  static equations s;
  uint64_t seed = 11;
  for (int flows = 0; flows < 2; flows++)
    {
      double most = 0;
      for (int n = 1; n <= NODES; n++)
        for (int first = 0; first < n; first++)
          for (int last = first; last < n; last++)
            most = fmax (most, solve_line (&s, n, first, last, flows, &seed));
      print_message ("# any part of the line, flows %d: worst residual %.2g\n", flows, most);
      assert_true (most < 1e-13);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (any_part), cmocka_unit_test (whole_line) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
