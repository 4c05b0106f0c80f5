/* The dive as a machine: operations that succeed whole or not at all, forks and checkpoints that
   are bit-equal, work that is skipped, no allocation in a step, and memory that runs out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/bight.h>
#include "testbed/profile.h"

/* ---- Counting and refusing allocations ---- */

#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__
#define CAN_COUNT 1

void *__libc_malloc (size_t);
void *__libc_calloc (size_t, size_t);
void *__libc_realloc (void *, size_t);

static long allocations;  /* since the program began */
static long fail_at = -1; /* the allocation of this number is refused; -1: none */

static int
refuse (void)
{
  return allocations++ == fail_at;
}

void *
malloc (size_t n)
{
  return refuse () ? NULL : __libc_malloc (n);
}

void *
calloc (size_t n, size_t size)
{
  return refuse () ? NULL : __libc_calloc (n, size);
}

void *
realloc (void *p, size_t n)
{
  return refuse () ? NULL : __libc_realloc (p, n);
}
#endif

/* ---- A small world ---- */

static const double east = 1.57079632679489661923; /* a bearing, radians */

typedef struct scene
{
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_world world;
} scene;

/* One vehicle 20 m across and 10 m up-current of its anchor on 40 m of neutral line.  */
static void
make_scene (scene *s, bt_model_kind model)
{
  bt_error e;
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  bt_def_init (bt_head_find ("rov"), &s->vehicle);
  bt_def_init (bt_head_find ("tether"), &s->tether);
  s->world.sea.current.kind = BT_CURRENT_UNIFORM;
  s->world.sea.current.velocity[0] = bt_set_and_drift (0.5, east);
  assert_int_equal (bt_def_set_name (s->vehicle.name, "minnow", &e), BT_OK);
  assert_int_equal (bt_def_set_name (s->tether.name, "line", &e), BT_OK);
  assert_int_equal (bt_def_set_name (s->tether.to.part, "minnow", &e), BT_OK);
  s->vehicle.at = (bt_vec3){ -10, 20, 0 };
  s->tether.length = 40;
  s->tether.props.wet_weight = 0;
  s->tether.props.model = model;
  s->world.vehicles = &s->vehicle;
  s->world.n_vehicles = 1;
  s->world.tethers = &s->tether;
  s->world.n_tethers = 1;
}

static bt_dive *
begin (bt_model_kind model)
{
  scene s;
  bt_model *compiled;
  bt_dive *dive;
  bt_error e;
  make_scene (&s, model);
  assert_int_equal (bt_model_new (&s.world, &compiled, &e), BT_OK);
  assert_int_equal (bt_dive_new (compiled, NULL, NULL, &dive, &e), BT_OK);
  bt_model_release (compiled);
  return dive;
}

static void
drive (bt_dive *dive, double surge, double yaw)
{
  bt_error e;
  double sticks[] = { surge, NAN, NAN, yaw };
  assert_int_equal (bt_dive_do (dive, BT_OP_DRIVE, 0, sticks, 4, &e), BT_OK);
}

static void
step (bt_dive *dive, int n)
{
  bt_error e;
  while (n-- > 0)
    assert_int_equal (bt_dive_step (dive, &e), BT_OK);
}

/* ---- Tests ---- */

#ifdef CAN_COUNT
/* Work space grows with the line and with what the line touches: the same steps again need no more
   of it.  */
static void
steps_taken_before_allocate_nothing (void **unused)
{
  (void)unused;
  for (int model = BT_MODEL_RUBBER_BAND; model <= BT_MODEL_AUTO; model++)
    {
      bt_dive *dive = begin ((bt_model_kind)model);
      size_t size = bt_dive_state_size (dive);
      void *state = malloc (size);
      long before;
      bt_error e;
      drive (dive, 0.8, 0.1);
      bt_dive_save (dive, state);
      step (dive, 120);
      assert_int_equal (bt_dive_restore (dive, state, size, &e), BT_OK);
      before = allocations;
      step (dive, 120);
      assert_true (allocations == before);
      free (state);
      bt_dive_free (dive);
    }
}

