/* The current of an ocean model at one place, as rows x y z t u v w.

   The velocity components are found by their CF standard names, else by usual names of variables.
   Each component is found among separate cells (spot.c), since some models stagger the components;
   times and levels (axes.c) are common to both.  Values are means over the cells with a number,
   weighted by their shares: near a coast some cells are land.  Vectors on a turned grid are turned
   back to east and north by the angle of the grid.  Levels without water at all times are left out;
   w is 0.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <cpl_string.h>

#include "base/error.h"
#include "geo-reader/flow.h"

enum
{
  EAST,
  NORTH,
  PARTS,
  TEXT = 128
};

typedef struct job
{
  GDALGroupH group;
  const bt_geo_column *wanted;
  bt__flow_part part[PARTS];
  size_t times, levels;
  double *time, *z;     /* s since 1970; m */
  double *speed[PARTS]; /* by time, then level; NaN: none */
  double angle;         /* rad: of the model's own x from east, anticlockwise */
  bt_error *error;
} job;

/* ---- Which variables ---- */

static const char *const standard_names[PARTS][4]
    = { { "eastward_sea_water_velocity", "surface_eastward_sea_water_velocity",
          "sea_water_x_velocity", NULL },
        { "northward_sea_water_velocity", "surface_northward_sea_water_velocity",
          "sea_water_y_velocity", NULL } };
static const char *const usual_names[PARTS][8]
    = { { "uo", "water_u", "u_eastward", "ucur", "u", NULL },
        { "vo", "water_v", "v_northward", "vcur", "v", NULL } };

static int
is_one_of (const char *name, const char *const *names)
{
  for (; *names; names++)
    if (strcmp (name, *names) == 0)
      return 1;
  return 0;
}

/* Does NAME of GROUP have the standard name of component K?  */
static int
is_standard (GDALGroupH group, const char *name, int k)
{
  char text[TEXT];
  bt__array a;
  int found = bt__array_open (group, name, &a) && a.n >= 2
              && is_one_of (bt__array_attribute (&a, "standard_name", text, sizeof text),
                            standard_names[k]);
  bt__array_close (&a);
  return found;
}

static const char *
choose_name (GDALGroupH group, CSLConstList names, int k)
{
  for (CSLConstList n = names; n && *n; n++)
    if (is_standard (group, *n, k))
      return *n;
  for (int i = 0; usual_names[k][i]; i++)
    if (CSLFindString ((char **)names, usual_names[k][i]) >= 0)
      return usual_names[k][i];
  return NULL;
}

/* Find time and level among the dimensions of PART before the last two.  */
static bt_status
sort_dimensions (job *j, bt__flow_part *part)
{
  part->time = part->level = -1;
  for (int i = 0; i + 2 < (int)part->array.n; i++)
    {
      char unit[TEXT];
      bt__array a;
      int there = bt__array_open (j->group, part->array.name[i], &a);
      int is_time
          = (there && strstr (bt__array_attribute (&a, "units", unit, sizeof unit), " since "))
            || strstr (part->array.name[i], "time");
      bt__array_close (&a);
      int *which = is_time ? &part->time : &part->level;
      if (*which >= 0)
        return bt__fail (j->error, BT_ERR_FORMAT,
                         "its current has other dimensions than time, depth, latitude and "
                         "longitude");
      *which = i;
    }
  return BT_OK;
}

static bt_status
open_parts (job *j)
{
  char **names = GDALGroupGetMDArrayNames (j->group, NULL);
  bt_status s = BT_OK;
  for (int k = 0; s == BT_OK && k < PARTS; k++)
    {
      const char *name = choose_name (j->group, names, k);
      if (!name || !bt__array_open (j->group, name, &j->part[k].array) || j->part[k].array.n < 2)
        s = bt__fail (j->error, BT_ERR_FORMAT,
                      "it has no current: no variables with the standard names "
                      "eastward_sea_water_velocity and northward_sea_water_velocity, nor called uo "
                      "and vo, water_u and water_v or u and v");
      else
        s = sort_dimensions (j, j->part + k);
    }
  CSLDestroy (names);
  return s;
}

