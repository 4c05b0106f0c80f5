/* The thesis' collision response, figure by figure (D. Manowitz, chapter 3): the collision point,
   splitting, rejoining, the two rules of 3.5.1; with what the thesis got wrong, and its failures
   without the rules, as mutants that must show.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "thesis_rig.h"

static const double radius = 0.005; /* of the rig's tether */
static const double degree = BT__PI / 180;

/* ---- 3.4: the collision point ---- */

static int
as_printed (const bt__link *l, const bt__triangle *k)
{
  bt_vec3 u = bt__sub (l->b, l->a), s21 = bt__sub (k->v[1], k->v[0]);
  bt_vec3 s32 = bt__sub (k->v[2], k->v[1]), n = bt__cross (s21, s32);
  double t = bt__dot (n, bt__sub (k->v[0], l->a)) / bt__dot (u, n), nn = bt__dot (n, n);
  bt_vec3 p = bt__sub (bt__axpy (l->a, t, u), k->v[0]);
  double alpha = bt__dot (bt__cross (p, s32), n) / nn, beta = bt__dot (bt__cross (s21, p), n) / nn;
  return t >= 0 && t <= 1 && alpha >= 0 && alpha <= 1 && beta >= 0 && beta <= 1;
}

/* By three signed volumes.  */
static int
meets (const bt__link *l, const bt__triangle *k)
{
  int s[3];
  for (int i = 0; i < 3; i++)
    s[i] = sweep_orient (l->a, l->b, k->v[i], k->v[(i + 1) % 3]);
  int a = sweep_orient (k->v[0], k->v[1], k->v[2], l->a);
  int b = sweep_orient (k->v[0], k->v[1], k->v[2], l->b);
  return s[0] == s[1] && s[1] == s[2] && a * b < 0;
}

static void
triangle (void **state)
{
  (void)state;
  dice d = dice_new (1);
  int hits = 0, printed = 0;
  for (int i = 0; i < 20000; i++)
    {
      double t;
      bt__triangle k = { { dice_point (&d, 1), dice_point (&d, 1), dice_point (&d, 1) } };
      bt__link l = { dice_point (&d, 1), dice_point (&d, 1) };
      assert_int_equal (bt__meets_triangle (&l, &k, &t), meets (&l, &k));
      hits += meets (&l, &k);
      printed += as_printed (&l, &k);
    }
  assert_true (hits > 1000);
  assert_true (printed > 1.4 * hits); /* it accepts the parallelogram */
}

static const uint32_t cube[12][3]
    = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
        { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };

static bt__mesh *
cube_mesh (bt_vec3 centre, double half)
{
  bt_vec3 v[8];
  for (int i = 0; i < 8; i++)
    v[i] = bt__add (centre, bt__vec (half * (i & 1 ? 1 : -1), half * (i & 2 ? 1 : -1),
                                     half * (i & 4 ? 1 : -1)));
  bt__soup soup = { 8, 12, v, cube, NULL, 0 };
  bt__mesh *m = NULL;
  return bt__mesh_new (&soup, NULL, NULL, &m, NULL) == BT_OK ? m : NULL;
}

/* A link that just touches the upright edge at (1, 1), at any lean of up to 30 degrees.  */
static void
edge_point (const bt__scene *scene, dice *d, uint32_t id)
{
  double phi = (135 + dice_between (d, -30, 30)) * degree, tilt = dice_between (d, -0.3, 0.3);
  bt_vec3 e = bt__vec (1 + 0.0025 / sqrt (2), 1 + 0.0025 / sqrt (2), dice_between (d, -0.5, 0.5));
  bt_vec3 u = bt__vec (cos (phi), sin (phi), tilt);
  double s = dice_between (d, 0.3, 0.7);
  bt__link link = { bt__axpy (e, -s, u), bt__axpy (e, 1 - s, u) }, at;
  bt__near near, parts[BT__PARTS_MAX];
  bt__count count = { 0 };
  bt__collision c;
  bt__witness w;
  assert_true (bt__scene_nearest (scene, NULL, &link, 1, &near, &count));
  bt__collision_point (scene, NULL, &link, &near, 0.05 * radius, radius, parts, &c, &count);
  assert_int_equal (scene->object[near.object].id, id);
  assert_int_equal (c.intersections, 2);
  assert_true (hypot (c.contact.x - 1, c.contact.y - 1) < radius);
  assert_true (bt__dot (c.normal, bt__vec (sqrt (0.5), sqrt (0.5), 0)) > cos (5 * degree));
  at = (bt__link){ c.point, c.point };
  assert_true (bt__scene_nearest (scene, NULL, &at, 1, &near, &count));
  w = near.w;
  assert_true (w.distance >= radius * (1 - 1e-9) && w.distance < 2 * radius);
}

