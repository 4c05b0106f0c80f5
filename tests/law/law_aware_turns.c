/* Turns, winding, linking: closed forms, whole numbers, signs.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "aware/turns.h"
#include "testbed/sweep.h"
#include "testbed/aware_cases.h"
#include "near.h"

enum
{
  N = 101
};

static const bt__axis pile = { { 0, 0, 0 }, { 0, 0, -1 } };

/* TURNS clockwise seen from above, about (0, 0) at RADIUS, rising by RISE.  */
static void
helix (bt_vec3 p[N], double turns, double radius, double rise)
{
  for (int i = 0; i < N; i++)
    {
      double u = (double)i / (N - 1), w = 2 * BT__PI * turns * u;
      p[i] = bt__vec (radius * cos (w), -radius * sin (w), rise * u);
    }
}

/* A polyline that keeps clear of the axis sweeps the same angle as the curve through its nodes.  */
static void
helix_turns_exactly (void **state)
{
  bt_vec3 p[N], back[N];
  (void)state;
  helix (p, 2.25, 0.9, 3);
  near ("turns", bt__turns (&pile, p, N), 2.25, 1e-14);
  for (int i = 0; i < N; i++)
    back[i] = p[N - 1 - i];
  near ("backwards", bt__turns (&pile, back, N), -2.25, 1e-14);
  for (int i = 0; i < N; i++)
    p[i] = bt__vec (p[i].x, -p[i].y, p[i].z);
  near ("mirrored", bt__turns (&pile, p, N), -2.25, 1e-14);
  near ("one point", bt__turns (&pile, p, 1), 0, 0);
}

/* Turned and moved with its axis nothing changes; seen along the axis the other way, the sign.  */
static void
turns_go_with_the_axis (void **state)
{
  dice d = dice_new (3);
  (void)state;
  for (int k = 0; k < 200; k++)
    {
      bt_vec3 p[N], at = dice_point (&d, 20), z = dice_direction (&d), x = bt__across (z);
      bt__frame f = { at, x, bt__cross (z, x), z };
      double turns = dice_between (&d, -4, 4);
      helix (p, turns, 1, dice_between (&d, -5, 5));
      for (int i = 0; i < N; i++)
        p[i] = bt__to_world (&f, p[i]);
      bt__axis axis = { bt__axpy (at, 7, z), z };
      near ("turns", bt__turns (&axis, p, N), -turns, 1e-12);
      axis.along = bt__scale (-1, z);
      near ("turns", bt__turns (&axis, p, N), turns, 1e-12);
    }
}

static void
winding_is_of_the_closed_curve (void **state)
{
  static const double turns[] = { 0.2, 0.49, 0.51, 1, 1.4, 2.25, 2.75 };
  static const int whole[] = { 0, 0, 1, 1, 1, 2, 3 };
  bt_vec3 p[N];
  (void)state;
  for (size_t k = 0; k < sizeof whole / sizeof *whole; k++)
    {
      helix (p, turns[k], 0.9, 3);
      assert_int_equal (bt__winding (&pile, p, N), whole[k]);
      helix (p, -turns[k], 0.9, 3);
      assert_int_equal (bt__winding (&pile, p, N), -whole[k]);
    }
  /* The chord through the axis: not round it, whatever the rounding says.  */
  for (int n = 3; n < N; n++)
    {
      helix (p, 0.5 * (N - 1) / (n - 1), 0.9, 1);
      assert_int_equal (bt__winding (&pile, p, (uint32_t)n), 0);
    }
}

/* The same whole number as crossings of a half plane, for lines drawn at random.  */
static void
winding_is_the_crossing_number (void **state)
{
  dice d = dice_new (5);
  long turned = 0;
  (void)state;
  for (int k = 0; k < 20000; k++)
    {
      bt_vec3 p[12];
      int n = 3 + dice_below (&d, 9), crossings = 0;
      for (int i = 0; i < n; i++)
        p[i] = dice_point (&d, 1);
      for (int i = 0; i < n; i++)
        {
          bt_vec3 a = p[i], b = p[(i + 1) % n];
          double x = a.x * b.y - a.y * b.x; /* the ray is +x */
          if ((a.y < 0) != (b.y < 0) && (b.y < 0) == (x < 0))
            crossings += b.y < 0 ? 1 : -1;
        }
      turned += crossings != 0;
      assert_int_equal (bt__winding (&pile, p, (uint32_t)n), crossings);
    }
  assert_true (turned > 2000);
}

static void
axes_of_obstacles (void **state)
{
  static stage g;
  bt__axis axis;
  (void)state;
  stage_capsule (&g, bt__vec (1, 2, 3), bt__vec (1, 6, 3), 0.1);
  stage_cylinder (&g, bt__vec (1, 2, 3), bt__vec (5, 2, 3), 0.1);
  stage_sphere (&g, bt__vec (1, 2, 3), 1);
  stage_box (&g, bt__vec (4, 5, 6), bt__vec (1, 1, 1));
  static const double along[4][3] = { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 }, { 0, 0, -1 } };
  for (int i = 0; i < 4; i++)
    {
      const double *w = along[i];
      assert_true (bt__axis_of (g.o + i, &axis));
      near ("along", bt__distance (axis.along, bt__vec (w[0], w[1], w[2])), 0, 1e-15);
    }
  near ("the box's middle", bt__distance (axis.at, bt__vec (4, 5, 6)), 0, 0);
  bt__obstacle bed = { .kind = BT__OBSTACLE_PLANE };
  assert_false (bt__axis_of (&bed, &axis));
}

