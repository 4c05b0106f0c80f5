/* The table of vehicle types, each from one source and never mixed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "vehicle/type.h"

#define HALF 0.70710678118654752 /* sin 45 deg */

/* A T200 at 16 V: 5.245 and 4.070 kgf (Blue Robotics' charts), at X, Y, Z along A, B, C.  The lag
   is the slow pole of von Benzon's third-order fit, (6136 s + 108700) / (s3 + 89 s2 + 9258 s +
   108700).
 */
#define T200(x, y, z, a, b, c)                                                                     \
  {                                                                                                \
    { x, y, z }, { a, b, c }, BT_MAP_T200, 51.436, 39.908, 0, 0.078                                \
  }

/* The four level thrusters of both BlueROV2, at the height Z: front ones push ahead and inward,
   rear ones astern and inward.  */
#define BLUEROV2_LEVEL(z)                                                                          \
  T200 (0.111, 0.156, z, -HALF, HALF, 0), T200 (-0.111, 0.156, z, HALF, HALF, 0),                  \
      T200 (0.111, -0.156, z, -HALF, -HALF, 0), T200 (-0.111, -0.156, z, HALF, -HALF, 0)

#define BLUEROV2_HEAVY_THRUSTERS                                                                   \
  {                                                                                                \
    BLUEROV2_LEVEL (-0.085), T200 (0.218, 0.12, 0, 0, 0, 1), T200 (-0.218, 0.12, 0, 0, 0, 1),      \
        T200 (0.218, -0.12, 0, 0, 0, 1), T200 (-0.218, -0.12, 0, 0, 0, 1)                          \
  }

/* Estimated from the maker's pull, 42, 25 and 13 kgf ahead, aside and up: four thrusters at
   atan (25/42) from ahead share the first two.  */
#define FALCON_LEVEL(x, y, a, b)                                                                   \
  {                                                                                                \
    { x, y, 0 }, { a * 0.51148, b * 0.85929, 0 }, BT_MAP_SQUARE, 119.8, 119.8, 0.03, 0.1           \
  }

/* Places and directions of the RexROV of the UUV Simulator, which carries Berg's vehicle; 4 kN
   ahead is a work-class vehicle's usual pull, not read in a source.  Lag 0.05 s as there.  */
#define WORK_UPPER(sx, sy)                                                                         \
  {                                                                                                \
    { sx * 0.334385, sy * 0.890895, 0.528822 }, { -sx * 0.213588, -sy * 0.159732, 0.963742 },      \
        BT_MAP_SQUARE, 1414, 1414, 0.02, 0.05                                                      \
  }
#define WORK_LEVEL(sx, sy)                                                                         \
  {                                                                                                \
    { sx * 0.505415, sy * 0.412125, 0.129 }, { sx * HALF, -sy * HALF, 0 }, BT_MAP_SQUARE, 1414,    \
        1414, 0.02, 0.05                                                                           \
  }

