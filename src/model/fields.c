/* The one table of every field a part has: parser, defaults, error messages, help and the validator
   all read it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include <bight/model.h>

#include "base/error.h"

#define COUNT_OF(array) (sizeof (array) / sizeof *(array))

static const bt_word inextensible[] = { { "inextensible", INFINITY }, { NULL, 0 } };
static const bt_word unbreakable[] = { { "none", INFINITY }, { NULL, 0 } };
static const bt_word unlimited[] = { { "none", INFINITY }, { NULL, 0 } };
static const bt_word automatic[] = { { "auto", BT_SAG_AUTO }, { NULL, 0 } };

static const bt_word models[] = { { "rubber-band", BT_MODEL_RUBBER_BAND },
                                  { "v-shape", BT_MODEL_V_SHAPE },
                                  { "catenary", BT_MODEL_CATENARY },
                                  { "catenary-simplex", BT_MODEL_CATENARY_SIMPLEX },
                                  { "elastic", BT_MODEL_ELASTIC },
                                  { "steady", BT_MODEL_STEADY },
                                  { "dynamic", BT_MODEL_DYNAMIC },
                                  { "auto", BT_MODEL_AUTO },
                                  { NULL, 0 } };

static const bt_word depth_rules[] = { { "sag", BT_DEPTH_SAG },
                                       { "linear", BT_DEPTH_LINEAR },
                                       { "thesis-linear", BT_DEPTH_THESIS_LINEAR },
                                       { NULL, 0 } };

#define FAR 1e7 /* metres: no sea is larger */

/* NUMBER (struct, member, name, unit, default, min, max, min excluded, live, words, text) */
#define NUMBER(s, m, n, u, d, lo, hi, above, live, words, t)                                       \
  {                                                                                                \
    n, u, t, BT_FIELD_NUMBER, offsetof (s, m), d, lo, hi, above, words, live                       \
  }
#define OTHER(s, m, n, u, k, d, words, live, t)                                                    \
  {                                                                                                \
    n, u, t, k, offsetof (s, m), d, -FAR, FAR, 0, words, live                                      \
  }
#define COUNT(s, m, n, u, d, lo, hi, live, t)                                                      \
  {                                                                                                \
    n, u, t, BT_FIELD_COUNT, offsetof (s, m), d, lo, hi, 0, NULL, live                             \
  }

static const bt_field sea_fields[] = {
  NUMBER (bt_sea_def, depth, "depth", "m", 100, 0, 12000, 1, 0, NULL,
          "from the surface to the bed"),
  NUMBER (bt_sea_def, density, "density", "kg/m3", 1025, 1, 2000, 0, 1, NULL, "of the water"),
  NUMBER (bt_sea_def, gravity, "gravity", "m/s2", 9.80665, 0, 100, 0, 1, NULL, "downward"),
  OTHER (bt_sea_def, current, "current", "", BT_FIELD_CURRENT, 0, NULL, 1,
         "the flow, toward its bearing"),
};

