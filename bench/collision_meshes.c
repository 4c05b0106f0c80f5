/* The jacket of jacket.h in 1e4 to 1e6 triangles: a tether of 100 links hung over its braces, one
   laid along a face and one wound round a leg, every triangle within 6 cm of each link, counted
   again by brute force; the same by FCL and Bullet where they are installed (rivals.h); the safe
   step; the beams of a sonar; the hull of a vehicle on its way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/calibration.h"
#include "collide/ray.h"
#include "collide/sweep.h"
#include "collision.h"
#include "rivals.h"

enum
{
  LINKS = JACKET_LINKS
};

/* Every triangle within REACH of each link, the long way.  */
static rival_answer
brute_force (const jacket *j, const bt_vec3 *x, int n)
{
  rival_answer answer = { 0, 0 };
  for (int i = 0; i < n; i++)
    for (uint32_t k = 0; k < j->triangles; k++)
      {
        const uint32_t *c = j->corner[k];
        bt_vec3 t[3] = { j->v[c[0]], j->v[c[1]], j->v[c[2]] };
        if (!rival_measure (t, x[i], x[i + 1], BENCH_REACH))
          continue;
        answer.pairs++;
        answer.sum += k;
      }
  return answer;
}

static rival_answer
answer_of (const bt__nears *list)
{
  rival_answer answer = { list->n, 0 };
  for (uint32_t i = 0; i < list->n; i++)
    answer.sum += list->at[i].triangle;
  return answer;
}

/* The pairs by which two answers differ, at least; the same number of other triangles counts 1.  */
static double
difference (rival_answer a, rival_answer b)
{
  return fmax (labs (a.pairs - b.pairs), a.sum != b.sum);
}

/* Return the seconds of a frame.  Each frame is asked once before it is timed.  */
static double
time_frames (bench *b, const bt__scene *s, const jacket *j, const char *name, const char *setting,
             jacket_layer lay)
{
  static bt__near room[BENCH_ROOM];
  double times[BENCH_FRAMES], wrong = 0;
  bt__count count = { 0 };
  uint64_t pairs = 0;
  for (int k = 0; k < BENCH_FRAMES; k++)
    {
      bt_vec3 x[LINKS + 1];
      bt__nears list = { room, 0, BENCH_ROOM, INFINITY };
      lay (x, 0.004 * k);
      bt__scene_near_line (s, NULL, x, LINKS + 1, BENCH_REACH, &list, &count);
      count = (bt__count){ 0 };
      double start = bench_now ();
      for (int i = 0; i < BENCH_REPEATS; i++)
        bt__scene_near_line (s, NULL, x, LINKS + 1, BENCH_REACH, &list, &count);
      times[k] = (bench_now () - start) / BENCH_REPEATS;
      pairs += list.n;
      if (k == 0)
        wrong = difference (answer_of (&list), brute_force (j, x, LINKS));
    }
  char counters[120];
  double seconds = bench_median (times, BENCH_FRAMES);
  snprintf (counters, sizeof counters, "pairs=%lu;measured=%lu;nodes=%lu",
            (unsigned long)(pairs / BENCH_FRAMES), (unsigned long)(count.pairs / BENCH_REPEATS),
            (unsigned long)(count.nodes / BENCH_REPEATS));
  bench_say (b, name, "mesh", setting, "frame of 100 links; wrong pairs", wrong, "brute force", 0,
             seconds, counters);
  return seconds;
}

/* ---- The rivals ---- */

typedef struct own_times
{
  double build, drape, lie, wrap;
} own_times;

