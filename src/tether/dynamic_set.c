/* The moving line: its set, a natural curvature.

   A line that lay on a drum, or was kinked, is bent where no moment acts.  A node's natural turn
   d is the integral of the natural curvature over its cell, and the node stores
   EI |w - d|^2 / (2 cell), w being its turn (dynamic_bend.c).

   The natural curvature is fixed in the material: it has two components, toward two directors of
   the cross-section.  A line does not twist here: the directors are carried along the line by
   parallel transport, from each tangent to the next the shortest way (the Bishop frame of M. Bergou
   et al., "Discrete elastic rods", ACM Transactions on Graphics 27, 2008), and half the way to a
   node. Where the line is clamped at node 0 the clamp holds the directors; else the line turns
   about itself freely, to where bending stores least: sum k b.(d x w) = 0, b the tangents at nodes.

   Directors follow the tangents of all nodes before them, a moment at one node pushes at all nodes
   before.  A tangent that sweeps an area on the sphere of directions turns the directors beyond it
   by that area (holonomy), and the moment about the tangent, which is the derivative of the energy
   by the angle of the directors, does work.  The forces of a set are the exact gradient of
   - EI w.d / cell at the present iterate, directors and all.  The blocks of a step have the
   stiffness of bending alone; where the line is long for its set, a turn of the whole line out of
   the plane is resisted by EI kappa0^4 more, which is added to the blocks of every node: the
   iteration creeps up on the solution instead of passing the solution.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_frame.h"

#define BACK 1e-6  /* of 1 + cos of the angle of a fold: less is a fold right back */
#define HOLD 1.0   /* of EI kappa0^4 by the cell, in the blocks */
#define SHORT 0.2  /* of the rest length: the shortest lever of a force */
#define BLUNT 0.05 /* 1 + cos of the sharpest fold that a moment passes as it is */

static const bt_vec3 down = { 0, 0, -1 }, north = { 0, 1, 0 };

bt_vec3
bt__carry_side (bt_vec3 u, bt_vec3 t, bt_vec3 s)
{
  double c = 1 + bt__dot (t, s);
  return c > BACK ? bt__axpy (u, -bt__dot (u, s) / c, bt__add (t, s)) : u;
}

bt_vec3
bt__set_side (bt_vec3 direction)
{
  return bt__carry_side (north, down, direction);
}

bt_vec3
bt__set_carry (bt_vec3 side, bt_vec3 from, bt_vec3 to)
{
  return bt__unit_or (bt__carry_side (side, from, to), bt__set_side (to));
}

static bt__dynamic_set
place_set (const bt_set *set, double from_end)
{
  double half = 0.5 * set->span, plane = set->plane * BT__PI / 180;
  return (bt__dynamic_set){ .from = isfinite (half) ? from_end - half : -INFINITY,
                            .to = isfinite (half) ? from_end + half : INFINITY,
                            .curvature
                            = { set->curvature * cos (plane), set->curvature * sin (plane) } };
}

int
bt__place_sets (const bt_set *sets, int n, double length, double beyond, bt__dynamic_set *out)
{
  int count = 0;
  for (int k = 0; k < n; k++)
    if (sets[k].curvature > 0)
      out[count++] = place_set (sets + k, length - sets[k].at - beyond);
  return count;
}

/* ---- Along the line ---- */

static bt_vec3
set_chord (const bt__frame_line *l, int j)
{
  return bt__sub (l->x[j + 1], l->x[j]);
}

int
bt__first_station (const bt__frame_line *l)
{
  return l->in->end[0].clamped ? 0 : 1;
}

int
bt__last_station (const bt__frame_line *l)
{
  return l->in->end[1].clamped ? l->n : l->n - 1;
}

static bt_vec3
clamp_of (const bt__frame_line *l, int end)
{
  return bt__unit_or (l->in->end[end].direction, down);
}

bt__walk
bt__set_out (const bt__frame_line *l)
{
  bt__walk s = { .cos = 1 };
  for (int j = 0; j < l->n; j++)
    s.left += bt__frame_rest (l, j);
  if (l->in->end[0].clamped)
    {
      bt_vec3 side = l->in->end[0].side;
      s.t = clamp_of (l, 0);
      side = bt__off_axis (s.t, side);
      s.u = bt__unit_or (side, bt__set_side (s.t));
      return s;
    }
  s.t = bt__unit_or (set_chord (l, 0), down);
  s.u = bt__set_side (s.t);
  s.left -= bt__frame_rest (l, 0);
  return s;
}

