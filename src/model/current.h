/* Questions to a current, beside the velocity, by a solver that marches through water.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MODEL_CURRENT_H
#define BT_MODEL_CURRENT_H

#include <bight/water.h>

/* Return true if the velocity of WATER depends on the height alone, and differs between heights. */
int bt__water_is_layered (const bt_water *water);

/* Layered water is smooth in each of its layers: between two rows of a profile, or beyond them; a
   current by a power law, below the surface or above.  */

/* Return the layer at the height Z.  */
int bt__water_layer_at (const bt_water *water, double z);

/* Write the heights LOW and HIGH of the ends of LAYER, infinite where the layer has no end.  */
void bt__water_layer_bounds (const bt_water *water, int layer, double *low, double *high);

/* Return the layer above LAYER if UP is true, else the one below.  There is one.  */
int bt__water_next_layer (const bt_water *water, int layer, int up);

/* Return the velocity in LAYER at the height Z, and in *SHEAR how much it changes per metre of
   height: beyond the bounds as if the layer went on.  */
bt_vec3 bt__water_in_layer (const bt_water *water, int layer, double z, bt_vec3 *shear);

/* Write the height of the surface of WATER over each of N places P, m, to HEIGHT: as
   bt_water_surface, within the accuracy of the waves.  */
void bt__water_surfaces (const bt_water *water, const bt_vec3 *p, size_t n, double *height);

#endif
