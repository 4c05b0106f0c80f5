/* bight-bench-awareness: time and error of what a tether is said to do, as CSV rows.

   Exact cases of about 100 links; scenes drawn at random (piles, jackets of 3 and 8 bays, rings,
   boxes and balls) with lines wound through them, drawn taut at once and led there at 2 cm a frame;
   words, their loading and their steadiness under random moves; voxels beside them; the free length
   beside the best of random detours; ways home, plans to unwind; knots.  Times are CPU.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "aware/haul.h"
#include "aware/knot.h"
#include "aware/shadow_job.h"
#include "aware/turns.h"
#include "aware/voxel_job.h"
#include "testbed/calibration.h"
#include "testbed/aware_cases.h"
#include "options.h"
#include "row.h"

enum
{
  FRAMES_MAX = 400000,
  KINDS = 5,
  QUERIES = 50
};

#define CORE 0.005

static const char *const kinds[KINDS]
    = { "6 piles", "jacket 3 bays", "4 rings", "boxes and balls", "jacket 8 bays" };

typedef struct bench
{
  bench_table table;
  long seed, scenes, detours, moves;
  stage g;
  bt__taut *taut;
  bt__string *s, *fine, *home, *loop, *copy;
  bt__knot *knot;
  bt__count count;
  bt_vec3 p[CASE_NODES];
  double frames[FRAMES_MAX];
  long n;
} bench;

static void
row (bench *b, const char *name, const char *setting, const char *metric, double error,
     const char *reference, double seconds, const char *counters)
{
  bench_put (&b->table, &(bench_row){ name, "aware", setting, metric, error, reference, 0, seconds,
                                      counters });
}

static int
by_size (const void *x, const void *y)
{
  double a = *(const double *)x, b = *(const double *)y;
  return a < b ? -1 : a > b;
}

/* Sort the N numbers X and return the one that SHARE of them do not exceed.  */
static double
quantile (double *x, long n, double share)
{
  qsort (x, (size_t)n, sizeof *x, by_size);
  return n > 0 ? x[(long)(share * (double)(n - 1))] : NAN;
}

static bt__taut_config
config_of (const bench *b, double mesh)
{
  return (bt__taut_config){
    .scene = b->g.scene, .core = CORE, .want = CORE, .mesh = mesh, .margin = 0.4
  };
}

static void
draw (bench *b, int kind, dice *d)
{
  if (kind == 0)
    draw_piles (&b->g, d, 6);
  else if (kind == 1)
    draw_jacket (&b->g, d, 3);
  else if (kind == 2)
    draw_rings (&b->g, d, 4);
  else if (kind == 3)
    draw_boxes (&b->g, d);
  else
    draw_jacket (&b->g, d, 8);
}

/* Lead STRING to END in one timed frame.  */
static void
frame (bench *b, const bt__taut_config *c, bt__string *string, bt_vec3 end)
{
  double start = bench_now ();
  int led = bt__taut_step (b->taut, c, string, string->x[0], end, 1, &b->count);
  if (led && b->n < FRAMES_MAX)
    b->frames[b->n++] = bench_now () - start;
}

/* ---- Exact cases ---- */

static void
exact (bench *b, exact_kind k)
{
  char counters[120];
  double length;
  uint32_t n = exact_case (k, CORE, 100, &b->g, b->p, &length);
  bt__taut_config c = config_of (b, 1.35 * length / 100);
  c.whole = 1;
  bt__string_lay (b->s, b->p, n);
  double start = bench_now ();
  uint32_t steps = bt__taut_relax (b->taut, &c, b->s, 2000, &b->count);
  double cold = bench_now () - start;
  double error = b->s->length / length - 1;
  double arcs = bt__string_length (&c, b->s, &b->count) / length - 1;
  double clear = way_clearance (&c, b->s->x, b->s->n, 1, &b->count);
  snprintf (counters, sizeof counters, "links=%u;steps=%u;arcs=%.2g;clearance=%.9f",
            (unsigned)b->s->n - 1, (unsigned)steps, arcs, clear);
  row (b, "taut", exact_names[k], "share of exact length", error, "closed form", cold, counters);
  bt_vec3 end = b->s->x[b->s->n - 1];
  b->n = 0;
  for (int i = 1; i <= 400; i++)
    frame (b, &c, b->s, bt__axpy (end, 0.02 * (i < 200 ? i : 400 - i), bt__vec (0.72, -0.6, 0.35)));
  double p99 = quantile (b->frames, b->n, 0.99);
  snprintf (counters, sizeof counters, "p99_us=%.1f;frames=%ld", 1e6 * p99, b->n);
  row (b, "taut frame", exact_names[k], "2 cm a frame", NAN, NULL, quantile (b->frames, b->n, 0.5),
       counters);
}

