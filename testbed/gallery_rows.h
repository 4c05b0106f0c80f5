/* How gallery.scm writes a world: rows of a table, each a part, a thing inside of the part before,
   or a field of the thing before, by the names of the engine's table of fields.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_GALLERY_ROWS_H
#define BT_TESTBED_GALLERY_ROWS_H

#include <stddef.h>

typedef struct gallery_row
{
  const char *head; /* kind of the part, or of the thing inside a part; NULL: the row is a field */
  const char *name; /* of the part or of the field; NULL: the row is a thing inside a part */
  const char *word; /* of a field, if a word is the value; else NULL */
  size_t n, width;  /* of a field: rows of numbers, and numbers in a row */
  const double *numbers;
} gallery_row;

typedef struct gallery_table
{
  const char *world;
  const gallery_row *rows;
  size_t n;
} gallery_table;

/* The table of a world without a name ends them.  */
extern const gallery_table gallery_tables[];

#endif
