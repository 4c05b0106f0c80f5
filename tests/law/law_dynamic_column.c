/* The moving line: compression is carried by bending.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <gsl/gsl_sf_ellint.h>

#include "law/dynamic_scene.h"

#define LENGTH 10.0
#define STEP (1.0 / 60)

/* A line of N intervals and EI in vacuum, laid between pinned ends with a BOW.  */
static void
open_column (scene *s, int n, double ea, double ei, double bow)
{
  bt_vec3 *shape = calloc ((size_t)n + 1, sizeof *shape);
  assert_non_null (shape);
  for (int i = 0; i <= n; i++)
    shape[i] = bt__vec (LENGTH * i / n, 0, bow * sin (BT__PI * i / n));
  bt_tether_props line
      = { .diameter = 0.01, .mass = 0.1, .ea = ea, .ei = ei, .cdn = 1.2, .cdt = 0.01, .ca = 1 };
  scene_open (s, line, 0, n, shape, n + 1, LENGTH);
  free (shape);
}

/* Step S once by H, and take the motion out: backward Euler goes to rest.  */
static void
still_step (scene *s, double h)
{
  scene_step (s, h);
  bt__dynamic_still (s->d);
}

/* Take the far end of S to SPAN, and let the column come to rest.  */
static void
press (scene *s, double span)
{
  double period = sqrt (s->line.mass / s->line.ei) * LENGTH * LENGTH / BT__PI, from = LENGTH;
  for (int k = 1; k <= 200; k++)
    {
      s->in.end[1].at.x = from + (span - from) * k / 200;
      still_step (s, 0.3 * period);
    }
  for (int k = 0; k < 200; k++)
    still_step (s, 3 * period);
}

/* ---- The elastica ---- */

/* A pinned column that has turned by ALPHA at its ends: with p = sin (ALPHA / 2), its load is
   EI (2 K / L)^2, its span L (2 E / K - 1), its rise L p / K (Timoshenko and Gere, Theory of
   Elastic Stability, 2nd edition 1961, section 2.7).  Return by how much the load and the rise are
   off.  */
static void
miss_elastica (int n, double ei, double alpha, double *load, double *rise)
{
  scene s;
  double p = sin (alpha / 2), k = gsl_sf_ellint_Kcomp (p, GSL_PREC_DOUBLE),
         e = gsl_sf_ellint_Ecomp (p, GSL_PREC_DOUBLE);
  double wanted = ei * 4 * k * k / (LENGTH * LENGTH);
  open_column (&s, n, 1e8, ei, 0.05);
  press (&s, LENGTH * (2 * e / k - 1));
  bt_vec3 middle = bt__dynamic_x (s.d)[n / 2];
  *load = -s.d->pull[0].x / wanted - 1;
  *rise = hypot (middle.y, middle.z) / (LENGTH * p / k) - 1;
  assert_close (s.d->pull[0].x + s.d->pull[1].x, 0, 1e-3 * wanted, "sum of both pulls");
  scene_close (&s);
}

static void
test_elastica_of_a_column (void **state)
{
  static const double degrees[] = { 10, 40, 80, 120 };
  (void)state;
  for (int k = 0; k < 4; k++)
    for (double ei = 0.01; ei < 200; ei *= 100)
      {
        double load[2], rise[2];
        for (int fine = 0; fine < 2; fine++)
          miss_elastica (fine ? 80 : 40, ei, degrees[k] * BT__PI / 180, load + fine, rise + fine);
        print_message ("# %g degrees, EI %g: load off by %.1e and %.1e, rise by %.1e and %.1e\n",
                       degrees[k], ei, load[0], load[1], rise[0], rise[1]);
        assert_true (fabs (load[0]) < 6e-3 && fabs (rise[0]) < 2e-3);
        assert_true (fabs (load[1]) < 0.3 * fabs (load[0]));
        assert_true (fabs (rise[1]) < 0.3 * fabs (rise[0]) + 1e-5);
      }
}

/* ---- Buckling ---- */

/* Euler's load of a column is C EI (pi / L)^2, C 1 between pins, 2.04575 with one clamp, 4 with
   two. Pressed by less the column stays straight and bears all; pressed by more it bears the load
   of Euler, for the rest goes into its bow.  */