/* ---- Random scenes ---- */

static void
fly (bench *b, const bt__taut_config *c, uint32_t n)
{
  bt__string_lay (b->fine, b->p, 2);
  for (uint32_t i = 1; i + 1 < n; i++)
    for (int k = 1; k <= 25; k++)
      frame (b, c, b->fine, bt__axpy (b->p[i], k / 25.0, bt__sub (b->p[i + 1], b->p[i])));
}

static void
scenes (bench *b, int kind)
{
  char counters[160];
  double cold[1000], error[1000], nodes = 0, clear = INFINITY;
  b->n = 0;
  for (int i = 0; i < b->scenes; i++)
    {
      dice d = dice_new ((uint64_t)b->seed + (uint64_t)(1000 * kind + i));
      draw (b, kind, &d);
      bt__taut_config c = config_of (b, 0.6), fine = config_of (b, 0.6 / 3.5);
      uint32_t n = draw_line (&b->g, &d, 14, 0.35, 0.5, b->p);
      bt__string_lay (b->s, b->p, n);
      double start = bench_now ();
      bt__taut_relax (b->taut, &c, b->s, 400, &b->count);
      cold[i] = bench_now () - start;
      nodes += b->s->n;
      clear = fmin (clear, way_clearance (&c, b->s->x, b->s->n, 1, &b->count));
      bt__string_lay (b->fine, b->p, n);
      bt__taut_relax (b->taut, &fine, b->fine, 4000, &b->count);
      error[i] = fabs (bt__string_length (&c, b->s, &b->count)
                           / bt__string_length (&fine, b->fine, &b->count)
                       - 1);
      fly (b, &c, n);
    }
  double p99 = quantile (b->frames, b->n, 0.99), most = b->frames[b->n - 1];
  snprintf (counters, sizeof counters, "max_ms=%.2f;worst=%.2g;nodes=%.1f;clearance=%.9f",
            1e3 * quantile (cold, b->scenes, 1), quantile (error, b->scenes, 1),
            nodes / (double)b->scenes, clear);
  row (b, "taut", kinds[kind], "median share of length", quantile (error, b->scenes, 0.5),
       "3.5 times finer", quantile (cold, b->scenes, 0.5), counters);
  snprintf (counters, sizeof counters, "p99_us=%.1f;max_us=%.1f;frames=%ld", 1e6 * p99, 1e6 * most,
            b->n);
  row (b, "taut frame", kinds[kind], "2 cm a frame", NAN, NULL, quantile (b->frames, b->n, 0.5),
       counters);
}

/* ---- Words ---- */

static bt__shadow *
shadow_of (const bench *b, double *seconds)
{
  bt__graph graph;
  bt__shadow *shadow = NULL;
  bt__graph_config config = { .scene = b->g.scene, .surface = 0, .gap = 0.01 };
  bt__shadow_config how = { .jitter = 0.2, .tries = 24 };
  double start = bench_now ();
  if (bt__graph_new (&config, &graph, NULL))
    return NULL;
  if (bt__shadow_new (&graph, &how, &shadow, NULL))
    shadow = NULL;
  bt__graph_free (&graph);
  *seconds = bench_now () - start;
  return shadow;
}

/* Return how many of PATHS lines have another word after MOVES moves in all.  */
static int
changed (bench *b, const bt__shadow *shadow, dice *d, int paths)
{
  int out = 0;
  bt__word before, after;
  for (int k = 0; k < paths; k++)
    {
      uint32_t n = draw_line (&b->g, d, 8, 0.1, 0.6, b->p);
      bt__shadow_word (shadow, b->p, n, &before);
      for (long i = 0, tries = 0; i < b->moves / paths && tries < 20 * b->moves; tries++)
        i += move_node (&b->g, d, 0.5, b->p, 1 + (uint32_t)dice_below (d, (int)n - 2));
      bt__shadow_word (shadow, b->p, n, &after);
      out += !is_same_word (&before, &after);
    }
  return out;
}

