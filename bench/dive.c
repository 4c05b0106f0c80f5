/* bight-bench-dive: what a whole dive costs, as CSV rows on standard output.

   The scene, testbed/worlds/deep-jacket.scm, has everything: a BlueROV2 Heavy holding its place in
   a jacket, on 100 nodes of a moving line whose anchor rides a wind sea, in a current with the
   jacket's lee.  Row `all' is the
   CPU time of a step; among its counters, how many times faster than real time that is.  Each row
   `without ...' is the same dive with one part left out: share_percent is that part's share of the
   step; the counters of the part are zero when the scene lacks it.  The error is the share of steps
   not solved to tolerance.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/calibration.h"
#include "math/vec.h"
#include "options.h"
#include "row.h"
#include "testbed/gallery.h"
#include "testbed/scene.h"

enum
{
  ROUNDS = 5
};

/* What the scene has.  */
enum
{
  VEHICLE = 1,
  JACKET = 2,
  WAKE = 4,
  WAVES = 8,
  CURRENT = 16,
  LINE = 32,
  ALL = 63
};

typedef struct cost
{
  double step; /* s of CPU */
  bt_profile profile;
} cost;

/* ---- The scene ---- */

/* Take from W what HAS does not name.  */
static void
strip (gallery_world *w, int has)
{
  bt_sea_def *sea = &w->world.sea;
  if (!(has & VEHICLE))
    w->vehicle->mass = 0;
  if (!(has & JACKET))
    w->world.n_obstacles = 0;
  if (!(has & WAKE))
    sea->wake = 0;
  if (!(has & WAVES))
    sea->waves = (bt_wave_def){ 0 };
  if (!(has & CURRENT))
    sea->current = (bt_current){ 0 };
  if (!(has & LINE))
    w->world.n_tethers = 0;
}

/* ---- Measuring ---- */

static bt_dive *
begin (int has)
{
  gallery_world *w = gallery_open ("deep-jacket");
  bt_error error;
  strip (w, has);
  bt_dive *dive = scene_begin (&w->world);
  gallery_close (w);
  scene_must (bt_dive_do (dive, BT_OP_HOLD_POSITION, 0, NULL, 0, &error), &error);
  return dive;
}

static cost
measure (int has, int steps)
{
  double seconds[ROUNDS];
  cost c;
  for (int r = 0; r < ROUNDS; r++)
    {
      bt_dive *dive = begin (has);
      scene_fly (dive, 1, 0, 60);
      seconds[r] = scene_fly (dive, 1, 60, steps);
      bt_dive_profile (dive, &c.profile);
      bt_dive_free (dive);
    }
  c.step = bench_median (seconds, ROUNDS);
  return c;
}

static void
row (bench_table *t, const char *name, const char *setting, const cost *c, const cost *all)
{
  const bt_profile *p = &c->profile;
  char counters[300];
  snprintf (counters, sizeof counters,
            "times_real_time=%.4g;share_percent=%.3g;chain_steps=%llu;body_steps=%llu;"
            "links_asked=%llu;wave_samples=%llu;lee_samples=%llu",
            1.0 / 60 / c->step, 100 * (1 - c->step / all->step), (unsigned long long)p->chain_steps,
            (unsigned long long)p->body_steps, (unsigned long long)p->links_asked,
            (unsigned long long)p->wave_samples, (unsigned long long)p->lee_samples);
  bench_put (
      t, &(bench_row){ name, "dynamic", setting, "unsolved share of steps",
                       p->chain_steps ? (double)p->chain_unconverged / (double)p->chain_steps : NAN,
                       "tolerance of the step", 0, c->step, counters });
}

static int
run (int steps)
{
  static const struct
  {
    const char *name;
    int has;
  } parts[] = { { "without vehicle's mass", VEHICLE },
                { "without jacket and lee", JACKET | WAKE },
                { "without lee", WAKE },
                { "without waves", WAVES },
                { "without current and lee", CURRENT | WAKE },
                { "without line", LINE } };
  bench_table table;
  bench_open (&table);
  cost all = measure (ALL, steps);
  row (&table, "jacket", "all", &all, &all);
  for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
    {
      cost c = measure (ALL & ~parts[k].has, steps);
      row (&table, "jacket", parts[k].name, &c, &all);
    }
  return bench_close (&table);
}

int
main (int argc, char **argv)
{
  long steps = 3600;
  const bench_option options[]
      = { { "steps", &steps, 1, 10000000, 240, "steps of each of five dives" } };
  const bench_program program = { "dive", "Measure what a whole dive costs", options, 1 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run ((int)steps) : status;
}
