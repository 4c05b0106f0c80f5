/* Moves that touch, known exactly: no cast may call one of them clear.

   Every number is a small multiple of a power of two, so that the contact, at a share T of the move
   between the point S of the link and a point of the obstacle, is one of rational arithmetic and is
   checked in 113 bits.  Ends meet faces, edges meet edges, corners and themselves lengthwise; the
   link turns and stretches, slides in the plane of the triangle, only grazes it, or goes through; a
   triangle may be a sliver or have no area.

   The mutants look at the end of the move, or at nine places of it; both miss some.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "testbed/solids.h"
#include "testbed/sweep.h"
#include "collide/cast.h"

__extension__ typedef __float128 quad;

static const double core = 0x1p-9;

static long
moves (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 3000000 : 60000;
}

/* ---- Exact moves ---- */

/* A multiple of 1/16 within HALF.  */
static double
draw_number (dice *d, int half)
{
  return (double)(dice_below (d, 32 * half + 1) - 16 * half) / 16;
}

static bt_vec3
draw_vec (dice *d, int half)
{
  double x = draw_number (d, half), y = draw_number (d, half);
  return bt__vec (x, y, draw_number (d, half));
}

typedef struct move
{
  bt__triangle triangle;
  bt__link link;  /* at the start */
  bt_vec3 da, db; /* of its ends */
  bt_vec3 p;      /* where they meet */
  double s, t;
} move;

static bt__triangle
draw_triangle (dice *d)
{
  bt__triangle t;
  for (int k = 0; k < 3; k++)
    t.v[k] = draw_vec (d, 2);
  int kind = dice_below (d, 8);
  if (kind == 0)
    t.v[2] = t.v[1];
  else if (kind == 1)
    t.v[2] = bt__scale (0.5, bt__add (t.v[0], t.v[1]));
  else if (kind == 2)
    t.v[2] = bt__axpy (t.v[1], 0x1p-20, t.v[2]); /* a sliver */
  else if (kind == 3)
    t.v[0].z = t.v[1].z = t.v[2].z = 0;
  return t;
}

/* A point of it: inside, on an edge, a corner; weights are quarters.  */
static bt_vec3
draw_point (dice *d, const bt__triangle *t)
{
  static const int weights[][3]
      = { { 1, 1, 2 }, { 2, 1, 1 }, { 2, 2, 0 }, { 0, 1, 3 }, { 4, 0, 0 }, { 0, 0, 4 } };
  const int *w = weights[dice_below (d, 6)];
  bt_vec3 p = bt__scale (w[0] / 4.0, t->v[0]);
  return bt__axpy (bt__axpy (p, w[1] / 4.0, t->v[1]), w[2] / 4.0, t->v[2]);
}

/* A move of which the link's point S is at P at the share T.  */
static move
draw_move (dice *d)
{
  static const double shares[] = { 0, 0.5, 0.75, 1 };
  move m = { .triangle = draw_triangle (d), .t = (1 + dice_below (d, 15)) / 16.0 };
  m.p = draw_point (d, &m.triangle);
  m.s = shares[dice_below (d, 4)];
  m.da = draw_vec (d, 4);
  m.db = dice_below (d, 2) ? m.da : draw_vec (d, 4);
  bt_vec3 far = draw_vec (d, 3);
  int kind = dice_below (d, 6);
  if (kind == 0) /* along an edge: parallel */
    far = bt__sub (m.triangle.v[1], m.triangle.v[0]);
  else if (kind == 1 && m.s == 1) /* in the plane z = 0 of some triangles */
    m.da.z = m.db.z = far.z = 0;
  /* Where the ends are at T: the one at FAR from P times what keeps S of the link on P.  */
  bt_vec3 a = bt__axpy (m.p, -m.s, far), b = bt__axpy (m.p, 1 - m.s, far);
  m.link = (bt__link){ bt__axpy (a, -m.t, m.da), bt__axpy (b, -m.t, m.db) };
  return m;
}

