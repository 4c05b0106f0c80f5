/* The moving line: a chain of lumped nodes stepped implicitly, knowing no world.

   The state is one flat block of doubles and 64-bit integers, without pointers or padding: a
   bt__dynamic followed by arrays for N_MAX intervals.  Copy it with memcpy for a checkpoint, hash
   it, write it; two equal blocks have equal futures.  Workspaces hold nothing from step to step.

   A step solves, for every node, with M mass and added mass (normal part alone), F drag on the
   relative velocity, w wet weight, T tension and B bending,
     M a = F(u - v) - w + T_i t_i - T_{i-1} t_{i-1} + B,
     T = max (0, EA (e - 1) + BA de/dt),   e = chord / rest length,
     T = EA (e - 1) + BA de/dt for a line with bending stiffness, which carries compression,
   where v and a are second-order backward differences of variable step (backward Euler when there
   is no usable history).  Loads, mass and drag act per unstretched metre.

   Contacts join by dynamic_contact.h: a half-space adds SPD blocks to the diagonal and off-diagonal
   of the nodes it touches, its force to their right-hand sides, its potential to the line's.  The
   history rule: a node whose proposal is refused and cut to another place Y, or that makes a new
   contact, goes on with v = vp = (Y - x)/h and dx = h v, so that the next difference starts without
   a jump.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_DYNAMIC_H
#define BT_TETHER_DYNAMIC_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <bight/status.h>
#include <bight/tether.h>
#include <bight/vec.h>
#include <bight/water.h>

#include "base/ask.h"
#include "base/range.h"
#include "base/record.h"

/* ---- The state ---- */

/* How far a line went, or may go: no less than the most that ...  */
typedef struct bt__dynamic_drift
{
  double way;    /* m: ... a node goes, ... */
  double turned; /* m: ... the one end of an interval against the other, ... */
  double apart;  /* m: ... and any node against any other */
} bt__dynamic_drift;

/* The head of the block.  Node 0 is the winch end, node n the far end.  */
typedef struct bt__dynamic
{
  int64_t n;               /* intervals in use */
  int64_t n_max;           /* intervals there is room for */
  int64_t history;         /* steps behind that may be differenced; 0: the next is backward Euler */
  double h;                /* s: the last step */
  double piece;            /* m: rest length the winch gives a new interval: the mean one's where
                              nodes have come or gone along the line */
  double owed;             /* m: line that is out but not yet in the chain, see bt__dynamic_wind */
  bt_vec3 pull[2];         /* N: force of the line on its ends */
  double most;             /* J: of a line alone, the energy it may have, if it still has ... */
  double left;             /* ... what its last step left it */
  bt__dynamic_drift step;  /* m: the last step's */
  bt__dynamic_drift spare; /* m: what it may go until it must be looked at.  Contact gives it, a
                              step takes what it goes, what else alters the line takes all.  */
  double fastest;          /* m/s: no node is faster, if there is some spare way */
  int64_t seen;            /* what the spare was given for, and ... */
  int64_t wait;            /* ... in how many steps it is asked again, see contact/line.h */
  int64_t least;           /* intervals that the winch leaves: of a cut line all but its last */
  int64_t rounded;         /* true: a chord has a surplus, see bt__dynamic_chord */
  int64_t gripped;         /* true: both clamps hold the material, see dynamic_twist.c */
  double grip;             /* rad: angle of the far clamp's director in the line without twist */
  double twist;            /* rad: of node n against node 0, right-handed about the line */
  double torque[2];        /* N m: in the line at its ends, right-handed about the line */
} bt__dynamic;

enum
{
  BT__LEAST_INTERVALS = 2 /* of a line that is held at both ends */
};

/* Return the size in bytes of a block with room for N_MAX intervals.  */
size_t bt__dynamic_size (int n_max);

/* Write the ranges in use of a block with room for ROOM intervals, N of them in use, to OUT: the
   head and the beginning of each array.  What lies behind them is never read, and need not be
   copied.  */
