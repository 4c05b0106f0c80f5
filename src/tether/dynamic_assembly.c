/* The moving line: the equations of a step.

   One pass along the line gives the tensions and stiffnesses of the intervals and the loads,
   inertia and blocks of the nodes.  What is lumped at nodes, bending and contacts are added by
   passes of their own: everything is a symmetric positive block and a force.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

#define LEVER 0.2      /* of the rest length: the shortest lever of the geometric stiffness */
#define NO_TURN 1e-18  /* of the rest length, squared: a sum of tangents that has no direction */
#define STILL 1e-20    /* m2/s2: of water that does not flow */
#define NOTHING 1e-200 /* m2: a square that is no divisor */

/* A, but for what is less than LEAST: nothing is divided by zero, not even where it is not used. */
static inline bt__pair
at_least (double least, bt__pair a)
{
  return bt__pair_max (a, (bt__pair){ least, least });
}

/* ---- The intervals ---- */

static inline bt_vec3
chord_of (const bt__dynamic_work *w, int j)
{
  bt_vec3 c = bt__sub (w->X[j + 1], w->X[j]);
  return w->chord ? bt__add (c, w->chord[j]) : c;
}

static BT__HOT bt__pair_vec
chords_of (const bt__dynamic_work *w, int i, int j)
{
  bt__pair_vec c = bt__pair_sub (bt__pair_load (w->X + i + 1, w->X + j + 1),
                                 bt__pair_load (w->X + i, w->X + j));
  return w->chord ? bt__pair_add (c, bt__pair_load (w->chord + i, w->chord + j)) : c;
}

/* A tangent for interval J when it has no length: what it had.  */
static void
keep_tangent (bt__dynamic_work *w, int j)
{
  bt__link *k = w->link + j;
  if (!(bt__norm (chord_of (w, j)) > 1e-9 * k->rest))
    k->t = bt__unit_or (bt__sub (w->x[j + 1], w->x[j]), bt__vec (0, 0, -1));
}

/* What two intervals do to the nodes at their ends.  */
typedef struct sides
{
  bt__pair rest, pull;
  bt__pair_vec t;
  bt__pair length, per_length;
  bt__pair_sym k; /* stiffness kg 1 + kd t t^T */
} sides;

static BT__HOT bt__pair_sym
stiffness (bt__pair kg, bt__pair kd, bt__pair_vec t)
{
  bt__pair_vec d = bt__pair_scale (kd, t);
  return (bt__pair_sym){ kg + d.x * t.x, d.x * t.y, d.x * t.z,
                         kg + d.y * t.y, d.y * t.z, kg + d.z * t.z };
}

/* Directions of intervals I and J, to S.  */
static BT__HOT void
measure_links (bt__dynamic_work *w, int i, int j, sides *s)
{
  bt__link *a = w->link + i, *b = w->link + j;
  bt__pair_vec c = chords_of (w, i, j);
  bt__pair square = bt__pair_dot (c, c);
  s->rest = (bt__pair){ a->rest, b->rest };
  s->length = bt__pair_sqrt (square);
  s->per_length = s->length * (1 / at_least (NOTHING, square));
  s->t = bt__pair_scale (s->per_length, c);
  bt__pair_store (&a->t, &b->t, s->t);
  bt__pair shortest = LEVER * s->rest;
  if (bt__pair_any (s->length < shortest))
    {
      keep_tangent (w, i);
      keep_tangent (w, j);
      s->t = bt__pair_load (&a->t, &b->t);
      s->per_length = 1 / bt__pair_max (s->length, shortest);
    }
}

/* Tension and stiffness of intervals I and J, to S.  Return true if one went slack or taut by
   more than the tolerance would tell.  */
static BT__HOT int
assemble_links (bt__dynamic_work *w, int i, int j, int safe, sides *s)
{
  bt__link *a = w->link + i, *b = w->link + j;
  bt__pair spring = { a->ka, b->ka }, zero = { a->zero, b->zero },
           thrust = { a->thrust, b->thrust }, from = { a->start, b->start },
           lam = { w->lam[i], w->lam[j] };
  bt__pair rho = w->rho * s->rest, slack = bt__pair_min (w->soft * spring, w->inertia * s->rest);
  bt__pair length = s->length, stretch = length - zero;
  bt__pair urge = safe ? stretch : lam + rho * stretch;
  bt__mask taut = urge > w->least;
  bt__pair active = bt__pair_where (taut, (bt__pair){ 1, 1 }), was = { a->active, b->active };
  bt__pair ka = slack + bt__pair_where (taut, spring),
           tension = bt__pair_where (taut, spring * stretch);
  s->pull = tension + slack * (length - from) - thrust;
  bt__pair held = safe ? s->pull : lam - thrust;
  bt__pair kg = bt__pair_max (held, (bt__pair){ w->pushed, w->pushed }) * s->per_length,
           kd = ka - kg;
  if (w->stiffen > 0) /* at least as stiff in every direction, slack or not */
    {
      kg = bt__pair_max (kg, w->stiffen * spring);
      kd = bt__pair_max (ka, w->stiffen * spring) - kg;
    }
  s->k = stiffness (kg, kd, s->t);
  bt__pair_store_sym (w->off + i, w->off + j, &s->k);
  a->tension = tension[0];
  b->tension = tension[1];
  a->active = active[0];
  b->active = active[1];
  return bt__pair_any ((active != was) & (bt__pair_abs (urge) > rho * w->tolerance));
}

