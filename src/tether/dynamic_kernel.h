/* What the rooms of the dynamic line share: one step's constants and its workspace.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_DYNAMIC_KERNEL_H
#define BT_TETHER_DYNAMIC_KERNEL_H

#if defined __SSE2__
#include <emmintrin.h>
#endif

#include "math/vec.h"
#include "math/wide.h"
#include "tether/dynamic.h"
#include "tether/dynamic_contact.h"

#define BT__SHARPEST 1.0 /* turn at a node, as a vector: none sharper thrusts more */

/* A symmetric 3 x 3 block.  */
typedef struct bt__sym
{
  double xx, xy, xz, yy, yz, zz;
} bt__sym;

typedef struct bt__full
{
  double m[3][3];
} bt__full;

/* Two numbers, vectors or blocks side by side, of two places that do not wait for each other:
   vectors of GNU C, on any machine.  Each half comes out as it would alone.  */
typedef double bt__pair __attribute__ ((vector_size (16)));
typedef int64_t bt__mask __attribute__ ((vector_size (16))); /* -1 yes, 0 no */

typedef struct bt__pair_vec
{
  bt__pair x, y, z;
} bt__pair_vec;

typedef struct bt__pair_sym
{
  bt__pair xx, xy, xz, yy, yz, zz;
} bt__pair_sym;

typedef struct bt__pair_full
{
  bt__pair m[3][3];
} bt__pair_full;

/* What is lumped at a node, beside the line.  */
typedef struct bt__extra
{
  double mass, weight, linear, quadratic; /* mass with added mass */
  double lift;                            /* N: buoyancy, which it has in the water alone */
  bt_vec3 force;
} bt__extra;

/* One interval of a step: what does not change while it is solved, and the present iterate.  */
typedef struct bt__link
{
  double rest, ka, zero; /* m, N/m, m: length of no tension */
  double thrust;         /* N: what bending pushes it together with, see dynamic_bend.c */
  double start;          /* m: length at the start */
  double tension;        /* N: of the line */
  bt_vec3 t;             /* unit tangent */
  double active;         /* 1 taut, 0 slack, -1 not known yet */
} bt__link;

/* One node of a step.  */
typedef struct bt__node
{
  double cell, wet;     /* m of line it stands for; of them under water */
  double level;         /* m: the surface above or below it, if it comes near to it */
  bt_vec3 v0, a0;       /* v = b0 (X - x) + v0, a = b0 v + a0 */
  bt_vec3 current, tau; /* of the water; unit tangent */
} bt__node;

/* One row of bending: w = sum of c[k] X[first + k] - d, energy k |w|^2 / 2.  */
typedef struct bt__bend
{
  int first, count;
  double k, c[3];
  bt_vec3 d;
} bt__bend;

/* A node whose layers may slip, see dynamic_slip.c.  */
typedef struct bt__slip
{
  int64_t node;
  bt__bend row;    /* of its turn, with the secant stiffness; no D */
  double k;        /* N m: stiffness of what sticks, for a turn */
  bt_vec3 tangent; /* at the start of the step */
  bt_vec3 turn;    /* by which its layers have slipped then, across TANGENT */
  bt_vec3 borne;   /* at the last iterate: the turn that its moment bears, m / k */
} bt__slip;

/* Four numbers side by side, anywhere.  */
typedef double bt__four __attribute__ ((vector_size (32), aligned (8)));

/* A^-1 K of one node, or of two side by side; of one in dynamic_lu.c, with A^-1 R.  */
typedef union bt__factors
{
  bt__full one;
  bt__pair_full two;
  bt__four rows[3];
} bt__factors;

/* A pivot: A = L D L^T with unit L; inverse D.  */
typedef struct bt__factor
{
  double l10, l20, l21, d0, d1, d2;
} bt__factor;

typedef struct bt__pair_factor
{
  bt__pair l10, l20, l21, d0, d1, d2;
} bt__pair_factor;

/* A pivot that is not symmetric: its rows in the order ROW are L U; inverses of the diagonal of U.
 */
