/* Real meshes, soups with holes and sheets that cross: the tree is brute force on them, and a
   tether thrown about among them never passes a triangle.

   They are read from BIGHT_REFERENCE_DATA or ../shared/data; where there are none, a word is
   printed and nothing is claimed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/obj.h"
#include "testbed/solids.h"
#include "testbed/sweep.h"
#include "collide/safe.h"

enum
{
  NODES = 31,
  MOST = 400000
};

static const double core = 0.0025;

static void
check_tree (const bt__scene *s, const bt__mesh *m, dice *d, bt_vec3 middle, double half)
{
  static bt__near room[MOST];
  bt__count count = { 0 };
  for (int i = 0; i < 40; i++)
    {
      bt_vec3 a = bt__add (middle, dice_point (d, half));
      bt__link link = { a, bt__add (a, dice_point (d, 0.05 * half)) };
      double reach = half * pow (10, dice_between (d, -3, -1));
      bt__nears list = { room, 0, MOST, INFINITY };
      uint32_t n = 0;
      bt__scene_near (s, NULL, &link, 0, reach, &list, &count);
      for (uint32_t k = 0; k < m->triangles; k++)
        {
          bt__witness w;
          bt__triangle t = bt__mesh_triangle (m, k);
          bt__pair_triangle (&t, &link, &w);
          n += w.distance <= reach;
        }
      assert_int_equal (list.n, n);
    }
}

static int
passes (const bt__mesh *m, const bt_vec3 *from, const bt_vec3 *to)
{
  int sum = 0;
  for (uint32_t i = 0; i < m->triangles; i++)
    {
      bt__triangle t = bt__mesh_triangle (m, i);
      sum += sweep_sheet (from, to, NODES, &(sweep_triangle){ { t.v[0], t.v[1], t.v[2] } });
    }
  return sum;
}

/* A tether from above, thrown at the mesh and about in it.  */
static void
throw_about (const bt__scene *s, const bt__mesh *m, dice *d, bt_vec3 middle, double half)
{
  bt__safe *safe = NULL;
  bt__safe_config config = { core, 0.2 * half, 1 };
  bt__count count = { 0 };
  bt_vec3 x[NODES], before[NODES], want[NODES];
  long truncated = 0;
  assert_int_equal (bt__safe_new (NODES, 64, &safe, NULL), BT_OK);
  for (int i = 0; i < NODES; i++)
    x[i] = bt__axpy (middle, half, bt__vec (2.0 * i / (NODES - 1) - 1, 0.01 * i, 1.2));
  for (int step = 0; step < 60; step++)
    {
      bt__safe_report report;
      bt_vec3 pull = bt__axpy (middle, half, dice_point (d, 1));
      for (int i = 0; i < NODES; i++)
        {
          want[i]
              = bt__add (bt__axpy (x[i], 0.3, bt__sub (pull, x[i])), dice_point (d, 0.1 * half));
          if (dice_below (d, 200) == 0)
            want[i].z = dice_below (d, 2) ? NAN : -1e9;
          before[i] = x[i];
        }
      bt__safe_step (safe, &config, s, NULL, NULL, 0, x, want, NODES, &report, &count);
      truncated += report.truncated;
      assert_int_equal (passes (m, before, x), 0);
    }
  for (int j = 0; j + 1 < NODES; j++)
    for (uint32_t i = 0; i < m->triangles; i++)
      {
        bt__link link = { x[j], x[j + 1] };
        solid t = { .kind = SOLID_TRIANGLE, .triangle = bt__mesh_triangle (m, i) };
        bt_vec3 to = bt__sub (t.triangle.v[0], link.a);
        if (bt__norm (to) < 0.05 * half) /* the judge is slow */
          assert_true (solid_brute (&t, &link) >= core);
      }
  print_message ("# truncated %ld of 60\n", truncated);
  bt__safe_free (safe);
}

static void
check (const char *name)
{
  bt__mesh *mesh = obj_mesh (name);
  bt__scene *scene = NULL;
  dice d = dice_new (3);
  if (!mesh)
    {
      print_message ("# %s is not here: not tested\n", name);
      return;
    }
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH, .shape.mesh = mesh };
  assert_int_equal (bt__scene_new (&o, 1, 1, &scene, NULL), BT_OK);
  bt_vec3 middle = bt__scale (0.5, bt__add (mesh->box.lo, mesh->box.hi));
  double half = 0.5 * bt__largest (bt__sub (mesh->box.hi, mesh->box.lo));
  print_message ("# %s: %u triangles, %.3g m\n", name, (unsigned)mesh->triangles, 2 * half);
  check_tree (scene, mesh, &d, middle, half);
  throw_about (scene, mesh, &d, middle, half);
  bt__scene_free (scene);
}

static void
wreck (void **state)
{
  (void)state;
  check ("sunken_ship.obj");
}

static void
frame (void **state)
{
  (void)state;
  check ("underwater_frame.obj");
}

static void
panel (void **state)
{
  (void)state;
  check ("bop_panel.obj");
}

static void
seabeds (void **state)
{
  (void)state;
  check ("herkules_seabed.obj");
  check ("munkholmen_seabed.obj");
}

static void
vehicle (void **state)
{
  (void)state;
  check ("rexrov_body.obj");
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (wreck), cmocka_unit_test (frame), cmocka_unit_test (panel),
          cmocka_unit_test (seabeds), cmocka_unit_test (vehicle) };
  if (!obj_is_here ("sunken_ship.obj"))
    {
      puts ("1..0 # SKIP the reference meshes are not here");
      return 0;
    }
  return cmocka_run_group_tests_name ("collide_real", tests, NULL, NULL);
}
