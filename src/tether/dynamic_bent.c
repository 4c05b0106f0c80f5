/* The moving line: sliding nodes, about which the line runs as about a wire or an edge.  The method
   is Eulerian on Lagrangian (S. Sueda et al., "Large-scale dynamic simulation of highly constrained
   strands", 2011).

   A sliding node stays in place across the edge, and line runs through the node: FLOW metres of
   rest length go in a step from the interval before the node to the interval after.  Each sliding
   node adds an unknown, the flow, and an equation, the capstan's:
     T_b + c = (T_a + c) exp (wrap k),   k = drag / max (|drag, side|, slip).

   DRAG is the length by which the line was drawn from where the line stuck: friction grows with
   DRAG and is complete at SLIP, as in every contact.  The force c is a hundredth of a newton.
   Without c a slack line would hold nothing however often the line is wound round, and a nearly
   slack line would hold anything in one step and nothing in the next.

   A flow is one more unknown of its node (dynamic_lu.c).  Its equation and what it does to the
   nodes are not symmetric, because friction is not.

   The safe way leaves the flows out, or the direction found would not descend: flows then follow
   the places from one iteration to the next, as friction follows the loads.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

#define LEAST 0.02    /* of an interval: what line leaves of it in a step */
#define CLING 0.01    /* N: what a slack line holds on by */
#define SOFT 1e-6     /* of the stiffness: what resists the flow between slack intervals */
#define FOLLOWS 60    /* iterations for a flow that follows the places */
#define SETTLED 1e-13 /* m */
#define STICKS 0.25   /* of SLIP: a node that goes less in a step may stick */

/* ---- The intervals before and after ---- */

/* The surplus of interval J, m.  */
static double
rounded_by (const bt__dynamic_work *w, int64_t j)
{
  return w->rounded ? w->round[j] : 0;
}

/* An interval at a bent node: the tension, and the tension's gain with the interval's length, and
   with less rest length.  */
typedef struct leg
{
  double tension, along, by_rest, soft;
  bt_vec3 t;
} leg;

/* The length of the line of interval J: of the chord but for the surplus, m.  */
static double
length_at_bend (const bt__dynamic_work *w, int64_t j)
{
  bt_vec3 c = bt__sub (w->X[j + 1], w->X[j]);
  return bt__norm (w->chord ? bt__add (c, w->chord[j]) : c) - rounded_by (w, j);
}

static leg
leg_of (const bt__dynamic_work *w, int64_t j)
{
  const bt__link *k = w->link + j;
  int active = k->active > 0 && (k->tension > 0 || w->least == 0);
  return (leg){ .tension = active * k->tension,
                .along = active * k->ka,
                .by_rest = active * k->ka * length_at_bend (w, j) / k->rest,
                .soft = SOFT * k->ka,
                .t = k->t };
}

void
bt__dynamic_lengthen (bt__dynamic_work *w, int64_t j, double more)
{
  bt__link *k = w->link + j;
  double ratio = (k->rest + more) / k->rest;
  k->rest *= ratio;
  k->zero = ratio * (k->zero - rounded_by (w, j)) + rounded_by (w, j);
  k->ka /= ratio;
}

/* Let MORE flow at B, as far as there is line.  Return what did.  */
static double
let_flow (bt__dynamic_work *w, bt__dynamic_bent *b, double more)
{
  double before = w->link[b->node - 1].rest, after = w->link[b->node].rest;
  more = fmin (fmax (more, -(1 - LEAST) * after), (1 - LEAST) * before);
  bt__dynamic_lengthen (w, b->node - 1, -more);
  bt__dynamic_lengthen (w, b->node, more);
  b->flow += more;
  return more;
}

/* ---- Friction ---- */

/* The share K of the whole friction that is along the line, and its derivative by the drag.  */
static double
share_of (const bt__dynamic_bent *b, double drag, double *slope)
{
  double size = hypot (drag, b->side_now);
  if (size <= b->slip)
    {
      *slope = 1 / b->slip;
      return drag / b->slip;
    }
  *slope = b->side_now * b->side_now / (size * size * size);
  return drag / size;
}

static double
side_of (const bt__dynamic_work *w, const bt__dynamic_bent *b)
{
  bt_vec3 moved = bt__sub (bt__sub (w->X[b->node], w->x[b->node]), b->drift);
  return b->side + bt__dot (b->axis, moved);
}

/* ---- The equations of the nodes ---- */

static bt_vec3
spring_of (const bt__dynamic_work *w, const bt__dynamic_bent *b)
{
  bt_vec3 away = bt__sub (b->at, w->X[b->node]);
  return bt__scale (b->stiffness, bt__off_axis (b->axis, away));
}

/* The way along the edge that friction of B answers, m.  */
static double
answered_by (const bt__dynamic_bent *b)
{
  return b->side_now + BT__STICK_DAMPING * (b->side_now - b->side);
}

