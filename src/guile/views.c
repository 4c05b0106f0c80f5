/* Snapshots of vehicles and tethers as Scheme values, and what a tether is at a place.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "guile/guile.h"

#define DEGREES (180 / 3.14159265358979323846)

/* What lies at OFFSET of a view, told by NAME.  */
typedef struct answer
{
  const char *name;
  enum
  {
    POINT,
    REAL,
    ANGLE,
    STICKS,
    TRUTH,
    PLACE /* an index, below 0 for none */
  } kind;
  size_t offset;
} answer;

static SCM
from_answer (const answer *a, const void *view)
{
  const void *at = (const char *)view + a->offset;
  switch (a->kind)
    {
    case POINT:
      return bt__from_point (*(const bt_vec3 *)at);
    case REAL:
      return scm_from_double (*(const double *)at);
    case ANGLE:
      return scm_from_double (*(const double *)at * DEGREES);
    case STICKS:
      return bt__from_doubles (at, 4);
    case TRUTH:
      return scm_from_bool (*(const int *)at);
    default:
      return *(const int *)at < 0 ? SCM_BOOL_F : scm_from_int (*(const int *)at);
    }
}

static SCM
all_answers (const answer *answers, size_t n, const void *view)
{
  SCM list = SCM_EOL;
  while (n-- > 0)
    list = bt__associate (answers[n].name, from_answer (&answers[n], view), list);
  return list;
}

/* One of them: to make all for one takes as long as a third of a step.  */
static SCM
one_answer (const answer *answers, size_t n, const void *view, SCM key)
{
  for (size_t k = 0; k < n; k++)
    if (scm_is_eq (key, bt__symbol (answers[k].name)))
      return from_answer (&answers[k], view);
  return SCM_BOOL_F;
}

#define COUNT(table) (sizeof table / sizeof *table)

#define ANSWER(name, kind, member)                                                                 \
  {                                                                                                \
    name, kind, offsetof (bt_vehicle_view, member)                                                 \
  }

static const answer vehicle_answers[] = {
  ANSWER ("position", POINT, position), ANSWER ("height", REAL, position.z),
  ANSWER ("velocity", POINT, velocity), ANSWER ("heading", ANGLE, heading),
  ANSWER ("pitch", ANGLE, pitch),       ANSWER ("roll", ANGLE, roll),
  ANSWER ("turns", REAL, turns),        ANSWER ("sticks", STICKS, sticks),
  ANSWER ("arrived?", TRUTH, arrived),  ANSWER ("held?", TRUTH, held),
  ANSWER ("surge-speed", REAL, speeds),
};

#undef ANSWER
#define ANSWER(name, kind, member)                                                                 \
  {                                                                                                \
    name, kind, offsetof (bt_tether_view, member)                                                  \
  }

static const answer tether_answers[] = {
  ANSWER ("length", REAL, length),
  ANSWER ("target", REAL, target),
  ANSWER ("chord", REAL, chord),
  ANSWER ("tension-anchor", REAL, tension_anchor),
  ANSWER ("tension-end", REAL, tension_end),
  ANSWER ("tension-max", REAL, tension_max),
  ANSWER ("accuracy", REAL, accuracy),
  ANSWER ("tension-error", REAL, tension_error),
  ANSWER ("twist", REAL, twist),
  ANSWER ("torque-anchor", REAL, torque_anchor),
  ANSWER ("torque-end", REAL, torque_end),
  ANSWER ("force", POINT, force),
  ANSWER ("vehicle", PLACE, vehicle),
  ANSWER ("taut?", TRUTH, taut),
  ANSWER ("spooling?", TRUTH, spooling),
  ANSWER ("parted?", TRUTH, parted),
  ANSWER ("asleep?", TRUTH, asleep),
  ANSWER ("blocked?", TRUTH, blocked),
  ANSWER ("stuck?", TRUTH, stuck),
  ANSWER ("settled?", TRUTH, settled),
};

#undef ANSWER

static bt_vehicle_view
vehicle_view (SCM object, SCM index)
{
  bt_vehicle_view v;
  bt_error error;
  bt__check ("rov-position", bt_dive_vehicle (bt__to_dive (object), scm_to_int (index), &v, &error),
             &error);
  return v;
}

