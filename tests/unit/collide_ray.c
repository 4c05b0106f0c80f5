/* Rays against distance: a point that goes along the ray by its distance to the obstacle, told by
   the oracle, arrives where the ray does.  Trees against brute force, movers against obstacles
   where they stand, no leak between triangles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/solids.h"
#include "collide/ray.h"
#include "collide/ray_pair.h"

enum
{
  OBSTACLES = 200,
  TRIANGLES = 4000,
  HULLS = 4
};

static bt__hull *hulls[HULLS];

static const bt__scene nothing;

static int
make_hulls (void **state)
{
  dice d = dice_new (77);
  (void)state;
  for (int i = 0; i < HULLS; i++)
    {
      bt_vec3 p[80];
      int n = 4 + 25 * i;
      for (int k = 0; k < n; k++)
        p[k] = dice_point (&d, 0.5);
      if (bt__hull_new (p, n, hulls + i, NULL))
        return 1;
    }
  return 0;
}

static int
drop_hulls (void **state)
{
  (void)state;
  for (int i = 0; i < HULLS; i++)
    bt__hull_free (hulls[i]);
  return 0;
}

/* ---- One shape ---- */

/* March a point along RAY; return where it is within NEAR of X, or past the range.  */
static double
march (const solid *x, const bt__ray *ray, double near)
{
  double t = 0;
  for (int i = 0; i < 100000 && t <= ray->range; i++)
    {
      double gap = solid_point (x, bt__axpy (ray->from, t, ray->direction));
      if (gap <= near)
        break;
      t += gap;
    }
  return t;
}

static int
cast_at (const solid *x, const bt__ray *ray, bt__entry *e)
{
  bt__obstacle o = obstacle_of_solid (x);
  if (x->kind == SOLID_TRIANGLE)
    return bt__ray_triangle (&x->triangle, ray->from, ray->direction, ray->range, e);
  return bt__ray_obstacle (&o, ray->from, ray->direction, ray->range, e);
}

/* Nonzero if the answer HIT, E for X is right to 1e-9 of SCALE.  */
static int
is_right (const solid *x, const bt__ray *ray, int hit, const bt__entry *e, double scale)
{
  double near = 1e-11 * scale, t = march (x, ray, near);
  if (!hit) /* a graze within rounding may count as none */
    return t > ray->range - 1e-9 * scale
           || solid_point (x, bt__axpy (ray->from, t + 3e-5 * scale, ray->direction)) > 0;
  if (solid_point (x, bt__axpy (ray->from, e->range, ray->direction)) > 1e-9 * scale)
    return 0;
  double slope = fmax (fabs (bt__dot (e->normal, ray->direction)), 1e-3);
  return fabs (bt__norm (e->normal) - 1) < 1e-12 && bt__dot (e->normal, ray->direction) <= 0
         && t <= e->range + 1e-9 * scale && e->range <= t + 1e-9 * scale / slope;
}

static void
check_kind (solid_kind kind, dice *d, long n)
{
  long hits = 0, inside = 0;
  for (long i = 0; i < n; i++)
    {
      double scale = kind == SOLID_HULL ? 1 : pow (10, dice_between (d, -3, 3));
      solid x = solid_draw (d, kind, scale, hulls, HULLS);
      bt_vec3 from = dice_point (d, dice_below (d, 3) ? 3 * scale : 0.3 * scale);
      bt_vec3 to = dice_point (d, 0.4 * scale);
      bt__ray ray = { from, bt__unit_or (bt__sub (to, from), bt__vec (0, 0, 1)), 8 * scale };
      bt__entry e = { 0 };
      if (dice_below (d, 4) == 0) /* along an axis of the shape: ties */
        ray.direction = kind == SOLID_CYLINDER ? x.cylinder.axis : x.box.frame.x;
      int hit = cast_at (&x, &ray, &e);
      hits += hit;
      inside += hit && e.range == 0;
      if (!is_right (&x, &ray, hit, &e, scale))
        fail_msg ("%s %ld: hit %d at %.17g, marched to %.17g, scale %g", solid_names[kind], i, hit,
                  e.range, march (&x, &ray, 1e-11 * scale), scale);
    }
  print_message ("# %s: %ld of %ld hit, %ld from inside\n", solid_names[kind], hits, n, inside);
  assert_true (hits > n / 10 && (inside > 0 || kind == SOLID_TRIANGLE));
}

