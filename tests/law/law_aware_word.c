/* Homotopy classes as words: the rank theory says, nothing changed by moves and by tightening, what
   windings cannot see, what is not decided.

   1e4 random moves in each scene, 1e6 with BIGHT_LONG=1 in the environment.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "aware/shadow_job.h"
#include "aware/tietze.h"
#include "aware/turns.h"
#include "testbed/aware_cases.h"

#define CORE 0.005

typedef struct rig
{
  stage g;
  bt__graph graph;
  bt__shadow *shadow;
  bt__shadow_report report;
  bt__taut *taut;
  bt__string *s;
  bt__count count;
  bt_vec3 p[CASE_NODES];
} rig;

static rig r;

static int
set_up (void **state)
{
  (void)state;
  r.s = calloc (1, bt__string_size (CASE_NODES));
  if (!r.s || bt__taut_new (CASE_NODES, &r.taut, NULL))
    return 1;
  r.s->room = CASE_NODES;
  return 0;
}

static int
tear_down (void **state)
{
  (void)state;
  stage_clear (&r.g);
  free (r.s);
  bt__taut_free (r.taut);
  bt__shadow_free (r.shadow);
  return 0;
}

/* Make the words of the scene.  */
static void
read_scene (double jitter, int all_boundary)
{
  bt_error error;
  bt__graph_config config = { .scene = r.g.scene, .surface = 0, .gap = 0.01 };
  bt__shadow_config how = { .jitter = jitter, .tries = 24 };
  bt__shadow_free (r.shadow);
  r.shadow = NULL;
  if (bt__graph_new (&config, &r.graph, &error))
    fail_msg ("%s", error.text);
  if (all_boundary)
    memset (r.graph.boundary, 1, r.graph.vertices);
  uint32_t rank = 0;
  if (all_boundary)
    {
      bt__graph whole;
      assert_int_equal (bt__graph_new (&config, &whole, NULL), BT_OK);
      rank = bt__graph_rank (&whole);
      bt__graph_free (&whole);
    }
  if (bt__shadow_new (&r.graph, &how, &r.shadow, &error))
    fail_msg ("%s", error.text);
  r.report = r.shadow->report;
  if (all_boundary)
    r.report.expected = rank;
  bt__graph_free (&r.graph);
}

static void
word_of (const bt_vec3 *p, uint32_t n, bt__word *out)
{
  memset (out, 0xa5, sizeof *out);
  bt__shadow_word (r.shadow, p, n, out);
  assert_false (out->lost);
}

/* Move nodes of PATHS lines at random, MOVES in all that succeed; return the lines whose word
   changed.  */
static int
changed_by_moves (dice *d, int paths, long moves)
{
  int changed = 0;
  for (int k = 0; k < paths; k++)
    {
      uint32_t n = draw_line (&r.g, d, 8, 0.1, 0.6, r.p);
      bt__word before, after;
      word_of (r.p, n, &before);
      for (long i = 0, tries = 0; i < moves / paths && tries < 20 * moves; tries++)
        i += move_node (&r.g, d, 0.5, r.p, 1 + (uint32_t)dice_below (d, (int)n - 2));
      word_of (r.p, n, &after);
      changed += !is_same_word (&before, &after);
    }
  return changed;
}

static long
many (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 1000000 : 10000;
}

static void
ranks (void **state)
{
  static const uint32_t rank[] = { 6, 1, 3 };
  (void)state;
  for (int scene = 0; scene < 6; scene++)
    for (uint64_t seed = 1; seed <= 3; seed++)
      {
        dice d = dice_new (seed);
        draw_skeleton (&r.g, scene, &d);
        read_scene (0.2, 0);
        print_message ("# scene %d: rank %u, expected %u, leftover %u, crossings %u, longest %u\n",
                       scene, r.report.rank, r.report.expected, r.report.leftover,
                       r.report.crossings, r.report.longest);
        assert_true (r.report.decided);
        assert_int_equal (r.report.rank, r.report.expected);
        if (scene < 3)
          assert_int_equal (r.report.rank, rank[scene]);
      }
}

static void
moves_keep_words (void **state)
{
  (void)state;
  for (int scene = 0; scene < 6; scene++)
    {
      dice d = dice_new (10 + (uint64_t)scene);
      draw_skeleton (&r.g, scene, &d);
      read_scene (0.2, 0);
      assert_int_equal (changed_by_moves (&d, 20, many ()), 0);
    }
}

