/* The wear of a tether's jacket: a line hauled half round a drum is worn by the work of friction,
   T (e^(mu pi) - 1) a metre; what was worn stays with the material; it costs nothing where nothing
   slides.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "../oracle/dive_scene.h"
#include "testbed/profile.h"
#include "testbed/solids.h"
#include "contact/wear.h"
#include "math/vec.h"

#define DRUM 0.6      /* m */
#define PULL 30.0     /* N */
#define ENERGY 1e4    /* J/m */
#define LENGTH 14.0   /* m */
#define HAUL_RATE 0.2 /* m/s */

static void
assert_near (double is, double wanted, double tolerance, const char *what)
{
  if (!(fabs (is - wanted) <= tolerance))
    fail_msg ("%s: %.10g is not %.10g within %.3g", what, is, wanted, tolerance);
}

/* ---- A line half round a drum, a vehicle that pulls, a winch that hauls ---- */

static void
half_round (scene *s, double mu)
{
  double r = DRUM + 0.0038;
  begin_scene (s, BT_MODEL_DYNAMIC);
  s->world.sea.current.velocity[0] = (bt_vec3){ 0, 0, 0 };
  add_post (s, "cylinder", "drum", bt__vec (0, 0, 0), bt__vec (0, 0, 1), DRUM);
  s->vehicle[0].at = bt__vec (5.5, 1.001 * r, -6);
  s->vehicle[0].pull = PULL;
  s->tether[0].from.at = bt__vec (6, -1.001 * r, -6);
  s->tether[0].via.n = 2;
  s->tether[0].via.at[0] = bt__vec (-1.1 * r, -1.1 * r, -6);
  s->tether[0].via.at[1] = bt__vec (-1.1 * r, 1.1 * r, -6);
  s->tether[0].length = LENGTH;
  s->tether[0].props.nodes = 64;
  s->tether[0].props.cdt = 0;
  s->tether[0].props.friction = mu;
  s->tether[0].props.wear_energy = ENERGY;
}

static bt_tether_view
view_of (const bt_dive *dive)
{
  bt_tether_view v;
  assert_int_equal (bt_dive_tether (dive, 0, &v, NULL), BT_OK);
  return v;
}

static double
worn_at (const bt_dive *dive, double s)
{
  double share = NAN;
  assert_int_equal (bt_tether_wear_at (dive, 0, s, &share, NULL), BT_OK);
  return share;
}

static double
worn (const bt_dive *dive)
{
  double share = NAN;
  assert_int_equal (bt_tether_wear (dive, 0, &share, NULL), BT_OK);
  return share;
}

/* J done on all that is out.  */
static double
work_on (const bt_dive *dive)
{
  enum
  {
    PLACES = 20000
  };
  double length = view_of (dive).length, sum = 0;
  for (int k = 0; k < PLACES; k++)
    sum += worn_at (dive, length * (k + 0.5) / PLACES);
  return sum * ENERGY * length / PLACES;
}

static void
go (bt_dive *dive, double seconds)
{
  for (int k = 0; k < (int)(60 * seconds + 0.5); k++)
    assert_true (step (dive));
}

/* Begin a dive in S with the line drawn tight: the vehicle pulls away from the drum.  */
static bt_dive *
tight (const scene *s)
{
  bt_dive *dive = enter (s);
  double far[] = { 40, s->vehicle[0].at.y, -6, 0.5 };
  assert_int_equal (operate (dive, BT_OP_MOVE, 0, 4, far), BT_OK);
  go (dive, 20);
  assert_near (view_of (dive).tension_end, PULL, 0.02 * PULL, "the pull");
  return dive;
}

/* Haul in METRES at HAUL_RATE; return the J that the capstan's law gives.  */
static double
haul (bt_dive *dive, double mu, double metres)
{
  double sum = 0, length = view_of (dive).length;
  assert_int_equal (operate (dive, BT_OP_HAUL_IN, 0, 2, (double[]){ metres, HAUL_RATE }), BT_OK);
  for (int k = 0; k < (int)(60 * (metres / HAUL_RATE + 3)); k++)
    {
      assert_true (step (dive));
      bt_tether_view v = view_of (dive);
      sum += (length - v.length) * v.tension_end * expm1 (mu * BT__PI);
      length = v.length;
    }
  return sum;
}

static void
is_the_work_of_friction (void **state)
{
  (void)state;
  const double mu[] = { 0.1, 0.3, 0.6 };
  for (int k = 0; k < 3; k++)
    {
      scene s;
      half_round (&s, mu[k]);
      bt_dive *dive = tight (&s);
      double before = work_on (dive), wanted = haul (dive, mu[k], 3);
      /* What has passed all of the drum; the anchor's leg is 6 m, half a turn 1.9 m.  */
      double work = work_on (dive) - before, passed = worn_at (dive, 5), metre = wanted / 3;
      print_message ("# mu %.1f: %.3f J, T (e^(mu pi) - 1) s %.3f J; %.3f J/m where all passed, "
                     "exactly %.3f\n",
                     mu[k], work, wanted, passed * ENERGY, metre);
      assert_near (work / wanted, 1, 0.02, "the work");
      assert_near (passed * ENERGY / metre, 1, 0.1, "the work on a metre");
      bt_dive_free (dive);
    }
}

/* ---- It is the material's ---- */

/* Place K of a hundred on LENGTH metres, m from the anchor; none on the edge of a spot, where the
   last bit says which spot it is in.  */