enum
{
  BT__DYNAMIC_RANGES = 11
};
void bt__dynamic_in_use (int64_t n, int room, bt__range out[BT__DYNAMIC_RANGES]);

/* Parts of the block.  Node arrays have n + 1 elements, interval arrays n.  */
bt_vec3 *bt__dynamic_x (const bt__dynamic *d);     /* m: positions */
bt_vec3 *bt__dynamic_v (const bt__dynamic *d);     /* m/s: velocities */
bt_vec3 *bt__dynamic_dx (const bt__dynamic *d);    /* m: motion in the last step */
bt_vec3 *bt__dynamic_vp (const bt__dynamic *d);    /* m/s: velocities one step before */
bt_vec3 *bt__dynamic_load (const bt__dynamic *d);  /* N: fourth-order part of the loads; of a line
                                                      of second order the curvature, 1/m, by which
                                                      layers have slipped, see dynamic_slip.c, or
                                                      (angle of the interval's director, rad, 0, 0),
                                                      see dynamic_twist.c */
bt_vec3 *bt__dynamic_chord (const bt__dynamic *d); /* m: fourth-order part of the chords; of a line
                                                      of second order (crumple, BT__BEARS, surplus
                                                      over the line), zero where absent */
#define BT__BEARS 1.0 /* an interval that bears compression, see dynamic_unfold.c */
double *bt__dynamic_tension (const bt__dynamic *d);  /* N: tensions of the intervals */
double *bt__dynamic_rest (const bt__dynamic *d);     /* m: rest lengths */
double *bt__dynamic_stretch (const bt__dynamic *d);  /* chord without surplus / rest length */
double *bt__dynamic_dstretch (const bt__dynamic *d); /* its change in the last step */

/* The axial stiffness, N, that a line of stiffness EA is stepped with: one that cannot stretch
   stretches very little.  */
static inline double
bt__stiffness (double ea)
{
  return isfinite (ea) ? ea : 1e9;
}

/* Lay N intervals of LENGTH metres in all along the polyline SHAPE of M points, at rest, in *D,
   which has room for N_MAX.  EA sets the first guess of the tensions.  BT_ERR_LIMIT or
   BT_ERR_DOMAIN.  */
bt_status bt__dynamic_init (bt__dynamic *d, int n_max, int n, const bt_vec3 *shape, int m,
                            double length, double ea, bt_error *error);

extern const bt__record bt__dynamic_record;

/* Judge the block D, which was allotted room for ROOM intervals and comes from outside; tell the
   whole of it as seen.  What the functions above need of a block holds if it is sound.  */
bt_status bt__dynamic_judge (bt__judge *judge, const bt__dynamic *d, int room);

/* An interval of another mesh of a line: what its chord is to be, and what is needed to find
   nodes for that.  */
typedef struct bt__fit
{
  double rest;         /* m */
  double length, rate; /* m, m/s: of its chord */
  bt_vec3 along;       /* unit vector; 0: slack, and so short that nothing is asked of it */
  double off, pivot, force;
} bt__fit;

/* bt__dynamic_measure tells in FIT what N equal intervals of the line of D, which has no surplus of
   arcs, are to be for their tensions to be those of D.  bt__dynamic_fit moves the inner ones of the
   N + 1 points X, and changes their velocities V, by the least that makes them so, and returns
   true; or returns false if no such points were found near by: X is then anywhere.  */
void bt__dynamic_measure (const bt__dynamic *d, int n, bt__fit *fit);
int bt__dynamic_fit (bt_vec3 *x, bt_vec3 *v, int n, bt__fit *fit);

/* Take all motion out of D and forget its history.  */
void bt__dynamic_still (bt__dynamic *d);

/* ---- A step ---- */

typedef struct bt__dynamic_work bt__dynamic_work;

/* Return a workspace for up to N_MAX intervals, or NULL when memory is out.  Its arrays are made by
   the first step (bt__dynamic_begin) of a line with so many intervals, or with bending; nothing
   else below allocates.  */
