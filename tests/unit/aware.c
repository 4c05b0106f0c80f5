/* The watch over a dive: answers of the present state alone, whoever asked before; forks that share
   what is of the world; switches, movers and winches that change what the answers are of.

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

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_obstacle_def obstacle[3];
  double track[10];
} scene;

enum
{
  POST,
  BALL,
  CART,
  WAY_MAX = 2000
};

static void
add_post (scene *s, const char *name, double x, double y)
{
  bt_obstacle_def *def = &s->obstacle[s->world.n_obstacles++];
  bt_def_init (bt_head_find ("cylinder"), def);
  bt_def_set_name (def->name, name, NULL);
  def->from = (bt_vec3){ x, y, 1 };
  def->to = (bt_vec3){ x, y, -60 };
  def->radius = 0.4;
}

static void
add_ball (scene *s)
{
  bt_obstacle_def *def = &s->obstacle[s->world.n_obstacles++];
  bt_def_init (bt_head_find ("sphere"), def);
  bt_def_set_name (def->name, "ball", NULL);
  def->at = (bt_vec3){ 0, 12, -5 };
  def->radius = 1;
}

/* A post that goes to and fro.  */
static void
add_cart (scene *s)
{
  add_post (s, "cart", 20, 0);
  for (int k = 0; k < 2; k++)
    {
      double *row = s->track + 5 * k;
      row[0] = 30 * k;
      row[1] = 20;
      row[2] = 4 * k;
      row[3] = -20;
    }
  s->obstacle[CART].track = (bt_rows){ s->track, 2, 5 };
}

/* A line laid once round the post from (-6 -6 -5) to (3 -3 -5), clockwise from above.  */
static bt_dive *
begin (void)
{
  static const bt_vec3 via[3] = { { -3, 3, -5 }, { 3, 3, -5 }, { 3.5, 0, -5 } };
  scene s;
  bt_model *model;
  bt_dive *dive;
  bt_error error;
  memset (&s, 0, sizeof s);
  bt_def_init (bt_head_find ("sea"), &s.world.sea);
  bt_def_init (bt_head_find ("rov"), &s.vehicle);
  bt_def_init (bt_head_find ("tether"), &s.tether);
  bt_def_set_name (s.vehicle.name, "minnow", NULL);
  bt_def_set_name (s.tether.name, "line", NULL);
  bt_def_set_part (bt_field_find (bt_head_find ("tether"), "to"), &s.tether, "minnow", NULL);
  s.world.sea.depth = 60;
  s.vehicle.at = (bt_vec3){ 3, -3, -5 };
  s.tether.from.at = (bt_vec3){ -6, -6, -5 };
  s.tether.length = 32;
  s.tether.props.model = BT_MODEL_DYNAMIC;
  s.tether.props.wet_weight = 0;
  s.tether.via.n = 3;
  memcpy (s.tether.via.at, via, sizeof via);
  add_post (&s, "post", 0, 0);
  add_ball (&s);
  add_cart (&s);
  s.world.vehicles = &s.vehicle;
  s.world.n_vehicles = 1;
  s.world.tethers = &s.tether;
  s.world.n_tethers = 1;
  s.world.obstacles = s.obstacle;
  if (bt_model_new (&s.world, &model, &error) != BT_OK)
    fail_msg ("%s", error.text);
  if (bt_dive_new (model, NULL, NULL, &dive, &error) != BT_OK)
    fail_msg ("%s", error.text);
  bt_model_release (model);
  return dive;
}

static void
step (bt_dive *dive, int n)
{
  for (int k = 0; k < n; k++)
    assert_int_equal (bt_dive_step (dive, NULL), BT_OK);
}

/* Everything that may be asked.  */
typedef struct answers
{
  double taut, free, turns, wrap, lock;
  int winding, knotted;
  bt_foul foul;
  bt_class class;
  bt_prospect prospect;
  bt_route home, loop;
  bt_vec3 way[WAY_MAX];
  int n;
  bt_foresight ahead[16];
} answers;

