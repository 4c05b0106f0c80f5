/* The inextensible catenary against closed tables, against quadruple precision, and over 12
   decades.

   BIGHT_LONG=1 runs the random family over 1e7 cases instead of 2e5.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include <bight/statics.h>

#include "near.h"
#include "testbed/chance.h"

#define COUNT(table) (sizeof (table) / sizeof *(table))

/* ---- The table ---- */

/* sinh (x) / x = sqrt (L^2 - v^2) / h, a = h / (2 x), x_low = h/2 - a atanh (v / L), point at arc
   s: x = x_low + a asinh ((s + sigma0) / a), sigma0 = a sinh (-x_low / a), y over y_low: a cosh -
   a. Quoted from the reference data, catenary_inextensible.csv, 13 digits.  */
typedef struct row
{
  double s, h, v, w, a, H, start, end, x_low, y_min;
  double quarter[3][2];
} row;

static const row table[] = { { 2.85,
                               1.9,
                               -0.6,
                               0.4,
                               0.6040201591304,
                               0.2416080636522,
                               0.7412742370235,
                               0.5012742370235,
                               1.079092400928,
                               -1.249165433428,
                               { { 0.2869849484282, -0.6509491712590 },
                                 { 0.7662778828396, -1.166337367015 },
                                 { 1.442315666893, -1.136623622340 } } },
                             { 10,
                               8,
                               0,
                               1,
                               3.382018790853,
                               3.382018790853,
                               6.036393882252,
                               6.036393882252,
                               4,
                               -2.654375091398,
                               { { 1.685050203730, -1.830677403257 },
                                 { 4, -2.654375091398 },
                                 { 6.314949796270, -1.830677403257 } } },
                             { 10,
                               2,
                               3,
                               0.05,
                               0.2846808321866,
                               0.01423404160933,
                               0.1754448963115,
                               0.3254448963115,
                               0.9118857014974,
                               -3.224217094044,
                               { { 0.3520225203749, -2.471732777350 },
                                 { 1.585335595436, -1.979499863135 },
                                 { 1.862081283082, 0.5038823225177 } } },
                             { 100,
                               60,
                               -70,
                               0.5,
                               28.84847589582,
                               14.42423794791,
                               49.63966581015,
                               14.63966581015,
                               55.02029836761,
                               -70.43085572448,
                               { { 8.299827760212, -23.57194043382 },
                                 { 19.61053651393, -45.82998668931 },
                                 { 36.35466165506, -64.17867825256 } } },
                             { 100,
                               99.5,
                               5,
                               2,
                               331.0578194491,
                               662.1156388981,
                               665.4445233729,
                               675.4445233729,
                               33.18329422360,
                               -1.664442237410,
                               { { 24.94525751686, -1.561939371166 },
                                 { 49.93725495161, -1.240414928322 },
                                 { 74.83443949139, 0.9591288410935 } } },
                             { 30,
                               0.5,
                               -10,
                               0.2,
                               0.03777310580515,
                               0.007554621161029,
                               4.000010701037,
                               2.000010701037,
                               0.2630911608949,
                               -19.96228039938,
                               { { 0.01775342405861, -7.499978598035 },
                                 { 0.05236403727713, -14.99989299192 },
                                 { 0.4476371752209, -17.49978599299 } } },
                             { 400,
                               250,
                               -300,
                               6.5,
                               213.1718462579,
                               1385.617000676,
                               3440.445528008,
                               1490.445528008,
                               332.4066295631,
                               -300,
                               { { 44.15937166986, -89.68258701822 },
                                 { 98.06624692645, -173.8165865635 },
                                 { 165.5120325694, -247.3896256043 } } } };

