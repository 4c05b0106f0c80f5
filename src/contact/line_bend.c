/* Where a line runs about something thin: a wire, an edge.

   Links that pass over an edge of a radius far below their length would feel every node: the line
   would turn now at one, now at the next.  So a node is put where the line turns, and stays there
   while line runs through it (tether/dynamic_bent.c).  It comes where a link bears on an edge, on
   the link's chord, so that the line's shape stays; it goes when it bears no more; on the way its
   neighbours go from one side to the other, each taken out before it gets there and put in behind.

   It is held so far out that the links on either side pass the edge at the line's radius.  They are
   links like others: nothing here touches the promise that none passes through.  A node is taken
   out only if the way of the links to their new place is clear; else it waits.

   What an edge is, is felt: of points about the link those nearest on the obstacle go along with
   them in one direction, and stay in the other.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/line_job.h"

#define THIN 0.25      /* of a link: an edge of a radius so large is round */
#define FEEL 0.1       /* of the distance: how far is felt for the directions of an edge, ... */
#define LONG 0.8       /* ... what goes along with that on an edge, at least */
#define WIDE 0.2       /* of a link: how far is felt for its sharpness, ... */
#define SHARP 0.82     /* ... the most of the product of the normals there */
#define ALONG 0.9      /* product of line and edge: more, and the line lies along it */
#define SAME_EDGE 0.5  /* of the line's radius: how far an edge may be from where it was */
#define LEAST_COS 0.25 /* of half the turn: what a node is held out for at most */
#define STRAIGHT 1e-3  /* sine of half the turn: less has no direction */
#define PASS 0.25      /* of a piece: a node nearer to the edge passes, ... */
#define FORESIGHT 2.5  /* steps ... or one that is there so soon; ... */
#define SPLIT 1.6      /* ... an interval so long is split; ... */
#define LEAST 0.06     /* ... with so little left the line runs over the edge as it can */
#define SPARE 1.3      /* of a piece: a node between two intervals no longer than this is spare */
#define FROM_NODE 0.1  /* of a piece: nearer to a node no other is put; ... */
#define CROWDED 0.01   /* ... nearer to the next one none is bent */

enum
{
  TRIED = 12,  /* steps from one try to hold a node at an edge to the next */
  TANGENTS = 4 /* iterations for where they meet */
};

/* ---- What the line runs about ---- */

typedef struct edge
{
  bt_vec3 axis, point, normal; /* unit; on the obstacle; unit, to the line */
  double radius, distance;
} edge;

/* The obstacle, in the frame it is asked in.  */
typedef struct asked
{
  const bt__line_job *k;
  const bt__scene *scene;
  const bt__switches *on;
  int64_t id;
  uint32_t object; /* its place in the scene; none if it is the number of obstacles */
  double cap;
} asked;

static int
nearest (const asked *q, bt_vec3 p, bt__witness *w)
{
  bt__link point = { p, p };
  bt__near near;
  if (q->object == q->scene->n || !bt__is_on (q->on, q->object))
    return 0;
  if (q->scene->object[q->object].kind != BT__OBSTACLE_MESH)
    {
      bt__obstacle_pair (q->scene->object + q->object, &point, w);
      return w->distance <= q->cap;
    }
  if (!bt__scene_nearest (q->scene, q->on, &point, q->cap, &near, q->k->count)
      || q->scene->object[near.object].id != q->id)
    return 0;
  *w = near.w;
  return 1;
}

/* How the nearest point goes along when P goes by STEP either way: to A and B.  */
static int
follow (const asked *q, bt_vec3 p, bt_vec3 step, bt__witness *a, bt__witness *b)
{
  return nearest (q, bt__add (p, step), a) && nearest (q, bt__sub (p, step), b);
}

/* Nonzero if the normals about P turn by much ACROSS.  */
static int
is_sharp (const asked *q, bt_vec3 p, bt_vec3 across)
{
  bt__witness a, b;
  return follow (q, p, bt__scale (WIDE * q->k->d->piece, across), &a, &b)
         && bt__dot (a.normal, b.normal) < SHARP;
}