/* A line that the current has pressed to a post, about to be hauled along the post.  */
static bt_dive *
begin_at_a_post (void)
{
  scene s;
  bt_obstacle_def post;
  bt_model *model;
  bt_dive *dive;
  bt_error e;
  make_scene (&s, BT_MODEL_DYNAMIC);
  bt_def_init (bt_head_find ("capsule"), &post);
  assert_int_equal (bt_def_set_name (post.name, "post", &e), BT_OK);
  post.from = (bt_vec3){ 4, 10, -8 };
  post.to = (bt_vec3){ 4, 10, 8 };
  post.radius = 0.3;
  s.world.obstacles = &post;
  s.world.n_obstacles = 1;
  assert_int_equal (bt_model_new (&s.world, &model, &e), BT_OK);
  assert_int_equal (bt_dive_new (model, NULL, NULL, &dive, &e), BT_OK);
  bt_model_release (model);
  step (dive, 900);
  drive (dive, 1, 0.3);
  return dive;
}

enum
{
  SHORT = 40 /* steps */
};

/* Step a fork of DIVE, the NTH allocation in its steps being refused, and again what that stops;
 *REFUSED: it was asked for.  Return the hash at the end.  */
static uint64_t
hash_without (const bt_dive *dive, long nth, int *refused)
{
  bt_dive *fork;
  bt_error e;
  uint64_t hash = 0;
  assert_int_equal (bt_dive_fork (dive, &fork, &e), BT_OK);
  long least = allocations;
  fail_at = nth < 0 ? -1 : least + nth;
  for (int k = 0; k < SHORT; k++)
    {
      hash = bt_dive_hash (fork);
      if (bt_dive_step (fork, &e) == BT_OK)
        continue;
      assert_int_equal (e.status, BT_ERR_LIMIT);
      assert_true (bt_dive_hash (fork) == hash);
      fail_at = -1;
      step (fork, 1);
    }
  *refused = allocations > least + nth;
  fail_at = -1;
  hash = bt_dive_hash (fork);
  bt_dive_free (fork);
  return hash;
}

static void
a_step_without_memory_is_an_error (void **unused)
{
  bt_dive *dive = begin_at_a_post ();
  int refused;
  uint64_t wanted = hash_without (dive, -1, &refused);
  long nth = 0;
  bt_profile p;
  (void)unused;
  bt_dive_profile (dive, &p);
  assert_true (p.touches > 100);
  for (refused = 1; refused; nth++)
    assert_true (hash_without (dive, nth, &refused) == wanted);
  assert_true (nth > 40);
  bt_dive_free (dive);
}

static void
memory_running_out_is_an_error (void **unused)
{
  scene s;
  int failures = 0;
  (void)unused;
  make_scene (&s, BT_MODEL_STEADY);
  for (long nth = 0;; nth++)
    {
      bt_model *model = NULL;
      bt_dive *dive = NULL;
      bt_error e = { .status = BT_OK };
      bt_status status;
      fail_at = allocations + nth;
      status = bt_model_new (&s.world, &model, &e);
      if (status == BT_OK)
        status = bt_dive_new (model, NULL, NULL, &dive, &e);
      fail_at = -1;
      bt_dive_free (dive);
      bt_model_release (model);
      if (status == BT_OK)
        break;
      assert_int_equal (status, BT_ERR_LIMIT);
      assert_int_equal (e.status, BT_ERR_LIMIT);
      failures++;
    }
  assert_true (failures > 10);
}
#endif

static void
fork_goes_on_bit_equal (bt_model_kind model)
{
  bt_dive *dive = begin (model), *fork;
  bt_error e;
  drive (dive, 0.7, 0.2);
  step (dive, 100);
  assert_int_equal (bt_dive_fork (dive, &fork, &e), BT_OK);
  assert_true (bt_dive_hash (dive) == bt_dive_hash (fork));
  step (fork, 200);
  assert_true (bt_dive_hash (dive) != bt_dive_hash (fork));
  step (dive, 200);
  assert_true (bt_dive_hash (dive) == bt_dive_hash (fork));
  bt_dive_free (fork);
  bt_dive_free (dive);
}

