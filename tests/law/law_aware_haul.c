/* The instant rule of hauling, the way home, the loop that unwinds.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/aware.h>

#include "aware/haul.h"
#include "aware/shadow.h"
#include "testbed/aware_cases.h"
#include "near.h"

#define CORE 0.005

typedef struct rig
{
  stage g;
  bt__taut *taut;
  bt__string *s, *home, *loop, *copy, *way;
  bt__free *tree;
  bt__shadow *shadow;
  bt__taut_config config;
  bt__count count;
  bt__corner hold[CASE_NODES];
  bt_vec3 p[CASE_NODES];
} rig;

static rig r;

static const bt__haul_body body = { .radius = 0.3,
                                    .friction = 0.3,
                                    .least = 20,
                                    .drag1 = 60,
                                    .drag2 = 100,
                                    .winch = 150,
                                    .grip = BT_HAUL_GRIP };

static bt__string *
new_string (void)
{
  bt__string *s = calloc (1, bt__string_size (CASE_NODES));
  if (s)
    s->room = CASE_NODES;
  return s;
}

static int
set_up (void **state)
{
  (void)state;
  r.s = new_string ();
  r.home = new_string ();
  r.loop = new_string ();
  r.copy = new_string ();
  r.way = new_string ();
  return !r.s || !r.home || !r.loop || !r.copy || !r.way
         || bt__taut_new (CASE_NODES, &r.taut, NULL) != BT_OK;
}

static int
tear_down (void **state)
{
  (void)state;
  stage_clear (&r.g);
  free (r.s);
  free (r.home);
  free (r.loop);
  free (r.copy);
  free (r.way);
  bt__taut_free (r.taut);
  bt__free_free (r.tree);
  bt__shadow_free (r.shadow);
  return 0;
}

/* Relax the line of N points in the scene; the prospect of hauling it.  */
static bt__prospect
prospect (const bt_vec3 *line, uint32_t n, const bt__haul_body *b)
{
  r.config = (bt__taut_config){
    .scene = r.g.scene, .core = CORE, .want = CORE, .mesh = 0.4, .margin = 0.4
  };
  n = refine (line, n, 0.3, r.p);
  bt__string_lay (r.s, r.p, n);
  bt__taut_relax (r.taut, &r.config, r.s, 1000, &r.count);
  bt__holds h = { r.hold, 0, CASE_NODES, 0 };
  bt__holds_find (r.g.scene, NULL, r.s->x, r.s->n, CORE, 0.05, &h, &r.count);
  return bt__haul_prospect (&h, b);
}

/* A line bent by a right angle round an upright member of RADIUS.  */
static bt__prospect
round_a_member (double radius, const bt__haul_body *b)
{
  bt_vec3 line[3] = { { -5, -5, -10 }, { 2, 2, -10 }, { -5, 9, -10 } };
  line[1] = bt__vec (3, 2, -10);
  stage_clear (&r.g);
  stage_cylinder (&r.g, bt__vec (0, 2, 20), bt__vec (0, 2, -40), radius);
  assert_true (stage_make (&r.g));
  return prospect (line, 3, b);
}

static void
clear_of_everything (void **state)
{
  bt_vec3 line[2] = { { -5, -5, -10 }, { -5, 9, -10 } };
  bt__haul_body heavy = body;
  (void)state;
  round_a_member (0.2, &body);
  bt__prospect p = prospect (line, 2, &body);
  assert_true (p.answer == BT__YES && p.reason == BT__HAUL_CLEAR && p.object == UINT32_MAX);
  near ("lock", p.lock, 1, 0);
  near ("pull", p.pull, 150, 0);
  near ("drag at that speed", 60 * p.speed + 100 * p.speed * p.speed, 150, 1e-9);
  heavy.weight = 30;
  p = prospect (line, 2, &heavy);
  assert_true (p.answer == BT__UNSURE && p.reason == BT__HAUL_CLEAR);
  heavy.weight = -200;
  assert_true (prospect (line, 2, &heavy).answer == BT__NO);
}

/* A ball of 0.3 m with friction 0.3 hangs on any member thinner than 0.12 m, whatever the pull.  */
static void
hangs_on_thin_members (void **state)
{
  bt__haul_body strong = body;
  (void)state;
  strong.winch = 1e9;
  for (double radius = 0.02; radius < 0.118; radius += 0.02)
    {
      bt__prospect p = round_a_member (radius, &strong);
      assert_true (p.answer == BT__UNSURE && p.reason == BT__HAUL_HUNG && p.object == 0);
      near ("where", p.s, hypot (5, 7), 0.3);
    }
  for (double radius = 0.16; radius < 1; radius += 0.2)
    assert_true (round_a_member (radius, &body).reason == BT__HAUL_CLEAR);
  /* A weight has to be lifted past it as well.  */
  strong = body;
  strong.weight = 25;
  assert_true (round_a_member (0.16, &strong).reason == BT__HAUL_HUNG);
}

