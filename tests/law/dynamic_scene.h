/* A moving line, its water and its ends: what the laws of the dynamic line share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_DYNAMIC_SCENE_H
#define BT_LAW_DYNAMIC_SCENE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "math/vec.h"
#include "tether/dynamic.h"

enum
{
  SCENE_MAX = 2000 /* intervals */
};

typedef struct scene
{
  bt_tether_props line;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__dynamic_report report;
  bt__dynamic *d;
  bt__dynamic_work *work;
  long solves, unconverged, steps;
} scene;

static inline void
scene_close (scene *s)
{
  free (s->d);
  bt__dynamic_work_free (s->work);
  s->d = NULL;
  s->work = NULL;
}

/* Set S up with LINE of N intervals and LENGTH laid along the M points SHAPE, its ends held there,
   in water of DENSITY.  */
static inline void
scene_open (scene *s, bt_tether_props line, double density, int n, const bt_vec3 *shape, int m,
            double length)
{
  *s = (scene){ .line = line };
  s->d = malloc (bt__dynamic_size (SCENE_MAX));
  s->work = bt__dynamic_work_new (SCENE_MAX);
  assert_true (s->d && s->work);
  s->water = (bt_water){ density, 9.81, 1000, 0, &s->current, NULL, NULL, NULL };
  s->in = (bt__dynamic_input){ .line = &s->line, .water = &s->water, .tolerance = 1e-9 };
  s->in.end[0].at = shape[0];
  s->in.end[1].at = shape[m - 1];
  assert_int_equal (bt__dynamic_init (s->d, SCENE_MAX, n, shape, m, length, line.ea, NULL), BT_OK);
}

/* Let the water of S flow at U everywhere.  */
static inline void
scene_current (scene *s, bt_vec3 u)
{
  s->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { u } };
}

static inline void
scene_step (scene *s, double h)
{
  bt_error error = { 0 };
  s->water.current = &s->current;
  s->in.line = &s->line;
  s->in.water = &s->water;
  s->in.h = h;
  s->water.time += h;
  if (bt__dynamic_step (s->d, s->work, &s->in, &s->report, &error) != BT_OK)
    fail_msg ("%s", error.text);
  s->solves += s->report.solves;
  s->unconverged += !s->report.converged;
  s->steps++;
}

/* Let S come to rest: backward Euler steps that grow, without inertia in the end.  Beyond some
   hundred seconds the frozen tangents no longer converge where drag turns the line.  */
static inline void
scene_settle (scene *s)
{
  double tolerance = s->in.tolerance, time = s->water.time;
  s->in.tolerance = 1e-9;
  double h = 0.05;
  for (int i = 0, long_ones = 0; i < 600 && long_ones < 40; i++)
    {
      scene_step (s, h);
      bt__dynamic_still (s->d);
      long_ones += h >= 300 && s->report.converged;
      h = s->report.converged ? fmin (1.3 * h, 300) : fmax (h / 4, 0.01);
    }
  s->in.tolerance = tolerance;
  s->water.time = time;
}

/* The mechanical energy of S, J.  */
static inline double
scene_energy (const scene *s)
{
  bt__dynamic_energy e = bt__dynamic_energies (s->d, &s->in);
  return e.kinetic + e.strain + e.gravity + e.bending;
}

static inline void
assert_close (double is, double wanted, double tolerance, const char *what)
{
  if (!(fabs (is - wanted) <= tolerance))
    fail_msg ("%s: %.10g is not %.10g within %.3g", what, is, wanted, tolerance);
}

#endif
