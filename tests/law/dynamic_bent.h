/* Lines that bend, crooked, in vacuum: what the laws of sets and of twist share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_DYNAMIC_BENT_H
#define BT_LAW_DYNAMIC_BENT_H

#include "law/dynamic_scene.h"
#include "tether/dynamic_kernel.h"

#define EVERYWHERE -1e3, 1e3 /* m */

enum
{
  BENT = 14 /* intervals of a crooked line */
};

/* The state of the numbers thrown.  */
static uint64_t dice = 1;

/* From -1 to 1.  */
static inline double
thrown (void)
{
  dice = dice * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)dice / 9.3e18;
}

/* Set S up with a straight line of stiffness EI and GJ along x.  */
static inline void
open_line (scene *s, int n, double length, double ei, double gj, const bt__dynamic_set *sets,
           int n_sets)
{
  bt_vec3 shape[2] = { { 0, 0, 0 }, { length, 0, 0 } };
  bt_tether_props line = {
    .diameter = 0.01, .mass = 0.1, .ea = 1e6, .ei = ei, .gj = gj, .cdn = 1.2, .cdt = 0.01, .ca = 1
  };
  scene_open (s, line, 0, n, shape, 2, length);
  s->in.sets = sets;
  s->in.n_sets = n_sets;
}

/* Three sets that overlap, toward different sides.  */
static const bt__dynamic_set three[3]
    = { { 0.4, 1.1, { 2, -1 } }, { 0.8, 3, { -1.5, 0.6 } }, { -1, 0.5, { 0.3, 2 } } };

/* A crooked line of uneven stretch, of N_SETS of the three sets; CLAMPS: bit K for end K.  */
static inline void
open_crooked (scene *s, int clamps, double crooked, double gj, int n_sets)
{
  open_line (s, BENT, 2, 0.7, gj, three, n_sets);
  bt_vec3 *x = bt__dynamic_x (s->d);
  for (int i = 0; i <= BENT; i++)
    x[i] = bt__vec (1.9 * i / BENT + 0.05 * crooked * thrown (), crooked * 0.08 * thrown (),
                    crooked * (0.3 * sin (0.4 * i) + 0.08 * thrown ()));
  for (int k = 0; k < 2; k++)
    {
      s->in.end[k].free = 1;
      s->in.end[k].clamped = clamps >> k & 1;
      s->in.end[k].direction
          = bt__unit_or (bt__vec (1, 0.4 * thrown (), 0.4 * thrown ()), bt__vec (1, 0, 0));
    }
}

static inline double
prepared_energy (scene *s)
{
  s->in.h = 1;
  assert_int_equal (bt__dynamic_begin (s->d, s->work, &s->in, &s->report, &s->error), BT_OK);
  memcpy (s->work->X, bt__dynamic_x (s->d), (BENT + 1) * sizeof (bt_vec3));
  return bt__dynamic_bend_energy (s->work, s->work->X);
}

static inline double *
component (scene *s, int i, int axis)
{
  return &((double *)(void *)&bt__dynamic_x (s->d)[i])[axis];
}

/* What bending pushes node I of S with is minus the gradient of the energy, of central differences:
   return by how much it is not, and the greatest component to *MOST.  */
static inline double
off_the_gradient (scene *s, int i, double *most)
{
  double h = 1e-5, worst = 0, force[3];
  prepared_energy (s);
  bt_vec3 f = bt__dynamic_bend_on (s->work, i);
  memcpy (force, &f, sizeof force);
  for (int axis = 0; axis < 3; axis++)
    {
      double was = *component (s, i, axis), up, down;
      *component (s, i, axis) = was + h;
      up = prepared_energy (s);
      *component (s, i, axis) = was - h;
      down = prepared_energy (s);
      *component (s, i, axis) = was;
      worst = fmax (worst, fabs (force[axis] + (up - down) / (2 * h)));
      *most = fmax (*most, fabs (force[axis]));
    }
  return worst;
}

/* All nodes of S; without clamps no force and no moment of all is left.  */
static inline void
assert_gradient (scene *s, int clamped, const char *what)
{
  double worst = 0, most = 0;
  bt_vec3 all = { 0, 0, 0 }, turning = { 0, 0, 0 };
  for (int i = 0; i <= BENT; i++)
    {
      worst = fmax (worst, off_the_gradient (s, i, &most));
      prepared_energy (s);
      bt_vec3 f = bt__dynamic_bend_on (s->work, i);
      all = bt__add (all, f);
      turning = bt__add (turning, bt__cross (s->work->X[i], f));
    }
  if (!(worst < 1e-6 * most))
    fail_msg ("%s: the force is off the gradient by %g of %g", what, worst, most);
  assert_true (bt__norm (all) < 1e-9 * most);
  if (!clamped)
    assert_true (bt__norm (turning) < 1e-9 * most);
}

#endif
