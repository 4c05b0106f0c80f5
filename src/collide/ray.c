/* Rays through the tree over the obstacles, then through those of the meshes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/ray.h"
#include "collide/ray_pair.h"

typedef struct question
{
  const bt__scene *scene;
  const bt__switches *on;
  bt__ray ray;
  uint32_t object;
  bt__entry best;
  int found;
  bt__ray_hit *out;
  bt__count *count;
} question;

static double
take_hit (question *q, const bt__entry *e, uint32_t slot)
{
  bt__ray_hit *h = q->out;
  q->found = 1;
  h->range = e->range;
  h->normal = e->normal;
  h->object = q->object;
  h->slot = h->triangle = slot;
  if (slot != BT__NO_TRIANGLE)
    h->triangle = q->scene->object[q->object].shape.mesh->id[slot];
  return e->range;
}

static double
cast_at_triangle (void *user, uint32_t slot, double reach)
{
  question *q = user;
  bt__triangle t = bt__mesh_triangle (q->scene->object[q->object].shape.mesh, slot);
  bt__entry e;
  q->count->pairs++;
  return bt__ray_triangle (&t, q->ray.from, q->ray.direction, reach, &e) ? take_hit (q, &e, slot)
                                                                         : reach;
}

static double
cast_at_object (question *q, uint32_t object, double reach)
{
  const bt__obstacle *o = q->scene->object + object;
  bt__entry e;
  if (!bt__is_on (q->on, object))
    return reach;
  q->object = object;
  if (o->kind == BT__OBSTACLE_MESH)
    return bt__bvh_ray (&o->shape.mesh->tree, q->ray.from, q->ray.direction, reach,
                        cast_at_triangle, q, q->count);
  q->count->pairs++;
  return bt__ray_obstacle (o, q->ray.from, q->ray.direction, reach, &e)
             ? take_hit (q, &e, BT__NO_TRIANGLE)
             : reach;
}

static double
cast_at_solid (void *user, uint32_t slot, double reach)
{
  question *q = user;
  return cast_at_object (q, q->scene->solid[q->scene->tree.order[slot]], reach);
}

static int
is_ray (const bt__ray *r)
{
  return bt__is_finite (r->from) && bt__is_finite (r->direction) && r->range >= 0
         && isfinite (r->range);
}

static int
ray_at_scene (const bt__scene *s, const bt__switches *on, const bt__ray *ray, bt__ray_hit *out,
              bt__count *count)
{
  question q = { .scene = s, .on = on, .ray = *ray, .out = out, .count = count };
  double reach = ray->range;
  if (s->n == 0)
    {
      count->skipped_empty++;
      return 0;
    }
  if (!is_ray (ray))
    return 0;
  count->links++;
  for (uint32_t i = 0; i < s->planes; i++)
    reach = cast_at_object (&q, s->plane[i], reach);
  bt__bvh_ray (&s->tree, ray->from, ray->direction, reach, cast_at_solid, &q, count);
  if (q.found)
    {
      out->mover = BT__NO_MOVER;
      out->point = bt__axpy (ray->from, out->range, ray->direction);
    }
  return q.found;
}

int
bt__ray_cast (const bt__scene *scene, const bt__switches *on, const bt__mover *mover,
              uint32_t movers, const bt__ray *ray, bt__ray_hit *out, bt__count *count)
{
  bt__ray left = *ray;
  int found = 0;
  if (ray_at_scene (scene, on, ray, out, count))
    {
      found = 1;
      left.range = out->range;
    }
  for (uint32_t m = 0; m < movers; m++)
    {
      bt__frame f = bt__motion_at (&mover[m].motion, mover[m].done);
      bt__ray local = { bt__to_local (&f, left.from), bt__into (&f, left.direction), left.range };
      bt__ray_hit hit;
      if (!ray_at_scene (mover[m].body, mover[m].on, &local, &hit, count))
        continue;
      found = 1;
      left.range = hit.range;
      *out = hit;
      out->mover = m;
      out->normal = bt__out_of (&f, hit.normal);
      out->point = bt__axpy (ray->from, hit.range, ray->direction);
    }
  return found;
}
