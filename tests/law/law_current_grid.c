/* A current from a table is linear between its points, and a pile leaves a lee.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <fenv.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/water.h>

#include "math/vec.h"

static void
assert_close (double value, double expected, double tolerance, const char *what)
{
  if (!(fabs (value - expected) <= tolerance))
    fail_msg ("%s: %.12g is not %.12g within %g", what, value, expected, tolerance);
}

/* ---- The grid ---- */

/* Linear in each coordinate by itself: what interpolation between points keeps exactly.  */
static bt_vec3
field (const double *p)
{
  double x = p[0], y = p[1], z = p[2], t = p[3];
  return bt__vec (0.2 + 0.01 * x - 0.02 * y * z / 10 + 1e-3 * t, 0.1 + 1e-4 * x * t - 0.01 * z,
                  0.01 * y + 1e-6 * x * y * z * t);
}

enum
{
  NX = 4,
  NY = 3,
  NZ = 5,
  NT = 3,
  ROWS = NX * NY * NZ * NT
};

static const double xs[NX] = { -10, 0, 4, 20 }, ys[NY] = { -5, 5, 6 };
static const double zs[NZ] = { -40, -20, -10, -5, 0 }, ts[NT] = { 0, 600, 1000 };

/* In an order that is no order.  */
static void
fill_rows (double (*rows)[7])
{
  for (int i = 0; i < ROWS; i++)
    {
      double *r = rows[i * 77 % ROWS];
      r[0] = xs[i % NX];
      r[1] = ys[i / NX % NY];
      r[2] = zs[i / NX / NY % NZ];
      r[3] = ts[i / NX / NY / NZ];
      bt_vec3 v = field (r);
      r[4] = v.x;
      r[5] = v.y;
      r[6] = v.z;
    }
}

static double
within (const double *line, int n, double value)
{
  return fmax (line[0], fmin (line[n - 1], value));
}

static void
check_field (const bt_current_grid *grid)
{
  for (double x = -15; x < 30; x += 2.3)
    for (double y = -8; y < 9; y += 1.1)
      for (double z = -50; z < 5; z += 3.7)
        for (double t = -100; t < 1200; t += 130)
          {
            double in[4] = { within (xs, NX, x), within (ys, NY, y), within (zs, NZ, z),
                             within (ts, NT, t) };
            bt_vec3 v = bt_current_grid_velocity (grid, bt__vec (x, y, z), t);
            assert_close (bt__distance (v, field (in)), 0, 1e-13, "field");
          }
}

static void
test_grid (void **state)
{
  (void)state;
  double rows[ROWS][7];
  bt_current_grid *grid;
  bt_error error;
  fill_rows (rows);
  assert_int_equal (bt_current_grid_new ((const double (*)[7])rows, ROWS, &grid, &error), BT_OK);
  check_field (grid);
  assert_true (bt_current_grid_is_unsteady (grid));
  assert_false (bt__is_finite (bt_current_grid_velocity (grid, bt__vec (0, NAN, 0), 0)));
  bt_current current = { .kind = BT_CURRENT_GRID };
  bt_sea sea = { grid, NULL, NULL };
  bt_water water = { 1025, 9.81, 40, 300, &current, NULL, NULL, &sea };
  double p[4] = { 1, 2, -3, 300 };
  assert_close (bt__distance (bt_water_velocity (&water, bt__vec (1, 2, -3)), field (p)), 0, 1e-14,
                "water");
  assert_true (bt_water_is_unsteady (&water));
  bt_current_grid_free (grid);
}

/* ---- The file ---- */

static bt_status
read_text (const char *text, bt_current_grid **grid, bt_error *error)
{
  char name[] = "/tmp/bight-grid-XXXXXX";
  int fd = mkstemp (name);
  assert_true (fd >= 0);
  FILE *file = fdopen (fd, "w");
  fputs (text, file);
  fclose (file);
  bt_status status = bt_current_grid_read (name, grid, error);
  remove (name);
  return status;
}

