/* The line in a current brought to rest from a given shape: relaxation of a chain of n links.

   Backward Euler without mass.  Each step solves, for the interior nodes X from x, T_i t_i -
   T_{i-1} t_{i-1} + loads - kappa (X - x) = 0, a viscous creep toward rest whose resistance KAPPA
   (N/m) falls as the steps succeed: a large kappa follows the path on which the shape falls, none
   at all is Newton's method on the equilibrium.

   The kernel is a mixed primal-dual active set: every link has a multiplier LAM, the linearised
   tension.  LAM sets the geometric stiffness and decides with the stretch C whether the link is
   taut:

   taut <=> lam + kappa C > 0, T = ea C/l, K = k_g 1 + (ea/l - k_g) t t^T, k_g = lam+ / length.

   Deciding by the sign of the stretch alone cycles.  A slack link keeps a small modulus: no node
   may be free of all forces.

   An inextensible line, or a line very stiff for its load, gets a moderate modulus e and per link a
   bias b, the tension of the last step (augmented Lagrangian):

   T = e C/l + b (1 - e/ea).

   At rest b = T = ea C/l, the true law, and no step sees a huge modulus.

   The loads turn with the line: half of each link's load acts on either node of the link.  The
   derivative of the load to the link's direction is kept, else the last steps converge slowly or
   not at all where the load exceeds the tension over a link.  The derivative makes the block
   tridiagonal matrix unsymmetric; kappa keeps the matrix regular, and a lost step is repeated with
   a larger kappa.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "tether/steady.h"

#define STIFF 1e3       /* largest modulus used, in units of the tension to be expected */
#define TAUT 1e-6       /* a line with less slack than this is stretched */
#define SLACK 1e-5      /* modulus of a slack link, in units of ea ... */
#define SLACK_LOAD 1e-2 /* ... and at most this in units of the load */
#define SPARE 1e-3      /* of a link: strain accepted in a shape not at rest */
#define SETTLED 1e-10   /* of the length: the motion in the longest step that counts as rest */

/* How the steps grow, found by measurement over random shapes, chords and currents; nothing depends
   on them but speed.  Lengths in units of the line's.  */
#define FIRST_REACH 0.02 /* how far the load moves a free node in the first step */
#define LAST_REACH 1e4
#define LEAST_REACH 1e-6
#define SOLVED 0.1     /* of the reach: the last update of a step that counts as solved */
#define KEPT 1.0       /* the last update with which an unsolved step is still kept */
#define PATH_REACH 0.1 /* beyond this reach ... */
#define PATH 0.05      /* ... a step that moves a node farther is taken back */
#define LOST 1e3       /* an update that has left every shape */
#define FAR 0.1        /* motion in a step: shorten the next */
#define NEAR 0.03      /* ... keep its length */
#define NEARER 1e-3    /* ... lengthen it by GROWTH, below by FASTER */
#define GROWTH 3.0
#define FASTER 10.0
#define SHRINK 0.6
#define FAILED 8.0

enum
{
  NEWTON = 6 /* iterations in a step */
};

typedef struct chain
{
  bt__loads loads;
  int n;
  double l, ea, slack;  /* link, m; moduli, N */
  double length, force; /* m, N */
  double kept;          /* share of the bias that is not stretch */
  double kappa;         /* N/m */
  bt_vec3 *x;           /* present iterate */
  bt_steady *w;
} chain;

/* ---- 3 x 3 ---- */

static inline void
add_outer (bt__block *a, double k, bt_vec3 u, bt_vec3 v)
{
  double ku[3] = { k * u.x, k * u.y, k * u.z }, vv[3] = { v.x, v.y, v.z };
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      a->m[i][j] += ku[i] * vv[j];
}

static inline void
add_to_diagonal (bt__block *a, double k)
{
  for (int i = 0; i < 3; i++)
    a->m[i][i] += k;
}

