/* What a closed line is caught on: nothing where it can be drawn home, whole turns with their sign
   about what it cannot be drawn free of, the fewest that say so, and nothing else changed by what
   is far away or by a mirror.

   The words of homotopy classes, whose exponents sum up to the class in the first homology, are the
   judge.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "aware/caught.h"
#include "aware/shadow.h"
#include "testbed/aware_cases.h"

enum
{
  SCENES = 6,
  NUMBERS = 5, /* of the small graphs that are searched through */
  SPAN = 2     /* by so many either way */
};

typedef struct rig
{
  stage g;
  bt__graph graph;
  bt__shadow *shadow;
  bt_vec3 p[CASE_NODES], q[CASE_NODES];
} rig;

static rig r;

static int
tear_down (void **state)
{
  (void)state;
  stage_clear (&r.g);
  bt__graph_free (&r.graph);
  bt__shadow_free (r.shadow);
  return 0;
}

/* Make the graph of the scene, and with WORDS its words.  */
static void
read_scene (int words)
{
  bt_error error;
  bt__graph_config config = { .scene = r.g.scene, .surface = 0, .gap = 0.01 };
  bt__graph_free (&r.graph);
  bt__shadow_free (r.shadow);
  r.shadow = NULL;
  if (bt__graph_new (&config, &r.graph, &error))
    fail_msg ("%s", error.text);
  if (words
      && bt__shadow_new (&r.graph, &(bt__shadow_config){ .jitter = 0.2, .tries = 24 }, &r.shadow,
                         &error))
    fail_msg ("%s", error.text);
}

static bt__caught
caught (const bt_vec3 *p, uint32_t n, const bt_vec3 *q, uint32_t m)
{
  bt__caught c;
  assert_int_equal (bt__caught_new (&r.graph, &c, NULL), BT_OK);
  bt__caught_find (&c, p, n, q, m, NULL);
  return c;
}

/* How often all of the loops go about obstacle PLACE.  */
static int
about (const bt__caught *c, uint32_t place)
{
  int sum = 0;
  for (uint32_t e = 0; e < c->graph->edges; e++)
    sum += r.graph.object[e] == place ? c->loops[e] : 0;
  return sum;
}

static int
loops_in_all (const bt__caught *c)
{
  int sum = 0;
  for (uint32_t e = 0; e < c->graph->edges; e++)
    sum += abs (c->loops[e]);
  return sum;
}

/* ---- Zero where the class is ---- */

static void
what_can_be_drawn_home_is_not_caught (void **state)
{
  (void)state;
  for (int scene = 0; scene < SCENES; scene++)
    {
      dice d = dice_new (10 + (uint64_t)scene);
      draw_skeleton (&r.g, scene, &d);
      read_scene (0);
      for (int k = 0; k < 20; k++)
        {
          uint32_t n = draw_line (&r.g, &d, 8, 0.1, 0.6, r.p);
          memcpy (r.q, r.p, n * sizeof *r.q);
          for (int i = 0, tries = 0; i < 500 && tries < 20000; tries++)
            i += move_node (&r.g, &d, 0.5, r.q, 1 + (uint32_t)dice_below (&d, (int)n - 2));
          bt__caught c = caught (r.p, n, r.q, n);
          assert_false (c.any);
          bt__caught_free (&c);
        }
    }
}

/* True if the exponents of a letter of WORD do not sum up to zero.  */
static int
is_in_homology (const bt__word *word)
{
  for (uint32_t i = 0; i < word->n; i++)
    {
      int sum = 0;
      for (uint32_t k = 0; k < word->n; k++)
        sum += (word->letter[k] == word->letter[i]) - (word->letter[k] == -word->letter[i]);
      if (sum != 0)
        return 1;
    }
  return 0;
}

/* Two ways between the same two points: caught if and only if the words' exponents say so.  */
static void
agrees_with_words (void **state)
{
  int is = 0, is_not = 0, blind = 0;
  (void)state;
  for (int k = 0; k < 240; k++)
    {
      dice d = dice_new (100 + (uint64_t)k);
      draw_skeleton (&r.g, k % SCENES, &d);
      read_scene (1);
      bt_vec3 a = draw_point (&r.g, &d, 0.4), b = draw_point (&r.g, &d, 0.4);
      uint32_t n = draw_between (&r.g, &d, a, b, 6, 0.1, 0.6, r.p);
      uint32_t m = draw_between (&r.g, &d, a, b, 2, 0.1, 0.6, r.q);
      bt__word one, other, relative;
      bt__shadow_word (r.shadow, r.p, n, &one);
      bt__shadow_word (r.shadow, r.q, m, &other);
      bt__word_relative (&one, &other, &relative);
      assert_true (relative.decided && !relative.lost);
      bt__caught c = caught (r.p, n, r.q, m);
      assert_int_equal (c.any, is_in_homology (&relative));
      is += c.any;
      is_not += !c.any;
      blind += !c.any && relative.n > 0;
      bt__caught_free (&c);
    }
  print_message ("# caught %d, not %d, of which %d in commutators alone\n", is, is_not, blind);
  assert_true (is > 40 && is_not > 40);
}