static void
time_words (bench *b, const bt__shadow *shadow, dice *d, const char *setting)
{
  bt__word word;
  double letters = 0;
  b->n = 0;
  for (int k = 0; k < 60; k++)
    {
      uint32_t n = draw_line (&b->g, d, 12, 0.2, 0.25, b->p);
      double start = bench_now ();
      for (int i = 0; i < 20; i++)
        bt__shadow_word (shadow, b->p, n, &word);
      b->frames[b->n++] = (bench_now () - start) / 20 * 100 / (n - 1);
      letters += word.n / 60.0;
    }
  char counters[80];
  double most = quantile (b->frames, b->n, 1);
  snprintf (counters, sizeof counters, "max_us=%.1f;letters=%.0f", 1e6 * most, letters);
  row (b, "word", setting, "100 links", NAN, NULL, quantile (b->frames, b->n, 0.5), counters);
}

static void
words (bench *b)
{
  static const struct
  {
    const char *name;
    int rings, bays;
  } scene[] = { { "6 piles", 0, 0 },       { "ring", 1, 0 },          { "3 rings", 3, 0 },
                { "jacket 2 bays", 0, 2 }, { "jacket 4 bays", 0, 4 }, { "jacket 8 bays", 0, 8 } };
  for (int k = 0; k < 6; k++)
    {
      dice d = dice_new ((uint64_t)b->seed + 7);
      double load;
      if (scene[k].bays)
        draw_jacket (&b->g, &d, scene[k].bays);
      else if (scene[k].rings)
        draw_rings (&b->g, &d, scene[k].rings);
      else
        draw_piles (&b->g, &d, 6);
      bt__shadow *shadow = shadow_of (b, &load);
      if (!shadow)
        continue;
      bt__shadow_report r;
      char counters[120];
      r = shadow->report;
      snprintf (counters, sizeof counters, "rank=%u;expected=%u;crossings=%u;longest=%u",
                (unsigned)r.rank, (unsigned)r.expected, (unsigned)r.crossings, (unsigned)r.longest);
      row (b, "words load", scene[k].name, "relations left", r.leftover, "theory", load, counters);
      time_words (b, shadow, &d, scene[k].name);
      double start = bench_now ();
      int out = changed (b, shadow, &d, 60);
      snprintf (counters, sizeof counters, "moves=%ld", b->moves);
      row (b, "words moved", scene[k].name, "of 60 words changed", out, "none may",
           (bench_now () - start) / (double)b->moves, counters);
      bt__shadow_free (shadow);
    }
}

static void
voxels (bench *b, int kind)
{
  enum
  {
    PATHS = 40
  };
  static bt__word one[PATHS], other[PATHS];
  dice d = dice_new ((uint64_t)b->seed + 11);
  double load;
  draw (b, kind, &d);
  bt__shadow *shadow = shadow_of (b, &load);
  bt__voxels *v = NULL;
  bt__voxel_config c = { b->g.scene, NULL, bt__vec (-18, -14, -20), bt__vec (18, 14, 0), 0.5 };
  double start = bench_now ();
  bt_status status = bt__voxels_new (&c, NULL, &v, NULL);
  load = bench_now () - start;
  if (shadow && !status)
    {
      bt_vec3 from = draw_point (&b->g, &d, 0.4), to = draw_point (&b->g, &d, 0.4);
      int pairs = 0, agree = 0, lost = 0;
      bt__voxel_report r;
      bt__shadow_report known;
      r = v->report;
      known = shadow->report;
      b->n = 0;
      for (int i = 0; i < PATHS; i++)
        {
          uint32_t n = draw_between (&b->g, &d, from, to, 2 + i % 6, 0.2, 0.5, b->p);
          bt__shadow_word (shadow, b->p, n, one + i);
          start = bench_now ();
          bt__voxels_word (v, b->p, n, other + i, &b->count);
          b->frames[b->n++] = bench_now () - start;
          lost += other[i].lost;
        }
      for (int i = 0; i < PATHS; i++)
        for (int j = 0; j < i; j++)
          if (!other[i].lost && !other[j].lost)
            {
              pairs++;
              agree += is_same_word (one + i, one + j) == is_same_word (other + i, other + j);
            }
      char counters[120];
      snprintf (counters, sizeof counters, "cells=%u;generators=%u;rank=%u;left=%u",
                (unsigned)r.cells, (unsigned)r.generators, (unsigned)known.rank,
                (unsigned)r.leftover);
      row (b, "voxels load", kinds[kind], "0.5 m", NAN, NULL, load, counters);
      snprintf (counters, sizeof counters, "pairs=%d;lost=%d", pairs, lost);
      row (b, "voxel word", kinds[kind], "pairs that disagree", pairs - agree, "words",
           quantile (b->frames, b->n, 0.5), counters);
    }
  bt__voxels_free (v);
  bt__shadow_free (shadow);
}