static void
check_row (const row *t)
{
  bt_catenary c;
  assert_int_equal (bt_catenary_solve (t->h, t->v, t->s, &c, NULL), BT_OK);
  double digit = 2e-12 * t->s;
  near ("A", c.a, t->a, 3e-12 * t->a);
  near ("H = w A", t->w * c.a, t->H, 3e-12 * t->H);
  near ("tension at the start", t->w * hypot (c.a, c.sigma0), t->start, 3e-12 * t->start);
  near ("tension at the end", t->w * hypot (c.a, c.sigma0 + t->s), t->end, 3e-12 * t->end);
  near ("lowest point", -c.a * asinh (c.sigma0 / c.a), t->x_low, 1e-11 * t->s);
  for (int k = 0; k < 3; k++)
    {
      bt_point2 p = bt_catenary_point (&c, 0.25 * (k + 1) * t->s);
      near ("x at a quarter", p.x, t->quarter[k][0], digit);
      near ("y at a quarter", p.y, t->quarter[k][1], digit);
    }
  if (t->x_low < t->h)
    near ("lowest height", bt_catenary_point (&c, -c.sigma0).y, t->y_min, digit);
}

static void
matches_the_table (void **state)
{
  (void)state;
  for (size_t i = 0; i < COUNT (table); i++)
    check_row (table + i);
}

/* DOMAIN chapter 6: sqrt (L^2 - d^2) = 2 A sinh (c / 2A), y0 = c/2 - A atanh (d / L), and the
   farthest point down-current, quoted.  */
static void
matches_the_golden_numbers (void **state)
{
  static const double golden[][6] = {
    { 3, 0, 5, .815841, 1.5, 1.81391 },           { 60, 0, 100, 16.316827, 30, 36.27822 },
    { 20, 10, 40, 4.717166, 8.795175, 10.86766 }, { 20, -10, 40, 4.717166, 11.204825, 20.86766 },
    { 30, 0, 30.5, 47.552295, 15, 2.38550 },      { 15, 5, 25, 4.171054, 6.654392, 6.53397 }
  };
  (void)state;
  for (size_t i = 0; i < COUNT (golden); i++)
    {
      const double *g = golden[i];
      bt_catenary c;
      assert_int_equal (bt_catenary_solve (g[0], g[1], g[2], &c, NULL), BT_OK);
      near ("A", c.a, g[3], 6e-7);
      near ("y0", -c.a * asinh (c.sigma0 / c.a), g[4], 6e-7);
      near ("down-current", -bt_catenary_point (&c, -c.sigma0).y, g[5], 6e-6);
    }
}

/* ---- Ends of the range ---- */

static void
hangs_folded (void **state)
{
  bt_catenary c;
  (void)state;
  assert_int_equal (bt_catenary_solve (0, 2, 10, &c, NULL), BT_OK);
  assert_true (c.a == 0);
  near ("bottom", bt_catenary_point (&c, 4).y, -4, 0);
  near ("end", bt_catenary_point (&c, 10).y, 2, 0);
  near ("end", bt_catenary_point (&c, 10).x, 0, 0);
  near ("down", bt_catenary_tangent (&c, 1).y, -1, 0);
  near ("up", bt_catenary_tangent (&c, 9).y, 1, 0);
  near ("across at the fold", bt_catenary_tangent (&c, 4).x, 1, 0);
  assert_int_equal (bt_catenary_solve (0, 0, 1, &c, NULL), BT_OK);
  near ("folded in half", bt_catenary_point (&c, 0.5).y, -0.5, 0);
}

static void
goes_straight_when_taut (void **state)
{
  bt_catenary c;
  (void)state;
  assert_int_equal (bt_catenary_solve (3, 4, 5, &c, NULL), BT_OK);
  assert_true (isinf (c.a));
  assert_int_equal (bt_catenary_solve (30, -40, 5, &c, NULL), BT_OK);
  assert_true (isinf (c.a));
  near ("x", bt_catenary_point (&c, 2.5).x, 15, 1e-14);
  near ("y", bt_catenary_point (&c, 2.5).y, -20, 1e-14);
  near ("slope", bt_catenary_tangent (&c, 1).y, -0.8, 1e-15);
  assert_int_equal (bt_catenary_solve (0, 7, 5, &c, NULL), BT_OK);
  assert_true (isinf (c.a));
}