static void
hangs_on_edges (void **state)
{
  bt_vec3 line[3] = { { -5, 0, -10 }, { 1, 0, -4 }, { 4, 0, -10 } };
  (void)state;
  stage_clear (&r.g);
  stage_box (&r.g, bt__vec (0, 0, -10), bt__vec (2, 30, 4));
  assert_true (stage_make (&r.g));
  line[1].z = -5;
  bt_vec3 over[4] = { line[0], { -2.2, 0, -5 }, { 2.2, 0, -5 }, line[2] };
  bt__prospect p = prospect (over, 4, &body);
  assert_true (p.reason == BT__HAUL_HUNG && p.object == 0 && p.answer == BT__UNSURE);
  /* The edge at the vehicle's side is met first.  */
  assert_true (p.s > 0.5 * r.s->length);
}

/* Two turns at friction 0.3: the winch's 150 N become 3.5.  */
static void
locked_by_turns (void **state)
{
  double exact;
  (void)state;
  uint32_t n = exact_case (EXACT_PILE, CORE, 100, &r.g, r.p, &exact);
  static bt_vec3 line[CASE_NODES];
  memcpy (line, r.p, n * sizeof *line);
  bt__prospect p = prospect (line, n, &body);
  assert_true (p.answer == BT__NO && p.reason == BT__HAUL_LOCKED && p.object == 0);
  near ("pull", p.pull, 150 / p.lock, 1e-9);
  assert_true (p.lock > 20 && p.lock < 50);
  bt__haul_body light = body;
  light.least = 1;
  assert_true (prospect (line, n, &light).answer == BT__UNSURE);
}

/* Between two boxes a hand apart the tether goes, the vehicle not.  */
static void
wedged_in_a_gap (void **state)
{
  bt_vec3 line[2] = { { 0, -6, -10 }, { 0, 6, -10 } };
  (void)state;
  for (int wide = 0; wide < 2; wide++)
    {
      double half = wide ? 0.5 : 0.15;
      stage_clear (&r.g);
      stage_box (&r.g, bt__vec (-3 - half, 0, -10), bt__vec (3, 1, 10));
      stage_box (&r.g, bt__vec (3 + half, 0, -10), bt__vec (3, 1, 10));
      assert_true (stage_make (&r.g));
      bt__prospect p = prospect (line, 2, &body);
      assert_true (p.reason == BT__HAUL_CLEAR);
      bt__route w = bt__way_home (r.taut, &r.config, r.s, body.radius + 0.02, r.home, &r.count);
      near ("clearance", w.clearance, wide ? 0.5 : 0.15, 0.01);
      bt__haul_wedge (&w, &body, &p);
      assert_int_equal (p.reason, wide ? BT__HAUL_CLEAR : BT__HAUL_WEDGED);
      assert_int_equal (p.answer, wide ? BT__YES : BT__UNSURE);
      near ("start of the way", bt__distance (r.home->x[0], line[1]), 0, 0);
      near ("end of it", bt__distance (r.home->x[r.home->n - 1], line[0]), 0, 0);
    }
}

/* The prospect of a line over the crossing of two bars, or over one of them, AWAY from its start.
 */
static bt__prospect
over_bars (int bars, double away)
{
  bt_vec3 line[3] = { { 0, -away, -10.3 }, { 0, 0, -9.74 }, { 0, 6, -10.3 } };
  stage_clear (&r.g);
  for (int k = 0; k < bars; k++)
    stage_capsule (&r.g, bt__vec (-3, 0, -10 - 3 * (1 - 2 * k)),
                   bt__vec (3, 0, -10 + 3 * (1 - 2 * k)), 0.25);
  assert_true (stage_make (&r.g));
  bt__prospect p = prospect (line, 3, &body);
  bt__haul_crotch (&r.config, r.s, &body, &p, &r.count);
  return p;
}

