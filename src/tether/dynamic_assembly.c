/* The moving line: the equations of a step.

   One pass along the line gives the tensions and stiffnesses of the intervals and the loads,
   inertia and blocks of the nodes.  What is lumped at nodes and bending are added by passes of
   their own, and so will a contact be: everything is a symmetric positive block and a force.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

#define LEVER 0.2 /* of the rest length: the shortest lever of the geometric stiffness */

/* ---- The intervals ---- */

static BT__HOT bt_vec3
chord_of (const bt__dynamic_work *w, int j)
{
  bt_vec3 c = bt__sub (w->X[j + 1], w->X[j]);
  return w->chord ? bt__add (c, w->chord[j]) : c;
}

/* Make K at least LEAST stiff in every direction, slack or not.  */
static void
stiffen_link (bt__link *k, double least)
{
  double along = fmax (k->kg + k->kd, least);
  k->kg = fmax (k->kg, least);
  k->kd = along - k->kg;
}

/* Tension and stiffness of interval J.  Return nonzero if it went slack or taut by more than the
   tolerance would tell.  */
static BT__HOT int
assemble_link (bt__dynamic_work *w, int j, int safe)
{
  bt__link *k = w->link + j;
  bt_vec3 c = chord_of (w, j);
  double length = bt__norm (c), stretch = length - k->zero, inverse = 1 / length;
  k->t = length > 1e-9 * k->rest ? bt__scale (inverse, c)
                                 : bt__unit_or (bt__sub (w->x[j + 1], w->x[j]), bt__vec (0, 0, -1));
  double urge = safe ? stretch : w->lam[j] + k->rho * stretch;
  int active = urge > 0, was = k->active;
  double ka = k->slack + (active ? k->ka : 0), tension = active ? k->ka * stretch : 0;
  k->tension = tension;
  k->pull = tension + k->slack * (length - k->start) - k->thrust;
  double held = safe ? k->pull : w->lam[j] - k->thrust;
  if (length < LEVER * k->rest)
    inverse = 1 / (LEVER * k->rest);
  k->kg = held > 0 ? held * inverse : 0;
  k->kd = ka - k->kg;
  if (w->stiffen > 0)
    stiffen_link (k, w->stiffen * k->ka);
  k->active = active;
  bt__sym off = { 0 };
  bt__sym_add (&off, k->kg, k->kd, k->t);
  w->off[j] = off;
  return active != was && fabs (urge) > k->rho * w->tolerance;
}

/* ---- The nodes ---- */

/* Tangent at node I: that of the parabola through its neighbours.  */
static BT__HOT bt_vec3
node_tangent (const bt__dynamic_work *w, int i)
{
  if (i == 0)
    return w->link[0].t;
  const bt__link *p = w->link + i - 1, *q = w->link + i;
  if (i == w->n)
    return p->t;
  bt_vec3 t = bt__axpy (bt__scale (q->rest, p->t), p->rest, q->t);
  if (w->chord && i > 1 && i < w->n - 1)
    t = bt__axpy (bt__scale (8, bt__sub (w->X[i + 1], w->X[i - 1])), -1,
                  bt__sub (w->X[i + 2], w->X[i - 2]));
  double square = bt__dot (t, t);
  return square > 1e-18 * p->rest * p->rest ? bt__scale (1 / sqrt (square), t) : p->t;
}

/* How node I moves and how the water flows past it.  */
static BT__HOT void
node_flow (bt__dynamic_work *w, int i)
{
  bt__node *k = w->node + i;
  bt_vec3 v = bt__node_v (w, i), rel = bt__sub (k->current, v);
  k->acc = bt__node_a (w, i, v);
  k->along = bt__dot (rel, k->tau);
  k->across = bt__axpy (rel, -k->along, k->tau);
  k->side = sqrt (bt__dot (k->across, k->across));
  k->per_side = k->side > 1e-10 ? 1 / k->side : 0;
}

/* Drag, weight and inertia of the line about node I: the force, and its block to A.  */
static BT__HOT bt_vec3
node_load (const bt__dynamic_work *w, int i, bt__sym *a)
{
  const bt__node *k = w->node + i;
  double cell = k->cell, kn = w->kn * cell * k->side, kt = w->kt * cell * fabs (k->along);
  double ma = w->ma * cell, mn = w->m * cell + ma, ca = w->b0 * w->b0;
  double level = ca * mn + w->b0 * kn, turn = w->b0 * kn * k->per_side * k->per_side;
  double tangential = w->b0 * (2 * kt - kn) - ca * ma,
         pull = kt * k->along + ma * bt__dot (k->acc, k->tau);
  bt_vec3 t = k->tau, c = k->across, at = bt__scale (tangential, t), ac = bt__scale (turn, c);
  *a = (bt__sym){ level + at.x * t.x + ac.x * c.x, at.x * t.y + ac.x * c.y,
                  at.x * t.z + ac.x * c.z,         level + at.y * t.y + ac.y * c.y,
                  at.y * t.z + ac.y * c.z,         level + at.z * t.z + ac.z * c.z };
  bt_vec3 f = bt__axpy (bt__axpy (bt__scale (kn, c), pull, t), -mn, k->acc);
  f.z -= w->weight * cell;
  return f;
}

static BT__HOT void
add_block (bt__sym *a, const bt__sym *b)
{
  a->xx += b->xx;
  a->xy += b->xy;
  a->xz += b->xz;
  a->yy += b->yy;
  a->yz += b->yz;
  a->zz += b->zz;
}

