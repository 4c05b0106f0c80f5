/* Time as a value: the journal of operations, tracks, and states as text.

   The journal of a dive is a list of every operation with its numbers, kept on the Scheme side of
   the handle; replaying an operation by name and numbers (redo) takes the same way as the first
   call.  A serial number counts the operations, so that recordings can be joined.  States pass
   between bytevectors and text without loss: base 64, with runs of zeros as a count between stars.
   Checksums are the engine's hash.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"

/* ---- The journal ---- */

static SCM
journal (SCM object)
{
  return bt__to_handle (object)->journal;
}

static SCM
set_journal (SCM object, SCM list)
{
  bt__to_handle (object)->journal = list;
  return SCM_UNSPECIFIED;
}

static SCM
serial (SCM object)
{
  return scm_from_int64 (bt__to_handle (object)->serial);
}

static SCM
raise_serial (SCM object, SCM least)
{
  bt__handle *handle = bt__to_handle (object);
  int64_t n = scm_to_int64 (least);
  if (handle->serial < n)
    handle->serial = n;
  return SCM_UNSPECIFIED;
}

/* Any operation by its name, with the numbers it was recorded with.  */
static SCM
redo (SCM object, SCM name, SCM subject, SCM args)
{
  static const char *const who = "replay";
  bt_error unknown = { BT_ERR_NAME, "there is no such operation" };
  SCM_ASSERT_TYPE (scm_is_true (scm_f64vector_p (args)), args, SCM_ARG4, who, "f64vector");
  size_t n = scm_c_array_length (args);
  const double *numbers = (const double *)SCM_BYTEVECTOR_CONTENTS (args);
  char *wanted = scm_to_utf8_string (scm_symbol_to_string (name));
  int op = 0;
  while (op < BT_OP_COUNT && strcmp (bt_op_describe ((bt_op)op)->name, wanted) != 0)
    op++;
  free (wanted);
  if (op == BT_OP_COUNT)
    bt__raise (who, &unknown);
  bt__to_idle_dive (who, object);
  bt__operate (who, bt__to_handle (object), (bt_op)op, scm_to_int (subject), numbers, (int)n);
  scm_remember_upto_here_2 (object, args);
  return SCM_UNSPECIFIED;
}

/* (NAME . PART): the table of operations, PART a symbol or #f.  */
static SCM
operations (void)
{
  static const char *const parts[] = { NULL, "rov", "tether", NULL };
  SCM list = SCM_EOL;
  for (int op = BT_OP_COUNT; op-- > 0;)
    {
      const bt_op_info *info = bt_op_describe ((bt_op)op);
      const char *part = parts[info->subject];
      list = scm_acons (scm_from_utf8_symbol (info->name),
                        part ? scm_from_utf8_symbol (part) : SCM_BOOL_F, list);
    }
  return list;
}

/* ---- Tracks ---- */

static SCM
tracks (SCM object)
{
  bt_dive *dive = bt__to_dive (object);
  const double *rows;
  SCM list = SCM_EOL;
  for (int i = 0, n; (n = bt_dive_track (dive, i, &rows)) > 0; i++)
    {
      SCM numbers = scm_make_f64vector (scm_from_int (n), scm_from_double (0));
      memcpy (SCM_BYTEVECTOR_CONTENTS (numbers), rows, sizeof *rows * (size_t)n);
      list = scm_cons (numbers, list);
    }
  return scm_reverse_x (list, SCM_EOL);
}

static SCM
add_track (SCM object, SCM rows)
{
  bt_error error;
  int index;
  SCM_ASSERT_TYPE (scm_is_true (scm_f64vector_p (rows)), rows, SCM_ARG2, "load-dive", "f64vector");
  bt__check ("load-dive",
             bt_dive_add_track (bt__to_idle_dive ("load-dive", object),
                                (const double *)SCM_BYTEVECTOR_CONTENTS (rows),
                                (int)scm_c_array_length (rows), &index, &error),
             &error);
  return SCM_UNSPECIFIED;
}

