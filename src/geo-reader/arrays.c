/* Arrays of a NetCDF file.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>

#include "base/error.h"
#include "geo-reader/arrays.h"

static void
take_dimensions (bt__array *a, GDALDimensionH *dimensions)
{
  for (size_t i = 0; i < a->n; i++)
    {
      a->size[i] = (size_t)GDALDimensionGetSize (dimensions[i]);
      snprintf (a->name[i], sizeof a->name[i], "%s", GDALDimensionGetName (dimensions[i]));
    }
}

int
bt__array_open (GDALGroupH group, const char *name, bt__array *a)
{
  *a = (bt__array){ .array = GDALGroupOpenMDArray (group, name, NULL) };
  if (!a->array)
    return 0;
  size_t n;
  GDALDimensionH *dimensions = GDALMDArrayGetDimensions (a->array, &n);
  if (n <= BT__ARRAY_DIMENSIONS)
    {
      a->n = n;
      take_dimensions (a, dimensions);
    }
  GDALReleaseDimensions (dimensions, n);
  if (n > BT__ARRAY_DIMENSIONS)
    bt__array_close (a);
  return a->array != NULL;
}

void
bt__array_close (bt__array *a)
{
  if (a->array)
    GDALMDArrayRelease (a->array);
  a->array = NULL;
}

const char *
bt__array_attribute (const bt__array *a, const char *name, char *text, size_t size)
{
  GDALAttributeH attribute = a->array ? GDALMDArrayGetAttribute (a->array, name) : NULL;
  const char *value = attribute ? GDALAttributeReadAsString (attribute) : NULL;
  snprintf (text, size, "%s", value ? value : "");
  if (attribute)
    GDALAttributeRelease (attribute);
  return text;
}

/* The number of A's attribute NAME; NaN without one.  */
static double
attribute_number (const bt__array *a, const char *name)
{
  GDALAttributeH attribute = GDALMDArrayGetAttribute (a->array, name);
  double number = attribute ? GDALAttributeReadAsDouble (attribute) : NAN;
  if (attribute)
    GDALAttributeRelease (attribute);
  return number;
}

bt_status
bt__array_read (const bt__array *a, const size_t *first, const size_t *count, double *numbers,
                bt_error *error)
{
  GUInt64 start[BT__ARRAY_DIMENSIONS + 1] = { 0 };
  size_t n = 1, counts[BT__ARRAY_DIMENSIONS + 1] = { 1 };
  for (size_t i = 0; i < a->n; i++)
    {
      start[i] = first[i];
      counts[i] = count[i];
      n *= count[i];
    }
  GDALExtendedDataTypeH type = GDALExtendedDataTypeCreate (GDT_Float64);
  int fine = GDALMDArrayRead (a->array, start, counts, NULL, NULL, type, numbers, numbers,
                              n * sizeof *numbers);
  GDALExtendedDataTypeRelease (type);
  if (!fine)
    return bt__fail (error, BT_ERR_FORMAT, "it is damaged: its numbers cannot all be read");
  int has_none, has_scale, has_offset;
  double none = GDALMDArrayGetNoDataValueAsDouble (a->array, &has_none);
  double missing = attribute_number (a, "missing_value"); /* beside _FillValue, or without */
  double scale = GDALMDArrayGetScale (a->array, &has_scale);
  double offset = GDALMDArrayGetOffset (a->array, &has_offset);
  for (size_t i = 0; i < n; i++)
    if ((has_none && numbers[i] == none) || numbers[i] == missing || !isfinite (numbers[i])
        || fabs (numbers[i]) > 1e30)
      numbers[i] = NAN;
    else
      numbers[i] = numbers[i] * (has_scale ? scale : 1) + (has_offset ? offset : 0);
  return BT_OK;
}

double *
bt__array_read_all (const bt__array *a, bt_error *error)
{
  static const size_t origin[BT__ARRAY_DIMENSIONS] = { 0 };
  double n = 1;
  for (size_t i = 0; i < a->n; i++)
    n *= (double)a->size[i];
  double *numbers = n >= 1 && n <= BT__ARRAY_NUMBERS ? malloc ((size_t)n * sizeof *numbers) : NULL;
  if (!numbers)
    {
      bt__fail (error, BT_ERR_LIMIT, "an array of %.0f numbers; 1 to %d are read", n,
                BT__ARRAY_NUMBERS);
      return NULL;
    }
  if (bt__array_read (a, origin, a->size, numbers, error) == BT_OK)
    return numbers;
  free (numbers);
  return NULL;
}

double
bt__array_number (GDALGroupH group, const char *name, double otherwise)
{
  bt__array a;
  bt_error ignored;
  double *all = bt__array_open (group, name, &a) ? bt__array_read_all (&a, &ignored) : NULL;
  double number = all && isfinite (all[0]) ? all[0] : otherwise;
  free (all);
  bt__array_close (&a);
  return number;
}
