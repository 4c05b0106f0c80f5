/* What several threads make of a dive is what one makes of it, to the last bit: fleets of mixed
   models and masses, garages, ships that many lines hang from, lines that meet, obstacles that are
   held back, winches, cuts, jumps; checkpoints, forks, children of the process.  A dive that does
   not ask for threads starts none.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "../oracle/dive_scene.h"
#include "testbed/profile.h"
#include "testbed/solids.h"
#include "base/workers.h"
#include "math/vec.h"

/* ---- Allocations, counted and refused ---- */

#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define CAN_COUNT 1

void *__libc_malloc (size_t);
void *__libc_calloc (size_t, size_t);

static _Atomic long allocations;
static long fail_at = -1; /* the allocation of this number is refused; -1: none */

void *
malloc (size_t n)
{
  return allocations++ == fail_at ? NULL : __libc_malloc (n);
}

void *
calloc (size_t n, size_t size)
{
  return allocations++ == fail_at ? NULL : __libc_calloc (n, size);
}
#endif

/* ---- A fleet ---- */

enum
{
  MOST = 64
};

typedef struct fleet
{
  bt_world world;
  bt_vehicle_def vehicle[MOST];
  bt_tether_def tether[MOST];
  scene shore; /* whose obstacles it has */
} fleet;

/* Give NAME the words STEM-I.  */
static void
name_part (char *name, const char *stem, int i)
{
  char text[24];
  snprintf (text, sizeof text, "%s-%d", stem, i);
  assert_int_equal (bt_def_set_name (name, text, NULL), BT_OK);
}

static void
begin_fleet (fleet *f)
{
  memset (f, 0, sizeof *f);
  bt_def_init (bt_head_find ("sea"), &f->world.sea);
  f->world.sea.depth = 100;
  f->world.sea.current.kind = BT_CURRENT_UNIFORM;
  f->world.sea.current.velocity[0] = bt__vec (0.05, 0.2, 0);
  f->world.vehicles = f->vehicle;
  f->world.tethers = f->tether;
}

/* Vehicle number I at P, the end of a line of MODEL from FROM.  */
static bt_tether_def *
add_rov (fleet *f, bt_vec3 from, bt_vec3 p, bt_model_kind model)
{
  bt_vehicle_def *v = &f->vehicle[f->world.n_vehicles];
  bt_tether_def *t = &f->tether[f->world.n_tethers];
  bt_def_init (bt_head_find ("rov"), v);
  bt_def_init (bt_head_find ("tether"), t);
  name_part (v->name, "rov", f->world.n_vehicles);
  name_part (t->to.part, "rov", f->world.n_vehicles++);
  name_part (t->name, "line", f->world.n_tethers++);
  v->at = p;
  t->from.at = from;
  t->length = 1.25 * bt__distance (from, p);
  t->props.nodes = 20;
  t->props.mass = 0.05;
  t->props.model = model;
  t->props.response = BT_RESPONSE_THESIS;
  return t;
}

/* Of N vehicles every third one has mass, every fifth works from a garage and, if there is to be a
   ship, every fourth of the rest from that; models by turns, most of them moving lines.  */
static void
add_rovs (fleet *f, int n, double apart, int with_ship)
{
  static const bt_model_kind models[]
      = { BT_MODEL_DYNAMIC, BT_MODEL_AUTO, BT_MODEL_DYNAMIC, BT_MODEL_STEADY,
          BT_MODEL_DYNAMIC, BT_MODEL_AUTO, BT_MODEL_CATENARY };
  bt_def_init (bt_head_find ("rov"), &f->vehicle[0]);
  name_part (f->vehicle[0].name, "ship", 0);
  f->world.n_vehicles = 1;
  f->vehicle[0].at = bt__vec (-3, -3, 0);
  for (int i = 0; i < n; i++)
    {
      bt_vec3 top = bt__vec (-12 + apart * (i % 5), -14 + apart * (int)(i / 5), 0);
      bt_vec3 p = bt__add (top, bt__vec (5, 4, -9 - i % 3));
      int garage = i % 5 == 4, ship = with_ship && !garage && i % 4 == 3;
      if (garage)
        top = f->vehicle[f->world.n_vehicles - 1].at;
      else if (ship)
        top = f->vehicle[0].at;
      bt_tether_def *t = add_rov (f, top, p, models[i % 7]);
      if (garage)
        name_part (t->from.part, "rov", f->world.n_vehicles - 2);
      else if (ship)
        name_part (t->from.part, "ship", 0);
      if (i % 3 == 1)
        assert_int_equal (
            bt_def_set_vehicle_type (&f->vehicle[f->world.n_vehicles - 1], "bluerov2-heavy", NULL),
            BT_OK);
    }
}

