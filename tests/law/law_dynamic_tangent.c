/* The tangent of friction that follows the loads is that of the forces: what is solved for takes
   the forces left over to zero at the rate at which they are, by central differences; of touches
   that stick, slide, bear or do not, with loads that wander, of two places that push each other
   apart, and of sliding nodes through which line flows.

   What friction of a sliding node turns from along the line to along its edge is left out of the
   equations, and so of this law: its nodes stick, or slide along the edge alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_bent.h"

enum
{
  TOUCHES = 10,
  STATES = 200
};

#define DEEP 2e-3 /* m: no touch is deeper in, or farther out */
#define WAY 1e-7  /* m: of the farthest node, to either side */

/* What is solved for, and the forces left over.  */
typedef struct state
{
  scene s;
  bt_vec3 force[BENT + 1];
  bt__constraint row[TOUCHES];
  bt__dynamic_bent bent[2];
} state;

typedef struct left
{
  bt_vec3 node[BENT + 1];
  double flow[2];
} left;

/* From A to B.  */
static double
between (double a, double b)
{
  return 0.5 * (a + b + (b - a) * thrown ());
}

static bt_vec3
any_way (double size)
{
  double x = thrown (), y = thrown ();
  return bt__scale (size, bt__unit_or (bt__vec (x, y, thrown ()), bt__vec (1, 0, 0)));
}

static bt_vec3
across (bt_vec3 v, bt_vec3 n)
{
  return bt__axpy (v, -bt__dot (v, n), n);
}

static bt_vec3
place (const bt_vec3 *p, double s)
{
  return bt__axpy (bt__scale (1 - s, p[0]), s, p[1]);
}

/* A touch, in by up to DEEP or out; every third is of a load that wanders; with PAIRS every fifth
   is of two places.  */
static void
draw_touch (const bt__dynamic_work *w, bt__constraint *r, int k, int pairs)
{
  int64_t node = (int64_t)between (0, BENT / 2 - 1);
  *r = (bt__constraint){ .node = node,
                         .s = between (0, 1),
                         .t = between (0, 1),
                         .normal = any_way (1),
                         .stiffness = 1e4,
                         .friction = between (0, 0.8),
                         .slip = 2e-3,
                         .active = -1 };
  bt_vec3 at = place (w->X + node, r->s), was = place (w->x + node, r->s);
  if (pairs && k % 5 == 0)
    {
      r->pair = node + BENT / 2;
      at = bt__sub (at, place (w->X + r->pair - 1, r->t));
      was = bt__sub (was, place (w->x + r->pair - 1, r->t));
    }
  else if (k % 3 == 0)
    r->roll = between (0, 3);
  r->tilt = bt__dot (r->normal, bt__sub (w->X[node + 1], w->X[node])) + between (-0.1, 0.1);
  r->drift = bt__sub (at, was);
  r->stick = across (any_way (between (0, 2) * r->slip), r->normal);
  double deep = between (0.1 * DEEP, DEEP);
  r->offset = bt__dot (r->normal, at) + (k % 4 ? deep : -deep);
  r->load = k % 4 ? r->stiffness * deep : 0;
}

/* A sliding node that sticks, or slides along its edge alone.  */
static void
draw_bent (const bt__dynamic_work *w, bt__dynamic_bent *b, int64_t node, int slides)
{
  *b = (bt__dynamic_bent){ .node = node,
                           .axis = any_way (1),
                           .stiffness = 1e4,
                           .wrap = between (0.1, 1),
                           .friction = between (0, 0.8),
                           .slip = 2e-3,
                           .load = between (5, 20),
                           .pull = { 1e3, 1e3 } };
  b->normal = bt__unit_or (across (any_way (1), b->axis), bt__vec (0, 0, 1));
  b->at = bt__axpy (w->X[node], b->load / b->stiffness, b->normal);
  b->drift = bt__sub (w->X[node], w->x[node]);
  b->drag = slides ? 0 : between (-0.3, 0.3) * b->slip;
  b->side = (slides ? between (1.2, 3) : between (-0.5, 0.5)) * b->slip;
}

/* The loads of the present places.  */
static void
press (bt__dynamic_work *w)
{
  bt__dynamic_assemble (w, BT__FROZEN);
  for (int k = 0; k < w->rows; k++)
    w->row[k].load = fmax (bt__dot (w->row[k].force, w->row[k].normal), 0);
  for (int k = 0; k < w->bents; k++)
    w->bent[k].load = bt__dot (w->bent[k].force, w->bent[k].normal);
}

