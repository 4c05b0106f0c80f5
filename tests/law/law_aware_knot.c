/* Knots: those everybody knows, circles and tangles without one, the same after any move.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "aware/knot.h"
#include "testbed/aware_cases.h"

enum
{
  N = 120
};

#define PRIME ((UINT64_C (1) << 61) - 1)

static bt__knot *knot;

static int
set_up (void **state)
{
  (void)state;
  return bt__knot_new (2 * CASE_NODES, &knot, NULL) != BT_OK;
}

static int
tear_down (void **state)
{
  (void)state;
  bt__knot_free (knot);
  return 0;
}

/* A / B modulo the prime, B small: the first of A, A + prime ... that B divides.  */
static uint64_t
fraction (uint64_t a, uint64_t b)
{
  uint64_t k = 0;
  while ((k * (PRIME % b) + a) % b)
    k++;
  return k * (PRIME / b) + (k * (PRIME % b) + a) / b;
}

static void
torus (bt_vec3 *p, int around, int through)
{
  for (int i = 0; i < N; i++)
    {
      double t = 2 * BT__PI * i / N, r = 2 + 0.8 * cos (through * t);
      p[i] = bt__vec (r * cos (around * t), r * sin (around * t), 0.8 * sin (through * t));
    }
}

static void
figure_eight (bt_vec3 *p)
{
  for (int i = 0; i < N; i++)
    {
      double t = 2 * BT__PI * i / N, r = 2 + cos (2 * t);
      p[i] = bt__vec (r * cos (3 * t), r * sin (3 * t), sin (4 * t));
    }
}

static bt__knot_value
value_of (const bt_vec3 *p, uint32_t n)
{
  bt__knot_value v;
  assert_true (bt__knot_of_closed (knot, p, n, &v));
  return v;
}

/* The determinant and the squares of the polynomial at 2 and 3.  */
static void
expect (bt__knot_value v, uint64_t det, uint64_t at2, uint64_t at3)
{
  assert_int_equal (v.determinant, det);
  assert_true (v.at2 == at2 && v.at3 == at3);
  assert_int_equal (v.knotted, det != 1 || at2 != 1 || at3 != 1);
}

static void
known_knots (void **state)
{
  bt_vec3 p[N];
  (void)state;
  torus (p, 1, 5);
  expect (value_of (p, N), 1, 1, 1);
  torus (p, 2, 3); /* t - 1 + 1/t: 3/2, 7/3 */
  expect (value_of (p, N), 3, fraction (9, 4), fraction (49, 9));
  for (int i = 0; i < N; i++)
    p[i].z = -p[i].z; /* the other trefoil */
  expect (value_of (p, N), 3, fraction (9, 4), fraction (49, 9));
  figure_eight (p); /* 3 - t - 1/t: 1/2, -1/3 */
  expect (value_of (p, N), 5, fraction (1, 4), fraction (1, 9));
  torus (p, 2, 5); /* t^2 - t + 1 - 1/t + 1/t^2: 11/4, 61/9 */
  expect (value_of (p, N), 5, fraction (121, 16), fraction (3721, 81));
  torus (p, 2, 7);
  assert_int_equal (value_of (p, N).determinant, 7);
  torus (p, 3, 4); /* t^3 - t^2 + 1 - ...: the determinant does not tell all */
  assert_int_equal (value_of (p, N).determinant, 3);
  assert_true (value_of (p, N).at2 != fraction (9, 4));
  torus (p, 3, 5); /* the determinant tells nothing */
  assert_int_equal (value_of (p, N).determinant, 1);
  assert_true (value_of (p, N).knotted);
}

/* ---- Moves ---- */

static double
volume (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  return bt__dot (bt__sub (b, a), bt__cross (bt__sub (c, a), bt__sub (d, a)));
}

static int
hits (bt_vec3 p, bt_vec3 q, bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  if ((volume (a, b, c, p) >= 0) == (volume (a, b, c, q) >= 0))
    return 0;
  int one = volume (p, q, a, b) >= 0;
  return one == (volume (p, q, b, c) >= 0) && one == (volume (p, q, c, a) >= 0);
}

/* Node J goes to TO unless one of its links sweeps another.  */
static int
shift (bt_vec3 *p, int n, int j, bt_vec3 to)
{
  int h = (j + n - 1) % n, k = (j + 1) % n;
  for (int a = 0; a < n; a++)
    {
      int b = (a + 1) % n;
      if (a == h || a == j)
        continue;
      if ((b != h && a != h && hits (p[a], p[b], p[h], p[j], to))
          || (a != k && b != k && hits (p[a], p[b], p[j], p[k], to)))
        return 0;
    }
  p[j] = to;
  return 1;
}

