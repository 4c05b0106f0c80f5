/* Sliding nodes: where a line runs about a wire, an edge or a round member thin against its links.

   The idea is that of Eulerian-on-Lagrangian cables (Sueda et al. 2011).  Links passing over a thin
   member would feel every node: the line would turn now at one node, now at the next, and a polygon
   drawn round a drum jerks like a chain on a sprocket.  So a node is placed where the line turns,
   and stays while line flows through the node (tether/dynamic_bent.c).  An edge needs a single
   node, and so does a wire about which the line turns by a right angle; by half a turn, the
   tangents of a single node would meet nowhere.  A round member has as many nodes as the turn of
   the line needs, the corners of a polygon about the member (line_turn.c): the first and the last
   side follow the line, the sides between keep their directions.  Links beside sliding nodes are
   tangents at the line's radius, and are guarded like all links.

   Sliding is measured at the tangents, not at the corner: as the line is laid round, a corner moves
   on and line flows through the corner without sliding.  Sideways a corner slides across the line's
   own direction, at any angle to the member; a part of this motion that goes round the member is
   undone in the next step and does not count as sliding.

   The place of a corner depends on the future places of its neighbours, and theirs on the corner: a
   stiff line pulled by a corner too far out turns more, and the corner goes farther out.  A corner
   moving round between its links at a constant distance from the axis leaves the length of the line
   unchanged at first order.  Therefore a corner goes half the wanted way round in a step, but moves
   out and in slowly.

   Nodes come and go in line_rebend.c.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define TURNED 0.3  /* radians: a corner that turns back by more is none */
#define HALFWAY 0.5 /* of the way to where it should be does a corner go in a step, ... */
#define FOLLOWS 1.0 /* m/s: ... but no faster; ... */
#define RISES 0.3   /* m/s: nor does one come out faster, as the line turns more */
#define EVENING 0.5 /* radians/s: how fast a corner that turns too much shares with the next */

enum
{
  KNOTTED = 4 /* links: nor may the line touch itself so near */
};

/* A node that was held in the last step and is still.  */
typedef struct corner
{
  bt__contact anchor;
  int node;
  bt__edge edge;
  bt__turn turn;
  bt_vec3 lag, place; /* m: what it has yet to go round; where it is held */
  double away;        /* m from the axis, but for LAG */
  int single;         /* true: the only corner about a member that is thin */
} corner;

typedef struct corners
{
  int n;
  corner at[BT__BENTS];
} corners;

int
bt__bend_node (const bt__line_job *k, double from_end)
{
  double near = BT__SAME * (1 + k->w->from_end[0]);
  for (int i = 1; i < k->links; i++)
    if (fabs (k->w->from_end[i] - from_end) <= near)
      return i;
  return -1;
}

/* ---- Where they are held in this step ---- */

static void
gather (bt__line_job *k, corners *s)
{
  s->n = 0;
  for (int q = 0; q < k->olds && s->n < BT__BENTS; q++)
    {
      bt__contact *a = k->w->old + q;
      corner *c = s->at + s->n;
      c->node = a->bent ? bt__bend_node (k, a->from_end) : -1;
      if (c->node < 0 || !bt__edge_again (k, a, k->x[c->node], &c->edge))
        continue;
      c->anchor = *a;
      c->anchor.bent = c->edge.round ? BT__BENT_ROUND : BT__BENT_EDGE;
      s->n++;
    }
}

/* True if corner C and the next are of one member.  */
static int
goes_on (const corners *s, int c)
{
  return c >= 0 && c + 1 < s->n && s->at[c].node + 1 == s->at[c + 1].node
         && bt__bend_goes_on (&s->at[c].anchor, &s->at[c + 1].anchor);
}

/* True if corner C is the only one about a member that is thin.  */
static int
is_single (const bt__line_job *k, const corners *s, int c)
{
  return bt__edge_is_thin (k, s->at[c].edge.radius) && !goes_on (s, c - 1) && !goes_on (s, c);
}

