/* A vehicle on a stiff line: no jitter, no energy made, all momentum handed over.

   The line here is an anchor, a spring that cannot push, a node of line, another such spring, and
   the vehicle's grip: solved implicitly as the moving line solves itself, by BDF2, and as stiff and
   as light or heavy as one likes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "vehicle/body.h"
#include "vehicle/inertia.h"
#include "vehicle/solve.h"
#include "../oracle/rigid_energy.h"

#define STEP (1.0 / 60)
#define G 9.80665

typedef struct line
{
  bt_vec3 anchor;
  double k, rest, mass, drag;      /* N/m and m of each spring, kg and N s/m of the node */
  bt_vec3 x[2], x_start, x_before; /* node, end; node at the start of the step and of the last */
  bt_vec3 v, v_before;
  double tension; /* N: of the outer spring */
} line;

/* Force of the spring from A on B, and its stiffness, which is positive, to the block at ROW and
   COLUMN times SIGN.  */
static bt_vec3
spring (const line *l, bt_vec3 a, bt_vec3 b, double (*k)[3])
{
  bt_vec3 d = bt__sub (b, a);
  double length = bt__norm (d), pull = l->k * (length - l->rest);
  memset (k, 0, 9 * sizeof (double));
  if (!(pull > 0))
    return bt__vec (0, 0, 0);
  bt_vec3 u = bt__scale (1 / length, d);
  double t[3] = { u.x, u.y, u.z }, across = pull / length;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      k[i][j] = (l->k - across) * t[i] * t[j] + (i == j ? across : 0);
  return bt__scale (-pull, u);
}

static void
add_block (double (*a)[6], int row, int column, double (*k)[3], double sign)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      a[row + i][column + j] += sign * k[i][j];
}

/* Where the node would be at the end of the step if its velocity were zero then.  */
static bt_vec3
coast_of (const line *l, double h)
{
  bt_vec3 v0 = bt__scale (0.5 / h, bt__sub (l->x_before, l->x_start));
  return bt__axpy (l->x_start, -h / 1.5, v0);
}

/* The gradient (to R, negative) and Hessian of the step's potential at X.  */
static void
equations (const line *l, const bt__grip *grip, bt_vec3 wish, const bt_vec3 *x, double h, double *r,
           double (*a)[6])
{
  double k0[3][3], k1[3][3], b0 = 1.5 / h;
  bt_vec3 f0 = spring (l, l->anchor, x[0], k0), f1 = spring (l, x[0], x[1], k1);
  double inertia = l->mass * b0 * b0, drag = l->drag * b0;
  bt_vec3 at_node = bt__axpy (bt__sub (f0, f1), inertia, bt__sub (wish, x[0]));
  at_node = bt__axpy (at_node, drag, bt__sub (coast_of (l, h), x[0]));
  bt_vec3 at_end = bt__sub (f1, bt__grip_pull (grip, x[1]));
  double grip_k[3][3];
  memcpy (grip_k, grip->stiffness, sizeof grip_k);
  memset (a, 0, 36 * sizeof (double));
  add_block (a, 0, 0, k0, 1);
  add_block (a, 0, 0, k1, 1);
  add_block (a, 0, 3, k1, -1);
  add_block (a, 3, 0, k1, -1);
  add_block (a, 3, 3, k1, 1);
  add_block (a, 3, 3, grip_k, 1);
  for (int i = 0; i < 3; i++)
    a[i][i] += inertia + drag;
  memcpy (r, (double[6]){ at_node.x, at_node.y, at_node.z, at_end.x, at_end.y, at_end.z },
          6 * sizeof *r);
}

