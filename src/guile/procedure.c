/* How a C function becomes a Scheme procedure, and an engine's error a Scheme condition.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "guile/guile.h"

void
bt__define_procedures (const bt__procedure *table, size_t n)
{
  SCM key = scm_from_utf8_symbol ("documentation");
  for (size_t i = 0; i < n; i++)
    {
      SCM procedure = scm_c_define_gsubr (table[i].name, table[i].required, table[i].optional, 0,
                                          table[i].function);
      scm_set_procedure_property_x (procedure, key, scm_from_utf8_string (table[i].documentation));
      scm_c_export (table[i].name, NULL);
    }
}

void
bt__raise (const char *who, const bt_error *error)
{
  static SCM raise; /* the variable; modules are not collected */
  if (!raise)
    raise = scm_c_public_lookup ("bight core errors", "raise-engine-error");
  scm_call_3 (scm_variable_ref (raise), scm_from_utf8_symbol (bt_status_name (error->status)),
              scm_from_utf8_symbol (who), scm_from_utf8_string (error->text));
  abort (); /* raise-engine-error does not return */
}

void
bt__check (const char *who, bt_status status, const bt_error *error)
{
  if (status != BT_OK)
    bt__raise (who, error);
}
