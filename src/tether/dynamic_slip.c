/* The moving line: layers that stick to each other and slip.

   The wires of an armoured cable that is bent a little are held by friction, and the cable is as
   stiff as a solid one; bent further, layer after layer slips, until each wire bends for itself (K.
   O. Papailiou 1997, A. Cardou 2013).  Bent to and fro, the moment against the curvature is a
   loop, whose area is lost to friction.  Here all layers slip at once: two stiffnesses.  The moment
   of a node is
     EI w / cell + m,   m = K (w - s) / cell,   |m| <= M = K kappa_s,
   w being its turn, K = EI (sticking) - EI, and s the turn by which its layers have slipped, which
   follows so that m keeps its bound: a spring behind a Coulomb slider, as in plasticity with linear
   hardening.  It knows no time: the loop is the same at any rate.  A step minimises what the spring
   stores and the slider takes,
     K |w - s|^2 / (2 cell) up to |m| = M, and M |w - s| - M^2 cell / (2 K) beyond,
   which is convex: no step gains energy by it, whatever its length.  Each iterate has the secant
   stiffness of that, M / |w - s|, a bound of the energy that touches it.

   What has slipped is kept as a curvature, s / cell, at each node of the state, in place of the
   fourth-order part of the loads.  A node's s lies across its tangent and turns with the tangent
   the shortest way, as if the line did not spin about itself.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

static const bt_vec3 down = { 0, 0, -1 };

int
bt__layers_slip (const bt_tether_props *p)
{
  return p->ei > 0 && p->ei_stuck > p->ei && p->slip_curvature > 0;
}

/* ---- Of one node ---- */

/* A line as it lies at X: in a step, of intervals LINK; else with rest lengths REST.  */
typedef struct slip_line
{
  const bt__dynamic_input *in;
  const bt_vec3 *x;
  const bt__link *link;
  const double *rest;
  int n;
} slip_line;

static double
slip_rest (const slip_line *l, int j)
{
  return l->link ? l->link[j].rest : l->rest[j];
}

/* What lies before node I of L, or behind it if AFTER: an interval, or what clamps the line.  */
static bt_vec3
way_at (const slip_line *l, int i, int after)
{
  int j = after ? i : i - 1;
  if (j < 0 || j >= l->n)
    return bt__unit_or (l->in->end[after].direction, down);
  return bt__scale (1 / slip_rest (l, j), bt__sub (l->x[j + 1], l->x[j]));
}

static bt_vec3
middle_of (const slip_line *l, int i)
{
  bt_vec3 after = bt__unit_or (way_at (l, i, 1), down),
          before = bt__unit_or (way_at (l, i, 0), after);
  return bt__unit_or (bt__add (before, after), after);
}

static bt_vec3
turn_at (const slip_line *l, int i)
{
  return bt__sub (way_at (l, i, 1), way_at (l, i, 0));
}

/* m of line in which node I of L turns: half a cell at an end.  */
static double
cell_at (const slip_line *l, int i)
{
  return 0.5 * ((i > 0 ? slip_rest (l, i - 1) : 0) + (i < l->n ? slip_rest (l, i) : 0));
}

/* True if node I of L bends.  */
static int
bends_at (const slip_line *l, int i)
{
  return i == 0 ? l->in->end[0].clamped : i == l->n ? l->in->end[1].clamped : 1;
}

static double
stiffness_of (const bt_tether_props *p)
{
  return p->ei_stuck - p->ei;
}

static double
most_moment (const bt_tether_props *p)
{
  return stiffness_of (p) * p->slip_curvature;
}

/* The part of W - S that springs of stiffness K hold with a moment of MOST at most.  */
static bt_vec3
borne (bt_vec3 w, bt_vec3 s, double k, double most)
{
  bt_vec3 off = bt__sub (w, s);
  double size = bt__norm (off);
  return k * size > most ? bt__scale (most / (k * size), off) : off;
}

/* ---- In a step ---- */

/* The turn of node I as a row without stiffness: at a clamp from its direction.  */
static bt__bend
row_of (const slip_line *l, int i)
{
  double q = i > 0 ? 1 / slip_rest (l, i - 1) : 0, p = i < l->n ? 1 / slip_rest (l, i) : 0;
  bt__bend row = { .first = i - 1, .count = 3, .c = { q, -(p + q), p } };
  if (i == 0)
    row = (bt__bend){ .first = 0, .count = 2, .c = { -p, p } };
  if (i == l->n)
    row = (bt__bend){ .first = i - 1, .count = 2, .c = { q, -q } };
  return row;
}

static slip_line
line_of_step (const bt__dynamic_work *w, const bt_vec3 *x)
{
  return (slip_line){ .in = w->in, .x = x, .link = w->link, .n = w->n };
}

void
bt__dynamic_slip_prepare (bt__dynamic_work *w, const bt__dynamic *d)
{
  if (!bt__layers_slip (w->in->line))
    return;
  slip_line l = line_of_step (w, w->x);
  for (int i = 0; i <= w->n; i++)
    {
      double cell = cell_at (&l, i);
      bt_vec3 b = middle_of (&l, i), s = bt__scale (cell, bt__dynamic_load (d)[i]);
      if (bends_at (&l, i))
        w->slip[w->slips++] = (bt__slip){ .node = i,
                                          .row = row_of (&l, i),
                                          .tangent = b,
                                          .turn = bt__off_axis (b, s),
                                          .k = stiffness_of (w->in->line) / cell };
    }
}

