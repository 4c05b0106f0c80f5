/* Tethers never pass through each other: random worlds of two tethers and two vehicles, in open
   water or with kinematic obstacles, flown by a pilot who does anything; kinematic vehicles and
   vehicles with mass, whole lines and cut ones.  Each step is judged by brute force without the
   engine.  With the pair switched off the judge must cry out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/dive_play.h"
#include "../oracle/meet.h"
#include "../oracle/two_lines.h"
#include "math/vec.h"

enum
{
  WORLDS = 12,
  ACTS = 8,
  STEPS = 40
};

/* What a world has.  */
typedef struct kind
{
  int movers, mass, cut, off;
} kind;

/* What the judge saw: steps, steps in which lines touched, steps not judged because nodes came or
   went, crossings.  */
typedef struct verdict
{
  long steps, touching, unjudged, crossings;
} verdict;

/* ---- The judge ---- */

/* Tethers step one after another: how often parts P and Q crossed, in the order that crosses less.
 */
static long
crossings_between (const sight *was, const sight *is, int p, int q)
{
  const bt_vec3 *a = was->x[p], *b = is->x[p], *c = was->x[q], *d = is->x[q];
  int n = is->n[p], m = is->n[q];
  long first = meet_crossings (a, b, n, c, c, m) + meet_crossings (b, b, n, c, d, m);
  if (first == 0)
    return 0;
  long second = meet_crossings (a, a, n, c, d, m) + meet_crossings (a, b, n, d, d, m);
  return first < second ? first : second;
}

static void
judge_step (const bt_dive *dive, const sight *was, const sight *is, verdict *v)
{
  v->steps++;
  v->touching
      += bt_dive_collided (dive, BT_PART_TETHER, 0, bt_dive_count (dive, BT_PART_OBSTACLE) + 1);
  if (memcmp (was->n, is->n, sizeof was->n) != 0)
    {
      v->unjudged++;
      return;
    }
  for (int p = 0; p < 2; p++)
    for (int q = 2; q < 4; q++)
      if (is->n[p] > 0 && is->n[q] > 0)
        v->crossings += crossings_between (was, is, p, q);
}

/* ---- Worlds and pilots ---- */

/* Two lines across each other, a metre apart.  */
static void
draw_world (scene *s, dice *d, kind k)
{
  begin_two_lines (s, BT_MODEL_DYNAMIC);
  for (int i = 0; i < 2; i++)
    draw_line_of_two (s, i, d, 1, 6, k.mass);
  if (k.movers)
    add_movers (s);
}

static void
act (bt_dive *dive, dice *d, kind k)
{
  int v = dice_below (d, 2);
  bt_vec3 p = bt__add (bt__vec (0, 0, -7), dice_point (d, 7));
  act_on_two (dive, d, v, p, 3, k.mass, k.cut);
}

static void
fly_and_judge (uint64_t seed, kind k, verdict *v)
{
  static sight sights[2];
  sight *was = sights, *is = sights + 1;
  scene s;
  dice d = dice_new (seed + other_seeds ());
  draw_world (&s, &d, k);
  bt_dive *dive = enter (&s);
  int other = s.world.n_obstacles + 1;
  if (k.off)
    operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ BT_PART_TETHER, other, 0 });
  for (int a = 0; a < ACTS; a++)
    {
      act (dive, &d, k);
      look (dive, was);
      for (int i = 0; i < STEPS && step (dive); i++)
        {
          sight *before = was;
          look (dive, is);
          judge_step (dive, was, is, v);
          was = is;
          is = before;
        }
    }
  bt_dive_free (dive);
}

static verdict
fly_worlds (uint64_t seed, int worlds, kind k, const char *name)
{
  verdict v = { 0 };
  for (int i = 0; i < worlds; i++)
    fly_and_judge (seed + (uint64_t)i, k, &v);
  print_message ("# %s: %ld steps, %ld touching, %ld not judged, %ld crossings\n", name, v.steps,
                 v.touching, v.unjudged, v.crossings);
  return v;
}

static void
never (uint64_t seed, kind k, const char *name)
{
  verdict v = fly_worlds (seed, WORLDS * longer (), k, name);
  assert_int_equal (v.crossings, 0);
  assert_true (v.touching > v.steps / 100);
  assert_true (v.unjudged < v.steps / 15);
}

/* ---- Tests ---- */

static void
in_open_water (void **state)
{
  (void)state;
  never (1000, (kind){ 0 }, "open water");
  never (2000, (kind){ .mass = 1 }, "open water, vehicles with mass");
}

static void
cut_in_open_water (void **state)
{
  (void)state;
  never (3000, (kind){ .cut = 1 }, "open water, lines cut");
}

static void
among_movers (void **state)
{
  (void)state;
  never (4000, (kind){ .movers = 1, .cut = 1 }, "kinematic obstacles");
}

static void
switched_off_they_pass (void **state)
{
  (void)state;
  verdict v = fly_worlds (1000, WORLDS, (kind){ .off = 1 }, "switched off");
  assert_true (v.crossings > WORLDS / 2);
  assert_int_equal (v.touching, 0);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (in_open_water), cmocka_unit_test (cut_in_open_water),
          cmocka_unit_test (among_movers), cmocka_unit_test (switched_off_they_pass) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
