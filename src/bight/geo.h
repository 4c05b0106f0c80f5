/* Bathymetry and currents in geographic coordinates, brought to the local metres of a world: x east
   and y north of its origin, in the transverse Mercator projection about the origin (WGS 84, scale
   1 at the origin; lengths within 100 km of it are right to 0.013 %).

   A separate process reads the file: a file that crashes or exhausts the libraries of the formats
   is an error like any other.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_GEO_H
#define BIGHT_GEO_H

#include <bight/mesh.h>
#include <bight/sea.h>

BT_BEGIN_DECLS

/* Where a world's (0, 0) is.  */
typedef struct bt_geo_origin
{
  double latitude;  /* degrees north, -89 to 89 */
  double longitude; /* degrees east, -180 to 360 */
} bt_geo_origin;

/* Which way the numbers of a bathymetry count.  */
typedef enum bt_geo_sign
{
  BT_GEO_AS_TOLD = 0, /* up, unless the file says that they are depths */
  BT_GEO_UP,          /* heights above the sea surface */
  BT_GEO_DOWN         /* depths */
} bt_geo_sign;

/* What is wanted of a bathymetry.  */
typedef struct bt_geo_bed
{
  bt_geo_origin origin;
  const char *system;   /* of its coordinates, "EPSG:32632"; NULL: as the file says */
  const char *variable; /* of a NetCDF file with several; NULL: the only one that can be meant */
  bt_geo_sign sign;
  double reach; /* m north, east, south and west of the origin; 0: all that the file has */
} bt_geo_bed;

/* Read the bathymetry in FILE (GeoTIFF, NetCDF, XYZ, ESRI ASCII) into *OUT: heights on a grid along
   x and y with the spacing of the file's posts, bilinear between posts, NaN where the file has no
   height. *OUT is freed by bt_heights_data_free, and NULL on failure: BT_ERR_IO when FILE cannot be
   read, is a folder or empty; BT_ERR_DOMAIN for an origin that is no place; BT_ERR_FORMAT when FILE
   is no bathymetry, lies elsewhere or crashes the reader; BT_ERR_LIMIT when it is too large, takes
   too long, or memory is short; BT_ERR_UNSUPPORTED when bight was built without it.  */
bt_status bt_geo_heights_read (const char *file, const bt_geo_bed *wanted, bt_heights_data **out,
                               bt_error *error);

/* What is wanted of an ocean model's current.  */
typedef struct bt_geo_column
{
  bt_geo_origin at; /* the place whose water is taken for all of the world */
  double start;     /* s since 1970-01-01T00:00Z: the world's time 0; NaN: the file's first */
} bt_geo_column;

/* Read the current in FILE, NetCDF as ROMS, HYCOM and CMEMS write it, into *OUT: the column at one
   place, linear between the file's times and levels.  *OUT is freed by bt_current_grid_free;
   failures are those of bt_geo_heights_read.  */
bt_status bt_geo_current_read (const char *file, const bt_geo_column *wanted, bt_current_grid **out,
                               bt_error *error);

BT_END_DECLS

#endif