/* ---- The nodes ---- */

/* Tangent at node I where T, square SQUARE before it was unit, will not do: that of the interval
   before where the line turns back, and one of the fourth order.  */
static bt_vec3
tangent_of (const bt__dynamic_work *w, int i, bt_vec3 t, double square)
{
  const bt_vec3 *X = w->X + i;
  const bt__link *before = w->link + (i > 0 ? i - 1 : 0);
  if (!(square > NO_TURN * before->rest * before->rest))
    t = before->t;
  if (!w->chord || i < 2 || i > w->n - 2)
    return t;
  bt_vec3 twice = bt__sub (X[1], X[-1]);
  return bt__unit_or (bt__axpy (bt__scale (8, twice), -1, bt__sub (X[2], X[-2])), t);
}

/* How two nodes move and how the water flows past them.  */
typedef struct flows
{
  bt__pair_vec tau, acc, side; /* tangent; acceleration; relative velocity across the line, ... */
  bt__pair across, per_across, along; /* ... its size and one by it, and along the line */
} flows;

/* Tangents at nodes I and J between P and Q: those of the parabolas through their neighbours.  */
static BT__HOT bt__pair_vec
turn_nodes (bt__dynamic_work *w, int i, int j, const sides *p, const sides *q)
{
  bt_vec3 *a = &w->node[i].tau, *b = &w->node[j].tau;
  bt__pair_vec t = bt__pair_axpy (bt__pair_scale (q->rest, p->t), p->rest, q->t);
  bt__pair square = bt__pair_dot (t, t);
  t = bt__pair_scale (bt__pair_sqrt (square) * (1 / at_least (NOTHING, square)), t);
  bt__pair_store (a, b, t);
  if (!w->chord && !bt__pair_any (square <= NO_TURN * p->rest * p->rest))
    return t;
  bt_vec3 first = tangent_of (w, i, *a, square[0]), second = tangent_of (w, j, *b, square[1]);
  *a = first;
  *b = second; /* where both are the same, this one is kept */
  return bt__pair_load (a, b);
}

static BT__HOT void
flow_past (const bt__dynamic_work *w, int i, int j, flows *s)
{
  const bt__node *p = w->node + i, *q = w->node + j;
  bt__pair rate = { w->b0, w->b0 };
  bt__pair_vec move
      = bt__pair_sub (bt__pair_load (w->X + i, w->X + j), bt__pair_load (w->x + i, w->x + j));
  bt__pair_vec v = bt__pair_axpy (bt__pair_load (&p->v0, &q->v0), rate, move);
  bt__pair_vec rel = bt__pair_sub (bt__pair_load (&p->current, &q->current), v);
  s->acc = bt__pair_axpy (bt__pair_load (&p->a0, &q->a0), rate, v);
  s->along = bt__pair_dot (rel, s->tau);
  s->side = bt__pair_axpy (rel, -s->along, s->tau);
  bt__pair square = bt__pair_dot (s->side, s->side);
  s->across = bt__pair_sqrt (square);
  s->per_across = bt__pair_where (square > STILL, s->across * (1 / at_least (STILL, square)));
}

/* Drag, weight and inertia of the line about nodes I and J in S: the forces, and their blocks to
   A.  */
static BT__HOT bt__pair_vec
node_loads (const bt__dynamic_work *w, int i, int j, const flows *s, bt__pair_sym *a)
{
  double b0 = w->b0, ca = b0 * b0;
  bt__pair cell = { w->node[i].cell, w->node[j].cell }, wet = { w->node[i].wet, w->node[j].wet };
  bt__pair kn = w->kn * wet * s->across, kt = w->kt * wet * bt__pair_abs (s->along);
  bt__pair ma = w->ma * wet, mn = w->m * cell + ma;
  bt__pair level = ca * mn + b0 * kn, turn = b0 * kn * s->per_across * s->per_across;
  bt__pair tangential = b0 * (2 * kt - kn) - ca * ma;
  bt__pair_vec t = s->tau, c = s->side, at = bt__pair_scale (tangential, t),
               ac = bt__pair_scale (turn, c);
  *a = (bt__pair_sym){ level + at.x * t.x + ac.x * c.x, at.x * t.y + ac.x * c.y,
                       at.x * t.z + ac.x * c.z,         level + at.y * t.y + ac.y * c.y,
                       at.y * t.z + ac.y * c.z,         level + at.z * t.z + ac.z * c.z };
  bt__pair pull = kt * s->along + ma * bt__pair_dot (s->acc, t);
  bt__pair_vec f = bt__pair_axpy (bt__pair_axpy (bt__pair_scale (kn, c), pull, t), -mn, s->acc);
  f.z -= w->weight * cell;
  return f;
}