static SCM
vehicle (SCM object, SCM index)
{
  bt_vehicle_view v = vehicle_view (object, index);
  return all_answers (vehicle_answers, COUNT (vehicle_answers), &v);
}

static SCM
vehicle_value (SCM object, SCM index, SCM key)
{
  bt_vehicle_view v = vehicle_view (object, index);
  return one_answer (vehicle_answers, COUNT (vehicle_answers), &v, key);
}

static bt_tether_view
tether_view (const char *who, SCM object, SCM index)
{
  bt_tether_view view;
  bt_error error;
  bt__check (who, bt_dive_tether (bt__to_dive (object), scm_to_int (index), &view, &error), &error);
  return view;
}

static SCM
tether (SCM object, SCM index)
{
  bt_tether_view t = tether_view ("tether-length", object, index);
  return all_answers (tether_answers, COUNT (tether_answers), &t);
}

static SCM
tether_value (SCM object, SCM index, SCM key)
{
  bt_tether_view t = tether_view ("tether-length", object, index);
  return one_answer (tether_answers, COUNT (tether_answers), &t, key);
}

static SCM
error_estimate (SCM object, SCM index)
{
  double estimate;
  bt_error error;
  bt__check ("error-estimate",
             bt_tether_error_estimate (bt__to_dive (object), scm_to_int (index), &estimate, &error),
             &error);
  return scm_from_double (estimate);
}

/* The properties of a tether, by the names of their fields.  */
static SCM
properties (SCM object, SCM index)
{
  bt_tether_def def;
  const bt_head *head = bt_head_find ("tether");
  SCM list = SCM_EOL;
  bt_tether_view view = tether_view ("describe", object, index);
  def.props = view.props;
  def.length = view.length;
  def.drum = view.drum;
  for (size_t i = head->n_fields; i-- > 0;)
    {
      const bt_field *field = &head->fields[i];
      const double *value = (const double *)(const void *)((const char *)&def + field->offset);
      if (field->kind == BT_FIELD_NUMBER || field->kind == BT_FIELD_COUNT
          || field->kind == BT_FIELD_WORD)
        list = bt__associate (field->name, bt__from_field (field, *value), list);
    }
  return list;
}

static SCM
tether_points (SCM object, SCM index, SCM count)
{
  bt_dive *dive = bt__to_dive (object);
  int i = scm_to_int (index), asked = scm_to_int (count);
  int n = asked ? asked : tether_view ("tether-points", object, index).nodes;
  SCM array = scm_make_typed_array (scm_from_utf8_symbol ("f64"), SCM_UNSPECIFIED,
                                    scm_list_2 (scm_from_int (n), scm_from_int (3)));
  scm_t_array_handle handle;
  bt_status status;
  bt_error error;
  scm_array_get_handle (array, &handle);
  status = bt_tether_points (
      dive, i, asked, (bt_vec3 *)(void *)scm_array_handle_f64_writable_elements (&handle), &error);
  scm_array_handle_release (&handle);
  bt__check ("tether-points", status, &error);
  return array;
}

static SCM
tether_tensions (SCM object, SCM index, SCM count)
{
  bt_dive *dive = bt__to_dive (object);
  int asked = scm_to_int (count);
  int n = asked ? asked : tether_view ("tensions", object, index).nodes;
  SCM v = scm_make_f64vector (scm_from_int (n), SCM_INUM0);
  bt_error error;
  bt__check ("tensions",
             bt_tether_tensions (dive, scm_to_int (index), asked,
                                 (double *)SCM_BYTEVECTOR_CONTENTS (v), &error),
             &error);
  return v;
}

static SCM
point_at (SCM object, SCM index, SCM s)
{
  bt_vec3 p;
  bt_error error;
  bt__check (
      "point-at",
      bt_tether_point (bt__to_dive (object), scm_to_int (index), scm_to_double (s), &p, &error),
      &error);
  return bt__from_point (p);
}

static SCM
tangent_at (SCM object, SCM index, SCM s)
{
  bt_vec3 p;
  bt_error error;
  bt__check (
      "tangent-at",
      bt_tether_tangent (bt__to_dive (object), scm_to_int (index), scm_to_double (s), &p, &error),
      &error);
  return bt__from_point (p);
}

static SCM
tension_at (SCM object, SCM index, SCM s)
{
  double t;
  bt_error error;
  bt__check (
      "tension-at",
      bt_tether_tension (bt__to_dive (object), scm_to_int (index), scm_to_double (s), &t, &error),
      &error);
  return scm_from_double (t);
}