/* The expected place of node I, a neighbour of C. Of a single corner the present place is taken:
   the turn depends little on the neighbour, but the distance from the axis depends on the turn.  */
static bt_vec3
expected (const bt__line_job *k, const corner *c, int i)
{
  return !c->single && bt__distance (k->X[i], k->x[i]) <= BT__LINE_FORETOLD ? k->X[i] : k->x[i];
}

static int
find_corner_turn (const bt__line_job *k, corners *s, int c)
{
  corner *q = s->at + c;
  const bt_vec3 p[]
      = { expected (k, q, q->node - 1), expected (k, q, q->node), expected (k, q, q->node + 1) };
  int is_last = !goes_on (s, c), is_first = !goes_on (s, c - 1);
  int turns = bt__turn_find (k, &q->edge, p, is_first ? NULL : &q[-1].anchor.after,
                             is_last ? NULL : &q->anchor.after, &q->turn);
  return turns && q->turn.angle > (is_first && is_last ? 0 : -TURNED);
}

/* Turn the side after corner C if a corner of the side turns by so much that another would come:
   the two corners share the turn.  Else the corner that comes would stay without a turn, and go. */
static void
even_out (const bt__line_job *k, corners *s, int c)
{
  corner *a = s->at + c, *b = a + 1;
  double more = b->turn.angle - a->turn.angle;
  if (fmax (a->turn.angle, b->turn.angle) <= BT__TURN_MOST)
    return;
  double by = fmin (fmax (0.25 * more, -EVENING * k->h), EVENING * k->h);
  bt_vec3 n = a->anchor.after;
  a->anchor.after = bt__axpy (bt__scale (cos (by), n), sin (by), bt__cross (a->edge.axis, n));
}

static int
is_by_link (uint32_t i, uint32_t j)
{
  return i < j + KNOTTED && j < i + KNOTTED;
}

/* True if anything but obstacle ID is nearer to link J than WAY.  */
static int
is_disturbed (const bt__line_job *k, uint32_t j, int64_t id, double way)
{
  const bt__near *near = bt__line_near (k, j);
  for (uint32_t i = 0; i < k->w->watch[j].found; i++)
    if (near[i].w.distance < way
        && (near[i].link || bt__line_scene (k, near + i)->object[near[i].object].id != id))
      return 1;
  for (int i = 0; i < k->w->self.pairs; i++)
    {
      const bt__self_pair *p = k->w->self.pair + i;
      int is_by = is_by_link (p->i, j) || (p->strand < 0 && is_by_link (p->j, j));
      if (is_by && p->w.distance < 2 * way)
        return 1;
    }
  return 0;
}

int
bt__bend_is_calm (const bt__line_job *k, int64_t node, int64_t id, double share)
{
  double way = share * (k->config->radius + k->margin);
  return !is_disturbed (k, (uint32_t)node, id, way)
         && !is_disturbed (k, (uint32_t)node - 1, id, way);
}

int
bt__bend_is_wedged (const bt__line_job *k, int64_t node, double share)
{
  return bt__line_is_wedged (k, (uint32_t)node, share)
         || bt__line_is_wedged (k, (uint32_t)node - 1, share);
}

/* Choose the corners to be held.  With something else near a round member, half-spaces serve better
   than sliding nodes, and all corners of the member are given up.  The same holds between two
   members: the other member would bear against a node that cannot give way.  */
static void
choose (const bt__line_job *k, const corners *s, int *may)
{
  for (int c = 0; c < s->n; c++)
    may[c] = bt__edge_is_thin (k, s->at[c].edge.radius)
                 ? !bt__bend_is_wedged (k, s->at[c].node, 1)
                 : !k->plain && bt__bend_is_calm (k, s->at[c].node, s->at[c].anchor.object, 1);
  for (int c = 0; c + 1 < s->n; c++)
    may[c + 1] &= may[c] || !goes_on (s, c);
  for (int c = s->n - 2; c >= 0; c--)
    may[c] &= may[c + 1] || !goes_on (s, c);
}

