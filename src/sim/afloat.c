/* A line that floats is laid on the water: see chain.h.

   The equilibrium solvers know no surface: a slack line lighter than water rises above the surface
   in an arch.  Each arch is laid down by a rotation about the straight line between its two
   crossings of the surface, down to the side to which the current sets.  The rotation keeps length
   and curvature.  An arch from an end above the water hangs from the end instead.

   Between two nodes the line is a cubic and may rise above both nodes: the nodes are laid deeper by
   the cubic's rise.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/chain.h"

#define HAIR 1e-9  /* m: a node lifted out of the water by rounding is not in air */
#define ASIDE 1e-6 /* of the current: less of it across the feet is rounding and tells no side */
#define DEEPER 0.1 /* of the length between nodes: cubics rise less above the nodes */

enum
{
  FEWEST = 32 /* intervals of a shape that had none: so many follow a fold */
};

static const bt_vec3 up = { 0, 0, 1 };

static int
is_out (bt_vec3 p)
{
  return p.z > HAIR;
}

/* The place between P and Q where the height over a level, HP there and HQ here, is none.  */
static bt_vec3
crossing (bt_vec3 p, bt_vec3 q, double hp, double hq)
{
  return bt__axpy (p, hp / (hp - hq), bt__sub (q, p));
}

int
bt__next_arch (const bt_vec3 *x, const double *over, int n, int k, bt__arch *a)
{
  while (k <= n && !(over[k] > 0))
    k++;
  if (k > n)
    return 0;
  a->first = k;
  while (k < n && over[k + 1] > 0)
    k++;
  a->last = k;
  a->from = a->first == 0
                ? x[0]
                : crossing (x[a->first - 1], x[a->first], over[a->first - 1], over[a->first]);
  a->to = a->last == n ? x[n]
                       : crossing (x[a->last], x[a->last + 1], over[a->last], over[a->last + 1]);
  return 1;
}

/* The direction of the arch's feet from each other; where they are one, that of its middle.  */
static bt_vec3
along_feet (const bt_vec3 *x, const bt__arch *a)
{
  bt_vec3 far = bt__sub (a->to, a->from);
  if (bt__norm (far) > 1e-9)
    return bt__unit_or (far, far);
  far = bt__sub (x[(a->first + a->last) / 2], a->from);
  far.z = 0;
  return bt__unit_or (far, bt__vec (1, 0, 0));
}

void
bt__lay_aside (bt_vec3 *x, const bt__arch *a, int hangs, bt_vec3 downstream)
{
  bt_vec3 e = along_feet (x, a), side = bt__unit_or (bt__cross (up, e), bt__vec (1, 0, 0));
  if (bt__dot (side, downstream) < -ASIDE * bt__norm (downstream))
    side = bt__scale (-1, side);
  for (int k = a->first; k <= a->last; k++)
    {
      bt_vec3 foot = bt__axpy (a->from, bt__dot (bt__sub (x[k], a->from), e), e);
      bt_vec3 off = bt__sub (x[k], foot);
      if (!hangs)
        x[k] = bt__axpy (foot, bt__norm (off), side);
      else if (off.z > 0)
        x[k] = bt__sub (foot, off);
    }
}

/* True if a node of A is out of the water.  */
static int
is_any_out (const bt_vec3 *x, const bt__arch *a)
{
  int any = 0;
  for (int k = a->first; k <= a->last; k++)
    any |= is_out (x[k]);
  return any;
}

int
bt__lay_afloat (bt_vec3 *x, double *over, int n, double length, const bt_water *water)
{
  bt__arch a;
  double level = -DEEPER * length / n;
  int laid = 0;
  bt_vec3 first = x[0], last = x[n], downstream = bt_water_velocity (water, x[n / 2]);
  for (int k = 0; k <= n; k++)
    over[k] = x[k].z - level;
  for (int k = 0; bt__next_arch (x, over, n, k, &a); k = a.last + 1)
    if (is_any_out (x, &a))
      {
        bt__lay_aside (x, &a, is_out (a.from) || is_out (a.to), downstream);
        laid = 1;
      }
  x[0] = first;
  x[n] = last;
  return laid;
}

/* ---- Still shapes ---- */

/* True if one of N points along SHAPE stands out of the water and both ends are in the water.  */
static int
stands (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, int n)
{
  if (is_out (shape->a) || is_out (shape->b))
    return 0;
  int known = bt__has_nodes (shape->form);
  for (int k = 1; k < n; k++)
    if (is_out (known ? nodes[k] : bt__shape_point (shape, nodes, tensions, shape->length * k / n)))
      return 1;
  return 0;
}

static bt_vec3
tension_at (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  return bt__scale (bt__shape_tension (shape, nodes, tensions, s),
                    bt__shape_tangent (shape, nodes, tensions, s));
}

/* Turn the tension vectors along the line at the nodes of X, N + 1 in number, moved from WERE, and
   at their neighbours.  */
static void
turn_tensions (const bt_vec3 *x, const bt_vec3 *were, bt_vec3 *tension, int n)
{
  for (int k = 0; k <= n; k++)
    {
      bt_vec3 way = bt__sub (x[k < n ? k + 1 : n], x[k > 0 ? k - 1 : 0]);
      int moved = 0;
      for (int j = k > 0 ? k - 1 : 0; j <= k + 1 && j <= n; j++)
        moved |= bt__distance (x[j], were[j]) > 0;
      if (moved)
        tension[k] = bt__scale (bt__norm (tension[k]), bt__unit_or (way, tension[k]));
    }
}

/* Give SHAPE, solved in closed form, N intervals.  */
static void
divide (bt__shape *shape, bt_vec3 *nodes, bt_vec3 *tensions, int n)
{
  for (int k = 0; k <= n; k++)
    {
      double s = shape->length * k / n;
      nodes[k] = bt__shape_point (shape, NULL, NULL, s);
      tensions[k] = tension_at (shape, NULL, NULL, s);
    }
  nodes[0] = shape->a;
  nodes[n] = shape->b;
}

void
bt__lay_shape_afloat (bt_dive *dive, bt__state *state, int i)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__shape *shape = &tether->shape;
  bt_vec3 *nodes = bt__dive_nodes (dive, state, i), *tensions = bt__dive_tensions (dive, state, i);
  bt_vec3 *were = dive->polyline;
  int n = (int)(bt__has_nodes (shape->form) ? shape->n : fmax (tether->props.nodes, FEWEST));
  bt_water water = bt__dive_water (dive, state);
  if (!stands (shape, nodes, tensions, n))
    return;
  if (shape->form != BT__FORM_NODES)
    divide (shape, nodes, tensions, n);
  memcpy (were, nodes, sizeof *nodes * (size_t)(n + 1));
  bt__lay_afloat (nodes, dive->over, n, shape->length, &water);
  turn_tensions (nodes, were, tensions, n);
  shape->form = BT__FORM_AFLOAT;
  shape->n = n;
}
