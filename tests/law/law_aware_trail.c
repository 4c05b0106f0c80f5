/* A line that trails without forces: a link led sideways draws a tractrix; what is slack stays;
   what is taut is led from its anchor; a thing in the way is met where it stands.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "aware/trail.h"
#include "testbed/aware_cases.h"

enum
{
  NODES = 3
};

static bt_vec3 x[NODES];
static double link_of[NODES];

static bt__trail
laid (const bt_vec3 *p)
{
  bt__trail trail = { x, link_of, 0 };
  bt__trail_lay (&trail, p, NODES);
  return trail;
}

static double
off (bt_vec3 p, double px, double py)
{
  return bt__distance (p, bt__vec (px, py, 0));
}

/* The end goes along y = 0; the node before it, a behind, draws x = t - a tanh (t / a),
   y = a / cosh (t / a).  Steps of h are off by h / 2 at most.  */
static void
draws_a_tractrix (void **state)
{
  const bt_vec3 p[NODES] = { { 0, 20, 0 }, { 0, 2, 0 }, { 0, 0, 0 } };
  const double a = 2, h = 1e-3;
  bt__trail trail = laid (p);
  (void)state;
  trail.link[0] = 100;
  for (int k = 1; k <= 6000; k++)
    {
      double t = h * k;
      assert_int_equal (bt__trail_lead (&trail, bt__vec (t, 0, 0)), 0);
      assert_true (off (x[1], t - a * tanh (t / a), a / cosh (t / a)) < h);
    }
}

static void
leaves_what_is_slack (void **state)
{
  const bt_vec3 p[NODES] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
  bt__trail trail = laid (p);
  (void)state;
  assert_int_equal (bt__trail_lead (&trail, bt__vec (1.3, 0.6, 0)), 1);
  assert_true (off (x[0], 0, 0) == 0 && off (x[1], 1, 0) == 0);
}

/* Led beyond what it reaches, its links from the anchor on keep their lengths.  */
static void
hangs_from_its_anchor (void **state)
{
  const bt_vec3 p[NODES] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  bt__trail trail = laid (p);
  (void)state;
  assert_int_equal (bt__trail_lead (&trail, bt__vec (0, 3, 0)), 0);
  assert_true (off (x[0], 0, 0) == 0);
  assert_true (fabs (bt__distance (x[0], x[1]) - 1) < 1e-12);
}

static void
is_pushed_out (void **state)
{
  const bt_vec3 p[NODES] = { { -5, 0, -10 }, { -2, 0.95, -10 }, { 2, 0.95, -10 } };
  static stage g;
  bt__trail trail = laid (p);
  bt__near near;
  bt__count count = { 0 };
  (void)state;
  stage_clear (&g);
  stage_cylinder (&g, bt__vec (0, 0, 0), bt__vec (0, 0, -20), 1);
  assert_true (stage_make (&g));
  assert_true (bt__trail_meet (&trail, 1, g.scene, NULL, 0.01, &near, &count));
  assert_int_equal (near.object, 0);
  assert_true (fabs (x[1].y - 1.01) < 1e-9 && x[2].y == 0.95);
  trail = laid ((bt_vec3[]){ { -5, 0, -10 }, { -2, 2, -10 }, { 2, 2, -10 } });
  assert_false (bt__trail_meet (&trail, 1, g.scene, NULL, 0.01, &near, &count));
  stage_clear (&g);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (draws_a_tractrix),
    cmocka_unit_test (leaves_what_is_slack),
    cmocka_unit_test (hangs_from_its_anchor),
    cmocka_unit_test (is_pushed_out),
  };
  return cmocka_run_group_tests_name ("aware trail", tests, NULL, NULL);
}
