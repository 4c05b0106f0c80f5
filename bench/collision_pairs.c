/* Pairs: a link of radius 1 cm and 0.5 to 1.5 m against shapes of 0.1 to 1 m, gap within a radius;
   the error is of the distance, against golden section over the link.  With libccd (HAVE_CCD) its
   MPR stands beside, timed only: what it calls depth is none.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef HAVE_CCD
#include <ccd/ccd.h>
#include <ccd/vec3.h>
#endif

#include "testbed/calibration.h"
#include "collision.h"

enum
{
  ROUNDS = 7
};

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
      bt_vec3 shift = bt__scale (dice_between (d, 0, 2 * BENCH_RADIUS) - w.distance, w.normal);
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
  ccd_of (bt__axpy (p, BENCH_RADIUS / bt__norm (d), d), out);
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
report_pair (bench *b, cases *c, solid_kind kind, const char *setting, bt__hull *hull)
{
  char counters[80];
  double worst = 0;
  draw_cases (c, &b->dice, kind, hull);
  double seconds = time_pair (c, kind);
  for (long i = 0; i < c->n && i < 4000; i++)
    worst = fmax (worst, fabs (fmax (c->w[i].distance, 0) - solid_brute (c->x + i, c->link + i)));
  snprintf (counters, sizeof counters, "cases=%ld", c->n);
  bench_say (b, "pair", solid_names[kind], setting, "worst distance [m]", worst, "golden section",
             1e-16, seconds, counters);
#ifdef HAVE_CCD
  long hits = 0;
  double other = time_mpr (c, &hits);
  snprintf (counters, sizeof counters, "cases=%ld;hits=%ld;ratio=%.2f", c->n, hits,
            other / seconds);
  bench_say (b, "pair", solid_names[kind], "libccd MPR", "not compared", NAN, NULL, 0, other,
             counters);
#endif
}

void
bench_pairs (bench *b, long n)
{
  cases c = { n, malloc ((size_t)n * sizeof *c.x), malloc ((size_t)n * sizeof *c.link),
              malloc ((size_t)n * sizeof *c.w) };
  bt__hull *small = draw_hull (&b->dice, 30), *large = draw_hull (&b->dice, 200);
  if (c.x && c.link && c.w && small && large)
    {
      for (int k = 0; k < SOLID_HULL; k++)
        report_pair (b, &c, (solid_kind)k, "closed", small);
      report_pair (b, &c, SOLID_HULL, "GJK 30 vertices", small);
      report_pair (b, &c, SOLID_HULL, "GJK 200 vertices", large);
    }
  free (c.x);
  free (c.link);
  free (c.w);
  bt__hull_free (small);
  bt__hull_free (large);
}
