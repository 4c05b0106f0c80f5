/* ESRI ASCII grids: where the heights stand, every way to write the header, every way to get one
   wrong, each error with its line.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "mesh/grid.h"

static bt_heights_data *
accepted (const char *text)
{
  bt_heights_data *data;
  bt_error e = { 0 };
  if (bt__grid_parse ("g.asc", text, strlen (text), &data, &e) != BT_OK)
    fail_msg ("%s", e.text);
  return data;
}

/* TEXT, N bytes, must be refused with WORDS.  The copy has not a byte too many.  */
static void
refused_bytes (const char *text, size_t n, bt_status status, const char *words)
{
  bt_heights_data *data = (bt_heights_data *)(uintptr_t)1;
  bt_error e = { 0 };
  char *copy = malloc (n + 1);
  assert_non_null (copy);
  memcpy (copy, text, n);
  copy[n] = '\0';
  bt_status s = bt__grid_parse ("g.asc", copy, n, &data, &e);
  free (copy);
  if (s != status || e.status != status || data || !strstr (e.text, words))
    fail_msg ("`%s': %s: %s; wanted: %s", text, bt_status_name (s), e.text, words);
}

static void
refused (const char *text, const char *words)
{
  refused_bytes (text, strlen (text), BT_ERR_FORMAT, words);
}

#define HEAD "ncols 3\nnrows 2\nxllcorner 500\nyllcorner -20\ncellsize 10\nNODATA_value -9999\n"

static void
rows_and_places (void **state)
{
  static const double wanted[] = { -4, -5, -6.5, -1, 0, -3 };
  bt_heights_data *d = accepted (HEAD "-1 -9999 -3\n-4 -5 -6.5\n");
  (void)state;
  assert_ptr_equal (d->z, d->heights.z);
  assert_int_equal (d->heights.nx, 3);
  assert_int_equal (d->heights.ny, 2);
  assert_true (d->heights.x == 505 && d->heights.y == -15);
  assert_true (d->heights.dx == 10 && d->heights.dy == 10);
  for (int i = 0; i < 6; i++)
    assert_true (i == 4 ? isnan (d->z[i]) : d->z[i] == wanted[i]);
  bt_heights_data_free (d);
}

/* The same grid, whatever the writer's habits.  */
static void
headers (void **state)
{
  static const char *const texts[] = {
    "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 7\r\nYLLCENTER 8\r\nCELLSIZE 4\r\n1 2\r\n3 4\r\n",
    "yllcenter 8 xllcenter 7 cellsize 4 nrows 2 ncols 2 1 2 3 4",
    "\xef\xbb\xbfncols 2\nnrows 2\nxllcorner 5\nyllcorner 6\ndx 4\ndy 4\n1\n2\n3\n4",
    "ncols\t2\nnrows\t2.0\nxllcorner 5e0\nyllcenter +8\nnodata_value nan\ndy 4\ndx 4.\n1 2 3 4\n\n",
  };
  (void)state;
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    {
      bt_heights_data *d = accepted (texts[i]);
      assert_true (d->heights.x == 7 && d->heights.y == 8);
      assert_true (d->heights.dx == 4 && d->heights.dy == 4);
      assert_true (d->z[0] == 3 && d->z[1] == 4 && d->z[2] == 1 && d->z[3] == 2);
      bt_heights_data_free (d);
    }
}

static void
no_data (void **state)
{
  bt_heights_data *d
      = accepted ("ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1 1 -9999 -9999.0 4");
  (void)state;
  assert_true (isnan (d->z[0]) && isnan (d->z[3])); /* what a file that does not say means */
  bt_heights_data_free (d);
  d = accepted ("ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1 nodata_value "
                "-3.4028234663852886e+38 1 -3.4028234663852886e+38 3 4");
  assert_true (isnan (d->z[3]) && d->z[2] == 1);
  bt_heights_data_free (d);
  d = accepted ("ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1 nodata_value NaN 1 nan 3 4");
  assert_true (isnan (d->z[3]));
  bt_heights_data_free (d);
  refused (HEAD "1 2 3\n4 5 nan\n", "line 8: `nan' where a height was expected");
  refused (HEAD "-9999 -9999 -9999\n-9999 -9999 -9999\n", "no height");
}

static void
bad_headers (void **state)
{
  (void)state;
  refused ("", "ncols");
  refused ("hello", "line 1: it is no ASCII grid");
  refused ("1 2 3 4", "ncols");
  refused ("ncols 3\n1 2 3\n", "it must give nrows");
  refused ("ncols", "line 1: the file ends where a whole number from 2 on");
  refused ("ncols 3\nncols 3\n", "line 2: ncols is given twice");
  refused ("ncols 1\n", "line 1: `1' where a whole number");
  refused ("ncols -5\n", "`-5' where a whole number");
  refused ("ncols 2.5\n", "`2.5' where a whole number");
  refused ("ncols 0x10\n", "`0x10' where a whole number");
  refused ("ncols 1e99\n", "`1e99' where a whole number");
  refused ("ncols 2\nnrows 2\nxllcorner 1e300\n", "line 3: `1e300' where a number of metres");
  refused ("ncols 2\nnrows 2\nxllcorner inf\n", "line 3: `inf'");
  refused ("cellsize 0\n", "`0' where a positive number");
  refused ("cellsize -1\n", "`-1' where a positive number");
  refused ("cellsize 0,5\n", "decimals are written with a point");
  refused ("ncols 2 nrows 2 xllcorner 0 xllcenter 0 yllcorner 0 cellsize 1 1 2 3 4",
           "one of xllcorner and xllcenter");
  refused ("ncols 2 nrows 2 xllcorner 0 cellsize 1 1 2 3 4", "one of yllcorner and yllcenter");
  refused ("ncols 2 nrows 2 xllcorner 0 yllcorner 0 dx 1 1 2 3 4", "either cellsize or dx and dy");
  refused ("ncols 2 nrows 2 xllcorner 0 yllcorner 0 cellsize 1 dy 1 1 2 3 4",
           "either cellsize or dx and dy");
  refused ("ncols 2 nrows 2 xllcorner 0 yllcorner 0 cell_size 1 1 2 3 4", "`cell_size'");
  refused_bytes ("ncols 100000 nrows 100000 xllcorner 0 yllcorner 0 cellsize 1 1", 62, BT_ERR_LIMIT,
                 "100000 by 100000 heights; at most 5000000");
}

