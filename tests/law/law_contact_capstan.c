/* A line drawn over a drum: T2 / T1 = e^(mu theta) at every coefficient, turn and link length;
   where it stops it stays.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define DRUM 0.6 /* m */
#define LEG 1.5
#define SPEED 0.1

typedef struct capstan
{
  reef reef;
  rope rope;
  double theta;
  bt_vec3 along, at; /* the tangent of the hauled leg; its end */
} capstan;

enum
{
  CORNERS = 402
};

/* A line about TURNS of a drum, its links SHARE of the drum's radius, R from the axis, a weight on
   the near end, LEG m off.  */
static void
wind_wider (capstan *c, double share, double mu, double turns, double r, double leg)
{
  static bt_vec3 shape[CORNERS + 1];
  double link = share * DRUM, rise = turns > 0.75 ? 0.15 * turns : 0;
  c->theta = 2 * BT__PI * turns;
  assert_true (reef_open (&c->reef));
  reef_cylinder (&c->reef, bt__vec (0, -5, 0), bt__vec (0, 5, 0), DRUM);
  assert_true (reef_raise (&c->reef));
  shape[0] = bt__vec (-r, 0, -leg);
  for (int i = 1; i < CORNERS; i++)
    {
      double u = (i - 1) / (CORNERS - 2.0), a = BT__PI - c->theta * u;
      shape[i] = bt__vec (r * cos (a), rise * u, r * sin (a));
    }
  double a = BT__PI - c->theta;
  c->along = bt__vec (sin (a), 0, -cos (a));
  bt_vec3 out = bt__vec (cos (a), 0, sin (a));
  c->at = bt__axpy (shape[CORNERS - 1], DRUM + 0.005 - r, out);
  c->at = shape[CORNERS] = bt__axpy (c->at, leg + 0.5, c->along);
  double length = bt__length (shape, CORNERS + 1);
  assert_true (
      rope_open (&c->rope, &c->reef, (int)(length / link + 0.5), shape, CORNERS + 1, length, mu));
  c->rope.line.cdt = 0;
  c->rope.in.end[0]
      = (bt__dynamic_end){ .free = 1, .body = { .mass = 1, .linear = 20, .force = { 0, 0, -30 } } };
  c->rope.config.pull[1] = INFINITY;
}

static void
wind (capstan *c, double share, double mu, double turns)
{
  wind_wider (c, share, mu, turns, 1.0001 * (DRUM + 0.005) / cos (share / 2), LEG);
}

/* Haul for STEPS at SPEED; return the ratio of the tensions over the second half.  */
static double
haul_at (capstan *c, int steps, double speed)
{
  const double *t = bt__dynamic_tension (c->rope.d);
  double low = 0, high = 0;
  for (int i = 0; i < steps; i++)
    {
      c->at = bt__axpy (c->at, speed * frame * fmin (1, i / 60.0), c->along);
      c->rope.in.end[1].at = c->at;
      assert_true (rope_step (&c->rope, frame, 0));
      if (i >= steps / 2)
        {
          low += t[1];
          high += t[c->rope.d->n - 2];
        }
    }
  return high / low;
}

static double
haul (capstan *c, int steps)
{
  return haul_at (c, steps, SPEED);
}

/* The least and the most tension, N.  */
typedef struct spread
{
  double least, most;
} spread;

/* Haul on for STEPS at SPEED; the tension of the link FROM_END from the hauled end.  */
static spread
haul_on (capstan *c, int steps, double speed, int from_end, int judged)
{
  const double *t = bt__dynamic_tension (c->rope.d);
  spread s = { INFINITY, 0 };
  for (int i = 0; i < steps; i++)
    {
      c->at = bt__axpy (c->at, speed * frame, c->along);
      c->rope.in.end[1].at = c->at;
      assert_true (rope_step (&c->rope, frame, judged));
      s.least = fmin (s.least, t[c->rope.d->n - from_end]);
      s.most = fmax (s.most, t[c->rope.d->n - from_end]);
    }
  return s;
}

static void
unwind (capstan *c)
{
  rope_close (&c->rope);
  reef_close (&c->reef);
}

static void
check (double share, double mu, double turns)
{
  static capstan c;
  wind (&c, share, mu, turns);
  double ratio = haul (&c, 400), wanted = exp (mu * c.theta);
  print_message ("# link %.2f R, mu %.1f, %.2f turns: %.4f, exactly %.4f, %.2f solves a step\n",
                 share, mu, turns, ratio, wanted, (double)c.rope.solves / (double)c.rope.steps);
  assert_near (ratio / wanted, 1, 0.01, "the ratio of tensions");
  assert_int_equal (c.rope.truncated, 0);
  unwind (&c);
}

/* Links as long as the drum is thick, or longer, are held where they turn: no ripple either.  */
static void
check_long (double share, double mu, double turns, double speed)
{
  static capstan c;
  double link = share * DRUM, around = DRUM + 0.005;
  wind_wider (&c, share, mu, turns, 1.001 * sqrt (around * around + link * link / 4), 4 + 3 * link);
  double ratio = haul_at (&c, 1500, speed), wanted = exp (mu * c.theta);
  spread t = haul_on (&c, 120, speed, 1, 1);
  print_message (
      "# link %.2f R, mu %.1f, %.2f turns, %.1f m/s: %.4f, exactly %.4f; ripple %.2f %%; "
      "%.2f solves a step\n",
      share, mu, turns, speed, ratio, wanted, 100 * (t.most / t.least - 1),
      (double)c.rope.solves / (double)c.rope.steps);
  assert_near (ratio / wanted, 1, 0.01, "the ratio of tensions");
  assert_below (t.most / t.least, 1.03, "the ripple");
  assert_true (c.rope.touch.bends > 2);
  assert_kept (&c.rope, "long links about a drum");
  unwind (&c);
}