/* In the upper corner of two crossed bars the body wedges, over one it is drawn; not at home.  */
static void
wedged_in_a_corner (void **state)
{
  (void)state;
  bt__prospect p = over_bars (2, 6);
  assert_true (p.answer == BT__UNSURE && p.reason == BT__HAUL_WEDGED && p.object < 2);
  near ("where", p.s, 6, 0.7);
  assert_int_equal (over_bars (1, 6).reason, BT__HAUL_CLEAR);
  assert_int_equal (over_bars (2, 0.8).reason, BT__HAUL_CLEAR);
}

/* What is long hangs on a member that a ball as large slips past.  */
static void
hangs_by_its_longest_side (void **state)
{
  bt__haul_body longer = body;
  (void)state;
  assert_int_equal (round_a_member (0.2, &longer).reason, BT__HAUL_CLEAR);
  longer.reach = 0.2; /* less than its radius: that counts */
  assert_int_equal (round_a_member (0.2, &longer).reason, BT__HAUL_CLEAR);
  longer.reach = 0.6;
  assert_int_equal (round_a_member (0.2, &longer).reason, BT__HAUL_HUNG);
}

/* A block beside the vehicle, or beside the anchor, does not make the way home narrow; one on the
   way does.  */
static void
ends_of_a_way (void **state)
{
  bt_vec3 line[2] = { { 0, -6, -10 }, { 0, 6, -10 } };
  (void)state;
  for (int k = -1; k <= 1; k++)
    {
      stage_clear (&r.g);
      stage_box (&r.g, bt__vec (1.1, k ? 6.5 * k : 0, -10), bt__vec (1, k ? 0.7 : 6, 1));
      stage_box (&r.g, bt__vec (-1.1, k ? 6.5 * k : 0, -10), bt__vec (1, k ? 0.7 : 6, 1));
      assert_true (stage_make (&r.g));
      prospect (line, 2, &body);
      bt__route w = bt__way_home (r.taut, &r.config, r.s, 0.5, r.home, &r.count);
      if (k == 0)
        near ("between the blocks", w.clearance, 0.1, 0.01);
      else
        assert_true (w.clearance > 0.3);
    }
}

/* ---- Many scenes ---- */

static void
make_words (void)
{
  bt__graph graph;
  bt__graph_config config = { .scene = r.g.scene, .surface = 0, .gap = 0.01 };
  bt__shadow_config how = { .jitter = 0.2, .tries = 12 };
  bt__shadow_free (r.shadow);
  r.shadow = NULL;
  assert_int_equal (bt__graph_new (&config, &graph, NULL), BT_OK);
  assert_int_equal (bt__shadow_new (&graph, &how, &r.shadow, NULL), BT_OK);
  bt__graph_free (&graph);
}

static void
make_tree (bt_vec3 anchor)
{
  bt__free_config c = { r.g.scene, NULL, bt__vec (-18, -14, -20), bt__vec (18, 14, 0), 0.75, 0.03 };
  bt__free_free (r.tree);
  assert_int_equal (bt__free_new (&c, &r.tree, NULL), BT_OK);
  bt__free_plant (r.tree, anchor);
}

/* A scene, a string in it, its free way.  */
static void
draw (uint64_t seed)
{
  dice d = dice_new (seed);
  if (seed % 3 == 0)
    draw_piles (&r.g, &d, 6);
  else if (seed % 3 == 1)
    draw_jacket (&r.g, &d, 2);
  else
    draw_rings (&r.g, &d, 4);
  r.config = (bt__taut_config){
    .scene = r.g.scene, .core = CORE, .want = CORE, .mesh = 0.6, .margin = 0.4
  };
  uint32_t n = draw_line (&r.g, &d, 10, 0.4, 0.5, r.p);
  bt__string_lay (r.s, r.p, n);
  bt__taut_relax (r.taut, &r.config, r.s, 400, &r.count);
  make_words ();
  make_tree (r.p[0]);
  tight_free_length (r.tree, r.p[0], r.p[n - 1], 200, r.taut, &r.config, r.way, &r.count);
}

static void
word_of (const bt__string *s, bt__word *out)
{
  bt__shadow_word (r.shadow, s->x, s->n, out);
}

/* The way home is wide enough for the vehicle and of the tether's class.  */
static void
ways_home (void **state)
{
  int wide = 0;
  bt__word there, back, relative;
  (void)state;
  for (uint64_t seed = 1; seed <= 30; seed++)
    {
      draw (seed);
      bt__route w = bt__way_home (r.taut, &r.config, r.s, body.radius + 0.02, r.home, &r.count);
      wide += w.clearance > body.radius;
      assert_true (w.clearance >= CORE);
      word_of (r.s, &there);
      for (uint32_t i = 0; i < r.home->n / 2; i++)
        {
          bt_vec3 swap = r.home->x[i];
          r.home->x[i] = r.home->x[r.home->n - 1 - i];
          r.home->x[r.home->n - 1 - i] = swap;
        }
      word_of (r.home, &back);
      bt__word_relative (&there, &back, &relative);
      assert_int_equal (relative.n, 0);
    }
  print_message ("# %d of 30 ways home wide enough\n", wide);
  assert_true (wide >= 29);
}

