/* Features for sliding nodes: edges, wires, round members.

   An edge is recognised by probing: for points about the link, the nearest points on the obstacle
   follow in the direction along the edge and stay behind in the direction across.  The side of a
   cylinder or a capsule is known without probing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define THIN 0.25     /* of a link: an edge of a radius so large is round, ... */
#define ROUNDEST 2.3  /* ... and one so large is left to half-spaces */
#define FEEL 0.1      /* of the distance: how far is felt for the directions of an edge, ... */
#define LONG 0.8      /* ... what goes along with that on an edge, at least */
#define WIDE 0.2      /* of a link: how far is felt for its sharpness, ... */
#define SHARP 0.82    /* ... the most of the product of the normals there */
#define FAR 0.5       /* of a link: an edge of a mesh is no farther */
#define SAME_EDGE 0.5 /* of the line's radius: how far an edge may be from where it was */

/* The obstacle that is asked.  */
typedef struct asked
{
  const bt__line_job *k;
  int64_t id;
  uint32_t object; /* its place in the scene; none if it is the number of obstacles */
} asked;

static int
nearest (const asked *q, bt_vec3 p, bt__witness *w)
{
  const bt__scene *scene = q->k->scene;
  bt__link point = { p, p };
  bt__near near;
  if (q->object == scene->n || !bt__is_on (q->k->on, q->object))
    return 0;
  if (scene->object[q->object].kind != BT__OBSTACLE_MESH)
    {
      bt__obstacle_pair (scene->object + q->object, &point, w);
      return 1;
    }
  if (!bt__scene_nearest (scene, q->k->on, &point, FAR * q->k->d->piece, &near, q->k->count)
      || scene->object[near.object].id != q->id)
    return 0;
  *w = near.w;
  return 1;
}

static asked
ask (const bt__line_job *k, int64_t id)
{
  const bt__scene *scene = k->scene;
  uint32_t at = id >= 0 && id < scene->n && scene->object[id].id == id ? (uint32_t)id : 0;
  while (at < scene->n && scene->object[at].id != id)
    at++;
  return (asked){ .k = k, .id = id, .object = at };
}

/* ---- Felt ---- */

/* How the nearest point goes along when P goes by STEP either way: to A and B.  */
static int
follow (const asked *q, bt_vec3 p, bt_vec3 step, bt__witness *a, bt__witness *b)
{
  return nearest (q, bt__add (p, step), a) && nearest (q, bt__sub (p, step), b);
}

/* True if the normals about P turn by much ACROSS.  */
static int
is_edge_sharp (const asked *q, bt_vec3 p, bt_vec3 across)
{
  bt__witness a, b;
  return follow (q, p, bt__scale (WIDE * q->k->d->piece, across), &a, &b)
         && bt__dot (a.normal, b.normal) < SHARP;
}

/* The direction across N in which the nearest point follows a move of P least, for steps of STEP;
   zero if it cannot be said.  */
static int
stays_along (const asked *q, bt_vec3 p, bt_vec3 n, double step, bt_vec3 *axis)
{
  bt_vec3 least = fabs (n.x) < 0.6 ? bt__vec (1, 0, 0) : bt__vec (0, 1, 0), side[2];
  bt__witness a, b;
  double m[2][2];
  side[0] = bt__unit_or (bt__cross (n, least), least);
  side[1] = bt__cross (n, side[0]);
  for (int i = 0; i < 2; i++)
    {
      if (!follow (q, p, bt__scale (step, side[i]), &a, &b))
        return 0;
      bt_vec3 gone = bt__scale (0.5 / step, bt__sub (a.point, b.point));
      m[0][i] = bt__dot (side[0], gone);
      m[1][i] = bt__dot (side[1], gone);
    }
  double turn = 0.5 * atan2 (m[0][1] + m[1][0], m[0][0] - m[1][1]);
  *axis = bt__axpy (bt__scale (cos (turn), side[0]), sin (turn), side[1]);
  return 1;
}

