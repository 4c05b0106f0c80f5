/* The line passes through nothing: a pilot in a jacket, wires at speed, junk of every kind, a
   solver whose results are overwritten.  The judge shares nothing with the engine; without the
   guard he objects.

   Short of steps by default, more with BIGHT_LONG=1 in the environment.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

enum
{
  LINKS = 100
};

/* A line from outside the jacket, all of it clear.  */
static void
enter (rope *p, reef *r, int links, uint64_t seed)
{
  const bt_vec3 shape[] = { { -14, 0, -5 }, { -16, -20, -8 }, { -12, -20, -8 }, { -9, 0, -8 } };
  assert_true (reef_jacket (r, seed));
  assert_true (rope_open (p, r, links, shape, 4, 60, 0.3));
  p->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { { -0.15, 0.1, 0 } } };
}

static void
leave (rope *p, reef *r)
{
  rope_close (p);
  reef_close (r);
}

static bt_vec3
somewhere (dice *d)
{
  return bt__vec (dice_between (d, -9, 9), dice_between (d, -9, 9), dice_between (d, -28, -1));
}

/* A vehicle's thrust toward TARGET.  */
static void
thrust (rope *p, bt_vec3 target)
{
  bt_vec3 way = bt__sub (target, bt__dynamic_x (p->d)[p->d->n]);
  double far = bt__norm (way);
  bt_vec3 want = bt__scale (fmin (1.5, far) / fmax (far, 1e-9), way);
  bt_vec3 f = bt__scale (200, bt__sub (want, bt__dynamic_v (p->d)[p->d->n]));
  double size = bt__norm (f);
  p->in.end[1].body.force = size > 150 ? bt__scale (150 / size, f) : f;
}

/* Fly STEPS aimed straight through whatever is there.  */
static void
fly (rope *p, dice *d, long steps, long judge_every)
{
  bt_vec3 target = { 0, 0, -8 };
  long until = 0;
  for (long i = 0; i < steps; i++)
    {
      if (i >= until || bt__distance (bt__dynamic_x (p->d)[p->d->n], target) < 0.3)
        {
          target = somewhere (d);
          until = i + 900;
        }
      if (p->in.end[1].free)
        thrust (p, target);
      else
        rope_tow (p, target, 1.5, frame);
      rope_step (p, frame, 1);
      if (i % judge_every == 0)
        assert_kept (p, "a pilot in a jacket");
    }
}

static void
report (const rope *p, const char *what)
{
  print_message ("# %s: %ld steps, %.2f solves each, %ld truncated, %ld unsolved, %ld touches at "
                 "most, tension to %.0f N\n",
                 what, p->steps, (double)p->solves / (double)p->steps, p->truncated, p->unconverged,
                 p->most_touches, p->tension);
}

static void
pilot (int body, uint64_t seed)
{
  static reef r;
  static rope p;
  dice d = dice_new (7 * seed + 1);
  enter (&p, &r, LINKS, seed);
  if (body)
    p.in.end[1] = (bt__dynamic_end){ .free = 1, .body = { .mass = 20, .quadratic = 60 } };
  fly (&p, &d, is_long () ? 100000 : 2000, is_long () ? 500 : 200);
  report (&p, body ? "a vehicle with mass" : "a towed end");
  assert_kept (&p, "a pilot in a jacket");
  assert_true (p.most_touches >= 4);
  assert_true (p.truncated <= p.steps / 1000);
  assert_true (p.unconverged <= p.steps / 50);
  leave (&p, &r);
}

static void
pilots (void **state)
{
  (void)state;
  pilot (0, 3);
  pilot (1, 3);
}

/* ---- Junk ---- */

typedef struct junk
{
  dice d;
} junk;

static void
spoil (void *user, const bt_vec3 *from, bt_vec3 *to, int nodes)
{
  junk *j = user;
  (void)from;
  for (int i = 0; i < nodes; i++)
    {
      to[i] = bt__add (to[i], dice_point (&j->d, 3));
      int bad = dice_below (&j->d, 100);
      if (bad == 0)
        to[i].x = NAN;
      else if (bad == 1)
        to[i] = dice_point (&j->d, 1e9);
    }
}