static void
collision_point (void **state)
{
  (void)state;
  for (int mesh = 0; mesh < 2; mesh++)
    {
      bt__obstacle o[2] = { { .kind = BT__OBSTACLE_SPHERE, .id = 4 }, { .id = 7 } };
      bt__scene *scene;
      dice d = dice_new (2);
      o[0].shape.sphere = (bt__sphere){ { -5, 0, 0 }, 1 };
      o[1].kind = mesh ? BT__OBSTACLE_MESH : BT__OBSTACLE_BOX;
      if (mesh)
        o[1].shape.mesh = cube_mesh (bt__vec (0, 0, 0), 1);
      else
        o[1].shape.box
            = (bt__box){ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 1, 1, 1 } };
      assert_int_equal (bt__scene_new (o, 2, 1, &scene, NULL), BT_OK);
      for (int i = 0; i < 500; i++)
        edge_point (scene, &d, 7);
      bt__scene_free (scene);
    }
}

/* ---- Figure 3-4: splitting ---- */

/* A box with its upright edge at (1, 1), a line laid past it; drawn over the edge.  */
static rig *
edge_rig (int model)
{
  rig *r = rig_new ();
  rig_box (r, bt__vec (0, 0, -5), bt__vec (1, 1, 1), 0);
  r->props.model = model;
  r->current.kind = BT_CURRENT_STILL;
  rig_start (r, bt__vec (4, -1.8, -5), bt__vec (-1.8, 4, -5), 12);
  return r;
}

static void
splitting (void **state)
{
  (void)state;
  rig *r = edge_rig (BT_MODEL_RUBBER_BAND);
  rig_fly (r, bt__vec (-2.6, 3.4, -5), 0.02);
  assert_int_equal (rig_contacts (r), 1);
  bt__split *s = &rig_span (r, 0)->end;
  assert_true (hypot (s->contact.x - 1, s->contact.y - 1) < radius);
  assert_true (bt__dot (s->normal, bt__vec (sqrt (0.5), sqrt (0.5), 0)) > cos (5 * degree));
  assert_true (rig_clearance (r) >= radius / 2);
  bt_vec3 point = s->point;
  for (int i = 0; i < 100; i++)
    assert_true (rig_step (r, bt__vec (-2.6 - 0.01 * i, 3.4 - 0.01 * i, -5)));
  assert_int_equal (rig_contacts (r), 1);
  assert_memory_equal (&point, &rig_span (r, 0)->end.point, sizeof point);
  rig_check (r);
  rig_free (r);
}

/* ---- Figure 1-2: the piece beyond a sticky contact is fixed ---- */

static void
sticky (void **state)
{
  (void)state;
  rig *r = rig_new ();
  bt_vec3 before[64];
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  r->rules.sliding = 0;
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 22);
  rig_round (r, bt__vec (0, 0, -5), 0.9 * BT__PI, 3, 0.05);
  rig_fly (r, bt__vec (-4, -3, -5), 0.05);
  assert_true (rig_contacts (r) > 0);
  int64_t n = rig_span (r, 0)->end.node;
  int contacts = rig_contacts (r);
  memcpy (before, rig_x (r), (size_t)n * sizeof *before);
  bt_vec3 b = r->report.b;
  rig_fly (r, bt__vec (b.x - 1, b.y - 1, b.z), 0.05);
  rig_fly (r, b, 0.05);
  assert_int_equal (rig_contacts (r), contacts);
  for (int64_t i = 0; i < n; i++)
    assert_true (bt__distance (before[i], rig_x (r)[i]) < 1e-6);
  rig_check (r);
  rig_free (r);
}

/* ---- The 185 degrees ---- */

