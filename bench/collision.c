/* bight-bench-collision: time and error of the collision queries, as CSV rows on standard output.

   Pairs: a link of radius 1 cm and 0.5 to 1.5 m against shapes of 0.1 to 1 m, gap within a radius;
   the error is of the distance, against golden section over the link.  With libccd (HAVE_CCD) its
   MPR stands beside, timed only: what it calls depth is none.  Scenes: a jacket of tubulars 60 x 60
   x 100 m in 1e4 to 1e6 triangles, a tether of 100 links draped through it and one wound round a
   leg, every triangle within 6 cm of each link; fields of 1e2 to 1e5 capsules of one density; the
   safe step in both.  Times are CPU, medians of several rounds.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <getopt.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef HAVE_CCD
#include <ccd/ccd.h>
#include <ccd/vec3.h>
#endif

#include "../tests/oracle/solids.h"
#include "calibration.h"
#include "collide/safe.h"

enum
{
  ROUNDS = 7,
  LINKS = 100,
  FRAMES = 30,
  ROOM = 200000
};

static const double radius = 0.01, reach = 0.06;
static double calibration;

static void
row (const char *name, const char *model, const char *setting, const char *metric, double error,
     const char *reference, double uncertainty, double seconds, const char *counters)
{
  printf ("%s,%s,%s,%s,%.3g,%s,%.2g,%.1f,%.4g,%s\n", name, model, setting, metric, error, reference,
          uncertainty, 1e9 * seconds, seconds / calibration, counters);
  fflush (stdout);
}

/* ---- Pairs ---- */

typedef struct cases
{
  long n;
  solid *x;
  bt__link *link;
  bt__witness *w;
} cases;

/* Links of the size asked for, shifted along the normal to a gap within a radius.  */
static void
draw_cases (cases *c, dice *d, solid_kind kind, bt__hull *hull)
{
  for (long i = 0; i < c->n; i++)
    {
      solid x = solid_draw (d, kind, 1, &hull, 1);
      bt_vec3 a = dice_point (d, 1);
      bt__link link = { a, bt__axpy (a, dice_between (d, 0.5, 1.5), dice_direction (d)) };
      bt__witness w = solid_pair (&x, &link);
      bt_vec3 shift = bt__scale (dice_between (d, 0, 2 * radius) - w.distance, w.normal);
      c->x[i] = x;
      c->link[i] = (bt__link){ bt__add (link.a, shift), bt__add (link.b, shift) };
    }
}

#define TIME_PAIR(function, member)                                                                \
  for (long i = 0; i < c->n; i++)                                                                  \
  function (&c->x[i].member, c->link + i, c->w + i)

static void
run_pair (cases *c, solid_kind kind)
{
  switch (kind)
    {
    case SOLID_SPHERE:
      TIME_PAIR (bt__pair_sphere, sphere);
      break;
    case SOLID_CAPSULE:
      TIME_PAIR (bt__pair_capsule, capsule);
      break;
    case SOLID_BOX:
      TIME_PAIR (bt__pair_box, box);
      break;
    case SOLID_CYLINDER:
      TIME_PAIR (bt__pair_cylinder, cylinder);
      break;
    case SOLID_TRIANGLE:
      TIME_PAIR (bt__pair_triangle, triangle);
      break;
    default:
      for (long i = 0; i < c->n; i++)
        bt__pair_hull (c->x[i].hull, c->link + i, c->w + i);
    }
}

static double
time_pair (cases *c, solid_kind kind)
{
  double times[ROUNDS];
  for (int k = 0; k < ROUNDS; k++)
    {
      double start = bench_now ();
      run_pair (c, kind);
      times[k] = (bench_now () - start) / (double)c->n;
    }
  return bench_median (times, ROUNDS);
}

#ifdef HAVE_CCD
static void
ccd_of (bt_vec3 p, ccd_vec3_t *out)
{
  ccdVec3Set (out, p.x, p.y, p.z);
}

static bt_vec3
from_ccd (const ccd_vec3_t *v)
{
  return bt__vec (v->v[0], v->v[1], v->v[2]);
}

