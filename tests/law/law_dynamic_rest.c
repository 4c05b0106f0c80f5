/* The moving line brought to rest: against closed solutions and the static solvers.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"
#include "tether/smooth.h"

#include <bight/statics.h>

/* ---- The elastica: EI, a clamp, a free end ---- */

/* A horizontal cantilever of unit length and EI with N intervals, under the tip load P and the
   weight W, at rest.  *X, *Z its tip.  */
static void
cantilever (int n, double p, double w, double *x, double *z)
{
  scene s;
  bt_vec3 shape[2] = { { 0, 0, 0 }, { 1, 0, 0 } };
  bt_tether_props line = { .diameter = 0.01, .mass = 1, .wet_weight = w, .ea = 1e7, .ei = 1 };
  scene_open (&s, line, 0, n, shape, 2, 1);
  s.in.end[0].clamped = 1;
  s.in.end[0].direction = bt__vec (1, 0, 0);
  s.in.end[1].free = 1;
  s.in.end[1].body.force = bt__vec (0, 0, -p);
  scene_settle (&s);
  bt_vec3 tip = bt__dynamic_x (s.d)[n];
  *x = tip.x;
  *z = tip.z;
  scene_close (&s);
}

/* elastica_tip_load.csv (Bisshopp & Drucker 1945): q = P L^2 / EI, K(p) - F(p, phi1) = sqrt q,
   x/L = sqrt (2 sin theta) / sqrt q, v/L = 1 - 2 (E(p) - E(p, phi1)) / sqrt q.  Exact.
   elastica_heavy_cantilever.csv: q = w L^3 / EI, EI th'' = -w (L - s) cos th; to 1e-11.  */
static const struct
{
  double q, x, v;
} tip_loads[] = { { 0.2, 0.9973534516595, 0.06636448214483 },
                  { 1, 0.9435667637166, 0.3017207737998 },
                  { 3, 0.7455798154358, 0.6032534411300 },
                  { 10, 0.4450044022462, 0.8106090248803 },
                  { 50, 0.1999996039504, 0.9171554473036 } },
  weights[] = { { 0.1, 0.9999107322241, 0.01249843784817 },
                { 1, 0.9912463953466, 0.1234714019834 },
                { 5, 0.8466571799543, 0.4959050446224 },
                { 20, 0.4452320522396, 0.8298814434393 },
                { 100, 0.1592233826284, 0.9375239353963 } };

static void
check_cantilever (double q, double wanted_x, double wanted_v, int weight)
{
  double x, z, miss[2];
  for (int k = 0; k < 2; k++)
    {
      cantilever (k ? 80 : 40, weight ? 0 : q, weight ? q : 0, &x, &z);
      miss[k] = hypot (x - wanted_x, -z - wanted_v);
    }
  if (!(miss[1] < 2e-3) || !(miss[1] < 0.3 * miss[0] + 2e-6))
    fail_msg ("%s %g: the tip is off by %g with 40 and %g with 80 intervals",
              weight ? "weight" : "tip load", q, miss[0], miss[1]);
}

static void
test_elastica (void **state)
{
  (void)state;
  for (int k = 0; k < 5; k++)
    {
      check_cantilever (tip_loads[k].q, tip_loads[k].x, tip_loads[k].v, 0);
      check_cantilever (weights[k].q, weights[k].x, weights[k].v, 1);
    }
}

/* ---- Towing: the critical angle ---- */

/* tow_critical_angle.csv: D sin^2 phi = w cos phi, cos phi = (-k + sqrt (k^2 + 4)) / 2, k = w / D,
   D = rho/2 Cd d U^2, rho 1025; whatever the tangential drag.  */
static const struct
{
  double w, d, cd, u, degrees;
} tows[] = { { 0.4, 0.0035, 1.2, 0.3, 66.11458260413 },
             { 0.4, 0.0035, 1.2, 0.6, 39.22465236943 },
             { 1, 0.01, 1.2, 1, 22.77995694378 },
             { 20, 0.025, 1.5, 5, 11.64882072019 },
             { 0.05, 0.0076, 1.2, 0.5, 11.80938062361 } };

static void
test_tow_angle (void **state)
{
  (void)state;
  for (int k = 0; k < 5; k++)
    {
      scene s;
      const int n = 20;
      bt_vec3 shape[2] = { { 0, 0, 0 }, { 60, 0, -80 } };
      bt_tether_props line = { .diameter = tows[k].d,
                               .mass = 1.5e3 * tows[k].d * tows[k].d,
                               .wet_weight = tows[k].w,
                               .ea = 1e6,
                               .cdn = tows[k].cd,
                               .cdt = 0.01,
                               .ca = 1 };
      scene_open (&s, line, 1025, n, shape, 2, 100);
      scene_current (&s, bt__vec (tows[k].u, 0, 0));
      s.in.end[1].free = 1;
      for (int i = 0; i < 4000; i++)
        scene_step (&s, 0.5);
      const bt_vec3 *x = bt__dynamic_x (s.d);
      for (int j = 0; j < n; j++)
        {
          bt_vec3 c = bt__sub (x[j + 1], x[j]);
          assert_close (atan2 (-c.z, c.x) * 180 / BT__PI, tows[k].degrees, 2e-3, "towing angle");
        }
      scene_close (&s);
    }
}

