/* Times and levels of an ocean model.

   Times have a unit such as "hours since 1950-01-01 00:00:00" (CF conventions); they become seconds
   since 1970 in the Gregorian calendar, by H. Hinnant's days_from_civil, and must rise.  Other
   calendars, such as years of 360 days, are refused.

   Levels are depths, or follow the bed by the s-coordinate of ROMS (ROMS wiki, "Vertical
   S-coordinate", transformations 1 and 2, at a still surface).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "geo-reader/flow.h"

enum
{
  TEXT = 128
};

static double *
one_zero (bt_error *error)
{
  double *one = calloc (1, sizeof *one);
  if (!one)
    bt__fail (error, BT_ERR_LIMIT, "there is no memory");
  return one;
}

/* ---- Times ---- */

/* Days from 1970-01-01 to a day of the Gregorian calendar (H. Hinnant's days_from_civil).  */
static double
days_from_civil (int year, int month, int day)
{
  year -= month <= 2;
  int era = (year >= 0 ? year : year - 399) / 400, of_era = year - era * 400;
  int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097.0 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

const char *
bt__flow_time_text (double t, char text[BT__FLOW_TIME_TEXT])
{
  double day = floor (t / 86400), left = t - 86400 * day;
  int z = (int)day + 719468, era = (z >= 0 ? z : z - 146096) / 146097, of_era = z - era * 146097;
  int year = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  int of_year = of_era - (365 * year + year / 4 - year / 100), month = (5 * of_year + 2) / 153;
  int minute = (int)(left / 60);
  snprintf (text, BT__FLOW_TIME_TEXT, "%04d-%02d-%02dT%02d:%02dZ", year + era * 400 + (month >= 10),
            month < 10 ? month + 3 : month - 9, of_year - (153 * month + 2) / 5 + 1, minute / 60,
            minute % 60);
  return text;
}

/* Seconds of the unit WORD of time, or 0.  */
static double
seconds_of (const char *word)
{
  static const struct
  {
    const char *word;
    double seconds;
  } units[] = { { "second", 1 },  { "sec", 1 },   { "s", 1 },    { "minute", 60 }, { "min", 60 },
                { "hour", 3600 }, { "hr", 3600 }, { "h", 3600 }, { "day", 86400 }, { "d", 86400 } };
  size_t n = strlen (word);
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    {
      size_t k = strlen (units[i].word);
      if (strncmp (word, units[i].word, k) == 0 && (n == k || (n == k + 1 && word[k] == 's')))
        return units[i].seconds;
    }
  return 0;
}

/* Parse a unit such as "hours since 1950-01-01 00:00:00": the seconds of the unit, and the
   beginning in seconds since 1970.  Return true for a unit of this form.  */
static int
parse_unit (const char *unit, double *seconds, double *begin)
{
  char word[16];
  int year, month, day, hour = 0, minute = 0;
  double second = 0;
  if (sscanf (unit, "%15s since %d-%d-%d%*[T ]%d:%d:%lf", word, &year, &month, &day, &hour, &minute,
              &second)
      < 4)
    return 0;
  *seconds = seconds_of (word);
  if (*seconds == 0 || abs (year) > 9999 || month < 1 || month > 12 || day < 1 || day > 31)
    return 0;
  *begin = 86400 * days_from_civil (year, month, day) + 3600.0 * hour + 60.0 * minute + second;
  return 1;
}

static int
is_plain_calendar (const bt__array *a)
{
  static const char *const plain[] = { "", "standard", "gregorian", "proleptic_gregorian" };
  char name[TEXT];
  bt__array_attribute (a, "calendar", name, sizeof name);
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
    if (strcmp (name, plain[i]) == 0)
      return 1;
  return 0;
}

/* Turn the N TIMES in the unit of A to seconds since 1970, which must rise.  */
static bt_status
to_seconds (const bt__array *a, double *times, bt_error *error)
{
  char unit[TEXT];
  double seconds, begin;
  if (!parse_unit (bt__array_attribute (a, "units", unit, sizeof unit), &seconds, &begin))
    return bt__fail (error, BT_ERR_FORMAT,
                     "its times have no unit such as `hours since 1950-01-01 00:00:00'");
  if (!is_plain_calendar (a))
    return bt__fail (error, BT_ERR_FORMAT, "its times are of another calendar than ours");
  for (size_t i = 0; i < a->size[0]; i++)
    {
      times[i] = begin + seconds * times[i];
      if (!(fabs (times[i]) < 1e11) || (i > 0 && !(times[i] > times[i - 1])))
        return bt__fail (error, BT_ERR_FORMAT, "its times do not rise");
    }
  return BT_OK;
}

double *
bt__flow_times (GDALGroupH group, const bt__flow_part *part, bt_error *error)
{
  if (part->time < 0)
    return one_zero (error);
  bt__array a;
  double *times = NULL;
  if (!bt__array_open (group, part->array.name[part->time], &a) || a.n != 1)
    bt__fail (error, BT_ERR_FORMAT, "it does not say at which times its current is");
  else
    times = bt__array_read_all (&a, error);
  if (times && to_seconds (&a, times, error) != BT_OK)
    {
      free (times);
      times = NULL;
    }
  bt__array_close (&a);
  return times;
}

/* ---- Levels ---- */

/* The number of the field NAME at the cell nearest to AT.  */
static double
field_at (GDALGroupH group, const char *name, const bt_geo_origin *at)
{
  static const size_t one[2] = { 1, 1 };
  bt__flow_part field = { .time = -1, .level = -1 };
  bt_error ignored;
  double value = NAN;
  if (bt__array_open (group, name, &field.array) && field.array.n == 2
      && bt__flow_find_spot (group, at, &field, &ignored) == BT_OK)
    bt__array_read (&field.array, (size_t[]){ field.spot.row[0], field.spot.column[0] }, one,
                    &value, &ignored);
  bt__array_close (&field.array);
  return value;
}

/* Turn the N levels S, -1 at the bed to 0 at the surface, to heights.  */
static bt_status
follow_bed (GDALGroupH group, const bt_geo_origin *at, size_t n, double *s, bt_error *error)
{
  bt__array stretch;
  double *c = bt__array_open (group, "Cs_r", &stretch) && stretch.n == 1 && stretch.size[0] == n
                  ? bt__array_read_all (&stretch, error)
                  : NULL;
  double h = field_at (group, "h", at), hc = bt__array_number (group, "hc", NAN);
  double transform = bt__array_number (group, "Vtransform", 1);
  bt__array_close (&stretch);
  int known = c && h > 0 && hc >= 0 && (transform == 1 || transform == 2);
  for (size_t i = 0; known && i < n; i++)
    s[i] = transform == 1 ? hc * s[i] + (h - hc) * c[i] : h * (hc * s[i] + h * c[i]) / (hc + h);
  free (c);
  return known ? BT_OK
               : bt__fail (error, BT_ERR_FORMAT,
                           "its levels follow the bed, and of h, hc, Cs_r and Vtransform not all "
                           "is there, or the place is dry");
}

double *
bt__flow_levels (GDALGroupH group, const bt__flow_part *part, const bt_geo_origin *at,
                 bt_error *error)
{
  if (part->level < 0)
    return one_zero (error);
  char text[TEXT];
  bt__array a;
  double *z = NULL;
  if (!bt__array_open (group, part->array.name[part->level], &a) || a.n != 1)
    bt__fail (error, BT_ERR_FORMAT, "it does not say at which depths its current is");
  else
    z = bt__array_read_all (&a, error);
  bt_status s = z ? BT_OK : BT_ERR_FORMAT;
  if (z
      && strncmp (bt__array_attribute (&a, "standard_name", text, sizeof text), "ocean_s", 7) == 0)
    s = follow_bed (group, at, a.size[0], z, error);
  else if (z && strcasecmp (bt__array_attribute (&a, "positive", text, sizeof text), "up") != 0)
    for (size_t i = 0; i < a.size[0]; i++)
      z[i] = 0 - z[i];
  bt__array_close (&a);
  if (s == BT_OK)
    return z;
  free (z);
  return NULL;
}
