/* What a pilot can read: pure functions of the truth, the step, a seed and what is broken.

   The same step and seed read the same, so a replay does; noise is Gaussian, drawn from a hash.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_INSTRUMENTS_H
#define BT_VEHICLE_INSTRUMENTS_H

#include <stdint.h>

#include "vehicle/frame.h"

/* What may be broken; faults add up.  */
typedef enum bt__fault
{
  BT__FAULT_COMPASS = 1,   /* drifts by DRIFT since SINCE */
  BT__FAULT_DEPTH = 2,     /* stands still at FROZEN */
  BT__FAULT_SPEED = 4,     /* no bottom lock */
  BT__FAULT_ALTITUDE = 8,  /* no echo */
  BT__FAULT_TENSION = 16,  /* dead cell: zero, with its noise */
  BT__FAULT_TELEMETRY = 32 /* nothing comes up, as when the tether has parted */
} bt__fault;

/* The instruments of a vehicle: flat.  Noises are standard deviations; zero is a perfect one.  */
typedef struct bt__instruments
{
  int64_t seed;
  int64_t faults;        /* sum of bt__fault */
  double drift, since;   /* rad/s, s: of the compass */
  double frozen;         /* m */
  double compass_noise;  /* rad */
  double depth_noise;    /* m */
  double speed_noise;    /* m/s, each component */
  double altitude_noise; /* m */
  double range_noise;    /* m */
  double bearing_noise;  /* rad */
  double tension_noise;  /* N */
  double counter_noise;  /* m */
} bt__instruments;

/* The truth that they look at.  */
typedef struct bt__truth
{
  int64_t step;
  double time;                /* s */
  bt_vec3 position, velocity; /* m, m/s over ground; world */
  bt__quat attitude;
  double turned;      /* rad: the heading that counts turns */
  double turned_from; /* rad: where it began */
  double altitude;    /* m above what is below; NAN: nothing is */
  bt_vec3 ship;       /* m: what range and bearing are to */
  double tension;     /* N at the anchor */
  double payout;      /* m */
} bt__truth;

/* What they show; NAN where they show nothing.  */
typedef struct bt__readings
{
  double heading;          /* rad, 0 to 2 pi */
  double pitch, roll;      /* rad */
  double depth, altitude;  /* m */
  double ahead, aside, up; /* m/s over ground, own axes */
  double turns;            /* by the counted heading, clockwise positive */
  double range, bearing;   /* m; rad clockwise from north, from the vehicle to the ship */
  double tension, payout;  /* N, m: read at the winch, so telemetry is not needed */
} bt__readings;

/* Read all INSTRUMENTS.  */
bt__readings bt__instruments_read (const bt__instruments *instruments, const bt__truth *truth);

/* A standard normal number that follows from SEED, STEP and CHANNEL alone.  */
double bt__noise (int64_t seed, int64_t step, int64_t channel);

#endif
