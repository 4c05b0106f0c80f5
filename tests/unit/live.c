/* Live dives: the queue decides, not the clock; who reads never waits for the dive nor holds it up;
   copies are whole.  Run it under the thread sanitizer, too.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include <bight/bight.h>

/* ---- A dive ---- */

/* A vehicle on 30 m of moving line, in a current.  */
static bt_dive *
begin (void)
{
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_world world;
  bt_model *model;
  bt_dive *dive;
  bt_error e;
  memset (&world, 0, sizeof world);
  bt_def_init (bt_head_find ("sea"), &world.sea);
  bt_def_init (bt_head_find ("rov"), &vehicle);
  bt_def_init (bt_head_find ("tether"), &tether);
  world.sea.current.kind = BT_CURRENT_UNIFORM;
  world.sea.current.velocity[0] = bt_set_and_drift (0.3, 1);
  assert_int_equal (bt_def_set_name (vehicle.name, "minnow", &e), BT_OK);
  assert_int_equal (bt_def_set_name (tether.name, "line", &e), BT_OK);
  assert_int_equal (bt_def_set_name (tether.to.part, "minnow", &e), BT_OK);
  vehicle.at = (bt_vec3){ 0, 20, -5 };
  tether.length = 30;
  tether.props.nodes = 20;
  tether.props.model = BT_MODEL_DYNAMIC;
  world.vehicles = &vehicle;
  world.n_vehicles = 1;
  world.tethers = &tether;
  world.n_tethers = 1;
  assert_int_equal (bt_model_new (&world, &model, &e), BT_OK);
  assert_int_equal (bt_dive_new (model, NULL, NULL, &dive, &e), BT_OK);
  bt_model_release (model);
  return dive;
}

static bt_dive *
fork_of (const bt_dive *dive)
{
  bt_dive *copy;
  bt_error e;
  assert_int_equal (bt_dive_fork (dive, &copy, &e), BT_OK);
  return copy;
}

static bt_live *
start (bt_dive *dive, double pace, int64_t until)
{
  bt_live_options options = bt_live_default_options ();
  bt_live *live;
  bt_error e;
  options.pace = pace;
  options.until = until;
  options.log = 1;
  assert_int_equal (bt_live_start (dive, &options, &live, &e), BT_OK);
  return live;
}

/* ---- A script: commands at steps ---- */

enum
{
  LINES = 40,
  LENGTH = 300 /* steps */
};

typedef struct line
{
  int64_t step;
  bt_op op;
  int n;
  double args[4];
} line;

static double
chance (uint64_t *seed)
{
  *seed = *seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(*seed >> 11) / 9007199254740992.0;
}

static void
write_script (line *script, uint64_t seed)
{
  for (int i = 0; i < LINES; i++)
    {
      line *l = &script[i];
      l->step = (int64_t)(chance (&seed) * LENGTH);
      l->op = chance (&seed) < 0.5 ? BT_OP_DRIVE : BT_OP_PAY_OUT;
      l->n = l->op == BT_OP_DRIVE ? 4 : 2;
      l->args[0] = chance (&seed);
      l->args[1] = l->op == BT_OP_DRIVE ? chance (&seed) : 0.5;
      l->args[2] = NAN;
      l->args[3] = chance (&seed) - 0.5;
    }
}

/* Do the script in this thread, and return the hash at its end.  */
static uint64_t
play (const bt_dive *dive, const line *script)
{
  bt_dive *copy = fork_of (dive);
  uint64_t hash;
  bt_error e;
  for (int64_t step = 0; step < LENGTH; step++)
    {
      for (int i = 0; i < LINES; i++)
        if (script[i].step == step)
          bt_dive_do (copy, script[i].op, 0, script[i].args, script[i].n, &e);
      assert_int_equal (bt_dive_step (copy, &e), BT_OK);
    }
  hash = bt_dive_hash (copy);
  bt_dive_free (copy);
  return hash;
}

static uint64_t
play_live (const bt_dive *dive, const line *script, double pace)
{
  bt_dive *copy = fork_of (dive);
  uint64_t hash;
  bt_error e;
  /* Time stands still at step 0 until all is in the queue: one posted after its step would be late.
   */
  bt_live *live = start (copy, pace, 0);
  for (int i = 0; i < LINES; i++)
    assert_int_equal (
        bt_live_post (live, script[i].step, script[i].op, 0, script[i].args, script[i].n, &e),
        BT_OK);
  bt_live_until (live, LENGTH);
  assert_int_equal (bt_live_wait (live, LENGTH, INFINITY), LENGTH);
  assert_int_equal (bt_live_stop (live, &e), BT_OK);
  assert_int_equal (bt_dive_steps (copy), LENGTH);
  hash = bt_dive_hash (copy);
  bt_dive_free (copy);
  return hash;
}

