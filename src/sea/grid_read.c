/* Reading the table of a current: text, a row a line.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <bight/sea.h>

#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

enum
{
  COLUMNS = 7,
  LINE_MAX_BYTES = 1024,
  ROWS_MAX = 1 << 26
};

enum
{
  UNNAMED,
  NAMED,
  MISNAMED
};

typedef struct table
{
  double (*row)[COLUMNS];
  size_t n, room;
  locale_t plain; /* a point in numbers, whatever the user's language */
} table;

static int
is_blank (char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* Take the numbers of LINE to ROW; return how many there are, -1 when something else is among
   them.  */
static int
parse_current_grid (const table *t, const char *line, double *row)
{
  int n = 0;
  for (;;)
    {
      char *end;
      while (is_blank (*line) || (n > 0 && (*line == ',' || *line == ';')))
        line++;
      if (*line == 0)
        return n;
      double value = strtod_l (line, &end, t->plain);
      if (end == line || (*end && !is_blank (*end) && *end != ',' && *end != ';'))
        return -1;
      if (n < COLUMNS)
        row[n] = value;
      n++;
      line = end;
    }
}

static bt_status
append_row (table *t, const double *row, bt_error *error)
{
  if (t->n == t->room)
    {
      size_t room = t->room ? 2 * t->room : 256;
      void *more = room > ROWS_MAX ? NULL : realloc (t->row, room * sizeof *t->row);
      if (!more)
        return bt__fail (error, BT_ERR_LIMIT, "no memory for the %zu rows of a current", room);
      t->row = more;
      t->room = room;
    }
  memcpy (t->row[t->n++], row, sizeof *t->row);
  return BT_OK;
}

/* True if LINE names the columns of a current in order, with or without units.  */
static int
names_columns (const char *line)
{
  const char *name = "xyztuvw";
  for (; *name; name++)
    {
      while (is_blank (*line) || *line == ',' || *line == ';')
        line++;
      if ((*line | 32) != *name || isalnum ((unsigned char)line[1]))
        return 0;
      while (*line && !is_blank (*line) && *line != ',' && *line != ';')
        line++;
      while (is_blank (*line))
        line++;
      if (*line == '(' || *line == '[')
        while (*line && *line++ != ')' && line[-1] != ']')
          ;
    }
  return 1;
}

/* The first line with anything on it may name the columns.  */
static bt_status
take_line (table *t, const char *file, size_t number, const char *line, int *named, bt_error *error)
{
  double row[COLUMNS];
  const char *p = line;
  while (is_blank (*p))
    p++;
  if (*p == 0 || *p == '#')
    return BT_OK;
  int n = parse_current_grid (t, p, row);
  if (n == COLUMNS && *named == MISNAMED)
    return bt__fail (
        error, BT_ERR_FORMAT,
        "%.200s has other names for its columns than those of a current, x y z t u v w "
        "in this order (m, s and m/s)",
        file);
  if (n == COLUMNS)
    return append_row (t, row, error);
  if (n < 0 && t->n == 0 && *named == UNNAMED)
    {
      *named = names_columns (p) ? NAMED : MISNAMED;
      return BT_OK;
    }
  if (n < 0)
    return bt__fail (error, BT_ERR_FORMAT, "%.200s, line %zu: not a row of numbers", file, number);
  return bt__fail (error, BT_ERR_FORMAT,
                   "%.200s, line %zu: %d numbers where a current has 7: x y z t u v w", file,
                   number, n);
}

static bt_status
read_current_rows (FILE *stream, const char *file, table *t, bt_error *error)
{
  char line[LINE_MAX_BYTES];
  int named = UNNAMED;
  for (size_t number = 1; fgets (line, sizeof line, stream); number++)
    {
      if (!strchr (line, '\n') && !feof (stream))
        return bt__fail (error, BT_ERR_FORMAT, "%.200s, line %zu: longer than %d bytes", file,
                         number, LINE_MAX_BYTES - 1);
      bt_status status = take_line (t, file, number, line, &named, error);
      if (status != BT_OK)
        return status;
    }
  if (ferror (stream))
    return bt__fail (error, BT_ERR_IO, "%.200s cannot be read: %s", file, strerror (errno));
  return BT_OK;
}

bt_status
bt_current_grid_read (const char *file, bt_current_grid **grid, bt_error *error)
{
  table t = { NULL, 0, 0, newlocale (LC_ALL_MASK, "C", (locale_t)0) };
  bt_status status;
  if (t.plain == (locale_t)0)
    return bt__fail (error, BT_ERR_LIMIT, "no memory to read %.200s", file);
  FILE *stream = fopen (file, "r");
  if (stream)
    status = read_current_rows (stream, file, &t, error);
  else
    status = bt__fail (error, BT_ERR_IO, "%.200s cannot be read: %s", file, strerror (errno));
  if (stream)
    fclose (stream);
  if (status == BT_OK)
    status = bt_current_grid_new ((const double (*)[COLUMNS])t.row, t.n, grid, error);
  free (t.row);
  freelocale (t.plain);
  return status;
}
