/* From obstacles to a graph.

   Every member is sampled for its stretches in the ground, every pair of members for the places
   where the two meet.  Samples and meetings give points on a member.  Points of one joint are
   united; a stretch of member in the water between neighbouring points is an edge.  Where a member
   enters the ground, an edge leads on straight down past everything, and where a member leaves the
   water, straight up, so that no horizontal shadow ends at a bed, sloping or not.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aware/graph_job.h"
#include "base/error.h"

enum
{
  SAMPLES = 64 /* of a member in the ground, at most */
};

static int
is_member (const bt__obstacle *o)
{
  return o->kind == BT__OBSTACLE_CAPSULE || o->kind == BT__OBSTACLE_CYLINDER;
}

static int
is_ground (const bt__graph_job *k, uint32_t i)
{
  return k->scene->object[i].kind == BT__OBSTACLE_PLANE || (k->c->ground && k->c->ground[i]);
}

static int
counts (const bt__graph_job *k, uint32_t i)
{
  return bt__is_on (k->c->on, i) && !is_ground (k, i);
}

static bt__capsule
member_axis (const bt__obstacle *o)
{
  if (o->kind == BT__OBSTACLE_CAPSULE)
    return o->shape.capsule;
  const bt__cylinder *c = &o->shape.cylinder;
  return (bt__capsule){ bt__axpy (c->centre, -c->half, c->axis),
                        bt__axpy (c->centre, c->half, c->axis), c->radius };
}

/* ---- Points ---- */

static uint32_t
add_point (bt__graph_job *k, uint32_t member, double s, bt_vec3 at, double radius)
{
  if (k->n == k->room)
    {
      uint32_t room = k->room ? 2 * k->room : 256;
      bt__point *p = realloc (k->p, room * sizeof *p);
      if (!p)
        {
          k->failed = 1;
          return 0;
        }
      k->p = p;
      k->room = room;
    }
  k->p[k->n] = (bt__point){ .at = at, .s = s, .radius = radius, .member = member, .joint = k->n };
  return k->n++;
}

uint32_t
bt__joint_of (const bt__graph_job *k, uint32_t i)
{
  while (k->p[i].joint != i)
    i = k->p[i].joint;
  return i;
}

void
bt__unite (bt__graph_job *k, uint32_t a, uint32_t b)
{
  a = bt__joint_of (k, a);
  b = bt__joint_of (k, b);
  if (a < b)
    k->p[b].joint = a;
  else
    k->p[a].joint = b;
}

/* ---- Ground ---- */

static uint8_t
medium (bt__graph_job *k, bt_vec3 p, double radius)
{
  bt__switches ground = { k->off, 0 };
  bt__link link = { p, p };
  if (bt__scene_within (k->scene, &ground, &link, radius + k->c->gap, &k->count))
    return BT__GROUND;
  if (k->c->depth > 0 && p.z <= -k->c->depth)
    return BT__GROUND;
  ground.off = k->solid;
  if (k->undescribed > 0
      && bt__scene_within (k->scene, &ground, &link, radius + k->c->gap, &k->count))
    return BT__MESH;
  return p.z >= k->c->surface ? BT__AIR : BT__WATER;
}

/* The share between A and B where the medium stops being that at A.  */
static double
shore (bt__graph_job *k, const bt__capsule *m, double a, double b, uint8_t at_a)
{
  for (int i = 0; i < 30; i++)
    {
      double middle = 0.5 * (a + b);
      if (medium (k, bt__axpy (m->a, middle, bt__sub (m->b, m->a)), m->radius) == at_a)
        a = middle;
      else
        b = middle;
    }
  return 0.5 * (a + b);
}

/* Add a point of member I at its shore, share S of the member's length, moved along the member by
   WAY (1 or -1) well out of the water.  */
static void
add_shore (bt__graph_job *k, uint32_t i, const bt__capsule *m, double s, int way, uint8_t what)
{
  bt_vec3 d = bt__sub (m->b, m->a), p = bt__axpy (m->a, s, d);
  double in = 2 * m->radius + k->c->gap + 0.2;
  uint32_t at = add_point (k, i, s, bt__axpy (p, way * in, bt__unit_or (d, d)), m->radius);
  k->p[at].boundary = what;
  k->p[at].dry = way > 0;
}