/* The integral of component C of the natural curvature from FROM to TO metres from node n.  */
static double
natural_angle (const bt__dynamic_input *in, int c, double from, double to)
{
  double sum = 0;
  for (int k = 0; k < in->n_sets; k++)
    {
      const bt__dynamic_set *set = in->sets + k;
      sum += set->curvature[c] * fmax (0, fmin (to, set->to) - fmax (from, set->from));
    }
  return sum;
}

/* The natural turn of a node of tangent B whose first director is U; its cell reaches from FROM to
   TO metres from node n.  */
static bt_vec3
natural_turn (const bt__frame_line *l, const bt__walk *s, double from, double to, bt_vec3 b,
              bt_vec3 u)
{
  double p = natural_angle (l->in, 0, from, to), q = natural_angle (l->in, 1, from, to);
  double angle = hypot (p, q);
  if (angle == 0)
    return bt__vec (0, 0, 0);
  double size = 2 * sin (0.5 * fmin (angle, BT__SHARPEST)) / angle;
  bt_vec3 v = bt__cross (b, u);
  return bt__axpy (bt__scale (size * (p * s->cos - q * s->sin), u),
                   size * (p * s->sin + q * s->cos), v);
}

bt__station
bt__next_station (const bt__frame_line *l, bt__walk *s, int i)
{
  double before = i > 0 ? bt__frame_rest (l, i - 1) : 0,
         after = i < l->n ? bt__frame_rest (l, i) : 0;
  bt_vec3 to = i < l->n ? set_chord (l, i) : clamp_of (l, 1);
  bt_vec3 next = bt__unit_or (to, s->t);
  bt_vec3 from = i > 0 ? bt__scale (1 / before, set_chord (l, i - 1)) : s->t;
  bt__station at = { .swept = bt__cross (s->t, next), .half = 0.5 * (1 + bt__dot (s->t, next)) };
  at.w = bt__sub (i < l->n ? bt__scale (1 / after, to) : to, from);
  at.middle = bt__unit_or (bt__add (s->t, next), next);
  at.cell = 0.5 * (before + after);
  at.k = 2 * l->in->line->ei / (before + after);
  if (l->edge && l->in->n_sets > 0)
    {
      double angle = 0.5 * (bt__angle_before (l, i) + bt__angle_after (l, i));
      s->cos = cos (angle);
      s->sin = sin (angle);
    }
  at.d = natural_turn (l, s, s->left - 0.5 * after, s->left + 0.5 * before, at.middle,
                       bt__carry_side (s->u, s->t, at.middle));
  s->u = bt__carry_side (s->u, s->t, next);
  s->t = next;
  s->left -= after;
  return at;
}

double
bt__moment_of (const bt__station *at)
{
  return at->k * bt__dot (at->middle, bt__cross (at->d, at->w));
}

/* At the start of L, at the angle about its axis to which a line turns without a clamp.  */
static bt__walk
set_out_turned (const bt__frame_line *l)
{
  bt__walk start = bt__set_out (l), s = start;
  double sin = 0, cos = 0;
  if (l->in->end[0].clamped || l->edge)
    return start;
  for (int i = bt__first_station (l); i <= bt__last_station (l); i++)
    {
      bt__station at = bt__next_station (l, &s, i);
      sin += bt__moment_of (&at);
      cos += at.k * bt__dot (at.d, at.w);
    }
  double size = hypot (sin, cos);
  if (size > 0)
    {
      start.cos = cos / size;
      start.sin = sin / size;
    }
  return start;
}

double
bt__set_energy (const bt__frame_line *l)
{
  bt__walk s = set_out_turned (l);
  double sum = 0;
  for (int i = bt__first_station (l); i <= bt__last_station (l); i++)
    {
      bt__station at = bt__next_station (l, &s, i);
      bt_vec3 off = bt__sub (at.w, at.d);
      sum += i > 0 && i < l->n ? 0.5 * at.k * bt__dot (off, off) : 0;
    }
  return sum;
}

/* ---- Forces ---- */

/* The derivative of - w.d k of node I by the tangents before and after the node: the natural turn
   follows the tangents, and the moment BEYOND passes through the node.  */
