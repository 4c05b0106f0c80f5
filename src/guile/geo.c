/* Geographic files between Scheme and C.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include <bight/geo.h>

#include "guile/guile.h"

/* (LATITUDE LONGITUDE), numbers.  */
static bt_geo_origin
to_origin (SCM list)
{
  return (bt_geo_origin){ scm_to_double (scm_car (list)), scm_to_double (scm_cadr (list)) };
}

static char *
to_text_or_null (SCM object)
{
  return scm_is_string (object) ? scm_to_locale_string (object) : NULL;
}

static bt_geo_sign
to_sign (SCM word)
{
  return scm_is_eq (word, scm_from_utf8_symbol ("up"))     ? BT_GEO_UP
         : scm_is_eq (word, scm_from_utf8_symbol ("down")) ? BT_GEO_DOWN
                                                           : BT_GEO_AS_TOLD;
}

static void
free_bed (void *data)
{
  bt_heights_data_free (data);
}

static SCM
read_geo_heights (SCM file, SCM origin, SCM reach, SCM sign, SCM system, SCM variable)
{
  char *name = scm_to_locale_string (file), *system_name = to_text_or_null (system),
       *variable_name = to_text_or_null (variable);
  bt_geo_bed wanted
      = { to_origin (origin), system_name, variable_name, to_sign (sign), scm_to_double (reach) };
  bt_heights_data *data;
  bt_error error;
  bt_status status = bt_geo_heights_read (name, &wanted, &data, &error);
  free (name);
  free (system_name);
  free (variable_name);
  bt__check ("enter!", status, &error);
  return scm_from_pointer (data, free_bed);
}

static void
free_column (void *data)
{
  bt_current_grid_free (data);
}

static SCM
read_geo_current (SCM file, SCM at, SCM start)
{
  char *name = scm_to_locale_string (file);
  bt_geo_column wanted = { to_origin (at), scm_is_true (start) ? scm_to_double (start) : NAN };
  bt_current_grid *grid;
  bt_error error;
  bt_status status = bt_geo_current_read (name, &wanted, &grid, &error);
  free (name);
  bt__check ("enter!", status, &error);
  return scm_from_pointer (grid, free_column);
}

enum
{
  COLUMNS = 7
};

static SCM
current_of_rows (SCM numbers)
{
  bt_current_grid *grid;
  bt_error error;
  size_t n = scm_c_array_length (numbers) / COLUMNS;
  const double *rows = (const double *)SCM_BYTEVECTOR_CONTENTS (numbers);
  bt_status status
      = bt_current_grid_new ((const double (*)[COLUMNS]) (const void *)rows, n, &grid, &error);
  bt__check ("enter!", status, &error);
  return scm_from_pointer (grid, free_column);
}

void
bt__define_geo (void)
{
  static const bt__procedure table[] = {
    { "%read-geo-heights", 6, 0, (scm_t_subr)read_geo_heights,
      "Return the heights in FILE, a bathymetry in the coordinates of a map, about ORIGIN, "
      "(LATITUDE "
      "LONGITUDE), within REACH metres (0: all); SIGN is up, down or #f, SYSTEM and VARIABLE texts "
      "or "
      "#f: an object for %make-dive." },
    { "%read-geo-current", 3, 0, (scm_t_subr)read_geo_current,
      "Return the current of the ocean model in FILE AT (LATITUDE LONGITUDE), time 0 being START, "
      "s "
      "since 1970 or #f: an object for %make-dive." },
    { "%current-of-rows", 1, 0, (scm_t_subr)current_of_rows,
      "Return the current of NUMBERS, an f64vector of rows x y z t u v w: an object for "
      "%make-dive." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
