/* Sliding nodes come and go where a line runs about something.

   A node comes where a link bears (line_hold.c).  Where the line turns by too much at a corner of a
   member, the next corner is placed on the side that follows the line, at the touching point: the
   line does not turn there yet, and keeps its shape.  A corner goes the same way when the line no
   longer turns at the corner, and all corners go when none bears.

   As line flows, neighbouring nodes pass from side to side of a sliding node: each is taken out
   before arriving at the turn and put in behind the turn.  A node is taken out only if the way of
   the links to their new place is clear; else the node waits.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_bend.h"

#define PASS 0.25     /* of a piece: a node nearer to where the line touches passes, ... */
#define FORESIGHT 2.5 /* steps ... or one that is there so soon, ... */
#define CLEAR 2.2     /* times the line's radius: ... or is no farther from touching */
#define SPLIT 1.6     /* of a piece: an interval so long is split; ... */
#define LEAST 0.06    /* ... with so little left the line runs over the edge as it can, ... */
#define INSIDE 0.8    /* of the way to where it touches: ... or with so little */
#define SPARE 1.3     /* of a piece: a node between two intervals no longer than this is spare */
#define BACK 0.02     /* radians: how far a corner turns back to go */

enum
{
  FAILURES = 2, /* steps on end that are not solved: too many */
  IDLE = 6      /* steps without load, after which a corner goes where the line hardly turns */
};

/* Neighbouring nodes found to belong to the same member: the side between stays.  */
static void
join (const bt__line_job *k, bt__sliding *s)
{
  for (int q = 0; q < s->n; q++)
    {
      bt__contact *a = s->anchor + q, *b = a + 1;
      bt_vec3 none = { 0, 0, 0 };
      if (q + 1 == s->n || s->node[q] + 1 != s->node[q + 1] || a->object != b->object)
        {
          if (bt__dot (a->after, a->after) > 0)
            bt__sliding_change (s);
          a->after = none;
        }
      else if (a->bent == BT__BENT_ROUND && b->bent == BT__BENT_ROUND && !bt__sliding_goes_on (s, q)
               && bt__dot (a->axis, b->axis) > 0)
        {
          a->after = bt__turn_normal (a->axis, bt__dynamic_x (k->d) + s->node[q]);
          bt__sliding_change (s);
        }
    }
}

/* ---- Corners of a member that come and go ---- */

/* The turn at bend Q as it is now, computed once for as long as nodes and sides stay.  */
static const bt__turn *
sliding_turn (const bt__line_job *k, bt__sliding *s, int q, bt__edge *e)
{
  const bt__contact *a = s->anchor + q;
  *e = (bt__edge){ a->axis, a->point, a->normal, a->thick, 0, a->bent == BT__BENT_ROUND };
  if (!(s->known >> q & 1))
    bt__turn_find (k, e, bt__dynamic_x (k->d) + s->node[q] - 1,
                   bt__sliding_goes_on (s, q - 1) ? &s->anchor[q - 1].after : NULL,
                   bt__sliding_goes_on (s, q) ? &a->after : NULL, s->turn + q);
  s->known |= (uint64_t)1 << q;
  return s->turn + q;
}

/* Take out the corner at either end of a member's where the line turns no more.  */
static void
take_corner (bt__line_job *k, bt__sliding *s, int q)
{
  bt__edge e;
  if (bt__sliding_goes_on (s, q - 1) == bt__sliding_goes_on (s, q))
    return;
  double least = s->anchor[q].age < IDLE ? -BACK : BACK;
  if (sliding_turn (k, s, q, &e)->angle > least)
    return;
  int64_t node = s->node[q];
  bt__sliding_lose (s, q);
  if (!bt__sliding_take_out (k, s, node))
    bt__sliding_let_go (k, node);
}