/* ---- Whole, with a sign ---- */

/* Once and again round a pile, at its side or with other piles about: that pile alone.  */
static void
turns_are_loops (void **state)
{
  dice d = dice_new (77);
  (void)state;
  draw_piles (&r.g, &d, 6);
  read_scene (0);
  for (uint32_t o = 1; o < r.g.n; o++)
    for (int turns = -3; turns <= 3; turns++)
      {
        bt_vec3 c = r.g.o[o].shape.cylinder.centre;
        double off = r.g.o[o].shape.cylinder.radius + 0.01;
        int down = r.g.o[o].shape.cylinder.axis.z < 0;
        for (int i = 0; i <= 200; i++)
          {
            double w = 2 * BT__PI * turns * i / 200;
            r.p[i] = bt__vec (c.x + off * cos (w), c.y - off * sin (w), -18 + 0.05 * i);
          }
        r.q[0] = r.p[0];
        r.q[1] = r.p[200];
        bt__caught got = caught (r.p, 201, r.q, 2);
        assert_int_equal (about (&got, o), down ? turns : -turns);
        assert_int_equal (loops_in_all (&got), abs (turns));
        bt__caught_free (&got);
      }
}

/* A ring about the member from A to B, at share S of it, of RADIUS, right-handed.  */
static uint32_t
ring_about (bt_vec3 a, bt_vec3 b, double s, double radius, bt_vec3 *p)
{
  bt_vec3 along = bt__unit_or (bt__sub (b, a), bt__vec (0, 0, 1));
  bt_vec3 aside = fabs (along.z) < 0.9 ? bt__vec (0, 0, 1) : bt__vec (1, 0, 0);
  bt_vec3 u = bt__unit_or (bt__cross (along, aside), aside), v = bt__cross (along, u);
  bt_vec3 middle = bt__axpy (a, s, bt__sub (b, a));
  for (int i = 0; i <= 24; i++)
    {
      double w = 2 * BT__PI * i / 24;
      p[i] = bt__axpy (bt__axpy (middle, radius * cos (w), u), radius * sin (w), v);
    }
  return 25;
}

/* Close round any edge of a jacket, or of rings: one loop, about that edge if it holds the line. */
static void
a_ring_about_an_edge_is_one_loop (void **state)
{
  int rings = 0;
  (void)state;
  for (int scene = 1; scene < SCENES; scene++)
    {
      dice d = dice_new (40 + (uint64_t)scene);
      draw_skeleton (&r.g, scene, &d);
      read_scene (0);
      for (uint32_t e = 0; e < r.graph.own; e++)
        {
          uint32_t v = r.graph.edge[e][0], w = r.graph.edge[e][1];
          uint32_t n = ring_about (r.graph.v[v], r.graph.v[w], 0.5, 1e-3, r.p);
          uint8_t favoured[8 * CASE_OBSTACLES] = { 0 };
          bt__caught got;
          assert_true (r.graph.edges <= sizeof favoured);
          favoured[e] = 1;
          assert_int_equal (bt__caught_new (&r.graph, &got, NULL), BT_OK);
          bt__caught_find (&got, r.p, n, r.p, 1, favoured);
          assert_int_equal (loops_in_all (&got), got.any);
          assert_int_equal (got.loops[e], got.any);
          rings += got.any;
          bt__caught_free (&got);
        }
    }
  print_message ("# %d rings about edges are one loop\n", rings);
  assert_true (rings > 200);
}

