/* The moving line: layers that stick and slip lose the area of a loop, and gain nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"

#define EI 1.0
#define STUCK 10.0
#define SLIPS 0.2                     /* 1/m */
#define MOST ((STUCK - EI) * (SLIPS)) /* N m: the moment of layers that slip */

static bt_tether_props
armoured (double slips)
{
  return (bt_tether_props){ .diameter = 0.01,
                            .mass = 0.1,
                            .ea = 1e7,
                            .ei = EI,
                            .ei_stuck = STUCK,
                            .slip_curvature = slips,
                            .cdn = 1.2,
                            .cdt = 0.01,
                            .ca = 1 };
}

/* ---- One bend ---- */

/* Two metres of line, of two intervals, bend between ends 2 HALF metres apart: the turn at its
   middle is 2 sqrt (1 - HALF^2).  */
static double
half_of_turn (double turn)
{
  return sqrt (1 - 0.25 * turn * turn);
}

static void
open_bend (scene *s, double slips, double turn)
{
  double half = half_of_turn (turn);
  bt_vec3 shape[3] = { { -half, 0, 0 }, { 0, 0, 0.5 * turn }, { half, 0, 0 } };
  bt_tether_props line = armoured (slips);
  line.ea = 1e9;
  scene_open (s, line, 0, 2, shape, 3, 2);
  s->in.tolerance = 1e-10;
}

/* Lead the turn of S from FROM to TO in COUNT steps of H seconds; return the work that took, J.  */
static double
bend (scene *s, double from, double to, int count, double h)
{
  double work = 0;
  long unsolved = s->unconverged;
  for (int i = 1; i <= count; i++)
    {
      double half = half_of_turn (from + (to - from) * i / count);
      bt_vec3 before[2] = { s->d->pull[0], s->d->pull[1] }, was[2], at[2];
      for (int k = 0; k < 2; k++)
        {
          at[k] = bt__vec (k ? half : -half, 0, 0);
          was[k] = s->in.end[k].at;
          s->in.end[k].at = at[k];
        }
      scene_step (s, h);
      for (int k = 0; k < 2; k++)
        work -= 0.5 * bt__dot (bt__add (before[k], s->d->pull[k]), bt__sub (at[k], was[k]));
    }
  assert_int_equal (s->unconverged, unsolved);
  return work;
}

/* Work over a closed loop of the turn from LOW to HIGH and back, once it repeats itself.  */
static double
loop (double slips, double low, double high, double h)
{
  scene s;
  open_bend (&s, slips, low);
  for (int i = 0; i < 20; i++) /* at rest, and what is left of the laying is gone */
    scene_step (&s, h);
  bend (&s, low, high, 400, h);
  bend (&s, high, low, 400, h);
  double work = bend (&s, low, high, 400, h);
  work += bend (&s, high, low, 400, h);
  scene_close (&s);
  return work;
}

/* A loop of the turn, which is the curvature by one metre of cell, loses twice the moment by what
   is left of the way to and fro when the layers have turned round; whatever its rate.  */
static void
test_loop_loses_its_area (void **state)
{
  const double low = 0.4, high = 1.2, area = 2 * MOST * (high - low - 2 * SLIPS);
  (void)state;
  assert_close (loop (SLIPS, low, high, 10), area, 2e-3 * area, "loss of a loop");
  assert_close (loop (SLIPS, low, high, 1000), area, 2e-3 * area, "the same a hundredth as fast");
}

/* A loop within the bound, and one of an elastic line, lose nothing.  */
static void
test_small_loop_loses_nothing (void **state)
{
  (void)state;
  assert_close (loop (SLIPS, 0.6, 0.6 + 1.9 * SLIPS, 10), 0, 1e-4 * MOST, "a loop that sticks");
  assert_close (loop (0, 0.4, 1.2, 10), 0, 1e-4 * MOST, "a loop of an elastic line");
}

/* The moment of a bend out of the straight is EI_stuck kappa while the layers stick, and rises by
   EI kappa once they slip.  */
static void
test_two_stiffnesses (void **state)
{
  scene s;
  (void)state;
  open_bend (&s, SLIPS, 0.02);
  bend (&s, 0.02, 0.1, 200, 10);
  double stuck = bt__dynamic_energies (&s.d[0], &s.in).bending;
  assert_close (stuck, 0.5 * STUCK * 0.1 * 0.1, 1e-3 * stuck, "energy of what sticks");
  bend (&s, 0.1, 0.5, 200, 10);
  double slid = bt__dynamic_energies (&s.d[0], &s.in).bending;
  assert_close (slid, 0.5 * EI * 0.25 + 0.5 * MOST * SLIPS, 1e-3 * slid, "energy of what slipped");
  scene_close (&s);
}

