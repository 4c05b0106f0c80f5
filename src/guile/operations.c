/* Operations: what changes a dive.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"

static bt_op
to_op (const char *name)
{
  for (int op = 0; op < BT_OP_COUNT; op++)
    if (strcmp (bt_op_describe ((bt_op)op)->name, name) == 0)
      return (bt_op)op;
  return BT_OP_COUNT;
}

/* The name of the SYMBOL in BUFFER, cut at its N bytes.  */
static void
symbol_name (SCM symbol, char *buffer, size_t n)
{
  size_t length = scm_to_locale_stringbuf (scm_symbol_to_string (symbol), buffer, n - 1);
  buffer[length < n - 1 ? length : n - 1] = 0;
}

/* The operation that a verb, such as drive!, stands for.  */
static bt_op
op_of_verb (SCM verb)
{
  char name[64];
  symbol_name (verb, name, sizeof name);
  name[strcspn (name, "!")] = 0;
  return to_op (name);
}

/* What was done, as `%journal' has it.  */
static SCM
journal_entry (int64_t serial, int64_t step, bt_op op, int subject, const double *args, int n)
{
  SCM numbers = scm_make_f64vector (scm_from_int (n), scm_from_double (0));
  SCM entry = scm_c_make_vector (5, SCM_BOOL_F);
  if (n > 0)
    memcpy (SCM_BYTEVECTOR_CONTENTS (numbers), args, sizeof *args * (size_t)n);
  scm_c_vector_set_x (entry, 0, scm_from_int64 (serial));
  scm_c_vector_set_x (entry, 1, scm_from_int64 (step));
  scm_c_vector_set_x (entry, 2, scm_from_utf8_symbol (bt_op_describe (op)->name));
  scm_c_vector_set_x (entry, 3, scm_from_int (subject));
  scm_c_vector_set_x (entry, 4, numbers);
  return entry;
}

/* The thread of a live dive has its own tracks; what it publishes follows them by number.  */
static bt_status
operate_live (bt__handle *handle, bt_op op, int subject, const double *args, int n, int64_t *step,
              bt_error *error)
{
  bt_status status
      = bt_live_do_polled (handle->live, op, subject, args, n, bt__ask_guile, handle, step, error);
  int index;
  if (status == BT_OK && op == BT_OP_FOLLOW)
    status = bt_dive_add_track (handle->dive, args, n, &index, error);
  return status;
}

/* What a guest does to a dive stands in its host's journal.  */
static void
note_down (bt__handle *handle, int64_t step, bt_op op, int subject, const double *args, int n)
{
  SCM entry = journal_entry (handle->serial + 1, step, op, subject, args, n);
  bt__lock_sharing ();
  scm_c_vector_set_x (entry, 0, scm_from_int64 (++handle->serial));
  handle->journal = scm_cons (entry, handle->journal);
  bt__unlock_sharing ();
}

void
bt__operate (const char *who, bt__handle *handle, bt_op op, int subject, const double *args, int n)
{
  bt_error error;
  int64_t step = bt_dive_steps (handle->dive);
  bt_status status = handle->live ? operate_live (handle, op, subject, args, n, &step, &error)
                                  : bt_dive_do (handle->dive, op, subject, args, n, &error);
  bt__check_long (who, handle, status, &error);
  note_down (scm_is_true (handle->host) ? bt__to_handle (handle->host) : handle, step, op, subject,
             args, n);
}

static SCM
operate (SCM object, SCM verb, SCM caller, SCM subject, SCM args)
{
  char who[64];
  size_t n = scm_c_array_length (args);
  const double *numbers = (const double *)SCM_BYTEVECTOR_CONTENTS (args);
  symbol_name (caller, who, sizeof who);
  bt__to_idle_dive (who, object);
  bt__operate (who, bt__to_handle (object), op_of_verb (verb), scm_to_int (subject), numbers,
               (int)n);
  scm_remember_upto_here_2 (object, args);
  return SCM_UNSPECIFIED;
}

/* A change of the procedure of a dive's current, taken back unless completed: the first call of the
   new procedure may leave by an exception.  */
