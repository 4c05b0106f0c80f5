/* Distance of a link's axis, a straight segment, to one shape: closed forms.

   Every function fills a bt__witness and cannot fail: a link of no length, a degenerate triangle,
   parallel and touching pairs have an answer.  Distances are good to 1e-12 of the largest length
   involved.  Radii of the link are the caller's affair: subtract them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_PAIR_H
#define BT_COLLIDE_PAIR_H

#include "math/vec.h"

/* The axis of a tether link.  */
typedef struct bt__link
{
  bt_vec3 a, b;
} bt__link;

typedef struct bt__witness
{
  double distance; /* to the shape; inside a solid minus the depth: the shortest way out */
  double s;        /* where on the link, 0 at A, 1 at B */
  bt_vec3 point;   /* on the shape */
  bt_vec3 normal;  /* unit, from the shape to the link; when inside, the way out */
  int feature;     /* of the shape, see each function */
} bt__witness;

/* Orthonormal, right-handed.  */
typedef struct bt__frame
{
  bt_vec3 origin, x, y, z;
} bt__frame;

typedef struct bt__sphere
{
  bt_vec3 centre;
  double radius;
} bt__sphere;

typedef struct bt__capsule
{
  bt_vec3 a, b;
  double radius;
} bt__capsule;

typedef struct bt__box
{
  bt__frame frame; /* origin at the centre */
  bt_vec3 half;
} bt__box;

/* Solid, with flat caps.  */
typedef struct bt__cylinder
{
  bt_vec3 centre, axis; /* axis: unit */
  double half, radius;  /* half: of the height */
} bt__cylinder;

typedef struct bt__triangle
{
  bt_vec3 v[3];
} bt__triangle;

/* Solid below: the points p with normal . p <= offset.  */
typedef struct bt__plane
{
  bt_vec3 normal; /* unit */
  double offset;
} bt__plane;

typedef struct bt__hull bt__hull;

/* Features of a solid cylinder and of a capsule.  */
enum
{
  BT__SIDE,
  BT__CAP_LOW,
  BT__CAP_HIGH,
  BT__RIM_LOW,
  BT__RIM_HIGH
};

/* Feature 0.  */
void bt__pair_point (bt_vec3 point, const bt__link *link, bt__witness *out);
void bt__pair_sphere (const bt__sphere *sphere, const bt__link *link, bt__witness *out);
void bt__pair_plane (const bt__plane *plane, const bt__link *link, bt__witness *out);

/* Feature BT__SIDE, BT__CAP_LOW (round A) or BT__CAP_HIGH (round B).  The radius may be 0.  */
void bt__pair_capsule (const bt__capsule *capsule, const bt__link *link, bt__witness *out);

/* LINK against the axis of OTHER: as against a capsule of radius 0.  */
static inline void
bt__pair_links (const bt__link *other, const bt__link *link, bt__witness *out)
{
  bt__pair_capsule (&(bt__capsule){ other->a, other->b, 0 }, link, out);
}

/* Feature in base 3, least digit x: 0 the low side, 1 between, 2 the high side.  */
void bt__pair_box (const bt__box *box, const bt__link *link, bt__witness *out);

/* Feature BT__SIDE, a cap or a rim.  */
void bt__pair_cylinder (const bt__cylinder *cylinder, const bt__link *link, bt__witness *out);
/* True if LINK is within REACH, positive, of CYLINDER; the way out of it is not looked for.  */
int bt__cylinder_within (const bt__cylinder *cylinder, const bt__link *link, double reach);

/* Two-sided, never inside: a link that crosses has distance 0.  Feature 0 the face, 1 to 3 the edge
   that starts at vertex 0 to 2, 4 to 6 the vertex.  */
void bt__pair_triangle (const bt__triangle *triangle, const bt__link *link, bt__witness *out);

/* Solid.  Feature: a vertex number outside; inside a face number, or the number of faces plus that
   of an edge.  */
void bt__pair_hull (const bt__hull *hull, const bt__link *link, bt__witness *out);

/* The solid cylinder when the link's axis is inside, in its frame (axis z, centre 0): P and Q are
   the ends, HALF and RADIUS its size; the same fields, in that frame.  */
