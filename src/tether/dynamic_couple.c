/* The moving line: the linear solve in which flows are unknowns, and friction follows the loads.

   Where a line is wound about something the load of every place depends on the tension, and the
   tension on the friction of the places before.  So what friction gains with the load stands in the
   equations (the consistent tangent of Coulomb's law: P. Wriggers, Computational Contact Mechanics,
   2nd edition, chapter 9), together with the friction of the present loads; likewise what a load
   does that has wandered along its interval, and the friction of sliding nodes along their edges.
   A row adds to the blocks of its two nodes the product of two vectors, and the matrix is no longer
   symmetric; nor is it where line flows through sliding nodes.  law_dynamic_tangent holds the
   equations to differences of the forces.  From the first of these places to the last nodes are
   eliminated by Gauss (dynamic_lu.c).

   Rows of two places couple nodes that are not neighbours.  Their symmetric part is in the blocks
   with an excess, as dynamic_pair.c says; the excess is taken back, and what their friction gains
   is added, by BiCGSTAB with that elimination as preconditioner on the right (H. A. van der Vorst,
   SIAM J. Sci. Stat. Comput. 13, 1992, 631).  As a product of the eliminated matrix with what was
   solved for is known, no other product is needed.  The equations of the flows are solved exactly,
   and never have a residual.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

enum
{
  TURNS = 6 /* of BiCGSTAB at most: Newton's iterations do the rest */
};

#define LITTLE 1e-12 /* of the square of the right-hand side: a residual that is solved */

/* ---- Where the equations are not symmetric ---- */

static int
gains (const bt__constraint *r)
{
  return r->active > 0 && (r->friction > 0 || r->roll > 0);
}

/* Add to Q what the nodes of R, from NODE on of the place SIDE (0, 1), gain by MORE newtons.  */
static void
add_gains_at (bt_vec3 *q, const bt__constraint *r, int side, double more)
{
  bt_vec3 gain[2];
  int64_t node = side ? r->pair - 1 : r->node;
  bt__dynamic_load_gains (r, side, gain);
  for (int e = 0; e < 2; e++)
    q[node + e] = bt__axpy (q[node + e], more, gain[e]);
}

/* Chain the rows of one place that gain with the load, each at its node; the equations had friction
   of the loads before.  */
static void
chain_rows (bt__dynamic_work *w)
{
  memset (w->first_row, 0, ((size_t)w->n + 1) * sizeof *w->first_row);
  for (int k = w->rows - 1; k >= 0; k--)
    {
      bt__constraint *r = w->row + k;
      if (!gains (r))
        continue;
      double more = bt__dot (r->force, r->normal) - fmax (r->load, 0);
      for (int side = 0; side <= (r->pair > 0); side++)
        add_gains_at (w->rhs, r, side, more);
      if (r->pair > 0)
        continue;
      r->next = w->first_row[r->node];
      w->first_row[r->node] = k + 1;
    }
}

/* Nodes from FIRST to LAST of the line are no longer symmetric; *FROM to *TO are not yet.  */
static void
spread (const bt__dynamic_work *w, int64_t first, int64_t last, int *from, int *to)
{
  *from = first < *from ? (first > w->lo ? (int)first : w->lo) : *from;
  *to = last > *to ? (last < w->hi ? (int)last : w->hi) : *to;
}

/* The nodes of the part that is not symmetric; all of them with pairs, and in a line that is stiff
   in bending.  None if *FROM > *TO.  */
static void
find_part (const bt__dynamic_work *w, int *from, int *to)
{
  *from = w->n + 1;
  *to = -1;
  for (int k = 0; w->flows && k < w->bents; k++)
    spread (w, w->bent[k].node - 1, w->bent[k].node + 1, from, to);
  for (int i = 0; w->coupled && i < w->n; i++)
    if (w->first_row[i] > 0)
      spread (w, i, i + 1, from, to);
  if (w->pairs > 0 || (w->bends > 0 && *from <= *to))
    spread (w, w->lo, w->hi, from, to);
}

/* ---- Pairs ---- */