static void
test_file (void **state)
{
  (void)state;
  bt_current_grid *grid;
  bt_error error;
  const char *text
      = "# measured\nx (m), Y_m, z[m], t, u, v, w (m/s)\n0,0,0,0, 1,0,0\n\n0 0 -10 0 0.5 0 0\n";
  assert_int_equal (read_text (text, &grid, &error), BT_OK);
  bt_vec3 v = bt_current_grid_velocity (grid, bt__vec (7, 8, -4), 99);
  assert_close (v.x, 0.8, 1e-15, "read");
  assert_false (bt_current_grid_is_unsteady (grid));
  bt_current_grid_free (grid);
}

/* What is wrong is named, with its line or its place.  */
static void
test_bad_files (void **state)
{
  (void)state;
  static const struct
  {
    const char *text, *says;
    bt_status status;
  } cases[] = {
    { "", "no rows", BT_ERR_FORMAT },
    { "0 0 0 0 1 0\n", "line 1: 6 numbers", BT_ERR_FORMAT },
    { "x y z t u v w\n0 0 0 0 1 0 0\n0 0 0 fast 1 0 0\n", "line 3", BT_ERR_FORMAT },
    { "t x y z u v w\n0 0 0 0 1 0 0\n", "x y z t u v w", BT_ERR_FORMAT },
    { "lon,lat,depth,time,u,v,w\n0,0,0,0,1,0,0\n", "x y z t u v w", BT_ERR_FORMAT },
    { "x y z t u v\n0 0 0 0 1 0 0\n", "x y z t u v w", BT_ERR_FORMAT },
    { "a\nb\n0 0 0 0 1 0 0\n", "line 2", BT_ERR_FORMAT },
    { "0 0 0 0 1 0 0\n1 1 0 0 1 0 0\n1 0 0 0 1 0 0\n", "x 0, y 1, z 0, t 0", BT_ERR_FORMAT },
    { "0 0 0 0 1 0 0\n0 0 0 0 1 0 0\n", "two rows", BT_ERR_FORMAT },
    { "0 0 0 0 21 0 0\n", "21 m/s", BT_ERR_DOMAIN },
    { "0 0 0 0 nan 0 0\n", "row 1", BT_ERR_DOMAIN },
    { "inf 0 0 0 0 0 0\n", "row 1", BT_ERR_DOMAIN },
  };
  bt_current_grid *grid;
  bt_error error;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      bt_status status = read_text (cases[i].text, &grid, &error);
      if (status != cases[i].status || !strstr (error.text, cases[i].says))
        fail_msg ("case %zu: %s: %s", i, bt_status_name (status), error.text);
    }
  assert_int_equal (bt_current_grid_read ("/nowhere/at.all", &grid, &error), BT_ERR_IO);
}

/* ---- The lee ---- */

static const bt_wake pile = { { 0, 0, 2 }, { 0, 0, -1 }, 32, 0.5 };
static const bt_vec3 east = { 0.6, 0, 0 };

static double
share (double x, double y, double z)
{
  return bt_wake_share (&pile, east, bt__vec (x, y, z));
}

/* Half the current from one to three diameters behind, all of it before and far away; the momentum
   that it lacks is that of a drag coefficient of 1.25: the integral of 1 - share over y is
   1.25 D/2, with a Gaussian's sqrt (2 pi) for 2.5.  */
static void
test_lee (void **state)
{
  (void)state;
  for (double s = 0.5; s <= 3; s += 0.25)
    assert_close (share (s, 0, -10), 0.5, 1e-12, "close");
  assert_true (share (-0.5, 0, -10) == 1 && share (-5, 0, -10) == 1);
  assert_true (share (2, 3.1, -10) == 1 && share (61, 0, -10) == 1 && share (2, 0, -32) == 1);
  assert_close (1 - share (12, 0, -10), 0.25, 1e-12, "far");
  for (double s = 1; s < 40; s *= 2)
    {
      double lack = 0;
      for (double y = -15; y < 15; y += 0.01)
        lack += (1 - share (s, y, -10)) * 0.01;
      assert_close (lack, 0.25 * sqrt (2 * BT__PI), 1e-3, "momentum");
    }
}

