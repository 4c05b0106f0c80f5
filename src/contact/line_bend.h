/* Sliding nodes: shared by the files on lines that run about an edge, a wire or a round member.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_LINE_BEND_H
#define BT_CONTACT_LINE_BEND_H

#include "contact/line_job.h"

/* ---- What the line runs about (line_edge.c) ---- */

typedef struct bt__edge
{
  bt_vec3 axis, point, normal; /* unit; on the obstacle; unit, to the line */
  double radius, distance;     /* m: of the edge; of the line's axis from POINT */
  int round;                   /* true: the side of a cylinder or a capsule */
} bt__edge;

/* The edge of the standing obstacle ID about P, to E; zero if there is none, or too round a one. */
int bt__edge_find (const bt__line_job *k, int64_t id, bt_vec3 p, bt__edge *e);

/* The edge that A knows, as it is about P; zero if there is none.  */
int bt__edge_again (const bt__line_job *k, const bt__contact *a, bt_vec3 p, bt__edge *e);

/* True if the obstacle of row OF has no edges that count; cheap.  */
int bt__edge_has_none (const bt__line_job *k, const bt__line_row *of);

/* True if an edge of RADIUS is thin enough against the line's links for a single node where the
   line turns by a right angle.  */
int bt__edge_is_thin (const bt__line_job *k, double radius);

/* ---- How it runs about that (line_turn.c) ---- */

/* The turn of the line at a node: along a tangent of the edge to the node, along another tangent
   from the node.  */
typedef struct bt__turn
{
  bt_vec3 before, after; /* unit, across the axis: from it to where the tangents touch */
  bt_vec3 centre, at;    /* m: the edge's middle there; where they meet */
  bt_vec3 normal;        /* unit, across the axis, from the one to the other */
  double reach;          /* m between them */
  double angle;          /* radians about the axis, positive the way the line winds */
  double turn;           /* radians in space */
  double zone;           /* m from AT along a tangent to where it touches */
  bt_vec3 sliding;       /* half the sum of the line's directions: how much of a move of AT it is */
} bt__turn;

/* The turn at node 1 of P about E; *BEFORE, *AFTER: the normal there if its other end is held too,
   else NULL.  Zero if the line does not run about it: lies along it, or turns away.  */
int bt__turn_find (const bt__line_job *k, const bt__edge *e, const bt_vec3 *p,
                   const bt_vec3 *before, const bt_vec3 *after, bt__turn *t);

/* The surplus, m, of the chord from a node at X, where the line runs about E by T, to the next node
   on either side, at NEXT.  ANGLE is the turn at NEXT if held at the same member, else NAN.  */
double bt__turn_round (const bt__line_job *k, const bt__edge *e, const bt__turn *t, bt_vec3 x,
                       bt_vec3 next, double angle);

/* The unit normal of the tangent from U, m across AXIS, to the circle of radius OUT: of the line
   that comes from U, SIGN 1, or goes to U, SIGN -1.  The direction of U if U is not outside.  */
bt_vec3 bt__turn_tangent (bt_vec3 axis, bt_vec3 u, double out, double sign);

/* The angle from A to B, both across AXIS, radians.  */
static inline double
bt__turn_angle (bt_vec3 axis, bt_vec3 a, bt_vec3 b)
{
  return atan2 (bt__dot (axis, bt__cross (a, b)), bt__dot (a, b));
}

/* Of the distance from the axis: the farthest that a new corner may have to go round.  */
#define BT__BEND_BEHIND 0.1
#define BT__TURN_MOST 1.05    /* radians: of a corner that is not single; ... */
#define BT__TURN_SINGLE 2.0   /* ... of a single one, about a thin member; for more another comes */
#define BT__TURN_ALONG 0.9    /* product of line and edge: more, and the line lies along it */
#define BT__BEND_TURNS 0.05   /* radians: a node that turns less is no corner, nor one needed */
#define BT__BEND_CROWDED 0.01 /* of an interval: nearer to a node no other is bent */

/* The normal of the interval from P[0] to P[1] about an axis.  */
static inline bt_vec3
bt__turn_normal (bt_vec3 axis, const bt_vec3 *p)
{
  bt_vec3 none = { 0, 0, 0 };
  return bt__cross (bt__unit_or (bt__off_axis (axis, bt__sub (p[1], p[0])), none), axis);
}

/* True if nodes A and B, the next, are held at the same member, the interval between them along
   a tangent.  */
static inline int
bt__bend_goes_on (const bt__contact *a, const bt__contact *b)
{
  return a->bent == BT__BENT_ROUND && b->bent == BT__BENT_ROUND && a->object == b->object
         && bt__dot (a->after, a->after) > 0;
}

/* ---- Nodes that are held (line_bend.c) ---- */

/* The node that is FROM_END from the end, or -1.  */
int bt__bend_node (const bt__line_job *k, double from_end);