static void
a_fork_goes_on_bit_equal (void **unused)
{
  (void)unused;
  for (int model = BT_MODEL_RUBBER_BAND; model <= BT_MODEL_AUTO; model++)
    fork_goes_on_bit_equal ((bt_model_kind)model);
}

static void
checkpoint_brings_everything_back (bt_model_kind model)
{
  bt_dive *dive = begin (model);
  size_t size = bt_dive_state_size (dive);
  void *state = malloc (size);
  uint64_t then, later;
  bt_error e;
  drive (dive, 0.7, 0.2);
  step (dive, 50);
  then = bt_dive_hash (dive);
  bt_dive_save (dive, state);
  step (dive, 50);
  later = bt_dive_hash (dive);
  assert_int_equal (bt_dive_restore (dive, state, size, &e), BT_OK);
  assert_true (bt_dive_hash (dive) == then);
  step (dive, 50);
  assert_true (bt_dive_hash (dive) == later);
  free (state);
  bt_dive_free (dive);
}

static void
a_checkpoint_brings_everything_back (void **unused)
{
  (void)unused;
  for (int model = BT_MODEL_RUBBER_BAND; model <= BT_MODEL_AUTO; model++)
    checkpoint_brings_everything_back ((bt_model_kind)model);
}

static void
foreign_and_damaged_states_are_refused (void **unused)
{
  bt_dive *dive = begin (BT_MODEL_CATENARY), *other = begin (BT_MODEL_V_SHAPE);
  size_t size = bt_dive_state_size (dive);
  unsigned char *state = malloc (size);
  uint64_t before = bt_dive_hash (dive);
  bt_error e;
  (void)unused;
  bt_dive_save (other, state);
  assert_int_equal (bt_dive_restore (dive, state, size, &e), BT_ERR_STALE);
  bt_dive_save (dive, state);
  state[100] ^= 1;
  assert_int_equal (bt_dive_restore (dive, state, size, &e), BT_ERR_FORMAT);
  assert_int_equal (bt_dive_restore (dive, state, size - 8, &e), BT_ERR_STALE);
  assert_true (bt_dive_hash (dive) == before);
  free (state);
  bt_dive_free (other);
  bt_dive_free (dive);
}

/* Packed and unpacked a state is the same; it takes no room for what is not in use; what is no
   packed state of that size is refused.  */
static void
a_state_is_packed (void **unused)
{
  bt_dive *dive = begin (BT_MODEL_DYNAMIC);
  size_t size = bt_dive_state_size (dive);
  uint64_t *state = calloc (1, size), *again = malloc (size);
  bt_error e;
  (void)unused;
  drive (dive, 0.7, 0.2);
  step (dive, 50);
  bt_dive_save (dive, state);
  size_t n = bt_state_pack (state, size, NULL);
  uint64_t *packed = malloc (n);
  assert_int_equal (bt_state_pack (state, size, packed), n);
  assert_true (n < size / 4 && bt_state_is_packed (packed, n) && !bt_state_is_packed (state, size));
  memset (again, 1, size);
  assert_int_equal (bt_state_unpack (packed, n, again, size, &e), BT_OK);
  assert_memory_equal (state, again, size);
  for (size_t k = 8; k < n; k += 8)
    assert_int_equal (bt_state_unpack (packed, k, again, size, &e), BT_ERR_STALE);
  assert_int_equal (bt_state_unpack (packed, n, again, size - 8, &e), BT_ERR_STALE);
  for (int k = 1; k < 3; k++)
    {
      uint64_t count = packed[k];
      packed[k] = UINT64_MAX - 1;
      assert_int_equal (bt_state_unpack (packed, n, again, size, &e), BT_ERR_STALE);
      packed[k] = count;
    }
  free (packed);
  free (state);
  free (again);
  bt_dive_free (dive);
}

