/* See scale_many.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "math/vec.h"
#include "scale_many.h"
#include "testbed/calibration.h"
#include "testbed/scene.h"

enum
{
  ROUNDS_MAX = 101,
  ROUNDS = 5,
  TURN = 120, /* steps of a turn */
  WARM = 60,
  SETTLE = 600 /* steps in which a line comes to lie */
};

static scene drawn;

static void
put (bench_table *t, const char *name, long n, const char *what, double seconds, const char *more)
{
  char setting[60], counters[160];
  snprintf (setting, sizeof setting, "%ld %s", n, what);
  snprintf (counters, sizeof counters, "n=%ld;%s", n, more);
  bench_put (t, &(bench_row){ name, "dynamic", setting, "cpu", NAN, NULL, 0, seconds, counters });
}

/* ---- Obstacles far away ---- */

/* The bare dive among N bars, each by itself, 500 m away and farther.  */
static bt_dive *
begin_far (long n)
{
  scene *s = &drawn;
  bt_obstacle_def *o = calloc ((size_t)n + 1, sizeof *o);
  if (!o)
    exit (EXIT_FAILURE);
  scene_clear (s);
  scene_vehicle (s, bt__vec (0, 12, -20));
  scene_line (s, bt__vec (-1, -12, 0), 40, 100)->props.mass = 0.05;
  for (long i = 0; i < n; i++)
    {
      bt_vec3 at = bt__vec (500 + 10 * (double)(i % 300), 10 * (double)(i / 300), 0);
      bt_def_init (bt_head_find ("capsule"), &o[i]);
      snprintf (o[i].name, sizeof o[i].name, "bar-%ld", i);
      o[i].from = bt__add (at, bt__vec (0, 0, -30));
      o[i].to = at;
      o[i].radius = 1;
    }
  s->world.obstacles = o;
  s->world.n_obstacles = (int)n;
  bt_dive *dive = scene_begin (&s->world);
  free (o);
  return dive;
}

void
scale_obstacles (bench_table *t, long most, int rounds)
{
  static double ratio[ROUNDS_MAX], seconds[ROUNDS_MAX];
  for (long n = 1; n <= most; n *= 10)
    {
      char more[60];
      bt_dive *bare = begin_far (0), *far = begin_far (n);
      scene_fly (bare, 1, 0, WARM);
      scene_fly (far, 1, 0, WARM);
      for (int r = 0; r < rounds; r++)
        {
          double alone = scene_fly (bare, 1, WARM + (long)r * TURN, TURN);
          seconds[r] = scene_fly (far, 1, WARM + (long)r * TURN, TURN);
          ratio[r] = seconds[r] / alone;
        }
      snprintf (more, sizeof more, "times_bare=%.3f", bench_median (ratio, rounds));
      put (t, "obstacles", n, "far away", bench_median (seconds, rounds), more);
      bt_dive_free (bare);
      bt_dive_free (far);
    }
}

/* ---- Contacts ---- */

/* Intervals of 0.4 m, on a slab whose top is at -20 m, a vehicle above its end.  */
static bt_dive *
begin_lying (long n)
{
  double length = 0.4 * (double)n;
  scene *s = &drawn;
  scene_clear (s);
  scene_vehicle (s, bt__vec (0, 0.97 * length, -19.5));
  scene_line (s, bt__vec (0, 0, -19.9), length, (int)n)->props.mass = 0.2;
  bt_obstacle_def *slab = scene_obstacle (s, "box");
  slab->at = bt__vec (0, 0, -21);
  slab->size = bt__vec (3 * length + 20, 3 * length + 20, 2);
  return scene_begin (&s->world);
}

void
scale_contacts (bench_table *t, long most, double work)
{
  for (long n = 10; n <= most; n *= 10)
    {
      double seconds[ROUNDS];
      int steps = (int)fmax (10, fmin (600, work / (double)n));
      bt_dive *dive = begin_lying (n);
      bt_profile before, after;
      char more[80];
      scene_fly (dive, 1, 0, SETTLE);
      bt_dive_profile (dive, &before);
      for (int r = 0; r < ROUNDS; r++)
        seconds[r] = scene_fly (dive, 1, SETTLE + (long)r * steps, steps);
      bt_dive_profile (dive, &after);
      double all = (double)(after.steps - before.steps);
      double touches = (double)(after.touches - before.touches) / all;
      snprintf (more, sizeof more, "intervals=%ld;solves=%.2f", n,
                (double)(after.chain_solves - before.chain_solves) / all);
      put (t, "contacts", lround (touches), "touches", bench_median (seconds, ROUNDS), more);
      bt_dive_free (dive);
    }
}

/* ---- Members ---- */

static double
step_members (bt_dive **member, long n, int64_t steps)
{
  bt_status *each = calloc ((size_t)n, sizeof *each);
  bt_error error;
  double begun = bench_now ();
  if (!each)
    exit (EXIT_FAILURE);
  int64_t to = bt_dive_steps (member[0]) + steps;
  scene_must (bt_dives_step (member, (int)n, to, 1, NULL, NULL, each, &error), &error);
  free (each);
  return (bench_now () - begun) / (double)steps;
}

