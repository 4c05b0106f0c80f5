/* The state of a dive among obstacles: the same ops give the same bits, on a fork and from a
   checkpoint too; spoilt checkpoints are refused; what is far or not there costs nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/dive_play.h"
#include "math/vec.h"

/* ---- Sameness ---- */

static void
make_crowd (scene *s, bt_model_kind model)
{
  begin_scene (s, model);
  plant_wood (s);
  hang_garage (s);
  add_movers (s);
  give_hull (s, 0, bt__vec (0.4, 0.5, 0.3));
}

static void
go_on (bt_dive *dive, const scene *s, uint64_t seed, int acts)
{
  dice d = dice_new (seed);
  judge j;
  begin_judging (&j, s, dive);
  live (dive, &j, &d, (habits){ .jumps = 1, .winch = 1, .models = 1 }, acts, 30);
  end_judging (&j);
}

/* The same again, on a fork and from a checkpoint taken by another dive: not a bit differs.  */
static void
same_again (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      make_crowd (&s, (bt_model_kind)model);
      bt_dive *a = enter (&s), *b = enter (&s), *fork;
      void *kept = malloc (bt_dive_state_size (a));
      assert_non_null (kept);
      go_on (a, &s, 90, 4);
      go_on (b, &s, 90, 4);
      assert_true (bt_dive_hash (a) == bt_dive_hash (b));
      bt_dive_save (a, kept);
      assert_int_equal (bt_dive_fork (a, &fork, NULL), BT_OK);
      go_on (b, &s, 91, 3);
      go_on (a, &s, 91, 3);
      assert_true (bt_dive_hash (a) == bt_dive_hash (b));
      go_on (b, &s, 92, 2); /* somewhere else, and back */
      assert_int_equal (bt_dive_restore (b, kept, bt_dive_state_size (b), NULL), BT_OK);
      go_on (b, &s, 91, 3);
      go_on (fork, &s, 91, 3);
      assert_true (bt_dive_hash (a) == bt_dive_hash (b));
      assert_true (bt_dive_hash (a) == bt_dive_hash (fork));
      free (kept);
      bt_dive_free (fork);
      bt_dive_free (b);
      bt_dive_free (a);
    }
}

/* Bytes that are not as saved are refused, whichever they are, and the dive goes on.  */
static void
spoilt_states (void **state)
{
  static const bt_model_kind models[] = { BT_MODEL_CATENARY, BT_MODEL_STEADY, BT_MODEL_DYNAMIC };
  (void)state;
  for (int k = 0; k < 3; k++)
    {
      scene s;
      make_crowd (&s, models[k]);
      bt_dive *dive = enter (&s);
      dice d = dice_new (95 + (uint64_t)k);
      go_on (dive, &s, 93, 4);
      size_t size = bt_dive_state_size (dive);
      uint64_t hash = bt_dive_hash (dive);
      unsigned char *good = malloc (size), *bad = malloc (size);
      long refused = 0;
      assert_non_null (good);
      assert_non_null (bad);
      bt_dive_save (dive, good);
      for (int i = 0; i < 3000; i++)
        {
          memcpy (bad, good, size);
          for (int n = 1 + dice_below (&d, 8); n-- > 0;)
            bad[dice_below (&d, (int)size)] ^= (unsigned char)(1 + dice_below (&d, 255));
          int same = bt_dive_restore (dive, bad, size, NULL) == BT_OK;
          refused += !same;
          assert_true (bt_dive_hash (dive) == hash); /* what is not in use does not count */
        }
      assert_true (refused > 300);
      assert_int_not_equal (bt_dive_restore (dive, good, size - 8, NULL), BT_OK);
      assert_int_equal (bt_dive_restore (dive, good, size, NULL), BT_OK);
      assert_true (step (dive));
      free (good);
      free (bad);
      bt_dive_free (dive);
    }
}

/* ---- What it costs ---- */

static void
nothing_there_costs_nothing (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    for (int far = 0; far < 2; far++)
      {
        scene s;
        bt_profile p;
        begin_scene (&s, (bt_model_kind)model);
        if (far)
          add_post (&s, "cylinder", "leg", bt__vec (0, 500, 0), bt__vec (0, 0, 1), 1);
        bt_dive *dive = enter (&s);
        operate (dive, BT_OP_DRIVE, 0, 4, (double[]){ 0.7, 0.2, 0.1, 0.3 });
        for (int i = 0; i < 300; i++)
          assert_true (step (dive));
        bt_dive_profile (dive, &p);
        if (!far)
          assert_true (p.links_asked + p.boxes_visited + p.pairs_measured + p.links_clear + p.casts
                           + p.touches + p.contact_rounds + p.truncated + p.span_solves
                           + p.span_skips
                       == 0);
        assert_true (p.pairs_measured + p.casts < 300); /* of some 7000 links */
        bt_dive_free (dive);
      }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (same_again),
    cmocka_unit_test (spoilt_states),
    cmocka_unit_test (nothing_there_costs_nothing),
  };
  return cmocka_run_group_tests_name ("dive_obstacles_state", tests, NULL, NULL);
}