/* Add the ends of member I and its crossings of ground and surface.  */
static void
add_member (bt__graph_job *k, uint32_t i)
{
  bt__capsule m = member_axis (k->scene->object + i);
  bt_vec3 d = bt__sub (m.b, m.a);
  int samples = (int)fmin (SAMPLES, 2 + ceil (bt__norm (d) / 0.5));
  uint8_t before = medium (k, m.a, m.radius);
  uint32_t end = add_point (k, i, 0, m.a, m.radius);
  k->p[end].dry = before != BT__WATER;
  for (int j = 1; j <= samples && !k->failed; j++)
    {
      double s = (double)j / samples;
      uint8_t now = medium (k, bt__axpy (m.a, s, d), m.radius);
      if ((now == BT__WATER) != (before == BT__WATER))
        add_shore (k, i, &m, shore (k, &m, (j - 1.0) / samples, s, before),
                   now == BT__WATER ? -1 : 1, now == BT__WATER ? before : now);
      before = now;
    }
  add_point (k, i, 1, m.b, m.radius);
}

/* ---- Where members meet ---- */

/* A point of member I at share S, in the water or not as its stretch is.  */
static uint32_t
add_meeting (bt__graph_job *k, uint32_t i, const bt__capsule *m, double s)
{
  return add_point (k, i, s, bt__axpy (m->a, s, bt__sub (m->b, m->a)), m->radius);
}

static void
join_members (bt__graph_job *k, uint32_t i, uint32_t j)
{
  bt__capsule a = member_axis (k->scene->object + i), b = member_axis (k->scene->object + j);
  bt_vec3 d = bt__sub (a.b, a.a), e = bt__sub (b.b, b.a);
  double s, t;
  bt__closest_segments (bt__sub (a.a, b.a), d, e, &s, &t);
  bt_vec3 p = bt__axpy (a.a, s, d), q = bt__axpy (b.a, t, e);
  if (bt__distance (p, q) > a.radius + b.radius + k->c->gap)
    return;
  uint32_t one = add_meeting (k, i, &a, s), other = add_meeting (k, j, &b, t);
  if (!k->failed)
    bt__unite (k, one, other);
}

static bt_vec3
obstacle_middle (const bt__obstacle *o)
{
  bt_vec3 sum = bt__vec (0, 0, 0);
  if (o->kind == BT__OBSTACLE_BOX)
    return o->shape.box.frame.origin;
  if (o->kind == BT__OBSTACLE_SPHERE)
    return o->shape.sphere.centre;
  for (int i = 0; i < o->shape.hull->vertices; i++)
    sum = bt__add (sum, o->shape.hull->v[i]);
  return bt__scale (1.0 / o->shape.hull->vertices, sum);
}

/* The I-th point that stands for the surface of O, a box or a hull.  */
static bt_vec3
corner_of (const bt__obstacle *o, int i)
{
  const bt__box *b = &o->shape.box;
  if (o->kind != BT__OBSTACLE_BOX)
    return o->shape.hull->v[i];
  return bt__to_world (&b->frame,
                       bt__vec (i & 1 ? b->half.x : -b->half.x, i & 2 ? b->half.y : -b->half.y,
                                i & 4 ? b->half.z : -b->half.z));
}

/* What joint O reaches into: a bit for each medium.  */
static unsigned
reaches_into (bt__graph_job *k, const bt__obstacle *o)
{
  int corners = o->kind == BT__OBSTACLE_BOX      ? 8
                : o->kind == BT__OBSTACLE_CONVEX ? o->shape.hull->vertices
                                                 : 0;
  unsigned media = 0;
  for (int i = 0; i < corners; i++)
    media |= 1u << medium (k, corner_of (o, i), 0);
  if (o->kind == BT__OBSTACLE_BOX)
    {
      const bt__box *b = &o->shape.box;
      double least = fmin (b->half.x, fmin (b->half.y, b->half.z));
      media |= 1u << medium (k, b->frame.origin, least);
    }
  if (o->kind == BT__OBSTACLE_SPHERE)
    {
      bt_vec3 up = bt__vec (0, 0, o->shape.sphere.radius);
      media |= 1u << medium (k, o->shape.sphere.centre, o->shape.sphere.radius);
      media |= 1u << medium (k, bt__add (o->shape.sphere.centre, up), 0);
    }
  return media;
}