/* V, shorter by BY.  */
static bt_vec3
shortened (bt_vec3 v, double by)
{
  double size = bt__norm (v);
  return size > by ? bt__scale (1 - by / size, v) : bt__vec (0, 0, 0);
}

/* The remaining way round of corner C to its wanted place.  The wanted place depends on predicted
   neighbours, and the neighbours move with the corner: C goes half the way in a step.  */
static bt_vec3
corner_lag (const bt__line_job *k, const corner *c)
{
  if (c->single)
    return bt__vec (0, 0, 0);
  bt_vec3 should = bt__axpy (c->turn.centre, c->anchor.away, c->turn.normal);
  bt_vec3 lag = bt__off_axis (c->edge.axis, bt__sub (c->anchor.held, should));
  return shortened (lag, fmin (HALFWAY * bt__norm (lag), FOLLOWS * k->h));
}

/* How far from the axis it is held.  */
static double
held_distance (const bt__line_job *k, const corner *c)
{
  double more = c->turn.reach - c->anchor.away;
  if (c->single)
    return c->turn.reach;
  return c->anchor.away + fmin (fmax (more, -BT__LINE_CREEP * k->h), RISES * k->h);
}

static void
place (const bt__line_job *k, corner *c)
{
  c->lag = corner_lag (k, c);
  c->away = held_distance (k, c);
  c->place = bt__add (bt__axpy (c->turn.centre, c->away, c->turn.normal), c->lag);
  double along = bt__dot (c->edge.axis, bt__sub (k->x[c->node], c->place));
  c->place = bt__axpy (c->place, along, c->edge.axis); /* along the member it starts where it is */
}

/* Where the next node on SIDE (-1, 1) of corner C will be.  */
static bt_vec3
beside (const bt__line_job *k, const corners *s, int c, int side)
{
  return goes_on (s, side > 0 ? c : c - 1) ? s->at[c + side].place
                                           : expected (k, s->at + c, s->at[c].node + side);
}

/* The way of corner C across the axis in the step, as the line is laid round: of the wanted place,
   for the line is measured along the arc wherever the corner is held.  */
static bt_vec3
gone_round (const corner *c)
{
  bt_vec3 to = bt__sub (c->place, c->lag), from = bt__sub (c->anchor.held, c->anchor.lag);
  return bt__off_axis (c->edge.axis, bt__sub (to, from));
}

bt_vec3
bt__bend_aside (const bt__line_job *k, const bt__edge *e, bt_vec3 normal, bt_vec3 along)
{
  if (bt__edge_is_thin (k, e->radius))
    return e->axis;
  bt_vec3 aside = bt__unit_or (bt__cross (normal, along), e->axis);
  return bt__dot (aside, e->axis) < 0 ? bt__scale (-1, aside) : aside;
}

/* The part round the axis of the slide ASIDE in the last step; the corner goes back by the same way
   along the line.  */
static bt_vec3
slid_round (const bt__line_job *k, const corner *c, bt_vec3 aside)
{
  double slid = bt__dot (aside, bt__sub (k->x[c->node], c->anchor.held));
  return c->single ? bt__vec (0, 0, 0) : bt__off_axis (c->edge.axis, bt__scale (slid, aside));
}

/* The surplus of the chord on SIDE of corner C at the end of the step, m.  */
static double
corner_round (const bt__line_job *k, const corners *s, int c, int side)
{
  const corner *q = s->at + c;
  double angle = goes_on (s, side > 0 ? c : c - 1) ? q[side].turn.angle : NAN;
  return bt__turn_round (k, &q->edge, &q->turn, q->place, beside (k, s, c, side), angle);
}

