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

/* What a line is laid among.  */
typedef struct ground
{
  const bt_dive *dive;
  bt__state *state;
  bt__surroundings around; /* what the tether can touch */
  const bt_vec3 *way;      /* the clear places from which the nodes are led */
  double height;           /* m: of the line's middle above the bed */
} ground;

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

/* The height at which node K lies on what is below the place of P, seen from the way; the obstacle
   there, or BT__NO_OBSTACLE.  */
static double
lies_at (const ground *g, int k, bt_vec3 p, int *obstacle)
{
  p.z = g->way[k].z;
  return p.z - bt__altitude_among (g->dive, g->state, &g->around, p, obstacle) + g->height;
}

/* The one obstacle below all nodes X of A, or BT__NO_OBSTACLE.  If PUTS, the nodes are taken down
   to the obstacle; one that lies above the way has none below: the bed rises aside, or is a roof.
 */
static int
bed_of (const ground *g, bt_vec3 *x, const bt__arch *a, int puts)
{
  int bed = BT__NO_OBSTACLE;
  for (int k = a->first; k <= a->last; k++)
    {
      int below;
      double z = lies_at (g, k, x[k], &below);
      if ((k > a->first && below != bed) || (puts && z > g->way[k].z + g->height))
        return BT__NO_OBSTACLE;
      bed = below;
      if (puts)
        x[k].z = z;
    }
  return bed;
}

int
bt__lay_on_bed (bt_dive *dive, bt__state *state, int i, const bt_vec3 *way, int n)
{
  bt_vec3 *x = dive->polyline, *kept = dive->motion;
  bt_water water = bt__dive_water (dive, state);
  ground g = { dive, state, bt__surround (dive, state, BT_PART_TETHER, i), way,
               height_of (dive, state, i) };
  bt__arch a;
  int unused, laid = 0;
  for (int k = 0; k <= n; k++)
    dive->over[k] = lies_at (&g, k, x[k], &unused) - x[k].z;
  dive->over[0] = dive->over[n] = -1; /* the ends stay */
  for (int k = 0; bt__next_arch (x, dive->over, n, k, &a); k = a.last + 1)
    {
      size_t size = sizeof *x * (size_t)(a.last - a.first + 1);
      int bed = bed_of (&g, x, &a, 0);
      memcpy (kept, x + a.first, size);
      bt__lay_aside (x, &a, 0, bt_water_velocity (&water, a.from));
      if (bed != BT__NO_OBSTACLE && bed_of (&g, x, &a, 1) == bed)
        laid = 1;
      else
        memcpy (x + a.first, kept, size);
    }
  return laid;
}