/* Tightening, and following the end instead, keep the word.  */
static void
tightening_keeps_words (void **state)
{
  int wound = 0;
  (void)state;
  for (uint64_t seed = 0; seed < 30; seed++)
    {
      dice d = dice_new (50 + seed);
      draw_skeleton (&r.g, (int)(seed % 6), &d);
      read_scene (0.2, 0);
      bt__taut_config config
          = { .scene = r.g.scene, .core = CORE, .want = CORE, .mesh = 0.6, .margin = 0.4 };
      uint32_t n = draw_line (&r.g, &d, 12, 0.35, 0.5, r.p);
      bt__word before, after, straight;
      word_of (r.p, n, &before);
      bt__string_lay (r.s, r.p, n);
      bt__taut_relax (r.taut, &config, r.s, 400, &r.count);
      word_of (r.s->x, r.s->n, &after);
      assert_true (is_same_word (&before, &after));
      bt_vec3 line[2] = { r.p[0], r.p[n - 1] };
      word_of (line, 2, &straight);
      wound += !is_same_word (&before, &straight);
      bt__string_lay (r.s, r.p, 2);
      for (uint32_t i = 2; i < n; i++)
        for (int k = 1; k <= 10; k++)
          {
            bt_vec3 to = bt__axpy (r.p[i - 1], k / 10.0, bt__sub (r.p[i], r.p[i - 1]));
            assert_true (bt__taut_step (r.taut, &config, r.s, r.p[0], to, 2, &r.count));
          }
      word_of (r.s->x, r.s->n, &after);
      assert_true (is_same_word (&before, &after));
      assert_true (way_clearance (&config, r.s->x, r.s->n, 1, &r.count) >= CORE);
    }
  print_message ("# %d of 30 lines were wound\n", wound);
  assert_true (wound > 12);
}

/* ---- What windings do not see ---- */

/* a b a^-1 b^-1 about two piles: no winding, four letters; and it can be tightened.  */
static void
commutator_weave (void **state)
{
  /* Round the left pile, the right one, back round both.  */
  enum
  {
    TURN = 24
  };
  bt_vec3 way[4 * TURN + 2];
  int n = 0;
  (void)state;
  stage_clear (&r.g);
  stage_cylinder (&r.g, bt__vec (-3, 0, 2), bt__vec (-3, 0, -21), 0.4);
  stage_cylinder (&r.g, bt__vec (3, 0, 2), bt__vec (3, 0, -21), 0.4);
  bt__obstacle *bed = r.g.o + r.g.n++;
  *bed = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, -20 } };
  assert_true (stage_make (&r.g));
  read_scene (0.2, 0);
  assert_int_equal (r.report.rank, 2);
  static const int pile[4] = { 0, 1, 0, 1 }, sense[4] = { 1, 1, -1, -1 };
  way[n++] = bt__vec (0, -8, -15);
  for (int k = 0; k < 4; k++)
    for (int i = 0; i < TURN; i++)
      {
        double u = (double)i / (TURN - 1), w = 2 * BT__PI * u * sense[k];
        double c = pile[k] ? 3 : -3, from = pile[k] ? BT__PI : 0;
        double z = -15 + 2 * (k + u);
        way[n++] = bt__vec (c + 2.5 * cos (from + w), 2.5 * sin (from + w), z);
      }
  way[n++] = bt__vec (0, 8, -6);
  uint32_t m = refine (way, (uint32_t)n, 0.4, r.p);
  bt__word weave, line, relative;
  bt_vec3 straight[2] = { way[0], way[n - 1] };
  word_of (r.p, m, &weave);
  word_of (straight, 2, &line);
  bt__word_relative (&weave, &line, &relative);
  assert_int_equal (relative.n, 4);
  assert_true (relative.decided);
  assert_int_equal (relative.letter[0], -relative.letter[2]);
  assert_int_equal (relative.letter[1], -relative.letter[3]);
  assert_int_not_equal (bt__shadow_object (r.shadow, relative.letter[0]),
                        bt__shadow_object (r.shadow, relative.letter[1]));
  for (uint32_t i = 0; i < 2; i++)
    {
      bt__axis axis;
      assert_true (bt__axis_of (r.g.o + i, &axis));
      double turns = bt__turns (&axis, r.p, m) - bt__turns (&axis, straight, 2);
      assert_true (fabs (turns) < 1e-12);
      assert_int_equal (bt__winding (&axis, r.p, m), 0);
    }
  bt__taut_config config
      = { .scene = r.g.scene, .core = CORE, .want = CORE, .mesh = 0.3, .margin = 0.4 };
  bt__string_lay (r.s, r.p, m);
  bt__taut_relax (r.taut, &config, r.s, 2000, &r.count);
  bt__word tight;
  word_of (r.s->x, r.s->n, &tight);
  assert_true (is_same_word (&tight, &weave));
  assert_true (r.s->length > 1.4 * bt__distance (straight[0], straight[1]));
}