bt__dynamic_work *bt__dynamic_work_new (int n_max);
void bt__dynamic_work_free (bt__dynamic_work *work);

/* Let the iterations of a step ask ASKER, which must stay, whether to go on; left, a step has not
   converged.  */
void bt__dynamic_ask (bt__dynamic_work *work, bt__asker *asker);
/* True if the step of WORK is to be left.  */
int bt__dynamic_is_left (bt__dynamic_work *work);

/* Something that is not line: at an end, or along the line.  */
typedef struct bt__dynamic_lump
{
  double from_end;          /* m of rest length from node n (bt__dynamic_end: not used) */
  double span;              /* m over which it is spread, 0: at a point */
  double mass, added;       /* kg; added mass in every direction */
  double wet_weight;        /* N, sinking positive */
  double linear, quadratic; /* N s/m, N s2/m2: drag against the water in every direction */
  bt_vec3 force;            /* N, held over the step */
} bt__dynamic_lump;

/* A natural curvature of a part of the line (dynamic_set.c).  */
typedef struct bt__dynamic_set
{
  double from, to;     /* m of rest length from node n; they may lie beyond the line */
  double curvature[2]; /* 1/m, toward the first and second director of the cross-section */
} bt__dynamic_set;

typedef struct bt__dynamic_end
{
  int free;               /* zero: taken to AT; else moved by the forces, BODY among them */
  bt_vec3 at;             /* m: where it is at the end of the step */
  bt__dynamic_lump body;  /* a point mass fastened there; all zero for none */
  int gripped;            /* FREE alone: a spring of STIFFNESS holds it to AT: a vehicle's body */
  double stiffness[3][3]; /* N/m: symmetric, positive definite */
  int clamped;            /* true: the line leaves along DIRECTION; wants bending stiffness */
  bt_vec3 direction;      /* unit, from node 0 toward node n */
  bt_vec3 side;           /* of a clamp: a director of the line's cross-section there, the first one
                             at node 0; 0: bt__set_side.  At node n the line is gripped as it lies
                             in its first step.  */
} bt__dynamic_end;

/* What the number of intervals keeps to while a winch turns; all zero: as many as there is room
   for.  */
typedef struct bt__dynamic_mesh
{
  int fewest, most; /* intervals; MOST 0: the room of the block */
  double error;     /* m: the bt__dynamic_space_error that is aimed at; 0: none */
  double shortest; /* m: no interval is halved to less: a line that lies crumpled is not smooth, and
                      would be halved for good */
  int idle;        /* true: one node may come or go in this step though the winch stands */
  int corners;     /* true: the winch looks after the corners of the line at lumps, and lumps may
                      pass it */
} bt__dynamic_mesh;

typedef struct bt__dynamic_input
{
  const bt_tether_props *line; /* diameter, mass, wet_weight, ea, ei, gj, ba,
                                  bending_damping, ei_stuck, slip_curvature, cdn, cdt, ca */
  const bt_water *water;       /* TIME at the end of the step; density 0: no water */
  bt__dynamic_end end[2];
  const bt__dynamic_lump *lumps;
  int n_lumps;
  const bt__dynamic_set *sets; /* want bending stiffness; overlapping sets add up */
  int n_sets;                  /* not of a line whose layers slip */
  double h;                    /* s */
  double pay;                  /* m/s of line through the winch end, out positive */
  double hold; /* N: what the winch holds; a line that pulls harder draws line from it; 0: all */
  double room; /* m: how much it may draw in the step, beyond PAY */
  double tolerance; /* of the length: last update of a solved step; 0: 1e-5, less in steps below
                       1/60 s */
  int surfaced;     /* true: what is above the surface of the water is in air */
  int order;        /* 4: fourth order in space by deferred correction; else second */
  double growth;    /* a step so many times as long as the last is of second order in time: up to
                       1 + sqrt (2) where the motion is smooth; 0: no longer step is */
  bt__dynamic_mesh mesh;
} bt__dynamic_input;