typedef struct bt__lu
{
  double l10, l20, l21, u01, u02, u12, d0, d1, d2;
  int row[3];
} bt__lu;

typedef union bt__pivot
{
  bt__factor one;
  bt__pair_factor two;
  bt__lu lu;
} bt__pivot;

enum
{
  BT__CROWD = 6
};

/* What a node before and one after pass on when they are eliminated: K A^-1 K and K A^-1 R.  */
typedef struct bt__passed
{
  bt__pair_sym a;
  bt__pair_vec r;
} bt__passed;

/* The equation of a flow, an unknown of its sliding node: what the flow does in the equations of
   the nodes before, at and after, and what these do in its own, with the flows of the nodes before
   and after.  What friction along the edge gains by a newton of load, and what load the node loses
   by its place, if COUPLED.  Then, of dynamic_lu.c: the flow by the nodes at and after; by the next
   flow, and what the flow does in that one's equation.  */
typedef struct bt__flow
{
  int64_t node;
  bt_vec3 column[3], row[3]; /* N/m */
  double own, beside[2];     /* N/m */
  double right;              /* N: right-hand side */
  bt_vec3 gain, press;       /* 1, N/m */
  bt_vec3 by[2];
  double by_next, back;
} bt__flow;

struct bt__frame_line;
struct bt__twisted;

struct bt__dynamic_work
{
  int n_max, room;  /* intervals at most; that the arrays are made for */
  bt__asker *asker; /* of the iterations; or NULL */
  /* ---- of the step ---- */
  const bt__dynamic_input *in;
  int n, lo, hi;     /* unknown nodes LO to HI */
  int bends, lumped; /* rows of bending; true if any node has extras, ... */
  int slips;         /* nodes whose layers may slip */
  int bodies;        /* ... and of these more than a force */
  double b0, b1, b2;
  double ea, kn, kt, m, ma, weight; /* N, drag, mass and wet weight per metre */
  double lift;                      /* N/m: buoyancy */
  int surfaced;                     /* true: the line comes near to the surface, ... */
  int near_from, near_to;           /* ... no interval but these */
  double least;   /* m: an interval bears no tension below this stretch: 0, or with bending
                     stiffness minus infinity */
  double pushed;  /* N: the greatest compression in the geometric stiffness, see dynamic_bend.c */
  double stiffen; /* of ka: the least geometric stiffness, see safe */
  double rho;     /* N/m2: of the activity test, see prepare_links */
  double soft, inertia;        /* of ka, N/m2: what resists a change of length is the less */
  double tolerance;            /* m */
  double owed;                 /* m: line out, not in the chain, after the step */
  double given;                /* m: line that was drawn from the winch */
  const bt_vec3 *x;            /* positions at the start */
  const bt_vec3 *chord, *load; /* fourth-order parts, NULL if none */
  int is_set;                  /* true: the line has a natural curvature, see dynamic_set.c: */
  int twists;                  /* true: the directors turn about it, see dynamic_twist.c: */
  struct bt__twisted *twisted; /* ... the angles of a step */
  bt__constraint *row;         /* the caller's half-spaces, ... */
  int coupled;                 /* true: friction follows the loads within an iteration */
  int rows, pairs;             /* ... how many; and of these, how many bear on two places */
  bt__dynamic_hold *hold;      /* of the ends, NULL if none */
  bt__dynamic_bent *bent;      /* nodes about which the line runs, ... */
  int bents, flows;            /* ... how many; true if their flows are unknowns, ... */
  bt__flow flow[BT__BENTS];    /* ... with these equations */
  int rounded;                 /* true: a chord has a surplus, see bt__dynamic_round */
  /* ---- arrays ---- */
  bt_vec3 *X, *d, *rhs, *keep; /* iterate, update, right-hand side, spare */
  bt_vec3 *last;               /* among contacts: the update before */
  double *lam;
  bt_vec3 *natural; /* ... turns of nodes, ... */
  bt_vec3 *twist;   /* ... and forces on nodes, N, as last asked for */
  bt_vec3 *felt;    /* ... by tangents on the way to the forces, N m */
  double *crumple;  /* m: with bending stiffness, see dynamic_unfold.c */
  double *round;    /* m: surplus of the intervals, valid if ROUNDED */
  bt__link *link;
  bt__node *node;
  bt__extra *extra;
  uint8_t *kept;       /* flags of nodes, between steps */
  bt__sym *diag, *off; /* off-diagonal blocks are minus OFF */
  bt__factors *up;     /* eliminated: to the next node, ... */
  bt__full *up2;       /* ... and with bending to the one after it */
  bt__pivot *pivot;    /* of each, if it is to be solved again, ... */
  bt__factor middle;   /* ... and where both ways meet */
  bt__bend *bend;
  double *bend_diag, *bend_off, *bend_far;
  bt__slip *slip;
  bt_vec3 *whole, *spare; /* of what is tried */
  bt_vec3 *crowd;         /* BT__CROWD vectors of all nodes: of what is solved for pairs */
  double flowed;          /* m: the most that a flow changed in the last iteration */
  bt__four (*far)[3];     /* of dynamic_lu.c: as UP2; with pairs, the blocks from a node ... */
  bt__four (*down)[3];    /* ... to the one before */
  int64_t *first_row;     /* 1 + the first row of each node, or 0, see dynamic_couple.c */
};

