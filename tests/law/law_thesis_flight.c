/* The thesis' collision response in flight: round any post and back, among random obstacles and
   real meshes, past moving ones; and the models that know no contact, held.  The oracle sees every
   motion of the line: nothing is ever passed, no link comes nearer than the core, none stretches.

   2400 steps of random flight, 40 times as many with BIGHT_LONG=1 in the environment.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/obj.h"
#include "thesis_rig.h"

/* ---- Round any convex post ---- */

static void
raise_hull (rig *r, dice *d)
{
  bt_vec3 p[24];
  for (int i = 0; i < 12; i++)
    {
      double phi = 2 * BT__PI * i / 12, q = dice_between (d, 0.3, 0.8);
      p[i] = bt__vec (q * cos (phi), q * sin (phi), -10);
      p[12 + i] = bt__vec (p[i].x, p[i].y, 0);
    }
  rig_hull (r, p, 24);
  r->bones = 0; /* the points are not all on the hull: its axis is */
  r->bone[r->bones++] = (sweep_segment){ { 0, 0, -10 }, { 0, 0, 0 } };
}

static void
raise_post (rig *r, dice *d, int kind)
{
  double a = dice_between (d, 0.1, 0.8), b = dice_between (d, 0.1, 0.8);
  if (kind == 0)
    rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), a);
  else if (kind == 1)
    rig_box (r, bt__vec (0, 0, -5), bt__vec (a, b, 5), dice_between (d, 0, 3));
  else if (kind == 2)
    rig_bar (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.1 * a);
  else
    raise_hull (r, d);
}

static void
round_posts (void **state)
{
  (void)state;
  dice d = dice_new (11);
  for (int i = 0; i < 24; i++)
    {
      rig *r = rig_new ();
      double way = i & 4 ? -1 : 1,
             phi = dice_between (&d, 2, 4.2); /* the bow hangs away from the post */
      bt_vec3 o = bt__vec (0, 0, -5);
      raise_post (r, &d, i % 4);
      r->props.model = i % 3 == 0 ? BT_MODEL_V_SHAPE : BT_MODEL_CATENARY;
      r->current.velocity[0] = bt__vec (0.3 * cos (phi), 0.3 * sin (phi), 0);
      rig_start (r, bt__vec (-7, -2, -5), bt__vec (-4, 0, -5), 20);
      double before = rig_turns (r, o);
      rig_round (r, o, way * 2 * BT__PI, 3, 0.05);
      rig_fly (r, bt__vec (-4, 0, -5), 0.05);
      assert_true (fabs (rig_turns (r, o) - before - way) < 1e-9);
      assert_true (rig_contacts (r) > 0);
      rig_round (r, o, -way * 2 * BT__PI, 3, 0.05);
      rig_fly (r, bt__vec (-4, 0, -5), 0.05);
      assert_true (fabs (rig_turns (r, o) - before) < 1e-9);
      assert_int_equal (rig_contacts (r), 0);
      rig_check (r);
      rig_free (r);
    }
}

/* Two turns and a quarter, as far as the pile's own contacts go, and off again.  */
static void
many_turns (void **state)
{
  (void)state;
  rig *r = rig_new ();
  bt_vec3 o = bt__vec (0, 0, -5);
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (-3, -3, -5), 40);
  double before = rig_turns (r, o);
  rig_round (r, o, 4.5 * BT__PI, 3, 0.05);
  assert_true (fabs (rig_turns (r, o) - before - 2.25) < 1e-9);
  assert_true (rig_contacts (r) > 30);
  rig_round (r, o, -4.5 * BT__PI, 3 * sqrt (2), 0.05);
  assert_true (fabs (rig_turns (r, o) - before) < 1e-9);
  assert_int_equal (rig_contacts (r), 0);
  rig_check (r);
  rig_free (r);
}

/* ---- Anywhere at any pace ---- */

