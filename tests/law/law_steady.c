/* The line in a current: marches, shooting, relaxation and the choice between them, held against
   quoted solutions.

   Quoted tables: integrations by DOP853 at rtol 1e-13 (good to about 1e-9) and the golden numbers
   of the domain study, of dr/ds = t,  d(T t)/ds = -[(0, 0, -w) + rho/2 cdn d |un| un + rho/2 cdt pi
   d |ut| ut], un, ut the current's parts normal and tangential to t.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <bight/statics.h>

#include "math/vec.h"
#include "testbed/chance.h"
#include "tether/equilibrium.h"

enum
{
  N_MAX = 2048
};

static bt_steady *steady;
static bt_vec3 r[N_MAX + 1], t[N_MAX + 1], r2[N_MAX + 1], t2[N_MAX + 1];

/* ---- A line in a sea ---- */

typedef struct scene
{
  bt_line line;
  bt_water water;
  bt_current current;
  bt_vec3 a, b;
} scene;

static void
set_scene (scene *s, bt_line line, double density, int kind, double p, bt_vec3 u, bt_vec3 b)
{
  *s = (scene){ .line = line, .b = b };
  s->water = (bt_water){ density, 9.81, p > 0 ? p : 100, 0, &s->current, NULL, NULL, NULL };
  s->current = (bt_current){ .kind = kind, .velocity = { u } };
  s->current.exponent = 1.0 / 7;
  s->current.turn_rate = -BT__PI / 2 / (p > 0 ? p : 1);
  s->current.n = 2; /* `linear': U (1 + z/p) */
  s->current.z[1] = -p;
}

/* Shoot cold over N intervals into R, T.  */
static bt_steady_report
shoot (const scene *s, int n)
{
  bt_vec3 pull = { 0, 0, 0 };
  bt_steady_report report;
  assert_int_equal (
      bt_steady_shoot (steady, &s->line, &s->water, s->a, s->b, n, 0, &pull, r, t, &report, NULL),
      BT_OK);
  return report;
}

static bt_steady_report
relax (const scene *s, int n, int solves, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_steady_report report;
  assert_int_equal (bt_steady_relax (steady, &s->line, &s->water, s->a, s->b, n, solves, nodes,
                                     tensions, &report, NULL),
                    BT_OK);
  return report;
}

static void
assert_near (bt_vec3 a, bt_vec3 b, double tolerance, const char *what)
{
  if (!(bt__distance (a, b) <= tolerance))
    fail_msg ("%s: (%.12g %.12g %.12g) is not (%.12g %.12g %.12g) within %g", what, a.x, a.y, a.z,
              b.x, b.y, b.z, tolerance);
}

static void
assert_about (double a, double b, double tolerance, const char *what)
{
  if (!(fabs (a - b) <= tolerance))
    fail_msg ("%s: %.12g is not %.12g within %g", what, a, b, tolerance);
}

/* ---- current_bvp3d.csv: two fixed ends, A at the origin ---- */

typedef struct fixed_ends
{
  const char *name;
  bt_vec3 b;
  bt_line line;
  double density;
  int kind;
  double p; /* of the profile, m */
  bt_vec3 u, ta, tb, quarter[3];
} fixed_ends;

