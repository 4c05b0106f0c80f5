/* The safe step against every kind of junk: whatever is proposed, no link passes through anything
   or comes nearer than the core.  The judge is oracle/sweep.c, which shares nothing with the
   engine; the mutants, no truncation and end points only, show that it can say no.

   5000 steps, 1.25e5 with BIGHT_LONG=1 in the environment; `bight bench collision --stress N' plays
   the same.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/play.h"

static const double core = 0.0025;

static long
steps (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 25000 : 1000;
}

static void
check (void (*draw) (stage *, dice *), uint64_t seed)
{
  dice d = dice_new (seed);
  stage *g = calloc (1, sizeof *g);
  assert_non_null (g);
  draw (g, &d);
  assert_true (raise_stage (g));
  assert_true (clearance (g, g->x) > core);
  verdict v = play (g, &d, steps (), core);
  print_message ("# truncated %ld of %ld, overflows %ld, least %.6g m, casts %lu\n", v.truncated,
                 steps (), v.overflows, v.least, (unsigned long)g->count.casts);
  if (v.crossings || v.too_near || v.unlinked)
    fail_msg ("%ld crossings, %ld links undone, least clearance %.17g", v.crossings, v.unlinked,
              v.least);
  assert_true (v.truncated > 0);
  assert_true (g->movers == 0 || v.pinched > 0);
  strike (g);
}

static void
wires (void **state)
{
  (void)state;
  check (draw_wires, 1);
}

static void
cage (void **state)
{
  (void)state;
  check (draw_cage, 2);
}

static void
corners (void **state)
{
  (void)state;
  check (draw_corners, 3);
}

static void
sheets (void **state)
{
  (void)state;
  check (draw_sheets, 4);
}

static void
movers (void **state)
{
  (void)state;
  check (draw_movers, 5);
}

/* ---- Mutants ---- */

static int
ends_are_clear (const stage *g, const bt_vec3 *x)
{
  bt__count count = { 0 };
  for (int j = 0; j + 1 < NODES; j++)
    {
      bt__link link = { x[j], x[j + 1] };
      bt__near near;
      if (bt__scene_nearest (g->scene, NULL, &link, core, &near, &count))
        return 0;
    }
  return 1;
}

/* A mover of tethers that looks at nothing (LOOK 0) or only at where a move ends.  */
static long
mutant (void (*draw) (stage *, dice *), int look)
{
  dice d = dice_new (2);
  stage *g = calloc (1, sizeof *g);
  long sum = 0;
  assert_non_null (g);
  draw (g, &d);
  assert_true (raise_stage (g));
  for (int i = 0; i < 60; i++) /* to and fro, right across */
    {
      bt_vec3 want[NODES], jump = dice_point (&d, 0.5);
      jump.x = i % 2 ? -18 : 18;
      for (int k = 0; k < NODES; k++)
        want[k] = bt__add (g->x[k], jump);
      if (look && !ends_are_clear (g, want))
        continue;
      sum += crossings (g, g->x, want);
      for (int k = 0; k < NODES; k++)
        g->x[k] = want[k];
    }
  strike (g);
  return sum;
}

static void
oracle_fires (void **state)
{
  void (*draws[]) (stage *, dice *) = { draw_wires, draw_cage, draw_corners, draw_sheets };
  (void)state;
  for (int i = 0; i < 4; i++)
    {
      long blind = mutant (draws[i], 0), ends = mutant (draws[i], 1);
      print_message ("# mutants: %ld crossings without truncation, %ld with end points only\n",
                     blind, ends);
      assert_true (blind > 0);
      assert_true (ends > 0);
    }
}

/* ---- The rest ---- */

static void
goes_where_it_is_free (void **state)
{
  dice d = dice_new (9);
  stage *g = calloc (1, sizeof *g);
  bt_vec3 want[NODES];
  bt__safe_config config = { core, 2, 16 };
  bt__safe_report report;
  (void)state;
  assert_non_null (g);
  draw_corners (g, &d);
  assert_true (raise_stage (g));
  for (int i = 0; i < NODES; i++)
    want[i] = bt__vec (-9, g->x[i].y, 12 + g->x[i].z);
  bt__safe_step (g->safe, &config, g->scene, NULL, NULL, 0, g->x, want, NODES, &report, &g->count);
  assert_int_equal (report.held, 0);
  for (int i = 0; i < NODES; i++)
    assert_true (bt__distance (g->x[i], want[i]) == 0);
  /* It stays there for nothing.  */
  bt__count before = g->count;
  bt__safe_step (g->safe, &config, g->scene, NULL, NULL, 0, g->x, want, NODES, &report, &g->count);
  assert_int_equal (g->count.pairs, before.pairs);
  strike (g);
}

