/* The taut string: exact cases, clearance, following its end, slipping, what holds it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "aware/turns.h"
#include "testbed/aware_cases.h"
#include "near.h"

#define CORE 0.005

typedef struct rig
{
  stage g;
  bt__taut *taut;
  bt__string *s, *fresh;
  bt__taut_config config;
  bt__count count;
  bt__corner hold[CASE_NODES];
  bt_vec3 p[CASE_NODES];
} rig;

static rig r;

static int
set_up (void **state)
{
  (void)state;
  r.s = calloc (1, bt__string_size (CASE_NODES));
  r.fresh = calloc (1, bt__string_size (CASE_NODES));
  if (!r.s || !r.fresh || bt__taut_new (CASE_NODES, &r.taut, NULL))
    return 1;
  r.s->room = r.fresh->room = CASE_NODES;
  return 0;
}

static int
tear_down (void **state)
{
  (void)state;
  stage_clear (&r.g);
  free (r.s);
  free (r.fresh);
  bt__taut_free (r.taut);
  return 0;
}

static void
configure (double mesh)
{
  r.config = (bt__taut_config){
    .scene = r.g.scene, .core = CORE, .want = CORE, .mesh = mesh, .margin = 0.4
  };
}

static double
clearance (const bt__string *s)
{
  return way_clearance (&r.config, s->x, s->n, 10, &r.count);
}

static bt__holds
holds (void)
{
  bt__holds h = { r.hold, 0, CASE_NODES, 0 };
  bt__holds_find (r.g.scene, NULL, r.s->x, r.s->n, CORE, 0.05, &h, &r.count);
  return h;
}

/* Shrink exact case K; return the exact length.  */
static double
shrink (exact_kind k, int links, int whole)
{
  double exact;
  uint32_t n = exact_case (k, CORE, links, &r.g, r.p, &exact);
  configure (1.35 * exact / links);
  r.config.whole = whole;
  assert_true (bt__string_lay (r.s, r.p, n));
  double before = r.s->length;
  assert_true (clearance (r.s) > CORE && before > exact);
  bt__taut_relax (r.taut, &r.config, r.s, 2000, &r.count);
  assert_true (r.s->settled);
  near ("length kept", r.s->length, bt__length (r.s->x, r.s->n), 0);
  near ("start", bt__distance (r.s->x[0], r.p[0]), 0, 0);
  near ("end", bt__distance (r.s->x[r.s->n - 1], r.p[n - 1]), 0, 0);
  return exact;
}

/* About 100 links: within 0.2 % and never short of the exact length, arcs within 0.1 %.  */
static void
exact_cases (void **state)
{
  (void)state;
  for (int k = 0; k < EXACT_KINDS; k++)
    {
      double exact = shrink ((exact_kind)k, 100, 1);
      bt__holds h = holds ();
      double arcs = bt__holds_length (&h, r.s->x, r.s->n);
      assert_true (r.s->n >= 80 && r.s->n <= 125);
      near (exact_names[k], r.s->length / exact, 1, k == EXACT_SPHERE ? 0.003 : 0.002);
      near (exact_names[k], arcs / exact, 1, k == EXACT_SPHERE ? 0.003 : 0.001);
      assert_true (r.s->length > exact * (1 - 1e-6));
      assert_true (clearance (r.s) >= CORE);
    }
}

/* Fine links near obstacles only: fewer nodes, no worse where they are as fine.  */
static void
sparse_mesh (void **state)
{
  (void)state;
  for (int k = 0; k < EXACT_KINDS; k++)
    {
      double exact = shrink ((exact_kind)k, 100, 0);
      near (exact_names[k], r.s->length / exact, 1, 0.003);
      assert_true (r.s->n < 100 && clearance (r.s) >= CORE);
    }
}

