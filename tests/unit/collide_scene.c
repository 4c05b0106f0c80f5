/* The trees and the scene: what they report is what brute force finds, by id, also far from the
   origin; overflow says what it dropped; an empty scene does nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/solids.h"
#include "collide/scene.h"

enum
{
  TRIANGLES = 3000,
  OBSTACLES = 300,
  LINKS = 400,
  ROOM = 40000
};

static bt__near room[ROOM];

/* ---- Meshes ---- */

static bt__mesh *
draw_mesh (dice *d, bt_vec3 far)
{
  static bt_vec3 v[3 * TRIANGLES];
  static uint32_t corner[TRIANGLES][3], id[TRIANGLES];
  for (uint32_t i = 0; i < TRIANGLES; i++)
    {
      bt_vec3 at = dice_point (d, 10);
      double size = pow (10, dice_between (d, -4, 0.5));
      for (uint32_t k = 0; k < 3; k++)
        {
          v[3 * i + k] = bt__add (far, bt__add (at, dice_point (d, size)));
          corner[i][k] = 3 * i + k;
        }
      if (i % 50 == 0)
        corner[i][2] = corner[i][1];
      id[i] = 7 * i + 3;
    }
  bt__soup soup = { 3 * TRIANGLES, TRIANGLES, v, (const uint32_t (*)[3])corner, id, 0 };
  bt__mesh *m = NULL;
  bt_error error;
  if (bt__mesh_new (&soup, NULL, NULL, &m, &error))
    fail_msg ("%s", error.text);
  return m;
}

static bt__link
draw_link (dice *d, bt_vec3 far)
{
  bt_vec3 a = bt__add (far, dice_point (d, 12));
  double size = pow (10, dice_between (d, -3, 1));
  return (bt__link){ a, dice_below (d, 10) ? bt__add (a, dice_point (d, size)) : a };
}

static int
by_triangle (const void *a, const void *b)
{
  const bt__near *x = a, *y = b;
  return (x->triangle > y->triangle) - (x->triangle < y->triangle);
}

/* LIST, one link's, has every triangle within REACH of LINK once and no other.  */
static void
check_list (const bt__mesh *m, const bt__link *link, double reach, bt__nears *list)
{
  static uint8_t wanted[8 * TRIANGLES];
  uint32_t n = 0;
  for (uint32_t i = 0; i < m->triangles; i++)
    {
      bt__witness w;
      bt__triangle t = bt__mesh_triangle (m, i);
      bt__pair_triangle (&t, link, &w);
      wanted[m->id[i]] = w.distance <= reach;
      n += w.distance <= reach;
    }
  if (list->n != n)
    fail_msg ("%u triangles, not %u", (unsigned)list->n, (unsigned)n);
  qsort (list->at, list->n, sizeof *list->at, by_triangle);
  for (uint32_t i = 0; i < list->n; i++)
    {
      assert_true (wanted[list->at[i].triangle]);
      assert_true (i == 0 || list->at[i].triangle != list->at[i - 1].triangle);
    }
}

static void
check_mesh (bt_vec3 far)
{
  dice d = dice_new (11);
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH, .shape.mesh = draw_mesh (&d, far) };
  bt__scene *s = NULL;
  bt__count count = { 0 };
  assert_int_equal (bt__scene_new (&o, 1, 1, &s, NULL), BT_OK);
  for (int i = 0; i < LINKS; i++)
    {
      bt__link link = draw_link (&d, far);
      double reach = pow (10, dice_between (&d, -4, 0.3));
      bt__nears list = { room, 0, ROOM, INFINITY };
      bt__scene_near (s, NULL, &link, 0, reach, &list, &count);
      check_list (o.shape.mesh, &link, reach, &list);
      double best = INFINITY;
      for (uint32_t k = 0; k < list.n; k++)
        best = fmin (best, list.at[k].w.distance);
      bt__near near;
      int found = bt__scene_nearest (s, NULL, &link, reach, &near, &count);
      assert_true (found == (list.n > 0));
      assert_true (found == bt__scene_within (s, NULL, &link, reach, &count));
      assert_true (!found || near.w.distance == best);
    }
  assert_true (count.pairs < (uint64_t)LINKS * TRIANGLES);
  bt__scene_free (s);
}