static void
every_kind (void **state)
{
  dice d = dice_new (1);
  (void)state;
  for (int k = 0; k < SOLID_KINDS; k++)
    check_kind ((solid_kind)k, &d, k == SOLID_HULL ? 300 : 5000);
}

static void
judge_can_say_no (void **state)
{
  solid x = { .kind = SOLID_SPHERE, .sphere = { { 5, 0, 0 }, 1 } };
  bt__ray ray = { { 0, 0, 0 }, { 1, 0, 0 }, 10 };
  bt__entry e;
  (void)state;
  assert_true (cast_at (&x, &ray, &e));
  assert_true (is_right (&x, &ray, 1, &e, 1));
  assert_false (is_right (&x, &ray, 0, &e, 1));
  e.range += 1e-8;
  assert_false (is_right (&x, &ray, 1, &e, 1));
  e.range -= 2e-8;
  assert_false (is_right (&x, &ray, 1, &e, 1));
}

/* ---- Scenes ---- */

static bt__mesh *
draw_mesh (dice *d)
{
  static bt_vec3 v[3 * TRIANGLES];
  static uint32_t corner[TRIANGLES][3];
  for (uint32_t i = 0; i < TRIANGLES; i++)
    {
      bt_vec3 at = dice_point (d, 20);
      double size = pow (10, dice_between (d, -3, 0.3));
      for (uint32_t k = 0; k < 3; k++)
        {
          v[3 * i + k] = bt__add (at, dice_point (d, size));
          corner[i][k] = 3 * i + k;
        }
    }
  bt__soup soup = { 3 * TRIANGLES, TRIANGLES, v, (const uint32_t (*)[3])corner, NULL, 0 };
  bt__mesh *m = NULL;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, NULL), BT_OK);
  return m;
}

static bt__scene *
draw_scene (dice *d, bt_vec3 far)
{
  bt__obstacle o[OBSTACLES];
  bt__scene *s = NULL;
  for (uint32_t i = 0; i < OBSTACLES; i++)
    {
      solid x = solid_draw (d, (solid_kind)dice_below (d, SOLID_TRIANGLE), 1, NULL, 0);
      bt_vec3 at = bt__add (far, dice_point (d, 20));
      x.sphere.centre = bt__add (x.sphere.centre, at);
      x.box.frame.origin = bt__add (x.box.frame.origin, at);
      x.cylinder.centre = bt__add (x.cylinder.centre, at);
      x.capsule.a = bt__add (x.capsule.a, at);
      x.capsule.b = bt__add (x.capsule.b, at);
      o[i] = obstacle_of_solid (&x);
    }
  o[7] = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, far.z - 19 } };
  o[9] = (bt__obstacle){ .kind = BT__OBSTACLE_MESH, .shape.mesh = draw_mesh (d) };
  assert_int_equal (bt__scene_new (o, OBSTACLES, 1, &s, NULL), BT_OK);
  return s;
}

/* The nearest hit, the long way.  */
static double
brute (const bt__scene *s, const bt__switches *on, const bt__ray *ray)
{
  double best = INFINITY;
  for (uint32_t i = 0; i < s->n; i++)
    {
      const bt__obstacle *o = s->object + i;
      bt__entry e;
      if (!bt__is_on (on, i))
        continue;
      if (o->kind != BT__OBSTACLE_MESH)
        {
          if (bt__ray_obstacle (o, ray->from, ray->direction, ray->range, &e))
            best = fmin (best, e.range);
          continue;
        }
      for (uint32_t k = 0; k < o->shape.mesh->triangles; k++)
        {
          bt__triangle t = bt__mesh_triangle (o->shape.mesh, k);
          if (bt__ray_triangle (&t, ray->from, ray->direction, ray->range, &e))
            best = fmin (best, e.range);
        }
    }
  return best;
}

