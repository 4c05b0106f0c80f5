/* The place of a point among the cells of a variable of an ocean model.

   Two layouts are known.  Latitude and longitude as lines: the interval of each line is found and
   the four cells around get bilinear shares; half an interval beyond the ends counts as the end,
   and longitudes are tried with whole turns.  Latitude and longitude as arrays named by the
   attribute `coordinates': the cell with the nearest centre gets the whole share, provided that the
   point is no farther from the centre than 1.4 times the distance to the centre of the cell beside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "geo-reader/flow.h"

enum
{
  TEXT = 256
};

static const double degree = 3.14159265358979323846 / 180;

/* True if the unit of A is degrees to the WAY, 0: north, 1: east, in one of the six spellings of
   the CF conventions (4.1, 4.2).  */
static int
points (const bt__array *a, int way)
{
  static const char *const stems[] = { "degrees_", "degree_", "degrees", "degree" };
  static const char *const ends[2][2] = { { "north", "N" }, { "east", "E" } };
  char unit[TEXT];
  bt__array_attribute (a, "units", unit, sizeof unit);
  for (size_t i = 0; i < sizeof stems / sizeof *stems; i++)
    {
      size_t n = strlen (stems[i]);
      if (strncmp (unit, stems[i], n) == 0
          && (strcmp (unit + n, ends[way][0]) == 0 || strcmp (unit + n, ends[way][1]) == 0))
        return 1;
    }
  return 0;
}

/* ---- Lines of latitude and longitude ---- */

/* Find the interval around VALUE on the line of N numbers, rising or falling, and the share to the
   end of the interval.  Return true if found; half an interval beyond the ends counts as the end.
 */
static int
locate_on_line (const double *line, size_t n, double value, size_t *low, double *share)
{
  *low = 0;
  *share = 0;
  if (n == 1)
    return fabs (value - line[0]) < 1;
  for (size_t i = 0; i + 1 < n; i++)
    {
      double s = (value - line[i]) / (line[i + 1] - line[i]);
      double least = i == 0 ? -0.5 : 0, most = i + 2 == n ? 1.5 : 1;
      if (s >= least && s <= most)
        {
          *low = i;
          *share = fmin (fmax (s, 0), 1);
          return 1;
        }
    }
  return 0;
}

static void
make_corners (bt__flow_spot *spot, const size_t low[2], const double share[2])
{
  spot->n = 0;
  for (int k = 0; k < BT__FLOW_CELLS; k++)
    {
      double weight = (k & 1 ? share[1] : 1 - share[1]) * (k & 2 ? share[0] : 1 - share[0]);
      if (weight > 0)
        {
          spot->row[spot->n] = low[0] + (size_t)(k >> 1);
          spot->column[spot->n] = low[1] + (size_t)(k & 1);
          spot->share[spot->n++] = weight;
        }
    }
}

/* Find VALUE on the line A; longitudes by whole turns too.  */
static bt_status
find_on_line (const bt__array *a, double value, int turns, size_t *low, double *share,
              bt_error *error)
{
  double *line = bt__array_read_all (a, error);
  if (!line)
    return BT_ERR_FORMAT;
  int found = 0;
  for (int k = -1; k <= 1 && !found; k++)
    if (k == 0 || turns)
      found = locate_on_line (line, a->size[0], value + 360 * k, low, share);
  double first = line[0], last = line[a->size[0] - 1];
  free (line);
  if (found)
    return BT_OK;
  return bt__fail (error, BT_ERR_FORMAT, "it has nothing at %s %g: its own are %g to %g",
                   turns ? "longitude" : "latitude", value, first, last);
}

static bt_status
find_on_lines (const bt__array line[2], const bt_geo_origin *at, bt__flow_spot *spot,
               bt_error *error)
{
  size_t low[2];
  double share[2];
  bt_status s = find_on_line (line, at->latitude, 0, low, share, error);
  if (s == BT_OK)
    s = find_on_line (line + 1, at->longitude, 1, low + 1, share + 1, error);
  if (s == BT_OK)
    make_corners (spot, low, share);
  return s;
}

