/* A vehicle moves as rigid bodies in water do: closed forms, conserved quantities, turns.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "vehicle/body.h"
#include "vehicle/inertia.h"
#include "../oracle/rigid_energy.h"

#define STEP (1.0 / 60)
#define G 9.80665

static bt__vehicle_type
type_of (const char *name)
{
  bt__vehicle_type type;
  bt_error error;
  assert_int_equal (bt__vehicle_type_find (name, &type, &error), BT_OK);
  assert_int_equal (bt__vehicle_type_check (&type, &error), BT_OK);
  return type;
}

/* Weightless, without thrusters, drag and centres apart: what is left is inertia.  */
static bt__vehicle_type
lump_of (double mass, bt_vec3 inertia)
{
  return (bt__vehicle_type){ .name = "lump", .mass = mass, .inertia = inertia, .hydro.munk = 1 };
}

static void
run (const bt__vehicle_type *type, bt__rigid *body, const bt__rigid_input *in, int steps)
{
  bt_error error;
  for (int i = 0; i < steps; i++)
    assert_int_equal (bt__rigid_step (type, body, in, &error), BT_OK);
}

static void
assert_close (double value, double expected, double tolerance, const char *what)
{
  if (!(fabs (value - expected) <= tolerance))
    fail_msg ("%s: %.12g is not %.12g (off by %.3g, allowed %.3g)", what, value, expected,
              value - expected, tolerance);
}

static bt_vec3
angular_momentum (const bt__vehicle_type *type, const bt__rigid *body)
{
  return bt__turn_out (body->attitude, bt__times (bt__inertias (type), body->spin));
}

/* ---- Bodies without forces ---- */

/* A spinning top without moments keeps energy and angular momentum, for hours.  */
static void
test_free_precession (void **state)
{
  (void)state;
  bt__vehicle_type type = lump_of (10, bt__vec (1, 2, 3));
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, -5), 1, 0.3, -0.2);
  body.spin = bt__vec (3, 0.2, 0.1); /* near the unstable axis: it tumbles */
  double energy = rigid_energy (&type, &body, bt__vec (0, 0, 0)), flipped = 0;
  bt_vec3 start = angular_momentum (&type, &body);
  bt__rigid_input in = { .h = STEP };
  for (int i = 0; i < 20000; i++)
    {
      run (&type, &body, &in, 1);
      flipped = fmin (flipped, body.spin.x);
    }
  assert_true (flipped < -2.9);
  assert_close (rigid_energy (&type, &body, bt__vec (0, 0, 0)) / energy, 1, 1e-11, "energy");
  assert_close (bt__distance (angular_momentum (&type, &body), start) / bt__norm (start), 0, 1e-11,
                "momentum");
}

/* A symmetric top: the spin goes round the axis at (I3 - I1) / I1 w3.  */
static void
test_precession_rate (void **state)
{
  (void)state;
  bt__vehicle_type type = lump_of (1, bt__vec (2, 2, 3));
  type.inertia = bt__vec (2, 2, 3); /* roll pitch yaw: x and y alike */
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, 0), 0, 0, 0);
  body.spin = bt__vec (0.4, 0, 1.5);
  bt__rigid_input in = { .h = STEP };
  double rate = (3 - 2) / 2.0 * 1.5, t = 4;
  run (&type, &body, &in, 240);
  assert_close (atan2 (body.spin.y, body.spin.x), remainder (rate * t, 2 * BT__PI), 3e-4, "phase");
  assert_close (body.spin.z, 1.5, 1e-12, "axial spin");
}

/* Kirchhoff: with anisotropic added mass and no drag, C moves energy about and makes none.  */
static void
test_coriolis_does_no_work (void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++)
    {
      bt__vehicle_type type = type_of (k ? "bluerov2-heavy" : "work-class");
      bt__rigid body;
      bt__rigid_place (&body, bt__vec (0, 0, -50), 0.5, 0.2, 0.1);
      memset (type.hydro.linear, 0, sizeof type.hydro.linear);
      memset (type.hydro.quadratic, 0, sizeof type.hydro.quadratic);
      type.hydro.munk = k ? 1 : 0.4;
      body.velocity = bt__vec (0.7, -1.1, 0.4);
      body.spin = bt__vec (0.5, -0.3, 0.9);
      bt_vec3 flow = bt__vec (0.3, 0.2, -0.1);
      double energy = rigid_energy (&type, &body, flow), least = energy;
      bt__rigid_input in = { .h = STEP, .flow = flow };
      for (int i = 0; i < 6000; i++)
        {
          run (&type, &body, &in, 1);
          assert_close (rigid_energy (&type, &body, flow) / energy, 1, 1e-10, "energy");
          least = fmin (least, type.mass * bt__dot (body.velocity, body.velocity) / 2);
        }
      assert_true (least < 0.95 * energy); /* it did go about */
    }
}