static const bt__vehicle_type types[] = {
  /* M. von Benzon, F. F. Sorensen, E. Uth, J. Jouffroy, J. Liniger, S. Pedersen: An open-source
     benchmark simulator: control of a BlueROV2 underwater robot, J. Mar. Sci. Eng. 10 (2022) 1898.
     The tether leaves at the stern (estimate).  */
  { .name = "bluerov2-heavy",
    .mass = 13.5,
    .volume = 0.0134,
    .inertia = { 0.26, 0.23, 0.37 },
    .buoyancy = { 0, 0, 0.01 },
    .size = { 0.575, 0.457, 0.254 },
    .attached = { 0, -0.22, 0 },
    .hydro = { .added = { 6.36, 7.12, 18.68, 0.189, 0.135, 0.222 },
               .linear = { 13.7, 0, 33, 0, 0.8, 0 },
               .quadratic = { 141, 217, 190, 1.19, 0.47, 1.5 },
               .munk = 1 },
    .volts = 16,
    .steers = { 1, 1, 1, 1, 1, 1 },
    .n = 8,
    .thruster = BLUEROV2_HEAVY_THRUSTERS },
  /* C.-J. Wu: 6-DoF modelling and control of a remotely operated vehicle, Flinders University
     (2018): weight 112.8 N and buoyancy 114.8 N.  Its drag gives 2.6 m/s, far above what the maker
     names: here for comparison with other work.  */
  { .name = "bluerov2-heavy-wu",
    .mass = 11.5,
    .volume = 0.01142,
    .inertia = { 0.16, 0.16, 0.16 },
    .buoyancy = { 0, 0, 0.02 },
    .size = { 0.575, 0.457, 0.254 },
    .attached = { 0, -0.22, 0 },
    .hydro = { .added = { 5.5, 12.7, 14.57, 0.12, 0.12, 0.12 },
               .linear = { 4.03, 6.22, 5.18, 0.07, 0.07, 0.07 },
               .quadratic = { 18.18, 21.66, 36.99, 1.55, 1.55, 1.55 },
               .munk = 1 },
    .volts = 16,
    .steers = { 1, 1, 1, 1, 1, 1 },
    .n = 8,
    .thruster = BLUEROV2_HEAVY_THRUSTERS },
  /* Six thrusters.  Linear and quadratic drag in surge, sway and heave: Li (2020), read in a later
     simulator.  Mass, inertia, added mass and angular drag as Wu's, the displacement to float by 2
     N: estimates.  The thrusters cannot hold the pitch, so the level thrusters are placed at the
     height of the centre of gravity, and Munk's couple is left out, as in separated flow:
     estimates.  */
  { .name = "bluerov2",
    .mass = 11.5,
    .volume = 0.01142,
    .inertia = { 0.16, 0.16, 0.16 },
    .buoyancy = { 0, 0, 0.02 },
    .size = { 0.338, 0.457, 0.254 },
    .attached = { 0, -0.22, 0 },
    .hydro = { .added = { 5.5, 12.7, 14.57, 0.12, 0.12, 0.12 },
               .linear = { 1.31, 9.14, 2.015, 0.07, 0.07, 0.07 },
               .quadratic = { 38.17, 129.6, 243.2, 1.55, 1.55, 1.55 },
               .munk = 0 },
    .volts = 16,
    .steers = { 1, 1, 1, 1, 0, 1 },
    .n = 6,
    .thruster = { BLUEROV2_LEVEL (0), T200 (0.111, 0, 0, 0, 0, 1), T200 (-0.111, 0, 0, 0, 0, 1) } },
  /* Saab Seaeye Falcon.  Mass and pull are the maker's; surge drag follows from 412 N at 3 knots;
     everything else is an estimate from the size of the hull.  */
  { .name = "falcon",
    .mass = 60,
    .volume = 0.0587,
    .inertia = { 4, 6, 7 },
    .buoyancy = { 0, 0, 0.1 },
    .size = { 0.6, 1.0, 0.5 },
    .attached = { 0, -0.45, 0.1 },
    .hydro = { .added = { 40, 60, 90, 3, 5, 5 },
               .linear = { 0, 0, 0, 5, 5, 5 },
               .quadratic = { 173, 300, 400, 20, 30, 30 },
               .munk = 0 },
    .volts = 0,
    .steers = { 1, 1, 1, 0, 0, 1 },
    .n = 5,
    .thruster = { FALCON_LEVEL (0.25, 0.4, -1, 1),
                  FALCON_LEVEL (-0.25, 0.4, 1, 1),
                  FALCON_LEVEL (0.25, -0.4, -1, -1),
                  FALCON_LEVEL (-0.25, -0.4, 1, -1),
                  { { 0, 0, 0 }, { 0, 0, 1 }, BT_MAP_SQUARE, 127.5, 127.5, 0.03, 0.1 } } },
  /* V. Berg: Development and commissioning of a DP system for ROV SF 30k, NTNU (2012), as carried
     by the RexROV of M. M. M. Manhaes et al.: UUV Simulator, OCEANS 2016.  */
  { .name = "work-class",
    .mass = 1862.87,
    .volume = 1.83826,
    .inertia = { 525.39, 794.20, 691.23 },
    .buoyancy = { 0, 0, 0.3 },
    .size = { 1.5, 2.6, 1.6 },
    .attached = { 0, 0, 0.8 },
    .hydro = { .added = { 779.79, 1222, 3659.9, 534.9, 842.69, 224.32 },
               .linear = { 74.82, 69.48, 728.4, 268.8, 309.77, 105 },
               .quadratic = { 748.22, 992.53, 1821.01, 672, 774.44, 523.27 },
               .munk = 1 },
    .volts = 0,
    .steers = { 1, 1, 1, 1, 1, 1 },
    .n = 8,
    .thruster = { WORK_UPPER (-1, -1), WORK_UPPER (1, -1), WORK_UPPER (-1, 1), WORK_UPPER (1, 1),
                  WORK_LEVEL (-1, -1), WORK_LEVEL (1, -1), WORK_LEVEL (-1, 1), WORK_LEVEL (1, 1) } }
};

