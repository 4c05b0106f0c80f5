/* The entry of the extension: fills the module (bight engine), and raises the engine's errors.

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
    raise = scm_c_public_lookup ("bight errors", "raise-engine-error");
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

/* The folder that the environment names, else the installed one.  */
static SCM
folder (const char *variable, const char *installed)
{
  const char *set = getenv (variable);
  return scm_from_locale_string (set && *set ? set : installed);
}

static SCM
worlds_folder (void)
{
  return folder ("BIGHT_WORLDS", BIGHT_WORLDS_DIR);
}

static SCM
programs_folder (void)
{
  return folder ("BIGHT_LIBEXEC", BIGHT_LIBEXEC_DIR);
}

static void
define_folders (void)
{
  static const bt__procedure table[] = {
    { "%worlds-folder", 0, 0, (scm_t_subr)worlds_folder,
      "Return the folder of the worlds that come with bight; BIGHT_WORLDS overrides it." },
    { "%programs-folder", 0, 0, (scm_t_subr)programs_folder,
      "Return the folder of the benchmark programs; BIGHT_LIBEXEC overrides it." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}

void bight_guile_init (void);

__attribute__ ((visibility ("default"))) void
bight_guile_init (void)
{
  define_folders ();
  bt__define_parts ();
  bt__define_dives ();
  bt__define_operations ();
  bt__define_questions ();
}