static void
mesh_is_brute_force (void **state)
{
  (void)state;
  check_mesh (bt__vec (0, 0, 0));
}

static void
mesh_far_away (void **state)
{
  (void)state;
  check_mesh (bt__vec (1e5, -1e5, 1e5));
  check_mesh (bt__vec (1e8, 0, 3));
}

/* ---- Rings ---- */

static int
is_same (bt_vec3 a, bt_vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The corner or, if EDGES, the edge at A is at the same place as that at B.  */
static int
is_same_place (const bt__mesh *m, uint32_t a, uint32_t b, int edges)
{
  bt__triangle s = bt__mesh_triangle (m, a / 3), t = bt__mesh_triangle (m, b / 3);
  bt_vec3 p = s.v[a % 3], q = s.v[(a + 1) % 3], u = t.v[b % 3], v = t.v[(b + 1) % 3];
  if (!edges)
    return is_same (p, u);
  return !is_same (p, q)
         && ((is_same (p, u) && is_same (q, v)) || (is_same (p, v) && is_same (q, u)));
}

/* The ring NEXT from A on has all that is at the same place once, and no other.  */
static void
check_ring (const bt__mesh *m, const uint32_t *next, uint32_t a, int edges)
{
  uint32_t members = 1, wanted = 1;
  for (uint32_t b = 0; b < 3 * m->triangles; b++)
    wanted += b != a && is_same_place (m, a, b, edges);
  for (uint32_t b = next[a]; b != a && members <= wanted; b = next[b], members++)
    assert_true (is_same_place (m, a, b, edges));
  assert_int_equal (members, wanted);
}

/* A soup of corners drawn from few places, some written as -0, some triangles without area: edges
   of one triangle and of many.  */
static void
rings_are_brute_force (void **state)
{
  (void)state;
  static bt_vec3 v[900];
  static uint32_t corner[300][3];
  dice d = dice_new (5);
  for (uint32_t i = 0; i < 900; i++)
    {
      uint64_t place = dice_below (&d, 60);
      v[i] = bt__vec (place % 4            ? (double)(place % 4)
                      : dice_below (&d, 2) ? 0.0
                                           : -0.0,
                      (double)(place / 4 % 4), (double)(place / 16));
      corner[i / 3][i % 3] = i;
    }
  bt__soup soup = { 900, 300, v, (const uint32_t (*)[3])corner, NULL, 0 };
  bt__mesh *m = NULL;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, NULL), BT_OK);
  for (uint32_t i = 0; i < 900; i++)
    {
      check_ring (m, m->next_corner, i, 0);
      check_ring (m, m->next_edge, i, 1);
    }
  bt__mesh_free (m);
}

/* Of two triangles in a plane only the outer edges are folds; if one is bent off by 0.002, all.  */
static void
folds_are_no_planes (void **state)
{
  (void)state;
  for (int bent = 0; bent < 2; bent++)
    {
      bt_vec3 v[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, bent ? 0.002 : 0 } };
      const uint32_t corner[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
      bt__soup soup = { 4, 2, v, corner, NULL, 0 };
      bt__mesh *m = NULL;
      assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, NULL), BT_OK);
      for (uint32_t i = 0; i < 2; i++)
        assert_int_equal (m->folds[i], bent ? 7 : m->id[i] == 0 ? 3 : 6);
      bt__mesh_free (m);
    }
}

/* ---- Obstacles ---- */