static void
long_links (void **state)
{
  (void)state;
  const double share[] = { 0.5, 0.7, 1, 1.5, 2 };
  for (int i = 0; i < 5; i++)
    {
      check_long (share[i], 0.3, 0.5, SPEED);
      check_long (share[i], 0.6, 0.5, SPEED);
      check_long (share[i], 0.3, 1, SPEED);
    }
}

static void
half_a_turn (void **state)
{
  (void)state;
  const double share[] = { 0.05, 0.1, 0.2, 0.3, 0.4 }, mu[] = { 0.1, 0.3, 0.6 };
  for (int i = 0; i < 5; i++)
    for (int k = 0; k < 3; k++)
      check (share[i], mu[k], 0.5);
}

static void
a_turn (void **state)
{
  (void)state;
  const double share[] = { 0.1, 0.2, 0.4 };
  for (int i = 0; i < 3; i++)
    {
      check (share[i], 0.1, 1);
      check (share[i], 0.3, 1);
    }
  check (0.05, 0.6, 1);
  check (0.1, 0.6, 1);
  check (0.2, 0.6, 1);
  check (0.4, 0.6, 1);
}

/* The tensions are as 535 to one: the load of every place depends on the friction of all before.
   An iteration in which friction takes the loads of the iterate before does not settle.  */
static void
much_friction (void **state)
{
  (void)state;
  check (0.05, 1, 1);
  check (0.1, 1, 1);
  check (0.2, 1, 1);
  check (0.4, 1, 1);
}

/* Without friction the contacts take nothing: no drag from half-spaces that lag behind.  */
static void
no_friction (void **state)
{
  (void)state;
  const double share[] = { 0.05, 0.2, 0.4 };
  for (int i = 0; i < 3; i++)
    {
      static capstan c;
      wind (&c, share[i], 0, 0.5);
      assert_near (haul (&c, 300), 1, 5e-4, "the ratio of tensions");
      unwind (&c);
    }
}

/* The links in turn are not felt: no ripple as nodes come and go.  */
static void
no_ripple (void **state)
{
  (void)state;
  static capstan c;
  wind (&c, 0.3, 0.3, 0.5);
  haul (&c, 300);
  spread t = haul_on (&c, 200, SPEED, 2, 0);
  print_message ("# tension from %.2f to %.2f N\n", t.least, t.most);
  assert_below (t.most / t.least, 1.05, "the ripple");
  unwind (&c);
}

static void
sticks (void **state)
{
  (void)state;
  static capstan c;
  static bt_vec3 before[1000];
  wind (&c, 0.3, 0.3, 0.5);
  haul (&c, 300);
  int n = (int)c.rope.d->n;
  const bt_vec3 *x = bt__dynamic_x (c.rope.d);
  for (int i = 0; i < 1200; i++) /* until the legs no longer swing */
    assert_true (rope_step (&c.rope, frame, 0));
  for (int i = 0; i <= n; i++)
    before[i] = x[i];
  double held = bt__dynamic_tension (c.rope.d)[n - 2];
  for (int i = 0; i < 3600; i++)
    assert_true (rope_step (&c.rope, frame, 0));
  double creep = 0;
  for (int i = 0; i <= n; i++)
    creep = fmax (creep, bt__distance (before[i], x[i]));
  print_message ("# 60 s at %.1f N over 30 N: %.3g m, %.3g m/s\n", held, creep, c.rope.touch.speed);
  assert_below (creep, 5e-5, "the creep");
  assert_true (held > 45); /* friction holds what the weight does not */
  assert_true (c.rope.touch.touches > 5);
  unwind (&c);
}

/* Hauled through a right angle over the edge of a box, links longer than all that is round there:
   node after node comes to the edge, and no step has another ratio of tensions than e^(mu pi / 2)
   by 2 %.  */
static void
over_a_box_edge (void **state)
{
  (void)state;
  static capstan c;
  const bt_vec3 shape[] = { { -0.4, 0, -14 }, { -0.4, 0, 0.2 }, { 15, 0, 0.4 } };
  double ratio = exp (0.3 * BT__PI / 2), least = INFINITY, most = 0;
  assert_true (reef_open (&c.reef));
  reef_box (&c.reef, bt__vec (15, 0, -1), bt__vec (15, 3, 1), 0);
  assert_true (reef_raise (&c.reef));
  assert_true (rope_open (&c.rope, &c.reef, 100, shape, 3, bt__length (shape, 3), 0.3));
  c.rope.line.cdt = 0;
  c.rope.config.pull[1] = INFINITY;
  c.rope.in.end[0]
      = (bt__dynamic_end){ .free = 1, .body = { .mass = 1, .linear = 5, .force = { 0, 0, -30 } } };
  for (int i = 0; i < 540; i++)
    {
      const double *t = bt__dynamic_tension (c.rope.d);
      c.rope.in.end[1].at.x += frame * fmin (1, i / 60.0);
      assert_true (rope_step (&c.rope, frame, 0));
      if (i < 270)
        continue;
      least = fmin (least, t[c.rope.d->n - 2] / t[1]);
      most = fmax (most, t[c.rope.d->n - 2] / t[1]);
    }
  print_message ("# over a box's edge: ratios of %.4f to %.4f, and not %.4f\n", least, most, ratio);
  assert_true (least > 0.98 * ratio && most < 1.02 * ratio);
  unwind (&c);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (half_a_turn),   cmocka_unit_test (long_links),
          cmocka_unit_test (a_turn),        cmocka_unit_test (over_a_box_edge),
          cmocka_unit_test (much_friction), cmocka_unit_test (no_friction),
          cmocka_unit_test (no_ripple),     cmocka_unit_test (sticks) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