/* No jump anywhere, as P and the direction of the current go round.  */
static void
test_lee_is_smooth (void **state)
{
  (void)state;
  double e = 1e-6, steepest = 0;
  for (double x = -3; x < 65; x += 0.37)
    for (double y = -6; y < 6; y += 0.29)
      for (double z = -33; z < 4; z += 1.3)
        {
          double here = share (x, y, z);
          assert_true (here >= 0.5 && here <= 1);
          steepest = fmax (steepest, fabs (share (x + e, y, z) - here) / e);
          steepest = fmax (steepest, fabs (share (x, y + e, z) - here) / e);
          steepest = fmax (steepest, fabs (share (x, y, z + e) - here) / e);
        }
  assert_true (steepest < 1.6);
  double before = 1;
  for (double a = 0; a < 6.3; a += 1e-3)
    {
      bt_vec3 flow = bt__vec (cos (a), sin (a), 0);
      double now = bt_wake_share (&pile, flow, bt__vec (-2, -1, -9));
      assert_true (a == 0 || fabs (now - before) < 5e-3);
      before = now;
    }
  assert_true (bt_wake_share (&pile, bt__vec (0, 0, 0), bt__vec (2, 0, -9)) == 1);
  assert_true (bt_wake_share (&pile, bt__vec (0, 0, 1), bt__vec (2, 0, -9)) == 1);
}

static bt_lees *
lees_of (const bt_wake *wakes, size_t n)
{
  bt_error error;
  bt_lees *lees;
  assert_int_equal (bt_lees_new (wakes, n, &lees, &error), BT_OK);
  return lees;
}

/* The water behind two piles has both their lees, a turned scene the same ones.  */
static void
test_lees_in_water (void **state)
{
  (void)state;
  bt_wake other = bt_wake_of (bt__vec (4, 0, 0), bt__vec (4, 0, -30), 0.5);
  bt_lees *two = lees_of ((bt_wake[]){ pile, other }, 2);
  bt_current current = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.6, 0, 0 } } };
  bt_sea sea = { NULL, NULL, two };
  bt_water water = { 1025, 9.81, 40, 0, &current, NULL, NULL, &sea };
  bt_vec3 p = { 6, 0.2, -8 };
  double expected = 0.6 * share (6, 0.2, -8) * bt_wake_share (&other, east, p);
  assert_close (bt_water_velocity (&water, p).x, expected, 1e-15, "two");
  bt_vec3 mean = bt_water_mean_velocity (&water, bt__vec (6, -1, -8), bt__vec (6, 1, -8));
  assert_true (mean.x < 0.45 && mean.x > 0.15);
  double c = cos (0.9), s = sin (0.9);
  bt_wake turned = bt_wake_of (bt__vec (0, 2 * s, 2 * c), bt__vec (0, -30 * s, -30 * c), 0.5);
  bt_vec3 q = bt__vec (2, 0.3 * c - 9 * s, -0.3 * s - 9 * c);
  assert_close (bt_wake_share (&turned, east, q), share (2, 0.3, -9), 1e-12, "turned");
  bt_lees_free (two);
}

/* In [-1, 1), from *SEED, which goes on.  */
static double
draw (uint64_t *seed)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)(*seed >> 11 << 11) / 9223372036854775808.0;
}

static bt_vec3
draw_vec (uint64_t *seed, double size)
{
  double x = draw (seed), y = draw (seed), z = draw (seed);
  return bt__vec (size * x, size * y, size * z);
}

static double
sets_in (double u)
{
  u = fmax (0, fmin (1, u));
  return u * u * (3 - 2 * u);
}

/* What bight/sea.h says of one lee, from the place in the plane across its axis.  */
static double
share_by_the_book (const bt_wake *w, bt_vec3 flow, bt_vec3 p)
{
  double diameter = 2 * w->radius;
  bt_vec3 from = bt__sub (p, w->a);
  double along = bt__dot (from, w->axis), beyond = fmax (-along, along - w->length);
  bt_vec3 across = bt__axpy (flow, -bt__dot (flow, w->axis), w->axis);
  bt_vec3 off = bt__axpy (from, -along, w->axis), way = bt__unit_or (across, off);
  double s = bt__dot (off, way) / diameter, side = bt__norm (bt__axpy (off, -s * diameter, way));
  double c = sqrt (fmin (1, 3 / fmax (s, 1e-300))), b = diameter / 2 / c;
  if (side > 6 * b || bt__norm (across) <= 1e-6 * bt__norm (flow))
    return 1;
  double d = 0.5 * c * exp (-side * side / (2 * b * b));
  d *= sets_in (s + 0.5) * (1 - sets_in ((s - 40) / 20)) * sets_in (1 - beyond / diameter);
  return 1 - d * bt__norm (across) / bt__norm (flow);
}