/* ---- The catenary with stretch ---- */

/* catenary_elastic.csv, first row (Irvine 1981): L0 100, h 80, level, w 1, EA 1000: H
   29.97089880736, T at the ends 58.29455184939, middle at z -29.57365304203.  */
static void
test_elastic_catenary (void **state)
{
  (void)state;
  double miss[3][2];
  for (int k = 0; k < 3; k++)
    {
      scene s;
      int n = 25 << k;
      bt_vec3 shape[3] = { { 0, 0, 0 }, { 40, 0, -25 }, { 80, 0, 0 } };
      bt_tether_props line
          = { .diameter = 0.01, .mass = 0.1, .wet_weight = 1, .ea = 1000, .cdn = 1.2 };
      scene_open (&s, line, 1025, n, shape, 3, 100);
      scene_settle (&s);
      bt_vec3 middle = bt__dynamic_point (s.d, 50);
      miss[k][0] = fabs (middle.z + 29.57365304203);
      miss[k][1] = fabs (bt__dynamic_node_tension (s.d, 0) - 58.29455184939);
      assert_close (middle.x, 40, 1e-6, "middle");
      scene_close (&s);
    }
  for (int q = 0; q < 2; q++)
    for (int k = 0; k < 2; k++)
      assert_close (log2 (miss[k][q] / miss[k + 1][q]), 2, 0.1, q ? "order of T" : "order of z");
  assert_true (miss[2][0] < 5e-3 && miss[2][1] < 5e-3);
}

/* ---- The same rest as the static solver's ---- */

static const struct
{
  double w, u, length;
  bt_vec3 b;
} rests[] = { { 0.1, 0.25, 40, { 0, 20, -15 } },
              { 0.1, 0.5, 40, { 0, 20, -15 } },
              { 0, 0.5, 40, { -10, 20, 0 } },
              { -0.05, 0.25, 40, { 0, 20, -15 } } };

/* Distance and relative difference in tension to bt_steady_shoot.  */
static void
against_steady (int k, int n, double miss[2])
{
  static bt_vec3 r[RIG_MAX + 1], t[RIG_MAX + 1];
  scene s;
  bt_tether_props p = { .diameter = 0.0076,
                        .mass = 0.06,
                        .wet_weight = rests[k].w,
                        .ea = 2e5,
                        .cdn = 1.2,
                        .cdt = 0.01,
                        .ca = 1 };
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 5, 10, -10 }, rests[k].b };
  bt_line line = { rests[k].length, p.diameter, p.wet_weight, p.ea, p.cdn, p.cdt };
  bt_steady *steady = bt_steady_new (400);
  bt_steady_report report;
  bt_vec3 pull;
  scene_open (&s, p, 1025, n, shape, 3, line.length);
  scene_current (&s, bt__vec (rests[k].u, 0, 0));
  scene_settle (&s);
  assert_int_equal (bt_steady_shoot (steady, &line, &s.water, shape[0], shape[2], 400, 0, &pull, r,
                                     t, &report, NULL),
                    BT_OK);
  assert_true (report.converged);
  miss[0] = miss[1] = 0;
  for (int i = 0; i <= n; i++)
    {
      int at = i * (400 / n);
      miss[0] = fmax (miss[0], bt__distance (bt__dynamic_x (s.d)[i], r[at]));
      miss[1] = fmax (miss[1], fabs (bt__dynamic_node_tension (s.d, i) / bt__norm (t[at]) - 1));
    }
  scene_close (&s);
  bt_steady_free (steady);
}

static void
test_rest_is_steady (void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      double coarse[2], fine[2];
      against_steady (k, 50, coarse);
      against_steady (k, 100, fine);
      for (int q = 0; q < 2; q++)
        if (!(fine[q] < 3e-3) || fabs (log2 (coarse[q] / fine[q]) - 2) > 0.25)
          fail_msg ("rest %d: %s off by %g with 50 and %g with 100 intervals", k,
                    q ? "tension" : "shape", coarse[q], fine[q]);
    }
}

/* A neutral line without tangential drag has the same tension everywhere, the
   shape of a catenary with A = 4.7172 m that does not depend on the current.  */
