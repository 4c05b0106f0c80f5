/* What a line does on what it touches: comes to rest on a bottom and over a beam, is pushed by what
   moves, loses no more energy than friction takes, and is the line alone where nothing is near.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact_law.h"

/* ---- Rest ---- */

typedef enum ground
{
  PLANE,
  FLAT_MESH,
  ROUGH_MESH,
  BEAM
} ground;

static void
lay (reef *r, rope *p, ground g, uint64_t seed)
{
  double z = g == BEAM ? -4 : -1, deep = g == BEAM ? -4 : -8;
  const bt_vec3 over[] = { { 0, 0, z }, { 10, 0, deep }, { 20, 0, z } },
                across[] = { { 0, 0, -9 }, { 9.5, 3.1, -9.8 }, { 19, 6.2, -9 } };
  dice d = dice_new (seed);
  assert_true (reef_open (r));
  if (g == PLANE)
    reef_plane (r, -10);
  else if (g == BEAM)
    reef_cylinder (r, bt__vec (10, -5, -5), bt__vec (10, 5, -5), 0.3);
  else
    assert_true (reef_bottom (r, &d, -10, 0.5, 110, g == ROUGH_MESH ? 0.1 : 0));
  assert_true (reef_raise (r));
  double length = g == BEAM ? 26 : g == ROUGH_MESH ? 24 : 40;
  assert_true (rope_open (p, r, 100, g == ROUGH_MESH ? across : over, 3, length, 0.3));
  p->line.wet_weight = 0.5;
  p->line.mass += 0.5 / 9.81;
}

/* SLIP: m/s in the last 5 s.  */
static void
rests (ground g, uint64_t seed, const char *what, double seconds, double least)
{
  static reef r;
  static rope p;
  double slip = 0, lowest = INFINITY;
  lay (&r, &p, g, seed);
  for (int i = 0; i < seconds * 60; i++)
    {
      assert_true (rope_step (&p, frame, 0));
      if (i >= (seconds - 5) * 60)
        slip = fmax (slip, p.touch.speed);
    }
  for (int i = 0; i <= p.d->n; i++)
    lowest = fmin (lowest, bt__dynamic_x (p.d)[i].z);
  print_message ("# %s: slip %.3g m/s, %d touches, %.2f solves a step\n", what, slip,
                 p.touch.touches, (double)p.solves / (double)p.steps);
  assert_true (p.touch.touches >= (g == BEAM ? 1 : 20));
  assert_below (slip, least, what);
  assert_true (g == BEAM || g == ROUGH_MESH || fabs (lowest + 10 - 0.005) < 1e-4);
  assert_int_equal (p.truncated, 0);
  rope_close (&p);
  reef_close (&r);
}

enum
{
  BOWED = 20
};

/* Lay P of 20.05 m between ends 20 m apart in a current toward -y, along AT, beside a post whose
   nearest point is at HEIGHT.  */
static void
bow (reef *r, rope *p, double height, const bt_vec3 *at)
{
  double y = height - 0.3 - 0.005;
  assert_true (reef_open (r));
  reef_cylinder (r, bt__vec (0.03, y, -3), bt__vec (0.03, y, 3), 0.3);
  assert_true (reef_raise (r));
  assert_true (rope_open (p, r, BOWED, at, BOWED + 1, 20.05, 0.3));
  p->config.pull[1] = INFINITY;
  p->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { { 0, -0.3, 0 } } };
}

/* Where a line without a post comes to rest, to AT; return its lowest place.  */
static double
bowed (reef *r, rope *p, bt_vec3 *at)
{
  double lowest = 0;
  for (int i = 0; i <= BOWED; i++)
    {
      double u = (double)i / BOWED;
      at[i] = bt__vec (20 * u - 10, -2.4 * u * (1 - u), 0);
    }
  bow (r, p, -100, at);
  for (int i = 0; i < 2000; i++)
    assert_true (rope_step (p, frame, 0));
  memcpy (at, bt__dynamic_x (p->d), (BOWED + 1) * sizeof *at);
  for (int i = 0; i <= BOWED; i++)
    lowest = fmin (lowest, at[i].y);
  rope_close (p);
  reef_close (r);
  return lowest;
}

/* A post is pushed IN metres into the line of REST, LOWEST its lowest place.  */
static void
lies_on_a_post (const bt_vec3 *rest, double lowest, double in)
{
  static reef r;
  static rope p;
  bt_vec3 over[BOWED + 1];
  double least = INFINITY, most = 0;
  int away = 0;
  for (int i = 0; i <= BOWED; i++)
    over[i]
        = bt__add (rest[i], bt__vec (0, i % BOWED ? in + 0.06 * sin (BT__PI * i / BOWED) : 0, 0));
  bow (&r, &p, lowest + in, over);
  for (int i = 0; i < 2400; i++)
    {
      assert_true (rope_step (&p, frame, 0));
      if (i < 1800)
        continue;
      away += p.touch.touches == 0;
      least = fmin (least, p.report.tension);
      most = fmax (most, p.report.tension);
    }
  print_message ("# a post %.1f mm in: %.3f N on it, tension %.3f to %.3f N\n", 1000 * in,
                 p.touch.load, least, most);
  assert_int_equal (away, 0);
  assert_near (most / least, 1, 1e-3, "the tension");
  rope_close (&p);
  reef_close (&r);
}

