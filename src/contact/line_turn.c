/* The geometry of a line about an edge.

   Across the axis the edge is a circle, enlarged by the line's radius, and the line a polygon about
   the circle: every side a tangent, every corner a node held where two tangents meet.  Between the
   tangents of normals a and b the line turns by the angle from a to b.  The turns of all corners of
   a member add up to the turn of the line, wherever the corners are, and so do the exponents of the
   capstan: T_b / T_a = e^(mu (turn_1 + turn_2 + ...)).

   A corner is out / cos (angle / 2) from the axis; its tangents touch at out tan (angle / 2) from
   the corner.  From a point u away from the axis, D = |u|, the tangents have the normals

     (out u -+ sqrt (D^2 - out^2) axis x u) / D^2.

   The line itself lies along the circle, half the turn of a corner on either side.  Between two
   corners in a row with turns a and b lie out (a + b) / 2 of line about the circle, wherever the
   corners are held; between a corner with turn a and a point at distance D from the axis lie
   out a / 2 + sqrt (D^2 - out^2).  Together with the way along the axis the result is the length of
   the line, as of an unrolled helix.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define LEAST_COS 0.25 /* of half the turn: what a node is held out for at most */

bt_vec3
bt__turn_tangent (bt_vec3 axis, bt_vec3 u, double out, double sign)
{
  double square = bt__dot (u, u), way = sqrt (fmax (square - out * out, 0));
  if (!(way > 0))
    return bt__unit_or (u, bt__vec (0, 0, 0));
  return bt__scale (1 / square, bt__axpy (bt__scale (out, u), sign * way, bt__cross (axis, u)));
}

int
bt__turn_find (const bt__line_job *k, const bt__edge *e, const bt_vec3 *p, const bt_vec3 *before,
               const bt_vec3 *after, bt__turn *t)
{
  bt_vec3 axis = e->axis, centre = bt__axpy (e->point, -e->radius, e->normal), none = { 0, 0, 0 };
  double out = e->radius + k->config->radius;
  t->before = before ? *before
                     : bt__turn_tangent (axis, bt__off_axis (axis, bt__sub (p[0], centre)), out, 1);
  t->after = after ? *after
                   : bt__turn_tangent (axis, bt__off_axis (axis, bt__sub (p[2], centre)), out, -1);
  bt_vec3 sum = bt__add (t->before, t->after);
  t->normal = bt__unit_or (sum, e->normal);
  t->angle = bt__turn_angle (axis, t->before, t->after);
  double cosine = fmax (0.5 * bt__norm (sum), LEAST_COS);
  t->zone = out * sqrt (fmax (1 / (cosine * cosine) - 1, 0));
  centre = bt__axpy (centre, bt__dot (axis, bt__sub (p[1], centre)), axis);
  t->centre = centre;
  t->reach = out / cosine;
  t->at = bt__axpy (centre, t->reach, t->normal);
  bt_vec3 a = bt__unit_or (bt__sub (t->at, p[0]), none),
          b = bt__unit_or (bt__sub (p[2], t->at), none);
  t->turn = 2 * asin (fmin (0.5 * bt__norm (bt__sub (b, a)), 1));
  t->sliding = bt__scale (0.5, bt__add (a, b));
  return bt__dot (t->normal, e->normal) > 0 && fabs (bt__dot (axis, a)) < BT__TURN_ALONG
         && fabs (bt__dot (axis, b)) < BT__TURN_ALONG;
}

double
bt__turn_round (const bt__line_job *k, const bt__edge *e, const bt__turn *t, bt_vec3 x,
                bt_vec3 next, double angle)
{
  double out = e->radius + k->config->radius, rise = bt__dot (e->axis, bt__sub (next, x));
  bt_vec3 u = bt__off_axis (e->axis, bt__sub (next, t->centre));
  double beyond
      = isfinite (angle) ? 0.5 * out * angle : sqrt (fmax (bt__dot (u, u) - out * out, 0));
  double across = fmax (0.5 * out * t->angle + beyond, 0);
  return e->round ? bt__distance (x, next) - hypot (across, rise) : 0;
}
