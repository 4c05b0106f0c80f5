/* What a second of a recording tells of a dive, as text: the quantities of vehicles and tethers.

   Each vehicle is (rov NAME x y z heading), each tether (tether NAME length tension-at-anchor
   tension-at-end "DIGITS"), with four hexadecimal digits for each node.  A recording is written so
   once a second, and a replay reads what it compares from the same text.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"

#define DEGREES (180 / 3.14159265358979323846)

/* Text that grows, of the collector's memory.  */
typedef struct text
{
  char *at;
  size_t n, room;
} text;

/* Return the end of T, where N bytes more have room, and count them.  */
static char *
more_room (text *t, size_t n)
{
  if (t->n + n > t->room)
    {
      size_t room = 2 * (t->n + n);
      char *more = scm_gc_malloc_pointerless (room, "quantities");
      memcpy (more, t->at, t->n);
      t->at = more;
      t->room = room;
    }
  t->n += n;
  return t->at + t->n - n;
}

static void
put_text (text *t, const char *bytes, size_t n)
{
  memcpy (more_room (t, n), bytes, n);
}

/* A space and X as `write' has it.  */
static void
put_number (text *t, double x)
{
  size_t n;
  char *digits
      = scm_to_latin1_stringn (scm_number_to_string (scm_from_double (x), scm_from_int (10)), &n);
  put_text (t, " ", 1);
  put_text (t, digits, n);
  free (digits);
}

/* 16 bits of the place P: of a product, the upper ones, to which all lower bits have come.  */
static uint64_t
mark_of (bt_vec3 p)
{
  uint64_t word[3], h = 0xcbf29ce484222325u;
  memcpy (word, &p, sizeof word);
  for (int k = 0; k < 3; k++)
    h = (h ^ word[k]) * 0x9fb21c651e98df25u;
  return h >> 48;
}

static void
put_nodes (text *t, bt_dive *dive, int i, int n)
{
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * (size_t)(n + 1), "points");
  bt_error error;
  bt__check ("record!", bt_tether_points (dive, i, 0, points, &error), &error);
  put_text (t, " \"", 2);
  char *digits = more_room (t, 4 * (size_t)n);
  for (int k = 0; k < n; k++)
    bt__hexadecimal (digits + 4 * k, mark_of (points[k]), 4);
  put_text (t, "\"", 1);
}

static void
put_vehicle (text *t, bt_dive *dive, int i)
{
  bt_vehicle_view v;
  bt_error error;
  bt__check ("record!", bt_dive_vehicle (dive, i, &v, &error), &error);
  put_number (t, v.position.x);
  put_number (t, v.position.y);
  put_number (t, v.position.z);
  put_number (t, v.heading * DEGREES);
}

static void
put_tether (text *t, bt_dive *dive, int i)
{
  bt_tether_view v;
  bt_error error;
  bt__check ("record!", bt_dive_tether (dive, i, &v, &error), &error);
  put_number (t, v.length);
  put_number (t, v.tension_anchor);
  put_number (t, v.tension_end);
  put_nodes (t, dive, i, v.nodes);
}

/* NAMES is a list of bytevectors, one for each part: (HEAD NAME.  */
static void
put_each (text *t, bt_dive *dive, SCM names, void (*put_part) (text *, bt_dive *, int))
{
  for (int i = 0; scm_is_pair (names); i++, names = scm_cdr (names))
    {
      SCM name = scm_car (names);
      SCM_ASSERT_TYPE (SCM_BYTEVECTOR_P (name), name, SCM_ARGn, "record!", "bytevector");
      put_text (t, " ", 1);
      put_text (t, (const char *)SCM_BYTEVECTOR_CONTENTS (name), SCM_BYTEVECTOR_LENGTH (name));
      put_part (t, dive, i);
      put_text (t, ")", 1);
    }
}

static SCM
quantities (SCM object, SCM vehicles, SCM tethers)
{
  bt_dive *dive = bt__to_dive (object);
  text t = { .room = 1000, .at = scm_gc_malloc_pointerless (1000, "quantities") };
  put_each (&t, dive, vehicles, put_vehicle);
  put_each (&t, dive, tethers, put_tether);
  SCM bytes = scm_c_make_bytevector (t.n);
  memcpy (SCM_BYTEVECTOR_CONTENTS (bytes), t.at, t.n);
  return bytes;
}

void
bt__define_quantities (void)
{
  static const bt__procedure table[] = {
    { "%quantities", 3, 0, (scm_t_subr)quantities,
      "Return what a recording tells of DIVE, UTF-8 in a bytevector.  VEHICLES and TETHERS, lists "
      "of bytevectors, say how each begins: (rov NAME." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
