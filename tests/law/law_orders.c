/* Every discretisation converges with the order it is said to have.

   One table: a model, what is refined, the order it claims and how far the fitted one may lie from
   it.  A law hands out some numbers at each of several refinements, each twice as fine as the one
   before.  Its error is their distance from a closed form where it has one, else from the next
   refinement; the order is the slope of a straight line through the logarithms, by least squares.
   The laws left out are closed forms with nothing to refine: catenary, elastic, V, waves.

   Mutants are the same laws with a fault that costs an order: steps that forget their history, a
   force taken at the end of a step instead of its middle, the tension of an interval for that of
   its node.  Each must be refused.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/statics.h>

#include "law_orders_cases.h"
#include "tether/shape.h"
#include "vehicle/body.h"

enum
{
  REFINEMENTS = 6
};

/* ---- Statics in a current ---- */

typedef struct pool
{
  bt_line line;
  bt_water water;
  bt_current current;
  bt_steady *steady;
  bt_vec3 b, r[2049], t[2049];
} pool;

/* A sinking line in a current that fades with depth.  Without tangential drag, whose |ut| ut has a
   corner where the line lies square to the current.  */
static pool *
open_pool (void)
{
  pool *p = calloc (1, sizeof *p);
  assert_non_null (p);
  p->line = (bt_line){ 100, 0.0076, 0.1, 2e5, 1.2, 0 };
  p->current = (bt_current){
    .kind = BT_CURRENT_POWER, .n = 1, .exponent = 2, .velocity = { { 0.3, 0.15, 0 } }
  };
  p->water = (bt_water){ .density = 1025, .gravity = 9.81, .depth = 200, .current = &p->current };
  p->b = bt__vec (30, 60, -25); /* not in the plane of the current: |un| un has no corner */
  p->steady = bt_steady_new (2048);
  assert_non_null (p->steady);
  return p;
}

static void
close_pool (pool *p, int n, numbers *v)
{
  for (int q = 0; q <= 4; q++)
    {
      add_point (v, bt__scale (1 / p->line.length, p->r[q * n / 4]));
      add_point (v, bt__scale (1 / bt__norm (p->t[0]), p->t[q * n / 4]));
    }
  bt_steady_free (p->steady);
  free (p);
}

static void
march (int k, numbers *v)
{
  pool *p = open_pool ();
  int n = 32 << k;
  assert_int_equal (bt_steady_march (&p->line, &p->water, bt__vec (0, 0, -10), bt__vec (8, 2, -4),
                                     n, p->r, p->t, NULL),
                    BT_OK);
  close_pool (p, n, v);
}

static void
shoot (int k, numbers *v)
{
  pool *p = open_pool ();
  bt_vec3 pull = { 0, 0, 0 };
  bt_steady_report report;
  int n = 64 << k;
  assert_int_equal (bt_steady_shoot (p->steady, &p->line, &p->water, bt__vec (0, 0, -10), p->b, n,
                                     0, &pull, p->r, p->t, &report, NULL),
                    BT_OK);
  assert_true (report.converged);
  close_pool (p, n, v);
}

static void
relax (int k, numbers *v)
{
  pool *p = open_pool ();
  bt_steady_report report;
  int n = 16 << k;
  bt_vec3 a = bt__vec (0, 0, -10), pull = { 0, 0, 0 };
  assert_int_equal (bt_steady_shoot (p->steady, &p->line, &p->water, a, p->b, n, 0, &pull, p->r,
                                     p->t, &report, NULL),
                    BT_OK);
  assert_int_equal (
      bt_steady_relax (p->steady, &p->line, &p->water, a, p->b, n, 2000, p->r, p->t, &report, NULL),
      BT_OK);
  assert_true (report.converged);
  close_pool (p, n, v);
}

/* ---- Between nodes ---- */

