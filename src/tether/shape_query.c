/* Asking a resolved shape: points, tangents and tensions at an arc length, pure reads.

   Plane curves (V, catenary, elastic) are asked at the plane's own arc length and set into space by
   the vectors across, against and rise; rise is the depth shared out by the linear rule.

   Nodes of a steady line are joined by cubics of Hermite.  The end tangents have the direction of
   the tension and the length of the arc, chord (1 + turn^2 / 24), right for a circle to fourth
   order, times the stretch at the end over the mean stretch of the interval: the places along a
   heavy line that hangs straight are a square of its arc length, as is the cubic.  A cubic longer
   than its interval by more than 1 % takes only a share of its deviation from the chord (smooth.h).
   Tensions are a cubic through the four nearest nodes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "tether/shape.h"
#include "tether/smooth.h"

static const bt_vec3 down = { 0, 0, -1 };

static double
within_shape (const bt__shape *shape, double s)
{
  return s > 0 ? (s < shape->length ? s : shape->length) : 0;
}

/* Metres of plane curve per metre of line.  */
static double
plane_ratio (const bt__shape *shape)
{
  return shape->plane_length / shape->length;
}

/* ---- The V ---- */

/* The far end in the plane.  */
static bt_point2
plane_end (const bt__shape *shape)
{
  bt_vec3 chord = bt__axpy (bt__sub (shape->b, shape->a), -shape->length, shape->rise);
  return (bt_point2){ bt__dot (chord, shape->across), bt__dot (chord, shape->against) };
}

static int
is_second_link (const bt_v_shape *v, double u)
{
  return v->l2 > 0 && u >= v->l1;
}

static bt_point2
v_point (const bt__shape *shape, double u)
{
  const bt_v_shape *v = &shape->v;
  if (!is_second_link (v, u))
    return (bt_point2){ v->bend.x * (u / v->l1), v->bend.y * (u / v->l1) };
  bt_point2 end = plane_end (shape);
  double k = fmin ((u - v->l1) / v->l2, 1);
  return (bt_point2){ v->bend.x + k * (end.x - v->bend.x), v->bend.y + k * (end.y - v->bend.y) };
}

static bt_point2
v_tangent (const bt__shape *shape, double u)
{
  const bt_v_shape *v = &shape->v;
  if (!is_second_link (v, u))
    return (bt_point2){ v->bend.x / v->l1, v->bend.y / v->l1 };
  bt_point2 end = plane_end (shape);
  return (bt_point2){ (end.x - v->bend.x) / v->l2, (end.y - v->bend.y) / v->l2 };
}

/* ---- Nodes ---- */

/* One interval: ends, derivatives by the fraction F along it, chord.  */
typedef struct piece
{
  double f;
  int64_t i;
  bt_vec3 p, q, dp, dq, chord;
} piece;

static int64_t
node_interval (const bt__shape *shape, double s, double *f)
{
  double x = s / shape->length * (double)shape->n;
  int64_t i = (int64_t)x;
  if (i > shape->n - 1)
    i = shape->n - 1;
  *f = x - (double)i;
  return i;
}

static double
stretch_by (const bt__shape *shape, double tension)
{
  return shape->elastic.ea > 0 ? 1 + tension / shape->elastic.ea : 1;
}

/* The mean stretch of an interval between nodes under the tensions T and U, by the rule of Simpson:
   where the load is even, tension changes evenly.  */
static double
mean_stretch (const bt__shape *shape, bt_vec3 t, bt_vec3 u)
{
  double between = 0.5 * bt__norm (bt__add (t, u));
  return (stretch_by (shape, bt__norm (t)) + 4 * stretch_by (shape, between)
          + stretch_by (shape, bt__norm (u)))
         / 6;
}

/* How long an interval of REST metres, of the chord CHORD, would be unstretched, m: by its turn, in
   radians, or by what is known of a line that stretches.  At a fold the turn tells too much.  */
static double
unstretched_arc (const bt__shape *shape, double chord, double turn, double mean, double rest)
{
  double arc = chord * (1 + turn * turn / 24) / mean;
  return shape->elastic.ea > 0 ? fmin (arc, rest) : arc;
}

static piece
piece_of (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  piece p;
  p.i = node_interval (shape, s, &p.f);
  p.p = nodes[p.i];
  p.q = nodes[p.i + 1];
  p.chord = bt__sub (p.q, p.p);
  bt_vec3 along = bt__unit_or (p.chord, down);
  bt_vec3 t = bt__unit_or (tensions[p.i], along), u = bt__unit_or (tensions[p.i + 1], along);
  double turn = bt__distance (t, u), rest = shape->length / (double)shape->n;
  double mean = mean_stretch (shape, tensions[p.i], tensions[p.i + 1]),
         at = stretch_by (shape, bt__norm (tensions[p.i])),
         there = stretch_by (shape, bt__norm (tensions[p.i + 1])),
         line = unstretched_arc (shape, bt__norm (p.chord), turn, mean, rest);
  bt_vec3 a = bt__sub (bt__scale (line * at, t), p.chord),
          b = bt__sub (bt__scale (line * there, u), p.chord);
  double reach = fmax (at, there) / mean * fmax (bt__norm (p.chord), rest);
  double share = bt__smooth_share (p.chord, a, b, reach);
  p.dp = bt__axpy (p.chord, share, a);
  p.dq = bt__axpy (p.chord, share, b);
  return p;
}

