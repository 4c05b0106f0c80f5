/* A tether of 100 links of 0.1 m among 1e2 to 1e5 capsules of one density, with contact and far
   from everything; and steps of junk on every stage, judged by the oracle.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/play.h"
#include "testbed/calibration.h"
#include "collision.h"

enum
{
  LINKS = 100
};

/* ---- Fields ---- */

static bt__scene *
make_field (bench *b, uint32_t n, double half)
{
  bt__obstacle *o = calloc (n + 1, sizeof *o);
  bt__scene *scene = NULL;
  if (!o)
    return NULL;
  for (uint32_t i = 0; i < n; i++)
    {
      bt_vec3 a = dice_point (&b->dice, half);
      o[i] = (bt__obstacle){ .kind = BT__OBSTACLE_CAPSULE, .id = i };
      o[i].shape.capsule = (bt__capsule){ a, bt__add (a, dice_direction (&b->dice)), 0.05 };
    }
  double start = bench_now ();
  bt_status status = bt__scene_new (o, n, 1, &scene, NULL);
  double seconds = bench_now () - start;
  char setting[40];
  snprintf (setting, sizeof setting, "%u capsules", (unsigned)n);
  if (n > 0)
    bench_say (b, "build", "scene", setting, "check and tree", 0, NULL, 0, seconds, "");
  free (o);
  return status ? NULL : scene;
}

static double
one_by_one (const bt__scene *s, const bt_vec3 *x)
{
  uint32_t n = 0;
  for (int i = 0; i < LINKS; i++)
    for (uint32_t k = 0; k < s->n; k++)
      {
        bt__link link = { x[i], x[i + 1] };
        bt__witness w;
        bt__obstacle_pair (s->object + k, &link, &w);
        n += w.distance <= BENCH_REACH;
      }
  return n;
}

/* A tether within HALF of FROM.  */
static void
time_field (bench *b, const bt__scene *s, const char *name, bt_vec3 from, double half)
{
  static bt__near room[BENCH_ROOM];
  double times[BENCH_FRAMES], wrong = 0;
  uint64_t pairs = 0;
  bt__count count = { 0 };
  for (int k = 0; k < BENCH_FRAMES; k++)
    {
      bt_vec3 x[LINKS + 1], a = bt__add (from, dice_point (&b->dice, half));
      bt_vec3 along = dice_direction (&b->dice);
      bt__nears list = { room, 0, BENCH_ROOM, INFINITY };
      for (int i = 0; i <= LINKS; i++)
        x[i] = bt__axpy (a, 0.1 * i, along);
      count = (bt__count){ 0 };
      double start = bench_now ();
      for (int i = 0; i < BENCH_REPEATS; i++)
        bt__scene_near_line (s, NULL, x, LINKS + 1, BENCH_REACH, &list, &count);
      times[k] = (bench_now () - start) / BENCH_REPEATS;
      pairs += list.n;
      if (k < 2)
        wrong += fabs (list.n - one_by_one (s, x));
    }
  char setting[40], counters[120];
  snprintf (setting, sizeof setting, "%u capsules", (unsigned)s->n);
  snprintf (counters, sizeof counters, "pairs=%lu;asked=%lu;nodes=%lu;measured=%lu",
            (unsigned long)(pairs / BENCH_FRAMES), (unsigned long)(count.links / BENCH_REPEATS),
            (unsigned long)(count.nodes / BENCH_REPEATS),
            (unsigned long)(count.pairs / BENCH_REPEATS));
  bench_say (b, name, "scene", setting, "frame of 100 links; wrong pairs", wrong, "brute force", 0,
             bench_median (times, BENCH_FRAMES), counters);
}

void
bench_field (bench *b, uint32_t n)
{
  double half = 5 * cbrt (n / 100.0);
  bt__scene *scene = make_field (b, n, half);
  if (!scene)
    return;
  time_field (b, scene, "field", bt__vec (0, 0, 0), 0.5 * half);
  time_field (b, scene, "field far", bt__vec (0, 0, half + 30), 5);
  bt__scene_free (scene);
}

/* ---- Stress ---- */

int
bench_stress (bench *b, long n)
{
  static const struct
  {
    const char *name;
    void (*draw) (stage *, dice *);
  } stages[] = { { "wires", draw_wires },
                 { "cage", draw_cage },
                 { "corners", draw_corners },
                 { "sheets", draw_sheets },
                 { "movers", draw_movers } };
  const double core = 0.0025;
  int sound = 1;
  for (size_t i = 0; i < sizeof stages / sizeof *stages; i++)
    {
      stage *g = calloc (1, sizeof *g);
      char setting[40], counters[200];
      if (!g)
        return 0;
      stages[i].draw (g, &b->dice);
      if (!raise_stage (g))
        return 0;
      double start = bench_now ();
      verdict v = play (g, &b->dice, n, core);
      sound &= !v.crossings && !v.too_near && !v.unlinked;
      snprintf (setting, sizeof setting, "%ld steps", n);
      snprintf (counters, sizeof counters,
                "crossings=%ld;unlinked=%ld;clearance_over_core=%.6f;truncated=%ld;overflows=%ld;"
                "pinched=%ld",
                v.crossings, v.unlinked, v.least / core, v.truncated, v.overflows, v.pinched);
      bench_say (b, "stress", stages[i].name, setting, "crossings", (double)v.crossings,
                 "swept patches", 0, (bench_now () - start) / (double)n, counters);
      strike (g);
    }
  return sound;
}
