/* The moving line, refined in space and time: see law_orders.c.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/statics.h>

#include "law_orders_cases.h"

/* How far what is said between the nodes of a half circle is from it.  */
void
line_points (int k, numbers *v)
{
  enum
  {
    MOST = 512
  };
  int n = 8 << k;
  bt__dynamic *d = malloc (bt__dynamic_size (MOST));
  bt_vec3 shape[2] = { { 1, 0, 0 }, { -1, 0, 0 } };
  assert_non_null (d);
  assert_int_equal (bt__dynamic_init (d, MOST, n, shape, 2, BT__PI, 1e5, NULL), BT_OK);
  for (int i = 0; i <= n; i++)
    bt__dynamic_x (d)[i] = bt__vec (cos (BT__PI * i / n), sin (BT__PI * i / n), 0);
  for (int i = 0; i < 12; i++)
    {
      double u = BT__PI * (i + 0.37) / 12;
      add_point (v, bt__sub (bt__dynamic_point (d, u), bt__vec (cos (u), sin (u), 0)));
    }
  free (d);
}

/* Nodes at tenths of S's line.  */
static void
add_line (numbers *v, const scene *s, double length)
{
  for (int i = 1; i <= 10; i++)
    add_point (v, bt__dynamic_point (s->d, length * i / 10));
}

typedef enum fault
{
  NONE,
  FORGETFUL /* every step is backward Euler */
} fault;

typedef enum pace
{
  EVEN,
  CHANGING, /* steps that grow and shrink by a percent from one to the next */
  ABRUPT    /* every second one is a fifth longer than the one before it */
} pace;

/* When step I of H ends.  */
static double
moment (int i, double h, pace p)
{
  double t = i * h;
  return p == CHANGING          ? t - 0.15 / BT__PI * sin (BT__PI * t)
         : p == ABRUPT && i % 2 ? t + h / 10
                                : t;
}

/* A vehicle that sets off gently on a Lissajous path, 2 s of it.  */
static void
fly (int n, double h, pace p, fault f, numbers *v)
{
  scene s;
  scene_open_flight (&s, n);
  for (int i = 1; i < 2 / h + 0.5; i++)
    {
      double t = moment (i, h, p);
      s.in.end[1].at = flight_at (t);
      if (f == FORGETFUL)
        s.d->history = 0;
      scene_step (&s, t - moment (i - 1, h, p));
    }
  add_line (v, &s, 24);
  scene_close (&s);
}

void
line_finer (int k, numbers *v)
{
  fly (80 << k, 0.01, EVEN, NONE, v);
}

void
line_quicker (int k, numbers *v)
{
  fly (20, 0.02 / (1 << k), EVEN, NONE, v);
}

void
line_changing (int k, numbers *v)
{
  fly (20, 0.02 / (1 << k), CHANGING, NONE, v);
}

void
line_abrupt (int k, numbers *v)
{
  fly (20, 0.02 / (1 << k), ABRUPT, NONE, v);
}

void
line_forgets (int k, numbers *v)
{
  fly (20, 0.02 / (1 << k), EVEN, FORGETFUL, v);
}

/* A heavy elastic line at rest between two points, and Irvine's catenary.  */
typedef struct hanging
{
  scene s;
  bt_elastic e;
} hanging;

static void
hang (hanging *g, int n)
{
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 40, 0, -25 }, { 80, 0, -10 } };
  bt_tether_props line
      = { .diameter = 0.01, .mass = 0.1, .wet_weight = 1, .ea = 1e4, .ba = 100, .cdn = 1.2 };
  assert_int_equal (bt_elastic_solve (80, -10, 100, line.wet_weight, line.ea, &g->e, NULL), BT_OK);
  scene_open (&g->s, line, 1025, n, shape, 3, 100);
  scene_settle (&g->s);
}

static void
add_places (numbers *v, const hanging *g)
{
  for (int i = 1; i < 8; i++)
    {
      bt_point2 p = bt_elastic_point (&g->e, 12.5 * i);
      add_point (v, bt__sub (bt__dynamic_point (g->s.d, 12.5 * i), bt__vec (p.x, 0, p.y)));
    }
}

