/* Vehicles of a world: from the fields of a definition to the type used by the step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "model/compile.h"

/* ---- Types that come with the engine ---- */

const char *
bt_vehicle_type_name (int i)
{
  return bt__vehicle_type_name (i);
}

const char *
bt_vehicle_type_text (int i)
{
  return bt__vehicle_type_text (i);
}

static bt_six
six_of (const double *axis)
{
  return (bt_six){ { axis[BT__SURGE], axis[BT__SWAY], axis[BT__HEAVE] },
                   { axis[BT__ROLL], axis[BT__PITCH], axis[BT__YAW] } };
}

static bt_thruster_def
thruster_def (const bt__thruster *t)
{
  return (bt_thruster_def){ t->at, t->along, (double)t->map, t->ahead, t->astern, t->dead, t->lag };
}

bt_status
bt_def_set_vehicle_type (bt_vehicle_def *def, const char *name, bt_error *error)
{
  bt__vehicle_type type;
  double steers[BT__AXES];
  bt_status status = bt__vehicle_type_find (name, &type, error);
  if (status != BT_OK)
    return status;
  for (int i = 0; i < BT__AXES; i++)
    steers[i] = (double)type.steers[i];
  def->size = type.size;
  def->mass = type.mass;
  def->volume = type.volume;
  def->inertia = type.inertia;
  def->buoyancy = type.buoyancy;
  def->attached = type.attached;
  def->added = six_of (type.hydro.added);
  def->linear = six_of (type.hydro.linear);
  def->quadratic = six_of (type.hydro.quadratic);
  def->munk = type.hydro.munk;
  def->steers = six_of (steers);
  def->volts = type.volts;
  def->n_thrusters = (double)type.n;
  for (int i = 0; i < type.n; i++)
    def->thrusters[i] = thruster_def (&type.thruster[i]);
  return BT_OK;
}

/* ---- From what is given to what is stepped ---- */

static void
axes_of (const bt_six *six, double *axis)
{
  memcpy (axis,
          (double[BT__AXES]){ six->along.x, six->along.y, six->along.z, six->about.x, six->about.y,
                              six->about.z },
          BT__AXES * sizeof *axis);
}

static double
any_of (const bt_six *six)
{
  return six->along.x + six->along.y + six->along.z + six->about.x + six->about.y + six->about.z;
}

/* That of a solid box; of one 0.4 m wide where there is no size.  */
static bt_vec3
box_inertia (const bt_vehicle_def *def)
{
  bt_vec3 s = bt__norm (def->size) > 0 ? def->size : bt__vec (0.4, 0.4, 0.4);
  double k = def->mass / 12;
  return bt__vec (k * (s.x * s.x + s.z * s.z), k * (s.y * s.y + s.z * s.z),
                  k * (s.x * s.x + s.y * s.y));
}

static bt__thruster
thruster_of (const bt_thruster_def *def)
{
  bt__thruster t = { .at = def->at,
                     .along = bt__unit_or (def->along, def->along),
                     .map = (int64_t)def->map,
                     .ahead = def->ahead,
                     .astern = def->astern > 0 ? def->astern : def->ahead,
                     .dead = def->dead,
                     .lag = def->lag };
  return t;
}

/* Nothing that is asked for commands each axis that can be: first those that matter most.  */
static void
find_steered (bt__vehicle_type *type)
{
  static const int order[BT__AXES]
      = { BT__SURGE, BT__YAW, BT__HEAVE, BT__SWAY, BT__ROLL, BT__PITCH };
  bt__rig rig;
  bt_error error;
  for (int k = 0; k < BT__AXES; k++)
    {
      type->steers[order[k]] = 1;
      type->steers[order[k]] = bt__rig_make (type, &rig, &error) == BT_OK;
    }
}