typedef struct bt__dynamic_report
{
  int converged;
  int solves;                 /* linear solves */
  int safeguarded;            /* true: the quick iteration failed and descent took over */
  int loose;                  /* true: converged, but tension still walks along the line */
  double update;              /* m: last update */
  double speed, acceleration; /* the largest of any node, for the caller's sleep */
  double given;               /* m: line that was drawn from the winch, beyond what was paid out */
  double tension;             /* N: the largest, along the line and at what holds its ends, ... */
  int at;                     /* ... and its interval, to be held against the breaking load */
  double bend_radius;         /* m: the tightest, INFINITY if straight */
  int bend_at;                /* its node */
  int slips;                  /* nodes whose layers may slip */
  bt__dynamic_drift drift;    /* m: of the step */
} bt__dynamic_report;

/* Step D by INPUT->h.  BT_ERR_DIVERGED (saying node, time and quantity) and BT_ERR_DOMAIN leave *D
   as it was.  A step that is not solved to the tolerance is taken all the same, bounded, with
   REPORT->converged = 0.  Nodes come and go when INPUT->pay asks for it, at the winch end and, to
   keep to INPUT->mesh, along the line.  */
bt_status bt__dynamic_step (bt__dynamic *d, bt__dynamic_work *work, const bt__dynamic_input *input,
                            bt__dynamic_report *report, bt_error *error);

/* ---- Within a long step (dynamic_dense.c) ---- */

/* Copy what is in use of FROM to TO, which has as much room.  */
void bt__dynamic_copy (bt__dynamic *to, const bt__dynamic *from);

/* Let D, just stepped from BEGIN with as many intervals and in the second order, know of BEGIN for
   the questions below; let D be as any block again.  */
void bt__dynamic_reach_back (bt__dynamic *d, const bt__dynamic *begin);
void bt__dynamic_forget_back (bt__dynamic *d);

/* bt__dynamic_surprise estimates the error in place of any node by the last step of D, m, BEGIN
   having made a step too: by the difference from the predictor (Milne's device).
   bt__dynamic_swing: no node is farther from the straight way of the step, m.
   bt__dynamic_tension_bow estimates how far any tension, of a line of stiffness EA, is meanwhile
   off the straight way between its values before and after the last step of D, N: by the difference
   from the tension extrapolated from the step of BEGIN.  */
double bt__dynamic_surprise (const bt__dynamic *begin, const bt__dynamic *d);
double bt__dynamic_tension_bow (const bt__dynamic *begin, const bt__dynamic *d, double ea);
double bt__dynamic_swing (const bt__dynamic *d);

/* Return the place of node I of D at the SHARE, 0 to 1, of its last step.  */
bt_vec3 bt__dynamic_node_between (const bt__dynamic *d, double share, int64_t i);

/* Make OUT, with as much room, the line D at the SHARE of the last step of D, a block that reaches
   back; motion and former velocities of OUT are left alone.  bt__dynamic_resume gives OUT a last
   step from the share BEFORE too, so that OUT can be stepped on.  Pulls on the ends are those of
   D.  */
void bt__dynamic_between (const bt__dynamic *d, double share, bt__dynamic *out);
void bt__dynamic_resume (const bt__dynamic *d, double before, double share, bt__dynamic *out);

/* Take the ends of D to END; the nodes between share the little way, at no speed.  */
void bt__dynamic_lead_ends (bt__dynamic *d, const bt_vec3 end[2]);

/* ---- Winch and knife ---- */

/* Split the first interval of D when it has grown, or join it with the second when it has shrunk,
   and keep the number of intervals to the mesh of INPUT (dynamic_mesh.c).  The tension is kept: the
   rest lengths follow it, and what that leaves over is owed and comes out with the next half second
   of steps. Called by the step.  */
void bt__dynamic_wind (bt__dynamic *d, bt__dynamic_work *work, const bt__dynamic_input *input);

/* Return the length of D that is out, m.  */
double bt__dynamic_length (const bt__dynamic *d);

