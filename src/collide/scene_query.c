/* A link's questions: the tree over the obstacles, then the tree over a mesh's triangles.

   bt__scene_near lists all parts within a reach, bt__scene_nearest finds the nearest part,
   bt__scene_within ends at the first.  All walk the planes, then the tree of the scene; a mesh
   found there is asked for its triangles through the mesh's own tree.  The closest points come from
   the closed forms of pair.h.

   Lists have a fixed room.  A full list keeps the nearest parts and notes the least distance of the
   dropped parts: nearer than this distance the list is complete.  Before a triangle is measured
   exactly, the three coordinates are compared: most triangles of a leaf lie beyond the reach along
   one axis.

   bt__scene_apart is the coarse question, asked once for a whole line: a lower bound on the
   distance from a box to anything in the scene, in the time of one box and the planes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/scene.h"

void
bt__obstacle_pair (const bt__obstacle *o, const bt__link *link, bt__witness *out)
{
  switch (o->kind)
    {
    case BT__OBSTACLE_BOX:
      bt__pair_box (&o->shape.box, link, out);
      break;
    case BT__OBSTACLE_SPHERE:
      bt__pair_sphere (&o->shape.sphere, link, out);
      break;
    case BT__OBSTACLE_CYLINDER:
      bt__pair_cylinder (&o->shape.cylinder, link, out);
      break;
    case BT__OBSTACLE_CAPSULE:
      bt__pair_capsule (&o->shape.capsule, link, out);
      break;
    case BT__OBSTACLE_PLANE:
      bt__pair_plane (&o->shape.plane, link, out);
      break;
    default:
      bt__pair_hull (o->shape.hull, link, out);
    }
}

void
bt__scene_pair (const bt__scene *s, const bt__near *near, const bt__link *link, bt__witness *out)
{
  const bt__obstacle *o = s->object + near->object;
  if (near->slot == BT__NO_TRIANGLE)
    bt__obstacle_pair (o, link, out);
  else
    {
      bt__triangle t = bt__mesh_triangle (o->shape.mesh, near->slot);
      bt__pair_triangle (&t, link, out);
    }
}

/* True if P and Q are both farther than REACH on one side of all of A, B, C.  */
static inline int
is_beyond (double a, double b, double c, double p, double q, double reach)
{
  double lo = a < b ? a : b, hi = a < b ? b : a;
  lo = (c < lo ? c : lo) - reach;
  hi = (c > hi ? c : hi) + reach;
  return (p < lo && q < lo) || (p > hi && q > hi);
}

/* True if LINK is within REACH of T, to *OUT; else *OUT may be as it was.  */
static inline int
triangle_within (const bt__triangle *t, const bt__link *link, double reach, bt__witness *out,
                 bt__count *count)
{
  const bt_vec3 *v = t->v, a = link->a, b = link->b;
  if (is_beyond (v[0].x, v[1].x, v[2].x, a.x, b.x, reach)
      || is_beyond (v[0].y, v[1].y, v[2].y, a.y, b.y, reach)
      || is_beyond (v[0].z, v[1].z, v[2].z, a.z, b.z, reach))
    return 0;
  count->pairs++;
  bt__pair_triangle (t, link, out);
  return out->distance <= reach;
}

int
bt__scene_pair_within (const bt__scene *s, const bt__near *near, const bt__link *link, double reach,
                       bt__witness *out, bt__count *count)
{
  const bt__obstacle *o = s->object + near->object;
  if (near->slot != BT__NO_TRIANGLE)
    {
      bt__triangle t = bt__mesh_triangle (o->shape.mesh, near->slot);
      return triangle_within (&t, link, reach, out, count);
    }
  count->pairs++;
  bt__obstacle_pair (o, link, out);
  return out->distance <= reach;
}

/* ---- Lists ---- */

static uint32_t
farthest (const bt__nears *list)
{
  uint32_t far = 0;
  for (uint32_t i = 1; i < list->n; i++)
    if (list->at[i].w.distance > list->at[far].w.distance)
      far = i;
  return far;
}

static void
keep_nearest (bt__nears *list, const bt__near *near)
{
  if (list->n < list->room)
    {
      list->at[list->n++] = *near;
      return;
    }
  uint32_t far = list->n ? farthest (list) : 0;
  double out = near->w.distance;
  if (list->n && list->at[far].w.distance > out)
    {
      out = list->at[far].w.distance;
      list->at[far] = *near;
    }
  list->dropped = fmin (list->dropped, out);
}

typedef int (*before) (const bt__near *x, const bt__near *y);

static int
nearer (const bt__near *x, const bt__near *y)
{
  return x->w.distance != y->w.distance ? x->w.distance < y->w.distance : x->object < y->object;
}

static int
nearer_of_object (const bt__near *x, const bt__near *y)
{
  return x->object != y->object ? x->object < y->object : nearer (x, y);
}

static void
sift (bt__near *at, uint32_t top, uint32_t n, before is_before)
{
  bt__near held = at[top];
  for (uint32_t child = 2 * top + 1; child < n; child = 2 * top + 1)
    {
      if (child + 1 < n && is_before (at + child, at + child + 1))
        child++;
      if (!is_before (&held, at + child))
        break;
      at[top] = at[child];
      top = child;
    }
  at[top] = held;
}

/* Heap sort: qsort of the C library may allocate.  */
static void
sort (bt__near *at, uint32_t n, before is_before)
{
  for (uint32_t i = n / 2; i > 0; i--)
    sift (at, i - 1, n, is_before);
  for (uint32_t last = n; last > 1; last--)
    {
      bt__near swap = at[0];
      at[0] = at[last - 1];
      at[last - 1] = swap;
      sift (at, 0, last - 1, is_before);
    }
}

