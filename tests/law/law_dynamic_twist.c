/* The moving line: its twist.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_bent.h"
#include "tether/dynamic_frame.h"

/* Turn the grip on node n of S, which lies along x, to ANGLE.  */
static void
turn_grip (scene *s, double angle)
{
  s->in.end[1].side = bt__vec (0, cos (angle), sin (angle));
}

/* Clamp both ends of S along x.  */
static void
clamp (scene *s)
{
  for (int k = 0; k < 2; k++)
    {
      s->in.end[k].clamped = 1;
      s->in.end[k].direction = bt__vec (1, 0, 0);
      s->in.end[k].side = bt__vec (0, 1, 0);
    }
}

/* Turn the grip from FROM to TO in COUNT steps of H seconds.  */
static void
twist (scene *s, double from, double to, int count, double h)
{
  for (int i = 1; i <= count; i++)
    {
      turn_grip (s, from + (to - from) * i / count);
      scene_step (s, h);
    }
}

/* ---- Energy, forces, torques ---- */

/* With any clamps, with sets and without, the force is the exact gradient, and the torque of the
   grip is the derivative of the energy by its angle.  */
static void
test_force_is_the_gradient (void **state)
{
  (void)state;
  for (int trial = 0; trial < 32; trial++)
    {
      scene s;
      char what[32];
      int clamps = trial % 8 < 2 ? 3 : trial % 4, sets = trial % 8 == 1 ? 0 : 3;
      double gj = trial % 3 == 0 ? 0.05 : trial % 3 == 1 ? 0.5 : 20;
      snprintf (what, sizeof what, "trial %d", trial);
      open_crooked (&s, clamps, trial < 16 ? 1 : 0.2, gj, sets);
      prepared_energy (&s);
      s.d->gripped = clamps == 3;
      s.d->grip = 0.7;
      s.d->twist = clamps == 3 ? 4 * thrown () : 0;
      assert_gradient (&s, clamps, what);
      scene_close (&s);
    }
}

static void
test_torque_is_the_derivative (void **state)
{
  (void)state;
  for (int trial = 0; trial < 8; trial++)
    {
      scene s;
      double h = 1e-4, energy[2];
      open_crooked (&s, 3, 0.5, 0.4, trial % 2 ? 3 : 0);
      prepared_energy (&s);
      s.d->gripped = 1;
      s.d->twist = 3 * thrown ();
      s.d->grip = 0.3;
      prepared_energy (&s);
      bt__frame_line l = { .in = &s.in, .x = s.work->x, .n = BENT, .link = s.work->link };
      double torque = bt__dynamic_twist (s.work, &l);
      for (int k = 0; k < 2; k++)
        {
          s.d->grip += k ? 2 * h : -h;
          energy[k] = prepared_energy (&s);
        }
      double slope = (energy[0] - energy[1]) / (2 * h);
      assert_close (torque, slope, 1e-6 * (1 + fabs (slope)), "torque of the grip");
      scene_close (&s);
    }
}

/* A straight line turned at its end by whole turns has the torque GJ Theta / L at both ends, and
   stores GJ Theta^2 / (2 L); turned back it has none.  */
static void
test_straight_line (void **state)
{
  scene s;
  double gj = 0.3, length = 2, full = 6 * BT__PI;
  (void)state;
  open_line (&s, 20, length, 50, gj, NULL, 0);
  clamp (&s);
  scene_step (&s, 0.1);
  twist (&s, 0, full, 30, 0.1);
  for (int k = 0; k < 2; k++)
    assert_close (s.d->torque[k], gj * full / length, 1e-9, "torque at an end");
  assert_close (s.d->twist, full, 1e-9, "twist");
  assert_close (bt__dynamic_energies (s.d, &s.in).bending, 0.5 * gj * full * full / length, 1e-6,
                "energy");
  twist (&s, full, 0, 30, 0.1);
  assert_close (s.d->torque[1], 0, 1e-9, "torque when turned back");
  scene_close (&s);
}

/* An arc of curvature K with as much set in it holds the directors of its material as gravity holds
   a pendulum: GJ theta'' = EI K^2 sin theta.  The small angle A of a grip falls as a hyperbolic
   sine of s / sqrt (GJ / EI) K; there is more torque at the grip that turns than at the one that
   does not.  */