/* ---- Arrays of latitude and longitude ---- */

/* About how far AT is from latitude Y, longitude X, in degrees of latitude, squared.  */
static double
distance2 (const bt_geo_origin *at, double y, double x)
{
  double north = y - at->latitude;
  double east = remainder (x - at->longitude, 360) * cos (degree * at->latitude);
  return north * north + east * east;
}

/* Find the nearest cell.  The distance to its centre must be at most 1.4 times the distance between
   the centres of the cell and the cell beside.  */
static bt_status
find_nearest (const bt__array field[2], const bt_geo_origin *at, bt__flow_spot *spot,
              bt_error *error)
{
  double *y = bt__array_read_all (field, error),
         *x = y ? bt__array_read_all (field + 1, error) : NULL;
  size_t columns = field->size[1], n = field->size[0] * columns, best = n;
  double least = INFINITY;
  for (size_t i = 0; x && i < n; i++)
    if (distance2 (at, y[i], x[i]) < least)
      {
        least = distance2 (at, y[i], x[i]);
        best = i;
      }
  bt_status s = x ? BT_OK : BT_ERR_FORMAT;
  if (x && best < n)
    {
      size_t beside = best % columns + 1 < columns ? best + 1 : best > 0 ? best - 1 : best;
      double cell = distance2 (&(bt_geo_origin){ y[best], x[best] }, y[beside], x[beside]);
      if (!(least <= 2 * cell))
        best = n;
    }
  if (x && best == n)
    s = bt__fail (error, BT_ERR_FORMAT, "latitude %g, longitude %g is outside its cells",
                  at->latitude, at->longitude);
  *spot = (bt__flow_spot){ 1, { best / columns }, { best % columns }, { 1 } };
  free (x);
  free (y);
  return s;
}

/* Open the two arrays that PART's attribute `coordinates' names, latitude first.  True if both are
   there and as large as its last two dimensions.  */
static int
open_fields (GDALGroupH group, const bt__flow_part *part, bt__array field[2])
{
  char names[TEXT];
  int found[2] = { 0, 0 };
  bt__array_attribute (&part->array, "coordinates", names, sizeof names);
  for (char *name = strtok (names, " "); name; name = strtok (NULL, " "))
    {
      bt__array a;
      if (!bt__array_open (group, name, &a))
        continue;
      int way = points (&a, 0) ? 0 : points (&a, 1) ? 1 : -1;
      if (way >= 0 && !found[way] && a.n == 2 && a.size[0] == part->array.size[part->row]
          && a.size[1] == part->array.size[part->column])
        {
          field[way] = a;
          found[way] = 1;
        }
      else
        bt__array_close (&a);
    }
  return found[0] && found[1];
}

bt_status
bt__flow_find_spot (GDALGroupH group, const bt_geo_origin *at, bt__flow_part *part, bt_error *error)
{
  bt__array side[2] = { { 0 }, { 0 } };
  bt_status s;
  part->row = (int)part->array.n - 2;
  part->column = (int)part->array.n - 1;
  bt__array_open (group, part->array.name[part->row], side);
  bt__array_open (group, part->array.name[part->column], side + 1);
  if (side[0].n == 1 && side[1].n == 1 && points (side, 0) && points (side + 1, 1))
    s = find_on_lines (side, at, &part->spot, error);
  else
    {
      bt__array_close (side);
      bt__array_close (side + 1);
      s = open_fields (group, part, side)
              ? find_nearest (side, at, &part->spot, error)
              : bt__fail (error, BT_ERR_FORMAT,
                          "it does not say at which latitudes and longitudes its current is");
    }
  bt__array_close (side);
  bt__array_close (side + 1);
  return s;
}
