/* The way out to a terminal: a port through which text of whatever origin can be written.

   A terminal obeys some characters instead of showing them: they move its cursor, name its window,
   fill its clipboard.  Names, sentences and error messages may hold these characters, copied from a
   file.  An outlet writes text to another port with every obeyed character escaped, \x1b or \u202e;
   line feed, tabulator and the carriage return before a line feed pass.  What is meant for the
   terminal to obey is written to the port behind the outlet.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/letter.h"
#include "guile/guile.h"

enum
{
  LONGEST = 6, /* bytes that one byte becomes at most, as in \u202e of three */
  HELD = 4     /* bytes of a letter that is not whole yet, or a carriage return */
};

typedef struct outlet
{
  SCM behind;
  unsigned char held[HELD];
  size_t n;
} outlet;

static scm_t_port_type *outlet_type;

/* ---- Letters ---- */

/* Decode the LETTER at TEXT, of N bytes, and return the number of bytes taken; 0 for the beginning
   of a letter; -1 for a byte outside UTF-8.  */
static int
decode (const unsigned char *text, size_t n, uint32_t *letter)
{
  static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
  unsigned char lead = text[0];
  int size = lead < 0x80 ? 1 : lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : lead >> 3 == 30 ? 4 : -1;
  if (size < 0)
    return -1;
  *letter = size == 1 ? lead : lead & (0x7fU >> size);
  for (int i = 1; i < size; i++)
    {
      if ((size_t)i == n)
        return 0;
      if (text[i] >> 6 != 2)
        return -1;
      *letter = *letter << 6 | (text[i] & 0x3fU);
    }
  return *letter >= least[size] && *letter <= 0x10ffff && *letter >> 11 != 27 ? size : -1;
}

/* Write the SIZE bytes at TEXT, the letter U or a stray byte, to OUT as they may be shown; return
   how many that are.  */
static size_t
show (const unsigned char *text, size_t size, int stray, uint32_t u, char *out)
{
  if (!stray && (u == '\n' || u == '\t' || !bt__is_control (u)))
    {
      memcpy (out, text, size);
      return size;
    }
  return (size_t)sprintf (out, stray || u < 0x100 ? "\\x%02x" : "\\u%04x",
                          stray ? text[0] : (unsigned)u);
}

/* Write the text of N bytes to OUT, with room for LONGEST bytes each, in a form safe to show. *LEFT
   receives the number of last bytes not judged yet.  */
static size_t
show_all (const unsigned char *text, size_t n, char *out, size_t *left)
{
  size_t at = 0, written = 0;
  while (at < n)
    {
      uint32_t u = 0;
      int size = decode (text + at, n - at, &u);
      if (size == 0 || (u == '\r' && size == 1 && at + 1 == n))
        break;
      if (u == '\r' && size == 1 && text[at + 1] == '\n')
        out[written++] = '\r';
      else
        written += show (text + at, size < 0 ? 1 : (size_t)size, size < 0, u, out + written);
      at += size < 0 ? 1 : (size_t)size;
    }
  *left = n - at;
  return written;
}

/* ---- The port ---- */

static outlet *
outlet_of (SCM port)
{
  return (outlet *)SCM_STREAM (port);
}

static int
is_outlet (SCM port)
{
  return SCM_PORTP (port) && SCM_PORT_TYPE (port) == outlet_type;
}

static void
put (SCM port, const char *text, size_t n)
{
  if (n == 0)
    return;
  if (scm_is_true (scm_equal_p (scm_port_encoding (port), scm_from_utf8_string ("UTF-8"))))
    scm_c_write (port, text, n);
  else
    scm_display (scm_from_utf8_stringn (text, n), port);
}

static size_t
write_outlet (SCM port, SCM source, size_t start, size_t count)
{
  outlet *o = outlet_of (port);
  size_t n = o->n + count, left;
  unsigned char *text;
  char *out;
  if (!SCM_OPOUTPORTP (o->behind))
    return count; /* it was closed: nobody reads this any more */
  text = scm_gc_malloc_pointerless (n, "outlet");
  out = scm_gc_malloc_pointerless (LONGEST * n, "outlet");
  memcpy (text, o->held, o->n);
  memcpy (text + o->n, SCM_BYTEVECTOR_CONTENTS (source) + start, count);
  n = show_all (text, n, out, &left);
  put (o->behind, out, n);
  memcpy (o->held, text + (o->n + count - left), left);
  o->n = left;
  scm_force_output (o->behind);
  return count;
}

static SCM
make_outlet (SCM behind)
{
  outlet *o;
  if (!SCM_OPOUTPORTP (behind))
    scm_wrong_type_arg_msg ("%outlet", 1, behind, "port to write to");
  o = scm_gc_malloc (sizeof *o, "outlet");
  o->behind = behind;
  o->n = 0;
  return scm_c_make_port_with_encoding (outlet_type, SCM_OPN | SCM_WRTNG,
                                        scm_from_utf8_symbol ("UTF-8"),
                                        scm_from_utf8_symbol ("substitute"), (scm_t_bits)o);
}

static SCM
port_behind (SCM port)
{
  while (is_outlet (port))
    port = outlet_of (port)->behind;
  return port;
}

static SCM
shown (SCM string)
{
  size_t n, left;
  char *text = scm_to_utf8_stringn (string, &n);
  char *out = scm_gc_malloc_pointerless (LONGEST * n + LONGEST, "shown");
  size_t written = show_all ((unsigned char *)text, n, out, &left);
  if (left) /* a carriage return at the end */
    written += show ((unsigned char *)"\r", 1, 0, '\r', out + written);
  free (text);
  return scm_from_utf8_stringn (out, written);
}

void bight_outlet_init (void);

__attribute__ ((visibility ("default"))) void
bight_outlet_init (void)
{
  static const bt__procedure table[] = {
    { "%outlet", 1, 0, (scm_t_subr)make_outlet,
      "Return a port whose text goes to PORT with what a terminal would obey escaped." },
    { "%behind", 1, 0, (scm_t_subr)port_behind,
      "Return the port that the outlet PORT writes to; any other port itself." },
    { "%shown", 1, 0, (scm_t_subr)shown, "Return STRING as an outlet writes it." },
  };
  outlet_type = scm_make_port_type ((char *)"outlet", NULL, write_outlet);
  scm_set_port_needs_close_on_gc (outlet_type, 1); /* so that it is flushed at the end */
  bt__define_procedures (table, sizeof table / sizeof *table);
}
