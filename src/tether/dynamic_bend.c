/* The moving line: bending.

   A node bends by w = C_i / l_i - C_{i-1} / l_{i-1}, the turn of the line from one interval to the
   next, and stores EI |w|^2 / (2 cell); the half cell at a clamp turns from its direction to the
   first interval.  For intervals that hardly stretch this is the curvature of the line to second
   order, at any rotation, and it is quadratic in the positions: forces are linear, the blocks are
   constant multiples of the unit, and bending costs no iteration.

   A line that bends keeps its length: its intervals bear compression as they bear tension, and the
   line goes aside under it, as a column buckles.  Of the compression the stiffness of a step takes
   into account as much as leaves every block positive; Newton's way finds the rest.

   The energy of bending also falls when a bent interval shortens, as if it were pushed by EI
   kappa^2.  A line bent to a circle would so be shorter by EI kappa^2 / EA, and no circle between
   clamps: the intervals push back by that thrust, as it is at the start of the step.

   Damping of bending adds D dw/dt / cell to the moment of a node.  The backward difference of w is
   linear in the positions, so a damped row is a row again: stiffer by D b0, about another turn.
   Any D is stable.  At the first node of a line that is wound, where the cell changes too, D
   resists the change of curvature w / cell instead.  The half cell at a clamp has no damping: the
   rate at which the clamp's direction turns is not given.

   A set makes the natural turn of a node other than none (dynamic_set.c): its forces are added at
   every iterate, and the thrust of an interval is EI kappa . (kappa - the natural curvature).
   Those of twist are added with them (dynamic_twist.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

#define CROOKED 1e-6  /* 1/m: no line under compression is straighter, ... */
#define ROUGH 1e-4    /* ... and so much of a compression beyond ... */
#define STRAINED 2e-5 /* ... this strain pushes a node aside, ... */
#define STRAIGHT 1e-4 /* ... while the line turns there by less */
#define SAFELY 0.9    /* of the compression at which a block of a step would be singular */

void
bt__bend_stiffen (bt__dynamic_work *w, const bt__bend *row, double k)
{
  const double *c = row->c;
  for (int p = 0; p < row->count; p++)
    {
      int i = row->first + p;
      w->bend_diag[i] += k * c[p] * c[p];
      if (p + 1 < row->count)
        w->bend_off[i] += k * c[p] * c[p + 1];
      if (p + 2 < row->count)
        w->bend_far[i] += k * c[p] * c[p + 2];
    }
}

static void
add_bend (bt__dynamic_work *w, bt__bend row)
{
  w->bend[w->bends++] = row;
  bt__bend_stiffen (w, &row, row.k);
}

/* The half cell at end K turns from the clamp's direction.  */
static void
add_clamp (bt__dynamic_work *w, int k, double ei)
{
  const bt__dynamic_end *end = w->in->end + k;
  int j = k ? w->n - 1 : 0;
  double l = w->link[j].rest;
  bt_vec3 d = bt__unit_or (end->direction, bt__vec (0, 0, -1));
  if (end->clamped)
    add_bend (w, (bt__bend){ j, 2, 2 * ei / l, { -1 / l, 1 / l, 0 }, d });
}

/* The turn of ROW with places or velocities P in place of X, not counting D.  */
static inline bt_vec3
bend_sum (const bt__bend *row, const bt_vec3 *p)
{
  bt_vec3 sum = { 0, 0, 0 };
  for (int k = 0; k < row->count; k++)
    sum = bt__axpy (sum, row->c[k], bt__sub (p[k], p[0]));
  return sum;
}

/* b0 times the turn of ROW that does not change in the step.  */
static bt_vec3
still_turn (const bt__dynamic_work *w, const bt__bend *row)
{
  bt_vec3 v0[3];
  for (int p = 0; p < row->count; p++)
    v0[p] = w->node[row->first + p].v0;
  return bt__axpy (bt__scale (w->b0, bend_sum (row, w->x + row->first)), -1, bend_sum (row, v0));
}

/* The curvature at the middle of three places X that are FIRST and NEXT metres of line apart.  */
static bt_vec3
curvature_of (const bt_vec3 *x, double first, double next)
{
  bt_vec3 a = bt__scale (1 / first, bt__sub (x[1], x[0])),
          b = bt__scale (1 / next, bt__sub (x[2], x[1]));
  return bt__scale (2 / (first + next), bt__sub (b, a));
}

/* The same for node 1 while the winch turns: the curvature that does not change, for the length of
   line before node 1 does.  The length before the last step follows from the stretch.  */
