/* Distance of a link to every shape: against golden section over the points of the link, against
   GJK on the cores, against closed cases; the depth against supports in many directions.

   2e5 random pairs of each shape, 1e7 with BIGHT_LONG=1 in the environment.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/solids.h"

enum
{
  POOL = 12
};

static long
many (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 10000000 : 200000;
}

static void
make_pool (dice *d, double scale, bt__hull *pool[POOL])
{
  static const int sizes[] = { 4, 5, 8, 12, 20, 30, 60, 200 };
  bt_vec3 points[200];
  for (int k = 0; k < POOL; k++)
    {
      int n = sizes[k % 8];
      for (int i = 0; i < n; i++)
        points[i] = k < 8 ? bt__scale (scale, dice_direction (d)) : dice_point (d, scale);
      bt_error error;
      if (bt__hull_new (points, n, pool + k, &error))
        fail_msg ("%s", error.text);
    }
}

static void
free_pool (bt__hull *pool[POOL])
{
  for (int k = 0; k < POOL; k++)
    bt__hull_free (pool[k]);
}

/* Links in general, parallel to things, touching, without length, much longer and shorter.  */
static bt__link
draw_link (dice *d, const solid *x, double scale)
{
  bt__link link = { dice_point (d, 1.2 * scale), dice_point (d, 1.2 * scale) };
  bt_vec3 axes[] = { x->box.frame.x, x->box.frame.y, x->box.frame.z };
  bt_vec3 along = x->kind == SOLID_TRIANGLE ? bt__sub (x->triangle.v[1], x->triangle.v[0])
                                            : axes[dice_below (d, 3)];
  switch (dice_below (d, 12))
    {
    case 0:
      link.b = link.a;
      break;
    case 1:
      link.b = bt__axpy (link.a, scale * dice_between (d, -1, 1), along);
      break;
    case 2: /* nearly parallel */
      link.b = bt__axpy (link.a, scale * dice_between (d, -1, 1), along);
      link.b = bt__axpy (link.b, scale * pow (10, dice_between (d, -14, -1)), dice_direction (d));
      break;
    case 3: /* an end on the shape */
      link.a = solid_pair (x, &link).point;
      break;
    case 4: /* a hair above it */
      {
        bt__witness w = solid_pair (x, &link);
        link.a = bt__axpy (w.point, scale * pow (10, dice_between (d, -14, -3)), w.normal);
        break;
      }
    case 5:
      link.b = bt__axpy (link.a, scale * pow (10, dice_between (d, -12, 3)), dice_direction (d));
      break;
    case 6: /* in the plane of a triangle, along a side */
      link.a = bt__axpy (x->triangle.v[0], dice_between (d, -1, 2), along);
      link.b = bt__axpy (x->triangle.v[2], dice_between (d, -1, 2), along);
      break;
    default:
      break;
    }
  return link;
}

/* ---- What must hold of every answer ---- */

typedef struct worst
{
  double brute, gjk, point, normal, gap, depth;
} worst;

static double
shrink (const bt__link *link, double scale)
{
  return scale + bt__largest (link->a) + bt__largest (link->b);
}

static void
check_witness (const solid *x, const bt__link *link, const bt__witness *w, double size, worst *e)
{
  bt_vec3 on = bt__along (link, w->s), gap = bt__sub (on, w->point);
  e->point = fmax (e->point, solid_point (x, w->point) / size);
  e->normal = fmax (e->normal, fabs (bt__norm (w->normal) - 1));
  e->gap = fmax (e->gap, bt__norm (bt__axpy (gap, -w->distance, w->normal)) / size);
}

/* No direction leads out sooner, and the normal leads out.  */
static void
check_depth (dice *d, const solid *x, const bt__link *link, const bt__witness *w, double size,
             worst *e)
{
  bt_vec3 n = w->normal;
  double depth = -w->distance;
  double at = solid_support (x, n) - fmin (bt__dot (n, link->a), bt__dot (n, link->b));
  e->depth = fmax (e->depth, fabs (at - depth) / size);
  for (int i = 0; i < 12; i++)
    {
      double spread = pow (10, -dice_below (d, 6));
      bt_vec3 m = bt__unit_or (bt__axpy (n, spread, dice_direction (d)), n);
      double there = solid_support (x, m) - fmin (bt__dot (m, link->a), bt__dot (m, link->b));
      e->depth = fmax (e->depth, (depth - there) / size);
    }
}

