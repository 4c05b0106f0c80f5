/* A line wound on a drum bears what its length says along the arc, and never more inside the wrap
   than what its ends have borne: friction may hold what a pull has stretched, but stretches
   nothing (Euler 1769, Eytelwein 1808).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define DRUM 0.6  /* m */
#define OUT 0.605 /* m: of the line's axis */
#define LEG 3.0
#define RISE 0.15 /* m a turn, of more than one turn */

enum
{
  CORNERS = 402
};

/* A line about TURNS of a drum, R from its axis; its elements LINK of the drum's radius long.  */
typedef struct wound
{
  double link, mu, turns, ea, r;
  reef reef;
  rope rope;
  double theta;
  bt_vec3 end[2], along[2]; /* where the ends are; the ways in which they are drawn */
} wound;

static void
lay (wound *w)
{
  static bt_vec3 shape[CORNERS + 1];
  double rise = w->turns > 0.75 ? RISE * w->turns : 0;
  w->theta = 2 * BT__PI * w->turns;
  assert_true (reef_open (&w->reef));
  reef_cylinder (&w->reef, bt__vec (0, -5, 0), bt__vec (0, 5, 0), DRUM);
  assert_true (reef_raise (&w->reef));
  double a = BT__PI - w->theta;
  w->along[0] = bt__vec (0, 0, -1);
  w->along[1] = bt__vec (sin (a), 0, -cos (a));
  for (int i = 1; i < CORNERS; i++)
    {
      double u = (i - 1) / (CORNERS - 2.0), b = BT__PI - w->theta * u;
      shape[i] = bt__vec (w->r * cos (b), rise * u, w->r * sin (b));
    }
  w->end[0] = shape[0] = bt__vec (-OUT, 0, -LEG);
  w->end[1] = bt__vec (OUT * cos (a), rise, OUT * sin (a));
  w->end[1] = shape[CORNERS] = bt__axpy (w->end[1], LEG, w->along[1]);
  double length = bt__length (shape, CORNERS + 1);
  int links = (int)(length / (w->link * DRUM) + 0.5);
  assert_true (rope_open (&w->rope, &w->reef, links, shape, CORNERS + 1, length, w->mu));
  w->rope.line.ea = w->ea;
  w->rope.config.pull[0] = w->rope.config.pull[1] = INFINITY;
}

static void
unwind (wound *w)
{
  rope_close (&w->rope);
  reef_close (&w->reef);
}

static double
laid (const wound *w)
{
  return bt__dynamic_length (w->rope.d);
}

/* ---- The loads ---- */

/* The length without tension of a line that is drawn over the drum by end 1, which is LEG from the
   drum, with tension T at end 0: where the line has run round by the share u of theta, the tension
   is T exp (mu theta u).  */
static double
unstretched (const wound *w, double leg, double t)
{
  const int parts = 2000; /* of the arc: each as its middle */
  double grown = exp (w->mu * w->theta),
         sum = LEG / (1 + t / w->ea) + leg / (1 + grown * t / w->ea);
  for (int i = 0; i < parts; i++)
    {
      double at = t * exp (w->mu * w->theta * (i + 0.5) / parts);
      sum += OUT * w->theta / parts / (1 + at / w->ea);
    }
  return sum;
}

/* The tension at end 0 of a line whose length without tension is LENGTH.  */
static double
load_of (const wound *w, double leg, double length)
{
  double low = 0, high = w->ea;
  for (int i = 0; i < 100; i++)
    {
      double t = 0.5 * (low + high);
      if (unstretched (w, leg, t) > length)
        low = t;
      else
        high = t;
    }
  return low;
}

/* Draw end E by WAY at SPEED.  */
static void
draw (wound *w, int e, double way, double speed)
{
  for (double left = way; left > 0; left -= speed * frame)
    {
      w->end[e] = bt__axpy (w->end[e], fmin (left, speed * frame), w->along[e]);
      w->rope.in.end[e].at = w->end[e];
      assert_true (rope_step (&w->rope, frame, 0));
    }
}

