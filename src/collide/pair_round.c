/* A link's axis against a point, a sphere, a capsule and a half-space.

   Point and segment: the foot, clamped.  Capsule: the closest points of two segments.  The distance
   to a round shape is the distance to its core less the radius.  This holds inside too: the
   shortest way out of the sum of a ball and a flat set leads straight across the flat set.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/pair.h"

/* Two points nearer than this share of the coordinates have a difference with lost digits; the
   directions of the two shapes are then the better normal.  */
#define CLOSE 1e-3

/* The normal N where a segment of direction D is met at T: made square to D, and at an end turned
   away from the segment (SIDE 1 if N points to the segment, -1 if from the segment).  */
static bt_vec3
square_off (bt_vec3 n, bt_vec3 d, double t, double side)
{
  double along = side * bt__dot (n, d), dd = bt__dot (d, d);
  if (!(dd > 0) || (t <= 0 && along >= 0) || (t >= 1 && along <= 0))
    return n;
  return bt__unit_or (bt__axpy (n, -side * along / dd, d), n);
}

typedef struct meeting
{
  bt_vec3 d, e, point; /* directions of link and core, the core's nearest point */
  double s, t, radius; /* where on link and core */
} meeting;

/* The normal where the axes cross, either way.  */
static bt_vec3
cross_normal (const meeting *m)
{
  bt_vec3 n = bt__cross (m->d, m->e);
  double flat = 1e-12 * bt__norm (m->d) * bt__norm (m->e);
  if (bt__norm (n) > flat)
    {
      n = bt__unit_or (n, n); /* of nearly parallel axes not quite across them: once more */
      return bt__unit_or (bt__axpy (n, -bt__dot (n, m->d) / bt__dot (m->d, m->d), m->d), n);
    }
  return bt__across (bt__dot (m->e, m->e) > bt__dot (m->d, m->d) ? m->e : m->d);
}

static void
finish_round (const meeting *m, const bt__link *link, bt__witness *out)
{
  bt_vec3 on = bt__along (link, m->s), gap = bt__sub (on, m->point), n;
  double distance = bt__norm (gap), size = bt__largest (on) + bt__largest (m->d) + m->radius;
  if (distance > CLOSE * size)
    n = bt__scale (1 / distance, gap);
  else
    {
      n = cross_normal (m);
      int inner = m->s > 0 && m->s < 1 && m->t > 0 && m->t < 1;
      if (inner && bt__dot (n, gap) < 0)
        n = bt__scale (-1, n);
      else if (!inner && distance > BT__TOUCHING * size)
        n = square_off (square_off (bt__scale (1 / distance, gap), m->d, m->s, 1), m->e, m->t, -1);
    }
  out->s = m->s;
  out->normal = n;
  out->point = bt__axpy (m->point, m->radius, n);
  out->distance = distance - m->radius;
}

void
bt__pair_sphere (const bt__sphere *sphere, const bt__link *link, bt__witness *out)
{
  meeting m = { .point = sphere->centre, .radius = sphere->radius };
  m.d = bt__sub (link->b, link->a);
  m.s = bt__share (bt__dot (bt__sub (sphere->centre, link->a), m.d), bt__dot (m.d, m.d));
  out->feature = 0;
  finish_round (&m, link, out);
}

void
bt__pair_point (bt_vec3 point, const bt__link *link, bt__witness *out)
{
  bt__sphere sphere = { point, 0 };
  bt__pair_sphere (&sphere, link, out);
}

void
bt__pair_capsule (const bt__capsule *capsule, const bt__link *link, bt__witness *out)
{
  meeting m = { .radius = capsule->radius };
  m.d = bt__sub (link->b, link->a);
  m.e = bt__sub (capsule->b, capsule->a);
  bt__closest_segments (bt__sub (link->a, capsule->a), m.d, m.e, &m.s, &m.t);
  m.point = bt__axpy (capsule->a, m.t, m.e);
  out->feature = m.t <= 0 ? BT__CAP_LOW : m.t >= 1 ? BT__CAP_HIGH : BT__SIDE;
  finish_round (&m, link, out);
}

void
bt__pair_plane (const bt__plane *plane, const bt__link *link, bt__witness *out)
{
  double a = bt__dot (plane->normal, link->a) - plane->offset;
  double b = bt__dot (plane->normal, link->b) - plane->offset;
  out->s = b < a;
  out->distance = b < a ? b : a;
  out->normal = plane->normal;
  out->point = bt__axpy (b < a ? link->b : link->a, -out->distance, plane->normal);
  out->feature = 0;
}