static const fixed_ends table[] = {
  { "toulon6_sway_steady_0.15",
    { 1.9, 0, -0.6 },
    { 2.85, 0.0035, 0.4, INFINITY, 1.3, 0.01 },
    1000,
    BT_CURRENT_UNIFORM,
    0,
    { 0, 0.15, 0 },
    { 0.2415900891, 0.07905365875, -0.6962248077 },
    { 0.2403033414, -0.06506192024, 0.434975092 },
    { { 0.2874322676, 0.07095168977, -0.6468504271 },
      { 0.7680380794, 0.1169667373, -1.158836608 },
      { 1.443684041, 0.08607034458, -1.13081002 } } },
  { "toulon6_sway_steady_0.3",
    { 1.9, 0, -0.6 },
    { 2.85, 0.0035, 0.4, INFINITY, 1.3, 0.01 },
    1000,
    BT_CURRENT_UNIFORM,
    0,
    { 0, 0.3, 0 },
    { 0.2433185962, 0.2785977182, -0.646912263 },
    { 0.229614931, -0.2228968061, 0.3910855219 },
    { { 0.2928139717, 0.2491634659, -0.598256339 },
      { 0.7882362726, 0.4074256667, -1.070864747 },
      { 1.458328163, 0.2951253409, -1.063506885 } } },
  { "toulon6_surge_steady_0.3",
    { 1.9, 0, -0.6 },
    { 2.85, 0.0035, 0.4, INFINITY, 1.3, 0.01 },
    1000,
    BT_CURRENT_UNIFORM,
    0,
    { 0.3, 0, 0 },
    { 0.3634670362, 0, -0.619265492 },
    { 0.1165080737, 0, 0.4566333794 },
    { { 0.3819064105, 0, -0.6012556582 },
      { 0.8588463297, 0, -1.126541304 },
      { 1.524200381, 0, -1.184730638 } } },
  { "fathom_neutral_cross",
    { 60, 20, -50 },
    { 100, 0.0076, 0, INFINITY, 1.2, 0 },
    1025,
    BT_CURRENT_UNIFORM,
    0,
    { 0.3, 0.4, 0 },
    { 17.45904373, 16.96498819, -5.261447327 },
    { -2.1686032, -20.19260804, -14.41761426 },
    { { 17.86071393, 16.32015403, -6.245109345 },
      { 36.52479035, 29.91105889, -15.65721798 },
      { 54.36674672, 34.45437544, -31.69551682 } } },
  { "fathom_light_shear",
    { 50, 30, -60 },
    { 110, 0.0076, 0.05, INFINITY, 1.2, 0.02 },
    1025,
    BT_CURRENT_PROFILE,
    100.0,
    { 0.8, 0, 0 },
    { 38.47288008, 2.978235496, -7.89511656 },
    { -18.95953625, 10.90714995, -19.74518596 },
    { { 26.56205581, 2.691815401, -6.53935522 },
      { 51.13020295, 7.825730597, -17.45252342 },
      { 62.21172265, 18.58645495, -38.64970058 } } },
  { "fathom_floating_uniform",
    { 40, 0, -40 },
    { 75, 0.0076, -0.03, INFINITY, 1.2, 0.01 },
    1025,
    BT_CURRENT_UNIFORM,
    0,
    { 0, 0.25, 0 },
    { 2.178993632, 5.167078298, -1.423489324 },
    { 2.248157817, -5.854627354, -3.061697571 },
    { { 8.643713701, 15.09605465, -6.691354713 },
      { 21.01292294, 21.77606197, -18.35717226 },
      { 32.48564523, 14.33334869, -30.6590921 } } },
  { "slim_turning_current",
    { 30, 10, -80 },
    { 105, 0.004, 0.02, INFINITY, 1.1, 0.02 },
    1025,
    BT_CURRENT_TURNING,
    100.0,
    { 0.5, 0, 0 },
    { 17.05867649, 5.905221184, -8.925511602 },
    { -6.804764376, -11.20844849, -12.04987631 },
    { { 20.553458, 8.851696459, -13.60684474 },
      { 35.33204519, 18.3609515, -32.84233648 },
      { 38.16879855, 21.14435205, -58.1505847 } } },
  { "workclass_umbilical",
    { 60, -30, -480 },
    { 505, 0.03, 12, INFINITY, 1.2, 0.01 },
    1025,
    BT_CURRENT_POWER,
    600.0,
    { 0.5, 0.3, 0 },
    { 1791.641273, 783.359426, -6073.357263 },
    { -293.7806248, -452.1152992, -305.3505868 },
    { { 33.44041909, 13.39244676, -120.9872936 },
      { 61.29562364, 20.71797146, -243.8668765 },
      { 78.23308333, 15.62446816, -368.6639649 } } },
};

enum
{
  ROWS = sizeof table / sizeof *table,
  SURGE = 2 /* the row whose current lies in the plane of the line */
};

static void
row_scene (scene *s, const fixed_ends *row)
{
  set_scene (s, row->line, row->density, row->kind, row->p, row->u, row->b);
}

static void
test_fixed_ends_are_reproduced (void **state)
{
  (void)state;
  for (int k = 0; k < ROWS; k++)
    {
      scene s;
      const int n = 512;
      row_scene (&s, &table[k]);
      assert_true (shoot (&s, n).converged);
      double force = bt__norm (table[k].ta), length = s.line.length;
      assert_near (t[0], table[k].ta, 1e-8 * force, table[k].name);
      assert_near (t[n], table[k].tb, 1e-8 * force, table[k].name);
      for (int q = 0; q < 3; q++)
        assert_near (r[(q + 1) * n / 4], table[k].quarter[q], 1e-8 * length, table[k].name);
      assert_near (r[n], s.b, 1e-10 * length, table[k].name);
    }
}

/* Root mean square over the quarter points of the position error over the length and of the tension
   error over the tension; the reference lies in R2, T2 with N_MAX intervals.  */
static double
error_over (const scene *s, int n)
{
  double sum = 0;
  for (int q = 0; q <= 4; q++)
    {
      int i = q * n / 4, j = q * N_MAX / 4;
      double dr = bt__distance (r[i], r2[j]) / s->line.length;
      double dt = bt__distance (t[i], t2[j]) / bt__norm (t2[0]);
      sum += dr * dr + dt * dt;
    }
  return sqrt (sum / 10);
}

