/* The winch and what hangs from it: it pulls no harder than it can and holds no more than it can,
   at any rate, whatever hangs from it; what is cut comes home; a line parts at its ends too.

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

#include <bight/bight.h>

#include "math/vec.h"

#define STEP (1.0 / 60)
#define ROUNDING 1.01e-4 /* m: a line so near to where its winch stands has followed it */

/* ---- Chance ---- */

typedef struct dice
{
  uint64_t state;
} dice;

static double
chance (dice *d)
{
  uint64_t z = d->state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

static double
between (dice *d, double low, double high)
{
  return low + chance (d) * (high - low);
}

/* Alike in every decade.  */
static double
around (dice *d, double low, double high)
{
  return low * pow (high / low, chance (d));
}

static int
one_of (dice *d, int n)
{
  return (int)(chance (d) * n);
}

/* ---- Worlds ---- */

typedef enum hanging
{
  TO_POINT,
  TO_HANDS, /* a vehicle without mass */
  TO_BODY,
  HANGINGS
} hanging;

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_obstacle_def pile[2];
  hanging what;
} scene;

static void
hang (scene *s, hanging what, bt_vec3 at, dice *d)
{
  s->what = what;
  s->tether.to.at = at;
  if (what == TO_POINT)
    return;
  bt_def_set_name (s->vehicle.name, "rov", NULL);
  bt_def_set_name (s->tether.to.part, "rov", NULL);
  s->vehicle.at = at;
  s->world.vehicles = &s->vehicle;
  s->world.n_vehicles = 1;
  if (what != TO_BODY)
    return;
  double mass = around (d, 5, 2000), side = cbrt (mass / 1025);
  s->vehicle.mass = mass;
  s->vehicle.size = bt__vec (side, side, side);
  s->vehicle.added.along = bt__vec (mass / 2, mass / 2, mass / 2);
  s->vehicle.quadratic.along = bt__vec (20 * side, 20 * side, 20 * side);
}

/* A pile that the line leads past, so that it is drawn over it.  */
static void
raise_pile (scene *s, bt_vec3 to, dice *d)
{
  bt_def_init (bt_head_find ("cylinder"), s->pile);
  bt_def_set_name (s->pile[0].name, "pile", NULL);
  s->pile[0].radius = between (d, 0.2, 1);
  bt_vec3 middle = bt__scale (0.5, to), side = bt__vec (-to.y, to.x, 0);
  bt_vec3 foot = bt__axpy (middle, (s->pile[0].radius + 0.1) / bt__norm (side), side);
  s->pile[0].from = bt__vec (foot.x, foot.y, 5);
  s->pile[0].to = bt__vec (foot.x, foot.y, -90);
  s->tether.via.n = 1;
  s->tether.via.at[0] = bt__axpy (middle, (2 * s->pile[0].radius + 1.2) / bt__norm (side), side);
  s->world.obstacles = s->pile;
  s->world.n_obstacles = 1;
}

static double
straight_way (const scene *s)
{
  bt_vec3 a = s->tether.from.at, b = s->tether.to.at;
  if (s->tether.via.n == 0)
    return bt__distance (a, b);
  return bt__distance (a, s->tether.via.at[0]) + bt__distance (s->tether.via.at[0], b);
}

static void
draw (scene *s, hanging what, int among, bt_model_kind model, dice *d)
{
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  bt_def_init (bt_head_find ("rov"), &s->vehicle);
  bt_def_init (bt_head_find ("tether"), &s->tether);
  bt_vec3 to = { around (d, 5, 200), around (d, 1, 50), -between (d, 1, 80) };
  bt_def_set_name (s->tether.name, "line", NULL);
  hang (s, what, to, d);
  if (among)
    raise_pile (s, to, d);
  bt_tether_props *p = &s->tether.props;
  s->tether.length = straight_way (s) * (1.0005 + around (d, 1e-4, 0.3));
  p->model = model;
  p->ea = around (d, 2e3, 2e6);
  p->nodes = 8 + one_of (d, 56);
  p->wet_weight = one_of (d, 2) ? between (d, -1, 3) : 0;
  p->winch_pull = around (d, 20, 2000);
  p->winch_lag = one_of (d, 3) ? 0.25 : between (d, 0, 1);
  s->world.sea.current.kind = BT_CURRENT_UNIFORM;
  s->world.sea.current.velocity[0]
      = one_of (d, 2) ? bt__vec (between (d, -0.5, 0.5), between (d, -0.5, 0.5), 0)
                      : bt__vec (0, 0, 0);
  s->world.tethers = &s->tether;
  s->world.n_tethers = 1;
}

