/* What a pilot can read: instruments with noise and faults, a sonar, a camera.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_INSTRUMENTS_H
#define BIGHT_INSTRUMENTS_H

#include <bight/dive.h>

BT_BEGIN_DECLS

/* What an instructor may break with BT_OP_FAULT; faults add up.  */
typedef enum bt_fault
{
  BT_FAULT_COMPASS = 1,    /* it drifts */
  BT_FAULT_DEPTH = 2,      /* the sensor stands still */
  BT_FAULT_SPEED = 4,      /* no bottom lock */
  BT_FAULT_ALTITUDE = 8,   /* no echo */
  BT_FAULT_TENSION = 16,   /* dead cell: zero, with its noise */
  BT_FAULT_TELEMETRY = 32, /* nothing comes up, as when the tether has parted */
  BT_FAULT_THRUSTER = 64   /* one of them is dead */
} bt_fault;

/* Return the word for FAULT, or NULL.  */
const char *bt_fault_name (bt_fault fault);

/* What the instruments of a vehicle show; NAN where they show nothing.  */
typedef struct bt_readings
{
  double heading;          /* rad, 0 to 2 pi */
  double pitch, roll;      /* rad */
  double depth, altitude;  /* m */
  double ahead, aside, up; /* m/s over ground, own axes */
  double turns;            /* clockwise positive, since the dive began */
  double range, bearing;   /* m; rad clockwise from north, from the vehicle to the ship */
  double tension, payout;  /* N, m: read at the winch, so telemetry is not needed */
} bt_readings;

/* Read the instruments of vehicle I.  The ship is where the anchor of its first tether is.  */
bt_status bt_dive_instruments (const bt_dive *dive, int i, bt_readings *readings, bt_error *error);

/* Write to *ALTITUDE the distance, m, from P straight down to the first surface, bed or obstacle,
   and to *OBSTACLE the number of the obstacle met.  Where no surface is below P, *OBSTACLE is -1
   and the altitude is above the depth of the sea, negative below.  BT_ERR_DOMAIN for a P that is
   not finite.  */
bt_status bt_dive_altitude (const bt_dive *dive, bt_vec3 p, double *altitude, int *obstacle,
                            bt_error *error);

/* Return the faults of vehicle I, a sum of bt_fault, and in *LOST which thrusters are dead, by
   bit.  */
int64_t bt_dive_faults (const bt_dive *dive, int i, int64_t *lost);

/* Write the thrust, N, of each thruster of vehicle I, a vehicle with mass, to THRUST, with room for
   BT_THRUSTERS_MAX, and return the number of thrusters.  */
int bt_dive_thrusts (const bt_dive *dive, int i, double *thrust);

enum
{
  BT_BEAMS_MAX = 1024
};

/* A fan of beams from the bow.  */
typedef struct bt_sonar
{
  double sector; /* rad: in the plane of the vehicle's own x and y, about ahead */
  double tilt;   /* rad: of that plane about the own x, bow up positive */
  double range;  /* m */
  int beams;     /* at most BT_BEAMS_MAX */
  double width;  /* rad: of a beam, a cone, in which lines are heard; 0: lines are not heard */
} bt_sonar;

/* Write to RANGE the distance of the first echo of each beam, from port to starboard, m; INFINITY
   where nothing comes back.  On the axis of a beam echo obstacles, the hulls of other vehicles,
   boxes of their size, and clumps and floats at a point of a tether, balls of their volume.
   Tethers, which a thin beam would miss, echo anywhere in its cone where nothing solid is before
   them, by the nearest point there.  Without noise good to 1e-9 m.  BT_ERR_NAME, BT_ERR_DOMAIN;
   BT_ERR_LIMIT: no memory.  */
bt_status bt_dive_sonar (const bt_dive *dive, int i, const bt_sonar *sonar, double *range,
                         bt_error *error);

/* Write the places, m, reported by N transponders on tether I, equally spaced in arc length, both
   ends included.  Each coordinate has Gaussian noise of SIGMA metres, determined by the seed of the
   vehicle at the far end (else at the anchor, else 1), the step and the number of the transponder.
   BT_ERR_NAME; BT_ERR_DOMAIN unless N is 2 or more and SIGMA 0 or more.  */
bt_status bt_dive_transponders (const bt_dive *dive, int i, int n, double sigma, bt_vec3 *points,
                                bt_error *error);

/* A camera at the bow.  */
typedef struct bt_eye
{
  double width, height; /* rad: whole angles of view */
  double tilt;          /* rad: bow up positive */
  double sight;         /* m: how far one sees */
} bt_eye;

/* How much of a tether a camera sees.  */
typedef struct bt_sighting
{
  double length;  /* m of the tether that are in the picture and not hidden */
  double nearest; /* m to the nearest of it; INFINITY: nothing is seen */
} bt_sighting;

/* Return in *SIGHTING what CAMERA of vehicle I sees of TETHER; obstacles hide what is behind them.
   BT_ERR_NAME, BT_ERR_DOMAIN.  */
bt_status bt_dive_sight (const bt_dive *dive, int i, const bt_eye *camera, int tether,
                         bt_sighting *sighting, bt_error *error);

BT_END_DECLS

#endif
