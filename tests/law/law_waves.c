/* Waves obey the linear theory they are made of, and a sea has the spectrum it was asked for.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <fenv.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <bight/water.h>

#include "clones.h"
#include "math/vec.h"
#include "sea/waves_line.h"
#include "sea/waves_series.h"
#include "sea/waves_sum.h"

#define G 9.80665

static void
assert_close (double value, double expected, double tolerance, const char *what)
{
  if (!(fabs (value - expected) <= tolerance))
    fail_msg ("%s: %.12g is not %.12g within %g", what, value, expected, tolerance);
}

static bt_waves
waves_of (bt_wave_def def, double depth)
{
  bt_waves w;
  bt_error error = { BT_OK, "" };
  if (bt_waves_make (&def, depth, G, &w, &error) != BT_OK)
    fail_msg ("%s", error.text);
  return w;
}

static bt_waves
airy (double height, double period, double depth)
{
  return waves_of ((bt_wave_def){ BT_WAVE_AIRY, height, period, 0.7, 0.3, 0, 0, 0, 0 }, depth);
}

static bt_waves
jonswap (double height, double period, int seed)
{
  bt_wave_def def = { BT_WAVE_JONSWAP, height, period, 1.2, 0, 3.3, 64, seed, 0 };
  return waves_of (def, 60);
}

/* omega2 = g k tanh (k d) to the last digits, from ripples in deep water to tides in puddles; deep
   k = omega2/g, shallow k = omega / sqrt (g d).  */
static void
test_dispersion (void **state)
{
  (void)state;
  for (double depth = 0.01; depth < 2e4; depth *= 3)
    for (double omega = 1e-4; omega < 20; omega *= 1.7)
      {
        double k = bt_wave_number (omega, depth, G);
        assert_close (G * k * tanh (k * depth) / (omega * omega), 1, 1e-12, "dispersion");
      }
  assert_close (bt_wave_number (2, 1000, G) * G / 4, 1, 1e-14, "deep");
  assert_close (bt_wave_number (1e-4, 10, G) * sqrt (G * 10) / 1e-4, 1, 1e-6, "shallow");
}

/* The velocity has no divergence and no curl, meets the bottom level, moves the surface, and the
   acceleration is its rate.  */
static void
test_flow (void **state)
{
  (void)state;
  bt_waves seas[3] = { airy (2, 8, 15), airy (0.3, 3, 100), jonswap (3, 9, 5) };
  double e = 1e-4, t = 17.3;
  for (int i = 0; i < 3; i++)
    for (double z = -1; z > -14; z -= 2.5)
      {
        const bt_waves *w = &seas[i];
        bt_vec3 p = bt__vec (3, -5, z), d[3][2], now, a, later;
        for (int k = 0; k < 3; k++)
          for (int s = 0; s < 2; s++)
            {
              bt_vec3 way = bt__vec (k == 0, k == 1, k == 2);
              bt_waves_motion (w, bt__axpy (p, s ? e : -e, way), t, &d[k][s], NULL);
            }
        double div = d[0][1].x - d[0][0].x + d[1][1].y - d[1][0].y + d[2][1].z - d[2][0].z;
        double curl = d[1][1].z - d[1][0].z - d[2][1].y + d[2][0].y;
        assert_close (div / (2 * e), 0, 1e-7, "divergence");
        assert_close (curl / (2 * e), 0, 1e-7, "curl");
        bt_waves_motion (w, p, t - e, &now, NULL);
        bt_waves_motion (w, p, t + e, &later, NULL);
        bt_waves_motion (w, p, t, NULL, &a);
        bt_vec3 rate = bt__scale (0.5 / e, bt__sub (later, now));
        assert_close (bt__distance (rate, a), 0, 1e-7, "acceleration");
        bt_waves_motion (w, bt__vec (3, -5, -w->depth), t, &now, NULL);
        assert_close (now.z, 0, 1e-14, "bottom");
        bt_waves_motion (w, bt__vec (3, -5, 0), t, &now, NULL);
        double rise = bt_waves_elevation (w, 3, -5, t + e) - bt_waves_elevation (w, 3, -5, t - e);
        assert_close (rise / (2 * e), now.z, 1e-6, "surface");
      }
}

/* A 10 s wave of 10 m in deep water: k = w2/g, pi H/T = 3.1416 m/s at the surface, down by e^(k z).
 */
