/* A frame of the collision room: nothing is allocated in it, its work is bounded, and its numbers
   are the same to the last bit however the engine was compiled.

   The allocations are counted by the linker's --wrap.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/solids.h"
#include "base/hash.h"
#include "collide/ray.h"
#include "collide/sweep.h"

enum
{
  NODES = 61,
  BLOCKS = 40,
  POSTS = 40,
  FRAMES = 60,
  ROOM = 4000,
  BEAMS = 16
};

/* ---- Allocations ---- */

static long allocations;

void *__real_malloc (size_t n);
void *__real_calloc (size_t n, size_t size);
void *__real_realloc (void *p, size_t n);
void *__wrap_malloc (size_t n);
void *__wrap_calloc (size_t n, size_t size);
void *__wrap_realloc (void *p, size_t n);

void *
__wrap_malloc (size_t n)
{
  allocations++;
  return __real_malloc (n);
}

void *
__wrap_calloc (size_t n, size_t size)
{
  allocations++;
  return __real_calloc (n, size);
}

void *
__wrap_realloc (void *p, size_t n)
{
  allocations++;
  return __real_realloc (p, n);
}

/* ---- A scene of every kind ---- */

static bt__mesh *
make_ground (dice *d)
{
  static double z[POSTS * POSTS];
  bt__grid grid = { POSTS, POSTS, -20, -20, 1, 1, z };
  bt__mesh *m = NULL;
  for (int i = 0; i < POSTS * POSTS; i++)
    z[i] = -6 + dice_uniform (d);
  assert_int_equal (bt__mesh_from_grid (&grid, NULL, NULL, &m, NULL), BT_OK);
  return m;
}

static bt__hull *
make_hull (dice *d)
{
  bt_vec3 p[12];
  bt__hull *h = NULL;
  for (int i = 0; i < 12; i++)
    p[i] = bt__add (bt__vec (2, -3, -2), dice_point (d, 1));
  assert_int_equal (bt__hull_new (p, 12, &h, NULL), BT_OK);
  return h;
}

static bt__scene *
make_scene (dice *d)
{
  bt__obstacle o[BLOCKS];
  bt__scene *s = NULL;
  for (uint32_t i = 0; i < BLOCKS; i++)
    {
      solid x = solid_draw (d, (solid_kind)(i % 4), 1, NULL, 0);
      bt_vec3 at = dice_point (d, 8);
      o[i] = (bt__obstacle){ .kind = BT__OBSTACLE_SPHERE, .id = i, .shape.sphere = x.sphere };
      o[i].shape.sphere.centre = bt__add (x.sphere.centre, at);
      if (x.kind == SOLID_BOX)
        {
          x.box.frame.origin = bt__add (x.box.frame.origin, at);
          o[i] = (bt__obstacle){ .kind = BT__OBSTACLE_BOX, .shape.box = x.box };
        }
      else if (x.kind == SOLID_CYLINDER)
        {
          x.cylinder.centre = bt__add (x.cylinder.centre, at);
          o[i] = (bt__obstacle){ .kind = BT__OBSTACLE_CYLINDER, .shape.cylinder = x.cylinder };
        }
      else if (x.kind == SOLID_CAPSULE)
        {
          x.capsule.a = bt__add (x.capsule.a, at);
          x.capsule.b = bt__add (x.capsule.b, at);
          o[i] = (bt__obstacle){ .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = x.capsule };
        }
    }
  o[0] = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, -9 } };
  o[1] = (bt__obstacle){ .kind = BT__OBSTACLE_MESH, .shape.mesh = make_ground (d) };
  o[2] = (bt__obstacle){ .kind = BT__OBSTACLE_CONVEX, .shape.hull = make_hull (d) };
  assert_int_equal (bt__scene_new (o, BLOCKS, 1, &s, NULL), BT_OK);
  return s;
}

/* ---- Frames ---- */