/* The force on node B at its place; *SLOPE is the stiffness along the edge, N/m.  */
static bt_vec3
bent_force (bt__dynamic_work *w, bt__dynamic_bent *b, double *slope)
{
  b->side_now = side_of (w, b);
  double answered = answered_by (b);
  double size = hypot (b->drag + b->flow, answered), most = b->load > 0 ? b->friction * b->load : 0;
  double ks = most / fmax (size, b->slip), part = answered / size;
  *slope = (1 + BT__STICK_DAMPING) * (size > b->slip ? ks * fmax (1 - part * part, 0) : ks);
  return bt__axpy (spring_of (w, b), -ks * answered, b->axis);
}

static void
assemble_bent (bt__dynamic_work *w, bt__dynamic_bent *b)
{
  double slope;
  b->force = bent_force (w, b, &slope);
  w->rhs[b->node] = bt__add (w->rhs[b->node], b->force);
  bt__sym_add (w->diag + b->node, b->stiffness, slope - b->stiffness, b->axis);
}

void
bt__dynamic_bent_assemble (bt__dynamic_work *w, bt__mode mode)
{
  w->flows = mode != BT__SAFE;
  for (int k = 0; k < w->bents; k++)
    assemble_bent (w, w->bent + k);
}

double
bt__dynamic_bent_potential (const bt__dynamic_work *w)
{
  double sum = 0;
  for (int k = 0; k < w->bents; k++)
    {
      const bt__dynamic_bent *b = w->bent + k;
      bt_vec3 f = spring_of (w, b);
      double size = fabs (side_of (w, b)), most = b->load > 0 ? b->friction * b->load : 0;
      double floor = fmax (b->slip, fabs (b->drag + b->flow));
      sum += 0.5 * bt__dot (f, f) / b->stiffness
             + most * (size < floor ? 0.5 * size * size / floor : size - 0.5 * floor);
    }
  return sum;
}

/* ---- The equations of the flows ---- */

/* The equation of the flow at B: the lack T_b - e T_a is to become zero.  */
static bt__flow
flow_of (const bt__dynamic_work *w, bt__dynamic_bent *b)
{
  leg before = leg_of (w, b->node - 1), after = leg_of (w, b->node);
  double bends, k = share_of (b, b->drag + b->flow, &bends), e = exp (b->wrap * k);
  double slope = (before.tension + CLING) * e * b->wrap * bends;
  b->gain[0] = before.by_rest;
  b->gain[1] = after.by_rest;
  bt_vec3 p = bt__scale (before.by_rest, before.t), q = bt__scale (after.by_rest, after.t),
          c = bt__scale (e * before.along, before.t), d = bt__scale (after.along, after.t);
  return (bt__flow){ .node = b->node,
                     .column = { bt__scale (-1, p), bt__add (p, q), bt__scale (-1, q) },
                     .row = { c, bt__scale (-1, bt__add (c, d)), d },
                     .own
                     = -(after.by_rest + e * before.by_rest + slope + before.soft + after.soft),
                     .beside = { e * before.by_rest, after.by_rest },
                     .right = e * (before.tension + CLING) - after.tension - CLING };
}

/* Friction of B along its edge follows the load in the equations, unless the load is all that both
   tensions can press with; these are not known before the first iteration.  */
static void
follow_load (bt__dynamic_work *w, const bt__dynamic_bent *b, bt__flow *f)
{
  double load = bt__dot (b->normal, spring_of (w, b)), answered = answered_by (b);
  if (!(b->load > 0 && load > 0 && b->load < b->pull[0] + b->pull[1]))
    return;
  double size = fmax (hypot (b->drag + b->flow, answered), b->slip);
  f->gain = bt__scale (-b->friction * answered / size, b->axis);
  f->press = bt__scale (b->stiffness, b->normal);
  w->rhs[b->node] = bt__axpy (w->rhs[b->node], load - b->load, f->gain);
}

void
bt__dynamic_bent_flows (bt__dynamic_work *w)
{
  for (int k = 0; k < w->bents; k++)
    {
      w->flow[k] = flow_of (w, w->bent + k);
      if (w->coupled)
        follow_load (w, w->bent + k, w->flow + k);
    }
}

/* ---- Flows that follow the places ---- */

/* The legs of a bent node as they share their line: what they could span without tension, m of rest
   length, how much they have, and the tension of a stretch by one.  */
typedef struct share
{
  double a, b, rest_a, rest_b, unit;
  double zero_a, zero_b; /* of the rest length, where there is no tension */
} share;

static share
share_out (const bt__dynamic_work *w, const bt__dynamic_bent *b)
{
  const bt__link *p = w->link + b->node - 1, *q = p + 1;
  share s = { .rest_a = p->rest, .rest_b = q->rest, .unit = p->ka * p->rest };
  s.zero_a = (p->zero - rounded_by (w, b->node - 1)) / p->rest;
  s.zero_b = (q->zero - rounded_by (w, b->node)) / q->rest;
  s.a = length_at_bend (w, b->node - 1) / s.zero_a;
  s.b = length_at_bend (w, b->node) / s.zero_b;
  return s;
}

