/* A line drawn into the crotch of two members that cross, half an angle A on either side: each
   bears F / (2 sin A) of a pull F; drawn along it drags by mu F / sin A, and rests until then; what
   drew it in takes it out again, without a jump, at no more than it would go by itself; and the
   guard has nothing to do.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define LENGTH 6.0 /* m */
#define FAR 12.0
#define RADIUS 0.005
#define MASS 5.0 /* kg, N s/m: of either end */
#define DRAG 50.0

typedef struct crotch
{
  reef reef;
  rope rope;
  double angle, touch; /* rad; where the line just fits, along the bisector */
  double along, load[2];
} crotch;

typedef struct setting
{
  double degrees, radius, mu, shift; /* SHIFT: m by which nodes are beside the crotch */
  int links;
} setting;

/* The members lie across one another at the origin, and open along x; the line stands along z.  */
static void
raise (crotch *c, const setting *s, double from)
{
  double a = s->degrees * BT__PI / 180, x = FAR * cos (a), y = FAR * sin (a);
  *c = (crotch){ .angle = a, .touch = (s->radius + RADIUS) / sin (a) };
  bt_vec3 shape[] = { { c->touch + from, 0, s->shift - LENGTH / 2 },
                      { c->touch + from, 0, s->shift + LENGTH / 2 } };
  assert_true (reef_open (&c->reef));
  reef_cylinder (&c->reef, bt__vec (-x, -y, 0), bt__vec (x, y, 0), s->radius);
  reef_cylinder (&c->reef, bt__vec (-x, y, 0), bt__vec (x, -y, 0), s->radius);
  assert_true (reef_raise (&c->reef));
  assert_true (rope_open (&c->rope, &c->reef, s->links, shape, 2, LENGTH, s->mu));
  for (int e = 0; e < 2; e++)
    c->rope.in.end[e] = (bt__dynamic_end){ .free = 1, .body = { .mass = MASS, .linear = DRAG } };
}

static void
clear (crotch *c)
{
  assert_kept (&c->rope, "a line in a crotch");
  rope_close (&c->rope);
  reef_close (&c->reef);
}

/* Pull the ends apart by TIGHT and both along the bisector, OUT in all; MORE at the upper end.  */
static void
pull (crotch *c, double tight, double out, double more)
{
  for (int e = 0; e < 2; e++)
    c->rope.in.end[e].body.force = bt__vec (out / 2, 0, e ? tight + more : -tight);
}

static void
look (crotch *c)
{
  const bt__contact *a = bt__contacts_at (c->rope.anchors);
  const bt_vec3 *x = bt__dynamic_x (c->rope.d);
  int i = 0;
  c->load[0] = c->load[1] = 0;
  for (int64_t k = 0; k < c->rope.anchors->n; k++)
    c->load[a[k].object] += a[k].load;
  while (i + 2 < c->rope.nodes && x[i + 1].z < 0)
    i++;
  double s = -x[i].z / (x[i + 1].z - x[i].z);
  c->along = x[i].x + s * (x[i + 1].x - x[i].x) - c->touch;
}

static void
go (crotch *c, double seconds)
{
  for (int i = 0; i < seconds / frame; i++)
    assert_true (rope_step (&c->rope, frame, 1));
  look (c);
}

/* ---- What bears ---- */

/* Without friction, the crotch between two nodes.  */
static void
bears_exactly (double degrees, double radius, double in)
{
  static crotch c;
  setting s = { degrees, radius, 0, 0, 21 };
  raise (&c, &s, 0.1);
  pull (&c, 200, -in, 0);
  go (&c, 25);
  double wanted = in / (2 * sin (c.angle));
  print_message ("# %g degrees, R %.2f m: %.2f and %.2f N, exactly %.2f\n", degrees, radius,
                 c.load[0], c.load[1], wanted);
  assert_near (c.load[0] / wanted, 1, 0.01, "the load of one member");
  assert_near (c.load[1] / wanted, 1, 0.01, "the load of the other");
  assert_below (c.rope.report.speed, 1e-4, "the speed of a line at rest");
  assert_int_equal (c.rope.truncated, 0);
  clear (&c);
}

/* With friction, which took some of the pull on the way in.  */
static void
bears (const setting *s, double in)
{
  static crotch c;
  raise (&c, s, 0.1);
  pull (&c, 200, -in, 0);
  go (&c, 20);
  double most = in / (2 * sin (c.angle)),
         least = in / (2 * (sin (c.angle) + s->mu * cos (c.angle)));
  print_message ("# %g degrees, R %.2f m, mu %.1f, %d links: %.1f and %.1f N, from %.1f to %.1f\n",
                 s->degrees, s->radius, s->mu, s->links, c.load[0], c.load[1], least, most);
  for (int k = 0; k < 2; k++)
    assert_true (c.load[k] > 0.95 * least && c.load[k] < 1.05 * most);
  assert_below (c.rope.report.speed, 1e-4, "the speed of a line at rest");
  assert_int_equal (c.rope.truncated, 0);
  assert_true (c.rope.unconverged <= 2);
  clear (&c);
}