/* Leave the finest answer in R2, T2.  */
static void
shoot_reference (const scene *s)
{
  assert_true (shoot (s, N_MAX).converged);
  memcpy (r2, r, sizeof r);
  memcpy (t2, t, sizeof t);
}

/* The order shown by doubling N once.  */
static double
order_from (const scene *s, int n)
{
  assert_true (shoot (s, n).converged);
  double coarse = error_over (s, n);
  assert_true (shoot (s, 2 * n).converged);
  return log2 (coarse / error_over (s, 2 * n));
}

/* Fourth order at every halving, where the loads are smooth: without tangential drag, |ut| ut has
   no corner where the line lies square across the current.  One row's current lies in the plane of
   the line and along it at a point, so that |un| un has a corner too; it is left out here.  */
static void
test_shooting_is_of_fourth_order (void **state)
{
  (void)state;
  for (int k = 0; k < ROWS; k++)
    {
      scene s;
      row_scene (&s, &table[k]);
      s.line.cdt = 0;
      shoot_reference (&s);
      for (int n = 32; n < 128 && k != SURGE; n *= 2)
        {
          double order = order_from (&s, n);
          if (!(order > 3.9 && order < 4.2))
            fail_msg ("%s: order %g from %d intervals", table[k].name, order, n);
        }
    }
}

/* With the corners the step across one is of third order, and single halvings scatter between the
 * two.  */
static void
test_corners_in_the_drag_cost_one_order (void **state)
{
  (void)state;
  for (int k = 0; k < ROWS; k++)
    {
      scene s;
      row_scene (&s, &table[k]);
      shoot_reference (&s);
      for (int n = 32; n < 128; n *= 2)
        {
          double order = order_from (&s, n);
          if (!(order > 2.9))
            fail_msg ("%s: order %g from %d intervals", table[k].name, order, n);
        }
    }
}

/* The chain, from the straight line, comes to rest in the same shape with second order.  */
static void
test_relaxation_is_of_second_order (void **state)
{
  (void)state;
  for (int k = 0; k < ROWS; k++)
    {
      scene s;
      double error[2];
      row_scene (&s, &table[k]);
      shoot_reference (&s);
      for (int i = 0, n = 32; i < 2; i++, n *= 2)
        {
          for (int j = 0; j <= n; j++)
            r[j] = bt__axpy (s.a, (double)j / n, bt__sub (s.b, s.a));
          if (!relax (&s, n, 600, r, t).converged)
            fail_msg ("%s: %d links still move", table[k].name, n);
          error[i] = error_over (&s, n);
        }
      double order = log2 (error[0] / error[1]);
      if (!(order > 1.8 && order < 2.2 && error[1] < 2e-3))
        fail_msg ("%s: order %g, error %g", table[k].name, order, error[1]);
    }
}

/* ---- current_free_end.csv: the lower end carries a known force ---- */

typedef struct free_end
{
  const char *name;
  bt_line line;
  double density;
  bt_vec3 u, force, top, pull, middle;
} free_end;

static const free_end free_table[] = {
  { "towed_body",
    { 200, 0.012, 0.8, INFINITY, 1.5, 0.02 },
    1025,
    { 2, 0, 0 },
    { 200, 0, -500 },
    { -188.6709341, 0, 54.06093265 },
    { -849.0502202, 0, 135.4886228 },
    { -90.15773545, 0, 36.91674264 } },
  { "towed_no_tangential",
    { 200, 0.012, 0.8, INFINITY, 1.5, 0 },
    1025,
    { 2, 0, 0 },
    { 200, 0, -500 },
    { -188.9846364, 0, 52.68667946 },
    { -573.9090991, 0, 88.32409353 },
    { -90.34455232, 0, 36.28155733 } },
  { "rov_thrust_neutral",
    { 100, 0.0076, 0, INFINITY, 1.2, 0.01 },
    1025,
    { 0.5, 0, 0 },
    { -40, 0, -30 },
    { 10.0900609, 0, 84.68509898 },
    { -35.58038443, 0, 34.79346021 },
    { 27.83656566, 0, 40.03463821 } },
  { "rov_cross_thrust",
    { 100, 0.0076, 0.02, INFINITY, 1.2, 0.01 },
    1025,
    { 0.4, 0, 0 },
    { -15, 25, -10 },
    { -39.86135696, -72.76206601, 31.63834541 },
    { -28.02877246, -13.92821491, 6.865290032 },
    { -2.090456455, -43.67229153, 18.26341523 } },
  { "clump_hanging_current",
    { 300, 0.025, 6.5, INFINITY, 1.2, 0.01 },
    1025,
    { 0.75, 0, 0 },
    { 50, 0, -2000 },
    { -111.0272295, 0, 274.9282755 },
    { -2070.16768, 0, 3184.644954 },
    { -37.87365016, 0, 144.1429851 } },
};