static void
a_refused_operation_changes_nothing (void **unused)
{
  static const struct
  {
    bt_op op;
    int subject;
    double args[4];
    int n;
    bt_status why;
  } cases[] = {
    { BT_OP_DRIVE, 0, { 2, 0, 0, 0 }, 4, BT_ERR_DOMAIN },
    { BT_OP_DRIVE, 1, { 0, 0, 0, 0 }, 4, BT_ERR_NAME },
    { BT_OP_DRIVE, 0, { 0, 0, 0, 0 }, 3, BT_ERR_DOMAIN },
    { BT_OP_PLACE, 0, { NAN, 0, 0 }, 3, BT_ERR_DOMAIN },
    { BT_OP_PLACE, 0, { INFINITY, 0, 0 }, 3, BT_ERR_DOMAIN },
    { BT_OP_LAY, 0, { 1000, 0, 0 }, 3, BT_ERR_DOMAIN },
    { BT_OP_MOVE, 0, { 0, 0, 0, -1 }, 4, BT_ERR_DOMAIN },
    { BT_OP_PAY_OUT, 0, { -1, 1 }, 2, BT_ERR_DOMAIN },
    { BT_OP_HAUL_IN, 0, { 41, 1 }, 2, BT_ERR_DOMAIN },
    { BT_OP_CURRENT, 0, { 99, 0, 0, 0 }, 4, BT_ERR_DOMAIN },
    { BT_OP_ALTER, 0, { BT_PART_TETHER, 999, 1 }, 3, BT_ERR_NAME },
    { BT_OP_ALTER, 0, { BT_PART_TETHER, 2, 1 }, 3, BT_ERR_DOMAIN },
    { BT_OP_COUNT, 0, { 0 }, 0, BT_ERR_NAME },
  };
  bt_dive *dive = begin (BT_MODEL_CATENARY);
  uint64_t before = bt_dive_hash (dive);
  (void)unused;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      bt_error e = { .status = BT_OK };
      bt_status status
          = bt_dive_do (dive, cases[i].op, cases[i].subject, cases[i].args, cases[i].n, &e);
      assert_int_equal (status, cases[i].why);
      assert_int_equal (e.status, cases[i].why);
      assert_true (strlen (e.text) > 10);
      assert_true (bt_dive_hash (dive) == before);
    }
  assert_int_equal (profile_of (dive).refused, sizeof cases / sizeof *cases);
  bt_dive_free (dive);
}

static void
what_did_not_change_is_not_solved (void **unused)
{
  bt_dive *dive = begin (BT_MODEL_STEADY);
  bt_profile before = profile_of (dive), after;
  (void)unused;
  step (dive, 60);
  after = profile_of (dive);
  assert_int_equal (after.shape_solves, before.shape_solves);
  assert_int_equal (after.shape_skips, before.shape_skips + 60);
  assert_int_equal (after.marches, before.marches);
  drive (dive, 1, 0);
  step (dive, 1);
  assert_int_equal (profile_of (dive).shape_solves, before.shape_solves + 1);
  bt_dive_free (dive);
}

static void
still_water_needs_no_shooting (void **unused)
{
  scene s;
  bt_model *model;
  bt_dive *dive;
  bt_error e;
  (void)unused;
  make_scene (&s, BT_MODEL_STEADY);
  s.world.sea.current.kind = BT_CURRENT_STILL;
  assert_int_equal (bt_model_new (&s.world, &model, &e), BT_OK);
  assert_int_equal (bt_dive_new (model, NULL, NULL, &dive, &e), BT_OK);
  drive (dive, 1, 0);
  step (dive, 60);
  assert_int_equal (profile_of (dive).shots, 0);
  assert_int_equal (profile_of (dive).relaxations, 0);
  bt_dive_free (dive);
  bt_model_release (model);
}

static void
two_worlds_live_side_by_side (void **unused)
{
  bt_dive *a = begin (BT_MODEL_CATENARY), *b = begin (BT_MODEL_CATENARY), *alone;
  (void)unused;
  drive (a, 1, 0);
  drive (b, -1, 0.5);
  for (int i = 0; i < 60; i++)
    {
      step (a, 1);
      step (b, 2);
    }
  alone = begin (BT_MODEL_CATENARY);
  drive (alone, 1, 0);
  step (alone, 60);
  assert_true (bt_dive_hash (a) == bt_dive_hash (alone));
  bt_dive_free (alone);
  bt_dive_free (a);
  bt_dive_free (b);
}