static bt_vec3
nodes_point (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  piece p = piece_of (shape, nodes, tensions, s);
  double f = p.f, g = 1 - f;
  bt_vec3 r = f < 0.5 ? bt__axpy (p.p, f * f * (3 - 2 * f), p.chord)
                      : bt__axpy (p.q, -g * g * (3 - 2 * g), p.chord);
  return bt__axpy (bt__axpy (r, f * g * g, p.dp), -f * f * g, p.dq);
}

static bt_vec3
nodes_tangent (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  piece p = piece_of (shape, nodes, tensions, s);
  double f = p.f, g = 1 - f;
  bt_vec3 d = bt__scale (6 * f * g, p.chord);
  d = bt__axpy (bt__axpy (d, g * (g - 2 * f), p.dp), f * (f - 2 * g), p.dq);
  return bt__unit_or (d, bt__unit_or (p.chord, down));
}

/* The tension vector by the cubic through the four nearest nodes, a line where there are fewer.  */
static double
nodes_tension (const bt__shape *shape, const bt_vec3 *tensions, double s)
{
  double f;
  int64_t i = node_interval (shape, s, &f);
  if (shape->n < 3)
    return bt__norm (bt__axpy (bt__scale (1 - f, tensions[i]), f, tensions[i + 1]));
  int64_t first = i < 1 ? 0 : i > shape->n - 2 ? shape->n - 3 : i - 1;
  double x = f + (double)(i - first);
  const bt_vec3 *t = tensions + first;
  bt_vec3 sum = bt__scale ((1 - x) * (2 - x) * (3 - x) / 6, t[0]);
  sum = bt__axpy (sum, x * (2 - x) * (3 - x) / 2, t[1]);
  sum = bt__axpy (sum, x * (x - 1) * (3 - x) / 2, t[2]);
  return bt__norm (bt__axpy (sum, x * (x - 1) * (x - 2) / 6, t[3]));
}

/* ---- Any form ---- */

static bt_point2
plane_point (const bt__shape *shape, double u)
{
  switch (shape->form)
    {
    case BT__FORM_V:
      return v_point (shape, u);
    case BT__FORM_ELASTIC:
      return bt_elastic_point (&shape->elastic, u);
    default:
      return bt_catenary_point (&shape->catenary, u);
    }
}

static bt_point2
plane_tangent (const bt__shape *shape, double u)
{
  switch (shape->form)
    {
    case BT__FORM_V:
      return v_tangent (shape, u);
    case BT__FORM_ELASTIC:
      return bt_elastic_tangent (&shape->elastic, u);
    default:
      return bt_catenary_tangent (&shape->catenary, u);
    }
}

bt_vec3
bt__shape_point (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  s = within_shape (shape, s);
  if (shape->form == BT__FORM_STRAIGHT)
    return bt__axpy (shape->a, s / shape->length, bt__sub (shape->b, shape->a));
  if (bt__has_nodes (shape->form))
    return nodes_point (shape, nodes, tensions, s);
  bt_point2 p = plane_point (shape, s * plane_ratio (shape));
  bt_vec3 r = bt__axpy (bt__axpy (shape->a, p.x, shape->across), p.y, shape->against);
  return bt__axpy (r, s, shape->rise);
}

bt_vec3
bt__shape_tangent (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  s = within_shape (shape, s);
  if (shape->form == BT__FORM_STRAIGHT)
    return bt__unit_or (bt__sub (shape->b, shape->a), down);
  if (bt__has_nodes (shape->form))
    return nodes_tangent (shape, nodes, tensions, s);
  double ratio = plane_ratio (shape);
  bt_point2 t = plane_tangent (shape, s * ratio);
  bt_vec3 r = bt__axpy (bt__scale (t.x, shape->across), t.y, shape->against);
  return bt__unit_or (bt__axpy (shape->rise, ratio, r), shape->across);
}

double
bt__shape_tension (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions, double s)
{
  (void)nodes;
  s = within_shape (shape, s);
  switch (shape->form)
    {
    case BT__FORM_V:
      return is_second_link (&shape->v, s * plane_ratio (shape)) ? shape->t2 : shape->t1;
    case BT__FORM_ELASTIC:
      return bt_elastic_tension (&shape->elastic, s);
    case BT__FORM_NODES:
    case BT__FORM_AFLOAT:
      return nodes_tension (shape, tensions, s);
    default:
      return shape->t1;
    }
}