/* NULL for a world that cannot be: one whose line of lay meets the pile.  */
static bt_dive *
enter (const scene *s)
{
  bt_model *model;
  bt_dive *dive;
  bt_error error = { 0 };
  if (bt_model_new (&s->world, &model, &error) != BT_OK)
    return NULL;
  bt_status status = bt_dive_new (model, NULL, NULL, &dive, &error);
  bt_model_release (model);
  return status == BT_OK ? dive : NULL;
}

static bt_tether_view
look (const bt_dive *dive)
{
  bt_tether_view view;
  assert_int_equal (bt_dive_tether (dive, 0, &view, NULL), BT_OK);
  return view;
}

static void
step (bt_dive *dive)
{
  bt_error error = { 0 };
  if (bt_dive_step (dive, &error) != BT_OK)
    fail_msg ("%s", error.text);
}

static int
turn (bt_dive *dive, bt_op op, double metres, double rate)
{
  return bt_dive_do (dive, op, 0, (double[]){ metres, rate }, 2, NULL) == BT_OK;
}

static int
happened (const bt_dive *dive, bt_event_kind kind)
{
  bt_event event[BT_EVENTS_KEPT];
  int n = bt_dive_events (dive, 0, event), times = 0;
  for (int i = 0; i < n; i++)
    times += event[i].kind == (int64_t)kind;
  return times;
}

/* ---- What must hold at every look ---- */

/* The largest of all tensions that can be asked for is what `max-tension' says, or less.  */
static void
check_most (const bt_dive *dive, int seed)
{
  bt_tether_view v = look (dive);
  double tensions[2 * BT_NODES_MAX + 1], most = fmax (v.tension_anchor, v.tension_end);
  assert_int_equal (bt_tether_tensions (dive, 0, 0, tensions, NULL), BT_OK);
  for (int k = 0; k < v.nodes; k++)
    most = fmax (most, tensions[k]);
  if (!(v.tension_max >= most * (1 - 1e-9)))
    fail_msg ("seed %d at %g s: the most is %g N, but %g N are there", seed, bt_dive_time (dive),
              v.tension_max, most);
}

/* ---- Hauling ---- */

static int
longer (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 30 : 1;
}

/* By what one step at RATE stretches the line: as far as the tension runs in it.  */
static double
stretch_of_step (const scene *s, double length, double rate)
{
  const bt_tether_props *p = &s->tether.props;
  double mass = isnan (p->mass)
                    ? 1025 * BT__PI / 4 * p->diameter * p->diameter + fabs (p->wet_weight) / 9.8
                    : p->mass;
  return rate * fmax (p->ea * STEP / length, sqrt (p->ea * mass));
}

/* What the flow across the whole line, and its weight, can add once the winch stands.  */
static double
load_of_sea (const scene *s)
{
  const bt_tether_props *p = &s->tether.props;
  double u = bt__norm (s->world.sea.current.velocity[0]);
  double pressed = 0.5 * 1025 * p->cdn * p->diameter * u * u * s->tether.length;
  return 10 * pressed + fabs (p->wet_weight) * s->tether.length;
}

typedef struct tally
{
  int dives, stalls, spooled;
  double most, anywhere; /* of the limit: at the winch, and along the line */
} tally;

/* Haul until the winch stops, and look on for three seconds more.  */
static void
haul (const scene *s, bt_dive *dive, double rate, int seed, tally *t)
{
  double limit = s->tether.props.winch_pull, stopped = NAN;
  double begin = look (dive).tension_anchor, out = look (dive).length;
  double sea = load_of_sea (s), step_of = stretch_of_step (s, out, rate);
  assert_true (turn (dive, BT_OP_HAUL_IN, 0.9 * out, rate));
  for (int k = 0, after = 0; k < 1200 && after < 180; k++)
    {
      step (dive);
      bt_tether_view v = look (dive);
      check_most (dive, seed);
      int stopping = isnan (stopped) && happened (dive, BT_EVENT_STALLED) > 0;
      if (v.length > out + ROUNDING)
        fail_msg ("seed %d at %g s: %g m out, after %g m", seed, bt_dive_time (dive), v.length,
                  out);
      if (v.tension_anchor > limit * (1 + 1e-6) && v.length < out - ROUNDING)
        fail_msg ("seed %d at %g s: drew in %g m with %g N, not %g", seed, bt_dive_time (dive),
                  out - v.length, v.tension_anchor, limit);
      out = v.length;
      after += !v.spooling;
      if (stopping)
        stopped = v.length;
      if (!isnan (stopped) && v.length != stopped)
        fail_msg ("seed %d: drawn in after the stall, %g m", seed, stopped - v.length);
      if (s->what == TO_BODY || begin > limit)
        continue;
      t->most = fmax (t->most, v.tension_anchor / limit);
      t->anywhere = fmax (t->anywhere, v.tension_max / limit);
      /* The wave that the stall sends along is doubled where the far end stands.  */
      if (v.tension_anchor > limit + step_of + sea || v.tension_max > limit + 2 * step_of + sea)
        fail_msg ("seed %d at %g s: %g N at the winch, %g N anywhere, limit %g N, a step's stretch "
                  "%g N, the sea's %g N",
                  seed, bt_dive_time (dive), v.tension_anchor, v.tension_max, limit, step_of, sea);
    }
  t->dives++;
  t->stalls += happened (dive, BT_EVENT_STALLED) > 0;
  t->spooled += happened (dive, BT_EVENT_SPOOLED) > 0;
}