/* Feel for an edge about P, to E.  */
static int
feel (const asked *q, bt_vec3 p, edge *e)
{
  bt__witness w, a, b;
  if (!nearest (q, p, &w) || !(w.distance > 0))
    return 0;
  double step = FEEL * w.distance, m[2][2];
  bt_vec3 n = w.normal, least = fabs (n.x) < 0.6 ? bt__vec (1, 0, 0) : bt__vec (0, 1, 0);
  bt_vec3 side[2];
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
  bt_vec3 axis = bt__axpy (bt__scale (cos (turn), side[0]), sin (turn), side[1]);
  bt_vec3 across = bt__cross (n, axis);
  if (!follow (q, p, bt__scale (step, across), &a, &b))
    return 0;
  double there = bt__dot (across, bt__sub (a.point, w.point)),
         back = -bt__dot (across, bt__sub (b.point, w.point));
  double goes = fmax (fmin (there, back) / step, 0);
  if (!(goes < LONG) || !follow (q, p, bt__scale (step, axis), &a, &b)
      || !(bt__dot (axis, bt__sub (a.point, b.point)) > 2 * LONG * step))
    return 0;
  *e = (edge){ axis, w.point, n, w.distance * goes / (1 - goes), w.distance };
  return e->radius + q->k->config->radius <= THIN * q->k->d->piece && is_sharp (q, p, across);
}

static asked
ask (const bt__line_job *k, int64_t mover, int64_t id)
{
  const bt__mover *m = mover < 0 ? NULL : k->mover + mover;
  const bt__scene *scene = m ? m->body : k->scene;
  uint32_t at = id >= 0 && id < scene->n && scene->object[id].id == id ? (uint32_t)id : 0;
  while (at < scene->n && scene->object[at].id != id)
    at++;
  return (asked){ .k = k,
                  .scene = scene,
                  .on = m ? m->on : k->on,
                  .id = id,
                  .object = at,
                  .cap = 2 * THIN * k->d->piece };
}

/* ---- Nodes that were bent before this step ---- */

/* The node that is FROM_END from the end, or -1.  */
static int
node_of (const bt__line_job *k, double from_end)
{
  double near = 1e-9 * (1 + k->w->from_end[0]);
  for (int i = 1; i < k->links; i++)
    if (fabs (k->w->from_end[i] - from_end) <= near)
      return i;
  return -1;
}

/* The edge of A as it is about its node now, in the world at the end of the step; FROM is where its
   nearest point was.  Zero if there is none.  */
static int
find_edge (const bt__line_job *k, const bt__anchor *a, int i, edge *e, bt_vec3 *drift)
{
  const bt__mover *m = a->mover < 0 ? NULL : k->mover + a->mover;
  asked q;
  bt__witness w;
  if (a->mover >= (int64_t)k->movers)
    return 0;
  q = ask (k, a->mover, a->object);
  bt_vec3 p = k->x[i], axis = a->axis, was = bt__axpy (a->point, -a->thick, a->normal);
  if (m)
    {
      p = bt__to_local (&m->motion.from, p);
      axis = bt__into (&m->motion.from, axis);
      was = bt__to_local (&m->motion.from, was);
    }
  if (!nearest (&q, p, &w) || !(w.distance > 0))
    return 0;
  *e = (edge){ axis, w.point, w.normal, a->thick, w.distance };
  bt_vec3 gone = bt__sub (bt__axpy (w.point, -a->thick, w.normal), was);
  if (!(bt__norm (bt__axpy (gone, -bt__dot (axis, gone), axis)) < SAME_EDGE * k->config->radius)
      && !feel (&q, p, e))
    return 0;
  *drift = bt__vec (0, 0, 0);
  if (m)
    {
      bt__frame to = bt__motion_at (&m->motion, 1);
      bt_vec3 before = bt__to_world (&m->motion.from, e->point);
      e->axis = bt__out_of (&to, e->axis);
      e->normal = bt__out_of (&to, e->normal);
      e->point = bt__to_world (&to, e->point);
      *drift = bt__sub (e->point, before);
    }
  return 1;
}

/* How the line runs about an edge.  */
typedef struct turn
{
  bt_vec3 at, normal;
  double angle;
} turn;

/* The directions from node I's place AT to its neighbours: A, B, and across the edge PA, PB.  */
typedef struct legs
{
  bt_vec3 a, b, pa, pb;
} legs;

