/* Allocation: the forces of the thrusters that make a wanted wrench.

   The least forces in the sense of squares: the pseudo-inverse B^T (B B^T)^-1, where column k of B
   is the wrench of one newton of thruster k, over the steered axes of a type (T. I. Fossen,
   Handbook of Marine Craft Hydrodynamics and Motion Control, 12.3).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "vehicle/solve.h"
#include "vehicle/type.h"

/* The wrench of one newton of thruster T in the papers' order; yaw is about the axis that points
   down.  */
static void
effect (const bt__thruster *t, double *column)
{
  bt_vec3 m = bt__cross (t->at, t->along);
  column[BT__SURGE] = t->along.y;
  column[BT__SWAY] = t->along.x;
  column[BT__HEAVE] = t->along.z;
  column[BT__ROLL] = m.y;
  column[BT__PITCH] = m.x;
  column[BT__YAW] = -m.z;
}

/* B B^T, and one where an axis is not steered.  */
static void
square_up (const bt__vehicle_type *type, double (*b)[BT__AXES], double (*a)[6])
{
  memset (a, 0, 36 * sizeof (double));
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++)
      if (type->steers[i] && type->steers[j])
        for (int k = 0; k < type->n; k++)
          a[i][j] += b[k][i] * b[k][j];
      else if (i == j)
        a[i][j] = 1;
}

/* A full stick: the thruster that works hardest gives what its stronger way can.  */
static double
full_stick (const bt__vehicle_type *type, const bt__rig *rig, int axis)
{
  double most = 0, share;
  for (int k = 0; k < type->n; k++)
    {
      share = fabs (rig->mix[k][axis]) / fmax (type->thruster[k].ahead, type->thruster[k].astern);
      most = fmax (most, share);
    }
  return most > 0 ? 1 / most : 0;
}

bt_status
bt__rig_make (const bt__vehicle_type *type, bt__rig *rig, bt_error *error)
{
  static const char *const names[] = { "surge", "sway", "heave", "roll", "pitch", "yaw" };
  double b[BT__THRUSTERS_MAX][BT__AXES], a[6][6];
  memset (rig, 0, sizeof *rig);
  for (int k = 0; k < type->n; k++)
    effect (&type->thruster[k], b[k]);
  for (int axis = 0; axis < 6; axis++)
    {
      double x[6] = { 0 };
      if (!type->steers[axis])
        continue;
      x[axis] = 1;
      square_up (type, b, a);
      if (!bt__factor6 (a))
        return bt__fail (error, BT_ERR_DEF, "the thrusters of `%s' cannot command %s alone",
                         type->name, names[axis]);
      bt__substitute6 (a, x);
      for (int k = 0; k < type->n; k++)
        for (int i = 0; i < 6; i++)
          if (type->steers[i])
            rig->mix[k][axis] += b[k][i] * x[i];
      rig->most[axis] = full_stick (type, rig, axis);
    }
  return BT_OK;
}

int
bt__rig_share (const bt__vehicle_type *type, const bt__rig *rig, const double *wrench,
               double *force)
{
  double over = 1;
  int reduced = 0;
  for (int k = 0; k < type->n; k++)
    {
      const bt__thruster *t = &type->thruster[k];
      force[k] = 0;
      for (int i = 0; i < BT__AXES; i++)
        force[k] += rig->mix[k][i] * wrench[i];
      double share = fabs (force[k]) / (t->ahead > t->astern ? t->ahead : t->astern);
      over = share > over ? share : over;
    }
  for (int k = 0; k < type->n; k++)
    {
      const bt__thruster *t = &type->thruster[k];
      double f = force[k] / over;
      force[k] = bt__clamp (f, -t->astern, t->ahead);
      reduced |= over > 1 || force[k] != f;
    }
  return reduced;
}