static void
check_loads (double link, double mu, double tolerance)
{
  static wound w;
  w = (wound){ .link = link, .mu = mu, .turns = 0.5, .ea = 4000, .r = OUT };
  lay (&w);
  double length = laid (&w), way = 0.07 * length;
  w.rope.in.end[0].at = w.end[0];
  draw (&w, 1, way, 0.05);
  const double *t = bt__dynamic_tension (w.rope.d);
  double low = load_of (&w, LEG + way, length), high = low * exp (mu * w.theta);
  double is[] = { t[0], t[w.rope.d->n - 1] };
  print_message (
      "# elements of %.2f R, mu %.1f: %.2f and %.2f N, exactly %.2f and %.2f (%+.2f, %+.2f %%); "
      "%d corners\n",
      link, mu, is[0], is[1], low, high, 100 * (is[0] / low - 1), 100 * (is[1] / high - 1),
      (int)w.rope.touch.bends);
  assert_near (is[0] / low, 1, tolerance, "the load at the end that is held");
  assert_near (is[1] / high, 1, tolerance, "the load at the end that is drawn");
  unwind (&w);
}

static void
loads (void **state)
{
  (void)state;
  const double link[] = { 0.5, 0.7, 1, 1.5, 2 }, mu[] = { 0, 0.3 };
  for (int i = 0; i < 5; i++)
    for (int k = 0; k < 2; k++)
      check_loads (link[i], mu[k], 0.01);
  for (int k = 0; k < 2; k++) /* not held at corners: a polygon is longer by (link / 2 R)^2 / 3 */
    check_loads (0.25, mu[k], 0.025);
}

/* ---- Inside the wrap ---- */

/* What was borne.  */
typedef struct borne
{
  double ends, inside; /* N: the most so far; the most above what the ends had borne by then */
} borne;

static void
look (const wound *w, borne *b)
{
  const double *t = bt__dynamic_tension (w->rope.d);
  int n = (int)w->rope.d->n;
  b->ends = fmax (b->ends, fmax (fmax (t[0], t[1]), fmax (t[n - 1], t[n - 2])));
  for (int j = 0; j < n; j++)
    b->inside = fmax (b->inside, t[j] - b->ends);
}

/* Draw a loose wrap tight by end E until 150 N, and let the line hang for a while; a mass hangs
   from the other end.  Where a loose line runs taut, a snap comes to v sqrt (EA m), and is thrown
   back.  */
static void
check_inside (double link, double mu, double turns, double ea, int e)
{
  static wound w;
  w = (wound){ .link = link,
               .mu = mu,
               .turns = turns,
               .ea = ea,
               .r = 1.02 * sqrt (OUT * OUT + link * link * DRUM * DRUM / 4) };
  lay (&w);
  borne b = { 0, 0 };
  double speed = 0.2;
  long after = 0;
  w.rope.in.end[!e] = (bt__dynamic_end){
    .free = 1, .body = { .mass = 5, .linear = 20, .force = bt__scale (25, w.along[!e]) }
  };
  w.rope.in.end[e].at = w.end[e];
  for (int i = 0; i < 1200 && after < 60; i++)
    {
      after += bt__norm (w.rope.d->pull[e]) > 150;
      if (after == 0)
        w.end[e] = bt__axpy (w.end[e], speed * frame, w.along[e]);
      w.rope.in.end[e].at = w.end[e];
      assert_true (rope_step (&w.rope, frame, 0));
      look (&w, &b);
    }
  double snap = 2 * speed * sqrt (ea * w.rope.line.mass);
  print_message (
      "# elements of %.2f R, mu %.1f, %.2f turns, EA %.0e, end %d: %.1f N at the ends, inside "
      "%+.1f; a snap %.1f\n",
      link, mu, turns, ea, e, b.ends, b.inside, snap);
  assert_below (b.inside, 5 + snap, "what is borne inside beyond what the ends have borne");
  unwind (&w);
}

static void
inside (void **state)
{
  (void)state;
  const double link[] = { 0.3, 0.5, 0.7, 1, 2 };
  for (int i = 0; i < 5; i++)
    for (int e = 0; e < 2; e++)
      {
        check_inside (link[i], 0.6, 2.25, 2e4, e);
        check_inside (link[i], 0.3, 1.25, 2e5, e);
      }
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (loads), cmocka_unit_test (inside) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
