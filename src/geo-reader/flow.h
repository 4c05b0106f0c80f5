/* The current of an ocean model at one place, in parts: the place among the model's cells, the
   times, the levels.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_GEO_READER_FLOW_H
#define BT_GEO_READER_FLOW_H

#include "geo-reader/arrays.h"
#include "geo-reader/geo.h"

enum
{
  BT__FLOW_CELLS = 4,
  BT__FLOW_TIME_TEXT = 64
};

/* A place among the cells of a variable: up to four cells and their shares.  */
typedef struct bt__flow_spot
{
  int n;
  size_t row[BT__FLOW_CELLS], column[BT__FLOW_CELLS];
  double share[BT__FLOW_CELLS];
} bt__flow_spot;

/* One component of the velocity.  The number of a missing dimension is -1.  */
typedef struct bt__flow_part
{
  bt__array array;
  int time, level, row, column; /* which of its dimensions */
  bt__flow_spot spot;
} bt__flow_part;

/* ---- spot.c ---- */

/* Find AT among the cells of PART, and set row and column of PART: bilinear where latitudes and
   longitudes are lines, the nearest cell where they are arrays.  BT_ERR_FORMAT.  */
bt_status bt__flow_find_spot (GDALGroupH group, const bt_geo_origin *at, bt__flow_part *part,
                              bt_error *error);

/* ---- axes.c ---- */

/* Return the times of PART, s since 1970-01-01T00:00Z, freed by free; one 0 where it has none.
   NULL on failure.  */
double *bt__flow_times (GDALGroupH group, const bt__flow_part *part, bt_error *error);

/* Return the heights z, m, of the levels of PART, freed by free; one 0 where it has none.  NULL on
   failure.  AT is the place at which levels along the bed are wanted.  */
double *bt__flow_levels (GDALGroupH group, const bt__flow_part *part, const bt_geo_origin *at,
                         bt_error *error);

/* Write the time T to TEXT in the form 2025-03-01T06:00Z.  Return TEXT.  */
const char *bt__flow_time_text (double t, char text[BT__FLOW_TIME_TEXT]);

#endif
