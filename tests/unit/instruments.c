/* Instruments show the truth, with the noise and the faults they were given, and nothing else; a
   sonar's ranges are those of geometry.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "model/model.h"
#include "vehicle/instruments.h"
#include "vehicle/sonar.h"

#define DEGREE (BT__PI / 180)

static void
assert_close (double value, double expected, double tolerance, const char *what)
{
  if (!(fabs (value - expected) <= tolerance))
    fail_msg ("%s: %.12g is not %.12g within %g", what, value, expected, tolerance);
}

static bt__truth
truth_at (int64_t step)
{
  return (bt__truth){ .step = step,
                      .time = (double)step / 60,
                      .position = { 3, 4, -12 },
                      .velocity = { 0.5, 0, 0.1 },
                      .attitude = bt__quat_of (90 * DEGREE, 0.1, -0.2),
                      .turned = 450 * DEGREE,
                      .turned_from = 90 * DEGREE,
                      .altitude = 7,
                      .ship = { 0, 0, -12 },
                      .tension = 80,
                      .payout = 33 };
}

static void
test_truth (void **state)
{
  (void)state;
  bt__instruments none = { .seed = 1 };
  bt__truth truth = truth_at (600);
  bt_readings r = bt__instruments_read (&none, &truth);
  assert_close (r.heading, bt__twist_of (truth.attitude), 1e-12, "heading");
  assert_close (r.pitch, 0.1, 1e-12, "pitch");
  assert_close (r.roll, -0.2, 1e-12, "roll");
  assert_close (r.turns, 1, 1e-12, "turns");
  assert_close (r.depth, 12, 1e-12, "depth");
  assert_close (r.altitude, 7, 1e-12, "altitude");
  assert_close (r.ahead * r.ahead + r.aside * r.aside + r.up * r.up, 0.26, 1e-12, "speed");
  assert_true (r.ahead > 0.45);
  assert_close (r.range, 5, 1e-12, "range");
  assert_close (r.bearing, atan2 (-3, -4) + 2 * BT__PI, 1e-12, "bearing");
  assert_close (r.tension, 80, 1e-12, "tension");
  assert_close (r.payout, 33, 1e-12, "payout");
}

/* Mean 0, variance 1, fourth moment 3; steps, channels and seeds do not know of each other; the
   same asked again is the same.  */
static void
test_noise (void **state)
{
  (void)state;
  enum
  {
    N = 100000
  };
  double m1 = 0, m2 = 0, m4 = 0, by_step = 0, by_channel = 0, by_seed = 0;
  for (int i = 0; i < N; i++)
    {
      double x = bt__noise (5, i, 2);
      m1 += x / N;
      m2 += x * x / N;
      m4 += x * x * x * x / N;
      by_step += x * bt__noise (5, i + 1, 2) / N;
      by_channel += x * bt__noise (5, i, 3) / N;
      by_seed += x * bt__noise (6, i, 2) / N;
      assert_true (x == bt__noise (5, i, 2));
    }
  double sigma = 1 / sqrt (N);
  assert_close (m1, 0, 4 * sigma, "mean");
  assert_close (m2, 1, 4 * sqrt (2) * sigma, "variance");
  assert_close (m4, 3, 4 * sqrt (96) * sigma, "fourth moment");
  assert_close (by_step, 0, 4 * sigma, "steps");
  assert_close (by_channel, 0, 4 * sigma, "channels");
  assert_close (by_seed, 0, 4 * sigma, "seeds");
}

static void
test_noisy_readings (void **state)
{
  (void)state;
  bt__instruments i = { .seed = 9, .depth_noise = 0.05, .compass_noise = 0.01 };
  double sum = 0, square = 0;
  for (int step = 0; step < 10000; step++)
    {
      bt__truth truth = truth_at (step);
      bt_readings r = bt__instruments_read (&i, &truth), again = bt__instruments_read (&i, &truth);
      assert_memory_equal (&r, &again, sizeof r);
      sum += r.depth - 12;
      square += (r.depth - 12) * (r.depth - 12);
      assert_true (r.tension == 80);
    }
  assert_close (sum / 10000, 0, 0.002, "mean");
  assert_close (sqrt (square / 10000), 0.05, 0.002, "sigma");
}

