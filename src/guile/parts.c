/* Parts: the engine's tables of fields as Scheme sees them, and a world compiled from a list.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"

/* ---- Reflection ---- */

static SCM
part_heads (void)
{
  size_t n;
  const bt_head *heads = bt_heads (&n);
  SCM list = SCM_EOL;
  while (n-- > 0)
    if (!heads[n].inside)
      list = scm_cons (scm_from_utf8_symbol (heads[n].name), list);
  return list;
}

/* The kinds of things written inside parts of kind HEAD.  */
static SCM
inner_heads (SCM head)
{
  size_t n;
  const bt_head *heads = bt_heads (&n);
  SCM list = SCM_EOL;
  while (n-- > 0)
    if (heads[n].inside && scm_is_eq (head, scm_from_utf8_symbol (heads[n].inside)))
      list = scm_cons (scm_from_utf8_symbol (heads[n].name), list);
  return list;
}

const bt_head *
bt__to_head (const char *who, SCM symbol)
{
  char *name = scm_to_utf8_string (scm_symbol_to_string (symbol));
  const bt_head *head = bt_head_find (name);
  free (name);
  if (!head)
    {
      bt_error error = { BT_ERR_NAME, "there is no such kind of part" };
      bt__raise (who, &error);
    }
  return head;
}

static SCM
head_text (SCM head)
{
  return scm_from_utf8_string (bt__to_head ("%head-text", head)->text);
}

static SCM
words_of (const bt_field *field)
{
  SCM list = SCM_EOL;
  for (const bt_word *w = field->words; w && w->word; w++)
    list = scm_cons (scm_cons (scm_from_utf8_symbol (w->word), scm_from_double (w->value)), list);
  return scm_reverse_x (list, SCM_EOL);
}

static const char *
kind_name (bt_field_kind kind)
{
  static const char *const names[]
      = { "number", "count",  "point",  "word",  "end",  "current", "waves",
          "points", "points", "points", "track", "mesh", "grid" };
  return names[kind];
}

static int
has_default (const bt_field *field)
{
  return (field->kind == BT_FIELD_NUMBER || field->kind == BT_FIELD_COUNT
          || field->kind == BT_FIELD_WORD)
         && (!isnan (field->fallback) || scm_is_symbol (bt__from_field (field, field->fallback)));
}

/* #(name kind unit text default min max above-min? words specials live?) */
static SCM
from_field_description (const bt_field *field)
{
  SCM v = scm_c_make_vector (11, SCM_BOOL_F);
  SCM words = words_of (field), names = SCM_EOL;
  for (SCM rest = words; scm_is_pair (rest); rest = SCM_CDR (rest))
    names = scm_cons (SCM_CAAR (rest), names);
  scm_c_vector_set_x (v, 0, scm_from_utf8_symbol (field->name));
  scm_c_vector_set_x (v, 1, scm_from_utf8_symbol (kind_name (field->kind)));
  scm_c_vector_set_x (v, 2, scm_from_utf8_string (field->unit));
  scm_c_vector_set_x (v, 3, scm_from_utf8_string (field->text));
  if (has_default (field))
    scm_c_vector_set_x (v, 4, bt__from_field (field, field->fallback));
  scm_c_vector_set_x (v, 5, scm_from_double (field->min));
  scm_c_vector_set_x (v, 6, scm_from_double (field->max));
  scm_c_vector_set_x (v, 7, scm_from_bool (field->above_min));
  scm_c_vector_set_x (v, 8,
                      field->kind == BT_FIELD_WORD ? scm_reverse_x (names, SCM_EOL) : SCM_EOL);
  scm_c_vector_set_x (v, 9, field->kind == BT_FIELD_WORD ? SCM_EOL : words);
  scm_c_vector_set_x (v, 10, scm_from_bool (field->live));
  return v;
}

static SCM
part_fields (SCM symbol)
{
  const bt_head *head = bt__to_head ("%part-fields", symbol);
  SCM list = SCM_EOL;
  for (size_t i = head->n_fields; i-- > 0;)
    list = scm_cons (from_field_description (&head->fields[i]), list);
  return list;
}

/* A list of #(field of factor power floor).  */
static SCM
tether_bounds (void)
{
  size_t n;
  const bt_bound *all = bt_bounds (&n);
  SCM list = SCM_EOL;
  while (n-- > 0)
    {
      SCM v = scm_c_make_vector (5, SCM_BOOL_F);
      scm_c_vector_set_x (v, 0, scm_from_utf8_symbol (all[n].field));
      scm_c_vector_set_x (v, 1, scm_from_utf8_symbol (all[n].of));
      scm_c_vector_set_x (v, 2, scm_from_double (all[n].factor));
      scm_c_vector_set_x (v, 3, scm_from_int (all[n].power));
      scm_c_vector_set_x (v, 4, scm_from_double (all[n].floor));
      list = scm_cons (v, list);
    }
  return list;
}