static double
potential (const line *l, const bt__grip *grip, bt_vec3 wish, const bt_vec3 *x, double h)
{
  double b0 = 1.5 / h, e0 = bt__distance (x[0], l->anchor) - l->rest;
  double e1 = bt__distance (x[1], x[0]) - l->rest;
  bt_vec3 d = bt__sub (x[0], wish);
  double sum = bt__dot (bt__grip_pull (grip, x[1]), bt__sub (x[1], grip->at));
  sum += l->mass * b0 * b0 * bt__dot (d, d);
  d = bt__sub (x[0], coast_of (l, h));
  sum += l->drag * b0 * bt__dot (d, d);
  sum += e0 > 0 ? l->k * e0 * e0 : 0;
  return (sum + (e1 > 0 ? l->k * e1 * e1 : 0)) / 2;
}

/* The step of the line: Newton on a convex potential, with halving.  */
static void
solve (line *l, const bt__grip *grip, bt_vec3 wish, double h)
{
  bt_vec3 *x = l->x;
  double size = 1;
  for (int n = 0; n < 200 && size > 1e-13; n++)
    {
      double d[6], a[6][6], before = potential (l, grip, wish, x, h), share = 1;
      equations (l, grip, wish, x, h, d, a);
      assert_true (bt__factor6 (a));
      bt__substitute6 (a, d);
      bt_vec3 y[2] = { x[0], x[1] };
      for (int i = 0; i < 40; i++, share /= 2)
        {
          y[0] = bt__axpy (x[0], share, bt__vec (d[0], d[1], d[2]));
          y[1] = bt__axpy (x[1], share, bt__vec (d[3], d[4], d[5]));
          if (potential (l, grip, wish, y, h) <= before)
            break;
        }
      size = bt__distance (x[0], y[0]) + bt__distance (x[1], y[1]);
      x[0] = y[0];
      x[1] = y[1];
    }
}

/* A coupled step; returns how far the body's attachment ends from the line's end, m.  */
static double
step (const bt__vehicle_type *type, bt__rigid *body, bt__rigid_input *in, line *l)
{
  bt__grip grip;
  bt_error error;
  double h = in->h, b0 = 1.5 / h;
  in->gripped = 1;
  in->stiffness = l->k;
  assert_int_equal (bt__rigid_grip (type, body, in, &grip, &error), BT_OK);
  /* BDF2: v = (3 X - 4 x + x')/2h, a = (3 v - 4 v0 + v')/2h: mass times b0^2 (X - wish).  */
  bt_vec3 v0 = bt__scale (0.5 / h, bt__sub (l->x_before, l->x[0]));
  bt_vec3 a0 = bt__scale (0.5 / h, bt__axpy (l->v_before, -4, l->v));
  bt_vec3 start = l->x_start = l->x[0];
  bt_vec3 wish = bt__axpy (bt__axpy (start, -1 / b0, v0), -1 / (b0 * b0), a0);
  solve (l, &grip, wish, h);
  l->v_before = l->v;
  l->v = bt__axpy (v0, b0, bt__sub (l->x[0], start));
  l->x_before = start;
  in->pull = bt__grip_pull (&grip, l->x[1]);
  l->tension = bt__norm (in->pull);
  assert_int_equal (bt__rigid_step (type, body, in, &error), BT_OK);
  return bt__distance (bt__rigid_point (body, type->attached), l->x[1]);
}

static line
line_to (const bt__vehicle_type *type, const bt__rigid *body, double k, double mass, double rest)
{
  line l = { .k = 2 * k, .rest = rest / 2, .mass = mass };
  l.x[1] = bt__rigid_point (body, type->attached);
  l.anchor = bt__sub (l.x[1], bt__vec (0, rest, 0));
  l.x[0] = l.x_before = bt__axpy (l.anchor, 0.5, bt__sub (l.x[1], l.anchor));
  return l;
}

static double
spring_energy (const line *l)
{
  double e0 = bt__distance (l->x[0], l->anchor) - l->rest;
  double e1 = bt__distance (l->x[1], l->x[0]) - l->rest;
  return l->k / 2 * ((e0 > 0 ? e0 * e0 : 0) + (e1 > 0 ? e1 * e1 : 0))
         + l->mass / 2 * bt__dot (l->v, l->v);
}