/* Joint I stands in the ground and rises out of the water: a member from its top to its foot, whose
   middle is the joint.  Return the middle.  */
static uint32_t
add_pillar (bt__graph_job *k, uint32_t i)
{
  bt_vec3 middle = obstacle_middle (k->scene->object + i);
  bt__aabb box = bt__obstacle_box (k->scene->object + i);
  uint32_t top = add_point (k, i, 0, bt__vec (middle.x, middle.y, box.hi.z), 0.1);
  uint32_t foot = add_point (k, i, 1, bt__vec (middle.x, middle.y, box.lo.z), 0.1);
  if (!k->failed)
    {
      k->p[top].boundary = BT__AIR;
      k->p[foot].boundary = BT__GROUND;
    }
  return add_point (k, i, 0.5, middle, 0.1);
}

static void
add_joint (bt__graph_job *k, uint32_t i)
{
  unsigned media = reaches_into (k, k->scene->object + i);
  if (media & 1u << BT__GROUND && media & 1u << BT__AIR)
    {
      k->middle[i] = add_pillar (k, i);
      return;
    }
  k->middle[i] = add_point (k, BT__NO_MEMBER, 0, obstacle_middle (k->scene->object + i), 0.1);
  for (uint8_t what = BT__GROUND; what <= BT__MESH && !k->failed; what++)
    if (media & 1u << what)
      k->p[k->middle[i]].boundary = what;
}

/* Member I ends in, or goes through, joint J.  */
static void
join_to_joint (bt__graph_job *k, uint32_t i, uint32_t j)
{
  bt__capsule m = member_axis (k->scene->object + i);
  bt__link link = { m.a, m.b };
  bt__witness w;
  bt__obstacle_pair (k->scene->object + j, &link, &w);
  if (w.distance > m.radius + k->c->gap)
    return;
  uint32_t one = add_meeting (k, i, &m, w.s);
  if (!k->failed)
    bt__unite (k, one, k->middle[j]);
}

/* Two joints that touch: one vertex, unless they were already; then a hole may be between.  */
static void
join_joints (bt__graph_job *k, uint32_t i, uint32_t j)
{
  const bt__obstacle *a = k->scene->object + i, *b = k->scene->object + j;
  bt__link link = { obstacle_middle (a), obstacle_middle (b) };
  int covered = 1;
  for (int n = 0; n <= 32 && covered; n++)
    {
      bt_vec3 p = bt__along (&link, n / 32.0);
      bt__link at = { p, p };
      bt__witness v, w;
      bt__obstacle_pair (a, &at, &v);
      bt__obstacle_pair (b, &at, &w);
      covered = fmin (v.distance, w.distance) <= k->c->gap;
    }
  uint32_t x = k->middle[i], y = k->middle[j];
  if (!covered)
    return;
  int pillar = k->p[x].member != BT__NO_MEMBER || k->p[y].member != BT__NO_MEMBER;
  if (pillar || bt__joint_of (k, x) == bt__joint_of (k, y)
      || (k->p[x].boundary && k->p[y].boundary))
    k->undescribed++;
  bt__unite (k, x, y);
}

/* Join obstacles I and J if they meet.  */
static void
join_if_meeting (bt__graph_job *k, uint32_t i, uint32_t j)
{
  int a = is_member (k->scene->object + i), b = is_member (k->scene->object + j);
  if (a && b)
    join_members (k, i, j);
  else if (a && k->middle[j] != BT__NO_MEMBER)
    join_to_joint (k, i, j);
  else if (b && k->middle[i] != BT__NO_MEMBER)
    join_to_joint (k, j, i);
  else if (k->middle[i] != BT__NO_MEMBER && k->middle[j] != BT__NO_MEMBER)
    join_joints (k, i, j);
}

