/* Tethers that come with the engine, and the figures of each.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include <bight/model.h>

#include "base/error.h"

/* The figures of a type.  Of mass and wet weight one may be NAN: it follows from the other.  An EI
   of 0 is no figure.  PUBLISHED, MEASURED and FITTED list the fields that a source tells; all other
   figures are assumed.  */
typedef struct tether_type
{
  const char *name, *text;
  double diameter, mass, wet_weight; /* m, kg/m in air, N/m in the sea */
  double ea, breaking_load;          /* N */
  double min_bend_radius;            /* m */
  double cdn;                        /* drag across */
  double ei;                         /* N m2 */
  const char *published, *measured, *fitted;
} tether_type;

/* Of all of them.  */
#define DRAG_ALONG 0.01
#define ADDED_MASS 1.0
#define FRICTION 0.3

/* Every text says where the figures come from, as the lists behind it do for programs.  One source
   tells a bending stiffness; none tells a bending damping or a friction.  */
#define UNBENT " No figure of bending: ei and bending-damping are 0."

static const tether_type types[] = {
  { "fathom",
    "Blue Robotics Fathom R2, floats a little in the sea. Published (docs.bluerobotics.com): "
    "diameter, mass, breaking load. Assumed: ea, min-bend-radius, drag, friction." UNBENT,
    0.0076, 0.043, NAN, 1e5, 1557, 0.05, 1.2, 0, "diameter mass breaking-load", "", "" },
  { "fathom-slim",
    "Blue Robotics Fathom Slim, one pair. Published: diameter. Assumed: all the rest." UNBENT,
    0.004, 0.014, NAN, 5e4, 785, 0.03, 1.2, 0, "diameter", "", "" },
  { "falcon", "Like a Seaeye Falcon umbilical, neutral. Assumed: all of it." UNBENT, 0.0145, NAN, 0,
    2e5, 5000, 0.1, 1.2, 0, "", "", "" },
  { "cat5e",
    "Direct-burial network cable. Measured: the weight of 200 ft in the sea "
    "(submarineboat.com). Assumed: all the rest." UNBENT,
    0.006, NAN, 0.0285, 5e4, 200, 0.04, 1.2, 0, "", "wet-weight", "" },
  { "work-umbilical",
    "Like the armoured umbilical of a work-class vehicle. Assumed, from typical ranges: all of "
    "it." UNBENT,
    0.030, 2.5, NAN, 1e7, 250000, 0.5, 1.5, 0, "", "", "" },
  { "leaded-rope",
    "Leaded rope, cable 6 of the Toulon experiments (Filliung 2024). Measured: diameter, mass, "
    "wet-weight. Fitted to a run: cdn. Assumed: ea, breaking-load, min-bend-radius, "
    "friction." UNBENT,
    0.0035, 0.0517, 0.40, 5e4, 1000, 0.02, 1.3, 0, "", "diameter mass wet-weight", "cdn" },
  { "flexible-jumper",
    "A flooded flexible jumper (Lowe and Langley, OMAE 2006). Published: diameter, mass, ea, ei, "
    "cdn, ca. Assumed: breaking-load, min-bend-radius, cdt, friction. No figure of the damping of "
    "bending: bending-damping is 0.",
    0.396, 165, NAN, 5e8, 5e6, 4, 1, 120.8e3, "diameter mass ea ei cdn ca", "", "" },
};

enum
{
  TYPES = sizeof types / sizeof *types
};

const char *
bt_tether_type_name (int i)
{
  return i >= 0 && i < TYPES ? types[i].name : NULL;
}

const char *
bt_tether_type_text (int i)
{
  return i >= 0 && i < TYPES ? types[i].text : NULL;
}

/* True if NAME is one of the words of LIST.  */
static int
is_word_of (const char *list, const char *name)
{
  size_t n = strlen (name);
  for (const char *at = list; (at = strstr (at, name)); at += n)
    if ((at == list || at[-1] == ' ') && (at[n] == ' ' || !at[n]))
      return 1;
  return 0;
}

const char *
bt_tether_type_origin (int i, const char *field)
{
  if (!(i >= 0 && i < TYPES))
    return NULL;
  return is_word_of (types[i].published, field)  ? "published"
         : is_word_of (types[i].measured, field) ? "measured"
         : is_word_of (types[i].fitted, field)   ? "fitted"
                                                 : "assumed";
}

bt_status
bt_def_set_tether_type (bt_tether_def *def, const char *name, bt_error *error)
{
  int i = 0;
  while (i < TYPES && strcmp (types[i].name, name) != 0)
    i++;
  if (i == TYPES)
    return bt__fail (error, BT_ERR_NAME,
                     "no tether type is called `%.60s'; there are %s, %s, %s, %s, %s, %s, %s", name,
                     types[0].name, types[1].name, types[2].name, types[3].name, types[4].name,
                     types[5].name, types[6].name);
  bt_tether_props *p = &def->props;
  p->diameter = types[i].diameter;
  p->mass = types[i].mass;
  p->wet_weight = types[i].wet_weight;
  p->ea = types[i].ea;
  p->breaking_load = types[i].breaking_load;
  p->min_bend_radius = types[i].min_bend_radius;
  p->cdn = types[i].cdn;
  p->cdt = DRAG_ALONG;
  p->ca = ADDED_MASS;
  p->friction = FRICTION;
  if (types[i].ei > 0)
    p->ei = types[i].ei;
  return BT_OK;
}
