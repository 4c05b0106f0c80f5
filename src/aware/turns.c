/* Turns and winding: sums of angles, each by one atan2.

   Turns of a polyline about an axis are the sum, over the links, of the angle between the two ends
   of the link as seen along the axis.  Each angle is below half a turn and comes from the
   components of cross and scalar product, so the sum is exact but for rounding, however the line
   lies.  A link through the axis itself counts as 0.

   The winding is the turns rounded to a whole number, halves towards 0: a straight line past an
   axis turns by less than half a turn and has winding 0.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "aware/turns.h"

/* ---- The axis of an obstacle ---- */

static bt_vec3
middle_of_box (const bt_vec3 *v, uint32_t n)
{
  bt_vec3 lo = v[0], hi = v[0];
  for (uint32_t i = 1; i < n; i++)
    {
      lo = bt__vec (fmin (lo.x, v[i].x), fmin (lo.y, v[i].y), fmin (lo.z, v[i].z));
      hi = bt__vec (fmax (hi.x, v[i].x), fmax (hi.y, v[i].y), fmax (hi.z, v[i].z));
    }
  return bt__scale (0.5, bt__add (lo, hi));
}

int
bt__axis_of (const bt__obstacle *o, bt__axis *out)
{
  bt_vec3 down = bt__vec (0, 0, -1);
  *out = (bt__axis){ .along = down };
  switch (o->kind)
    {
    case BT__OBSTACLE_BOX:
      out->at = o->shape.box.frame.origin;
      return 1;
    case BT__OBSTACLE_SPHERE:
      out->at = o->shape.sphere.centre;
      return 1;
    case BT__OBSTACLE_CYLINDER:
      *out = (bt__axis){ o->shape.cylinder.centre, o->shape.cylinder.axis };
      return 1;
    case BT__OBSTACLE_CAPSULE:
      out->at = o->shape.capsule.a;
      out->along = bt__unit_or (bt__sub (o->shape.capsule.b, o->shape.capsule.a), down);
      return 1;
    case BT__OBSTACLE_CONVEX:
      out->at = middle_of_box (o->shape.hull->v, (uint32_t)o->shape.hull->vertices);
      return 1;
    case BT__OBSTACLE_MESH:
      out->at = bt__scale (0.5, bt__add (o->shape.mesh->box.lo, o->shape.mesh->box.hi));
      return 1;
    default:
      return 0;
    }
}

/* ---- Turns ---- */

/* The part of P - AXIS across the axis.  */
static bt_vec3
off_axis (const bt__axis *axis, bt_vec3 p)
{
  return bt__off_axis (axis->along, bt__sub (p, axis->at));
}

double
bt__turns (const bt__axis *axis, const bt_vec3 *p, uint32_t n)
{
  double sum = 0;
  for (uint32_t i = 0; i + 1 < n; i++)
    {
      bt_vec3 a = off_axis (axis, p[i]), b = off_axis (axis, p[i + 1]);
      double sine = bt__dot (axis->along, bt__cross (a, b)), cosine = bt__dot (a, b);
      sum += sine != 0 ? atan2 (sine, cosine) : 0;
    }
  return sum / (2 * BT__PI);
}

int
bt__winding (const bt__axis *axis, const bt_vec3 *p, uint32_t n)
{
  double turns = bt__turns (axis, p, n), size = fabs (turns);
  double whole = ceil (size - 0.5 - 1e-9);
  return (int)copysign (fmax (whole, 0), turns);
}