/* One unit in the last place of slack is seen: the excess is formed beyond double precision.  */
static void
sees_the_last_bit_of_slack (void **state)
{
  bt_catenary c;
  (void)state;
  assert_int_equal (bt_catenary_solve (3, 4, nextafter (5, 6), &c, NULL), BT_OK);
  /* Near taut the sag is a parabola's: slack = h^4 / (24 A^2 chord).  */
  double slack = nextafter (5, 6) - 5, a = 3 * 3 / sqrt (24 * slack * 5);
  near ("A", c.a, a, 1e-6 * a);
  assert_int_equal (bt_catenary_solve (3, 4, nextafter (5, 4), &c, NULL), BT_OK);
  assert_true (isinf (c.a));
}

static void
refuses_nonsense (void **state)
{
  static const double bad[][3]
      = { { NAN, 0, 1 },       { 0, NAN, 1 },   { 0, 0, NAN },   { INFINITY, 0, 1 },
          { 1, -INFINITY, 1 }, { -1, 0, 5 },    { 1, 0, 0 },     { 1, 0, -5 },
          { 1, 0, INFINITY },  { 1e300, 0, 1 }, { 0, 0, 1e300 }, { 0, 0, 1e-300 } };
  (void)state;
  for (size_t i = 0; i < COUNT (bad); i++)
    {
      bt_catenary c = { 1, 2, 3, 4, 5 };
      bt_error error = { BT_OK, "" };
      const double *b = bad[i];
      assert_int_equal (bt_catenary_solve (b[0], b[1], b[2], &c, &error), BT_ERR_DOMAIN);
      assert_int_equal (error.status, BT_ERR_DOMAIN);
      assert_true (strlen (error.text) > 20);
      assert_true (c.h == 1 && c.sigma0 == 5);
    }
}

static void
clamps_the_arc_length (void **state)
{
  bt_catenary c;
  (void)state;
  assert_int_equal (bt_catenary_solve (8, 1, 10, &c, NULL), BT_OK);
  near ("start", bt_catenary_point (&c, -3).x, 0, 0);
  near ("end", bt_catenary_point (&c, 11).x, bt_catenary_point (&c, 10).x, 0);
}

/* ---- Length by quadrature ---- */

/* Gauss' five points on each of N chords of the parameter: the tangent integrates to the chord, and
   its length to the length.  Asked of the points, by the central difference, so that point and
   tangent are held against each other.  */
static void
length_by_quadrature (void **state)
{
  (void)state;
  for (size_t i = 0; i < COUNT (table); i++)
    {
      const row *t = table + i;
      bt_catenary c;
      assert_int_equal (bt_catenary_solve (t->h, t->v, t->s, &c, NULL), BT_OK);
      enum
      {
        N = 200000
      };
      double sum = 0;
      bt_point2 p = bt_catenary_point (&c, 0);
      for (int k = 1; k <= N; k++)
        {
          bt_point2 q = bt_catenary_point (&c, t->s * k / N);
          bt_point2 m = bt_catenary_tangent (&c, t->s * (k - 0.5) / N);
          sum += (q.x - p.x) * m.x + (q.y - p.y) * m.y;
          p = q;
        }
      /* A chord falls short of its arc by (turn)^2 / 24.  */
      double turn = t->s / N / c.a;
      near ("length", sum, t->s, t->s * (turn * turn / 24 + 1e-10));
    }
}

/* ---- The random family ---- */

static uint64_t seed = 88172645463325252u;

/* Sizes over 13 decades, slack 1e-15 to 1e6, slopes h/v 1e-16 to 1e16.  */
static void
draw (double *h, double *v, double *s)
{
  double size = chance_decades (&seed, -6, 7), slope = chance_decades (&seed, -16, 16),
         chord = size / (1 + chance_decades (&seed, -15, 6));
  *s = size;
  *h = chord * (slope / hypot (1, slope));
  *v = (chance (&seed) < 0.5 ? -1 : 1) * chord / hypot (1, slope);
}

typedef __float128 quad;

static quad
quad_sqrt (quad x)
{
  quad y = sqrt ((double)x);
  for (int i = 0; i < 3; i++)
    y = (y + x / y) / 2;
  return y;
}