static void
test_free_ends_are_reproduced (void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof free_table / sizeof *free_table; k++)
    {
      const free_end *row = &free_table[k];
      scene s;
      const int n = 2048;
      set_scene (&s, row->line, row->density, BT_CURRENT_UNIFORM, 0, row->u, bt__vec (0, 0, 0));
      assert_int_equal (bt_steady_march (&s.line, &s.water, bt__vec (0, 0, 0),
                                         bt__scale (-1, row->force), n, r, t, NULL),
                        BT_OK);
      assert_near (r[n], row->top, 1e-7 * s.line.length, row->name);
      assert_near (r[n / 2], row->middle, 1e-7 * s.line.length, row->name);
      assert_near (t[n], row->pull, 1e-7 * bt__norm (row->pull), row->name);
    }
}

/* ---- Shooting in 4000 steps: rho 1025, d 7.6 mm, cdn 1.2; four digits after the point ---- */

static const struct golden
{
  const char *name;
  double cdt, wet, u, length;
  bt_vec3 b;
  double ta, tb;
  bt_vec3 middle, force;
} golden[] = {
  { "S1",
    0,
    0,
    .5,
    40,
    { -10, 20, 0 },
    5.5120,
    5.5120,
    { 8.6038, 13.2493, 0 },
    { 5.4175, -1.0163, 0 } },
  { "S1b",
    .01,
    0,
    .5,
    40,
    { -10, 20, 0 },
    5.7226,
    6.0196,
    { 8.6028, 13.2218, 0 },
    { 5.9104, -1.1414, 0 } },
  { "S2",
    .01,
    .1,
    0,
    30,
    { 20, 0, -10 },
    2.1600,
    1.1600,
    { 7.2797, 0, -12.9070 },
    { -.6705, 0, -.9467 } },
  { "S3",
    .01,
    .1,
    .25,
    40,
    { 0, 20, -15 },
    3.6448,
    2.1555,
    { 12.8890, 8.3401, -11.9161 },
    { 1.9493, -.6611, -.6396 } },
  { "S4",
    .01,
    .1,
    .5,
    40,
    { 0, 20, -15 },
    9.5729,
    8.0873,
    { 14.0231, 9.4871, -8.7640 },
    { 7.7123, -2.3700, .5547 } },
  { "S5",
    .01,
    -.05,
    .25,
    40,
    { 0, 20, -15 },
    1.9924,
    2.7357,
    { 13.7467, 10.9702, -5.0523 },
    { 2.4131, -.6259, 1.1267 } },
  { "S6",
    .01,
    0,
    .5,
    45,
    { 0, 0, -30 },
    11.1109,
    11.1109,
    { 15.0880, 0, -15 },
    { 10.2668, 0, 4.2480 } },
};

static void
test_golden_numbers (void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof golden / sizeof *golden; k++)
    {
      const struct golden *g = &golden[k];
      scene s;
      const int n = 1024;
      bt_line line = { g->length, 0.0076, g->wet, INFINITY, 1.2, g->cdt };
      set_scene (&s, line, 1025, BT_CURRENT_UNIFORM, 0, bt__vec (g->u, 0, 0), g->b);
      assert_true (shoot (&s, n).converged);
      assert_about (bt__norm (t[0]), g->ta, 1e-4, g->name);
      assert_about (bt__norm (t[n]), g->tb, 1e-4, g->name);
      assert_near (r[n / 2], g->middle, 2e-4, g->name);
      assert_near (bt__scale (-1, t[n]), g->force, 2e-4, g->name);
    }
}

/* ---- Random scenes, always the same ones ---- */

static uint64_t seed;

static bt_vec3
direction (void)
{
  for (;;)
    {
      bt_vec3 v = bt__vec (chance_between (&seed, -1, 1), chance_between (&seed, -1, 1),
                           chance_between (&seed, -1, 1));
      double n = bt__norm (v);
      if (n > 0.1 && n < 1)
        return bt__scale (1 / n, v);
    }
}

/* A line of 20 to 200 m with its chord between LOW and HIGH of the length in a sheared, turning
   profile of up to SPEED m/s; a third of the lines neutral, some sinking, some floating.  */