/* ---- Where and when ---- */

static bt_status
find_spots (job *j)
{
  for (int k = 0; k < PARTS; k++)
    {
      bt_status s = bt__flow_find_spot (j->group, &j->wanted->at, j->part + k, j->error);
      if (s != BT_OK)
        return s;
    }
  return BT_OK;
}

static size_t
size_along (const bt__flow_part *part, int dimension)
{
  return dimension < 0 ? 1 : part->array.size[dimension];
}

static bt_status
find_axes (job *j)
{
  const bt__flow_part *p = j->part;
  j->times = size_along (p, p->time);
  j->levels = size_along (p, p->level);
  if (j->times != size_along (p + 1, p[1].time) || j->levels != size_along (p + 1, p[1].level))
    return bt__fail (j->error, BT_ERR_FORMAT,
                     "its two components are not at the same times and depths");
  if ((double)j->times * (double)j->levels > BT__GEO_FLOW_ROWS_MAX)
    return bt__fail (j->error, BT_ERR_LIMIT,
                     "it has %zu times and %zu depths; at most %d in all "
                     "are read",
                     j->times, j->levels, BT__GEO_FLOW_ROWS_MAX);
  j->time = bt__flow_times (j->group, p, j->error);
  j->z = j->time ? bt__flow_levels (j->group, p, &j->wanted->at, j->error) : NULL;
  return j->z ? BT_OK : BT_ERR_FORMAT;
}

static bt_status
check_start (job *j)
{
  char from[BT__FLOW_TIME_TEXT], to[BT__FLOW_TIME_TEXT], asked[BT__FLOW_TIME_TEXT];
  double start = j->wanted->start, first = j->time[0], last = j->time[j->times - 1];
  if (isnan (start) || j->part->time < 0 || (start >= first && start <= last))
    return BT_OK;
  return bt__fail (j->error, BT_ERR_FORMAT, "it has no current at %s: its times are %s to %s",
                   bt__flow_time_text (start, asked), bt__flow_time_text (first, from),
                   bt__flow_time_text (last, to));
}

/* ---- The numbers ---- */

/* Read the values of PART at cell I of its place to NUMBERS, by time, then level.  */
static bt_status
read_cell (job *j, const bt__flow_part *part, int i, double *numbers)
{
  size_t first[BT__ARRAY_DIMENSIONS] = { 0 }, count[BT__ARRAY_DIMENSIONS];
  if (part->time > part->level && part->level >= 0)
    return bt__fail (j->error, BT_ERR_FORMAT, "its depths come before its times");
  for (size_t k = 0; k < part->array.n; k++)
    count[k] = part->array.size[k];
  first[part->row] = part->spot.row[i];
  first[part->column] = part->spot.column[i];
  count[part->row] = count[part->column] = 1;
  return bt__array_read (&part->array, first, count, numbers, j->error);
}

/* The mean of the cells that have a number, by their shares: near a coast some are land.  */
static bt_status
read_component (job *j, int k)
{
  size_t n = j->times * j->levels;
  double *cell = malloc (n * sizeof *cell), *share = calloc (n, sizeof *share);
  bt_status s = BT_OK;
  j->speed[k] = calloc (n, sizeof *j->speed[k]);
  if (!cell || !share || !j->speed[k])
    s = bt__fail (j->error, BT_ERR_LIMIT, "there is no memory for so long a current");
  for (int i = 0; s == BT_OK && i < j->part[k].spot.n; i++)
    {
      s = read_cell (j, j->part + k, i, cell);
      for (size_t m = 0; s == BT_OK && m < n; m++)
        if (!isnan (cell[m]))
          {
            j->speed[k][m] += j->part[k].spot.share[i] * cell[m];
            share[m] += j->part[k].spot.share[i];
          }
    }
  for (size_t m = 0; s == BT_OK && m < n; m++)
    j->speed[k][m] = share[m] > 0 ? j->speed[k][m] / share[m] : NAN;
  free (cell);
  free (share);
  return s;
}

