/* A body's way: along it, looked at in many places, the body is nowhere nearer than the gap, and it
   is not held for nothing.

   The judge measures a box against an obstacle by golden section: each edge of the box against the
   obstacle, each corner, edge or axis of the obstacle against the box.  The mutant, which looks at
   the ends of the way only, shows that it can say no.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/solids.h"
#include "collide/sweep.h"

enum
{
  OBSTACLES = 60,
  LOOKS = 24
};

static const double gap = 0.02;
static const bt__box hull
    = { { { 0.1, 0, 0.05 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0.5, 0.3, 0.25 } };

/* ---- The judge ---- */

static bt_vec3
corner_of (const bt__box *b, int i)
{
  bt_vec3 p = { i & 1 ? b->half.x : -b->half.x, i & 2 ? b->half.y : -b->half.y,
                i & 4 ? b->half.z : -b->half.z };
  return bt__to_world (&b->frame, p);
}

/* The least distance of the edges of B from X.  */
static double
edges (const bt__box *b, const solid *x)
{
  double best = INFINITY;
  for (int i = 0; i < 8; i++)
    for (int k = 1; k < 8; k *= 2)
      {
        bt__link edge = { corner_of (b, i), corner_of (b, i | k) };
        if (!(i & k))
          best = fmin (best, solid_brute (x, &edge));
      }
  return best;
}

/* The distance of the box B from X, which is no cylinder.  */
static double
judge (const bt__box *b, const solid *x)
{
  solid box = { .kind = SOLID_BOX, .box = *b };
  double best = edges (b, x);
  bt__link axis = { x->capsule.a, x->capsule.b };
  switch (x->kind)
    {
    case SOLID_SPHERE:
      return fmin (best, fmax (solid_point (&box, x->sphere.centre) - x->sphere.radius, 0));
    case SOLID_CAPSULE:
      return fmin (best, fmax (solid_brute (&box, &axis) - x->capsule.radius, 0));
    case SOLID_BOX:
      return fmin (best, edges (&x->box, &box));
    default:
      for (int k = 0; k < 3; k++)
        {
          bt__link edge = { x->triangle.v[k], x->triangle.v[(k + 1) % 3] };
          best = fmin (best, solid_brute (&box, &edge));
        }
      return best;
    }
}

static bt__box
placed (const bt__frame *f)
{
  bt__box b = hull;
  b.frame.origin = bt__to_world (f, hull.frame.origin);
  b.frame.x = bt__out_of (f, hull.frame.x);
  b.frame.y = bt__out_of (f, hull.frame.y);
  b.frame.z = bt__out_of (f, hull.frame.z);
  return b;
}

/* ---- A scene the judge knows ---- */

typedef struct place
{
  solid x[OBSTACLES];
  int n;
  bt__scene *scene;
} place;

static void
move_solid (solid *x, bt_vec3 by)
{
  x->sphere.centre = bt__add (x->sphere.centre, by);
  x->box.frame.origin = bt__add (x->box.frame.origin, by);
  x->capsule.a = bt__add (x->capsule.a, by);
  x->capsule.b = bt__add (x->capsule.b, by);
  for (int k = 0; k < 3; k++)
    x->triangle.v[k] = bt__add (x->triangle.v[k], by);
}

static bt__obstacle
obstacle_of (const solid *x)
{
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH };
  uint32_t corner[1][3] = { { 0, 1, 2 } };
  bt__soup soup = { 3, 1, x->triangle.v, (const uint32_t (*)[3])corner, NULL, 0 };
  if (x->kind != SOLID_TRIANGLE)
    return obstacle_of_solid (x);
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &o.shape.mesh, NULL), BT_OK);
  return o;
}