/* Cut D at SHARE of interval J, 1 only if another follows, into *A (nodes 0 to J and a new end) and
   *B (a new end and the rest), blocks with room for as many intervals as D.  The new ends are to be
   stepped as free ends. Either may be NULL, and then the other may be D itself; A may be in any
   case.  */
void bt__dynamic_cut (const bt__dynamic *d, int j, double share, bt__dynamic *a, bt__dynamic *b);

/* ---- Questions ---- */

/* Return how far from node 0, in rest lengths of intervals, is the place S metres along D: what is
   owed counts as line, but is in no interval yet, so all of them are read as so much longer.  */
double bt__dynamic_along (const bt__dynamic *d, double s);

/* Return the point, or the velocity, of D at S metres along it from node 0 (clamped), by the cubic
   through four nodes.  No piece of the curve is longer than its line by more than BT__SMOOTH_SPARE
   of it.  */
bt_vec3 bt__dynamic_point (const bt__dynamic *d, double s);
bt_vec3 bt__dynamic_velocity (const bt__dynamic *d, double s);

/* Return the interval at U metres of rest length from node 0 (clamped); *START receives the rest
   length from node 0 to the beginning of the interval.  */
int bt__dynamic_interval (const bt__dynamic *d, double u, double *start);

/* Return the point at U metres of rest length from node 0 (clamped) on the straight intervals.  */
bt_vec3 bt__dynamic_chord_point (const bt__dynamic *d, double u);

/* Return the tension at node I, N; of second order at the ends too.  */
double bt__dynamic_node_tension (const bt__dynamic *d, int i);

typedef struct bt__dynamic_energy
{
  double kinetic, strain, gravity, bending; /* J; added mass moves too; gravity from z = 0; a line
                                               under bending is strained by pushing together too */
} bt__dynamic_energy;

/* Write to OUT those of N SETS, told for a line of LENGTH metres, that bend: as a part of the line
   has them beyond whose far end lie BEYOND metres.  Return how many.  */
int bt__place_sets (const bt_set *sets, int n, double length, double beyond, bt__dynamic_set *out);

/* The first director of a line that leaves along DIRECTION: north if that is straight down, else
   turned with it the shortest way.  SIDE, across the unit vector FROM, as FROM turns to TO the
   shortest way.  */
bt_vec3 bt__set_side (bt_vec3 direction);
bt_vec3 bt__set_carry (bt_vec3 side, bt_vec3 from, bt_vec3 to);

/* True if the layers of a line of P stick and slip.  */
int bt__layers_slip (const bt_tether_props *p);

/* True if the line of INPUT twists: it has torsional stiffness, and clamps or a set that twist
   it.  */
int bt__twists (const bt__dynamic_input *input);

/* Give TO, the same line on another mesh, the twist of FROM; no line is held so any more.  */
void bt__twist_copy (bt__dynamic *to, const bt__dynamic *from);
void bt__twist_forget (bt__dynamic *d);

/* Write the curvatures, 1/m, by which the layers of D have slipped at N + 1 places evenly along it
   to OUT.  */
void bt__slipped_along (const bt__dynamic *d, int n, bt_vec3 *out);

/* Return the energies of the line (not its lumps) as INPUT has it.  */
bt__dynamic_energy bt__dynamic_energies (const bt__dynamic *d, const bt__dynamic_input *input);

/* Return how much of the strain energy that bt__dynamic_energies counts, J, is of intervals that
   are shorter than their tension tells: a line under bending that was laid so has crumpled there,
   and nothing pushes it together (dynamic_unfold.c).  */
double bt__dynamic_crumple_energy (const bt__dynamic *d, const bt__dynamic_input *input);

/* Estimate the error in position that comes of the number of nodes, m: the true one is 1.3 to 2.5
   times as large.  At the nodes that CORNER flags (or NULL) the line is not smooth, and more nodes
   would not help: nothing is made of differences there.  */
double bt__dynamic_space_error (const bt__dynamic *d, const uint8_t *corner);

#endif