static inline void
add_block (bt__block *a, double k, const bt__block *b)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      a->m[i][j] += k * b->m[i][j];
}

static inline bt_vec3
block_times (const bt__block *a, bt_vec3 v)
{
  return bt__vec (a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z,
                  a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z,
                  a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z);
}

static inline bt__block
product (const bt__block *a, const bt__block *b)
{
  bt__block c;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      c.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j];
  return c;
}

/* Invert by cofactors, accurate enough because a diagonal block is nearly a multiple of a projector
   plus a multiple of the unit matrix.  A singular block gives values that are not finite, which the
   step detects.  */
static inline bt__block
block_inverse (const bt__block *a)
{
  const double (*m)[3] = a->m;
  bt__block c;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      {
        int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
        c.m[i][j] = m[p][r] * m[q][s] - m[p][s] * m[q][r];
      }
  double det = m[0][0] * c.m[0][0] + m[0][1] * c.m[1][0] + m[0][2] * c.m[2][0];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      c.m[i][j] /= det;
  return c;
}

/* ---- One link ---- */

/* What link J does to its two nodes: force on the left (its opposite on the right), load on each,
   and derivatives to the vector C from left to right.  */
typedef struct link
{
  bt_vec3 force, load;
  bt__block stiffness, turn;
} link;

/* d(load)/dC for the load LOAD on a link with unit tangent T and length C.  With P = 1 - t t^T, ut
   and un the parts of the current: -kn |un| (t un^T + ut (P + n n^T)) + kt (2 |ut| t un^T + |ut| ut
   P),  over C.  */
static void
turn_of_load (const bt__loads *k, bt_vec3 u, bt_vec3 t, double scale, bt__block *d)
{
  double ut = bt__dot (u, t);
  bt_vec3 un = bt__axpy (u, -ut, t);
  double speed = bt__norm (un);
  double side = scale * (k->kt * fabs (ut) * ut - k->kn * speed * ut);
  add_outer (d, scale * (2 * k->kt * fabs (ut) - k->kn * speed), t, un);
  add_to_diagonal (d, side);
  add_outer (d, -side, t, t);
  if (speed > 0)
    add_outer (d, -scale * k->kn * ut / speed, un, un);
}

/* The stretch that decides is the one that makes the tension: from where it would vanish.  */
static inline int
is_taut_link (const chain *c, int j, double length)
{
  double stretch = length - c->l + c->kept * c->w->bias[j] * c->l / c->ea;
  return c->w->lam[j] + c->kappa * stretch > 0;
}

static link
relaxed_link (chain *c, int j)
{
  link k = { { 0, 0, 0 }, { 0, 0, 0 }, { { { 0 } } }, { { { 0 } } } };
  bt_vec3 chord = bt__sub (c->x[j + 1], c->x[j]);
  double length = bt__norm (chord);
  bt_vec3 t = length > 1e-9 * c->l ? bt__scale (1 / length, chord) : c->w->t[j];
  double stretch = length - c->l, lam = c->w->lam[j];
  int taut = is_taut_link (c, j, length);
  double k_a = (taut ? c->ea : c->slack) / c->l, lever = fmax (length, 0.2 * c->l);
  double k_g = fmax (lam, 0) / lever;
  c->w->t[j] = t;
  c->w->pull[j] = k_a * stretch + (taut ? c->kept * c->w->bias[j] : 0);
  k.force = bt__scale (c->w->pull[j], t);
  add_to_diagonal (&k.stiffness, k_g);
  add_outer (&k.stiffness, k_a - k_g, t, t);
  bt_vec3 middle = bt__scale (0.5, bt__add (c->x[j], c->x[j + 1]));
  bt_vec3 u = bt__loads_current (&c->loads, middle);
  k.load = bt__scale (c->l / 2, bt__loads_at (&c->loads, u, t));
  turn_of_load (&c->loads, u, t, c->l / (2 * lever), &k.turn);
  return k;
}