static void
random_scene (scene *s, double low, double high, double speed, double ea)
{
  bt_line line = {
    chance_between (&seed, 20, 200), 0.0076, chance_between (&seed, -0.1, 0.3), ea, 1.2, 0.01
  };
  if (chance_between (&seed, 0, 1) < 0.3)
    line.wet_weight = 0;
  double bearing = chance_between (&seed, 0, 2 * BT__PI),
         fast = chance_between (&seed, 0.05, speed);
  set_scene (s, line, 1025, BT_CURRENT_PROFILE, 100, bt_set_and_drift (fast, bearing),
             bt__vec (0, 0, 0));
  s->current.velocity[1] = bt_set_and_drift (fast * chance_between (&seed, 0, 1),
                                             bearing + chance_between (&seed, -1, 1));
  s->a = bt__vec (0, 0, -chance_between (&seed, 0, 50));
  s->b = bt__axpy (s->a, chance_between (&seed, low, high) * line.length, direction ());
}

/* A chain of the right length wandering from A, its end anywhere.  */
static void
random_shape (const scene *s, int n, bt_vec3 *shape)
{
  bt_vec3 d = direction ();
  shape[0] = s->a;
  for (int i = 1; i <= n; i++)
    {
      d = bt__unit_or (bt__axpy (d, 0.5, direction ()), d);
      shape[i] = bt__axpy (shape[i - 1], s->line.length / n, d);
    }
}

static int
all_finite (const bt_vec3 *v, int n)
{
  for (int i = 0; i <= n; i++)
    if (!bt__is_finite (v[i]))
      return 0;
  return 1;
}

/* A neutral line under normal drag in a uniform current is a catenary with the same tension q A all
   along, q = rho/2 cdn d U^2, whatever the speed.  */
static void
test_neutral_line_is_a_catenary (void **state)
{
  (void)state;
  seed = 0x9e3779b97f4a7c15u;
  for (int k = 0; k < 200; k++)
    {
      scene s;
      const int n = 128;
      double speed = chance_between (&seed, 0.05, 3), length = chance_between (&seed, 5, 300);
      bt_vec3 to = bt__vec (chance_between (&seed, 0.3, 0.9), 0, chance_between (&seed, -0.3, 0.3));
      bt_line line = { length, 0.0076, 0, INFINITY, 1.2, 0 };
      set_scene (&s, line, 1025, BT_CURRENT_UNIFORM, 0, bt__vec (0, 0, -speed),
                 bt__scale (length, to));
      assert_true (shoot (&s, n).converged);
      bt_catenary c;
      assert_int_equal (bt_catenary_solve (s.b.x, s.b.z, length, &c, NULL), BT_OK);
      double q = 1025.0 / 2 * 1.2 * 0.0076 * speed * speed;
      for (int i = 0; i <= n; i += 16)
        {
          bt_point2 p = bt_catenary_point (&c, length * i / n);
          assert_near (r[i], bt__vec (p.x, 0, p.y), 1e-4 * length, "catenary");
          assert_about (bt__norm (t[i]) / (q * c.a), 1, 1e-3, "tension q A");
        }
    }
}

/* ---- Equilibria from shapes ---- */

static const bt__reaction unknown = { 0, { 0, 0, 0 }, { { 0, 0, 0 } } };

static bt_status
solve (const scene *s, int n, int have, bt__reaction *reaction, bt__shape_counts *counts)
{
  return bt__equilibrium_solve (steady, &s->line, &s->water, s->a, s->b, n, have,
                                bt__vec (0, 0, -1), reaction, r, t, counts, NULL);
}

/* Whatever slack shape a line has, a few calls bring it to rest, and once there it stays.  */
static void
test_equilibrium_from_random_shapes (void **state)
{
  (void)state;
  int unsettled = 0, moved = 0;
  seed = 0x2545f4914f6cdd1du;
  for (int k = 0; k < 1000; k++)
    {
      scene s;
      const int n = 16;
      bt__reaction pull = unknown;
      bt__shape_counts counts = { 0 };
      random_scene (&s, 0.01, 0.95, 1, k % 2 ? INFINITY : 2e5);
      random_shape (&s, n, r);
      for (int call = 0, still = 1; call < 12 && still; call++)
        {
          uint64_t before = counts.unsettled;
          assert_int_equal (solve (&s, n, 1, &pull, &counts), BT_OK);
          assert_true (all_finite (r, n) && all_finite (t, n) && bt__is_finite (pull.pull));
          still = counts.unsettled != before;
          unsettled += call == 11 && still;
        }
      assert_near (r[0], s.a, 1e-9 * s.line.length, "end A");
      assert_near (r[n], s.b, 1e-9 * s.line.length, "end B");
      memcpy (r2, r, sizeof r);
      solve (&s, n, 1, &pull, &counts);
      for (int i = 0; i <= n; i++)
        if (bt__distance (r[i], r2[i]) > 0.021 * s.line.length)
          {
            moved++;
            break;
          }
    }
  if (unsettled > 5 || moved > 5)
    fail_msg ("%d of 1000 shapes still move after 12 calls, %d moved on after rest", unsettled,
              moved);
}

