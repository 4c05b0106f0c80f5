/* The thesis' collision response (D. Manowitz, 3.5.2): sliding at constant length, the taut stop,
   sticking, the platform of figure 3-8; only what changed is solved; asking; the flat state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "thesis_rig.h"

static const double radius = 0.005; /* of the rig's tether */
static const double degree = BT__PI / 180;

static double
tension_at_end (const rig *r)
{
  return bt__thesis_tension (r->state, r->report.length);
}

/* ---- Figure 3-7: sliding; the taut stop ---- */

static void
sliding (void **state)
{
  (void)state;
  rig *r = rig_new ();
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  r->pull = 5000; /* more than the drag of any bow that a step of 5 cm leaves */
  r->current.velocity[0] = bt__vec (0, -0.25, 0);
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 25);
  rig_round (r, bt__vec (0, 0, -5), 1.3 * BT__PI, 3, 0.05);
  int last = rig_contacts (r);
  assert_true (last > 2);
  assert_int_equal (r->state->bent, 0);
  bt_vec3 c = rig_span (r, last - 1)->end.point, b = r->report.b;
  bt_vec3 along = bt__unit_or (bt__sub (b, c), b);
  double free0 = rig_span (r, last)->length, bent0 = rig_span (r, 0)->length;
  for (int way = 1; way >= 0; way--)
    {
      assert_int_equal (rig_fly (r, bt__axpy (b, 5 * way, along), 0.05), 0);
      assert_int_equal (rig_contacts (r), last);
      assert_true (fabs (rig_span (r, last)->length - free0 - 5 * way) < 0.05);
      assert_true (fabs (bent0 - rig_span (r, 0)->length - 5 * way) < 0.05);
      assert_true (fabs (r->report.length - 25) < 0.025);
      assert_int_equal (rig_span (r, 0)->straight, 0);
    }
  /* Outward until the bent span is taut.  */
  double most = 0;
  int stopped = 0;
  bt_vec3 at = b;
  for (int i = 0; i < 600; i++)
    {
      int there = rig_step (r, bt__axpy (b, 0.05 * i, along));
      double t = tension_at_end (r);
      assert_true (t >= most * (1 - 1e-9));
      most = t;
      stopped += !there;
      if (stopped > 1)
        assert_true (bt__distance (at, r->report.b) < 0.01);
      at = r->report.b;
    }
  assert_true (stopped > 100 && r->report.taut && !r->report.held);
  assert_true (most == r->pull);
  double chords = 0;
  for (int k = 0; k <= rig_contacts (r); k++)
    chords += bt__distance (rig_span (r, k)->shape.a, rig_span (r, k)->shape.b);
  assert_true (fabs (chords / 25 - 1) < 1e-6);
  rig_check (r);
  rig_free (r);
}

/* ---- Sticking ---- */

static void
sticking (void **state)
{
  (void)state;
  /* By, angle (degrees), count; stuck after 40 and after 200 degrees of the pile.  */
  static const struct
  {
    int by;
    double angle, count;
    int early, late;
  } row[] = { { BT_STICK_BY_ANGLE, 90, INFINITY, 0, 1 }, { BT_STICK_BY_ANGLE, 900, 1, 0, 0 },
              { BT_STICK_BY_COUNT, 10, INFINITY, 0, 0 }, { BT_STICK_BY_COUNT, 900, 2, 1, 1 },
              { BT_STICK_BY_EITHER, 90, 2, 1, 1 },       { BT_STICK_BY_EITHER, 90, 300, 0, 1 },
              { BT_STICK_BY_BOTH, 90, 2, 0, 1 },         { BT_STICK_BY_BOTH, 10, INFINITY, 0, 0 } };
  for (size_t i = 0; i < sizeof row / sizeof *row; i++)
    {
      rig *r = rig_new ();
      rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
      r->rules.stick_by = row[i].by;
      r->rules.stick_angle = row[i].angle * degree;
      r->rules.stick_count = row[i].count;
      rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 25);
      rig_round (r, bt__vec (0, 0, -5), 1.3 * BT__PI, 3, 0.05);
      assert_true (rig_contacts (r) > 1);
      assert_int_equal (r->state->stuck != 0, row[i].early);
      rig_round (r, bt__vec (0, 0, -5), BT__PI, 2, 0.05);
      assert_int_equal (r->state->stuck != 0, row[i].late);
      rig_check (r);
      rig_free (r);
    }
}