static answers *
ask (const bt_dive *dive)
{
  answers *a = calloc (1, sizeof *a);
  int n = 0;
  assert_non_null (a);
  assert_int_equal (bt_tether_unwind_plan (dive, 0, a->way, WAY_MAX, &a->n, &a->loop, NULL), BT_OK);
  assert_int_equal (bt_tether_free_length (dive, 0, &a->free, NULL), BT_OK);
  assert_int_equal (bt_tether_taut_length (dive, 0, &a->taut, NULL), BT_OK);
  assert_int_equal (bt_tether_turns (dive, 0, POST, &a->turns, NULL), BT_OK);
  assert_int_equal (bt_tether_winding (dive, 0, POST, &a->winding, NULL), BT_OK);
  assert_int_equal (bt_tether_wrap_angle (dive, 0, POST, &a->wrap, NULL), BT_OK);
  assert_int_equal (bt_tether_capstan_lock (dive, 0, &a->lock, NULL), BT_OK);
  assert_int_equal (bt_tether_class (dive, 0, &a->class, NULL), BT_OK);
  assert_int_equal (bt_tether_knotted (dive, 0, &a->knotted, NULL), BT_OK);
  assert_int_equal (bt_tether_fouled (dive, 0, &a->foul, NULL), BT_OK);
  assert_int_equal (bt_tether_prospect (dive, 0, 150, &a->prospect, NULL), BT_OK);
  assert_int_equal (bt_tether_way_home (dive, 0, a->way, WAY_MAX, &n, &a->home, NULL), BT_OK);
  assert_int_equal (bt_tether_foresee (dive, 0, 20, a->ahead, 16, &n, NULL), BT_OK);
  return a;
}

static int
is_same_route (const bt_route *a, const bt_route *b)
{
  return a->needed == b->needed && a->feasible == b->feasible && a->length == b->length
         && a->clearance == b->clearance && a->longest == b->longest && a->left == b->left;
}

static int
is_same (const answers *a, const answers *b)
{
  return a->taut == b->taut && a->free == b->free && a->turns == b->turns && a->wrap == b->wrap
         && a->lock == b->lock && a->winding == b->winding && a->knotted == b->knotted
         && a->foul == b->foul && bt_class_equal (&a->class, &b->class)
         && a->prospect.reason == b->prospect.reason && a->prospect.pull == b->prospect.pull
         && is_same_route (&a->home, &b->home) && is_same_route (&a->loop, &b->loop)
         && memcmp (a->way, b->way, sizeof a->way) == 0
         && memcmp (a->ahead, b->ahead, sizeof a->ahead) == 0;
}

static void
same (const bt_dive *dive, const answers *wanted)
{
  answers *a = ask (dive);
  assert_true (is_same (a, wanted));
  free (a);
}

static void
of_the_state_alone (void **state)
{
  bt_dive *dive = begin (), *fork;
  (void)state;
  step (dive, 30);
  void *kept = malloc (bt_dive_state_size (dive));
  answers *a = ask (dive);
  assert_true (a->winding == 1 && a->foul == BT_FOUL_WOUND && a->class.letters == 1);
  assert_true (a->class.object[0] == POST && a->class.decided && !a->knotted);
  assert_true (a->taut > a->free + 1 && a->lock > 1 && a->loop.needed && a->loop.feasible);
  same (dive, a);
  assert_int_equal (bt_dive_fork (dive, &fork, NULL), BT_OK);
  bt_dive_save (dive, kept);
  double sway[4] = { 0.5, 0.5, NAN, 0.2 };
  assert_int_equal (bt_dive_do (dive, BT_OP_DRIVE, 0, sway, 4, NULL), BT_OK);
  step (dive, 120);
  answers *later = ask (dive);
  assert_false (is_same (a, later));
  same (fork, a); /* it shares the charts, not the gaze */
  assert_int_equal (bt_dive_restore (dive, kept, bt_dive_state_size (dive), NULL), BT_OK);
  same (dive, a);
  bt_dive_free (dive);
  same (fork, a); /* the charts outlive who made them */
  free (kept);
  free (a);
  free (later);
  bt_dive_free (fork);
}

