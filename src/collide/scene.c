/* Making a scene: obstacles are checked and boxed.  Planes have no box and stand in a list of their
   own, walked by every question.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "collide/scene.h"

void
bt__scene_free (bt__scene *s)
{
  if (!s)
    return;
  for (uint32_t i = 0; s->object && i < s->n; i++)
    if (s->object[i].kind == BT__OBSTACLE_CONVEX)
      bt__hull_free (s->object[i].shape.hull);
    else if (s->object[i].kind == BT__OBSTACLE_MESH)
      bt__mesh_free (s->object[i].shape.mesh);
  bt__bvh_free (&s->tree);
  free (s->object);
  free (s->plane);
  free (s->solid);
  free (s);
}

/* ---- Checks ---- */

static int
is_size (double x)
{
  return x > 0 && isfinite (x);
}

static int
is_unit (bt_vec3 a)
{
  return fabs (bt__norm (a) - 1) < 1e-9;
}

static int
is_frame (const bt__frame *f)
{
  bt_vec3 z = bt__cross (f->x, f->y);
  return bt__is_finite (f->origin) && is_unit (f->x) && is_unit (f->y) && is_unit (f->z)
         && bt__distance (z, f->z) < 1e-9;
}

static int
is_sound (const bt__obstacle *o)
{
  const bt__cylinder *c = &o->shape.cylinder;
  switch (o->kind)
    {
    case BT__OBSTACLE_BOX:
      return is_frame (&o->shape.box.frame) && is_size (o->shape.box.half.x)
             && is_size (o->shape.box.half.y) && is_size (o->shape.box.half.z);
    case BT__OBSTACLE_SPHERE:
      return bt__is_finite (o->shape.sphere.centre) && is_size (o->shape.sphere.radius);
    case BT__OBSTACLE_CYLINDER:
      return bt__is_finite (c->centre) && is_unit (c->axis) && is_size (c->half)
             && is_size (c->radius);
    case BT__OBSTACLE_CAPSULE:
      return bt__is_finite (o->shape.capsule.a) && bt__is_finite (o->shape.capsule.b)
             && o->shape.capsule.radius >= 0 && isfinite (o->shape.capsule.radius);
    case BT__OBSTACLE_PLANE:
      return is_unit (o->shape.plane.normal) && isfinite (o->shape.plane.offset);
    default:
      return o->shape.hull != NULL;
    }
}

/* ---- Boxes ---- */

static bt__aabb
box_about (bt_vec3 centre, bt_vec3 half)
{
  return (bt__aabb){ bt__sub (centre, half), bt__add (centre, half) };
}

static bt__aabb
box_of_points (const bt_vec3 *p, int n, double more)
{
  bt_vec3 lo = p[0], hi = p[0], r = { more, more, more };
  for (int i = 1; i < n; i++)
    {
      lo = bt__vec (fmin (lo.x, p[i].x), fmin (lo.y, p[i].y), fmin (lo.z, p[i].z));
      hi = bt__vec (fmax (hi.x, p[i].x), fmax (hi.y, p[i].y), fmax (hi.z, p[i].z));
    }
  return (bt__aabb){ bt__sub (lo, r), bt__add (hi, r) };
}

static bt__aabb
box_of_box (const bt__box *b)
{
  bt_vec3 x = bt__scale (b->half.x, b->frame.x), y = bt__scale (b->half.y, b->frame.y),
          z = bt__scale (b->half.z, b->frame.z);
  return box_about (b->frame.origin, bt__vec (fabs (x.x) + fabs (y.x) + fabs (z.x),
                                              fabs (x.y) + fabs (y.y) + fabs (z.y),
                                              fabs (x.z) + fabs (y.z) + fabs (z.z)));
}

static double
cylinder_half (const bt__cylinder *c, double along)
{
  return c->half * fabs (along) + c->radius * sqrt (fmax (1 - along * along, 0));
}

bt__aabb
bt__obstacle_box (const bt__obstacle *o)
{
  const bt__cylinder *c = &o->shape.cylinder;
  double r = o->shape.sphere.radius;
  switch (o->kind)
    {
    case BT__OBSTACLE_BOX:
      return box_of_box (&o->shape.box);
    case BT__OBSTACLE_SPHERE:
      return box_about (o->shape.sphere.centre, bt__vec (r, r, r));
    case BT__OBSTACLE_CYLINDER:
      return box_about (c->centre,
                        bt__vec (cylinder_half (c, c->axis.x), cylinder_half (c, c->axis.y),
                                 cylinder_half (c, c->axis.z)));
    case BT__OBSTACLE_CAPSULE:
      return box_of_points ((bt_vec3[]){ o->shape.capsule.a, o->shape.capsule.b }, 2,
                            o->shape.capsule.radius);
    case BT__OBSTACLE_CONVEX:
      return box_of_points (o->shape.hull->v, o->shape.hull->vertices, 0);
    case BT__OBSTACLE_PLANE:
      return box_about (bt__vec (0, 0, 0), bt__vec (INFINITY, INFINITY, INFINITY));
    default:
      return o->shape.mesh->box;
    }
}

/* A little larger than computed, for the rounding of directions.  */
static void
box_of_solid (const void *user, uint32_t i, bt__aabb *box)
{
  const bt__scene *s = user;
  bt__aabb b = bt__obstacle_box (s->object + s->solid[i]);
  double more = 1e-8 * bt__largest (bt__sub (b.hi, b.lo));
  bt_vec3 r = { more, more, more };
  *box = (bt__aabb){ bt__sub (b.lo, r), bt__add (b.hi, r) };
}

/* ---- Making ---- */

static bt_status
allocate_scene (bt__scene *s, uint32_t n, bt_error *error)
{
  size_t some = (size_t)n + 1;
  s->object = malloc (some * sizeof *s->object);
  s->plane = malloc (some * sizeof *s->plane);
  s->solid = malloc (some * sizeof *s->solid);
  if (!s->object || !s->plane || !s->solid)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for %u obstacles", (unsigned)n);
  return bt__bvh_reserve (&s->tree, n, error);
}

bt_status
bt__scene_new (const bt__obstacle *obstacles, uint32_t n, uint64_t serial, bt__scene **out,
               bt_error *error)
{
  for (uint32_t i = 0; i < n; i++)
    if (!is_sound (obstacles + i) || !(obstacles[i].friction >= 0))
      return bt__fail (error, BT_ERR_DOMAIN,
                       "obstacle %u has a size that is not positive, a number that is not finite "
                       "or axes that are not orthonormal",
                       (unsigned)i);
  bt__scene *s = calloc (1, sizeof *s);
  bt_status status = s ? allocate_scene (s, n, error)
                       : bt__fail (error, BT_ERR_LIMIT, "no memory for %u obstacles", (unsigned)n);
  if (status)
    {
      bt__scene_free (s); /* it has no obstacles yet */
      return status;
    }
  s->n = n;
  s->serial = serial;
  for (uint32_t i = 0; i < n; i++)
    {
      s->object[i] = obstacles[i];
      if (obstacles[i].kind == BT__OBSTACLE_PLANE)
        s->plane[s->planes++] = i;
      else
        s->solid[s->solids++] = i;
    }
  bt__bvh_build (&s->tree, s->solids, box_of_solid, s);
  bt__bvh_trim (&s->tree);
  *out = s;
  return BT_OK;
}
