/* Opening files: of the two hundred formats of GDAL, the four in use for bathymetry.  GDAL's error
   messages are not passed on, since the messages may quote a file of no such format.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>

#include "base/error.h"
#include "geo-reader/geo.h"

static const char *const raster_formats[] = { "GTiff", "netCDF", "AAIGrid", "XYZ", NULL };
static const char *const array_formats[] = { "netCDF", NULL };

enum
{
  NAME_SIZE = 5000,
  LIST_SIZE = 160
};

void
bt__geo_prepare (void)
{
  static const char *const settings[][2] = {
    { "GDAL_PAM_ENABLED", "NO" },                    /* no .aux.xml is read or written */
    { "GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR" }, /* nor what lies beside the file */
    { "GDAL_NUM_THREADS", "1" },
    { "GDAL_CACHEMAX", "64" }, /* megabytes */
    { "PROJ_NETWORK", "OFF" },
    { "OGR_CT_FORCE_TRADITIONAL_GIS_ORDER", "YES" },
  };
  for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
    {
      CPLSetConfigOption (settings[i][0], settings[i][1]);
      setenv (settings[i][0], settings[i][1], 1); /* PROJ reads the environment */
    }
  CPLPushErrorHandler (CPLQuietErrorHandler);
  GDALAllRegister ();
}

static bt_status
no_format (bt_error *error)
{
  return bt__fail (error, BT_ERR_FORMAT,
                   "it cannot be read as GeoTIFF, NetCDF, XYZ or ESRI ASCII grid: it is something "
                   "else, or damaged");
}

/* ---- The variables of a NetCDF file ---- */

/* Names of variables for bathymetry, the likeliest first.  */
static const char *const usual_names[]
    = { "elevation", "z", "depth", "bathymetry", "bathy", "topo", "h", "Band1", "height", NULL };

/* The variable of the subdataset NAME, `NETCDF:"FILE":VARIABLE'.  */
static const char *
variable_of (const char *name)
{
  const char *colon = strrchr (name, ':');
  return colon ? colon + 1 : name;
}

/* The subdataset of NAMES (SUBDATASET_1_NAME=..., with descriptions among them) for VARIABLE, or
   NULL.  */
static const char *
find_variable (CSLConstList names, const char *variable)
{
  for (; names && *names; names++)
    {
      const char *value = strchr (*names, '=');
      if (value && value - *names > 5 && memcmp (value - 5, "_NAME", 5) == 0
          && strcmp (variable_of (value), variable) == 0)
        return value + 1;
    }
  return NULL;
}

/* Those of NAMES as a list for a sentence.  */
static const char *
list_variables (CSLConstList names, char text[LIST_SIZE])
{
  size_t n = 0;
  text[0] = '\0';
  for (; names && *names; names++)
    {
      const char *value = strchr (*names, '=');
      if (value && value - *names > 5 && memcmp (value - 5, "_NAME", 5) == 0
          && n + strlen (variable_of (value)) + 3 < LIST_SIZE)
        n += (size_t)snprintf (text + n, LIST_SIZE - n, "%s%s", n ? ", " : "", variable_of (value));
    }
  return text;
}

static const char *
choose_variable (CSLConstList names, const char *wanted, bt_error *error)
{
  char list[LIST_SIZE];
  const char *found = wanted ? find_variable (names, wanted) : NULL;
  for (int i = 0; !wanted && !found && usual_names[i]; i++)
    found = find_variable (names, usual_names[i]);
  if (found)
    return found;
  bt__fail (error, BT_ERR_FORMAT,
            "it has no variable %s; (variable \"NAME\") says which is the bathymetry; it has %s",
            wanted ? wanted : "elevation, z, depth, bathymetry, topo or h",
            list_variables (names, list));
  return NULL;
}

/* True if the only grid of DATA is the variable NAME.  */
static int
is_variable (GDALDatasetH data, const char *name)
{
  const char *own = GDALGetMetadataItem (GDALGetRasterBand (data, 1), "NETCDF_VARNAME", NULL);
  return own && strcmp (own, name) == 0;
}

/* DATA, or its subdataset with the bathymetry.  */
static GDALDatasetH
choose_part (GDALDatasetH data, const char *wanted, bt_error *error)
{
  char name[NAME_SIZE];
  CSLConstList parts = GDALGetMetadata (data, "SUBDATASETS");
  if (GDALGetRasterCount (data) > 0 && (!wanted || is_variable (data, wanted)))
    return data;
  const char *part = parts && *parts ? choose_variable (parts, wanted, error) : NULL;
  if (!parts || !*parts)
    bt__fail (error, BT_ERR_FORMAT, "it has no grid of numbers%s",
              wanted ? " that is the variable wanted" : "");
  if (part)
    snprintf (name, sizeof name, "%s", part);
  GDALClose (data);
  if (!part)
    return NULL;
  data = GDALOpenEx (name, GDAL_OF_RASTER | GDAL_OF_READONLY, array_formats, NULL, NULL);
  if (!data)
    no_format (error);
  return data;
}

GDALDatasetH
bt__geo_open_bed (const bt__geo_wish *wish, bt_error *error)
{
  GDALDatasetH data
      = GDALOpenEx (wish->file, GDAL_OF_RASTER | GDAL_OF_READONLY, raster_formats, NULL, NULL);
  if (!data)
    {
      no_format (error);
      return NULL;
    }
  return choose_part (data, wish->bed.variable, error);
}

GDALDatasetH
bt__geo_open_arrays (const char *file, bt_error *error)
{
  GDALDatasetH data
      = GDALOpenEx (file, GDAL_OF_MULTIDIM_RASTER | GDAL_OF_READONLY, array_formats, NULL, NULL);
  if (!data)
    bt__fail (error, BT_ERR_FORMAT,
              "it cannot be read as NetCDF: it is something else, or damaged");
  return data;
}