/* What many leave is the product of what each leaves, and that is what the book says; nothing is
   divided by zero for those that are not there.  */
static void
test_many_lees (void **state)
{
  (void)state;
  enum
  {
    MOST = 70
  };
  uint64_t seed = 11;
  int felt = 0, asked = 0;
  for (int round = 0; round < 3000; round++)
    {
      bt_wake one[MOST];
      size_t n = 1 + (size_t)round % (round % 10 ? 11 : MOST);
      for (size_t i = 0; i < n; i++)
        {
          bt_vec3 a = draw_vec (&seed, 10);
          double length = round % 7 ? pow (10, 2 * draw (&seed)) : 0;
          one[i]
              = bt_wake_of (a, bt__add (a, draw_vec (&seed, length)), exp (2 * draw (&seed)) / 3);
        }
      bt_lees *lees = lees_of (one, n);
      bt_vec3 flow = round % 5 ? draw_vec (&seed, 1) : one[0].axis;
      for (int k = 0; k < 40; k++)
        {
          bt_vec3 p = draw_vec (&seed, round % 3 ? 15 : 60);
          double product = 1;
          for (size_t i = 0; i < n; i++)
            {
              double one_share = bt_wake_share (&one[i], flow, p);
              assert_close (one_share, share_by_the_book (&one[i], flow, p), 1e-11, "one");
              product *= one_share;
            }
          feclearexcept (FE_ALL_EXCEPT);
          assert_close (bt_lees_share (lees, flow, p), product, 1e-14, "many");
          assert_false (fetestexcept (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW));
          felt += product < 1;
          asked++;
        }
      bt_lees_free (lees);
    }
  assert_true (felt > asked / 10 && felt < asked * 9 / 10);
}

/* Of places on a line the shares are those of each alone, to the bit: fine and coarse lines, far
   too many wakes to note, flows along an axis, places that are not finite.  */
static void
test_lees_together (void **state)
{
  (void)state;
  enum
  {
    MOST = 900,
    PLACES = 37
  };
  static bt_wake one[MOST];
  uint64_t seed = 5;
  int felt = 0;
  for (int round = 0; round < 400; round++)
    {
      size_t n = round % 20 ? 1 + (size_t)round % 90 : MOST;
      double room = round % 20 ? 15 : 5;
      for (size_t i = 0; i < n; i++)
        {
          bt_vec3 a = draw_vec (&seed, room);
          one[i] = bt_wake_of (a, bt__add (a, draw_vec (&seed, 10)), exp (2 * draw (&seed)) / 5);
        }
      bt_lees *lees = lees_of (one, n);
      bt_vec3 flow = round % 5 ? draw_vec (&seed, 1) : one[0].axis, p[PLACES];
      double share[PLACES], step = pow (10, draw (&seed));
      p[0] = draw_vec (&seed, 20);
      for (int k = 1; k < PLACES; k++)
        p[k] = bt__add (p[k - 1], draw_vec (&seed, step));
      if (round % 30 == 0)
        p[round % PLACES].y = round % 60 ? NAN : INFINITY;
      bt_lees_shares (lees, flow, p, PLACES, share);
      for (int k = 0; k < PLACES; k++)
        {
          double alone = bt_lees_share (lees, flow, p[k]);
          assert_memory_equal (&share[k], &alone, sizeof alone);
          felt += alone < 1;
        }
      bt_lees_free (lees);
    }
  assert_true (felt > 400 * PLACES / 5);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_grid),          cmocka_unit_test (test_file),
    cmocka_unit_test (test_bad_files),     cmocka_unit_test (test_lee),
    cmocka_unit_test (test_lee_is_smooth), cmocka_unit_test (test_lees_in_water),
    cmocka_unit_test (test_many_lees),     cmocka_unit_test (test_lees_together),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