/* WET-WEIGHT #f: it follows from the mass.  */
static SCM
least_mass (SCM diameter, SCM wet_weight, SCM density, SCM gravity)
{
  bt_tether_props props
      = { .diameter = scm_to_double (diameter),
          .wet_weight = scm_is_true (wet_weight) ? scm_to_double (wet_weight) : NAN };
  return scm_from_double (
      bt_tether_least_mass (&props, scm_to_double (density), scm_to_double (gravity)));
}

/* ---- A world from a list ---- */

/* What a list of parts is read into; its memory is the collector's.  */
typedef struct reading
{
  bt_world world;
  bt_vehicle_def *vehicles;
  bt_tether_def *tethers;
  bt_obstacle_def *obstacles;
  SCM function;
} reading;

static void read_inner (void *outer, const bt_head *head, SCM fields);

/* The field NAME of parts of kind HEAD, or NULL if NAME is the kind of an inner part, put into
 *INNER.  */
static const bt_field *
field_or_inner (const bt_head *head, const char *name, const bt_head **inner)
{
  const bt_field *field = bt_field_find (head, name);
  bt_error unknown = { BT_ERR_NAME, "there is no such field" };
  *inner = field ? NULL : bt_head_find (name);
  if (!field && !(*inner && (*inner)->inside && strcmp ((*inner)->inside, head->name) == 0))
    bt__raise ("enter!", &unknown);
  return field;
}

static void
read_fields (const bt_head *head, void *def, SCM fields, SCM *function)
{
  static const char *const who = "enter!";
  bt_error error;
  for (; scm_is_pair (fields); fields = SCM_CDR (fields))
    {
      char *name = scm_to_utf8_string (scm_symbol_to_string (SCM_CAAR (fields)));
      const bt_head *inner;
      const bt_field *field = field_or_inner (head, name, &inner);
      SCM value = SCM_CDAR (fields);
      free (name);
      if (!field)
        read_inner (def, inner, value);
      else if (bt__set_shape (who, field, def, value))
        continue;
      else if (field->kind == BT_FIELD_CURRENT)
        {
          bt_current current = bt__to_current (who, value, function);
          bt__check (who, bt_def_set_current (field, def, &current, &error), &error);
          if (current.kind == BT_CURRENT_GRID)
            ((bt_sea_def *)def)->grid = scm_to_pointer (scm_cadr (value));
        }
      else if (field->kind == BT_FIELD_WAVES)
        {
          bt_wave_def waves;
          const double *numbers = (const double *)SCM_BYTEVECTOR_CONTENTS (value);
          int n = (int)scm_c_array_length (value);
          bt__check (who, bt_waves_unpack (numbers, n, &waves, &error), &error);
          bt__check (who, bt_def_set_waves (field, def, &waves, &error), &error);
        }
      else
        bt__check (who, bt__set_field (who, field, def, value, &error), &error);
    }
}

static void
read_name (char *name_field, SCM symbol)
{
  bt_error error;
  char *name = scm_to_utf8_string (scm_symbol_to_string (symbol));
  bt_status status = bt_def_set_name (name_field, name, &error);
  free (name);
  bt__check ("enter!", status, &error);
}

static void
check_room (int n, int most, const char *what)
{
  bt_error error = { .status = BT_ERR_LIMIT };
  if (n < most)
    return;
  snprintf (error.text, sizeof error.text, "a world has at most %d %s", most, what);
  bt__raise ("enter!", &error);
}

/* Add a row of SIZE bytes, of kind HEAD with FIELDS, to the *N of MOST in ROWS.  */
static void
read_row (const bt_head *head, SCM fields, void *rows, size_t size, double *n, int most,
          const char *what)
{
  void *row = (char *)rows + (size_t)*n * size;
  check_room ((int)*n, most, what);
  bt_def_init (head, row);
  read_fields (head, row, fields, NULL);
  ++*n;
}

/* A thing of kind HEAD inside OUTER.  */
static void
read_inner (void *outer, const bt_head *head, SCM fields)
{
  bt_vehicle_def *vehicle = outer;
  bt_tether_def *tether = outer;
  if (strcmp (head->inside, "rov") == 0)
    read_row (head, fields, vehicle->thrusters, sizeof *vehicle->thrusters, &vehicle->n_thrusters,
              BT_THRUSTERS_MAX, "thrusters on one rov");
  else if (strcmp (head->name, "set") == 0)
    read_row (head, fields, tether->sets, sizeof *tether->sets, &tether->n_sets, BT_SETS_MAX,
              "sets of one tether");
  else
    read_row (head, fields, tether->lumps, sizeof *tether->lumps, &tether->n_lumps, BT_LUMPS_MAX,
              "clumps and floats on one tether");
}

