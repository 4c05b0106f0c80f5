/* The moving line: damping of bending.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"

enum
{
  INTERVALS = 60
};

#define LENGTH 2.0
#define MASS 0.5  /* kg/m */
#define PULL 4.0  /* N */
#define STIFF 1.5 /* N m2 */
#define SWAY 1e-4 /* m */

static double mode[INTERVALS + 1];

/* A pinned beam under PULL in vacuum, displaced to its mode of NUMBER, with DAMPING.  */
static void
open_beam (scene *s, int number, double stiff, double damping)
{
  double ea = 1e6;
  bt_vec3 shape[2] = { { 0, 0, 0 }, { LENGTH, 0, 0 } }, *x;
  bt_tether_props line
      = { .diameter = 0.01, .mass = MASS, .ea = ea, .ei = stiff, .bending_damping = damping };
  scene_open (s, line, 0, INTERVALS, shape, 2, LENGTH / (1 + PULL / ea));
  x = bt__dynamic_x (s->d);
  for (int i = 0; i <= INTERVALS; i++)
    {
      mode[i] = sin (number * BT__PI * i / INTERVALS);
      x[i].z += SWAY * mode[i];
    }
  for (int j = 0; j < INTERVALS; j++)
    bt__dynamic_stretch (s->d)[j] = bt__distance (x[j], x[j + 1]) / bt__dynamic_rest (s->d)[j];
}

/* The share of the mode in the shape of S, of SWAY.  */
static double
share_of_mode (const scene *s)
{
  double sum = 0, all = 0;
  for (int i = 0; i <= INTERVALS; i++)
    {
      sum += mode[i] * bt__dynamic_x (s->d)[i].z;
      all += mode[i] * mode[i];
    }
  return sum / all / SWAY;
}

/* m q'' + D k^4 q' + (T k^2 + EI k^4) q = 0 for the mode of wave number k, from rest at q = 1.  */
static double
closed_form (double k, double damping, double t)
{
  double k4 = k * k * k * k, g = damping * k4 / (2 * MASS);
  double square = (PULL * k * k + STIFF * k4) / MASS - g * g, w = sqrt (fabs (square));
  if (square > 0)
    return exp (-g * t) * (cos (w * t) + g / w * sin (w * t));
  double a = g - w, b = g + w;
  return (b * exp (-a * t) - a * exp (-b * t)) / (b - a);
}

/* Damping ratios of a tenth, four fifths, and three: beyond three the beam creeps back.  */
static void
test_beam_is_damped (void **state)
{
  static const double ratios[] = { 0.1, 0.8, 3 };
  (void)state;
  for (int number = 1; number <= 3; number += 2)
    for (int r = 0; r < 3; r++)
      {
        scene s;
        double k = number * BT__PI / LENGTH, k4 = k * k * k * k;
        double w = sqrt ((PULL * k * k + STIFF * k4) / MASS), period = 2 * BT__PI / w;
        double damping = ratios[r] * 2 * MASS * w / k4, worst = 0;
        open_beam (&s, number, STIFF, damping);
        for (int i = 1; i <= 1200; i++)
          {
            scene_step (&s, period / 600);
            worst
                = fmax (worst, fabs (share_of_mode (&s) - closed_form (k, damping, s.water.time)));
          }
        if (!(worst < 0.01))
          fail_msg ("mode %d, damping ratio %g: off by %g of the sway", number, ratios[r], worst);
        scene_close (&s);
      }
}

/* Whatever the damping, with stiffness or without, no step gives energy, and all is solved.  */
static void
test_any_damping_is_stable (void **state)
{
  (void)state;
  for (int stiff = 0; stiff < 2; stiff++)
    for (double damping = 1e-9; damping < 2e9; damping *= 1000)
      {
        scene s;
        open_beam (&s, 2, stiff * STIFF, damping);
        s.in.tolerance = 0;
        double before = scene_energy (&s);
        for (int i = 0; i < 100; i++)
          {
            scene_step (&s, 1.0 / 60);
            double now = scene_energy (&s);
            assert_true (s.report.converged && now <= before * (1 + 1e-9));
            before = now;
          }
        scene_close (&s);
      }
}

/* A beam that is bent by its end comes to rest in the same shape with damping and without.  */
static void
test_damping_holds_nothing_at_rest (void **state)
{
  (void)state;
  bt_vec3 tip[2];
  for (int k = 0; k < 2; k++)
    {
      scene s;
      bt_vec3 shape[2] = { { 0, 0, 0 }, { 1, 0, 0 } };
      bt_tether_props line = { .diameter = 0.01, .mass = 1, .ea = 1e7, .ei = 1 };
      line.bending_damping = k ? 0.1 : 0;
      scene_open (&s, line, 0, 40, shape, 2, 1);
      s.in.end[0].clamped = s.in.end[1].free = 1;
      s.in.end[0].direction = bt__vec (1, 0, 0);
      s.in.end[1].body.force = bt__vec (0, 0, -3);
      for (int i = 0; i < 400; i++) /* backward Euler, which takes the motion out */
        {
          scene_step (&s, 0.05);
          bt__dynamic_still (s.d);
        }
      tip[k] = bt__dynamic_x (s.d)[40];
      scene_close (&s);
    }
  assert_close (bt__distance (tip[0], tip[1]), 0, 1e-5, "tip");
}