/* ---- Linking ---- */

/* A torus curve: LONG times round, SHORT times through the hole.  */
static void
torus_curve (bt_vec3 p[N], int around, int through, double phase)
{
  for (int i = 0; i < N; i++)
    {
      double u = 2 * BT__PI * i / N, w = through * u + phase, r = 2 + 0.7 * cos (w);
      p[i] = bt__vec (r * cos (around * u), r * sin (around * u), 0.7 * sin (w));
    }
}

/* Half the solid angle of the triangle A, B, C seen from 0.  */
static double
half_angle (bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  double x = bt__norm (a), y = bt__norm (b), z = bt__norm (c);
  double volume = bt__dot (a, bt__cross (b, c));
  return atan2 (volume, x * y * z + bt__dot (a, b) * z + bt__dot (b, c) * x + bt__dot (c, a) * y);
}

/* Half the solid angle of the parallelogram of links A to B and C to D: their part of Gauss's
   integral.  */
static double
half_angle_of_links (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  bt_vec3 ca = bt__sub (c, a), cb = bt__sub (c, b), db = bt__sub (d, b), da = bt__sub (d, a);
  return half_angle (ca, cb, db) + half_angle (ca, db, da);
}

/* The linking number of the closed polylines P of N and Q of M points, which must not meet: Gauss's
   integral.  The differences between points of two straight links fill a parallelogram, whose solid
   angle is summed in two triangles (van Oosterom and Strackee 1983): tan (omega / 2) = a . (b x c)
   /
   (|a||b||c| + (a . b) |c| + (b . c) |a| + (c . a) |b|).  The sum over 4 pi is whole but for
   rounding; *OFF (may be NULL) is the distance to the whole number.  */
static int
linking (const bt_vec3 *p, uint32_t n, const bt_vec3 *q, uint32_t m, double *off)
{
  double sum = 0;
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < m; j++)
      sum += half_angle_of_links (p[i], p[(i + 1) % n], q[j], q[(j + 1) % m]);
  double lk = sum / (2 * BT__PI), whole = rint (lk);
  if (off)
    *off = fabs (lk - whole);
  return (int)whole;
}

static void
linking_is_whole (void **state)
{
  bt_vec3 p[N], q[N];
  double off;
  (void)state;
  for (int k = -5; k <= 5; k++)
    {
      torus_curve (p, 1, k, 0);
      torus_curve (q, 1, k, BT__PI);
      assert_int_equal (abs (linking (p, N, q, N, &off)), abs (k));
      near ("off", off, 0, 1e-11);
      int lk = linking (p, N, q, N, NULL);
      for (int i = 0; i < N; i++)
        q[i].z = -q[i].z, p[i].z = -p[i].z;
      assert_int_equal (linking (p, N, q, N, NULL), -lk);
      assert_int_equal (linking (q, N, p, N, NULL), -lk);
    }
}

/* A core circle against a curve that winds about it.  */
static void
linking_counts_the_core (void **state)
{
  bt_vec3 p[N], core[N];
  (void)state;
  for (int i = 0; i < N; i++)
    core[i] = bt__vec (2 * cos (2 * BT__PI * i / N), 2 * sin (2 * BT__PI * i / N), 0);
  for (int k = -4; k <= 4; k++)
    {
      torus_curve (p, 2, k, 0.1);
      assert_int_equal (abs (linking (p, N, core, N, NULL)), abs (k));
    }
}

/* Closed lines at random: whole to rounding, and the crossing number of a triangle's face.  */
static void
linking_of_random_lines (void **state)
{
  dice d = dice_new (8);
  long linked = 0;
  (void)state;
  for (int k = 0; k < 4000; k++)
    {
      bt_vec3 p[8], t[3], shift = dice_point (&d, 0.5);
      double off;
      int through = 0;
      for (int i = 0; i < 8; i++)
        p[i] = bt__add (shift, dice_point (&d, 1));
      for (int i = 0; i < 3; i++)
        t[i] = dice_point (&d, 1.5);
      for (int i = 0; i < 8; i++)
        {
          bt_vec3 a = p[i], b = p[(i + 1) % 8];
          int side = sweep_orient (t[0], t[1], t[2], a);
          int one = sweep_orient (a, b, t[0], t[1]);
          if (side != sweep_orient (t[0], t[1], t[2], b) && one == sweep_orient (a, b, t[1], t[2])
              && one == sweep_orient (a, b, t[2], t[0]))
            through += one;
        }
      linked += through != 0;
      assert_int_equal (abs (linking (p, 8, t, 3, &off)), abs (through));
      near ("off", off, 0, 1e-9);
    }
  assert_true (linked > 300);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (helix_turns_exactly),
                                      cmocka_unit_test (turns_go_with_the_axis),
                                      cmocka_unit_test (winding_is_of_the_closed_curve),
                                      cmocka_unit_test (winding_is_the_crossing_number),
                                      cmocka_unit_test (axes_of_obstacles),
                                      cmocka_unit_test (linking_is_whole),
                                      cmocka_unit_test (linking_counts_the_core),
                                      cmocka_unit_test (linking_of_random_lines) };
  return cmocka_run_group_tests_name ("aware turns", tests, NULL, NULL);
}