static bt_vec3
across (bt_vec3 axis, bt_vec3 v)
{
  return bt__axpy (v, -bt__dot (axis, v), axis);
}

static legs
legs_of (const bt__line_job *k, int i, bt_vec3 axis, bt_vec3 at)
{
  bt_vec3 none = { 0, 0, 0 };
  legs l = { .a = bt__unit_or (bt__sub (k->x[i - 1], at), none),
             .b = bt__unit_or (bt__sub (k->x[i + 1], at), none) };
  l.pa = bt__unit_or (across (axis, l.a), none);
  l.pb = bt__unit_or (across (axis, l.b), none);
  return l;
}

/* The turn of the line at node I about E, where the tangents from both neighbours meet: the links
   pass it at the line's radius.  Zero if the line does not run about it: lies along it, or turns
   away.  */
static int
turn_about (const bt__line_job *k, const edge *e, int i, turn *t)
{
  bt_vec3 axis = e->axis, centre = bt__axpy (e->point, -e->radius, e->normal);
  centre = bt__axpy (centre, bt__dot (axis, bt__sub (k->X[i], centre)), axis);
  double out = e->radius + k->config->radius;
  t->normal = e->normal;
  t->at = k->X[i];
  for (int q = 0; q < TANGENTS; q++)
    {
      legs l = legs_of (k, i, axis, t->at);
      bt_vec3 sum = bt__add (l.pa, l.pb);
      double sine = fmin (0.5 * bt__norm (sum), 1);
      if (sine > STRAIGHT)
        t->normal = bt__scale (-0.5 / sine, sum);
      if (!(bt__dot (t->normal, e->normal) > 0))
        return 0;
      double cosine = fmax (sqrt (1 - sine * sine), LEAST_COS);
      t->at = bt__axpy (centre, out / cosine, t->normal);
    }
  legs l = legs_of (k, i, axis, t->at);
  t->angle = 2 * asin (fmin (0.5 * bt__norm (bt__add (l.a, l.b)), 1));
  return fabs (bt__dot (axis, l.a)) < ALONG && fabs (bt__dot (axis, l.b)) < ALONG;
}

static void
bend_at (bt__line_job *k, const bt__anchor *a, int i, const edge *e, const turn *t, bt_vec3 drift)
{
  int at = k->bents++;
  double mu = bt__line_friction (k, a->object);
  double stiff = bt__line_stiffness (k, i, a->load);
  k->w->bent[at] = (bt__dynamic_bent){ .node = i,
                                       .at = t->at,
                                       .axis = e->axis,
                                       .normal = t->normal,
                                       .drift = drift,
                                       .stiffness = stiff,
                                       .wrap = mu * t->angle,
                                       .friction = mu,
                                       .slip = BT__LINE_SLIP,
                                       .drag = a->drag,
                                       .side = a->side,
                                       .flow = a->flow * k->h,
                                       .load = a->load };
  k->w->bend[at] = *a;
  k->w->bend[at].axis = e->axis;
  k->w->bend[at].point = e->point;
  k->w->bend[at].normal = e->normal;
  k->w->bend[at].thick = e->radius;
}

void
bt__line_bends (bt__line_job *k)
{
  k->bents = 0;
  for (int q = 0; q < k->olds && k->bents < BT__BENTS; q++)
    {
      bt__anchor *a = k->w->old + q;
      edge e;
      turn t;
      bt_vec3 drift;
      int i = a->bent ? node_of (k, a->from_end) : -1;
      if (i < 0 || !find_edge (k, a, i, &e, &drift) || !turn_about (k, &e, i, &t))
        continue;
      bend_at (k, a, i, &e, &t, drift);
      a->state = -1; /* taken */
    }
  bt__dynamic_bend (k->kernel, k->w->bent, k->bents);
}

