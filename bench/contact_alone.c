/* See contact_alone.h.

   Two lines are flown the same way by turns, a round of each at a time: one by its own step, one
   with something to look out for.  Neither ever touches anything; that both go the same way to the
   last bit is the row's error.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "testbed/calibration.h"
#include "contact_alone.h"
#include "testbed/contact_scene.h"

enum
{
  LINKS = 100,
  POINTS = 140,
  ROUNDS_MAX = 201,
  STEPS = 400
};

static const double frame = 1.0 / 60;

/* A line and how it is flown: its end goes WIDE metres to and fro.  */
typedef struct scene
{
  const char *name;
  int (*lay) (bt_vec3 *p);
  double wide, weight; /* m, N/m */
  int far, itself;     /* nonzero: something stands far away; it looks out for itself */
} scene;

/* ---- Shapes ---- */

static int
hang (bt_vec3 *p)
{
  for (int i = 0; i <= 60; i++)
    {
      double u = i / 30.0 - 1;
      p[i] = bt__vec (20 * u, 0, -14 * (1 - u * u));
    }
  return 61;
}

/* Down and up again, 0.6 m beside.  */
static int
fold (bt_vec3 *p)
{
  int n = 0;
  for (int i = 0; i <= 30; i++)
    p[n++] = bt__vec (0, 0, -25.0 * i / 30);
  for (int i = 1; i < 12; i++)
    p[n++] = bt__vec (0.3 - 0.3 * cos (BT__PI * i / 12), 0, -25 - 0.3 * sin (BT__PI * i / 12));
  for (int i = 0; i <= 30; i++)
    p[n++] = bt__vec (0.6, 0, -25 + 25.0 * i / 30);
  return n;
}

/* Five turns of 2 m, 0.12 m one above the other.  */
static int
coil (bt_vec3 *p)
{
  for (int i = 0; i <= 120; i++)
    {
      double a = 2 * BT__PI * 5 * i / 120;
      p[i] = bt__vec (cos (a), sin (a), -0.12 * a / (2 * BT__PI));
    }
  return 121;
}

static const scene scenes[] = {
  { "a scene far away", hang, 1, 0.5, 1, 0 },
  { "itself, hanging", hang, 1, 0.5, 0, 1 },
  { "itself, folded", fold, 0.2, 0.5, 0, 1 },
  { "itself, coiled", coil, 0.05, 0, 0, 1 },
};

/* ---- Flown by turns ---- */

typedef struct twin
{
  reef place;
  rope line;
  bt_vec3 end;
  long step, pairs;
} twin;

static int
open_twin (twin *t, const scene *s, int looks)
{
  bt_vec3 p[POINTS];
  int n = s->lay (p);
  double length = bt__length (p, (uint32_t)n);
  *t = (twin){ .end = p[n - 1] };
  if (!reef_open (&t->place))
    return 0;
  if (looks && s->far)
    reef_box (&t->place, bt__vec (10, 0, -60), bt__vec (1, 1, 1), 0);
  if (!reef_raise (&t->place) || !rope_open (&t->line, &t->place, LINKS, p, n, length, 0.3))
    return 0;
  t->line.line.wet_weight = s->weight;
  t->line.line.mass += s->weight / 9.81;
  t->line.config.itself = looks && s->itself;
  return 1;
}

/* Fly T for a round; return its CPU seconds a step.  */
static double
fly (twin *t, const scene *s)
{
  double start = bench_now ();
  for (int i = 0; i < STEPS; i++)
    {
      double a = frame * (double)t->step++;
      bt_vec3 way = { sin (a), cos (1.3 * a) - 1, sin (0.7 * a) };
      t->line.in.end[1].at = bt__axpy (t->end, s->wide, way);
      rope_step (&t->line, frame, 0);
      t->pairs += t->line.touch.pairs;
    }
  return (bench_now () - start) / STEPS;
}

static double
farthest_apart (const twin *a, const twin *b)
{
  double most = 0;
  for (int i = 0; i <= LINKS; i++)
    most = fmax (most, bt__distance (bt__dynamic_x (a->line.d)[i], bt__dynamic_x (b->line.d)[i]));
  return most;
}

static int
measure (bench_table *table, const scene *s, int rounds)
{
  static twin t[2];
  static double seconds[2][ROUNDS_MAX], ratio[ROUNDS_MAX];
  char counters[120];
  if (!open_twin (t, s, 0) || !open_twin (t + 1, s, 1))
    return 0;
  for (int k = 0; k < rounds; k++)
    {
      for (int i = 0; i < 2; i++)
        {
          int which = (i + k) % 2;
          seconds[which][k] = fly (t + which, s);
        }
      ratio[k] = seconds[1][k] / seconds[0][k];
    }
  snprintf (counters, sizeof counters, "times_own=%.4f;pairs=%.2f;touches=%ld",
            bench_median (ratio, rounds), (double)t[1].pairs / (double)t[1].step,
            t[1].line.touches);
  bench_put (table, &(bench_row){ "alone", "dynamic", s->name, "m from where its own step leads",
                                  farthest_apart (t, t + 1), "its own step", 0,
                                  bench_median (seconds[1], rounds), counters });
  for (int i = 0; i < 2; i++)
    {
      rope_close (&t[i].line);
      reef_close (&t[i].place);
    }
  return 1;
}

int
contact_alone (bench_table *table, int rounds)
{
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
    if (!measure (table, scenes + i, rounds < ROUNDS_MAX ? rounds : ROUNDS_MAX))
      return 0;
  return 1;
}
