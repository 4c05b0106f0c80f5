/* Shared by the files of the geographic reader: opening a file in one of the permitted formats,
   coordinates to the local metres of an origin and back, and the table handed over.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_GEO_READER_GEO_H
#define BT_GEO_READER_GEO_H

#include <stdint.h>

#include <gdal.h>
#include <ogr_srs_api.h>

#include <bight/geo.h>

#include "geo/stream.h"

/* A table in the making.  NUMBERS is freed by free.  */
typedef struct bt__geo_made
{
  bt__geo_head head; /* magic, version and spare are set when it is written */
  double *numbers;
} bt__geo_made;

/* The wanted part of a bathymetry, from the arguments of main.  */
typedef struct bt__geo_wish
{
  const char *file;
  bt_geo_bed bed; /* its texts NULL, never "" */
} bt__geo_wish;

/* ---- formats.c ---- */

/* Register the permitted formats of GDAL; switch off network, caches and files beside the given
   file.  */
void bt__geo_prepare (void);

/* Open the bathymetry that WISH names; NULL on failure: BT_ERR_FORMAT.  */
GDALDatasetH bt__geo_open_bed (const bt__geo_wish *wish, bt_error *error);

/* Open the NetCDF FILE for its arrays; NULL on failure: BT_ERR_FORMAT.  */
GDALDatasetH bt__geo_open_arrays (const char *file, bt_error *error);

/* ---- place.c ---- */

/* From the columns and rows of a raster to local metres and back.  */
typedef struct bt__geo_map
{
  int columns, rows;
  double to_source[6], to_cell[6]; /* affine, cells and the numbers of the file's coordinates */
  OGRCoordinateTransformationH out, in; /* file to local, local to file */
  int degrees;                          /* true: the file's numbers are degrees */
} bt__geo_map;

/* Make *MAP of RASTER for WISH.  BT_ERR_FORMAT when the coordinates are missing, unknown, or the
   origin lies elsewhere.  It is freed by bt__geo_map_free, also after a failure.  */
bt_status bt__geo_map_make (GDALDatasetH raster, const bt__geo_wish *wish, bt__geo_map *map,
                            bt_error *error);
void bt__geo_map_free (bt__geo_map *map);

/* Turn the N cells (column, row; 0: the centre of the first) in X and Y to local metres; not finite
   where there is no such place.  */
void bt__geo_cells_to_local (const bt__geo_map *map, int n, double *x, double *y);

/* Turn N local places in X and Y to columns and rows; not finite where there are none.  */
void bt__geo_local_to_cells (const bt__geo_map *map, int n, double *x, double *y);

/* ---- bed.c, flow.c: what main does ---- */

bt_status bt__geo_bed_make (const bt__geo_wish *wish, bt__geo_made *made, bt_error *error);
bt_status bt__geo_flow_make (const char *file, const bt_geo_column *wanted, bt__geo_made *made,
                             bt_error *error);

#endif
