/* Laws of a moving line at the surface: it floats, hangs in air by its weight there, and takes no
   notice of a surface that it is not near to.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/sea.h>
#include <bight/statics.h>

#include "dynamic_scene.h"

#define G 9.81
#define LAYER 0.1

static const bt_tether_props floating = { .diameter = 0.01,
                                          .mass = 0.04,
                                          .wet_weight = -0.3,
                                          .ea = 2e4,
                                          .ba = 20,
                                          .cdn = 1.2,
                                          .cdt = 0.01,
                                          .ca = 1 };

static double
highest (const scene *s)
{
  double most = -HUGE_VAL;
  for (int i = 0; i <= s->d->n; i++)
    most = fmax (most, bt__dynamic_x (s->d)[i].z);
  return most;
}

static void
wait (scene *s, double seconds)
{
  for (double end = s->water.time + seconds; s->water.time < end - 1e-9;)
    scene_step (s, 1.0 / 60);
}

/* A slack line let go in an arch above the water comes down and floats where buoyancy is its weight
   in air: 1 - u^2 (3 - 2 u) = m g / (m g - w).  Without its surface it stays up there.  */
static void
test_floats (void **state)
{
  (void)state;
  double sunk = 0.04 * G / (0.04 * G + 0.3), low = 0, high = 1;
  for (int i = 0; i < 60; i++)
    {
      double u = (low + high) / 2;
      *(1 - u * u * (3 - 2 * u) > sunk ? &low : &high) = u;
    }
  for (int surfaced = 0; surfaced < 2; surfaced++)
    {
      scene s;
      bt_vec3 shape[3] = { { 0, 0, -0.5 }, { 5, 0, 3 }, { 10, 0, -0.5 } };
      scene_open (&s, floating, 1025, 60, shape, 3, 12);
      s.in.surfaced = surfaced;
      s.in.tolerance = 0;
      wait (&s, 120);
      bt_vec3 middle = bt__dynamic_x (s.d)[30];
      if (surfaced)
        {
          assert_close (middle.z, low * LAYER, 1e-4, "where a line floats");
          assert_true (highest (&s) < LAYER);
        }
      else
        assert_true (middle.z > 1);
      assert_true (s.unconverged < 0.02 * s.steps);
      scene_close (&s);
    }
}

/* In air it hangs in the catenary of its weight there.  */
static void
test_hangs_in_air (void **state)
{
  (void)state;
  scene s;
  bt_elastic e;
  bt_vec3 shape[3] = { { 0, 0, 20 }, { 5, 0, 17 }, { 10, 0, 20 } };
  scene_open (&s, floating, 1025, 100, shape, 3, 12);
  s.in.surfaced = 1;
  scene_settle (&s);
  assert_int_equal (bt_elastic_solve (10, 0, 12, 0.04 * G, 2e4, &e, NULL), BT_OK);
  bt_point2 p = bt_elastic_point (&e, 6);
  assert_close (bt__dynamic_point (s.d, 6).z, 20 + p.y, 2e-3, "sag in air");
  assert_close (bt__norm (s.d->pull[0]), bt_elastic_tension (&e, 0), 2e-3, "tension in air");
  scene_close (&s);
}

/* Hung from above into the water its top bears its weight in air and in water.  */
static void
test_hangs_into_water (void **state)
{
  (void)state;
  scene s;
  bt_vec3 shape[2] = { { 0, 0, 5 }, { 0, 0, -7 } };
  bt_tether_props line = floating;
  line.mass = 0.2;
  line.wet_weight = 1;
  scene_open (&s, line, 1025, 240, shape, 2, 12);
  s.in.surfaced = 1;
  s.in.end[1].free = 1;
  scene_settle (&s);
  double dry = 5 - LAYER / 2;
  assert_close (bt__norm (s.d->pull[0]), dry * 0.2 * G + (12 - dry) * 1, 0.01,
                "tension at the top");
  scene_close (&s);
}

