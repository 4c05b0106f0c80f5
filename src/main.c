/* The program: find the Scheme modules, boot Guile, hand over to (bight cli).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <langinfo.h>
#if defined __GLIBC__
#include <malloc.h>
#endif
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <libguile.h>

/* Follow the user's locale, but print any letter even where none is set, and read and write numbers
   with a point everywhere.  */
static void
choose_locale (void)
{
  setlocale (LC_ALL, "");
  if (strcmp (nl_langinfo (CODESET), "ANSI_X3.4-1968") == 0)
    setlocale (LC_CTYPE, "C.UTF-8");
  setlocale (LC_NUMERIC, "C");
}

/* Return true if DIR is the first folder of the search path PATH.  */
static int
is_first (const char *path, const char *dir)
{
  size_t n = strlen (dir);
  return strncmp (path, dir, n) == 0 && (path[n] == ':' || path[n] == '\0');
}

/* Put DIR before the folders of the search path in the environment variable NAME.  */
static void
prepend_path (const char *name, const char *dir)
{
  const char *old = getenv (name);
  if (!old || !*old)
    {
      setenv (name, dir, 1);
      return;
    }
  if (is_first (old, dir))
    return;
  size_t size = strlen (dir) + 1 + strlen (old) + 1;
  char *path = malloc (size);
  if (!path)
    return; /* Guile will say what it does not find.  */
  snprintf (path, size, "%s:%s", dir, old);
  setenv (name, path, 1);
  free (path);
}

/* Let Guile find the installed modules.  ./pre-inst-env has named those of the build tree.  */
static void
find_modules (void)
{
  if (getenv ("BIGHT_UNINSTALLED"))
    return;
  prepend_path ("GUILE_LOAD_PATH", BIGHT_MODULE_DIR);
  prepend_path ("GUILE_LOAD_COMPILED_PATH", BIGHT_CCACHE_DIR);
  prepend_path ("GUILE_EXTENSIONS_PATH", BIGHT_EXTENSION_DIR);
}

/* The command line, in the locale that was chosen: Guile reads it in the user's own.  */
static SCM
arguments (int argc, char **argv)
{
  SCM list = SCM_EOL;
  for (int i = argc - 1; i >= 0; i--)
    list = scm_cons (scm_from_stringn (argv[i], (size_t)-1, nl_langinfo (CODESET),
                                       SCM_FAILED_CONVERSION_QUESTION_MARK),
                     list);
  return list;
}

/* Call (main ARGUMENTS) of (bight cli), as a Guile script is called.  It ends with `exit' or
   returns the exit status.  */
static void
run (void *unused, int argc, char **argv)
{
  (void)unused;
  scm_set_program_arguments_scm (arguments (argc, argv));
  /* No second thread in the house: the binding frees what was dropped, between steps.  */
  scm_set_automatic_finalization_enabled (0);
  SCM status = scm_call_1 (scm_c_public_ref ("bight cli", "main"), scm_program_arguments ());
  scm_flush_all_ports ();
  exit (scm_is_signed_integer (status, 0, 255) ? scm_to_int (status) : EXIT_SUCCESS);
}

/* The collector's work goes by what lives, 7 MB of modules and the language: with room to fill it
   works seldom.  Forks of a dive come and go, a megabyte each: memory given back is kept, else the
   kernel clears each page of each fork anew.  */
static void
make_way_for_forks (void)
{
  setenv ("GC_INITIAL_HEAP_SIZE", "33554432", 0);
#if defined __GLIBC__
  mallopt (M_MMAP_THRESHOLD, 1 << 25);
  mallopt (M_TRIM_THRESHOLD, 1 << 26);
#endif
}

int
main (int argc, char **argv)
{
  choose_locale ();
  find_modules ();
  make_way_for_forks ();
  setenv ("GUILE_AUTO_COMPILE", "0",
          0); /* A world is a small script: compiling it gains nothing.  */
  scm_boot_guile (argc, argv, run, NULL);
}