static void
members_bear_the_pull (void **state)
{
  (void)state;
  const setting all[]
      = { { 5, 0.03, 0.1, 0, 20 },   { 5, 0.3, 0.1, 0.03, 60 }, { 5, 0.03, 0.3, 0, 20 },
          { 5, 0.3, 0.3, 0, 21 },    { 15, 0.3, 0.1, 0, 20 },   { 15, 0.03, 0.3, 0.03, 60 },
          { 15, 0.3, 0.3, 0.1, 20 }, { 30, 0.03, 0.1, 0, 60 },  { 30, 0.3, 0.3, 0, 20 } };
  for (int k = 0; k < 2; k++)
    {
      bears_exactly (5, k ? 0.3 : 0.03, 40);
      bears_exactly (15, k ? 0.3 : 0.03, 20);
      bears_exactly (30, k ? 0.3 : 0.03, 40);
    }
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    bears (all + i, 40);
}

/* ---- Friction of both sides ---- */

/* Drawn along by SHARE of what it drags by; return the speed.  */
static double
drawn (const setting *s, double share)
{
  static crotch c;
  double in = 40;
  raise (&c, s, 0.05);
  pull (&c, 200, -in, 0);
  go (&c, 12);
  pull (&c, 200, -in, share * s->mu * in / sin (c.angle));
  go (&c, 3);
  double before = bt__dynamic_x (c.rope.d)[0].z;
  go (&c, 2);
  double speed = (bt__dynamic_x (c.rope.d)[0].z - before) / 2;
  print_message ("# %g degrees, mu %.1f, %d links, drawn by %.2f: %.2g m/s\n", s->degrees, s->mu,
                 s->links, share, speed);
  clear (&c);
  return speed;
}

static void
drags_by_both_sides (void **state)
{
  (void)state;
  const setting all[]
      = { { 15, 0.3, 0.2, 0, 21 }, { 15, 0.03, 0.2, 0.03, 60 }, { 30, 0.3, 0.3, 0, 61 } };
  for (int i = 0; i < 3; i++)
    {
      assert_below (fabs (drawn (all + i, 0.8)), 1e-4, "a line that is held");
      assert_true (drawn (all + i, 1.25) > 0.01);
    }
}

/* ---- In and out ---- */

/* Drawn in by IN from half a metre off, out again by BACK.  What friction holds back leaves as a
   plucked string, at BACK / (2 sqrt (T m)).  */
static void
in_and_out (const setting *s, double in, double back)
{
  static crotch c;
  double fastest = 0, out = -1, tight = 200;
  raise (&c, s, 0.5);
  pull (&c, tight, -in, 0);
  go (&c, 10);
  double load = c.rope.load, most = 1.5 * in / (2 * sin (c.angle)), along = c.along;
  pull (&c, tight, back, 0);
  for (int i = 0; i < 300; i++)
    {
      assert_true (rope_step (&c.rope, frame, 1));
      look (&c);
      fastest = fmax (fastest, c.rope.report.speed);
      if (out < 0 && c.along > 0.05)
        out = i * frame;
    }
  double plucked = back / (2 * sqrt (tight * 2 * c.rope.line.mass)) + back / (2 * DRAG);
  print_message (
      "# %g degrees, R %.2f m, mu %.1f, %d links, in by %g N: %.0f N at most, %.2g m in, "
      "out by %g N in %.1f s, %.2f m/s (%.2f); %ld cut, %ld unsolved\n",
      s->degrees, s->radius, s->mu, s->links, in, load, -along, back, out, fastest, plucked,
      c.rope.truncated, c.rope.unconverged);
  assert_below (load, most, "the load");
  assert_true (out >= 0);
  assert_below (fastest, 1.2 * plucked, "the speed on the way out");
  assert_true (c.rope.truncated <= 3);
  clear (&c);
}

static void
comes_out_as_it_went_in (void **state)
{
  (void)state;
  const double in[] = { 40, 400 };
  const setting all[]
      = { { 3, 0.3, 0.3, 0, 20 },   { 5, 0.03, 0.3, 0, 20 },  { 5, 0.3, 0.1, 0.03, 60 },
          { 15, 0.3, 0.3, 0, 60 },  { 15, 0.03, 0.6, 0, 21 }, { 30, 0.3, 0.3, 0.1, 20 },
          { 10, 0.03, 0.3, 0, 21 }, { 10, 0.3, 0, 0, 20 } };
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    for (int k = 0; k < 2; k++)
      in_and_out (all + i, in[k], in[k]);
}

/* Where friction holds nothing, tan A > mu, a tenth is enough.  */
static void
falls_out_of_a_wide_one (void **state)
{
  (void)state;
  const setting all[] = { { 20, 0.3, 0.3, 0, 20 }, { 30, 0.03, 0.3, 0.03, 60 } };
  for (int i = 0; i < 2; i++)
    in_and_out (all + i, 40, 4);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (members_bear_the_pull), cmocka_unit_test (drags_by_both_sides),
          cmocka_unit_test (comes_out_as_it_went_in), cmocka_unit_test (falls_out_of_a_wide_one) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
