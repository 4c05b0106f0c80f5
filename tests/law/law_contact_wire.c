/* A line drawn over wires and edges far thinner than its links: the tensions are as on a drum, they
   do not ripple as nodes pass, where it stops it stays, along the wire it goes as friction lets it,
   and it comes off as it was.

   Short of sweeps by default, more with BIGHT_LONG=1 in the environment.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define SPEED 0.1
#define LEG 4.0 /* m: of the side with the weight */
#define APART 3.0

typedef struct rig
{
  reef reef;
  rope rope;
  bt_vec3 at, along;
  double theta;
} rig;

typedef enum thin
{
  WIRE,
  EDGE
} thin;

/* Links of LINK over COUNT right angles; a weight on the near end.  */
static void
lay (rig *r, thin what, int count, double link, double mu)
{
  double out = what == WIRE ? 0.01 : 0.005, bulge = out + 0.55 * link, length = -0.004;
  bt_vec3 shape[] = { { -out, 0, -LEG },
                      { -bulge, 0, bulge },
                      { count > 1 ? APART + bulge : 6, 0, count > 1 ? bulge : out },
                      { APART + out, 0, -9 } };
  int points = count > 1 ? 4 : 3;
  r->theta = count * BT__PI / 2;
  r->along = count > 1 ? bt__vec (0, 0, -1) : bt__vec (1, 0, 0);
  assert_true (reef_open (&r->reef));
  if (what == EDGE)
    {
      double half = count > 1 ? APART / 2 : 15;
      reef_box (&r->reef, bt__vec (half, 0, -1), bt__vec (half, 3, 1), 0);
    }
  else
    for (int i = 0; i < count; i++)
      reef_wire (&r->reef, bt__vec (i * APART, -3, 0), bt__vec (i * APART, 3, 0), 0.005);
  assert_true (reef_raise (&r->reef));
  for (int i = 0; i + 1 < points; i++)
    length += bt__distance (shape[i], shape[i + 1]);
  assert_true (
      rope_open (&r->rope, &r->reef, (int)(length / link + 0.5), shape, points, length, mu));
  r->rope.line.cdt = 0;
  r->rope.config.pull[1] = INFINITY;
  r->rope.in.end[0]
      = (bt__dynamic_end){ .free = 1, .body = { .mass = 1, .linear = 20, .force = { 0, 0, -30 } } };
  r->at = r->rope.in.end[1].at;
}

static void
clear (rig *r)
{
  assert_kept (&r->rope, "a line over something thin");
  rope_close (&r->rope);
  reef_close (&r->reef);
}

typedef struct pulled
{
  double ratio, low, high; /* of the tensions: mean; hauled end: least and most, N */
} pulled;

/* Haul for STEPS; return what was in the second half.  */
static pulled
haul (rig *r, int steps, double speed)
{
  double before = 0, after = 0;
  pulled p = { 0, INFINITY, 0 };
  for (int i = 0; i < steps; i++)
    {
      const double *t = bt__dynamic_tension (r->rope.d);
      r->at = bt__axpy (r->at, speed * frame * fmin (1, i / 60.0), r->along);
      r->rope.in.end[1].at = r->at;
      assert_true (rope_step (&r->rope, frame, 1));
      if (i < steps / 2)
        continue;
      before += t[0];
      after += t[r->rope.d->n - 1];
      p.low = fmin (p.low, t[r->rope.d->n - 1]);
      p.high = fmax (p.high, t[r->rope.d->n - 1]);
    }
  p.ratio = after / before;
  return p;
}

static void
check (thin what, int count, double link, double mu)
{
  static rig r;
  lay (&r, what, count, link, mu);
  pulled p = haul (&r, link < 0.2 ? 900 : 1200, SPEED);
  double wanted = exp (mu * r.theta), ripple = p.high / p.low - 1;
  print_message ("# %d %s, link %.2f m, mu %.1f: %.4f, exactly %.4f; ripple %.2f %%; %.2f solves\n",
                 count, what == WIRE ? "wires" : "edges", link, mu, p.ratio, wanted, 100 * ripple,
                 (double)r.rope.solves / (double)r.rope.steps);
  assert_near (p.ratio / wanted, 1, 0.01, "the ratio of tensions");
  assert_below (ripple, 0.03, "the ripple");
  assert_int_equal (r.rope.touch.bends, count);
  clear (&r);
}

