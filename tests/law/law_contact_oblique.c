/* A line drawn obliquely over a round member: it rests while what draws it sideways is within the
   friction of what presses it on, whatever the angle at which it crosses, and slides beyond.

   Drawn taut along its own direction it is pressed on by P and drawn across itself, in the plane
   that touches the member, by Q: it rests for Q < mu P.  What lies on the member is bent sideways
   then by less than mu times the angle by which it is bent about it (e.g. I. Johannsen, The
   Mechanics of Filament Winding).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define LENGTH 6.0 /* m */
#define FAR 12.0
#define RADIUS 0.005
#define MASS 5.0 /* kg, N s/m: of either end */
#define DRAG 50.0
#define TIGHT 200.0 /* N */
#define PRESS 40.0

typedef struct setting
{
  double degrees, radius, mu; /* from member to line */
  int links;
} setting;

/* The member lies along x, the line above it.  */
static void
raise (reef *reef, rope *p, const setting *s, bt_vec3 along)
{
  bt_vec3 up = bt__vec (0, 0, s->radius + RADIUS + 0.02);
  bt_vec3 shape[] = { bt__axpy (up, -LENGTH / 2, along), bt__axpy (up, LENGTH / 2, along) };
  assert_true (reef_open (reef));
  reef_cylinder (reef, bt__vec (-FAR, 0, 0), bt__vec (FAR, 0, 0), s->radius);
  assert_true (reef_raise (reef));
  assert_true (rope_open (p, reef, s->links, shape, 2, LENGTH, s->mu));
  for (int e = 0; e < 2; e++)
    p->in.end[e] = (bt__dynamic_end){ .free = 1, .body = { .mass = MASS, .linear = DRAG } };
}

/* Pull the ends apart, press them down, and draw both by SIDE in all.  */
static void
pull (rope *p, bt_vec3 along, bt_vec3 side)
{
  for (int e = 0; e < 2; e++)
    p->in.end[e].body.force
        = bt__axpy (bt__axpy (bt__vec (0, 0, -PRESS / 2), e ? TIGHT : -TIGHT, along), 0.5, side);
}

static void
go (rope *p, double seconds)
{
  for (int i = 0; i < seconds / frame; i++)
    assert_true (rope_step (p, frame, 1));
}

static bt_vec3
middle (const rope *p)
{
  const bt_vec3 *x = bt__dynamic_x (p->d);
  return bt__scale (0.5, bt__add (x[0], x[p->nodes - 1]));
}

/* Drawn across itself by SHARE of what friction bears; return the speed that way.  */
static double
drawn (const setting *s, double share)
{
  static reef reef;
  static rope p;
  double a = s->degrees * BT__PI / 180, by = share * s->mu * PRESS;
  bt_vec3 along = { cos (a), sin (a), 0 }, across = { sin (a), -cos (a), 0 };
  raise (&reef, &p, s, along);
  pull (&p, along, bt__vec (0, 0, 0));
  go (&p, 6);
  pull (&p, along, bt__scale (by, across));
  go (&p, 8);
  bt_vec3 before = middle (&p);
  go (&p, 1);
  double speed = bt__dot (across, bt__sub (middle (&p), before));
  print_message ("# at %g degrees, R %.2f m, mu %.1f, %d links, drawn by %.2f: %.2g m/s; %d held\n",
                 s->degrees, s->radius, s->mu, s->links, share, speed, p.touch.bends);
  assert_kept (&p, "a line drawn obliquely");
  rope_close (&p);
  reef_close (&reef);
  return speed;
}

static void
rests_within_its_friction (void **state)
{
  (void)state;
  const setting all[] = { { 90, 0.3, 0.3, 21 }, { 60, 0.3, 0.3, 21 }, { 45, 0.3, 0.3, 21 },
                          { 35, 0.3, 0.6, 21 }, { 45, 0.3, 0.6, 40 }, { 45, 0.1, 0.6, 21 } };
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    {
      assert_below (fabs (drawn (all + i, 0.8)), 1e-3, "the speed of a line that is held");
      assert_true (drawn (all + i, 1.25) > 0.01);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (rests_within_its_friction) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