static bt_status
read_components (job *j)
{
  bt_status s = read_component (j, EAST);
  return s == BT_OK ? read_component (j, NORTH) : s;
}

/* A model with cells along a coast has velocities along its own axes.  */
static bt_status
find_angle (job *j)
{
  static const size_t one[2] = { 1, 1 };
  bt__flow_part field = { .time = -1, .level = -1 };
  bt_error ignored;
  char name[TEXT];
  bt__array_attribute (&j->part[EAST].array, "standard_name", name, sizeof name);
  double angle = NAN;
  if (!strstr (name, "eastward") && bt__array_open (j->group, "angle", &field.array)
      && field.array.n == 2
      && bt__flow_find_spot (j->group, &j->wanted->at, &field, &ignored) == BT_OK)
    bt__array_read (&field.array, (size_t[]){ field.spot.row[0], field.spot.column[0] }, one,
                    &angle, &ignored);
  bt__array_close (&field.array);
  j->angle = isfinite (angle) ? angle : 0;
  return BT_OK;
}

/* ---- The rows ---- */

/* True if there is water at level L at all times.  */
static int
is_wet (const job *j, size_t l)
{
  for (size_t t = 0; t < j->times; t++)
    if (isnan (j->speed[EAST][t * j->levels + l]) || isnan (j->speed[NORTH][t * j->levels + l]))
      return 0;
  return isfinite (j->z[l]);
}

static void
put_row (const job *j, size_t t, size_t l, double *row)
{
  double u = j->speed[EAST][t * j->levels + l], v = j->speed[NORTH][t * j->levels + l];
  double c = cos (j->angle), s = sin (j->angle);
  double start = isnan (j->wanted->start) || j->part->time < 0 ? j->time[0] : j->wanted->start;
  row[2] = j->z[l];
  row[3] = j->time[t] - start;
  row[4] = c * u - s * v;
  row[5] = s * u + c * v;
}

static bt_status
make_flow_rows (job *j, bt__geo_made *made)
{
  size_t wet = 0, n = 0;
  for (size_t l = 0; l < j->levels; l++)
    wet += (size_t)is_wet (j, l);
  if (wet == 0)
    return bt__fail (j->error, BT_ERR_FORMAT, "it has no water at latitude %g, longitude %g",
                     j->wanted->at.latitude, j->wanted->at.longitude);
  made->numbers = calloc (j->times * wet * BT__GEO_FLOW_COLUMNS, sizeof *made->numbers);
  if (!made->numbers)
    return bt__fail (j->error, BT_ERR_LIMIT, "there is no memory for so long a current");
  for (size_t l = 0; l < j->levels; l++)
    for (size_t t = 0; is_wet (j, l) && t < j->times; t++)
      put_row (j, t, l, made->numbers + BT__GEO_FLOW_COLUMNS * n++);
  made->head.columns = BT__GEO_FLOW_COLUMNS;
  made->head.rows = (uint32_t)n;
  return BT_OK;
}

static void
free_job (job *j)
{
  for (int k = 0; k < PARTS; k++)
    {
      bt__array_close (&j->part[k].array);
      free (j->speed[k]);
    }
  free (j->time);
  free (j->z);
  GDALGroupRelease (j->group);
}

bt_status
bt__geo_flow_make (const char *file, const bt_geo_column *wanted, bt__geo_made *made,
                   bt_error *error)
{
  static bt_status (*const parts[]) (job *)
      = { open_parts, find_spots, find_axes, check_start, read_components, find_angle };
  job j = { .wanted = wanted, .error = error };
  GDALDatasetH data = bt__geo_open_arrays (file, error);
  if (!data)
    return BT_ERR_FORMAT;
  j.group = GDALDatasetGetRootGroup (data);
  bt_status s = BT_OK;
  for (size_t i = 0; s == BT_OK && i < sizeof parts / sizeof *parts; i++)
    s = parts[i](&j);
  if (s == BT_OK)
    s = make_flow_rows (&j, made);
  free_job (&j);
  GDALClose (data);
  return s;
}