static bt_vec3
still_first_turn (const bt__dynamic_work *w, const bt__dynamic *d)
{
  const bt_vec3 *dx = bt__dynamic_dx (d);
  bt_vec3 was[3];
  double first = bt__dynamic_rest (d)[0], next = w->link[1].rest,
         stretch = bt__dynamic_stretch (d)[0] - bt__dynamic_dstretch (d)[0];
  for (int i = 0; i < 3; i++)
    was[i] = bt__sub (w->x[i], dx[i]);
  double drawn = bt__distance (was[0], was[1]) - bt__dynamic_chord (d)[0].z;
  double before = stretch > 0 && drawn > 0 ? drawn / stretch : first;
  bt_vec3 now = curvature_of (w->x, first, next), then = curvature_of (was, before, next);
  bt_vec3 still = bt__axpy (bt__scale (w->b0, now), -w->b2, bt__sub (now, then));
  return bt__scale (w->node[1].cell, still);
}

/* ROW with a DAMPING of its turn, N m s; STILL is b0 times the turn that is not damped.  */
static bt__bend
damped (const bt__dynamic_work *w, bt__bend row, double damping, bt_vec3 still)
{
  double k = row.k + w->b0 * damping;
  row.d = bt__scale (1 / k, bt__axpy (bt__scale (row.k, row.d), damping, still));
  row.k = k;
  return row;
}

/* A straight line that is pushed would stay straight under any load: nothing tells it to which side
   to buckle.  So ROW of a node between pushed intervals has a natural curvature, for as long as the
   line there is straighter, and is pushed out of line by a little of the compression, to this side
   or to that by the bits of a number: waves of every length grow.  A line without stiffness bears
   no compression, and does not buckle.  */
static void
add_crook (const bt__dynamic_work *w, bt__bend *row)
{
  int i = row->first + 1;
  double cell = w->node[i].cell, turn = CROOKED * cell;
  double pushed = -fmax (w->lam[i - 1], w->lam[i]);
  if (!(row->k > 0) || pushed < 0
      || bt__turn_square (w->x + i, w->link[i - 1].rest, w->link[i].rest) > STRAIGHT * STRAIGHT)
    return;
  bt_vec3 t = bt__sub (w->x[i + 1], w->x[i - 1]);
  double aside = ROUGH * fmax (0, pushed - STRAINED * w->ea) * cell / row->k;
  turn += (uint32_t)i * 2654435769u >> 31 ? aside : -aside;
  row->d
      = bt__scale (turn, bt__unit_or (bt__cross (t, bt__vec (t.y, t.z, t.x)), bt__vec (0, 0, 1)));
}

/* The greatest compression, N, that leaves every block of a step positive, whatever the wave:
   inertia gives m b0^2 to a wave of any number q, bending EI q^4, and a compression P takes P q^2.
 */
static double
pushed_most (const bt__dynamic_work *w, double ei)
{
  double inertia = w->b0 * w->b0 * w->m, l = w->link[w->n - 1].rest;
  return SAFELY * fmax (2 * sqrt (inertia * ei), inertia * l * l / 4);
}

/* The square of the curvature at node I as the step starts, with the REST lengths before the winch
   turns; with a set, the product of the curvature and the curvature beyond the natural one.  */
static double
thrusting_square (const bt__dynamic_work *w, const double *rest, int i)
{
  double before = rest[i - 1], after = rest[i], cell = 0.5 * (before + after);
  if (!w->is_set)
    return bt__bend_square (w->x + i, before, after);
  double all = bt__turn_square (w->x + i, before, after),
         set = bt__dot (bt__turn_of (w->x + i, before, after), w->natural[i]);
  set *= cell / w->node[i].cell;
  return fmax (-BT__SHARPEST, fmin (all - set, BT__SHARPEST)) / (cell * cell);
}

/* The thrust of node I, N.  */
static double
thrust_at (const bt__dynamic_work *w, const double *rest, int i)
{
  double thrust = w->in->line->ei * thrusting_square (w, rest, i);
  return w->slips > 0 ? thrust + bt__slip_thrust (w, rest, i) : thrust;
}

static void
prepare_thrust (bt__dynamic_work *w, const double *rest)
{
  double before = 0;
  for (int j = 0; j < w->n; j++)
    {
      bt__link *k = w->link + j;
      double after = j + 1 < w->n ? thrust_at (w, rest, j + 1) : before;
      k->thrust = 0.5 * ((j ? before : after) + after);
      before = after;
    }
}

