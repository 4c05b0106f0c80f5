/* bight-bench-scale: how a dive grows with what is in it, as CSV rows on standard output.

   A moving line of 2 to 10^4 intervals; 1 to 64 vehicles, each on a line of 50; a line of 100 laid
   along a jacket's face of 10^3 to 10^6 triangles, pressed on to it by a current.  Times are CPU of
   a step; the counters have them for one node, vehicle or triangle, too.  The error is bytes, that
   the model and the dive (of triangles, the model) take from the system's allocator, for one of
   what grows; it is the only number here that is not better for being closer to something else.

   The same of what moves the water, waves and lees of piles: scale_sea.h; of obstacles far away,
   contacts, forks stepped side by side, and what a fork takes of memory: scale_many.h.  The counter
   `n' is what a row has so many of; the report draws CPU time over `n', case by case, with the
   exponent that fits.

   The same vehicles stepped by several threads, in open water and each line pressed to a post,
   beside a dive of one thread: by turns, a few steps each.  The error is the number of turns after
   which the states differ; the counters have the speed-up, of the least time that passed, what CPU
   it took of that of one thread, how many steps were shared out, and how many of them done again.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "testbed/calibration.h"
#include "jacket.h"
#include "math/vec.h"
#include "options.h"
#include "row.h"
#include "scale_many.h"
#include "scale_sea.h"
#include "scale_trees.h"
#include "testbed/scene.h"

enum
{
  ROUNDS = 5,
  TREE_ROUNDS = 7,
  WARM = 12,    /* steps before it is timed */
  SEVERAL = 50, /* intervals of each of several lines */
  TURNS = 300,  /* of two dives that are compared, at most, ... */
  TURN = 20 /* ... and steps of one tether in a turn: short, for a busy machine to overlook it */
};

static double
bytes_in_use (void)
{
  struct mallinfo2 m = mallinfo2 ();
  return (double)m.uordblks + (double)m.hblkhd;
}

typedef struct size
{
  double step;        /* s of CPU */
  double model, dive; /* bytes */
  double load;        /* s of CPU */
  bt_profile profile;
} size;

/* Fly S, STEPS in each of ROUNDS.  */
static size
measure (const scene *s, int flown, int steps)
{
  double seconds[ROUNDS], before = bytes_in_use (), begun = bench_now ();
  bt_model *model;
  bt_dive *dive;
  bt_error error;
  size z;
  scene_must (bt_model_new (&s->world, &model, &error), &error);
  z.model = bytes_in_use () - before;
  scene_must (bt_dive_new (model, NULL, NULL, &dive, &error), &error);
  z.dive = bytes_in_use () - before - z.model;
  z.load = bench_now () - begun;
  bt_model_release (model);
  scene_fly (dive, flown, 0, WARM);
  for (int r = 0; r < ROUNDS; r++)
    seconds[r] = scene_fly (dive, flown, WARM + (long)r * steps, steps);
  z.step = bench_median (seconds, ROUNDS);
  bt_dive_profile (dive, &z.profile);
  bt_dive_free (dive);
  return z;
}

static void
say (bench_table *t, const char *name, long n, const char *what, double bytes, const size *z)
{
  char setting[60], metric[60], counters[260];
  snprintf (setting, sizeof setting, "%ld %s", n, what);
  snprintf (metric, sizeof metric, "bytes for one of %s", what);
  snprintf (counters, sizeof counters,
            "n=%ld;step_ns_each=%.4g;load_ns_each=%.4g;model_kB=%.4g;dive_kB=%.4g;solves=%.2f;"
            "touches=%.1f",
            n, 1e9 * z->step / (double)n, 1e9 * z->load / (double)n, 1e-3 * z->model,
            1e-3 * z->dive, (double)z->profile.chain_solves / (double)z->profile.steps,
            (double)z->profile.touches / (double)z->profile.steps);
  bench_put (t, &(bench_row){ name, "dynamic", setting, metric, bytes / (double)n, NULL, 0, z->step,
                              counters });
}

