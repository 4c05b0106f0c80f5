/* The current is what its kind says at every place and time, and nonsense is refused.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <bight/water.h>

#include "math/vec.h"
#include "model/current.h"

#define DEGREE (BT__PI / 180)

static void
assert_near (bt_vec3 a, bt_vec3 b, double tolerance)
{
  if (!(bt__distance (a, b) <= tolerance))
    fail_msg ("(%.15g %.15g %.15g) is not (%.15g %.15g %.15g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

static bt_water
water_with (const bt_current *current)
{
  return (bt_water){ 1025, 9.81, 100, 0, current, NULL, NULL, NULL };
}

static bt_vec3
at (const bt_current *current, double z)
{
  bt_water water = water_with (current);
  return bt_water_velocity (&water, bt__vec (3, -7, z));
}

static void
test_set_is_toward_the_bearing (void **state)
{
  (void)state;
  assert_near (bt_set_and_drift (0.5, 0), bt__vec (0, 0.5, 0), 1e-16);
  assert_near (bt_set_and_drift (0.5, 90 * DEGREE), bt__vec (0.5, 0, 0), 1e-16);
  assert_near (bt_set_and_drift (2, 225 * DEGREE), bt__vec (-sqrt (2), -sqrt (2), 0), 1e-15);
}

static void
test_still_and_missing (void **state)
{
  (void)state;
  bt_current still = { .kind = BT_CURRENT_STILL, .velocity = { { 1, 2, 3 } } };
  assert_near (at (&still, -5), bt__vec (0, 0, 0), 0);
  assert_near (at (NULL, -5), bt__vec (0, 0, 0), 0);
}

static void
test_uniform (void **state)
{
  (void)state;
  bt_current c = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.3, -0.1, 0.02 } } };
  assert_near (at (&c, 10), c.velocity[0], 0);
  assert_near (at (&c, -1e4), c.velocity[0], 0);
}

static void
fill_profile (bt_current *c, int n, double top, double step)
{
  *c = (bt_current){ .kind = BT_CURRENT_PROFILE, .n = n };
  for (int i = 0; i < n; i++)
    {
      c->z[i] = top + step * i;
      c->velocity[i] = bt__vec (0.1 * i, 0.01 * i * i, 0);
    }
}

/* Linear between rows, exact at rows, constant beyond; downward and upward tables alike.  */
static void
check_profile (double top, double step)
{
  bt_current c;
  fill_profile (&c, BT_PROFILE_MAX, top, step);
  int last = BT_PROFILE_MAX - 1;
  for (int i = 0; i < last; i++)
    {
      assert_near (at (&c, c.z[i]), c.velocity[i], 1e-15);
      bt_vec3 quarter = bt__axpy (bt__scale (0.75, c.velocity[i]), 0.25, c.velocity[i + 1]);
      assert_near (at (&c, 0.75 * c.z[i] + 0.25 * c.z[i + 1]), quarter, 1e-12);
    }
  assert_near (at (&c, c.z[0] - 9 * step), c.velocity[0], 0);
  assert_near (at (&c, c.z[last]), c.velocity[last], 0);
  assert_near (at (&c, c.z[last] + 9 * step), c.velocity[last], 0);
}

static void
test_profile (void **state)
{
  (void)state;
  check_profile (0, -1.7);
  check_profile (-80, 0.9);
  bt_current one;
  fill_profile (&one, 1, -10, 1);
  one.velocity[0] = bt__vec (0.2, 0, 0);
  assert_near (at (&one, -3), one.velocity[0], 0);
  assert_false (bt__is_finite (at (&(bt_current){ .kind = BT_CURRENT_PROFILE,
                                                  .n = 2,
                                                  .z = { 0, -9 },
                                                  .velocity = { { 1, 0, 0 }, { 0, 1, 0 } } },
                                   NAN)));
}

/* current_bvp3d.csv, `turn': constant speed, heading rotated by -(z/p) 90 degrees counter-clockwise
   with p = 100 m; a bearing grows clockwise, so it falls by 0.9 degrees per metre of depth.  */
static void
test_turning (void **state)
{
  (void)state;
  bt_current c
      = { .kind = BT_CURRENT_TURNING, .turn_rate = -0.9 * DEGREE, .velocity = { { 0.5, 0, 0 } } };
  for (double z = 0; z >= -120; z -= 7)
    {
      double angle = -z / 100 * 90 * DEGREE;
      assert_near (at (&c, z), bt__vec (0.5 * cos (angle), 0.5 * sin (angle), 0), 1e-15);
      bt_vec3 by_bearing = bt_set_and_drift (0.5, 90 * DEGREE + c.turn_rate * -z);
      assert_near (at (&c, z), by_bearing, 1e-15);
    }
  for (double toward = 0; toward < 360; toward += 35)
    {
      c.velocity[0] = bt_set_and_drift (0.5, toward * DEGREE);
      bt_vec3 turned = bt_set_and_drift (0.5, toward * DEGREE + c.turn_rate * 40);
      assert_near (at (&c, -40), turned, 1e-15);
    }
}

