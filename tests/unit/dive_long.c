/* Calls that last: each asks whether to go on, can be given up at any time and then has changed
   nothing; and laying a slack line among members, or above a bed far below, is little work whatever
   the number of its nodes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/bight.h>

#include "testbed/gallery.h"

typedef struct place
{
  bt_world world;
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_obstacle_def obstacle;
} place;

/* ---- Places ---- */

static void
begin_place (place *p, bt_model_kind model, double length, int nodes)
{
  memset (p, 0, sizeof *p);
  bt_def_init (bt_head_find ("sea"), &p->world.sea);
  bt_def_init (bt_head_find ("rov"), &p->vehicle);
  bt_def_init (bt_head_find ("tether"), &p->tether);
  p->world.sea.depth = 400;
  bt_def_set_name (p->vehicle.name, "minnow", NULL);
  bt_def_set_name (p->tether.name, "line", NULL);
  bt_def_set_name (p->tether.to.part, "minnow", NULL);
  p->tether.length = length;
  p->tether.props.model = model;
  p->tether.props.nodes = nodes;
  p->world.vehicles = &p->vehicle;
  p->world.n_vehicles = 1;
  p->world.tethers = &p->tether;
  p->world.n_tethers = 1;
  p->world.obstacles = &p->obstacle;
}

/* The one obstacle.  */
static bt_obstacle_def *
add (place *p, const char *head)
{
  assert_int_equal (p->world.n_obstacles++, 0);
  bt_def_init (bt_head_find (head), &p->obstacle);
  strcpy (p->obstacle.name, head);
  return &p->obstacle;
}

static bt_model *
compile (const bt_world *world)
{
  bt_model *model = NULL;
  bt_error e;
  if (bt_model_new (world, &model, &e) != BT_OK)
    fail_msg ("%s", e.text);
  return model;
}

/* Begin a dive of MODEL, which is given away.  */
static bt_dive *
enter (bt_model *model)
{
  bt_dive *dive = NULL;
  bt_error e;
  if (bt_dive_new (model, NULL, NULL, &dive, &e) != BT_OK)
    fail_msg ("%s", e.text);
  bt_model_release (model);
  return dive;
}

/* ---- Little work ---- */

/* 36 m of a thick line over 3 m, in a jacket: testbed/worlds/narrow-jacket.scm.  */
static bt_model *
slack_in_a_jacket (bt_model_kind model, int nodes, double wet_weight)
{
  gallery_world *w = gallery_open ("narrow-jacket");
  w->tether->props.model = model;
  w->tether->props.nodes = nodes;
  w->tether->props.wet_weight = wet_weight;
  bt_model *compiled = compile (&w->world);
  gallery_close (w);
  return compiled;
}

static void
laying_by_nodes (void **state)
{
  static const int nodes[] = { 2, 5, 13, 24, 40, 64, 100, 128, 200, 256, 400 };
  (void)state;
  for (size_t k = 0; k < sizeof nodes / sizeof *nodes; k++)
    for (int w = -1; w <= 1; w++)
      {
        bt_profile work;
        bt_tether_view view;
        bt_dive *dive = enter (slack_in_a_jacket (BT_MODEL_DYNAMIC, nodes[k], 2 * w));
        bt_dive_profile (dive, &work);
        assert_int_equal (bt_dive_tether (dive, 0, &view, NULL), BT_OK);
        print_message ("# %d nodes, %d N/m: %lu touches, %lu rounds, %lu pairs of links, %g N\n",
                       nodes[k], 2 * w, (unsigned long)work.touches,
                       (unsigned long)work.contact_rounds, (unsigned long)work.line_pairs,
                       view.tension_max);
        assert_true (work.line_pairs <= 1000000);
        assert_true (work.touches <= 100000);
        assert_true (work.contact_rounds <= 1000);
        assert_true (view.tension_max < 500);
        bt_dive_free (dive);
      }
}

/* 800 m that a current bows out, with and without a bed that they never reach.  */
static bt_dive *
tow (int bed, bt_model_kind model)
{
  place p;
  begin_place (&p, model, 800, 40);
  p.world.sea.depth = 2000;
  p.world.sea.current.kind = BT_CURRENT_UNIFORM;
  p.world.sea.current.velocity[0] = (bt_vec3){ 0.5, 0, 0 };
  p.vehicle.at = (bt_vec3){ 300, 0, -500 };
  p.tether.from.at = (bt_vec3){ 0, 0, 0 };
  if (bed)
    add (&p, "seabed");
  return enter (compile (&p.world));
}

static void
a_bed_far_below (void **state)
{
  (void)state;
  for (int model = BT_MODEL_DYNAMIC; model <= BT_MODEL_AUTO; model++)
    {
      /* With a bed, model `auto' leaves an eighth of the nodes to contact.  */
      double near = model == BT_MODEL_AUTO ? 1e-3 : 1e-9;
      bt_tether_view without, with;
      bt_dive *a = tow (0, (bt_model_kind)model), *b = tow (1, (bt_model_kind)model);
      bt_dive_tether (a, 0, &without, NULL);
      bt_dive_tether (b, 0, &with, NULL);
      print_message ("# %g N without a bed, %g with one far below\n", without.tension_anchor,
                     with.tension_anchor);
      assert_true (without.tension_anchor > 10);
      assert_float_equal (with.tension_anchor, without.tension_anchor,
                          near * without.tension_anchor);
      for (int k = 0; k < 60; k++)
        {
          assert_int_equal (bt_dive_step (a, NULL), BT_OK);
          assert_int_equal (bt_dive_step (b, NULL), BT_OK);
        }
      bt_dive_tether (a, 0, &without, NULL);
      bt_dive_tether (b, 0, &with, NULL);
      print_message ("# a second later %g N and %g\n", without.tension_anchor, with.tension_anchor);
      assert_float_equal (with.tension_anchor, without.tension_anchor,
                          0.01 * without.tension_anchor);
      bt_dive_free (a);
      bt_dive_free (b);
    }
}