/* Posts between the lines, pipes under them, and two movers that sweep through.  */
static void
add_shore (fleet *f)
{
  bt_vec3 up = { 0, 0, 1 }, along = { 1, 0, 0 };
  begin_scene (&f->shore, BT_MODEL_DYNAMIC);
  add_post (&f->shore, "cylinder", "leg", bt__vec (-5, -3, 0), up, 0.4);
  add_post (&f->shore, "capsule", "wire", bt__vec (1, 3, 0), up, 0.01);
  add_post (&f->shore, "capsule", "pile", bt__vec (7, 9, 0), up, 0.3);
  add_post (&f->shore, "cylinder", "pipe", bt__vec (0, -4, -14), along, 0.3);
  add_post (&f->shore, "capsule", "main", bt__vec (0, 6, -13), along, 0.5);
  add_movers (&f->shore);
  f->world.obstacles = f->shore.obstacle;
  f->world.n_obstacles = f->shore.world.n_obstacles;
}

static bt_dive *
launch (const fleet *f, int threads)
{
  scene s = { .world = f->world };
  bt_dive *dive = enter (&s);
  bt_error e = { 0 };
  if (bt_dive_set_threads (dive, threads, &e) != BT_OK)
    fail_msg ("%s", e.text);
  assert_int_equal (bt_dive_threads (dive), threads);
  return dive;
}

/* ---- A pilot who does anything ---- */

typedef struct act
{
  bt_op op;
  int subject, n;
  double args[4];
} act;

static act
act_at (bt_op op, int subject, bt_vec3 p, double speed, int n)
{
  return (act){ op, subject, n, { p.x, p.y, p.z, speed } };
}

static act
think (dice *d, const bt_dive *dive)
{
  int v = dice_below (d, bt_dive_count (dive, BT_PART_VEHICLE));
  int t = dice_below (d, bt_dive_count (dive, BT_PART_TETHER));
  int o = bt_dive_count (dive, BT_PART_OBSTACLE);
  bt_vec3 p = dice_point (d, 12);
  p.z = dice_between (d, -16, 0);
  switch (dice_below (d, 10))
    {
    case 0:
      return act_at (BT_OP_MOVE, v, p, dice_below (d, 3) ? 2 : 20, 4);
    case 1:
      return act_at (BT_OP_FLY_TO, v, p, 2, 4);
    case 2:
      return act_at (BT_OP_PLACE, v, p, 0, 3);
    case 3:
      return (act){ BT_OP_PAY_OUT, t, 2, { dice_between (d, 0.1, 6), dice_between (d, 0.1, 2) } };
    case 4:
      return (act){ BT_OP_HAUL_IN, t, 2, { dice_between (d, 0.1, 6), dice_between (d, 0.1, 2) } };
    case 5:
      return (act){ BT_OP_CUT, t, dice_below (d, 3) == 0, { dice_between (d, 1, 8) } };
    case 6:
      if (o > 0)
        return (
            act){ BT_OP_COLLIDE, 0, 3, { BT_PART_TETHER, dice_below (d, o), dice_below (d, 2) } };
      /* fallthrough */
    default:
      return act_at (
          BT_OP_DRIVE, v,
          bt__vec (dice_between (d, -1, 1), dice_between (d, -1, 1), dice_between (d, -1, 1)),
          dice_between (d, -1, 1), 4);
    }
}

