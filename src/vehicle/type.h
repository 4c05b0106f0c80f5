/* A vehicle type: masses, drag and thrusters, as plain data.

   Forces and moments come in sixes, along and about the body's own axes at its centre of gravity: x
   to starboard, y ahead, z up.  The table gives them as the papers do, in the order surge, sway,
   heave, roll, pitch, yaw.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_TYPE_H
#define BT_VEHICLE_TYPE_H

#include <stdint.h>

#include <bight/model.h>
#include <bight/status.h>
#include <bight/vec.h>

enum
{
  BT__THRUSTERS_MAX = BT_THRUSTERS_MAX
};

/* Degrees of freedom in the papers' order.  */
typedef enum bt__freedom
{
  BT__SURGE, /* ahead */
  BT__SWAY,  /* to starboard */
  BT__HEAVE, /* up */
  BT__ROLL,  /* starboard down */
  BT__PITCH, /* bow up */
  BT__YAW,   /* clockwise */
  BT__AXES
} bt__freedom;

typedef struct bt__thruster
{
  bt_vec3 at, along; /* m from the centre of gravity; unit, of the thrust at a positive command */
  int64_t map;       /* bt_thrust_map */
  double ahead, astern; /* N: the most either way, both positive */
  double dead;          /* of the command: within it nothing turns */
  double lag;           /* s: time constant, 0 for none */
} bt__thruster;

/* What the water does to a body.  Added mass and drag in the papers' order.  */
typedef struct bt__hydro
{
  double added[BT__AXES];     /* kg, kg m2: the diagonal, positive */
  double linear[BT__AXES];    /* N s/m, N m s */
  double quadratic[BT__AXES]; /* N s2/m2, N m s2 */
  double munk; /* share of the couple of a slender body in oblique flow that is kept */
} bt__hydro;

typedef struct bt__vehicle_type
{
  char name[32];
  double mass;      /* kg */
  double volume;    /* m3 of water displaced */
  bt_vec3 inertia;  /* kg m2: roll, pitch, yaw, about the centre of gravity */
  bt_vec3 buoyancy; /* m: the centre of buoyancy from the centre of gravity */
  bt_vec3 size;     /* m: of the hull along its own x, y, z */
  bt_vec3 attached; /* m: where the tether is made fast, from the centre of gravity */
  bt__hydro hydro;
  double volts;             /* of the battery, for the map */
  int64_t steers[BT__AXES]; /* true: the thrusters command this axis */
  int64_t n;
  bt__thruster thruster[BT__THRUSTERS_MAX];
} bt__vehicle_type;

/* Return the type called NAME in *TYPE: `bluerov2-heavy', `bluerov2-heavy-wu', `bluerov2',
   `falcon', `work-class'.  BT_ERR_NAME lists them.  */
bt_status bt__vehicle_type_find (const char *name, bt__vehicle_type *type, bt_error *error);

/* Return the name of the I-th type of the table, and where it comes from; NULL beyond the last.  */
const char *bt__vehicle_type_name (int i);
const char *bt__vehicle_type_text (int i);

/* Check TYPE: finite, masses and inertias positive, drag not negative, unit directions.
   BT_ERR_DOMAIN names the field.  */
bt_status bt__vehicle_type_check (const bt__vehicle_type *type, bt_error *error);

/* ---- Thrusters ---- */

/* Force of THRUSTER at COMMAND (-1 to 1, clipped) and VOLTS, N.  */
double bt__thruster_force (const bt__thruster *thruster, double volts, double command);

/* The command that gives FORCE at VOLTS, or the nearest it can.  */
double bt__thruster_command (const bt__thruster *thruster, double volts, double force);

/* The force at VOLTS of the command for FORCE at VOLTS, N, without the command: the nearest to
   FORCE that a thruster without a dead band can give.  */
double bt__thruster_nearest (const bt__thruster *thruster, double volts, double force);

/* ---- What sticks and autopilots command ---- */

/* The thrusters of a type as one: made once.  */
typedef struct bt__rig
{
  double mix[BT__THRUSTERS_MAX][BT__AXES]; /* N of each per N or N m of each axis */
  double most[BT__AXES];                   /* N, N m: what a full stick asks for */
} bt__rig;

/* Make *RIG: the pseudo-inverse over the axes that TYPE steers.  BT_ERR_DEF when its thrusters
   cannot command one of them alone.  */
bt_status bt__rig_make (const bt__vehicle_type *type, bt__rig *rig, bt_error *error);

/* Put into FORCE the forces for WRENCH (in the papers' order).  All forces are reduced alike if a
   thruster would exceed its stronger direction, then each is cut to the limit of its direction.
   Return true if a force was reduced.  */
int bt__rig_share (const bt__vehicle_type *type, const bt__rig *rig, const double *wrench,
                   double *force);

#endif