static void
the_queue_decides (void **unused)
{
  bt_dive *dive = begin ();
  line script[LINES];
  (void)unused;
  for (uint64_t seed = 1; seed <= 5; seed++)
    {
      uint64_t wanted;
      write_script (script, seed);
      wanted = play (dive, script);
      assert_true (play_live (dive, script, 0) == wanted);
      assert_true (play_live (dive, script, 50) == wanted);
    }
  bt_dive_free (dive);
}

/* ---- Commands ---- */

typedef struct story
{
  int n, refused;
  line done[1000];
} story;

static void
see (void *user, const bt_live_command *command)
{
  story *l = user;
  l->refused += command->status != BT_OK;
  if (command->status != BT_OK || l->n == 1000)
    return;
  l->done[l->n] = (line){ .step = command->step, .op = command->op, .n = command->n };
  memcpy (l->done[l->n].args, command->args, sizeof (double) * (size_t)command->n);
  l->n++;
}

static void
the_log_replays (void **unused)
{
  bt_dive *dive = begin (), *again = fork_of (dive);
  bt_live *live = start (dive, 20, -1);
  story l = { 0 };
  uint64_t seed = 3;
  bt_error e;
  (void)unused;
  for (int i = 0; i < 60; i++)
    {
      double sticks[4] = { chance (&seed), NAN, NAN, chance (&seed) };
      if (i % 10 == 9)
        sticks[0] = 2; /* refused */
      assert_int_equal (bt_live_post (live, -1, BT_OP_DRIVE, 0, sticks, 4, &e), BT_OK);
      bt_live_wait (live, bt_live_steps (live) + 3, 1);
    }
  bt_live_drain (live, see, &l);
  assert_int_equal (bt_live_stop (live, &e), BT_OK);
  assert_int_equal (l.n, 54);
  assert_int_equal (l.refused, 6);
  for (int i = 0; i < l.n; i++)
    {
      while (bt_dive_steps (again) < l.done[i].step)
        assert_int_equal (bt_dive_step (again, &e), BT_OK);
      assert_int_equal (bt_dive_do (again, l.done[i].op, 0, l.done[i].args, l.done[i].n, &e),
                        BT_OK);
    }
  while (bt_dive_steps (again) < bt_dive_steps (dive))
    assert_int_equal (bt_dive_step (again, &e), BT_OK);
  assert_true (bt_dive_hash (again) == bt_dive_hash (dive));
  bt_dive_free (dive);
  bt_dive_free (again);
}

static void
commands_are_answered (void **unused)
{
  bt_dive *dive = begin (), *view = fork_of (dive);
  bt_live *live = start (dive, 1, -1);
  double fast[] = { 2, 0, 0, 0 }, ahead[] = { 0.5, 0, 0, 0 };
  bt_vehicle_view v;
  int64_t step = -1;
  bt_error e;
  (void)unused;
  assert_int_equal (bt_live_do (live, BT_OP_DRIVE, 0, fast, 4, NULL, &e), BT_ERR_DOMAIN);
  assert_non_null (strstr (e.text, "2"));
  assert_int_equal (bt_live_do (live, BT_OP_DRIVE, 7, ahead, 4, NULL, &e), BT_ERR_NAME);
  assert_int_equal (bt_live_do (live, (bt_op)99, 0, ahead, 4, NULL, &e), BT_ERR_NAME);
  assert_int_equal (bt_live_do (live, BT_OP_DRIVE, 0, ahead, 4, &step, &e), BT_OK);
  assert_true (step >= 0 && step <= bt_live_steps (live));
  assert_int_equal (bt_live_read (live, view, &e), BT_OK);
  assert_int_equal (bt_dive_vehicle (view, 0, &v, &e), BT_OK);
  assert_true (v.sticks[0] == 0.5); /* what was done is what one reads */
  assert_int_equal (bt_live_stop (live, &e), BT_OK);
  bt_dive_free (dive);
  bt_dive_free (view);
}

/* ---- Readers ---- */