static void
push_tangents (bt__dynamic_work *w, int i, const bt__station *at, double beyond)
{
  double half = fmax (at->half, BLUNT), c = sqrt (half), here = beyond + bt__moment_of (at);
  double size = 1 / (4 * half * (1 + c));
  double near = 1 + 2 * c; /* the half of a turn that is at a tangent follows it more */
  bt_vec3 follow = bt__scale (at->k * bt__dot (at->w, at->middle) / (2 * c), at->d);
  bt_vec3 *g = w->felt;
  if (i > 0)
    g[i - 1] = bt__add (g[i - 1], bt__axpy (follow, size * (here * near + beyond), at->swept));
  if (i < w->n)
    g[i] = bt__add (g[i], bt__axpy (follow, size * (here + beyond * near), at->swept));
}

/* The force PULL on the end of interval J, and its reaction on the beginning.  */
static void
pull_apart (bt__dynamic_work *w, int j, bt_vec3 pull)
{
  w->twist[j] = bt__sub (w->twist[j], pull);
  w->twist[j + 1] = bt__add (w->twist[j + 1], pull);
}

/* The force of the natural turn of node I, its directors held.  */
static void
push_turn (bt__dynamic_work *w, const bt__frame_line *l, int i, const bt__station *at)
{
  w->natural[i] = at->d;
  if (i > 0)
    pull_apart (w, i - 1, bt__scale (-at->k / bt__frame_rest (l, i - 1), at->d));
  if (i < w->n)
    pull_apart (w, i, bt__scale (at->k / bt__frame_rest (l, i), at->d));
}

/* The forces of what the tangents feel.  */
static void
push_chords (bt__dynamic_work *w, const bt__frame_line *l)
{
  for (int j = 0; j < w->n; j++)
    {
      bt_vec3 c = set_chord (l, j), t = bt__unit_or (c, down), g = w->felt[j];
      double length = fmax (bt__norm (c), SHORT * bt__frame_rest (l, j));
      pull_apart (w, j, bt__scale (-1 / length, bt__off_axis (t, g)));
    }
}

/* The moment that passes a node is the sum over all nodes beyond, from the far end, which turns
   freely, or is gripped and adds the torque of its grip.  */
void
bt__dynamic_set_forces (bt__dynamic_work *w, const bt_vec3 *x)
{
  bt__frame_line l = { .in = w->in, .x = x, .n = w->n, .link = w->link };
  double beyond = w->twists ? bt__dynamic_twist (w, &l) : 0;
  bt__walk start = set_out_turned (&l), s = start;
  memset (w->natural, 0, (size_t)(w->n + 1) * sizeof *w->natural);
  memset (w->twist, 0, (size_t)(w->n + 1) * sizeof *w->twist);
  memset (w->felt, 0, (size_t)(w->n + 1) * sizeof *w->felt);
  for (int i = bt__first_station (&l); w->is_set && i <= bt__last_station (&l); i++)
    {
      bt__station at = bt__next_station (&l, &s, i);
      beyond += bt__moment_of (&at);
      push_turn (w, &l, i, &at);
    }
  s = start;
  for (int i = bt__first_station (&l); i <= bt__last_station (&l); i++)
    {
      bt__station at = bt__next_station (&l, &s, i);
      beyond -= bt__moment_of (&at);
      push_tangents (w, i, &at, beyond);
    }
  push_chords (w, &l);
}

double
bt__set_hold (const bt__dynamic_work *w, int i)
{
  double cell = w->node[i].cell, square = bt__dot (w->natural[i], w->natural[i]) / (cell * cell);
  return HOLD * w->in->line->ei * square * square * cell;
}

double
bt__dynamic_set_potential (const bt__dynamic_work *w, const bt_vec3 *x)
{
  bt__frame_line l = { .in = w->in, .x = x, .n = w->n, .link = w->link };
  if (w->twists)
    bt__dynamic_twist (w, &l);
  bt__walk s = set_out_turned (&l);
  double sum = w->twists ? bt__dynamic_twist_potential (w, &l) : 0;
  for (int i = bt__first_station (&l); i <= bt__last_station (&l); i++)
    {
      bt__station at = bt__next_station (&l, &s, i);
      sum -= at.k * bt__dot (at.w, at.d);
    }
  return sum;
}