/* How far bend Q has to go round, and its distance from the axis, to *AWAY.  */
static bt_vec3
sliding_lag (const bt__line_job *k, bt__sliding *s, int q, double *away)
{
  bt__edge e;
  bt_vec3 x = bt__dynamic_x (k->d)[s->node[q]];
  const bt__turn *t = sliding_turn (k, s, q, &e);
  *away = bt__dot (t->normal, bt__sub (x, t->centre));
  return bt__off_axis (e.axis, bt__sub (x, bt__axpy (t->centre, *away, t->normal)));
}

static int
is_new (const bt__sliding *s, int q)
{
  return !isfinite (s->anchor[q].lag.x);
}

/* True if bend Q is new, and too far from where it should be.  */
static int
is_behind (const bt__line_job *k, bt__sliding *s, int q)
{
  double away;
  return is_new (s, q) && !bt__sliding_is_single (k, s, q)
         && bt__norm (sliding_lag (k, s, q, &away)) > BT__BEND_BEHIND * away;
}

/* A node that is newly held starts from where it is.  */
static void
settle (const bt__line_job *k, bt__sliding *s, int q)
{
  bt__contact *a = s->anchor + q;
  if (!is_new (s, q))
    return;
  a->held = bt__dynamic_x (k->d)[s->node[q]];
  a->lag = sliding_lag (k, s, q, &a->away);
}

/* Hold NODE beside a corner of the same member, as A says that corner is.  A corner that would go
   at once is not held, and nothing has happened: a line at rest would be stirred up in every step.
 */
static int
hold_beside (bt__line_job *k, bt__sliding *s, bt__contact *a, int64_t node)
{
  a->load = a->work = a->step_work = a->before = a->beyond = 0;
  a->force = bt__vec (0, 0, 0);
  a->age = 0;
  a->lag = bt__vec (INFINITY, 0, 0);
  int q = bt__sliding_add (s, a, node);
  if (!bt__sliding_runs_across (k, node, a->axis) || is_behind (k, s, q))
    {
      bt__sliding_lose (s, q);
      return 0;
    }
  bt__sliding_take_hold (k, node, a->axis);
  settle (k, s, q);
  return 1;
}

/* All that are new; one that goes changes how the line runs at the others.  */
static void
settle_all (bt__line_job *k, bt__sliding *s)
{
  for (int q = 0; q < s->n; q++)
    if (is_behind (k, s, q))
      {
        bt__sliding_drop (k, s, q);
        q = -1;
      }
  for (int q = 0; q < s->n; q++)
    settle (k, s, q);
}

/* Let another corner come on SIDE (-1, 1) of bend Q, where the line touches.  */
static int
add_corner (bt__line_job *k, bt__sliding *s, int q, int side, const bt__turn *t)
{
  int64_t node = s->node[q], j = side > 0 ? node : node - 1;
  const bt_vec3 *x = bt__dynamic_x (k->d) + j;
  double share = t->zone / fmax (bt__distance (x[0], x[1]), 1e-9);
  if (bt__sliding_goes_on (s, side > 0 ? q : q - 1) || !(share < 1 - BT__BEND_CROWDED)
      || s->n >= BT__BENTS || k->d->n >= k->d->n_max)
    return 0;
  bt__sliding_put_in (k, s, j, side > 0 ? share : 1 - share, j);
  bt__contact a = s->anchor[q];
  if (side > 0)
    s->anchor[q].after = t->after;
  else
    a.after = t->before;
  return hold_beside (k, s, &a, j + 1);
}

/* True if bend Q turns by T, and that is more than a corner of its kind does.  */
static int
turns_too_much (const bt__line_job *k, const bt__sliding *s, int q, const bt__turn *t)
{
  return bt__sliding_is_single (k, s, q)
             ? t->angle > BT__TURN_SINGLE
                   || (t->angle > 0 && !bt__edge_is_thin (k, t->zone - k->config->radius))
             : t->angle > BT__TURN_MOST;
}

