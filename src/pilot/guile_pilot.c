/* The extension for flying in a terminal: fills the module (bight cockpit cells).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"
#include "pilot/screen.h"
#include "pilot/terminal.h"

static const char *const who = "pilot!";

/* ---- The terminal.  What may wait lets Guile's other threads go on. ---- */

static SCM
enter (void)
{
  bt_error error;
  bt__check (who, bt__terminal_enter (&error), &error);
  return SCM_UNSPECIFIED;
}

static SCM
leave (void)
{
  bt__terminal_leave ();
  return SCM_UNSPECIFIED;
}

static SCM
size (void)
{
  int columns, rows;
  bt__terminal_size (&columns, &rows);
  return scm_cons (scm_from_int (columns), scm_from_int (rows));
}

typedef struct transfer
{
  double seconds;
  char in[4096];
  const char *out;
  size_t n;
  int result;
} transfer;

static void *
read_keys (void *data)
{
  transfer *t = data;
  t->result = bt__terminal_keys (t->seconds, t->in, sizeof t->in);
  return NULL;
}

static void *
write_bytes (void *data)
{
  transfer *t = data;
  t->result = bt__terminal_write (t->out, t->n);
  return NULL;
}

static SCM
keys (SCM seconds)
{
  transfer t = { .seconds = scm_to_double (seconds) };
  SCM list = SCM_EOL;
  scm_without_guile (read_keys, &t);
  if (t.result < 0)
    return SCM_BOOL_F;
  for (int i = t.result; i-- > 0;)
    list = scm_cons (scm_from_uint8 ((unsigned char)t.in[i]), list);
  return list;
}

/* ---- Screens ---- */

static void
free_screen (void *screen)
{
  bt__screen_free (screen);
}

static SCM
make_screen (SCM columns, SCM rows, SCM palette, SCM ascii)
{
  bt__screen *screen = NULL;
  bt_error error;
  int i = 0;
  while (bt__palette_name ((bt__palette)i)
         && !scm_is_eq (palette, scm_from_utf8_symbol (bt__palette_name ((bt__palette)i))))
    i++;
  SCM_ASSERT (i < BT__PALETTES, palette, SCM_ARG3, "%make-screen");
  bt__check (who,
             bt__screen_new (scm_to_int (columns), scm_to_int (rows), (bt__palette)i,
                             !SCM_UNBNDP (ascii) && scm_is_true (ascii), &screen, &error),
             &error);
  return scm_from_pointer (screen, free_screen);
}

static SCM
clear (SCM screen)
{
  bt__screen_clear (scm_to_pointer (screen));
  return SCM_UNSPECIFIED;
}

static SCM
picture (SCM object, SCM pixels)
{
  bt__screen *screen = scm_to_pointer (object);
  size_t n = (size_t)bt__screen_columns (screen) * (size_t)bt__screen_rows (screen) * 2;
  SCM_ASSERT (scm_is_bytevector (pixels) && SCM_BYTEVECTOR_LENGTH (pixels) == 4 * n, pixels,
              SCM_ARG2, "%screen-picture!");
  bt__screen_picture (screen, (const uint32_t *)(const void *)SCM_BYTEVECTOR_CONTENTS (pixels));
  scm_remember_upto_here_2 (object, pixels);
  return SCM_UNSPECIFIED;
}

static SCM
text (SCM screen, SCM column, SCM row, SCM string, SCM ink, SCM paper)
{
  size_t n;
  char *bytes = scm_to_utf8_stringn (string, &n);
  bt__screen_text (scm_to_pointer (screen), scm_to_int (column), scm_to_int (row), bytes, n,
                   scm_to_int32 (ink), scm_is_true (paper) ? scm_to_int32 (paper) : BT__DIMMED);
  free (bytes);
  return SCM_UNSPECIFIED;
}

static SCM
write_screen (SCM screen, SCM all)
{
  transfer t = { .result = 1 };
  int cells;
  t.n = bt__screen_changes (scm_to_pointer (screen), scm_is_true (all), &t.out, &cells);
  scm_without_guile (write_bytes, &t);
  scm_remember_upto_here_1 (screen);
  return t.result ? scm_cons (scm_from_int (cells), scm_from_size_t (t.n)) : SCM_BOOL_F;
}

static SCM
screen_bytes (SCM screen, SCM all)
{
  const char *bytes;
  size_t n = bt__screen_changes (scm_to_pointer (screen), scm_is_true (all), &bytes, NULL);
  SCM string = scm_from_utf8_stringn (bytes, n);
  scm_remember_upto_here_1 (screen);
  return string;
}

void bight_pilot_init (void);

__attribute__ ((visibility ("default"))) void
bight_pilot_init (void)
{
  static const bt__procedure table[] = {
    { "%terminal-enter!", 0, 0, (scm_t_subr)enter,
      "Take the terminal: raw keys, the other page, no cursor." },
    { "%terminal-leave!", 0, 0, (scm_t_subr)leave, "Put the terminal back as it was." },
    { "%screen-size", 0, 0, (scm_t_subr)size,
      "Return the columns and rows of the terminal, a pair." },
    { "%terminal-keys", 1, 0, (scm_t_subr)keys,
      "Return the bytes that came within SECONDS, a list, or #f when the terminal is gone." },
    { "%make-screen", 3, 1, (scm_t_subr)make_screen,
      "Return a blank screen of COLUMNS and ROWS in PALETTE: none, few, many or true; with ASCII "
      "true "
      "nothing else is written to it." },
    { "%screen-clear!", 1, 0, (scm_t_subr)clear, "Blank SCREEN." },
    { "%screen-picture!", 2, 0, (scm_t_subr)picture,
      "Fill SCREEN with PIXELS, a bytevector, two to a cell." },
    { "%screen-text!", 6, 0, (scm_t_subr)text,
      "Put STRING on SCREEN at COLUMN and ROW in the colour INK on PAPER, or #f: what is there, "
      "dimmed." },
    { "%screen-write!", 2, 0, (scm_t_subr)write_screen,
      "Write what changed of SCREEN, or ALL, to the terminal.  Return (CELLS . BYTES), or #f when "
      "the terminal is gone." },
    { "%screen-bytes", 2, 0, (scm_t_subr)screen_bytes,
      "Return what %screen-write! would write, as a string." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