static void
hold (bt__line_job *k, const corners *s, int i)
{
  const corner *c = s->at + i;
  int at = k->bents++;
  bt_vec3 none = { 0, 0, 0 }, a_side = bt__unit_or (bt__sub (c->place, beside (k, s, i, -1)), none),
          b_side = bt__unit_or (bt__sub (beside (k, s, i, 1), c->place), none);
  double bears = bt__dot (c->turn.normal, bt__sub (a_side, b_side));
  double turn = 2 * asin (fmin (0.5 * fmax (bears, 0), 1));
  double mu = bt__line_friction (k, c->anchor.object);
  bt_vec3 gone = gone_round (c), sum = bt__add (a_side, b_side);
  bt_vec3 aside = bt__bend_aside (k, &c->edge, c->turn.normal, sum);
  gone = bt__sub (gone, slid_round (k, c, aside));
  k->w->bent[at] = (bt__dynamic_bent){ .node = c->node,
                                       .at = c->place,
                                       .axis = aside,
                                       .normal = c->turn.normal,
                                       .stiffness = bt__line_stiffness (k, c->node),
                                       .wrap = c->turn.angle > 0 ? mu * turn : 0,
                                       .friction = mu,
                                       .slip = BT__LINE_SLIP,
                                       .drag = c->anchor.drag + 0.5 * bt__dot (sum, gone),
                                       .side = c->anchor.side,
                                       .flow = c->anchor.flow * k->h,
                                       .load = c->anchor.load };
  bt__contact *a = k->w->bend + at;
  *a = c->anchor;
  a->held = c->place;
  a->away = c->away;
  a->lag = c->lag;
  a->axis = c->edge.axis;
  a->point = c->edge.point;
  a->normal = c->edge.normal;
  a->thick = c->edge.radius;
  a->before = goes_on (s, i - 1) ? 0 : corner_round (k, s, i, -1);
  a->beyond = corner_round (k, s, i, 1);
  k->w->gain[at][0] = a->before - c->anchor.before;
  k->w->gain[at][1] = a->beyond - c->anchor.beyond;
  a->span = (c->edge.radius + k->config->radius) * fmax (c->turn.angle, 0);
}

void
bt__line_bends (bt__line_job *k)
{
  corners s;
  int may[BT__BENTS];
  k->bents = 0;
  gather (k, &s);
  for (int c = 0; c < s.n; c++)
    s.at[c].single = is_single (k, &s, c);
  for (int c = 0; c < s.n; c++)
    find_corner_turn (k, &s, c);
  for (int c = 0; c < s.n; c++)
    if (goes_on (&s, c))
      even_out (k, &s, c);
  choose (k, &s, may);
  for (int c = 0; c < s.n; c++)
    {
      may[c] &= find_corner_turn (k, &s, c);
      place (k, s.at + c);
    }
  for (int c = 0; c < s.n; c++)
    if (may[c])
      hold (k, &s, c);
  for (int q = 0; q < k->olds; q++) /* taken, or gone */
    k->w->old[q].state = k->w->old[q].bent ? -1 : k->w->old[q].state;
  bt__line_round (k);
  bt__dynamic_bend (k->kernel, k->w->bent, k->bents);
}

int
bt__line_is_laid_round (const bt__line_job *k)
{
  for (int i = 0; i < k->bents; i++)
    if (!bt__edge_is_thin (k, k->w->bend[i].thick))
      return 1;
  return 0;
}

int
bt__line_is_bent_about (const bt__line_job *k, int q)
{
  const bt__line_row *of = k->w->of + q;
  for (int i = 0; i < k->bents; i++)
    {
      const bt__contact *a = k->w->bend + i;
      int64_t node = k->w->bent[i].node;
      if ((int64_t)of->link != node && (int64_t)of->link != node - 1)
        continue;
      if (a->object != of->id || a->mover != (int64_t)of->mover - 1)
        continue;
      bt_vec3 away = bt__sub (of->point, bt__axpy (a->point, -a->thick, a->normal));
      if (bt__norm (bt__off_axis (a->axis, away)) < a->thick + 2 * k->config->radius)
        return 1;
    }
  return 0;
}