/* At any rate, stiffness, length and lag, whatever hangs there.  */
static void
test_limit (void **unused)
{
  (void)unused;
  for (int what = 0; what < HANGINGS; what++)
    for (int among = 0; among < 2; among++)
      {
        tally t = { 0 };
        for (int seed = 0; seed < 12 * longer (); seed++)
          {
            dice d = { (uint64_t)(seed + 1000 * (2 * what + among)) };
            scene s;
            draw (&s, (hanging)what, among, seed % 3 ? BT_MODEL_DYNAMIC : BT_MODEL_AUTO, &d);
            double rate = around (&d, 0.01, 20);
            bt_dive *dive = enter (&s);
            if (!dive)
              continue;
            haul (&s, dive, rate, seed, &t);
            bt_dive_free (dive);
          }
        print_message ("# hauled %s%s: %d dives, %d stalls, %d in whole; at most %.3f of the limit "
                       "at the winch, %.3f anywhere\n",
                       what == TO_POINT   ? "from a post"
                       : what == TO_HANDS ? "from hands"
                                          : "a body",
                       among ? " past a pile" : "", t.dives, t.stalls, t.spooled, t.most,
                       t.anywhere);
        assert_true (t.dives > 5 && t.stalls + t.spooled > 0);
        assert_true (what == TO_BODY || t.stalls > 0);
      }
}

/* ---- The brake ---- */

/* A vehicle flies off: the line runs out at the brake, never in, and to the end of the drum.  */
static void
test_brake (void **unused)
{
  (void)unused;
  double held = 0, ran = 0;
  int at_the_end = 0;
  for (int seed = 0; seed < 12 * longer (); seed++)
    {
      dice d = { (uint64_t)seed + 77 };
      scene s;
      draw (&s, TO_HANDS, 0, seed % 3 ? BT_MODEL_DYNAMIC : BT_MODEL_AUTO, &d);
      s.vehicle.pull = 1e6;
      s.tether.props.winch_brake = around (&d, 30, 3000);
      s.tether.drum = s.tether.length * between (&d, 1, 2);
      s.world.sea.current.velocity[0] = bt__vec (0, 0, 0);
      bt_dive *dive = enter (&s);
      if (!dive)
        continue; /* a line that cannot be */
      double begin = look (dive).tension_anchor, out = look (dive).length;
      double brake = fmax (begin, s.tether.props.winch_brake) * (1 + 1e-6);
      bt_vec3 away = bt__scale (5, s.vehicle.at);
      double to[] = { away.x, away.y, away.z, between (&d, 0.1, 3) };
      assert_int_equal (bt_dive_do (dive, BT_OP_MOVE, 0, to, 4, NULL), BT_OK);
      for (int k = 0; k < 1200; k++)
        {
          step (dive);
          bt_tether_view v = look (dive);
          check_most (dive, seed);
          if (v.length < out || v.length > s.tether.drum * (1 + 1e-12))
            fail_msg ("seed %d: %g m out, after %g m, of %g", seed, v.length, out, s.tether.drum);
          if (v.length < s.tether.drum - 1e-6 && v.tension_anchor > brake)
            fail_msg ("seed %d at %g s: the brake holds %g N, not %g", seed, bt_dive_time (dive),
                      v.tension_anchor, brake);
          if (v.length < s.tether.drum - 1e-6)
            held = fmax (held, v.tension_anchor / brake);
          out = v.length;
        }
      ran = fmax (ran, out - s.tether.length);
      at_the_end += out > s.tether.drum - 1e-6;
      bt_dive_free (dive);
    }
  print_message ("# the brake held %.4f of what it holds at most; %.1f m ran out at most; the drum "
                 "was empty %d times\n",
                 held, ran, at_the_end);
  assert_true (held > 0.99 && ran > 5 && at_the_end > 0);
}