typedef struct reader
{
  bt_live *live;
  bt_dive *view;
  int reads, wrong;
} reader;

static void *
read_on (void *data)
{
  reader *r = data;
  int64_t last = 0;
  bt_error e;
  for (int i = 0; i < 300; i++)
    {
      r->wrong += bt_live_read (r->live, r->view, &e) != BT_OK || bt_dive_steps (r->view) < last;
      last = bt_dive_steps (r->view);
      r->reads++;
    }
  return NULL;
}

static void
copies_are_whole (void **unused)
{
  enum
  {
    READERS = 3
  };
  bt_dive *dive = begin ();
  reader readers[READERS];
  pthread_t threads[READERS];
  bt_error e;
  bt_live *live;
  (void)unused;
  for (int i = 0; i < READERS; i++)
    readers[i] = (reader){ .view = fork_of (dive) };
  live = start (dive, 0, -1);
  for (int i = 0; i < READERS; i++)
    {
      readers[i].live = live;
      assert_int_equal (pthread_create (&threads[i], NULL, read_on, &readers[i]), 0);
    }
  for (int i = 0; i < READERS; i++)
    {
      pthread_join (threads[i], NULL);
      assert_int_equal (readers[i].wrong, 0); /* a torn copy would not be restored */
      bt_dive_free (readers[i].view);
    }
  assert_int_equal (bt_live_stop (live, &e), BT_OK);
  bt_dive_free (dive);
}

/* ---- Time ---- */

static double
seconds_now (void)
{
  struct timespec t;
  timespec_get (&t, TIME_UTC);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void
time_passes_by_itself (void **unused)
{
  bt_dive *dive = begin ();
  bt_live *live = start (dive, 10, -1);
  double before = seconds_now (), passed;
  int64_t steps = bt_live_wait (live, 120, INFINITY);
  bt_error e;
  (void)unused;
  passed = seconds_now () - before;
  assert_true (steps >= 120);
  /* Two seconds of the dive at ten times the pace: never faster; how much slower, the machine
   * knows. */
  assert_true (passed > 0.19);
  assert_true (bt_live_late (live) <= passed);
  assert_int_equal (bt_live_status (live, &e), BT_OK);
  assert_int_equal (bt_live_stop (live, &e), BT_OK);
  steps = bt_dive_steps (dive);
  assert_true (steps >= 120);
  bt_dive_free (dive);
}

static void
moments_are_the_seconds (void **unused)
{
  bt_dive *dive = begin (), *again = fork_of (dive);
  size_t size = bt_dive_state_size (dive);
  void *state = malloc (size);
  bt_live *live;
  int64_t step;
  uint64_t hash;
  bt_error e;
  (void)unused;
  live = start (dive, 0, 70 * 60);
  bt_live_wait (live, 70 * 60, INFINITY);
  assert_int_equal (bt_live_moments (live), 60); /* as many as the options say */
  for (int i = 0; i < 60; i++)
    {
      assert_true (bt_live_moment (live, i, &step, &hash, state) == size);
      assert_int_equal (step, (11 + i) * 60);
      assert_int_equal (bt_dive_restore (again, state, size, &e), BT_OK);
      assert_true (bt_dive_hash (again) == hash);
      assert_int_equal (bt_dive_steps (again), step);
    }
  assert_true (bt_live_moment (live, 60, &step, &hash, NULL) == 0);
  assert_int_equal (bt_live_stop (live, &e), BT_OK);
  free (state);
  bt_dive_free (dive);
  bt_dive_free (again);
}

static void
options_are_checked (void **unused)
{
  bt_dive *dive = begin ();
  bt_live_options options = bt_live_default_options ();
  bt_live *live;
  bt_error e;
  (void)unused;
  options.pace = NAN;
  assert_int_equal (bt_live_start (dive, &options, &live, &e), BT_ERR_DOMAIN);
  options.pace = 1;
  options.moments = -1;
  assert_int_equal (bt_live_start (dive, &options, &live, &e), BT_ERR_DOMAIN);
  assert_int_equal (bt_live_stop (NULL, &e), BT_OK);
  bt_dive_free (dive);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (the_queue_decides),     cmocka_unit_test (the_log_replays),
    cmocka_unit_test (commands_are_answered), cmocka_unit_test (copies_are_whole),
    cmocka_unit_test (time_passes_by_itself), cmocka_unit_test (moments_are_the_seconds),
    cmocka_unit_test (options_are_checked),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