static void
check_pair (dice *d, const solid *x, const bt__link *link, double scale, int gjk, worst *e)
{
  bt__witness w = solid_pair (x, link);
  double size = shrink (link, scale), brute = solid_brute (x, link);
  if (!isfinite (w.distance) || !(w.s >= 0 && w.s <= 1) || !bt__is_finite (w.point))
    fail_msg ("%s: no answer", solid_names[x->kind]);
  e->brute = fmax (e->brute, fabs (fmax (w.distance, 0) - brute) / size);
  check_witness (x, link, &w, size, e);
  if (w.distance <= 0 && x->kind != SOLID_TRIANGLE)
    check_depth (d, x, link, &w, size, e);
  if (gjk)
    {
      bt__gap gap;
      double radius;
      bt__convex a = solid_link_core (link), b = solid_core (x, &radius);
      bt__gjk (&a, &b, &gap);
      e->gjk = fmax (e->gjk, fabs (fmax (gap.distance - radius, 0) - fmax (w.distance, 0)) / size);
    }
}

static void
check_kind (solid_kind kind)
{
  static const double scales[] = { 1e-3, 1, 1e3 };
  worst e = { 0 };
  dice d = dice_new (7 + kind);
  for (int k = 0; k < 3; k++)
    {
      bt__hull *pool[POOL];
      make_pool (&d, scales[k], pool);
      long n = many () / 3;
      if (kind == SOLID_HULL)
        n /= 10; /* the brute search over its faces is slow */
      for (long i = 0; i < n; i++)
        {
          solid x = solid_draw (&d, kind, scales[k], pool, POOL);
          bt__link link = draw_link (&d, &x, scales[k]);
          check_pair (&d, &x, &link, scales[k], i % 4 == 0, &e);
        }
      free_pool (pool);
    }
  /* GJK converges slowly on a curved core and may stall on a flat simplex.  The way out of a box
     for a link nearly along a side is by side or edge, which then tie, and
     a link that touches a sliver is where the sliver is but for its angle: the point shows it.  */
  double gjk = 1e-7;
  if (!(e.brute <= 1e-12 && e.point <= 1e-10 && e.normal <= 1e-12 && e.gap <= 1e-12
        && e.depth <= 1e-12 && e.gjk <= gjk))
    fail_msg ("%s: brute %.2g, GJK %.2g, point %.2g, normal %.2g, gap %.2g, depth %.2g",
              solid_names[kind], e.brute, e.gjk, e.point, e.normal, e.gap, e.depth);
}

static void
spheres (void **state)
{
  (void)state;
  check_kind (SOLID_SPHERE);
}

static void
capsules (void **state)
{
  (void)state;
  check_kind (SOLID_CAPSULE);
}

static void
boxes (void **state)
{
  (void)state;
  check_kind (SOLID_BOX);
}

static void
cylinders (void **state)
{
  (void)state;
  check_kind (SOLID_CYLINDER);
}

static void
triangles (void **state)
{
  (void)state;
  check_kind (SOLID_TRIANGLE);
}

static void
hulls (void **state)
{
  (void)state;
  check_kind (SOLID_HULL);
}

/* ---- Closed cases ---- */

typedef struct exact
{
  bt__link link;
  double distance, s;
  bt_vec3 normal;
  int feature;
} exact;

static void
agree (const char *what, const bt__witness *w, const exact *x)
{
  if (!(fabs (w->distance - x->distance) <= 1e-14 && fabs (w->s - x->s) <= 1e-14
        && bt__distance (w->normal, x->normal) <= 1e-14 && w->feature == x->feature))
    fail_msg ("%s: distance %.17g at %.17g, normal (%g, %g, %g), feature %d", what, w->distance,
              w->s, w->normal.x, w->normal.y, w->normal.z, w->feature);
}

static void
box_by_hand (void **state)
{
  static const exact cases[] = {
    { { { 3, 0, 0 }, { 5, 0, 0 } }, 2, 0, { 1, 0, 0 }, 14 },
    { { { 4, 6, -1 }, { 4, 6, 1 } }, 5, 0.5, { 0.6, 0.8, 0 }, 17 },
    { { { 0.75, 0, -1 }, { 0.75, 0, 1 } }, -0.25, 0.5, { 1, 0, 0 }, 14 },
    { { { 0, 0, 0.9 }, { 0, 0, 9 } }, -1, 0, { 1, 0, 0 }, 14 },
  };
  bt__box box = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 1, 2, 3 } };
  (void)state;
  for (int i = 0; i < 3; i++)
    {
      bt__witness w;
      bt__pair_box (&box, &cases[i].link, &w);
      w.s = i == 1 || i == 2 ? 0.5 : w.s; /* a line contact: any */
      agree ("box", &w, cases + i);
    }
}