typedef struct play
{
  bt__scene *scene, *bar;
  bt__safe *safe;
  bt__mover mover;
  bt_vec3 x[NODES];
  bt__frame hull; /* of the vehicle */
  bt__count count;
  uint64_t hash;
} play;

static void
add (play *p, const void *data, size_t n)
{
  p->hash = bt__hash (data, n, p->hash);
}

static void
setup (play *p, dice *d)
{
  bt__obstacle bar
      = { .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = { { -2, 0, 0 }, { 2, 0, 0 }, 0.1 } };
  *p = (play){ .scene = make_scene (d) };
  assert_int_equal (bt__scene_new (&bar, 1, 2, &p->bar, NULL), BT_OK);
  assert_int_equal (bt__safe_new (NODES, 24, &p->safe, NULL), BT_OK);
  for (int i = 0; i < NODES; i++)
    p->x[i] = bt__vec (-12 + 0.4 * i, -14, 3);
  p->hull = (bt__frame){ { -12, -12, 3 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
}

static void
drop (play *p)
{
  bt__safe_free (p->safe);
  bt__scene_free (p->scene);
  bt__scene_free (p->bar);
}

static void
move_hull (play *p, dice *d)
{
  static const bt__box box
      = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0.4, 0.3, 0.2 } };
  bt__body body = bt__body_box (&box, 0);
  bt__motion m = { .from = p->hull, .travel = dice_point (d, 3), .axis = { 0, 0, 1 } };
  bt__stop stop = { 0 };
  double share = bt__body_sweep (&body, &m, 0.02, p->scene, NULL, &p->mover, 1, &stop, &p->count);
  p->hull = bt__motion_at (&m, share);
  add (p, &share, sizeof share);
  add (p, &p->hull, sizeof p->hull);
  add (p, &stop.distance, sizeof stop.distance);
  if (bt__body_nearest (&body, &p->hull, 5, p->scene, NULL, &p->mover, 1, &stop, &p->count))
    add (p, &stop.point, sizeof stop.point);
}

static void
cast_beams (play *p, dice *d)
{
  for (int i = 0; i < BEAMS; i++)
    {
      bt__ray ray = { p->hull.origin, dice_direction (d), 30 };
      bt__ray_hit hit;
      if (bt__ray_cast (p->scene, NULL, &p->mover, 1, &ray, &hit, &p->count))
        add (p, &hit.range, sizeof hit.range);
    }
}

static void
frame (play *p, dice *d)
{
  static bt__near room[ROOM];
  bt__safe_config config = { 0.0025, 2, 4 };
  bt__safe_report report;
  bt__nears list = { room, 0, ROOM, INFINITY };
  bt_vec3 want[NODES], pull = dice_point (d, 4);
  for (int i = 0; i < NODES; i++)
    want[i] = bt__add (bt__axpy (p->x[i], -0.3, p->x[i]), bt__add (pull, dice_point (d, 0.1)));
  bt__frame at = { { 0, -12, 2 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, 0, 1 } };
  p->mover = (bt__mover){
    p->bar, NULL, { .from = at, .travel = dice_point (d, 0.5), .axis = { 0, 0, 1 } }, 2.2, 1
  };
  bt__safe_step (p->safe, &config, p->scene, NULL, &p->mover, 1, p->x, want, NODES, &report,
                 &p->count);
  bt__scene_near_line (p->scene, NULL, p->x, NODES, 0.2, &list, &p->count);
  bt__nears_by_object (&list);
  add (p, p->x, sizeof p->x);
  add (p, &report, sizeof report);
  for (uint32_t i = 0; i < list.n; i++)
    {
      add (p, &list.at[i].object, sizeof list.at[i].object);
      add (p, &list.at[i].w.distance, sizeof list.at[i].w.distance);
    }
  move_hull (p, d);
  cast_beams (p, d);
}

static void
run (play *p, dice *d)
{
  for (int i = 0; i < FRAMES; i++)
    frame (p, d);
}

/* ---- The tests ---- */