/* In a mirror every loop goes the other way.  */
static void
a_mirror_turns_the_sign (void **state)
{
  int any = 0;
  (void)state;
  for (int k = 0; k < 60; k++)
    {
      dice d = dice_new (300 + (uint64_t)k);
      draw_skeleton (&r.g, k % SCENES, &d);
      read_scene (0);
      bt_vec3 a = draw_point (&r.g, &d, 0.4), b = draw_point (&r.g, &d, 0.4);
      uint32_t n = draw_between (&r.g, &d, a, b, 6, 0.1, 0.6, r.p);
      uint32_t m = draw_between (&r.g, &d, a, b, 2, 0.1, 0.6, r.q);
      bt__caught before = caught (r.p, n, r.q, m);
      for (uint32_t v = 0; v < r.graph.vertices; v++)
        r.graph.v[v].x *= -1;
      assert_int_equal (bt__graph_plant (&r.graph, NULL), BT_OK);
      for (uint32_t i = 0; i < n || i < m; i++)
        {
          r.p[i].x *= i < n ? -1 : 1;
          r.q[i].x *= i < m ? -1 : 1;
        }
      bt__caught after = caught (r.p, n, r.q, m);
      for (uint32_t e = 0; e < r.graph.edges; e++)
        assert_int_equal (after.loops[e], -before.loops[e]);
      any += before.any;
      bt__caught_free (&before);
      bt__caught_free (&after);
    }
  assert_true (any > 10);
}

/* ---- What cannot hold, and what is far away ---- */

static void
wind_round (double x, double y, double z, int turns)
{
  for (int i = 0; i <= 200; i++)
    {
      double w = 2 * BT__PI * turns * i / 200;
      r.p[i] = bt__vec (x + 2 * cos (w), y - 2 * sin (w), z + 0.005 * i);
    }
  r.q[0] = r.p[0];
  r.q[1] = r.p[200];
}

static void
add_bed (void)
{
  bt__obstacle *bed = r.g.o + r.g.n++;
  *bed = (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, -20 } };
  assert_true (stage_make (&r.g));
  read_scene (0);
}

/* A stub slips out below, a hanger above, a spar and a ball both ways; a pile does not.  */
static void
what_ends_in_the_water_holds_nothing (void **state)
{
  static const double top[] = { -5, 2, -5, 2 }, foot[] = { -21, -15, -15, -21 };
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      stage_clear (&r.g);
      stage_cylinder (&r.g, bt__vec (0, 0, top[k]), bt__vec (0, 0, foot[k]), 0.4);
      stage_sphere (&r.g, bt__vec (8, 0, -10), 1);
      add_bed ();
      wind_round (0, 0, -11, 3);
      bt__caught got = caught (r.p, 201, r.q, 2);
      assert_int_equal (about (&got, 0), k == 3 ? 3 : 0);
      assert_int_equal (got.any, k == 3);
      bt__caught_free (&got);
      wind_round (8, 0, -10.5, 2);
      got = caught (r.p, 201, r.q, 2);
      assert_false (got.any);
      bt__caught_free (&got);
    }
}

/* A box from the bed to the air is a pillar; one that stands on the bed, or hangs, is not.  */
static void
a_box_from_bed_to_air_is_a_pillar (void **state)
{
  static const double top[] = { 1, -2, 1 }, foot[] = { -20.5, -20.5, -15 };
  (void)state;
  for (int k = 0; k < 3; k++)
    {
      stage_clear (&r.g);
      stage_box (&r.g, bt__vec (0, 0, 0.5 * (top[k] + foot[k])),
                 bt__vec (1, 1, 0.5 * (top[k] - foot[k])));
      add_bed ();
      wind_round (0, 0, -11, -2);
      bt__caught got = caught (r.p, 201, r.q, 2);
      assert_int_equal (about (&got, 0), k == 0 ? -2 : 0);
      bt__caught_free (&got);
    }
}

/* Piles far off, and a jacket's, change no loop.  */
static void
what_is_far_away_changes_nothing (void **state)
{
  (void)state;
  for (int k = 0; k < 20; k++)
    {
      dice d = dice_new (500 + (uint64_t)k);
      draw_skeleton (&r.g, k % 2 ? 3 : 0, &d);
      read_scene (0);
      bt_vec3 a = draw_point (&r.g, &d, 0.4), b = draw_point (&r.g, &d, 0.4);
      uint32_t n = draw_between (&r.g, &d, a, b, 6, 0.1, 0.6, r.p), objects = r.g.n;
      uint32_t m = draw_between (&r.g, &d, a, b, 2, 0.1, 0.6, r.q);
      int before[CASE_OBSTACLES];
      bt__caught got = caught (r.p, n, r.q, m);
      for (uint32_t o = 0; o < objects; o++)
        before[o] = about (&got, o);
      bt__caught_free (&got);
      for (int i = 0; i < 5; i++)
        stage_cylinder (&r.g, bt__vec (200 + 9 * i, 50, 2), bt__vec (200 + 9 * i, 50, -21), 0.5);
      bt__scene_free (r.g.scene);
      assert_true (stage_make (&r.g));
      read_scene (0);
      got = caught (r.p, n, r.q, m);
      for (uint32_t o = 0; o < r.g.n; o++)
        assert_int_equal (about (&got, o), o < objects ? before[o] : 0);
      bt__caught_free (&got);
    }
}

