/* A tether never passes through the hull of another's vehicle: random worlds of two tethers and two
   vehicles, in open water or with kinematic obstacles, where pilots fly their vehicles at each
   other's lines; kinematic vehicles and vehicles with mass, whole lines and cut ones, one thread
   and two, straight on and by way of a saved state.  Each step is judged without the engine.  With
   the pairs switched off the judge must cry out.

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
#include "../oracle/two_lines.h"
#include "math/vec.h"
#include "world/hull.h"

enum
{
  WORLDS = 10,
  ACTS = 6,
  STEPS = 40,
  BETWEEN = 8 /* moments of a step that are looked at */
};

/* What a world has.  */
typedef struct kind
{
  int movers, mass, cut, off, saved, fine, threads;
  bt_model_kind model;
} kind;

/* What the judge saw: steps, steps in which a line touched a hull, steps judged at their end alone,
   because nodes came or went, or straight ways lead through a hull in a step that was taken in
   parts, in each of which the line goes straight, but not in all; steps with a line in a hull,
   steps that the guard shortened; the parts taken so far; where it all ended.  */
typedef struct verdict
{
  long steps, touching, unjudged, inside;
  uint64_t tries, truncated, beside, shared, parts, hash;
} verdict;

/* Where the hulls are.  A body that is pitched and rolled has another heading than its compass
   says, so its attitude is read.  */
typedef struct hulls
{
  bt__box box[2];
  double rest[PARTS][POINTS]; /* m: of the intervals of the lines, too */
} hulls;

/* ---- The judge ---- */

static void
look_at_hulls (const scene *s, const bt_dive *dive, const sight *sight, hulls *h)
{
  for (int i = 0; i < 2; i++)
    h->box[i] = (bt__box){ bt__vehicle_frame (bt__dive_vehicle (dive, dive->now, i)),
                           bt__scale (0.5, s->vehicle[i].size) };
  for (int p = 0; p < PARTS; p++)
    if (sight->n[p] > 0)
      memcpy (h->rest[p], bt__dynamic_rest (bt__dive_chain (dive, dive->now, p / 2, p % 2)),
              sizeof (double) * (size_t)(sight->n[p] - 1));
}

/* True if the nodes of part P are the same before and after: a sliding node that comes while
   another goes leaves their number.  */
static int
are_same_nodes (const sight *was, const sight *is, const hulls *before, const hulls *after, int p)
{
  const double *a = before->rest[p], *b = after->rest[p];
  int same = was->n[p] == is->n[p];
  for (int i = 0; same && i + 1 < is->n[p]; i++)
    same = fabs (a[i] - b[i]) < 0.2 * a[i];
  return same;
}

/* True if the segment from P to Q, in the frame of a box, has a point within HALF.  */
static int
enters (bt_vec3 p, bt_vec3 q, bt_vec3 half)
{
  const double *a = &p.x, *b = &q.x, *h = &half.x;
  double from = 0, to = 1;
  for (int k = 0; k < 3; k++)
    {
      double d = b[k] - a[k], s = (-h[k] - a[k]) / d, t = (h[k] - a[k]) / d;
      if (d == 0 && fabs (a[k]) >= h[k])
        return 0;
      if (d == 0)
        continue;
      from = fmax (from, fmin (s, t));
      to = fmin (to, fmax (s, t));
    }
  return from < to;
}

/* True if a line of N nodes, which went from X to Y, had after the share T a point within HALF of
   the origin of the frame *BOX.  */
static int
is_in (const bt__frame *box, bt_vec3 half, const bt_vec3 *x, const bt_vec3 *y, int n, double t)
{
  bt_vec3 last = bt__to_local (box, bt__axpy (x[0], t, bt__sub (y[0], x[0])));
  for (int i = 1; i < n; i++)
    {
      bt_vec3 next = bt__to_local (box, bt__axpy (x[i], t, bt__sub (y[i], x[i])));
      if (enters (last, next, half))
        return 1;
      last = next;
    }
  return 0;
}

/* True if part P of a line is in the box that went from A to B, straight, with an even turn, or was
   at one of the moments from FIRST on.  */
static int
was_inside (const sight *was, const sight *is, int p, const bt__box *a, const bt__box *b, int first)
{
  bt_vec3 half = bt__sub (a->half, bt__vec (1e-6, 1e-6, 1e-6));
  bt__motion motion = bt__motion_between (&a->frame, &b->frame);
  for (int m = first; m <= BETWEEN; m++)
    {
      double t = (double)m / BETWEEN;
      bt__frame box = bt__motion_at (&motion, t);
      if (is_in (&box, half, m < BETWEEN ? was->x[p] : is->x[p], is->x[p], is->n[p], t))
        return 1;
    }
  return 0;
}