static const bt_field vehicle_fields[] = {
  OTHER (bt_vehicle_def, at, "at", "m", BT_FIELD_POINT, 0, NULL, 0, "where it starts"),
  NUMBER (bt_vehicle_def, heading, "heading", "deg", 0, -1e6, 1e6, 0, 0, NULL,
          "compass bearing of its front"),
  NUMBER (bt_vehicle_def, pitch, "pitch", "deg", 0, -90, 90, 0, 0, NULL, "bow up positive"),
  NUMBER (bt_vehicle_def, roll, "roll", "deg", 0, -180, 180, 0, 0, NULL, "starboard down positive"),
  NUMBER (bt_vehicle_def, surge_speed, "surge-speed", "m/s", 1.0, 0, 100, 0, 1, NULL,
          "ahead at full stick"),
  NUMBER (bt_vehicle_def, sway_speed, "sway-speed", "m/s", 0.7, 0, 100, 0, 1, NULL,
          "sideways at full stick"),
  NUMBER (bt_vehicle_def, heave_speed, "heave-speed", "m/s", 0.7, 0, 100, 0, 1, NULL,
          "up at full stick"),
  NUMBER (bt_vehicle_def, yaw_rate, "yaw-rate", "deg/s", 45, 0, 3600, 0, 1, NULL,
          "turning at full stick"),
  NUMBER (bt_vehicle_def, pull, "pull", "N", 100, 0, 1e6, 0, 1, NULL,
          "its pull on a taut tether that holds it"),
  NUMBER (bt_vehicle_def, mass, "mass", "kg", 0, 0, 1e6, 0, 0, NULL,
          "0: it goes exactly where it is told; else thrust, water and tether move it"),
  NUMBER (bt_vehicle_def, added_mass, "added-mass", "kg", 0, 0, 1e6, 0, 0, NULL,
          "of the water it sets in motion; with mass"),
  NUMBER (bt_vehicle_def, drag, "drag", "N s/m", 0, 0, 1e6, 0, 1, NULL, "linear; with mass"),
  NUMBER (bt_vehicle_def, quadratic_drag, "quadratic-drag", "N s2/m2", 0, 0, 1e6, 0, 1, NULL,
          "with mass"),
  NUMBER (bt_vehicle_def, thrust, "thrust", "N", 100, 0, 1e6, 0, 1, NULL,
          "at full stick; with mass"),
};

#define PROP(m, n, u, d, lo, hi, above, words, t)                                                  \
  NUMBER (bt_tether_def, props.m, n, u, d, lo, hi, above, 1, words, t)

static const bt_field tether_fields[] = {
  OTHER (bt_tether_def, from, "from", "m", BT_FIELD_END, 0, NULL, 0,
         "the anchor: a point, or a vehicle that carries the winch"),
  OTHER (bt_tether_def, to, "to", "m", BT_FIELD_END, 0, NULL, 0,
         "the far end: a vehicle, or a fixed point"),
  NUMBER (bt_tether_def, length, "length", "m", NAN, 0, 1e6, 1, 0, NULL,
          "paid out; pay-out! and haul-in! change it"),
  NUMBER (bt_tether_def, drum, "drum", "m", INFINITY, 0, 1e6, 1, 0, unlimited,
          "the most that can be out"),
  PROP (diameter, "diameter", "m", 0.0076, 0, 2, 1, NULL, "outer"),
  PROP (mass, "mass", "kg/m", NAN, 0, 1e4, 1, NULL,
        "in air; follows from wet-weight when not given"),
  PROP (wet_weight, "wet-weight", "N/m", NAN, -1e5, 1e5, 0, NULL,
        "in the water, sinking positive; follows from mass when not given"),
  PROP (ea, "ea", "N", 2e5, 0, 1e12, 1, inextensible, "axial stiffness"),
  PROP (ei, "ei", "N m2", 0, 0, 1e9, 0, NULL, "bending stiffness"),
  PROP (gj, "gj", "N m2", 0, 0, 1e9, 0, NULL, "torsional stiffness"),
  PROP (ba, "ba", "N s", 20, 0, 1e9, 0, NULL, "internal damping"),
  PROP (cdn, "cdn", "", 1.2, 0, 20, 0, NULL, "normal drag coefficient, on the diameter"),
  PROP (cdt, "cdt", "", 0.01, 0, 5, 0, NULL, "tangential drag coefficient, on the circumference"),
  PROP (ca, "ca", "", 1, 0, 10, 0, NULL, "normal added mass per displaced mass"),
  PROP (friction, "friction", "", 0.3, 0, 10, 0, NULL, "Coulomb coefficient against obstacles"),
  PROP (breaking_load, "breaking-load", "N", INFINITY, 0, 1e9, 1, unbreakable,
        "the tension it parts at"),
  PROP (min_bend_radius, "min-bend-radius", "m", 0, 0, 100, 0, NULL, "the tightest bend allowed"),
  COUNT (bt_tether_def, props.nodes, "nodes", "", 64, 2, BT_NODES_MAX, 0,
         "intervals of the models that have nodes"),
  OTHER (bt_tether_def, props.model, "model", "", BT_FIELD_WORD, BT_MODEL_STEADY, models, 1,
         "how its shape is found"),
  OTHER (bt_tether_def, props.depth_rule, "depth-rule", "", BT_FIELD_WORD, BT_DEPTH_SAG,
         depth_rules, 1, "how the thesis' models take depth"),
  PROP (sag_buoyancy, "sag-buoyancy", "", BT_SAG_AUTO, -1, 1, 0, automatic,
        "the thesis' buoyancy for rule `sag': -1 sinks, 1 floats"),
  PROP (accuracy, "accuracy", "m", 0.05, 0, 100, 1, NULL,
        "the error in position that model `auto' keeps"),
  PROP (max_current, "max-current", "m/s", 1, 0, 100, 1, NULL,
        "the thesis' maximum allowed current, for rule `sag'"),
  PROP (thesis_length_factor, "thesis-length-factor", "", 1, 0.5, 1, 0, NULL,
        "of the length in rule `thesis-linear'; the thesis took 0.95"),
};