static double
place (double length, int k)
{
  return length * (k + 0.618) / 100;
}

static void
stays_with_the_material (void **state)
{
  (void)state;
  scene s;
  double kept[100];
  half_round (&s, 0.3);
  bt_dive *dive = tight (&s);
  haul (dive, 0.3, 2);
  assert_int_equal (operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ BT_PART_TETHER, 0, 0 }), BT_OK);
  double length = view_of (dive).length;
  for (int k = 0; k < 100; k++)
    kept[k] = worn_at (dive, place (length, k));
  assert_int_equal (operate (dive, BT_OP_PAY_OUT, 0, 2, (double[]){ 1.5, 0.5 }), BT_OK);
  go (dive, 6);
  double out = view_of (dive).length;
  assert_near (out, length + 1.5, 1e-9, "what is out");
  assert_int_equal (operate (dive, BT_OP_CUT, 0, 1, (double[]){ out - 2 }), BT_OK);
  double left = view_of (dive).length;
  int compared = 0;
  for (int k = 0; k < 100; k++)
    if (place (length, k) + 1.5 < left)
      {
        assert_near (worn_at (dive, place (length, k) + 1.5), kept[k], 1e-12, "a spot");
        compared += kept[k] > 0;
      }
  assert_true (compared > 10);
  bt_dive_free (dive);
}

/* ---- What makes it, and what does not ---- */

static double
worn_by (double abrasiveness)
{
  scene s;
  half_round (&s, 0.3);
  s.obstacle[0].abrasiveness = abrasiveness;
  bt_dive *dive = tight (&s);
  haul (dive, 0.3, 1);
  double share = worn (dive);
  bt_dive_free (dive);
  return share;
}

static void
goes_as_the_abrasiveness (void **state)
{
  (void)state;
  double steel = worn_by (1);
  assert_true (steel > 0);
  assert_near (worn_by (7) / steel, 7, 1e-9, "seven times as rough");
  assert_true (worn_by (0) == 0);
}

/* Nothing is added where nothing slides: clear of all, or stuck.  */
static void
costs_nothing_else (void **state)
{
  (void)state;
  scene s;
  begin_scene (&s, BT_MODEL_DYNAMIC);
  add_post (&s, "cylinder", "far", bt__vec (0, 200, 0), bt__vec (0, 0, 1), DRUM);
  bt_dive *dive = enter (&s);
  go (dive, 10);
  assert_true (profile_of (dive).chafes == 0 && worn (dive) == 0);
  bt_dive_free (dive);
  half_round (&s, 0.6);
  dive = tight (&s);
  go (dive, 20);
  bt_profile before = profile_of (dive);
  double share = worn (dive);
  go (dive, 20);
  bt_profile after = profile_of (dive);
  assert_true (after.touches > before.touches + 1200);
  assert_true (after.chafes - before.chafes < (after.touches - before.touches) / 20);
  assert_near (worn (dive), share, 1e-6 * share, "what sticks");
  bt_dive_free (dive);
}

static int
times_told (const bt_dive *dive, int *object)
{
  bt_event kept[BT_EVENTS_KEPT];
  int n = bt_dive_events (dive, 0, kept), told = 0;
  for (int k = 0; k < n; k++)
    if (kept[k].kind == BT_EVENT_WORN)
      {
        told++;
        *object = (int)kept[k].object;
      }
  return told;
}

static void
is_told_once (void **state)
{
  (void)state;
  scene s;
  int object = -1;
  half_round (&s, 0.3);
  s.tether[0].props.wear_limit = 0.5 * PULL * expm1 (0.3 * BT__PI) / ENERGY;
  bt_dive *dive = tight (&s);
  assert_int_equal (times_told (dive, &object), 0);
  haul (dive, 0.3, 3);
  assert_true (worn (dive) > s.tether[0].props.wear_limit);
  assert_int_equal (times_told (dive, &object), 1);
  assert_int_equal (object, 0);
  bt_dive_free (dive);
}

/* ---- The spots ---- */

/* Wherever it falls, none of it is lost.  */
static void
nothing_is_lost (void **state)
{
  (void)state;
  const double length[] = { 0.01, 3, 50, 4000 };
  dice d = dice_new (5);
  for (int k = 0; k < 4; k++)
    {
      bt__wear w = { NULL, bt__wear_spots (length[k]), bt__wear_width (length[k]) };
      double done = 0, sum = 0;
      w.spot = calloc ((size_t)w.n, sizeof *w.spot);
      assert_non_null (w.spot);
      assert_near (w.n * w.width, 2 * length[k], 1e-9, "what the spots cover");
      for (int i = 0; i < 2000; i++)
        {
          double at = dice_between (&d, -1, 3 * length[k]), span = dice_between (&d, 0, 2),
                 work = dice_between (&d, 0, 10);
          double most = bt__wear_add (&w, at, span, work);
          done += work;
          assert_true (most > 0 && most >= bt__wear_at (&w, fmin (fmax (at, 0), 2 * length[k])));
        }
      for (int i = 0; i < w.n; i++)
        sum += w.spot[i] * w.width;
      assert_near (sum / done, 1, 1e-12, "the whole");
      free (w.spot);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (is_the_work_of_friction),
                                      cmocka_unit_test (stays_with_the_material),
                                      cmocka_unit_test (goes_as_the_abrasiveness),
                                      cmocka_unit_test (costs_nothing_else),
                                      cmocka_unit_test (is_told_once),
                                      cmocka_unit_test (nothing_is_lost) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
