/* What a line knows of how far it may go: all of it holds, by brute force, and mutants are told.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "../oracle/meet.h"
#include "contact_law.h"

enum
{
  LINKS = 80,
  CORNERS = 200
};

/* ---- Lines and how they are flown ---- */

typedef enum shape_kind
{
  HANGING,
  FOLDED,
  COILED,
  WANDERING,
  SHAPES
} shape_kind;

static int
lay (shape_kind kind, dice *d, bt_vec3 *p)
{
  int n = 0;
  bt_vec3 at = { 0, 0, -10 }, way = { 1, 0, 0 };
  switch (kind)
    {
    case HANGING:
      for (int i = 0; i <= 60; i++)
        p[n++] = bt__vec (i / 1.5 - 20, 0, -14 + 14 * (i / 30.0 - 1) * (i / 30.0 - 1));
      break;
    case FOLDED:
      for (int i = 0; i <= 80; i++)
        p[n++] = bt__vec (i < 40 ? 0 : 0.6, 0, i < 40 ? -i / 2.0 : -20 + (i - 40) / 2.0);
      break;
    case COILED:
      for (int i = 0; i <= 120; i++)
        p[n++] = bt__vec (cos (BT__PI * i / 12), sin (BT__PI * i / 12), -0.01 * i);
      break;
    default:
      for (int i = 0; i < CORNERS; i++)
        {
          way = bt__unit_or (bt__add (way, dice_point (d, 0.5)), way);
          at = bt__axpy (at, 0.15, way);
          p[n++] = at;
        }
    }
  return n;
}

/* A line of KIND in R, which touches itself.  */
static void
begin (rope *p, reef *r, shape_kind kind, uint64_t seed)
{
  bt_vec3 path[CORNERS];
  dice d = dice_new (seed);
  int n = lay (kind, &d, path);
  assert_true (rope_open (p, r, LINKS, path, n, bt__length (path, (uint32_t)n), 0.3));
  p->config.itself = 1;
  p->config.id = 1000;
  p->config.pull[1] = 150;
}

/* The end is led to and fro about where it was, WIDE metres.  */
static void
fly (rope *p, bt_vec3 about, int i, double wide)
{
  double t = i * frame;
  p->in.end[1].at = bt__axpy (about, wide, bt__vec (sin (t), cos (1.3 * t) - 1, sin (0.7 * t)));
  rope_step (p, frame, 0);
}

/* ---- The line and itself ---- */

/* What links I and J of P must keep.  */
static double
floor_of (const rope *p, int i, int j)
{
  double between = 0;
  for (int q = i + 1; q < j; q++)
    between += bt__dynamic_rest (p->d)[q];
  return fmin (2 * p->config.core, 0.24 * between);
}

/* Links I and J come together as straight as SPARE lets them, every link between and with them
   turning as much: the nearest they come.  */
static double
nearest_of (const bt_vec3 *x, int i, int j, const bt__dynamic_drift *spare)
{
  bt_vec3 a = bt__scale (0.5, bt__add (x[i], x[i + 1])),
          b = bt__scale (0.5, bt__add (x[j], x[j + 1]));
  bt_vec3 to = bt__unit_or (bt__sub (a, b), bt__vec (0, 0, 1));
  double links = j + 1 - i, turn = fmin (spare->turned, spare->apart / links), least = INFINITY;
  for (int k = 0; k <= 8; k++)
    {
      double t = turn * k / 8;
      bt_vec3 p[2] = { x[i], bt__axpy (x[i + 1], t, to) };
      bt_vec3 q[2] = { bt__axpy (x[j], t * (j - i), to), bt__axpy (x[j + 1], t * links, to) };
      least = fmin (least, meet_distance (p, q));
    }
  return least;
}

/* The pairs of links of P that SHARE of what it has to spare lets come too near; *ASKED is how many
   steps had any to spare.  */