static void
ccd_solid_support (const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out)
{
  double r;
  int hint = 0;
  bt_vec3 d = from_ccd (direction);
  bt__convex core = solid_core (object, &r);
  bt_vec3 p = core.support (core.shape, d, &hint);
  ccd_of (r > 0 ? bt__axpy (p, r / bt__norm (d), d) : p, out);
}

static void
ccd_link_support (const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out)
{
  const bt__link *link = object;
  bt_vec3 d = from_ccd (direction);
  bt_vec3 p = bt__dot (bt__sub (link->b, link->a), d) > 0 ? link->b : link->a;
  ccd_of (bt__axpy (p, radius / bt__norm (d), d), out);
}

static void
ccd_solid_centre (const void *object, ccd_vec3_t *out)
{
  const solid *x = object;
  bt_vec3 c = x->sphere.centre;
  if (x->kind == SOLID_CAPSULE)
    c = bt__scale (0.5, bt__add (x->capsule.a, x->capsule.b));
  else if (x->kind == SOLID_TRIANGLE)
    c = bt__scale (1.0 / 3,
                   bt__add (x->triangle.v[0], bt__add (x->triangle.v[1], x->triangle.v[2])));
  else if (x->kind == SOLID_HULL)
    c = bt__vec (0, 0, 0);
  ccd_of (c, out);
}

static void
ccd_link_centre (const void *object, ccd_vec3_t *out)
{
  ccd_of (bt__along (object, 0.5), out);
}

static double
time_mpr (const cases *c, long *hits)
{
  double times[ROUNDS];
  ccd_t ccd;
  CCD_INIT (&ccd);
  ccd.support1 = ccd_link_support;
  ccd.support2 = ccd_solid_support;
  ccd.center1 = ccd_link_centre;
  ccd.center2 = ccd_solid_centre;
  ccd.max_iterations = 200;
  for (int k = 0; k < ROUNDS; k++)
    {
      double start = bench_now ();
      *hits = 0;
      for (long i = 0; i < c->n; i++)
        {
          ccd_real_t depth = 0;
          ccd_vec3_t dir, pos;
          *hits += ccdMPRPenetration (c->link + i, c->x + i, &ccd, &depth, &dir, &pos) == 0;
        }
      times[k] = (bench_now () - start) / (double)c->n;
    }
  return bench_median (times, ROUNDS);
}
#endif

static bt__hull *
draw_hull (dice *d, int n)
{
  bt_vec3 p[200];
  bt__hull *hull = NULL;
  for (int i = 0; i < n; i++)
    p[i] = bt__scale (0.5, dice_direction (d));
  return bt__hull_new (p, n, &hull, NULL) == BT_OK ? hull : NULL;
}

static void
report_pair (cases *c, dice *d, solid_kind kind, const char *setting, bt__hull *hull)
{
  char counters[80];
  double worst = 0;
  draw_cases (c, d, kind, hull);
  double seconds = time_pair (c, kind);
  for (long i = 0; i < c->n && i < 4000; i++)
    worst = fmax (worst, fabs (fmax (c->w[i].distance, 0) - solid_brute (c->x + i, c->link + i)));
  snprintf (counters, sizeof counters, "cases=%ld", c->n);
  row ("pair", solid_names[kind], setting, "worst distance [m]", worst, "golden section", 1e-16,
       seconds, counters);
#ifdef HAVE_CCD
  long hits = 0;
  double other = time_mpr (c, &hits);
  snprintf (counters, sizeof counters, "cases=%ld;hits=%ld;ratio=%.2f", c->n, hits,
            other / seconds);
  row ("pair", solid_names[kind], "libccd MPR", "not compared", NAN, "none", 0, other, counters);
#endif
}

static void
run_pairs (dice *d, long n)
{
  cases c = { n, malloc ((size_t)n * sizeof *c.x), malloc ((size_t)n * sizeof *c.link),
              malloc ((size_t)n * sizeof *c.w) };
  bt__hull *small = draw_hull (d, 30), *large = draw_hull (d, 200);
  if (c.x && c.link && c.w && small && large)
    {
      for (int k = 0; k < SOLID_HULL; k++)
        report_pair (&c, d, (solid_kind)k, "closed", small);
      report_pair (&c, d, SOLID_HULL, "GJK 30 vertices", small);
      report_pair (&c, d, SOLID_HULL, "GJK 200 vertices", large);
    }
  free (c.x);
  free (c.link);
  free (c.w);
  bt__hull_free (small);
  bt__hull_free (large);
}