/* Return the turn at X of the node of S; to *SLIPPED the turn by which its layers have slipped,
   carried there if it FOLLOWS.  */
static bt_vec3
look_at (const bt__dynamic_work *w, const bt__slip *s, const bt_vec3 *x, int follows,
         bt_vec3 *slipped)
{
  slip_line l = line_of_step (w, x);
  *slipped = follows ? bt__carry_side (s->turn, s->tangent, middle_of (&l, s->node)) : s->turn;
  return turn_at (&l, s->node);
}

/* Note what the nodes bear at the iterate, and put their stiffness into the blocks.  */
static void
note_borne (bt__dynamic_work *w, int follows)
{
  double most = most_moment (w->in->line);
  for (int r = 0; r < w->slips; r++)
    {
      bt__slip *s = w->slip + r;
      bt_vec3 slipped, turn = look_at (w, s, w->X, follows, &slipped);
      double off = bt__distance (turn, slipped), k = s->k * off > most ? most / off : s->k;
      s->borne = borne (turn, slipped, s->k, most);
      bt__bend_stiffen (w, &s->row, k - s->row.k);
      s->row.k = k;
    }
}

void
bt__dynamic_slip_force (bt__dynamic_work *w, bt__mode mode)
{
  note_borne (w, mode != BT__SAFE);
  for (int r = 0; r < w->slips; r++)
    for (int p = 0; p < w->slip[r].row.count; p++)
      {
        const bt__slip *s = w->slip + r;
        bt_vec3 *f = w->rhs + s->row.first + p;
        *f = bt__axpy (*f, -s->k * s->row.c[p], s->borne);
      }
}

bt_vec3
bt__dynamic_slip_on (bt__dynamic_work *w, int i)
{
  bt_vec3 sum = { 0, 0, 0 };
  note_borne (w, 1);
  for (int r = 0; r < w->slips; r++)
    {
      const bt__slip *s = w->slip + r;
      int p = i - s->row.first;
      if (p >= 0 && p < s->row.count)
        sum = bt__axpy (sum, -s->k * s->row.c[p], s->borne);
    }
  return sum;
}

double
bt__dynamic_slip_potential (const bt__dynamic_work *w, const bt_vec3 *x)
{
  double sum = 0, most = most_moment (w->in->line);
  for (int r = 0; r < w->slips; r++)
    {
      const bt__slip *s = w->slip + r;
      bt_vec3 slipped, turn = look_at (w, s, x, 0, &slipped);
      double off = bt__distance (turn, slipped);
      sum += s->k * off > most ? most * (off - 0.5 * most / s->k) : 0.5 * s->k * off * off;
    }
  return sum;
}

double
bt__slip_thrust (const bt__dynamic_work *w, const double *rest, int i)
{
  int r = i - (w->slips > 0 ? w->slip[0].node : 0);
  if (r < 0 || r >= w->slips)
    return 0;
  const bt__slip *s = w->slip + r;
  slip_line was = { w->in, w->x, NULL, rest, w->n };
  double cell = w->node[i].cell;
  bt_vec3 turn = bt__scale (cell / cell_at (&was, i), turn_at (&was, i));
  return s->k * bt__dot (borne (turn, s->turn, s->k, most_moment (w->in->line)), turn) / cell;
}

/* ---- After it, and of a line as it lies ---- */

void
bt__dynamic_slip_take (bt__dynamic *d, bt__dynamic_work *w)
{
  slip_line l = line_of_step (w, w->X);
  bt_vec3 *kept = bt__dynamic_load (d);
  double most = most_moment (w->in->line);
  for (int i = 0; i <= w->n; i += w->n)
    kept[i] = bt__vec (0, 0, 0);
  for (int r = 0; r < w->slips; r++)
    {
      const bt__slip *s = w->slip + r;
      bt_vec3 slipped, turn = look_at (w, s, w->X, 1, &slipped);
      bt_vec3 now = bt__sub (turn, borne (turn, slipped, s->k, most));
      kept[s->node] = bt__scale (1 / cell_at (&l, s->node), now);
    }
}

void
bt__slipped_along (const bt__dynamic *d, int n, bt_vec3 *out)
{
  const bt_vec3 *slipped = bt__dynamic_load (d);
  const double *rest = bt__dynamic_rest (d);
  double length = bt__dynamic_length (d) - d->owed, behind = 0;
  int64_t j = 0;
  for (int k = 0; k <= n; k++)
    {
      double s = length * k / n;
      while (j < d->n - 1 && behind + rest[j] < s)
        behind += rest[j++];
      double u = fmin ((s - behind) / rest[j], 1);
      out[k] = bt__axpy (bt__scale (1 - u, slipped[j]), u, slipped[j + 1]);
    }
}

double
bt__slip_energy (const bt__dynamic *d, const bt__dynamic_input *in, const bt_vec3 *x)
{
  slip_line was = { in, bt__dynamic_x (d), NULL, bt__dynamic_rest (d), (int)d->n };
  slip_line is = { in, x, NULL, was.rest, was.n };
  double sum = 0, most = most_moment (in->line);
  for (int i = 1; i < is.n; i++)
    {
      double cell = cell_at (&is, i), k = stiffness_of (in->line) / cell;
      bt_vec3 from = middle_of (&was, i), s = bt__scale (cell, bt__dynamic_load (d)[i]);
      s = bt__carry_side (bt__off_axis (from, s), from, middle_of (&is, i));
      bt_vec3 off = borne (turn_at (&is, i), s, k, most);
      sum += 0.5 * k * bt__dot (off, off);
    }
  return sum;
}