static SCM
asks (SCM object)
{
  return scm_from_bool (bt_dive_asks (bt__to_dive (object)));
}

/* ---- Bytes ---- */

void
bt__hexadecimal (char *text, uint64_t x, int digits)
{
  for (int i = digits; i-- > 0; x >>= 4)
    text[i] = "0123456789abcdef"[x & 15];
}

/* The first COUNT numbers of the u32vector NUMBERS, eight digits each.  */
static SCM
eight_digits (SCM numbers, SCM count)
{
  size_t n = scm_to_size_t (count);
  SCM_ASSERT_TYPE (SCM_BYTEVECTOR_P (numbers) && SCM_BYTEVECTOR_LENGTH (numbers) / 4 >= n, numbers,
                   SCM_ARG1, "record!", "as many numbers");
  const uint32_t *x = (const uint32_t *)(const void *)SCM_BYTEVECTOR_CONTENTS (numbers);
  char *text = scm_gc_malloc_pointerless (8 * n + 1, "digits");
  for (size_t i = 0; i < n; i++)
    bt__hexadecimal (text + 8 * i, x[i], 8);
  scm_remember_upto_here_1 (numbers);
  return scm_from_latin1_stringn (text, 8 * n);
}

/* FNV-1a, 64 bits, but 0 for nothing: the sum of what follows continues from that of what went
   before.  */
static SCM
checksum (SCM bytes, SCM seed)
{
  const uint64_t basis = 0xcbf29ce484222325ULL;
  const unsigned char *p = (const unsigned char *)SCM_BYTEVECTOR_CONTENTS (bytes);
  uint64_t h = scm_to_uint64 (seed) ^ basis;
  for (size_t i = 0, n = SCM_BYTEVECTOR_LENGTH (bytes); i < n; i++)
    h = (h ^ p[i]) * 0x100000001b3ULL;
  scm_remember_upto_here_1 (bytes);
  return scm_from_uint64 (h ^ basis);
}

/* Base 64, but a run of zero bytes in threes, of which states are full, is written *COUNT*.  */

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

enum
{
  RUN_LEAST = 8, /* triples */
  RUN_TEXT = 24  /* room for one that is written as a run */
};

static size_t
zero_triples (const unsigned char *p, size_t n)
{
  size_t i = 0;
  while (3 * i + 3 <= n && !p[3 * i] && !p[3 * i + 1] && !p[3 * i + 2])
    i++;
  return i;
}

static char *
write_triple (char *out, const unsigned char *p, size_t n)
{
  unsigned long word = (unsigned long)p[0] << 16;
  word |= n > 1 ? (unsigned long)p[1] << 8 : 0;
  word |= n > 2 ? p[2] : 0;
  for (int k = 0; k < 4; k++)
    *out++ = (size_t)k <= n ? digits[word >> (18 - 6 * k) & 63] : '=';
  return out;
}

static SCM
bytes_to_text (SCM bytes)
{
  const unsigned char *p = (const unsigned char *)SCM_BYTEVECTOR_CONTENTS (bytes);
  size_t n = SCM_BYTEVECTOR_LENGTH (bytes), i = 0;
  char *text = scm_gc_malloc_pointerless (n / 3 * 4 + 4 + RUN_TEXT, "text");
  char *out = text;
  while (i < n)
    {
      size_t zeros = zero_triples (p + i, n - i);
      if (zeros >= RUN_LEAST)
        {
          out += sprintf (out, "*%zu*", zeros);
          i += 3 * zeros;
          continue;
        }
      out = write_triple (out, p + i, n - i);
      i += n - i < 3 ? n - i : 3;
    }
  scm_remember_upto_here_1 (bytes);
  return scm_from_latin1_stringn (text, (size_t)(out - text));
}

static int
digit_value (char c)
{
  const char *place = c ? strchr (digits, c) : NULL;
  return place ? (int)(place - digits) : -1;
}