/* A brake that holds less than the drag of what is at the drum: a neutral line is drawn by its
   vehicle, no faster than the vehicle flies, and every step is solved.  */
static void
test_weak_brake (void **unused)
{
  (void)unused;
  for (int seed = 0; seed < 8 * longer (); seed++)
    {
      dice d = { (uint64_t)seed + 501 };
      scene s;
      draw (&s, TO_HANDS, 0, BT_MODEL_DYNAMIC, &d);
      double rate = between (&d, 0.1, 3), flown = 0;
      s.vehicle.pull = 1e6;
      s.tether.props.winch_brake = around (&d, 1e-6, 1e-2);
      s.tether.props.wet_weight = 0;
      s.world.sea.current.velocity[0] = bt__vec (0, 0, 0);
      bt_dive *dive = enter (&s);
      assert_non_null (dive);
      double begin = look (dive).length, span = bt__norm (s.vehicle.at);
      bt_vec3 away = bt__scale (5, s.vehicle.at);
      double to[] = { away.x, away.y, away.z, rate };
      assert_int_equal (bt_dive_do (dive, BT_OP_MOVE, 0, to, 4, NULL), BT_OK);
      for (int k = 0; k < 600; k++, flown += rate * STEP)
        step (dive);
      double out = look (dive).length;
      if (!(out > span + flown - 1e-3 * begin - rate && out < begin + 1.02 * flown + 0.1))
        fail_msg ("seed %d: %g m out of %g, %g m flown, %g m apart at first", seed, out, begin,
                  flown, span);
      bt_profile profile;
      bt_dive_profile (dive, &profile);
      if (profile.chain_unconverged > 0)
        fail_msg ("seed %d: %d steps were not solved", seed, (int)profile.chain_unconverged);
      bt_dive_free (dive);
    }
}

/* ---- Ends ---- */

/* Whatever the model, the most is no less than what is at the ends.  */
static void
test_most_is_at_least_the_ends (void **unused)
{
  (void)unused;
  int dives = 0;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    for (int seed = 0; seed < 12 * longer (); seed++)
      {
        dice d = { (uint64_t)(seed + 500 * model) };
        scene s;
        draw (&s, (hanging)one_of (&d, HANGINGS), one_of (&d, 2), (bt_model_kind)model, &d);
        s.tether.props.wet_weight = between (&d, -2, 10);
        s.tether.props.nodes = 2 + one_of (&d, 20);
        bt_dive *dive = enter (&s);
        if (!dive)
          continue;
        dives++;
        check_most (dive, seed);
        for (int k = 0; k < 60; k++)
          {
            if (k == 20)
              turn (dive, one_of (&d, 2) ? BT_OP_PAY_OUT : BT_OP_HAUL_IN, 1, 1);
            if (bt_dive_step (dive, NULL) != BT_OK)
              break;
            check_most (dive, seed);
          }
        bt_dive_free (dive);
      }
  print_message ("# %d dives of every model: nowhere more than the most\n", dives);
  assert_true (dives > 6 * BT_MODEL_AUTO);
}

/* A heavy line of few nodes bears its own weight at the top, where no interval has its middle: it
   parts at what it bears there.  */
static void
test_parts_at_its_end (void **unused)
{
  (void)unused;
  for (int above = 0; above < 2; above++)
    {
      scene s = { .what = TO_POINT };
      bt_def_init (bt_head_find ("sea"), &s.world.sea);
      bt_def_init (bt_head_find ("tether"), &s.tether);
      s.world.sea.depth = 200;
      bt_def_set_name (s.tether.name, "line", NULL);
      s.tether.to.at = bt__vec (0, 0, -100);
      s.tether.length = 99.9; /* 1000 N */
      s.tether.props.wet_weight = 5;
      s.tether.props.ea = 1e6;
      s.tether.props.nodes = 10;
      s.tether.props.model = BT_MODEL_DYNAMIC;
      /* 250 N on either side of its middle; the middle of the first interval bears 1226 N.  */
      s.tether.props.breaking_load = above ? 1255 : 1246;
      s.world.tethers = &s.tether;
      s.world.n_tethers = 1;
      bt_dive *dive = enter (&s);
      assert_non_null (dive);
      for (int k = 0; k < 60; k++)
        step (dive);
      assert_int_equal (look (dive).parted, !above);
      bt_dive_free (dive);
    }
}

/* ---- What is cut ---- */