/* A vehicle that swims: the shape follows its end and never leaps, warm shooting does nearly all of
 * it.  */
static void
test_equilibrium_follows_the_end (void **state)
{
  (void)state;
  int hard = 0;
  seed = 0xda942042e4dd58b5u;
  for (int k = 0; k < 40; k++)
    {
      scene s;
      const int n = 32;
      bt__reaction pull = unknown;
      bt_vec3 way = direction ();
      bt__shape_counts counts = { 0 };
      random_scene (&s, 0.5, 0.7, 1, 2e5);
      assert_int_equal (solve (&s, n, 0, &pull, &counts), BT_OK);
      counts = (bt__shape_counts){ 0 };
      for (int step = 0; step < 100; step++)
        {
          memcpy (r2, r, sizeof r);
          s.b = bt__axpy (s.b, 0.025, way);
          assert_int_equal (solve (&s, n, 1, &pull, &counts), BT_OK);
          for (int i = 0; i <= n; i++)
            assert_near (r[i], r2[i], 0.03 * s.line.length + 0.2, "a leap");
        }
      hard += counts.relaxations > 5 || counts.marches > 100 * 20;
      assert_int_equal (counts.unsettled, 0);
    }
  assert_true (hard <= 2); /* a hairpin that shooting cannot follow is relaxed at every step */
}

/* The current turns round: the line crosses to the other side and rests in the answer a fresh line
 * has.  */
static void
test_equilibrium_follows_the_current (void **state)
{
  (void)state;
  scene s;
  const int n = 32;
  bt__reaction pull = unknown;
  bt__shape_counts counts = { 0 };
  bt_line line = { 40, 0.0076, 0.02, INFINITY, 1.2, 0.01 };
  set_scene (&s, line, 1025, BT_CURRENT_UNIFORM, 0, bt__vec (0.5, 0, 0), bt__vec (0, 30, -5));
  assert_int_equal (solve (&s, n, 0, &pull, &counts), BT_OK);
  assert_true (r[n / 2].x > 5);
  s.current.velocity[0].x = -0.5;
  for (int call = 0; call < 12; call++)
    assert_int_equal (solve (&s, n, 1, &pull, &counts), BT_OK);
  memcpy (r2, r, sizeof r);
  pull = unknown;
  for (int call = 0; call < 3; call++)
    assert_int_equal (solve (&s, n, call > 0, &pull, &counts), BT_OK);
  for (int i = 0; i <= n; i++)
    assert_near (r2[i], r[i], 1e-8 * line.length, "after the turn of the tide");
  assert_true (shoot (&s, N_MAX).converged);
  for (int i = 0; i <= n; i++)
    assert_near (r2[i], r[i * (N_MAX / n)], 1e-6 * line.length, "after the turn, on a fine mesh");
}

/* ---- Robustness ---- */

/* Random points, folded, all in one point, enormous, not finite: what junk may reach the solver. */
static void
junk_shape (const scene *s, int kind, int n, bt_vec3 *shape)
{
  for (int i = 0; i <= n; i++)
    {
      bt_vec3 chord = bt__sub (s->b, s->a), far = bt__scale (s->line.length, direction ());
      bt_vec3 points[] = { bt__axpy (s->a, chance_between (&seed, 0, 3), far),
                           bt__axpy (s->a, i % 2, chord),
                           s->a,
                           bt__axpy (s->a, 1e4, far),
                           bt__axpy (s->a, i == n / 2 ? NAN : 1, far),
                           bt__axpy (s->a, (double)i / n, chord) };
      shape[i] = points[kind % 6];
    }
}

/* The longest link of the N + 1 nodes X, to what a link of the line of S must be.  */
static double
longest_link (const scene *s, const bt_vec3 *x, int n)
{
  double most = 0;
  for (int i = 0; i < n; i++)
    most = fmax (most, bt__distance (x[i], x[i + 1]));
  return most / fmax (s->line.length / n, bt__distance (s->a, s->b) / n);
}