/* Right-hand side and diagonal block of node I, between its intervals.  */
static BT__HOT void
assemble_node (bt__dynamic_work *w, int i)
{
  bt__sym a;
  bt_vec3 f = node_load (w, i, &a);
  if (i > 0)
    {
      f = bt__axpy (f, -w->link[i - 1].pull, w->link[i - 1].t);
      add_block (&a, w->off + i - 1);
    }
  if (i < w->n)
    {
      f = bt__axpy (f, w->link[i].pull, w->link[i].t);
      add_block (&a, w->off + i);
    }
  w->rhs[i] = f;
  w->diag[i] = a;
}

enum
{
  PART = 16 /* nodes: what stays at hand */
};

/* Short loops rather than one, over short parts of the line: their roots and divisions overlap, and
   what one leaves is at hand for the next.  */
static int
assemble_line (bt__dynamic_work *w, bt__mode mode)
{
  int changed = 0;
  for (int from = 0; from <= w->n; from += PART)
    {
      int to = from + PART < w->n + 1 ? from + PART : w->n + 1;
      int first = from > w->lo ? from : w->lo, last = to - 1 < w->hi ? to - 1 : w->hi;
      for (int j = from; j < to && j < w->n; j++)
        changed |= assemble_link (w, j, mode == BT__SAFE);
      for (int i = from; i < to && mode == BT__QUICK; i++)
        w->node[i].tau = node_tangent (w, i);
      for (int i = first; i <= last; i++)
        node_flow (w, i);
      for (int i = first; i <= last; i++)
        assemble_node (w, i);
    }
  return changed;
}

/* ---- What is lumped at nodes ---- */

static void
assemble_lumps (bt__dynamic_work *w)
{
  for (int i = w->lo; i <= w->hi; i++)
    {
      const bt__extra *e = w->extra + i;
      bt_vec3 v = bt__node_v (w, i), rel = bt__sub (w->node[i].current, v);
      double s = bt__norm (rel), k = e->linear + e->quadratic * s;
      bt_vec3 f = bt__axpy (e->force, k, rel);
      f = bt__axpy (f, -e->mass, bt__node_a (w, i, v));
      f.z -= e->weight;
      w->rhs[i] = bt__add (w->rhs[i], f);
      bt__sym_add (w->diag + i, w->b0 * (w->b0 * e->mass + k),
                   s > 1e-10 ? w->b0 * e->quadratic / s : 0, rel);
    }
}

bt_vec3
bt__dynamic_node_load (bt__dynamic_work *w, int i)
{
  bt__sym unused;
  node_flow (w, i);
  return node_load (w, i, &unused);
}

int
bt__dynamic_assemble (bt__dynamic_work *w, bt__mode mode)
{
  int changed = assemble_line (w, mode);
  if (w->load)
    for (int i = w->lo; i <= w->hi; i++)
      w->rhs[i] = bt__add (w->rhs[i], w->load[i]);
  if (w->lumped)
    assemble_lumps (w);
  if (w->bends > 0)
    bt__dynamic_bend_force (w);
  return changed;
}

/* ---- The potential ---- */

/* Inertia, drag and weight about node I.  */
static double
node_potential (const bt__dynamic_work *w, int i)
{
  const bt__node *k = w->node + i;
  bt_vec3 v = bt__node_v (w, i), a = bt__node_a (w, i, v), rel = bt__sub (k->current, v);
  double along = bt__dot (rel, k->tau), at = bt__dot (a, k->tau);
  double s = bt__norm (bt__axpy (rel, -along, k->tau)), cv = w->b0;
  double inertia = (w->m + w->ma) * bt__dot (a, a) - w->ma * at * at;
  double drag = w->kn * s * s * s + w->kt * fabs (along) * along * along;
  double p = k->cell
             * (0.5 * inertia / (cv * cv) + drag / (3 * cv) + w->weight * (w->X[i].z - w->x[i].z));
  bt_vec3 move = bt__sub (w->X[i], w->x[i]);
  if (w->load)
    p -= bt__dot (w->load[i], move);
  if (!w->lumped)
    return p;
  const bt__extra *e = w->extra + i;
  s = bt__norm (rel);
  return p + 0.5 * e->mass * bt__dot (a, a) / (cv * cv) + e->weight * move.z
         - bt__dot (e->force, move) + s * s * (e->linear / 2 + e->quadratic * s / 3) / cv;
}

double
bt__dynamic_potential (const bt__dynamic_work *w)
{
  double sum = w->bends > 0 ? bt__dynamic_bend_energy (w, w->X) : 0;
  for (int i = w->lo; i <= w->hi; i++)
    sum += node_potential (w, i);
  for (int j = 0; j < w->n; j++)
    {
      const bt__link *k = w->link + j;
      double stretch = bt__norm (chord_of (w, j)) - k->zero;
      double change = stretch + k->zero - k->start;
      sum += 0.5 * (stretch > 0 ? k->ka : 0) * stretch * stretch - k->thrust * stretch
             + 0.5 * k->slack * change * change;
    }
  return sum;
}

/* ---- The ends ---- */

bt_vec3
bt__dynamic_end_pull (bt__dynamic_work *w, int k)
{
  int i = k ? w->n : 0, j = k ? w->n - 1 : 0;
  bt_vec3 c = chord_of (w, j), t = bt__unit_or (c, w->link[j].t);
  double lam = w->lam[j] - w->link[j].thrust;
  bt_vec3 f = bt__scale (k ? -lam : lam, t);
  f = bt__add (f, bt__dynamic_node_load (w, i));
  return w->load ? bt__add (f, w->load[i]) : f;
}