/* True if nothing but obstacle ID is near the links of NODE, nor the line itself; SHARE: how
   near, of what keeps it from being held about a round member.  */
int bt__bend_is_calm (const bt__line_job *k, int64_t node, int64_t id, double share);

/* True if one of the links of NODE is in a crotch, see bt__line_is_wedged.  */
int bt__bend_is_wedged (const bt__line_job *k, int64_t node, double share);

/* The unit direction in which a node at E slides sideways where the line, pressed on against
   NORMAL, runs along ALONG: across the line and not along the member, or the held place would bear
   a force drawing the line obliquely over the member.  At a thin member along the member, or the
   node would leave the member.  */
bt_vec3 bt__bend_aside (const bt__line_job *k, const bt__edge *e, bt_vec3 normal, bt_vec3 along);

/* line_bend_keep.c: true if the I-th sliding node bears, or a corner of the same member next to it.
 */
int bt__bend_bears (const bt__line_job *k, int i);

/* ---- Nodes that come and go (line_rebend.c) ---- */

/* The nodes held, in order, while nodes come and go; their anchors are not among the others.  */
typedef struct bt__sliding
{
  int n;
  bt__contact anchor[BT__BENTS];
  int64_t node[BT__BENTS];
  double was[BT__BENTS][2]; /* m: surplus before and after the node, as of before any change */
  bt__turn turn[BT__BENTS]; /* at the present nodes, kept by line_rebend.c */
  uint64_t known;           /* bit q: TURN[q] is computed */
  int changed;              /* true: nodes or sides are others than those WAS is of */
} bt__sliding;

_Static_assert(BT__BENTS <= 8 * sizeof (((bt__sliding *)0)->known), "a bit for each node");

/* Note that nodes, or the directions of sides, have changed.  */
static inline void
bt__sliding_change (bt__sliding *s)
{
  s->known = 0;
  s->changed = 1;
}

/* line_bend_list.c: take the sliding nodes out of the contacts, or put them back in order; move the
   contact of constraint Q to A, or return 0 if Q has none.  */
void bt__sliding_gather (bt__line_job *k, bt__sliding *s);
void bt__sliding_scatter (bt__line_job *k, bt__sliding *s);
int bt__sliding_take_anchor (bt__line_job *k, int q, bt__contact *a);

/* True if node I is held; if bend Q and the next are of one member; if bend Q is the only one
   there, and the member is thin.  */
int bt__sliding_has (const bt__sliding *s, int64_t i);
int bt__sliding_goes_on (const bt__sliding *s, int q);
int bt__sliding_is_single (const bt__line_job *k, const bt__sliding *s, int q);

/* Hold NODE too, as A says: return its place in the list; hold bend Q no more; the same, and let
   its node go.  */
int bt__sliding_add (bt__sliding *s, const bt__contact *a, int64_t node);
void bt__sliding_lose (bt__sliding *s, int q);
void bt__sliding_drop (bt__line_job *k, bt__sliding *s, int q);

/* Put a node at the share U of interval J's chord, see bt__dynamic_insert; node I was put in
   otherwise; take node I out if the way of its links to the chord is clear, else return 0.  */
void bt__sliding_put_in (bt__line_job *k, bt__sliding *s, int64_t j, double u, int64_t from);
void bt__sliding_came (bt__line_job *k, bt__sliding *s, int64_t i);
int bt__sliding_take_out (bt__line_job *k, bt__sliding *s, int64_t i);

/* line_round.c: hand over surplus between the chords of a wrap; the tensions stay.  */
void bt__sliding_even_rounds (bt__line_job *k, const bt__sliding *s);

/* Node I goes on with the line; stays, but for along AXIS.  */
void bt__sliding_let_go (bt__line_job *k, int64_t i);
void bt__sliding_take_hold (bt__line_job *k, int64_t i, bt_vec3 axis);

/* Show the line to a hook that looks, see bt__line_hook.  */
void bt__sliding_show (const bt__line_job *k, int64_t i, int by);

/* The nodes have changed: where they are along the line.  */
void bt__sliding_measure (bt__line_job *k);

/* Where a node is to be held: a row's edge, a node or -1 for a new one.  */
typedef struct bt__bend_place
{
  int row;
  int64_t node;
  bt__edge edge;
} bt__bend_place;

/* line_hold.c: find one more place, zero if there is none; hold the line there.  A new node changes
   the numbers of those that the rows know.  */
int bt__sliding_find (const bt__line_job *k, const bt__sliding *s, bt__bend_place *p);
void bt__sliding_hold (bt__line_job *k, bt__sliding *s, const bt__bend_place *p);

/* True if the links of node I run so far across AXIS that the node may become a corner: farther
   than a corner has to, or the corner would come and go.  */
int bt__sliding_runs_across (const bt__line_job *k, int64_t i, bt_vec3 axis);

#endif