/* A turn about a pile is one letter for each, of that pile.  */
static void
turns_are_letters (void **state)
{
  dice d = dice_new (77);
  (void)state;
  draw_piles (&r.g, &d, 4);
  read_scene (0.2, 0);
  for (uint32_t o = 1; o < r.g.n; o++)
    for (int turns = -3; turns <= 3; turns++)
      {
        bt_vec3 c = r.g.o[o].shape.cylinder.centre;
        double off = r.g.o[o].shape.cylinder.radius + 0.01;
        for (int i = 0; i <= 200; i++)
          {
            double w = 2 * BT__PI * turns * i / 200;
            r.p[i] = bt__vec (c.x + off * cos (w), c.y - off * sin (w), -18 + 0.05 * i);
          }
        bt__word word;
        word_of (r.p, 201, &word);
        assert_int_equal (word.n, abs (turns));
        for (uint32_t i = 0; i < word.n; i++)
          assert_int_equal (bt__shadow_object (r.shadow, word.letter[i]), o);
        bt__axis axis;
        bt__axis_of (r.g.o + o, &axis);
        assert_int_equal (bt__winding (&axis, r.p, 201), turns);
      }
}

/* ---- What is not decided ---- */

static void
knotted_obstacles_are_flagged (void **state)
{
  static void (*const draws[]) (stage *) = { draw_hopf, draw_borromean, draw_trefoil };
  static const uint32_t crossings[] = { 2, 6, 3 };
  (void)state;
  for (int i = 0; i < 3; i++)
    {
      draws[i](&r.g);
      read_scene (0.2, 0);
      print_message ("# rank %u, leftover %u, crossings %u\n", r.report.rank, r.report.leftover,
                     r.report.crossings);
      assert_true (r.report.leftover > 0);
      assert_false (r.report.decided);
      assert_true (r.report.crossings >= crossings[i]);
      bt__word word;
      dice d = dice_new (4);
      uint32_t n = draw_line (&r.g, &d, 6, 0.2, 0.5, r.p);
      word_of (r.p, n, &word);
      assert_false (word.decided);
    }
}

/* Two rings side by side, not linked: free all the same.  */
static void
unlinked_rings_are_free (void **state)
{
  (void)state;
  draw_hopf (&r.g);
  stage g = r.g;
  stage_clear (&r.g);
  for (uint32_t i = 0; i < g.n; i++)
    {
      bt__capsule c = g.o[i].shape.capsule;
      bt_vec3 by = bt__vec (i < g.n / 2 ? 0 : 3.5, 0, 0);
      stage_capsule (&r.g, bt__add (c.a, by), bt__add (c.b, by), c.radius);
    }
  assert_true (stage_make (&r.g));
  read_scene (0.2, 0);
  assert_true (r.report.decided);
  assert_int_equal (r.report.rank, 2);
}

/* Boxes and balls hold nothing; a beam over two boxes makes a gate; a pipe lying down holds
   nothing; a mesh that is not ground is not described.  */
static void
what_holds (void **state)
{
  (void)state;
  stage_clear (&r.g);
  stage_box (&r.g, bt__vec (-3, 0, -19), bt__vec (1, 1, 1));
  stage_box (&r.g, bt__vec (3, 0, -19), bt__vec (1, 1, 1));
  stage_sphere (&r.g, bt__vec (0, 6, -10), 1);
  stage_capsule (&r.g, bt__vec (-9, 8, -19.9), bt__vec (9, 8, -19.9), 0.1);
  bt__obstacle *bed = r.g.o + r.g.n++;
  *bed = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, -20 } };
  assert_true (stage_make (&r.g));
  read_scene (0.2, 0);
  assert_true (r.report.decided);
  assert_int_equal (r.report.rank, 0);
  stage_capsule (&r.g, bt__vec (-3, 0, -17.9), bt__vec (3, 0, -17.9), 0.15);
  bt__scene_free (r.g.scene);
  assert_true (stage_make (&r.g));
  read_scene (0.2, 0);
  assert_true (r.report.decided);
  assert_int_equal (r.report.rank, 1);
  bt_vec3 under[2] = { { 0, -5, -19 }, { 0, 5, -19 } },
          over[3] = { { 0, -5, -19 }, { 0, 0, -15 }, { 0, 5, -19 } };
  bt__word a, b;
  word_of (under, 2, &a);
  word_of (over, 3, &b);
  assert_int_equal (a.n + b.n, 1);
}