/* ---- Given up ---- */

typedef struct patience
{
  int asked, most; /* it gives up at the MOST-th question; 0: never */
  double last;     /* share */
} patience;

static int
ask (void *user, double share)
{
  patience *p = user;
  assert_true (share >= 0 && share <= 1);
  p->last = share;
  return ++p->asked == p->most;
}

static void
entering_is_given_up (void **state)
{
  (void)state;
  bt_model *model = slack_in_a_jacket (BT_MODEL_DYNAMIC, 64, 1);
  patience whole = { 0 };
  bt_dive *dive = NULL;
  bt_error e;
  assert_int_equal (bt_dive_new_polled (model, NULL, NULL, ask, &whole, &dive, &e), BT_OK);
  assert_true (whole.asked > 20);
  bt_dive_free (dive);
  for (int most = 1; most <= whole.asked; most += 1 + whole.asked / 7)
    {
      patience some = { .most = most };
      assert_int_equal (bt_dive_new_polled (model, NULL, NULL, ask, &some, &dive, &e),
                        BT_ERR_INTERRUPTED);
      assert_int_equal (some.asked, most);
    }
  bt_model_release (model);
}

static double
field_of_model (void)
{
  const bt_head *head = bt_head_find ("tether");
  return (double)(bt_field_find (head, "model") - head->fields);
}

typedef struct act
{
  const char *name;
  bt_op op;
  int n;
  double args[3];
  bt_model_kind from;
} act;

static void
what_is_done_is_given_up (void **state)
{
  double model = field_of_model ();
  const act acts[] = {
    { "place", BT_OP_PLACE, 3, { 30, -6, -16 }, BT_MODEL_DYNAMIC },
    { "place, auto", BT_OP_PLACE, 3, { 30, -6, -16 }, BT_MODEL_AUTO },
    { "lay", BT_OP_LAY, 3, { 0, 0, -17 }, BT_MODEL_DYNAMIC },
    { "alter", BT_OP_ALTER, 3, { BT_PART_TETHER, model, BT_MODEL_DYNAMIC }, BT_MODEL_CATENARY },
    { "alter, auto", BT_OP_ALTER, 3, { BT_PART_TETHER, model, BT_MODEL_AUTO }, BT_MODEL_STEADY },
  };
  (void)state;
  for (size_t k = 0; k < sizeof acts / sizeof *acts; k++)
    {
      const act *a = &acts[k];
      bt_error e;
      bt_dive *dive = enter (slack_in_a_jacket (a->from, 30, 1));
      patience some = { .most = 1 + k % 3 }, whole = { 0 };
      uint64_t before = bt_dive_hash (dive);
      bt_dive_set_poll (dive, ask, &some);
      assert_int_equal (bt_dive_do (dive, a->op, 0, a->args, a->n, &e), BT_ERR_INTERRUPTED);
      assert_true (bt_dive_hash (dive) == before);
      bt_dive_set_poll (dive, ask, &whole);
      assert_int_equal (bt_dive_do (dive, a->op, 0, a->args, a->n, &e), BT_OK);
      print_message ("# %s: asked %d times\n", a->name, whole.asked);
      assert_true (whole.asked >= some.asked);
      assert_true (bt_dive_hash (dive) != before);
      bt_dive_free (dive);
    }
}

/* Of a way of hours the end is not waited for.  */
static void
a_hundred_kilometres (void **state)
{
  place p;
  bt_error e;
  (void)state;
  begin_place (&p, BT_MODEL_DYNAMIC, 1e5, 24);
  p.vehicle.at = (bt_vec3){ 2, -5, -26 };
  p.tether.from.at = (bt_vec3){ -8, -1, -17 };
  bt_obstacle_def *ball = add (&p, "sphere");
  ball->at = (bt_vec3){ 4, -2, -23 };
  ball->radius = 0.27;
  patience some = { .most = 100 };
  bt_dive *dive = enter (compile (&p.world));
  bt_dive_set_poll (dive, ask, &some);
  assert_int_equal (bt_dive_do (dive, BT_OP_PLACE, 0, (double[]){ 1e5, 0, -20 }, 3, &e),
                    BT_ERR_INTERRUPTED);
  bt_dive_free (dive);
}

static void
a_haul_is_given_up (void **state)
{
  bt_error e;
  bt_haul haul;
  (void)state;
  bt_dive *dive = enter (slack_in_a_jacket (BT_MODEL_DYNAMIC, 30, 1));
  patience some = { .most = 40 };
  uint64_t before = bt_dive_hash (dive);
  bt_dive_set_poll (dive, ask, &some);
  assert_int_equal (bt_tether_haul (dive, 0, 0.5, 1000, 600, &haul, &e), BT_ERR_INTERRUPTED);
  assert_true (bt_dive_hash (dive) == before);
  bt_dive_free (dive);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (laying_by_nodes),      cmocka_unit_test (a_bed_far_below),
    cmocka_unit_test (entering_is_given_up), cmocka_unit_test (what_is_done_is_given_up),
    cmocka_unit_test (a_hundred_kilometres), cmocka_unit_test (a_haul_is_given_up),
  };
  return cmocka_run_group_tests_name ("dive_long", tests, NULL, NULL);
}
