/* The moving line: what pulls at its ends.

   An end node has the equation of any inner node: mass, weight and drag of half an interval, the
   tension of one interval, lumps, waves, bending and contacts; the holder's force closes the
   equation.  The pull on the holder is the sum of all the remaining forces, and the pulls at both
   ends balance the loads and the inertia of the whole line.

   The sum is taken at the solution of a step.  Tensions are the multipliers of the last iteration;
   every other force is evaluated at the final places of the nodes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

static int
node_of (const bt__dynamic_work *w, int k)
{
  return k ? w->n : 0;
}

static bt_vec3
chord_at (const bt__dynamic_work *w, int j)
{
  bt_vec3 c = bt__sub (w->X[j + 1], w->X[j]);
  return w->chord ? bt__add (c, w->chord[j]) : c;
}

/* The pull of interval J along itself, N: negative if the interval pushes.  */
static double
pull_along (const bt__dynamic_work *w, int j)
{
  double change = bt__norm (chord_at (w, j)) - w->link[j].start;
  return w->lam[j] - w->link[j].thrust + bt__dynamic_slack (w, j) * change;
}

/* The pull of the interval at end K, out of the end.  */
static bt_vec3
interval_pull (const bt__dynamic_work *w, int k)
{
  int j = k ? w->n - 1 : 0;
  double pull = pull_along (w, j);
  return bt__scale (k ? -pull : pull, bt__unit_or (chord_at (w, j), w->link[j].t));
}

double
bt__dynamic_overload (bt__dynamic_work *w)
{
  return fmin (bt__norm (bt__dynamic_end_pull (w, 0)) - w->in->hold, pull_along (w, 0));
}

/* The force of the lumps at node I without the body of end K, which is pulled by the line.  */
static bt_vec3
lumps_pull (const bt__dynamic_work *w, int k, int i)
{
  bt__extra body = { 0 };
  if (w->in->end[k].free)
    bt__dynamic_lump_add (w, &body, &w->in->end[k].body, 1);
  bt__past past = bt__dynamic_past (w, i);
  bt_vec3 all = bt__dynamic_lump_force (w, i, w->extra + i, &past),
          own = bt__dynamic_lump_force (w, i, &body, &past);
  double lift = w->extra[i].lift - body.lift;
  bt_vec3 f = bt__sub (all, own);
  f.z -= lift * bt__dynamic_out_of_water (w, i);
  return f;
}

bt_vec3
bt__dynamic_end_pull (bt__dynamic_work *w, int k)
{
  int i = node_of (w, k);
  bt_vec3 f = bt__add (interval_pull (w, k), bt__dynamic_node_load (w, i));
  if (w->load)
    f = bt__add (f, w->load[i]);
  if (w->lumped)
    f = bt__add (f, lumps_pull (w, k, i));
  if (w->bends > 0)
    f = bt__add (f, bt__dynamic_bend_on (w, i));
  if (w->rows > 0)
    f = bt__add (f, bt__dynamic_contact_on (w, i));
  return f;
}