static long
wrong_pairs (const rope *p, double share, long *asked)
{
  const bt_vec3 *x = bt__dynamic_x (p->d);
  bt__dynamic_drift s = p->d->spare;
  long wrong = 0;
  if (!(s.turned > 0 && s.apart > 0))
    return 0;
  ++*asked;
  s.turned *= share;
  s.apart *= share;
  for (int i = 0; i < (int)p->d->n; i++)
    for (int j = i + 2; j < (int)p->d->n; j++)
      wrong += nearest_of (x, i, j, &s) < floor_of (p, i, j);
  return wrong;
}

static void
pairs_stay_apart (void **state)
{
  (void)state;
  static reef r;
  static rope p;
  long wrong = 0, mutant[SHAPES] = { 0 }, asked[SHAPES] = { 0 }, unused = 0;
  assert_true (reef_open (&r) && reef_raise (&r));
  for (int kind = 0; kind < SHAPES; kind++)
    for (uint64_t seed = 1; seed <= (kind == WANDERING ? (is_long () ? 100 : 4) : 1); seed++)
      {
        begin (&p, &r, (shape_kind)kind, seed);
        bt_vec3 about = p.in.end[1].at;
        for (int i = 0; i < (is_long () ? 2000 : 240); i++)
          {
            fly (&p, about, i, kind == COILED ? 0.05 : 0.5);
            if (i % 8)
              continue;
            wrong += wrong_pairs (&p, 1, &asked[kind]);
            mutant[kind] += wrong_pairs (&p, 3, &unused);
          }
        rope_close (&p);
      }
  print_message ("# looked at %ld, %ld, %ld, %ld times; of three times as much %ld, %ld, %ld, %ld "
                 "pairs are wrong\n",
                 asked[0], asked[1], asked[2], asked[3], mutant[0], mutant[1], mutant[2],
                 mutant[3]);
  assert_int_equal (wrong, 0);
  for (int kind = 0; kind < SHAPES; kind++)
    assert_true (asked[kind] > 10);
  assert_true (mutant[FOLDED] > 0 && mutant[COILED] > 0 && mutant[WANDERING] > 0);
  reef_close (&r);
}

/* A line whose end is drawn through another part of it: what it believes to have to spare is FALSE,
   or what it has.  Return how often it goes through itself.  */
static long
draw_across (double false_spare)
{
  static reef r;
  static rope p;
  bt_vec3 path[] = { { 0, 0, 0 }, { 6, 0, 0 }, { 6, 1, 1 }, { 3, 1, 1 } };
  bt_vec3 before[LINKS + 1], target = { 3, -3, -3 };
  long crossings = 0;
  assert_true (reef_open (&r) && reef_raise (&r));
  assert_true (rope_open (&p, &r, LINKS, path, 4, bt__length (path, 4), 0.3));
  p.config.itself = 1;
  for (int i = 0; i < 400; i++)
    {
      memcpy (before, bt__dynamic_x (p.d), sizeof before);
      if (false_spare > 0)
        p.d->spare.turned = p.d->spare.apart = false_spare;
      rope_tow (&p, target, 1, frame);
      rope_step (&p, frame, 0);
      const bt_vec3 *x = bt__dynamic_x (p.d);
      crossings += meet_crossings (before, x, LINKS + 1, before, x, LINKS + 1);
    }
  rope_close (&p);
  reef_close (&r);
  return crossings;
}

static void
false_spare_goes_through (void **state)
{
  (void)state;
  assert_int_equal (draw_across (0), 0);
  assert_true (draw_across (100) > 0);
}

/* ---- What stands ---- */

static double
clearance (const reef *r, const bt_vec3 *x, int n)
{
  double least = INFINITY;
  for (int i = 0; i < r->solids; i++)
    for (int j = 0; j + 1 < n; j++)
      {
        bt__link link = { x[j], x[j + 1] };
        least = fmin (least, solid_brute (r->solid + i, &link));
      }
  return least;
}