/* Nonzero if row Q is of an edge about which the line is bent.  */
int
bt__line_is_bent_about (const bt__line_job *k, int q)
{
  const bt__line_row *of = k->w->of + q;
  for (int i = 0; i < k->bents; i++)
    {
      const bt__anchor *a = k->w->bend + i;
      int64_t node = k->w->bent[i].node;
      if ((int64_t)of->link != node && (int64_t)of->link != node - 1)
        continue;
      if (a->object != of->id || a->mover != (int64_t)of->mover - 1)
        continue;
      bt_vec3 away = bt__sub (of->point, bt__axpy (a->point, -a->thick, a->normal));
      if (bt__norm (bt__axpy (away, -bt__dot (a->axis, away), a->axis))
          < a->thick + 2 * k->config->radius)
        return 1;
    }
  return 0;
}

/* ---- What is kept of them ---- */

bt__anchor
bt__line_bent_anchor (const bt__line_job *k, int i)
{
  const bt__dynamic_bent *b = k->w->bent + i;
  bt__anchor a = k->w->bend[i];
  double drag = b->drag + b->flow, side = b->side_now, size = hypot (drag, side);
  double keep = size > BT__LINE_SLIP ? BT__LINE_SLIP / size : 1;
  double pull = fabs (b->pull[1] - b->pull[0]);
  a.state = size > BT__LINE_SLIP ? BT__TOUCH_SLIDE : BT__TOUCH_STICK;
  a.step_work = (1 - keep) * (pull * fabs (drag) + b->friction * b->load * fabs (side));
  a.work += a.step_work;
  a.drag = keep * drag;
  a.side = keep * side;
  a.flow = b->flow / k->h;
  a.speed = hypot (b->flow, side - b->side) / k->h;
  a.load = b->load;
  a.force = b->force;
  a.from_end = k->w->from_end[b->node] + b->flow;
  a.stick = bt__vec (0, 0, 0);
  return a;
}

/* ---- Nodes that come and go ---- */

/* The anchors of bent nodes and their nodes, as they are while nodes come and go.  */
typedef struct bends
{
  int n;
  bt__anchor *anchor[BT__BENTS];
  int64_t node[BT__BENTS];
} bends;

static int
is_bent (const bends *s, int64_t i)
{
  for (int k = 0; k < s->n; k++)
    if (s->node[k] == i)
      return 1;
  return 0;
}

static void
shift_bends (bends *s, int64_t from, int by)
{
  for (int k = 0; k < s->n; k++)
    s->node[k] += s->node[k] >= from ? by : 0;
}

static void
show (const bt__line_job *k, int64_t i, int by)
{
  const bt__line_hook *hook = k->config->hook;
  if (hook && hook->see)
    hook->see (hook->witness, (int)i, by, bt__dynamic_x (k->d), (int)k->d->n + 1);
}

static void
put_in (bt__line_job *k, bends *s, int64_t j, double u, int64_t from)
{
  bt__dynamic_insert (k->d, j, u, from);
  shift_bends (s, j + 1, 1);
  show (k, j + 1, 1);
}

/* Take out node I if its links are clear on their way to the chord.  */
static int
take_out (bt__line_job *k, bends *s, int64_t i)
{
  const bt_vec3 *p = bt__dynamic_x (k->d) + i - 1;
  const double *rest = bt__dynamic_rest (k->d) + i - 1;
  double u = rest[0] / (rest[0] + rest[1]);
  bt_vec3 to = bt__axpy (bt__scale (1 - u, p[0]), u, p[2]);
  if (i < 1 || i >= k->d->n || is_bent (s, i) || !bt__line_may_move (k, p, bt__sub (to, p[1])))
    return 0;
  bt__dynamic_remove (k->d, i);
  shift_bends (s, i, -1);
  show (k, i, -1);
  return 1;
}

/* Line runs out of the interval on one side of bent node Q, at FLOW a step, into that on the other:
   the next nodes pass.  Zero if they cannot and nothing is left.  */
static int
pass_nodes (bt__line_job *k, bends *s, int q, double flow)
{
  double piece = k->d->piece, size = fabs (flow), least = fmax (PASS * piece, FORESIGHT * size);
  for (int i = 0; i < 4; i++)
    {
      int64_t node = s->node[q], from = flow > 0 ? node - 1 : node,
              next = flow > 0 ? node - 1 : node + 1;
      double left = bt__dynamic_rest (k->d)[from];
      if (left >= least)
        break;
      if (is_bent (s, next))
        return left > LEAST * piece;
      if (!take_out (k, s, next))
        return left > LEAST * piece + size;
    }
  int64_t node = s->node[q], into = flow > 0 ? node : node - 1,
          far = flow > 0 ? node + 1 : node - 1;
  double rest = bt__dynamic_rest (k->d)[into];
  if (rest > fmax (SPLIT * piece, least + 1.1 * piece) && k->d->n < k->d->n_max)
    put_in (k, s, into, flow > 0 ? (rest - piece) / rest : piece / rest,
            far > node ? into + 1 : into);
  return 1;
}