static void
test_set_holds_directors (void **state)
{
  enum
  {
    N = 200
  };
  scene s;
  bt_vec3 shape[N + 1];
  double length = 2, k = 1.5, ei = 0.4, gj = 0.3, a = 0.01, rate = k * sqrt (ei / gj);
  bt__dynamic_set set = { EVERYWHERE, { k, 0 } };
  (void)state;
  for (int i = 0; i <= N; i++)
    shape[i] = bt__vec (sin (k * length * i / N) / k, (1 - cos (k * length * i / N)) / k, 0);
  bt_tether_props line = { .diameter = 0.01, .mass = 0.1, .ea = 1e6, .ei = ei, .gj = gj };
  scene_open (&s, line, 0, N, shape, N + 1, length);
  s.in.sets = &set;
  s.in.n_sets = 1;
  clamp (&s);
  bt_vec3 t = { cos (k * length), sin (k * length), 0 }, up = { 0, 0, 1 }, in = bt__cross (up, t);
  s.in.end[1].direction = t;
  s.in.end[1].side = in;
  scene_step (&s, 1e-6);
  assert_close (s.d->torque[1], 0, 1e-9, "torque of a line as it is set");
  s.in.end[1].side = bt__axpy (bt__scale (cos (a), in), sin (a), up);
  scene_step (&s, 1e-6);
  assert_close (s.d->torque[1], gj * a * rate / tanh (rate * length), 1e-3 * gj * a, "at the grip");
  assert_close (s.d->torque[0], gj * a * rate / sinh (rate * length), 1e-3 * gj * a, "far from it");
  scene_close (&s);
}

/* ---- Shapes ---- */

/* By how much P and R, a half of L / (2 EI) by Q +- sqrt (Q^2 - 4 EI T), miss the condition of
   buckling of a line clamped at both ends: w'''' - i Q/EI w''' - T/EI w'' = 0, w and w' zero at
   both ends.  */
static double
off_buckling (double torque, double tension, double ei, double length)
{
  double root = sqrt (torque * torque - 4 * ei * tension), by = length / (4 * ei);
  double p = by * (torque + root), r = by * (torque - root);
  return p * r * sin (p - r) - (p - r) * sin (p) * sin (r);
}

/* The least torque, N m, at which it buckles.  */
static double
buckling_torque (double tension, double ei, double length)
{
  double least = 2 * sqrt (ei * tension) * (1 + 1e-6), step = 1e-4 * ei / length;
  double q = least, begun = off_buckling (q, tension, ei, length);
  while (off_buckling (q, tension, ei, length) * begun > 0)
    q += step;
  return q;
}

/* The greatest distance from the x axis after a line of tension T twisted to SHARE of the torque at
   which it buckles was left for a while.  */
static double
gone_aside (double tension, double share)
{
  scene s;
  double length = 2, ei = 0.5, gj = 0.4, most = 0;
  double angle = share * buckling_torque (tension, ei, length) * length / gj;
  open_line (&s, 40, length, ei, gj, NULL, 0);
  s.in.tolerance = 1e-9;
  clamp (&s);
  s.in.end[1].at.x = length * (1 + tension / s.line.ea);
  scene_step (&s, 0.1);
  twist (&s, 0, angle, 40, 0.1);
  for (int i = 0; i < 200; i++)
    scene_step (&s, 0.5);
  for (int i = 0; i <= 40; i++)
    most = fmax (most, hypot (bt__dynamic_x (s.d)[i].y, bt__dynamic_x (s.d)[i].z));
  scene_close (&s);
  return most;
}

/* Greenhill's buckling, of clamped ends: without tension Q L = 8.9868 EI, with much of it a little
   more than 2 sqrt (EI T).  */
static void
test_buckling (void **state)
{
  (void)state;
  assert_close (buckling_torque (1e-6, 1, 1), 8.9868, 2e-3, "closed form");
  for (double tension = 0.1; tension < 50; tension *= 10)
    {
      double below = gone_aside (tension, 0.96), above = gone_aside (tension, 1.04);
      if (!(below < 1e-6))
        fail_msg ("%g N: %g m aside below the load", tension, below);
      if (!(above > 1e-4))
        fail_msg ("%g N: %g m aside above the load", tension, above);
    }
}

/* The writhe, in turns, of the polygon of N + 1 points X that goes on straight for ever at both
   ends: Gauss' integral over all pairs of its sides (K. Klenin and J. Langowski, Biopolymers 54,
   2000, method 1a).  */