static bt_status
do_act (bt_dive *dive, const act *a)
{
  bt_error e;
  return bt_dive_do (dive, a->op, a->subject, a->args, a->n, &e);
}

enum
{
  DIVES = 4
};

static const int threads_of[DIVES] = { 1, 2, 3, 8 };

/* All DIVES agree with the first, on what failed with STATUS too.  */
static void
compare (bt_dive *const *dive, const bt_status *status, const bt_error *error, int when)
{
  for (int k = 1; k < DIVES; k++)
    {
      if (status[k] != status[0] || strcmp (error[k].text, error[0].text) != 0)
        fail_msg ("act %d: \"%s\" of one thread, \"%s\" of %d", when, error[0].text, error[k].text,
                  threads_of[k]);
      if (bt_dive_hash (dive[k]) != bt_dive_hash (dive[0]))
        fail_msg ("act %d, t = %g: another hash with %d threads", when, bt_dive_time (dive[0]),
                  threads_of[k]);
    }
}

static void
step_all (bt_dive *const *dive, int when)
{
  bt_status status[DIVES];
  bt_error error[DIVES] = { 0 };
  for (int k = 0; k < DIVES; k++)
    status[k] = bt_dive_step (dive[k], &error[k]);
  compare (dive, status, error, when);
}

static void
act_all (bt_dive *const *dive, dice *d, int when)
{
  act a = think (d, dive[0]);
  bt_status status[DIVES];
  bt_error error[DIVES] = { 0 };
  for (int k = 0; k < DIVES; k++)
    status[k] = do_act (dive[k], &a);
  compare (dive, status, error, when);
}

/* Work, refusals left out, does not depend on threads either.  */
static void
compare_work (bt_dive *const *dive)
{
  bt_profile one = profile_of (dive[0]);
  assert_true (one.threads == 0 && one.shared_steps == 0 && one.shared_again == 0);
  for (int k = 1; k < DIVES; k++)
    {
      bt_profile p = profile_of (dive[k]);
      assert_true (p.threads == (uint64_t)threads_of[k] - 1);
      assert_true (p.chain_steps == one.chain_steps && p.chain_solves == one.chain_solves
                   && p.touches == one.touches && p.shape_solves == one.shape_solves
                   && p.span_solves == one.span_solves);
    }
}

static void
play (const fleet *f, uint64_t seed, int acts, int steps, const char *name)
{
  bt_dive *dive[DIVES];
  dice d = dice_new (seed);
  bt_profile p;
  for (int k = 0; k < DIVES; k++)
    dive[k] = launch (f, threads_of[k]);
  for (int a = 0; a < acts; a++)
    {
      act_all (dive, &d, a);
      act_all (dive, &d, a);
      for (int i = 0; i < steps; i++)
        step_all (dive, a);
    }
  compare_work (dive);
  p = profile_of (dive[1]);
  print_message ("# %s: %lu steps, %lu shared out, %lu of them again\n", name,
                 (unsigned long)p.steps, (unsigned long)p.shared_steps,
                 (unsigned long)p.shared_again);
  assert_true (p.shared_steps > p.steps / 4 && p.shared_again < p.shared_steps / 2);
  for (int k = 0; k < DIVES; k++)
    bt_dive_free (dive[k]);
}

static void
open_water (void **state)
{
  fleet f;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 32, 6, 1);
  play (&f, 1, 24, 20, "open water");
}

static void
among_obstacles (void **state)
{
  fleet f;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 20, 6, 1);
  add_shore (&f);
  /* Two short dives: late in a long one all time goes to two lines that are jerked at 20 m/s, each
     of whose steps is solved in 256 parts.  */
  play (&f, 2, 12, 12, "among obstacles");
  play (&f, 4, 12, 12, "among obstacles again");
}

static void
crowded (void **state)
{
  fleet f;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 20, 1.5, 0);
  add_shore (&f);
  play (&f, 3, 16, 12, "crowded");
}