static void
test_deep_wave (void **state)
{
  (void)state;
  bt_waves w = airy (10, 10, 2000);
  double k = 4 * BT__PI * BT__PI / 100 / G;
  for (double z = 0; z > -100; z -= 9)
    for (double t = 0; t < 10; t += 0.7)
      {
        bt_vec3 v;
        bt_waves_motion (&w, bt__vec (50, 20, z), t, &v, NULL);
        assert_close (bt__norm (v), BT__PI * exp (k * z), 1e-9, "speed");
      }
  assert_close (bt_waves_elevation (&w, 0, 0, 0), 5 * cos (0.3), 1e-12, "phase");
  /* It travels toward its bearing at omega / k.  */
  double c = 2 * BT__PI / 10 / k, t = 3;
  assert_close (bt_waves_elevation (&w, c * t * sin (0.7), c * t * cos (0.7), t), 5 * cos (0.3),
                1e-9, "celerity");
}

/* What the textbook says of component I at P and T.  */
static void
textbook (const bt_waves *w, int i, bt_vec3 p, double t, bt_vec3 *v, bt_vec3 *a)
{
  long double k = w->k[i], d = w->depth, omega = w->omega[i];
  long double theta = k * (w->east * p.x + w->north * p.y) - omega * t + w->phase[i];
  long double size = w->amplitude[i] * omega / sinhl (k * d);
  double level = (double)(size * coshl (k * (p.z + d)) * cosl (theta));
  double rise = (double)(size * sinhl (k * (p.z + d)) * sinl (theta));
  double level2 = (double)(omega * size * coshl (k * (p.z + d)) * sinl (theta));
  double rise2 = (double)(-omega * size * sinhl (k * (p.z + d)) * cosl (theta));
  *v = bt__vec (level * w->east, level * w->north, rise);
  *a = bt__vec (level2 * w->east, level2 * w->north, rise2);
}

/* The sum of components is that of the textbook at any depth and after any time; of those that are
   left out, where they are 1e-7 of themselves, within that.  Nothing is divided by zero for the
   components that fill up four.  */
static void
test_components (void **state)
{
  (void)state;
  bt_waves seas[4] = { airy (2, 8, 15), airy (0.1, 20, 0.5), airy (9, 9, 4000), jonswap (3, 9, 5) };
  for (int n = 0; n < 4; n++)
    for (double t = 0.3; t < 2e9; t *= 7)
      for (double at = 0; at <= 1; at += 0.04)
        {
          const bt_waves *w = &seas[n];
          bt_vec3 p = bt__vec (31 * at, 900 * at - 20, -at * w->depth), v, a;
          bt_vec3 sum = { 0, 0, 0 }, sum2 = { 0, 0, 0 };
          double tolerance = 0, tolerance2 = 0;
          for (int i = 0; i < w->n; i++)
            {
              double way = w->k[i] * 1000, turned = w->omega[i] * t;
              double most = w->speed[i] * exp (w->k[i] * p.z) * (1 + w->bed[i]);
              double lost = w->k[i] * -p.z < 16 ? 2e-15 + 5e-16 * (way > turned ? way : turned) : 1;
              textbook (w, i, p, t, &v, &a);
              sum = bt__add (sum, v);
              sum2 = bt__add (sum2, a);
              tolerance += 2 * most * lost;
              tolerance2 += 2 * most * lost * w->omega[i];
            }
          feclearexcept (FE_ALL_EXCEPT);
          bt_waves_motion (w, p, t, &v, &a);
          bt_waves_elevation (w, p.x, p.y, t);
          assert_false (fetestexcept (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW));
          assert_close (bt__distance (v, sum), 0, tolerance, "velocity");
          assert_close (bt__distance (a, sum2), 0, tolerance2, "acceleration");
        }
}

/* Each component is felt down to that depth, and no farther.  */
static void
test_felt (void **state)
{
  (void)state;
  bt_waves w = jonswap (3, 9, 5);
  w.depth = 4000;
  memset (w.bed, 0, sizeof w.bed);
  for (int i = 0; i < w.n; i++)
    {
      bt_waves less = w;
      less.amplitude[i] = less.speed[i] = 0;
      bt_vec3 all, rest, p = bt__vec (5, 5, -15.9 / w.k[i]);
      bt_waves_motion (&w, p, 3, &all, NULL);
      bt_waves_motion (&less, p, 3, &rest, NULL);
      assert_close (bt__distance (all, rest) / (w.speed[i] * exp (-15.9)), 1, 1e-6, "felt");
      p.z = -16.1 / w.k[i];
      bt_waves_motion (&w, p, 3, &all, NULL);
      bt_waves_motion (&less, p, 3, &rest, NULL);
      assert_true (bt__distance (all, rest) == 0);
    }
}