typedef struct change
{
  bt__handle *handle;
  SCM before;
  int complete;
} change;

static void
ask_function (bt__handle *handle, SCM function)
{
  int asks = scm_is_true (scm_procedure_p (function));
  handle->function = function;
  bt_dive_set_current_function (handle->dive, asks ? bt__call_current : NULL, handle);
}

static void
take_back (void *data)
{
  change *c = data;
  if (!c->complete)
    ask_function (c->handle, c->before);
}

/* A procedure is asked before it is believed.  */
static void
ask_once (bt__handle *handle, const bt_current *current)
{
  bt_vec3 v;
  if (current->kind == BT_CURRENT_FUNCTION)
    bt__call_current (handle, (bt_vec3){ 0, 0, 0 }, bt_dive_time (handle->dive), &v);
}

static SCM
set_current (SCM object, SCM list)
{
  static const char *const who = "current!";
  bt__handle *handle = bt__to_handle (object);
  change c = { handle, handle->function, 0 };
  SCM function = c.before;
  bt_current current = bt__to_current (who, list, &function);
  double args[BT_CURRENT_ARGS];
  bt_error error;
  bt_error live = { BT_ERR_UNSUPPORTED, "the current of a live dive cannot be a procedure: the "
                                        "thread that steps it never enters Scheme" };
  bt__to_idle_dive (who, object);
  bt__check (who, bt_current_check (&current, &error), &error);
  if (handle->live && current.kind == BT_CURRENT_FUNCTION)
    bt__raise (who, &live);
  scm_dynwind_begin (0);
  scm_dynwind_unwind_handler (take_back, &c, SCM_F_WIND_EXPLICITLY);
  ask_function (c.handle, function);
  ask_once (c.handle, &current);
  bt__operate (who, handle, BT_OP_CURRENT, 0, args, bt_current_pack (&current, args));
  c.complete = 1;
  scm_dynwind_end ();
  return SCM_UNSPECIFIED;
}

/* The number that VALUE, a number or a word, stands for in FIELD.  */
static double
field_value (const char *who, const bt_field *field, SCM value)
{
  union
  {
    bt_sea_def sea;
    bt_vehicle_def vehicle;
    bt_tether_def tether;
    bt_obstacle_def obstacle;
  } def;
  bt_error error;
  memset (&def, 0, sizeof def);
  bt__check (who, bt__set_field (who, field, &def, value, &error), &error);
  return *(double *)(void *)((char *)&def + field->offset);
}

static SCM
alter (SCM object, SCM part, SCM subject, SCM field_name, SCM value)
{
  static const char *const who = "alter!";
  const bt_head *head = bt__to_head (who, part);
  bt_part kind = head->obstacle >= 0 ? BT_PART_OBSTACLE : bt__to_part (who, part);
  char *name = scm_to_utf8_string (scm_symbol_to_string (field_name));
  const bt_field *field = bt_field_find (head, name);
  bt_error error = { BT_ERR_NAME, "there is no such field" };
  double args[3];
  bt__to_idle_dive (who, object);
  free (name);
  if (!field)
    bt__raise (who, &error);
  args[0] = kind;
  args[1] = (double)(field - head->fields);
  args[2] = field_value (who, field, value);
  bt__operate (who, bt__to_handle (object), BT_OP_ALTER, scm_to_int (subject), args, 3);
  return SCM_UNSPECIFIED;
}

void
bt__define_operations (void)
{
  static const bt__procedure table[] = {
    { "%operate!", 5, 0, (scm_t_subr)operate,
      "Do VERB, on behalf of CALLER, on the SUBJECT-th part of its kind in DIVE with ARGS, an "
      "f64vector." },
    { "%set-current!", 2, 0, (scm_t_subr)set_current,
      "Give DIVE the current that LIST describes." },
    { "%alter!", 5, 0, (scm_t_subr)alter,
      "Set FIELD of the SUBJECT-th PART (sea, rov, tether or obstacle, by its head) of DIVE to "
      "VALUE." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