/* Lines that hang side by side at rest, half a metre apart: they ask for little.  Then two are
   flown toward each other at 20 m/s: within a step neither gets to where the other was, but both
   pass.  */
static void
meet_suddenly (int obstacles)
{
  static const act across[]
      = { { BT_OP_MOVE, 2, 4, { 4, 4, -8, 20 } }, { BT_OP_MOVE, 3, 4, { -2, 4, -8, 20 } } };
  fleet f;
  bt_dive *dive[DIVES];
  bt_profile p;
  begin_fleet (&f);
  f.world.sea.current.kind = BT_CURRENT_STILL;
  for (int i = 0; i < 20; i++) /* fewer are not worth sharing in open water */
    add_rov (&f, bt__vec (0.5 * i, 0, 0), bt__vec (0.5 * i, 4, -8), BT_MODEL_DYNAMIC)->length = 9;
  begin_scene (&f.shore, BT_MODEL_DYNAMIC);
  add_post (&f.shore, "capsule", "far", bt__vec (0, 90, 0), bt__vec (0, 0, 1), 0.3);
  f.world.obstacles = f.shore.obstacle;
  f.world.n_obstacles = obstacles;
  for (int k = 0; k < DIVES; k++)
    dive[k] = launch (&f, threads_of[k]);
  for (int i = 0; i < 30; i++)
    step_all (dive, 0);
  p = profile_of (dive[1]);
  assert_true (p.shared_steps > 20 && p.shared_again == 0);
  for (int k = 0; k < DIVES; k++)
    for (int m = 0; m < 2; m++)
      assert_int_equal (do_act (dive[k], &across[m]), BT_OK);
  for (int i = 0; i < 20; i++)
    step_all (dive, 1);
  p = profile_of (dive[1]);
  assert_true (p.shared_again > 0 && p.touches > 0);
  for (int k = 0; k < DIVES; k++)
    bt_dive_free (dive[k]);
}

static void
suddenly_they_meet (void **state)
{
  (void)state;
  meet_suddenly (0);
  meet_suddenly (1);
}

static int
count_events (const bt_dive *dive, bt_event_kind kind)
{
  bt_event event[BT_EVENTS_KEPT];
  int n = bt_dive_events (dive, 0, event), count = 0;
  for (int i = 0; i < n; i++)
    count += event[i].kind == (int64_t)kind;
  return count;
}

/* A bar that presses lines to a wall is held back by the first of them, for all.  */
static void
pinched (void **state)
{
  double track[2][5] = { { 0, 6, -1, -4, 0 }, { 4, 6, 1, -4, 0 } };
  bt_obstacle_def *wall, *bar;
  fleet f;
  bt_dive *dive[DIVES];
  (void)state;
  begin_fleet (&f);
  f.world.sea.current.kind = BT_CURRENT_STILL;
  for (int i = 0; i < 8; i++)
    add_rov (&f, bt__vec (1.5 * i, 0, 0), bt__vec (1.5 * i, 0, -8), BT_MODEL_DYNAMIC)->length = 8.1;
  begin_scene (&f.shore, BT_MODEL_DYNAMIC);
  wall = add (&f.shore, "box", "wall");
  wall->at = bt__vec (6, 0.4, -4);
  wall->size = bt__vec (30, 0.5, 20);
  bar = add (&f.shore, "capsule", "bar");
  bar->from = bt__vec (-10, -1, -4);
  bar->to = bt__vec (22, -1, -4);
  bar->radius = 0.2;
  bar->track = (bt_rows){ track[0], 2, 5 };
  f.world.obstacles = f.shore.obstacle;
  f.world.n_obstacles = 2;
  for (int k = 0; k < DIVES; k++)
    dive[k] = launch (&f, threads_of[k]);
  for (int i = 0; i < 150; i++)
    step_all (dive, 0);
  assert_true (count_events (dive[0], BT_EVENT_PINCHED) > 0);
  assert_true (profile_of (dive[1]).shared_again > 0);
  for (int k = 0; k < DIVES; k++)
    bt_dive_free (dive[k]);
}

/* ---- Nothing that was not asked for ---- */

