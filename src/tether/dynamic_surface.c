/* The moving line: where the line comes out of the water.

   A metre of line is borne up by B = m g - w, its weight in air less its weight in water.  Line
   above the surface has lost B, and is neither dragged by water nor carries added mass.  On the
   surface lies a layer with the thickness of ripples, in which buoyancy goes as 1 - u^2 (3 - 2 u),
   u from 0 at the bottom of the layer to 1 at its top: a force with a potential, part of the
   iteration.  The share of water for drag is held for a step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

#define LAYER 0.1 /* m */

/* How far Z is up the layer on the surface at LEVEL: below 0 in the water, above 1 in the air.
 */
static double
rise (double z, double level)
{
  return (z - level) / LAYER;
}

/* The share of a line at U that is out of the water, and its integral over U from 0.  */
static double
out_of_water (double u)
{
  return u <= 0 ? 0 : u >= 1 ? 1 : u * u * (3 - 2 * u);
}

static double
out_so_far (double u)
{
  return u <= 0 ? 0 : u >= 1 ? u - 0.5 : u * u * u * (1 - 0.5 * u);
}

void
bt__dynamic_surface_prepare (bt__dynamic_work *w)
{
  const bt_water *water = w->in->water;
  double trough = -bt_water_crest (water);
  w->surfaced = 0;
  w->lift = fmax (0, w->m * water->gravity - w->weight);
  for (int i = 0; i <= w->n; i++)
    {
      bt__node *k = w->node + i;
      k->wet = k->cell;
      k->level = INFINITY; /* deeper than that no wave is asked for */
      if (!w->in->surfaced || !(water->density > 0) || w->X[i].z <= trough)
        continue;
      w->surfaced = 1;
      k->level = bt_water_surface (water, w->X[i]);
      k->wet *= 1 - out_of_water (rise (w->X[i].z, k->level));
    }
}

double
bt__dynamic_out_of_water (const bt__dynamic_work *w, int i)
{
  return w->surfaced ? out_of_water (rise (w->X[i].z, w->node[i].level)) : 0;
}

static double
lift_of (const bt__dynamic_work *w, int i)
{
  return w->lift * w->node[i].cell + (w->lumped ? w->extra[i].lift : 0);
}

void
bt__dynamic_surface_force (bt__dynamic_work *w)
{
  for (int i = w->lo; i <= w->hi; i++)
    {
      double u = rise (w->X[i].z, w->node[i].level);
      if (u <= 0)
        continue;
      w->rhs[i].z -= lift_of (w, i) * out_of_water (u);
      w->diag[i].zz += u < 1 ? lift_of (w, i) * 6 * u * (1 - u) / LAYER : 0;
    }
}

double
bt__dynamic_surface_potential (const bt__dynamic_work *w)
{
  double sum = 0;
  for (int i = w->lo; i <= w->hi; i++)
    sum += lift_of (w, i) * LAYER * out_so_far (rise (w->X[i].z, w->node[i].level));
  return sum;
}

double
bt__dynamic_out (const bt_water *water, bt_vec3 x)
{
  return x.z <= -bt_water_crest (water)
             ? 0
             : LAYER * out_so_far (rise (x.z, bt_water_surface (water, x)));
}
