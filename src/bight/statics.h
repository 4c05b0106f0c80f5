/* The static shapes of a tether as pure functions: no world, no state, and no allocation except in
   a workspace.

   Plane problems are posed with the start at (0, 0), x across and y against the load: a loaded line
   sags toward -y.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_STATICS_H
#define BIGHT_STATICS_H

#include <bight/decls.h>
#include <bight/status.h>
#include <bight/vec.h>
#include <bight/water.h>

BT_BEGIN_DECLS

typedef struct bt_point2
{
  double x, y;
} bt_point2;

/* ---- The inextensible catenary, by one scalar equation ---- */

/* A solved catenary from (0, 0) to (H, V) with arc length S.  Straight (over-taut included): A is
   infinite.  H = 0: A is 0 and the line hangs folded.  */
typedef struct bt_catenary
{
  double h, v, s; /* as given; h >= 0 */
  double a;       /* the parameter A = horizontal tension / load, m */
  double sigma0;  /* signed arc length from the lowest point to the start, m */
} bt_catenary;

/* Solve the catenary from (0, 0) to (H, V), H >= 0, with arc length S > 0 into *C.  A line too
   short to reach becomes the straight line.  Full double precision at any size and slack.
   BT_ERR_DOMAIN unless the numbers are finite with H >= 0 and S > 0.  */
bt_status bt_catenary_solve (double h, double v, double s, bt_catenary *c, bt_error *error);

/* Return the point of C at arc length U from the start, 0 <= U <= S (clamped).  */
bt_point2 bt_catenary_point (const bt_catenary *c, double u);

/* Return the unit tangent of C at arc length U, pointing from the start to the end.  */
bt_point2 bt_catenary_tangent (const bt_catenary *c, double u);

/* ---- The thesis' search for the same curve: Nelder-Mead on (A, xs), equations 2-2 to 2-4 ---- */

typedef struct bt_search bt_search; /* GSL's workspace */

typedef struct bt_search_result
{
  double a, xs; /* y = A cosh ((x - xs)/A) + ys */
  int iterations;
  int converged; /* the simplex error fell below the tolerance */
} bt_search_result;

/* Return a workspace, or NULL when memory is out.  Free it with bt_search_free.  */
bt_search *bt_search_new (void);
void bt_search_free (bt_search *search);

/* Search the catenary from (0, 0) to (H, V) with arc length S until the relative error is below
   TOLERANCE (the thesis: 0.005), at most ITERATIONS.  Starts from *RESULT when WARM is true,
   else from the thesis' guess xs = ((3 log10 S + log2 S)/4)^3, A = xs/2.  The relative forms of the
   errors are used where |V| or S exceeds one.  Returns BT_ERR_DOMAIN as bt_catenary_solve, and
   BT_OK with RESULT->converged = 0 when it does not settle.  */
bt_status bt_search_catenary (bt_search *search, double h, double v, double s, double tolerance,
                              int iterations, int warm, bt_search_result *result, bt_error *error);

/* ---- The V: two links, thesis equation 2-1 ---- */

typedef struct bt_v_shape
{
  double l1, l2;  /* lengths of the two links, m */
  bt_point2 bend; /* in the plane, relative to the start */
} bt_v_shape;

/* Bend a line of length S from (0, 0) to (H, V), H >= 0, at l1 = S/2 - V/(2 sin theta), where
   H = S cos theta (V is measured against the load).  A line too short to reach is straight with
   l1 = S/2.  BT_ERR_DOMAIN as bt_catenary_solve.  */
bt_status bt_v_shape_solve (double h, double v, double s, bt_v_shape *shape, bt_error *error);

/* ---- The elastic catenary (Irvine 1981) ---- */

typedef struct bt_elastic
{
  double h, v, s; /* ends as above; S the unstretched length */
  double w, ea;   /* load per unstretched metre, N/m; axial stiffness, N (may be infinite) */
  double H;       /* tension component across the load, N */
  double V; /* tension component against the load at the start: force of the line's support, N */
} bt_elastic;

/* Solve the elastic catenary from (0, 0) to (H, V) with unstretched length S under W > 0 newtons
   per unstretched metre toward -y and axial stiffness EA (INFINITY: inextensible; then a line too
   short to reach is BT_ERR_DOMAIN).  BT_ERR_DIVERGED if Newton does not settle.  */