static void
litter (rig *r, dice *d, sweep_triangle *sheet, int sheets)
{
  for (int i = 0; i < 12; i++)
    {
      bt_vec3 c = dice_point (d, 5), e = bt__add (c, dice_point (d, 4));
      bt_vec3 half = bt__vec (dice_between (d, 0.1, 1), dice_between (d, 0.1, 1), 0.5);
      int kind = dice_below (d, 4);
      if (kind == 0)
        rig_box (r, c, half, dice_between (d, 0, 3));
      else if (kind == 1)
        rig_pile (r, c, e, dice_between (d, 0.05, 0.6));
      else if (kind == 2)
        rig_ball (r, c, half.x);
      else
        rig_bar (r, c, e, dice_between (d, 0.005, 0.1));
    }
  if (sheets == 0)
    return;
  uint32_t corner[64][3];
  for (int i = 0; i < 3 * sheets; i++)
    corner[i / 3][i % 3] = (uint32_t)i;
  for (int i = 0; i < sheets; i++)
    for (int k = 0; k < 3; k++)
      sheet[i].v[k] = bt__add (k ? sheet[i].v[0] : dice_point (d, 5), dice_point (d, 1));
  bt__soup soup = {
    3 * (uint32_t)sheets, (uint32_t)sheets, sheet->v, (const uint32_t (*)[3])corner, NULL, 0
  };
  bt__mesh *m = NULL;
  assert_int_equal (bt__mesh_new (&soup, NULL, NULL, &m, NULL), BT_OK);
  rig_mesh (r, m);
  r->sheet = sheet;
  r->sheets = sheets;
}

static void
fly_anywhere (rig *r, dice *d, int steps)
{
  bt_vec3 goal = dice_point (d, 7);
  for (int i = 0; i < steps; i++)
    {
      double stride = pow (10, dice_between (d, -2, 0.5));
      bt_vec3 b = r->report.b, to = bt__sub (goal, b);
      if (bt__norm (to) < 0.3 || dice_below (d, 30) == 0 || (r->report.held && i % 3 == 0))
        goal = dice_point (d, 7);
      if (dice_below (d, 100) == 0)
        r->length = dice_between (d, 10, 40);
      rig_step (r, bt__axpy (b, fmin (1, stride / (bt__norm (to) + 1e-9)), to));
      if (i % 10 == 0)
        rig_check (r);
    }
}

static rig *
random_rig (uint64_t seed, dice *d, sweep_triangle *sheet)
{
  static const double models[] = { BT_MODEL_CATENARY, BT_MODEL_V_SHAPE, BT_MODEL_CATENARY,
                                   BT_MODEL_RUBBER_BAND, BT_MODEL_CATENARY };
  rig *r = rig_new ();
  *d = dice_new (seed + 1);
  litter (r, d, sheet, seed % 2 ? 40 : 0);
  r->rules.sliding = seed % 3 != 0;
  r->rules.stick_angle = seed % 3 == 1 ? 1.5 : 600;
  r->props.model = models[seed % 5];
  bt_vec3 aside = bt__vec (-9, 0, 0);
  rig_start (r, bt__add (aside, dice_point (d, 1)), bt__add (aside, dice_point (d, 1)),
             dice_between (d, 10, 40));
  return r;
}

static void
anywhere (void **state)
{
  (void)state;
  const char *wish = getenv ("BIGHT_LONG");
  uint64_t seeds = wish && *wish == '1' ? 480 : 12, splits = 0, rejoins = 0, refused = 0;
  for (uint64_t seed = 0; seed < seeds; seed++)
    {
      dice d;
      sweep_triangle sheet[64];
      rig *r = random_rig (seed, &d, sheet);
      fly_anywhere (r, &d, 200);
      rig_check (r);
      splits += r->counts.splits;
      rejoins += r->counts.rejoins;
      refused += r->counts.refused;
      rig_free (r);
    }
  print_message ("# %lu splits, %lu rejoined, %lu moves refused\n", (unsigned long)splits,
                 (unsigned long)rejoins, (unsigned long)refused);
  assert_true (splits > 100 && rejoins > 50);
}

