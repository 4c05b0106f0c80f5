/* Places for sliding nodes: at an edge that bears a link, a new node on the link's chord, which
   keeps the line's shape; at a round member, the ends of links tangent to the member.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define STEEP 0.8     /* product of line and axis: with more no corner comes, see BT__TURN_ALONG */
#define FROM_NODE 0.1 /* of a piece: nearer to a node no other is put, nor is a touch beyond it */
#define TAUT 5.0      /* N: a line under less has no corners about round members */
#define CALM 3.0      /* times as far must be what else is near as when it is held */
#define SHARPEST 2.4  /* radians: a link's end that turns more is no corner, nor one ... */
#define ASIDE 0.06    /* ... whose links pass nearer to the axis by so much of the way ... */
#define OFF 0.03      /* ... or farther */

enum
{
  TRIED = 12 /* steps from one try to hold a node to the next */
};

/* The node that is there already where R bears, or -1.  */
static int64_t
node_near (const bt__line_job *k, const bt__constraint *r)
{
  double rest = bt__dynamic_rest (k->d)[r->node], near = FROM_NODE * k->d->piece;
  return r->s * rest < near ? r->node : (1 - r->s) * rest < near ? r->node + 1 : -1;
}

/* True if one of node I's intervals is too short for it to be bent.  */
static int
is_crowded (const bt__line_job *k, int64_t i)
{
  const double *rest = bt__dynamic_rest (k->d) + i;
  return i < 1 || i >= k->d->n || fmin (rest[-1], rest[0]) < BT__BEND_CROWDED * k->d->piece;
}

/* True if both links of node I are tangents of E, as near as may be, and touch it.  E's axis is
   turned the way the line winds.  */
static int
is_tangent_corner (const bt__line_job *k, int64_t i, bt__edge *e)
{
  const bt_vec3 *x = bt__dynamic_x (k->d) + i - 1;
  double out = e->radius + k->config->radius;
  bt_vec3 centre = bt__axpy (e->point, -e->radius, e->normal);
  bt_vec3 u = bt__off_axis (e->axis, bt__sub (x[1], centre));
  if (bt__dot (e->axis, bt__cross (u, bt__sub (x[2], x[0]))) < 0)
    e->axis = bt__scale (-1, e->axis);
  bt_vec3 a = bt__turn_normal (e->axis, x), b = bt__turn_normal (e->axis, x + 1);
  double angle = bt__turn_angle (e->axis, a, b);
  double low = (1 - ASIDE) * out, high = (1 + OFF) * out, da = bt__dot (a, u), db = bt__dot (b, u);
  double la = bt__dot (bt__cross (e->axis, a), u), lb = -bt__dot (bt__cross (e->axis, b), u);
  double slack = FROM_NODE * k->d->piece;
  return angle > BT__BEND_TURNS && angle < SHARPEST && da > low && da < high && db > low
         && db < high && la > -slack && lb > -slack && la < bt__distance (x[0], x[1]) + slack
         && lb < bt__distance (x[1], x[2]) + slack;
}

/* True if the link from node I to the next runs far enough across AXIS.  */
static int
link_runs_across (const bt__line_job *k, int64_t i, bt_vec3 axis)
{
  const bt_vec3 *x = bt__dynamic_x (k->d) + i;
  bt_vec3 none = { 0, 0, 0 }, t = bt__unit_or (bt__sub (x[1], x[0]), none);
  return fabs (bt__dot (t, axis)) < STEEP;
}

int
bt__sliding_runs_across (const bt__line_job *k, int64_t i, bt_vec3 axis)
{
  return link_runs_across (k, i - 1, axis) && link_runs_across (k, i, axis);
}

/* True if row Q has borne for a while, a line that is taut enough and near nothing else.  */
static int
is_settled (const bt__line_job *k, int q)
{
  int64_t j = k->w->row[q].node, id = k->w->of[q].id;
  return k->w->of[q].age >= TRIED && bt__dynamic_tension (k->d)[j] > TAUT && j >= 1
         && j + 2 < k->links && bt__bend_is_calm (k, j, id, CALM)
         && bt__bend_is_calm (k, j + 1, id, CALM);
}

/* True if node I may be held as a corner of what row Q is of.  */
static int
may_corner (const bt__line_job *k, const bt__sliding *s, int q, int64_t i, bt__bend_place *p)
{
  const bt_vec3 *x = bt__dynamic_x (k->d);
  p->row = q;
  p->node = i;
  return is_settled (k, q) && i >= 1 && i < k->d->n && !bt__sliding_has (s, i) && !is_crowded (k, i)
         && bt__edge_find (k, k->w->of[q].id, x[i], &p->edge) && p->edge.round
         && !bt__edge_is_thin (k, p->edge.radius) && bt__sliding_runs_across (k, i, p->edge.axis)
         && is_tangent_corner (k, i, &p->edge);
}

/* True if another row of the obstacle of row Q is on a link next to its link.  */
static int
has_company (const bt__line_job *k, int q)
{
  const bt__line_row *of = k->w->of + q;
  for (int i = 0; i < k->rows; i++)
    if (i != q && k->w->of[i].id == of->id && k->w->row[i].load > 0
        && (k->w->of[i].link + 1 == of->link || k->w->of[i].link == of->link + 1))
      return 1;
  return 0;
}