static void
grow (bt__line_job *k, bt__sliding *s, int q)
{
  bt__edge e;
  bt__turn t = *sliding_turn (k, s, q, &e);
  if (!e.round || !turns_too_much (k, s, q, &t))
    return;
  const double *rest = bt__dynamic_rest (k->d) + s->node[q];
  int longer = rest[0] >= rest[-1] ? 1 : -1;
  if (!add_corner (k, s, q, longer, &t))
    add_corner (k, s, q, -longer, &t);
}

/* A node next to bend Q on SIDE cannot pass: it is on the member already, and is held too.  */
static int
extend (bt__line_job *k, bt__sliding *s, int q, int side)
{
  int64_t i = s->node[q] + side;
  bt__contact a = s->anchor[q];
  const bt_vec3 *x = bt__dynamic_x (k->d) + i - 1;
  if (a.bent != BT__BENT_ROUND || i < 1 || i >= k->d->n || s->n >= BT__BENTS)
    return 0;
  bt_vec3 before = bt__turn_normal (a.axis, x), after = bt__turn_normal (a.axis, x + 1);
  if (!(bt__dot (a.axis, bt__cross (before, after)) > BT__BEND_TURNS))
    return 0;
  if (side > 0)
    s->anchor[q].after = before;
  else
    a.after = after;
  return hold_beside (k, s, &a, i);
}

/* ---- The line along the arc ---- */

/* The surplus of the chords before and after bend Q to OUT, m: none at a sharp edge.  */
static void
find_rounds (const bt__line_job *k, bt__sliding *s, int q, double out[2])
{
  const bt_vec3 *x = bt__dynamic_x (k->d) + s->node[q];
  bt__edge e, unused;
  out[0] = out[1] = 0;
  if (s->anchor[q].bent != BT__BENT_ROUND)
    return;
  const bt__turn *t = sliding_turn (k, s, q, &e);
  double next = bt__sliding_goes_on (s, q) ? sliding_turn (k, s, q + 1, &unused)->angle : NAN;
  out[0] = bt__sliding_goes_on (s, q - 1) ? 0 : bt__turn_round (k, &e, t, x[0], x[-1], NAN);
  out[1] = bt__turn_round (k, &e, t, x[0], x[1], next);
}

/* Note the surplus at all bends, before nodes come and go.  */
static void
note_rounds (const bt__line_job *k, bt__sliding *s)
{
  for (int q = 0; q < s->n; q++)
    find_rounds (k, s, q, s->was[q]);
  s->changed = 0;
}

/* Add the change of surplus since note_rounds, with the line in place.  */
static void
renew_rounds (const bt__line_job *k, bt__sliding *s)
{
  for (int q = 0; q < s->n && s->changed; q++)
    {
      double now[2];
      find_rounds (k, s, q, now);
      s->anchor[q].before += now[0] - s->was[q][0];
      s->anchor[q].beyond += now[1] - s->was[q][1];
    }
}

/* ---- Nodes that pass ---- */

/* Let the next nodes on SIDE (-1, 1) of bend Q pass if nearer than NEED, and put in a node on a
   long interval: more than would pass if it ran in as it may run out, MOST.  Zero if they cannot
   pass and no more than LEFT m is left.  */
static int
pass_on (bt__line_job *k, bt__sliding *s, int q, int side, double need, double most, double left)
{
  double piece = k->d->piece;
  for (int i = 0; i < 4; i++)
    {
      int64_t node = s->node[q], next = node + side;
      double rest = bt__dynamic_rest (k->d)[side > 0 ? node : node - 1];
      if (rest >= need)
        break;
      if (bt__sliding_has (s, next))
        return rest > left;
      if (!bt__sliding_take_out (k, s, next))
        return extend (k, s, q, side) || rest > left;
    }
  int64_t node = s->node[q], j = side > 0 ? node : node - 1;
  double rest = bt__dynamic_rest (k->d)[j];
  if (rest > fmax (SPLIT * piece, most + 1.1 * piece) && k->d->n < k->d->n_max)
    bt__sliding_put_in (k, s, j, side > 0 ? (rest - piece) / rest : piece / rest,
                        side > 0 ? j + 1 : j);
  return 1;
}