static void
a_taut_tether_holds_its_vehicle (void **unused)
{
  bt_dive *dive = begin (BT_MODEL_CATENARY);
  bt_vehicle_view v;
  bt_tether_view t;
  bt_event events[BT_EVENTS_KEPT];
  bt_error e;
  (void)unused;
  drive (dive, 1, 0); /* due north, 20 m already */
  step (dive, 60 * 60);
  assert_int_equal (bt_dive_vehicle (dive, 0, &v, &e), BT_OK);
  assert_int_equal (bt_dive_tether (dive, 0, &t, &e), BT_OK);
  assert_true (v.held && t.taut);
  assert_true (fabs (t.chord - 40) < 1e-9);
  assert_true (fabs (t.tension_end - 100) < 1e-9); /* the vehicle's pull */
  assert_int_equal (bt_dive_events (dive, 0, events), 1);
  assert_int_equal (events[0].kind, BT_EVENT_TAUT);
  drive (dive, -1, 0);
  step (dive, 60);
  assert_int_equal (bt_dive_events (dive, 1, events), 1);
  assert_int_equal (events[0].kind, BT_EVENT_SLACK);
  bt_dive_free (dive);
}

static void
the_winch_pays_out_exactly (void **unused)
{
  bt_dive *dive = begin (BT_MODEL_CATENARY);
  bt_tether_view t;
  bt_error e;
  (void)unused;
  assert_int_equal (bt_dive_do (dive, BT_OP_PAY_OUT, 0, (double[]){ 7.3, 0.5 }, 2, &e), BT_OK);
  step (dive, 60 * 14);
  bt_dive_tether (dive, 0, &t, &e);
  assert_true (t.spooling && fabs (t.length - 47) < 1e-9);
  step (dive, 60);
  bt_dive_tether (dive, 0, &t, &e);
  assert_true (!t.spooling && t.length == 47.3);
  assert_int_equal (bt_dive_do (dive, BT_OP_HAUL_IN, 0, (double[]){ 47, 10 }, 2, &e), BT_OK);
  step (dive, 600);
  bt_dive_tether (dive, 0, &t, &e);
  assert_true (t.taut && fabs (t.length - t.chord) < 1e-9); /* stalled */
  bt_dive_free (dive);
}

static void
wished_time_becomes_whole_steps (void **unused)
{
  bt_dive *dive = begin (BT_MODEL_RUBBER_BAND);
  int64_t n, sum = 0;
  bt_error e;
  (void)unused;
  for (int i = 0; i < 1000; i++)
    {
      assert_int_equal (bt_dive_whole_steps (dive, 0.1, &n, &e), BT_OK);
      sum += n;
    }
  assert_int_equal (sum, 6000);
  assert_int_equal (bt_dive_whole_steps (dive, 0.01, &n, &e), BT_OK);
  assert_int_equal (n, 0);
  assert_int_equal (bt_dive_whole_steps (dive, 0.01, &n, &e), BT_OK);
  assert_int_equal (n, 1);
  assert_int_equal (bt_dive_whole_steps (dive, -1, &n, &e), BT_ERR_DOMAIN);
  assert_int_equal (bt_dive_whole_steps (dive, NAN, &n, &e), BT_ERR_DOMAIN);
  bt_dive_free (dive);
}

/* ---- Worlds that do not hold together ---- */

static bt_status
compile (const scene *s)
{
  bt_model *model;
  bt_error e = { .status = BT_OK };
  bt_status status = bt_model_new (&s->world, &model, &e);
  if (status == BT_OK)
    bt_model_release (model);
  else
    {
      assert_int_equal (e.status, status);
      assert_true (strlen (e.text) > 10);
    }
  return status;
}

