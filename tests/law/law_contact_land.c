/* A line that is drawn onto a member at speed is no longer than its tension tells, however near to
   the member the step ends in which the line comes.

   A step may end anywhere between the nearest that the guard allows and the distance at which
   contact is felt: what a rare dive meets by chance is looked for here.  Each line is flown in open
   water first; then the member is put where a step of the flight ends so near to the line.

   The judge knows no solver: rest lengths and tensions as told, places of nodes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

enum
{
  BEFORE = 45, /* steps in open water */
  AFTER = 20,
  CUT_ON_END = 3 /* steps that the guard may cut one after the other */
};

#define MORE 0.03 /* of an interval: how much longer than its tension tells it may be */

typedef struct landing
{
  double speed;   /* m/s */
  double radius;  /* m: of the member */
  int links;      /* of 12 m of line */
  double oblique; /* rad: the member's axis out of the plane across the line */
  double aside;   /* rad: between the way of the ends and the normal of the line */
  double gap;     /* of the core: what the step leaves beyond it */
} landing;

static const bt_vec3 shape[] = { { 0, -6, 0 }, { 0, 6, 0 } };

/* Fly the next STEPS.  */
static void
draw (rope *p, const landing *l, int steps)
{
  for (int i = 0; i < steps; i++)
    {
      double t = (double)(p->steps + 1) * frame, way = l->speed * t * t / (t + 0.2);
      bt_vec3 by = { way * cos (l->aside), way * sin (l->aside), 0.2 * way };
      for (int e = 0; e < 2; e++)
        p->in.end[e].at = bt__add (shape[e], by);
      rope_step (p, frame, 1);
    }
}

static void
lay (rope *p, reef *r, const landing *l)
{
  assert_true (reef_raise (r));
  assert_true (rope_open (p, r, l->links, shape, 2, 12.6, 0.3));
  p->config.pull[0] = p->config.pull[1] = 5000;
}

/* Make R of the member of L, its axis through CENTRE.  */
static void
build (reef *r, const landing *l, bt_vec3 centre)
{
  bt_vec3 axis = { 0, sin (l->oblique), cos (l->oblique) };
  assert_true (reef_open (r));
  reef_wire (r, bt__axpy (centre, -30, axis), bt__axpy (centre, 30, axis), l->radius);
}

/* Return a point of the axis that the member is to have for the line X of N points to be as near to
   the member as L says; the line comes along x.  */
static bt_vec3
place (const landing *l, const bt_vec3 *x, int n, double core)
{
  double near = 0, far = 20;
  bt_vec3 at = { 0, x[n / 2].y + 0.1, 0 };
  for (int i = 0; i < 60; i++)
    {
      static reef r;
      at.x = 0.5 * (near + far) + x[n / 2].x;
      build (&r, l, at);
      assert_true (reef_raise (&r));
      *(reef_clearance (&r, x, n) < core * (1 + l->gap) ? &near : &far) = at.x - x[n / 2].x;
      reef_close (&r);
    }
  return at;
}

/* What came of a landing.  */
typedef struct verdict
{
  double longer; /* of an interval: more than its tension tells */
  int cut, at_core;
} verdict;

/* Where a line runs about a member, the surplus of the polygon of its chords over the arc is no
   stretch.  */
static double
longer_than_told (const rope *p)
{
  const double *rest = bt__dynamic_rest (p->d), *t = bt__dynamic_tension (p->d);
  const bt_vec3 *x = bt__dynamic_x (p->d);
  double most = 0;
  for (int i = 0; i < (int)p->d->n; i++)
    most = fmax (most, (bt__distance (x[i], x[i + 1]) - bt__dynamic_chord (p->d)[i].z) / rest[i] - 1
                           - t[i] / p->line.ea);
  return most;
}

static verdict
land (const landing *l)
{
  static reef r;
  static rope p;
  verdict v = { 0, 0, 0 };
  assert_true (reef_open (&r));
  lay (&p, &r, l);
  draw (&p, l, BEFORE);
  bt_vec3 at = place (l, bt__dynamic_x (p.d), (int)p.d->n + 1, p.config.core);
  rope_close (&p);
  reef_close (&r);
  build (&r, l, at);
  lay (&p, &r, l);
  draw (&p, l, BEFORE);
  double clear = reef_clearance (&r, bt__dynamic_x (p.d), (int)p.d->n + 1);
  v.at_core = clear < p.config.core * 1.02;
  int on_end = 0;
  for (int i = 0; i < AFTER; i++)
    {
      long before = p.truncated;
      draw (&p, l, 1);
      on_end = p.truncated > before ? on_end + 1 : 0;
      v.cut = on_end > v.cut ? on_end : v.cut;
      v.longer = fmax (v.longer, longer_than_told (&p));
    }
  assert_kept (&p, "a line drawn onto a member");
  rope_close (&p);
  reef_close (&r);
  return v;
}

static void
drawn_onto (void **state)
{
  static const double speeds[] = { 0.5, 1, 2, 3, 4 }, radii[] = { 0.01, 0.1, 0.5, 2 };
  static const double obliques[] = { 0, 0.6, 1.2 }, asides[] = { 0, 0.7 };
  static const double gaps[] = { 0.0005, 0.003, 0.01, 0.018, 0.1, 0.5 };
  static const int meshes[] = { 12, 40, 100 };
  dice d = dice_new (7);
  verdict most = { 0 };
  long at_core = 0, cases = is_long () ? 4000 : 400;
  (void)state;
  for (long i = 0; i < cases; i++)
    {
      landing l = { .speed = speeds[dice_below (&d, 5)],
                    .radius = radii[dice_below (&d, 4)],
                    .links = meshes[dice_below (&d, 3)],
                    .oblique = obliques[dice_below (&d, 3)],
                    .aside = asides[dice_below (&d, 2)],
                    .gap = gaps[dice_below (&d, 6)] };
      verdict v = land (&l);
      most.longer = fmax (most.longer, v.longer);
      most.cut = v.cut > most.cut ? v.cut : most.cut;
      at_core += v.at_core;
    }
  print_message (
      "# %ld landings, %ld within 2 %% of the core; intervals longer than told by %.2g at "
      "most, %d steps cut one after the other\n",
      cases, at_core, most.longer, most.cut);
  assert_true (at_core > cases / 10);
  assert_below (most.longer, MORE, "what an interval is longer than told, of its length");
  assert_true (most.cut <= CUT_ON_END);
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (drawn_onto) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