/* current_bvp3d.csv, `power7': U (1 + z/p)^(1/7).  */
static void
test_power (void **state)
{
  (void)state;
  bt_current c = { .kind = BT_CURRENT_POWER, .exponent = 1.0 / 7, .velocity = { { 0.5, 0.3, 0 } } };
  for (double z = 0; z > -100; z -= 9)
    assert_near (at (&c, z), bt__scale (pow (1 + z / 100, 1.0 / 7), c.velocity[0]), 1e-15);
  assert_near (at (&c, 4), c.velocity[0], 0);
  assert_near (at (&c, -100), bt__vec (0, 0, 0), 0);
  assert_near (at (&c, -130), bt__vec (0, 0, 0), 0);
}

/* In its layers the current is what it is, and between their bounds the shear is its slope.  */
static void
assert_layers (const bt_current *current)
{
  bt_water water = water_with (current);
  assert_true (bt__water_is_layered (&water));
  for (double z = 19.7; z > -95; z -= 0.83)
    {
      double low, high, step = 1e-5;
      bt_vec3 shear, ignored;
      int layer = bt__water_layer_at (&water, z);
      bt__water_layer_bounds (&water, layer, &low, &high);
      assert_true (low <= z && z <= high);
      assert_near (bt__water_in_layer (&water, layer, z, &shear), at (current, z), 1e-13);
      bt_vec3 above = bt__water_in_layer (&water, layer, z + step, &ignored);
      bt_vec3 below = bt__water_in_layer (&water, layer, z - step, &ignored);
      assert_near (bt__scale (0.5 / step, bt__sub (above, below)), shear, 1e-8);
      if (isfinite (high))
        assert_int_equal (bt__water_next_layer (&water, layer, 1),
                          bt__water_layer_at (&water, high + 1e-9));
      if (isfinite (low))
        assert_int_equal (bt__water_next_layer (&water, layer, 0),
                          bt__water_layer_at (&water, low - 1e-9));
    }
}

static void
test_layers (void **state)
{
  (void)state;
  bt_current falling = { .kind = BT_CURRENT_PROFILE, .n = 4, .z = { 0, -20, -30, -70 } };
  bt_current rising = { .kind = BT_CURRENT_PROFILE, .n = 3, .z = { -60, -10, 2 } };
  bt_current power = { .kind = BT_CURRENT_POWER, .exponent = 0.6 };
  bt_current turning = { .kind = BT_CURRENT_TURNING, .turn_rate = 0.03 };
  bt_current one_row = { .kind = BT_CURRENT_PROFILE, .n = 1, .z = { -20 } };
  bt_current *all[] = { &falling, &rising, &power, &turning, &one_row };
  for (size_t k = 0; k < sizeof all / sizeof *all; k++)
    {
      for (int i = 0; i < 4; i++)
        all[k]->velocity[i] = bt__vec (0.5 - 0.3 * i, 0.1 + 0.2 * i, 0);
      assert_layers (all[k]);
    }
}

static void
test_tide (void **state)
{
  (void)state;
  bt_current c = { .kind = BT_CURRENT_TIDE, .period = 44712, .velocity = { { 0, 0.6, 0 } } };
  bt_water water = water_with (&c);
  const double share[] = { 1, 0, -1, 0, 1 };
  for (int i = 0; i < 5; i++)
    {
      water.time = c.period * i / 4;
      assert_near (bt_water_velocity (&water, bt__vec (0, 0, 0)), bt__vec (0, 0.6 * share[i], 0),
                   1e-15);
    }
}

static void
swirl (void *user, bt_vec3 p, double t, bt_vec3 *v)
{
  *v = bt__scale (*(double *)user * t, bt__vec (-p.y, p.x, 0));
}

static void
test_function (void **state)
{
  (void)state;
  double rate = 0.5;
  bt_current c = { .kind = BT_CURRENT_FUNCTION };
  bt_water water = { 1025, 9.81, 100, 2, &c, swirl, &rate, NULL };
  assert_near (bt_water_velocity (&water, bt__vec (3, 4, 0)), bt__vec (-4, 3, 0), 0);
  water.function = NULL;
  assert_near (bt_water_velocity (&water, bt__vec (3, 4, 0)), bt__vec (0, 0, 0), 0);
}

static void
ninth_power (void *user, bt_vec3 p, double t, bt_vec3 *v)
{
  (void)user;
  (void)t;
  *v = bt__vec (pow (p.z, 9), 0, 0);
}