/* Drag alone takes energy away at every step, however absurd the speed and the step.  */
static void
test_bounded (void **state)
{
  (void)state;
  for (int i = 0; bt__vehicle_type_name (i); i++)
    for (double speed = 1; speed < 1e6; speed *= 31)
      for (double h = STEP; h < 100; h *= 40)
        {
          bt__vehicle_type type = type_of (bt__vehicle_type_name (i));
          bt__rigid body;
          bt__rigid_place (&body, bt__vec (0, 0, -5), 0, 0, 0);
          body.velocity = bt__vec (speed, -0.3 * speed, 0.7 * speed);
          body.spin = bt__vec (0.5 * speed, speed, -0.2 * speed);
          bt__rigid_input in = { .h = h, .density = 1025, .surface = INFINITY };
          double before = rigid_energy (&type, &body, bt__vec (0, 0, 0));
          for (int n = 0; n < 30; n++)
            {
              run (&type, &body, &in, 1);
              double now = rigid_energy (&type, &body, bt__vec (0, 0, 0));
              assert_true (now <= before * (1 + 1e-12));
              before = now;
            }
        }
}

/* Level, trimmed and told nothing, it keeps every bit; so it does with what a gone line left.  */
static void
test_rest (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("bluerov2-heavy");
  type.volume = type.mass / 1000;
  bt__rigid body, before;
  bt__rigid_place (&body, bt__vec (3.3, -7.7, -5.1), 0.7, 0, 0);
  before = body;
  bt__rigid_input in = { .h = STEP, .density = 1000, .gravity = G, .surface = 0 };
  run (&type, &body, &in, 1000);
  assert_memory_equal (&body, &before, sizeof body);
  in.gripped = 1;
  run (&type, &body, &in, 1000);
  assert_memory_equal (&body, &before, sizeof body);
}

/* ---- Water ---- */

/* v = (-l + sqrt (l2 + 4 q T)) / 2 q along each axis.  */
static double
terminal (double l, double q, double thrust)
{
  return (-l + sqrt (l * l + 4 * q * thrust)) / (2 * q);
}

static void
test_terminal_speed (void **state)
{
  (void)state;
  for (int i = 0; bt__vehicle_type_name (i); i++)
    for (int axis = BT__SURGE; axis <= BT__HEAVE; axis++)
      {
        bt__vehicle_type type = type_of (bt__vehicle_type_name (i));
        bt__rigid body;
        type.volume = type.mass / 1025;
        type.buoyancy = bt__vec (0, 0, 100); /* held upright */
        double force = 0.3 * type.mass * G;
        bt_vec3 way[3] = { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } };
        bt__rigid_place (&body, bt__vec (0, 0, -50), 0, 0, 0);
        bt__rigid_input in = { .h = STEP,
                               .density = 1025,
                               .gravity = G,
                               .surface = INFINITY,
                               .force = bt__scale (force, way[axis]),
                               .flow = { 0.2, -0.3, 0.1 } };
        body.velocity = in.flow;
        run (&type, &body, &in, 6000);
        double v = bt__dot (bt__sub (bt__rigid_point_velocity (&body, bt__vec (0, 0, 0)), in.flow),
                            way[axis]);
        double expected = terminal (type.hydro.linear[axis], type.hydro.quadratic[axis], force);
        assert_close (v / expected, 1, 1e-9, type.name);
      }
}

/* m v' = -l v - q v2: v = l / ((l/v0 + q) exp (l t/m) - q), and of second order in the step.  */
static void
test_free_decay (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("bluerov2-heavy");
  double m = type.mass + type.hydro.added[BT__SURGE], l = type.hydro.linear[BT__SURGE];
  double q = type.hydro.quadratic[BT__SURGE], v0 = 1.5, t = 2, error[2];
  double expected = l / ((l / v0 + q) * exp (l * t / m) - q);
  for (int k = 0; k < 2; k++)
    {
      bt__rigid body;
      bt__rigid_place (&body, bt__vec (0, 0, -50), 0, 0, 0);
      body.velocity.y = v0;
      bt__rigid_input in = { .h = k ? STEP / 2 : STEP, .density = 1025, .surface = INFINITY };
      run (&type, &body, &in, k ? 240 : 120);
      error[k] = fabs (body.velocity.y - expected);
    }
  assert_close (error[0] / expected, 0, 1e-3, "decay");
  assert_close (error[0] / error[1], 4, 0.2, "order");
}