/* How far what is said between the nodes of a half circle is from it.  */
static void
shape_numbers (int k, numbers *v)
{
  enum
  {
    MOST = 512
  };
  static bt_vec3 r[MOST + 1], t[MOST + 1];
  bt__shape shape = { .form = BT__FORM_NODES, .n = 8 << k, .length = BT__PI };
  for (int i = 0; i <= shape.n; i++)
    {
      double u = BT__PI * i / (double)shape.n;
      r[i] = bt__vec (cos (u), sin (u), 0);
      t[i] = bt__scale (2 + sin (u), bt__vec (-sin (u), cos (u), 0));
    }
  for (int i = 0; i < 12; i++)
    {
      double u = BT__PI * (i + 0.37) / 12;
      add_point (v, bt__sub (bt__shape_point (&shape, r, t, u), bt__vec (cos (u), sin (u), 0)));
    }
}

/* ---- Vehicles ---- */

static bt__vehicle_type
heavy (void)
{
  bt__vehicle_type type;
  assert_int_equal (bt__vehicle_type_find ("bluerov2-heavy", &type, NULL), BT_OK);
  return type;
}

/* Pushed about by a force that changes, turning, in a flow.  LATE: the force of the end of each
   step instead of its middle.  */
static void
push (int k, int late, numbers *v)
{
  bt__vehicle_type type = heavy ();
  bt__rigid body;
  double h = 1.0 / (15 << k);
  bt__rigid_place (&body, bt__vec (0, 0, -50), 0.5, 0.1, -0.1);
  body.velocity = bt__vec (0.3, 0.8, 0.1);
  body.spin = bt__vec (0.1, 0.2, 0.5);
  for (int i = 0; i < 30 << k; i++)
    {
      double t = (i + (late ? 1 : 0.5)) * h;
      bt__rigid_input in = { .h = h,
                             .density = 1025,
                             .gravity = 9.81,
                             .surface = INFINITY,
                             .flow = { 0.5, 0.4, 0.3 },
                             .force = { 20 * sin (t), 15 * cos (2 * t), 5 * sin (3 * t) },
                             .moment = { 0, 0, 2 * sin (t) } };
      assert_int_equal (bt__rigid_step (&type, &body, &in, NULL), BT_OK);
    }
  add_point (v, body.position);
  add_point (v, body.velocity);
  add_point (v, body.spin);
  add (v, body.heading);
}

static void
push_well (int k, numbers *v)
{
  push (k, 0, v);
}

static void
push_late (int k, numbers *v)
{
  push (k, 1, v);
}

/* Let run: m v' = -l v - q v2.  */
static void
coast (int k, numbers *v)
{
  bt__vehicle_type type = heavy ();
  double m = type.mass + type.hydro.added[BT__SURGE], l = type.hydro.linear[BT__SURGE];
  double q = type.hydro.quadratic[BT__SURGE], v0 = 1.5, t = 2;
  bt__rigid body;
  bt__rigid_input in = { .h = 1.0 / (15 << k), .density = 1025, .surface = INFINITY };
  bt__rigid_place (&body, bt__vec (0, 0, -50), 0, 0, 0);
  body.velocity.y = v0;
  for (int i = 0; i < 30 << k; i++)
    assert_int_equal (bt__rigid_step (&type, &body, &in, NULL), BT_OK);
  add (v, body.velocity.y - l / ((l / v0 + q) * exp (l * t / m) - q));
}

/* Tumbling in the void.  */
static void
tumble (int k, numbers *v)
{
  bt__vehicle_type type
      = { .name = "lump", .mass = 10, .inertia = { 1, 2, 3 }, .hydro = { .munk = 1 } };
  bt__rigid body;
  bt__rigid_input in = { .h = 1.0 / (30 << k) };
  bt__rigid_place (&body, bt__vec (0, 0, -5), 1, 0.3, -0.2);
  body.spin = bt__vec (1.2, 0.4, 0.3);
  for (int i = 0; i < 60 << k; i++)
    assert_int_equal (bt__rigid_step (&type, &body, &in, NULL), BT_OK);
  add_point (v, body.spin);
  add_point (v, bt__turn_out (body.attitude, bt__vec (1, 0, 0)));
  add_point (v, bt__turn_out (body.attitude, bt__vec (0, 1, 0)));
}

/* ---- The table ---- */

typedef struct law
{
  const char *model, *quantity;
  void (*numbers) (int k, numbers *v);
  int exact; /* nonzero: the numbers are errors; else the next refinement is what they are held to
              */
  int refinements;
  double order, range;
} law;

