/* States from outside: what a dive comes to is believed, what no dive comes to is not.

   BIGHT_RUNS: how many spoilt states, from the number BIGHT_FIRST on.  BIGHT_MARK: a file that
   tells which is under way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "../fuzz/state_worlds.h"
#include "../fuzz/targets.h"
#include "world/judge.h"
#include "world/layout.h"

enum
{
  RUNS = 4000,
  CHOICES = 96,
  SLOW = 60 /* s of processor time: no state is worth more */
};

/* ---- The tables ---- */

/* A member that a table leaves out is believed whatever it is: there is none.  */
static void
every_byte_has_a_member (void **state)
{
  size_t n;
  const bt__record *const *all = bt__state_records (&n);
  (void)state;
  for (size_t i = 0; i < n; i++)
    if (bt__record_gap (all[i]) != all[i]->size)
      fail_msg ("byte %zu of the %zu of a %s", bt__record_gap (all[i]), all[i]->size, all[i]->name);
}

/* All that is told of in place of a member of a table that leaves one out, has one twice, or ends
   before the struct does.  */
static void
gaps_are_found (void **state)
{
  typedef struct three
  {
    double a;
    int64_t b;
    double c;
  } three;
  const bt__member whole[]
      = { BT__WITHIN (three, a, 0, 1), BT__TRUTH (three, b), BT__WITHIN (three, c, 0, 1) };
  const bt__member twice[] = { whole[0], whole[1], whole[1], whole[2] };
  (void)state;
  assert_int_equal (bt__record_gap (&(bt__record){ "", sizeof (three), whole, 3 }), 24);
  assert_int_equal (bt__record_gap (&(bt__record){ "", sizeof (three), whole, 2 }), 16);
  assert_int_equal (bt__record_gap (&(bt__record){ "", sizeof (three), whole + 1, 2 }), 0);
  assert_int_equal (bt__record_gap (&(bt__record){ "", sizeof (three), twice, 4 }), 8);
}

/* ---- Sound states ---- */

static void
restores (bt_dive *dive, const char *name)
{
  size_t size = bt_dive_state_size (dive);
  void *kept = malloc (size);
  uint64_t hash = bt_dive_hash (dive);
  bt_error e;
  assert_non_null (kept);
  bt_dive_save (dive, kept);
  if (bt_dive_restore (dive, kept, size, &e) != BT_OK)
    fail_msg ("%s at %g s: %s", name, bt_dive_time (dive), e.text);
  assert_true (bt_dive_hash (dive) == hash);
  free (kept);
}

/* What a dive comes to is believed, whatever is done in it.  */
static void
what_a_dive_comes_to_is_believed (void **state)
{
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *dive = state_world (i);
      for (int k = 0; k < 40; k++)
        {
          double way[] = { 10 * sin (k), 10 * cos (1.7 * k), -6 + 4 * sin (0.3 * k), 5 };
          bt_dive_do (dive, k % 7 == 6 ? BT_OP_PLACE : BT_OP_MOVE, 0, way, k % 7 == 6 ? 3 : 4,
                      NULL);
          bt_dive_do (dive, BT_OP_HAUL_IN, 0, (double[]){ 4, 1 }, k % 5 == 0 ? 2 : 0, NULL);
          restores (dive, state_world_name (i));
          for (int m = 0; m < 15; m++)
            bt_dive_step (dive, NULL);
          restores (dive, state_world_name (i));
        }
      bt_dive_free (dive);
    }
}

/* ---- What is said ---- */

/* Restore DIVE to KEPT, whose checksum is made anew; return what is said.  */
static const char *
said_of (bt_dive *dive, bt__state *kept)
{
  static bt_error e;
  e.text[0] = 0;
  kept->checksum = 0;
  kept->checksum = bt__hash_state (dive, kept);
  bt_dive_restore (dive, kept, bt_dive_state_size (dive), &e);
  return e.text;
}