static void
cylinder_by_hand (void **state)
{
  static const exact cases[] = {
    { { { 3, -1, 0 }, { 3, 1, 0 } }, 2, 0.5, { 1, 0, 0 }, BT__SIDE },
    { { { 0.5, 0, 5 }, { 0.5, 0, 7 } }, 3, 0, { 0, 0, 1 }, BT__CAP_HIGH },
    { { { 4, -1, 6 }, { 4, 1, 6 } }, 5, 0.5, { 0.6, 0, 0.8 }, BT__RIM_HIGH },
    { { { 0.75, -3, 0 }, { 0.75, 3, 0 } }, -0.25, 0.5, { 1, 0, 0 }, BT__SIDE },
    { { { 0.1, 0, -1.9 }, { 0.1, 0, 3 } }, -0.9, 0.5, { 1, 0, 0 }, BT__SIDE },
    { { { 0.1, 0, -5 }, { 0.2, 0, -1.9 } }, -0.1, 1, { 0, 0, -1 }, BT__CAP_LOW },
  };
  bt__cylinder cylinder = { { 0, 0, 0 }, { 0, 0, 1 }, 2, 1 };
  (void)state;
  for (int i = 0; i < 6; i++)
    {
      bt__witness w;
      bt__pair_cylinder (&cylinder, &cases[i].link, &w);
      if (i == 4)
        w.s = 0.5;
      agree ("cylinder", &w, cases + i);
    }
}

static void
triangle_by_hand (void **state)
{
  static const exact cases[] = {
    { { { 0.2, 0.2, 3 }, { 0.2, 0.2, 1 } }, 1, 1, { 0, 0, 1 }, 0 },
    { { { 0.2, 0.2, 3 }, { 0.2, 0.2, -1 } }, 0, 0.75, { 0, 0, 1 }, 0 },
    { { { 0.5, -2, -1 }, { 0.5, -2, 3 } }, 2, 0.25, { 0, -1, 0 }, 1 },
    { { { 0.2, 0.2, 0 }, { 0.3, 0.2, 0 } }, 0, 0, { 0, 0, 1 }, 0 },
    { { { 4, 0, 4 }, { 4, 0, 4 } }, 5, 0, { 0.6, 0, 0.8 }, 5 },
  };
  bt__triangle triangle = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } } };
  (void)state;
  for (int i = 0; i < 5; i++)
    {
      bt__witness w;
      bt__pair_triangle (&triangle, &cases[i].link, &w);
      agree ("triangle", &w, cases + i);
    }
}

static void
planes_and_points (void **state)
{
  bt__plane plane = { { 0, 0, 1 }, -10 };
  bt__link link = { { 1, 2, -8 }, { 3, 4, -11 } };
  bt__witness w;
  (void)state;
  bt__pair_plane (&plane, &link, &w);
  agree ("plane", &w, &(exact){ link, -1, 1, { 0, 0, 1 }, 0 });
  bt__pair_point (bt__vec (1, 2, -12), &(bt__link){ { 1, 2, -8 }, { 1, 2, -8 } }, &w);
  agree ("point", &w, &(exact){ link, 4, 0, { 0, 0, 1 }, 0 });
}

static void
refuses_flat_hulls (void **state)
{
  bt_vec3 flat[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 0.5, 0.2, 0 } };
  bt__hull *hull = NULL;
  bt_error error;
  (void)state;
  assert_int_equal (bt__hull_new (flat, 5, &hull, &error), BT_ERR_DOMAIN);
  assert_int_equal (bt__hull_new (flat, 3, &hull, &error), BT_ERR_DOMAIN);
  flat[2].x = NAN;
  assert_int_equal (bt__hull_new (flat, 5, &hull, &error), BT_ERR_DOMAIN);
  assert_null (hull);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (spheres),
                                      cmocka_unit_test (capsules),
                                      cmocka_unit_test (boxes),
                                      cmocka_unit_test (cylinders),
                                      cmocka_unit_test (triangles),
                                      cmocka_unit_test (hulls),
                                      cmocka_unit_test (box_by_hand),
                                      cmocka_unit_test (cylinder_by_hand),
                                      cmocka_unit_test (triangle_by_hand),
                                      cmocka_unit_test (planes_and_points),
                                      cmocka_unit_test (refuses_flat_hulls) };
  return cmocka_run_group_tests_name ("collide_pair", tests, NULL, NULL);
}
