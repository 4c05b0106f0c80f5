/* Words by voxels: the same as those of members, of meshes alone, and what a square not tested
   does.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "aware/shadow_job.h"
#include "aware/voxel_job.h"
#include "testbed/aware_cases.h"

enum
{
  PATHS = 24
};

typedef struct rig
{
  stage g;
  bt__graph graph;
  bt__shadow *shadow;
  bt__voxels *voxels;
  bt__voxel_report report;
  bt__count count;
  bt_vec3 p[CASE_NODES];
  bt__word by_shadow[PATHS], by_voxel[PATHS];
} rig;

static rig r;

static int
tear_down (void **state)
{
  (void)state;
  stage_clear (&r.g);
  bt__shadow_free (r.shadow);
  bt__voxels_free (r.voxels);
  return 0;
}

static void
make_voxels (double cell)
{
  bt_error error;
  bt__voxel_config c = { r.g.scene, NULL, bt__vec (-18, -14, -20), bt__vec (18, 14, 0), cell };
  bt__voxels_free (r.voxels);
  if (bt__voxels_new (&c, NULL, &r.voxels, &error))
    fail_msg ("%s", error.text);
  r.report = r.voxels->report;
}

static void
make_shadow (void)
{
  bt__graph_config config = { .scene = r.g.scene, .surface = 0, .gap = 0.01 };
  bt__shadow_config how = { .jitter = 0.2, .tries = 24 };
  bt__shadow_free (r.shadow);
  assert_int_equal (bt__graph_new (&config, &r.graph, NULL), BT_OK);
  assert_int_equal (bt__shadow_new (&r.graph, &how, &r.shadow, NULL), BT_OK);
  bt__graph_free (&r.graph);
}

typedef struct tally
{
  int pairs, agree, equal, lost;
} tally;

/* Do the two kinds of words call the same lines between two points equal?  */
static tally
compare (dice *d)
{
  tally t = { 0 };
  bt_vec3 a = draw_point (&r.g, d, 0.4), b = draw_point (&r.g, d, 0.4);
  for (int i = 0; i < PATHS; i++)
    {
      uint32_t n = draw_between (&r.g, d, a, b, 2 + i % 6, 0.2, 0.5, r.p);
      bt__shadow_word (r.shadow, r.p, n, r.by_shadow + i);
      bt__voxels_word (r.voxels, r.p, n, r.by_voxel + i, &r.count);
      t.lost += r.by_voxel[i].lost != 0;
    }
  for (int i = 0; i < PATHS; i++)
    for (int j = 0; j < i; j++)
      {
        if (r.by_voxel[i].lost || r.by_voxel[j].lost)
          continue;
        int one = is_same_word (r.by_shadow + i, r.by_shadow + j);
        t.pairs++;
        t.equal += one;
        t.agree += one == is_same_word (r.by_voxel + i, r.by_voxel + j);
      }
  return t;
}

static void
draw (int scene, dice *d)
{
  if (scene == 0)
    draw_piles (&r.g, d, 6);
  else if (scene == 1)
    draw_rings (&r.g, d, 3);
  else if (scene == 2)
    draw_jacket (&r.g, d, 2);
  else
    draw_boxes (&r.g, d);
}

static void
agrees_with_shadows (void **state)
{
  int equal = 0, pairs = 0;
  (void)state;
  for (int scene = 0; scene < 4; scene++)
    {
      dice d = dice_new (40 + (uint64_t)scene);
      draw (scene, &d);
      make_shadow ();
      make_voxels (0.5);
      bt__shadow_report known;
      known = r.shadow->report;
      tally t = compare (&d);
      print_message ("# scene %d: %d of %d pairs agree, %d equal, %d lost; generators %u of %u, "
                     "left over %u\n",
                     scene, t.agree, t.pairs, t.equal, t.lost, r.report.generators, known.rank,
                     r.report.leftover);
      assert_int_equal (t.agree, t.pairs);
      assert_true (t.lost <= PATHS / 8);
      assert_int_equal (r.report.generators, known.rank);
      assert_int_equal (r.report.leftover, 0);
      equal += t.equal;
      pairs += t.pairs;
    }
  assert_true (equal > 20 && equal < pairs - 100);
}

