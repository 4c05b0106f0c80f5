/* The line being edited in GNU readline, drawn in colours over several rows, and a list of
   completions with their meanings.

   Guile's own module (ice-9 readline) reads the lines and calls a completer with the word alone.
   The procedures here tell the completer of the whole line.  Completions to be listed go to a
   procedure of Scheme, and the text it returns is shown instead.

   A form may have several lines in one buffer of readline.  Readline itself would show the ends of
   lines as ^J; therefore the rows on the screen come from a procedure of Scheme, the painter, and
   this file moves the terminal's cursor among the rows.  A second procedure decides about Enter and
   Tab in the middle of a form.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>
#include <wchar.h>

#include <readline/readline.h>

#include <readline/history.h>

#include "guile/guile.h"

static SCM lister = SCM_BOOL_F;  /* a procedure of a list of strings that returns a string */
static SCM painter = SCM_BOOL_F; /* of prompt, text before and behind the cursor, rows, columns */
static SCM presser = SCM_BOOL_F; /* of a key and the texts: the new text before the cursor, or #f */

/* ---- The screen ---- */

static struct
{
  int rows, at; /* rows drawn, 0 for none, and the row of the cursor among them */
} drawn;

/* Leave what was drawn: the cursor goes to the beginning of the last row.  */
static void
leave_drawing (void)
{
  int below = drawn.rows - 1 - drawn.at;
  if (below > 0)
    fprintf (rl_outstream, "\033[%dB", below);
  if (drawn.rows > 0)
    fputc ('\r', rl_outstream);
  drawn.rows = drawn.at = 0;
}

static SCM
text_before (void)
{
  return scm_from_locale_stringn (rl_line_buffer, (size_t)rl_point);
}

static SCM
text_behind (void)
{
  return scm_from_locale_stringn (rl_line_buffer + rl_point, (size_t)(rl_end - rl_point));
}

/* Write the rows TEXTS over those drawn before, and put the cursor at ROW and COLUMN.  */
static void
draw_rows (SCM texts, int row, int column)
{
  if (drawn.at > 0)
    fprintf (rl_outstream, "\033[%dA", drawn.at);
  drawn.rows = 0;
  for (; scm_is_pair (texts); texts = scm_cdr (texts), drawn.rows++)
    {
      char *text = scm_to_locale_string (scm_car (texts));
      fprintf (rl_outstream, "%s\r%s\033[K", drawn.rows > 0 ? "\n" : "", text);
      free (text);
    }
  drawn.at = row;
  fputs ("\033[J\r", rl_outstream);
  if (drawn.rows - 1 > row)
    fprintf (rl_outstream, "\033[%dA", drawn.rows - 1 - row);
  if (column > 0)
    fprintf (rl_outstream, "\033[%dC", column);
  fflush (rl_outstream);
}

/* Draw the line; BEHIND is the text after the cursor, or false for a finished line.  */
static void
draw_with (SCM behind)
{
  int rows = 24, columns = 80;
  const char *prompt = rl_display_prompt ? rl_display_prompt : "";
  SCM drawing;
  rl_get_screen_size (&rows, &columns);
  drawing = scm_call_5 (painter, scm_from_locale_string (prompt), text_before (), behind,
                        scm_from_int (rows), scm_from_int (columns));
  if (scm_is_pair (drawing))
    draw_rows (scm_car (drawing), scm_to_int (scm_cadr (drawing)),
               scm_to_int (scm_caddr (drawing)));
}

static void
draw_line (void)
{
  draw_with (text_behind ());
}

/* Draw the line as one that is done, and leave the drawing.  */
static void
finish_drawing (void)
{
  int at = rl_point;
  rl_point = rl_end;
  draw_with (SCM_BOOL_F);
  rl_point = at;
  leave_drawing ();
}