/* The box of the exact cases as a skin of triangles, 8 by 8 squares a face: the same length.  */
static bt__mesh *
skin_of_box (bt_vec3 centre, bt_vec3 half)
{
  enum
  {
    SIDE = 8
  };
  bt_vec3 v[6 * (SIDE + 1) * (SIDE + 1)];
  uint32_t corner[12 * SIDE * SIDE][3], n = 0, t = 0;
  bt__mesh *mesh = NULL;
  for (int face = 0; face < 6; face++)
    for (int i = 0; i <= SIDE; i++)
      for (int j = 0; j <= SIDE; j++)
        {
          double c[3], out = face % 2 ? 1 : -1;
          c[face / 2] = out;
          c[(face / 2 + 1) % 3] = 2.0 * i / SIDE - 1;
          c[(face / 2 + 2) % 3] = 2.0 * j / SIDE - 1;
          v[n] = bt__add (centre, bt__vec (c[0] * half.x, c[1] * half.y, c[2] * half.z));
          if (i < SIDE && j < SIDE)
            {
              uint32_t two[2][3]
                  = { { n, n + 1, n + SIDE + 1 }, { n + 1, n + SIDE + 1, n + SIDE + 2 } };
              memcpy (corner[t], two, sizeof two);
              t += 2;
            }
          n++;
        }
  bt__soup soup = { n, t, v, (const uint32_t (*)[3])corner, NULL, 0 };
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &mesh, NULL), BT_OK);
  return mesh;
}

static void
meshes_as_solids (void **state)
{
  (void)state;
  double exact = shrink (EXACT_BOX, 100, 1);
  uint32_t n = exact_case (EXACT_BOX, CORE, 100, &r.g, r.p, &exact);
  bt__box box = r.g.o[0].shape.box;
  stage_clear (&r.g);
  r.g.o[0] = (bt__obstacle){ .kind = BT__OBSTACLE_MESH, .friction = 0.3 };
  r.g.o[0].shape.mesh = skin_of_box (box.frame.origin, box.half);
  r.g.n = 1;
  assert_true (stage_make (&r.g));
  r.config.scene = r.g.scene;
  bt__string_lay (r.s, r.p, n);
  bt__taut_relax (r.taut, &r.config, r.s, 2000, &r.count);
  near ("length", r.s->length / exact, 1, 0.002);
  assert_true (r.s->length > exact * (1 - 1e-6) && clearance (r.s) >= CORE);
}

/* A polygon of half the links is four times as far above the arc.  */
static void
converges_to_second_order (void **state)
{
  (void)state;
  double coarse = shrink (EXACT_PILE, 60, 1);
  coarse = r.s->length / coarse - 1;
  double fine = shrink (EXACT_PILE, 120, 1);
  fine = r.s->length / fine - 1;
  assert_true (coarse / fine > 3 && coarse / fine < 5.5);
}

static void
lock_is_capstan (void **state)
{
  (void)state;
  shrink (EXACT_PILE, 100, 0);
  bt__holds h = holds ();
  /* The horizontal angle of contact, seen along the helix: times the cosine of its pitch.  */
  double d = 2.5, rad = 0.9 + CORE, flat = 4.5 * BT__PI - 2 * acos (rad / d);
  double run = 2 * sqrt (d * d - rad * rad) + rad * flat, wrap = flat * run / hypot (run, 3);
  near ("wrap", bt__holds_wrap (&h, 0), wrap, 0.01 * wrap);
  near ("lock", log (bt__holds_lock (&h)), 0.3 * wrap, 0.003 * wrap);
  near ("of another", bt__holds_wrap (&h, 1), 0, 0);
  assert_true (h.n > 10 && h.dropped == 0);
  near ("radius", r.hold[h.n / 2].radius, 0.9, 0);
  h.room = 3;
  bt__holds_find (r.g.scene, NULL, r.s->x, r.s->n, CORE, 0.05, &h, &r.count);
  assert_true (h.n == 3 && h.dropped > 5);
}

/* ---- Following ---- */