/* The mutant: the line goes where its spans say.  The judge must object.  */
static void
unguarded (void **state)
{
  static const bt__scene nothing;
  (void)state;
  long crossings = 0;
  for (uint64_t seed = 0; seed < 4; seed++)
    {
      dice d;
      sweep_triangle sheet[64];
      rig *r = random_rig (seed, &d, sheet);
      r->around.scene = &nothing;
      for (int i = 0; i < 50; i++)
        rig_step (r, dice_point (&d, 5));
      crossings += r->crossings;
      rig_free (r);
    }
  assert_true (crossings > 100);
}

/* ---- Soups ---- */

static void
drag_over (const char *name)
{
  bt__mesh *mesh = obj_mesh (name);
  if (!mesh)
    {
      print_message ("# %s is not here: not tested\n", name);
      return;
    }
  rig *r = rig_new ();
  bt_vec3 lo = mesh->box.lo, hi = mesh->box.hi, c = bt__scale (0.5, bt__add (lo, hi));
  double size = bt__norm (bt__sub (hi, lo)), far = 0.7 * size;
  rig_mesh (r, mesh);
  r->current.velocity[0] = bt__vec (0.2, 0.1, 0);
  rig_start (r, bt__vec (c.x - far, c.y - far, hi.z + 0.2 * size),
             bt__vec (c.x + far, c.y - far, hi.z + 0.2 * size), 3.2 * size);
  dice d = dice_new (7);
  for (int i = 0; i < 10; i++)
    {
      bt_vec3 to = bt__vec (c.x + dice_between (&d, -far, far), c.y + dice_between (&d, -far, far),
                            dice_between (&d, lo.z, hi.z));
      rig_fly (r, to, size / 60);
      rig_check (r);
    }
  print_message ("# %s: %lu splits, %d contacts left\n", name, (unsigned long)r->counts.splits,
                 rig_contacts (r));
  assert_true (r->counts.splits > 0);
  rig_free (r);
}

static void
soups (void **state)
{
  (void)state;
  if (!obj_is_here ("sunken_ship.obj"))
    skip ();
  drag_over ("sunken_ship.obj");
  drag_over ("underwater_frame.obj");
  drag_over ("munkholmen_seabed.obj");
}

/* ---- Movers ---- */

/* A box is driven through the line: it is held back and named.  */
static void
mover (void **state)
{
  (void)state;
  rig *r = rig_new ();
  bt__obstacle o = { .kind = BT__OBSTACLE_BOX,
                     .id = 9,
                     .shape.box = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
                                    { 0.5, 0.5, 0.5 } } };
  bt__scene *body;
  assert_int_equal (bt__scene_new (&o, 1, 77, &body, NULL), BT_OK);
  r->current.velocity[0] = bt__vec (-0.25, 0, 0);
  bt__frame at = { { -8, 0, -5 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  r->mover[0] = (bt__mover){ .body = body, .motion = { .from = at }, .radius = 0.9 };
  r->movers = 1;
  rig_start (r, bt__vec (0, -5, -5), bt__vec (0, 5, -5), 12);
  int pinched = 0;
  for (int i = 0; i < 200; i++)
    {
      bt__frame to = at;
      to.origin.x += 0.05;
      r->mover[0].motion = bt__motion_between (&at, &to);
      rig_step (r, r->b);
      at = bt__motion_at (&r->mover[0].motion, r->mover[0].done);
      pinched += r->report.pinched_n > 0;
      for (int64_t k = 0; k + 1 < rig_n (r); k++)
        {
          bt__link link
              = { bt__to_local (&at, rig_x (r)[k]), bt__to_local (&at, rig_x (r)[k + 1]) };
          bt__witness w;
          bt__obstacle_pair (&o, &link, &w);
          assert_true (w.distance >= bt__core (r->props.diameter));
        }
    }
  assert_true (pinched > 50);
  assert_true (at.origin.x < 0); /* the bow is still before it */
  /* The line drawn over the box while it stands: a contact on a mover, known by its id.  */
  r->mover[0].motion = (bt__motion){ .from = at };
  rig_fly (r, bt__vec (-6, -3, -5), 0.05);
  bt__touch t;
  assert_true (bt__thesis_touches (r->state, &t, 1) > 0);
  assert_int_equal (t.object, 9);
  /* It is gone: so is the contact.  */
  r->mover[0].motion.from.origin.z = 50;
  rig_step (r, r->b);
  assert_int_equal (rig_contacts (r), 0);
  assert_true (r->report.left_n == 1 && r->report.left[0] == 9);
  assert_true (r->stretch <= 1.01);
  bt__scene_free (body);
  rig_free (r);
}

/* An obstacle switched off lets its contacts go.  */
static void
switched_off (void **state)
{
  (void)state;
  rig *r = rig_new ();
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 25);
  rig_round (r, bt__vec (0, 0, -5), 1.5 * BT__PI, 3, 0.05);
  assert_true (rig_contacts (r) > 0);
  r->off[0] = 1;
  r->on.version++;
  rig_step (r, r->b);
  assert_int_equal (rig_contacts (r), 0);
  assert_true (r->report.left_n == 1 && r->report.left[0] == 0);
  rig_free (r);
}