/* Plans that call themselves feasible end in the free class, no longer than it is.  */
static void
unwinding (void **state)
{
  int needed = 0, feasible = 0;
  bt__word end, free_word;
  (void)state;
  for (uint64_t seed = 1; seed <= 30; seed++)
    {
      draw (seed);
      bt__word string;
      word_of (r.s, &string);
      word_of (r.way, &free_word);
      bt__unwind u = bt__unwind_plan (r.taut, &r.config, r.s, r.way, 0.45, 1.2 * r.s->length, 0.3,
                                      r.loop, r.copy, &r.count);
      if (!is_same_word (&string, &free_word))
        assert_true (u.needed); /* another class cannot be drawn to a point */
      needed += u.needed;
      feasible += u.feasible;
      if (!u.feasible)
        continue;
      word_of (r.copy, &end);
      assert_true (is_same_word (&end, &free_word));
      assert_true (u.left <= r.way->length + fmax (0.5, 0.02 * r.way->length));
      near ("back where it was", bt__distance (r.loop->x[0], r.loop->x[r.loop->n - 1]), 0, 0);
      /* With less paid out than the string needs on the way it is not.  */
      u = bt__unwind_plan (r.taut, &r.config, r.s, r.way, 0.45, u.longest - 1e-6, 0.3, r.loop,
                           r.copy, &r.count);
      assert_false (u.feasible);
    }
  print_message ("# %d plans, %d feasible\n", needed, feasible);
  assert_true (needed > 12 && feasible >= 0.9 * needed);
}

/* A full turn comes off by one loop round the pile, the other way.  */
static void
one_turn_off (void **state)
{
  (void)state;
  stage_clear (&r.g);
  stage_cylinder (&r.g, bt__vec (0, 0, 2), bt__vec (0, 0, -40), 0.5);
  assert_true (stage_make (&r.g));
  r.config = (bt__taut_config){
    .scene = r.g.scene, .core = CORE, .want = CORE, .mesh = 0.4, .margin = 0.4
  };
  for (int i = 0; i <= 60; i++)
    {
      double u = i / 60.0, w = BT__PI / 2 - 2.5 * BT__PI * u;
      r.p[i] = bt__vec (4 * cos (w), 4 * sin (w), -10 + 2 * u);
    }
  bt__string_lay (r.s, r.p, 61);
  bt__taut_relax (r.taut, &r.config, r.s, 400, &r.count);
  make_tree (r.p[0]);
  assert_true (isfinite (
      tight_free_length (r.tree, r.p[0], r.p[60], 200, r.taut, &r.config, r.way, &r.count)));
  bt__unwind u = bt__unwind_plan (r.taut, &r.config, r.s, r.way, 0.45, r.s->length + 5, 0.3, r.loop,
                                  r.copy, &r.count);
  assert_true (u.needed && u.feasible);
  near ("clear of the pile", u.way.clearance, 0.45, 0.03);
  /* Tangents to a circle of 0.95 and most of it.  */
  double rad = 0.95, tangents = 2 * sqrt (16 - rad * rad);
  near ("the loop", u.way.length, tangents + rad * (2 * BT__PI - 2 * acos (rad / 4)), 0.3);
  /* The string that is free needs nothing.  */
  u = bt__unwind_plan (r.taut, &r.config, r.way, r.way, 0.45, 100, 0.3, r.loop, r.copy, &r.count);
  assert_true (!u.needed && !u.feasible);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (clear_of_everything), cmocka_unit_test (hangs_on_thin_members),
          cmocka_unit_test (hangs_on_edges),      cmocka_unit_test (locked_by_turns),
          cmocka_unit_test (wedged_in_a_gap),     cmocka_unit_test (ways_home),
          cmocka_unit_test (wedged_in_a_corner),  cmocka_unit_test (hangs_by_its_longest_side),
          cmocka_unit_test (ends_of_a_way),       cmocka_unit_test (unwinding),
          cmocka_unit_test (one_turn_off) };
  return cmocka_run_group_tests_name ("aware haul", tests, set_up, tear_down);
}