static void
run (bt_dive *dive, int steps)
{
  bt_error e;
  for (int i = 0; i < steps; i++)
    assert_int_equal (bt_dive_step (dive, &e), BT_OK);
}

static void
drive_all (bt_dive *dive)
{
  for (int i = 0; i < bt_dive_count (dive, BT_PART_VEHICLE); i++)
    operate (dive, BT_OP_DRIVE, i, 4, (double[]){ 0.3, 0.1 * (i % 3), 0, 0.05 });
}

static int
threads_alive (void)
{
  char line[200];
  int n = 0;
  FILE *f = fopen ("/proc/self/status", "r");
  while (f && fgets (line, sizeof line, f))
    sscanf (line, "Threads: %d", &n);
  if (f)
    fclose (f);
  return n;
}

static void
one_thread_is_as_it_was (void **state)
{
  fleet f;
  bt_dive *dive;
  int before = threads_alive ();
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 24, 8, 0);
  dive = launch (&f, 1);
  drive_all (dive);
  run (dive, 20);
  assert_int_equal (threads_alive (), before);
  assert_true (profile_of (dive).shared_steps == 0 && profile_of (dive).threads == 0);
  assert_int_equal (bt_dive_set_threads (dive, 3, NULL), BT_OK);
  assert_int_equal (threads_alive (), before); /* not before there is work */
  run (dive, 20);
  if (before > 0)
    assert_int_equal (threads_alive (), before + 2);
  assert_true (profile_of (dive).threads == 2);
  assert_int_equal (bt_dive_set_threads (dive, 1, NULL), BT_OK);
  assert_int_equal (threads_alive (), before);
  assert_true (profile_of (dive).threads == 2);
  bt_dive_free (dive);
}

static void
little_work_is_not_shared (void **state)
{
  fleet f;
  bt_dive *dive;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 2, 8, 0);
  dive = launch (&f, 4);
  drive_all (dive);
  run (dive, 50);
  assert_true (profile_of (dive).shared_steps == 0 && profile_of (dive).threads == 0);
  bt_dive_free (dive);
}

static void
bad_numbers_are_refused (void **state)
{
  static const int bad[] = { 0, -1, BT_THREADS_MAX + 1 };
  fleet f;
  bt_dive *dive;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 2, 8, 0);
  dive = launch (&f, 2);
  for (int i = 0; i < 3; i++)
    {
      bt_error e = { 0 };
      assert_int_equal (bt_dive_set_threads (dive, bad[i], &e), BT_ERR_DOMAIN);
      assert_non_null (strstr (e.text, "1 to 64"));
      assert_int_equal (bt_dive_threads (dive), 2);
    }
  bt_dive_free (dive);
}

#ifdef CAN_COUNT
static void
memory_running_out_leaves_the_threads_it_had (void **state)
{
  fleet f;
  bt_dive *dive;
  int failures = 0;
  uint64_t hash;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 12, 8, 0);
  add_shore (&f);
  dive = launch (&f, 2);
  hash = bt_dive_hash (dive);
  for (long nth = 0;; nth++)
    {
      bt_error e = { 0 };
      bt_status status;
      fail_at = allocations + nth;
      status = bt_dive_set_threads (dive, 3, &e);
      fail_at = -1;
      if (status == BT_OK)
        break;
      assert_int_equal (status, BT_ERR_LIMIT);
      assert_int_equal (bt_dive_threads (dive), 2);
      failures++;
    }
  assert_true (failures > 20 && bt_dive_hash (dive) == hash);
  bt_dive_free (dive);
}

static void
shared_steps_hardly_allocate (void **state)
{
  fleet f;
  bt_dive *dive;
  long before;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 20, 8, 0);
  add_shore (&f);
  dive = launch (&f, 3);
  drive_all (dive);
  run (dive, 20); /* no look at windings yet */
  before = allocations;
  run (dive, 60); /* of 20 lines; a thread's work space grows with what it comes to step */
  assert_true (allocations - before < 300 && profile_of (dive).shared_steps > 30);
  bt_dive_free (dive);
}

