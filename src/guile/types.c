/* The types of vehicles and tethers that come with the engine, as Scheme values.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"

static SCM
from_rows (const double *x, size_t n)
{
  SCM array = scm_make_typed_array (scm_from_utf8_symbol ("f64"), SCM_UNSPECIFIED,
                                    scm_list_2 (scm_from_size_t (n), scm_from_int (3)));
  scm_t_array_handle handle;
  scm_array_get_handle (array, &handle);
  memcpy (scm_array_handle_f64_writable_elements (&handle), x, 3 * n * sizeof *x);
  scm_array_handle_release (&handle);
  return array;
}

/* Put in front of LIST the fields of DEF, a struct of the kind HEAD, with values other than the
   initial values.  */
static SCM
from_fields (const bt_head *head, const void *def, const void *born, SCM list)
{
  for (size_t i = head->n_fields; i-- > 0;)
    {
      const bt_field *field = &head->fields[i];
      const char *at = (const char *)def + field->offset;
      size_t size = field->kind == BT_FIELD_SIX     ? sizeof (bt_six)
                    : field->kind == BT_FIELD_POINT ? sizeof (bt_vec3)
                                                    : sizeof (double);
      SCM value;
      if (born && memcmp (at, (const char *)born + field->offset, size) == 0)
        continue;
      value = field->kind == BT_FIELD_SIX ? from_rows ((const double *)(const void *)at, 2)
              : field->kind == BT_FIELD_POINT
                  ? bt__from_point (*(const bt_vec3 *)(const void *)at)
                  : bt__from_field (field, *(const double *)(const void *)at);
      list = scm_acons (scm_from_utf8_symbol (field->name), value, list);
    }
  return list;
}

static SCM
vehicle_types (void)
{
  const bt_head *rov = bt_head_find ("rov"), *thruster = bt_head_find ("thruster");
  SCM list = SCM_EOL;
  for (int i = 0; bt_vehicle_type_name (i); i++)
    {
      bt_vehicle_def def, born;
      bt_error error;
      SCM fields = SCM_EOL;
      bt_def_init (rov, &def);
      born = def;
      bt__check ("vehicle-types", bt_def_set_vehicle_type (&def, bt_vehicle_type_name (i), &error),
                 &error);
      for (int k = (int)def.n_thrusters; k-- > 0;)
        fields = scm_acons (scm_from_utf8_symbol ("thruster"),
                            from_fields (thruster, &def.thrusters[k], NULL, SCM_EOL), fields);
      list = scm_cons (scm_list_3 (scm_from_utf8_symbol (bt_vehicle_type_name (i)),
                                   scm_from_utf8_string (bt_vehicle_type_text (i)),
                                   from_fields (rov, &def, &born, fields)),
                       list);
    }
  return scm_reverse_x (list, SCM_EOL);
}

/* Where the I-th type of tether has each of its FIELDS from: (FIELD . TEXT) ...  */
static SCM
origins_of (int i, SCM fields)
{
  SCM list = SCM_EOL;
  for (; scm_is_pair (fields); fields = SCM_CDR (fields))
    {
      char *name = scm_to_utf8_string (scm_symbol_to_string (SCM_CAAR (fields)));
      list = scm_acons (SCM_CAAR (fields), scm_from_utf8_string (bt_tether_type_origin (i, name)),
                        list);
      free (name);
    }
  return list;
}

/* The tether types with their fields, and where these come from.  The fields of a type are found by
   filling a struct with impossible values: the type changes its own fields.  */
static SCM
tether_types (void)
{
  const bt_head *tether = bt_head_find ("tether");
  bt_tether_def blank;
  SCM list = SCM_EOL;
  memset (&blank, 0xa5, sizeof blank);
  blank.props.mass = blank.props.wet_weight = NAN; /* one of these may follow from the other */
  for (int i = 0; bt_tether_type_name (i); i++)
    {
      bt_tether_def def = blank;
      bt_error error;
      bt__check ("tether-types", bt_def_set_tether_type (&def, bt_tether_type_name (i), &error),
                 &error);
      SCM fields = from_fields (tether, &def, &blank, SCM_EOL);
      list = scm_cons (scm_list_4 (scm_from_utf8_symbol (bt_tether_type_name (i)),
                                   scm_from_utf8_string (bt_tether_type_text (i)), fields,
                                   origins_of (i, fields)),
                       list);
    }
  return scm_reverse_x (list, SCM_EOL);
}

void
bt__define_types (void)
{
  static const bt__procedure table[] = {
    { "%tether-types", 0, 0, (scm_t_subr)tether_types,
      "Return the types of tether that come with the engine, lists (NAME SENTENCE FIELDS)." },
    { "%vehicle-types", 0, 0, (scm_t_subr)vehicle_types,
      "Return the types of vehicle that come with the engine, lists (NAME SENTENCE FIELDS)." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