/* Read four digits at TEXT into at most three bytes; return how many, or -1.  */
static int
read_triple (const char *text, unsigned char *out)
{
  unsigned long word = 0;
  int n = text[2] == '=' ? 1 : text[3] == '=' ? 2 : 3;
  for (int k = 0; k < 4; k++)
    {
      int value = k <= n ? digit_value (text[k]) : text[k] == '=' ? 0 : -1;
      if (value < 0)
        return -1;
      word = word << 6 | (unsigned long)value;
    }
  for (int k = 0; k < n; k++)
    out[k] = (unsigned char)(word >> (16 - 8 * k) & 255);
  return n;
}

/* Read TEXT of LENGTH into OUT, which has room for SIZE bytes; return true if it fills it.  */
static int
read_text (const char *text, size_t length, unsigned char *out, size_t size)
{
  const char *end = text + length;
  size_t at = 0;
  while (text < end)
    {
      unsigned char triple[3];
      int n;
      if (*text == '*')
        {
          char *after;
          unsigned long long zeros = strtoull (text + 1, &after, 10);
          if (after >= end || *after != '*' || zeros > (size - at) / 3)
            return 0;
          memset (out + at, 0, 3 * (size_t)zeros);
          at += 3 * (size_t)zeros;
          text = after + 1;
          continue;
        }
      n = end - text >= 4 ? read_triple (text, triple) : -1;
      if (n < 0 || (size_t)n > size - at)
        return 0;
      memcpy (out + at, triple, (size_t)n);
      at += (size_t)n;
      text += 4;
    }
  return at == size;
}

static SCM
text_to_bytes (SCM string, SCM length)
{
  size_t size = scm_to_size_t (length);
  char *text;
  SCM bytes;
  int whole;
  scm_dynwind_begin (0);
  text = scm_to_utf8_string (string);
  scm_dynwind_free (text);
  bytes = scm_c_make_bytevector (size);
  whole = read_text (text, strlen (text), (unsigned char *)SCM_BYTEVECTOR_CONTENTS (bytes), size);
  scm_dynwind_end ();
  return whole ? bytes : SCM_BOOL_F;
}

void
bt__define_times (void)
{
  static const bt__procedure table[] = {
    { "%journal", 1, 0, (scm_t_subr)journal,
      "Return what was done to DIVE, the last first: vectors #(serial step operation subject "
      "numbers)." },
    { "%set-journal!", 2, 0, (scm_t_subr)set_journal, "Let LIST be the journal of DIVE." },
    { "%serial", 1, 0, (scm_t_subr)serial,
      "Return the number of the last operation that was done to DIVE." },
    { "%raise-serial!", 2, 0, (scm_t_subr)raise_serial,
      "Let later operations on DIVE have numbers above LEAST." },
    { "%redo!", 4, 0, (scm_t_subr)redo,
      "Do the operation NAME on the SUBJECT-th part of its kind in DIVE with the numbers ARGS." },
    { "%operations", 0, 0, (scm_t_subr)operations,
      "Return the table of operations, an alist from name to the kind of part it is about, or "
      "#f." },
    { "%tracks", 1, 0, (scm_t_subr)tracks, "Return the tracks of DIVE, a list of f64vectors." },
    { "%add-track!", 2, 0, (scm_t_subr)add_track,
      "Add ROWS, an f64vector, to the tracks of DIVE." },
    { "%asks?", 1, 0, (scm_t_subr)asks,
      "Return #t if the current of DIVE is now a procedure's answer." },
    { "%eight-digits", 2, 0, (scm_t_subr)eight_digits,
      "Return the first COUNT numbers of the u32vector NUMBERS, eight hexadecimal digits each." },
    { "%checksum", 2, 0, (scm_t_subr)checksum,
      "Return the 64-bit checksum of BYTES, continued from SEED, 0 at first." },
    { "%bytes->text", 1, 0, (scm_t_subr)bytes_to_text, "Return BYTES as text." },
    { "%text->bytes", 2, 0, (scm_t_subr)text_to_bytes,
      "Return the SIZE bytes that TEXT stands for, or #f." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