/* ---- The free length ---- */

static void
free_lengths (bench *b, int kind)
{
  char counters[120];
  double first[1000] = { 0 }, worst = 0;
  int asked = 0, longer = 0, queries = b->detours ? 4 : 0;
  b->n = 0;
  for (int i = 0; i < b->scenes; i++)
    {
      dice d = dice_new ((uint64_t)b->seed + (uint64_t)(1000 * kind + i));
      bt__free *tree;
      draw (b, kind, &d);
      bt__taut_config c = config_of (b, 0.6);
      bt__free_config f
          = { b->g.scene, NULL, bt__vec (-18, -14, -20), bt__vec (18, 14, 0), 0.75, 0.03 };
      draw_line (&b->g, &d, 1, 0.35, 0.5, b->p);
      if (bt__free_new (&f, &tree, NULL))
        return;
      bt__free_plant (tree, b->p[0]);
      for (int k = 0; k < QUERIES; k++)
        {
          bt_vec3 to = draw_point (&b->g, &d, 0.3);
          double start = bench_now ();
          double is = tight_free_length (tree, b->p[0], to, 60, b->taut, &c, b->s, &b->count);
          b->frames[b->n++] = bench_now () - start;
          first[i] = k == 0 ? b->frames[b->n - 1] : first[i];
          if (k >= queries)
            continue;
          double best = best_detour (&b->g, &d, b->taut, &c, b->p[0], to, (int)b->detours, b->s);
          asked++;
          longer += is > 1.002 * best;
          worst = fmax (worst, is / best - 1);
        }
      bt__free_free (tree);
    }
  row (b, "free first", kinds[kind], "0.75 m", NAN, NULL, quantile (first, b->scenes, 0.5), "");
  double p95 = quantile (b->frames, b->n, 0.95);
  snprintf (counters, sizeof counters, "p95_us=%.1f;asked=%d;worst=%.2g", 1e6 * p95, asked, worst);
  row (b, "free length", kinds[kind], "share longer by 0.2 %", asked ? (double)longer / asked : NAN,
       "best of random detours", quantile (b->frames, b->n, 0.5), counters);
}

/* ---- Hauling and knots ---- */

static void
hauls (bench *b, int kind)
{
  char counters[120];
  double home[1000], plan[1000];
  int needed = 0, feasible = 0, wide = 0;
  for (int i = 0; i < b->scenes; i++)
    {
      dice d = dice_new ((uint64_t)b->seed + (uint64_t)(1000 * kind + i));
      bt__free *tree;
      draw (b, kind, &d);
      bt__taut_config c = config_of (b, 0.6);
      bt__free_config f
          = { b->g.scene, NULL, bt__vec (-18, -14, -20), bt__vec (18, 14, 0), 0.75, 0.03 };
      uint32_t n = draw_line (&b->g, &d, 10, 0.4, 0.5, b->p);
      bt__string_lay (b->s, b->p, n);
      bt__taut_relax (b->taut, &c, b->s, 400, &b->count);
      if (bt__free_new (&f, &tree, NULL))
        return;
      bt__free_plant (tree, b->p[0]);
      tight_free_length (tree, b->p[0], b->p[n - 1], 200, b->taut, &c, b->fine, &b->count);
      double start = bench_now ();
      bt__route w = bt__way_home (b->taut, &c, b->s, 0.32, b->home, &b->count);
      home[i] = bench_now () - start;
      wide += w.clearance > 0.3;
      start = bench_now ();
      bt__unwind u = bt__unwind_plan (b->taut, &c, b->s, b->fine, 0.45, 1.2 * b->s->length, 0.3,
                                      b->loop, b->copy, &b->count);
      plan[i] = bench_now () - start;
      needed += u.needed;
      feasible += u.feasible;
      bt__free_free (tree);
    }
  snprintf (counters, sizeof counters, "of=%ld", b->scenes);
  row (b, "way home", kinds[kind], "too narrow", (double)(b->scenes - wide), "vehicle of 0.3 m",
       quantile (home, b->scenes, 0.5), counters);
  snprintf (counters, sizeof counters, "max_ms=%.2f;needed=%d", 1e3 * quantile (plan, b->scenes, 1),
            needed);
  row (b, "unwind plan", kinds[kind], "not feasible", needed - feasible, "preview",
       quantile (plan, b->scenes, 0.5), counters);
}