static double
solid_angle (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  bt_vec3 r[4] = { bt__sub (c, a), bt__sub (d, a), bt__sub (d, b), bt__sub (c, b) }, n[4];
  bt_vec3 none = { 0, 0, 0 };
  double sum = 0;
  for (int i = 0; i < 4; i++)
    n[i] = bt__unit_or (bt__cross (r[i], r[(i + 1) % 4]), none);
  for (int i = 0; i < 4; i++)
    sum += asin (fmin (fmax (bt__dot (n[i], n[(i + 1) % 4]), -1), 1));
  double side = bt__dot (bt__cross (bt__sub (d, c), bt__sub (b, a)), r[0]);
  return side > 0 ? sum : -sum;
}

static double
writhe (const bt_vec3 *x, int n)
{
  bt_vec3 p[64];
  double sum = 0, tail = 1e5;
  p[0] = bt__sub (x[0], bt__vec (tail, 0, 0));
  memcpy (p + 1, x, (size_t)(n + 1) * sizeof *x);
  p[n + 2] = bt__add (x[n], bt__vec (tail, 0, 0));
  for (int i = 0; i < n + 2; i++)
    for (int j = 0; j < i - 1; j++)
      sum += solid_angle (p[i], p[i + 1], p[j], p[j + 1]);
  return sum / (2 * BT__PI);
}

/* A twisted line whose ends come nearer throws a loop: it twists by as much less as it writhes
   more.  */
static void
test_link_is_kept (void **state)
{
  enum
  {
    N = 40
  };
  scene s;
  double turns = 1.5, length = 2;
  (void)state;
  open_line (&s, N, length, 0.5, 0.5, NULL, 0);
  clamp (&s);
  scene_step (&s, 0.1);
  twist (&s, 0, 2 * BT__PI * turns, 20, 0.1);
  for (int i = 1; i <= 200; i++)
    {
      s.in.end[1].at.x = length * (1 - 0.4 * i / 200);
      scene_step (&s, 0.5);
    }
  const bt_vec3 *x = bt__dynamic_x (s.d);
  double is = s.d->twist / (2 * BT__PI), w = writhe (x, N);
  assert_true (w > 0.3);
  assert_close (is + w, turns, 1e-4, "link");
  scene_close (&s);
}

/* ---- In motion ---- */

/* A line let go from a twist in vacuum has no more energy than it had, though it swings.  */
static void
test_no_energy_is_gained (void **state)
{
  (void)state;
  for (int sets = 0; sets <= 3; sets += 3)
    {
      scene s;
      double fastest = 0;
      open_line (&s, 40, 2, 0.3, 0.3, three, sets);
      clamp (&s);
      s.in.end[1].at.x = 1.9;
      scene_step (&s, 1.0 / 240);
      twist (&s, 0, 5 * BT__PI, 40, 1.0 / 240);
      scene_step (&s, 1.0 / 240);
      double first = scene_energy (&s);
      for (int i = 0; i < 480; i++)
        {
          scene_step (&s, 1.0 / 240);
          fastest = fmax (fastest, bt__dynamic_energies (s.d, &s.in).kinetic);
          if (!(scene_energy (&s) <= first * (1 + 1e-9)))
            fail_msg ("%d sets, step %d: %.12g J of %.12g", sets, i, scene_energy (&s), first);
        }
      assert_true (fastest > 1e-3 * first);
      scene_close (&s);
    }
}

/* A line that hangs between clamps in a plane, and its places after a while, to X.  */
static void
swing (double gj, double angle, double mirror, bt_vec3 *x, double *torque)
{
  enum
  {
    N = 30
  };
  scene s;
  bt_vec3 shape[N + 1];
  bt_tether_props line = { .diameter = 0.01,
                           .mass = 0.1,
                           .wet_weight = 0.2,
                           .ea = 1e6,
                           .ei = 0.2,
                           .gj = gj,
                           .cdn = 1.2,
                           .cdt = 0.1,
                           .ca = 1 };
  for (int i = 0; i <= N; i++) /* chords as long as the line: nothing is crumpled */
    shape[i] = bt__vec (sin (2.0 * i / N - 1), 0, -cos (2.0 * i / N - 1));
  scene_open (&s, line, 1025, N, shape, N + 1, 2 * sin (1.0 / N) * N);
  clamp (&s);
  s.in.end[0].direction = bt__vec (cos (1), 0, -sin (1));
  s.in.end[1].direction = bt__vec (cos (1), 0, sin (1));
  s.in.tolerance = 1e-11;
  scene_step (&s, 1.0 / 60);
  for (int i = 1; i <= 120; i++)
    {
      double t = i / 120.0;
      s.in.end[1].at
          = bt__add (shape[N], bt__vec (-0.4 * t, angle != 0 ? mirror * 0.3 * t : 0, 0.2 * t));
      turn_grip (&s, mirror * angle * t);
      scene_step (&s, 1.0 / 60);
    }
  memcpy (x, bt__dynamic_x (s.d), (N + 1) * sizeof *x);
  *torque = s.d->torque[1];
  scene_close (&s);
}

