/* The choice among equilibria: shooting if its answer belongs to the present shape, else
   relaxation.

   Shooting is exact and, with a warm start, costs a few marches; but shooting ignores the present
   shape, and a slack line in a current may have several equilibria.  So an answer of shooting is
   taken only if near the present shape.  Relaxation finds the equilibrium into which the present
   shape falls, at second order in the mesh; after relaxation, shooting from the tension found
   polishes the result.  The work of one call is bounded: A shape not yet at rest is returned
   unfinished, counted as unsettled, and relaxed further by the next call.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "tether/equilibrium.h"
#include "tether/steady.h"

#define FOLLOW 4.0 /* motion of the line allowed, in units of the motion of its ends ... */
#define DRIFT 0.02 /* ... beyond this, in units of its length */
#define COLD 0.25  /* the same for a line without a present shape, from its catenary */
#define LESSER 0.8 /* ratio of tensions at which the end to shoot from is changed */

enum
{
  SOLVES_COLD = 600, /* linear solves in one call without, with a present shape */
  SOLVES_WARM = 60
};

typedef struct task
{
  bt_steady *steady;
  const bt_line *line;
  const bt_water *water;
  bt_vec3 a, b;
  int n;
  bt__shape_counts *counts;
  bt_error *error;
} task;

static const bt__reaction unknown = { 0, { 0, 0, 0 }, { { 0, 0, 0 } } };

static double
largest_distance (const bt_vec3 *p, const bt_vec3 *q, int n)
{
  double most = 0;
  for (int i = 0; i <= n; i++)
    most = fmax (most, bt__distance (p[i], q[i]));
  return most;
}

/* The loads on the line with the shape of NODES, taken on straight intervals, N.  */
static bt_vec3
loads_on_shape (const task *k, const bt_vec3 *nodes)
{
  bt__loads loads;
  bt_vec3 sum = { 0, 0, 0 };
  bt__loads_set (&loads, k->line, k->water, k->a);
  for (int i = 0; i < k->n; i++)
    {
      bt_vec3 middle = bt__scale (0.5, bt__add (nodes[i], nodes[i + 1]));
      bt_vec3 t = bt__unit_or (bt__sub (nodes[i + 1], nodes[i]), bt__vec (0, 0, -1));
      sum = bt__add (sum, bt__loads_at (&loads, bt__loads_current (&loads, middle), t));
    }
  return bt__scale (k->line->length / k->n, sum);
}

static bt__reaction
reaction_at_a (bt_vec3 tension)
{
  return (bt__reaction){ 0, tension, { { 0, 0, 0 } } };
}

static bt__reaction
reaction_at_b (bt_vec3 tension)
{
  return (bt__reaction){ 1, bt__scale (-1, tension), { { 0, 0, 0 } } };
}

/* The reaction to shoot from where the tension vectors at the ends are AT_A and AT_B: that of the
   end with the lesser tension, from where a march is the more stable.  LAST is kept if there is
   little between the two.  */
static bt__reaction
lesser_reaction (const bt__reaction *last, bt_vec3 at_a, bt_vec3 at_b)
{
  double a = bt__norm (at_a), b = bt__norm (at_b);
  int64_t want = last->at_b ? b < LESSER * a || !(a < LESSER * b) : b < LESSER * a;
  if (want == last->at_b && bt__norm (last->pull) > 0)
    return *last;
  return want ? reaction_at_b (at_b) : reaction_at_a (at_a);
}

/* Shoot from REACTION.  Take the answer and return true if it lies within REACH of NODES.  *STATUS
   is the solver's.  */
static int
shoot_near (task *k, double reach, bt__reaction *reaction, bt_vec3 *nodes, bt_vec3 *tensions,
            bt_status *status)
{
  bt_steady_report report;
  bt__reaction trial = *reaction;
  bt_vec3 *r = k->steady->shape, *t = k->steady->tensions;
  *status = bt__steady_refine (k->steady, k->line, k->water, k->a, k->b, k->n, &trial, r, t,
                               &report, k->error);
  k->counts->shots++;
  k->counts->marches += (uint64_t)report.integrations;
  if (*status != BT_OK || !report.converged || !(largest_distance (r, nodes, k->n) <= reach))
    return 0;
  size_t size = ((size_t)k->n + 1) * sizeof *nodes;
  memcpy (nodes, r, size);
  memcpy (tensions, t, size);
  nodes[k->n] = k->b;
  *reaction = trial;
  return 1;
}