/* Led twice round a pile and back by the same way, the string has its turns and loses them.  */
static void
follows_its_end (void **state)
{
  const bt__axis axis = { { 0, 0, 0 }, { 0, 0, -1 } };
  bt_vec3 line[2] = { { -3, -3, 0 }, { 3, -3, 0 } };
  (void)state;
  stage_clear (&r.g);
  stage_cylinder (&r.g, bt__vec (0, 0, 20), bt__vec (0, 0, -20), 0.5);
  assert_true (stage_make (&r.g));
  configure (0.3);
  bt__string_lay (r.s, line, 2);
  double straight = r.s->length;
  for (int i = 0; i <= 2400; i++)
    {
      double u = i < 1200 ? i / 1200.0 : (2400 - i) / 1200.0, w = BT__PI / 4 - 4 * BT__PI * u;
      bt_vec3 to = bt__vec (3 * sqrt (2) * cos (w), 3 * sqrt (2) * -sin (w), 2 * u);
      assert_true (bt__taut_step (r.taut, &r.config, r.s, line[0], to, 1, &r.count));
      assert_true (clearance (r.s) >= CORE);
      if (i == 1200)
        near ("turns", bt__turns (&axis, r.s->x, r.s->n), -2.25, 1e-9);
    }
  bt__taut_relax (r.taut, &r.config, r.s, 50, &r.count);
  near ("straight again", r.s->length, straight, 1e-9 * straight);
}

/* A warm frame lags the settled string by little.  */
static void
lags_little (void **state)
{
  double worst = 0;
  dice d = dice_new (4);
  (void)state;
  draw_jacket (&r.g, &d, 2);
  uint32_t n = draw_line (&r.g, &d, 8, 0.35, 0.5, r.p);
  configure (0.6);
  bt_vec3 start = r.p[0];
  bt__string_lay (r.s, r.p, 2);
  for (uint32_t i = 1; i + 1 < n; i++)
    for (int k = 1; k <= 25; k++)
      {
        bt_vec3 to = bt__axpy (r.p[i], k / 25.0, bt__sub (r.p[i + 1], r.p[i]));
        assert_true (bt__taut_step (r.taut, &r.config, r.s, start, to, 2, &r.count));
        if (k % 5)
          continue;
        memcpy (r.fresh, r.s, bt__string_size (CASE_NODES));
        r.fresh->still = r.fresh->settled = 0;
        bt__taut_relax (r.taut, &r.config, r.fresh, 400, &r.count);
        worst = fmax (worst, r.s->length / r.fresh->length - 1);
      }
  print_message ("# worst lag %.4f %%\n", 100 * worst);
  assert_true (worst < 0.02 && clearance (r.s) >= CORE);
}

static void
will_not_be_led_through (void **state)
{
  bt_vec3 line[2] = { { -3, -3, 0 }, { 3, -3, 0 } };
  (void)state;
  stage_clear (&r.g);
  stage_cylinder (&r.g, bt__vec (0, 0, 20), bt__vec (0, 0, -20), 0.5);
  assert_true (stage_make (&r.g));
  configure (0.3);
  bt__string_lay (r.s, line, 2);
  assert_false (bt__taut_step (r.taut, &r.config, r.s, line[0], bt__vec (-3, 3, 0), 1, &r.count));
  near ("left alone", bt__distance (r.s->x[r.s->n - 1], line[1]), 0, 0);
  /* The start is led too.  */
  assert_true (bt__taut_step (r.taut, &r.config, r.s, bt__vec (-3, -4, 1), line[1], 5, &r.count));
  near ("start", bt__distance (r.s->x[0], bt__vec (-3, -4, 1)), 0, 0);
  near ("straight", r.s->length, sqrt (36 + 1 + 1), 1e-9);
  /* Nothing is solved that did not change.  */
  bt__taut_relax (r.taut, &r.config, r.s, 50, &r.count);
  uint64_t asked = r.count.links;
  bt_vec3 end = r.s->x[r.s->n - 1];
  assert_true (bt__taut_step (r.taut, &r.config, r.s, r.s->x[0], end, 2, &r.count));
  assert_true (r.count.links == asked);
}

