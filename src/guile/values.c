/* Values between Scheme and C: points, currents, fields.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"

static void fail (const char *who, bt_status status, const char *text) SCM_NORETURN;

static void
fail (const char *who, bt_status status, const char *text)
{
  bt_error error = { .status = status };
  strncpy (error.text, text, sizeof error.text - 1);
  bt__raise (who, &error);
}

/* ---- Points ---- */

SCM
bt__from_point (bt_vec3 p)
{
  SCM v = scm_make_f64vector (scm_from_int (3), SCM_INUM0);
  double *x = (double *)SCM_BYTEVECTOR_CONTENTS (v);
  x[0] = p.x + 0.0; /* no minus zero */
  x[1] = p.y + 0.0;
  x[2] = p.z + 0.0;
  return v;
}

static int
is_f64vector3 (SCM object)
{
  return scm_is_true (scm_f64vector_p (object)) && scm_c_array_length (object) == 3;
}

bt_vec3
bt__to_point (const char *who, SCM object)
{
  const double *x;
  if (!is_f64vector3 (object))
    fail (who, BT_ERR_DOMAIN, "a point is an f64vector of three numbers here");
  x = (const double *)SCM_BYTEVECTOR_CONTENTS (object);
  return (bt_vec3){ x[0], x[1], x[2] };
}

/* Symbols by the places of their names in memory: to intern one takes twenty times as long.  */
enum
{
  NAMES = 512, /* a power of two */
  TRIES = 8
};

static struct
{
  _Atomic (const char *) name;
  SCM symbol;
} known[NAMES];

static pthread_mutex_t naming = PTHREAD_MUTEX_INITIALIZER;

/* Intern NAME, and keep the symbol at the first free of TRIES places from AT on, if any is free. */
static SCM
intern (const char *name, size_t at)
{
  SCM symbol = scm_permanent_object (scm_from_utf8_symbol (name));
  pthread_mutex_lock (&naming);
  for (size_t i = at; i < at + TRIES; i++)
    if (!atomic_load (&known[i % NAMES].name))
      {
        known[i % NAMES].symbol = symbol;
        atomic_store (&known[i % NAMES].name, name);
        break;
      }
  pthread_mutex_unlock (&naming);
  return symbol;
}

SCM
bt__symbol (const char *name)
{
  size_t at = ((uintptr_t)name * 0x9e3779b1u >> 8) % NAMES;
  for (size_t i = at; i < at + TRIES; i++)
    if (atomic_load_explicit (&known[i % NAMES].name, memory_order_acquire) == name)
      return known[i % NAMES].symbol;
  return intern (name, at);
}

SCM
bt__associate (const char *name, SCM value, SCM rest)
{
  return scm_acons (bt__symbol (name), value, rest);
}

SCM
bt__from_points (const bt_vec3 *points, int n)
{
  SCM array = scm_make_typed_array (scm_from_utf8_symbol ("f64"), SCM_UNSPECIFIED,
                                    scm_list_2 (scm_from_int (n), scm_from_int (3)));
  scm_t_array_handle handle;
  scm_array_get_handle (array, &handle);
  memcpy (scm_array_handle_f64_writable_elements (&handle), points, sizeof *points * (size_t)n);
  scm_array_handle_release (&handle);
  return array;
}

/* ---- Names ---- */

SCM
bt__obstacle_name (bt_dive *dive, int object)
{
  const char *name = bt_dive_name (dive, BT_PART_OBSTACLE, object);
  return name ? scm_from_utf8_symbol (name) : SCM_BOOL_F;
}

/* ---- Currents ---- */

#define DEGREE (3.14159265358979323846 / 180)

static double
number_in (SCM list, int i)
{
  return scm_to_double (scm_list_ref (list, scm_from_int (i)));
}

/* Exact toward the four winds.  */
static bt_vec3
set_and_drift (double speed, double degrees)
{
  double d = remainder (degrees, 360);
  if (d == 0 || d == 180 || d == -180)
    return (bt_vec3){ 0, d == 0 ? speed : -speed, 0 };
  if (d == 90 || d == -90)
    return (bt_vec3){ d > 0 ? speed : -speed, 0, 0 };
  return bt_set_and_drift (speed, d * DEGREE);
}

static bt_vec3
velocity_in (SCM list, int i)
{
  return set_and_drift (number_in (list, i), number_in (list, i + 1));
}

static void
read_profile (const char *who, SCM rows, bt_current *current)
{
  for (; scm_is_pair (rows); rows = SCM_CDR (rows))
    {
      if (current->n == BT_PROFILE_MAX)
        fail (who, BT_ERR_LIMIT, "a current profile has at most 64 rows");
      current->z[current->n] = number_in (SCM_CAR (rows), 0);
      current->velocity[current->n++] = velocity_in (SCM_CAR (rows), 1);
    }
}