/* Ways to assemble: which tangents, whose activity.  */
typedef enum bt__mode
{
  BT__QUICK,  /* activity and geometric stiffness by the multipliers; tangents of the iterate */
  BT__FROZEN, /* the same, tangents kept */
  BT__SAFE    /* activity and geometric stiffness by the stretch, tangents kept: a gradient */
} bt__mode;

/* Prepare WORK for a step of D by INPUT: constants, differences, predictor, current.  REST0 is the
   rest length of the first interval at the end of the step.  */
void bt__dynamic_prepare (bt__dynamic_work *w, const bt__dynamic *d, const bt__dynamic_input *in,
                          double rest0);

/* Fill the blocks and right-hand sides at the iterate X.  Return true if an interval went slack
   or taut since the last call.  */
int bt__dynamic_assemble (bt__dynamic_work *w, bt__mode mode);

/* The incremental potential of which the right-hand side in SAFE mode is minus the gradient, J.  */
double bt__dynamic_potential (const bt__dynamic_work *w);

/* The resistance of interval J to a change of length in a step, N/m, see prepare_links.  */
static inline double
bt__dynamic_slack (const bt__dynamic_work *w, int j)
{
  return fmin (w->soft * w->link[j].ka, w->inertia * w->link[j].rest);
}

/* Lumps: the motion of node I and of the water past the node; the force, N, of E at node I; add
   SHARE of LUMP to E.  */
typedef struct bt__past
{
  bt_vec3 v, rel; /* m/s */
  double speed;   /* m/s, of REL */
} bt__past;

bt__past bt__dynamic_past (const bt__dynamic_work *w, int i);
bt_vec3 bt__dynamic_lump_force (const bt__dynamic_work *w, int i, const bt__extra *e,
                                const bt__past *p);
void bt__dynamic_lump_add (const bt__dynamic_work *w, bt__extra *e, const bt__dynamic_lump *lump,
                           double share);

/* Drag, weight, inertia and lost buoyancy of the line about node I, N.  */
bt_vec3 bt__dynamic_node_load (bt__dynamic_work *w, int i);

/* By how much the line draws too hard on the winch, N: the excess of the end pull over what the
   winch holds, at most the pull of the first interval.  The weight and drag of the half interval at
   the winch are borne by the winch whether line is given or not; a slack interval draws no line. */
double bt__dynamic_overload (bt__dynamic_work *w);

/* The forces of the rows of bending, and of the caller's half-spaces, on node I, N.  */
bt_vec3 bt__dynamic_bend_on (bt__dynamic_work *w, int i);
bt_vec3 bt__dynamic_contact_on (const bt__dynamic_work *w, int i);

