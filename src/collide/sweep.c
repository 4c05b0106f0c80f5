/* How far a body may go through a scene.

   The ball about the body, swept along the path, is asked of the trees; each convex part found is
   chased (sweep_chase.c), and the least share of all parts counts.  The body may go on from a
   touch: sweep_chase.c permits motion along and away from a surface.

   A kinematic obstacle is asked in its own frame at the start, with the reach of both motions
   together.  The shares of body and obstacle are cut by the same factor, obstacle by obstacle,
   until a pass cuts nothing; after 20 passes that cut, body and obstacles stand still: not to move
   is safe.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "collide/sweep_job.h"

enum
{
  SWEEPS_MAX = 20
};

static const bt__frame world = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };

/* ---- Bodies ---- */

static bt_vec3
origin_support (const void *shape, bt_vec3 d, int *hint)
{
  (void)shape;
  (void)d;
  *hint = 0;
  return bt__vec (0, 0, 0);
}

bt__body
bt__body_box (const bt__box *b, double round)
{
  double radius = bt__norm (b->frame.origin) + bt__norm (b->half) + round;
  return (bt__body){ { bt__box_support, b }, round, radius * (1 + 1e-12) };
}

bt__body
bt__body_ball (double radius)
{
  return (bt__body){ { origin_support, NULL }, radius, radius };
}

/* ---- One scene ---- */

typedef struct sweep
{
  bt__chase chase;
  const bt__scene *scene;
  const bt__switches *on;
  bt__link path; /* of the body's origin, in the scene's frame */
  double reach;
  uint32_t object, mover;
  double best;
  bt__stop *stop;
  bt__count *count;
} sweep;

static void
chase_part (sweep *s, uint32_t slot)
{
  bt__apart apart;
  double t = bt__chase_run (&s->chase, s->best, &apart, s->count);
  s->count->pairs++;
  if (!(t < s->best))
    return;
  s->best = t;
  *s->stop
      = (bt__stop){ s->mover, s->object, slot, slot, apart.distance, apart.point, apart.normal };
  if (slot != BT__NO_TRIANGLE)
    s->stop->triangle = s->scene->object[s->object].shape.mesh->id[slot];
}

static double
sweep_triangle (void *user, uint32_t slot, double reach)
{
  sweep *s = user;
  bt__triangle t = bt__mesh_triangle (s->scene->object[s->object].shape.mesh, slot);
  s->chase.part.core = (bt__convex){ bt__triangle_support, &t };
  s->chase.part.round = 0;
  chase_part (s, slot);
  return reach;
}

static void
sweep_object (sweep *s, uint32_t object)
{
  const bt__obstacle *o = s->scene->object + object;
  if (!bt__is_on (s->on, object))
    return;
  s->object = object;
  s->chase.plane = o->kind == BT__OBSTACLE_PLANE ? &o->shape.plane : NULL;
  if (o->kind == BT__OBSTACLE_MESH)
    {
      bt__bvh_query (&o->shape.mesh->tree, &s->path, s->reach, 0, sweep_triangle, s, s->count);
      return;
    }
  if (!s->chase.plane)
    s->chase.part.core = bt__obstacle_core (o, &s->chase.part.round);
  chase_part (s, BT__NO_TRIANGLE);
}

static double
sweep_solid (void *user, uint32_t slot, double reach)
{
  sweep *s = user;
  sweep_object (s, s->scene->solid[s->scene->tree.order[slot]]);
  return reach;
}

static double
run_sweep (sweep *s)
{
  s->best = 1;
  if (s->scene->n == 0)
    {
      s->count->skipped_empty++;
      return 1;
    }
  s->count->links++;
  for (uint32_t i = 0; i < s->scene->planes; i++)
    sweep_object (s, s->scene->plane[i]);
  bt__bvh_query (&s->scene->tree, &s->path, s->reach, 0, sweep_solid, s, s->count);
  return s->best;
}

static bt__flier
flier_of (const bt__body *body, const bt__motion *motion)
{
  return (bt__flier){ body->core, body->round, body->radius, *motion };
}

static double
sweep_static (const bt__body *body, const bt__motion *motion, double gap, const bt__scene *scene,
              const bt__switches *on, bt__stop *stop, bt__count *count)
{
  bt_vec3 from = motion->from.origin;
  sweep s = { .scene = scene,
              .on = on,
              .path = { from, bt__add (from, motion->travel) },
              .reach = (body->radius + gap) * (1 + 1e-5),
              .mover = UINT32_MAX,
              .stop = stop,
              .count = count };
  s.chase = (bt__chase){ .body = flier_of (body, motion),
                         .part.motion = { .from = world, .axis = { 0, 0, 1 } },
                         .gap = gap };
  return run_sweep (&s);
}

