/* Sight: is a point hidden from a camera?

   The line of sight is intersected with every solid of the view: boxes by slabs in their own axes,
   balls by the distance of the centre, triangles by the test of Moeller and Trumbore (1997).
   Cylinders and ground are sampled at 64 regular places along the line, so a thin pile far from the
   camera may be missed.  A mesh of more than 20 000 triangles is left out: the search would take
   longer than the picture.

   The last 0.3 m before the point, or a tenth of the line if less, are left out: a point on a solid
   or in touch with a solid is not hidden by it.  Used to choose a direction (aim.c), where an
   approximate answer is enough.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "render/sight.h"

enum
{
  PLACES = 64,      /* along a line of sight */
  TRIANGLES = 20000 /* a finer mesh is left out: the search would take longer than the picture */
};

/* The line FROM TO.  */
typedef struct ray
{
  bt_vec3 from, to;
} ray;

static bt_vec3
along (const ray *r, double t)
{
  return bt__axpy (r->from, t, bt__sub (r->to, r->from));
}

/* True if the line passes the slab from LOW to HIGH, narrowing T.  */
static int
in_slab (double from, double to, double low, double high, double t[2])
{
  double way = to - from, a = (low - from) / way, b = (high - from) / way;
  if (way == 0)
    return from > low && from < high;
  t[0] = fmax (t[0], fmin (a, b));
  t[1] = fmin (t[1], fmax (a, b));
  return t[0] < t[1];
}

static int
box_hides (const bt_thing *b, const ray *r)
{
  double size[3] = { b->size.x, b->size.y, b->size.z }, t[2] = { 0, 1 };
  bt_vec3 axis[3];
  int in = 1;
  bt_body_axes (b->heading, b->pitch, b->roll, axis);
  for (int i = 0; in && i < 3; i++)
    in = in_slab (bt__dot (bt__sub (r->from, b->at), axis[i]),
                  bt__dot (bt__sub (r->to, b->at), axis[i]), -size[i] / 2, size[i] / 2, t);
  return in;
}

/* How far P is from the line A B.  */
static double
off_line (bt_vec3 p, bt_vec3 a, bt_vec3 b)
{
  bt_vec3 ab = bt__sub (b, a);
  double l = bt__dot (ab, ab), t = l > 0 ? bt__dot (bt__sub (p, a), ab) / l : 0;
  return bt__distance (p, bt__axpy (a, fmin (fmax (t, 0), 1), ab));
}

static int
round_hides (const bt_thing *c, const ray *r)
{
  int hides = 0;
  for (int i = 0; i < PLACES && !hides; i++)
    hides = off_line (along (r, (i + 0.5) / PLACES), c->from, c->to) < c->radius;
  return hides;
}

static double
height_at (const bt_heights *g, double x, double y)
{
  double i = floor ((x - g->x) / g->dx + 0.5), k = floor ((y - g->y) / g->dy + 0.5);
  if (!(i >= 0 && k >= 0 && i < (double)g->nx && k < (double)g->ny))
    return -INFINITY;
  return g->z[(size_t)k * g->nx + (size_t)i];
}

static int
field_hides (const bt_thing *f, const ray *r)
{
  int hides = 0;
  for (int i = 0; i < PLACES && !hides; i++)
    {
      bt_vec3 p = along (r, (i + 0.5) / PLACES);
      hides = p.z < height_at (&f->grid, p.x, p.y);
    }
  return hides;
}

/* After T. Moeller and B. Trumbore, Fast, minimum storage ray/triangle intersection (1997).  */
static int
triangle_hides (const bt_vec3 p[3], const ray *r)
{
  bt_vec3 way = bt__sub (r->to, r->from), e = bt__sub (p[1], p[0]), f = bt__sub (p[2], p[0]);
  bt_vec3 h = bt__cross (way, f), s = bt__sub (r->from, p[0]), q = bt__cross (s, e);
  double a = bt__dot (e, h), u = bt__dot (s, h) / a, v = bt__dot (way, q) / a;
  double t = bt__dot (f, q) / a;
  return a != 0 && u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1;
}

static int
mesh_hides (const bt_thing *m, const ray *r)
{
  bt_vec3 axis[3], p[3];
  ray own;
  int hides = 0;
  bt_body_axes (m->heading, m->pitch, m->roll, axis);
  for (int i = 0; i < 2; i++)
    {
      bt_vec3 d = bt__sub (i ? r->to : r->from, m->at);
      d = bt__scale (1 / m->scale,
                     bt__vec (bt__dot (d, axis[0]), bt__dot (d, axis[1]), bt__dot (d, axis[2])));
      *(i ? &own.to : &own.from) = d;
    }
  for (size_t i = 0; i < m->triangles && m->triangles <= TRIANGLES && !hides; i++)
    {
      for (int k = 0; k < 3; k++)
        p[k] = m->points[m->corner[i][k]];
      hides = triangle_hides (p, &own);
    }
  return hides;
}

static int
hides (const bt_thing *t, const ray *r)
{
  switch (t->kind)
    {
    case BT_THING_BOX:
      return box_hides (t, r);
    case BT_THING_SPHERE:
      return off_line (t->at, r->from, r->to) < t->radius;
    case BT_THING_CYLINDER:
    case BT_THING_CAPSULE:
      return round_hides (t, r);
    case BT_THING_MESH:
      return mesh_hides (t, r);
    case BT_THING_LEVEL:
      return r->from.z < t->at.z || r->to.z < t->at.z;
    case BT_THING_FIELD:
      return field_hides (t, r);
    default:
      return 0;
    }
}

int
bt__hidden (const bt_view *view, bt_vec3 from, bt_vec3 to)
{
  /* A point on a solid, or in touch with a solid, is not hidden by that solid.  */
  double length = bt__distance (from, to), off = fmin (0.3, 0.1 * length);
  ray r = { from, bt__axpy (to, length > 0 ? off / length : 0, bt__sub (from, to)) };
  for (size_t i = 0; i < view->n; i++)
    if (hides (&view->things[i], &r))
      return 1;
  return 0;
}