static void
capstan (void **state)
{
  (void)state;
  const double link[] = { 0.1, 0.25, 0.5, 1 }, mu[] = { 0, 0.3, 0.6 };
  for (int count = 1; count <= 2; count++)
    for (int i = 0; i < 4; i++)
      for (int k = 0; k < 3; k++)
        {
          check (WIRE, count, link[i], mu[k]);
          check (EDGE, count, link[i], mu[k]);
        }
}

/* Lay 100 links of a line with 14 m to the weight and 15 m to the hauled end.  */
static void
lay_long (rig *r, thin what)
{
  enum
  {
    ARC = 10
  };
  double bend = 0.4;
  bt_vec3 shape[ARC + 2] = { { -bend, 0, -14 } };
  for (int i = 0; i < ARC; i++)
    {
      double a = BT__PI / 2 * i / (ARC - 1);
      shape[i + 1] = bt__scale (1.03 * bend, bt__vec (-cos (a), 0, sin (a)));
    }
  shape[ARC + 1] = bt__vec (15, 0, shape[ARC].z);
  assert_true (reef_open (&r->reef));
  if (what == EDGE)
    reef_box (&r->reef, bt__vec (15, 0, -1), bt__vec (15, 3, 1), 0);
  else
    reef_wire (&r->reef, bt__vec (0, -3, 0), bt__vec (0, 3, 0), 0.005);
  assert_true (reef_raise (&r->reef));
  double length = bt__length (shape, ARC + 2);
  assert_true (rope_open (&r->rope, &r->reef, 100, shape, ARC + 2, length, 0.3));
  r->rope.line.cdt = 0;
  r->rope.config.pull[1] = INFINITY;
  r->rope.in.end[0]
      = (bt__dynamic_end){ .free = 1, .body = { .mass = 1, .linear = 5, .force = { 0, 0, -30 } } };
  r->at = r->rope.in.end[1].at;
  r->along = bt__vec (1, 0, 0);
}

/* At 3 m/s, ten nodes a second pass: the line is held where it turns at once again.  */
static void
goes_fast (void **state)
{
  (void)state;
  static rig r;
  for (int what = WIRE; what <= EDGE; what++)
    {
      double low = INFINITY, high = 0;
      lay_long (&r, (thin)what);
      for (int i = 0; i < 180; i++)
        {
          r.at = bt__axpy (r.at, 3 * frame * fmin (1, i / 60.0), r.along);
          r.rope.in.end[1].at = r.at;
          assert_true (rope_step (&r.rope, frame, 1));
          const double *t = bt__dynamic_tension (r.rope.d);
          double ratio = t[r.rope.d->n - 2] / t[1];
          low = i < 90 ? low : fmin (low, ratio);
          high = i < 90 ? high : fmax (high, ratio);
        }
      print_message ("# a %s at 3 m/s: tensions %.3f to %.3f to one, exactly %.3f\n",
                     what == WIRE ? "wire" : "edge", low, high, exp (0.3 * BT__PI / 2));
      assert_below (high / low, 1.04, "the ripple");
      clear (&r);
    }
}

/* Mutant: without the held nodes every node that passes is felt.  */
static void
ripples_without (void **state)
{
  (void)state;
  static rig r;
  lay (&r, WIRE, 1, 0.5, 0.3);
  r.rope.hook.no_bends = 1;
  pulled p = haul (&r, 1200, SPEED);
  assert_true (p.high > 2 * p.low);
  clear (&r);
}

static void
sticks (void **state)
{
  (void)state;
  static rig r;
  double before[2], creep = 0;
  lay (&r, WIRE, 2, 0.5, 0.3);
  haul (&r, 400, SPEED);
  for (int i = 0; i < 1200; i++)
    assert_true (rope_step (&r.rope, frame, 0));
  const bt__contact *a = bt__contacts_at (r.rope.anchors);
  double held = bt__dynamic_tension (r.rope.d)[r.rope.d->n - 1];
  assert_int_equal (r.rope.touch.bends, 2);
  for (int i = 0; i < 2; i++)
    before[i] = a[i].from_end;
  for (int i = 0; i < 3600; i++)
    assert_true (rope_step (&r.rope, frame, 0));
  for (int i = 0; i < 2; i++)
    creep = fmax (creep, fabs (a[i].from_end - before[i]));
  print_message ("# 60 s at %.1f N over 30 N: %.3g m, %.3g m/s\n", held, creep, r.rope.touch.speed);
  assert_below (creep, 5e-5, "the creep");
  assert_true (held > 60);
  clear (&r);
}

/* The hauled end goes aside by 1 m, the weight's is free to follow: the line goes along the wire,
   or sticks to it.  */