static bt__obstacle
obstacle_of (const solid *x, uint32_t id, bt_vec3 at)
{
  bt__obstacle o = { .id = id };
  switch (x->kind)
    {
    case SOLID_BOX:
      o.kind = BT__OBSTACLE_BOX;
      o.shape.box = x->box;
      o.shape.box.frame.origin = bt__add (o.shape.box.frame.origin, at);
      break;
    case SOLID_CYLINDER:
      o.kind = BT__OBSTACLE_CYLINDER;
      o.shape.cylinder = x->cylinder;
      o.shape.cylinder.centre = bt__add (o.shape.cylinder.centre, at);
      break;
    case SOLID_CAPSULE:
      o.kind = BT__OBSTACLE_CAPSULE;
      o.shape.capsule = x->capsule;
      o.shape.capsule.a = bt__add (o.shape.capsule.a, at);
      o.shape.capsule.b = bt__add (o.shape.capsule.b, at);
      break;
    default:
      o.kind = BT__OBSTACLE_SPHERE;
      o.shape.sphere = x->sphere;
      o.shape.sphere.centre = bt__add (o.shape.sphere.centre, at);
    }
  return o;
}

static bt__scene *
draw_scene (dice *d)
{
  bt__obstacle o[OBSTACLES];
  bt__scene *s = NULL;
  bt_error error;
  for (uint32_t i = 0; i < OBSTACLES; i++)
    {
      solid x = solid_draw (d, (solid_kind)dice_below (d, SOLID_TRIANGLE), 1, NULL, 0);
      o[i] = obstacle_of (&x, 1000 + i, dice_point (d, 10));
    }
  o[5] = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .id = 5, .shape.plane = { { 0, 0, 1 }, -9 } };
  if (bt__scene_new (o, OBSTACLES, 1, &s, &error))
    fail_msg ("%s", error.text);
  return s;
}

/* True if LIST has LINK within REACH of OBJECT.  */
static int
list_has (const bt__nears *list, uint32_t link, uint32_t object, double reach)
{
  for (uint32_t i = 0; i < list->n; i++)
    if (list->at[i].link == link && list->at[i].object == object && list->at[i].w.distance <= reach)
      return 1;
  return 0;
}

static void
scene_is_brute_force (void **state)
{
  dice d = dice_new (5);
  bt__scene *s = draw_scene (&d);
  bt__count count = { 0 };
  uint8_t off[OBSTACLES] = { 0 };
  bt__switches on = { off, 1 };
  (void)state;
  for (int i = 0; i < OBSTACLES; i += 3)
    off[i] = 1;
  for (int i = 0; i < 2000; i++)
    {
      bt__link link = draw_link (&d, bt__vec (0, 0, 0));
      double reach = pow (10, dice_between (&d, -3, 0.5));
      bt__nears list = { room, 0, ROOM, INFINITY };
      bt__scene_near (s, &on, &link, 3, reach, &list, &count);
      for (uint32_t k = 0; k < OBSTACLES; k++)
        {
          bt__witness w;
          bt__obstacle_pair (s->object + k, &link, &w);
          assert_int_equal (list_has (&list, 3, k, reach), w.distance <= reach && !off[k]);
        }
      assert_int_equal (bt__scene_within (s, &on, &link, reach, &count), list.n > 0);
      bt__nears_by_object (&list);
      for (uint32_t k = 1; k < list.n; k++)
        assert_true (list.at[k - 1].w.distance <= list.at[k].w.distance);
    }
  bt__scene_free (s);
}

/* With room for K, the K nearest are kept and the next is what was dropped.  */
static void
overflow_says_what_it_dropped (void **state)
{
  dice d = dice_new (6);
  bt__scene *s = draw_scene (&d);
  bt__count count = { 0 };
  bt__near few[4];
  (void)state;
  for (int i = 0; i < 1000; i++)
    {
      bt__link link = draw_link (&d, bt__vec (0, 0, 0));
      bt__nears all = { room, 0, ROOM, INFINITY }, some = { few, 0, 4, INFINITY };
      bt__scene_near (s, NULL, &link, 0, 4, &all, &count);
      bt__scene_near (s, NULL, &link, 0, 4, &some, &count);
      bt__nears_by_object (&all);
      bt__nears_by_object (&some);
      for (uint32_t k = 0; k < some.n; k++)
        assert_true (some.at[k].w.distance == all.at[k].w.distance);
      assert_true (all.n <= 4 ? isinf (some.dropped) : some.dropped == all.at[4].w.distance);
    }
  bt__scene_free (s);
}

