/* Two mutants of the engine, made here from its own source: the laws that hold of the engine must
   fail of them.  The taut string whose planes bind but one end of a link; voxels whose squares are
   never looked into.  The other two, words without general position and without the relations of
   vertices, stand with the words.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define BT__FIRST_SIDE(t, j) ((t)->first[j])
#include "aware/taut_solve.c"
#define BT__SQUARE_IS_CLEAR(v, c, count) ((void)(c), (void)(count), 1)
#include "aware/voxel.c"

#include "aware/shadow_job.h"
#include "testbed/aware_cases.h"

static stage g;
static bt_vec3 p[CASE_NODES];

static bt__shadow *
shadow_of (void)
{
  bt__graph graph;
  bt__shadow *shadow = NULL;
  bt__graph_config config = { .scene = g.scene, .surface = 0, .gap = 0.01 };
  bt__shadow_config how = { .jitter = 0.2, .tries = 24 };
  assert_int_equal (bt__graph_new (&config, &graph, NULL), BT_OK);
  assert_int_equal (bt__shadow_new (&graph, &how, &shadow, NULL), BT_OK);
  bt__graph_free (&graph);
  return shadow;
}

static void
planes_for_one_end (void **state)
{
  bt__taut *taut = NULL;
  bt__string *s = calloc (1, bt__string_size (CASE_NODES));
  bt__count count = { 0 };
  int changed = 0, near = 0;
  (void)state;
  assert_non_null (s);
  s->room = CASE_NODES;
  assert_int_equal (bt__taut_new (CASE_NODES, &taut, NULL), BT_OK);
  for (uint64_t seed = 0; seed < 30; seed++)
    {
      dice d = dice_new (50 + seed);
      if (seed % 2)
        draw_jacket (&g, &d, 2);
      else
        draw_rings (&g, &d, 4);
      bt__shadow *shadow = shadow_of ();
      bt__taut_config config
          = { .scene = g.scene, .core = 0.005, .want = 0.005, .mesh = 0.6, .margin = 0.4 };
      uint32_t n = draw_line (&g, &d, 12, 0.35, 0.5, p);
      bt__word before, after;
      bt__shadow_word (shadow, p, n, &before);
      bt__string_lay (s, p, n);
      bt__taut_relax (taut, &config, s, 400, &count);
      bt__shadow_word (shadow, s->x, s->n, &after);
      changed += !is_same_word (&before, &after);
      near += way_clearance (&config, s->x, s->n, 1, &count) < 0.005;
      bt__shadow_free (shadow);
    }
  print_message ("# planes for one end: %d of 30 classes changed, %d too near\n", changed, near);
  assert_true (changed >= 2 && near >= 5);
  bt__taut_free (taut);
  free (s);
}

static void
squares_not_looked_into (void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 3; seed++)
    {
      dice d = dice_new (seed);
      bt__voxels *v = NULL;
      bt__voxel_report report;
      draw_rings (&g, &d, 3);
      bt__voxel_config c = { g.scene, NULL, bt__vec (-18, -14, -20), bt__vec (18, 14, 0), 0.5 };
      assert_int_equal (bt__voxels_new (&c, NULL, &v, NULL), BT_OK);
      report = v->report;
      print_message ("# squares not looked into: %u of 3 rings left\n",
                     (unsigned)report.generators);
      assert_true (report.generators < 3);
      bt__voxels_free (v);
    }
}

static int
tear_down (void **state)
{
  (void)state;
  stage_clear (&g);
  return 0;
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (planes_for_one_end), cmocka_unit_test (squares_not_looked_into) };
  return cmocka_run_group_tests_name ("aware mutants", tests, NULL, tear_down);
}