/* Moves of single nodes make every Reidemeister move.  */
static void
moves_change_nothing (void **state)
{
  dice d = dice_new (12);
  bt_vec3 p[N];
  uint32_t most = 0;
  (void)state;
  for (int k = 0; k < 12; k++)
    {
      bt__knot_value before;
      if (k % 3 == 0)
        figure_eight (p);
      else
        torus (p, k % 3, 3);
      before = value_of (p, N);
      for (int round = 0; round < 6; round++)
        {
          for (int i = 0; i < 1500; i++)
            {
              int j = dice_below (&d, N);
              shift (p, N, j, bt__add (p[j], dice_point (&d, 0.8)));
            }
          bt__knot_value v = value_of (p, N);
          assert_true (v.determinant == before.determinant && v.at2 == before.at2
                       && v.at3 == before.at3);
          most = v.crossings > most ? v.crossings : most;
        }
    }
  print_message ("# up to %u crossings\n", (unsigned)most);
  assert_true (most > 10);
}

/* ---- Open lines ---- */

/* The knot tied into a long line: cut open where it is farthest out and led away.  */
static uint32_t
open_knot (bt_vec3 *out, const bt_vec3 *closed)
{
  int at = 0;
  for (int i = 0; i < N; i++)
    if (bt__norm (closed[i]) > bt__norm (closed[at]))
      at = i;
  bt_vec3 e = bt__unit_or (closed[at], bt__vec (1, 0, 0)), f = bt__across (e);
  uint32_t n = 0;
  out[n++] = bt__axpy (bt__scale (8, e), -8, f);
  for (int i = 0; i + 2 < N; i++)
    out[n++] = closed[(at + 1 + i) % N];
  out[n++] = bt__axpy (bt__scale (8, e), 8, f);
  return n;
}

static void
open_lines (void **state)
{
  bt_vec3 p[N], line[N + 2];
  bt__knot_value v;
  (void)state;
  torus (p, 2, 3);
  uint32_t n = open_knot (line, p);
  assert_true (bt__knot_of (knot, line, n, &v));
  expect (v, 3, fraction (9, 4), fraction (49, 9));
  figure_eight (p);
  n = open_knot (line, p);
  assert_true (bt__knot_of (knot, line, n, &v));
  expect (v, 5, fraction (1, 4), fraction (1, 9));
  torus (p, 1, 7);
  n = open_knot (line, p);
  assert_true (bt__knot_of (knot, line, n, &v));
  expect (v, 1, 1, 1);
}

/* A widening coil, and walks that never turn back: tangles, but no knots.  */
static void
tangles_without_a_knot (void **state)
{
  bt_vec3 p[3 * N];
  bt__knot_value v;
  (void)state;
  for (int i = 0; i < 3 * N; i++)
    {
      double t = i / 12.0;
      p[i] = bt__vec (cos (t) * (1 + 0.01 * i), sin (t) * (1 + 0.01 * i), 0.02 * i);
    }
  assert_true (bt__knot_of (knot, p, 3 * N, &v));
  assert_false (v.knotted);
  dice d = dice_new (9);
  for (int k = 0; k < 200; k++)
    {
      for (int i = 0; i < N; i++)
        p[i] = bt__vec (0.02 * i, dice_between (&d, -3, 3), dice_between (&d, -3, 3));
      assert_true (bt__knot_of (knot, p, N, &v));
      assert_false (v.knotted);
    }
}

static void
refuses_too_much (void **state)
{
  bt_vec3 p[N];
  bt__knot_value v;
  bt__knot *small = NULL;
  (void)state;
  torus (p, 2, 3);
  assert_int_equal (bt__knot_new (50, &small, NULL), BT_OK);
  assert_false (bt__knot_of (small, p, N, &v));
  assert_false (bt__knot_of (small, p, 1, &v));
  assert_true (bt__knot_of (small, p, 2, &v) && !v.knotted);
  bt__knot_free (small);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (known_knots), cmocka_unit_test (moves_change_nothing),
          cmocka_unit_test (open_lines), cmocka_unit_test (tangles_without_a_knot),
          cmocka_unit_test (refuses_too_much) };
  return cmocka_run_group_tests_name ("aware knot", tests, set_up, tear_down);
}