static void
test_load_of_euler (void **state)
{
  static const double c[] = { 1, 2.04575, 4 };
  (void)state;
  for (int clamps = 0; clamps < 3; clamps++)
    for (double ei = 0.01; ei < 200; ei *= 100)
      for (int more = 0; more < 2; more++)
        {
          scene s;
          int n = 80;
          double ea = 1e4 * ei, load = c[clamps] * ei * BT__PI * BT__PI / (LENGTH * LENGTH);
          open_column (&s, n, ea, ei, 1e-4);
          for (int k = 0; k < clamps; k++)
            {
              s.in.end[k].clamped = 1;
              s.in.end[k].direction = bt__vec (1, 0, 0);
            }
          press (&s, LENGTH * (1 - (more ? 2 : 0.9) * load / ea));
          double bow = hypot (bt__dynamic_x (s.d)[n / 2].y, bt__dynamic_x (s.d)[n / 2].z);
          assert_close (-s.d->pull[0].x / load, more ? 1 : 0.9, 2e-3, "load of Euler");
          assert_true (more ? bow > 1e-3 : bow < 1e-4);
          scene_close (&s);
        }
}

/* A line that lies straight to the last bit buckles too.  */
static void
test_straight_line_buckles (void **state)
{
  (void)state;
  scene s;
  open_column (&s, 40, 1e8, 1, 0);
  press (&s, 0.9 * LENGTH);
  bt_vec3 middle = bt__dynamic_x (s.d)[20];
  assert_close (-s.d->pull[0].x, 0.1038, 2e-4, "load");
  assert_close (hypot (middle.y, middle.z), 1.9499, 2e-3, "rise");
  scene_close (&s);
}

/* ---- The length is kept ---- */

static double
chords_of (const scene *s)
{
  double sum = 0;
  for (int j = 0; j < s->d->n; j++)
    sum += bt__distance (bt__dynamic_x (s->d)[j], bt__dynamic_x (s->d)[j + 1]);
  return sum;
}

enum
{
  PIECES = 60
};

/* Points of equal distance on a circular arc of LENGTH between ends SPAN apart.  */
static void
lay_arc (double length, double span, bt_vec3 *shape)
{
  double low = 0, high = BT__PI; /* half the angle of the arc: sin (a) / a = span / length */
  for (int k = 0; k < 60; k++)
    {
      double a = 0.5 * (low + high);
      *(sin (a) / a > span / length ? &low : &high) = a;
    }
  double radius = length / (2 * low);
  for (int i = 0; i <= PIECES; i++)
    {
      double a = low * (2.0 * i / PIECES - 1);
      shape[i] = bt__vec (0.5 * span + radius * sin (a), radius * (cos (a) - cos (low)), 0);
    }
}

/* Off 25 m of a LINE in a bow between ends 24.9 m apart a vehicle backs 8 m, gently, and stands for
   half a minute.  Return by how much of its length the line was longer or shorter at most.  */
static double
back_off (bt_tether_props line, scene *s)
{
  bt_vec3 shape[PIECES + 1];
  double worst = 0, time = 20;
  lay_arc (25, 24.9, shape);
  double length = PIECES * bt__distance (shape[0], shape[1]);
  scene_open (s, line, 1025, PIECES, shape, PIECES + 1, length);
  for (int k = 1; k < 50 / STEP; k++)
    {
      double u = fmin (k * STEP / time, 1);
      s->in.end[1].at.x = 24.9 - 8 * u * u * (3 - 2 * u);
      scene_step (s, STEP);
      worst = fmax (worst, fabs (chords_of (s) / length - 1));
    }
  return worst;
}

/* Within 1e-4 whatever the stiffness; neutral and heavy.  */
static void
test_length_is_kept (void **state)
{
  (void)state;
  double most = 0;
  for (int heavy = 0; heavy < 2; heavy++)
    for (double ei = 1e-6; ei < 2e3; ei *= 100)
      {
        scene s;
        bt_tether_props line = { .diameter = 0.01,
                                 .mass = 0.1,
                                 .wet_weight = heavy * 0.5,
                                 .ea = 2e5 * fmax (1, ei),
                                 .ei = ei,
                                 .cdn = 1.2,
                                 .cdt = 0.01,
                                 .ca = 1 };
        double off = back_off (line, &s);
        if (!(off < 1e-4))
          fail_msg ("EI %g: the length was off by %g of it", ei, off);
        most = fmax (most, off);
        assert_true (s.unconverged <= 2);
        scene_close (&s);
      }
  print_message ("# the length was off by %.1e of it at most\n", most);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_elastica_of_a_column),
    cmocka_unit_test (test_load_of_euler),
    cmocka_unit_test (test_straight_line_buckles),
    cmocka_unit_test (test_length_is_kept),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