/* A bar that sweeps and turns through a tether that stays: held back, never through.  */
static void
movers_are_held_back (void **state)
{
  bt__safe_config config = { core, 2, 1 };
  bt__scene *bar = NULL, *empty = NULL;
  bt__safe *safe = NULL;
  bt__count count = { 0 };
  dice d = dice_new (12);
  (void)state;
  bt__obstacle o
      = { .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = { { -3, 0, 0 }, { 3, 0, 0 }, 0.05 } };
  assert_int_equal (bt__scene_new (&o, 1, 2, &bar, NULL), BT_OK);
  assert_int_equal (bt__scene_new (NULL, 0, 1, &empty, NULL), BT_OK);
  assert_int_equal (bt__safe_new (3, 8, &safe, NULL), BT_OK);
  bt__frame at = { { 0, -6, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  bt_vec3 x[3] = { { 0, 0, -5 }, { 0.1, 0, 0 }, { 0, 0, 5 } };
  long pinched = 0;
  for (int i = 0; i < 4000; i++)
    {
      bt_vec3 toward = bt__axpy (dice_point (&d, 5), -0.3, at.origin);
      bt__motion m = { .from = at,
                       .travel = toward,
                       .axis = dice_direction (&d),
                       .angle = i % 2 ? dice_between (&d, 0, 2) : 0 };
      bt__mover mover = { bar, NULL, m, 3.05, 1 };
      bt_vec3 want[3], before[3] = { x[0], x[1], x[2] };
      for (int k = 0; k < 3; k++)
        want[k] = bt__add (x[k], i % 3 ? bt__vec (0, 0, 0) : dice_point (&d, 2));
      bt__safe_report report;
      bt__safe_step (safe, &config, empty, NULL, &mover, 1, x, want, 3, &report, &count);
      pinched += mover.done < 1;
      /* Seen from the bar, in 64 parts of the step.  */
      for (int part = 1; part <= 64; part++)
        {
          bt_vec3 from[3], to[3];
          bt__frame f = bt__motion_at (&m, mover.done * (part - 1) / 64),
                    h = bt__motion_at (&m, mover.done * part / 64);
          for (int k = 0; k < 3; k++)
            {
              bt_vec3 go = bt__sub (x[k], before[k]);
              from[k] = bt__to_local (&f, bt__axpy (before[k], (part - 1) / 64.0, go));
              to[k] = bt__to_local (&h, bt__axpy (before[k], part / 64.0, go));
            }
          assert_int_equal (
              sweep_crossings (from, to, 3, &(sweep_segment){ { -3, 0, 0 }, { 3, 0, 0 } }), 0);
        }
      at = bt__motion_at (&m, mover.done);
      for (int k = 0; k < 2; k++)
        {
          bt__link link = { bt__to_local (&at, x[k]), bt__to_local (&at, x[k + 1]) };
          solid s = capsule_between (bt__vec (-3, 0, 0), bt__vec (3, 0, 0), 0.05);
          assert_true (solid_brute (&s, &link) >= core);
        }
    }
  assert_true (pinched > 0);
  bt__scene_free (bar);
  bt__scene_free (empty);
  bt__safe_free (safe);
}

static void
orientation_is_exact (void **state)
{
  bt_vec3 a = { 0.1, 0.2, 0.3 }, b = { 1.1, 0.2, 0.3 }, c = { 0.1, 1.2, 0.3 };
  (void)state;
  assert_int_equal (sweep_orient (a, b, c, bt__vec (0.5, 0.6, 0.3)), 0);
  assert_int_equal (sweep_orient (a, b, c, bt__vec (0.5, 0.6, nextafter (0.3, 1))), -1);
  assert_int_equal (sweep_orient (a, b, c, bt__vec (0.5, 0.6, nextafter (0.3, 0))), 1);
  bt_vec3 ring[4] = { { 1, 1, 0 }, { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 } };
  bt_vec3 from[2] = { { 0, 0, -1 }, { 0, 0, 1 } }, to[2] = { { 5, 0, -1 }, { 5, 0, 1 } };
  assert_true (fabs (fabs (sweep_linking (from, to, 2, ring, 4)) - 1) < 1e-14);
  assert_int_equal (sweep_crossings (from, to, 2, &(sweep_segment){ ring[3], ring[0] }), 1);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (orientation_is_exact),
                                      cmocka_unit_test (oracle_fires),
                                      cmocka_unit_test (wires),
                                      cmocka_unit_test (cage),
                                      cmocka_unit_test (corners),
                                      cmocka_unit_test (sheets),
                                      cmocka_unit_test (movers),
                                      cmocka_unit_test (movers_are_held_back),
                                      cmocka_unit_test (goes_where_it_is_free) };
  return cmocka_run_group_tests_name ("collide_safe", tests, NULL, NULL);
}