/* A node that is bent no more goes on with the line.  */
static void
let_go (bt__line_job *k, int64_t i)
{
  bt_vec3 *arrays[] = { bt__dynamic_v (k->d), bt__dynamic_vp (k->d), bt__dynamic_dx (k->d) };
  for (int q = 0; q < 3; q++)
    {
      bt_vec3 *v = arrays[q] + i;
      v[0] = bt__scale (0.5, bt__add (v[-1], v[1]));
    }
}

static void
let_go_idle (bt__line_job *k)
{
  for (int q = 0; q < k->bents; q++)
    if (!(k->w->bent[q].load > 0))
      let_go (k, k->w->bent[q].node);
}

static void
drop (bt__line_job *k, bends *s, int q)
{
  s->anchor[q]->bent = 0;
  let_go (k, s->node[q]);
  s->n--;
  for (int i = q; i < s->n; i++)
    {
      s->anchor[i] = s->anchor[i + 1];
      s->node[i] = s->node[i + 1];
    }
}

static void
measure (bt__line_job *k)
{
  const double *rest = bt__dynamic_rest (k->d);
  k->links = (int)k->d->n;
  k->w->from_end[k->links] = 0;
  for (int j = k->links - 1; j >= 0; j--)
    k->w->from_end[j] = k->w->from_end[j + 1] + rest[j];
}

static void
gather (bt__line_job *k, bends *s)
{
  bt__anchor *a = bt__anchors_at (k->anchors);
  s->n = 0;
  for (int64_t q = 0; q < k->anchors->n && s->n < BT__BENTS; q++)
    {
      int i = a[q].bent ? node_of (k, a[q].from_end) : -1;
      a[q].bent = i > 0;
      if (i <= 0)
        continue;
      s->anchor[s->n] = a + q;
      s->node[s->n++] = i;
    }
}

/* ---- New ones ---- */

/* Nonzero if the obstacle of row Q is too round for an edge; cheap.  */
static int
is_round (const bt__line_job *k, const bt__line_row *of)
{
  const bt__scene *scene = of->mover ? k->mover[of->mover - 1].body : k->scene;
  const bt__obstacle *o = scene->object + of->object;
  double most = THIN * k->d->piece - k->config->radius;
  switch (o->kind)
    {
    case BT__OBSTACLE_PLANE:
    case BT__OBSTACLE_SPHERE:
      return 1;
    case BT__OBSTACLE_CAPSULE:
      return o->shape.capsule.radius > most;
    case BT__OBSTACLE_CYLINDER:
      return o->shape.cylinder.radius > most;
    default:
      return 0;
    }
}

/* The node that is there already where R bears, or -1.  */
static int64_t
node_near (const bt__line_job *k, const bt__dynamic_row *r)
{
  double rest = bt__dynamic_rest (k->d)[r->node], near = FROM_NODE * k->d->piece;
  return r->s * rest < near ? r->node : (1 - r->s) * rest < near ? r->node + 1 : -1;
}

/* Nonzero if one of node I's intervals is too short for it to be bent.  */
static int
is_crowded (const bt__line_job *k, int64_t i)
{
  const double *rest = bt__dynamic_rest (k->d) + i;
  return i < 1 || i >= k->d->n || fmin (rest[-1], rest[0]) < CROWDED * k->d->piece;
}