/* Solve for the update D; return its largest, infinity if any is not finite.  */
double bt__dynamic_solve (bt__dynamic_work *w);

/* That of the update as it is (dynamic_solve.c).  */
double bt__dynamic_largest (const bt__dynamic_work *w);

/* Of the unknown nodes: the product of A and B; TO = A + SHARE B (dynamic_pair.c).  */
double bt__dynamic_product (const bt__dynamic_work *w, const bt_vec3 *a, const bt_vec3 *b);
void bt__dynamic_sum (const bt__dynamic_work *w, bt_vec3 *to, const bt_vec3 *a, double share,
                      const bt_vec3 *b);

/* The same for the symmetric blocks alone, with pivots that are kept; then again for another
   right-hand side X, in place.  */
double bt__dynamic_solve_blocks (bt__dynamic_work *w);
void bt__dynamic_solve_again (bt__dynamic_work *w, bt_vec3 *x);

/* Iterate X to the solution.  Return true if it is one; on return zero X may hold anything.  */
int bt__dynamic_newton (bt__dynamic_work *w, bt__dynamic_report *report);

/* The same, and let the winch give way where the line pulls harder than it holds.  */
int bt__dynamic_settle (bt__dynamic_work *w, bt__dynamic_report *report);

/* Take back what the winch gave in this step.  */
void bt__dynamic_give_nothing (bt__dynamic_work *w);

/* Give interval J so much more rest length.  */
void bt__dynamic_lengthen (bt__dynamic_work *w, int64_t j, double more);

/* The surface: note what is near to it, and how much is wet; add its forces and blocks at the
   iterate X; their potential.  */
void bt__dynamic_surface_prepare (bt__dynamic_work *w);
double bt__dynamic_out_of_water (const bt__dynamic_work *w,
                                 int i);                        /* the share of a lump at node I */
double bt__dynamic_line_out (const bt__dynamic_work *w, int i); /* m of line that node I bears */
void bt__dynamic_surface_force (bt__dynamic_work *w);
double bt__dynamic_surface_potential (const bt__dynamic_work *w);

/* Return the energy, J, that an interval of REST metres lacks for each newton of its buoyancy per
   metre, for it is above the surface.  */
double bt__dynamic_out (const bt_water *water, double rest, bt_vec3 from, bt_vec3 to);

/* Contacts: add the blocks and forces of the rows and holds at the iterate X, and return true if
   one changed sides since the last call; take over SHARE of the update D, and return true if
   loads hardly changed; forget the loads, or set them to those of X; their potential.  */
int bt__dynamic_contact_assemble (bt__dynamic_work *w, bt__mode mode);
int bt__dynamic_contact_take (bt__dynamic_work *w, double share);
void bt__dynamic_contact_load (bt__dynamic_work *w, int none);
double bt__dynamic_contact_potential (const bt__dynamic_work *w);

/* Return true if a held end would run past its place by the update D: it has been put there.  */
int bt__dynamic_hold_arrives (bt__dynamic_work *w);

static inline int
bt__dynamic_touches (const bt__dynamic_work *w)
{
  return w->rows > 0 || w->hold != NULL || w->bents > 0;
}

/* A row of two places: add block K and what pushes; the solution with all pairs.  */
void bt__dynamic_pair_add (bt__dynamic_work *w, bt__constraint *r, const bt__sym *k);
double bt__dynamic_pair_solve (bt__dynamic_work *w);

/* Q less what the blocks have too much of for rows of two places, times P.  */
void bt__dynamic_pair_take_back (const bt__dynamic_work *w, const bt_vec3 *p, bt_vec3 *q);

/* Bent nodes, likewise; the equations of their flows, to FLOW.  */
void bt__dynamic_bent_assemble (bt__dynamic_work *w, bt__mode mode);
void bt__dynamic_bent_take (bt__dynamic_work *w, double share);
double bt__dynamic_bent_potential (const bt__dynamic_work *w);
void bt__dynamic_bent_flows (bt__dynamic_work *w);