static void
bad_worlds_are_refused (void **unused)
{
  scene s;
  (void)unused;
  make_scene (&s, BT_MODEL_CATENARY);
  assert_int_equal (compile (&s), BT_OK);
  s.tether.length = 20;
  assert_int_equal (compile (&s), BT_ERR_DEF);
  s.tether.length = NAN;
  assert_int_equal (compile (&s), BT_ERR_DEF);
  s.tether.length = -1;
  assert_int_equal (compile (&s), BT_ERR_DOMAIN);
  make_scene (&s, BT_MODEL_CATENARY);
  strcpy (s.tether.to.part, "nobody");
  assert_int_equal (compile (&s), BT_ERR_DEF);
  make_scene (&s, BT_MODEL_CATENARY);
  strcpy (s.tether.name, "minnow");
  assert_int_equal (compile (&s), BT_ERR_DEF);
  make_scene (&s, BT_MODEL_CATENARY);
  s.world.sea.density = INFINITY;
  assert_int_equal (compile (&s), BT_ERR_DOMAIN);
  make_scene (&s, (bt_model_kind)77);
  assert_int_equal (compile (&s), BT_ERR_NAME);
  make_scene (&s, BT_MODEL_CATENARY);
  s.world.n_tethers = BT_TETHERS_MAX + 1;
  assert_int_equal (compile (&s), BT_ERR_LIMIT);
}

static void
mass_and_wet_weight_follow_each_other (void **unused)
{
  bt_tether_props p;
  (void)unused;
  memset (&p, 0, sizeof p);
  p.diameter = 0.0076;
  p.mass = 0.043;
  p.wet_weight = NAN;
  bt_tether_props_complete (&p, 1025, 9.80665);
  assert_true (fabs (p.wet_weight + 0.0343) < 1e-4); /* it floats in the sea */
  p.mass = NAN;
  bt_tether_props_complete (&p, 1025, 9.80665);
  assert_true (fabs (p.mass - 0.043) < 1e-12);
}

/* A line has a fortieth of its water's mass at least, or of the mass that its lift would carry;
   where nothing gives it lift, or where there is no water, any.  */
static void
no_line_is_lighter_than_foam (void **unused)
{
  scene s;
  bt_tether_props p = { .diameter = 0.02, .mass = NAN, .wet_weight = -1000 };
  double displaced = 1025 * acos (-1) / 4 * 0.02 * 0.02;
  (void)unused;
  assert_true (fabs (bt_tether_least_mass (&p, 1025, 10) - 2.5) < 1e-12);
  assert_true (fabs (bt_tether_least_mass (&p, 1025, 0) - displaced / 40) < 1e-12);
  assert_true (bt_tether_least_mass (&p, 0, 0) == 0);
  bt_tether_props_complete (&p, 1025, 10);
  assert_true (fabs (p.mass - 2.5) < 1e-12);
  make_scene (&s, BT_MODEL_CATENARY);
  s.tether.props.diameter = 0.02;
  s.tether.props.wet_weight = NAN;
  s.tether.props.mass = 1.0001 * displaced / 40;
  assert_int_equal (compile (&s), BT_OK);
  s.tether.props.wet_weight = NAN;
  s.tether.props.mass = 0.9999 * displaced / 40;
  assert_int_equal (compile (&s), BT_ERR_DOMAIN);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
#ifdef CAN_COUNT
    cmocka_unit_test (steps_taken_before_allocate_nothing),
    cmocka_unit_test (a_step_without_memory_is_an_error),
    cmocka_unit_test (memory_running_out_is_an_error),
#endif
    cmocka_unit_test (a_fork_goes_on_bit_equal),
    cmocka_unit_test (a_checkpoint_brings_everything_back),
    cmocka_unit_test (foreign_and_damaged_states_are_refused),
    cmocka_unit_test (a_state_is_packed),
    cmocka_unit_test (a_refused_operation_changes_nothing),
    cmocka_unit_test (what_did_not_change_is_not_solved),
    cmocka_unit_test (still_water_needs_no_shooting),
    cmocka_unit_test (two_worlds_live_side_by_side),
    cmocka_unit_test (a_taut_tether_holds_its_vehicle),
    cmocka_unit_test (the_winch_pays_out_exactly),
    cmocka_unit_test (wished_time_becomes_whole_steps),
    cmocka_unit_test (bad_worlds_are_refused),
    cmocka_unit_test (mass_and_wet_weight_follow_each_other),
    cmocka_unit_test (no_line_is_lighter_than_foam),
  };
  return cmocka_run_group_tests_name ("dive", tests, NULL, NULL);
}