/* A trimmed hull rolls with 2 pi sqrt (I / (W BG)) for small angles.  */
static void
test_righting_period (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("work-class");
  memset (type.hydro.linear, 0, sizeof type.hydro.linear);
  memset (type.hydro.quadratic, 0, sizeof type.hydro.quadratic);
  type.volume = type.mass / 1025;
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, -50), 0.4, 0, 0.01);
  bt__rigid_input in = { .h = STEP, .density = 1025, .gravity = G, .surface = INFINITY };
  double inertia = type.inertia.x + type.hydro.added[BT__ROLL];
  double period = 2 * BT__PI * sqrt (inertia / (type.mass * G * 0.3)), crossed = 0;
  double before = bt__roll_of (body.attitude), last = 0;
  for (int i = 1, n = 0; n < 20; i++)
    {
      run (&type, &body, &in, 1);
      double now = bt__roll_of (body.attitude);
      if (before > 0 && now <= 0)
        {
          last = (i - 1 + before / (before - now)) * STEP;
          crossed = n++ ? crossed : last;
        }
      before = now;
    }
  assert_close ((last - crossed) / 19 / period, 1, 1e-3, "period");
}

/* A current that is the same everywhere is a frame that moves: drifting with it is rest.  And a
   neutral body goes with water that is accelerated.  */
static void
test_current_and_acceleration (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("bluerov2-heavy");
  bt__rigid body;
  type.volume = type.mass / 1025;
  bt__rigid_place (&body, bt__vec (0, 0, -50), 1, 0, 0);
  bt_vec3 a = bt__vec (0.3, -0.2, 0.1);
  for (int i = 0; i < 600; i++)
    {
      bt_vec3 flow = bt__scale ((i + 0.5) * STEP, a);
      bt__rigid_input in = { .h = STEP,
                             .density = 1025,
                             .gravity = G,
                             .surface = INFINITY,
                             .flow = flow,
                             .flow_acceleration = a };
      run (&type, &body, &in, 1);
    }
  bt_vec3 v = bt__rigid_point_velocity (&body, bt__vec (0, 0, 0));
  assert_close (bt__distance (v, bt__scale (10, a)), 0, 1e-10, "velocity");
  assert_close (bt__distance (body.position, bt__axpy (bt__vec (0, 0, -50), 50, a)), 0, 1e-9,
                "position");
}

/* It floats where its weight is displaced, and settles there.  */
static void
test_floats (void **state)
{
  (void)state;
  bt__vehicle_type type = type_of ("bluerov2-heavy");
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, -2), 0, 0, 0);
  bt__rigid_input in = { .h = STEP, .density = 1025, .gravity = G, .surface = 0.4 };
  run (&type, &body, &in, 6000);
  double wet = type.mass / (1025 * type.volume);
  assert_close (body.position.z, 0.4 + (0.5 - wet) * type.size.z, 1e-4, "height");
}

/* ---- Thrusters ---- */

/* Blue Robotics' charts at 16 V, kgf.  */
static void
test_t200 (void **state)
{
  (void)state;
  static const double chart[][2]
      = { { 1100, -4.07 }, { 1208, -2.58 }, { 1304, -1.40 }, { 1400, -0.48 }, { 1448, -0.13 },
          { 1496, 0 },     { 1544, 0.10 },  { 1592, 0.51 },  { 1640, 1.03 },  { 1688, 1.65 },
          { 1736, 2.38 },  { 1784, 3.17 },  { 1832, 4.06 },  { 1880, 5.01 },  { 1900, 5.25 } };
  bt__thruster t = type_of ("bluerov2-heavy").thruster[0];
  for (size_t i = 0; i < sizeof chart / sizeof *chart; i++)
    assert_close (bt__thruster_force (&t, 16, (chart[i][0] - 1500) / 400) / G, chart[i][1], 0.06,
                  "chart");
  for (double c = -0.059; c < 0.06; c += 0.005)
    assert_true (bt__thruster_force (&t, 16, c) == 0);
  for (double volts = 9; volts < 22; volts += 0.7)
    for (double f = -39; f < 51; f += 0.31)
      {
        double c = bt__thruster_command (&t, volts, f), most = bt__thruster_force (&t, volts, 1);
        double least = bt__thruster_force (&t, volts, -1);
        assert_close (bt__thruster_force (&t, volts, c), fmax (least, fmin (most, f)), 1e-9,
                      "inverse");
      }
}

/* The nearest force that a thruster can give is the force of the command for the wish: with the
   chart, and with a square law.  */
