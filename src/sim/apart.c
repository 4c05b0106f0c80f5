/* Islands: groups of tethers that may influence each other in the coming step.

   Two tethers form an island in three cases: the far end of either may carry a vehicle of both;
   either may meet the hull of a vehicle at the far end of the second; both are moving lines and may
   touch within the reach of their queries.  Distances are bounded by boxes: about each line, about
   every few links, then link by link.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/share.h"
#include "world/obstacles.h"

/* ---- Groups ---- */

/* The first tether of the group of I: until they are numbered a group points to earlier ones.  */
static int
root_of (const bt__contexts *l, int i)
{
  while (l->group[i] != i)
    i = l->group[i];
  return i;
}

static void
join (bt__contexts *l, int i, int j)
{
  int a = root_of (l, i), b = root_of (l, j);
  if (a < b)
    l->group[b] = a;
  else
    l->group[a] = b;
}

static void
join_at_vehicles (const bt_dive *dive, bt__contexts *l)
{
  const bt_model *model = dive->model;
  for (int i = 0; i < model->n_tethers; i++)
    for (int j = 0; j < model->n_tethers; j++)
      if (model->ends[i][1].vehicle >= 0
          && (model->ends[j][0].vehicle == model->ends[i][1].vehicle
              || model->ends[j][1].vehicle == model->ends[i][1].vehicle))
        join (l, i, j);
}

/* A line that meets a hull goes after the line that carries the vehicle.  */
static void
join_at_hulls (const bt_dive *dive, bt__contexts *l)
{
  const bt_model *model = dive->model;
  for (int i = 0; i < model->n_tethers; i++)
    for (int j = 0; j < model->n_tethers; j++)
      for (int k = 0; k < 2; k++)
        if (model->ends[j][k].vehicle >= 0 && bt__is_by_hull (dive, i, model->ends[j][k].vehicle))
          join (l, i, j);
}

/* Number the groups in the order of their first tethers, and list the tethers of each group.  */
static void
number (const bt_dive *dive, bt__contexts *l)
{
  int n = dive->model->n_tethers, root[BT_TETHERS_MAX], of[BT_TETHERS_MAX];
  for (int i = 0; i < n; i++)
    {
      root[i] = root_of (l, i);
      of[i] = -1;
    }
  l->groups = 0;
  for (int p = 0; p < n; p++)
    {
      int i = dive->contact_work.order[p], g = of[root[i]];
      if (g < 0)
        l->first[g = of[root[i]] = l->groups++] = i;
      else
        l->after[l->last[g]] = i;
      l->last[g] = i;
      l->after[i] = -1;
      l->group[i] = g;
    }
}

static void
mark_shared (const bt_dive *dive, bt__contexts *l)
{
  int of[BT_VEHICLES_MAX];
  for (int v = 0; v < dive->model->n_vehicles; v++)
    {
      of[v] = -1;
      l->shared[v] = 0;
    }
  for (int i = 0; i < dive->model->n_tethers; i++)
    for (int k = 0; k < 2; k++)
      {
        int v = dive->model->ends[i][k].vehicle;
        if (v < 0)
          continue;
        l->shared[v] = l->shared[v] || (of[v] >= 0 && of[v] != l->group[i]);
        of[v] = l->group[i];
      }
}

/* ---- Boxes ---- */

static int
leaves_of (const bt__dynamic *chain)
{
  return (int)(chain->n + BT__LANE_LEAF - 1) / BT__LANE_LEAF;
}

/* Boxes about the leaves of PART of tether I.  */
static void
box_leaves (const bt_dive *dive, bt__state *state, bt__contexts *l, int i, int part)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  const bt_vec3 *x = bt__dynamic_x (chain);
  bt__aabb *box = l->box + l->box_at[i] + l->boxes[i];
  for (int n = 0; n < leaves_of (chain); n++)
    {
      int from = n * BT__LANE_LEAF;
      box[n] = (bt__aabb){ x[from], x[from] };
      for (int k = from + 1; k <= chain->n && k <= from + BT__LANE_LEAF; k++)
        box[n] = bt__box_with (box[n], x[k]);
    }
  l->boxes[i] += leaves_of (chain);
}

/* One box about all the places that tether I has in its stretch.  */
static void
box_stretch (const bt_dive *dive, bt__state *state, bt__contexts *l, int i)
{
  l->whole[i] = l->box[l->box_at[i]] = bt__box_of_stretch (dive, state, i);
  l->boxes[i] = 1;
}