/* ---- Only what changed is solved ---- */

static void
solves (void **state)
{
  (void)state;
  rig *r = rig_new ();
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  r->rules.sliding = 0;
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 25);
  rig_round (r, bt__vec (0, 0, -5), 0.9 * BT__PI, 3, 0.05);
  while (rig_contacts (r) < 7)
    rig_round (r, bt__vec (0, 0, -5), 0.02, 3, 0.05);
  assert_int_equal (rig_contacts (r), 7);
  for (int i = 0; i < 3; i++)
    {
      bt__thesis_counts before = r->counts;
      bt_vec3 b = r->report.b;
      rig_span (r, 7)->rubber = 0;
      rig_step (r, bt__vec (b.x, b.y, b.z + 0.01));
      assert_int_equal (r->counts.solves - before.solves, 1);
      assert_int_equal (r->counts.skips - before.skips, 7);
      before = r->counts;
      rig_step (r, r->b);
      assert_int_equal (r->counts.solves, before.solves);
      assert_int_equal (r->counts.rounds, before.rounds);
    }
  rig_free (r);
}

/* ---- Figure 3-8: the platform ---- */

static const bt_vec3 leg[4] = { { 0, 0, -10 }, { 12, 0, -10 }, { 12, 12, -10 }, { 0, 12, -10 } };

static void
platform (void **state)
{
  (void)state;
  rig *r = rig_new ();
  r->props.diameter = 0.03;
  for (int i = 0; i < 4; i++)
    {
      bt_vec3 p = leg[i], q = leg[(i + 1) % 4];
      rig_pile (r, bt__vec (p.x, p.y, -20), bt__vec (p.x, p.y, 0), 0.6);
      rig_bar (r, bt__vec (p.x, p.y, -18), bt__vec (q.x, q.y, -14), 0.25);
    }
  r->rules.stick_angle = 620 * degree;
  rig_start (r, bt__vec (-8, -4, -10), bt__vec (-2, -3, -10), 90);
  double w0 = rig_turns (r, leg[0]), w1 = rig_turns (r, leg[1]);
  /* Round the first leg and on, round the second and on.  */
  static const struct
  {
    int leg;
    double x, y;
  } tour[]
      = { { 0, 2, -2 }, { 0, 2.4, 2 }, { 0, -2, 2 },  { 0, -2, -2 }, { 0, 2, -2 }, { 1, 14, -2 },
          { 1, 14, 2 }, { 1, 10, 2 },  { 1, 10, -2 }, { 1, 14, -2 }, { 1, 14, 2 } };
  enum
  {
    LEGS = sizeof tour / sizeof *tour
  };
  for (int i = 0; i < LEGS; i++)
    {
      int short_of = rig_fly (r, bt__vec (tour[i].x, tour[i].y, -10), 0.05);
      assert_true (short_of == 0 || r->state->stuck);
    }
  assert_true (rig_contacts (r) >= 3);
  assert_true (r->state->stuck && r->report.taut && !r->report.held);
  assert_true (rig_turns (r, leg[0]) - w0 > 1 && rig_turns (r, leg[1]) - w1 > 1);
  double t = tension_at_end (r), first = rig_span (r, 0)->length;
  bt_vec3 b = r->report.b;
  bt_vec3 near = bt__polyline_point (bt__thesis_line (r->state), r->report.length - 1);
  double last = rig_span (r, rig_contacts (r))->length;
  r->length += 10;
  rig_rest (r, 10);
  assert_memory_equal (&b, &r->report.b, sizeof b);
  assert_true (fabs (tension_at_end (r) - t) <= 0.02 * fabs (t));
  assert_true (
      bt__distance (near, bt__polyline_point (bt__thesis_line (r->state), r->report.length - 1))
      < 1e-6);
  assert_true (fabs (rig_span (r, rig_contacts (r))->length - last) < 1e-6);
  assert_true (fabs (rig_span (r, 0)->length - first - 10) < 1e-6);
  rig_check (r);
  r->length -= 10;
  for (int i = LEGS - 2; i >= 0; i--)
    rig_fly (r, bt__vec (tour[i].x, tour[i].y, -10), 0.05);
  rig_fly (r, bt__vec (-2, -3, -10), 0.05);
  assert_int_equal (rig_contacts (r), 0);
  assert_true (fabs (rig_turns (r, leg[0]) - w0) < 1e-6);
  assert_true (fabs (rig_turns (r, leg[1]) - w1) < 1e-6);
  rig_check (r);
  rig_free (r);
}