static void
empty_scene_does_nothing (void **state)
{
  bt__scene *s = NULL;
  bt__count count = { 0 };
  bt_vec3 line[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  bt__nears list = { room, 0, ROOM, 0 };
  (void)state;
  assert_int_equal (bt__scene_new (NULL, 0, 1, &s, NULL), BT_OK);
  bt__scene_near_line (s, NULL, line, 3, 1, &list, &count);
  assert_int_equal (list.n, 0);
  assert_int_equal (count.skipped_empty, 1);
  assert_int_equal (count.nodes + count.pairs + count.links, 0);
  bt__scene_free (s);
}

/* A box for a body against every kind, by golden section over the edges of both being out of reach:
   its nearest is not farther than any of its corners, nor nearer than its ball allows.  */
static void
body_finds_its_nearest (void **state)
{
  dice d = dice_new (8);
  bt__scene *s = draw_scene (&d);
  bt__count count = { 0 };
  (void)state;
  for (int i = 0; i < 500; i++)
    {
      bt__link axis = draw_link (&d, bt__vec (0, 0, 0));
      bt__convex body = solid_link_core (&axis); /* as thin a body as there is: the pairs know it */
      bt_vec3 centre = bt__along (&axis, 0.5);
      double radius = 0.5 * bt__distance (axis.a, axis.b);
      bt__near near, link;
      bt__gap gap;
      int found
          = bt__scene_nearest_to_body (s, NULL, &body, centre, radius, 2, &near, &gap, &count);
      int wanted = bt__scene_nearest (s, NULL, &axis, 2, &link, &count);
      assert_int_equal (found, wanted);
      if (found && link.w.distance > 0)
        assert_true (fabs (near.w.distance - link.w.distance) <= 1e-6);
    }
  bt__scene_free (s);
}

static void
refuses_bad_soups (void **state)
{
  bt_vec3 v[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, NAN, 0 } };
  uint32_t corner[1][3] = { { 0, 1, 2 } };
  bt__soup soup = { 3, 1, v, (const uint32_t (*)[3])corner, NULL, 0 };
  bt__mesh *m = NULL;
  bt_error error;
  (void)state;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, &error), BT_ERR_DOMAIN);
  v[2].y = 1;
  corner[0][1] = 3;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, &error), BT_ERR_DOMAIN);
  corner[0][1] = 1;
  soup.triangles = 0;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, &error), BT_ERR_DOMAIN);
  assert_null (m);
  soup.triangles = 1;
  bt__place place = { { 10, 0, 0 }, 0.5 * BT__PI, 2 };
  assert_int_equal (bt__mesh_new (&soup, &place, NULL, &m, &error), BT_OK);
  /* Scaled by 2, its north turned to the east.  */
  assert_true (bt__distance (m->v[1], bt__vec (10, -2, 0)) < 1e-14);
  assert_true (bt__distance (m->v[2], bt__vec (12, 0, 0)) < 1e-14);
  bt__mesh_free (m);
}

static void
grid_has_its_triangles (void **state)
{
  double z[6] = { 0, 1, 2, 3, NAN, 5 };
  bt__grid grid = { 3, 2, 10, 20, 2, 3, z };
  bt__mesh *m = NULL;
  (void)state;
  assert_int_equal (bt__mesh_from_grid (&grid, NULL, NULL, &m, NULL), BT_OK);
  assert_int_equal (m->triangles, 1); /* the others touch the missing post */
  assert_int_equal (m->id[0], 2);
  bt__mesh_free (m);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (mesh_is_brute_force),           cmocka_unit_test (mesh_far_away),
    cmocka_unit_test (rings_are_brute_force),         cmocka_unit_test (folds_are_no_planes),
    cmocka_unit_test (scene_is_brute_force),          cmocka_unit_test (refuses_bad_soups),
    cmocka_unit_test (overflow_says_what_it_dropped), cmocka_unit_test (grid_has_its_triangles),
    cmocka_unit_test (empty_scene_does_nothing),      cmocka_unit_test (body_finds_its_nearest)
  };
  return cmocka_run_group_tests_name ("collide_scene", tests, NULL, NULL);
}