static quad
at (double from, double by, quad t)
{
  return (quad)from + t * (quad)by;
}

/* The contact holds exactly.  */
static int
is_exact (const move *m)
{
  quad s = m->s, t = m->t;
#define MEETS(k)                                                                                   \
  ((1 - s) * at (m->link.a.k, m->da.k, t) + s * at (m->link.b.k, m->db.k, t) == (quad)m->p.k)
  return MEETS (x) && MEETS (y) && MEETS (z);
#undef MEETS
}

static bt__link
link_at (const move *m, double t)
{
  return (bt__link){ bt__axpy (m->link.a, t, m->da), bt__axpy (m->link.b, t, m->db) };
}

static double
distance (const move *m, double t)
{
  bt__link link = link_at (m, t);
  bt__witness w;
  bt__pair_triangle (&m->triangle, &link, &w);
  return w.distance;
}

/* ---- The cast ---- */

static double
cast (const move *m, bt__count *count)
{
  uint32_t corner[1][3] = { { 0, 1, 2 } };
  bt__soup soup = { 3, 1, m->triangle.v, (const uint32_t (*)[3])corner, NULL, 0 };
  bt__obstacle o = { .kind = BT__OBSTACLE_MESH };
  bt__scene *s = NULL;
  bt__near near;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &o.shape.mesh, NULL), BT_OK);
  assert_int_equal (bt__scene_new (&o, 1, 1, &s, NULL), BT_OK);
  assert_true (bt__scene_nearest (s, NULL, &m->link, 1e3, &near, count));
  bt__cast c = {
    .scene = s, .near = &near, .link = m->link, .d = { m->da, m->db }, .core = core, .w = near.w
  };
  double t = bt__cast_run (&c, count);
  bt__scene_free (s);
  return t;
}

static void
no_contact_is_missed (void **state)
{
  dice d = dice_new (4);
  bt__count count = { 0 };
  long tried = 0, ends = 0, nine = 0;
  double late = 0;
  (void)state;
  for (long i = 0; i < moves (); i++)
    {
      move m = draw_move (&d);
      assert_true (is_exact (&m));
      if (distance (&m, 0) < 2 * core)
        continue;
      tried++;
      double t = cast (&m, &count);
      if (!(t < m.t))
        fail_msg ("move %ld: allowed to %.17g, touches at %.17g", i, t, m.t);
      for (int k = 1; k <= 8; k++)
        assert_true (distance (&m, t * k / 8) >= core * (1 - 1e-9));
      late = fmax (late, t / m.t);
      int missed = 1;
      for (int k = 1; k <= 9; k++)
        missed &= distance (&m, k / 9.0) >= core;
      nine += missed;
      ends += distance (&m, 1) >= core;
    }
  print_message (
      "# 0 of %ld contacts missed, %.1f steps each; by end points %ld, by nine places %ld\n", tried,
      (double)count.cast_steps / (double)tried, ends, nine);
  assert_true (tried > moves () / 2);
  assert_true (ends > tried / 2 && nine > 0);
}

/* Whatever the exact predicates see pass through, among moves drawn at random, is held too; of what
   stays clear little is.  */
static void
crossings_are_held (void **state)
{
  dice d = dice_new (5);
  bt__count count = { 0 };
  long through = 0, clear = 0, held = 0;
  (void)state;
  for (long i = 0; i < moves () / 6; i++)
    {
      move m = draw_move (&d);
      m.link.a = bt__add (m.link.a, dice_point (&d, 0.7));
      m.link.b = bt__add (m.link.b, dice_point (&d, 0.7));
      if (distance (&m, 0) < 2 * core)
        continue;
      bt_vec3 from[2] = { m.link.a, m.link.b };
      bt__link end = link_at (&m, 1);
      bt_vec3 to[2] = { end.a, end.b };
      sweep_triangle t = { { m.triangle.v[0], m.triangle.v[1], m.triangle.v[2] } };
      double share = cast (&m, &count), least = INFINITY;
      if (sweep_sheet (from, to, 2, &t) > 0)
        {
          through++;
          assert_true (share < 1);
          continue;
        }
      for (int k = 0; k <= 200; k++)
        least = fmin (least, distance (&m, k / 200.0));
      if (least < 0.05)
        continue;
      clear++;
      held += share < 1;
    }
  print_message ("# %ld go through; of %ld that stay clear %ld are held\n", through, clear, held);
  assert_true (through > 100 && clear > 1000);
  assert_true (held <= clear / 100);
}