static const law laws[] = {
  { "steady march", "intervals", march, 0, 5, 4, 0.2 },
  { "steady shooting", "intervals", shoot, 0, 5, 4, 0.2 },
  { "steady relaxation", "links", relax, 0, 4, 2, 0.15 },
  { "points between static nodes", "nodes", shape_numbers, 1, 5, 4, 0.25 },
  { "points between moving nodes", "nodes", line_points, 1, 5, 4, 0.25 },
  { "moving line", "intervals", line_finer, 0, 4, 2, 0.2 },
  { "moving line", "even steps", line_quicker, 0, 4, 2, 0.2 },
  { "moving line", "changing steps", line_changing, 0, 4, 2, 0.2 },
  { "moving line", "abrupt steps", line_abrupt, 0, 4, 1, 0.2 },
  { "moving line at rest", "intervals", line_hangs, 1, 4, 2, 0.1 },
  { "moving line at rest, its tension", "intervals", line_tension, 1, 4, 2, 0.1 },
  { "moving line at rest, corrected", "intervals", line_corrected, 1, 3, 4, 0.6 },
  { "moving line with bending", "intervals", line_bends, 0, 5, 2, 0.2 },
  { "moving line that sinks", "steps", line_sinks, 1, 4, 2, 0.2 },
  { "vehicle pushed about", "steps", push_well, 0, 5, 2, 0.15 },
  { "vehicle that runs out", "steps", coast, 1, 4, 2, 0.1 },
  { "vehicle that tumbles", "steps", tumble, 0, 5, 2, 0.1 },
};

static const law mutants[] = {
  { "moving line that forgets its history", "steps", line_forgets, 0, 4, 2, 0.2 },
  { "moving line that sinks and forgets", "steps", line_sinks_forgetful, 1, 4, 2, 0.2 },
  { "tension of the interval for the node's", "intervals", line_tension_of_interval, 1, 4, 2, 0.1 },
  { "vehicle pushed late", "steps", push_late, 0, 5, 2, 0.15 },
};

static double
apart (const numbers *a, const numbers *b)
{
  double sum = 0;
  for (int i = 0; i < a->n; i++)
    sum += (a->x[i] - b->x[i]) * (a->x[i] - b->x[i]);
  return sqrt (sum / a->n);
}

/* The slope of Y over 0, 1 ... N - 1.  */
static double
slope (const double *y, int n)
{
  double mean = (n - 1) / 2.0, over = 0, under = 0;
  for (int k = 0; k < n; k++)
    {
      over += (k - mean) * y[k];
      under += (k - mean) * (k - mean);
    }
  return over / under;
}

/* Return the order that L shows.  */
static double
order_of (const law *l)
{
  numbers v[REFINEMENTS], zero = { 0 };
  double logs[REFINEMENTS];
  int n = l->refinements - !l->exact;
  for (int k = 0; k < l->refinements; k++)
    {
      v[k].n = 0;
      l->numbers (k, v + k);
    }
  for (int k = 0; k < n; k++)
    logs[k] = log2 (apart (v + k, l->exact ? &zero : v + k + 1));
  double order = -slope (logs, n);
  printf ("# %-40s %-13s order %.2f of %g +- %g, error %.1e to %.1e\n", l->model, l->quantity,
          order, l->order, l->range, exp2 (logs[0]), exp2 (logs[n - 1]));
  return order;
}

static int
holds (const law *l, double order)
{
  return fabs (order - l->order) <= l->range;
}

static void
test_orders (void **state)
{
  int wrong = 0;
  (void)state;
  for (size_t i = 0; i < sizeof laws / sizeof *laws; i++)
    wrong += !holds (laws + i, order_of (laws + i));
  if (wrong)
    fail_msg ("%d orders are not as they are said to be", wrong);
}

/* A fault of first order is seen, and as what it is.  */
static void
test_mutants (void **state)
{
  (void)state;
  for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++)
    {
      double order = order_of (mutants + i);
      assert_false (holds (mutants + i, order));
      assert_close (order, 1, 0.3, mutants[i].model);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (test_orders), cmocka_unit_test (test_mutants) };
  return cmocka_run_group_tests_name ("orders", tests, NULL, NULL);
}