/* ---- A jacket of tubulars ---- */

typedef struct soup
{
  bt_vec3 *v;
  uint32_t (*corner)[3];
  uint32_t vertices, triangles, room;
} soup;

/* A tube from A to B in facets of about SIZE.  */
static void
add_tube (soup *s, bt_vec3 a, bt_vec3 b, double r, double size)
{
  bt_vec3 axis = bt__sub (b, a), e = bt__across (axis);
  bt_vec3 f = bt__unit_or (bt__cross (axis, e), e);
  uint32_t around = (uint32_t)fmax (6, ceil (2 * BT__PI * r / size));
  uint32_t along = (uint32_t)fmax (1, ceil (bt__norm (axis) / size)), base = s->vertices;
  if (s->triangles + 2 * around * along > s->room)
    return;
  for (uint32_t j = 0; j <= along; j++)
    for (uint32_t i = 0; i < around; i++)
      {
        double w = 2 * BT__PI * i / around;
        bt_vec3 p = bt__axpy (a, (double)j / along, axis);
        s->v[s->vertices++] = bt__axpy (bt__axpy (p, r * cos (w), e), r * sin (w), f);
      }
  for (uint32_t j = 0; j < along; j++)
    for (uint32_t i = 0; i < around; i++)
      {
        uint32_t p = base + j * around + i, q = base + j * around + (i + 1) % around;
        uint32_t *t = s->corner[s->triangles++], *u = s->corner[s->triangles++];
        t[0] = p;
        t[1] = u[0] = q;
        t[2] = u[2] = p + around;
        u[1] = q + around;
      }
}

static void
add_jacket (soup *s, double size)
{
  static const double side[4][2] = { { -30, -30 }, { 30, -30 }, { 30, 30 }, { -30, 30 } };
  s->vertices = s->triangles = 0;
  for (int k = 0; k < 4; k++)
    {
      const double *p = side[k], *q = side[(k + 1) % 4];
      add_tube (s, bt__vec (p[0], p[1], -100), bt__vec (p[0], p[1], 0), 0.6, size);
      for (int level = 0; level < 5; level++)
        {
          double z = -100 + 20 * level, top = z + 20;
          add_tube (s, bt__vec (p[0], p[1], z), bt__vec (q[0], q[1], z), 0.3, size);
          add_tube (s, bt__vec (p[0], p[1], z), bt__vec (q[0], q[1], top), 0.2, size);
          add_tube (s, bt__vec (p[0], p[1], top), bt__vec (q[0], q[1], z), 0.2, size);
        }
    }
}

/* Facets as small as gives about WANTED triangles.  */
static void
make_jacket (soup *s, uint32_t wanted)
{
  double lo = 0.01, hi = 10;
  for (int i = 0; i < 40; i++)
    {
      double size = sqrt (lo * hi);
      add_jacket (s, size);
      /* Tubes that found no room make the count stop short of WANTED.  */
      if (s->triangles >= wanted)
        lo = size;
      else
        hi = size;
    }
  add_jacket (s, hi);
}

/* 100 links in a slack line along a face of the jacket, laid on its braces.  */
static void
drape (bt_vec3 x[LINKS + 1], double shift)
{
  for (int i = 0; i <= LINKS; i++)
    {
      double u = (double)i / LINKS;
      x[i] = bt__vec (-70 + 140 * u + shift, -30.25, -20 - 60 * u * u - 6 * sin (7 * u) + shift);
    }
}

/* Six turns round a leg, 2 cm off.  */
static void
wrap (bt_vec3 x[LINKS + 1], double shift)
{
  for (int i = 0; i <= LINKS; i++)
    {
      double u = (double)i / LINKS, w = 12 * BT__PI * u;
      x[i] = bt__vec (-30 + 0.632 * cos (w), -30 + 0.632 * sin (w), -53 + 6 * u + shift);
    }
}