static void
read_part (reading *r, SCM part)
{
  const bt_head *head = bt__to_head ("enter!", SCM_CAR (part));
  SCM name = scm_cadr (part), fields = scm_caddr (part);
  if (strcmp (head->name, "sea") == 0)
    read_fields (head, &r->world.sea, fields, &r->function);
  else if (strcmp (head->name, "rov") == 0)
    {
      check_room (r->world.n_vehicles, BT_VEHICLES_MAX, "vehicles");
      bt_vehicle_def *def = &r->vehicles[r->world.n_vehicles++];
      bt_def_init (head, def);
      read_name (def->name, name);
      read_fields (head, def, fields, &r->function);
    }
  else if (head->obstacle >= 0)
    {
      check_room (r->world.n_obstacles, BT_OBSTACLES_MAX, "obstacles");
      bt_obstacle_def *def = &r->obstacles[r->world.n_obstacles++];
      bt_def_init (head, def);
      read_name (def->name, name);
      read_fields (head, def, fields, &r->function);
    }
  else
    {
      check_room (r->world.n_tethers, BT_TETHERS_MAX, "tethers");
      bt_tether_def *def = &r->tethers[r->world.n_tethers++];
      bt_def_init (head, def);
      read_name (def->name, name);
      read_fields (head, def, fields, &r->function);
    }
}

/* Room for as many as a world may have, and no more than there are.  */
static size_t
count_obstacles (SCM parts)
{
  size_t n = 0;
  for (; scm_is_pair (parts) && n < BT_OBSTACLES_MAX; parts = SCM_CDR (parts))
    n += bt__to_head ("enter!", SCM_CAAR (parts))->obstacle >= 0;
  return n;
}

static reading
read_parts (SCM parts)
{
  static const char *const what = "parts of a world";
  reading r = { .function = SCM_BOOL_F };
  r.vehicles = scm_gc_malloc_pointerless (sizeof *r.vehicles * BT_VEHICLES_MAX, what);
  r.tethers = scm_gc_malloc_pointerless (sizeof *r.tethers * BT_TETHERS_MAX, what);
  /* They borrow from values in PARTS: seen by the collector.  */
  r.obstacles = scm_gc_calloc (sizeof *r.obstacles * count_obstacles (parts), what);
  r.world.obstacles = r.obstacles;
  r.world.vehicles = r.vehicles;
  r.world.tethers = r.tethers;
  bt_def_init (bt_head_find ("sea"), &r.world.sea);
  for (; scm_is_pair (parts); parts = SCM_CDR (parts))
    read_part (&r, SCM_CAR (parts));
  return r;
}

static SCM
make_dive (SCM parts)
{
  static const char *const who = "enter!";
  reading r = read_parts (parts);
  int asks = scm_is_true (scm_procedure_p (r.function));
  bt__handle *handle = bt__new_handle (r.function);
  bt_model *model;
  bt_error error;
  bt_status status;
  scm_run_finalizers ();
  bt__check_long (who, handle,
                  bt_model_new_polled (&r.world, bt__ask_guile, handle, &model, &error), &error);
  status = bt_dive_new_polled (model, asks ? bt__call_current : NULL, handle, bt__ask_guile, handle,
                               &handle->dive, &error);
  bt_model_release (model);
  bt__check_long (who, handle, status, &error);
  bt__tell_states (handle, 2);
  scm_remember_upto_here_1 (parts);
  return bt__from_handle (handle);
}

static SCM
version (void)
{
  return scm_from_utf8_string (bt_version ());
}

void
bt__define_parts (void)
{
  static const bt__procedure table[] = {
    { "%version", 0, 0, (scm_t_subr)version, "Return the version of the engine, a string." },
    { "%part-heads", 0, 0, (scm_t_subr)part_heads, "Return the kinds of parts, symbols." },
    { "%inner-heads", 1, 0, (scm_t_subr)inner_heads,
      "Return the kinds of things that are written inside parts of kind HEAD, symbols." },
    { "%head-text", 1, 0, (scm_t_subr)head_text, "Return the sentence on parts of kind HEAD." },
    { "%part-fields", 1, 0, (scm_t_subr)part_fields,
      "Return the fields of parts of kind HEAD, a list of vectors #(name kind unit text default "
      "min "
      "max above-min? words specials live?)." },
    { "%tether-bounds", 0, 0, (scm_t_subr)tether_bounds,
      "Return what fields of tethers may be at most for another field, a list of vectors #(field "
      "of "
      "factor power floor)." },
    { "%least-mass", 4, 0, (scm_t_subr)least_mass,
      "Return the least mass, kg/m, that a line of DIAMETER and WET-WEIGHT, or #f if that follows, "
      "has in water of DENSITY under GRAVITY." },
    { "%make-dive", 1, 0, (scm_t_subr)make_dive,
      "Start a dive from PARTS, a list of (HEAD NAME ((FIELD . VALUE) ...))." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
