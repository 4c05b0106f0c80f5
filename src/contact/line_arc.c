/* The line between two nodes where it bends about a round member.

   A sliding node about a round member is the corner of a polygon about the member, and the line of
   the solver is measured along the arc below the corner (line_round.c).  Between a corner and the
   next node the line lies along a helix from the place below the corner to where the tangent from
   the next node touches the member, and then straight; between two corners of one member along a
   helix throughout.  Points of the line are read there: on the chords of the corners two points
   would be farther apart than the line between them is long.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

/* A piece of helix about an axis, from below a corner to where the line leaves the member.  */
typedef struct arc
{
  bt_vec3 axis, from,
      centre;              /* unit; unit, across the axis; m: middle of the member at the corner */
  double out, angle, rise; /* m; radians; m along the axis to the end of the arc */
  double length;           /* m; 0 where there is no arc: the line then goes straight to END */
  bt_vec3 end;             /* m */
} arc;

/* The point of A at the share F, from the corner on.  */
static bt_vec3
arc_point (const arc *a, double f)
{
  double turned = f * a->angle;
  bt_vec3 n
      = bt__axpy (bt__scale (cos (turned), a->from), sin (turned), bt__cross (a->axis, a->from));
  return bt__axpy (bt__axpy (a->centre, a->out, n), f * a->rise, a->axis);
}

/* The arc at corner C with its node at X, of ANGLE and RISE.  */
static arc
arc_from (const bt__contact *c, double radius, bt_vec3 x)
{
  bt_vec3 middle = bt__axpy (c->point, -c->thick, c->normal);
  bt_vec3 u = bt__off_axis (c->axis, bt__sub (x, middle));
  return (arc){ .axis = c->axis,
                .from = bt__unit_or (u, c->normal),
                .centre = bt__sub (x, u),
                .out = c->thick + radius };
}

static void
measure_arc (arc *a)
{
  a->length = hypot (a->out * a->angle, a->rise);
  a->end = arc_point (a, 1);
}

/* The arc at corner C, with its node at X, on the side of the next node, at NEXT: SIDE 1 after the
   corner, -1 before it.  */
static arc
arc_to_tangent (const bt__contact *c, double radius, bt_vec3 x, bt_vec3 next, int side)
{
  arc a = arc_from (c, radius, x);
  bt_vec3 u = bt__off_axis (a.axis, bt__sub (next, a.centre));
  double way = sqrt (fmax (bt__dot (u, u) - a.out * a.out, 0));
  a.angle = bt__turn_angle (a.axis, a.from, bt__turn_tangent (a.axis, u, a.out, -side));
  a.angle = side * fmax (side * a.angle, 0);
  double round = a.out * fabs (a.angle);
  a.rise = round > 0 ? bt__dot (a.axis, bt__sub (next, x)) * round / (round + way) : 0;
  measure_arc (&a);
  return a;
}

/* The arc from corner C, with its node at X, to the next corner of the same member, at NEXT.  */
static arc
arc_to_corner (const bt__contact *c, double radius, bt_vec3 x, bt_vec3 next)
{
  arc a = arc_from (c, radius, x);
  bt_vec3 to = bt__unit_or (bt__off_axis (a.axis, bt__sub (next, a.centre)), a.from);
  a.angle = bt__turn_angle (a.axis, a.from, to);
  a.rise = bt__dot (a.axis, bt__sub (next, x));
  measure_arc (&a);
  return a;
}

/* The point at the share F of the line along A, then straight, then along B backward.  */
static bt_vec3
point_along (const arc *a, const arc *b, double f)
{
  double straight = bt__distance (a->end, b->end);
  double s = f * (a->length + straight + b->length);
  if (s < a->length)
    return arc_point (a, s / a->length);
  s -= a->length;
  if (s > straight)
    return arc_point (b, b->length > 0 ? fmax (1 - (s - straight) / b->length, 0) : 1);
  return bt__axpy (a->end, straight > 0 ? s / straight : 0, bt__sub (b->end, a->end));
}

/* The contact of a sliding node about a round member that is FROM_END m from the end of D.  */
static const bt__contact *
round_at (const bt__dynamic *d, const bt__contacts *contacts, double from_end)
{
  const bt__contact *a = bt__contacts_at (contacts);
  double near = BT__SAME * (1 + bt__dynamic_length (d));
  for (int64_t q = 0; q < contacts->n; q++)
    if (a[q].bent == BT__BENT_ROUND && fabs (a[q].from_end - from_end) <= near)
      return a + q;
  return NULL;
}

/* True if a sliding node about a round member is in CONTACTS.  */
static int
has_round (const bt__contacts *contacts)
{
  const bt__contact *a = bt__contacts_at (contacts);
  for (int64_t q = 0; q < contacts->n; q++)
    if (a[q].bent == BT__BENT_ROUND)
      return 1;
  return 0;
}

bt_vec3
bt__line_arc_point (const bt__dynamic *d, const bt__contacts *contacts, double radius, double s)
{
  if (!has_round (contacts))
    return bt__dynamic_point (d, s);
  double start, u = bt__dynamic_along (d, s);
  int j = bt__dynamic_interval (d, u, &start);
  double rest = bt__dynamic_rest (d)[j], from_end = bt__dynamic_length (d) - d->owed - start;
  const bt__contact *c[2]
      = { round_at (d, contacts, from_end), round_at (d, contacts, from_end - rest) };
  const bt_vec3 *x = bt__dynamic_x (d) + j;
  arc a = { .end = x[0] }, b = { .end = x[1] };
  if (!c[0] && !c[1])
    return bt__dynamic_point (d, s);
  if (c[0] && c[1] && bt__bend_goes_on (c[0], c[1]))
    {
      a = arc_to_corner (c[0], radius, x[0], x[1]);
      b.end = a.end;
    }
  else
    {
      a = c[0] ? arc_to_tangent (c[0], radius, x[0], x[1], 1) : a;
      b = c[1] ? arc_to_tangent (c[1], radius, x[1], x[0], -1) : b;
    }
  return point_along (&a, &b, fmin (fmax (u - start, 0) / rest, 1));
}