/* Sweep BODY against kinematic obstacle M, in the frame of M at the start.  Parts farther away than
   both motions together are not met.  */
static double
sweep_mover (const bt__body *body, const bt__motion *motion, double gap, const bt__mover *m,
             uint32_t number, bt__stop *stop, bt__count *count)
{
  bt__motion own = bt__motion_cut (&m->motion, m->done);
  bt_vec3 at = bt__to_local (&own.from, motion->from.origin);
  double far = bt__norm (motion->travel) + bt__norm (own.travel) + fabs (own.angle) * m->radius;
  sweep s = { .scene = m->body,
              .on = m->on,
              .path = { at, at },
              .reach = (body->radius + gap + far) * (1 + 1e-5),
              .mover = number,
              .stop = stop,
              .count = count };
  s.chase = (bt__chase){ .body = flier_of (body, motion),
                         .part = { .radius = m->radius, .motion = own },
                         .gap = gap };
  return run_sweep (&s);
}

static int
is_motion (const bt__motion *m)
{
  return bt__is_finite (m->from.origin) && isfinite (bt__norm (m->travel)) && isfinite (m->angle);
}

double
bt__body_sweep (const bt__body *body, const bt__motion *motion, double gap, const bt__scene *scene,
                const bt__switches *on, bt__mover *mover, uint32_t movers, bt__stop *stop,
                bt__count *count)
{
  bt__stop none;
  stop = stop ? stop : &none;
  *stop = (bt__stop){ UINT32_MAX, UINT32_MAX,  BT__NO_TRIANGLE, BT__NO_TRIANGLE,
                      INFINITY,   { 0, 0, 0 }, { 0, 0, 0 } };
  if (!is_motion (motion))
    return 0;
  double share = sweep_static (body, motion, gap, scene, on, stop, count);
  int cut = movers > 0;
  for (int i = 0; cut && i < SWEEPS_MAX; i++)
    {
      cut = 0;
      for (uint32_t m = 0; m < movers; m++)
        {
          bt__motion now = bt__motion_cut (motion, share);
          double t = sweep_mover (body, &now, gap, mover + m, m, stop, count);
          if (t >= 1)
            continue;
          cut = 1;
          share *= t;
          mover[m].done *= t;
        }
    }
  if (!cut)
    return share;
  for (uint32_t m = 0; m < movers; m++)
    mover[m].done = 0;
  return 0;
}

/* ---- Standing ---- */

static void
keep_nearer (const bt__near *near, const bt__frame *f, double round, uint32_t mover, bt__stop *stop)
{
  bt_vec3 point = bt__to_world (f, near->w.point), normal = bt__out_of (f, near->w.normal);
  double distance = fmax (near->w.distance - round, 0);
  *stop = (bt__stop){ mover, near->object, near->slot, near->triangle, distance, point, normal };
}

/* Ask SCENE, standing at AT, of the body at FRAME.  */
static int
nearest_stop (const bt__body *body, const bt__frame *frame, double cap, const bt__scene *scene,
              const bt__switches *on, const bt__frame *at, uint32_t mover, bt__stop *stop,
              bt__count *count)
{
  bt__placed placed = { &body->core,
                        { bt__to_local (at, frame->origin), bt__into (at, frame->x),
                          bt__into (at, frame->y), bt__into (at, frame->z) } };
  bt__convex core = { bt__placed_support, &placed };
  bt__near near;
  bt__gap gap;
  if (!bt__scene_nearest_to_body (scene, on, &core, placed.frame.origin, body->radius,
                                  cap + body->round, &near, &gap, count))
    return 0;
  keep_nearer (&near, at, body->round, mover, stop);
  return 1;
}

int
bt__body_nearest (const bt__body *body, const bt__frame *frame, double cap, const bt__scene *scene,
                  const bt__switches *on, const bt__mover *mover, uint32_t movers, bt__stop *stop,
                  bt__count *count)
{
  int found = nearest_stop (body, frame, cap, scene, on, &world, UINT32_MAX, stop, count);
  for (uint32_t m = 0; m < movers; m++)
    {
      bt__frame at = bt__motion_at (&mover[m].motion, mover[m].done);
      cap = found ? fmin (cap, stop->distance) : cap;
      found |= nearest_stop (body, frame, cap, mover[m].body, mover[m].on, &at, m, stop, count);
    }
  return found;
}