/* No point of what is left is farther from the winch than along the line: but for its stretch, and
   for what the curve through its nodes strays in an interval.  */
static void
check_reach (const bt_dive *dive, int seed)
{
  bt_tether_view v = look (dive);
  double stretch = 1.01 + v.tension_max / v.props.ea, interval = v.length / (v.nodes - 1);
  bt_vec3 p[41];
  assert_int_equal (bt_tether_points (dive, 0, 41, p, NULL), BT_OK);
  for (int k = 0; k < 41; k++)
    {
      double s = v.length * k / 40, away = bt__distance (p[0], p[k]);
      if (!bt__is_finite (p[k]) || away > stretch * s + interval)
        fail_msg ("seed %d: %g m along the line, %g m away", seed, s, away);
    }
}

static void
check_free_end (const bt_dive *dive, int seed)
{
  bt_tether_view v = look (dive);
  int taut = 1;
  assert_int_equal (bt_tether_is_taut (dive, 0, &taut, NULL), BT_OK);
  assert_false (taut);
  assert_true (v.parted && !v.taut);
  if (v.chord > v.length * (1.01 + v.tension_max / v.props.ea) + 0.3)
    fail_msg ("seed %d: %g m of line reach %g m", seed, v.length, v.chord);
  check_reach (dive, seed);
  check_most (dive, seed);
}

/* It is hauled home, more than is left; a copy does the same; it can be paid out again.  */
static void
test_cut_comes_home (void **unused)
{
  (void)unused;
  int home = 0, dives = 0, caught = 0;
  for (int seed = 0; seed < 20 * longer (); seed++)
    {
      dice d = { (uint64_t)seed + 4711 };
      scene s;
      draw (&s, (hanging)one_of (&d, HANGINGS), seed % 2,
            seed % 3 ? BT_MODEL_DYNAMIC : BT_MODEL_AUTO, &d);
      s.tether.props.winch_pull = around (&d, 100, 1000);
      if (seed % 4 == 0)
        s.tether.drum = 1.2 * s.tether.length;
      bt_dive *dive = enter (&s), *copy;
      if (!dive)
        continue;
      dives++;
      for (int k = 0; k < 30; k++)
        step (dive);
      double out = look (dive).length, at = out * chance (&d), rate = around (&d, 0.2, 10);
      assert_int_equal (bt_dive_do (dive, BT_OP_CUT, 0, &at, 1, NULL), BT_OK);
      if (isfinite (s.tether.drum))
        {
          assert_true (!turn (dive, BT_OP_PAY_OUT, s.tether.drum - out + 0.01, 1));
          assert_true (turn (dive, BT_OP_PAY_OUT, s.tether.drum - out - 0.01, 1));
        }
      for (int k = 0; k < 60; k++) /* until the jerk is over */
        step (dive);
      double left = look (dive).length;
      assert_true (turn (dive, BT_OP_HAUL_IN, 2 * left + 1, rate));
      assert_true (look (dive).target <= 0.1);
      assert_int_equal (bt_dive_fork (dive, &copy, NULL), BT_OK);
      int most = (int)fmin (60 * (left / rate + 20), 3000);
      for (int k = 0; k < most; k++)
        {
          step (dive);
          step (copy);
          if (k % 20 == 0)
            check_free_end (dive, seed);
        }
      assert_true (bt_dive_hash (dive) == bt_dive_hash (copy));
      bt_dive_free (copy);
      bt_tether_view v = look (dive);
      assert_true (v.length < left);
      home += v.length <= 0.1;
      caught += happened (dive, BT_EVENT_STALLED) > 0;
      if (v.length <= 0.1)
        {
          assert_true (v.chord < 0.2 && v.tension_anchor < 20 && !v.spooling);
          assert_true (turn (dive, BT_OP_HAUL_IN, 1, 1) && !look (dive).spooling);
          assert_true (turn (dive, BT_OP_PAY_OUT, 3, 1));
          for (int k = 0; k < 1200 && look (dive).spooling; k++)
            step (dive);
          check_free_end (dive, seed);
          assert_true (fabs (look (dive).length - v.length - 3) < 1e-9);
        }
      bt_dive_free (dive);
    }
  print_message ("# %d cut lines: %d came home, %d stalled their winch on the way\n", dives, home,
                 caught);
  assert_true (dives > 10 && home > dives / 2);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_limit),
    cmocka_unit_test (test_brake),
    cmocka_unit_test (test_weak_brake),
    cmocka_unit_test (test_most_is_at_least_the_ends),
    cmocka_unit_test (test_parts_at_its_end),
    cmocka_unit_test (test_cut_comes_home),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