/* ---- The fewest ---- */

/* The least sum that any numbers from -SPAN to SPAN at the inner vertices leave of LOOPS.  */
static int
least_of_all (const int32_t *loops)
{
  int number[NUMBERS + 2] = { 0 }, least = INT32_MAX, tries = 1;
  for (int i = 0; i < NUMBERS; i++)
    tries *= 2 * SPAN + 1;
  for (int t = 0; t < tries; t++)
    {
      int sum = 0, rest = t;
      for (int i = 0; i < NUMBERS; i++, rest /= 2 * SPAN + 1)
        number[i] = rest % (2 * SPAN + 1) - SPAN;
      for (uint32_t e = 0; e < r.graph.edges; e++)
        sum += abs (loops[e] + number[r.graph.edge[e][0]] - number[r.graph.edge[e][1]]);
      least = sum < least ? sum : least;
    }
  return least;
}

/* A frame of five joints between two ends that are held, and lines drawn through it anyhow.  */
static void
random_frame (dice *d)
{
  static bt_vec3 v[NUMBERS + 2];
  static double radius[NUMBERS + 2];
  static uint8_t boundary[NUMBERS + 2];
  static uint32_t edge[12][2], object[12];
  r.graph = (bt__graph){ .vertices = NUMBERS + 2, .v = v, .radius = radius, .boundary = boundary };
  r.graph.edge = edge;
  r.graph.object = object;
  boundary[NUMBERS] = boundary[NUMBERS + 1] = 1;
  for (int i = 0; i < NUMBERS + 2; i++)
    v[i] = bt__vec (dice_between (d, -1, 1), dice_between (d, -1, 1), dice_between (d, -1, 1));
  for (int e = 0; e < 12; e++)
    {
      uint32_t a = (uint32_t)dice_below (d, NUMBERS + 2), b = (uint32_t)dice_below (d, NUMBERS + 2);
      if (a != b)
        {
          edge[r.graph.edges][0] = a;
          edge[r.graph.edges++][1] = b;
        }
    }
  r.graph.own = r.graph.edges;
  assert_int_equal (bt__graph_plant (&r.graph, NULL), BT_OK);
}

static void
no_sum_is_smaller (void **state)
{
  int32_t loops[12];
  int more = 0, slid = 0;
  (void)state;
  bt__graph_free (&r.graph);
  dice d = dice_new (9);
  for (int k = 0; k < 300; k++)
    {
      random_frame (&d);
      for (int i = 0; i < 12; i++)
        r.p[i] = bt__vec (dice_between (&d, -1.2, 1.2), dice_between (&d, -1.2, 1.2),
                          dice_between (&d, -1.2, 1.2));
      r.q[0] = r.p[0];
      r.q[1] = r.p[11];
      bt__caught got = caught (r.p, 12, r.q, 2);
      int before = 0, least;
      bt__caught_crossings (&r.graph, r.p, 12, r.q, 2, loops);
      for (uint32_t e = 0; e < r.graph.edges; e++)
        before += abs (loops[e]);
      least = least_of_all (loops);
      assert_true (loops_in_all (&got) <= least);
      more += loops_in_all (&got) > 1;
      slid += loops_in_all (&got) < before;
      bt__bvh_free (&r.graph.tree);
      bt__caught_free (&got);
    }
  r.graph = (bt__graph){ 0 };
  print_message ("# more than one loop %d times, fewer than crossings %d times\n", more, slid);
  assert_true (more > 50 && slid > 50);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (what_can_be_drawn_home_is_not_caught),
                                      cmocka_unit_test (agrees_with_words),
                                      cmocka_unit_test (turns_are_loops),
                                      cmocka_unit_test (a_ring_about_an_edge_is_one_loop),
                                      cmocka_unit_test (a_mirror_turns_the_sign),
                                      cmocka_unit_test (what_ends_in_the_water_holds_nothing),
                                      cmocka_unit_test (a_box_from_bed_to_air_is_a_pillar),
                                      cmocka_unit_test (what_is_far_away_changes_nothing),
                                      cmocka_unit_test (no_sum_is_smaller) };
  return cmocka_run_group_tests_name ("aware caught", tests, NULL, tear_down);
}