void
bt__dynamic_bend_prepare (bt__dynamic_work *w, const bt__dynamic *d)
{
  double ei = w->in->line->ei, damping = w->in->line->bending_damping;
  size_t size = (size_t)(w->n + 1) * sizeof (double);
  w->bends = w->slips = w->is_set = w->twists = 0;
  w->least = ei > 0 ? -INFINITY : 0;
  w->pushed = ei > 0 ? -pushed_most (w, ei) : 0;
  if (!(ei > 0 || damping > 0))
    return;
  w->is_set = w->in->n_sets > 0 && ei > 0;
  bt__dynamic_twist_prepare (w, d);
  if (w->is_set || w->twists)
    bt__dynamic_set_forces (w, w->x);
  bt__dynamic_slip_prepare (w, d);
  prepare_thrust (w, bt__dynamic_rest (d));
  bt__dynamic_unfold (w, d);
  memset (w->bend_diag, 0, size);
  memset (w->bend_off, 0, size);
  memset (w->bend_far, 0, size);
  for (int i = 1; i < w->n; i++)
    {
      double q = 1 / w->link[i - 1].rest, p = 1 / w->link[i].rest;
      bt__bend row = { i - 1, 3, ei / w->node[i].cell, { q, -(p + q), p }, { 0, 0, 0 } };
      if (!w->is_set)
        add_crook (w, &row);
      if (damping > 0)
        {
          int winds = i == 1 && w->link[0].rest != bt__dynamic_rest (d)[0];
          bt_vec3 still = winds ? still_first_turn (w, d) : still_turn (w, &row);
          row = damped (w, row, damping / w->node[i].cell, still);
        }
      add_bend (w, row);
    }
  add_clamp (w, 0, ei);
  add_clamp (w, 1, ei);
  for (int i = 1; i < w->n && w->is_set; i++)
    w->bend_diag[i] += bt__set_hold (w, i);
  if (w->twists)
    bt__dynamic_twist_hold (w);
}

static inline bt_vec3
turn_of (const bt__bend *row, const bt_vec3 *X)
{
  bt_vec3 sum = bt__scale (-1, row->d);
  for (int p = 0; p < row->count; p++)
    sum = bt__axpy (sum, row->c[p], bt__sub (X[row->first + p], X[row->first]));
  return sum;
}

void
bt__dynamic_bend_force (bt__dynamic_work *w, bt__mode mode)
{
  for (int k = 0; k < w->bends; k++)
    {
      const bt__bend *row = w->bend + k;
      bt_vec3 turn = turn_of (row, w->X);
      for (int p = 0; p < row->count; p++)
        {
          bt_vec3 *r = w->rhs + row->first + p;
          *r = bt__axpy (*r, -row->k * row->c[p], turn);
        }
    }
  if (w->slips > 0)
    bt__dynamic_slip_force (w, mode);
  if (!w->is_set && !w->twists)
    return;
  bt__dynamic_set_forces (w, w->X);
  for (int i = 0; i <= w->n; i++)
    w->rhs[i] = bt__add (w->rhs[i], w->twist[i]);
}

/* Add what row ROW does on node I, if it is of that node.  */
static bt_vec3
add_row_on (const bt__dynamic_work *w, int row, int i, bt_vec3 sum)
{
  const bt__bend *b = w->bend + row;
  int p = i - b->first;
  return p >= 0 && p < b->count ? bt__axpy (sum, -b->k * b->c[p], turn_of (b, w->X)) : sum;
}

/* Inner node I has row I - 1; clamps have the last.  */
bt_vec3
bt__dynamic_bend_on (bt__dynamic_work *w, int i)
{
  bt_vec3 sum = { 0, 0, 0 };
  if (w->is_set || w->twists)
    {
      bt__dynamic_set_forces (w, w->X);
      sum = w->twist[i];
    }
  if (w->slips > 0)
    sum = bt__add (sum, bt__dynamic_slip_on (w, i));
  int inner = w->n - 1, from = i > 2 ? i - 2 : 0, to = i < inner ? i + 1 : inner;
  for (int k = from; k < to; k++)
    sum = add_row_on (w, k, i, sum);
  for (int k = inner; k < w->bends; k++)
    sum = add_row_on (w, k, i, sum);
  return sum;
}

double
bt__dynamic_bend_energy (const bt__dynamic_work *w, const bt_vec3 *X)
{
  double sum = 0;
  for (int k = 0; k < w->bends; k++)
    {
      bt_vec3 turn = turn_of (w->bend + k, X);
      sum += 0.5 * w->bend[k].k * bt__dot (turn, turn);
    }
  if (w->slips > 0)
    sum += bt__dynamic_slip_potential (w, X);
  return w->is_set || w->twists ? sum + bt__dynamic_set_potential (w, X) : sum;
}