static SCM
tether_tail (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  int i = scm_to_int (index), n = bt_tether_tail (dive, i, NULL, 0);
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * (size_t)(n + 1), "tether-tail");
  bt_tether_tail (dive, i, points, n);
  return n ? bt__from_points (points, n) : SCM_BOOL_F;
}

static SCM
tightest_bend (SCM object, SCM index)
{
  double radius;
  bt_error error;
  bt__check ("tightest-bend",
             bt_tether_tightest_bend (bt__to_dive (object), scm_to_int (index), &radius, &error),
             &error);
  return scm_from_double (radius);
}

static SCM
energy (SCM object, SCM index)
{
  bt_energy e;
  bt_error error;
  bt__check ("energy", bt_tether_energy (bt__to_dive (object), scm_to_int (index), &e, &error),
             &error);
  return bt__associate (
      "kinetic", scm_from_double (e.kinetic),
      bt__associate ("strain", scm_from_double (e.strain),
                     bt__associate ("gravity", scm_from_double (e.gravity),
                                    bt__associate ("bending", scm_from_double (e.bending),
                                                   bt__associate ("lost", scm_from_double (e.lost),
                                                                  SCM_EOL)))));
}

static SCM
equilibria (SCM object, SCM index)
{
  enum
  {
    MOST = 8
  };
  int n = (int)tether_view ("equilibria", object, index).props.nodes + 1, found;
  bt_vec3 *shapes = scm_gc_malloc_pointerless (sizeof *shapes * MOST * (size_t)n, "equilibria");
  SCM list = SCM_EOL;
  bt_error error;
  bt__check_long (
      "equilibria", bt__to_handle (object),
      bt_tether_equilibria (bt__to_dive (object), scm_to_int (index), MOST, shapes, &found, &error),
      &error);
  while (found-- > 0)
    list = scm_cons (bt__from_points (shapes + (size_t)found * n, n), list);
  return list;
}

void
bt__define_views (void)
{
  static const bt__procedure table[] = {
    { "%vehicle", 2, 0, (scm_t_subr)vehicle, "Return the INDEX-th vehicle of DIVE, an alist." },
    { "%vehicle-value", 3, 0, (scm_t_subr)vehicle_value,
      "Return what KEY is in the alist of the INDEX-th vehicle of DIVE." },
    { "%tether", 2, 0, (scm_t_subr)tether, "Return the INDEX-th tether of DIVE, an alist." },
    { "%tether-value", 3, 0, (scm_t_subr)tether_value,
      "Return what KEY is in the alist of the INDEX-th tether of DIVE." },
    { "%tether-properties", 2, 0, (scm_t_subr)properties,
      "Return the properties of the INDEX-th tether of DIVE, an alist by field." },
    { "%error-estimate", 2, 0, (scm_t_subr)error_estimate,
      "Return the error in position of tether INDEX of DIVE, m; NaN of a static shape." },
    { "%tether-points", 3, 0, (scm_t_subr)tether_points,
      "Return COUNT points (0: the model's own) of the INDEX-th tether of DIVE, an n x 3 array." },
    { "%tether-tensions", 3, 0, (scm_t_subr)tether_tensions,
      "Return tensions at the same points, an f64vector." },
    { "%point-at", 3, 0, (scm_t_subr)point_at, "Return the point at arc length S." },
    { "%tangent-at", 3, 0, (scm_t_subr)tangent_at, "Return the unit tangent at arc length S." },
    { "%tension-at", 3, 0, (scm_t_subr)tension_at, "Return the tension at arc length S, N." },
    { "%tether-tail", 2, 0, (scm_t_subr)tether_tail,
      "Return the points of the part of a parted tether at its far end, or #f when it is whole." },
    { "%tightest-bend", 2, 0, (scm_t_subr)tightest_bend,
      "Return the radius of the tightest bend of the INDEX-th tether of DIVE, m." },
    { "%energy", 2, 0, (scm_t_subr)energy,
      "Return the energies of the INDEX-th tether of DIVE by kind, J, an alist." },
    { "%equilibria", 2, 0, (scm_t_subr)equilibria,
      "Return the equilibria found for the INDEX-th tether of DIVE, polylines." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