/* A straight line without stiffness, slack in one part and taut in another, is damped as any other.
 */
static void
test_slack_line_is_damped (void **state)
{
  (void)state;
  for (double pull = -0.1; pull < 0.2; pull += 0.1)
    {
      scene s;
      bt_vec3 shape[2] = { { 0, 0, 0 }, { LENGTH, 0, 0 } };
      bt_tether_props line = {
        .diameter = 0.01, .mass = MASS, .wet_weight = 0.1, .ea = 1e6, .bending_damping = 0.5
      };
      scene_open (&s, line, 1025, INTERVALS, shape, 2, LENGTH);
      for (int i = 0; i < 120; i++)
        {
          s.in.end[1].at.x = LENGTH + (pull > 0 ? 1e-6 : pull) * fmin (1, i / 60.0);
          scene_step (&s, 1.0 / 60);
          assert_true (s.report.converged);
        }
      assert_true (pull >= 0 || bt__dynamic_x (s.d)[INTERVALS / 2].z < -0.01);
      scene_close (&s);
    }
}

/* ---- Paid out ---- */

#define BEND 2.0  /* m: radius of a circle */
#define SPEED 1.0 /* m/s */
#define STEP 5e-4 /* s */

/* The place of a line that runs round a circle, S metres from the winch.  */
static bt_vec3
on_circle (double s)
{
  return bt__vec (BEND * sin (s / BEND), 0, BEND * (1 - cos (s / BEND)));
}

/* Let the line of S move along the circle at SPEED, as in the steps before.  */
static void
set_running (scene *s)
{
  bt_vec3 *x = bt__dynamic_x (s->d), *v = bt__dynamic_v (s->d), *dx = bt__dynamic_dx (s->d);
  for (int64_t i = 1; i <= s->d->n; i++)
    {
      double at = LENGTH * (double)i / (double)s->d->n;
      x[i] = on_circle (at);
      dx[i] = bt__sub (x[i], on_circle (at - SPEED * STEP));
      v[i] = bt__scale (0.5 * SPEED / 1e-4, bt__sub (on_circle (at + 1e-4), on_circle (at - 1e-4)));
      bt__dynamic_vp (s->d)[i] = v[i];
    }
}

/* How far from its circle is a line that is paid out along it, without weight in vacuum, with
   DAMPING, m: under a tension of m v^2 a line runs on along itself in any shape.
 */
static double
strays_from_circle (double damping)
{
  scene s;
  double ea = 1e5, stretch = 1 + MASS * SPEED * SPEED / ea, worst = 0;
  bt_vec3 shape[INTERVALS + 1];
  bt_tether_props line = { .diameter = 0.01, .mass = MASS, .ea = ea, .bending_damping = damping };
  for (int i = 0; i <= INTERVALS; i++)
    shape[i] = on_circle (LENGTH * i / INTERVALS);
  double chord = bt__distance (shape[0], shape[1]);
  scene_open (&s, line, 0, INTERVALS, shape, INTERVALS + 1, INTERVALS * chord / stretch);
  set_running (&s);
  s.in.pay = SPEED / stretch;
  for (int i = 1; i <= 35; i++)
    {
      s.in.end[1].at = on_circle (LENGTH + SPEED * STEP * i);
      scene_step (&s, STEP);
      for (int64_t k = 0; k <= s.d->n; k++)
        {
          bt_vec3 off = bt__sub (bt__dynamic_x (s.d)[k], bt__vec (0, 0, BEND));
          worst = fmax (worst, fabs (bt__norm (off) - BEND));
        }
    }
  scene_close (&s);
  return worst;
}

/* The winch changes how much line is between it and the first node, not how the line is bent there:
   damping feels nothing of it.  */
static void
test_winch_is_not_damped (void **state)
{
  (void)state;
  static const double damping[] = { 0, 0.001, 0.01, 0.1 };
  for (int k = 0; k < 4; k++)
    {
      double strays = strays_from_circle (damping[k]);
      if (!(strays < 1e-5))
        fail_msg ("with a damping of %g N m2 s the line is %g m off", damping[k], strays);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_beam_is_damped),
    cmocka_unit_test (test_any_damping_is_stable),
    cmocka_unit_test (test_damping_holds_nothing_at_rest),
    cmocka_unit_test (test_slack_line_is_damped),
    cmocka_unit_test (test_winch_is_not_damped),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
