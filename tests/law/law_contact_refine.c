/* What a line among obstacles does may not hang on how finely it is cut: with twice the links, with
   half the step and with both it winds about the same members as often, and its tensions are the
   same within 3 %.

   A vehicle of 20 kg takes 60 m of line round two legs and over a box, holds against it, and the
   other end is hauled in; the tensions are means over the last seconds of the haul, in which the
   line slips everywhere.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define LEG 0.6       /* m: radius */
#define CRUISE 0.8    /* m/s */
#define THRUST 150.0  /* N at the most */
#define HELD 80.0     /* N: what the vehicle pulls with in the end */
#define HAUL 0.1      /* m/s */
#define SETTLE 30.0   /* s */
#define HAULED 20.0   /* s, the second half counted */
#define PATIENCE 40.0 /* s on the way to a place */

enum
{
  LEGS = 2,
  PLACES = 6
};

typedef struct course
{
  const char *name;
  bt_vec3 axis[LEGS]; /* m: where the legs stand */
  bt_vec3 place[PLACES];
  int legs, places, box;
  bt_vec3 pull; /* unit: which way the vehicle pulls in the end */
} course;

static const course courses[] = {
  { .name = "once round a leg",
    .axis = { { 0, 0, 0 } },
    .legs = 1,
    .place = { { 0, -3, -5 }, { 3, 0, -5 }, { 0, 3, -5 }, { -3, 0, -5 }, { 0, -3, -5 } },
    .places = 5,
    .pull = { 0.8, -0.6, 0 } },
  { .name = "between two legs, and back round the second",
    .axis = { { 0, -3, 0 }, { 6, 3, 0 } },
    .legs = 2,
    .place = { { 0, 1, -5 }, { 4, -1, -5 }, { 9, 0, -5 }, { 9, 6, -5 }, { 3, 7, -5 } },
    .places = 5,
    .pull = { -0.6, 0.8, 0 } },
  { .name = "round a leg and down over a box",
    .axis = { { 0, -3, 0 } },
    .legs = 1,
    .place = { { 0, 1, -5 }, { 6, -4, -4 }, { 13, -6, -4 }, { 15, -6, -12 } },
    .places = 4,
    .box = 1,
    .pull = { 0, 0, -1 } },
};

/* What came of it.  */
typedef struct outcome
{
  double turns[LEGS]; /* about the legs, as they fell at the end of the flight */
  double tension[2];  /* N: means of either end's */
} outcome;

typedef struct flight
{
  reef reef;
  rope rope;
  double step;
} flight;

static void
begin (flight *f, const course *c, int links, double step)
{
  const bt_vec3 shape[] = { { -12, 0, -5 }, { -14, -20, -5 }, { -8, -18, -5 }, { -6, 0, -5 } };
  f->step = step;
  assert_true (reef_open (&f->reef));
  for (int i = 0; i < c->legs; i++)
    {
      bt_vec3 foot = c->axis[i], head = c->axis[i];
      foot.z = -20;
      head.z = 5;
      reef_cylinder (&f->reef, foot, head, LEG);
    }
  if (c->box)
    reef_box (&f->reef, bt__vec (11, -5, -8), bt__vec (2, 3, 2.5), 0);
  assert_true (reef_raise (&f->reef));
  assert_true (rope_open (&f->rope, &f->reef, links, shape, 4, 46, 0.2));
  f->rope.in.end[1] = (bt__dynamic_end){ .free = 1, .body = { .mass = 20, .quadratic = 60 } };
}

/* A step with the vehicle pushed by FORCE.  */
static void
push (flight *f, bt_vec3 force)
{
  f->rope.in.end[1].body.force = force;
  assert_true (rope_step (&f->rope, f->step, 0));
}

static bt_vec3
vehicle (const flight *f)
{
  return bt__dynamic_x (f->rope.d)[f->rope.d->n];
}

static void
fly_to (flight *f, bt_vec3 place)
{
  for (double t = 0; t < PATIENCE && bt__distance (vehicle (f), place) > 0.2; t += f->step)
    {
      bt_vec3 way = bt__sub (place, vehicle (f)), v = bt__dynamic_v (f->rope.d)[f->rope.d->n];
      double far = bt__norm (way);
      bt_vec3 wish = bt__scale (fmin (CRUISE, far) / fmax (far, 1e-9), way);
      bt_vec3 force = bt__scale (200, bt__sub (wish, v));
      push (f, bt__scale (fmin (1, THRUST / fmax (bt__norm (force), 1e-9)), force));
    }
}

/* The turns of the line about the vertical through AXIS.  */
static double
turns_about (const flight *f, bt_vec3 axis)
{
  const bt_vec3 *x = bt__dynamic_x (f->rope.d);
  double sum = 0;
  for (int64_t i = 0; i < f->rope.d->n; i++)
    {
      bt_vec3 a = bt__sub (x[i], axis), b = bt__sub (x[i + 1], axis);
      sum += atan2 (a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    }
  return sum / (2 * BT__PI);
}

/* Haul at the anchor against the vehicle; the tensions to O.  */
static void
haul (flight *f, bt_vec3 pull, outcome *o)
{
  const double *t = bt__dynamic_tension (f->rope.d);
  bt_vec3 at = f->rope.in.end[0].at;
  int steps = (int)(HAULED / f->step), counted = 0;
  for (int i = 0; i < steps; i++)
    {
      at.x -= HAUL * f->step * fmin (1, i * f->step);
      f->rope.in.end[0].at = at;
      push (f, pull);
      if (2 * i < steps)
        continue;
      o->tension[0] += t[0];
      o->tension[1] += t[f->rope.d->n - 1];
      counted++;
    }
  for (int e = 0; e < 2; e++)
    o->tension[e] /= counted;
}

static outcome
fly (const course *c, int links, double step)
{
  static flight f;
  outcome o = { 0 };
  bt_vec3 pull = bt__scale (HELD, c->pull);
  begin (&f, c, links, step);
  for (int i = 0; i < c->places; i++)
    fly_to (&f, c->place[i]);
  for (double t = 0; t < SETTLE; t += step)
    push (&f, pull);
  for (int i = 0; i < c->legs; i++)
    o.turns[i] = turns_about (&f, c->axis[i]);
  haul (&f, pull, &o);
  print_message ("# %s, %d links, 1/%.0f s: %.3f, %.3f turns; %.2f, %.2f N; %.2f solves\n", c->name,
                 links, 1 / step, o.turns[0], o.turns[1], o.tension[0], o.tension[1],
                 (double)f.rope.solves / (double)f.rope.steps);
  assert_kept (&f.rope, c->name);
  rope_close (&f.rope);
  reef_close (&f.reef);
  return o;
}

static void
refines (void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof courses / sizeof *courses; k++)
    {
      const course *c = courses + k;
      outcome fine[] = { fly (c, 100, frame), fly (c, 200, frame), fly (c, 100, frame / 2),
                         fly (c, 200, frame / 2) };
      for (int i = 1; i < 4; i++)
        {
          for (int q = 0; q < c->legs; q++)
            assert_near (fine[i].turns[q], fine[0].turns[q], 0.01, "the turns about a leg");
          for (int e = 0; e < 2; e++)
            assert_near (fine[i].tension[e] / fine[0].tension[e], 1, 0.03, "a tension");
        }
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (refines) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
