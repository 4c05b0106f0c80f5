/* Waves at many places: how far the series of waves_line.c reach, and the surface by them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SEA_WAVES_LINE_H
#define BT_SEA_WAVES_LINE_H

#include <bight/sea.h>

/* Set the reaches of W, whose components and accuracy are set.  */
void bt__waves_reaches (bt_waves *w);

/* Write the height of the surface over each of N places P at T, m, to HEIGHT: as
   bt_waves_elevation, within the accuracy of W, a share of all amplitudes together.  */
void bt__waves_elevations (const bt_waves *w, const bt_vec3 *p, size_t n, double t, double *height);

#endif