void
bt__nears_by_object (bt__nears *list)
{
  uint32_t n = 0;
  sort (list->at, list->n, nearer_of_object);
  for (uint32_t i = 0; i < list->n; i++)
    if (n == 0 || list->at[i].object != list->at[n - 1].object)
      list->at[n++] = list->at[i];
  list->n = n;
  sort (list->at, n, nearer);
}

/* ---- All of it ---- */

static double
gap_between (double lo, double hi, double centre, double half)
{
  return fmax (lo - (centre + half), centre - half - hi);
}

double
bt__scene_apart (const bt__scene *scene, const bt__aabb *box)
{
  bt_vec3 lo = box->lo, hi = box->hi, o = scene->tree.origin;
  bt_vec3 middle = bt__scale (0.5, bt__add (lo, hi)), reach = bt__scale (0.5, bt__sub (hi, lo));
  double half = 0.5000001 * scene->tree.extent + 1e-15 * bt__largest (o), gap = INFINITY;
  if (scene->solids > 0)
    gap = fmax (gap_between (lo.x, hi.x, o.x, half),
                fmax (gap_between (lo.y, hi.y, o.y, half), gap_between (lo.z, hi.z, o.z, half)));
  for (uint32_t i = 0; i < scene->planes; i++)
    {
      const bt__plane *p = &scene->object[scene->plane[i]].shape.plane;
      bt_vec3 n = p->normal;
      gap = fmin (gap, bt__dot (n, middle) - p->offset - fabs (n.x) * reach.x - fabs (n.y) * reach.y
                           - fabs (n.z) * reach.z);
    }
  return gap;
}

/* ---- One link ---- */

typedef struct question
{
  const bt__scene *scene;
  const bt__switches *on;
  const bt__link *link;
  bt__nears *list; /* or NULL: the nearest only, in BEST */
  bt__near best, now;
  int found, any; /* any: whether a part is within reach is all that is asked */
  bt__count *count;
} question;

/* The reach after a part was found of which nothing but that is asked.  */
static double
end_search (question *q)
{
  q->found = 1;
  return -INFINITY;
}

/* Take NOW, a measured pair, if it is within REACH; return the reach from now on.  */
static double
take_pair (question *q, double reach)
{
  if (!(q->now.w.distance <= reach))
    return reach;
  if (q->any)
    return end_search (q);
  if (q->list)
    {
      keep_nearest (q->list, &q->now);
      return reach;
    }
  q->best = q->now;
  q->found = 1;
  return q->now.w.distance;
}

static double
measure_triangle (void *user, uint32_t slot, double reach)
{
  question *q = user;
  const bt__mesh *m = q->scene->object[q->now.object].shape.mesh;
  bt__triangle t = bt__mesh_triangle (m, slot);
  if (!triangle_within (&t, q->link, reach, &q->now.w, q->count))
    return reach;
  q->now.slot = slot;
  q->now.triangle = m->id[slot];
  return take_pair (q, reach);
}

static double
measure_object (question *q, uint32_t object, double reach)
{
  const bt__obstacle *o = q->scene->object + object;
  if (!bt__is_on (q->on, object))
    return reach;
  q->now.object = object;
  q->now.slot = q->now.triangle = BT__NO_TRIANGLE;
  if (o->kind == BT__OBSTACLE_MESH)
    return bt__bvh_query (&o->shape.mesh->tree, q->link, reach, !q->list, measure_triangle, q,
                          q->count);
  q->count->pairs++;
  if (q->any && o->kind == BT__OBSTACLE_CYLINDER)
    return bt__cylinder_within (&o->shape.cylinder, q->link, reach) ? end_search (q) : reach;
  bt__obstacle_pair (o, q->link, &q->now.w);
  return take_pair (q, reach);
}

static double
measure_solid (void *user, uint32_t slot, double reach)
{
  question *q = user;
  return measure_object (q, q->scene->solid[q->scene->tree.order[slot]], reach);
}

static void
ask_tree (question *q, double reach)
{
  const bt__scene *s = q->scene;
  if (s->n == 0)
    {
      q->count->skipped_empty++;
      return;
    }
  q->count->links++;
  for (uint32_t i = 0; i < s->planes; i++)
    reach = measure_object (q, s->plane[i], reach);
  bt__bvh_query (&s->tree, q->link, reach, !q->list, measure_solid, q, q->count);
}

void
bt__scene_near (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                uint32_t number, double reach, bt__nears *list, bt__count *count)
{
  question q = {
    .scene = scene, .on = on, .link = link, .list = list, .now.link = number, .count = count
  };
  ask_tree (&q, reach);
}

void
bt__scene_near_line (const bt__scene *scene, const bt__switches *on, const bt_vec3 *p, uint32_t n,
                     double reach, bt__nears *list, bt__count *count)
{
  list->n = 0;
  list->dropped = INFINITY;
  if (scene->n == 0)
    {
      count->skipped_empty++;
      return;
    }
  for (uint32_t i = 0; i + 1 < n; i++)
    {
      bt__link link = { p[i], p[i + 1] };
      bt__scene_near (scene, on, &link, i, reach, list, count);
    }
}

int
bt__scene_nearest (const bt__scene *scene, const bt__switches *on, const bt__link *link, double cap,
                   bt__near *out, bt__count *count)
{
  question q = { .scene = scene, .on = on, .link = link, .count = count };
  ask_tree (&q, cap);
  if (q.found)
    *out = q.best;
  return q.found;
}

int
bt__scene_within (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                  double reach, bt__count *count)
{
  question q = { .scene = scene, .on = on, .link = link, .any = 1, .count = count };
  ask_tree (&q, reach);
  return q.found;
}