static void
test_nearest (void **state)
{
  (void)state;
  bt__thruster t[2] = { type_of ("bluerov2-heavy").thruster[0] };
  t[1] = (bt__thruster){ .map = BT_MAP_SQUARE, .ahead = 80, .astern = 50 };
  for (int k = 0; k < 2; k++)
    for (double volts = 9; volts < 22; volts += 0.5)
      for (double f = -90; f < 90; f += 0.37)
        assert_close (bt__thruster_nearest (&t[k], volts, f),
                      bt__thruster_force (&t[k], volts, bt__thruster_command (&t[k], volts, f)),
                      1e-9, "nearest");
}

/* First-order lag, exact at the ends of steps: f = F (1 - exp (-t/tau)), and as much impulse.  */
static void
test_lag (void **state)
{
  (void)state;
  bt__vehicle_type type = lump_of (2, bt__vec (1, 1, 1));
  type.n = 1;
  type.thruster[0] = (bt__thruster){ { 0, 0, 0 }, { 0, 1, 0 }, BT_MAP_SQUARE, 50, 50, 0.05, 0.08 };
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, -5), 0, 0, 0);
  bt__rigid_input in = { .h = STEP, .wish = { 20 } };
  run (&type, &body, &in, 12);
  double tau = 0.08, t = 0.2, f = 20 * (1 - exp (-t / tau));
  assert_close (body.thrust[0], f, 1e-10, "force");
  assert_close (2 * body.velocity.y, 20 * (t - tau * (1 - exp (-t / tau))), 1e-10, "impulse");
  in.lost = 1;
  run (&type, &body, &in, 600);
  assert_close (body.thrust[0], 0, 1e-12, "lost");
  in.lost = 0;
  in.wish[0] = 50 * 0.04 * 0.04; /* a command of 0.04, within the dead band */
  run (&type, &body, &in, 600);
  assert_close (body.thrust[0], 0, 1e-12, "dead band");
}

/* What the rig shares out is what was asked, on every axis a type steers, and within limits.  */
static void
test_allocation (void **state)
{
  (void)state;
  for (int i = 0; bt__vehicle_type_name (i); i++)
    {
      bt__vehicle_type type = type_of (bt__vehicle_type_name (i));
      bt__rig rig;
      bt_error error;
      assert_int_equal (bt__rig_make (&type, &rig, &error), BT_OK);
      for (int axis = 0; axis < BT__AXES; axis++)
        {
          double wrench[BT__AXES] = { 0 }, force[BT__THRUSTERS_MAX];
          bt_vec3 sum = { 0, 0, 0 }, moment = { 0, 0, 0 };
          wrench[axis] = 0.4 * rig.most[axis];
          assert_true ((rig.most[axis] > 0) == (type.steers[axis] != 0));
          assert_int_equal (bt__rig_share (&type, &rig, wrench, force), 0);
          for (int k = 0; k < type.n; k++)
            {
              sum = bt__axpy (sum, force[k], type.thruster[k].along);
              moment = bt__axpy (moment, force[k],
                                 bt__cross (type.thruster[k].at, type.thruster[k].along));
            }
          double got[BT__AXES] = { sum.y, sum.x, sum.z, moment.y, moment.x, -moment.z };
          for (int k = 0; k < BT__AXES; k++)
            if (type.steers[k])
              assert_close (got[k], wrench[k], 1e-4 * (1 + rig.most[k]), type.name);
          wrench[axis] = 30 * rig.most[axis] + 1;
          bt__rig_share (&type, &rig, wrench, force);
          for (int k = 0; k < type.n; k++)
            assert_true (force[k] <= type.thruster[k].ahead
                         && force[k] >= -type.thruster[k].astern);
        }
    }
  bt__vehicle_type type = type_of ("falcon");
  bt__rig rig;
  bt_error error;
  type.steers[BT__PITCH] = 1;
  assert_int_equal (bt__rig_make (&type, &rig, &error), BT_ERR_DEF);
}

/* ---- Turns ---- */

static double
turns_by (double step, int n, double pitch, double roll)
{
  double heading = 0.3;
  for (int i = 1; i <= n; i++)
    heading = bt__heading_follow (heading, bt__quat_of (0.3 + i * step, pitch, roll));
  return (heading - 0.3) / (2 * BT__PI);
}

/* +720 and -360 degrees are a turn to starboard, in steps of exactly 90 degrees as in small ones,
   level, pitched and rolled.  */