bt_status bt_elastic_solve (double h, double v, double s, double w, double ea, bt_elastic *e,
                            bt_error *error);
bt_point2 bt_elastic_point (const bt_elastic *e, double u);   /* U unstretched, from the start */
bt_point2 bt_elastic_tangent (const bt_elastic *e, double u); /* unit */
double bt_elastic_tension (const bt_elastic *e, double u);    /* N */

/* ---- The line in any current: three-dimensional equilibrium ---- */

/* One uniform line between two ends.  Loads act per unstretched metre:
     dr/ds = t (1 + T/ea),  d(T t)/ds = -(0, 0, -wet_weight) - rho/2 cdn d |un| un - rho/2 cdt pi d
   |ut| ut with un, ut the parts of the current normal and tangential to the unit tangent t.  */
typedef struct bt_line
{
  double length;     /* unstretched, m */
  double diameter;   /* m */
  double wet_weight; /* N/m, sinking positive */
  double ea;         /* N, INFINITY for inextensible */
  double cdn, cdt;   /* on d and on pi d */
} bt_line;

typedef struct bt_steady bt_steady; /* workspace for up to a given number of intervals */

/* Return a workspace for lines of up to N_MAX intervals, or NULL when memory is out.  The first
   call of a solver below allocates the arrays of the workspace: BT_ERR_LIMIT when memory is out. */
bt_steady *bt_steady_new (int n_max);
void bt_steady_free (bt_steady *steady);

/* What a solve did and how far it got.  */
typedef struct bt_steady_report
{
  int converged;    /* true: residual within tolerance */
  int iterations;   /* Newton iterations (shooting) or relaxation steps */
  int integrations; /* marches along the line, or linear solves */
  double residual;  /* miss of the far end, or fastest node motion times the settling time, m */
} bt_steady_report;

/* March LINE in WATER from START with tension vector PULL there (N, pointing along the line) in N
   fourth-order Runge-Kutta steps.  R and T receive N + 1 positions and tension vectors (T points
   from start to end).  BT_ERR_DIVERGED when the tension vanishes or a value is not finite.  */
bt_status bt_steady_march (const bt_line *line, const bt_water *water, bt_vec3 start, bt_vec3 pull,
                           int n, bt_vec3 *r, bt_vec3 *t, bt_error *error);

/* Find the equilibrium of LINE in WATER between A and B by shooting over N intervals (GSL's hybrid
   root finder on the tension at A).  *PULL is the tension vector at A: the guess when WARM is
   true, and the answer.  Cold, the guess is the catenary under the mean load.  R, T as above.
   Returns BT_OK with REPORT->converged = 0 when it did not converge (then R and T are unspecified).
 */
bt_status bt_steady_shoot (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                           bt_vec3 b, int n, int warm, bt_vec3 *pull, bt_vec3 *r, bt_vec3 *t,
                           bt_steady_report *report, bt_error *error);

/* Relax the chain of N links whose present shape is R (N + 1 nodes; its ends are moved to A and B)
   in WATER to rest, by backward Euler with growing steps and at most SOLVES linear solves.  R
   receives the shape, T the tension vectors at the nodes.  Where several equilibria exist, the
   present shape decides.  REPORT->converged = 0 if the chain still moves; R is then a possible
   shape of the line, not an equilibrium.  */
bt_status bt_steady_relax (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                           bt_vec3 b, int n, int solves, bt_vec3 *r, bt_vec3 *t,
                           bt_steady_report *report, bt_error *error);

/* Search for distinct equilibria of LINE in WATER between A and B: the line is relaxed from its own
   catenary, from bows to the other sides, and from above and below.  SHAPES has room for MAX shapes
   of N + 1 points each, one after another; *FOUND receives the number of shapes that differ by more
   than LINE->length / 100.  The search proves nothing about equilibria not found.  */
bt_status bt_steady_equilibria (bt_steady *steady, const bt_line *line, const bt_water *water,
                                bt_vec3 a, bt_vec3 b, int n, int max, bt_vec3 *shapes, int *found,
                                bt_error *error);

BT_END_DECLS

#endif