/* In a plane nothing twists, and the motion is that of a line without torsional stiffness; mirrored
   in the plane, a line moves as its mirror image, twisted the other way.  */
static void
test_planar_and_mirrored (void **state)
{
  bt_vec3 limp[31], is[31], image[31];
  double none, torque, other;
  (void)state;
  swing (0, 0, 1, limp, &none);
  swing (0.3, 0, 1, is, &torque);
  assert_close (torque, 0, 1e-9, "torque in a plane");
  for (int i = 0; i <= 30; i++)
    assert_close (bt__distance (is[i], limp[i]), 0, 1e-7, "place in a plane");
  swing (0.3, 4, 1, is, &torque);
  swing (0.3, 4, -1, image, &other);
  assert_true (fabs (torque) > 0.1);
  assert_close (other, -torque, 1e-6, "torque of the mirror image");
  for (int i = 0; i <= 30; i++)
    {
      assert_close (image[i].x, is[i].x, 1e-6, "x of the mirror image");
      assert_close (image[i].y, -is[i].y, 1e-6, "y of the mirror image");
    }
}

/* What is not clamped at both ends, and has no set, is not twisted: its bits are those without GJ.
   With a set, ever more GJ is a line that does not twist.  */
static void
test_limits (void **state)
{
  bt_vec3 tip[3];
  double off[2];
  (void)state;
  for (int k = 0; k < 2; k++)
    {
      scene s;
      open_line (&s, 30, 2, 0.3, k ? 0.5 : 0, NULL, 0);
      s.line.wet_weight = 1;
      clamp (&s);
      s.in.end[1] = (bt__dynamic_end){ .free = 1 };
      for (int i = 0; i < 60; i++)
        scene_step (&s, 1.0 / 60);
      tip[k] = bt__dynamic_x (s.d)[30];
      scene_close (&s);
    }
  assert_memory_equal (tip, tip + 1, sizeof *tip);
  for (int k = 0; k < 3; k++)
    {
      scene s;
      open_line (&s, 40, 2, 0.3, k == 0 ? 0 : k == 1 ? 100 : 1000, three, 3);
      s.line.wet_weight = 0.3;
      clamp (&s);
      s.in.end[1] = (bt__dynamic_end){ .free = 1 };
      scene_settle (&s);
      tip[k] = bt__dynamic_x (s.d)[40];
      scene_close (&s);
    }
  for (int k = 0; k < 2; k++)
    off[k] = bt__distance (tip[0], tip[k + 1]);
  assert_true (off[0] > 1e-4 && off[0] < 0.01 && off[1] < 0.3 * off[0]);
}

/* A workspace that a line was twisted in steps a line without torsion as a new one does.  */
static void
test_workspace_keeps_nothing (void **state)
{
  (void)state;
  scene twisted, plain[2];
  open_line (&twisted, 20, 2, 0.7, 0.3, three, 3);
  clamp (&twisted);
  scene_step (&twisted, 0.1);
  twist (&twisted, 0, 6, 3, 0.1);
  for (int k = 0; k < 2; k++)
    {
      open_line (&plain[k], 20, 2, 0, 0.3, NULL, 0);
      clamp (&plain[k]);
      turn_grip (&plain[k], 0.5);
    }
  bt__dynamic_work *own = plain[1].work;
  plain[1].work = twisted.work;
  for (int i = 0; i < 3; i++)
    {
      scene_step (&plain[0], 0.1);
      scene_step (&plain[1], 0.1);
      assert_memory_equal (plain[0].d, plain[1].d, bt__dynamic_size ((int)plain[0].d->n_max));
    }
  plain[1].work = own;
  scene_close (&plain[0]);
  scene_close (&plain[1]);
  scene_close (&twisted);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_force_is_the_gradient),
    cmocka_unit_test (test_torque_is_the_derivative),
    cmocka_unit_test (test_straight_line),
    cmocka_unit_test (test_set_holds_directors),
    cmocka_unit_test (test_buckling),
    cmocka_unit_test (test_link_is_kept),
    cmocka_unit_test (test_no_energy_is_gained),
    cmocka_unit_test (test_planar_and_mirrored),
    cmocka_unit_test (test_limits),
    cmocka_unit_test (test_workspace_keeps_nothing),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