/* Fly the vehicle of DIVE round the post and let line out; return how often the steps allocate.  */
static long
fly_round (bt_dive *dive)
{
  long sum = 0;
  static const double corner[][4] = { { 4, -4, -6, 1 }, { 4, 4, -6, 1 }, { -4, 4, -7, 1 } };
  operate (dive, BT_OP_PAY_OUT, 0, 2, (double[]){ 20, 0.5 });
  for (int k = 0; k < 3; k++)
    {
      operate (dive, BT_OP_MOVE, 0, 4, corner[k]);
      long before = allocations;
      run (dive, 480);
      sum += allocations - before;
    }
  return sum;
}

/* What was flown before needs no more memory, looks at what the line is wound about among it; on a
   fork that is told what to do, too.  */
static void
no_step_allocates_again (void **state)
{
  fleet f;
  bt_dive *dive, *fork;
  (void)state;
  begin_fleet (&f);
  f.world.sea.current.kind = BT_CURRENT_STILL;
  add_rov (&f, bt__vec (-4, -5, -5), bt__vec (-2, -4, -5), BT_MODEL_DYNAMIC)->length = 14;
  begin_scene (&f.shore, BT_MODEL_DYNAMIC);
  add_post (&f.shore, "cylinder", "pile", bt__vec (0, 0, 0), bt__vec (0, 0, 1), 0.4);
  f.world.obstacles = f.shore.obstacle;
  f.world.n_obstacles = 1;
  dive = launch (&f, 1);
  void *kept = malloc (bt_dive_state_size (dive));
  bt_dive_save (dive, kept);
  assert_int_equal (bt_dive_fork (dive, &fork, NULL), BT_OK);
  fly_round (dive);
  fly_round (fork);
  assert_true (profile_of (dive).charts > 0 && profile_of (dive).strings > 0);
  assert_int_equal (bt_dive_restore (dive, kept, bt_dive_state_size (dive), NULL), BT_OK);
  assert_int_equal (bt_dive_restore (fork, kept, bt_dive_state_size (dive), NULL), BT_OK);
  assert_int_equal (fly_round (dive), 0);
  assert_int_equal (fly_round (fork), 0);
  free (kept);
  bt_dive_free (fork);
  bt_dive_free (dive);
}
#endif

/* ---- Time as a value ---- */

static void
checkpoints_and_forks (void **state)
{
  fleet f;
  bt_dive *one, *many, *fork;
  void *kept;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 16, 7, 0);
  add_shore (&f);
  one = launch (&f, 1);
  many = launch (&f, 3);
  kept = malloc (bt_dive_state_size (one));
  drive_all (one);
  drive_all (many);
  run (one, 40);
  run (many, 40);
  bt_dive_save (many, kept);
  assert_int_equal (bt_dive_fork (many, &fork, NULL), BT_OK);
  assert_int_equal (bt_dive_threads (fork), 1);
  assert_int_equal (bt_dive_set_threads (fork, 2, NULL), BT_OK);
  run (one, 40);
  run (fork, 40);
  assert_true (bt_dive_hash (fork) == bt_dive_hash (one));
  run (many, 20);
  assert_int_equal (bt_dive_set_threads (many, 8, NULL), BT_OK);
  assert_int_equal (bt_dive_restore (many, kept, bt_dive_state_size (many), NULL), BT_OK);
  assert_int_equal (bt_dive_threads (many), 8);
  run (many, 40);
  assert_true (bt_dive_hash (many) == bt_dive_hash (one));
  free (kept);
  bt_dive_free (fork);
  bt_dive_free (many);
  bt_dive_free (one);
}

