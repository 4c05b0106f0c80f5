/* What is copied of a state, and what is written in place: nothing is missed.

   Laws, in every world of state_worlds.c, after each of many acts.  The two states of a dive
   are the same once the parts said to have changed are copied.  What lies behind the used part of
   an array is never read: a twin, all of whose unused room is poisoned, goes the same way.  An
   order written to the present state leaves what the operation on a copy leaves.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../fuzz/state_worlds.h"
#include "../oracle/dive_scene.h"
#include "testbed/order.h"
#include "testbed/overwrite.h"
#include "world/layout.h"
#include "world/obstacles.h"

enum
{
  ACTS = 12,
  OTHER_MODEL = 5 /* every act of a number by this: a line that moved is still, or the reverse */
};

/* The K-th act on DIVE; most are steps.  Refusals are as good as the rest.  */
static void
act (bt_dive *dive, int k)
{
  double way[] = { 8 * sin (k), 8 * cos (1.7 * k), -6 + 4 * sin (0.3 * k), 5 };
  double stick[] = { sin (k), NAN, 0.2, cos (k) }, spool[] = { 2 + k % 3, 1 };
  double rough[] = { BT_PART_OBSTACLE, 0, 0.1 + 0.01 * k }, off[] = { BT_PART_TETHER, 0, k & 1 };
  static const struct
  {
    bt_op op;
    int n;
  } acts[] = { { BT_OP_DRIVE, 4 },   { BT_OP_MOVE, 4 },         { BT_OP_HAUL_IN, 2 },
               { BT_OP_COLLIDE, 3 }, { BT_OP_PLACE, 3 },        { BT_OP_ALTER, 3 },
               { BT_OP_PAY_OUT, 2 }, { BT_OP_HOLD_HEADING, 1 }, { BT_OP_RELEASE, 0 } };
  const double *args[] = { stick, way, spool, off, way, rough, spool, stick, NULL };
  size_t which = (size_t)k % (sizeof acts / sizeof *acts);
  if (k % OTHER_MODEL == OTHER_MODEL - 1)
    take_model (dive, 0, k / OTHER_MODEL % 2 ? BT_MODEL_DYNAMIC : BT_MODEL_STEADY);
  bt_dive_do (dive, acts[which].op, 0, args[which], acts[which].n, NULL);
}

static void
run (bt_dive *dive, int steps)
{
  while (steps-- > 0)
    (void)bt_dive_step (dive, NULL);
}

static int
is_level (bt_dive *dive)
{
  return bt__hash_state (dive, bt__dive_begin (dive)) == bt_dive_hash (dive);
}

static void
both_states_are_level (void **state)
{
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *dive = state_world (i);
      for (int k = 0; k < ACTS; k++)
        {
          act (dive, k);
          if (!is_level (dive))
            fail_msg ("%s: after act %d", state_world_name (i), k);
          for (int m = 0; m < 4; m++)
            {
              run (dive, 1);
              if (!is_level (dive))
                fail_msg ("%s: a step after act %d", state_world_name (i), k);
            }
        }
      bt_dive_free (dive);
    }
}

/* What a look at the windings tells is told in both states.  Here it puts right what was told
   wrongly.  */
static void
windings_are_level (void **state)
{
  static scene s;
  (void)state;
  begin_scene (&s, BT_MODEL_DYNAMIC);
  add_post (&s, "capsule", "post", (bt_vec3){ 0, -5, 0 }, (bt_vec3){ 0, 0, 1 }, 0.3);
  bt_dive *dive = enter (&s);
  operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 6, 1, -6, 1 });
  run (dive, 40);
  bt__dive_told (dive, bt__dive_begin (dive), 0)[0] = 1;
  bt__dive_told (dive, dive->now, 0)[0] = 1;
  for (int m = 0; m < 30; m++)
    {
      run (dive, 1);
      assert_true (is_level (dive));
    }
  assert_int_equal (bt__dive_told (dive, dive->now, 0)[0], 0);
  bt_dive_free (dive);
}

/* Make every byte of *STATE that is not in use 0xff: a NaN, or a number out of any range.  */
static void
poison (const bt_dive *dive, bt__state *state)
{
  size_t size = bt_dive_state_size (dive);
  bt__state *live = malloc (size);
  assert_non_null (live);
  memset (live, 0xff, size);
  bt__copy_state (dive, live, state);
  memcpy (state, live, size);
  free (live);
}

static void
unused_room_is_not_read (void **state)
{
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *clean = state_world (i), *foul = state_world (i);
      for (int k = 0; k < ACTS; k++)
        {
          poison (foul, bt__dive_begin (foul));
          poison (foul, foul->now);
          act (clean, k);
          act (foul, k);
          run (clean, 4);
          run (foul, 4);
          if (bt_dive_hash (clean) != bt_dive_hash (foul))
            fail_msg ("%s: after act %d", state_world_name (i), k);
        }
      bt_dive_free (clean);
      bt_dive_free (foul);
    }
}