static void
add_tensions (numbers *v, const hanging *g, int n, int by_interval)
{
  for (int i = 0; i <= 8; i++)
    {
      int node = i * n / 8;
      double is = by_interval ? bt__dynamic_tension (g->s.d)[node < n ? node : n - 1]
                              : bt__dynamic_node_tension (g->s.d, node);
      add (v, is - bt_elastic_tension (&g->e, 12.5 * i));
    }
}

void
line_hangs (int k, numbers *v)
{
  hanging g;
  hang (&g, 16 << k);
  add_places (v, &g);
  scene_close (&g.s);
}

void
line_tension (int k, numbers *v)
{
  hanging g;
  hang (&g, 16 << k);
  add_tensions (v, &g, 16 << k, 0);
  scene_close (&g.s);
}

void
line_tension_of_interval (int k, numbers *v)
{
  hanging g;
  hang (&g, 16 << k);
  add_tensions (v, &g, 16 << k, 1);
  scene_close (&g.s);
}

/* What the deferred correction makes of it: it follows the line with a delay, and the line creeps
   to where that wants it.  */
void
line_corrected (int k, numbers *v)
{
  hanging g;
  hang (&g, 16 << k);
  g.s.in.order = 4;
  g.s.in.tolerance = 1e-13;
  for (int i = 0; i < 12000; i++)
    scene_step (&g.s, 0.2);
  add_places (v, &g);
  scene_close (&g.s);
}

/* A stiff line clamped at both ends, bent by its weight and a current, at rest.  */
void
line_bends (int k, numbers *v)
{
  scene s;
  bt_vec3 shape[3] = { { 0, 0, -10 }, { 10, 4, -13 }, { 18, 0, -10 } };
  bt_tether_props line = { .diameter = 0.02,
                           .mass = 0.5,
                           .wet_weight = 1,
                           .ea = 1e5,
                           .ei = 30,
                           .ba = 100,
                           .cdn = 1.2,
                           .ca = 1 };
  scene_open (&s, line, 1025, 16 << k, shape, 3, 21);
  scene_current (&s, bt__vec (0, 0.3, 0));
  for (int end = 0; end < 2; end++)
    {
      s.in.end[end].clamped = 1;
      s.in.end[end].direction = bt__vec (1, 0, 0);
    }
  scene_settle (&s);
  add_line (v, &s, 21);
  scene_close (&s);
}

/* A free line falls from rest: v = vt tanh (t / tau), and what a forgetful step makes of it.  */
static void
sink (int k, fault f, numbers *v)
{
  scene s;
  double d = 0.0035, m = 0.0517, w = 0.4, h = 4e-3 / (1 << k);
  double me = m + 1000 * BT__PI * d * d / 4, vt = sqrt (2 * w / (1000 * 1.3 * d)),
         tau = me * vt / w;
  bt_vec3 shape[2] = { { 0, 0, -5 }, { 10, 0, -5 } };
  bt_tether_props line
      = { .diameter = d, .mass = m, .wet_weight = w, .ea = 1e5, .cdn = 1.3, .cdt = 0.01, .ca = 1 };
  scene_open (&s, line, 1000, 4, shape, 2, 10);
  s.in.end[0].free = s.in.end[1].free = 1;
  for (int i = 0; i < 50 << k; i++)
    {
      if (f == FORGETFUL)
        s.d->history = 0;
      scene_step (&s, h);
    }
  add (v, -bt__dynamic_v (s.d)[2].z - vt * tanh (0.2 / tau));
  add (v, -5 - bt__dynamic_x (s.d)[2].z - vt * tau * log (cosh (0.2 / tau)));
  scene_close (&s);
}

void
line_sinks (int k, numbers *v)
{
  sink (k, NONE, v);
}

void
line_sinks_forgetful (int k, numbers *v)
{
  sink (k, FORGETFUL, v);
}