static void
check_scene (bt_vec3 far)
{
  dice d = dice_new (4);
  bt__scene *s = draw_scene (&d, far);
  uint8_t off[OBSTACLES] = { 0 };
  bt__switches on = { off, 1 };
  bt__count count = { 0 };
  long hits = 0;
  for (int i = 0; i < OBSTACLES; i += 5)
    off[i] = 1;
  for (int i = 0; i < 2000; i++)
    {
      bt_vec3 n = i % 10 ? dice_direction (&d) : bt__vec (0, i % 20 ? 1 : -1, 0);
      bt__ray ray = { bt__add (far, dice_point (&d, 25)), n, pow (10, dice_between (&d, 0, 3)) };
      bt__ray_hit hit;
      int found = bt__ray_cast (s, &on, NULL, 0, &ray, &hit, &count);
      double wanted = brute (s, &on, &ray);
      assert_int_equal (found, wanted < INFINITY);
      hits += found;
      if (!found)
        continue;
      assert_true (hit.range == wanted);
      assert_true (bt__distance (hit.point, bt__axpy (ray.from, hit.range, n)) == 0);
      assert_true (!off[hit.object] && hit.mover == BT__NO_MOVER);
      assert_true ((hit.slot == BT__NO_TRIANGLE) == (hit.object != 9));
    }
  print_message ("# %ld of 2000 hit; %lu pairs, %lu nodes a ray\n", hits,
                 (unsigned long)count.pairs / 2000, (unsigned long)count.nodes / 2000);
  assert_true (hits > 500 && count.pairs < 2000ul * 100);
  bt__scene_free (s);
}

static void
scene_is_brute_force (void **state)
{
  (void)state;
  check_scene (bt__vec (0, 0, 0));
  check_scene (bt__vec (1e5, -1e5, 1e4));
}

/* A ball of triangles, seen from inside: through every vertex, along edges, at random, all rays
   meet it.  */
static void
nothing_leaks (void **state)
{
  enum
  {
    ROUND = 24,
    UP = 12
  };
  static bt_vec3 v[ROUND * (UP + 1)];
  static uint32_t corner[2 * ROUND * UP][3];
  uint32_t n = 0;
  dice d = dice_new (6);
  (void)state;
  for (uint32_t j = 0; j <= UP; j++)
    for (uint32_t i = 0; i < ROUND; i++)
      {
        double a = 2 * BT__PI * i / ROUND, b = BT__PI * j / UP;
        v[j * ROUND + i] = bt__vec (sin (b) * cos (a), sin (b) * sin (a), cos (b));
      }
  for (uint32_t i = 0; i < ROUND; i++) /* the poles are one point */
    {
      v[i] = bt__vec (0, 0, 1);
      v[UP * ROUND + i] = bt__vec (0, 0, -1);
    }
  for (uint32_t j = 0; j < UP; j++)
    for (uint32_t i = 0; i < ROUND; i++)
      {
        uint32_t a = j * ROUND + i, b = j * ROUND + (i + 1) % ROUND;
        uint32_t two[2][3] = { { a, b, b + ROUND }, { a, b + ROUND, a + ROUND } };
        for (int k = 0; k < 6; k++)
          corner[n + (uint32_t)k / 3][k % 3] = two[k / 3][k % 3];
        n += 2;
      }
  bt__soup soup = { ROUND * (UP + 1), n, v, (const uint32_t (*)[3])corner, NULL, 0 };
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH };
  bt__scene *s = NULL;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &o.shape.mesh, NULL), BT_OK);
  assert_int_equal (bt__scene_new (&o, 1, 1, &s, NULL), BT_OK);
  for (int i = 0; i < 30000; i++)
    {
      bt_vec3 a = v[dice_below (&d, ROUND * (UP + 1))], b = v[dice_below (&d, ROUND * (UP + 1))];
      bt_vec3 from = i % 2 ? bt__vec (0, 0, 0) : dice_point (&d, 0.3);
      double t = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.5 : dice_uniform (&d);
      if (bt__distance (a, b) > 0.6)
        b = a;
      bt_vec3 at = bt__axpy (a, t, bt__sub (b, a));
      bt__ray ray = { from, bt__unit_or (bt__sub (at, from), bt__vec (0, 0, 1)), 3 };
      bt__ray_hit hit;
      bt__count count = { 0 };
      assert_true (bt__ray_cast (s, NULL, NULL, 0, &ray, &hit, &count));
    }
  bt__scene_free (s);
}

