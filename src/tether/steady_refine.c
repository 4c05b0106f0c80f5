/* The line in a current, solved until its nodes and tensions are right to a millionth of the length
   and of the largest tension.

   Newton's method on the pull at the end where the march begins: each iteration is one march, which
   brings its own derivatives (steady_lanes.c).  The last correction moves all nodes by their
   derivatives and needs no march.  A line whose ends moved a little begins from the
   last pull, corrected by the stiffness that the line had, and mostly needs one march.

   Each step of a march may miss a small part (FINE) of what is asked, at the far end of the line
   and in the pull that brings the far end back.  The march of a nearly taut line, whose pull
   changes much with the far end, is therefore more accurate.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "tether/steady.h"

#define FINE 3e-8   /* of the length and the tension: the error of a step ... */
#define COARSE 1e-5 /* ... and of one far from the answer */
#define NEAR 0.02   /* of the length and the pull: a miss from which fine steps pay */
#define LAST 5e-5   /* of the same: an iteration from such a miss is the last */
#define ALIKE 2.0   /* ratio of the stiffness of two marches that tell of one another */
#define STRIDE 0.5  /* of the pull: the largest correction that is made */

enum
{
  ITERATIONS = 14
};

/* ---- Reading a march ---- */

static bt_vec3
node_in_lane (double at[6][BT__FOUR], int from, int lane)
{
  return bt__vec (at[from][lane], at[from + 1][lane], at[from + 2][lane]);
}

/* The far end of the march with PULL in AT, m from its beginning, and in COLUMN its derivatives by
   the pull, m/N.  */
static bt_vec3
end_of_march (const bt__shot *shot, bt_vec3 pull, double (*at)[6][BT__FOUR], bt_vec3 column[3])
{
  double probe = BT__PROBE * bt__norm (pull);
  bt_vec3 end = node_in_lane (at[shot->n], 0, 0);
  for (int k = 0; k < 3; k++)
    column[k] = bt__scale (1 / probe, bt__sub (node_in_lane (at[shot->n], 0, k + 1), end));
  return end;
}

/* The tension at the far end, N.  */
static double
tension_at_end (const bt__shot *shot, double (*at)[6][BT__FOUR])
{
  return bt__norm (node_in_lane (at[shot->n], 3, 0));
}

/* The vector at FROM of a node, as the pull grows by SHARE of the probe along x, y and z.  */
static bt_vec3
corrected (double at[6][BT__FOUR], int from, bt_vec3 share)
{
  bt_vec3 v = node_in_lane (at, from, 0), sum = v;
  sum = bt__axpy (sum, share.x, bt__sub (node_in_lane (at, from, 1), v));
  sum = bt__axpy (sum, share.y, bt__sub (node_in_lane (at, from, 2), v));
  return bt__axpy (sum, share.z, bt__sub (node_in_lane (at, from, 3), v));
}

static double
square (bt_vec3 v)
{
  return bt__dot (v, v);
}

/* Read the nodes R and tensions T of the line whose pull is MORE than PULL, a first-order
   correction of the march in AT; with BACKWARD true the march began at the last node.  Return the
   largest change of a tension by the correction, over the tension.  */
static double
read_march (const bt__shot *shot, bt_vec3 pull, bt_vec3 more, double (*at)[6][BT__FOUR],
            int backward, bt_vec3 *r, bt_vec3 *t)
{
  bt_vec3 share = bt__scale (1 / (BT__PROBE * bt__norm (pull)), more);
  double most = 0;
  for (int i = 0; i <= shot->n; i++)
    {
      int k = backward ? shot->n - i : i;
      bt_vec3 tension = corrected (at[i], 3, share), before = node_in_lane (at[i], 3, 0);
      most = fmax (most, square (bt__sub (tension, before)) / square (before));
      r[k] = bt__add (shot->a, corrected (at[i], 0, share));
      t[k] = bt__scale (backward ? -1 : 1, tension);
    }
  return sqrt (most);
}

/* ---- Iterating ---- */

/* The inverse, in ROW, of the matrix with the columns C; not finite if there is none.  As rows and
   columns change places, the same function takes rows to columns.  */
static void
invert_columns (const bt_vec3 c[3], bt_vec3 row[3])
{
  bt_vec3 p = bt__cross (c[1], c[2]);
  double det = bt__dot (c[0], p);
  row[0] = bt__scale (1 / det, p);
  row[1] = bt__scale (1 / det, bt__cross (c[2], c[0]));
  row[2] = bt__scale (1 / det, bt__cross (c[0], c[1]));
}