enum
{
  TYPES = sizeof types / sizeof *types
};

static const char *const texts[TYPES] = {
  "BlueROV2 Heavy, 16 V (von Benzon et al. 2022); where the tether leaves is an estimate.",
  "BlueROV2 Heavy by another set (Wu 2018): its drag is far too low; for comparison.",
  "BlueROV2 of six thrusters: drag Li 2020; mass, added mass, angular drag as Wu's: estimates.",
  "Seaeye Falcon: mass, pull and surge drag the maker's; all else estimates from its size.",
  "Work-class, SF 30k (Berg 2012; RexROV); 4 kN ahead, the usual pull, is an estimate.",
};

const char *
bt__vehicle_type_text (int i)
{
  return i >= 0 && i < TYPES ? texts[i] : NULL;
}

const char *
bt__vehicle_type_name (int i)
{
  return i >= 0 && i < TYPES ? types[i].name : NULL;
}

bt_status
bt__vehicle_type_find (const char *name, bt__vehicle_type *type, bt_error *error)
{
  for (int i = 0; i < TYPES; i++)
    if (strcmp (types[i].name, name) == 0)
      {
        *type = types[i];
        return BT_OK;
      }
  return bt__fail (error, BT_ERR_NAME,
                   "no vehicle type is called `%.60s'; there are %s, %s, %s, %s, %s", name,
                   types[0].name, types[1].name, types[2].name, types[3].name, types[4].name);
}

/* ---- Checks ---- */

static bt_status
check_value (int fine, const char *what, double value, bt_error *error)
{
  if (fine && isfinite (value))
    return BT_OK;
  return bt__fail (error, BT_ERR_DOMAIN, "a vehicle type with %s of %g", what, value);
}

static bt_status
check_hydro (const bt__hydro *hydro, bt_error *error)
{
  bt_status status = check_value (hydro->munk >= 0 && hydro->munk <= 1, "a share of Munk's couple",
                                  hydro->munk, error);
  for (int k = 0; k < BT__AXES && status == BT_OK; k++)
    {
      status = check_value (hydro->added[k] >= 0, "an added mass", hydro->added[k], error);
      if (status == BT_OK)
        status = check_value (hydro->linear[k] >= 0, "a linear drag", hydro->linear[k], error);
      if (status == BT_OK)
        status = check_value (hydro->quadratic[k] >= 0, "a quadratic drag", hydro->quadratic[k],
                              error);
    }
  return status;
}

static bt_status
check_thruster (const bt__thruster *t, bt_error *error)
{
  bt_status status = check_value (fabs (bt__norm (t->along) - 1) < 1e-4,
                                  "a thruster's direction of length", bt__norm (t->along), error);
  if (status == BT_OK)
    status = check_value (t->ahead > 0, "a thruster's force ahead", t->ahead, error);
  if (status == BT_OK)
    status = check_value (t->astern > 0, "a thruster's force astern", t->astern, error);
  if (status == BT_OK)
    status = check_value (t->lag >= 0, "a thruster's lag", t->lag, error);
  if (status == BT_OK)
    status = check_value (bt__norm (t->at) < 100, "a thruster's distance", bt__norm (t->at), error);
  return status;
}

bt_status
bt__vehicle_type_check (const bt__vehicle_type *type, bt_error *error)
{
  bt_vec3 j = type->inertia;
  bt_status status = check_value (type->mass > 0, "a mass", type->mass, error);
  if (status == BT_OK)
    status = check_value (type->volume >= 0, "a volume", type->volume, error);
  if (status == BT_OK)
    status = check_value (j.x > 0 && j.y > 0 && j.z > 0, "a least inertia",
                          fmin (j.x, fmin (j.y, j.z)), error);
  if (status == BT_OK)
    status = check_value (bt__norm (type->attached) < 100, "its tether made fast at a distance",
                          bt__norm (type->attached), error);
  if (status == BT_OK)
    status = check_hydro (&type->hydro, error);
  if (status == BT_OK)
    status = check_value (type->n >= 0 && type->n <= BT__THRUSTERS_MAX, "a number of thrusters",
                          (double)type->n, error);
  for (int i = 0; i < type->n && status == BT_OK; i++)
    status = check_thruster (&type->thruster[i], error);
  return status;
}
