/* See scale_sea.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"
#include "scale_sea.h"
#include "testbed/calibration.h"
#include "testbed/scene.h"

enum
{
  ROUNDS_MAX = 101,
  BESIDE = 3,  /* dives that take turns, at most */
  NODES = 100, /* intervals of the line */
  TURN = 120,  /* steps of a turn */
  WARM = 60
};

/* Dives that take turns, the first being what the others are measured by.  */
typedef struct turns
{
  int n;
  bt_dive *dive[BESIDE];
  double seconds[BESIDE][ROUNDS_MAX];
  double load[BESIDE]; /* s of CPU */
} turns;

static scene *
draw_line (void)
{
  static scene s;
  scene_clear (&s);
  scene_vehicle (&s, bt__vec (0, 12, -20));
  scene_line (&s, bt__vec (-1, -12, 0), 40, NODES)->props.mass = 0.05;
  return &s;
}

static void
join (turns *f, const scene *s)
{
  double begun = bench_now ();
  f->dive[f->n] = scene_begin (&s->world);
  f->load[f->n] = bench_now () - begun;
  scene_fly (f->dive[f->n++], 1, 0, WARM);
}

static void
take_turns (turns *f, int rounds)
{
  for (int r = 0; r < rounds; r++)
    for (int k = 0; k < f->n; k++)
      f->seconds[k][r] = scene_fly (f->dive[k], 1, WARM + (long)r * TURN, TURN);
}

/* The median over the ROUNDS of what dive K takes beside the first.  */
static double
times_first (const turns *f, int k, int rounds)
{
  double ratio[ROUNDS_MAX];
  for (int r = 0; r < rounds; r++)
    ratio[r] = f->seconds[k][r] / f->seconds[0][r];
  return bench_median (ratio, rounds);
}

static void
leave (turns *f)
{
  for (int k = 0; k < f->n; k++)
    bt_dive_free (f->dive[k]);
}

/* ---- Waves ---- */

static double
line_apart (const bt_dive *a, const bt_dive *b)
{
  static bt_vec3 x[NODES + 1], y[NODES + 1];
  double most = 0;
  bt_error error;
  scene_must (bt_tether_points (a, 0, NODES + 1, x, &error), &error);
  scene_must (bt_tether_points (b, 0, NODES + 1, y, &error), &error);
  for (int i = 0; i <= NODES; i++)
    most = fmax (most, bt__distance (x[i], y[i]));
  return most;
}

static void
fly_waves (bench_table *t, int components, double accuracy, int rounds)
{
  static turns f;
  char setting[60], counters[160];
  scene *s = draw_line ();
  f.n = 0;
  join (&f, s);
  scene_waves (s);
  s->world.sea.waves.components = components;
  s->world.sea.waves.accuracy = accuracy;
  join (&f, s);
  s->world.sea.waves.accuracy = 0;
  join (&f, s);
  take_turns (&f, rounds);
  snprintf (setting, sizeof setting, "%d components within %g", components, accuracy);
  snprintf (counters, sizeof counters, "n=%d;times_calm=%.3f;exact_times_calm=%.3f;flown_s=%.0f",
            components, times_first (&f, 1, rounds), times_first (&f, 2, rounds),
            rounds * TURN / 60.0);
  bench_put (t, &(bench_row){ accuracy == 1e-4 ? "waves" : "waves, other accuracy", "dynamic",
                              setting, "m from the exact sea", line_apart (f.dive[1], f.dive[2]),
                              "each node by itself", 0, bench_median (f.seconds[1], rounds),
                              counters });
  leave (&f);
}

void
scale_waves (bench_table *t, int rounds)
{
  for (int n = 2; n <= BT_WAVES_MAX; n *= 2)
    fly_waves (t, n, 1e-4, rounds);
  fly_waves (t, 32, 1e-2, rounds);
  fly_waves (t, 32, 1e-6, rounds);
}

/* ---- Lees ---- */

/* N piles 15 m apart, the line between them.  */
static bt_obstacle_def *
draw_piles (long n)
{
  bt_obstacle_def *pile = calloc ((size_t)n, sizeof *pile);
  long row = (long)ceil (sqrt ((double)n));
  if (!pile)
    exit (EXIT_FAILURE);
  for (long i = 0; i < n; i++)
    {
      double east = 15.0 * (double)(i % row - row / 2) + 7,
             north = 15.0 * (double)(i / row - row / 2) + 7;
      bt_error error;
      char name[24];
      bt_def_init (bt_head_find ("capsule"), &pile[i]);
      snprintf (name, sizeof name, "pile-%ld", i);
      scene_must (bt_def_set_name (pile[i].name, name, &error), &error);
      pile[i].from = bt__vec (east, north, -60);
      pile[i].to = bt__vec (east, north, 5);
      pile[i].radius = 0.5;
    }
  return pile;
}

static void
fly_lees (bench_table *t, long n, int rounds)
{
  static turns f;
  char setting[60], counters[200];
  scene *s = draw_line ();
  bt_obstacle_def *pile = draw_piles (n);
  scene_current (s, bt__vec (0.3, 0, 0));
  f.n = 0;
  join (&f, s);
  s->world.obstacles = pile;
  s->world.n_obstacles = (int)n;
  join (&f, s);
  s->world.sea.wake = 1;
  join (&f, s);
  take_turns (&f, rounds);
  snprintf (setting, sizeof setting, "%ld piles with lees", n);
  snprintf (counters, sizeof counters,
            "n=%ld;times_open=%.3f;without_lees_times_open=%.3f;lees_ns=%.0f;load_s=%.4f", n,
            times_first (&f, 2, rounds), times_first (&f, 1, rounds),
            1e9 * (bench_median (f.seconds[2], rounds) - bench_median (f.seconds[1], rounds)),
            f.load[2]);
  bench_put (t, &(bench_row){ "lees", "dynamic", setting, "cpu", NAN, NULL, 0,
                              bench_median (f.seconds[2], rounds), counters });
  leave (&f);
  free (pile);
}

void
scale_lees (bench_table *t, long most, int rounds)
{
  for (long n = 10; n <= most; n *= 10)
    fly_lees (t, n, rounds);
}
