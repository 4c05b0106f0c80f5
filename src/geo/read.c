/* Reading bathymetry and currents: the program bight-geo-reader, a separate process, has the
   libraries for formats and coordinates.  This file takes the answer of the reader and checks every
   number.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <bight/geo.h>

#include "base/error.h"
#include "geo/stream.h"
#include "mesh/file.h"
#include "mesh/reader.h"

enum
{
  NUMBER_SIZE = 32
};

/* Five million posts take a second or two and a gigabyte.  The libraries themselves take half a
   gigabyte of addresses before they have read anything.  */
static const bt__reader_limits usual = { 120, 60, 4096 };
static const double height_max = 1e5; /* m: farther than any bottom or peak */
static const bt__reader geo_reader = { "bight-geo-reader",
                                       "BIGHT_GEO_READER",
                                       "the geographic reader",
                                       "geographic files",
                                       "GDAL (Debian package: libgdal-dev)",
                                       20000000000 /* all of GEBCO has 7.5e9 */ };

/* A number as the reader takes it.  */
typedef struct text
{
  char at[NUMBER_SIZE];
} text;

static char *
to_text (double number, text *t)
{
  snprintf (t->at, sizeof t->at, "%.17g", number);
  return t->at;
}

static bt_status
check_origin (const bt_geo_origin *at, bt_error *error)
{
  if (!(at->latitude >= -89 && at->latitude <= 89))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a latitude of %g; -89 to 89 degrees are allowed, north positive",
                     at->latitude);
  if (!(at->longitude >= -180 && at->longitude <= 360))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a longitude of %g; -180 to 360 degrees are allowed, east positive",
                     at->longitude);
  return BT_OK;
}

/* A table to be read, and the numbers read so far.  */
typedef struct table
{
  uint64_t most; /* numbers */
  bt__geo_head head;
  double *numbers;
} table;

static bt_status
take_table (const bt__answer *answer, void *into, bt_error *error)
{
  table *t = into;
  return bt__geo_take (answer, t->most, &t->head, &t->numbers, error);
}

/* Have FILE read with ARGUMENTS into *T, whose most is given; its numbers are freed by free.  */
static bt_status
read_table (const char *file, char *const *arguments, table *t, bt_error *error)
{
  bt_status s = bt__reader_ask (&geo_reader, file, arguments, &usual, take_table, t, error);
  if (s != BT_OK)
    {
      free (t->numbers);
      t->numbers = NULL;
    }
  return s;
}

/* ---- Heights ---- */

static bt_status
check_bed (const char *file, const bt__geo_head *head, const double *z, bt_error *error)
{
  if (head->columns < 2 || head->rows < 2 || !(head->dx > 0) || !(head->dy > 0)
      || !isfinite (head->dx) || !isfinite (head->dy) || !isfinite (head->x) || !isfinite (head->y))
    return bt__fail (error, BT_ERR_FORMAT, "%s: its grid has no size", bt__file_tail (file));
  for (size_t i = 0; i < (size_t)head->columns * head->rows; i++)
    if (!isnan (z[i]) && !(fabs (z[i]) <= height_max))
      return bt__fail (error, BT_ERR_FORMAT,
                       "%s: a height of %g m; it must be within 100 km of the sea surface",
                       bt__file_tail (file), z[i]);
  return BT_OK;
}

bt_status
bt_geo_heights_read (const char *file, const bt_geo_bed *wanted, bt_heights_data **out,
                     bt_error *error)
{
  static char *const signs[] = { "told", "up", "down" };
  text t[3];
  char *const arguments[] = { "bed",
                              to_text (wanted->origin.latitude, t),
                              to_text (wanted->origin.longitude, t + 1),
                              to_text (wanted->reach, t + 2),
                              signs[wanted->sign],
                              (char *)(wanted->system ? wanted->system : ""),
                              (char *)(wanted->variable ? wanted->variable : ""),
                              NULL };
  table bed = { .most = BT_HEIGHTS_POSTS_MAX };
  *out = NULL;
  bt_status s = check_origin (&wanted->origin, error);
  if (s == BT_OK)
    s = read_table (file, arguments, &bed, error);
  if (s == BT_OK)
    s = check_bed (file, &bed.head, bed.numbers, error);
  bt_heights_data *data = s == BT_OK ? calloc (1, sizeof *data) : NULL;
  if (!data)
    {
      free (bed.numbers);
      return s != BT_OK ? s : bt__fail (error, BT_ERR_LIMIT, "%s: no memory", bt__file_tail (file));
    }
  data->z = bed.numbers;
  data->heights = (bt_heights){ .nx = bed.head.columns,
                                .ny = bed.head.rows,
                                .x = bed.head.x,
                                .y = bed.head.y,
                                .dx = bed.head.dx,
                                .dy = bed.head.dy,
                                .z = bed.numbers };
  *out = data;
  return BT_OK;
}

/* ---- Currents ---- */

bt_status
bt_geo_current_read (const char *file, const bt_geo_column *wanted, bt_current_grid **out,
                     bt_error *error)
{
  text t[3];
  char *const arguments[]
      = { "current", to_text (wanted->at.latitude, t), to_text (wanted->at.longitude, t + 1),
          to_text (wanted->start, t + 2), NULL };
  table flow = { .most = (uint64_t)BT__GEO_FLOW_COLUMNS * BT__GEO_FLOW_ROWS_MAX };
  bt_error why;
  *out = NULL;
  bt_status s = check_origin (&wanted->at, error);
  if (s == BT_OK)
    s = read_table (file, arguments, &flow, error);
  if (s != BT_OK)
    return s;
  if (flow.head.columns != BT__GEO_FLOW_COLUMNS)
    s = bt__fail (&why, BT_ERR_FORMAT, "the geographic reader's answer is no current");
  else
    s = bt_current_grid_new ((const double (*)[BT__GEO_FLOW_COLUMNS])flow.numbers, flow.head.rows,
                             out, &why);
  free (flow.numbers);
  return s == BT_OK ? s : bt__fail (error, s, "%s: %s", bt__file_tail (file), why.text);
}