/* The weight of a heavy line that hangs through the surface, as it is lifted over N intervals.  It
   is that in water and the buoyancy of what is in the air: linear, whatever the nodes.  By whole
   nodes it rose in steps of the buoyancy of an interval.  */
static void
check_lifted (int n)
{
  scene s;
  const double length = 100;
  bt_vec3 shape[2] = { { 0, 0, 5 }, { 0, 0, 5 - length } };
  bt_tether_props line = floating;
  line.diameter = 0.03;
  line.mass = 4;
  line.wet_weight = 30;
  line.ea = 1e8;
  double lift = line.mass * G - line.wet_weight, interval = length / n;
  scene_open (&s, line, 1025, n, shape, 2, length);
  s.in.surfaced = 1;
  s.in.end[1].free = 1;
  for (int k = 0; k < 9; k++)
    {
      double top = 5 + 0.3 * k * interval;
      s.in.end[0].at.z = top;
      scene_settle (&s);
      double weight = 30 * length + lift * (top - LAYER / 2);
      assert_close (bt__norm (s.d->pull[0]), weight, 1e-5 * weight, "the weight of a lifted line");
    }
  scene_close (&s);
}

static void
test_lifted (void **state)
{
  (void)state;
  check_lifted (40);
  check_lifted (320);
}

/* In waves the surface over a line that hangs through it rises and falls; what it bears follows. */
static void
test_pierces_waves (void **state)
{
  (void)state;
  scene s;
  bt_waves waves;
  bt_wave_def def = { .kind = BT_WAVE_AIRY, .height = 2, .period = 9 };
  bt_vec3 shape[2] = { { 0, 0, 5 }, { 0, 0, -35 } };
  bt_tether_props line = floating;
  line.mass = 4;
  line.wet_weight = 30;
  line.ea = 1e8;
  line.cdn = line.cdt = line.ca = 0;
  line.diameter = 1e-4; /* no push of the waves */
  assert_int_equal (bt_waves_make (&def, 60, G, &waves, NULL), BT_OK);
  bt_sea sea = { .waves = &waves };
  scene_open (&s, line, 1025, 16, shape, 2, 40);
  s.in.surfaced = 1;
  s.in.end[1].free = 1;
  scene_settle (&s);
  s.water.sea = &sea;
  wait (&s, 2);
  for (int k = 0; k < 540; k++)
    {
      scene_step (&s, 1.0 / 60);
      double dry = 5 - bt_water_surface (&s.water, shape[0]) - LAYER / 2;
      double weight = 30 * 40 + (line.mass * G - 30) * dry;
      assert_close (bt__norm (s.d->pull[0]), weight, 2e-4 * weight, "what waves leave to be borne");
    }
  scene_close (&s);
}

/* In air nothing drags: a line let go falls as a stone does, until it meets the water.  */
static void
test_falls_in_air (void **state)
{
  (void)state;
  scene s;
  bt_vec3 shape[2] = { { 0, 0, 3 }, { 5, 0, 3 } };
  scene_open (&s, floating, 1025, 20, shape, 2, 5);
  s.in.surfaced = 1;
  s.in.end[0].free = s.in.end[1].free = 1;
  for (int i = 0; i < 500; i++)
    scene_step (&s, 1e-3);
  assert_close (bt__dynamic_x (s.d)[10].z, 3 - 0.5 * G * 0.25, 5e-3, "fallen in half a second");
  wait (&s, 20);
  assert_close (bt__dynamic_x (s.d)[10].z, LAYER / 2, LAYER / 2, "then it floats");
  scene_close (&s);
}

/* Without drag and added mass the energies, that of what is out of the water among them, only ever
   fall: the force is the gradient of its potential.  */
