/* A rope in a tank led by a vehicle: see outside.h.

   The reference tells no markers, but in each frame the catenary nearest to the markers, in the
   sense of least squares, among those whose vertical is any direction at all (an augmented
   catenary: Filliung et al., "An Augmented Catenary Model for Underwater Tethered Robots", ICRA
   2024), and by how much the markers lie beside that catenary.  A rope that drag bends is no such
   catenary.  So our line is drawn by the same rule too: then like is held against like.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/statics.h>

#include "testbed/outside.h"
#include "testbed/rig.h"

enum
{
  MARKERS = 16,
  INTERVALS = 57,
  TRIES = 30 /* of Gauss and Newton */
};

#define LENGTH 2.85 /* m */
#define DIAMETER 0.0035
#define DENSITY 1000.0
#define HANGS 2.1    /* s: until then the vehicle keeps its station */
#define NUDGE 1e-5   /* of a vertical: a derivative */
#define SETTLED 1e-9 /* of a vertical: the last correction */

const outside_rope outside_plain_rope = { .cd = 1.3 };

/* The markers' places along the cable, m.  */
static const double markers[MARKERS] = { 0,    0.05, 0.25, 0.45, 0.65, 0.85, 1.05, 1.25,
                                         1.45, 1.65, 1.85, 2.05, 2.25, 2.45, 2.65, 2.85 };

/* ---- Turned catenaries ---- */

/* What is downward for a catenary: (X, Y, -1).  */
typedef struct plumb
{
  double x, y;
} plumb;

/* The markers P on the rope from A to B if its downward is DOWN; zero if there is no catenary.  */
static int
draw_turned (bt_vec3 a, bt_vec3 b, plumb down, bt_vec3 *p)
{
  bt_vec3 up = bt__unit_or (bt__vec (-down.x, -down.y, 1), bt__vec (0, 0, 1)), c = bt__sub (b, a);
  double rise = bt__dot (c, up);
  bt_vec3 level = bt__axpy (c, -rise, up), ahead = bt__unit_or (level, bt__vec (1, 0, 0));
  bt_catenary curve;
  if (bt_catenary_solve (bt__norm (level), rise, LENGTH, &curve, NULL) != BT_OK)
    return 0;
  for (int k = 0; k < MARKERS; k++)
    {
      bt_point2 q = bt_catenary_point (&curve, markers[k]);
      p[k] = bt__axpy (bt__axpy (a, q.x, ahead), q.y, up);
    }
  return 1;
}

static double
mean_distance (const bt_vec3 *p, const bt_vec3 *q)
{
  double sum = 0;
  for (int k = 0; k < MARKERS; k++)
    sum += bt__distance (p[k], q[k]);
  return sum / MARKERS;
}

/* A step of Gauss and Newton for *DOWN, from P, its markers, and what they are beside X.  */
static double
correct (const bt_vec3 *x, const bt_vec3 *p, bt_vec3 side[2][MARKERS], plumb *down)
{
  double a = 0, b = 0, c = 0, u = 0, v = 0;
  for (int k = 0; k < MARKERS; k++)
    {
      bt_vec3 s = bt__scale (1 / NUDGE, bt__sub (side[0][k], p[k]));
      bt_vec3 t = bt__scale (1 / NUDGE, bt__sub (side[1][k], p[k])), off = bt__sub (x[k], p[k]);
      a += bt__dot (s, s);
      b += bt__dot (s, t);
      c += bt__dot (t, t);
      u += bt__dot (s, off);
      v += bt__dot (t, off);
    }
  double x_by = (c * u - b * v) / (a * c - b * b), y_by = (a * v - b * u) / (a * c - b * b);
  down->x += x_by;
  down->y += y_by;
  return fabs (x_by) + fabs (y_by);
}

/* The turned catenary P nearest to the markers X, with the ends of X, and its *DOWN, which holds a
   guess.  */
static int
fit_turned (const bt_vec3 *x, plumb *down, bt_vec3 *p)
{
  bt_vec3 side[2][MARKERS], a = x[0], b = x[MARKERS - 1];
  double moved = 1;
  for (int i = 0; i < TRIES && moved > SETTLED; i++)
    {
      if (!draw_turned (a, b, *down, p)
          || !draw_turned (a, b, (plumb){ down->x + NUDGE, down->y }, side[0])
          || !draw_turned (a, b, (plumb){ down->x, down->y + NUDGE }, side[1]))
        return 0;
      moved = correct (x, p, side, down);
    }
  return draw_turned (a, b, *down, p) && moved <= SETTLED;
}

/* ---- The rows of the reference ---- */

/* Axes of which the third points upward.  */
typedef struct axes
{
  bt_vec3 e[3];
} axes;

static axes
axes_of (plumb down)
{
  axes a;
  a.e[2] = bt__unit_or (bt__vec (-down.x, -down.y, 1), bt__vec (0, 0, 1));
  a.e[1] = bt__unit_or (bt__cross (a.e[2], bt__vec (1, 0, 0)), bt__vec (0, 1, 0));
  a.e[0] = bt__cross (a.e[1], a.e[2]);
  return a;
}

/* The three numbers P as a place in A.  */
static bt_vec3
place_in (const axes *a, const double *p)
{
  bt_vec3 q = bt__vec (p[0], p[1], p[2]);
  return bt__vec (bt__dot (q, a->e[0]), bt__dot (q, a->e[1]), bt__dot (q, a->e[2]));
}

static void
theirs_in (const axes *a, const double *row, bt_vec3 *x)
{
  for (int k = 0; k < MARKERS; k++)
    x[k] = place_in (a, row + 12 + 3 * k);
}