/* The solution with flows, and with friction that follows the loads if COUPLED (dynamic_couple.c).
   Its parts: solve for nodes FIRST to LAST, of which D has the right-hand sides and those before
   and after have taken PASSED, and for the FLOWs; with pairs, again for other right-hand sides, in
   place (dynamic_lu.c).  The same for all nodes, of which those before FIRST and after LAST have
   symmetric equations (dynamic_solve.c).  */
double bt__dynamic_couple_solve (bt__dynamic_work *w);
void bt__dynamic_lu_solve (bt__dynamic_work *w, int first, int last,
                           const bt__passed *const passed[2], double *flow);
void bt__dynamic_lu_solve_again (const bt__dynamic_work *w, int first, int last, bt_vec3 *x,
                                 double *flow);
void bt__dynamic_solve_around (bt__dynamic_work *w, int first, int last, double *flow);

/* The forces that the two nodes of R's place SIDE (0, 1) gain by a newton of load, beside the load
   itself: friction, and what the load does by having wandered.  */
static inline void
bt__dynamic_load_gains (const bt__constraint *r, int side, bt_vec3 gain[2])
{
  bt_vec3 f = bt__scale (-r->friction / fmax (bt__norm (r->drag), r->slip), r->drag);
  double shift = side == 0 && r->roll > 0 ? r->shift : 0;
  gain[0] = bt__axpy (bt__scale (side ? r->t - 1 : 1 - r->s, f), -shift, r->normal);
  gain[1] = bt__axpy (bt__scale (side ? -r->t : r->s, f), shift, r->normal);
}

/* Unfold what is crumpled of a line with bending stiffness (dynamic_unfold.c).  */
void bt__dynamic_unfold (bt__dynamic_work *w, const bt__dynamic *d);

/* A set, and twist: their forces and natural turns of a line that lies at X, to TWIST and NATURAL;
   the potential of the forces; the energy of bending, J, of a line with a set; what node I resists
   more than by its bending, N/m.  */
void bt__dynamic_set_forces (bt__dynamic_work *w, const bt_vec3 *x);
double bt__set_hold (const bt__dynamic_work *w, int i);
double bt__dynamic_set_potential (const bt__dynamic_work *w, const bt_vec3 *x);
double bt__set_energy (const struct bt__frame_line *l);

/* Twist (dynamic_twist.c): set up a step of D; find the angles of the directors of L, which are
   then L's, and return the torque of the grip on node n, N m; the energy of twist of L, J, and of
   the last L found but for a constant; make the blocks stiffer by what twist may resist; keep in D
   what the step came to.  */
void bt__dynamic_twist_prepare (bt__dynamic_work *w, const bt__dynamic *d);
double bt__dynamic_twist (const bt__dynamic_work *w, struct bt__frame_line *l);
double bt__twist_energy (const struct bt__frame_line *l);
double bt__dynamic_twist_potential (const bt__dynamic_work *w, const struct bt__frame_line *l);
void bt__dynamic_twist_hold (bt__dynamic_work *w);
void bt__dynamic_twist_take (bt__dynamic *d, bt__dynamic_work *w);

/* Let L twist as D does after its last step, or if W is not NULL as the last iterate of W.  */
void bt__twist_of (const bt__dynamic *d, const bt__dynamic_work *w, struct bt__frame_line *l);

/* The workspace of the angles for N intervals, or NULL; freed by free.  */
struct bt__twisted *bt__twisted_new (size_t n);

/* U, a vector across the unit vector T, as T turns to the unit vector S the shortest way.  */
bt_vec3 bt__carry_side (bt_vec3 u, bt_vec3 t, bt_vec3 s);

/* Slipping layers (dynamic_slip.c): set up the nodes of a step; add forces and blocks at the
   iterate X, where but in the safe way what has slipped turns with the tangents; the force on node
   I, N, at X; the potential of the safe way at X; the thrust, N, of node I at the start of the
   step; what has slipped after the step, to D.  */
