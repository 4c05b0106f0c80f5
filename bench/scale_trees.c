/* The trees of large meshes: see scale_trees.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/hash.h"
#include "collide/mesh.h"
#include "jacket.h"
#include "scale_trees.h"
#include "testbed/calibration.h"
#include "testbed/scene.h"

enum
{
  FINE = 100000,
  MOST_ROUNDS = 101
};

typedef enum way
{
  ALONE,
  BY_TWO,
  FROM_DISK,
  WAYS
} way;

static const char *const ways[WAYS] = { "one thread", "two threads", "from disk" };

typedef struct times
{
  double all[WAYS][MOST_ROUNDS];    /* s of CPU of the process */
  double caller[WAYS][MOST_ROUNDS]; /* of which in the calling thread */
  int strays[WAYS];                 /* meshes with other bits */
} times;

static double
caller_now (void)
{
  struct timespec t;
  clock_gettime (CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t
mesh_bits (const bt__mesh *m)
{
  uint64_t h = bt__hash (m->tree.node, m->tree.nodes * sizeof *m->tree.node, 0);
  h = bt__hash (m->corner, m->triangles * sizeof *m->corner, h);
  h = bt__hash (m->next_corner, 3 * (size_t)m->triangles * sizeof *m->next_corner, h);
  h = bt__hash (m->next_edge, 3 * (size_t)m->triangles * sizeof *m->next_edge, h);
  return bt__hash (m->folds, m->triangles, h);
}

static uint64_t
make_mesh (const jacket *j, way how, double *all, double *caller)
{
  bt__soup soup = { j->vertices, j->triangles,         j->v, (const uint32_t (*)[3])j->corner,
                    NULL,        how == BY_TWO ? 2 : 1 };
  double begun = bench_now (), begun_here = caller_now ();
  bt__mesh *m;
  bt_error error;
  scene_must (bt__mesh_new (&soup, NULL, NULL, &m, &error), &error);
  *all = bench_now () - begun;
  *caller = caller_now () - begun_here;
  uint64_t bits = mesh_bits (m);
  bt__mesh_free (m);
  return bits;
}

/* Trees are kept in FOLDER, after the first mesh.  */
static void
take_times (const jacket *j, const char *folder, int rounds, times *out)
{
  double unused[2];
  setenv ("BIGHT_TREES", folder, 1);
  uint64_t bits = make_mesh (j, ALONE, unused, unused + 1);
  for (int r = 0; r < rounds; r++)
    for (way how = 0; how < WAYS; how++)
      {
        setenv ("BIGHT_TREES", how == FROM_DISK ? folder : "", 1);
        out->strays[how] += make_mesh (j, how, out->all[how] + r, out->caller[how] + r) != bits;
      }
  setenv ("BIGHT_TREES", "", 1);
}

static void
put_times (bench_table *t, const jacket *j, int rounds, times *got)
{
  double alone[MOST_ROUNDS], share[MOST_ROUNDS], here[MOST_ROUNDS];
  for (int r = 0; r < rounds; r++)
    alone[r] = got->all[ALONE][r];
  for (way how = 0; how < WAYS; how++)
    {
      char setting[60], counters[120];
      for (int r = 0; r < rounds; r++)
        {
          share[r] = got->all[how][r] / alone[r];
          here[r] = got->caller[how][r] / alone[r];
        }
      double least = 1e9, most = 0;
      for (int r = 0; r < rounds; r++)
        {
          least = fmin (least, here[r]);
          most = fmax (most, here[r]);
        }
      snprintf (setting, sizeof setting, "%u triangles, %s", (unsigned)j->triangles, ways[how]);
      snprintf (counters, sizeof counters,
                "cpu_of_one=%.3f;caller_of_one=%.3f;caller_least=%.3f;caller_most=%.3f",
                bench_median (share, rounds), bench_median (here, rounds), least, most);
      bench_put (t,
                 &(bench_row){ "trees", "mesh", setting, "meshes with other bits", got->strays[how],
                               "one thread", 0, bench_median (got->all[how], rounds), counters });
    }
}

void
scale_trees (bench_table *t, long most, int rounds)
{
  char folder[] = "/tmp/bight-trees-XXXXXX", command[64];
  jacket j;
  static times got;
  if (!mkdtemp (folder) || !jacket_new (&j, (uint32_t)most))
    return;
  for (long n = most < FINE ? most : FINE; n <= most; n *= 10)
    {
      got = (times){ .strays = { 0 } };
      jacket_make (&j, (uint32_t)n);
      take_times (&j, folder, rounds, &got);
      put_times (t, &j, rounds, &got);
    }
  jacket_free (&j);
  snprintf (command, sizeof command, "rm -rf %s", folder);
  if (system (command) != 0)
    fprintf (stderr, "%s is left behind\n", folder);
}