#ifndef __SANITIZE_THREAD__
/* A child has none of the threads, and starts its own when it steps.  */
static void
a_child_of_the_process (void **state)
{
  fleet f;
  bt_dive *dive;
  uint64_t hash = 0;
  int ends[2], status;
  pid_t child;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 24, 8, 0);
  dive = launch (&f, 3);
  drive_all (dive);
  run (dive, 20);
  assert_int_equal (pipe (ends), 0);
  child = fork ();
  if (child == 0)
    {
      bt_error e;
      alarm (600);
      for (int i = 0; i < 20; i++)
        bt_dive_step (dive, &e);
      hash = profile_of (dive).threads == 4 ? bt_dive_hash (dive) : 0;
      bt_dive_free (dive);
      _exit (write (ends[1], &hash, sizeof hash) != (ssize_t)sizeof hash);
    }
  run (dive, 20);
  assert_int_equal (read (ends[0], &hash, sizeof hash), (ssize_t)sizeof hash);
  assert_int_equal (waitpid (child, &status, 0), child);
  assert_int_equal (status, 0);
  assert_true (hash == bt_dive_hash (dive));
  child = fork (); /* one that only frees it */
  if (child == 0)
    {
      alarm (600);
      bt_dive_free (dive);
      _exit (0);
    }
  assert_int_equal (waitpid (child, &status, 0), child);
  assert_int_equal (status, 0);
  close (ends[0]);
  close (ends[1]);
  bt_dive_free (dive);
}
#endif

/* ---- Live ---- */

static void
live_with_threads (void **state)
{
  bt_live_options options = bt_live_default_options ();
  fleet f;
  bt_dive *one, *many;
  bt_live *live;
  (void)state;
  begin_fleet (&f);
  add_rovs (&f, 24, 8, 0);
  one = launch (&f, 1);
  many = launch (&f, 3);
  drive_all (one);
  drive_all (many);
  run (one, 60);
  options.pace = 0; /* as fast as it goes */
  options.until = 60;
  assert_int_equal (bt_live_start (many, &options, &live, NULL), BT_OK);
  while (bt_live_wait (live, 60, 0.1) < 60)
    ;
  assert_int_equal (bt_live_stop (live, NULL), BT_OK);
  assert_true (bt_dive_hash (many) == bt_dive_hash (one) && profile_of (many).shared_steps > 30);
  bt_dive_free (one);
  bt_dive_free (many);
}

/* ---- The workers themselves ---- */

enum
{
  TASKS = 1000
};

typedef struct tally
{
  _Atomic int done[TASKS], at_work[5], clashes;
} tally;

static void
count_task (void *user, int w, int k)
{
  tally *t = user;
  t->clashes += t->at_work[w]++ != 0;
  t->done[k]++;
  t->at_work[w]--;
}

static void
every_task_once (void **state)
{
  static tally t;
  bt__workers *workers = bt__workers_new (5);
  (void)state;
  assert_int_equal (bt__workers_started (workers), 0);
  for (int round = 0; round < 300; round++)
    bt__workers_run (workers, round % 7 == 0 ? 0 : TASKS - round, count_task, NULL, &t);
  for (int k = 0, rounds = 257; k < TASKS - 300; k++)
    assert_int_equal (t.done[k], rounds);
  assert_int_equal (t.clashes, 0);
  assert_int_equal (bt__workers_started (workers), 4);
  bt__workers_free (workers);
  bt__workers_free (NULL);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (every_task_once),
    cmocka_unit_test (one_thread_is_as_it_was),
    cmocka_unit_test (little_work_is_not_shared),
    cmocka_unit_test (bad_numbers_are_refused),
    cmocka_unit_test (open_water),
    cmocka_unit_test (among_obstacles),
    cmocka_unit_test (crowded),
    cmocka_unit_test (suddenly_they_meet),
    cmocka_unit_test (pinched),
    cmocka_unit_test (checkpoints_and_forks),
    cmocka_unit_test (live_with_threads),
#ifdef CAN_COUNT
    cmocka_unit_test (memory_running_out_leaves_the_threads_it_had),
    cmocka_unit_test (shared_steps_hardly_allocate),
    cmocka_unit_test (no_step_allocates_again),
#endif
#ifndef __SANITIZE_THREAD__
    cmocka_unit_test (a_child_of_the_process),
#endif
  };
  return cmocka_run_group_tests_name ("threads", tests, NULL, NULL);
}