static void
find_meetings (bt__graph_job *k)
{
  uint32_t n = k->scene->n;
  for (uint32_t i = 0; i < n && !bt__ask (k->c->asker); i++)
    for (uint32_t j = i + 1; j < n && !k->failed; j++)
      if (bt__boxes_are_near (&k->box[i], &k->box[j], 0) && counts (k, i) && counts (k, j))
        join_if_meeting (k, i, j);
}

/* Sort the objects of the scene into ground, meshes and members, and find the box about all.  */
static void
sort_out (bt__graph_job *k)
{
  bt_vec3 gap = bt__vec (k->c->gap, k->c->gap, k->c->gap);
  for (uint32_t i = 0; i < k->scene->n; i++)
    {
      const bt__obstacle *o = k->scene->object + i;
      int mesh = o->kind == BT__OBSTACLE_MESH && counts (k, i);
      k->off[i] = !is_ground (k, i) || !bt__is_on (k->c->on, i);
      k->solid[i] = !mesh;
      k->undescribed += mesh;
      k->middle[i] = BT__NO_MEMBER;
      k->box[i] = bt__obstacle_box (o);
      k->box[i].lo = bt__sub (k->box[i].lo, gap);
      k->box[i].hi = bt__add (k->box[i].hi, gap);
    }
}

static void
begin_graph (bt__graph_job *k)
{
  sort_out (k);
  for (uint32_t i = 0; i < k->scene->n && !k->failed && !bt__ask (k->c->asker); i++)
    {
      const bt__obstacle *o = k->scene->object + i;
      if (!counts (k, i) || o->kind == BT__OBSTACLE_MESH)
        continue;
      if (is_member (o))
        add_member (k, i);
      else
        add_joint (k, i);
    }
}

/* The box about edge I of the graph USER.  */
static void
edge_box (const void *user, uint32_t i, bt__aabb *box)
{
  const bt__graph *g = user;
  bt_vec3 from = g->v[g->edge[i][0]];
  *box = bt__box_with ((bt__aabb){ from, from }, g->v[g->edge[i][1]]);
}

bt_status
bt__graph_plant (bt__graph *graph, bt_error *error)
{
  bt__bvh_free (&graph->tree);
  bt_status status = bt__bvh_reserve (&graph->tree, graph->edges, error);
  if (status != BT_OK)
    return status;
  bt__bvh_build (&graph->tree, graph->edges, edge_box, graph);
  bt__bvh_trim (&graph->tree);
  return BT_OK;
}

bt_status
bt__graph_new (const bt__graph_config *config, bt__graph *graph, bt_error *error)
{
  bt__graph_job k = { .c = config, .scene = config->scene };
  memset (graph, 0, sizeof *graph);
  k.off = calloc (k.scene->n + 1, 1);
  k.solid = calloc (k.scene->n + 1, 1);
  k.middle = malloc ((k.scene->n + 1) * sizeof *k.middle);
  k.box = malloc ((k.scene->n + 1) * sizeof *k.box);
  k.failed = !k.off || !k.solid || !k.middle || !k.box;
  if (!k.failed)
    begin_graph (&k);
  if (!k.failed)
    find_meetings (&k);
  if (!k.failed)
    bt__graph_build (&k, graph);
  if (!k.failed)
    k.failed = bt__graph_plant (graph, NULL) != BT_OK;
  graph->undescribed = (uint32_t)k.undescribed;
  free (k.p);
  free (k.off);
  free (k.solid);
  free (k.middle);
  free (k.box);
  bt_status left = bt__stopped (config->asker, error);
  if (!k.failed && left == BT_OK)
    return BT_OK;
  bt__graph_free (graph);
  if (left != BT_OK)
    return left;
  return bt__fail (error, BT_ERR_LIMIT, "no memory for the graph of %u obstacles",
                   (unsigned)config->scene->n);
}

void
bt__graph_free (bt__graph *g)
{
  free (g->v);
  free (g->radius);
  free (g->boundary);
  free (g->edge);
  free (g->object);
  bt__bvh_free (&g->tree);
  memset (g, 0, sizeof *g);
}
