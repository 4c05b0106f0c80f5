/* Tethers that come with the engine, and the figures of each.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include <bight/model.h>

#include "base/error.h"

/* The figures of a type.  Of mass and wet weight one may be NAN: it follows from the other.  */
typedef struct tether_type
{
  const char *name, *text;
  double diameter, mass, wet_weight; /* m, kg/m in air, N/m in the sea */
  double ea, breaking_load;          /* N */
  double min_bend_radius;            /* m */
  double cdn;                        /* drag across */
} tether_type;

/* Of all of them.  */
#define DRAG_ALONG 0.01
#define ADDED_MASS 1.0
#define FRICTION 0.3

static const tether_type types[] = {
  { "fathom",
    "Blue Robotics Fathom R2: 7.6 mm, floats a little in the sea; stiffness, friction, bend "
    "estimates.",
    0.0076, 0.043, NAN, 1e5, 1557, 0.05, 1.2 },
  { "fathom-slim", "Blue Robotics Fathom Slim: 4 mm, one pair; all but the diameter estimates.",
    0.004, 0.014, NAN, 5e4, 785, 0.03, 1.2 },
  { "falcon", "Seaeye Falcon umbilical: 14.5 mm, neutral; estimates throughout.", 0.0145, NAN, 0,
    2e5, 5000, 0.1, 1.2 },
  { "cat5e", "Direct-burial network cable: 0.0285 N/m weighed in the sea; the rest estimates.",
    0.006, NAN, 0.0285, 5e4, 200, 0.04, 1.2 },
  { "work-umbilical",
    "Armoured umbilical of a work-class vehicle: 30 mm, 2.5 kg/m; estimates from typical ranges.",
    0.030, 2.5, NAN, 1e7, 250000, 0.5, 1.5 },
  { "leaded-rope",
    "Leaded rope, cable 6 of the Toulon experiments (Filliung 2024), fitted; strength, stiffness "
    "estimates.",
    0.0035, 0.0517, 0.40, 5e4, 1000, 0.02, 1.3 },
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

bt_status
bt_def_set_tether_type (bt_tether_def *def, const char *name, bt_error *error)
{
  int i = 0;
  while (i < TYPES && strcmp (types[i].name, name) != 0)
    i++;
  if (i == TYPES)
    return bt__fail (error, BT_ERR_NAME,
                     "no tether type is called `%.60s'; there are %s, %s, %s, %s, %s, %s", name,
                     types[0].name, types[1].name, types[2].name, types[3].name, types[4].name,
                     types[5].name);
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
  return BT_OK;
}
