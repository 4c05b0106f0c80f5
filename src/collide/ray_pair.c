/* A line meets a convex solid in an interval, the intersection of the line's intervals in the
   slabs, half-spaces, balls and infinite cylinders about the solid.  A capsule is the union of
   three such solids.

   Triangles are tested as by Woop, Benthin and Wald (2013): the ray is sheared on to an axis, and
   two triangles with a common edge compute the side of the edge by the same product, so no ray
   slips between the triangles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/ray_pair.h"

/* The interval of a line inside a shape, empty if IN > OUT; N is the normal where it enters.  */
typedef struct span
{
  double in, out;
  bt_vec3 n;
} span;

typedef struct line
{
  bt_vec3 from, d;
} line;

/* A direction flatter than this against a face is along it.  */
#define ALONG 1e-15

static const span all = { -INFINITY, INFINITY, { 0, 0, 0 } };
static const span none = { INFINITY, -INFINITY, { 0, 0, 0 } };

/* Cut S to the half-space N . p <= 0.  The line starts at HEIGHT outside and rises at SPEED.  */
static void
clip_to_half_space (span *s, bt_vec3 n, double height, double speed)
{
  if (fabs (speed) <= ALONG)
    {
      if (height > 0)
        *s = none;
      return;
    }
  double at = -height / speed;
  if (speed > 0)
    s->out = at < s->out ? at : s->out;
  else if (at > s->in)
    {
      s->in = at;
      s->n = n;
    }
}

/* Cut S to the slab of HALF to both sides of 0 along the unit N.  */
static void
clip_slab (span *s, bt_vec3 n, double half, double at, double speed)
{
  clip_to_half_space (s, n, at - half, speed);
  clip_to_half_space (s, bt__scale (-1, n), -at - half, -speed);
}

/* The ball of radius R about a centre from which the line starts at M, seen in the space across
   some axis: M and D without what lies along it; DD is D . D.  */
static span
in_round (bt_vec3 m, bt_vec3 d, double dd, double r)
{
  if (!(dd > ALONG * ALONG))
    return bt__dot (m, m) <= r * r ? all : none;
  double middle = -bt__dot (m, d) / dd;
  bt_vec3 foot = bt__axpy (m, middle, d);
  double square = (r - bt__norm (foot)) * (r + bt__norm (foot));
  if (!(square >= 0))
    return none;
  double half = sqrt (square / dd);
  bt_vec3 out = bt__axpy (foot, -half, d);
  return (span){ middle - half, middle + half, bt__unit_or (out, bt__scale (-1, d)) };
}

static span
in_sphere (const bt__sphere *s, const line *l)
{
  return in_round (bt__sub (l->from, s->centre), l->d, bt__dot (l->d, l->d), s->radius);
}

/* The side of the infinite cylinder through CENTRE along the unit AXIS.  */
static span
in_side (bt_vec3 centre, bt_vec3 axis, double radius, const line *l)
{
  bt_vec3 m = bt__sub (l->from, centre);
  m = bt__off_axis (axis, m);
  bt_vec3 d = bt__off_axis (axis, l->d);
  return in_round (m, d, bt__dot (d, d), radius);
}

static span
in_cylinder (const bt__cylinder *c, const line *l)
{
  span s = in_side (c->centre, c->axis, c->radius, l);
  clip_slab (&s, c->axis, c->half, bt__dot (c->axis, bt__sub (l->from, c->centre)),
             bt__dot (c->axis, l->d));
  return s;
}

static span
in_box (const bt__box *b, const line *l)
{
  span s = all;
  bt_vec3 m = bt__to_local (&b->frame, l->from), d = bt__into (&b->frame, l->d);
  clip_slab (&s, b->frame.x, b->half.x, m.x, d.x);
  clip_slab (&s, b->frame.y, b->half.y, m.y, d.y);
  clip_slab (&s, b->frame.z, b->half.z, m.z, d.z);
  return s;
}

static span
in_hull (const bt__hull *h, const line *l)
{
  span s = all;
  for (int i = 0; i < h->faces && s.in <= s.out; i++)
    {
      bt_vec3 n = h->face[i].normal;
      double height = bt__dot (n, bt__sub (l->from, h->v[h->corner[i][0]]));
      clip_to_half_space (&s, n, height, bt__dot (n, l->d));
    }
  return s;
}

static span
in_plane (const bt__plane *p, const line *l)
{
  span s = all;
  clip_to_half_space (&s, p->normal, bt__dot (p->normal, l->from) - p->offset,
                      bt__dot (p->normal, l->d));
  return s;
}