/* ---- The models that know no contact ---- */

static void
held (void **state)
{
  (void)state;
  rig *r = rig_new ();
  rig_pile (r, bt__vec (0, 0, -10), bt__vec (0, 0, 0), 0.3);
  rig_start (r, bt__vec (-6, -3, -5), bt__vec (3, -3, -5), 12);
  uint32_t room = RIG_NODES + 1;
  bt__polyline *line = calloc (1, bt__polyline_size (room));
  bt_vec3 ends[2] = { r->a, r->b };
  bt__shape shape = { 0 };
  bt__shape_memory memory = { 0 };
  assert_non_null (line);
  assert_int_equal (bt__polyline_lay (line, room, ends, 2, 12, RIG_NODES, NULL), BT_OK);
  bt_vec3 b = r->b;
  int stopped = 0, late = 0;
  for (int i = 0; i <= 260; i++)
    {
      bt__held_report report;
      bt_vec3 wish = bt__axpy (b, 0.05, bt__vec (i < 180 ? -0.7 : 0.7, i < 180 ? 1 : -1, 0));
      bt__shape_input in = { r->a, wish, 12, 100, &r->props, &r->water };
      assert_int_equal (
          bt__shape_solve (&in, &r->tools, &r->shapes, &shape, &memory, NULL, NULL, NULL), BT_OK);
      bt__held_step (line, &r->way, &shape, NULL, NULL, &report);
      assert_true (report.held == !(report.share == 1));
      assert_true (report.held ? report.object == 0 : bt__distance (report.b, wish) == 0);
      assert_true (rig_stretch (line) <= 1.01);
      stopped += report.held;
      late += report.held && i > 220;
      b = report.b;
      if (i == 179)
        {
          bt__touch t;
          assert_int_equal (bt__held_touches (line, &r->way, r->props.diameter, &t, 1), 1);
          assert_true (t.object == 0 && fabs (hypot (t.point.x, t.point.y) - 0.3) < 1e-9);
        }
    }
  assert_true (stopped > 5);
  assert_int_equal (late, 0); /* it came away again */
  assert_int_equal (r->crossings, 0);
  free (line);
  rig_free (r);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (round_posts),  cmocka_unit_test (many_turns), cmocka_unit_test (anywhere),
    cmocka_unit_test (unguarded),    cmocka_unit_test (soups),      cmocka_unit_test (mover),
    cmocka_unit_test (switched_off), cmocka_unit_test (held),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