/* A ring as triangles: one generator, none about a box of triangles.  */
static void
meshes (void **state)
{
  enum
  {
    LONG = 24,
    AROUND = 8
  };
  bt_vec3 v[LONG * AROUND];
  uint32_t corner[2 * LONG * AROUND][3], n = 0;
  (void)state;
  for (uint32_t i = 0; i < LONG; i++)
    for (uint32_t j = 0; j < AROUND; j++)
      {
        double u = 2 * BT__PI * i / LONG, w = 2 * BT__PI * j / AROUND, rad = 3 + 0.15 * cos (w);
        uint32_t k = i * AROUND, l = (i + 1) % LONG * AROUND, m = (j + 1) % AROUND;
        v[k + j] = bt__vec (rad * cos (u), 0.15 * sin (w), rad * sin (u) - 10);
        uint32_t t[2][3] = { { k + j, l + j, l + m }, { k + j, l + m, k + m } };
        memcpy (corner[n], t, sizeof t);
        n += 2;
      }
  bt__soup soup = { LONG * AROUND, n, v, (const uint32_t (*)[3])corner, NULL, 0 };
  stage_clear (&r.g);
  r.g.o[0] = (bt__obstacle){ .kind = BT__OBSTACLE_MESH };
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &r.g.o[0].shape.mesh, NULL), BT_OK);
  r.g.n = 1;
  assert_true (stage_make (&r.g));
  make_voxels (0.5);
  /* The inside of the tube holds no cell.  */
  assert_int_equal (r.report.generators, 1);
  assert_int_equal (r.report.leftover, 0);
  bt_vec3 through[3] = { { 0, -5, -10 }, { 0, 0, -10 }, { 0, 5, -10 } };
  bt_vec3 past[3] = { { 0, -5, -10 }, { 8, 0, -10 }, { 0, 5, -10 } };
  bt_vec3 above[3] = { { 0, -5, -10 }, { 0, 0, -5 }, { 0, 5, -10 } };
  bt__word a, b, c;
  bt__voxels_word (r.voxels, through, 3, &a, &r.count);
  bt__voxels_word (r.voxels, past, 3, &b, &r.count);
  bt__voxels_word (r.voxels, above, 3, &c, &r.count);
  assert_true (is_same_word (&b, &c));
  assert_false (is_same_word (&a, &b));
  bt__word_relative (&a, &b, &c);
  assert_int_equal (c.n, 1);
}

static void
lines_that_cannot_be_followed (void **state)
{
  dice d = dice_new (3);
  (void)state;
  draw_piles (&r.g, &d, 3);
  make_voxels (1);
  bt_vec3 in = r.g.o[1].shape.cylinder.centre, line[2] = { in, { 17, 13, -5 } };
  bt__word word;
  bt__voxels_word (r.voxels, line, 2, &word, &r.count);
  assert_true (word.lost);
  bt__voxels_word (r.voxels, line, 0, &word, &r.count);
  assert_true (word.lost);
}

static void
refuses_nonsense (void **state)
{
  bt__voxel_config c = { r.g.scene, NULL, bt__vec (0, 0, 0), bt__vec (1, 1, 1), -1 };
  bt__voxels *v;
  bt_error error;
  (void)state;
  assert_int_equal (bt__voxels_new (&c, NULL, &v, &error), BT_ERR_DOMAIN);
  c.cell = 1e-3;
  assert_int_equal (bt__voxels_new (&c, NULL, &v, &error), BT_ERR_LIMIT);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (agrees_with_shadows), cmocka_unit_test (meshes),
          cmocka_unit_test (lines_that_cannot_be_followed), cmocka_unit_test (refuses_nonsense) };
  return cmocka_run_group_tests_name ("aware voxel", tests, NULL, tear_down);
}