static void
test_faults (void **state)
{
  (void)state;
  bt__truth truth = truth_at (1200);
  bt__instruments good = { .seed = 1 }, i = good;
  bt_readings fine = bt__instruments_read (&good, &truth);
  i.faults = BT_FAULT_COMPASS | BT_FAULT_TENSION;
  i.drift = 1 * DEGREE;
  i.since = 10;
  bt_readings r = bt__instruments_read (&i, &truth);
  assert_close (r.heading - fine.heading, 10 * DEGREE, 1e-12, "drift");
  assert_close (r.turns - fine.turns, 10.0 / 360, 1e-12, "turns drift");
  assert_true (r.tension == 0 && r.depth == fine.depth);
  i.since = 30;
  assert_close (bt__instruments_read (&i, &truth).heading, fine.heading, 1e-12, "not yet");
  i.faults = BT_FAULT_DEPTH | BT_FAULT_SPEED | BT_FAULT_ALTITUDE;
  i.frozen = 3;
  r = bt__instruments_read (&i, &truth);
  assert_true (r.depth == 3 && isnan (r.ahead) && isnan (r.altitude) && r.heading == fine.heading);
  i.faults = BT_FAULT_TELEMETRY;
  r = bt__instruments_read (&i, &truth);
  assert_true (isnan (r.heading) && isnan (r.depth) && isnan (r.turns));
  assert_true (r.tension == 80 && r.payout == 33 && r.range == fine.range);
}

/* ---- Sonar ---- */

static bt__scene *
scene_of (bt__obstacle o)
{
  bt__scene *scene = NULL;
  bt_error error;
  if (bt__scene_new (&o, 1, 1, &scene, &error) != BT_OK)
    fail_msg ("%s", error.text);
  return scene;
}

static bt__obstacle
mesh_wall (double y)
{
  static bt_vec3 v[4];
  static const uint32_t corner[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
  double x[4] = { -90, 90, 90, -90 }, z[4] = { -90, -90, 90, 90 };
  for (int i = 0; i < 4; i++)
    v[i] = bt__vec (x[i], y, z[i]);
  bt__soup soup = { 4, 2, v, corner, NULL, 0 };
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH };
  bt_error error;
  if (bt__mesh_new (&soup, NULL, NULL, &o.shape.mesh, &error) != BT_OK)
    fail_msg ("%s", error.text);
  return o;
}

/* The head at the origin looks north at a wall of mesh 12 m away: 12 m by the cosine.  And at
   a cylinder of 1 m about (0, 8): by the quadratic.  */
static double
bearing_of (int i, int n, double sector)
{
  return sector * (i / (n - 1.0) - 0.5);
}

static void
test_sonar (void **state)
{
  (void)state;
  bt__sonar sonar
      = { .head = bt__turned (bt__vec (0, 0, 0), 0, 0, 0), .sector = 120 * DEGREE, .range = 50 };
  bt__count count = { 0 };
  double range[BT__BEAMS];
  bt__obstacle pile = { .kind = BT__OBSTACLE_CYLINDER };
  pile.shape.cylinder = (bt__cylinder){ { 0, 8, 0 }, { 0, 0, 1 }, 30, 1 };
  bt__scene *wall = scene_of (mesh_wall (12)), *post = scene_of (pile);
  bt__echoing to_wall = { .scene = wall }, to_post = { .scene = post };
  bt__sonar_sweep (&sonar, &to_wall, BT__BEAMS, range, &count);
  for (int i = 0; i < BT__BEAMS; i++)
    assert_close (range[i], 12 / cos (bearing_of (i, BT__BEAMS, sonar.sector)), 1e-9, "wall");
  bt__sonar_sweep (&sonar, &to_post, BT__BEAMS, range, &count);
  for (int i = 0; i < BT__BEAMS; i++)
    {
      double a = bearing_of (i, BT__BEAMS, sonar.sector), s = 8 * sin (a);
      if (fabs (s) < 1)
        assert_close (range[i], 8 * cos (a) - sqrt (1 - s * s), 1e-9, "pile");
      else
        assert_true (range[i] == INFINITY);
    }
  /* Turned and moved as one, it sees the same; noise is its own.  */
  sonar.head = bt__turned (bt__vec (-8, 8, -3), 90, 0, 0);
  bt__sonar_sweep (&sonar, &to_post, 3, range, &count);
  assert_close (range[1], 7, 1e-9, "moved");
  sonar.noise = 0.01;
  bt__sonar_add_noise (&sonar, 7, 3, range);
  assert_true (range[1] != 7 && fabs (range[1] - 7) < 0.06 && range[0] == INFINITY);
  bt__scene_free (wall);
  bt__scene_free (post);
}