/* Targets 25 m off and not finite for STEPS.  */
static void
throw_about (rope *p, dice *d, long steps)
{
  bt_vec3 target = { 0, 0, -8 };
  for (long i = 0; i < steps; i++)
    {
      if (i % 5 == 0)
        target = bt__add (bt__dynamic_x (p->d)[p->d->n], dice_point (d, i % 3 ? 25 : 2));
      p->in.end[1].at = target;
      if (dice_below (d, 100) == 0)
        p->in.end[1].at.y = NAN;
      rope_step (p, frame, 1);
    }
}

static void
adversary (double pull, int spoiled, const char *what)
{
  static reef r;
  static rope p;
  junk j = { dice_new (11) };
  dice d = dice_new (5);
  enter (&p, &r, 60, 2);
  p.config.pull[1] = pull;
  p.hook.user = &j;
  fly (&p, &d, 600, 600); /* among the members first */
  p.hook.spoil = spoiled ? spoil : NULL;
  long from = p.steps;
  throw_about (&p, &d, is_long () ? 20000 : 200);
  report (&p, what);
  assert_true (p.steps > from);
  assert_kept (&p, what);
  leave (&p, &r);
}

static void
junk_of_all_kinds (void **state)
{
  (void)state;
  adversary (150, 0, "targets 25 m off");
  adversary (1e5, 0, "pulled by 100 kN");
  adversary (INFINITY, 0, "pulled by whatever it takes");
  adversary (150, 1, "solver overwritten");
}

/* A line thrown about at 100 kN is as it was within a second.  */
static void
recovers (void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 3; seed++)
    {
      static reef r;
      static rope p;
      dice d = dice_new (seed);
      enter (&p, &r, 60, seed);
      p.config.pull[1] = 1e5;
      fly (&p, &d, 600, 600);
      throw_about (&p, &d, 150);
      p.config.pull[1] = 150;
      for (int i = 0; i < 60; i++)
        {
          rope_tow (&p, bt__vec (-9, 0, -8), 1.5, frame);
          rope_step (&p, frame, 1);
        }
      print_message ("# a second later: %.0f N\n", p.report.tension);
      assert_below (p.report.tension, 2000, "the tension a second after 100 kN");
      assert_kept (&p, "recovery");
      leave (&p, &r);
    }
}

/* ---- Wires ---- */

/* The crossings of a sweep.  */
static long
sweep_wire (int k, double speed, int links, int mutant, dice *d)
{
  static reef r;
  static rope p;
  sweep_onto_wire (&p, &r, k, links, speed, 60, mutant, d);
  long crossings = p.crossings;
  if (!mutant)
    assert_kept (&p, "a wire");
  leave (&p, &r);
  return crossings;
}

static void
wires (void **state)
{
  (void)state;
  dice d = dice_new (5);
  int cases = is_long () ? 200 : 8;
  for (int k = 0; k < cases; k++)
    {
      assert_int_equal (sweep_wire (k, 20, 80, 0, &d), 0);
      assert_int_equal (sweep_wire (k, 20, 20, 0, &d), 0);
      assert_int_equal (sweep_wire (k, 6, 20, 0, &d), 0);
    }
}

/* ---- Mutants: the judge can say no ---- */

static void
mutants (void **state)
{
  (void)state;
  dice d = dice_new (5);
  long through = 0;
  for (int k = 0; k < 8; k++)
    through += sweep_wire (k, 20, 20, 1, &d);
  assert_true (through > 0);
  static reef r;
  static rope p;
  enter (&p, &r, 60, 2);
  p.hook.no_guard = 1; /* contacts alone, and a solver that errs */
  junk j = { dice_new (11) };
  p.hook.user = &j;
  fly (&p, &d, 300, 10000);
  p.hook.spoil = spoil;
  throw_about (&p, &d, 100);
  assert_true (p.crossings > 0);
  leave (&p, &r);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (pilots), cmocka_unit_test (junk_of_all_kinds),
          cmocka_unit_test (recovers), cmocka_unit_test (wires), cmocka_unit_test (mutants) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