static void
test_neutral_line (void **state)
{
  (void)state;
  static const double tensions[] = { 1.378, 5.512, 22.05 };
  for (int k = 0; k < 3; k++)
    {
      scene s;
      const int n = 100;
      double u = 0.25 * (1 << k);
      bt_vec3 shape[3] = { { 0, 0, 0 }, { 8, 10, 0 }, { -10, 20, 0 } };
      bt_tether_props p = { .diameter = 0.0076, .mass = 0.0465, .ea = 2e5, .cdn = 1.2, .ca = 1 };
      scene_open (&s, p, 1025, n, shape, 3, 40);
      scene_current (&s, bt__vec (u, 0, 0));
      scene_settle (&s);
      double downstream = 0;
      for (int i = 0; i <= n; i++)
        {
          assert_close (bt__dynamic_node_tension (s.d, i), tensions[k], 0.005 * tensions[k], "T");
          downstream = fmax (downstream, bt__dynamic_x (s.d)[i].x);
        }
      assert_close (downstream, 10.868, 0.005, "downstream");
      scene_close (&s);
    }
}

/* ---- A point load ---- */

/* michalos_birnstiel.csv (Michalos & Birnstiel 1962, two exact catenaries): span 1000 ft, lengths
   412.8837 and 613.0422 ft, EA 16150 kip, w 3.16 lb/ft; loaded with 8 kip at the joint.  */
static void
test_point_load (void **state)
{
  (void)state;
  const double ft = 0.3048, lb = 4.4482216152605;
  scene s;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 400 * ft, 0, -100 * ft }, { 1000 * ft, 0, 0 } };
  bt_tether_props line
      = { .diameter = 0.026, .mass = 4.7, .wet_weight = 3.16 * lb / ft, .ea = 16150e3 * lb };
  bt__dynamic_lump load = { .from_end = 613.0422 * ft, .wet_weight = 8000 * lb };
  scene_open (&s, line, 0, 400, shape, 3, (412.8837 + 613.0422) * ft);
  s.in.lumps = &load;
  s.in.n_lumps = 1;
  scene_settle (&s);
  bt_vec3 p = bt__dynamic_point (s.d, 412.8837 * ft);
  assert_close (p.x / ft, 397.1804614140, 0.05, "joint, across");
  assert_close (p.z / ft, -114.5062248428, 0.05, "joint, down");
  scene_close (&s);
}

/* The estimate of the error in space is a fixed share of the error.  */
static void
test_error_estimate (void **state)
{
  (void)state;
  for (int n = 10; n <= 80; n *= 2)
    {
      scene s;
      bt_catenary c;
      bt_vec3 shape[3] = { { 0, 0, 0 }, { 40, 0, -25 }, { 80, 0, 0 } };
      bt_tether_props line = { .diameter = 0.01, .mass = 0.1, .wet_weight = 1, .ea = 1e8 };
      double worst = 0;
      scene_open (&s, line, 0, n, shape, 3, 100);
      scene_settle (&s);
      assert_int_equal (bt_catenary_solve (80, 0, 100, &c, NULL), BT_OK);
      for (int i = 0; i <= n; i++)
        {
          bt_point2 p = bt_catenary_point (&c, 100.0 * i / n);
          worst = fmax (worst, bt__distance (bt__dynamic_x (s.d)[i], bt__vec (p.x, 0, p.y)));
        }
      double share = bt__dynamic_space_error (s.d, NULL) / worst;
      if (!(share > 0.4 && share < 1.3))
        fail_msg ("%d intervals: the estimate is %g of the error %g", n, share, worst);
      scene_close (&s);
    }
}

/* Between nodes a line is read off a cubic nowhere longer than it is by more than 2 %, be its nodes
   as uneven or slack as can be; and a cubic that is no longer anyway is left as it is.  */
static void
test_smooth_is_no_longer (void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int k = 0; k < 20000; k++)
    {
      double r[9], most = 0;
      for (int i = 0; i < 9; i++)
        {
          seed = seed * 6364136223846793005u + 1442695040888963407u;
          r[i] = (double)(seed >> 11) / 4503599627370496.0 - 1; /* -1 to 1 */
        }
      double fast = k % 3 ? 2 : 0.01;
      bt_vec3 chord = { r[0], r[1], r[2] }, a = bt__scale (fast, bt__vec (r[3], r[4], r[5])),
              b = bt__scale (fast, bt__vec (r[6], r[7], r[8]));
      double rest = bt__norm (chord) * (k % 2 ? 1 : 1.6),
             share = bt__smooth_share (chord, a, b, rest);
      for (int i = 0; i <= 200; i++)
        {
          double f = i / 200.0;
          bt_vec3 off = bt__axpy (bt__scale (1 - 4 * f + 3 * f * f, a), 3 * f * f - 2 * f, b);
          most = fmax (most, bt__norm (bt__axpy (chord, share, off)) / rest);
        }
      assert_true (share > 0 && share <= 1 && most < 1.02);
      assert_true (share == 1 || most > 1 - 1e-9);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_elastica),         cmocka_unit_test (test_tow_angle),
    cmocka_unit_test (test_elastic_catenary), cmocka_unit_test (test_rest_is_steady),
    cmocka_unit_test (test_neutral_line),     cmocka_unit_test (test_error_estimate),
    cmocka_unit_test (test_point_load),       cmocka_unit_test (test_smooth_is_no_longer),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