static void
obstacles_stay_away (void **state)
{
  (void)state;
  static reef r;
  static rope p;
  long wrong = 0, mutant = 0, asked = 0;
  assert_true (reef_open (&r));
  reef_cylinder (&r, bt__vec (3, 5, -40), bt__vec (3, 5, 2), 0.6);
  reef_wire (&r, bt__vec (-9, -4, -8), bt__vec (12, -4, -6), 0.005);
  reef_box (&r, bt__vec (-6, 3, -9), bt__vec (1, 1, 1), 0.3);
  assert_true (reef_raise (&r));
  begin (&p, &r, HANGING, 1);
  dice d = dice_new (7);
  bt_vec3 target = { 0, 0, 0 };
  for (int i = 0; i < (is_long () ? 20000 : 1500); i++)
    {
      if (i % 200 == 0)
        target = bt__vec (dice_between (&d, -12, 12), dice_between (&d, -8, 8),
                          dice_between (&d, -14, 0));
      rope_tow (&p, target, 2, frame);
      rope_step (&p, frame, 0);
      if (i % 5 || !(p.d->spare.way > 0))
        continue;
      double clear = clearance (&r, bt__dynamic_x (p.d), (int)p.d->n + 1);
      asked++;
      wrong += clear < p.d->spare.way;
      mutant += clear < p.d->spare.way + 1;
    }
  print_message ("# %ld times something to spare; a metre more is wrong %ld times\n", asked,
                 mutant);
  assert_int_equal (wrong, 0);
  assert_true (asked > 50 && mutant > 0);
  rope_close (&p);
  reef_close (&r);
}

/* ---- It is of the line alone ---- */

/* A line whose workspace forgets all now and then has the same state to the last bit.  */
static void
is_of_the_state (void **state)
{
  (void)state;
  static reef r;
  static rope p, q;
  for (int kind = 0; kind < SHAPES; kind++)
    {
      assert_true (reef_open (&r));
      reef_cylinder (&r, bt__vec (3, 5, -40), bt__vec (3, 5, 2), 0.6);
      assert_true (reef_raise (&r));
      begin (&p, &r, (shape_kind)kind, 5);
      begin (&q, &r, (shape_kind)kind, 5);
      bt_vec3 about = p.in.end[1].at;
      dice d = dice_new (3);
      for (int i = 0; i < (is_long () ? 3000 : 300); i++)
        {
          if (dice_below (&d, 7) == 0)
            bt__line_work_forget (q.contact);
          fly (&p, about, i, kind == COILED ? 0.1 : 2);
          fly (&q, about, i, kind == COILED ? 0.1 : 2);
          assert_memory_equal (p.d, q.d, bt__dynamic_size ((int)p.d->n_max));
          assert_memory_equal (p.anchors, q.anchors, bt__contacts_live (p.anchors));
        }
      rope_close (&p);
      rope_close (&q);
      reef_close (&r);
    }
}

/* A line that hangs in open water in the midst of a ring of line, whose box is about both, has the
   same state to the last bit as one far from any: what another line does within its box and out of
   reach tells on nothing.  */
static void
far_lines_change_nothing (void **state)
{
  (void)state;
  enum
  {
    CORNERS_OF_RING = 48
  };
  static reef r;
  static rope p, q, ring;
  bt_vec3 shape[CORNERS_OF_RING + 1];
  for (int i = 0; i <= CORNERS_OF_RING; i++)
    {
      double turn = 1.9 * BT__PI * i / CORNERS_OF_RING;
      shape[i] = bt__vec (40 * cos (turn), 40 * sin (turn), i % 2 ? -40 : 20);
    }
  assert_true (reef_open (&r) && reef_raise (&r));
  assert_true (rope_open (&ring, &r, 2 * CORNERS_OF_RING, shape, CORNERS_OF_RING + 1,
                          bt__length (shape, CORNERS_OF_RING + 1), 0.3));
  begin (&p, &r, HANGING, 5);
  begin (&q, &r, HANGING, 5);
  bt__strand about_q = { .line = ring.d,
                         .anchors = ring.anchors,
                         .id = 7,
                         .radius = ring.config.radius,
                         .core = ring.config.core,
                         .friction = 0.3 };
  q.config.strand = &about_q;
  q.config.strands = 1;
  bt_vec3 about = p.in.end[1].at;
  for (int i = 0; i < 300; i++)
    {
      fly (&p, about, i, 1);
      fly (&q, about, i, 1);
      assert_memory_equal (p.d, q.d, bt__dynamic_size ((int)p.d->n_max));
    }
  rope_close (&p);
  rope_close (&q);
  rope_close (&ring);
  reef_close (&r);
}