/* Swing the vehicle about the split so that its angle goes by SWING degrees to either side of 180;
   return how often the number of contacts changed.  */
static int
swing (rig *r, double angle, int cycles)
{
  int changes = 0, before = rig_contacts (r);
  bt_vec3 a = r->a, e = bt__vec (1, 1, -5), along = bt__unit_or (bt__sub (e, a), e);
  bt_vec3 out = bt__vec (-along.y, along.x, 0);
  if (bt__dot (out, bt__vec (1, 1, 0)) < 0)
    out = bt__scale (-1, out);
  for (int i = 0; i < 60 * cycles; i++)
    {
      double phi = angle * degree * sin (2 * BT__PI * i / 60);
      bt_vec3 d = bt__axpy (bt__scale (cos (phi), along), sin (phi), out);
      rig_step (r, bt__axpy (e, 3, d));
      changes += rig_contacts (r) != before;
      before = rig_contacts (r);
    }
  return changes;
}

static void
rejoining (void **state)
{
  (void)state;
  rig *r = edge_rig (BT_MODEL_CATENARY);
  bt_vec3 start = r->report.b, shape[64];
  r->length = 8.45; /* nearly straight */
  rig_rest (r, 1);
  int64_t n = rig_n (r);
  memcpy (shape, rig_x (r), (size_t)n * sizeof *shape);
  rig_fly (r, bt__vec (-2.6, 3.4, -5), 0.01);
  assert_int_equal (rig_contacts (r), 1);
  int changes = 0, before = 1, steps = 400;
  double last = 0;
  bt_vec3 from = r->report.b, far = bt__axpy (start, 0.5, bt__sub (start, from));
  for (int i = 1; i <= steps; i++)
    {
      last = before ? rig_span (r, 0)->end.angle : last;
      rig_step (r, bt__axpy (from, (double)i / steps, bt__sub (far, from)));
      changes += rig_contacts (r) != before;
      before = rig_contacts (r);
    }
  assert_int_equal (rig_contacts (r), 0);
  assert_int_equal (changes, 1);
  assert_true (last > 180 * degree && last < 185 * degree);
  rig_fly (r, start, 0.01);
  assert_int_equal (rig_contacts (r), 0);
  assert_true (fabs (r->report.length - 8.45) < 0.00845);
  for (int i = 0; i <= 20; i++)
    {
      double s = 8.45 * i / 20, u = 0;
      int64_t k = 0;
      for (; k + 2 < n && u + 8.45 / (double)(n - 1) < s; k++)
        u += 8.45 / (double)(n - 1);
      bt_vec3 p
          = bt__axpy (shape[k], (s - u) * (double)(n - 1) / 8.45, bt__sub (shape[k + 1], shape[k]));
      assert_true (bt__distance (p, bt__polyline_point (bt__thesis_line (r->state), s)) < 0.0845);
    }
  rig_check (r);
  rig_free (r);
}

static void
flapping (void **state)
{
  (void)state;
  for (int at = 180; at <= 185; at += 5)
    {
      rig *r = edge_rig (BT_MODEL_RUBBER_BAND);
      r->rules.rejoin_angle = at * degree;
      rig_fly (r, bt__vec (-2.6, 3.4, -5), 0.02);
      assert_int_equal (rig_contacts (r), 1);
      int changes = swing (r, 4, 5);
      if (at == 185)
        assert_int_equal (changes, 0);
      else
        assert_true (changes >= 8); /* the thesis' first number: it flaps */
      rig_check (r);
      rig_free (r);
    }
}

/* ---- Figure 3-5: the back side ---- */

/* A slack line with its bow down-current of a post, carried up-current until it meets the lee;
   sliding, and sticking.  */
static const struct
{
  int sliding;
  double ax, ay, bx, by, length, heading; /* radians from the east */
} lee[] = { { 1, -0.487, -2.419, 2.470, 1.970, 5.773, 3.833 },
            { 0, -1.183, -5.655, 2.346, 4.860, 17.317, 4.273 } };

