/* The entry of the extension: fills the module (bight engine).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "guile/guile.h"

/* The folder or file that the environment names, else the installed one.  */
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
manual_file (void)
{
  return folder ("BIGHT_MANUAL", BIGHT_INFO_DIR "/bight.info");
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
    { "%manual-file", 0, 0, (scm_t_subr)manual_file,
      "Return the manual as an Info file; BIGHT_MANUAL overrides it." },
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
  bt__define_shapes ();
  bt__define_geo ();
  bt__define_dives ();
  bt__define_operations ();
  bt__define_times ();
  bt__define_quantities ();
  bt__define_live ();
  bt__define_questions ();
  bt__define_types ();
  bt__define_views ();
  bt__define_contacts ();
  bt__define_aware ();
  bt__define_outlines ();
  bt__define_instruments ();
  bt__define_patience ();
}