/* What two lines have but for what contact has told of them.  */
static int
are_alike (const bt__dynamic *a, const bt__dynamic *b)
{
  bt__dynamic head = *a;
  head.spare = b->spare;
  head.seen = b->seen;
  head.wait = b->wait;
  return memcmp (&head, b, sizeof head) == 0
         && memcmp (a + 1, b + 1, bt__dynamic_size ((int)a->n_max) - sizeof *a) == 0;
}

/* How a line is flown that never nears itself.  */
typedef struct flown
{
  const char *name;
  double wide, pay, density; /* m; m/s, out and in by turns; kg/m3 */
} flown;

/* Until they touch themselves lines go as their own step leads them, to the last bit, whether they
   look out for themselves or not: led gently, jerked, paid out and hauled in, and alone in a
   vacuum, where their energy is watched.  */
static void
a_clear_line_goes_its_own_way (void **state)
{
  (void)state;
  static reef r;
  static rope p, q;
  const flown how[] = {
    { "led", 1, 0, 1025 }, { "jerked", 6, 0, 1025 }, { "wound", 1, 0.4, 1025 }, { "alone", 0, 0, 0 }
  };
  assert_true (reef_open (&r) && reef_raise (&r));
  long looked = 0;
  for (size_t h = 0; h < sizeof how / sizeof *how; h++)
    for (int kind = 0; kind < COILED; kind++)
      {
        int steps = 0;
        begin (&p, &r, (shape_kind)kind, 1);
        begin (&q, &r, (shape_kind)kind, 1);
        q.config.itself = 0;
        p.water.density = q.water.density = how[h].density;
        bt_vec3 about = p.in.end[1].at;
        for (; steps < 600; steps++)
          {
            p.in.pay = q.in.pay = steps % 240 < 120 ? how[h].pay : -how[h].pay;
            fly (&p, about, steps, how[h].wide);
            fly (&q, about, steps, how[h].wide);
            if (p.touch.rows > 0)
              break;
            looked += p.touch.pairs;
            if (!are_alike (p.d, q.d))
              fail_msg ("shape %d, %s, differs at step %d", kind, how[h].name, steps);
          }
        print_message ("# shape %d, %s: alike for %d steps\n", kind, how[h].name, steps);
        assert_true (steps >= (kind == HANGING ? 600 : 4));
        rope_close (&p);
        rope_close (&q);
      }
  assert_true (looked > 0);
  reef_close (&r);
}

/* Lines that are clear ask only now and then.  */
static void
asks_seldom (void **state)
{
  (void)state;
  static reef r;
  static rope p;
  long pairs = 0;
  assert_true (reef_open (&r));
  reef_box (&r, bt__vec (10, 0, -60), bt__vec (1, 1, 1), 0);
  assert_true (reef_raise (&r));
  begin (&p, &r, HANGING, 1);
  bt_vec3 about = p.in.end[1].at;
  for (int i = 0; i < 600; i++)
    {
      fly (&p, about, i, 0.5);
      pairs += p.touch.pairs;
    }
  print_message ("# in 600 steps %ld pairs and %ld links were asked\n", pairs, (long)p.count.links);
  assert_true (pairs < 600 && p.count.links <= LINKS);
  rope_close (&p);
  reef_close (&r);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (pairs_stay_apart),
                                      cmocka_unit_test (false_spare_goes_through),
                                      cmocka_unit_test (obstacles_stay_away),
                                      cmocka_unit_test (is_of_the_state),
                                      cmocka_unit_test (far_lines_change_nothing),
                                      cmocka_unit_test (a_clear_line_goes_its_own_way),
                                      cmocka_unit_test (asks_seldom) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