/* Nonzero if the line may be bent where row Q bears; E is the edge then.  */
static int
may_bend (const bt__line_job *k, const bends *s, int q, edge *e)
{
  const bt__dynamic_row *r = k->w->row + q;
  const bt__line_row *of = k->w->of + q;
  const bt_vec3 *x = bt__dynamic_x (k->d) + r->node;
  if (!(r->load > 0) || of->age % TRIED != 0 || of->flat == 1 || of->mover || s->n >= BT__BENTS
      || k->d->n >= k->d->n_max || !(bt__dynamic_tension (k->d)[r->node] > 0) || is_round (k, of))
    return 0;
  int64_t own = node_near (k, r);
  if (own >= 0 && (is_crowded (k, own) || is_bent (s, own)))
    return 0;
  asked a = ask (k, (int64_t)of->mover - 1, of->id);
  bt_vec3 p = bt__axpy (bt__scale (1 - r->s, x[0]), r->s, x[1]);
  bt_vec3 t = bt__unit_or (bt__sub (x[1], x[0]), bt__vec (0, 0, 0));
  return feel (&a, p, e) && fabs (bt__dot (t, e->axis)) < ALONG;
}

/* The row that bears most of those where the line may be bent, or -1.  */
static int
find_new (const bt__line_job *k, const bends *s, edge *e)
{
  for (int q = 0; q < k->rows; q++)
    if (may_bend (k, s, q, e))
      return q;
  return -1;
}

/* The anchor of row Q, which becomes a bent node's.  */
static bt__anchor *
anchor_of (bt__line_job *k, int q)
{
  bt__anchor *a = bt__anchors_at (k->anchors);
  for (int64_t i = 0; i < k->anchors->n; i++)
    if (!a[i].bent && a[i].from_end == k->w->of[q].from_end && a[i].object == k->w->of[q].id)
      return a + i;
  return NULL;
}

static void
bend_new (bt__line_job *k, bends *s)
{
  edge e;
  int q = find_new (k, s, &e);
  bt__anchor *a = q < 0 ? NULL : anchor_of (k, q);
  if (!a)
    return;
  const bt__dynamic_row *r = k->w->row + q;
  int64_t j = r->node;
  bt_vec3 *x = bt__dynamic_x (k->d), *v = bt__dynamic_v (k->d);
  bt_vec3 t = bt__unit_or (bt__sub (x[j + 1], x[j]), bt__vec (0, 0, 0));
  a->bent = 1;
  a->flow = bt__dot (t, bt__axpy (bt__scale (1 - r->s, v[j]), r->s, v[j + 1]));
  a->drag = fmin (fmax (bt__dot (t, a->stick), -BT__LINE_SLIP), BT__LINE_SLIP);
  a->side = bt__dot (e.axis, a->stick);
  a->axis = e.axis;
  a->thick = e.radius;
  a->point = e.point;
  a->normal = e.normal;
  int64_t node = node_near (k, r);
  if (node < 0)
    {
      node = j + 1;
      put_in (k, s, j, r->s, j);
    }
  bt_vec3 *arrays[] = { v, bt__dynamic_vp (k->d), bt__dynamic_dx (k->d) };
  for (int i = 0; i < 3; i++)
    arrays[i][node] = bt__scale (bt__dot (e.axis, arrays[i][node]), e.axis);
  int at = s->n++;
  for (; at > 0 && s->node[at - 1] > node; at--)
    {
      s->anchor[at] = s->anchor[at - 1];
      s->node[at] = s->node[at - 1];
    }
  s->anchor[at] = a;
  s->node[at] = node;
}

/* ---- Spare ones ---- */

/* Take out one node that nothing needs any more.  */
static void
take_spare (bt__line_job *k, bends *s)
{
  const double *rest = bt__dynamic_rest (k->d);
  for (int64_t i = 2; i < k->d->n; i++)
    if (rest[i - 1] + rest[i] < SPARE * k->d->piece && !is_bent (s, i) && !is_bent (s, i - 1)
        && !is_bent (s, i + 1) && take_out (k, s, i))
      return;
}

void
bt__line_rebend (bt__line_job *k)
{
  bends s;
  show (k, 0, 0);
  let_go_idle (k);
  measure (k);
  gather (k, &s);
  if (!(k->config->hook && k->config->hook->no_bends))
    bend_new (k, &s);
  for (int q = s.n - 1; q >= 0; q--)
    if (!pass_nodes (k, &s, q, s.anchor[q]->flow * k->h))
      drop (k, &s, q);
  take_spare (k, &s);
  measure (k);
  for (int q = 0; q < s.n; q++)
    s.anchor[q]->from_end = k->w->from_end[s.node[q]];
}