/* True if the line is held near row Q at the same member already.  */
static int
is_held_near (const bt__line_job *k, const bt__sliding *s, int q)
{
  const bt__line_row *of = k->w->of + q;
  for (int i = 0; i < s->n; i++)
    if (s->anchor[i].bent == BT__BENT_ROUND && s->anchor[i].object == of->id
        && s->node[i] >= (int64_t)of->link - 2 && s->node[i] <= (int64_t)of->link + 2)
      return 1;
  return 0;
}

/* True if row Q is of a link in a crotch, or next to one.  */
static int
is_wedged (const bt__line_job *k, int q)
{
  int64_t j = k->w->row[q].node;
  return (j > 0 && bt__bend_is_wedged (k, j, CALM))
         || (j + 1 < k->links && bt__bend_is_wedged (k, j + 1, CALM));
}

/* True if the line turns about the round member of P, which touches interval J at AT; where the
   line turns away, a node would be let go in the next step.  */
static int
turns_about (const bt__line_job *k, const bt__bend_place *p, int64_t j, bt_vec3 at)
{
  const bt_vec3 *x = bt__dynamic_x (k->d);
  int64_t i = p->node;
  const bt_vec3 on[] = { x[i < 0 ? j : i - 1], i < 0 ? at : x[i], x[i < 0 ? j + 1 : i + 1] };
  bt__turn t;
  return bt__turn_find (k, &p->edge, on, NULL, NULL, &t) && t.angle > 0;
}

/* True if the line may be bent where row Q bears.  */
static int
may_bend (const bt__line_job *k, const bt__sliding *s, int q, bt__bend_place *p)
{
  const bt__constraint *r = k->w->row + q;
  const bt_vec3 *x = bt__dynamic_x (k->d) + r->node;
  bt_vec3 at = bt__between (x, r->s);
  bt_vec3 t = bt__unit_or (bt__sub (x[1], x[0]), bt__vec (0, 0, 0));
  p->row = q;
  p->node = node_near (k, r);
  if (p->node >= 0 && (is_crowded (k, p->node) || bt__sliding_has (s, p->node)))
    return 0;
  if (!bt__edge_find (k, k->w->of[q].id, at, &p->edge)
      || !link_runs_across (k, r->node, p->edge.axis))
    return 0;
  if (bt__dot (bt__cross (p->edge.axis, p->edge.normal), t) < 0)
    p->edge.axis = bt__scale (-1, p->edge.axis);
  if (p->edge.round && is_held_near (k, s, q))
    return 0;
  return bt__edge_is_thin (k, p->edge.radius)
             ? k->w->of[q].flat != 1 && !is_wedged (k, q)
             : is_settled (k, q) && !has_company (k, q) && turns_about (k, p, r->node, at);
}

static int
is_candidate (const bt__line_job *k, int q)
{
  const bt__constraint *r = k->w->row + q;
  const bt__line_row *of = k->w->of + q;
  return r->load > 0 && of->age % TRIED == 0 && !of->mover
         && bt__dynamic_tension (k->d)[r->node] > 0 && !bt__edge_has_none (k, of);
}

int
bt__sliding_find (const bt__line_job *k, const bt__sliding *s, bt__bend_place *p)
{
  if (s->n >= BT__BENTS || k->d->n >= k->d->n_max)
    return 0;
  for (int q = 0; q < k->rows; q++)
    if (is_candidate (k, q)
        && (may_corner (k, s, q, k->w->row[q].node, p)
            || may_corner (k, s, q, k->w->row[q].node + 1, p)))
      return 1;
  for (int q = 0; q < k->rows; q++)
    if (is_candidate (k, q) && may_bend (k, s, q, p))
      return 1;
  return 0;
}

void
bt__sliding_hold (bt__line_job *k, bt__sliding *s, const bt__bend_place *p)
{
  const bt__constraint *r = k->w->row + p->row;
  int64_t j = r->node, node = p->node;
  bt_vec3 *x = bt__dynamic_x (k->d), *v = bt__dynamic_v (k->d);
  bt_vec3 t = bt__unit_or (bt__sub (x[j + 1], x[j]), bt__vec (0, 0, 0));
  double flow = bt__dot (t, bt__between (v + j, r->s));
  bt__contact a;
  if (!bt__sliding_take_anchor (k, p->row, &a))
    a = (bt__contact){ .object = k->w->of[p->row].id, .triangle = -1, .mover = -1 };
  a.bent = p->edge.round ? BT__BENT_ROUND : BT__BENT_EDGE;
  a.age = 0;
  a.flow = flow;
  a.before = a.beyond = 0;
  a.drag = fmin (fmax (bt__dot (t, a.stick), -BT__LINE_SLIP), BT__LINE_SLIP);
  a.side = bt__dot (bt__bend_aside (k, &p->edge, p->edge.normal, t), a.stick);
  a.axis = p->edge.axis;
  a.thick = p->edge.radius;
  a.point = p->edge.point;
  a.normal = p->edge.normal;
  a.after = bt__vec (0, 0, 0);
  if (node < 0)
    {
      node = j + 1;
      bt__sliding_put_in (k, s, j, r->s, j);
    }
  a.held = bt__dynamic_x (k->d)[node];
  a.lag = bt__vec (INFINITY, 0, 0);
  bt__sliding_take_hold (k, node, a.axis);
  bt__sliding_add (s, &a, node);
}