/* sinh (x) / x - 1 for 0 < x, by its series or by the exponential's (halved and squared).  */
static quad
quad_s (quad x)
{
  quad y = x * x, term = 1, sum = 0;
  for (int k = 1; k < 400; k++)
    {
      term *= y / (quad)(2 * k) / (quad)(2 * k + 1);
      sum += term;
      if (term < sum * (quad)1e-36)
        break;
    }
  return sum;
}

/* The reference: bisection-safe Newton on the series in quadruple precision from the answer in
   hand, itself a check that the answer is near (a wrong start would need more than the six steps).
 */
static double
reference_a (double h, double v, double s, double a)
{
  quad H = h, V = v, S = s, g = (S * S - H * H - V * V) / (H * H);
  quad rho = g / (1 + quad_sqrt (1 + g)), x = H / (2 * (quad)a);
  for (int i = 0; i < 6; i++)
    {
      /* d/dx (sinh x / x) = (cosh x - sinh x / x) / x, cosh x = sqrt (1 + sinh^2 x) */
      quad f = quad_s (x), sinh_x = x * (1 + f), slope;
      /* cosh - sinh/x cancels for small x: there x/3 + x^3/30 + x^5/840 + ... is exact enough.  */
      if (x < (quad)1e-2)
        slope = x * (1 + x * x / 10 * (1 + x * x / 28)) / 3;
      else
        slope = (quad_sqrt (1 + sinh_x * sinh_x) - 1 - f) / x;
      x -= (f - rho) / slope;
    }
  return (double)(H / (2 * x));
}

/* The curve ends where it should: within 1e-14 of the length.  Against quadruple precision A has
   two units of the last place (only where x < 25, beyond which the series above is no reference).
 */
static void
meets_the_end_over_twelve_decades (void **state)
{
  const char *longer = getenv ("BIGHT_LONG");
  long cases = longer && *longer == '1' ? 10000000 : 200000, sampled = 0;
  double worst = 0, worst_a = 0;
  (void)state;
  for (long i = 0; i < cases; i++)
    {
      double h, v, s;
      bt_catenary c;
      draw (&h, &v, &s);
      assert_int_equal (bt_catenary_solve (h, v, s, &c, NULL), BT_OK);
      bt_point2 p = bt_catenary_point (&c, s), m = bt_catenary_point (&c, s * chance (&seed));
      bt_point2 t = bt_catenary_tangent (&c, s * chance (&seed));
      double miss = hypot (p.x - h, p.y - v) / s;
      if (!(miss < 1e-14) || !isfinite (m.x) || !isfinite (m.y)
          || !(fabs (hypot (t.x, t.y) - 1) < 1e-14))
        fail_msg ("case %ld: h %.17g v %.17g s %.17g misses by %g s", i, h, v, s, miss);
      worst = fmax (worst, miss);
      if (i % 20 == 0 && isfinite (c.a) && c.a > 0 && h / c.a < 50)
        {
          double a = reference_a (h, v, s, c.a), e = fabs (c.a / a - 1);
          sampled++;
          if (!(e < 1e-15))
            fail_msg ("h %.17g v %.17g s %.17g: A %.17g, not %.17g", h, v, s, c.a, a);
          worst_a = fmax (worst_a, e);
        }
    }
  print_message ("# %ld cases, worst miss %.2g of the length; A against quadruple precision, "
                 "%ld cases, worst %.2g\n",
                 cases, worst, sampled, worst_a);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (matches_the_table),
                                      cmocka_unit_test (matches_the_golden_numbers),
                                      cmocka_unit_test (hangs_folded),
                                      cmocka_unit_test (goes_straight_when_taut),
                                      cmocka_unit_test (sees_the_last_bit_of_slack),
                                      cmocka_unit_test (refuses_nonsense),
                                      cmocka_unit_test (clamps_the_arc_length),
                                      cmocka_unit_test (length_by_quadrature),
                                      cmocka_unit_test (meets_the_end_over_twelve_decades) };
  return cmocka_run_group_tests_name ("catenary", tests, NULL, NULL);
}