/* ---- Asking ---- */

static void
asking (void **state)
{
  (void)state;
  rig *r = rig_new ();
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 25);
  rig_round (r, bt__vec (0, 0, -5), 1.3 * BT__PI, 3, 0.05);
  int n = rig_contacts (r);
  bt__touch touch[BT__SPLITS_MAX];
  bt__segment seg[BT__SPLITS_MAX + 1];
  assert_int_equal (bt__thesis_touches (r->state, touch, BT__SPLITS_MAX), n);
  assert_int_equal (bt__thesis_segments (r->state, BT_MODEL_CATENARY, seg, BT__SPLITS_MAX + 1),
                    n + 1);
  assert_int_equal (seg[0].model, BT_MODEL_CATENARY);
  assert_true (seg[0].from == 0 && seg[n].to == r->report.length);
  for (int k = 0; k < n; k++)
    {
      assert_int_equal (touch[k].object, 0);
      assert_true (fabs (hypot (touch[k].point.x, touch[k].point.y) - 0.3) < radius);
      assert_true (bt__dot (touch[k].force, touch[k].normal) > 0);
      assert_true (touch[k].s == seg[k].to && seg[k].to == seg[k + 1].from);
      assert_int_equal (seg[k + 1].model, BT_MODEL_RUBBER_BAND);
      bt_vec3 p = bt__polyline_point (bt__thesis_line (r->state), touch[k].s);
      assert_true (bt__distance (p, seg[k].b) == 0);
    }
  assert_true (bt__thesis_tension_max (r->state) >= tension_at_end (r));
  rig_free (r);
}

/* The live bytes are all there is: a copy goes on to the same bits.  */
static void
is_flat (void **state)
{
  (void)state;
  rig *r = rig_new ();
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 25);
  rig_round (r, bt__vec (0, 0, -5), 1.3 * BT__PI, 3, 0.05);
  size_t all = bt__thesis_size (RIG_NODES), live = bt__thesis_live (r->state);
  bt__thesis *copy = calloc (1, all), *mine = r->state;
  assert_non_null (copy);
  assert_true (live < all);
  memcpy (copy, mine, live);
  assert_memory_equal (copy, mine, all); /* nothing is left beyond */
  bt_vec3 b = r->report.b;
  for (int k = 0; k < 2; k++)
    {
      r->state = k ? copy : mine;
      bt__safe_forget (r->safe);
      r->report.b = b;
      rig_round (r, bt__vec (0, 0, -5), -0.6 * BT__PI, 3, 0.05);
    }
  assert_memory_equal (copy, mine, all);
  r->state = mine;
  free (copy);
  rig_free (r);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (sliding),  cmocka_unit_test (sticking), cmocka_unit_test (solves),
    cmocka_unit_test (platform), cmocka_unit_test (asking),   cmocka_unit_test (is_flat),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
