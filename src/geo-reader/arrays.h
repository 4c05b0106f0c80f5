/* Arrays of a NetCDF file: numbers with their scale, NaN for missing values.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_GEO_READER_ARRAYS_H
#define BT_GEO_READER_ARRAYS_H

#include <stddef.h>

#include <gdal.h>

#include <bight/status.h>

enum
{
  BT__ARRAY_DIMENSIONS = 4,    /* of a variable at most: time, level, row, column */
  BT__ARRAY_NUMBERS = 20000000 /* of one array at most */
};

typedef struct bt__array
{
  GDALMDArrayH array;
  size_t n, size[BT__ARRAY_DIMENSIONS];
  char name[BT__ARRAY_DIMENSIONS][64]; /* of its dimensions */
} bt__array;

/* Open the array NAME of GROUP; true if there is one with at most BT__ARRAY_DIMENSIONS.  */
int bt__array_open (GDALGroupH group, const char *name, bt__array *a);
void bt__array_close (bt__array *a);

/* Write the attribute NAME of A to TEXT, "" where it is none.  Return TEXT.  */
const char *bt__array_attribute (const bt__array *a, const char *name, char *text, size_t size);

/* Read the numbers of A from FIRST on, COUNT of them along each dimension, to NUMBERS.  */
bt_status bt__array_read (const bt__array *a, const size_t *first, const size_t *count,
                          double *numbers, bt_error *error);

/* Return all numbers of A, freed by free; NULL on failure: BT_ERR_LIMIT, BT_ERR_FORMAT.  */
double *bt__array_read_all (const bt__array *a, bt_error *error);

/* Return the number that the array NAME of GROUP holds, or OTHERWISE.  */
double bt__array_number (GDALGroupH group, const char *name, double otherwise);

#endif
