/* Coordinates: the reference system of the numbers in a file, and the way to local metres.

   A file without a stated system is believed only if its numbers leave one possibility: the origin
   lies within the numbers as degrees, or as metres of the UTM zone of the origin.  A stated system,
   or the system wished for by the world, is taken as it is.  Local metres are a transverse Mercator
   projection about the origin with scale 1 (PROJ does the sums); a map holds the transformations
   both ways and the affine map of the file, and longitudes are tried with whole turns.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "geo-reader/geo.h"

enum
{
  TEXT = 200,
  DEGREES_EPSG = 4326
};

/* m from the origin to the nearest of a file's numbers: beyond it the system or the origin is
   wrong, and lengths of the projection are off.  */
static const double elsewhere = 1e5;

static OGRSpatialReferenceH
new_system (void)
{
  OGRSpatialReferenceH system = OSRNewSpatialReference (NULL);
  OSRSetAxisMappingStrategy (system, OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

static OGRSpatialReferenceH
local_system (const bt_geo_origin *origin)
{
  char text[TEXT];
  OGRSpatialReferenceH system = new_system ();
  snprintf (
      text, sizeof text,
      "+proj=tmerc +lat_0=%.12f +lon_0=%.12f +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
      origin->latitude, origin->longitude);
  if (OSRImportFromProj4 (system, text) == OGRERR_NONE)
    return system;
  OSRRelease (system);
  return NULL;
}

static OGRSpatialReferenceH
epsg_system (int code)
{
  OGRSpatialReferenceH system = new_system ();
  if (OSRImportFromEPSG (system, code) == OGRERR_NONE
      && (OSRIsGeographic (system) || OSRIsProjected (system)))
    return system;
  OSRRelease (system);
  return NULL;
}

/* ---- The box of a file's numbers ---- */

typedef struct box
{
  double low[2], high[2];
} box;

static void
through_affine (const double t[6], double x, double y, double *u, double *v)
{
  *u = t[0] + t[1] * x + t[2] * y;
  *v = t[3] + t[4] * x + t[5] * y;
}

static box
source_box (const bt__geo_map *map)
{
  box b = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
  for (int k = 0; k < 4; k++)
    {
      double p[2];
      through_affine (map->to_source, k & 1 ? map->columns : 0, k & 2 ? map->rows : 0, p, p + 1);
      for (int a = 0; a < 2; a++)
        {
          b.low[a] = fmin (b.low[a], p[a]);
          b.high[a] = fmax (b.high[a], p[a]);
        }
    }
  return b;
}

static int
box_holds (const box *b, double x, double y)
{
  return x >= b->low[0] && x <= b->high[0] && y >= b->low[1] && y <= b->high[1];
}

/* Longitudes of one turn or a little more, from -180 or 0 on, and latitudes: edges of cells may lie
   half a cell beyond.  */
static int
are_degrees (const box *b)
{
  return b->low[0] >= -185 && b->high[0] <= 365 && b->low[1] >= -95 && b->high[1] <= 95;
}

/* X moved by whole turns into the degrees of B, if it can be.  */
static double
turned (const box *b, double x)
{
  while (x < b->low[0])
    x += 360;
  while (x > b->high[0] && x - 360 >= b->low[0])
    x -= 360;
  return x;
}

/* ---- Systems ---- */

static bt_status
fail_system (const bt__geo_wish *wish, const box *b, bt_error *error)
{
  int zone = (int)floor ((remainder (wish->bed.origin.longitude, 360) + 180) / 6) % 60 + 1;
  return bt__fail (error, BT_ERR_FORMAT,
                   "it does not say in which coordinates its numbers are (%.8g to %.8g, %.8g to "
                   "%.8g), and as degrees or UTM they do not hold the origin; (system "
                   "\"EPSG:%d\") says UTM zone %d, (system \"EPSG:4326\") degrees",
                   b->low[0], b->high[0], b->low[1], b->high[1],
                   (wish->bed.origin.latitude < 0 ? 32700 : 32600) + zone, zone);
}

static OGRSpatialReferenceH
named_system (const char *name, bt_error *error)
{
  char *end;
  long code = strncmp (name, "EPSG:", 5) == 0 ? strtol (name + 5, &end, 10) : 0;
  OGRSpatialReferenceH system
      = code > 0 && code < 1000000 && *end == '\0' ? epsg_system ((int)code) : NULL;
  if (!system)
    bt__fail (error, BT_ERR_FORMAT,
              "`%.40s' is no system of coordinates; one is written \"EPSG:NUMBER\", as "
              "\"EPSG:4326\" for degrees and \"EPSG:32632\" for UTM zone 32 north",
              name);
  return system;
}

/* Does SYSTEM take the origin of WISH into B?  */
static int
holds_origin (OGRSpatialReferenceH system, const bt__geo_wish *wish, const box *b)
{
  double x = wish->bed.origin.longitude, y = wish->bed.origin.latitude;
  OGRSpatialReferenceH degrees = epsg_system (DEGREES_EPSG);
  OGRCoordinateTransformationH to
      = degrees ? OCTNewCoordinateTransformation (degrees, system) : NULL;
  int fine = to && OCTTransform (to, 1, &x, &y, NULL) && box_holds (b, x, y);
  if (to)
    OCTDestroyCoordinateTransformation (to);
  if (degrees)
    OSRRelease (degrees);
  return fine;
}

static OGRSpatialReferenceH
guessed_system (const bt__geo_wish *wish, const box *b, bt_error *error)
{
  int south = wish->bed.origin.latitude < 0;
  int zone = (int)floor ((remainder (wish->bed.origin.longitude, 360) + 180) / 6) % 60 + 1;
  int degrees = are_degrees (b)
                && box_holds (b, turned (b, wish->bed.origin.longitude), wish->bed.origin.latitude);
  if (degrees)
    return epsg_system (DEGREES_EPSG);
  OGRSpatialReferenceH utm = epsg_system ((south ? 32700 : 32600) + zone);
  if (utm && holds_origin (utm, wish, b))
    return utm;
  if (utm)
    OSRRelease (utm);
  fail_system (wish, b, error);
  return NULL;
}

/* The reference system of RASTER's numbers; NULL if unknown.  */
static OGRSpatialReferenceH
system_of (GDALDatasetH raster, const bt__geo_wish *wish, const box *b, bt_error *error)
{
  OGRSpatialReferenceH told = GDALGetSpatialRef (raster);
  if (wish->bed.system)
    return named_system (wish->bed.system, error);
  if (!told || OSRIsLocal (told))
    return guessed_system (wish, b, error);
  OGRSpatialReferenceH system = OSRClone (told);
  OSRSetAxisMappingStrategy (system, OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

/* ---- The map ---- */

static bt_status
make_ways (bt__geo_map *map, OGRSpatialReferenceH system, const bt_geo_origin *origin,
           bt_error *error)
{
  OGRSpatialReferenceH local = local_system (origin);
  map->degrees = OSRIsGeographic (system);
  if (local)
    {
      map->out = OCTNewCoordinateTransformation (system, local);
      map->in = OCTNewCoordinateTransformation (local, system);
      OSRRelease (local);
    }
  if (!map->out || !map->in)
    return bt__fail (error, BT_ERR_FORMAT,
                     "there is no way from its coordinates to latitude and longitude");
  return BT_OK;
}

/* The origin must lie in the file or near it; else origin or file is wrong.  */
static bt_status
check_near (const bt__geo_map *map, const bt__geo_wish *wish, const box *b, bt_error *error)
{
  double x = 0, y = 0;
  int fine = OCTTransform (map->in, 1, &x, &y, NULL);
  if (fine && map->degrees)
    x = turned (b, x);
  if (fine)
    {
      x = fmin (fmax (x, b->low[0]), b->high[0]);
      y = fmin (fmax (y, b->low[1]), b->high[1]);
      fine = OCTTransform (map->out, 1, &x, &y, NULL) && hypot (x, y) <= elsewhere;
    }
  if (fine)
    return BT_OK;
  return bt__fail (error, BT_ERR_FORMAT,
                   "it lies elsewhere: its numbers are %.8g to %.8g and %.8g to %.8g %s, more than "
                   "%.0f km from the origin at latitude %g, longitude %g",
                   b->low[0], b->high[0], b->low[1], b->high[1],
                   map->degrees ? "degrees east and north" : "of its map", elsewhere / 1e3,
                   wish->bed.origin.latitude, wish->bed.origin.longitude);
}

static int
is_plain (const double t[6])
{
  for (int i = 0; i < 6; i++)
    if (!isfinite (t[i]) || fabs (t[i]) > 1e9)
      return 0;
  return 1;
}

bt_status
bt__geo_map_make (GDALDatasetH raster, const bt__geo_wish *wish, bt__geo_map *map, bt_error *error)
{
  *map = (bt__geo_map){ .columns = GDALGetRasterXSize (raster),
                        .rows = GDALGetRasterYSize (raster) };
  if (GDALGetGeoTransform (raster, map->to_source) != CE_None || !is_plain (map->to_source)
      || !GDALInvGeoTransform (map->to_source, map->to_cell) || !is_plain (map->to_cell))
    return bt__fail (
        error, BT_ERR_FORMAT,
        "it does not say where its numbers are: it has no regular grid of coordinates");
  box b = source_box (map);
  OGRSpatialReferenceH system = system_of (raster, wish, &b, error);
  if (!system)
    return BT_ERR_FORMAT;
  bt_status s = OSRIsGeographic (system) && !are_degrees (&b)
                    ? bt__fail (error, BT_ERR_FORMAT,
                                "its numbers, %.8g to %.8g and %.8g to %.8g, are no degrees east "
                                "and north",
                                b.low[0], b.high[0], b.low[1], b.high[1])
                    : make_ways (map, system, &wish->bed.origin, error);
  OSRRelease (system);
  return s == BT_OK ? check_near (map, wish, &b, error) : s;
}

void
bt__geo_map_free (bt__geo_map *map)
{
  if (map->out)
    OCTDestroyCoordinateTransformation (map->out);
  if (map->in)
    OCTDestroyCoordinateTransformation (map->in);
}

void
bt__geo_cells_to_local (const bt__geo_map *map, int n, double *x, double *y)
{
  for (int i = 0; i < n; i++)
    through_affine (map->to_source, x[i] + 0.5, y[i] + 0.5, x + i, y + i);
  OCTTransform (map->out, n, x, y, NULL);
}

void
bt__geo_local_to_cells (const bt__geo_map *map, int n, double *x, double *y)
{
  box b = source_box (map);
  OCTTransform (map->in, n, x, y, NULL);
  for (int i = 0; i < n; i++)
    {
      double u = map->degrees && isfinite (x[i]) ? turned (&b, x[i]) : x[i];
      through_affine (map->to_cell, u, y[i], x + i, y + i);
      x[i] -= 0.5;
      y[i] -= 0.5;
    }
}