/* True if DIVE took a line through its last step in parts.  */
static int
was_in_parts (const bt_dive *dive, verdict *v)
{
  bt_profile work;
  bt_dive_profile (dive, &work);
  int in_parts = work.chain_parts != v->parts;
  v->parts = work.chain_parts;
  return in_parts;
}

static void
judge_step (const bt_dive *dive, const sight *was, const sight *is, const hulls *before,
            const hulls *after, verdict *v)
{
  int first = bt_dive_count (dive, BT_PART_OBSTACLE) + 2, in_parts = was_in_parts (dive, v);
  v->steps++;
  v->touching += bt_dive_collided (dive, BT_PART_TETHER, 0, first + 1)
                 || bt_dive_collided (dive, BT_PART_TETHER, 1, first);
  for (int p = 0; p < PARTS; p++)
    {
      int same = are_same_nodes (was, is, before, after, p), hull = 1 - p / 2;
      v->unjudged += !same;
      if (!was_inside (was, is, p, &before->box[hull], &after->box[hull], same ? 1 : BETWEEN))
        continue;
      if (in_parts && !was_inside (was, is, p, &before->box[hull], &after->box[hull], BETWEEN))
        {
          v->unjudged += same;
          continue;
        }
      v->inside++;
      if (getenv ("BIGHT_TELL"))
        printf ("# t %.3f part %d is in the hull of vehicle %d\n", bt_dive_time (dive), p, hull);
    }
}

/* ---- Worlds and pilots ---- */

/* Two lines across each other, two metres apart.  */
static void
draw_world (scene *s, dice *d, kind k)
{
  begin_two_lines (s, k.model);
  for (int i = 0; i < 2; i++)
    {
      draw_line_of_two (s, i, d, 2, k.mass ? 2 : 6, k.mass);
      s->tether[i].props.nodes = k.fine ? 240 : 24;
      if (!k.mass)
        give_hull (s, i, bt__vec (dice_between (d, 0.2, 1), dice_between (d, 0.2, 1), 0.4));
    }
  if (k.movers)
    add_movers (s);
}

/* Where a vehicle goes that crosses the line of the other.  */
static bt_vec3
across_the_other (const bt_dive *dive, dice *d, int v)
{
  static sight seen;
  bt_vehicle_view view;
  look (dive, &seen);
  assert_int_equal (bt_dive_vehicle (dive, v, &view, NULL), BT_OK);
  int p = 2 * (1 - v);
  bt_vec3 at = seen.x[p][dice_below (d, seen.n[p])], way = bt__sub (at, view.position);
  return bt__axpy (at, dice_between (d, 0.2, 3) / fmax (bt__norm (way), 1), way);
}

static void
act (bt_dive *dive, dice *d, kind k)
{
  int v = dice_below (d, 2);
  bt_vec3 p = across_the_other (dive, d, v);
  act_on_two (dive, d, v, p, 2, k.mass, k.cut);
}

/* Let DIVE go on from its own state, saved and restored.  */
static void
save_and_restore (bt_dive *dive)
{
  size_t size = bt_dive_state_size (dive);
  void *state = malloc (size);
  assert_non_null (state);
  bt_dive_save (dive, state);
  bt_error e = { 0 };
  if (bt_dive_restore (dive, state, size, &e) != BT_OK)
    fail_msg ("%s", e.text);
  free (state);
}

/* True if a line lies in a hull or close to one as the dive begins: that line is let out.  */
static int
begins_close (const bt_dive *dive, int hull)
{
  for (int i = 0; i < 2; i++)
    {
      bt_clearance clearance;
      assert_int_equal (bt_tether_clearance (dive, i, hull + 1 - i, &clearance, NULL), BT_OK);
      if (clearance.distance < 0.01)
        return 1;
    }
  return 0;
}