/* The linearised tension of link J after the update: the multiplier of the next iteration.  */
static void
update_multiplier (chain *c, int j)
{
  bt_vec3 t = c->w->t[j];
  int taut = is_taut_link (c, j, bt__distance (c->x[j + 1], c->x[j]));
  double closing = bt__dot (t, bt__sub (c->w->dx[j + 1], c->w->dx[j]));
  c->w->lam[j] = taut ? c->w->pull[j] + c->ea / c->l * closing : 0;
}

/* ---- One Newton iteration ---- */

/* Assemble and eliminate downward in one sweep: dx holds the reduced right-hand side, UP the
   reduced upper blocks.  */
static void
eliminate_down (chain *c)
{
  bt_steady *w = c->w;
  link left = relaxed_link (c, 0);
  for (int i = 1; i < c->n; i++)
    {
      link right = relaxed_link (c, i);
      bt__block diagonal = left.stiffness, lower = { { { 0 } } }, upper = { { { 0 } } };
      add_block (&diagonal, 1, &right.stiffness);
      add_block (&diagonal, -1, &left.turn);
      add_block (&diagonal, 1, &right.turn);
      add_to_diagonal (&diagonal, c->kappa);
      add_block (&lower, -1, &left.stiffness);
      add_block (&lower, 1, &left.turn);
      add_block (&upper, -1, &right.stiffness);
      add_block (&upper, -1, &right.turn);
      bt_vec3 force = bt__add (bt__sub (right.force, left.force), bt__add (left.load, right.load));
      bt_vec3 rhs = bt__axpy (force, -c->kappa, bt__sub (c->x[i], w->x0[i]));
      if (i > 1)
        {
          bt__block fill = product (&lower, &w->up[i - 1]);
          add_block (&diagonal, -1, &fill);
          rhs = bt__sub (rhs, block_times (&lower, w->dx[i - 1]));
        }
      bt__block pivot = block_inverse (&diagonal);
      w->up[i] = product (&pivot, &upper);
      w->dx[i] = block_times (&pivot, rhs);
      left = right;
    }
}

/* Substitute back, move the nodes and return the largest motion (infinite if any is not finite). */
static double
substitute_up (chain *c)
{
  bt_steady *w = c->w;
  double most = 0;
  w->dx[0] = w->dx[c->n] = bt__vec (0, 0, 0);
  for (int i = c->n - 1; i > 0; i--)
    {
      w->dx[i] = bt__sub (w->dx[i], block_times (&w->up[i], w->dx[i + 1]));
      double d = bt__norm (w->dx[i]);
      most = d > most || !isfinite (d) ? d : most;
      if (!isfinite (most))
        return INFINITY;
    }
  return most;
}

static double
iterate (chain *c)
{
  eliminate_down (c);
  double most = substitute_up (c);
  if (!isfinite (most))
    return INFINITY;
  for (int j = 0; j < c->n; j++)
    update_multiplier (c, j);
  for (int i = 1; i < c->n; i++)
    c->x[i] = bt__add (c->x[i], c->w->dx[i]);
  return most;
}

/* ---- Steps ---- */

static void
start_multipliers (chain *c)
{
  for (int j = 0; j < c->n; j++)
    {
      bt_vec3 chord = bt__sub (c->x[j + 1], c->x[j]);
      double stretch = bt__norm (chord) - c->l;
      c->w->lam[j] = fmax (c->ea / c->l * stretch + c->kept * c->w->bias[j], 0);
      c->w->t[j] = bt__unit_or (chord, bt__vec (1, 0, 0));
    }
}

static void
remember_shape (chain *c)
{
  for (int i = 0; i <= c->n; i++)
    c->w->x0[i] = c->x[i];
}

static void
restore (chain *c)
{
  for (int i = 0; i <= c->n; i++)
    c->x[i] = c->w->x0[i];
  start_multipliers (c);
}

