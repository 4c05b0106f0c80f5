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

#define FOLLOW 4.0    /* motion of the line allowed, in units of the motion of its ends ... */
#define DRIFT 0.02    /* ... beyond this, in units of its length */
#define COLD 0.25     /* the same for a line without a present shape, from its catenary */
#define RESOLVED 0.8  /* chord over arc of one interval: a turn of 2.2 rad */
#define POLISHED 0.95 /* the same before a polish is tried: sharper turns defeat shooting */

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

static double
largest_distance (const bt_vec3 *p, const bt_vec3 *q, int n)
{
  double most = 0;
  for (int i = 0; i <= n; i++)
    most = fmax (most, bt__distance (p[i], q[i]));
  return most;
}

/* A root of the discrete march whose turns no interval resolves is not a shape of the line.  */
static int
is_resolved_shape (const bt_vec3 *r, int n, double length, double share)
{
  for (int i = 0; i < n; i++)
    if (!(bt__distance (r[i], r[i + 1]) >= share * length / n))
      return 0;
  return 1;
}

/* Shoot from *PULL.  Take the answer and return true if it lies within REACH of NODES.  *STATUS
   is the solver's.  */
static int
shoot_near (task *k, double reach, bt_vec3 *pull, bt_vec3 *nodes, bt_vec3 *tensions,
            bt_status *status)
{
  bt_steady_report report;
  bt_vec3 trial = *pull, *r = k->steady->shape, *t = k->steady->tensions;
  *status = bt_steady_shoot (k->steady, k->line, k->water, k->a, k->b, k->n, 1, &trial, r, t,
                             &report, k->error);
  k->counts->shots++;
  k->counts->marches += (uint64_t)report.integrations;
  if (*status != BT_OK || !report.converged
      || !is_resolved_shape (r, k->n, k->line->length, RESOLVED)
      || !(largest_distance (r, nodes, k->n) <= reach))
    return 0;
  size_t size = ((size_t)k->n + 1) * sizeof *nodes;
  memcpy (nodes, r, size);
  memcpy (tensions, t, size);
  nodes[k->n] = k->b;
  *pull = trial;
  return 1;
}

/* Relax from NODES, then polish.  *PULL becomes the tension to shoot from next time, zero where
   shooting has no chance.  */
static bt_status
relax (task *k, int solves, bt_vec3 *pull, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_steady_report report;
  bt_status status = bt_steady_relax (k->steady, k->line, k->water, k->a, k->b, k->n, solves, nodes,
                                      tensions, &report, k->error);
  k->counts->relaxations++;
  *pull = bt__vec (0, 0, 0);
  if (status != BT_OK)
    return status;
  if (!report.converged)
    {
      k->counts->unsettled++;
      return BT_OK;
    }
  bt_vec3 trial = tensions[0];
  if (bt__norm (trial) > 0 && is_resolved_shape (nodes, k->n, k->line->length, POLISHED)
      && shoot_near (k, DRIFT * k->line->length, &trial, nodes, tensions, &status))
    *pull = trial;
  return status;
}

/* A line that cannot stretch and spans more than its length: straight.  Its tension is whatever it
   is pulled with, which is not known here.  */
static void
lay_straight (task *k, bt_vec3 *pull, bt_vec3 *nodes, bt_vec3 *tensions)
{
  for (int i = 0; i <= k->n; i++)
    {
      nodes[i] = bt__axpy (k->a, (double)i / k->n, bt__sub (k->b, k->a));
      tensions[i] = bt__vec (0, 0, 0);
    }
  nodes[k->n] = k->b;
  *pull = bt__vec (0, 0, 0);
}

static bt_status
solve_cold (task *k, bt_vec3 fallback, bt_vec3 *pull, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_status status = BT_OK;
  bt__steady_guess (k->line, k->water, k->a, k->b, fallback, k->n, nodes, pull);
  if (bt__norm (*pull) > 0
      && shoot_near (k, COLD * k->line->length, pull, nodes, tensions, &status))
    return BT_OK;
  return status == BT_OK ? relax (k, SOLVES_COLD, pull, nodes, tensions) : status;
}

static bt_status
solve_warm (task *k, bt_vec3 *pull, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt_status status = BT_OK;
  double moved = fmax (bt__distance (k->a, nodes[0]), bt__distance (k->b, nodes[k->n]));
  double reach = FOLLOW * moved + DRIFT * k->line->length;
  if (bt__norm (*pull) > 0 && shoot_near (k, reach, pull, nodes, tensions, &status))
    return BT_OK;
  return status == BT_OK ? relax (k, SOLVES_WARM, pull, nodes, tensions) : status;
}

bt_status
bt__equilibrium_solve (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                       bt_vec3 b, int n, int have_shape, bt_vec3 fallback, bt_vec3 *pull,
                       bt_vec3 *nodes, bt_vec3 *tensions, bt__shape_counts *counts, bt_error *error)
{
  task k = { steady, line, water, a, b, n, counts, error };
  if (n < 1 || n > steady->n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the workspace holds 1 to %d", n,
                     steady->n_max);
  if (!bt__is_finite (a) || !bt__is_finite (b) || !(line->length > 0))
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "a line of %g m between ends that may not be finite; both ends must be finite and "
        "the length positive",
        line->length);
  if (!isfinite (line->ea) && bt__distance (a, b) >= line->length)
    {
      lay_straight (&k, pull, nodes, tensions);
      return BT_OK;
    }
  return have_shape ? solve_warm (&k, pull, nodes, tensions)
                    : solve_cold (&k, fallback, pull, nodes, tensions);
}