/* Right-hand sides and diagonal blocks of nodes I and J between P and Q.  */
static BT__HOT void
assemble_nodes (bt__dynamic_work *w, int i, int j, const flows *s, const sides *p, const sides *q)
{
  bt__pair_sym a;
  bt__pair_vec f = node_loads (w, i, j, s, &a);
  f = bt__pair_axpy (bt__pair_axpy (f, -p->pull, p->t), q->pull, q->t);
  a.xx = a.xx + p->k.xx + q->k.xx;
  a.xy = a.xy + p->k.xy + q->k.xy;
  a.xz = a.xz + p->k.xz + q->k.xz;
  a.yy = a.yy + p->k.yy + q->k.yy;
  a.yz = a.yz + p->k.yz + q->k.yz;
  a.zz = a.zz + p->k.zz + q->k.zz;
  bt__pair_store (w->rhs + i, w->rhs + j, f);
  bt__pair_store_sym (w->diag + i, w->diag + j, &a);
}

/* ---- The line ---- */

enum
{
  PART = 16 /* pairs of nodes: what stays at hand */
};

/* P but for what pulls and holds, where THERE is zero.  */
static sides
end_of (const sides *p, bt__pair there)
{
  sides s = { .rest = p->rest, .pull = there * p->pull, .t = p->t };
  s.k = (bt__pair_sym){ there * p->k.xx, there * p->k.xy, there * p->k.xz,
                        there * p->k.yy, there * p->k.yz, there * p->k.zz };
  return s;
}

/* Nodes I + k and J + k between S[k] and S[k + 1].  */
static void
assemble_part (bt__dynamic_work *w, int i, int j, int count, int turning, const sides *s)
{
  flows f[PART];
  for (int k = 0; k < count; k++)
    f[k].tau = turning ? turn_nodes (w, i + k, j + k, s + k, s + k + 1)
                       : bt__pair_load (&w->node[i + k].tau, &w->node[j + k].tau);
  for (int k = 0; k < count; k++)
    flow_past (w, i + k, j + k, f + k);
  for (int k = 0; k < count; k++)
    assemble_nodes (w, i + k, j + k, f + k, s + k, s + k + 1);
}

/* The two halves of the line side by side, which overlap if its intervals are odd.  Short loops
   rather than one, over short parts: their roots and divisions overlap, and what one leaves is at
   hand for the next.  */
static int
assemble_line (bt__dynamic_work *w, bt__mode mode)
{
  int n = w->n, half = (n + 1) / 2, other = n - half, safe = mode == BT__SAFE;
  int turning = mode == BT__QUICK;
  sides s[PART + 1];
  measure_links (w, 0, other > 0 ? other - 1 : 0, s);
  int changed = assemble_links (w, 0, other > 0 ? other - 1 : 0, safe, s);
  s[0] = end_of (s, (bt__pair){ 0, other > 0 });
  for (int from = 0; from < half; from += PART)
    {
      int count = from + PART < half ? PART : half - from;
      for (int k = 0; k < count; k++)
        measure_links (w, from + k, other + from + k, s + k + 1);
      for (int k = 0; k < count; k++)
        changed |= assemble_links (w, from + k, other + from + k, safe, s + k + 1);
      assemble_part (w, from, other + from, count, turning, s);
      s[0] = s[count];
    }
  s[1] = end_of (s, (bt__pair){ 0, 0 });
  assemble_part (w, n, n, 1, turning, s); /* the second is kept */
  return changed;
}

/* ---- What is lumped at nodes ---- */

bt__past
bt__dynamic_past (const bt__dynamic_work *w, int i)
{
  bt_vec3 v = bt__node_v (w, i), rel = bt__sub (w->node[i].current, v);
  return (bt__past){ .v = v, .rel = rel, .speed = bt__norm (rel) };
}

bt_vec3
bt__dynamic_lump_force (const bt__dynamic_work *w, int i, const bt__extra *e, const bt__past *p)
{
  bt_vec3 f = bt__axpy (e->force, e->linear + e->quadratic * p->speed, p->rel);
  f = bt__axpy (f, -e->mass, bt__node_a (w, i, p->v));
  f.z -= e->weight;
  return f;
}