/* Feel for an edge about P, whose nearest is W, to E.  */
static int
feel_for_edge (const asked *q, bt_vec3 p, const bt__witness *w, bt__edge *e)
{
  bt__witness a, b;
  double step = FEEL * w->distance;
  bt_vec3 axis;
  if (!stays_along (q, p, w->normal, step, &axis))
    return 0;
  bt_vec3 across = bt__cross (w->normal, axis);
  if (!follow (q, p, bt__scale (step, across), &a, &b))
    return 0;
  double there = bt__dot (across, bt__sub (a.point, w->point)),
         back = -bt__dot (across, bt__sub (b.point, w->point));
  double goes = fmax (fmin (there, back) / step, 0);
  if (!(goes < LONG) || !follow (q, p, bt__scale (step, axis), &a, &b)
      || !(bt__dot (axis, bt__sub (a.point, b.point)) > 2 * LONG * step))
    return 0;
  *e = (bt__edge){ axis, w->point, w->normal, w->distance * goes / (1 - goes), w->distance, 0 };
  return bt__edge_is_thin (q->k, e->radius) && is_edge_sharp (q, p, across);
}

/* ---- Known ---- */

/* The side of a cylinder or a capsule, if W is on it.  */
static int
side_of (const asked *q, const bt__witness *w, bt__edge *e)
{
  const bt__obstacle *o = q->k->scene->object + q->object;
  *e = (bt__edge){ .point = w->point, .normal = w->normal, .distance = w->distance, .round = 1 };
  if (o->kind == BT__OBSTACLE_CYLINDER)
    {
      e->axis = o->shape.cylinder.axis;
      e->radius = o->shape.cylinder.radius;
      return w->feature == BT__SIDE;
    }
  if (o->kind != BT__OBSTACLE_CAPSULE)
    return 0;
  e->axis = bt__unit_or (bt__sub (o->shape.capsule.b, o->shape.capsule.a), bt__vec (0, 0, 0));
  e->radius = o->shape.capsule.radius;
  return w->feature == BT__SIDE;
}

int
bt__edge_is_thin (const bt__line_job *k, double radius)
{
  return radius + k->config->radius <= THIN * k->d->piece;
}

static int
find (const asked *q, bt_vec3 p, const bt__witness *w, bt__edge *e)
{
  if (side_of (q, w, e))
    return e->radius + q->k->config->radius <= ROUNDEST * q->k->d->piece;
  return feel_for_edge (q, p, w, e);
}

int
bt__edge_find (const bt__line_job *k, int64_t id, bt_vec3 p, bt__edge *e)
{
  asked q = ask (k, id);
  bt__witness w;
  return nearest (&q, p, &w) && w.distance > 0 && find (&q, p, &w, e);
}

int
bt__edge_again (const bt__line_job *k, const bt__contact *a, bt_vec3 p, bt__edge *e)
{
  asked q = ask (k, a->object);
  bt__witness w;
  bt_vec3 was = bt__axpy (a->point, -a->thick, a->normal);
  if (!nearest (&q, p, &w) || !(w.distance > 0))
    return 0;
  *e = (bt__edge){ a->axis, w.point, w.normal, a->thick, w.distance, a->bent == BT__BENT_ROUND };
  bt_vec3 gone = bt__off_axis (a->axis, bt__sub (bt__axpy (w.point, -a->thick, w.normal), was));
  if (bt__norm (gone) < SAME_EDGE * k->config->radius)
    return 1;
  if (!find (&q, p, &w, e))
    return 0;
  if (bt__dot (e->axis, a->axis) < 0)
    e->axis = bt__scale (-1, e->axis);
  return 1;
}

int
bt__edge_has_none (const bt__line_job *k, const bt__line_row *of)
{
  const bt__obstacle *o = k->scene->object + of->object;
  double most = ROUNDEST * k->d->piece - k->config->radius;
  switch (o->kind)
    {
    case BT__OBSTACLE_PLANE:
    case BT__OBSTACLE_SPHERE:
      return 1;
    case BT__OBSTACLE_CAPSULE:
      return o->shape.capsule.radius > most;
    default:
      return 0;
    }
}