void
scale_members (bench_table *t, long most, double work)
{
  bt_dive *origin = begin_far (0);
  scene_fly (origin, 1, 0, WARM);
  for (long n = 1; n <= most; n *= 10)
    {
      double seconds[ROUNDS];
      bt_dive **member = calloc ((size_t)n, sizeof *member);
      bt_error error;
      if (!member)
        exit (EXIT_FAILURE);
      for (long i = 0; i < n; i++)
        scene_must (bt_dive_fork (origin, &member[i], &error), &error);
      int64_t steps = (int64_t)fmax (3, fmin (600, work / (100 * (double)n)));
      step_members (member, n, 3);
      for (int r = 0; r < ROUNDS; r++)
        seconds[r] = step_members (member, n, steps);
      put (t, "members", n, "forks", bench_median (seconds, ROUNDS), "intervals=100");
      for (long i = 0; i < n; i++)
        bt_dive_free (member[i]);
      free (member);
    }
  bt_dive_free (origin);
}

/* ---- Forks ---- */

enum
{
  FORKS = 20,
  AGAIN = 400 /* forks made and freed, for the time */
};

/* Bytes for an interval of a fork, and s of CPU for a fork made and freed.  */
typedef struct cost
{
  double idle, stepped; /* given by the system: before a step, after five */
  double allotted;      /* asked of the system, after five */
  double seconds;
} cost;

/* What the system gave this process, bytes.  */
static double
given (void)
{
  long all = 0, resident = 0;
  FILE *f = fopen ("/proc/self/statm", "r");
  if (!f || fscanf (f, "%ld %ld", &all, &resident) != 2)
    exit (EXIT_FAILURE);
  fclose (f);
  return (double)resident * (double)sysconf (_SC_PAGESIZE);
}

static double
asked (void)
{
  struct mallinfo2 m = mallinfo2 ();
  return (double)m.uordblks + (double)m.hblkhd;
}

/* A vehicle on a line of N intervals that a current, where there is a bar, presses to it.  */
static bt_dive *
begin_forked (long n, int bar)
{
  scene *s = &drawn;
  scene_clear (s);
  scene_vehicle (s, bt__vec (0, 12, -20));
  scene_line (s, bt__vec (-1, -12, 0), fmax (40, 0.01 * (double)n), (int)n)->props.mass = 0.05;
  if (bar)
    scene_bar (s, bt__vec (-1, -20, -12), bt__vec (-1, 20, -12), 0.3);
  bt_dive *dive = scene_begin (&s->world);
  scene_fly (dive, 1, 0, WARM);
  return dive;
}

static cost
measure_forks (long n, int bar)
{
  bt_dive *dive = begin_forked (n, bar), *fork[FORKS];
  double before = given (), asked_before = asked (), each = FORKS * (double)n;
  cost c;
  bt_error error;
  for (int k = 0; k < FORKS; k++)
    scene_must (bt_dive_fork (dive, &fork[k], &error), &error);
  c.idle = (given () - before) / each;
  for (int k = 0; k < FORKS; k++)
    scene_fly (fork[k], 1, WARM, 5);
  c.stepped = (given () - before) / each;
  c.allotted = (asked () - asked_before) / each;
  for (int k = 0; k < FORKS; k++)
    bt_dive_free (fork[k]);
  double begun = bench_now ();
  for (int k = 0; k < AGAIN; k++)
    {
      scene_must (bt_dive_fork (dive, fork, &error), &error);
      bt_dive_free (fork[0]);
    }
  c.seconds = (bench_now () - begun) / AGAIN;
  return c;
}

/* The same in a process of its own, whose memory is fresh.  */
static cost
measure_apart (long n, int bar)
{
  int ends[2], status;
  cost c = { NAN, NAN, NAN, NAN };
  if (pipe (ends) != 0)
    exit (EXIT_FAILURE);
  pid_t child = fork ();
  if (child == 0)
    {
      c = measure_forks (n, bar);
      _exit (write (ends[1], &c, sizeof c) == sizeof c ? EXIT_SUCCESS : EXIT_FAILURE);
    }
  close (ends[1]);
  if (child < 0 || read (ends[0], &c, sizeof c) != sizeof c || waitpid (child, &status, 0) != child)
    exit (EXIT_FAILURE);
  close (ends[0]);
  return c;
}

void
scale_forks (bench_table *t)
{
  for (int bar = 0; bar < 2; bar++)
    for (long n = 100; n <= 1000; n *= 10)
      {
        cost c = measure_apart (n, bar);
        char setting[60], counters[120];
        snprintf (setting, sizeof setting, "%ld intervals%s", n, bar ? ", pressed to a bar" : "");
        snprintf (counters, sizeof counters, "allotted=%.0f;without_step=%.0f;intervals=%ld",
                  c.allotted, c.idle, n);
        bench_put (t, &(bench_row){ "fork", "dynamic", setting, "bytes given for an interval",
                                    c.stepped, NULL, 0, c.seconds, counters });
      }
}
