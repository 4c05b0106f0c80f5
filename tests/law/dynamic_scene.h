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

#include "testbed/rig.h"

typedef rig scene;

static inline void
scene_close (scene *s)
{
  rig_close (s);
}

/* What cannot be done fails the test.  */
static inline void
scene_good (const scene *s)
{
  if (!s->good)
    fail_msg ("%s", s->error.text);
}

/* Set S up with LINE of N intervals and LENGTH laid along the M points SHAPE, its ends held there,
   in water of DENSITY.  */
static inline void
scene_open (scene *s, bt_tether_props line, double density, int n, const bt_vec3 *shape, int m,
            double length)
{
  rig_open (s, line, density, n, shape, m, length);
  scene_good (s);
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
  rig_step (s, h);
  scene_good (s);
}

static inline void
scene_settle (scene *s)
{
  rig_settle (s);
  scene_good (s);
}

/* ---- A flight ---- */

/* Set S up with N intervals of 24 m of line to a vehicle at rest, in a current.  */
static inline void
scene_open_flight (scene *s, int n)
{
  bt_vec3 shape[3] = { { 0, 0, -10 }, { 10, 8, -14 }, { 18, 0, -10 } };
  bt_tether_props line = { .diameter = 0.01,
                           .mass = 0.1,
                           .wet_weight = 0.2,
                           .ea = 2e4,
                           .ba = 200,
                           .cdn = 1.2,
                           .cdt = 0.01,
                           .ca = 1 };
  scene_open (s, line, 1025, n, shape, 3, 24);
  scene_current (s, bt__vec (0, 0.3, 0));
  scene_settle (s);
}

/* Where that vehicle, which sets off gently on a Lissajous path, is at T.  */
static inline bt_vec3
flight_at (double t)
{
  double ramp = t * t * t / (1 + t * t * t);
  return bt__vec (18 - ramp * (1 - cos (0.7 * t)) * 4, ramp * 2 * sin (0.9 * t),
                  -10 + ramp * sin (1.3 * t));
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