static void
add_pair_gains (const bt__dynamic_work *w, const bt_vec3 *p, bt_vec3 *q)
{
  for (int k = 0; k < w->rows; k++)
    {
      const bt__constraint *r = w->row + k;
      if (r->pair == 0 || !gains (r))
        continue;
      const int64_t node[4] = { r->node, r->node + 1, r->pair - 1, r->pair };
      const double share[4] = { 1 - r->s, r->s, r->t - 1, -r->t };
      double rise = 0;
      for (int i = 0; i < 4; i++)
        rise += share[i] * bt__dot (r->normal, p[node[i]]);
      for (int side = 0; side < 2; side++)
        add_gains_at (q, r, side, r->stiffness * rise);
    }
}

/* Q plus what the eliminated matrix has more than the whole, times P.  */
static void
take_back (const bt__dynamic_work *w, const bt_vec3 *p, bt_vec3 *q)
{
  bt__dynamic_pair_take_back (w, p, q);
  if (w->coupled)
    add_pair_gains (w, p, q);
}

/* Q = the whole matrix times what elimination makes of Y, which is left in P and FLOW.  */
static void
multiply (const bt__dynamic_work *w, const bt_vec3 *y, bt_vec3 *p, double *flow, bt_vec3 *q)
{
  size_t size = (size_t)(w->n + 1) * sizeof *q;
  memcpy (p, y, size);
  memcpy (q, y, size);
  memset (flow, 0, BT__BENTS * sizeof *flow);
  bt__dynamic_lu_solve_again (w, w->lo, w->hi, p, flow);
  take_back (w, p, q);
}

/* Add SHARE of P and FLOW to the update.  */
static void
add_update (bt__dynamic_work *w, double share, const bt_vec3 *p, const double *flow)
{
  bt__dynamic_sum (w, w->d, w->d, share, p);
  for (int k = 0; k < w->bents; k++)
    w->bent[k].step += share * flow[k];
}

/* BiCGSTAB in the notation of van der Vorst, from what elimination makes of the right-hand side;
   the shadow residual S is the first.  */
static void
solve_with_pairs (bt__dynamic_work *w)
{
  size_t nodes = (size_t)w->n + 1;
  bt_vec3 *r = w->crowd, *p = r + nodes, *v = p + nodes, *ph = v + nodes, *t = ph + nodes,
          *s = t + nodes;
  double flow[BT__BENTS], enough = LITTLE * bt__dynamic_product (w, w->rhs, w->rhs);
  memset (r, 0, BT__CROWD * nodes * sizeof *r);
  take_back (w, w->d, s);
  bt__dynamic_sum (w, p, p, -1, s);
  memcpy (r, p, nodes * sizeof *r);
  memcpy (s, p, nodes * sizeof *r);
  double rho = bt__dynamic_product (w, s, s);
  for (int turn = 0; turn < TURNS && rho != 0; turn++)
    {
      multiply (w, p, ph, flow, v);
      double alpha = rho / bt__dynamic_product (w, s, v);
      add_update (w, alpha, ph, flow);
      bt__dynamic_sum (w, r, r, -alpha, v);
      multiply (w, r, ph, flow, t);
      double size = bt__dynamic_product (w, t, t),
             omega = size > 0 ? bt__dynamic_product (w, t, r) / size : 0;
      add_update (w, omega, ph, flow);
      bt__dynamic_sum (w, r, r, -omega, t);
      double next = bt__dynamic_product (w, s, r);
      if (!(bt__dynamic_product (w, r, r) > enough) || omega == 0)
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
  double flow[BT__BENTS];
  int first, last;
  if (w->coupled)
    chain_rows (w);
  find_part (w, &first, &last);
  if (first > last)
    return bt__dynamic_solve_blocks (w);
  if (w->flows)
    bt__dynamic_bent_flows (w);
  bt__dynamic_solve_around (w, first, last, flow);
  for (int k = 0; k < w->bents; k++)
    w->bent[k].step = flow[k];
  if (w->pairs > 0)
    solve_with_pairs (w);
  return bt__dynamic_largest (w);
}