static bt__vehicle_type
type_of (const char *name)
{
  bt__vehicle_type type;
  bt_error error;
  assert_int_equal (bt__vehicle_type_find (name, &type, &error), BT_OK);
  return type;
}

static const bt_vec3 still = { 0, 0, 0 };

/* In no water a vehicle flies off, the line snaps taut and flings it back, over and over, at every
   ratio of masses and stiffness: the energy never exceeds what it was.  */
static void
test_no_energy_is_made (void **state)
{
  (void)state;
  double worst = 0, gap = 0, pull = 0;
  for (int i = 0; bt__vehicle_type_name (i); i += 2)
    for (double ratio = 1e-3; ratio < 2e3; ratio *= 10)
      for (double k = 1e2; k < 2e7; k *= 10)
        {
          bt__vehicle_type type = type_of (bt__vehicle_type_name (i));
          bt__rigid body;
          bt__rigid_place (&body, bt__vec (0, 0, -50), 0.3, 0.1, 0);
          body.velocity = bt__vec (0.5, 1.5, 0.3);
          bt__rigid_input in = { .h = STEP };
          line l = line_to (&type, &body, k, ratio * type.mass, 2);
          double energy = rigid_energy (&type, &body, still);
          for (int n = 0; n < 1200; n++)
            {
              double apart = step (&type, &body, &in, &l);
              double now = rigid_energy (&type, &body, still) + spring_energy (&l);
              worst = fmax (worst, now / energy - 1);
              gap = fmax (gap, apart);
              pull = fmax (pull, l.tension);
            }
        }
  print_message ("energy at most %.3g above the start, gap %.3g m, pull %.0f N\n", worst, gap,
                 pull);
  assert_true (pull > 2000);
  assert_true (worst < 1e-3);
}

/* Under water, thrust pulls it away from the anchor: it comes to rest on the line, whose tension is
   the thrust, and nothing trembles.  */
static void
test_no_jitter (void **state)
{
  (void)state;
  for (int i = 0; bt__vehicle_type_name (i); i += 2)
    for (double ratio = 1e-3; ratio < 2e3; ratio *= 10)
      for (double per_mass = 1e2; per_mass < 2e6; per_mass *= 100)
        {
          bt__vehicle_type type = type_of (bt__vehicle_type_name (i));
          bt__rigid body;
          type.volume = type.mass / 1025;
          double k = per_mass * type.mass;
          for (int c = 0; c < BT__AXES; c++)
            type.hydro.linear[c] += c < 3 ? 2 * type.mass : type.inertia.z; /* soon at rest */
          bt__rigid_place (&body, bt__vec (0, 0, -50), 0, 0, 0);
          body.velocity = bt__vec (0, 3, 0);
          double thrust = type.mass * G;
          bt__rigid_input in = {
            .h = STEP, .density = 1025, .gravity = G, .surface = INFINITY, .force = { 0, thrust, 0 }
          };
          line l = line_to (&type, &body, k, ratio * type.mass, 2);
          l.drag = 2 * sqrt (l.k * l.mass);
          double before[2] = { 0, 0 }, tremble = 0;
          for (int n = 0; n < 6000; n++)
            {
              step (&type, &body, &in, &l);
              if (n > 5900)
                tremble = fmax (tremble, fabs (l.tension - 2 * before[1] + before[0]));
              before[0] = before[1];
              before[1] = l.tension;
            }
          if (!(fabs (l.tension / thrust - 1) < 1e-3 && bt__norm (body.velocity) < 5e-3
                && tremble < 1e-4 * thrust))
            fail_msg ("%s, ratio %g, k %g: tension %g of %g, trembling %g, speed %g", type.name,
                      ratio, k, l.tension, thrust, tremble, bt__norm (body.velocity));
        }
}

/* A massless line comes taut: the pull peaks at v sqrt (k m) = 0.8 sqrt (20000/30 19.86) = 92.05 N
   (m: mass and added mass in surge).  It is of second order.  */