/* The forces left over at the present places, which are solved for.  */
static void
look (bt__dynamic_work *w, left *l)
{
  press (w);
  bt__dynamic_assemble (w, BT__FROZEN);
  bt__dynamic_solve (w);
  memcpy (l->node, w->rhs, sizeof l->node);
  if (w->bents > 0)
    bt__dynamic_bent_flows (w);
  for (int k = 0; k < w->bents; k++)
    l->flow[k] = w->flow[k].right;
}

/* A crooked line, all of it taut; its tensions are the multipliers.  */
static void
draw_state (state *t, int pairs, int bents)
{
  bt__dynamic_work *w = t->s.work;
  for (int i = 0; i <= BENT; i++)
    {
      t->force[i] = any_way (50);
      w->X[i] = bt__add (bt__vec (2.6 * i / BENT, 0, 0), any_way (0.02));
    }
  w->load = t->force;
  w->row = t->row;
  w->rows = TOUCHES;
  for (int k = 0; k < TOUCHES; k++)
    draw_touch (w, t->row + k, k, pairs);
  w->bent = t->bent;
  w->bents = bents;
  for (int k = 0; k < bents; k++)
    draw_bent (w, t->bent + k, BENT / 2 + k, k % 2);
  w->coupled = 0;
  bt__dynamic_assemble (w, BT__QUICK);
  for (int j = 0; j < w->n; j++)
    w->lam[j]
        = w->link[j].tension
          + bt__dynamic_slack (w, j) * (bt__distance (w->X[j], w->X[j + 1]) - w->link[j].start);
  w->coupled = 1;
}

/* Go by SHARE of what was solved for, D and STEP.  */
static void
go (bt__dynamic_work *w, double share, const bt_vec3 *d, const double *step)
{
  for (int i = 0; i <= w->n; i++)
    w->X[i] = bt__axpy (w->X[i], share, d[i]);
  for (int k = 0; k < w->bents; k++)
    {
      bt__dynamic_lengthen (w, w->bent[k].node - 1, -share * step[k]);
      bt__dynamic_lengthen (w, w->bent[k].node, share * step[k]);
      w->bent[k].flow += share * step[k];
    }
}

/* How far the forces left over are from zero, by their rate, of the most.  */
static double
off_the_tangent (bt__dynamic_work *w)
{
  left now, ahead, back;
  bt_vec3 d[BENT + 1];
  double step[2] = { 0, 0 }, most = 0, worst = 0;
  look (w, &now);
  memcpy (d, w->d, sizeof d);
  for (int k = 0; k < w->bents; k++)
    step[k] = w->bent[k].step;
  double h = WAY / bt__dynamic_largest (w);
  go (w, h, d, step);
  look (w, &ahead);
  go (w, -2 * h, d, step);
  look (w, &back);
  for (int i = 0; i <= w->n; i++)
    {
      bt_vec3 rate = bt__scale (1 / (2 * h), bt__sub (ahead.node[i], back.node[i]));
      most = fmax (most, bt__norm (now.node[i]));
      worst = fmax (worst, bt__norm (bt__add (rate, now.node[i])));
    }
  for (int k = 0; k < w->bents; k++)
    worst = fmax (worst, fabs ((ahead.flow[k] - back.flow[k]) / (2 * h) + now.flow[k]));
  return worst / most;
}

static double
worst_of (int pairs, int bents)
{
  static state t;
  double worst = 0;
  for (int q = 0; q < STATES; q++)
    {
      const bt_vec3 shape[2] = { { 0, 0, 0 }, { 2, 0, 0 } };
      bt_tether_props line = { .diameter = 0.01, .mass = 0.1, .ea = 5e3 };
      scene_open (&t.s, line, 0, BENT, shape, 2, 2);
      t.s.in.end[0].free = t.s.in.end[1].free = 1;
      t.s.in.h = 1.0 / 60;
      assert_int_equal (bt__dynamic_begin (t.s.d, t.s.work, &t.s.in, &t.s.report, &t.s.error),
                        BT_OK);
      draw_state (&t, pairs, bents);
      worst = fmax (worst, off_the_tangent (t.s.work));
      scene_close (&t.s);
    }
  print_message ("# %s, %d sliding nodes: the worst of %d states is off by %.2g\n",
                 pairs ? "two touches of two places" : "touches", bents, STATES, worst);
  return worst;
}

static void
touches (void **state)
{
  (void)state;
  assert_true (worst_of (0, 0) < 1e-6);
}

static void
pairs_of_places (void **state)
{
  (void)state;
  assert_true (worst_of (1, 0) < 1e-5); /* what BiCGSTAB leaves */
}

static void
sliding_nodes (void **state)
{
  (void)state;
  assert_true (worst_of (0, 2) < 1e-5);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (touches), cmocka_unit_test (pairs_of_places),
          cmocka_unit_test (sliding_nodes) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