/* ---- Many bends ---- */

enum
{
  PARTS = 30
};

/* Three metres of LINE in an arc, in water of DENSITY that is clamped at its beginning.  */
static void
open_arc (scene *s, bt_tether_props line, double density, double radius)
{
  bt_vec3 shape[PARTS + 1];
  for (int i = 0; i <= PARTS; i++)
    {
      double angle = 3.0 / radius * i / PARTS;
      shape[i] = bt__vec (radius * sin (angle), 0, radius * (1 - cos (angle)));
    }
  scene_open (s, line, density, PARTS, shape, PARTS + 1, 3);
  s->in.end[0].clamped = 1;
  s->in.end[0].direction = bt__vec (1, 0, 0);
  s->in.end[1].free = 1;
}

/* The places of a line after it sprang for two seconds in water, to X.  */
static void
spring (bt_tether_props line, bt_vec3 *x)
{
  scene s;
  open_arc (&s, line, 1025, 2);
  s.in.tolerance = 1e-10;
  for (int i = 0; i < 120; i++)
    scene_step (&s, 1.0 / 60);
  memcpy (x, bt__dynamic_x (s.d), (PARTS + 1) * sizeof *x);
  scene_close (&s);
}

/* A line without width of its loop is the elastic line bit for bit; one that never slips is an
   elastic line as stiff as it is.  */
static void
test_limits_are_elastic (void **state)
{
  bt_vec3 elastic[PARTS + 1], is[PARTS + 1];
  bt_tether_props line = armoured (0), plain = line;
  (void)state;
  plain.ei_stuck = 0;
  spring (plain, elastic);
  spring (line, is);
  assert_memory_equal (is, elastic, sizeof is);
  line.ei_stuck = plain.ei_stuck = EI;
  line.slip_curvature = SLIPS;
  spring (line, is);
  assert_memory_equal (is, elastic, sizeof is);
  plain.ei = STUCK;
  plain.ei_stuck = 0;
  spring (plain, elastic);
  spring (armoured (1e6), is);
  for (int i = 0; i <= PARTS; i++)
    assert_close (bt__distance (is[i], elastic[i]), 0, 1e-6, "a line that sticks");
}

/* Set free in all but empty space, where nothing but its layers takes energy from it and nobody
   watches over it, a line gains none in any step, and hardly swings when an elastic one does.  */
static void
test_no_energy_is_gained (void **state)
{
  double left[2];
  (void)state;
  for (int k = 0; k < 2; k++)
    {
      scene s;
      open_arc (&s, armoured (k ? SLIPS : 0), 1e-9, 1);
      s.in.end[0] = s.in.end[1];
      scene_step (&s, 1e-3); /* its layers slip from the straight */
      double energy = scene_energy (&s), first = energy;
      for (int i = 0; i < 3000; i++)
        {
          scene_step (&s, 1e-3);
          double now = scene_energy (&s);
          if (k && now > energy + 1e-6 * first)
            fail_msg ("step %d: %.9g J after %.9g", i, now, energy);
          energy = now;
        }
      left[k] = bt__dynamic_energies (s.d, &s.in).kinetic / first;
      scene_close (&s);
    }
  if (!(left[1] < 0.1 * left[0]))
    fail_msg ("of its energy %.3g moves, of an elastic line's %.3g", left[1], left[0]);
}

/* A line that is bent, and turned as a whole in the plane of its bend, is as it was.  */
static void
test_turns_with_the_line (void **state)
{
  scene s;
  (void)state;
  open_arc (&s, armoured (SLIPS), 0, 2);
  bt_vec3 far = bt__dynamic_x (s.d)[PARTS];
  s.in.end[1].free = 0;
  s.in.end[1].at = far;
  for (int i = 0; i < 200; i++)
    scene_step (&s, 1);
  double before = bt__dynamic_energies (s.d, &s.in).bending;
  for (int i = 1; i <= 400; i++)
    {
      double a = 2 * BT__PI * i / 400, c = cos (a), b = sin (a);
      s.in.end[0].direction = bt__vec (c, 0, b);
      s.in.end[1].at = bt__vec (c * far.x - b * far.z, 0, b * far.x + c * far.z);
      scene_step (&s, 100);
    }
  assert_close (bt__dynamic_energies (s.d, &s.in).bending, before, 2e-3 * before,
                "energy of bends");
  scene_close (&s);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_loop_loses_its_area), cmocka_unit_test (test_small_loop_loses_nothing),
    cmocka_unit_test (test_two_stiffnesses),     cmocka_unit_test (test_limits_are_elastic),
    cmocka_unit_test (test_no_energy_is_gained), cmocka_unit_test (test_turns_with_the_line),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