static double
largest_motion (const chain *c)
{
  double most = 0;
  for (int i = 1; i < c->n; i++)
    most = fmax (most, bt__distance (c->x[i], c->w->x0[i]));
  return most;
}

/* Iterate from the remembered shape.  Count the iterations into *USED and return the last update,
   infinite if the shape was lost.  A step need not be solved to convergence, since the next step
   starts from its result; only an update that does not decrease means a step too long.  */
static double
take_relaxation_step (chain *c, double tolerance, int at_most, int *used)
{
  double update = INFINITY;
  for (int i = 0; i < at_most && !bt__ask (c->w->asker); i++)
    {
      ++*used;
      update = iterate (c);
      if (!(update < LOST * c->length))
        return INFINITY;
      if (update <= tolerance)
        break;
    }
  return update;
}

/* The reach of the next step after a step that moved the nodes by MOTION.  A shape far from rest is
   followed closely, a shape nearly at rest is taken to rest in long steps.  */
static double
next_reach (const chain *c, double reach, double motion, int solved)
{
  if (!solved || motion > FAR * c->length)
    return reach * SHRINK;
  if (motion > NEAR * c->length)
    return reach;
  return reach * (motion > NEARER * c->length ? GROWTH : FASTER);
}

/* The greatest motion allowed in a step of REACH.  Long steps are for the final approach: a long
   step with a large motion has left the path on which the shape falls.  A short step may move far,
   for example when a stretched line is released.  */
static double
allowed_motion (const chain *c, double reach)
{
  return reach > PATH_REACH * c->length ? PATH * c->length : HUGE_VAL;
}

/* Step until at rest or out of SOLVES.  REACH is how far the load would move a free node.  */
static void
relax_to_rest (chain *c, int solves, bt_steady_report *report)
{
  double most = LAST_REACH * c->length, least = LEAST_REACH * c->length;
  double reach = FIRST_REACH * c->length, rest = SETTLED * c->length;
  while (report->integrations < solves && !report->converged && !bt__ask (c->w->asker))
    {
      int left = solves - report->integrations;
      double tolerance = fmax (rest, SOLVED * fmin (reach, c->length));
      remember_shape (c);
      c->kappa = c->force / (c->n * reach);
      double update = take_relaxation_step (c, tolerance, left < NEWTON ? left : NEWTON,
                                            &report->integrations);
      report->iterations++;
      double motion = update <= KEPT * c->length ? largest_motion (c) : HUGE_VAL;
      int solved = update <= tolerance, kept = motion < allowed_motion (c, reach);
      if (!kept)
        restore (c);
      report->residual = kept ? motion : c->length;
      report->converged = solved && motion <= rest && reach >= most;
      reach = kept ? next_reach (c, reach, motion, solved) : reach / FAILED;
      reach = fmin (fmax (reach, least), most);
      if (c->kept > 0 && solved && motion <= NEAR * c->length)
        memcpy (c->w->bias, c->w->lam, (size_t)c->n * sizeof *c->w->bias);
    }
}

/* ---- From shape to shape ---- */

static int
shape_is_finite (const bt_vec3 *r, int n, double limit)
{
  for (int i = 0; i <= n; i++)
    if (!bt__is_finite (r[i]) || !(bt__norm (r[i]) < limit))
      return 0;
  return 1;
}

/* Move the ends to A and B and the nodes between in proportion: the motion is spread over all
   links.  A shape that is not finite becomes the straight line.  */
static void
place_ends (bt_vec3 *r, int n, bt_vec3 a, bt_vec3 b)
{
  int usable = shape_is_finite (r, n, 1e9);
  bt_vec3 da = bt__sub (a, r[0]), db = bt__sub (b, r[n]);
  for (int i = 1; i < n; i++)
    {
      double u = (double)i / n;
      bt_vec3 there
          = usable ? bt__axpy (bt__axpy (r[i], 1 - u, da), u, db) : bt__axpy (a, u, bt__sub (b, a));
      r[i] = there;
    }
  r[0] = a;
  r[n] = b;
}