static void
fly_and_judge (uint64_t seed, kind k, verdict *v)
{
  static sight sights[2];
  static hulls hulls_seen[2];
  sight *was = sights, *is = sights + 1;
  hulls *before = hulls_seen, *after = hulls_seen + 1;
  scene s;
  bt_profile work;
  dice d = dice_new (seed + other_seeds ());
  if (getenv ("BIGHT_TELL"))
    printf ("# seed %lu\n", (unsigned long)seed);
  draw_world (&s, &d, k);
  bt_dive *dive = enter (&s);
  int hull = s.world.n_obstacles + 2, begins = begins_close (dive, hull);
  if (k.threads)
    assert_int_equal (bt_dive_set_threads (dive, k.threads, NULL), BT_OK);
  for (int i = 0; i < 2 && k.off; i++)
    assert_int_equal (
        operate (dive, BT_OP_COLLIDE, i, 3, (double[]){ BT_PART_TETHER, hull + 1 - i, 0 }), BT_OK);
  for (int a = 0; a < ACTS && !begins; a++)
    {
      act (dive, &d, k);
      look (dive, was);
      look_at_hulls (&s, dive, was, before);
      for (int i = 0; i < (k.mass ? 3 * STEPS : STEPS) && step (dive); i++)
        {
          sight *old = was;
          hulls *old_hulls = before;
          look (dive, is);
          look_at_hulls (&s, dive, is, after);
          judge_step (dive, was, is, before, after, v);
          was = is;
          is = old;
          before = after;
          after = old_hulls;
        }
      if (k.saved)
        save_and_restore (dive);
    }
  bt_dive_profile (dive, &work);
  v->tries += work.chain_tries;
  v->truncated += work.truncated;
  v->beside += work.beside_hulls;
  v->shared += work.shared_steps;
  v->hash = v->hash * 31 + bt_dive_hash (dive);
  v->parts = 0;
  bt_dive_free (dive);
}

static verdict
fly_worlds (uint64_t seed, int worlds, kind k, const char *name)
{
  verdict v = { 0 };
  if (k.model == 0)
    k.model = BT_MODEL_DYNAMIC;
  for (int i = 0; i < worlds; i++)
    fly_and_judge (seed + (uint64_t)i, k, &v);
  print_message ("# %s: %ld steps (%g tries each), %ld touching a hull, %ld not judged, %ld with a "
                 "line in a hull, %lu shortened, %lu times beside, %lu shared\n",
                 name, v.steps, 0.5 * (double)v.tries / (double)v.steps, v.touching, v.unjudged,
                 v.inside, (unsigned long)v.truncated, (unsigned long)v.beside,
                 (unsigned long)v.shared);
  return v;
}

static void
never (uint64_t seed, kind k, const char *name)
{
  verdict v = fly_worlds (seed, WORLDS * longer (), k, name);
  assert_int_equal (v.inside, 0);
  assert_true (v.touching > v.steps / 50);
  assert_true (v.unjudged < v.steps / 15);
}

/* ---- Tests ---- */

static void
in_open_water (void **state)
{
  (void)state;
  never (1000, (kind){ 0 }, "open water");
  never (2000, (kind){ .mass = 1 }, "open water, vehicles with mass");
  never (2500, (kind){ .model = BT_MODEL_AUTO }, "open water, model auto");
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
  never (4500, (kind){ .movers = 1, .mass = 1 }, "kinematic obstacles, vehicles with mass");
}

static void
switched_off_they_pass (void **state)
{
  (void)state;
  verdict v = fly_worlds (1000, WORLDS, (kind){ .off = 1 }, "switched off");
  assert_true (v.inside > WORLDS);
  assert_int_equal (v.touching, 0);
  assert_int_equal (v.beside, 0);
}

/* Whatever the number of threads, and by way of a saved state, the same comes of the same.  */
static void
the_same_comes_of_the_same (void **state)
{
  (void)state;
  for (int mass = 0; mass < 2; mass++)
    {
      verdict one = fly_worlds (5000, WORLDS / 2, (kind){ .mass = mass }, "one thread");
      verdict saved = fly_worlds (5000, WORLDS / 2, (kind){ .mass = mass, .saved = 1 }, "saved");
      assert_true (one.hash == saved.hash);
      kind fine = { .mass = mass, .fine = 1 }, shared = { .mass = mass, .fine = 1, .threads = 2 };
      one = fly_worlds (6000, 2, fine, "fine lines");
      verdict two = fly_worlds (6000, 2, shared, "fine lines, two threads");
      assert_true (one.hash == two.hash);
      assert_true (two.shared > 0);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (in_open_water), cmocka_unit_test (cut_in_open_water),
          cmocka_unit_test (among_movers), cmocka_unit_test (switched_off_they_pass),
          cmocka_unit_test (the_same_comes_of_the_same) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