#if defined HAVE_FCL || defined HAVE_BULLET
static void
time_rival_frames (bench *b, const rival *r, void *built, const jacket *j, const char *name,
                   jacket_layer lay, double own)
{
  enum
  {
    FEW = 10
  };
  double times[FEW], wrong = 0;
  rival_answer answer = { 0, 0 };
  for (int k = 0; k < FEW; k++)
    {
      bt_vec3 x[LINKS + 1];
      lay (x, 0.004 * k);
      answer = r->frame (built, x, LINKS, BENCH_REACH); /* not timed */
      if (k == 0)
        wrong = difference (answer, brute_force (j, x, LINKS));
      double start = bench_now ();
      for (int i = 0; i < BENCH_REPEATS; i++)
        answer = r->frame (built, x, LINKS, BENCH_REACH);
      times[k] = (bench_now () - start) / BENCH_REPEATS;
    }
  char setting[60], counters[80];
  double seconds = bench_median (times, FEW);
  snprintf (setting, sizeof setting, "%s; %u triangles", r->name, (unsigned)j->triangles);
  snprintf (counters, sizeof counters, "pairs=%ld;ratio=%.2f", answer.pairs, seconds / own);
  bench_say (b, name, "rival", setting, "frame of 100 links; wrong pairs", wrong, "brute force", 0,
             seconds, counters);
}

static void
run_rival (bench *b, const rival *r, const jacket *j, const own_times *own)
{
  char setting[60], counters[80];
  double start = bench_now ();
  void *built = r->build (j);
  double seconds = bench_now () - start;
  snprintf (setting, sizeof setting, "%s; %u triangles", r->name, (unsigned)j->triangles);
  snprintf (counters, sizeof counters, "ratio=%.2f", seconds / own->build);
  bench_say (b, "build", "rival", setting, "tree", 0, NULL, 0, seconds, counters);
  time_rival_frames (b, r, built, j, "drape", jacket_drape, own->drape);
  time_rival_frames (b, r, built, j, "lie", jacket_lie, own->lie);
  time_rival_frames (b, r, built, j, "wrap", jacket_wrap, own->wrap);
  r->drop (built);
}
#endif

static void
run_rivals (bench *b, const jacket *j, const own_times *own)
{
#ifdef HAVE_FCL
  run_rival (b, &rival_fcl, j, own);
#endif
#ifdef HAVE_BULLET
  run_rival (b, &rival_bullet_contact, j, own);
  run_rival (b, &rival_bullet_tree, j, own);
#endif
  (void)b;
  (void)j;
  (void)own;
}

static void
time_safe (bench *b, const bt__scene *s, const char *name, const char *setting, jacket_layer lay)
{
  bt__safe *safe = NULL;
  bt__safe_config config = { 0.0025, 2, 4 };
  bt__safe_report report;
  bt__count count = { 0 };
  double times[BENCH_FRAMES];
  bt_vec3 x[LINKS + 1], want[LINKS + 1];
  dice d = dice_new (1);
  if (bt__safe_new (LINKS + 1, 64, &safe, NULL))
    return;
  lay (x, 0);
  for (int k = 0; k < BENCH_FRAMES; k++)
    {
      for (int i = 0; i <= LINKS; i++)
        want[i] = bt__add (x[i], dice_point (&d, 0.02));
      double start = bench_now ();
      bt__safe_step (safe, &config, s, NULL, NULL, 0, x, want, LINKS + 1, &report, &count);
      times[k] = bench_now () - start;
    }
  char counters[120];
  snprintf (counters, sizeof counters, "casts=%lu;skipped=%lu;pairs=%lu",
            (unsigned long)(count.casts / BENCH_FRAMES),
            (unsigned long)(count.skipped_clear / BENCH_FRAMES),
            (unsigned long)(count.pairs / BENCH_FRAMES));
  bench_say (b, name, "safe step", setting, "2 cm at random", 0, NULL, 0,
             bench_median (times, BENCH_FRAMES), counters);
  bt__safe_free (safe);
}