static void
movers_where_they_stand (void **state)
{
  dice d = dice_new (8);
  bt__scene *s = draw_scene (&d, bt__vec (0, 0, 0));
  bt__frame from = { { 1, 2, 3 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, 0, 1 } };
  bt__mover mover[2] = { { s, NULL, { from, { 0, 0, 0 }, { 0, 0, 1 }, 0 }, 50, 1 },
                         { s, NULL, { from, { 90, 0, 0 }, { 0, 0, 1 }, 1 }, 50, 0.5 } };
  bt__count count = { 0 };
  (void)state;
  for (int i = 0; i < 500; i++)
    {
      bt__ray ray = { dice_point (&d, 40), dice_direction (&d), 100 };
      double best = INFINITY;
      bt__ray_hit hit, own;
      for (int m = 0; m < 2; m++)
        {
          bt__frame f = bt__motion_at (&mover[m].motion, mover[m].done);
          bt__ray local = { bt__to_local (&f, ray.from), bt__into (&f, ray.direction), 100 };
          if (bt__ray_cast (s, NULL, NULL, 0, &local, &own, &count))
            best = fmin (best, own.range);
        }
      int found = bt__ray_cast (&nothing, NULL, mover, 2, &ray, &hit, &count);
      assert_int_equal (found, best < INFINITY);
      if (!found)
        continue;
      assert_true (hit.mover < 2 && fabs (hit.range - best) < 1e-12);
      assert_true (bt__dot (hit.normal, ray.direction) <= 0);
      assert_true (bt__distance (hit.point, bt__axpy (ray.from, best, ray.direction)) < 1e-10);
    }
  bt__scene_free (s);
}

static void
bad_rays_meet_nothing (void **state)
{
  dice d = dice_new (8);
  bt__scene *s = draw_scene (&d, bt__vec (0, 0, 0));
  bt__scene *empty = NULL;
  bt__count count = { 0 };
  bt__ray_hit hit;
  bt__ray bad[] = { { { NAN, 0, 0 }, { 1, 0, 0 }, 5 },
                    { { 0, 0, 0 }, { 0, INFINITY, 0 }, 5 },
                    { { 0, 0, 0 }, { 0, 0, 1 }, -1 },
                    { { 0, 0, 0 }, { 0, 0, -1 }, NAN },
                    { { 0, 0, 1e9 }, { 0, 0, 1 }, 1e12 } };
  (void)state;
  for (int i = 0; i < 5; i++)
    assert_false (bt__ray_cast (s, NULL, NULL, 0, bad + i, &hit, &count));
  assert_int_equal (bt__scene_new (NULL, 0, 1, &empty, NULL), BT_OK);
  count = (bt__count){ 0 };
  assert_false (bt__ray_cast (empty, NULL, NULL, 0, bad + 4, &hit, &count));
  assert_int_equal (count.nodes + count.pairs + count.links, 0);
  assert_int_equal (count.skipped_empty, 1);
  bt__scene_free (s);
  bt__scene_free (empty);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (every_kind),
                                      cmocka_unit_test (judge_can_say_no),
                                      cmocka_unit_test (scene_is_brute_force),
                                      cmocka_unit_test (nothing_leaks),
                                      cmocka_unit_test (movers_where_they_stand),
                                      cmocka_unit_test (bad_rays_meet_nothing) };
  return cmocka_run_group_tests_name ("collide_ray", tests, make_hulls, drop_hulls);
}
