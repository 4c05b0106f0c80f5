/* A slack line is laid on the bed below it.

   The equilibrium from which a line is laid knows no bed.  A bight of the equilibrium hangs below
   the bed, with two feet on the bed.  The bight is laid aside by a rotation about the straight line
   between the feet, and keeps length and wide bends.  Were the nodes led straight to the
   equilibrium, the bed would stop the nodes, and the length of the bight would fall into a heap of
   hundreds of links in contact.  The bed is a single obstacle below all of the bight, both hanging
   and laid aside, and below the clear way from which the line is led.  Over several obstacles,
   under a roof, and where the ground rises aside, the nodes are led straight (lay_way.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "math/vec.h"
#include "sim/chain.h"
#include "sim/lay.h"
#include "world/obstacles.h"

/* How high the middle of tether I is laid above the bed, m: clear of the bed by a radius, and of
   the tethers laid before, on which tether I comes down.  */
static double
height_of (const bt_dive *dive, bt__state *state, int i)
{
  double height = bt__dive_tether (dive, state, i)->props.diameter;
  for (int j = 0; j < i; j++)
    height += 2 * bt__dive_tether (dive, state, j)->props.diameter;
  return height;
}

/* The height at which the line of tether I lies on what is below the place of P, seen from the
   height TOP; the obstacle there, or BT__NO_OBSTACLE.  */
static double
lies_at (const bt_dive *dive, bt__state *state, int i, bt_vec3 p, double top, int *obstacle)
{
  p.z = top;
  return top - bt__dive_altitude (dive, state, p, obstacle) + height_of (dive, state, i);
}

/* The one obstacle below all nodes X of A, as seen from the WAY, or BT__NO_OBSTACLE.  */
static int
bed_of (const bt_dive *dive, bt__state *state, int i, const bt_vec3 *x, const bt_vec3 *way,
        const bt__arch *a)
{
  int bed = BT__NO_OBSTACLE;
  for (int k = a->first; k <= a->last; k++)
    {
      int below;
      lies_at (dive, state, i, x[k], way[k].z, &below);
      if (k > a->first && below != bed)
        return BT__NO_OBSTACLE;
      bed = below;
    }
  return bed;
}

/* Take the nodes X of A to the bed; return zero if a node then lies above the WAY: the bed rises
   aside, or is a roof.  */
static int
put_down (const bt_dive *dive, bt__state *state, int i, bt_vec3 *x, const bt_vec3 *way,
          const bt__arch *a)
{
  double spare = height_of (dive, state, i);
  int below = 1, unused;
  for (int k = a->first; k <= a->last; k++)
    {
      x[k].z = lies_at (dive, state, i, x[k], way[k].z, &unused);
      below &= x[k].z <= way[k].z + spare;
    }
  return below;
}

int
bt__lay_on_bed (bt_dive *dive, bt__state *state, int i, const bt_vec3 *way, int n)
{
  bt_vec3 *x = dive->polyline, *kept = dive->motion;
  double *over = dive->over;
  bt_water water = bt__dive_water (dive, state);
  bt__arch a;
  int unused, laid = 0;
  for (int k = 0; k <= n; k++)
    over[k] = lies_at (dive, state, i, x[k], way[k].z, &unused) - x[k].z;
  over[0] = over[n] = -1; /* the ends stay */
  for (int k = 0; bt__next_arch (x, over, n, k, &a); k = a.last + 1)
    {
      size_t size = sizeof *x * (size_t)(a.last - a.first + 1);
      int bed = bed_of (dive, state, i, x, way, &a);
      memcpy (kept, x + a.first, size);
      bt__lay_aside (x, &a, 0, bt_water_velocity (&water, a.from));
      if (bed != BT__NO_OBSTACLE && bed_of (dive, state, i, x, way, &a) == bed
          && put_down (dive, state, i, x, way, &a))
        laid = 1;
      else
        memcpy (x + a.first, kept, size);
    }
  return laid;
}