/* A line across the way ahead, 12 m away and in the plane of the beams, is as far in each as the
   edge of the beam that is nearer to ahead: 12 m by the cosine.  One of which only an end reaches
   into a beam is as far as that end. A post before the line hides what is behind it.  */
static void
test_sonar_hears_lines (void **state)
{
  (void)state;
  enum
  {
    N = 61
  };
  double range[N], sector = 120 * DEGREE, width = 1.5 * DEGREE, radius = 0.004;
  bt__sonar sonar = {
    .head = bt__turned (bt__vec (0, 0, 0), 0, 0, 0), .sector = sector, .range = 50, .width = width
  };
  bt__count count = { 0 };
  bt__capsule across = { { -90, 12, 0 }, { 90, 12, 0 }, radius },
              stub = { { 5, 5, 0 }, { 9, 9, 0 }, radius };
  bt__obstacle ball = { .kind = BT__OBSTACLE_SPHERE };
  ball.shape.sphere = (bt__sphere){ .centre = { 0, 8, 0 }, .radius = 1 };
  bt__scene *nothing = NULL;
  assert_int_equal (bt__scene_new (NULL, 0, 1, &nothing, NULL), BT_OK);
  bt__echoing open = { .scene = nothing },
              hidden = { .scene = nothing, .body = &ball, .bodies = 1 };
  bt__sonar_sweep (&sonar, &open, N, range, &count);
  bt__sonar_hear_line (&sonar, &open, &across, N, range, &count);
  for (int i = 0; i < N; i++)
    {
      double a = fmax (0, fabs (bearing_of (i, N, sector)) - width / 2);
      assert_close (range[i], 12 / cos (a) - radius, 1e-9, "line");
    }
  bt__sonar_sweep (&sonar, &open, N, range, &count);
  bt__sonar_hear_line (&sonar, &open, &stub, N, range, &count);
  for (int i = 0; i < N; i++)
    if (fabs (bearing_of (i, N, sector) - 45 * DEGREE) < width / 2)
      assert_close (range[i], sqrt (50) - radius, 1e-9, "end");
    else
      assert_true (range[i] == INFINITY);
  bt__sonar_sweep (&sonar, &hidden, N, range, &count);
  bt__sonar_hear_line (&sonar, &hidden, &across, N, range, &count);
  for (int i = 0; i < N; i++)
    {
      double a = bearing_of (i, N, sector), s = 8 * sin (a);
      double line = 12 / cos (fmax (0, fabs (a) - width / 2)) - radius;
      if (fabs (s) < 1)
        assert_close (range[i], 8 * cos (a) - sqrt (1 - s * s), 1e-9, "ball");
      else if (8 * sin (fabs (a) - width / 2) > 1)
        assert_close (range[i], line, 1e-9, "beside the ball");
    }
  bt__scene_free (nothing);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_truth),          cmocka_unit_test (test_noise),
    cmocka_unit_test (test_noisy_readings), cmocka_unit_test (test_faults),
    cmocka_unit_test (test_sonar),          cmocka_unit_test (test_sonar_hears_lines),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