/* The tether has gone over the top of a short post; the string learns it when seeded anew.  */
static void
slips (void **state)
{
  bt_vec3 round[3] = { { -3, 0.1, 0 }, { 0, 2, 0 }, { 3, 0.1, 0 } };
  bt_vec3 over[3] = { { -3, 0.1, 0 }, { 0, -0.1, 2 }, { 3, 0.1, 0 } };
  (void)state;
  stage_clear (&r.g);
  stage_cylinder (&r.g, bt__vec (0, -1, 1), bt__vec (0, -1, -20), 1.4);
  assert_true (stage_make (&r.g));
  configure (0.3);
  memset (r.s->x, 0, sizeof *r.s->x);
  r.s->n = 0;
  uint32_t n = refine (round, 3, 0.2, r.p);
  assert_false (bt__taut_reseed (r.taut, &r.config, r.s, r.fresh, r.p, n, 400, 0.005, &r.count));
  double was = r.s->length;
  assert_true (r.s->n >= 2);
  assert_false (bt__taut_reseed (r.taut, &r.config, r.s, r.fresh, r.p, n, 400, 0.005, &r.count));
  near ("the same", r.s->length, was, 0);
  over[1].y = 0.9; /* its slack lies off the post now */
  over[1].z = 0;
  n = refine (over, 3, 0.2, r.p);
  bt__string_lay (r.s, round, 3); /* a string that was not let shrink */
  assert_true (bt__taut_reseed (r.taut, &r.config, r.s, r.fresh, r.p, n, 400, 0.005, &r.count));
  near ("shorter", r.s->length, was, 0.003 * was);
}

/* The same input gives the same bytes.  */
static void
is_deterministic (void **state)
{
  static bt_vec3 first[CASE_NODES];
  (void)state;
  shrink (EXACT_TWO_PILES, 100, 0);
  memcpy (first, r.s->x, r.s->n * sizeof *first);
  uint32_t n = r.s->n;
  shrink (EXACT_WIRE, 100, 0);
  shrink (EXACT_TWO_PILES, 100, 0);
  assert_int_equal (n, r.s->n);
  assert_memory_equal (first, r.s->x, n * sizeof *first);
}

/* Pushed out: the same way, farther from the pile.  */
static void
inflates (void **state)
{
  (void)state;
  double taut = shrink (EXACT_PILE, 100, 0);
  r.config.want = 0.32;
  r.s->settled = r.s->still = 0;
  bt__taut_relax (r.taut, &r.config, r.s, 200, &r.count);
  assert_true (clearance (r.s) > 0.30);
  double wider = 2 * sqrt (6.25 - 1.22 * 1.22) + 1.22 * (4.5 * BT__PI - 2 * acos (1.22 / 2.5));
  near ("length", r.s->length, hypot (wider, 3), 0.02 * taut);
}

static void
refuses_nonsense (void **state)
{
  bt__taut *t = NULL;
  bt_error error;
  (void)state;
  assert_int_equal (bt__taut_new (3, &t, &error), BT_ERR_LIMIT);
  assert_null (t);
  assert_false (bt__string_lay (r.s, r.p, 1));
  assert_false (bt__string_lay (r.s, r.p, CASE_NODES + 1));
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (exact_cases),
                                      cmocka_unit_test (sparse_mesh),
                                      cmocka_unit_test (meshes_as_solids),
                                      cmocka_unit_test (converges_to_second_order),
                                      cmocka_unit_test (lock_is_capstan),
                                      cmocka_unit_test (follows_its_end),
                                      cmocka_unit_test (lags_little),
                                      cmocka_unit_test (will_not_be_led_through),
                                      cmocka_unit_test (slips),
                                      cmocka_unit_test (is_deterministic),
                                      cmocka_unit_test (inflates),
                                      cmocka_unit_test (refuses_nonsense) };
  return cmocka_run_group_tests_name ("aware taut", tests, set_up, tear_down);
}
