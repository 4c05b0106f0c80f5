/* What the laws of contact share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_CONTACT_LAW_H
#define BT_LAW_CONTACT_LAW_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/contact_scene.h"

static const double frame = 1.0 / 60;

static inline int
is_long (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1';
}

static inline void
assert_near (double is, double wanted, double tolerance, const char *what)
{
  if (!(fabs (is - wanted) <= tolerance))
    fail_msg ("%s: %.10g is not %.10g within %.3g", what, is, wanted, tolerance);
}

static inline void
assert_below (double is, double limit, const char *what)
{
  if (!(is < limit))
    fail_msg ("%s: %.10g is not below %.10g", what, is, limit);
}

/* The promise, as an independent judge sees it.  */
static inline void
assert_kept (const rope *p, const char *what)
{
  const bt_vec3 *x = bt__dynamic_x (p->d);
  double clear = reef_clearance (p->reef, x, (int)p->d->n + 1);
  if (p->crossings || p->nan || p->refused || !(clear >= p->config.core))
    fail_msg ("%s: %ld crossings, %ld not finite, %ld refused, clearance %.9g m", what,
              p->crossings, p->nan, p->refused, clear);
}

/* Lay P, a line of 20 m in LINKS, and sweep it sideways at SPEED for so many STEPS onto a wire of
   10 mm in R, the K-th of many; with MUTANT as the solver has it.  */
static inline void
sweep_onto_wire (rope *p, reef *r, int k, int links, double speed, int steps, int mutant, dice *d)
{
  bt_vec3 middle
      = { 3 + dice_between (d, 0, 1), dice_between (d, -0.5, 0.5), dice_between (d, -0.5, 0.5) };
  bt_vec3 axis = bt__unit_or (
      bt__add (bt__vec (0, cos (0.3 * k), sin (0.3 * k)), bt__scale (0.5, dice_direction (d))),
      bt__vec (0, 0, 1));
  bt_vec3 end = fabs (axis.y) > 0.9 ? bt__vec (0, 0, 10) : bt__vec (0, 10, 0);
  bt_vec3 shape[] = { bt__scale (-1, end), { -1, 0, 0 }, end };
  assert_true (reef_open (r));
  reef_wire (r, bt__axpy (middle, -30, axis), bt__axpy (middle, 30, axis), 0.005);
  assert_true (reef_raise (r));
  assert_true (rope_open (p, r, links, shape, 3, 20.2, 0.3));
  p->config.pull[0] = p->config.pull[1] = 150;
  p->hook.no_guard = p->hook.no_contacts = mutant;
  for (int i = 0; i < steps; i++)
    {
      bt_vec3 to = { fmin (speed * (i + 1) * frame, 8), 0, 0 };
      p->in.end[0].at = bt__add (shape[0], to);
      p->in.end[1].at = bt__add (shape[2], to);
      rope_step (p, frame, 1);
    }
}

#endif
