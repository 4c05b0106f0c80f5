/* See contact_wrap.h.

   A line is hauled over a drum on which it lies in a helix of pitch angle b, tan b = rise / (2 pi
   R): its curvature is cos^2 b / R over an arc of R / cos b for each radian, so that the tensions
   are as e^(mu theta cos b).  Links are a fifth of the radius, so that the contacts are as many as
   the turns; and other shares of it at half a turn.  A whole turn with much friction is last: there
   the tensions are as 43 and 535 to one.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/calibration.h"
#include "testbed/contact_scene.h"
#include "contact_wrap.h"

#define MU 0.05
#define RISE 0.06  /* m a turn */
#define LEG 1.0    /* m from the drum to either end */
#define SPEED 0.05 /* m/s */
#define PULL 30.0  /* N on the near end */

enum
{
  CORNERS = 802,
  STEPS = 600
};

static const double frame = 1.0 / 60;

typedef struct winding
{
  double radius, turns, share; /* m; ; a link, of the radius */
  double mu;
} winding;

/* What came of it, over the second half.  */
typedef struct hauled
{
  double ratio, seconds, touches, solves, unsolved; /* of the tensions; the rest a step */
} hauled;

/* The line's way: straight, about the drum, straight.  Return its length.  */
static double
shape_of (const winding *w, bt_vec3 *p)
{
  double theta = 2 * BT__PI * w->turns, out = w->radius + 0.005;
  double leg = LEG + 2 * w->share * w->radius, r = out / cos (fmin (w->share / 2, 1));
  p[0] = bt__vec (-r, 0, -leg);
  for (int i = 1; i < CORNERS; i++)
    {
      double u = (i - 1) / (CORNERS - 2.0), a = BT__PI - theta * u;
      p[i] = bt__vec (r * cos (a), RISE * w->turns * u, r * sin (a));
    }
  double a = BT__PI - theta;
  p[CORNERS] = bt__axpy (p[CORNERS - 1], leg, bt__vec (sin (a), 0, -cos (a)));
  return bt__length (p, CORNERS + 1);
}

static int
lay (const winding *w, reef *place, rope *line, bt_vec3 *shape)
{
  double length = shape_of (w, shape), half = 3 + RISE * w->turns;
  int links = (int)(length / (w->share * w->radius) + 0.5);
  if (!reef_open (place))
    return 0;
  reef_cylinder (place, bt__vec (0, -half, 0), bt__vec (0, half, 0), w->radius);
  if (!reef_raise (place) || !rope_open (line, place, links, shape, CORNERS + 1, length, w->mu))
    return 0;
  line->line.cdt = 0;
  line->config.pull[1] = INFINITY;
  line->in.end[0]
      = (bt__dynamic_end){ .free = 1,
                           .body = { .mass = 1, .linear = 20, .force = { 0, 0, -PULL } } };
  return 1;
}

static hauled
haul (rope *line, bt_vec3 along)
{
  hauled h = { 0 };
  double low = 0, high = 0;
  const double *t = bt__dynamic_tension (line->d);
  for (int i = 0; i < STEPS; i++)
    {
      bt_vec3 *at = &line->in.end[1].at;
      long solves = line->solves, unsolved = line->unconverged;
      *at = bt__axpy (*at, SPEED * frame * fmin (1, i / 60.0), along);
      double start = bench_now ();
      rope_step (line, frame, 0);
      double time = bench_now () - start;
      if (i < STEPS / 2)
        continue;
      h.seconds += time;
      h.touches += line->touch.touches;
      h.solves += (double)(line->solves - solves);
      h.unsolved += (double)(line->unconverged - unsolved);
      low += t[1];
      high += t[line->d->n - 2];
    }
  const int half = STEPS - STEPS / 2;
  return (hauled){ high / low, h.seconds / half, h.touches / half, h.solves / half,
                   h.unsolved / half };
}

static int
measure (bench_table *table, const winding *w)
{
  static reef place;
  static rope line;
  static bt_vec3 shape[CORNERS + 1];
  if (!lay (w, &place, &line, shape))
    return 0;
  bt_vec3 along = bt__unit_or (bt__sub (shape[CORNERS], shape[CORNERS - 1]), shape[0]);
  hauled h = haul (&line, along);
  double pitch = atan2 (RISE, 2 * BT__PI * w->radius);
  double exactly = exp (w->mu * 2 * BT__PI * w->turns * cos (pitch));
  char setting[80], counters[160], mu[20] = "";
  if (w->mu > MU)
    snprintf (mu, sizeof mu, " mu=%g", w->mu);
  snprintf (setting, sizeof setting, "R=%g m link=%g R%s %.0f touches", w->radius, w->share, mu,
            h.touches);
  snprintf (counters, sizeof counters,
            "turns=%g;T2/T1=%.4f;exactly=%.4f;solves=%.2f;unsolved=%.3g;links=%ld", w->turns,
            h.ratio, exactly, h.solves, h.unsolved, (long)line.d->n);
  bench_put (table,
             &(bench_row){ "wrap", "dynamic", setting, "T2/T1 against capstan",
                           fabs (h.ratio / exactly - 1), "closed form", 0, h.seconds, counters });
  rope_close (&line);
  reef_close (&place);
  return 1;
}

int
contact_wrap (bench_table *table, int quick)
{
  const double radius[] = { 0.6, 0.1, 2 }, turns[] = { 0, 0.25, 0.5, 1, 2, 4, 6 };
  const double share[] = { 0.05, 0.1, 0.4, 0.7, 1, 2 };
  for (int r = 0; r < (quick ? 1 : 3); r++)
    for (int i = 0; i < 7; i++)
      if (!measure (table, &(winding){ radius[r], turns[i], 0.2, MU }))
        return 0;
  for (int i = 0; i < 6; i++)
    if (!measure (table, &(winding){ 0.6, 0.5, share[i], MU }))
      return 0;
  for (int i = 0; i < 4; i++)
    if (!measure (table, &(winding){ 0.6, 1, i % 2 ? 0.2 : 0.05, i < 2 ? 0.6 : 1 }))
      return 0;
  return 1;
}