/* A fan of 120 beams, 120 degrees wide and 100 m long, from a vehicle among the legs.  */
static void
time_beams (bench *b, const bt__scene *s, const char *setting)
{
  enum
  {
    BEAMS = 120
  };
  double times[BENCH_FRAMES];
  bt__count count = { 0 };
  long hits = 0;
  for (int k = 0; k < BENCH_FRAMES; k++)
    {
      double start = bench_now ();
      for (int i = 0; i < BEAMS; i++)
        {
          double w = 0.2 * k + 2 * BT__PI / 3 * ((double)i / (BEAMS - 1) - 0.5);
          bt__ray ray = { { 5, -3, -47 }, { cos (w), sin (w), 0 }, 100 };
          bt__ray_hit hit;
          hits += bt__ray_cast (s, NULL, NULL, 0, &ray, &hit, &count);
        }
      times[k] = bench_now () - start;
    }
  char counters[120];
  snprintf (counters, sizeof counters, "hits=%ld;measured=%lu;nodes=%lu", hits / BENCH_FRAMES,
            (unsigned long)(count.pairs / BENCH_FRAMES),
            (unsigned long)(count.nodes / BENCH_FRAMES));
  bench_say (b, "beams", "mesh", setting, "fan of 120 beams", 0, NULL, 0,
             bench_median (times, BENCH_FRAMES), counters);
}

/* A hull of 1 m that comes down on a brace, 10 cm a frame, turning.  */
static void
time_hull (bench *b, const bt__scene *s, const char *setting)
{
  static const bt__box box
      = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0.5, 0.35, 0.3 } };
  bt__body body = bt__body_box (&box, 0);
  bt__motion m
      = { .from = box.frame, .travel = { 0.05, 0, -0.1 }, .axis = { 0, 0, 1 }, .angle = 0.02 };
  double times[BENCH_FRAMES], least = INFINITY;
  bt__count count = { 0 };
  m.from.origin = bt__vec (-11, -30, -38);
  for (int k = 0; k < BENCH_FRAMES; k++)
    {
      bt__stop stop;
      double start = bench_now ();
      double share = bt__body_sweep (&body, &m, 0.02, s, NULL, NULL, 0, &stop, &count);
      times[k] = bench_now () - start;
      m.from = bt__motion_at (&m, share);
      if (bt__body_nearest (&body, &m.from, 1, s, NULL, NULL, 0, &stop, &count))
        least = fmin (least, stop.distance);
    }
  char counters[120];
  snprintf (counters, sizeof counters, "least=%.6g;chases=%lu", least,
            (unsigned long)(count.casts / BENCH_FRAMES));
  bench_say (b, "hull", "mesh", setting, "step of 10 cm on to a brace", 0, NULL, 0,
             bench_median (times, BENCH_FRAMES), counters);
}

static void
run_mesh (bench *b, jacket *s, uint32_t wanted)
{
  char setting[40], counters[80];
  bt__scene *scene = NULL;
  double times[3];
  jacket_make (s, wanted);
  snprintf (setting, sizeof setting, "%u triangles", (unsigned)s->triangles);
  bt__soup as_mesh = { s->vertices, s->triangles, s->v, (const uint32_t (*)[3])s->corner, NULL, 0 };
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH };
  for (int k = 0; k < 3; k++)
    {
      if (k)
        bt__mesh_free (o.shape.mesh);
      double start = bench_now ();
      if (bt__mesh_new (&as_mesh, NULL, NULL, &o.shape.mesh, NULL))
        return;
      times[k] = bench_now () - start;
    }
  snprintf (counters, sizeof counters, "nodes=%u", (unsigned)o.shape.mesh->tree.nodes);
  bench_say (b, "build", "mesh", setting, "copy check tree", 0, NULL, 0, bench_median (times, 3),
             counters);
  if (bt__scene_new (&o, 1, 1, &scene, NULL))
    return;
  own_times own = { .build = times[1] }; /* sorted by now */
  own.drape = time_frames (b, scene, s, "drape", setting, jacket_drape);
  own.lie = time_frames (b, scene, s, "lie", setting, jacket_lie);
  own.wrap = time_frames (b, scene, s, "wrap", setting, jacket_wrap);
  time_safe (b, scene, "drape", setting, jacket_drape);
  time_safe (b, scene, "wrap", setting, jacket_wrap);
  time_beams (b, scene, setting);
  time_hull (b, scene, setting);
  bt__scene_free (scene);
  run_rivals (b, s, &own);
}

void
bench_meshes (bench *b, uint32_t most)
{
  jacket j;
  if (!jacket_new (&j, most))
    return;
  for (uint32_t n = 10000; n <= most; n *= 10)
    run_mesh (b, &j, n);
  jacket_free (&j);
}