void bt__dynamic_slip_prepare (bt__dynamic_work *w, const bt__dynamic *d);
void bt__dynamic_slip_force (bt__dynamic_work *w, bt__mode mode);
bt_vec3 bt__dynamic_slip_on (bt__dynamic_work *w, int i);
double bt__dynamic_slip_potential (const bt__dynamic_work *w, const bt_vec3 *x);
double bt__slip_thrust (const bt__dynamic_work *w, const double *rest, int i);
void bt__dynamic_slip_take (bt__dynamic *d, bt__dynamic_work *w);

/* What layers that stick store, J, of D with its nodes at X.  */
double bt__slip_energy (const bt__dynamic *d, const bt__dynamic_input *in, const bt_vec3 *x);

/* Bending: set up the rows, add their forces to RHS in MODE, return their energy.  */
void bt__dynamic_bend_prepare (bt__dynamic_work *w, const bt__dynamic *d);
void bt__dynamic_bend_force (bt__dynamic_work *w, bt__mode mode);
double bt__dynamic_bend_energy (const bt__dynamic_work *w, const bt_vec3 *X);

/* Make the blocks stiffer by K for the turn of ROW.  */
void bt__bend_stiffen (bt__dynamic_work *w, const bt__bend *row, double k);

/* What node X[0] turns by, its intervals BEFORE and AFTER metres long; its square; and that by the
   square of its cell, as far as it thrusts.  */
static inline bt_vec3
bt__turn_of (const bt_vec3 *x, double before, double after)
{
  bt_vec3 a = bt__scale (1 / before, bt__sub (x[0], x[-1])),
          b = bt__scale (1 / after, bt__sub (x[1], x[0]));
  return bt__sub (b, a);
}

static inline double
bt__turn_square (const bt_vec3 *x, double before, double after)
{
  bt_vec3 turn = bt__turn_of (x, before, after);
  return bt__dot (turn, turn);
}

static inline double
bt__bend_square (const bt_vec3 *x, double before, double after)
{
  double cell = 0.5 * (before + after);
  return fmin (bt__turn_square (x, before, after), BT__SHARPEST) / (cell * cell);
}

/* Return true if the step of D that INPUT asks for can only take energy from it.  */
int bt__dynamic_is_alone (const bt__dynamic *d, const bt__dynamic_input *in);

/* Of a line alone: the most energy it may have, J; true if the solution has more; slow it down
   until it has not, and return true if it had; after the step, keep in D what the next asks.  */
double bt__dynamic_most (const bt__dynamic *d, const bt__dynamic_work *w);
int bt__dynamic_gains (const bt__dynamic *d, bt__dynamic_work *w, double most);
int bt__dynamic_slow_down (const bt__dynamic *d, bt__dynamic_work *w, double most,
                           bt__dynamic_report *report);
void bt__dynamic_note (bt__dynamic *d, const bt__dynamic_work *w, double most);

/* Relax the fourth-order parts of D toward those of its shape and of the present loads.  */
void bt__dynamic_correct (bt__dynamic *d, bt__dynamic_work *w);

static inline bt_vec3
bt__sym_apply (const bt__sym *a, bt_vec3 v)
{
  return bt__vec (a->xx * v.x + a->xy * v.y + a->xz * v.z, a->xy * v.x + a->yy * v.y + a->yz * v.z,
                  a->xz * v.x + a->yz * v.y + a->zz * v.z);
}

/* A += W B.  */
static inline void
bt__sym_axpy (bt__sym *a, double w, const bt__sym *b)
{
  a->xx += w * b->xx;
  a->xy += w * b->xy;
  a->xz += w * b->xz;
  a->yy += w * b->yy;
  a->yz += w * b->yz;
  a->zz += w * b->zz;
}

/* A += K 1 + Q u u^T.  */
static inline void
bt__sym_add (bt__sym *a, double k, double q, bt_vec3 u)
{
  double qx = q * u.x, qy = q * u.y, qz = q * u.z;
  a->xx += k + qx * u.x;
  a->xy += qx * u.y;
  a->xz += qx * u.z;
  a->yy += k + qy * u.y;
  a->yz += qy * u.z;
  a->zz += k + qz * u.z;
}

