/* The order in which the tethers of a step are resolved: tethers that move a vehicle come before
   tethers that follow one.

   A tether resolved before its vehicle moves would end at the vehicle's old place.  A vehicle with
   mass is moved by its carrying line, and any vehicle may be held back by a moving line.  So
   carrying lines go first, each after the carrying line of its own anchor; then the other moving
   lines; then the static tethers, which end at any given place.  Exception: a static tether among
   obstacles may draw its vehicle along, for example when hauled in over an edge, and goes before
   all tethers unless a line carries its vehicle.  A line beside the hull of another line's vehicle
   goes after that line (hulls.c).  Within a rank the order stays: by number, or among obstacles by
   the direction of pressing of tethers on each other (chain_touch.c).  If ends and vehicles still
   do not fit together, the step is tried again (pins.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "sim/around.h"
#include "sim/chain.h"

/* The line that carries the vehicle at end K of tether I, or -1.  */
static int
carrier_at (const bt_dive *dive, bt__state *state, int i, int k)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  int line = vehicle < 0 ? -1 : bt__carrier (dive, state, vehicle);
  return line >= 0 && bt__carried_vehicle (dive, state, line) >= 0 ? line : -1;
}

/* True if the static tether I, among obstacles, may draw its vehicle along.  */
static int
may_draw (const bt_dive *dive, bt__state *state, int i)
{
  return bt__has_obstacles (dive) && carrier_at (dive, state, i, 0) < 0
         && carrier_at (dive, state, i, 1) < 0;
}

/* The rank of tether I; lower ranks go first.  Lines that carry each other in a ring have the
   highest rank of carrying lines.  */
static int
rank_of (const bt_dive *dive, bt__state *state, int i)
{
  int most = dive->model->n_vehicles, rank = 0;
  if (!bt__is_moving_model (bt__dive_tether (dive, state, i)))
    return may_draw (dive, state, i) ? -1 : most + 2;
  if (bt__carried_vehicle (dive, state, i) < 0)
    return most + 1;
  for (int j = carrier_at (dive, state, i, 0); j >= 0 && rank < most;
       j = carrier_at (dive, state, j, 0))
    rank++;
  return rank;
}

/* True if tether I meets the hull of the vehicle at the far end of tether J.  */
static int
meets_hull_of (const bt_dive *dive, int i, int j)
{
  int vehicle = dive->model->ends[j][1].vehicle;
  return vehicle >= 0 && bt__is_by_hull (dive, i, vehicle);
}

/* Put lines beside a hull after the line to the vehicle, unless both are beside the hulls of each
   other's vehicles.  */
static void
put_behind_hulls (const bt_dive *dive)
{
  int *order = dive->contact_work.order, n = dive->model->n_tethers;
  for (int p = 0; p < n && dive->model->n_hulls > 0; p++)
    for (int q = p + 1; q < n; q++)
      {
        int i = order[p], j = order[q];
        if (!meets_hull_of (dive, i, j) || meets_hull_of (dive, j, i))
          continue;
        memmove (order + p + 1, order + p, sizeof *order * (size_t)(q - p));
        order[p] = j;
      }
}

void
bt__put_carriers_first (bt_dive *dive, bt__state *state)
{
  int *order = dive->contact_work.order, n = dive->model->n_tethers, rank[BT_TETHERS_MAX];
  for (int i = 0; i < n; i++)
    rank[i] = rank_of (dive, state, i);
  for (int k = 1; k < n; k++)
    {
      int i = order[k], at = k;
      for (; at > 0 && rank[order[at - 1]] > rank[i]; at--)
        order[at] = order[at - 1];
      order[at] = i;
    }
  put_behind_hulls (dive);
  for (int k = 0; k < n; k++)
    dive->contact_work.place[order[k]] = k;
}
