/* The V, thesis equation 2-1, and the thesis' search for the catenary.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include <bight/statics.h>

#include "near.h"

#define COUNT(table) (sizeof (table) / sizeof *(table))

static double
length_of (const bt_v_shape *v, double h, double y)
{
  return hypot (v->bend.x, v->bend.y) + hypot (h - v->bend.x, y - v->bend.y);
}

/* Figure 2-2: length 10, 6 across; with the thesis' three constraints.  */
static void
meets_equation_2_1 (void **state)
{
  static const double rows[][4]
      = { { 0, 5, 3, -4 }, { 8, 0, 0, 0 }, { -8, 10, 6, -8 }, { 4, 2.5, 1.5, -2 } };
  (void)state;
  for (size_t i = 0; i < COUNT (rows); i++)
    {
      const double *r = rows[i];
      bt_v_shape v;
      assert_int_equal (bt_v_shape_solve (6, r[0], 10, &v, NULL), BT_OK);
      near ("length", length_of (&v, 6, r[0]), 10, 1e-14);
      near ("l1 + l2", v.l1 + v.l2, 10, 0);
      if (fabs (r[0]) == 8)
        continue; /* exactly taut: straight, by the header halved */
      near ("l1", v.l1, r[1], 1e-14);
      near ("x", v.bend.x, r[2], 1e-14);
      near ("y", v.bend.y, r[3], 1e-14);
    }
  /* The taut rows are the limit.  */
  for (size_t i = 1; i <= 2; i++)
    {
      const double *r = rows[i];
      bt_v_shape v;
      assert_int_equal (bt_v_shape_solve (6, r[0], 10 * (1 + 1e-12), &v, NULL), BT_OK);
      near ("l1", v.l1, r[1], 1e-10);
      near ("x", v.bend.x, r[2], 1e-10);
      near ("y", v.bend.y, r[3], 1e-10);
    }
}

static void
keeps_its_length (void **state)
{
  (void)state;
  for (int i = 0; i < 20000; i++)
    {
      double angle = i * 0.7, c = 7 * (i % 1000) / 1000.0, h = fabs (c * cos (angle)),
             y = c * sin (angle), s = 7 + (i % 3 == 0 ? 0 : i % 97);
      bt_v_shape v;
      assert_int_equal (bt_v_shape_solve (h, y, s, &v, NULL), BT_OK);
      near ("length", length_of (&v, h, y), s, 1e-14 * s);
      assert_true (v.l1 >= 0 && v.l2 >= 0);
    }
}

static void
refuses_nonsense (void **state)
{
  bt_v_shape v;
  bt_error error;
  (void)state;
  assert_int_equal (bt_v_shape_solve (-1, 0, 5, &v, &error), BT_ERR_DOMAIN);
  assert_int_equal (bt_v_shape_solve (1, NAN, 5, &v, &error), BT_ERR_DOMAIN);
  assert_int_equal (bt_v_shape_solve (1, 0, 0, &v, &error), BT_ERR_DOMAIN);
  assert_int_equal (bt_v_shape_solve (30, 40, 5, &v, &error), BT_OK);
  near ("middle of the straight line", v.bend.x, 15, 0);
}

/* ---- The search ---- */

static void
search_finds_the_catenary (void **state)
{
  static const double rows[][3] = { { 8, 0, 10 }, { 60, 20, 100 }, { 20, -10, 40 }, { 45, 0, 50 } };
  bt_search *search = bt_search_new ();
  (void)state;
  assert_non_null (search);
  for (size_t i = 0; i < COUNT (rows); i++)
    {
      const double *r = rows[i];
      bt_search_result found = { 0 };
      bt_catenary c;
      assert_int_equal (bt_catenary_solve (r[0], r[1], r[2], &c, NULL), BT_OK);
      assert_int_equal (bt_search_catenary (search, r[0], r[1], r[2], 1e-9, 500, 0, &found, NULL),
                        BT_OK);
      assert_true (found.converged);
      near ("A", found.a, c.a, 1e-6 * c.a);
      near ("xs", found.xs, -c.a * asinh (c.sigma0 / c.a), 1e-6 * r[2]);
      /* Warm, from the answer itself, it needs next to nothing; a coarse one needs less.  */
      int cold = found.iterations;
      assert_int_equal (bt_search_catenary (search, r[0], r[1], r[2], 0.005, 500, 1, &found, NULL),
                        BT_OK);
      assert_true (found.converged && found.iterations < cold / 4);
    }
  bt_search_free (search);
}

static void
search_ends_where_it_cannot (void **state)
{
  bt_search *search = bt_search_new ();
  bt_search_result found = { 0 };
  bt_error error;
  (void)state;
  assert_non_null (search);
  assert_int_equal (bt_search_catenary (search, 1, 0, -1, 0.005, 500, 0, &found, &error),
                    BT_ERR_DOMAIN);
  /* A line too short has no catenary; the search must say so and stop.  */
  assert_int_equal (bt_search_catenary (search, 20, 0, 10, 0.005, 500, 0, &found, &error), BT_OK);
  assert_false (found.converged);
  assert_true (found.iterations <= 500);
  /* One metre: the thesis' guess is A = 0.  */
  assert_int_equal (bt_search_catenary (search, 0.5, 0, 1, 0.005, 500, 0, &found, &error), BT_OK);
  bt_search_free (search);
  bt_search_free (NULL);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (meets_equation_2_1), cmocka_unit_test (keeps_its_length),
          cmocka_unit_test (refuses_nonsense), cmocka_unit_test (search_finds_the_catenary),
          cmocka_unit_test (search_ends_where_it_cannot) };
  return cmocka_run_group_tests_name ("v-shape", tests, NULL, NULL);
}