static void
assemble_lumps (bt__dynamic_work *w)
{
  for (int i = w->lo; !w->bodies && i <= w->hi; i++)
    w->rhs[i] = bt__add (w->rhs[i], w->extra[i].force);
  for (int i = w->lo; w->bodies && i <= w->hi; i++)
    {
      const bt__extra *e = w->extra + i;
      bt__past p = bt__dynamic_past (w, i);
      double k = e->linear + e->quadratic * p.speed;
      w->rhs[i] = bt__add (w->rhs[i], bt__dynamic_lump_force (w, i, e, &p));
      bt__sym_add (w->diag + i, w->b0 * (w->b0 * e->mass + k),
                   p.speed > 1e-10 ? w->b0 * e->quadratic / p.speed : 0, p.rel);
    }
}

/* ---- What grips an end ---- */

/* The spring of end E on its node at X.  */
static bt_vec3
grip_force (const bt__dynamic_end *e, bt_vec3 x)
{
  bt_vec3 d = bt__sub (e->at, x);
  const double (*k)[3] = e->stiffness;
  return bt__vec (k[0][0] * d.x + k[0][1] * d.y + k[0][2] * d.z,
                  k[1][0] * d.x + k[1][1] * d.y + k[1][2] * d.z,
                  k[2][0] * d.x + k[2][1] * d.y + k[2][2] * d.z);
}

static void
assemble_grips (bt__dynamic_work *w)
{
  for (int end = 0; end < 2; end++)
    {
      const bt__dynamic_end *e = &w->in->end[end];
      const double (*k)[3] = e->stiffness;
      int i = end ? w->n : 0;
      bt__sym *a = w->diag + i;
      if (!e->free || !e->gripped)
        continue;
      w->rhs[i] = bt__add (w->rhs[i], grip_force (e, w->X[i]));
      *a = (bt__sym){ a->xx + k[0][0], a->xy + k[0][1], a->xz + k[0][2],
                      a->yy + k[1][1], a->yz + k[1][2], a->zz + k[2][2] };
    }
}

static double
grip_potential (const bt__dynamic_work *w)
{
  double sum = 0;
  for (int end = 0; end < 2; end++)
    {
      const bt__dynamic_end *e = &w->in->end[end];
      bt_vec3 x = w->X[end ? w->n : 0];
      if (e->free && e->gripped)
        sum += 0.5 * bt__dot (grip_force (e, x), bt__sub (e->at, x));
    }
  return sum;
}

bt_vec3
bt__dynamic_node_load (bt__dynamic_work *w, int i)
{
  bt__pair_sym unused;
  flows s = { .tau = bt__pair_load (&w->node[i].tau, &w->node[i].tau) };
  flow_past (w, i, i, &s);
  bt__pair_vec f = node_loads (w, i, i, &s, &unused);
  double lost = w->lift * bt__dynamic_line_out (w, i);
  return bt__vec (f.x[0], f.y[0], f.z[0] - lost);
}

int
bt__dynamic_assemble (bt__dynamic_work *w, bt__mode mode)
{
  int changed = assemble_line (w, mode);
  if (w->load)
    for (int i = w->lo; i <= w->hi; i++)
      w->rhs[i] = bt__add (w->rhs[i], w->load[i]);
  assemble_grips (w);
  if (w->lumped)
    assemble_lumps (w);
  if (w->surfaced)
    bt__dynamic_surface_force (w);
  if (w->bends > 0)
    bt__dynamic_bend_force (w, mode);
  if (bt__dynamic_touches (w))
    changed |= bt__dynamic_contact_assemble (w, mode);
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
  double carried = w->ma * (bt__dot (a, a) - at * at);
  double drag = w->kn * s * s * s + w->kt * fabs (along) * along * along;
  double p
      = k->cell * (0.5 * w->m * bt__dot (a, a) / (cv * cv) + w->weight * (w->X[i].z - w->x[i].z))
        + k->wet * (0.5 * carried / (cv * cv) + drag / (3 * cv));
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
  sum += grip_potential (w);
  sum += w->surfaced ? bt__dynamic_surface_potential (w) : 0;
  for (int i = w->lo; i <= w->hi; i++)
    sum += node_potential (w, i);
  for (int j = 0; j < w->n; j++)
    {
      const bt__link *k = w->link + j;
      double stretch = bt__norm (chord_of (w, j)) - k->zero;
      double change = stretch + k->zero - k->start;
      double slack = bt__dynamic_slack (w, j);
      sum += 0.5 * (stretch > w->least ? k->ka : 0) * stretch * stretch - k->thrust * stretch
             + 0.5 * slack * change * change;
    }
  return bt__dynamic_touches (w) ? sum + bt__dynamic_contact_potential (w) : sum;
}