/* The force in link K, number J, none while it is slack.  */
static bt_vec3
link_force (const chain *c, int j, const link *k)
{
  return c->w->lam[j] > 0 ? k->force : bt__vec (0, 0, 0);
}

/* Tension vectors at the nodes: the mean of the links' at an inner node; at an end the link's,
   moved half a link along dT/ds = -load.  Both of second order.  Return zero if a tension or a load
   is not finite.  */
static int
node_tensions (chain *c, bt_vec3 *t)
{
  int last = c->n - 1, finite = 1;
  bt_vec3 left = { 0, 0, 0 };
  for (int j = 0; j < c->n; j++)
    {
      link k = relaxed_link (c, j);
      bt_vec3 force = link_force (c, j, &k), load = c->w->lam[j] > 0 ? k.load : bt__vec (0, 0, 0);
      t[j] = j > 0 ? bt__scale (0.5, bt__add (left, force)) : bt__add (force, load);
      if (j == last)
        t[c->n] = bt__sub (force, load);
      finite = finite && bt__is_finite (k.load) && bt__is_finite (k.force);
      left = force;
    }
  return finite;
}

/* The working modulus follows the tension to be expected: the load of a slack line, more of a line
   that is nearly taut (the parabola's T = load/sqrt (24 slack)).  A line to be stretched keeps its
   own.  */
static double
working_modulus (const chain *c, double chord)
{
  double slack = 1 - chord / c->length;
  if (slack < TAUT && c->loads.inv_ea > 0)
    return 1 / c->loads.inv_ea;
  return STIFF * c->force * fmax (1, 1 / sqrt (24 * fmax (slack, TAUT)));
}

static void
set_chain (chain *c, bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
           bt_vec3 b, int n, bt_vec3 *r)
{
  bt__loads_set (&c->loads, line, water, a);
  c->n = n;
  c->length = line->length;
  c->l = line->length / n;
  c->force = bt__loads_scale (&c->loads, line, a, b);
  c->ea = fmin (line->ea, working_modulus (c, bt__distance (a, b)));
  c->kept = 1 - c->ea * c->loads.inv_ea;
  c->slack = fmin (SLACK * c->ea, SLACK_LOAD * c->force);
  c->kappa = 0;
  c->x = r;
  c->w = steady;
  memset (steady->bias, 0, (size_t)n * sizeof *steady->bias);
}

/* Make a shape not at rest a possible shape of the line, with its tensions.  */
static void
leave_possible (chain *c)
{
  double straight = bt__distance (c->x[0], c->x[c->n]) / c->n;
  if (!bt__steady_shorten (c->x, c->n, (1 + SPARE) * fmax (c->l, straight)))
    return;
  memset (c->w->bias, 0, (size_t)c->n * sizeof *c->w->bias);
  start_multipliers (c);
}

bt_status
bt_steady_relax (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                 bt_vec3 b, int n, int solves, bt_vec3 *r, bt_vec3 *t, bt_steady_report *report,
                 bt_error *error)
{
  chain c;
  *report = (bt_steady_report){ 0, 0, 0, line->length };
  bt_status room = bt__steady_room (steady, n, error);
  if (room != BT_OK)
    return room;
  if (!bt__is_finite (a) || !bt__is_finite (b))
    return bt__fail (error, BT_ERR_DOMAIN, "an end of the line is not at a finite place");
  set_chain (&c, steady, line, water, a, b, n, r);
  place_ends (r, n, a, b);
  start_multipliers (&c);
  relax_to_rest (&c, solves, report);
  if (!report->converged)
    leave_possible (&c);
  if (!node_tensions (&c, t))
    return bt__fail (error, BT_ERR_DIVERGED, "the current along the line is not finite");
  return BT_OK;
}