typedef void (*layer) (bt_vec3 x[LINKS + 1], double shift);

static void
time_frames (const bt__scene *s, const char *name, const char *setting, layer lay)
{
  static bt__near room[ROOM];
  double times[FRAMES];
  bt__count count = { 0 };
  uint64_t pairs = 0;
  for (int k = 0; k < FRAMES; k++)
    {
      bt_vec3 x[LINKS + 1];
      bt__nears list = { room, 0, ROOM, INFINITY };
      lay (x, 0.004 * k);
      bt__scene_near_line (s, NULL, x, LINKS + 1, reach, &list, &count); /* warm */
      count = (bt__count){ 0 };
      double start = bench_now ();
      for (int i = 0; i < 20; i++)
        bt__scene_near_line (s, NULL, x, LINKS + 1, reach, &list, &count);
      times[k] = (bench_now () - start) / 20;
      pairs += list.n;
    }
  char counters[120];
  snprintf (counters, sizeof counters, "pairs=%lu;measured=%lu;nodes=%lu",
            (unsigned long)(pairs / FRAMES), (unsigned long)(count.pairs / 20),
            (unsigned long)(count.nodes / 20));
  row (name, "mesh", setting, "frame of 100 links", 0, "brute force", 0,
       bench_median (times, FRAMES), counters);
}

static void
time_safe (const bt__scene *s, const char *name, const char *setting, layer lay)
{
  bt__safe *safe = NULL;
  bt__safe_config config = { 0.0025, 2, 4 };
  bt__safe_report report;
  bt__count count = { 0 };
  double times[FRAMES];
  bt_vec3 x[LINKS + 1], want[LINKS + 1];
  dice d = dice_new (1);
  if (bt__safe_new (LINKS + 1, 64, &safe, NULL))
    return;
  lay (x, 0);
  for (int k = 0; k < FRAMES; k++)
    {
      for (int i = 0; i <= LINKS; i++)
        want[i] = bt__add (x[i], dice_point (&d, 0.02));
      double start = bench_now ();
      bt__safe_step (safe, &config, s, NULL, NULL, 0, x, want, LINKS + 1, &report, &count);
      times[k] = bench_now () - start;
    }
  char counters[120];
  snprintf (counters, sizeof counters, "casts=%lu;skipped=%lu;pairs=%lu",
            (unsigned long)(count.casts / FRAMES), (unsigned long)(count.skipped_clear / FRAMES),
            (unsigned long)(count.pairs / FRAMES));
  row (name, "safe step", setting, "2 cm at random", 0, "none", 0, bench_median (times, FRAMES),
       counters);
  bt__safe_free (safe);
}

static void
run_mesh (soup *s, uint32_t wanted)
{
  char setting[40], counters[80];
  bt__scene *scene = NULL;
  double times[3];
  make_jacket (s, wanted);
  snprintf (setting, sizeof setting, "%u triangles", (unsigned)s->triangles);
  bt__soup as_mesh = { s->vertices, s->triangles, s->v, (const uint32_t (*)[3])s->corner, NULL };
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH };
  for (int k = 0; k < 3; k++)
    {
      if (k)
        bt__mesh_free (o.shape.mesh);
      double start = bench_now ();
      if (bt__mesh_new (&as_mesh, NULL, &o.shape.mesh, NULL))
        return;
      times[k] = bench_now () - start;
    }
  snprintf (counters, sizeof counters, "nodes=%u", (unsigned)o.shape.mesh->tree.nodes);
  row ("build", "mesh", setting, "copy check tree", 0, "none", 0, bench_median (times, 3),
       counters);
  if (bt__scene_new (&o, 1, 1, &scene, NULL))
    return;
  time_frames (scene, "drape", setting, drape);
  time_frames (scene, "wrap", setting, wrap);
  time_safe (scene, "drape", setting, drape);
  time_safe (scene, "wrap", setting, wrap);
  bt__scene_free (scene);
}