/* Relax from NODES, then polish.  REACTION becomes what to shoot from next time, zero where
   shooting has no chance.  */
static bt_status
relax (task *k, int solves, bt__reaction *reaction, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_steady_report report;
  bt_status status = bt_steady_relax (k->steady, k->line, k->water, k->a, k->b, k->n, solves, nodes,
                                      tensions, &report, k->error);
  k->counts->relaxations++;
  *reaction = unknown;
  if (status != BT_OK)
    return status;
  if (!report.converged)
    {
      k->counts->unsettled++;
      return BT_OK;
    }
  bt__reaction trial = lesser_reaction (&unknown, tensions[0], tensions[k->n]);
  if (bt__norm (trial.pull) > 0
      && shoot_near (k, DRIFT * k->line->length, &trial, nodes, tensions, &status))
    *reaction = trial;
  return status;
}

/* A line that cannot stretch and spans more than its length: straight.  Its tension is whatever it
   is pulled with, which is not known here.  */
static void
lay_straight (task *k, bt__reaction *reaction, bt_vec3 *nodes, bt_vec3 *tensions)
{
  for (int i = 0; i <= k->n; i++)
    {
      nodes[i] = bt__axpy (k->a, (double)i / k->n, bt__sub (k->b, k->a));
      tensions[i] = bt__vec (0, 0, 0);
    }
  nodes[k->n] = k->b;
  *reaction = unknown;
}

static bt_status
solve_cold (task *k, bt_vec3 fallback, bt__reaction *reaction, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_status status = BT_OK;
  bt_vec3 pull;
  bt__steady_guess (k->line, k->water, k->a, k->b, fallback, k->n, nodes, &pull);
  bt_vec3 at_b = bt__sub (pull, loads_on_shape (k, nodes));
  *reaction = lesser_reaction (&unknown, pull, at_b);
  for (int ends = 0; ends < 2 && bt__norm (pull) > 0 && status == BT_OK; ends++)
    {
      if (shoot_near (k, COLD * k->line->length, reaction, nodes, tensions, &status))
        return BT_OK;
      *reaction = reaction->at_b ? reaction_at_a (pull) : reaction_at_b (at_b);
    }
  return status == BT_OK ? relax (k, SOLVES_COLD, reaction, nodes, tensions) : status;
}

static bt_status
solve_warm (task *k, bt__reaction *reaction, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_status status = BT_OK;
  double moved = fmax (bt__distance (k->a, nodes[0]), bt__distance (k->b, nodes[k->n]));
  double reach = FOLLOW * moved + DRIFT * k->line->length;
  bt_vec3 way = bt__sub (bt__sub (k->b, k->a), bt__sub (nodes[k->n], nodes[0]));
  if (bt__norm (reaction->pull) > 0)
    *reaction = lesser_reaction (reaction, tensions[0], tensions[k->n]);
  bt__steady_follow (reaction, way);
  if (bt__norm (reaction->pull) > 0 && shoot_near (k, reach, reaction, nodes, tensions, &status))
    return BT_OK;
  return status == BT_OK ? relax (k, SOLVES_WARM, reaction, nodes, tensions) : status;
}

bt_status
bt__equilibrium_solve (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                       bt_vec3 b, int n, int have_shape, bt_vec3 fallback, bt__reaction *reaction,
                       bt_vec3 *nodes, bt_vec3 *tensions, bt__shape_counts *counts, bt_error *error)
{
  task k = { steady, line, water, a, b, n, counts, error };
  bt_status room = bt__steady_room (steady, n, error);
  if (room != BT_OK)
    return room;
  if (!bt__is_finite (a) || !bt__is_finite (b) || !(line->length > 0))
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "a line of %g m between ends that may not be finite; both ends must be finite and "
        "the length positive",
        line->length);
  if (!isfinite (line->ea) && bt__distance (a, b) >= line->length)
    {
      lay_straight (&k, reaction, nodes, tensions);
      return BT_OK;
    }
  return have_shape ? solve_warm (&k, reaction, nodes, tensions)
                    : solve_cold (&k, fallback, reaction, nodes, tensions);
}