static void
fill_type (const bt_vehicle_def *def, bt__vehicle_type *type)
{
  double steers[BT__AXES];
  memset (type, 0, sizeof *type);
  memcpy (type->name, def->name, sizeof type->name - 1);
  type->mass = def->mass;
  type->volume = def->volume;
  type->inertia = bt__norm (def->inertia) > 0 ? def->inertia : box_inertia (def);
  type->buoyancy = def->buoyancy;
  type->size = def->size;
  type->attached = def->attached;
  axes_of (&def->added, type->hydro.added);
  axes_of (&def->linear, type->hydro.linear);
  axes_of (&def->quadratic, type->hydro.quadratic);
  axes_of (&def->steers, steers);
  type->hydro.munk = def->munk;
  type->volts = def->volts;
  type->n = (int64_t)def->n_thrusters;
  for (int i = 0; i < type->n; i++)
    type->thruster[i] = thruster_of (&def->thrusters[i]);
  for (int i = 0; i < BT__AXES; i++)
    type->steers[i] = steers[i] != 0;
}

/* What a vehicle without mass would be as a dead weight: 20 kg that neither floats nor sinks.  */
static bt_vehicle_def
dead_body (const bt_vehicle_def *def, double density)
{
  bt_vehicle_def dead = *def;
  bt_vec3 one = { 1, 1, 1 };
  dead.mass = 20;
  dead.volume = dead.mass / density;
  dead.added = (bt_six){ bt__scale (20, one), one };
  dead.linear = (bt_six){ bt__scale (60, one), bt__scale (5, one) };
  dead.quadratic = (bt_six){ bt__scale (100, one), bt__scale (5, one) };
  dead.attached = bt__vec (0, 0, 0);
  dead.n_thrusters = 0;
  return dead;
}

static bt_status
check_thrusters (bt_vehicle_def *def, bt_error *error)
{
  bt_status status = BT_OK;
  if (!(def->n_thrusters >= 0 && def->n_thrusters <= BT_THRUSTERS_MAX))
    return bt__fail (error, BT_ERR_LIMIT, "a vehicle has at most %d thrusters", BT_THRUSTERS_MAX);
  for (int i = 0; i < def->n_thrusters && status == BT_OK; i++)
    {
      bt_thruster_def *t = &def->thrusters[i];
      status = bt__check_def (bt_head_find ("thruster"), "", t, error);
      if (status == BT_OK && !(bt__norm (t->along) > 0))
        status = bt__fail (error, BT_ERR_DEF, "a thruster of rov `%s' needs its (along ...)",
                           def->name);
    }
  return status;
}

#define MOST_DISPLACED 800.0 /* times its own mass, of water: no vehicle is lighter than air */

static bt_status
check_volume (const bt_vehicle_def *def, double density, bt_error *error)
{
  double most = MOST_DISPLACED * def->mass / density;
  if (def->volume <= most)
    return BT_OK;
  return bt__fail (
      error, BT_ERR_DOMAIN,
      "`volume' of rov `%s' is %g m3; with its mass of %g kg it has at most %.3g: more, "
      "and it is lighter than air",
      def->name, def->volume, def->mass, most);
}

bt_status
bt__compile_vehicle (bt_vehicle_def *def, double density, bt__vehicle_type *type, bt__rig *rig,
                     bt_error *error)
{
  bt_error inner;
  bt_status status;
  memset (type, 0, sizeof *type);
  if (isnan (def->volume))
    def->volume = def->mass / density;
  status = check_thrusters (def, error);
  if (status != BT_OK)
    return status;
  if (def->mass == 0)
    {
      bt_vehicle_def dead = dead_body (def, density);
      fill_type (&dead, type);
      return BT_OK;
    }
  status = check_volume (def, density, error);
  if (status != BT_OK)
    return status;
  fill_type (def, type);
  status = bt__vehicle_type_check (type, &inner);
  if (status == BT_OK && any_of (&def->steers) == 0)
    find_steered (type);
  if (status == BT_OK)
    status = bt__rig_make (type, rig, &inner);
  return status == BT_OK ? BT_OK : bt__about ("rov", def->name, error, &inner);
}

bt_vec3
bt__attached_at (const bt_vehicle_def *def)
{
  double degree = BT__PI / 180;
  bt__quat q = bt__quat_of (degree * def->heading, degree * def->pitch, degree * def->roll);
  return def->mass > 0 ? bt__add (def->at, bt__turn_out (q, def->attached)) : def->at;
}