/* The downward of the rope while it hangs, before the vehicle sets out.  */
static plumb
hung (const outside_table *data)
{
  const axes told = axes_of ((plumb){ 0, 0 });
  bt_vec3 x[MARKERS], p[MARKERS];
  plumb sum = { 0, 0 }, down = { 0, 0 };
  int rows = 0;
  for (; rows < data->rows && data->at[rows][0] < HANGS; rows++)
    {
      theirs_in (&told, data->at[rows], x);
      if (!fit_turned (x, &down, p))
        return (plumb){ NAN, NAN };
      sum.x += down.x;
      sum.y += down.y;
    }
  return (plumb){ sum.x / rows, sum.y / rows };
}

/* ---- The rope ---- */

/* The water that the nodes have taken along.  */
typedef struct wake
{
  bt_vec3 v[INTERVALS + 1]; /* m/s */
  bt__dynamic_lump push[INTERVALS];
} wake;

/* The drag of node I of R less the drag of water without memory.  The water at a node takes on
   SHARE of its speed over a way of FADES diameters; drag is as much larger as makes up for it in
   steady motion.  */
static bt_vec3
push_of_wake (const rig *r, const outside_rope *rope, wake *w, int i, double h)
{
  const bt_vec3 *x = bt__dynamic_x (r->d), still = { 0, 0, 0 };
  bt_vec3 t = bt__unit_or (bt__sub (x[i + 1], x[i - 1]), bt__vec (0, 0, -1));
  bt_vec3 v = bt__sub (bt__dynamic_v (r->d)[i], rope->drift);
  v = bt__axpy (v, -bt__dot (v, t), t);
  double gone = bt__norm (v) * h / (rope->fades * DIAMETER);
  bt_vec3 wanted = bt__scale (rope->wake, v);
  w->v[i] = bt__axpy (w->v[i], 1 - exp (-gone), bt__sub (wanted, w->v[i]));
  bt_vec3 past = bt__sub (bt__axpy (w->v[i], -bt__dot (w->v[i], t), t), v);
  double k = 0.5 * DENSITY * rope->cd * DIAMETER * LENGTH / INTERVALS, slower = 1 - rope->wake;
  bt_vec3 more = bt__scale (k / (slower * slower) * bt__norm (past), past);
  return bt__sub (more, bt__scale (k * bt__norm (v), bt__sub (still, v)));
}

static void
drag_wake (rig *r, const outside_rope *rope, wake *w, double h)
{
  if (!(rope->wake > 0))
    return;
  for (int i = 1; i < INTERVALS; i++)
    w->push[i - 1] = (bt__dynamic_lump){ .from_end = (INTERVALS - i) * LENGTH / INTERVALS,
                                         .force = push_of_wake (r, rope, w, i, h) };
  r->in.lumps = w->push;
  r->in.n_lumps = INTERVALS - 1;
}

static void
open_rope (rig *r, const outside_rope *rope, const bt__dynamic_set *set, bt_vec3 end)
{
  bt_vec3 shape[3] = { { 0, 0, 0 }, { end.x / 2, end.y / 2, -1.3 }, end };
  bt_tether_props line = { .diameter = DIAMETER,
                           .mass = 0.0517,
                           .wet_weight = 0.4,
                           .ea = 1e4,
                           .ei = rope->ei,
                           .cdn = rope->cd,
                           .cdt = 0.01,
                           .ca = 1 };
  rig_open (r, line, DENSITY, INTERVALS, shape, 3, LENGTH);
  r->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { rope->drift } };
  r->in.sets = set;
  r->in.n_sets = rope->curvature > 0;
  rig_settle (r);
}

/* Hold R against a row of theirs, the markers X.  */
static void
compare (rig *r, const double *row, const bt_vec3 *x, plumb down[2], outside_tank *tank)
{
  bt_vec3 ours[MARKERS], p[MARKERS], q[MARKERS];
  int k = tank->rows++;
  for (int i = 0; i < MARKERS; i++)
    ours[i] = bt__dynamic_point (r->d, markers[i]);
  tank->t[k] = row[0];
  tank->off[k] = 1000 * mean_distance (ours, x);
  tank->doubt[k] = row[10];
  tank->plain[k] = row[11];
  r->good &= fit_turned (ours, down, p) && fit_turned (x, down + 1, q);
  tank->drawn[k] = 1000 * mean_distance (p, q);
  tank->misses[k] = 1000 * mean_distance (ours, p);
}

outside_result
outside_in_tank (const outside_rope *rope, outside_tank *tank)
{
  static outside_table data;
  static wake w;
  const bt__dynamic_set set = { -INFINITY, INFINITY, { rope->curvature, 0 } };
  plumb down[2] = { { 0, 0 }, { 0, 0 } };
  bt_vec3 x[MARKERS];
  rig r;
  if (!outside_load ("real/toulon_cable6_surge_0p6_0031.csv", 12 + 3 * MARKERS, &data))
    return OUTSIDE_NO_DATA;
  const axes a = axes_of (rope->plumb ? hung (&data) : (plumb){ 0, 0 });
  w = (wake){ 0 };
  open_rope (&r, rope, &set, place_in (&a, data.at[0] + 1));
  tank->rows = 0;
  for (int k = 0; r.good && k < data.rows; k++)
    {
      const double *row = data.at[k];
      double h = k > 0 ? row[0] - data.at[k - 1][0] : 0;
      r.in.end[1].at = place_in (&a, row + 1);
      drag_wake (&r, rope, &w, h);
      if (k > 0)
        rig_step (&r, h);
      theirs_in (&a, row, x);
      compare (&r, row, x, down, tank);
    }
  return rig_close (&r) ? OUTSIDE_DONE : OUTSIDE_FAILED;
}