static double
goes_aside (double mu)
{
  static rig r;
  lay (&r, WIRE, 1, 0.5, mu);
  haul (&r, 300, SPEED);
  for (int i = 0; i < 3000; i++)
    {
      r.at.y += i < 600 ? 1.0 / 600 : 0;
      r.rope.in.end[1].at = r.at;
      assert_true (rope_step (&r.rope, frame, 1));
    }
  assert_int_equal (r.rope.touch.bends, 1);
  const bt__contact *a = bt__contacts_at (r.rope.anchors);
  double y = a[0].point.y;
  clear (&r);
  return y;
}

static void
slides_along (void **state)
{
  (void)state;
  double free = goes_aside (0), stuck = goes_aside (0.6);
  print_message ("# along the wire: %.3f m, with friction %.3f m\n", free, stuck);
  assert_near (free, 1, 0.02, "the way along the wire");
  assert_below (stuck, 0.1, "the way along the wire with friction");
}

/* Taken off the wire the line has as many nodes as before, as far apart.  */
static void
comes_off (void **state)
{
  (void)state;
  static rig r;
  lay (&r, WIRE, 1, 0.25, 0.3);
  int n = (int)r.rope.d->n;
  haul (&r, 300, SPEED);
  r.rope.in.end[0].body.force = bt__vec (0, 0, 30); /* it floats up */
  double most = 0;
  for (int i = 0; i < 1800; i++)
    {
      assert_true (rope_step (&r.rope, frame, 1));
      most = fmax (most, r.rope.report.tension);
    }
  print_message ("# %d nodes, then %d; %.1f N at most\n", n, (int)r.rope.d->n, most);
  assert_int_equal (r.rope.touch.touches, 0);
  assert_true (abs ((int)r.rope.d->n - n) <= 1);
  assert_below (most, 120, "the tension as it comes off");
  clear (&r);
}

/* ---- What a steady step costs ---- */

/* Drawn along the wire at a steady speed by both ends, pulled apart and down: one solve a step.  */
static void
slides_in_one_solve (void **state)
{
  static reef r;
  static rope p;
  const bt_vec3 shape[] = { { -4, 0, -3 }, { 0, 0, 0.02 }, { 4, 0, -3 } };
  long before = 0;
  (void)state;
  assert_true (reef_open (&r));
  reef_wire (&r, bt__vec (0, -30, 0), bt__vec (0, 30, 0), 0.005);
  assert_true (reef_raise (&r) && rope_open (&p, &r, 40, shape, 3, 10.1, 0.3));
  for (int e = 0; e < 2; e++)
    p.in.end[e] = (bt__dynamic_end){ .free = 1, .body = { .mass = 5, .linear = 50 } };
  for (int i = 0; i < 900; i++)
    {
      for (int e = 0; e < 2; e++)
        p.in.end[e].body.force = bt__vec (e ? 20 : -20, i > 300 ? 30 : 0, -60);
      before = i == 450 ? p.solves : before;
      assert_true (rope_step (&p, frame, 1));
    }
  double solves = (double)(p.solves - before) / 450;
  print_message ("# sliding at %.2f m/s: %.3f solves a step\n", p.touch.speed, solves);
  assert_true (p.touch.speed > 0.05 && p.touch.bends > 0);
  assert_below (solves, 1.1, "solves of a step that slides on as it did");
  assert_kept (&p, "a line that slides along a wire");
  rope_close (&p);
  reef_close (&r);
}

/* ---- Sweeps ---- */

static void
sweep (int k, double speed, int links, dice *d)
{
  static reef r;
  static rope p;
  sweep_onto_wire (&p, &r, k, links, speed, speed < 10 ? 240 : 60, 0, d);
  assert_kept (&p, "a sweep onto a wire");
  rope_close (&p);
  reef_close (&r);
}

static void
sweeps (void **state)
{
  (void)state;
  dice d = dice_new (5);
  for (int k = 0; k < (is_long () ? 40 : 4); k++)
    for (int links = 20; links <= 80; links += 60)
      {
        sweep (k, 3, links, &d);
        sweep (k, 20, links, &d);
      }
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (capstan),         cmocka_unit_test (goes_fast),
          cmocka_unit_test (ripples_without), cmocka_unit_test (sticks),
          cmocka_unit_test (slides_along),    cmocka_unit_test (comes_off),
          cmocka_unit_test (sweeps),          cmocka_unit_test (slides_in_one_solve) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