typedef struct kind_word
{
  const char *word;
  bt_current_kind kind;
} kind_word;

static bt_current_kind
kind_of (const char *who, SCM symbol)
{
  static const kind_word words[]
      = { { "still", BT_CURRENT_STILL },       { "uniform", BT_CURRENT_UNIFORM },
          { "profile", BT_CURRENT_PROFILE },   { "turning", BT_CURRENT_TURNING },
          { "power", BT_CURRENT_POWER },       { "tide", BT_CURRENT_TIDE },
          { "function", BT_CURRENT_FUNCTION }, { "grid", BT_CURRENT_GRID } };
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (scm_is_eq (symbol, scm_from_utf8_symbol (words[i].word)))
      return words[i].kind;
  fail (who, BT_ERR_NAME, "that is no kind of current");
}

bt_current
bt__to_current (const char *who, SCM object, SCM *function)
{
  bt_current current;
  memset (&current, 0, sizeof current);
  if (!scm_is_pair (object))
    fail (who, BT_ERR_DOMAIN, "a current is a list here");
  current.kind = kind_of (who, SCM_CAR (object));
  switch (current.kind)
    {
    case BT_CURRENT_STILL:
    case BT_CURRENT_GRID:
      break;
    case BT_CURRENT_PROFILE:
      read_profile (who, SCM_CDR (object), &current);
      break;
    case BT_CURRENT_FUNCTION:
      *function = scm_cadr (object);
      break;
    default:
      current.velocity[0] = velocity_in (object, 1);
    }
  if (current.kind == BT_CURRENT_TURNING)
    current.turn_rate = number_in (object, 3) * DEGREE;
  if (current.kind == BT_CURRENT_POWER)
    current.exponent = number_in (object, 3);
  if (current.kind == BT_CURRENT_TIDE)
    current.period = number_in (object, 3);
  return current;
}

static void
stop_asking (void *handle)
{
  ((bt__handle *)handle)->asking = 0;
}

/* The procedure may leave by an exception: nothing of the engine is held then.  */
void
bt__call_current (void *user, bt_vec3 p, double t, bt_vec3 *v)
{
  bt__handle *handle = user;
  scm_dynwind_begin (0);
  scm_dynwind_unwind_handler (stop_asking, handle, SCM_F_WIND_EXPLICITLY);
  handle->asking = 1;
  *v = bt__to_point ("current",
                     scm_call_2 (handle->function, bt__from_point (p), scm_from_double (t)));
  scm_dynwind_end ();
}

/* ---- Parts and fields ---- */

bt_part
bt__to_part (const char *who, SCM symbol)
{
  if (scm_is_eq (symbol, bt__symbol ("rov")))
    return BT_PART_VEHICLE;
  if (scm_is_eq (symbol, bt__symbol ("tether")))
    return BT_PART_TETHER;
  if (scm_is_eq (symbol, bt__symbol ("sea")))
    return BT_PART_SEA;
  if (scm_is_eq (symbol, bt__symbol ("obstacle")))
    return BT_PART_OBSTACLE;
  fail (who, BT_ERR_NAME, "a part is a sea, a rov, a tether or an obstacle");
}

/* The bytes of SYMBOL in BUFFER, cut at BT_NAME_SIZE bytes, which no name reaches.  */
static void
symbol_bytes (SCM symbol, char buffer[BT_NAME_SIZE + 1])
{
  SCM bytes = scm_string_to_utf8 (scm_symbol_to_string (symbol));
  size_t n = SCM_BYTEVECTOR_LENGTH (bytes);
  n = n < BT_NAME_SIZE ? n : BT_NAME_SIZE;
  memcpy (buffer, SCM_BYTEVECTOR_CONTENTS (bytes), n);
  buffer[n] = 0;
}

bt_status
bt__set_field (const char *who, const bt_field *field, void *def, SCM value, bt_error *error)
{
  char word[BT_NAME_SIZE + 1];
  if (!scm_is_symbol (value))
    return scm_is_real (value) ? bt_def_set_number (field, def, scm_to_double (value), error)
                               : bt_def_set_point (field, def, bt__to_point (who, value), error);
  symbol_bytes (value, word);
  return field->kind == BT_FIELD_END ? bt_def_set_part (field, def, word, error)
                                     : bt_def_set_word (field, def, word, error);
}

SCM
bt__from_field (const bt_field *field, double value)
{
  for (const bt_word *w = field->words; w && w->word; w++)
    if (w->value == value || (isnan (w->value) && isnan (value)))
      return scm_from_utf8_symbol (w->word);
  return scm_from_double (value);
}