/* Show TEXT below the line, and the line again below that.  */
static void
show_below (SCM text)
{
  char *shown = scm_to_locale_string (text);
  finish_drawing ();
  fprintf (rl_outstream, "\r\n%s", shown);
  free (shown);
  draw_line ();
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

/* ---- Keys ---- */

/* Ask the presser what KEY makes of the text before the cursor; return false if nothing.  */
static int
is_pressed (int key)
{
  SCM text = scm_call_3 (presser, SCM_MAKE_CHAR (key), text_before (), text_behind ());
  char *before;
  if (!scm_is_string (text))
    return 0;
  before = scm_to_locale_string (text);
  rl_begin_undo_group ();
  rl_delete_text (0, rl_point);
  rl_point = 0;
  rl_insert_text (before);
  rl_end_undo_group ();
  free (before);
  return 1;
}

static int
press_enter (int count, int key)
{
  (void)count, (void)key;
  if (is_pressed ('\n'))
    return 0;
  rl_point = rl_end;
  finish_drawing ();
  fputc ('\n', rl_outstream);
  fflush (rl_outstream);
  rl_done = 1;
  RL_SETSTATE (RL_STATE_DONE);
  return 0;
}

static int
press_tab (int count, int key)
{
  return is_pressed ('\t') ? 0 : rl_complete (count, key);
}

static int
line_start (int at)
{
  while (at > 0 && rl_line_buffer[at - 1] != '\n')
    at--;
  return at;
}

static int
line_end (int at)
{
  while (at < rl_end && rl_line_buffer[at] != '\n')
    at++;
  return at;
}

/* Put the cursor AWAY bytes behind START, the beginning of a line, or at the line's end; never
   inside a character of UTF-8.  */
static int
go_along (int start, int away)
{
  int end = line_end (start);
  rl_point = start + away < end ? start + away : end;
  while (rl_point < end && ((unsigned char)rl_line_buffer[rl_point] & 0xC0) == 0x80)
    rl_point++;
  return 0;
}

static int
press_up (int count, int key)
{
  int start = line_start (rl_point);
  return start > 0 ? go_along (line_start (start - 1), rl_point - start)
                   : rl_get_previous_history (count, key);
}

static int
press_down (int count, int key)
{
  int end = line_end (rl_point);
  return end < rl_end ? go_along (end + 1, rl_point - line_start (rl_point))
                      : rl_get_next_history (count, key);
}

static int
press_home (int count, int key)
{
  (void)count, (void)key;
  rl_point = line_start (rl_point);
  return 0;
}

static int
press_end (int count, int key)
{
  (void)count, (void)key;
  rl_point = line_end (rl_point);
  return 0;
}

/* Kill the rest of the line or, at its end, join the next line.  */
static int
press_kill (int count, int key)
{
  int end = line_end (rl_point);
  (void)count, (void)key;
  return rl_kill_text (rl_point, end > rl_point || end == rl_end ? end : end + 1);
}

static int
press_clear (int count, int key)
{
  (void)count, (void)key;
  fputs ("\033[H\033[2J", rl_outstream);
  drawn.rows = drawn.at = 0;
  draw_line ();
  return 0;
}

/* Give up the line: the next begins below.  */
static int
press_break (int count, int key)
{
  (void)count, (void)key;
  finish_drawing ();
  fputc ('\n', rl_outstream);
  rl_delete_text (0, rl_end);
  rl_point = 0;
  rl_free_undo_list ();
  draw_line ();
  return 0;
}

/* While a line is edited ^C is a key: an interruption would wait for the next one.  */
static void
prepare_terminal (int meta)
{
  struct termios settings;
  rl_prep_terminal (meta);
  if (tcgetattr (fileno (rl_instream), &settings) == 0)
    {
      settings.c_cc[VINTR] = _POSIX_VDISABLE;
      tcsetattr (fileno (rl_instream), TCSADRAIN, &settings);
    }
}

/* Guile's module binds keys by which the cursor jumps to the partner of a parenthesis, on rows
   drawn by readline.  */
static void
keep_cursor (void)
{
  static const char ends[] = ")]}";
  for (const char *c = ends; *c; c++)
    rl_bind_key_in_map (*c, rl_insert, emacs_standard_keymap);
}

/* Readline reads ~/.inputrc later, so a user's own keys prevail.  */
static void
bind_keys (void)
{
  static const struct
  {
    const char *keys;
    rl_command_func_t *press;
  } bound[] = { { "\\C-m", press_enter }, { "\\C-j", press_enter }, { "\\C-c", press_break },
                { "\\C-i", press_tab },   { "\\e[A", press_up },    { "\\eOA", press_up },
                { "\\C-p", press_up },    { "\\e[B", press_down },  { "\\eOB", press_down },
                { "\\C-n", press_down },  { "\\e[H", press_home },  { "\\eOH", press_home },
                { "\\C-a", press_home },  { "\\e[F", press_end },   { "\\eOF", press_end },
                { "\\C-e", press_end },   { "\\C-k", press_kill },  { "\\C-l", press_clear } };
  enum
  {
    IN_VI = 4 /* the first of these */
  };
  for (size_t i = 0; i < sizeof bound / sizeof *bound; i++)
    {
      rl_bind_keyseq_in_map (bound[i].keys, bound[i].press, emacs_standard_keymap);
      if (i < IN_VI)
        rl_bind_keyseq_in_map (bound[i].keys, bound[i].press, vi_insertion_keymap);
      if (i < IN_VI - 1)
        rl_bind_keyseq_in_map (bound[i].keys, bound[i].press, vi_movement_keymap);
    }
}

/* ---- Procedures ---- */

static SCM
insert_text (SCM text)
{
  char *inserted = scm_to_locale_string (text);
  rl_insert_text (inserted);
  free (inserted);
  return SCM_UNSPECIFIED;
}

static SCM
tell_below (SCM text)
{
  show_below (text);
  return SCM_UNSPECIFIED;
}

/* The stream that readline wrote to may be closed by now.  */
static SCM
forget_drawing (void)
{
  int below = drawn.rows > 0 ? drawn.rows - 1 - drawn.at : 0;
  drawn.rows = drawn.at = 0;
  return scm_from_int (below);
}

static SCM
columns_of (SCM c)
{
  int columns = wcwidth ((wchar_t)SCM_CHAR (c));
  return scm_from_int (columns < 0 ? 0 : columns);
}

/* A quote before a name is no quotation mark, completions come in the order of the completer, and a
   single Tab lists all.  In the file of the history a line with the time stands before each form: a
   form may have several lines.  */
static SCM
begin_editing (SCM list, SCM paint, SCM press)
{
  lister = scm_gc_protect_object (list);
  painter = scm_gc_protect_object (paint);
  presser = scm_gc_protect_object (press);
  rl_basic_quote_characters = "\"";
  rl_sort_completion_matches = 0;
  rl_completion_display_matches_hook = list_matches;
  rl_redisplay_function = draw_line;
  rl_prep_term_function = prepare_terminal;
  rl_variable_bind ("show-all-if-ambiguous", "on");
  history_comment_char = '#';
  history_write_timestamps = 1;
  keep_cursor ();
  bind_keys ();
  return SCM_UNSPECIFIED;
}

void bight_prompt_init (void);

__attribute__ ((visibility ("default"))) void
bight_prompt_init (void)
{
  static const bt__procedure table[] = {
    { "%begin-editing", 3, 0, (scm_t_subr)begin_editing,
      "Set readline up; LIST returns the text that is shown for a list of completions, PAINT the "
      "rows, and the cursor's row and column, that show a prompt and the text before and behind "
      "the cursor on so many rows and columns, PRESS what Enter or Tab, a character, makes of the "
      "text before the cursor, or #f." },
    { "%line-before-cursor", 0, 0, (scm_t_subr)text_before,
      "Return the part of the line that is before the cursor." },
    { "%insert-text", 1, 0, (scm_t_subr)insert_text, "Put TEXT into the line at the cursor." },
    { "%tell-below", 1, 0, (scm_t_subr)tell_below,
      "Show TEXT below the line, then the line again." },
    { "%forget-drawing", 0, 0, (scm_t_subr)forget_drawing,
      "Forget what was drawn, and return how many rows of that are below the cursor." },
    { "%columns-of", 1, 0, (scm_t_subr)columns_of,
      "Return how many columns of a terminal the character C takes." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
