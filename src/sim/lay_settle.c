/* A moving line that bends begins at rest: its equilibrium with clamps, sets and bending stiffness.

   The static equilibria know no bending.  From such an equilibrium the line is stepped while the
   clock stands, each step from a stop and longer than the last, until steps are so long that
   inertia and damping count for nothing (pseudo-transient continuation, C. T. Kelley and D. E.
   Keyes 1998).  Steps are measured by sqrt (length / g), so that a line and its model to scale take
   the same steps.  Contacts are left out, as in the equilibria.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/chain.h"
#include "sim/lay.h"

#define GRAVITY 9.81   /* m/s2, of the unit of time */
#define FIRST 0.02     /* of the unit: the first step, ... */
#define LEAST 1e-3     /* ... the shortest, ... */
#define LONGEST 1e4    /* ... and the longest */
#define GROWTH 1.3     /* from a solved step to the next; one that is not is followed by ... */
#define SHRINK 0.25    /* ... one so many times as long */
#define TOLERANCE 1e-8 /* of the length, of a step */
#define WORK 4e6       /* linear solves times nodes */
#define STEPS 600
#define LONG_STEPS 6 /* solved steps of the greatest length after which the line rests */

/* Step tether I by INPUT to its rest; *RESTS: true if it was reached.  */
static bt_status
step_to_rest (bt_dive *dive, bt__dynamic *chain, bt__dynamic_input *input, int *rests,
              bt_error *error)
{
  double unit = sqrt (bt__dynamic_length (chain) / GRAVITY), h = FIRST * unit;
  int64_t most = (int64_t)(WORK / (double)(chain->n + 1)), solves = 0;
  int calm = 0;
  for (int k = 0; k < STEPS && calm < LONG_STEPS && solves < most && h > LEAST * unit; k++)
    {
      bt__dynamic_report report;
      input->h = h;
      bt_status status = bt__dynamic_step (chain, dive->work, input, &report, NULL);
      bt__dynamic_still (chain);
      solves += report.solves;
      calm += status == BT_OK && report.converged && h >= LONGEST * unit;
      h = status == BT_OK && report.converged ? fmin (GROWTH * h, LONGEST * unit) : SHRINK * h;
      status = bt__poll (dive, (double)k / STEPS, error);
      if (status != BT_OK)
        return status;
    }
  *rests = calm >= LONG_STEPS;
  return BT_OK;
}

/* Without twist first, and gripped as the line then lies; what a set twists comes after.  */
static bt_status
settle_untwisted (bt_dive *dive, bt__dynamic *chain, bt__dynamic_input *input, int *rests,
                  bt_error *error)
{
  const bt_tether_props *props = input->line;
  bt_tether_props limp = *props;
  limp.gj = 0;
  input->line = &limp;
  bt_status status = step_to_rest (dive, chain, input, rests, error);
  input->line = props;
  if (status == BT_OK && bt__twists (input) && input->n_sets > 0)
    status = step_to_rest (dive, chain, input, rests, error);
  return status;
}

bt_status
bt__settle_bent (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  bt_water water = bt__dive_water (dive, state);
  bt__dynamic_input input = bt__chain_input (dive, state, i, &water, ends);
  bt__fastened fastened;
  int rests = 0;
  bt__fasten (dive, i, 0, INFINITY, &input, &fastened);
  if (input.n_sets == 0 && !bt__is_clamped_at_all (dive, i))
    return BT_OK;
  input.end[1].free = input.end[1].gripped = 0;
  input.end[1].at = ends->b;
  input.tolerance = TOLERANCE;
  bt_status status = settle_untwisted (dive, chain, &input, &rests, error);
  bt__dive_tether (dive, state, i)->quiet = 0;
  return status == BT_OK && !rests ? bt__fall (dive, state, i, ends, error) : status;
}
