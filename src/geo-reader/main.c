/* bight-geo-reader: read bathymetry or a current in geographic coordinates and write a table to
   standard output in the form of src/geo/stream.h. bight runs a process for each geographic file of
   a world: GDAL, PROJ and damaged files cannot harm the dive.

     bight-geo-reader CPU-SECONDS MEGABYTES FILE bed LATITUDE LONGITUDE REACH SIGN SYSTEM VARIABLE
     bight-geo-reader CPU-SECONDS MEGABYTES FILE current LATITUDE LONGITUDE START

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "geo-reader/geo.h"
#include "mesh-reader/enclosed.h"
#include "mesh/reader.h"

static int
write_table (FILE *to, bt__geo_made *made)
{
  uint64_t sum = 0;
  memcpy (made->head.magic, BT__GEO_MAGIC, sizeof made->head.magic);
  made->head.version = BT__GEO_VERSION;
  size_t n = (size_t)made->head.columns * made->head.rows;
  return bt__enclosed_put (to, &made->head, sizeof made->head, &sum)
         && bt__enclosed_put (to, made->numbers, n * sizeof *made->numbers, &sum)
         && bt__enclosed_finish (to, sum);
}

static bt_geo_sign
to_sign_word (const char *word)
{
  return strcmp (word, "up") == 0     ? BT_GEO_UP
         : strcmp (word, "down") == 0 ? BT_GEO_DOWN
                                      : BT_GEO_AS_TOLD;
}

static const char *
text_or_null (const char *text)
{
  return *text ? text : NULL;
}

/* The C locale is in force: numbers have a point.  */
static bt_status
make_table (const char *file, char **arguments, bt__geo_made *made, bt_error *error)
{
  bt_geo_origin at = { strtod (arguments[1], NULL), strtod (arguments[2], NULL) };
  double third = strtod (arguments[3], NULL);
  if (strcmp (arguments[0], "current") == 0)
    return bt__geo_flow_make (file, &(bt_geo_column){ at, third }, made, error);
  bt__geo_wish wish = { file,
                        { .origin = at,
                          .reach = third,
                          .sign = to_sign_word (arguments[4]),
                          .system = text_or_null (arguments[5]),
                          .variable = text_or_null (arguments[6]) } };
  return bt__geo_bed_make (&wish, made, error);
}

static int
answer_with_table (const char *file, char **arguments, FILE *to)
{
  char path[PATH_MAX]; /* from the root: no name of a file may look like an address */
  bt__geo_made made = { 0 };
  bt_error error;
  if (!realpath (file, path))
    return bt__enclosed_complain (BT__READER_EXIT_IO, "it cannot be read");
  bt__geo_prepare ();
  if (make_table (path, arguments, &made, &error) != BT_OK)
    return bt__enclosed_complain_of (&error);
  if (!write_table (to, &made))
    return bt__enclosed_complain (BT__READER_EXIT_IO, "the numbers cannot be handed over");
  return BT__READER_EXIT_OK;
}

int
main (int argc, char **argv)
{
  int bed = argc == 11 && strcmp (argv[4], "bed") == 0;
  if (!bed && !(argc == 8 && strcmp (argv[4], "current") == 0))
    return bt__enclosed_complain (
        EXIT_FAILURE, "usage: bight-geo-reader CPU-SECONDS MEGABYTES FILE bed LATITUDE LONGITUDE "
                      "REACH told|up|down SYSTEM VARIABLE, or FILE current LATITUDE LONGITUDE "
                      "START, >NUMBERS");
  FILE *to = bt__enclosed_output ();
  if (!to)
    return bt__enclosed_complain (BT__READER_EXIT_IO, "there is no standard output");
  bt__enclosed_limit (argv[1], argv[2]);
  bt__enclosed_write_nothing ();
  int status = answer_with_table (argv[3], argv + 4, to);
  fflush (stderr);
  _exit (status); /* the memory goes with the process */
}