/* A shape that has not come to rest is one that the line can have.  */
static void
test_relaxation_survives_junk (void **state)
{
  (void)state;
  static const double stiffness[] = { 1e4, 2e5, 1e8, INFINITY };
  static const int links[] = { 1, 2, 3, 8, 20, 50 };
  int at_rest = 0;
  seed = 0x853c49e6748fea9bu;
  for (int k = 0; k < 2000; k++)
    {
      scene s;
      int n = links[k % 6];
      double chord
          = k % 3 ? chance_between (&seed, 1e-6, 1.05) : pow (10, chance_between (&seed, -6, 0));
      random_scene (&s, chord, chord, 5, stiffness[k / 7 % 4]);
      if (k % 11 == 0)
        s.line.wet_weight = 0, s.current.kind = BT_CURRENT_STILL;
      if (k % 13 == 0)
        s.b = s.a;
      junk_shape (&s, k / 6, n, r);
      bt_steady_report report = relax (&s, n, 150, r, t);
      assert_true (all_finite (r, n) && all_finite (t, n) && isfinite (report.residual));
      assert_true (report.integrations <= 150);
      at_rest += report.converged;
      if (!report.converged)
        assert_true (longest_link (&s, r, n) < 1.002);
    }
  if (at_rest < 1450)
    fail_msg ("only %d of 2000 came to rest in 150 solves", at_rest);
}

static void
hole (void *user, bt_vec3 p, double time, bt_vec3 *v)
{
  (void)user;
  (void)time;
  *v = bt__vec (p.z < -1 ? NAN : 0.3, 0, 0);
}

/* A current that is not finite is refused by every solver, not digested.  */
static void
test_current_that_is_not_finite (void **state)
{
  (void)state;
  scene s;
  bt_steady_report report;
  bt_error error;
  bt__shape_counts counts = { 0 };
  bt_vec3 pull = { 3, 0, -3 };
  bt__reaction reaction = { 0, pull, { { 0, 0, 0 } } };
  bt_line line = { 30, 0.0076, 0.1, 2e5, 1.2, 0.01 };
  set_scene (&s, line, 1025, BT_CURRENT_FUNCTION, 0, bt__vec (0, 0, 0), bt__vec (10, 0, -15));
  s.water.function = hole;
  assert_int_equal (bt_steady_march (&s.line, &s.water, s.a, pull, 32, r, t, &error),
                    BT_ERR_DIVERGED);
  assert_int_equal (
      bt_steady_shoot (steady, &s.line, &s.water, s.a, s.b, 32, 1, &pull, r, t, &report, &error),
      BT_ERR_DIVERGED);
  memset (r, 0, sizeof r);
  assert_int_equal (
      bt_steady_relax (steady, &s.line, &s.water, s.a, s.b, 32, 50, r, t, &report, &error),
      BT_ERR_DIVERGED);
  assert_int_equal (solve (&s, 32, 0, &reaction, &counts), BT_ERR_DIVERGED);
  assert_int_equal (bt_steady_march (&s.line, &s.water, s.a, bt__vec (0, 0, 0), 32, r, t, NULL),
                    BT_ERR_DIVERGED);
}

/* A stretched line is straight with T = ea times its strain; a line without loads keeps its shape.
 */
static void
test_straight_and_unloaded (void **state)
{
  (void)state;
  scene s;
  const int n = 16;
  bt__reaction pull = unknown;
  bt__shape_counts counts = { 0 };
  bt_line line = { 50, 0.0076, 0, 2e5, 1.2, 0.01 };
  set_scene (&s, line, 1025, BT_CURRENT_STILL, 0, bt__vec (0, 0, 0), bt__vec (50.5, 0, 0));
  assert_int_equal (solve (&s, n, 0, &pull, &counts), BT_OK);
  for (int i = 0; i <= n; i++)
    {
      assert_near (r[i], bt__vec (50.5 * i / n, 0, 0), 1e-8, "stretched");
      assert_near (t[i], bt__vec (2000, 0, 0), 1e-5, "stretched");
    }
  s.b = bt__vec (30, 0, 0);
  random_shape (&s, n, r);
  r[n] = s.b;
  memcpy (r2, r, sizeof r);
  assert_int_equal (solve (&s, n, 1, &pull, &counts), BT_OK);
  assert_true (all_finite (r, n) && bt__norm (t[0]) < 1);
  s.line.ea = INFINITY;
  s.b = bt__vec (51, 0, 0);
  assert_int_equal (solve (&s, n, 1, &pull, &counts), BT_OK);
  assert_near (r[n / 2], bt__vec (25.5, 0, 0), 1e-12, "inextensible and too short");
}

static void
test_limits_are_refused (void **state)
{
  (void)state;
  scene s;
  bt_steady_report report;
  bt__shape_counts counts = { 0 };
  bt_vec3 pull = { 1, 0, 0 };
  bt__reaction reaction = { 0, pull, { { 0, 0, 0 } } };
  row_scene (&s, &table[0]);
  static const int bad[] = { 0, -1, N_MAX + 1 };
  for (int i = 0; i < 3; i++)
    {
      int n = bad[i];
      assert_int_equal (
          bt_steady_shoot (steady, &s.line, &s.water, s.a, s.b, n, 0, &pull, r, t, &report, NULL),
          BT_ERR_LIMIT);
      assert_int_equal (
          bt_steady_relax (steady, &s.line, &s.water, s.a, s.b, n, 9, r, t, &report, NULL),
          BT_ERR_LIMIT);
      assert_int_equal (solve (&s, n, 0, &reaction, &counts), BT_ERR_LIMIT);
    }
  s.b.x = NAN;
  assert_int_equal (solve (&s, 8, 0, &reaction, &counts), BT_ERR_DOMAIN);
  assert_null (bt_steady_new (0));
  bt_steady_free (NULL);
}