/* ---- Values ---- */

static void
words_reduce (void **state)
{
  static const int32_t letters[] = { 1, 2, -2, 3, -3, -1, 5 };
  bt__word a, b, c;
  (void)state;
  bt__word_begin (&a, 7, 1);
  bt__word_add (&a, letters, 7, 0);
  bt__word_end (&a);
  assert_true (a.n == 1 && a.letter[0] == 5);
  bt__word_relative (&a, &a, &b);
  assert_true (b.n == 0 && !b.lost);
  bt__word_begin (&c, 8, 1);
  bt__word_add (&c, letters + 6, 1, 0);
  bt__word_end (&c);
  assert_false (is_same_word (&a, &c)); /* another world */
  bt__word_relative (&a, &c, &b);
  assert_true (b.lost);
  for (int i = 0; i < 1000; i++)
    bt__word_add (&c, letters, 2, 0);
  assert_true (c.lost && !is_same_word (&c, &c));
}

/* a b a^-1 b^-1 is left over; with a b^-1 it is not, and b is a.  */
static void
groups_simplify (void **state)
{
  static const int32_t torus[] = { 1, 2, -1, -2 }, same[] = { 1, -2 }, three[] = { 3, 1, 1 };
  bt__group g;
  (void)state;
  bt__group_begin (&g, 3);
  bt__group_relate (&g, torus, 4);
  bt__group_relate (&g, three, 3);
  assert_int_equal (bt__group_simplify (&g, NULL), BT_OK);
  assert_true (g.rank == 2 && g.leftover == 1);
  assert_true (g.is[2].n == 2 && g.is[2].at[0] == -1 && g.is[2].at[1] == -1);
  bt__group_free (&g);
  bt__group_begin (&g, 2);
  bt__group_relate (&g, torus, 4);
  bt__group_relate (&g, same, 2);
  assert_int_equal (bt__group_simplify (&g, NULL), BT_OK);
  assert_true (g.rank == 1 && g.leftover == 0 && g.is[0].at[0] == g.is[1].at[0]);
  bt__group_free (&g);
}

/* ---- Mutants ---- */

/* Without jitter the level members of a jacket lie over each other: words change, and it shows.  */
static void
mutant_without_general_position (void **state)
{
  int caught = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 4; seed++)
    {
      dice d = dice_new (seed);
      draw_jacket (&r.g, &d, 3);
      read_scene (0, 0);
      caught += !r.report.decided || changed_by_moves (&d, 10, 3000) > 0;
    }
  print_message ("# without jitter: %d of 4 caught\n", caught);
  assert_int_equal (caught, 4);
}

/* Without the relations of vertices words change though nothing is left over: the rank tells.  */
static void
mutant_without_vertex_relations (void **state)
{
  dice d = dice_new (2);
  (void)state;
  draw_jacket (&r.g, &d, 2);
  read_scene (0.2, 1);
  assert_int_equal (r.report.leftover, 0);
  assert_true (r.report.rank > r.report.expected);
  int changed = changed_by_moves (&d, 10, 20000);
  print_message ("# without vertex relations: rank %u of %u, %d of 10 words changed\n",
                 r.report.rank, r.report.expected, changed);
  assert_true (changed > 2);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (words_reduce),
                                      cmocka_unit_test (groups_simplify),
                                      cmocka_unit_test (ranks),
                                      cmocka_unit_test (turns_are_letters),
                                      cmocka_unit_test (moves_keep_words),
                                      cmocka_unit_test (tightening_keeps_words),
                                      cmocka_unit_test (commutator_weave),
                                      cmocka_unit_test (knotted_obstacles_are_flagged),
                                      cmocka_unit_test (unlinked_rings_are_free),
                                      cmocka_unit_test (what_holds),
                                      cmocka_unit_test (mutant_without_general_position),
                                      cmocka_unit_test (mutant_without_vertex_relations) };
  return cmocka_run_group_tests_name ("aware word", tests, set_up, tear_down);
}
