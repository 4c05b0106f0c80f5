/* OrcaFlex's chain on the bottom: see outside.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/outside.h"
#include "testbed/rig.h"

/* WD0050: 410 m of chain from an anchor 400 m off and 50 m down, half of it at rest on the bottom
   (springs of 1e5 Pa/m, by lumps at the nodes), the fairlead heaving.  390 kg/m, 1.674e9 N and
   0.252 m are what OrcaFlex's help ("Chain") makes of studless chain of 0.14 m bar: 19.9 d^2 t/m,
   0.854e8 d^2 kN and 1.80 d.  By the same table such chain touches the bottom with a diameter of
   3.35 d, so that its axis lies half of that above the bottom, and its axial drag is for a diameter
   of d / pi, ours for the circumference: so 1/pi of its coefficient.  The friction of the reference
   is not known; here there is none.  */
const outside_bottom outside_plain_bottom = { 164, 1e5, 1e4, 1 / BT__PI, 0, 3.35 * 0.14 };

enum
{
  CHAIN_MAX = 400
};

#define CHAIN_LENGTH 410.0
#define CHAIN_STEP 0.02 /* s */
#define GRAVITY 9.80665

static void
lie_on_bottom (rig *r, const outside_bottom *b, bt__dynamic_lump *lumps, double bottom)
{
  double l = CHAIN_LENGTH / b->intervals;
  for (int i = 1; i < b->intervals; i++)
    {
      bt_vec3 v = bt__dynamic_v (r->d)[i];
      double deep = bottom + b->contact / 2 - bt__dynamic_x (r->d)[i].z;
      double push
          = fmax (deep > 0 ? b->stiffness * deep - b->damping * v.z : 0, 0) * b->contact * l;
      double drag = b->friction * push / fmax (hypot (v.x, v.y), 0.1);
      lumps[i - 1] = (bt__dynamic_lump){ .from_end = (b->intervals - i) * l,
                                         .force = { -drag * v.x, -drag * v.y, push } };
    }
  r->in.lumps = lumps;
  r->in.n_lumps = b->intervals - 1;
}

static void
open_chain (rig *r, const outside_bottom *b)
{
  bt_vec3 shape[3] = { { 400, 0, -50 }, { 160, 0, -50 }, { 0, 0, 0 } };
  bt_tether_props line = { .diameter = 0.252,
                           .mass = 390,
                           .ea = 1.674e9,
                           .ba = 410.0 / b->intervals * sqrt (1.674e9 * 390), /* critical */
                           .cdn = 1.37,
                           .cdt = 0.64 * b->along,
                           .ca = 1 };
  line.wet_weight = (390 - 1025 * BT__PI * 0.252 * 0.252 / 4) * GRAVITY;
  rig_open (r, line, 1025, b->intervals, shape, 3, CHAIN_LENGTH);
  r->in.tolerance = 1e-8;
}

/* The height of the fairlead of MOTION at time T, by the cubic through four rows.  */
static double
heave (const outside_table *motion, double t)
{
  double u = (t - motion->at[0][0]) / 0.1;
  int k = (int)fmin (fmax (u - 1, 0), motion->rows - 4);
  double sum = 0;
  for (int i = k; i < k + 4; i++)
    {
      double p = motion->at[i][3];
      for (int j = k; j < k + 4; j++)
        p *= j == i ? 1 : (u - j) / (i - j);
      sum += p;
    }
  return sum;
}

/* Heave the chain R through MOTION; fill in *HISTORY at the moments of DATA.  */
static void
heave_chain (rig *r, const outside_bottom *bottom, bt__dynamic_lump *lumps,
             const outside_table *motion, const outside_table *data, outside_history *history)
{
  history->rows = 0;
  for (int i = 1; r->good && i <= 1500; i++)
    {
      double t = -10 + i * CHAIN_STEP;
      r->in.end[1].at.z = heave (motion, t);
      lie_on_bottom (r, bottom, lumps, -50);
      rig_step (r, CHAIN_STEP);
      int row = (int)floor (t * 10 + 0.5);
      if (t < -CHAIN_STEP / 2 || fabs (t * 10 - row) > 1e-6 || row >= data->rows)
        continue;
      history->t[history->rows] = t;
      history->ours[history->rows] = bt__dynamic_node_tension (r->d, bottom->intervals) / 1e3;
      history->theirs[history->rows++] = data->at[row][3];
    }
}

outside_result
outside_chain (int which, const outside_bottom *bottom, outside_history *history)
{
  static outside_table motion, data;
  static bt__dynamic_lump lumps[CHAIN_MAX];
  char file[2][80];
  rig r;
  snprintf (file[0], sizeof file[0], "published/orcaflex_motion_ZZP1_A%d.csv", which);
  snprintf (file[1], sizeof file[1], "published/orcaflex_WD0050_ZZP1_A%d.csv", which);
  if (!outside_load (file[0], 4, &motion) || !outside_load (file[1], 5, &data) || motion.rows < 4)
    return OUTSIDE_NO_DATA;
  open_chain (&r, bottom);
  for (int i = 0; r.good && i < 30000; i++)
    {
      lie_on_bottom (&r, bottom, lumps, -50);
      rig_step (&r, CHAIN_STEP);
    }
  for (int e = 0; r.good && e < 2; e++)
    history->rest[e] = bt__dynamic_node_tension (r.d, e ? 0 : bottom->intervals) / 1e3;
  heave_chain (&r, bottom, lumps, &motion, &data, history);
  return rig_close (&r) ? OUTSIDE_DONE : OUTSIDE_FAILED;
}