/* What is not finite is not hidden.  */
static void
test_not_finite (void **state)
{
  (void)state;
  bt_waves w = jonswap (3, 9, 5);
  w.depth = 4000;
  double bad[3] = { NAN, INFINITY, -INFINITY };
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 4; k++)
      {
        double at[4] = { 1, 2, -3, 4 };
        at[k] = bad[i];
        bt_vec3 v, a;
        bt_waves_motion (&w, bt__vec (at[0], at[1], at[2]), at[3], &v, &a);
        assert_false (bt__is_finite (v) || bt__is_finite (a));
        assert_true (k == 2 || isnan (bt_waves_elevation (&w, at[0], at[1], at[3])));
      }
}

static BT__HOT bt__orbit
orbit (const bt_waves *w, double way, double z, double t)
{
  return bt__waves_orbit (w, way, z, t);
}

static BT__HOT bt__orbit
surface (const bt_waves *w, double way, double t)
{
  return bt__waves_surface (w, way, t);
}

CLONES (bt__orbit, orbit, (const bt_waves *w, double way, double z, double t), (w, way, z, t))
CLONES (bt__orbit, surface, (const bt_waves *w, double way, double t), (w, way, t))

/* To the bit the same on every machine.  */
static void
test_clones (void **state)
{
  (void)state;
  bt_waves seas[3] = { airy (2, 8, 15), airy (9, 9, 4000), jonswap (3, 9, 5) };
  for (int n = 0; n < 3; n++)
    for (double t = 0; t < 5000; t += 1.7)
      {
        const bt_waves *w = &seas[n];
        double x = 37 * sin (t), y = 19 * cos (3 * t), z = -fabs (14 * sin (11 * t));
        double way = w->east * x + w->north * y;
        bt__orbit o = orbit_default (w, way, z, t), s = surface_default (w, way, t);
        for (int c = 1; c < N_CLONES; c++)
          if (clone_runs (c))
            {
              bt__orbit p = orbit_clones[c](w, way, z, t), q = surface_clones[c](w, way, t);
              assert_memory_equal (&o, &p, sizeof o);
              assert_memory_equal (&s, &q, sizeof s);
            }
        bt_vec3 v;
        bt_waves_motion (w, bt__vec (x, y, z), t, &v, NULL);
        assert_true (v.z == o.up && v.x == o.along * w->east);
        assert_true (bt_waves_elevation (w, x, y, t) == s.up);
      }
}

/* ---- Series ---- */

typedef struct shared
{
  double velocity, acceleration, height; /* the largest error, by what the accuracy allows */
  int series, heights;                   /* places that differ at all from those asked alone */
} shared;

enum
{
  PLACES = 60
};

/* Places of a line in the sea W, which go on by STEP metres about a way that bends.  */
static void
places_along (const bt_waves *w, double step, int seed, bt_vec3 *p)
{
  double turn = seed;
  p[0] = bt__vec (300 * sin (7.0 * seed), 20 * cos (3.0 * seed),
                  0.5 - fabs (sin (seed)) * fmin (w->depth, 40));
  for (int i = 1; i < PLACES; i++)
    {
      turn += sin (i * 1.3 * seed) / 3;
      p[i] = bt__axpy (p[i - 1], step,
                       bt__vec (cos (turn), 0.5 * sin (turn), 0.5 * sin (1.7 * turn)));
    }
}