/* Every equilibrium found is one: relaxed again it stays, and no two are the same.  */
static void
test_equilibria (void **state)
{
  (void)state;
  enum
  {
    N = 24,
    MAX = 6
  };
  static bt_vec3 shapes[MAX * (N + 1)];
  seed = 0xc0ffee123456789u;
  for (int k = 0; k < 30; k++)
    {
      scene s;
      int found = -1;
      random_scene (&s, 0.2, 0.9, 1, 2e5);
      assert_int_equal (
          bt_steady_equilibria (steady, &s.line, &s.water, s.a, s.b, N, MAX, shapes, &found, NULL),
          BT_OK);
      assert_true (found >= 1 && found <= MAX);
      for (int i = 0; i < found; i++)
        {
          memcpy (r, shapes + i * (N + 1), sizeof *r * (N + 1));
          assert_true (relax (&s, N, 200, r, t).converged);
          for (int j = 0; j <= N; j++)
            assert_near (r[j], shapes[i * (N + 1) + j], 1e-6 * s.line.length, "at rest");
        }
    }
}

/* Water that rises above 20 m of depth and sinks below: a line across it bows up or down.  Both are
   found, and the line stays in the one it is in, though the tension it is given leads shooting to
   the other.  */
static void
test_equilibrium_keeps_its_shape (void **state)
{
  (void)state;
  enum
  {
    N = 32,
    MAX = 6
  };
  static bt_vec3 shapes[MAX * (N + 1)];
  bt_line line = { 40, 0.0076, 0, 2e5, 1.2, 0.01 };
  for (double chord = 12; chord < 38; chord += 5)
    {
      scene s;
      int found;
      bt__shape_counts counts = { 0 };
      set_scene (&s, line, 1025, BT_CURRENT_PROFILE, 100, bt__vec (0, 0, 0.5),
                 bt__vec (0, chord, -20));
      s.a.z = -20;
      s.current.z[0] = -10;
      s.current.z[1] = -30;
      s.current.velocity[1] = bt__vec (0, 0, -0.5);
      bt_steady_equilibria (steady, &s.line, &s.water, s.a, s.b, N, MAX, shapes, &found, NULL);
      assert_true (found >= 2);
      for (int i = 0; i < 2; i++)
        {
          const bt_vec3 *mine = shapes + i * (N + 1), *other = shapes + (1 - i) * (N + 1);
          memcpy (r, other, sizeof *r * (N + 1));
          relax (&s, N, 200, r, t);
          bt__reaction pull = { 0, t[0], { { 0, 0, 0 } } };
          memcpy (r, mine, sizeof *r * (N + 1));
          assert_int_equal (solve (&s, N, 1, &pull, &counts), BT_OK);
          for (int j = 0; j <= N; j++)
            assert_near (r[j], mine[j], 0.021 * s.line.length, "its own shape");
        }
    }
}

static int
set_up (void **state)
{
  (void)state;
  steady = bt_steady_new (N_MAX);
  return steady ? 0 : -1;
}

static int
tear_down (void **state)
{
  (void)state;
  bt_steady_free (steady);
  return 0;
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_fixed_ends_are_reproduced),
    cmocka_unit_test (test_shooting_is_of_fourth_order),
    cmocka_unit_test (test_corners_in_the_drag_cost_one_order),
    cmocka_unit_test (test_relaxation_is_of_second_order),
    cmocka_unit_test (test_free_ends_are_reproduced),
    cmocka_unit_test (test_golden_numbers),
    cmocka_unit_test (test_neutral_line_is_a_catenary),
    cmocka_unit_test (test_equilibrium_from_random_shapes),
    cmocka_unit_test (test_equilibrium_follows_the_end),
    cmocka_unit_test (test_equilibrium_follows_the_current),
    cmocka_unit_test (test_relaxation_survives_junk),
    cmocka_unit_test (test_current_that_is_not_finite),
    cmocka_unit_test (test_straight_and_unloaded),
    cmocka_unit_test (test_limits_are_refused),
    cmocka_unit_test (test_equilibria),
    cmocka_unit_test (test_equilibrium_keeps_its_shape),
  };
  return cmocka_run_group_tests (tests, set_up, tear_down);
}