/* Let line flow from the interval on one side of bend Q into the interval on the other side.  Zero
   if nodes cannot pass and nothing is left.  */
static int
pass_nodes (bt__line_job *k, bt__sliding *s, int q)
{
  bt__edge e;
  double flow = s->anchor[q].flow * k->h, piece = k->d->piece, size = fabs (flow);
  double zone = sliding_turn (k, s, q, &e)->zone, r = k->config->radius;
  double clear = zone + sqrt (2 * (e.radius + r) * CLEAR * r);
  int passed = 1;
  for (int side = -1; side < 2; side += 2)
    {
      int comes = side * flow < 0;
      double most = clear + fmax (PASS * piece, FORESIGHT * size), need = comes ? most : clear;
      double left = fmax (LEAST * piece + (comes ? size : 0), INSIDE * zone);
      if (!bt__sliding_goes_on (s, side > 0 ? q : q - 1))
        passed &= pass_on (k, s, q, side, need, most, left);
    }
  return passed;
}

/* Take out one node that nothing needs any more.  A mesh that keeps to an error judges that
   itself: it wants short intervals where the line bends.  */
static void
take_spare (bt__line_job *k, bt__sliding *s)
{
  const double *rest = bt__dynamic_rest (k->d);
  if (k->in->mesh.error > 0)
    return;
  for (int64_t i = 2; i < k->d->n; i++)
    if (rest[i - 1] + rest[i] < SPARE * k->d->piece && !bt__sliding_has (s, i)
        && !bt__sliding_has (s, i - 1) && !bt__sliding_has (s, i + 1)
        && bt__sliding_take_out (k, s, i))
      return;
}

/* Half-spaces get a line out of places where held nodes hold it: Nodes about round members go when
   steps are not solved, all sliding nodes when a step was cut.  */
static void
drop_failed (bt__line_job *k, bt__sliding *s)
{
  for (int q = s->n - 1; q >= 0; q--)
    {
      int64_t *failed = &s->anchor[q].unsolved;
      *failed = k->unsolved ? *failed + 1 : 0;
      if (k->report->truncated || (*failed >= FAILURES && !bt__sliding_is_single (k, s, q)))
        bt__sliding_drop (k, s, q);
    }
}

static void
let_go_idle (bt__line_job *k)
{
  for (int q = 0; q < k->bents; q++)
    if (!bt__bend_bears (k, q))
      bt__sliding_let_go (k, k->w->bent[q].node);
}

void
bt__line_rebend (bt__line_job *k)
{
  int no_bends = k->config->hook && k->config->hook->no_bends;
  bt__sliding s;
  bt__bend_place p;
  bt__sliding_show (k, 0, 0);
  let_go_idle (k);
  bt__sliding_measure (k);
  bt__sliding_gather (k, &s);
  note_rounds (k, &s);
  drop_failed (k, &s);
  /* A new one changes the numbers of the rows' nodes.  A cut step is no solution either, but a line
     hooked over a thin member is cut in every step until a node lets the line slide.  */
  p.node = no_bends || (k->unsolved && !k->report->truncated) ? -1 : 0;
  while (p.node >= 0 && bt__sliding_find (k, &s, &p))
    bt__sliding_hold (k, &s, &p);
  join (k, &s);
  settle_all (k, &s);
  for (int q = s.n - 1; q >= 0; q--)
    take_corner (k, &s, q);
  for (int q = s.n - 1; q >= 0; q--)
    grow (k, &s, q);
  for (int q = s.n - 1; q >= 0; q--)
    if (!pass_nodes (k, &s, q))
      bt__sliding_drop (k, &s, q);
  take_spare (k, &s);
  renew_rounds (k, &s);
  bt__sliding_even_rounds (k, &s);
  bt__sliding_measure (k);
  bt__sliding_scatter (k, &s);
}