/* ---- Moves that only part ---- */

/* True if the link of C comes no nearer to X, or without X to the other link, in the whole of its
   move.  */
static int
only_parts (const bt__cast *c, const solid *x)
{
  double before = c->w.distance;
  for (int k = 1; k <= 300; k++) /* the first looks are the closest */
    {
      bt__link link = bt__link_moved (&c->link, c->d[0], c->d[1], pow (k / 300.0, 4));
      bt__link other = c->other;
      bt__witness w;
      if (x)
        w = solid_pair (x, &link);
      else
        bt__pair_links (&other, &link, &w);
      if (!(w.distance >= before))
        return 0;
      before = w.distance;
    }
  return 1;
}

/* Draw C a link within 2 % of the core of what C meets, and a move.  */
static int
draw_parting (dice *d, bt__cast *c, const solid *x)
{
  bt_vec3 at = dice_point (d, 1.5),
          along = bt__scale (dice_between (d, 0.05, 1), dice_direction (d));
  c->link = (bt__link){ bt__sub (at, along), bt__add (at, along) };
  if (x)
    c->w = solid_pair (x, &c->link);
  else
    bt__pair_links (&c->other, &c->link, &c->w);
  if (!(c->w.distance > 2 * core))
    return 0;
  double way = c->w.distance - core * (1 + exp (dice_between (d, log (1e-3), log (BT__CAST_NEAR))));
  bt_vec3 to = bt__scale (-way, c->w.normal);
  c->link = bt__link_moved (&c->link, to, to, 1);
  c->w.distance -= way;
  for (int e = 0; e < 2; e++)
    c->d[e] = bt__axpy (dice_point (d, 0.3), dice_between (d, 0, 0.3), c->w.normal);
  return 1;
}

/* However near the link is as the move begins.  */
static void
parting_is_free (void **state)
{
  dice d = dice_new (6);
  bt__count count = { 0 };
  long parts = 0, held = 0;
  (void)state;
  for (long i = 0; i < moves (); i++)
    {
      static const solid_kind kinds[] = { SOLID_SPHERE, SOLID_CAPSULE, SOLID_BOX, SOLID_CYLINDER };
      solid drawn = solid_draw (&d, kinds[i % 4], 1, NULL, 0), *x = i % 5 ? &drawn : NULL;
      bt__obstacle o = obstacle_of_solid (&drawn);
      bt__scene *s = NULL;
      bt__near near = { .slot = BT__NO_TRIANGLE };
      assert_int_equal (bt__scene_new (&o, 1, 1, &s, NULL), BT_OK);
      bt__cast c = { .scene = x ? s : NULL, .near = &near, .core = core };
      c.other = (bt__link){ dice_point (&d, 1), dice_point (&d, 1) };
      if (draw_parting (&d, &c, x) && only_parts (&c, x))
        {
          parts++;
          held += bt__cast_run (&c, &count) < 1;
        }
      bt__scene_free (s);
    }
  print_message ("# of %ld moves that only part %ld are held, %.1f steps each\n", parts, held,
                 (double)count.cast_steps / (double)parts);
  assert_true (parts > moves () / 20);
  assert_true (held <= parts / 1000);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (no_contact_is_missed), cmocka_unit_test (crossings_are_held),
          cmocka_unit_test (parting_is_free) };
  return cmocka_run_group_tests_name ("collide_motion", tests, NULL, NULL);
}