static double
stiffness_norm (const bt_vec3 row[3])
{
  return sqrt (bt__dot (row[0], row[0]) + bt__dot (row[1], row[1]) + bt__dot (row[2], row[2]));
}

static int
is_like (const bt_vec3 row[3], const bt_vec3 other[3])
{
  double ratio = stiffness_norm (row) / stiffness_norm (other);
  return ratio < ALIKE && ratio > 1 / ALIKE;
}

/* Aim at fine steps, by the stiffness of REACTION, if that is known and NEAR the answer.  */
static bt__aim
aim_at (const bt__shot *shot, const bt__reaction *reaction, double tension, int near)
{
  bt__aim aim = { .known = near && stiffness_norm (reaction->stiffness) > 0 };
  double error = aim.known ? FINE : COARSE;
  aim.place = error * shot->length;
  aim.tension = error * tension;
  aim.turn = error;
  if (aim.known)
    {
      invert_columns (reaction->stiffness, aim.column);
      memcpy (aim.stiffness, reaction->stiffness, sizeof aim.stiffness);
    }
  return aim;
}

/* Iterate from *REACTION; leave the nodes in R and T.  Return true if they are the line's.  */
static int
iterate_shot (bt_steady *steady, bt__reaction *reaction, bt_vec3 *r, bt_vec3 *t,
              bt_steady_report *report)
{
  bt__shot *shot = &steady->shot;
  bt_vec3 column[3];
  double tension = bt__norm (reaction->pull), off = 0;
  for (int i = 0; i < ITERATIONS && !bt__ask (shot->asker); i++)
    {
      bt__aim aim = aim_at (shot, reaction, tension, off <= NEAR);
      double size = bt__norm (reaction->pull);
      report->iterations++;
      if (!bt__fit_march (shot, reaction->pull, &aim, steady->lanes))
        return 0;
      bt_vec3 miss
          = bt__sub (shot->chord, end_of_march (shot, reaction->pull, steady->lanes, column));
      invert_columns (column, reaction->stiffness);
      bt_vec3 more = bt__stiffness_times (reaction->stiffness, miss);
      off = fmax (bt__norm (more) / size, bt__norm (miss) / shot->length);
      if (!isfinite (off))
        return 0;
      tension = fmax (size, tension_at_end (shot, steady->lanes));
      if (off <= LAST && aim.known && is_like (aim.stiffness, reaction->stiffness)
          && read_march (shot, reaction->pull, more, steady->lanes, reaction->at_b != 0, r, t)
                 <= LAST)
        {
          reaction->pull = bt__add (reaction->pull, more);
          report->residual = bt__norm (miss);
          return 1;
        }
      reaction->pull = bt__axpy (reaction->pull, fmin (1, STRIDE * size / bt__norm (more)), more);
    }
  return 0;
}

bt_status
bt__steady_refine (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                   bt_vec3 b, int n, bt__reaction *reaction, bt_vec3 *r, bt_vec3 *t,
                   bt_steady_report *report, bt_error *error)
{
  bt__reaction trial = *reaction;
  bt_vec3 from = trial.at_b ? b : a, to = trial.at_b ? a : b;
  bt_status status = bt__shot_begin (steady, line, water, from, to, n, error);
  *report = (bt_steady_report){ 0, 0, 0, line->length };
  if (status != BT_OK)
    return status;
  report->converged = iterate_shot (steady, &trial, r, t, report);
  int marches = steady->shot.marches;
  if (!report->converged)
    {
      /* GSL's method comes from farther away.  */
      trial = *reaction;
      memset (trial.stiffness, 0, sizeof trial.stiffness);
      status
          = bt_steady_shoot (steady, line, water, from, to, n, 1, &trial.pull, r, t, report, error);
      marches += report->integrations;
      steady->shot.marches = 0;
      report->converged = report->converged && iterate_shot (steady, &trial, r, t, report);
      marches += steady->shot.marches;
    }
  report->integrations = marches;
  if (report->converged)
    *reaction = trial;
  return status;
}

void
bt__steady_follow (bt__reaction *reaction, bt_vec3 way)
{
  bt_vec3 more
      = bt__stiffness_times (reaction->stiffness, bt__scale (reaction->at_b ? -1 : 1, way));
  if (bt__norm (more) <= STRIDE * bt__norm (reaction->pull))
    reaction->pull = bt__add (reaction->pull, more);
}