/* Velocity and acceleration of node I at X.  */
static inline bt_vec3
bt__node_v (const bt__dynamic_work *w, int i)
{
  return bt__axpy (w->node[i].v0, w->b0, bt__sub (w->X[i], w->x[i]));
}

static inline bt_vec3
bt__node_a (const bt__dynamic_work *w, int i, bt_vec3 v)
{
  return bt__axpy (w->node[i].a0, w->b0, v);
}

/* ---- Two at a time ---- */

static BT__HOT int
bt__pair_any (bt__mask m)
{
#if defined __SSE2__
  return _mm_movemask_pd ((bt__pair)m) != 0;
#else
  return (m[0] | m[1]) != 0;
#endif
}

/* A where M says so, else zero.  */
static BT__HOT bt__pair
bt__pair_where (bt__mask m, bt__pair a)
{
  return (bt__pair)((bt__mask)a & m);
}

static BT__HOT bt__pair
bt__pair_abs (bt__pair a)
{
  return (bt__pair)((bt__mask)a & INT64_MAX);
}

static BT__HOT bt__pair
bt__pair_max (bt__pair a, bt__pair b)
{
#if defined __SSE2__
  return _mm_max_pd (a, b);
#else
  return (bt__pair){ a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1] };
#endif
}

static BT__HOT bt__pair
bt__pair_min (bt__pair a, bt__pair b)
{
#if defined __SSE2__
  return _mm_min_pd (a, b);
#else
  return (bt__pair){ a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1] };
#endif
}

static BT__HOT bt__pair
bt__pair_sqrt (bt__pair a)
{
#if defined __SSE2__
  return _mm_sqrt_pd (a);
#else
  return (bt__pair){ sqrt (a[0]), sqrt (a[1]) };
#endif
}

static BT__HOT bt__pair_vec
bt__pair_load (const bt_vec3 *a, const bt_vec3 *b)
{
  return (bt__pair_vec){ { a->x, b->x }, { a->y, b->y }, { a->z, b->z } };
}

static BT__HOT void
bt__pair_store (bt_vec3 *a, bt_vec3 *b, bt__pair_vec v)
{
  *a = bt__vec (v.x[0], v.y[0], v.z[0]);
  *b = bt__vec (v.x[1], v.y[1], v.z[1]);
}

static BT__HOT bt__pair_sym
bt__pair_load_sym (const bt__sym *a, const bt__sym *b)
{
  return (bt__pair_sym){ { a->xx, b->xx }, { a->xy, b->xy }, { a->xz, b->xz },
                         { a->yy, b->yy }, { a->yz, b->yz }, { a->zz, b->zz } };
}

static BT__HOT void
bt__pair_store_sym (bt__sym *a, bt__sym *b, const bt__pair_sym *s)
{
  *a = (bt__sym){ s->xx[0], s->xy[0], s->xz[0], s->yy[0], s->yz[0], s->zz[0] };
  *b = (bt__sym){ s->xx[1], s->xy[1], s->xz[1], s->yy[1], s->yz[1], s->zz[1] };
}

static BT__HOT bt__pair_vec
bt__pair_add (bt__pair_vec a, bt__pair_vec b)
{
  return (bt__pair_vec){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static BT__HOT bt__pair_vec
bt__pair_sub (bt__pair_vec a, bt__pair_vec b)
{
  return (bt__pair_vec){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static BT__HOT bt__pair_vec
bt__pair_scale (bt__pair k, bt__pair_vec a)
{
  return (bt__pair_vec){ k * a.x, k * a.y, k * a.z };
}

static BT__HOT bt__pair_vec
bt__pair_axpy (bt__pair_vec a, bt__pair k, bt__pair_vec b)
{
  return (bt__pair_vec){ a.x + k * b.x, a.y + k * b.y, a.z + k * b.z };
}

static BT__HOT bt__pair
bt__pair_dot (bt__pair_vec a, bt__pair_vec b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

#endif