static void
bad_heights (void **state)
{
  (void)state;
  refused (HEAD "1 2 3\n4 5\n", "line 9: the file ends where a height was expected");
  refused (HEAD "1 2 3\n", "the file ends");
  refused (HEAD, "the file ends");
  refused (HEAD "1 2 3\n4 5 6\n7\n", "line 9: `7' where the end of the file");
  refused (HEAD "1 2 3\n4 five 6\n", "line 8: `five' where a height");
  refused (HEAD "1 2 3\n4 5,5 6\n", "line 8: `5,5' where a height was expected; decimals");
  refused (HEAD "1 2 3\n4 1e999 6\n", "line 8: `1e999'");
  refused (HEAD "1 2 3\n4 - 6\n", "line 8: `-'");
  refused (HEAD "1 2 3\n4 1e 6\n", "line 8: `1e'");
  refused (HEAD "1 2 3\n4 1-2 6\n", "line 8: `1-2'");
  refused (HEAD "1 2 3\n4 0x1p3 6\n", "line 8: `0x1p3'");
  refused (HEAD "1 2 3\n4 -3.4e38 6\n", "within 100 km of the sea surface, or the NODATA_value");
  refused_bytes (HEAD "1 2 3\n4 \0 6\n", sizeof HEAD - 1 + 12, BT_ERR_FORMAT, "line 8: `?'");
  refused (HEAD "1 123456789012345678901234567890x", "line 7: `123456789012345678901234...'");
}

/* Whether a locale of people who write a decimal comma is in force: one that the system has, or one
   made in FOLDER of its descriptions.  */
static int
comma_is_written (const char *folder)
{
  static const char *const names[] = { "de_DE.UTF-8", "fr_FR.UTF-8", "nb_NO.UTF-8" };
  char command[200];
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (setlocale (LC_ALL, names[i]))
      return 1;
  snprintf (command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1",
            folder);
  return system (command) == 0 && setenv ("LOCPATH", folder, 1) == 0
         && setlocale (LC_ALL, "de_DE.UTF-8");
}

/* A decimal point is a point where people write a comma.  */
static void
other_languages (void **state)
{
  char folder[] = "/tmp/bight-locale-XXXXXX", command[60];
  int comma;
  (void)state;
  assert_non_null (mkdtemp (folder));
  comma = comma_is_written (folder);
  if (comma)
    {
      bt_heights_data *d = accepted (HEAD "1 2 3\n4 5 -6.5\n");
      assert_string_equal (localeconv ()->decimal_point, ",");
      assert_true (d->z[2] == -6.5);
      bt_heights_data_free (d);
      setlocale (LC_ALL, "C");
    }
  snprintf (command, sizeof command, "rm -rf %s", folder);
  assert_int_equal (system (command), 0);
  if (!comma)
    skip (); /* Debian package: locales */
}

static void
files (void **state)
{
  char name[] = "/tmp/bight-grid-XXXXXX";
  bt_heights_data *data;
  bt_error e = { 0 };
  int fd = mkstemp (name);
  (void)state;
  assert_true (fd >= 0);
  assert_int_equal (bt_heights_read (name, &data, &e), BT_ERR_IO);
  assert_non_null (strstr (e.text, "is empty"));
  assert_int_equal (write (fd, HEAD "1 2 3\n4 5 6\n", sizeof HEAD + 11), sizeof HEAD + 11);
  assert_int_equal (bt_heights_read (name, &data, &e), BT_OK);
  assert_true (data->z[0] == 4);
  bt_heights_data_free (data);
  assert_int_equal (ftruncate (fd, 600000000), 0);
  assert_int_equal (bt_heights_read (name, &data, NULL), BT_ERR_LIMIT);
  close (fd);
  unlink (name);
  assert_int_equal (bt_heights_read (name, &data, &e), BT_ERR_IO);
  assert_non_null (strstr (e.text, "No such file"));
  assert_int_equal (bt_heights_read ("/tmp", &data, &e), BT_ERR_IO);
  assert_null (data);
  assert_non_null (strstr (e.text, "is a folder"));
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (rows_and_places), cmocka_unit_test (headers),
    cmocka_unit_test (no_data),         cmocka_unit_test (bad_headers),
    cmocka_unit_test (bad_heights),     cmocka_unit_test (other_languages),
    cmocka_unit_test (files),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