static int
steps_for (double work, double of)
{
  return (int)fmax (5, fmin (600, of / work));
}

/* The line sinks: one that floats lies crumpled on the surface, and its links on each other.  No
   link is shorter than the line is thick.  */
static void
scale_nodes (bench_table *t, long most, double work)
{
  static scene s;
  for (long n = 2; n <= most; n = n == 2 ? 10 : 10 * n)
    {
      double length = fmax (60, 0.01 * (double)n), reach = 25 * length / 60;
      scene_clear (&s);
      scene_vehicle (&s, bt__vec (0, reach, -20));
      scene_line (&s, bt__vec (0, -reach, 0), length, (int)n)->props.mass = 0.05;
      size z = measure (&s, 1, steps_for ((double)n, work));
      say (t, "nodes", n, "intervals", z.model + z.dive, &z);
    }
}

static void
scale_vehicles (bench_table *t, long most, double work)
{
  static scene s;
  for (int n = 1; n <= most; n *= 4)
    {
      scene_clear (&s);
      for (int i = 0; i < n; i++)
        {
          bt_vec3 at = bt__vec (100 * (i % 8), 100 * (int)(i / 8), 0);
          scene_vehicle (&s, bt__add (at, bt__vec (0, 12, -20)));
          scene_line (&s, at, 30, SEVERAL);
        }
      size z = measure (&s, n, steps_for (SEVERAL * n, work));
      say (t, "vehicles", n, "vehicles", z.model + z.dive, &z);
    }
}

static void
scale_triangles (bench_table *t, long most, double work)
{
  static scene s;
  jacket j;
  if (!jacket_new (&j, (uint32_t)most))
    return;
  for (long n = 1000; n <= most; n *= 10)
    {
      jacket_make (&j, (uint32_t)n);
      scene_clear (&s);
      s.world.sea.depth = 120;
      scene_current (&s, bt__vec (0, 0.2, 0));
      scene_vehicle (&s, bt__vec (25, -31.5, -52));
      scene_line (&s, bt__vec (-25, -31.5, -48), 51, 100);
      bt_obstacle_def *o = scene_obstacle (&s, "mesh");
      o->mesh
          = (bt_triangles){ j.v, j.vertices, (const uint32_t (*)[3])j.corner, j.triangles, NULL };
      size z = measure (&s, 0, steps_for (100, work));
      say (t, "triangles", j.triangles, "triangles", z.model, &z);
    }
  jacket_free (&j);
}

/* ---- Threads ---- */