/* A line bowed by a current lies on a post with hundredths of a newton and turns away from the post
   on either side: the line stays on the post, and its tension with it.  */
static void
stays_on_a_post (void **state)
{
  (void)state;
  static reef r;
  static rope p;
  const double in[] = { 0.0005, 0.002, 0.01 };
  bt_vec3 rest[BOWED + 1];
  double lowest = bowed (&r, &p, rest);
  for (int i = 0; i < 3; i++)
    lies_on_a_post (rest, lowest, in[i]);
}

static void
comes_to_rest (void **state)
{
  (void)state;
  rests (PLANE, 1, "a plane", 60, 1e-4);
  rests (FLAT_MESH, 1, "a flat mesh", 60, 1e-4);
  rests (BEAM, 1, "a beam", 40, 1e-4);
}

static void
rests_on_crests (void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 8; seed++)
    rests (ROUGH_MESH, seed, "a rough mesh", 90, 1e-3);
}

/* ---- Movers ---- */

/* A box that is driven along x into a slack line at SPEED, against a wall if WALL.  */
static void
drive (double speed, double turn, int wall, int *pinched, double *moved)
{
  static reef body, r;
  static rope p;
  const bt_vec3 shape[] = { { 0, -3, 0 }, { 0.5, 0, 0 }, { 0, 3, 0 } };
  assert_true (reef_open (&body) && reef_open (&r));
  reef_box (&body, bt__vec (0, 0, 0), bt__vec (0.4, 0.3, 0.5), 0);
  if (wall)
    reef_box (&r, bt__vec (1.8, 0, 0), bt__vec (0.5, 4, 4), 0);
  assert_true (reef_raise (&body) && reef_raise (&r));
  assert_true (rope_open (&p, &r, 40, shape, 3, 7.5, 0.3));
  bt__mover m = { .body = body.scene, .radius = 0.75 };
  p.around.mover = &m;
  p.around.movers = 1;
  bt__frame at = { { -1, 0.1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  *pinched = 0;
  for (int i = 0; i < 300; i++)
    {
      bt_vec3 from[41], to[41];
      int n = (int)p.d->n + 1;
      bt__frame next = at;
      double a = turn * frame;
      next.origin.x += speed * frame;
      next.x = bt__add (bt__scale (cos (a), at.x), bt__scale (sin (a), at.y));
      next.y = bt__axpy (bt__scale (cos (a), at.y), -sin (a), at.x);
      m.motion = bt__motion_between (&at, &next);
      for (int k = 0; k < n; k++)
        from[k] = bt__to_local (&at, bt__dynamic_x (p.d)[k]);
      assert_true (rope_step (&p, frame, 1));
      at = bt__motion_at (&m.motion, m.done);
      *pinched += m.done < 1;
      for (int k = 0; k < n; k++)
        to[k] = bt__to_local (&at, bt__dynamic_x (p.d)[k]);
      p.crossings += reef_crossings (&body, from, to, n);
      double clear = reef_clearance (&body, to, n);
      if (!(clear >= p.config.core))
        fail_msg ("the box is %.9g m from the line", clear);
    }
  assert_kept (&p, "a mover");
  *moved = bt__dynamic_x (p.d)[20].x;
  rope_close (&p);
  reef_close (&r);
  reef_close (&body);
}

static void
is_pushed (void **state)
{
  (void)state;
  int pinched;
  double moved;
  drive (0.4, 0, 0, &pinched, &moved);
  assert_int_equal (pinched, 0);
  assert_true (moved > 1.3);
  drive (0.4, 1, 0, &pinched, &moved);
  drive (0.4, 0, 1, &pinched, &moved);
  assert_true (pinched > 0);
  drive (5, 0, 1, &pinched, &moved);
}

/* ---- Where nothing is near ---- */

static void
is_the_line_alone (void **state)
{
  (void)state;
  static reef r;
  static rope p;
  const bt_vec3 shape[] = { { 0, 0, 0 }, { 10, 3, -4 }, { 20, 0, 0 } };
  assert_true (reef_open (&r));
  reef_box (&r, bt__vec (10, 0, -60), bt__vec (1, 1, 1), 0);
  assert_true (reef_raise (&r));
  assert_true (rope_open (&p, &r, 50, shape, 3, 25, 0.3));
  bt__dynamic *d = calloc (1, bt__dynamic_size ((int)p.d->n_max));
  bt__dynamic_work *work = bt__dynamic_work_new ((int)p.d->n_max);
  assert_true (d && work);
  memcpy (d, p.d, bt__dynamic_size ((int)p.d->n_max));
  for (int i = 0; i < 600; i++)
    {
      bt__dynamic_report report;
      p.in.end[1].at = bt__vec (20 + sin (0.02 * i), cos (0.03 * i), 0.01 * i);
      p.in.pay = 0.3 * sin (0.01 * i);
      assert_true (rope_step (&p, frame, 0));
      assert_int_equal (bt__dynamic_step (d, work, &p.in, &report, NULL), BT_OK);
    }
  d->spare = p.d->spare; /* what contact knows of it */
  d->seen = p.d->seen;
  assert_memory_equal (d, p.d, bt__dynamic_size ((int)p.d->n_max));
  free (d);
  bt__dynamic_work_free (work);
  rope_close (&p);
  reef_close (&r);
}

/* A line of 40 links on a bottom of 140 by 140 squares of SIDE and under a cylinder is stepped by
   P, which remembers, and by Q, which forgets before every step.  */
static void
step_both (reef *r, rope *p, rope *q, double side)
{
  double w = 60 * side, up = 0.1 * w - 10, z = 0.04 * w - 10;
  const bt_vec3 shape[] = { { -w, 0, up }, { 0, 0, 0.01 * w - 10 }, { w, 0, up } };
  dice d = dice_new (5);
  assert_true (reef_open (r));
  reef_bottom (r, &d, -10, side, 140, 0.2 * side);
  reef_cylinder (r, bt__vec (0.7 * w, -w, z), bt__vec (0.7 * w, w, z), 0.03 * w);
  assert_true (reef_raise (r));
  assert_true (rope_open (p, r, 40, shape, 3, 2.1 * w, 0.3));
  assert_true (rope_open (q, r, 40, shape, 3, 2.1 * w, 0.3));
  for (int i = 0; i < 300; i++)
    {
      bt__line_work_forget (q->contact);
      p->in.end[1].at = q->in.end[1].at = bt__vec (w - 0.001 * w * i, 0.001 * w * i, up);
      p->line.wet_weight = q->line.wet_weight = 0.5;
      p->in.pay = q->in.pay = 0.02 * w * sin (0.02 * i);
      assert_true (rope_step (p, frame, 0) && rope_step (q, frame, 0));
    }
}

/* What the workspace remembers changes no result: a step with a new one is the same to the last
   bit; and it spares most walks through the trees.  On squares of 5 cm more parts are about a link
   than a list has room for.  */
static void
remembers_nothing (void **state)
{
  (void)state;
  static const double sides[] = { 0.3, 0.05 };
  static reef r;
  static rope p, q;
  for (int i = 0; i < 2; i++)
    {
      step_both (&r, &p, &q, sides[i]);
      assert_true (p.anchors->n > 0);
      assert_memory_equal (p.d, q.d, bt__dynamic_size ((int)p.d->n_max));
      assert_int_equal (p.anchors->n, q.anchors->n);
      assert_memory_equal (bt__contacts_at (p.anchors), bt__contacts_at (q.anchors),
                           (size_t)p.anchors->n * sizeof (bt__contact));
      print_message ("squares of %g m: %lu nodes of trees, %lu by a step that forgets\n", sides[i],
                     (unsigned long)p.count.nodes, (unsigned long)q.count.nodes);
      assert_true (2 * p.count.nodes < q.count.nodes);
      rope_close (&p);
      rope_close (&q);
      reef_close (&r);
    }
}

/* ---- What is told ---- */

static void
tells_touches (void **state)
{
  (void)state;
  static reef r;
  static rope p;
  bt__touch touch[100];
  lay (&r, &p, PLANE, 1);
  for (int i = 0; i < 3600; i++)
    assert_true (rope_step (&p, frame, 0));
  int n = bt__line_touches (p.d, p.anchors, touch, 100);
  assert_int_equal (n, p.touch.touches);
  double sum = 0;
  for (int i = 0; i < n; i++)
    {
      sum += touch[i].force.z;
      assert_int_equal (touch[i].object, 0);
      assert_near (touch[i].normal.z, 1, 1e-12, "the normal");
      assert_true (touch[i].s > 0 && touch[i].s < 40.1 && (i == 0 || touch[i].s > touch[i - 1].s));
    }
  double weight = 0.5 * 40 - bt__dot (p.d->pull[0], bt__vec (0, 0, -1))
                  - bt__dot (p.d->pull[1], bt__vec (0, 0, -1));
  assert_near (sum, weight, 0.02 * weight, "what the bottom bears");
  rope_close (&p);
  reef_close (&r);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (comes_to_rest),     cmocka_unit_test (rests_on_crests),
          cmocka_unit_test (stays_on_a_post),   cmocka_unit_test (is_pushed),
          cmocka_unit_test (is_the_line_alone), cmocka_unit_test (remembers_nothing),
          cmocka_unit_test (tells_touches) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