/* Numbers that a step could take for those of a step before, and numbers that are none.  */
static void
the_workspace_remembers_nothing (void **state)
{
  static const int bytes[] = { 0xff, 0x3f, 0xbf };
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *clean = state_world (i), *foul = state_world (i);
      for (int k = 0; k < ACTS; k++)
        {
          act (clean, k);
          act (foul, k);
          for (int m = 0; m < 4; m++)
            {
              if (foul->work)
                overwrite_work (foul->work, bytes[(k + m) % 3]);
              run (clean, 1);
              run (foul, 1);
            }
          if (bt_dive_hash (clean) != bt_dive_hash (foul))
            fail_msg ("%s: after act %d", state_world_name (i), k);
        }
      bt_dive_free (clean);
      bt_dive_free (foul);
    }
}

static void
orders_in_place_are_operations (void **state)
{
  int in_place = 0;
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *a = state_world (i), *b = state_world (i);
      for (int k = 0; k < ACTS; k++)
        {
          double sticks[] = { sin (k), cos (2 * k), 0.1, NAN };
          const bt__state *was = a->now;
          assert_int_equal (order_drive_copy (b, sticks, NULL), BT_OK);
          assert_int_equal (bt_dive_do (a, BT_OP_DRIVE, 0, sticks, 4, NULL), BT_OK);
          in_place += a->now == was;
          if (bt_dive_hash (a) != bt_dive_hash (b))
            fail_msg ("%s: driven %d times", state_world_name (i), k + 1);
          run (a, 5);
          run (b, 5);
          if (bt_dive_hash (a) != bt_dive_hash (b))
            fail_msg ("%s: flown on after %d", state_world_name (i), k + 1);
        }
      bt_dive_free (a);
      bt_dive_free (b);
    }
  assert_true (in_place > ACTS * state_worlds () / 2);
}

/* A state kept without its unused room unpacks to the bytes that are saved, and is gone back to;
   cut off anywhere it is refused, and the dive stays as it is.  */
static void
kept_states_are_saved_states (void **state)
{
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *dive = state_world (i);
      size_t size = bt_dive_state_size (dive), room = bt_dive_keep_size (dive);
      void *saved = malloc (size), *again = malloc (size), *kept = malloc (room);
      assert_true (saved && again && kept);
      poison (dive, dive->now);
      bt_dive_save (dive, saved);
      assert_int_equal (bt_dive_keep (dive, kept), room);
      assert_int_equal (bt_state_unpack (kept, room, again, size, NULL), BT_OK);
      if (memcmp (saved, again, size) != 0)
        fail_msg ("%s: kept otherwise than saved", state_world_name (i));
      uint64_t was = bt_dive_hash (dive);
      run (dive, 7);
      uint64_t later = bt_dive_hash (dive);
      for (size_t k = 1; k < 40; k++)
        assert_int_not_equal (bt_dive_restore (dive, kept, room * k / 40 / 8 * 8, NULL), BT_OK);
      assert_true (bt_dive_hash (dive) == later);
      assert_int_equal (bt_dive_restore (dive, kept, room, NULL), BT_OK);
      assert_true (bt_dive_hash (dive) == was);
      run (dive, 7);
      assert_true (bt_dive_hash (dive) == later);
      free (saved);
      free (again);
      free (kept);
      bt_dive_free (dive);
    }
}

/* A refused order leaves no trace.  */
static void
refused_orders_leave_nothing (void **state)
{
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *dive = state_world (i);
      uint64_t was = bt_dive_hash (dive);
      assert_int_not_equal (
          bt_dive_do (dive, BT_OP_DRIVE, 0, (double[]){ 0.5, 0, 0, 1.5 }, 4, NULL), BT_OK);
      assert_int_not_equal (bt_dive_do (dive, BT_OP_MOVE, 0, (double[]){ 1, 1, -3, -1 }, 4, NULL),
                            BT_OK);
      assert_int_not_equal (bt_dive_do (dive, BT_OP_FAULT, 0, (double[]){ 9, 1, 0 }, 3, NULL),
                            BT_OK);
      assert_true (bt_dive_hash (dive) == was);
      bt_dive_free (dive);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (both_states_are_level),
    cmocka_unit_test (windings_are_level),
    cmocka_unit_test (unused_room_is_not_read),
    cmocka_unit_test (the_workspace_remembers_nothing),
    cmocka_unit_test (orders_in_place_are_operations),
    cmocka_unit_test (kept_states_are_saved_states),
    cmocka_unit_test (refused_orders_leave_nothing),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