static double
time_passed (void)
{
  struct timespec t;
  clock_gettime (CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* N vehicles, each line in open water or pressed to a post.  */
static void
make_fleet (scene *s, int n, int posts)
{
  scene_clear (s);
  scene_current (s, bt__vec (0.3, 0, 0));
  for (int i = 0; i < n; i++)
    {
      bt_vec3 at = bt__vec (30 * (i % 8), 30 * (int)(i / 8), 0);
      scene_vehicle (s, bt__add (at, bt__vec (0, 12, -20)));
      scene_line (s, at, 30, SEVERAL);
      if (posts)
        scene_bar (s, bt__add (at, bt__vec (1, -20, -10)), bt__add (at, bt__vec (1, 20, -10)), 0.3);
    }
}

/* A dive at its turns.  */
typedef struct runner
{
  bt_dive *dive;
  double least, cpu; /* s of a step, as it passed; s of CPU in all */
} runner;

static void
take_turn (runner *r, int flown, int turn, int steps)
{
  double begun = time_passed ();
  r->cpu += steps * scene_fly (r->dive, flown, (long)turn * steps, steps);
  r->least = fmin (r->least, (time_passed () - begun) / steps);
}

static void
compare_threads (bench_table *t, const scene *s, int n, int threads, const char *where, double work)
{
  runner one = { scene_begin (&s->world), INFINITY, 0 },
         many = { scene_begin (&s->world), INFINITY, 0 };
  int steps = 1 + TURN / n, turns = (int)fmin (TURNS, work / TURN), differ = 0;
  char setting[60], counters[240];
  bt_profile p;
  bt_error error;
  scene_must (bt_dive_set_threads (many.dive, threads, &error), &error);
  for (int turn = 0; turn < turns; turn++)
    {
      take_turn (&one, n, turn, steps);
      take_turn (&many, n, turn, steps);
      differ += bt_dive_hash (one.dive) != bt_dive_hash (many.dive);
    }
  bt_dive_profile (many.dive, &p);
  snprintf (setting, sizeof setting, "%d tethers, %d threads, %s", n, threads, where);
  snprintf (counters, sizeof counters,
            "speed_up=%.2f;cpu_of_one=%.2f;shared=%.3f;again=%.3f;threads=%d",
            one.least / many.least, many.cpu / one.cpu, (double)p.shared_steps / (double)p.steps,
            (double)p.shared_again / (double)p.steps, (int)p.threads);
  bench_put (t, &(bench_row){ "threads", "dynamic", setting, "turns after which states differ",
                              differ, "one thread", 0, many.cpu / (turns * steps), counters });
  bt_dive_free (one.dive);
  bt_dive_free (many.dive);
}

static void
scale_threads (bench_table *t, long most, double work)
{
  static scene s;
  for (int posts = 0; posts < 2; posts++)
    for (int n = 1; n <= most; n *= 4)
      for (int threads = 1; threads <= 4; threads *= 2)
        {
          make_fleet (&s, n, posts);
          compare_threads (t, &s, n, threads, posts ? "at posts" : "open water", work);
        }
}

int
main (int argc, char **argv)
{
  long nodes = 10000, vehicles = 64, triangles = 1000000, work = 60000, rounds = 15, piles = 10000,
       obstacles = 100000, contacts = 1000, members = 1000;
  const bench_option options[] = {
    { "nodes", &nodes, 2, BT_NODES_MAX, 0, "intervals of the longest line" },
    { "vehicles", &vehicles, 1, BT_VEHICLES_MAX, 0, "vehicles of the fullest scene" },
    { "triangles", &triangles, 1000, 10000000, 100000, "triangles of the finest mesh" },
    { "work", &work, 1, 100000000, 10000, "steps times intervals of a round" },
    { "piles", &piles, 10, 10000, 100, "piles of the fullest sea" },
    { "obstacles", &obstacles, 1, BT_OBSTACLES_MAX, 1000, "most obstacles far away" },
    { "contacts", &contacts, 10, BT_NODES_MAX, 100, "intervals of the longest line that lies" },
    { "members", &members, 1, 10000, 10, "most forks stepped side by side" },
    { "rounds", &rounds, 1, 101, 3, "turns in waves, lees and beside obstacles" },
  };
  const bench_program program
      = { "scale", "Measure how a dive grows with what is in it", options, 9 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  bench_table table;
  bench_open (&table);
  scale_forks (&table);
  scale_nodes (&table, nodes, (double)work);
  scale_vehicles (&table, vehicles, (double)work);
  setenv ("BIGHT_TREES", "", 1); /* or else rows of loading would hang on earlier runs */
  scale_triangles (&table, triangles, (double)work);
  scale_trees (&table, triangles, rounds < TREE_ROUNDS ? (int)rounds : TREE_ROUNDS);
  scale_threads (&table, vehicles, (double)work);
  scale_waves (&table, (int)rounds);
  scale_lees (&table, piles, (int)rounds);
  scale_obstacles (&table, obstacles, (int)rounds);
  scale_contacts (&table, contacts, (double)work);
  scale_members (&table, members, (double)work);
  return bench_close (&table);
}
