/* The nearest obstacle to a convex body, such as the hull of a vehicle.

   The ball about the body goes through the trees as a link of no length; GJK (gjk.c) measures the
   cores of the parts found.  A core is a shape without its radius: the centre of a sphere, the axis
   of a capsule, a solid box, cylinder, hull or triangle.  The reach shrinks with every nearer part.
   Where body and part overlap the distance is 0 and the normal arbitrary; below a plane the
   distance is negative.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/scene.h"

/* ---- Supports of the cores ---- */

static bt_vec3
farther (bt_vec3 a, bt_vec3 b, bt_vec3 d)
{
  return bt__dot (bt__sub (b, a), d) > 0 ? b : a;
}

bt_vec3
bt__box_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__box *b = shape;
  bt_vec3 q = bt__into (&b->frame, d);
  *hint = (q.x > 0) + 2 * (q.y > 0) + 4 * (q.z > 0);
  return bt__to_world (&b->frame,
                       bt__vec (q.x > 0 ? b->half.x : -b->half.x, q.y > 0 ? b->half.y : -b->half.y,
                                q.z > 0 ? b->half.z : -b->half.z));
}

static bt_vec3
cylinder_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__cylinder *c = shape;
  double z = bt__dot (c->axis, d);
  bt_vec3 level = bt__axpy (d, -z, c->axis), p = c->centre;
  /* A direction along the axis leaves a difference of rounding alone, not across the axis: project
     once more.  */
  level = bt__off_axis (c->axis, level);
  double size = bt__norm (level);
  if (size > 1e-12 * bt__norm (d))
    p = bt__axpy (p, c->radius / size, level);
  *hint = z > 0;
  return bt__axpy (p, z > 0 ? c->half : -c->half, c->axis);
}

bt_vec3
bt__capsule_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__capsule *c = shape;
  (void)hint;
  return farther (c->a, c->b, d);
}

static bt_vec3
point_support (const void *shape, bt_vec3 d, int *hint)
{
  (void)d;
  (void)hint;
  return *(const bt_vec3 *)shape;
}

bt_vec3
bt__triangle_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__triangle *t = shape;
  (void)hint;
  return farther (farther (t->v[0], t->v[1], d), t->v[2], d);
}

bt__convex
bt__obstacle_core (const bt__obstacle *o, double *radius)
{
  *radius = 0;
  switch (o->kind)
    {
    case BT__OBSTACLE_BOX:
      return (bt__convex){ bt__box_support, &o->shape.box };
    case BT__OBSTACLE_SPHERE:
      *radius = o->shape.sphere.radius;
      return (bt__convex){ point_support, &o->shape.sphere.centre };
    case BT__OBSTACLE_CYLINDER:
      return (bt__convex){ cylinder_support, &o->shape.cylinder };
    case BT__OBSTACLE_CAPSULE:
      *radius = o->shape.capsule.radius;
      return (bt__convex){ bt__capsule_support, &o->shape.capsule };
    default:
      return (bt__convex){ bt__hull_support, o->shape.hull };
    }
}

/* ---- The question ---- */

typedef struct question
{
  const bt__scene *scene;
  const bt__switches *on;
  const bt__convex *body;
  bt__link centre;
  double radius;
  uint32_t object;
  int found;
  bt__near *out;
  bt__gap *gap;
  bt__count *count;
} question;

static double
take_gap (question *q, uint32_t slot, const bt__gap *gap, double distance, double reach)
{
  q->count->pairs++;
  if (!(distance + q->radius <= reach))
    return reach;
  bt_vec3 n = bt__unit_or (bt__sub (gap->a, gap->b), bt__vec (0, 0, 1));
  const bt__obstacle *o = q->scene->object + q->object;
  q->found = 1;
  *q->gap = *gap;
  *q->out = (bt__near){ .object = q->object, .slot = slot, .triangle = slot };
  if (slot != BT__NO_TRIANGLE)
    q->out->triangle = o->shape.mesh->id[slot];
  q->out->w = (bt__witness){ distance, 0, bt__axpy (gap->b, gap->distance - distance, n), n, 0 };
  return distance + q->radius;
}

static double
gap_of_triangle (void *user, uint32_t slot, double reach)
{
  question *q = user;
  bt__triangle t = bt__mesh_triangle (q->scene->object[q->object].shape.mesh, slot);
  bt__convex core = { bt__triangle_support, &t };
  bt__gap gap;
  bt__gjk (q->body, &core, &gap);
  return take_gap (q, slot, &gap, gap.distance, reach);
}

static double
visit_plane (question *q, const bt__plane *plane, double reach)
{
  bt__gap gap = { 0 };
  gap.a = q->body->support (q->body->shape, bt__scale (-1, plane->normal), gap.hint);
  gap.distance = bt__dot (plane->normal, gap.a) - plane->offset;
  gap.b = bt__axpy (gap.a, -gap.distance, plane->normal);
  double before = reach, after = take_gap (q, BT__NO_TRIANGLE, &gap, gap.distance, reach);
  if (after < before)
    q->out->w.normal = plane->normal;
  return after;
}

static double
gap_of_object (question *q, uint32_t object, double reach)
{
  const bt__obstacle *o = q->scene->object + object;
  if (!bt__is_on (q->on, object))
    return reach;
  q->object = object;
  if (o->kind == BT__OBSTACLE_PLANE)
    return visit_plane (q, &o->shape.plane, reach);
  if (o->kind == BT__OBSTACLE_MESH)
    return bt__bvh_query (&o->shape.mesh->tree, &q->centre, reach, 1, gap_of_triangle, q, q->count);
  bt__gap gap;
  double radius;
  bt__convex core = bt__obstacle_core (o, &radius);
  bt__gjk (q->body, &core, &gap);
  return take_gap (q, BT__NO_TRIANGLE, &gap, fmax (gap.distance - radius, 0), reach);
}

static double
gap_of_solid (void *user, uint32_t slot, double reach)
{
  question *q = user;
  return gap_of_object (q, q->scene->solid[q->scene->tree.order[slot]], reach);
}

int
bt__scene_nearest_to_body (const bt__scene *scene, const bt__switches *on, const bt__convex *body,
                           bt_vec3 centre, double radius, double cap, bt__near *out, bt__gap *gap,
                           bt__count *count)
{
  question q = { scene, on, body, { centre, centre }, radius, 0, 0, out, gap, count };
  double reach = cap + radius;
  if (scene->n == 0)
    {
      count->skipped_empty++;
      return 0;
    }
  count->links++;
  for (uint32_t i = 0; i < scene->planes; i++)
    reach = gap_of_object (&q, scene->plane[i], reach);
  bt__bvh_query (&scene->tree, &q.centre, reach, 1, gap_of_solid, &q, count);
  return q.found;
}