static void
compare_shared (const bt_waves *w, const bt_vec3 *p, double t, shared *worst)
{
  bt_vec3 v[PLACES], a[PLACES], v0, a0;
  double speed = 0, gain = 0, crest = 0, height[PLACES];
  for (int i = 0; i < w->n; i++)
    {
      crest += w->amplitude[i];
      speed += w->speed[i];
      gain += w->speed[i] * w->omega[i];
    }
  bt_waves_motions (w, p, PLACES, t, v, a);
  bt__waves_elevations (w, p, PLACES, t, height);
  for (int i = 0; i < PLACES; i++)
    {
      bt_waves_motion (w, p[i], t, &v0, &a0);
      double off = bt__distance (v[i], v0), off2 = bt__distance (a[i], a0);
      double off0 = fabs (height[i] - bt_waves_elevation (w, p[i].x, p[i].y, t));
      worst->height = fmax (worst->height, off0 / (w->accuracy * crest));
      worst->heights += off0 > 0;
      worst->velocity = fmax (worst->velocity, off / (w->accuracy * speed));
      worst->acceleration = fmax (worst->acceleration, off2 / (w->accuracy * gain));
      worst->series += off > 0;
    }
}

/* Places that share a series are asked within the accuracy, in deep and shallow seas of any
   accuracy, on lines fine and coarse; and they do share.  */
static void
test_shared (void **state)
{
  (void)state;
  static const double accuracy[] = { 0.1, 1e-2, 1e-3, 1e-4, 1e-6 }, depth[] = { 2.5, 12, 60, 2000 };
  for (int n = 0; n < 5; n++)
    {
      shared worst = { 0 };
      for (int d = 0; d < 4; d++)
        for (int seed = 1; seed <= 24; seed++)
          {
            bt_wave_def def = { BT_WAVE_JONSWAP, seed % 3 ? 0.6 : 0.2, 3 + seed % 9, seed,       0,
                                1 + seed % 7,    5 + 2 * seed,         seed,         accuracy[n] };
            bt_waves w = waves_of (def, depth[d]);
            bt_vec3 p[PLACES];
            places_along (&w, pow (10, -2 + seed % 4), seed, p);
            compare_shared (&w, p, 1e3 * seed, &worst);
          }
      if (!(worst.velocity <= 1 && worst.acceleration <= 1 && worst.height <= 1))
        fail_msg ("accuracy %g: %g, %g and %g of it", accuracy[n], worst.velocity,
                  worst.acceleration, worst.height);
      assert_true (worst.velocity > 1e-3 && worst.acceleration > 1e-3 && worst.height > 1e-4);
      assert_true (worst.series > 96 * PLACES / 4 && worst.heights > 96 * PLACES / 4);
    }
}

/* To the bit as asked alone: without an accuracy, of few components, and where a place is alone. */
static void
test_exact (void **state)
{
  (void)state;
  bt_wave_def def = { BT_WAVE_JONSWAP, 1, 6, 1, 0, 3.3, 32, 5, 0 }, few = def, fine = def;
  few.components = 4;
  few.accuracy = fine.accuracy = 1e-3;
  bt_waves seas[3] = { waves_of (def, 30), waves_of (few, 30), waves_of (fine, 30) };
  for (int n = 0; n < 3; n++)
    {
      bt_vec3 p[PLACES], v[PLACES], a[PLACES], v0, a0;
      double height[PLACES];
      places_along (&seas[n], n < 2 ? 0.1 : 40, 3, p);
      bt_waves_motions (&seas[n], p, PLACES, 9, v, a);
      bt__waves_elevations (&seas[n], p, PLACES, 9, height);
      for (int i = 0; i < PLACES; i++)
        {
          assert_true (height[i] == bt_waves_elevation (&seas[n], p[i].x, p[i].y, 9));
          bt_waves_motion (&seas[n], p[i], 9, &v0, &a0);
          assert_memory_equal (&v0, &v[i], sizeof v0);
          assert_memory_equal (&a0, &a[i], sizeof a0);
        }
    }
  def.accuracy = 0.2;
  bt_error error;
  assert_int_equal (bt_waves_make (&def, 30, G, &seas[1], &error), BT_ERR_DOMAIN);
  def.accuracy = 1e-12;
  assert_int_equal (bt_waves_make (&def, 30, G, &seas[1], &error), BT_ERR_DOMAIN);
}

