/* The line being edited in GNU readline, and a list of completions with their meanings.

   Guile's own module (ice-9 readline) reads the lines and calls a completer with the word alone.
   The procedures here tell that completer of the whole line, put text into it, and hand the
   completions that are to be listed to a procedure of Scheme, which returns the text to be shown
   instead.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdio.h>
#include <stdlib.h>

#include <readline/readline.h>

#include "guile/guile.h"

static SCM lister = SCM_BOOL_F; /* a procedure of a list of strings that returns a string */

/* Show TEXT below the line, and the line again below that.  */
static void
show_below (SCM text)
{
  char *shown = scm_to_locale_string (text);
  rl_crlf ();
  fputs (shown, rl_outstream);
  free (shown);
  rl_forced_update_display ();
}

/* Show what the lister makes of the N completions from MATCHES[1] on.  */
static void
list_matches (char **matches, int n, int longest)
{
  (void)longest;
  SCM words = SCM_EOL;
  for (int i = n; i > 0; i--)
    words = scm_cons (scm_from_locale_string (matches[i]), words);
  SCM text = scm_call_1 (lister, words);
  if (scm_is_string (text))
    show_below (text);
}

static SCM
line_before_cursor (void)
{
  return scm_from_locale_stringn (rl_line_buffer, (size_t)rl_point);
}

static SCM
insert_text (SCM text)
{
  char *inserted = scm_to_locale_string (text);
  rl_insert_text (inserted);
  free (inserted);
  rl_redisplay ();
  return SCM_UNSPECIFIED;
}

static SCM
tell_below (SCM text)
{
  show_below (text);
  return SCM_UNSPECIFIED;
}

/* A quote before a name is no quotation mark, completions come in the order of the completer, and a
   single Tab lists all.  */
static SCM
begin_editing (SCM procedure)
{
  lister = scm_gc_protect_object (procedure);
  rl_basic_quote_characters = "\"";
  rl_sort_completion_matches = 0;
  rl_completion_display_matches_hook = list_matches;
  rl_variable_bind ("show-all-if-ambiguous", "on");
  return SCM_UNSPECIFIED;
}

void bight_prompt_init (void);

__attribute__ ((visibility ("default"))) void
bight_prompt_init (void)
{
  static const bt__procedure table[] = {
    { "%begin-editing", 1, 0, (scm_t_subr)begin_editing,
      "Set readline up; PROCEDURE returns the text that is shown for a list of completions." },
    { "%line-before-cursor", 0, 0, (scm_t_subr)line_before_cursor,
      "Return the part of the line that is before the cursor." },
    { "%insert-text", 1, 0, (scm_t_subr)insert_text, "Put TEXT into the line at the cursor." },
    { "%tell-below", 1, 0, (scm_t_subr)tell_below,
      "Show TEXT below the line, then the line again." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