static void
knots (bench *b)
{
  int knotted = 0;
  double crossings = 0;
  b->n = 0;
  for (int i = 0; i < 50; i++)
    {
      dice d = dice_new ((uint64_t)b->seed + (uint64_t)i);
      bt__knot_value v;
      bt_vec3 at = bt__vec (0, 0, 0), way = dice_direction (&d);
      for (int k = 0; k < 200; k++)
        {
          b->p[k] = at;
          way = bt__unit_or (bt__axpy (way, 0.5, dice_direction (&d)), way);
          at = bt__axpy (bt__scale (0.97, at), 0.5, way);
        }
      double start = bench_now ();
      int told = bt__knot_of (b->knot, b->p, 200, &v);
      b->frames[b->n++] = bench_now () - start;
      knotted += told && v.knotted;
      crossings += told ? v.crossings / 50.0 : 0;
    }
  char counters[80];
  double most = quantile (b->frames, b->n, 1);
  snprintf (counters, sizeof counters, "max_us=%.0f;knotted=%d;crossings=%.1f", 1e6 * most, knotted,
            crossings);
  row (b, "knot", "200 links in a ball", "Alexander", NAN, NULL, quantile (b->frames, b->n, 0.5),
       counters);
}

/* ---- All of it ---- */

static bt__string *
new_string (void)
{
  bt__string *s = calloc (1, bt__string_size (CASE_NODES));
  if (s)
    s->room = CASE_NODES;
  return s;
}

static int
run (bench *b)
{
  b->s = new_string ();
  b->fine = new_string ();
  b->home = new_string ();
  b->loop = new_string ();
  b->copy = new_string ();
  if (!b->s || !b->fine || !b->home || !b->loop || !b->copy
      || bt__taut_new (CASE_NODES, &b->taut, NULL) || bt__knot_new (CASE_NODES, &b->knot, NULL))
    return EXIT_FAILURE;
  bench_open (&b->table);
  for (int k = 0; k < EXACT_KINDS; k++)
    exact (b, (exact_kind)k);
  for (int k = 0; k < KINDS; k++)
    scenes (b, k);
  words (b);
  for (int k = 0; k < 4; k++)
    voxels (b, k);
  for (int k = 0; k < KINDS; k++)
    free_lengths (b, k);
  for (int k = 0; k < 3; k++)
    hauls (b, k);
  knots (b);
  stage_clear (&b->g);
  free (b->s);
  free (b->fine);
  free (b->home);
  free (b->loop);
  free (b->copy);
  bt__taut_free (b->taut);
  bt__knot_free (b->knot);
  return bench_close (&b->table);
}

int
main (int argc, char **argv)
{
  static bench b = { .scenes = 20, .detours = 150, .moves = 100000, .seed = 1 };
  const bench_option options[] = {
    { "scenes", &b.scenes, 1, 1000, 3, "scenes of each kind" },
    { "moves", &b.moves, 60, LONG_MAX, 6000, "random moves a scene that may not change a word" },
    { "detours", &b.detours, 0, INT_MAX, 20, "random detours beside a free length" },
    { "seed", &b.seed, 0, LONG_MAX, 0, "seed of the random numbers" },
  };
  const bench_program program
      = { "awareness", "Measure time and error of what a tether is said to do", options, 4 };
  int status = bench_options (&program, argc, argv);
  return status == BENCH_GO_ON ? run (&b) : status;
}