/* A place that is not finite is not hidden by those beside it, nor hides them.  */
static void
test_shared_not_finite (void **state)
{
  (void)state;
  bt_wave_def def = { BT_WAVE_JONSWAP, 1, 6, 1, 0, 3.3, 32, 5, 1e-3 };
  bt_waves w = waves_of (def, 30);
  double bad[3] = { NAN, INFINITY, -INFINITY };
  for (int n = 0; n < 9; n++)
    {
      bt_vec3 p[PLACES], v[PLACES], a[PLACES];
      double height[PLACES];
      places_along (&w, 0.1, 3, p);
      *(n / 3 == 0 ? &p[20].x : n / 3 == 1 ? &p[20].y : &p[20].z) = bad[n % 3];
      bt_waves_motions (&w, p, PLACES, 9, v, a);
      bt__waves_elevations (&w, p, PLACES, 9, height);
      for (int i = 0; i < PLACES; i++)
        {
          assert_true (bt__is_finite (v[i]) == (i != 20) && bt__is_finite (a[i]) == (i != 20));
          assert_true ((isfinite (height[i]) != 0) == (i != 20 || n / 3 == 2));
        }
      bt_waves_motions (&w, p, 1, NAN, v, a);
      assert_false (bt__is_finite (v[0]) || bt__is_finite (a[0]));
    }
}

static BT__HOT bt__orbit
series (const bt_waves *w, double way, double z, double t)
{
  bt__waves_centre at = { way - 0.3, z < -0.4 ? z + 0.2 : z, t, z - 1, fmin (0, z + 1), 9 };
  bt__waves_terms terms;
  bt__waves_series s;
  bt__waves_terms_find (w, &at, &terms);
  bt__waves_series_make (&terms, &s);
  return bt__waves_series_at (&s, z - at.z, way - at.way);
}

CLONES (bt__orbit, series, (const bt_waves *w, double way, double z, double t), (w, way, z, t))

/* Series, too, are to the bit the same on every machine.  */
static void
test_series_clones (void **state)
{
  (void)state;
  bt_wave_def def = { BT_WAVE_JONSWAP, 1, 8, 1, 0, 3.3, 31, 5, 1e-3 };
  bt_waves seas[2] = { waves_of (def, 12), waves_of (def, 3000) };
  for (int n = 0; n < 2; n++)
    for (double t = 0; t < 5000; t += 1.7)
      {
        double way = 37 * sin (t), z = -fabs (11 * sin (11 * t));
        bt__orbit o = series_default (&seas[n], way, z, t);
        for (int c = 1; c < N_CLONES; c++)
          if (clone_runs (c))
            {
              bt__orbit p = series_clones[c](&seas[n], way, z, t);
              assert_memory_equal (&o, &p, sizeof o);
            }
      }
}

/* 4 sqrt (m0) is the height exactly by the components; by three hours' record within its own
   sampling error, some 3 %.  The peak lies where it was asked for.  */
static void
test_sea (void **state)
{
  (void)state;
  for (int seed = 1; seed <= 5; seed++)
    {
      bt_waves w = jonswap (2.5, 8, seed);
      double m0 = 0, mean = 0, square = 0, up = 0, before = 0, n = 0;
      for (int i = 0; i < w.n; i++)
        {
          m0 += w.amplitude[i] * w.amplitude[i] / 2;
          assert_true (i == 0 || w.omega[i] >= w.omega[i - 1]);
        }
      assert_close (4 * sqrt (m0), 2.5, 1e-12, "height");
      for (double t = 0; t < 10800; t += 0.5, n++)
        {
          double eta = bt_waves_elevation (&w, 11, -3, t);
          mean += eta;
          square += eta * eta;
          up += before < 0 && eta >= 0;
          before = eta;
        }
      assert_close (4 * sqrt (square / n - mean / n * mean / n), 2.5, 0.03 * 2.5, "record");
      /* sqrt (m0/m2) of JONSWAP 3.3 cut at 0.5 and 4 times the peak frequency, integrated: 0.8013
         of the peak's period.  */
      assert_close (10800 / up / 8, 0.8013, 0.025, "zero crossings");
      double at_peak = 0;
      for (int i = 0; i < w.n; i++)
        at_peak += fabs (w.omega[i] * 8 / (2 * BT__PI) - 1) < 0.1;
      assert_true (at_peak / (double)w.n > 0.25);
    }
}

/* The seed tells seas apart, and nothing else does.  */
static void
test_seed (void **state)
{
  (void)state;
  bt_waves a = jonswap (2, 7, 3), b = jonswap (2, 7, 3), c = jonswap (2, 7, 4);
  assert_memory_equal (&a, &b, sizeof a);
  assert_true (memcmp (&a, &c, sizeof a) != 0);
}