#define LUMP_PLACE                                                                                 \
  NUMBER (bt_lump, at, "at", "m", NAN, 0, 1e6, 0, 0, NULL,                                         \
          "arc length of its middle from the anchor when the dive begins"),                        \
      NUMBER (bt_lump, span, "span", "m", 0, 0, 1e6, 0, 0, NULL, "the length of line it covers")

static const bt_field clump_fields[] = {
  LUMP_PLACE,
  NUMBER (bt_lump, mass, "mass", "kg", NAN, 0, 1e5, 1, 0, NULL, "in air, of steel"),
};

static const bt_field float_fields[] = {
  LUMP_PLACE,
  NUMBER (bt_lump, buoyancy, "buoyancy", "N", NAN, 0, 1e6, 1, 0, NULL, "net, upward"),
};

static const bt_head heads[] = {
  { "sea", NULL, "the water and its current", sizeof (bt_sea_def), sea_fields,
    COUNT_OF (sea_fields) },
  { "rov", NULL, "a vehicle", sizeof (bt_vehicle_def), vehicle_fields, COUNT_OF (vehicle_fields) },
  { "tether", NULL, "a tether between its anchor and a vehicle", sizeof (bt_tether_def),
    tether_fields, COUNT_OF (tether_fields) },
  { "clump", "tether", "a clump weight on a tether", sizeof (bt_lump), clump_fields,
    COUNT_OF (clump_fields) },
  { "float", "tether", "a float or a buoyant section on a tether", sizeof (bt_lump), float_fields,
    COUNT_OF (float_fields) },
};

const bt_head *
bt_heads (size_t *n)
{
  *n = COUNT_OF (heads);
  return heads;
}

const bt_head *
bt_head_find (const char *name)
{
  for (size_t i = 0; i < COUNT_OF (heads); i++)
    if (name && strcmp (heads[i].name, name) == 0)
      return &heads[i];
  return NULL;
}

const bt_field *
bt_field_find (const bt_head *head, const char *name)
{
  for (size_t i = 0; head && name && i < head->n_fields; i++)
    if (strcmp (head->fields[i].name, name) == 0)
      return &head->fields[i];
  return NULL;
}

static void *
member (const bt_field *field, void *def)
{
  return (char *)def + field->offset;
}

static int
is_numeric (const bt_field *field)
{
  return field->kind == BT_FIELD_NUMBER || field->kind == BT_FIELD_COUNT
         || field->kind == BT_FIELD_WORD;
}