static rig *
lee_rig (int i, int mutant)
{
  rig *r = rig_new ();
  rig_box (r, bt__vec (0, 0, -5), bt__vec (0.1, 0.1, 5), 0);
  r->current.velocity[0] = bt__vec (0.5, 0, 0);
  r->rules.sliding = lee[i].sliding;
  r->rules.no_back_side = mutant;
  rig_start (r, bt__vec (lee[i].ax, lee[i].ay, -5), bt__vec (lee[i].bx, lee[i].by, -5),
             lee[i].length);
  bt_vec3 b = r->report.b, d = bt__vec (cos (lee[i].heading), sin (lee[i].heading), 0);
  for (int k = 0; k < 800 && r->counts.splits == 0; k++)
    rig_step (r, bt__axpy (b, 0.01 * k, d));
  assert_true (r->counts.splits > 0);
  return r;
}

static void
lee_on (rig *r, int i, int steps)
{
  bt_vec3 b = r->report.b, d = bt__vec (cos (lee[i].heading), sin (lee[i].heading), 0);
  for (int k = 0; k < steps; k++)
    rig_step (r, bt__axpy (b, 0.01 * k, d));
}

static void
back_side (void **state)
{
  (void)state;
  for (int i = 0; i < 2; i++)
    {
      rig *r = lee_rig (i, 0);
      assert_int_equal (rig_contacts (r), 1);
      assert_true (rig_span (r, 0)->end.normal.x > 0.5); /* the lee */
      assert_true (r->counts.back_side > 0);
      assert_true (rig_span (r, 1)->straight);
      rig_rest (r, 5); /* where it is straight now it may lean on the other edge */
      int n = rig_contacts (r);
      assert_true (n == 1 || n == 2);
      for (int k = 0; k < 3600; k++)
        {
          rig_rest (r, 1);
          assert_int_equal (rig_contacts (r), n);
        }
      assert_true (r->counts.splits == (uint64_t)n);
      lee_on (r, i, 50);
      assert_true (rig_contacts (r) <= 2);
      assert_int_equal (r->counts.rejoins, 0);
      assert_true (r->counts.length_cheats > 0); /* the price, counted */
      rig_check (r);
      rig_free (r);
    }
}

/* Without the rule it comes undone at once and is met again, step after step.  */
static void
back_side_mutant (void **state)
{
  (void)state;
  for (int i = 0; i < 2; i++)
    {
      rig *r = lee_rig (i, 1);
      lee_on (r, i, 50);
      assert_true (r->counts.splits > 25 && r->counts.rejoins > 25);
      rig_check (r); /* but never into the post */
      rig_free (r);
    }
}

/* ---- Figure 3-6: a split that would collide at once ---- */

static rig *
corner_rig (int mutant)
{
  rig *r = rig_new ();
  rig_box (r, bt__vec (1, 0, -5), bt__vec (1, 2, 2), 0);
  r->current.velocity[0] = bt__vec (0.5, 0, 0);
  r->rules.sliding = 0;
  r->rules.no_immediate = mutant;
  rig_start (r, bt__vec (-3, -6, -5), bt__vec (-3, 6, -5), 12.6);
  rig_fly (r, bt__vec (3, 4, -5), 0.05);
  assert_true (rig_contacts (r) > 0);
  return r;
}

static void
immediate (void **state)
{
  (void)state;
  rig *r = corner_rig (0);
  assert_true (r->counts.immediate > 0);
  assert_true (r->counts.refused == 0 && !r->report.held); /* resolved in the step it came up */
  /* Toward the obstacle and back to the left: the thesis' line then went through it.  */
  bt_vec3 b = r->report.b;
  rig_fly (r, bt__vec (1, 2.3, -5), 0.05);
  rig_fly (r, bt__vec (-3, 6, -5), 0.05);
  rig_fly (r, b, 0.05);
  rig_check (r);
  rig_free (r);
}

/* Without the rule the bow presses on the second face step after step and nothing moves on.  */
static void
immediate_mutant (void **state)
{
  (void)state;
  rig *r = corner_rig (1);
  assert_true (r->counts.refused > 100 && r->report.held);
  rig_check (r);
  rig_free (r);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (triangle),  cmocka_unit_test (collision_point),
    cmocka_unit_test (splitting), cmocka_unit_test (sticky),
    cmocka_unit_test (rejoining), cmocka_unit_test (flapping),
    cmocka_unit_test (back_side), cmocka_unit_test (back_side_mutant),
    cmocka_unit_test (immediate), cmocka_unit_test (immediate_mutant),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