static place *
draw_place (dice *d, double half, int thin)
{
  static const solid_kind kinds[] = { SOLID_SPHERE, SOLID_CAPSULE, SOLID_BOX, SOLID_TRIANGLE };
  bt__obstacle o[OBSTACLES];
  place *p = calloc (1, sizeof *p);
  assert_non_null (p);
  while (p->n < OBSTACLES)
    {
      solid x
          = solid_draw (d, thin ? SOLID_CAPSULE : kinds[dice_below (d, 4)], thin ? 4 : 1, NULL, 0);
      bt_vec3 at = dice_point (d, half);
      if (thin)
        x.capsule.radius = 1e-3;
      if (bt__norm (at) < 2.5) /* the start is clear */
        continue;
      move_solid (&x, at);
      bt__box start = placed (&(bt__frame){ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
      if (judge (&start, &x) < 2 * gap)
        continue;
      o[p->n] = obstacle_of (&x);
      p->x[p->n++] = x;
    }
  assert_int_equal (bt__scene_new (o, OBSTACLES, 1, &p->scene, NULL), BT_OK);
  return p;
}

static void
drop_place (place *p)
{
  bt__scene_free (p->scene);
  free (p);
}

static double
clearance (const place *p, const bt__frame *f)
{
  double best = INFINITY;
  bt__box b = placed (f);
  for (int i = 0; i < p->n; i++)
    if (solid_point (p->x + i, b.frame.origin) - bt__norm (b.half) < best)
      best = fmin (best, judge (&b, p->x + i));
  return best;
}

/* The least clearance on the share T of M.  */
static double
least_on (const place *p, const bt__motion *m, double t)
{
  double least = INFINITY;
  for (int k = 0; k <= LOOKS; k++)
    {
      bt__frame f = bt__motion_at (m, t * k / LOOKS);
      least = fmin (least, clearance (p, &f));
    }
  return least;
}

static bt__motion
draw_motion (dice *d, const bt__frame *from, double far)
{
  bt__motion m = { .from = *from, .axis = dice_direction (d) };
  m.travel = bt__axpy (dice_point (d, far), -0.3, from->origin);
  m.angle = dice_below (d, 3) ? dice_between (d, 0, 1.5) : 0;
  return m;
}

/* ---- Random flights ---- */

static void
fly (place *p, dice *d, int n, double far)
{
  bt__body body = bt__body_box (&hull, 0);
  bt__frame at = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  bt__count count = { 0 };
  long held = 0, loose = 0;
  double least = INFINITY;
  for (int i = 0; i < n; i++)
    {
      bt__motion m = draw_motion (d, &at, i % 2 ? far : 0.2 * far);
      bt__stop stop;
      double t = bt__body_sweep (&body, &m, gap, p->scene, NULL, NULL, 0, &stop, &count);
      double on = least_on (p, &m, t);
      if (!(on >= gap * (1 - 1e-9)))
        fail_msg ("flight %d came to %.17g m", i, on);
      least = fmin (least, on);
      at = bt__motion_at (&m, t);
      if (t < 1)
        {
          bt__box b = placed (&at);
          double there = judge (&b, p->x + stop.object);
          held++;
          loose += there > 1.05 * gap;
          assert_true (fabs (stop.distance - there) < 1e-9);
          assert_true (fabs (bt__norm (stop.normal) - 1) < 1e-12);
          assert_true (solid_point (p->x + stop.object, stop.point) < 1e-9);
          solid box = { .kind = SOLID_BOX, .box = b };
          assert_true (fabs (solid_point (&box, stop.point) - there) < 1e-9);
        }
      at = squared_frame (at);
    }
  print_message ("# held %ld of %d, %ld of them loosely; least %.9g m, %.1f steps a chase\n", held,
                 n, loose, least, (double)count.cast_steps / (double)count.casts);
  assert_true (held > n / 20);
  assert_true (loose <= held / 10);
}

static void
flights_among_solids (void **state)
{
  dice d = dice_new (1);
  (void)state;
  place *p = draw_place (&d, 7, 0);
  fly (p, &d, 250, 4);
  drop_place (p);
}

static void
flights_among_wires (void **state)
{
  dice d = dice_new (2);
  (void)state;
  place *p = draw_place (&d, 6, 1);
  fly (p, &d, 150, 6);
  drop_place (p);
}

/* A mover of bodies that looks only at where a way ends.  */
static void
judge_fires (void **state)
{
  dice d = dice_new (3);
  bt__body body = bt__body_box (&hull, 0);
  bt__frame at = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  bt__count count = { 0 };
  int fired = 0;
  (void)state;
  place *p = draw_place (&d, 6, 1);
  for (int i = 0; i < 60; i++)
    {
      bt__motion m = draw_motion (&d, &at, 6);
      bt__frame end = bt__motion_at (&m, 1);
      bt__stop stop;
      if (bt__body_nearest (&body, &end, gap, p->scene, NULL, NULL, 0, &stop, &count))
        continue;
      fired += least_on (p, &m, 1) < gap;
      at = squared_frame (end);
    }
  print_message ("# the mutant met %d\n", fired);
  assert_true (fired > 0);
  drop_place (p);
}

/* ---- Touching ---- */

static const bt__frame north = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };

static double
one_way (const bt__frame *from, bt_vec3 travel, bt_vec3 axis, double angle, const bt__scene *s,
         bt__stop *stop)
{
  bt__body body = bt__body_box (&hull, 0);
  bt__motion m = { *from, travel, axis, angle };
  bt__count count = { 0 };
  return bt__body_sweep (&body, &m, gap, s, NULL, NULL, 0, stop, &count);
}

/* Down on to the ground: held at the gap; from there along it, up from it and turning about the
   vertical are free, down and tipping are not.  */
static void
ground_holds_and_lets_slide (void **state)
{
  bt__obstacle plane = { .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, -3 } };
  bt__box slab = { { { 0, 0, -4 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 50, 50, 1 } };
  bt__obstacle box = { .kind = BT__OBSTACLE_BOX, .shape.box = slab };
  (void)state;
  for (int i = 0; i < 2; i++)
    {
      bt__scene *s = NULL;
      bt__stop stop;
      assert_int_equal (bt__scene_new (i ? &plane : &box, 1, 1, &s, NULL), BT_OK);
      double t = one_way (&north, bt__vec (1, 0, -10), bt__vec (0, 0, 1), 0, s, &stop);
      assert_true (fabs (10 * t - (3 - 0.2 - gap)) < 0.01 * gap); /* the hull reaches 0.2 down */
      assert_true (fabs (stop.distance - gap) < 0.01 * gap);
      assert_true (bt__distance (stop.normal, bt__vec (0, 0, 1)) < 1e-9);
      assert_true (fabs (stop.point.z + 3) < 1e-9);
      bt__frame at = north;
      at.origin = bt__vec (t, 0, -10 * t);
      bt_vec3 up = { 0, 0, 1 }, side = { 0, 1, 0 }, no = { 0, 0, 0 };
      assert_true (one_way (&at, bt__vec (3, -4, 0), up, 0, s, NULL) == 1);
      assert_true (one_way (&at, bt__vec (0, 0, 0.1), up, 0, s, NULL) == 1);
      assert_true (one_way (&at, no, up, 1.5, s, NULL) == 1);
      assert_true (one_way (&at, bt__vec (1, 0, 2), side, 0.5, s, NULL) == 1);
      assert_true (one_way (&at, bt__vec (0, 0, -1), up, 0, s, NULL) < 1e-3);
      assert_true (one_way (&at, no, side, 0.5, s, NULL) < 0.02);
      bt__scene_free (s);
    }
}

/* Too near at the start: not nearer, but away; right inside: nowhere.  */
static void
too_near_may_leave (void **state)
{
  bt__obstacle o = { .kind = BT__OBSTACLE_SPHERE, .shape.sphere = { { 2, 0, 0.05 }, 1.39 } };
  bt__scene *s = NULL, *empty = NULL;
  bt__stop stop;
  (void)state;
  assert_int_equal (bt__scene_new (NULL, 0, 0, &empty, NULL), BT_OK);
  assert_int_equal (bt__scene_new (&o, 1, 1, &s, NULL), BT_OK); /* 1 cm off the hull's front */
  bt_vec3 up = { 0, 0, 1 };
  assert_true (one_way (&north, bt__vec (-1, 0, 0), up, 0, s, &stop) == 1);
  assert_true (one_way (&north, bt__vec (-1, 0, 0), up, 0.2, s, &stop) == 1);
  assert_true (one_way (&north, bt__vec (1, 0, 0), up, 0, s, &stop) < 1e-9);
  assert_true (fabs (stop.distance - 0.01) < 1e-9);
  bt__frame in = north;
  in.origin.x = 2;
  assert_true (one_way (&in, bt__vec (-1, 0, 0), up, 0, s, &stop) == 0);
  assert_true (one_way (&north, bt__vec (NAN, 0, 0), up, 0, s, &stop) == 0);
  assert_true (one_way (&north, bt__vec (5, 0, 0), up, 0, empty, &stop) == 1);
  bt__scene_free (empty);
  bt__scene_free (s);
}

/* ---- Movers ---- */

/* A turning bar and a body, both on their way, told apart in the bar's frame.  */
static void
movers_and_body_wait_for_each_other (void **state)
{
  dice d = dice_new (12);
  solid x = { .kind = SOLID_CAPSULE, .capsule = { { -3, 0, 0 }, { 3, 0, 0 }, 0.05 } };
  bt__obstacle o = { .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = x.capsule };
  bt__scene *bar = NULL, *none = NULL;
  bt__body body = bt__body_box (&hull, 0);
  bt__count count = { 0 };
  bt__frame at = north, own = north;
  int held = 0, pinched = 0;
  (void)state;
  assert_int_equal (bt__scene_new (&o, 1, 1, &bar, NULL), BT_OK);
  assert_int_equal (bt__scene_new (NULL, 0, 0, &none, NULL), BT_OK);
  own.origin = bt__vec (0, 4, 0);
  for (int i = 0; i < 400; i++)
    {
      bt__motion m = draw_motion (&d, &at, 1), n = draw_motion (&d, &own, 1);
      m.travel = bt__scale (i % 3 > 0, m.travel);
      bt__mover mover = { bar, NULL, n, 3.06, 1 };
      bt__stop stop;
      double t = bt__body_sweep (&body, &m, gap, none, NULL, &mover, 1, &stop, &count);
      held += t < 1;
      pinched += mover.done < 1;
      assert_true ((t < 1) == (mover.done < 1));
      for (int k = 0; k <= LOOKS; k++)
        {
          double u = (double)k / LOOKS;
          bt__frame f = bt__motion_at (&m, t * u), g = bt__motion_at (&n, mover.done * u);
          bt__frame seen = { bt__to_local (&g, f.origin), bt__into (&g, f.x), bt__into (&g, f.y),
                             bt__into (&g, f.z) };
          bt__box b = placed (&seen);
          double apart = judge (&b, &x);
          if (!(apart >= gap * (1 - 1e-9)))
            fail_msg ("way %d: %.17g m apart", i, apart);
        }
      at = squared_frame (bt__motion_at (&m, t));
      own = squared_frame (bt__motion_at (&n, mover.done));
      bt__mover there = { bar, NULL, { .from = own, .axis = { 0, 0, 1 } }, 3.06, 1 };
      if (t < 1)
        assert_true (bt__body_nearest (&body, &at, 1, none, NULL, &there, 1, &stop, &count)
                     && stop.mover == 0 && stop.distance < 0.5);
    }
  print_message ("# held %d of 400\n", held);
  assert_true (held > 20 && pinched > 20);
  bt__scene_free (none);
  bt__scene_free (bar);
}

/* ---- Other bodies ---- */

/* The same hull as a box and as eight points; a ball; all tell the same story.  */
static void
bodies_agree (void **state)
{
  dice d = dice_new (21);
  bt_vec3 corner[8];
  bt__hull *points = NULL;
  bt__count count = { 0 };
  (void)state;
  for (int i = 0; i < 8; i++)
    corner[i] = corner_of (&hull, i);
  assert_int_equal (bt__hull_new (corner, 8, &points, NULL), BT_OK);
  place *p = draw_place (&d, 5, 0);
  bt__body box = bt__body_box (&hull, 0.01),
           convex = { { bt__hull_support, points }, 0.01, box.radius };
  bt__body ball = bt__body_ball (0.4);
  bt__capsule grain = { { 0, 0, 0 }, { 0, 0, 1e-9 }, 0.4 };
  bt__body capsule = { { bt__capsule_support, &grain }, grain.radius, ball.radius + 1e-9 };
  for (int i = 0; i < 300; i++)
    {
      bt__motion m = draw_motion (&d, &north, 8);
      bt__stop a, b;
      double s = bt__body_sweep (&box, &m, gap, p->scene, NULL, NULL, 0, &a, &count);
      double t = bt__body_sweep (&convex, &m, gap, p->scene, NULL, NULL, 0, &b, &count);
      assert_true (fabs (s - t) < 1e-3);
      s = bt__body_sweep (&ball, &m, gap, p->scene, NULL, NULL, 0, &a, &count);
      t = bt__body_sweep (&capsule, &m, gap, p->scene, NULL, NULL, 0, &b, &count);
      assert_true (fabs (s - t) < 1e-3);
      if (s < 1)
        assert_true (a.distance >= gap && a.distance < 1.05 * gap);
    }
  drop_place (p);
  bt__hull_free (points);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (judge_fires),         cmocka_unit_test (flights_among_solids),
    cmocka_unit_test (flights_among_wires), cmocka_unit_test (ground_holds_and_lets_slide),
    cmocka_unit_test (too_near_may_leave),  cmocka_unit_test (movers_and_body_wait_for_each_other),
    cmocka_unit_test (bodies_agree)
  };
  return cmocka_run_group_tests_name ("collide_sweep", tests, NULL, NULL);
}
