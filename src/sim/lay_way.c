/* Laying a moving line among obstacles: from its corners towards its equilibrium without obstacles,
   by the safe step: each node stops before passing through an obstacle.

   Nodes stopped by an obstacle stay; the rest go on until the line has its length.  The line begins
   with intervals nearly as long as their chords, and neither bursts apart nor snaps together in its
   first step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/lay.h"
#include "world/obstacles.h"

enum
{
  ROUNDS = 200
};

#define STRIDE_LEAST 0.25 /* m a round */
#define IDLE 1e-3         /* of the stride: a round in which no node goes farther is the last */
#define ROOMY 1.02        /* times the radius */

/* The longest way that one of the N + 1 nodes X has to WANT.  */
static double
longest_way (const bt_vec3 *x, const bt_vec3 *want, int n)
{
  double most = 0;
  for (int k = 0; k <= n; k++)
    most = fmax (most, bt__distance (x[k], want[k]));
  return most;
}

/* The clearance, m, at which the line X of tether I is led past obstacles: the radius and a little
   more, so contact need not push the line off, and nodes may be taken out; but at most the present
   clearance.  */
static double
keep_off (bt_dive *dive, bt__state *state, int i, const bt_vec3 *x, int n)
{
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  double diameter = bt__dive_tether (dive, state, i)->props.diameter, off = ROOMY * diameter / 2;
  bt__near near;
  for (int k = 0; k < n; k++)
    off = bt__room_about (dive, &around, &(bt__link){ x[k], x[k + 1] }, off, &near);
  return fmax (bt__core (diameter), 0.999 * off);
}

/* Lead the N + 1 nodes X toward WANT by one stride.  */
static void
lead (bt_dive *dive, const bt__surroundings *around, const bt__safe_config *config, bt_vec3 *x,
      const bt_vec3 *want, int n)
{
  bt__safe_report report;
  bt__safe_step (dive->contact_work.safe, config, around->scene, around->on, around->mover,
                 around->movers, x, want, (uint32_t)n + 1, &report, &dive->contact_work.count);
}

bt_status
bt__lead_to_rest (bt_dive *dive, bt__state *state, int i, bt_vec3 *x, int n, int *there,
                  bt_error *error)
{
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  const bt_vec3 *want = dive->polyline;
  bt_vec3 *before = dive->motion;
  double left = longest_way (x, want, n), gone = INFINITY;
  double length
      = fmax (bt__length (want, (uint32_t)n + 1), bt__dive_tether (dive, state, i)->length);
  bt__safe_config config = { .core = keep_off (dive, state, i, x, n),
                             .stride = fmax (STRIDE_LEAST, 2 * left / ROUNDS),
                             .rounds = 1 };
  bt_status status = bt__dive_safe (dive, error);
  if (status != BT_OK)
    return status;
  bt__safe_forget (dive->contact_work.safe);
  dive->contact_work.safe_of = -1;
  for (int k = 0; status == BT_OK && left > 0 && gone > IDLE * config.stride && k < ROUNDS; k++)
    {
      memcpy (before, x, sizeof *x * (size_t)(n + 1));
      lead (dive, &around, &config, x, want, n);
      left = longest_way (x, want, n);
      gone = longest_way (x, before, n);
      if (left > 0 && bt__length (x, (uint32_t)n + 1) > length)
        {
          memcpy (x, before, sizeof *x * (size_t)(n + 1));
          gone = 0;
        }
      status = bt__poll (dive, (double)k / ROUNDS, error);
    }
  *there = left == 0;
  return status;
}