static void
test_energy (void **state)
{
  (void)state;
  scene s;
  bt_vec3 shape[2] = { { 0, 0, -1 }, { 5, 0, -1 } };
  bt_tether_props line = floating;
  line.cdn = line.cdt = line.ca = 0;
  scene_open (&s, line, 1025, 20, shape, 2, 5);
  s.in.surfaced = 1;
  s.in.end[0].free = s.in.end[1].free = 1;
  double start = scene_energy (&s), top = -1;
  for (int i = 0; i < 4000; i++)
    {
      scene_step (&s, 1e-3);
      top = fmax (top, bt__dynamic_x (s.d)[10].z);
      assert_true (scene_energy (&s) < start + 1e-3);
    }
  /* It leaps until weight in air has undone what 0.3 N/m did over a metre and half the layer.  */
  double lift = 0.04 * G + 0.3;
  assert_close (top, (0.3 + lift * LAYER / 2) / (0.04 * G), 0.03, "how far it leaps");
  assert_close (scene_energy (&s), start, 0.05 * fabs (start), "energy after two leaps");
  scene_close (&s);
}

/* A float on a line that sinks holds it up, and stays in the water.  */
static void
test_float (void **state)
{
  (void)state;
  scene s;
  bt_vec3 shape[3] = { { 0, 0, -2 }, { 5, 0, 1 }, { 10, 0, -2 } };
  bt_tether_props line = floating;
  line.mass = 0.1;
  line.wet_weight = 0.1;
  bt__dynamic_lump buoy = { .from_end = 6, .mass = 0.5, .wet_weight = -8 };
  scene_open (&s, line, 1025, 60, shape, 3, 12);
  s.in.surfaced = 1;
  s.in.tolerance = 0;
  s.in.lumps = &buoy;
  s.in.n_lumps = 1;
  wait (&s, 60);
  assert_close (bt__dynamic_x (s.d)[30].z, 0, LAYER, "the float");
  assert_true (bt__dynamic_x (s.d)[15].z < -0.2);
  scene_close (&s);
}

/* It rides long waves.  */
static void
test_rides_waves (void **state)
{
  (void)state;
  scene s;
  bt_waves waves;
  bt_wave_def def = { .kind = BT_WAVE_AIRY, .height = 1, .period = 8, .toward = BT__PI / 2 };
  bt_vec3 shape[2] = { { 0, 0, 0 }, { 5, 0, 0 } };
  assert_int_equal (bt_waves_make (&def, 50, G, &waves, NULL), BT_OK);
  bt_sea sea = { .waves = &waves };
  scene_open (&s, floating, 1025, 20, shape, 2, 5);
  s.water.sea = &sea;
  s.in.surfaced = 1;
  s.in.tolerance = 0;
  s.in.end[0].free = s.in.end[1].free = 1;
  wait (&s, 5);
  for (int i = 0; i < 960; i++)
    {
      scene_step (&s, 1.0 / 60);
      bt_vec3 x = bt__dynamic_x (s.d)[10];
      assert_close (x.z, bt_water_surface (&s.water, x), LAYER, "riding a wave");
    }
  scene_close (&s);
}

/* What is deep is stepped to the same bit with a surface and without.  */
static void
test_deep (void **state)
{
  (void)state;
  scene s[2];
  for (int k = 0; k < 2; k++)
    {
      scene_open_flight (&s[k], 40);
      s[k].in.surfaced = k;
      for (int i = 1; i < 120; i++)
        {
          s[k].in.end[1].at = flight_at (i / 60.0);
          scene_step (&s[k], 1.0 / 60);
        }
    }
  assert_memory_equal (s[0].d, s[1].d, bt__dynamic_size (RIG_MAX));
  scene_close (&s[0]);
  scene_close (&s[1]);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_floats),           cmocka_unit_test (test_hangs_in_air),
    cmocka_unit_test (test_hangs_into_water), cmocka_unit_test (test_falls_in_air),
    cmocka_unit_test (test_energy),           cmocka_unit_test (test_float),
    cmocka_unit_test (test_lifted),           cmocka_unit_test (test_pierces_waves),
    cmocka_unit_test (test_rides_waves),      cmocka_unit_test (test_deep),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