/* What floats rides: its velocity is that of the water at rest's surface.  */
static void
test_rider (void **state)
{
  (void)state;
  bt_waves w = jonswap (2, 7, 3);
  bt_rider all = { 1, 1, 1, 0.4 }, heave = { 1, 0, 0, 0.4 }, beam = { 0, 0, 1, 1.2 };
  bt_vec3 p = { 4, 9, 0 }, v;
  double t = 31, e = 1e-4;
  bt_waves_motion (&w, p, t, &v, NULL);
  bt_vec3 rate = bt__scale (
      0.5 / e, bt__sub (bt_waves_ride (&w, &all, p, t + e), bt_waves_ride (&w, &all, p, t - e)));
  assert_close (bt__distance (rate, v), 0, 1e-6, "ride");
  assert_close (bt_waves_ride (&w, &heave, p, t).z, bt_waves_elevation (&w, 4, 9, t), 1e-12,
                "heave");
  assert_close (bt__norm (bt_waves_ride (&w, &beam, p, t)), 0, 1e-12, "head sea without sway");
  /* In shallow water it goes farther to and fro than up and down, by 1 / tanh (k d).  */
  bt_waves low = airy (0.1, 20, 0.5);
  double most = 0;
  for (t = 0; t < 20; t += 0.01)
    most = fmax (most, bt_waves_ride (&low, &all, p, t).x / sin (0.7));
  assert_close (most, 0.05 / tanh (low.k[0] * 0.5), 1e-5, "to and fro");
}

static bt_status
make (double height, double period, double gamma, double components)
{
  bt_wave_def def = { BT_WAVE_JONSWAP, height, period, 0, 0, gamma, components, 1, 0 };
  bt_waves w;
  bt_error error;
  return bt_waves_make (&def, 50, G, &w, &error);
}

static void
test_refusals (void **state)
{
  (void)state;
  assert_int_equal (make (2, 8, 3.3, 32), BT_OK);
  assert_int_equal (make (0, 8, 3.3, 32), BT_OK);
  assert_int_equal (make (-1, 8, 3.3, 32), BT_ERR_DOMAIN);
  assert_int_equal (make (2, 0, 3.3, 32), BT_ERR_DOMAIN);
  assert_int_equal (make (2, NAN, 3.3, 32), BT_ERR_DOMAIN);
  assert_int_equal (make (2, 8, 0.5, 32), BT_ERR_DOMAIN);
  assert_int_equal (make (2, 8, 3.3, 65), BT_ERR_DOMAIN);
  assert_int_equal (make (20, 8, 3.3, 32), BT_ERR_DOMAIN); /* breaks */
}

/* In the water as the solvers see it, waves are on top of the current and tell of themselves.  */
static void
test_water (void **state)
{
  (void)state;
  bt_waves w = airy (1, 6, 30);
  bt_current current = { .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.3, 0.1, 0 } } };
  bt_sea sea = { NULL, &w, NULL };
  bt_water water = { 1025, G, 30, 12.5, &current, NULL, NULL, &sea };
  bt_vec3 p = { 1, 2, -3 }, orbit, a;
  bt_waves_motion (&w, p, 12.5, &orbit, &a);
  bt_vec3 v = bt_water_velocity (&water, p);
  assert_true (bt__distance (v, bt__add (current.velocity[0], orbit)) == 0);
  assert_true (bt__distance (bt_water_current (&water, p), current.velocity[0]) == 0);
  assert_true (bt__distance (bt_water_acceleration (&water, p), a) == 0);
  assert_true (bt_water_surface (&water, p) == bt_waves_elevation (&w, 1, 2, 12.5));
  assert_true (bt_water_is_unsteady (&water));
  sea.waves = NULL;
  assert_false (bt_water_is_unsteady (&water));
  assert_true (bt__distance (bt_water_velocity (&water, p), current.velocity[0]) == 0);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_dispersion),    cmocka_unit_test (test_flow),
    cmocka_unit_test (test_deep_wave),     cmocka_unit_test (test_sea),
    cmocka_unit_test (test_seed),          cmocka_unit_test (test_rider),
    cmocka_unit_test (test_refusals),      cmocka_unit_test (test_water),
    cmocka_unit_test (test_components),    cmocka_unit_test (test_felt),
    cmocka_unit_test (test_not_finite),    cmocka_unit_test (test_clones),
    cmocka_unit_test (test_shared),        cmocka_unit_test (test_exact),
    cmocka_unit_test (test_series_clones), cmocka_unit_test (test_shared_not_finite),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