/* A refusal names the part, the member, what it is and what it may be.  */
static void
refusals_teach (void **state)
{
  bt_dive *dive = state_world (6); /* a moving line in waves, a vehicle with mass */
  bt__state *kept = malloc (bt_dive_state_size (dive));
  (void)state;
  assert_non_null (kept);
  bt_dive_save (dive, kept);
  bt__vehicle *v = bt__dive_vehicle (dive, kept, 0);
  bt__dynamic *chain = bt__dive_chain (dive, kept, 0, 0);
  bt__tether *tether = bt__dive_tether (dive, kept, 0);
  assert_string_equal (said_of (dive, kept), "");
  v->goal = 99;
  assert_string_equal (said_of (dive, kept),
                       "vehicle `minnow': `goal' of its state is 99, not 0 to 3");
  v->goal = 0;
  int64_t n = chain->n;
  chain->n = 1 << 20;
  assert_non_null (strstr (said_of (dive, kept), "tether `line' has 1048576 intervals, not 1 to "));
  chain->n = n;
  tether->props.diameter = -1;
  assert_non_null (strstr (said_of (dive, kept), "tether `line': `diameter' is above 0"));
  tether->props.diameter = dive->model->tethers[0].props.diameter;
  tether->props.nodes = 13;
  assert_string_equal (said_of (dive, kept),
                       "tether `line': its `nodes' is 13, and in its world 12");
  free (kept);
  bt_dive_free (dive);
}

/* A split, which `contacts' tells, is at an object; the last span of a line ends at none.  */
static void
splits_have_an_object (void **state)
{
  int found = 0;
  (void)state;
  for (int i = 0; i < state_worlds (); i++)
    {
      bt_dive *dive = state_world (i);
      bt__state *kept = malloc (bt_dive_state_size (dive));
      assert_non_null (kept);
      bt_dive_save (dive, kept);
      bt__thesis *line = bt__dive_thesis (dive, kept, 0);
      if (bt__dive_tether (dive, kept, 0)->contact_form == BT__TETHER_SPANS && line->spans > 1)
        {
          found++;
          bt__thesis_spans (line)->end.object = -1;
          assert_non_null (
              strstr (said_of (dive, kept), "has -1 for the object of a split, not 0"));
        }
      free (kept);
      bt_dive_free (dive);
    }
  assert_true (found > 0);
}

/* ---- Spoilt states ---- */

/* The I-th choices, whatever was tried before.  */
static void
draw (uint64_t i, uint8_t *bytes)
{
  uint64_t x = i * 0x9e3779b97f4a7c15u + 1;
  for (int k = 0; k < CHOICES; k++)
    {
      x = x * 6364136223846793005u + 1442695040888963407u;
      bytes[k] = (uint8_t)(x >> 56 ^ x >> 37);
    }
}

static long
number_from (const char *name, long otherwise)
{
  const char *text = getenv (name);
  return text ? atol (text) : otherwise;
}

static void
note (uint64_t i)
{
  static FILE *mark;
  const char *file = getenv ("BIGHT_MARK");
  if (!mark && file)
    mark = fopen (file, "w");
  if (!mark)
    return;
  rewind (mark);
  fprintf (mark, "%llu \n", (unsigned long long)i);
  fflush (mark);
}

static void
spoilt_states_do_no_harm (void **state)
{
  long runs = number_from ("BIGHT_RUNS", RUNS), first = number_from ("BIGHT_FIRST", 0);
  uint8_t bytes[CHOICES];
  (void)state;
  for (long i = first; i < first + runs; i++)
    {
      clock_t began = clock ();
      note ((uint64_t)i);
      draw ((uint64_t)i, bytes);
      alarm (10 * SLOW);
      fuzz_state (bytes, sizeof bytes);
      double took = (double)(clock () - began) / CLOCKS_PER_SEC;
      if (took > SLOW)
        fail_msg ("spoilt state %ld took %g s", i, took);
      if (took > 1 && getenv ("BIGHT_MARK"))
        printf ("# %ld took %.1f s\n", i, took);
    }
  alarm (0);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (every_byte_has_a_member),
    cmocka_unit_test (gaps_are_found),
    cmocka_unit_test (what_a_dive_comes_to_is_believed),
    cmocka_unit_test (refusals_teach),
    cmocka_unit_test (splits_have_an_object),
    cmocka_unit_test (spoilt_states_do_no_harm),
  };
  if (getenv ("BIGHT_RUNS"))
    cmocka_set_test_filter ("spoilt*");
  return cmocka_run_group_tests (tests, NULL, NULL);
}