static void
test_turns (void **state)
{
  (void)state;
  static const double tilts[][2] = { { 0, 0 }, { 0.5, 0 }, { 0, -0.6 }, { -0.7, 0.9 }, { 1.5, 0 } };
  for (size_t i = 0; i < sizeof tilts / sizeof *tilts; i++)
    {
      const double *t = tilts[i];
      double quarter = BT__PI / 2, degree = BT__PI / 180;
      double tilted = turns_by (0, 1, t[0], t[1]); /* what the tilt itself shows as twist */
      assert_close (turns_by (quarter, 8, t[0], t[1]) - tilted, 2, 1e-12, "720");
      assert_close (turns_by (-quarter, 4, t[0], t[1]) - tilted, -1, 1e-12, "-360");
      assert_close (turns_by (degree, 720, t[0], t[1]) - tilted, 2, 1e-12, "720 slowly");
      for (int n = 1; n < 9; n++)
        assert_close (turns_by (quarter, n, t[0], t[1]) - tilted, n / 4.0, 1e-12, "quarters");
    }
}

/* Loops and barrel rolls at any rate are no turns; the vehicle's own motion counts the same.  */
static void
test_turns_survive_loops (void **state)
{
  (void)state;
  for (double step = 0.001; step < 0.5; step *= 3)
    for (int way = 0; way < 2; way++)
      {
        double heading = 0.3;
        for (double a = 0; a <= 8 * BT__PI; a += step)
          heading = bt__heading_follow (heading, way ? bt__quat_of (0.3 + 1e-3, a, 1e-3)
                                                     : bt__quat_of (0.3 - 1e-3, 1e-3, a));
        heading = bt__heading_follow (heading, bt__quat_of (0.3, 0, 0));
        assert_close (heading, 0.3, 1e-12, "loop");
      }
  bt__vehicle_type type = lump_of (1, bt__vec (1, 1, 1));
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, 0), 0.3, 0, 0);
  body.spin.z = -2 * BT__PI / 10;
  bt__rigid_input in = { .h = STEP };
  run (&type, &body, &in, 1200);
  assert_close ((body.heading - 0.3) / (2 * BT__PI), 2, 1e-4, "spun");
}

/* ---- Blows ---- */

/* A ball of no inertia's lever bounces as Newton says; no bounce ever makes energy.  */
static void
test_bounce (void **state)
{
  (void)state;
  bt__vehicle_type type = lump_of (3, bt__vec (0.2, 0.3, 0.4));
  bt__rigid body;
  bt__rigid_place (&body, bt__vec (0, 0, 0), 0, 0, 0);
  body.velocity = bt__vec (1, 0, -2);
  bt__rigid_bounce (&type, &body, bt__vec (0, 0, -0.5), bt__vec (0, 0, 1), 0.5, 0);
  assert_close (body.velocity.z, 1, 1e-12, "restitution");
  assert_close (body.velocity.x, 1, 1e-12, "without friction");
  uint64_t seed = 7;
  for (int i = 0; i < 5000; i++)
    {
      double r[9];
      for (int k = 0; k < 9; k++)
        {
          seed = seed * 6364136223846793005u + 1442695040888963407u;
          r[k] = (double)(seed >> 11) / 4503599627370496.0 - 1;
        }
      bt__rigid_place (&body, bt__vec (0, 0, 0), r[0], r[1], r[2]);
      body.velocity = bt__vec (r[3], r[4], r[5]);
      body.spin = bt__vec (5 * r[6], r[7], r[8]);
      bt_vec3 p = bt__vec (r[8], r[3], r[6]), n = bt__unit_or (bt__vec (r[1], r[5], r[7]), p);
      double before = rigid_energy (&type, &body, bt__vec (0, 0, 0));
      bt__rigid_bounce (&type, &body, p, n, fabs (r[2]), fabs (r[0]));
      assert_true (rigid_energy (&type, &body, bt__vec (0, 0, 0)) <= before * (1 + 1e-12));
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_free_precession),
    cmocka_unit_test (test_precession_rate),
    cmocka_unit_test (test_coriolis_does_no_work),
    cmocka_unit_test (test_bounded),
    cmocka_unit_test (test_rest),
    cmocka_unit_test (test_terminal_speed),
    cmocka_unit_test (test_free_decay),
    cmocka_unit_test (test_righting_period),
    cmocka_unit_test (test_current_and_acceleration),
    cmocka_unit_test (test_floats),
    cmocka_unit_test (test_t200),
    cmocka_unit_test (test_nearest),
    cmocka_unit_test (test_lag),
    cmocka_unit_test (test_allocation),
    cmocka_unit_test (test_turns),
    cmocka_unit_test (test_turns_survive_loops),
    cmocka_unit_test (test_bounce),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