/* Five Gauss points are exact to the ninth power.  */
static void
test_mean (void **state)
{
  (void)state;
  bt_current c = { .kind = BT_CURRENT_FUNCTION };
  bt_water water = { 1025, 9.81, 100, 0, &c, ninth_power, NULL, NULL };
  bt_vec3 mean = bt_water_mean_velocity (&water, bt__vec (1, 2, 0), bt__vec (5, -3, -2));
  assert_near (mean, bt__vec (-51.2, 0, 0), 1e-12);
  bt_current uniform = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.3, 0.1, 0 } } };
  water.current = &uniform;
  assert_near (bt_water_mean_velocity (&water, bt__vec (1, 2, 0), bt__vec (5, -3, -2)),
               uniform.velocity[0], 0);
}

static void
test_unsteady (void **state)
{
  (void)state;
  for (int kind = BT_CURRENT_STILL; kind <= BT_CURRENT_FUNCTION; kind++)
    assert_int_equal (bt_current_is_unsteady (&(bt_current){ .kind = kind }),
                      kind == BT_CURRENT_TIDE || kind == BT_CURRENT_FUNCTION);
}

static void
assert_refused (const bt_current *c)
{
  bt_error error = { BT_OK, "" };
  assert_int_equal (bt_current_check (c, &error), BT_ERR_DOMAIN);
  assert_int_equal (error.status, BT_ERR_DOMAIN);
  assert_true (strlen (error.text) > 10);
  assert_int_equal (bt_current_check (c, NULL), BT_ERR_DOMAIN);
}

static void
test_good_currents_pass (void **state)
{
  (void)state;
  bt_current c;
  fill_profile (&c, 20, 0, -3);
  assert_int_equal (bt_current_check (&c, NULL), BT_OK);
  fill_profile (&c, 20, -60, 3);
  assert_int_equal (bt_current_check (&c, NULL), BT_OK);
  c = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { { 20, 0, 0 } } };
  assert_int_equal (bt_current_check (&c, NULL), BT_OK);
  c = (bt_current){ .kind = BT_CURRENT_TIDE, .period = 1, .velocity = { { 1, 0, 0 } } };
  assert_int_equal (bt_current_check (&c, NULL), BT_OK);
  c = (bt_current){ .kind = BT_CURRENT_POWER, .exponent = 0 };
  assert_int_equal (bt_current_check (&c, NULL), BT_OK);
  c = (bt_current){ .kind = BT_CURRENT_TURNING, .turn_rate = -1 };
  assert_int_equal (bt_current_check (&c, NULL), BT_OK);
}

static void
test_bad_numbers_are_refused (void **state)
{
  (void)state;
  const double bad[] = { NAN, INFINITY, -INFINITY, 20.001 };
  const int kinds[] = { BT_CURRENT_UNIFORM, BT_CURRENT_TURNING, BT_CURRENT_POWER, BT_CURRENT_TIDE,
                        BT_CURRENT_PROFILE };
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 5; k++)
      assert_refused (
          &(bt_current){ .kind = kinds[k], .n = 1, .period = 1, .velocity = { { 0, bad[i], 0 } } });
  for (int i = 0; i < 3; i++)
    {
      assert_refused (&(bt_current){ .kind = BT_CURRENT_TURNING, .turn_rate = bad[i] });
      assert_refused (&(bt_current){ .kind = BT_CURRENT_POWER, .exponent = bad[i] });
      assert_refused (&(bt_current){ .kind = BT_CURRENT_TIDE, .period = bad[i] });
      assert_refused (&(bt_current){ .kind = BT_CURRENT_PROFILE, .n = 2, .z = { 0, bad[i] } });
    }
  assert_refused (&(bt_current){ .kind = BT_CURRENT_POWER, .exponent = -0.5 });
  assert_refused (&(bt_current){ .kind = BT_CURRENT_TIDE, .period = 0 });
  assert_refused (&(bt_current){ .kind = 99 });
  assert_refused (&(bt_current){ .kind = -1 });
}

static void
test_disorder_is_refused (void **state)
{
  (void)state;
  bt_current c;
  fill_profile (&c, 5, 0, -2);
  c.z[3] = c.z[2];
  assert_refused (&c);
  c.z[3] = c.z[1];
  assert_refused (&c);
  fill_profile (&c, 5, 0, -2);
  c.n = 0;
  assert_refused (&c);
  c.n = BT_PROFILE_MAX + 1;
  assert_refused (&c);
  c.n = INT64_MIN;
  assert_refused (&c);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_set_is_toward_the_bearing),
    cmocka_unit_test (test_still_and_missing),
    cmocka_unit_test (test_uniform),
    cmocka_unit_test (test_profile),
    cmocka_unit_test (test_turning),
    cmocka_unit_test (test_power),
    cmocka_unit_test (test_layers),
    cmocka_unit_test (test_tide),
    cmocka_unit_test (test_function),
    cmocka_unit_test (test_mean),
    cmocka_unit_test (test_unsteady),
    cmocka_unit_test (test_good_currents_pass),
    cmocka_unit_test (test_bad_numbers_are_refused),
    cmocka_unit_test (test_disorder_is_refused),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
