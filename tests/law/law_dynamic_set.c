/* The moving line: its set, a natural curvature.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_bent.h"

/* ---- Energy and forces ---- */

/* What bending pushes with at the start of a step is minus the gradient of its energy, of central
   differences; without clamps no force and no moment of all is left.  */
static void
test_force_is_the_gradient (void **state)
{
  (void)state;
  for (int trial = 0; trial < 24; trial++)
    {
      scene s;
      char what[32];
      snprintf (what, sizeof what, "trial %d", trial);
      open_crooked (&s, trial % 4, trial < 12 ? 1 : 0.2, 0, 3);
      assert_gradient (&s, trial % 4, what);
      scene_close (&s);
    }
}

/* ---- Shapes at rest ---- */

/* The radius of the circle through three points.  */
static double
radius_through (bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  bt_vec3 p = bt__sub (b, a), q = bt__sub (c, a);
  return bt__norm (p) * bt__norm (q) * bt__distance (b, c) / (2 * bt__norm (bt__cross (p, q)));
}

/* Without weight a constant set lies in a circle, one turn of which is as long as its
   circumference: the corners of a regular polygon of N sides, each turned by the natural angle.
   From a clamp the circle lies in the plane of the set, from a hinge in any.  */
static void
is_an_arc (int clamped, double plane)
{
  enum
  {
    N = 30
  };
  scene s;
  double length = 2, bend = 2 * BT__PI / length, corner = 2 * BT__PI / N;
  bt__dynamic_set set = { EVERYWHERE, { bend * cos (plane), bend * sin (plane) } };
  open_line (&s, N, length, 0.3, 0, &set, 1);
  s.in.end[0].clamped = clamped;
  s.in.end[0].direction = bt__vec (1, 0, 0);
  s.in.end[1].free = 1;
  scene_settle (&s);
  const bt_vec3 *x = bt__dynamic_x (s.d);
  double radius = length / N / (2 * sin (corner / 2));
  assert_close (radius_through (x[0], x[10], x[22]) / radius, 1, 1e-6, "radius of the arc");
  assert_close (bt__distance (x[0], x[N]), 0, 1e-5, "both ends");
  assert_true (bt__dynamic_energies (s.d, &s.in).bending < 1e-9);
  if (clamped) /* down turned to east by the shortest way: the first director stays north */
    {
      bt_vec3 at = bt__scale (1 / hypot (x[8].y, x[8].z), x[8]);
      assert_close (at.y, cos (plane), 1e-6, "plane, toward the first director");
      assert_close (at.z, sin (plane), 1e-6, "plane, toward the second");
    }
  scene_close (&s);
}

static void
test_constant_set_is_an_arc (void **state)
{
  (void)state;
  is_an_arc (0, 0.7);
  is_an_arc (1, 0);
  is_an_arc (1, 2.5);
}

/* A set whose plane turns by TAU along the line, against the frame that does not twist, is a helix
   of curvature K and torsion TAU: its radius is K / (K^2 + TAU^2).  */
static void
test_turning_set_is_a_helix (void **state)
{
  enum
  {
    PIECES = 80
  };
  scene s;
  bt__dynamic_set set[PIECES];
  double k = 5, tau = 3, length = 2;
  (void)state;
  for (int i = 0; i < PIECES; i++) /* from the far end on */
    {
      double piece = length / PIECES, angle = tau * (length - (i + 0.5) * piece);
      set[i]
          = (bt__dynamic_set){ i * piece, (i + 1) * piece, { k * cos (angle), k * sin (angle) } };
    }
  open_line (&s, PIECES, length, 0.3, 0, set, PIECES);
  s.in.end[1].free = 1;
  scene_settle (&s);
  const bt_vec3 *x = bt__dynamic_x (s.d);
  double pitch = 2 * BT__PI / sqrt (k * k + tau * tau); /* m of line in a turn */
  int turn = (int)lround (pitch / length * PIECES);
  double along = length * turn / PIECES, w = sqrt (k * k + tau * tau);
  double rise = tau / w * along, aside = 2 * k / (w * w) * fabs (sin (w * along / 2));
  for (int i = 5; i + turn < PIECES - 5; i += 10)
    assert_close (bt__distance (x[i], x[i + turn]), hypot (rise, aside), 2e-3,
                  "a turn of the helix");
  double half = length * (turn / 2) / PIECES;
  assert_close (bt__distance (x[20], x[20 + turn / 2]),
                hypot (tau / w * half, 2 * k / (w * w) * fabs (sin (w * half / 2))), 2e-3,
                "half a turn of the helix");
  scene_close (&s);
}

/* Pulled by T between hinges a set hardly shows: with q^2 = T / EI the bow is
   k / q^2 (1 - 1 / cosh (q L / 2)), for EI (y'' - k) vanishes at both ends.  */
static void
test_pulled_straight (void **state)
{
  (void)state;
  for (double pull = 2; pull < 100; pull *= 5)
    {
      scene s;
      double k = 0.05, length = 2, ei = 0.5, q = sqrt (pull / ei);
      bt__dynamic_set set = { EVERYWHERE, { 0, k } };
      open_line (&s, 80, length, ei, 0, &set, 1);
      s.in.end[1].free = 1;
      s.in.end[1].body.force = bt__vec (pull, 0, 0);
      scene_settle (&s);
      bt_vec3 middle = bt__dynamic_x (s.d)[40];
      assert_close (hypot (middle.y, middle.z) / (k / (q * q) * (1 - 1 / cosh (q * length / 2))), 1,
                    3e-3, "bow");
      scene_close (&s);
    }
}

/* ---- In motion ---- */

/* A line let go straight in vacuum curls up: it never has more energy than the set stored at first,
   and its length stays.  */
static void
test_no_energy_is_gained (void **state)
{
  scene s;
  (void)state;
  open_line (&s, 40, 2, 0.3, 0, three, 3);
  s.in.end[1].free = 1;
  double first = scene_energy (&s), fastest = 0;
  for (int i = 0; i < 480; i++)
    {
      scene_step (&s, 1.0 / 240);
      fastest = fmax (fastest, bt__dynamic_energies (s.d, &s.in).kinetic);
      assert_true (s.report.converged && scene_energy (&s) <= first * (1 + 1e-9));
    }
  for (int j = 0; j < 40; j++)
    assert_close (bt__dynamic_stretch (s.d)[j], 1, 1e-4, "stretch");
  assert_true (fastest > 0.1 * first);
  scene_close (&s);
}

/* What bends nothing changes nothing, to the last bit.  */
static void
test_none_is_none (void **state)
{
  static const bt__dynamic_set none = { EVERYWHERE, { 0, 0 } };
  bt_vec3 tip[2];
  (void)state;
  for (int k = 0; k < 2; k++)
    {
      scene s;
      open_line (&s, 30, 2, 0.3, 0, k ? &none : NULL, 0);
      s.line.wet_weight = 1;
      s.in.end[1].free = 1;
      for (int i = 0; i < 60; i++)
        scene_step (&s, 1.0 / 60);
      tip[k] = bt__dynamic_x (s.d)[30];
      scene_close (&s);
    }
  assert_memory_equal (tip, tip + 1, sizeof *tip);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_force_is_the_gradient),  cmocka_unit_test (test_constant_set_is_an_arc),
    cmocka_unit_test (test_turning_set_is_a_helix), cmocka_unit_test (test_pulled_straight),
    cmocka_unit_test (test_no_energy_is_gained),    cmocka_unit_test (test_none_is_none),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