void bt__cylinder_deep (bt_vec3 p, bt_vec3 q, double half, double radius, bt__witness *out);

/* ---- Inline parts ---- */

/* Below this share of the coordinates a distance is rounding: the normal comes from elsewhere.  */
#define BT__TOUCHING 1e-14

static inline bt_vec3
bt__along (const bt__link *link, double s)
{
  return bt__axpy (link->a, s, bt__sub (link->b, link->a));
}

/* The quotient N / D within 0 and 1; 0 if D is 0.  */
static inline double
bt__share (double n, double d)
{
  return d > 0 ? bt__clamp (n / d, 0, 1) : 0;
}

/* The place of the point of LINK nearest to P: 0 at its start, 1 at its end.  */
static inline double
bt__nearest_share (const bt__link *link, bt_vec3 p)
{
  bt_vec3 d = bt__sub (link->b, link->a);
  return bt__share (bt__dot (bt__sub (p, link->a), d), bt__dot (d, d));
}

static inline double
bt__largest (bt_vec3 a)
{
  double x = fabs (a.x), y = fabs (a.y), z = fabs (a.z);
  x = x > y ? x : y;
  return x > z ? x : z;
}

/* A unit vector across D, which may be 0.  */
static inline bt_vec3
bt__across (bt_vec3 d)
{
  double x = fabs (d.x), y = fabs (d.y), z = fabs (d.z);
  bt_vec3 e = x <= y && x <= z ? bt__vec (1, 0, 0) : y <= z ? bt__vec (0, 1, 0) : bt__vec (0, 0, 1);
  return bt__unit_or (bt__cross (d, e), e);
}

static inline bt_vec3
bt__into (const bt__frame *f, bt_vec3 d)
{
  return bt__vec (bt__dot (f->x, d), bt__dot (f->y, d), bt__dot (f->z, d));
}

static inline bt_vec3
bt__out_of (const bt__frame *f, bt_vec3 d)
{
  return bt__axpy (bt__axpy (bt__scale (d.x, f->x), d.y, f->y), d.z, f->z);
}

static inline bt_vec3
bt__to_local (const bt__frame *f, bt_vec3 p)
{
  return bt__into (f, bt__sub (p, f->origin));
}

static inline bt_vec3
bt__to_world (const bt__frame *f, bt_vec3 p)
{
  return bt__add (f->origin, bt__out_of (f, p));
}

/* Link J of the polyline X; LINK as seen in F; LINK after the share T of the moves DA, DB of the
   ends.  */
static inline bt__link
bt__link_of (const bt_vec3 *x, uint32_t j)
{
  return (bt__link){ x[j], x[j + 1] };
}

static inline bt__link
bt__link_into (const bt__frame *f, bt__link link)
{
  return (bt__link){ bt__to_local (f, link.a), bt__to_local (f, link.b) };
}

static inline bt__link
bt__link_moved (const bt__link *link, bt_vec3 da, bt_vec3 db, double t)
{
  return (bt__link){ bt__axpy (link->a, t, da), bt__axpy (link->b, t, db) };
}

/* The parameters S, T of the closest points of P + s D and Q + t E, both from 0 to 1, with
   R = P - Q.  Nearly parallel lines are solved by cross products, which lose digits with the angle
   between the two and not with its square.  */
static inline void
bt__closest_segments (bt_vec3 r, bt_vec3 d, bt_vec3 e, double *s, double *t)
{
  double dd = bt__dot (d, d), ee = bt__dot (e, e), de = bt__dot (d, e);
  double dr = bt__dot (d, r), er = bt__dot (e, r), det = dd * ee - de * de;
  if (det > 1e-4 * dd * ee)
    *s = bt__clamp ((de * er - dr * ee) / det, 0, 1);
  else
    {
      bt_vec3 n = bt__cross (d, e);
      *s = bt__share (bt__dot (bt__cross (e, r), n), bt__dot (n, n));
    }
  double to = de * *s + er; /* t of the foot, times ee */
  if (to <= 0)
    {
      *t = 0;
      *s = bt__share (-dr, dd);
    }
  else if (to >= ee)
    {
      *t = ee > 0 ? 1 : 0;
      *s = bt__share (ee > 0 ? de - dr : -dr, dd);
    }
  else
    *t = to / ee;
}

#endif