static void
test_snap (void **state)
{
  (void)state;
  double peak[3], offset[3];
  for (int r = 0; r < 3; r++)
    {
      bt__vehicle_type type = type_of ("bluerov2-heavy");
      bt__rigid body;
      memset (&type.hydro.linear, 0, sizeof type.hydro.linear);
      memset (&type.hydro.quadratic, 0, sizeof type.hydro.quadratic);
      bt__rigid_place (&body, bt__vec (0, 0, -50), 0, 0, 0);
      body.velocity.y = 0.8;
      bt__rigid_input in = { .h = STEP / (1 << r) };
      line l = line_to (&type, &body, 20000.0 / 30, 1e-9, 30);
      peak[r] = 0;
      for (int n = 0; n < 20 << r; n++)
        {
          step (&type, &body, &in, &l);
          peak[r] = fmax (peak[r], l.tension);
          if (n + 1 == 15 << r)
            offset[r] = body.position.y;
        }
    }
  double m = 13.5 + 6.36, w = sqrt (20000.0 / 30 / m), expected = 0.8 / w * sin (w * 0.25);
  print_message ("peak %.3f %.3f %.3f N; offset %.3g %.3g %.3g m\n", peak[0], peak[1], peak[2],
                 offset[0] - expected, offset[1] - expected, offset[2] - expected);
  assert_true (fabs (peak[0] / 92.05 - 1) < 0.01);
  double order = log2 ((offset[0] - expected) / (offset[1] - expected));
  assert_true (order > 1.7);
}

/* What the line gives arrives: a soft line's impulse is the mean of its pulls at the ends of each
   step, and what is let go of abruptly is never more than that.  */
static void
test_momentum (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("bluerov2-heavy");
  bt__rigid body;
  bt_error error;
  type.attached = still;
  memset (type.hydro.added, 0, sizeof type.hydro.added);
  bt__rigid_place (&body, bt__vec (0, 0, -50), 0.4, 0, 0);
  bt_vec3 sum = { 0, 0, 0 }, before = { 0, 0, 0 };
  for (int n = 0; n < 200; n++)
    {
      bt__rigid_input in = { .h = STEP, .gripped = 1 };
      in.pull = bt__vec (20 + 10 * sin (0.1 * n), 9 * cos (0.2 * n), -4);
      sum = bt__axpy (sum, STEP / 2, bt__add (in.pull, before));
      before = in.pull;
      assert_int_equal (bt__rigid_step (&type, &body, &in, &error), BT_OK);
    }
  bt_vec3 p = bt__scale (type.mass, bt__rigid_point_velocity (&body, still));
  assert_true (bt__norm (sum) > 1);
  assert_true (bt__distance (p, sum) < 1e-10 * bt__norm (sum));
  bt__rigid_input gone = { .h = STEP, .gripped = 1 };
  assert_int_equal (bt__rigid_step (&type, &body, &gone, &error), BT_OK);
  bt_vec3 q = bt__scale (type.mass, bt__rigid_point_velocity (&body, still));
  assert_true (bt__distance (p, q) <= 1e-14 * bt__norm (p));
}

/* On a soft steady pull the attachment goes where the line's end was brought.  */
static void
test_grip_is_where_the_body_goes (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("bluerov2-heavy");
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, -50), 0, 0, 0);
  body.velocity = bt__vec (0.6, 0.2, 0.1);
  body.spin = bt__vec (0.1, 0.2, 0.5);
  bt__rigid_input in = { .h = STEP, .density = 1025, .gravity = G, .surface = INFINITY };
  line l = line_to (&type, &body, 2e4, 0.1, 5);
  double gap = 0;
  for (int n = 0; n < 1200; n++)
    gap = fmax (gap, step (&type, &body, &in, &l));
  print_message ("gap %.3g m\n", gap);
  assert_true (gap < 1e-3);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_no_energy_is_made),
    cmocka_unit_test (test_no_jitter),
    cmocka_unit_test (test_snap),
    cmocka_unit_test (test_momentum),
    cmocka_unit_test (test_grip_is_where_the_body_goes),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