void
bt_def_init (const bt_head *head, void *def)
{
  memset (def, 0, head->size);
  for (size_t i = 0; i < head->n_fields; i++)
    if (is_numeric (&head->fields[i]))
      *(double *)member (&head->fields[i], def) = head->fields[i].fallback;
}

static const char *
lower_bound_word (const bt_field *field)
{
  return field->above_min ? "above" : "at least";
}

static int
is_word_value (const bt_field *field, double value)
{
  for (const bt_word *w = field->words; w && w->word; w++)
    if (w->value == value)
      return 1;
  return 0;
}

static int
in_range (const bt_field *field, double value)
{
  return isfinite (value) && value <= field->max
         && (field->above_min ? value > field->min : value >= field->min);
}

bt_status
bt_def_set_number (const bt_field *field, void *def, double value, bt_error *error)
{
  int whole = field->kind == BT_FIELD_COUNT;
  if (!is_numeric (field))
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take a number", field->name);
  if (field->kind == BT_FIELD_WORD && !is_word_value (field, value))
    return bt__fail (error, BT_ERR_NAME, "`%s' takes a word, not the number %g", field->name,
                     value);
  if (whole && (!in_range (field, value) || value != floor (value)))
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' is a whole number from %g to %g, not %g",
                     field->name, field->min, field->max, value);
  if (!whole && !is_word_value (field, value) && !in_range (field, value))
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' is %s %g and at most %g%s%s, not %g", field->name,
                     lower_bound_word (field), field->min, field->max, *field->unit ? " " : "",
                     field->unit, value);
  *(double *)member (field, def) = value;
  return BT_OK;
}

bt_status
bt_def_set_word (const bt_field *field, void *def, const char *word, bt_error *error)
{
  for (const bt_word *w = field->words; w && w->word; w++)
    if (strcmp (w->word, word) == 0)
      {
        *(double *)member (field, def) = w->value;
        return BT_OK;
      }
  return bt__fail (error, BT_ERR_NAME, "`%s' does not take the word `%s'", field->name, word);
}

bt_status
bt_def_set_point (const bt_field *field, void *def, bt_vec3 v, bt_error *error)
{
  int fits = fabs (v.x) <= field->max && fabs (v.y) <= field->max && fabs (v.z) <= field->max;
  if (field->kind != BT_FIELD_POINT && field->kind != BT_FIELD_END)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take a point", field->name);
  if (!fits) /* false for NaN too */
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' is a point within %g m, not (%g %g %g)",
                     field->name, field->max, v.x, v.y, v.z);
  if (field->kind == BT_FIELD_END)
    *(bt_end *)member (field, def) = (bt_end){ .at = v };
  else
    *(bt_vec3 *)member (field, def) = v;
  return BT_OK;
}

bt_status
bt_def_set_current (const bt_field *field, void *def, const bt_current *value, bt_error *error)
{
  bt_status status;
  if (field->kind != BT_FIELD_CURRENT)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take a current", field->name);
  status = bt_current_check (value, error);
  if (status == BT_OK)
    *(bt_current *)member (field, def) = *value;
  return status;
}

bt_status
bt_def_set_part (const bt_field *field, void *def, const char *part, bt_error *error)
{
  bt_end end = { { 0, 0, 0 }, { 0 } };
  bt_status status;
  if (field->kind != BT_FIELD_END)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take the name of a part", field->name);
  status = bt_def_set_name (end.part, part, error);
  if (status == BT_OK)
    *(bt_end *)member (field, def) = end;
  return status;
}

bt_status
bt_def_set_name (char *name_field, const char *name, bt_error *error)
{
  size_t n = strlen (name);
  if (n == 0 || n >= BT_NAME_SIZE)
    return bt__fail (error, BT_ERR_DEF, "a name has 1 to %d bytes, not %zu", BT_NAME_SIZE - 1, n);
  memset (name_field, 0, BT_NAME_SIZE);
  memcpy (name_field, name, n);
  return BT_OK;
}