/* What T_b exceeds exp (wrap k) T_a by when MORE has flowed; *SLOPE its derivative, below zero.  */
static double
lack_at (const bt__dynamic_bent *b, const share *s, double more, double *slope)
{
  double bends, k = share_of (b, b->drag + b->flow + more, &bends), e = exp (b->wrap * k);
  double ra = s->rest_a - more, rb = s->rest_b + more;
  double ta = s->unit * s->zero_a * (s->a / ra - 1), tb = s->unit * s->zero_b * (s->b / rb - 1);
  *slope = -s->unit * (s->zero_b * s->b / (rb * rb) + e * s->zero_a * s->a / (ra * ra))
           - (ta + CLING) * e * b->wrap * bends;
  return tb + CLING - e * (ta + CLING);
}

/* What must flow at B so that the tensions are right where the nodes are.  Both legs are taut, or
   neither is: then they share what is slack,
   or friction keeps it.  */
static double
wanted_flow (const bt__dynamic_work *w, const bt__dynamic_bent *b)
{
  share s = share_out (w, b);
  double even = (s.rest_a * s.b - s.rest_b * s.a) / (s.a + s.b);
  double low = s.rest_a - s.a, high = s.b - s.rest_b, f = even, slope;
  if (!(low < high) && b->wrap > 0)
    return fmin (fmax (-b->drag - b->flow, high), low);
  if (!(low < high))
    return isfinite (even) ? even : 0;
  for (int i = 0; i < FOLLOWS; i++)
    {
      double lack = lack_at (b, &s, f, &slope), next = f - lack / slope;
      if (lack > 0)
        low = f;
      else
        high = f;
      if (!(next > low && next < high))
        next = 0.5 * (low + high);
      if (fabs (next - f) < SETTLED)
        return next;
      f = next;
    }
  return f;
}

static void
follow (bt__dynamic_work *w, bt__dynamic_bent *b)
{
  b->side_now = side_of (w, b);
  let_flow (w, b, wanted_flow (w, b));
}

/* What the obstacle bears: never more than both tensions, whatever was done to the places.  The
   force is that of the places after the iteration.  */
static void
bear (bt__dynamic_work *w, bt__dynamic_bent *b)
{
  double slope;
  b->pull[0] = fmax (w->lam[b->node - 1], 0);
  b->pull[1] = fmax (w->lam[b->node], 0);
  b->load = fmin (bt__dot (b->normal, spring_of (w, b)), b->pull[0] + b->pull[1]);
  b->load = fmax (b->load, 0);
  b->force = bent_force (w, b, &slope);
}

void
bt__dynamic_bent_follow (bt__dynamic_work *w)
{
  for (int k = 0; k < w->bents; k++)
    {
      follow (w, w->bent + k);
      bear (w, w->bent + k);
    }
}

/* ---- After an iteration ---- */

/* The tensions are those of the linear equations, the flows what then suits the places.  Between
   slack intervals the linear equations may swing to and fro while those flows stand.  */
void
bt__dynamic_bent_take (bt__dynamic_work *w, double share)
{
  double before[BT__BENTS];
  for (int k = 0; k < w->bents; k++)
    {
      bt__dynamic_bent *b = w->bent + k;
      before[k] = b->flow;
      if (!w->flows)
        continue;
      w->lam[b->node - 1] += share * b->gain[0] * b->step;
      w->lam[b->node] -= share * b->gain[1] * b->step;
      let_flow (w, b, share * b->step);
    }
  bt__dynamic_bent_follow (w);
  w->flowed = 0;
  for (int k = 0; k < w->bents; k++)
    w->flowed = fmax (w->flowed, fabs (w->bent[k].flow - before[k]));
}

/* ---- From outside ---- */

void
bt__dynamic_bent_stop (bt__dynamic_work *w)
{
  for (int k = 0; k < w->bents; k++)
    {
      let_flow (w, w->bent + k, -w->bent[k].flow);
      w->bent[k].flow = 0;
    }
}

/* A sliding node starts where it is held, but along its edge as predicted, unless that is so little
   that it may stick: at rest it would be stirred up.  */
void
bt__dynamic_bend (bt__dynamic_work *w, bt__dynamic_bent *bent, int n)
{
  w->bent = bent;
  w->bents = n;
  for (int k = 0; k < n; k++)
    {
      double guess = bent[k].flow;
      bent[k].flow = 0;
      let_flow (w, bent + k, guess);
      bt_vec3 *X = w->X + bent[k].node, away = bt__sub (*X, bent[k].at);
      double along = bt__dot (bent[k].axis, away);
      *X = bt__axpy (bent[k].at, fabs (along) > STICKS * bent[k].slip ? along : 0, bent[k].axis);
    }
  for (int k = 0; k < n; k++)
    follow (w, bent + k);
}