static void
no_frame_allocates (void **state)
{
  dice d = dice_new (31);
  play p;
  (void)state;
  long before = allocations;
  setup (&p, &d);
  assert_true (allocations > before + 10); /* the counter counts */
  before = allocations;
  run (&p, &d);
  assert_int_equal (allocations, before);
  drop (&p);
}

/* Without libm's sines, which differ between processors, all is IEEE 754 arithmetic: the hash was
   printed by this test, compiled with -O0, -O2 and -O3, with and without AVX2, and is the same.  */
static void
same_bits_everywhere (void **state)
{
  const uint64_t golden = 0x53a5694a1f4cd841;
  dice d = dice_new (32);
  play p, q;
  (void)state;
  setup (&p, &d);
  dice again = d;
  run (&p, &d);
  drop (&p);
  d = dice_new (32);
  setup (&q, &d);
  run (&q, &again);
  drop (&q);
  assert_true (p.hash == q.hash);
  print_message ("# %#llx\n", (unsigned long long)p.hash);
#if defined __x86_64__ || defined __aarch64__
  assert_true (p.hash == golden);
#endif
}

static void
work_is_bounded (void **state)
{
  dice d = dice_new (33);
  play p;
  (void)state;
  setup (&p, &d);
  run (&p, &d);
  print_message (
      "# a frame: %lu links asked, %lu skipped, %lu nodes, %lu measured, %lu casts of %.1f "
      "steps\n",
      (unsigned long)p.count.links / FRAMES, (unsigned long)p.count.skipped_clear / FRAMES,
      (unsigned long)p.count.nodes / FRAMES, (unsigned long)p.count.pairs / FRAMES,
      (unsigned long)p.count.casts / FRAMES, (double)p.count.cast_steps / (double)p.count.casts);
  assert_true (p.count.pairs < 100ul * NODES * FRAMES); /* 3000 triangles are there */
  assert_true (p.count.cast_steps < 60 * p.count.casts);
  drop (&p);
}

/* GJK at its worst: discs, needles, parallel flats, four scales.  What it says is proven by the
   support along its normal.  */
static void
gjk_is_bounded (void **state)
{
  dice d = dice_new (34);
  int most = 0;
  double loose = 0;
  (void)state;
  for (int i = 0; i < 60000; i++)
    {
      double size = 1e-3 * (i % 4 == 0 ? 1 : i % 4 == 1 ? 30 : i % 4 == 2 ? 1000 : 1e6), r;
      solid x = solid_draw (&d, (solid_kind)(i % 5), size, NULL, 0), y = x;
      solid z = solid_draw (&d, SOLID_CYLINDER, dice_below (&d, 2) ? size : 0.01 * size, NULL, 0);
      z.cylinder.centre = bt__add (z.cylinder.centre, dice_point (&d, 1.5 * size));
      if (i % 7 == 0)
        z.cylinder.axis = y.cylinder.axis;
      bt__convex a = solid_core (&x, &r), b = solid_core (&z, &r);
      bt__gap gap;
      bt__gjk (&a, &b, &gap);
      most = gap.steps > most ? gap.steps : most;
      if (!(gap.distance > 0))
        continue;
      int hint = 0;
      bt_vec3 v = bt__sub (gap.a, gap.b), n = bt__unit_or (v, v);
      bt_vec3 p = a.support (a.shape, bt__scale (-1, n), &hint), q = b.support (b.shape, n, &hint);
      loose = fmax (loose, (gap.distance - bt__dot (n, bt__sub (p, q))) / size);
    }
  print_message ("# GJK: at most %d steps, proven to %.2g of the size\n", most, loose);
  assert_true (most < 120);
  assert_true (loose < 2e-7);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (no_frame_allocates), cmocka_unit_test (same_bits_everywhere),
          cmocka_unit_test (work_is_bounded), cmocka_unit_test (gjk_is_bounded) };
  return cmocka_run_group_tests_name ("collide_frame", tests, NULL, NULL);
}