static void
run_meshes (uint32_t most)
{
  soup s = { .room = most + most / 2 };
  s.v = malloc ((size_t)s.room * sizeof *s.v);
  s.corner = malloc ((size_t)s.room * sizeof *s.corner);
  for (uint32_t n = 10000; s.v && s.corner && n <= most; n *= 10)
    run_mesh (&s, n);
  free (s.v);
  free (s.corner);
}

/* ---- Fields of capsules ---- */

static void
run_field (dice *d, uint32_t n)
{
  bt__obstacle *o = calloc (n, sizeof *o);
  double half = 5 * cbrt (n / 100.0), times[FRAMES];
  bt__scene *scene = NULL;
  if (!o)
    return;
  for (uint32_t i = 0; i < n; i++)
    {
      bt_vec3 a = dice_point (d, half);
      o[i] = (bt__obstacle){ .kind = BT__OBSTACLE_CAPSULE, .id = i };
      o[i].shape.capsule = (bt__capsule){ a, bt__add (a, dice_direction (d)), 0.05 };
    }
  double start = bench_now ();
  bt_status status = bt__scene_new (o, n, 1, &scene, NULL);
  char setting[40];
  snprintf (setting, sizeof setting, "%u capsules", (unsigned)n);
  row ("build", "scene", setting, "check and tree", 0, "none", 0, bench_now () - start, "");
  free (o);
  if (status)
    return;
  static bt__near room[ROOM];
  bt__count count = { 0 };
  for (int k = 0; k < FRAMES; k++)
    {
      bt_vec3 x[LINKS + 1], a = dice_point (d, 0.5 * half), along = dice_direction (d);
      bt__nears list = { room, 0, ROOM, INFINITY };
      for (int i = 0; i <= LINKS; i++)
        x[i] = bt__axpy (a, 0.1 * i, along);
      start = bench_now ();
      for (int i = 0; i < 20; i++)
        bt__scene_near_line (scene, NULL, x, LINKS + 1, reach, &list, &count);
      times[k] = (bench_now () - start) / 20;
    }
  row ("field", "scene", setting, "frame of 100 links", 0, "brute force", 0,
       bench_median (times, FRAMES), "");
  bt__scene_free (scene);
}

static const char usage[]
    = "usage: bight-bench-collision [--cases N] [--triangles N] [--seed N] [--help]\n"
      "Print time and error of the collision queries as CSV rows.\n"
      "  --cases N      pairs of each kind; 20000\n"
      "  --triangles N  the largest mesh; 1000000\n"
      "  --seed N       of the random numbers; 1\n"
      "  --help         this text\n";

static int
run (long n, long triangles, unsigned long seed)
{
  dice d = dice_new (seed);
  calibration = bench_calibrate (0.3);
  puts ("case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns,calibration_ratio,"
        "counters");
  run_pairs (&d, n);
  run_meshes ((uint32_t)triangles);
  for (uint32_t k = 100; k <= 100000; k *= 10)
    run_field (&d, k);
  return EXIT_SUCCESS;
}

int
main (int argc, char **argv)
{
  static const struct option options[] = { { "cases", required_argument, NULL, 'c' },
                                           { "triangles", required_argument, NULL, 't' },
                                           { "seed", required_argument, NULL, 's' },
                                           { "help", no_argument, NULL, 'h' },
                                           { NULL, 0, NULL, 0 } };
  long cases = 20000, triangles = 1000000;
  unsigned long seed = 1;
  int c;
  while ((c = getopt_long (argc, argv, "", options, NULL)) != -1)
    switch (c)
      {
      case 'c':
        cases = strtol (optarg, NULL, 10);
        break;
      case 't':
        triangles = strtol (optarg, NULL, 10);
        break;
      case 's':
        seed = strtoul (optarg, NULL, 10);
        break;
      case 'h':
        fputs (usage, stdout);
        return EXIT_SUCCESS;
      default:
        fputs (usage, stderr);
        return EXIT_FAILURE;
      }
  if (cases < 1 || cases > 10000000 || triangles < 10000 || triangles > 100000000)
    {
      fputs ("bight-bench-collision: --cases takes 1 to 10000000, --triangles 10000 to 100000000\n",
             stderr);
      return EXIT_FAILURE;
    }
  return run (cases, triangles, seed);
}
