/* The collision point (thesis 3.4): the average of the points in which a link meets the obstacle's
   surface, and of the normals in these points.  The break point is moved out along the mean normal
   by the largest distance to the planes of the surface plus sqrt (2) radii.

   The thesis takes the link inside the obstacle.  In this program no link is ever inside, so a copy
   of the stopped link is pressed in a little and measured.  Solids have a smooth surface in place
   of triangles.  If a link meets no face, on a rim or lying flat, the nearest point and its normal
   replace the averages.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/thesis_job.h"

enum
{
  SEARCH = 60, /* thirds of an interval: 3e-11 of the link */
  BISECT = 50
};

#define ROOT2 1.41421356237309504880
#define SIDEWAYS 0.1 /* a direction has no less along the way than this */
#define ASIDE 0.5    /* cosine: a mean normal farther from the nearest point's is no help */

int
bt__meets_triangle (const bt__link *link, const bt__triangle *triangle, double *t)
{
  bt_vec3 u = bt__sub (link->b, link->a);
  bt_vec3 s21 = bt__sub (triangle->v[1], triangle->v[0]);
  bt_vec3 s32 = bt__sub (triangle->v[2], triangle->v[1]);
  bt_vec3 n = bt__cross (s21, s32);
  double un = bt__dot (u, n), nn = bt__dot (n, n);
  if (un == 0 || nn == 0)
    return 0;
  *t = bt__dot (n, bt__sub (triangle->v[0], link->a)) / un;
  bt_vec3 p = bt__sub (bt__axpy (link->a, *t, u), triangle->v[0]);
  /* P = alpha s21 + beta s32 is inside for 0 <= beta <= alpha <= 1.  */
  double alpha = bt__dot (bt__cross (p, s32), n) / nn, beta = bt__dot (bt__cross (s21, p), n) / nn;
  return *t >= 0 && *t <= 1 && beta >= 0 && beta <= alpha && alpha <= 1;
}

/* ---- Where a link meets a surface ---- */

typedef struct sum
{
  int n;
  bt_vec3 point, normal;
  bt_vec3 at[BT__PARTS_MAX], plane[BT__PARTS_MAX];
} sum;

static void
add (sum *s, bt_vec3 point, bt_vec3 normal)
{
  if (s->n == BT__PARTS_MAX)
    return;
  s->at[s->n] = point;
  s->plane[s->n++] = normal;
  s->point = bt__add (s->point, point);
  s->normal = bt__add (s->normal, normal);
}

static double
height_over (const bt__obstacle *o, const bt__link *link, double t, bt__witness *w)
{
  bt_vec3 p = bt__along (link, t);
  bt__link point = { p, p };
  bt__obstacle_pair (o, &point, w);
  return w->distance;
}

/* The deepest place: the depth of a convex body along a line has one least.  */
static double
deepest (const bt__obstacle *o, const bt__link *link)
{
  bt__witness w;
  double lo = 0, hi = 1;
  for (int i = 0; i < SEARCH; i++)
    {
      double p = lo + (hi - lo) / 3, q = hi - (hi - lo) / 3;
      if (height_over (o, link, p, &w) <= height_over (o, link, q, &w))
        hi = q;
      else
        lo = p;
    }
  return (lo + hi) / 2;
}

/* The surface between IN, inside, and OUT, outside.  */
static void
cross_surface (sum *s, const bt__obstacle *o, const bt__link *link, double in, double out)
{
  bt__witness w;
  if (height_over (o, link, out, &w) <= 0)
    return;
  for (int i = 0; i < BISECT; i++)
    {
      double mid = (in + out) / 2;
      if (height_over (o, link, mid, &w) > 0)
        out = mid;
      else
        in = mid;
    }
  height_over (o, link, out, &w);
  add (s, bt__along (link, out), w.normal);
}

static void
meet_solid (sum *s, const bt__obstacle *o, const bt__link *link)
{
  bt__witness w;
  double in = deepest (o, link);
  if (height_over (o, link, in, &w) >= 0)
    return;
  cross_surface (s, o, link, in, 0);
  cross_surface (s, o, link, in, 1);
}

/* Add every triangle of MESH pierced by LINK, with its normal turned to the side of OUT.  */
static void
meet_mesh (sum *s, const bt__mesh *mesh, uint32_t object, const bt__nears *list,
           const bt__link *link, bt_vec3 out)
{
  for (uint32_t i = 0; i < list->n; i++)
    {
      double t;
      if (list->at[i].object != object)
        continue;
      bt__triangle k = bt__mesh_triangle (mesh, list->at[i].slot);
      if (!bt__meets_triangle (link, &k, &t))
        continue;
      bt_vec3 n = bt__cross (bt__sub (k.v[1], k.v[0]), bt__sub (k.v[2], k.v[0]));
      n = bt__unit_or (bt__dot (n, out) < 0 ? bt__scale (-1, n) : n, out);
      add (s, bt__along (link, t), n);
    }
}

/* ---- The average ---- */

static double
farthest_plane (const sum *s, bt_vec3 p)
{
  double most = 0;
  for (int i = 0; i < s->n; i++)
    most = fmax (most, fabs (bt__dot (s->plane[i], bt__sub (p, s->at[i]))));
  return most;
}

void
bt__collision_point (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                     const bt__near *near, double depth, double radius, bt__near *parts,
                     bt__collision *out, bt__count *count)
{
  const bt__obstacle *o = scene->object + near->object;
  bt_vec3 push = bt__scale (-(near->w.distance + depth), near->w.normal);
  bt__link pressed = { bt__add (link->a, push), bt__add (link->b, push) };
  bt__nears list = { parts, 0, BT__PARTS_MAX, INFINITY };
  sum s = { 0 };
  if (o->kind == BT__OBSTACLE_MESH)
    {
      bt__scene_near (scene, on, &pressed, 0, 1e-9, &list, count);
      meet_mesh (&s, o->shape.mesh, near->object, &list, &pressed, near->w.normal);
    }
  else
    meet_solid (&s, o, &pressed);
  bt_vec3 mean = bt__unit_or (s.normal, bt__vec (0, 0, 0));
  if (s.n == 0 || bt__dot (mean, near->w.normal) < ASIDE)
    {
      *out = (bt__collision){ near->w.point, near->w.normal, near->w.point, 0 };
      out->point = bt__axpy (near->w.point, ROOT2 * radius, near->w.normal);
      return;
    }
  out->contact = bt__scale (1.0 / s.n, s.point);
  out->normal = mean;
  out->intersections = s.n;
  double shift = farthest_plane (&s, out->contact) + ROOT2 * radius;
  out->point = bt__axpy (out->contact, shift, mean);
}

/* The angle by which D rises over the plane across NORMAL, in the plane of NORMAL and the tether's
   direction T: motion to the side, down a pile or along an edge, is no opening.  */
static double
opening_angle (bt_vec3 d, bt_vec3 t, bt_vec3 normal)
{
  return atan2 (bt__dot (d, normal), fmax (fabs (bt__dot (d, t)), SIDEWAYS));
}

double
bt__split_angle (bt_vec3 d, bt_vec3 e, bt_vec3 normal)
{
  bt_vec3 way = bt__sub (e, d);
  way = bt__off_axis (normal, way);
  bt_vec3 t = bt__unit_or (way, bt__across (normal));
  return BT__PI + opening_angle (d, t, normal) + opening_angle (e, t, normal);
}