/* Give every moving line the box about its parts, drawn before.  */
static void
box_tethers (const bt_dive *dive, bt__state *state, bt__contexts *l)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      const bt__tether *tether = bt__dive_tether (dive, state, i);
      const bt__aabb *part = dive->contact_work.box + 2 * i;
      l->boxes[i] = 0;
      if (bt__is_ahead (tether))
        box_stretch (dive, state, l, i);
      if (!bt__is_cable (tether) || bt__is_ahead (tether))
        continue;
      l->whole[i] = part[0];
      if (tether->parted)
        l->whole[i] = bt__box_with (bt__box_with (part[0], part[1].lo), part[1].hi);
      for (int k = 0; k < bt__chains (tether); k++)
        box_leaves (dive, state, l, i, k);
    }
}

/* ---- Nearness ---- */

/* Links FROM to TO, less one, at X.  */
typedef struct leaf
{
  const bt_vec3 *x;
  int from, to;
} leaf;

/* Leaf N of tether I, those of its parts counted on.  */
static leaf
leaf_of (const bt_dive *dive, bt__state *state, int i, int n)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  if (n >= leaves_of (chain))
    {
      n -= leaves_of (chain);
      chain = bt__dive_chain (dive, state, i, 1);
    }
  int to = (n + 1) * BT__LANE_LEAF;
  return (leaf){ bt__dynamic_x (chain), n * BT__LANE_LEAF, to < chain->n ? to : (int)chain->n };
}

static int
leaves_meet (leaf a, leaf b, double gap)
{
  for (int i = a.from; i < a.to; i++)
    for (int j = b.from; j < b.to; j++)
      {
        double u, v;
        bt_vec3 d = bt__sub (a.x[i + 1], a.x[i]), e = bt__sub (b.x[j + 1], b.x[j]);
        bt_vec3 r = bt__sub (a.x[i], b.x[j]);
        bt__closest_segments (r, d, e, &u, &v);
        if (!(bt__norm (bt__axpy (bt__axpy (r, u, d), -v, e)) > gap))
          return 1;
      }
  return 0;
}

/* True if links of tethers I and J are nearer than GAP.  */
static int
tethers_meet (const bt_dive *dive, bt__state *state, const bt__contexts *l, int i, int j,
              double gap)
{
  const bt__aabb *a = l->box + l->box_at[i], *b = l->box + l->box_at[j];
  int told = bt__is_ahead (bt__dive_tether (dive, state, i))
             || bt__is_ahead (bt__dive_tether (dive, state, j)); /* by boxes alone */
  for (int m = 0; m < l->boxes[i]; m++)
    if (bt__boxes_are_near (&a[m], &l->whole[j], gap))
      for (int n = 0; n < l->boxes[j]; n++)
        if (bt__boxes_are_near (&a[m], &b[n], gap)
            && (told
                || leaves_meet (leaf_of (dive, state, i, m), leaf_of (dive, state, j, n), gap)))
          return 1;
  return 0;
}

/* True if either of tethers I and J may touch the other.  */
static int
may_touch (const bt_dive *dive, bt__state *state, int i, int j)
{
  return !bt__passes_tether (dive, state, i, j) || !bt__passes_tether (dive, state, j, i);
}

/* True if the tethers I and J may influence each other; WAY has the distance, m, that each tether
   may move or ask for.  */
static int
are_close (const bt_dive *dive, bt__state *state, const bt__contexts *l, int i, int j,
           const double *way)
{
  double gap = way[i] + way[j] + bt__dive_tether (dive, state, i)->props.diameter
               + bt__dive_tether (dive, state, j)->props.diameter;
  return l->boxes[i] > 0 && l->boxes[j] > 0 && bt__boxes_are_near (&l->whole[i], &l->whole[j], gap)
         && may_touch (dive, state, i, j) && tethers_meet (dive, state, l, i, j, gap);
}

static void
join_near (const bt_dive *dive, bt__state *state, bt__contexts *l)
{
  int n = dive->model->n_tethers;
  box_tethers (dive, state, l);
  for (int i = 0; i < n; i++)
    for (int j = i + 1; j < n; j++)
      if (root_of (l, i) != root_of (l, j) && are_close (dive, state, l, i, j, l->margin))
        join (l, i, j);
}

int
bt__were_apart (const bt_dive *dive, bt__contexts *l)
{
  int n = dive->model->n_tethers;
  for (int i = 0; i < n; i++)
    for (int j = i + 1; j < n; j++)
      if (l->group[i] != l->group[j] && are_close (dive, dive->now, l, i, j, l->asked))
        return 0;
  return 1;
}

void
bt__set_apart (const bt_dive *dive, bt__state *state, bt__contexts *l)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    l->group[i] = i;
  join_at_vehicles (dive, l);
  join_at_hulls (dive, l);
  join_near (dive, state, l);
  number (dive, l);
  mark_shared (dive, l);
}