static void
work_only_when_asked (void **state)
{
  bt_dive *dive = begin ();
  bt_profile p;
  double length;
  (void)state;
  step (dive, 29);
  bt_dive_profile (dive, &p);
  assert_true (p.strings == 0 && p.charts == 0 && p.words == 0);
  for (int k = 0; k < 3; k++)
    bt_tether_taut_length (dive, 0, &length, NULL);
  bt_dive_profile (dive, &p);
  assert_true (p.strings == 1 && p.charts == 0 && p.words == 0);
  free (ask (dive));
  step (dive, 1);
  free (ask (dive));
  bt_dive_profile (dive, &p);
  assert_true (p.strings == 2 && p.charts == 1 && p.words == 2);
  bt_dive_free (dive);
}

/* Switched off, the post holds nothing and nothing is wound about it; turns are geometry and stay.  */
static void
switches_count (void **state)
{
  bt_dive *dive = begin ();
  double off[3] = { BT_PART_TETHER, POST, 0 }, before, after, chord, turns, turns_after;
  bt_class class;
  int winding;
  (void)state;
  bt_tether_taut_length (dive, 0, &before, NULL);
  bt_tether_turns (dive, 0, POST, &turns, NULL);
  bt_tether_winding (dive, 0, POST, &winding, NULL);
  assert_int_equal (winding, 1);
  assert_int_equal (bt_dive_do (dive, BT_OP_COLLIDE, 0, off, 3, NULL), BT_OK);
  bt_tether_taut_length (dive, 0, &after, NULL);
  bt_tether_class (dive, 0, &class, NULL);
  bt_tether_winding (dive, 0, POST, &winding, NULL);
  chord = hypot (9, 3);
  assert_true (before > chord + 3 && fabs (after - chord) < 1e-3);
  bt_tether_turns (dive, 0, POST, &turns_after, NULL);
  assert_true (class.letters == 0 && winding == 0 && turns_after == turns && turns > 0.5);
  bt_dive_free (dive);
}

/* What moves has turns about where it is now, and no part in strings.  */
static void
movers_move (void **state)
{
  bt_dive *dive = begin ();
  double before, after;
  (void)state;
  assert_int_equal (bt_tether_turns (dive, 0, CART, &before, NULL), BT_OK);
  step (dive, 600);
  assert_int_equal (bt_tether_turns (dive, 0, CART, &after, NULL), BT_OK);
  assert_true (fabs (after - before) > 1e-3 && fabs (after) < 0.5);
  bt_dive_free (dive);
}

/* The string that is led stays near the one solved anew.  */
static void
led_along (void **state)
{
  bt_dive *dive = begin ();
  double sway[4] = { 0.3, 0.3, NAN, NAN }, length;
  bt_follow follow;
  (void)state;
  assert_int_equal (bt_dive_do (dive, BT_OP_DRIVE, 0, sway, 4, NULL), BT_OK);
  for (int k = 0; k < 200; k++)
    {
      step (dive, 1);
      assert_int_equal (bt_tether_follow (dive, 0, &follow, NULL), BT_OK);
    }
  bt_tether_taut_length (dive, 0, &length, NULL);
  assert_true (fabs (follow.length - length) < 0.01 * length && follow.nodes > 2);
  bt_dive_free (dive);
}

static void
refused (void **state)
{
  bt_dive *dive = begin ();
  double x;
  int n;
  bt_haul haul;
  bt_prospect prospect;
  bt_foresight f;
  (void)state;
  assert_int_equal (bt_tether_taut_length (dive, 1, &x, NULL), BT_ERR_NAME);
  assert_int_equal (bt_tether_turns (dive, 0, 3, &x, NULL), BT_ERR_NAME);
  assert_int_equal (bt_tether_wrap_angle (dive, 0, 9, &x, NULL), BT_ERR_NAME);
  assert_int_equal (bt_tether_prospect (dive, 0, NAN, &prospect, NULL), BT_ERR_DOMAIN);
  assert_int_equal (bt_tether_haul (dive, 0, 0, 150, 10, &haul, NULL), BT_ERR_DOMAIN);
  assert_int_equal (bt_tether_foresee (dive, 0, -1, &f, 1, &n, NULL), BT_ERR_DOMAIN);
  bt_dive_free (dive);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (of_the_state_alone), cmocka_unit_test (work_only_when_asked),
    cmocka_unit_test (switches_count),     cmocka_unit_test (movers_move),
    cmocka_unit_test (led_along),          cmocka_unit_test (refused),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