static int
enter (const span *s, bt_vec3 d, double reach, bt__entry *out)
{
  if (!(s->in <= s->out && s->out >= 0 && s->in <= reach))
    return 0;
  *out = s->in > 0 ? (bt__entry){ s->in, s->n } : (bt__entry){ 0, bt__scale (-1, d) };
  return 1;
}

static int
enter_capsule (const bt__capsule *c, const line *l, double reach, bt__entry *out)
{
  bt_vec3 d = bt__sub (c->b, c->a);
  double half = 0.5 * bt__norm (d);
  bt__sphere a = { c->a, c->radius }, b = { c->b, c->radius };
  span part[3] = { in_sphere (&a, l), in_sphere (&b, l), none };
  if (half > 0)
    part[2] = in_cylinder (&(bt__cylinder){ bt__scale (0.5, bt__add (c->a, c->b)),
                                            bt__scale (0.5 / half, d), half, c->radius },
                           l);
  int found = 0;
  for (int i = 0; i < 3; i++)
    if (enter (part + i, l->d, reach, out))
      {
        found = 1;
        reach = out->range;
      }
  return found;
}

int
bt__ray_obstacle (const bt__obstacle *o, bt_vec3 from, bt_vec3 direction, double reach,
                  bt__entry *out)
{
  line l = { from, direction };
  span s;
  switch (o->kind)
    {
    case BT__OBSTACLE_BOX:
      s = in_box (&o->shape.box, &l);
      break;
    case BT__OBSTACLE_SPHERE:
      s = in_sphere (&o->shape.sphere, &l);
      break;
    case BT__OBSTACLE_CYLINDER:
      s = in_cylinder (&o->shape.cylinder, &l);
      break;
    case BT__OBSTACLE_CAPSULE:
      return enter_capsule (&o->shape.capsule, &l, reach, out);
    case BT__OBSTACLE_CONVEX:
      s = in_hull (o->shape.hull, &l);
      break;
    case BT__OBSTACLE_PLANE:
      s = in_plane (&o->shape.plane, &l);
      break;
    default:
      return 0;
    }
  return enter (&s, direction, reach, out);
}

/* ---- Triangles ---- */

/* P from FROM, sheared so that the ray is the axis: X and Y across, Z along; axes in ORDER, the
   last the largest of the direction.  */
typedef struct shear
{
  double from[3], x, y, z;
  int order[3];
} shear;

static shear
shear_of (bt_vec3 from, bt_vec3 d)
{
  double dv[3] = { d.x, d.y, d.z };
  int k = fabs (d.x) > fabs (d.y) ? 0 : 1;
  k = fabs (dv[k]) > fabs (d.z) ? k : 2;
  shear s = { { from.x, from.y, from.z }, 0, 0, 1 / dv[k], { (k + 1) % 3, (k + 2) % 3, k } };
  s.x = dv[s.order[0]] * s.z;
  s.y = dv[s.order[1]] * s.z;
  return s;
}

static bt_vec3
sheared (const shear *s, bt_vec3 p)
{
  double q[3] = { p.x - s->from[0], p.y - s->from[1], p.z - s->from[2] }, z = q[s->order[2]];
  return bt__vec (q[s->order[0]] - s->x * z, q[s->order[1]] - s->y * z, s->z * z);
}

static double
side_of_edge (bt_vec3 p, bt_vec3 q)
{
  return q.x * p.y - q.y * p.x;
}

int
bt__ray_triangle (const bt__triangle *t, bt_vec3 from, bt_vec3 direction, double reach,
                  bt__entry *out)
{
  shear s = shear_of (from, direction);
  bt_vec3 a = sheared (&s, t->v[0]), b = sheared (&s, t->v[1]), c = sheared (&s, t->v[2]);
  double u = side_of_edge (b, c), v = side_of_edge (c, a), w = side_of_edge (a, b), det = u + v + w;
  if (((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) || det == 0)
    return 0;
  double range = (u * a.z + v * b.z + w * c.z) / det;
  if (!(range >= 0 && range <= reach))
    return 0;
  bt_vec3 n = bt__cross (bt__sub (t->v[1], t->v[0]), bt__sub (t->v[2], t->v[0]));
  n = bt__unit_or (n, bt__scale (-1, direction));
  *out = (bt__entry){ range, bt__dot (n, direction) > 0 ? bt__scale (-1, n) : n };
  return 1;
}
