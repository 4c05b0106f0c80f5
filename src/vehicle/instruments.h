/* Readings of a pilot: pure functions of the truth, the step, a seed and the faults.

   Equal steps and seeds give equal readings, so a replay does; noise is Gaussian, drawn from a
   hash.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_INSTRUMENTS_H
#define BT_VEHICLE_INSTRUMENTS_H

#include <stdint.h>

#include <bight/instruments.h>

#include "base/record.h"
#include "vehicle/frame.h"

/* The instruments of a vehicle: flat.  Noises are standard deviations; zero is a perfect one.  */
typedef struct bt__instruments
{
  int64_t seed;
  int64_t faults;        /* sum of bt_fault */
  double drift, since;   /* rad/s, s: of the compass */
  double frozen;         /* m: what a broken depth sensor shows */
  double compass_noise;  /* rad */
  double depth_noise;    /* m */
  double speed_noise;    /* m/s, each component */
  double altitude_noise; /* m */
  double range_noise;    /* m */
  double bearing_noise;  /* rad */
  double tension_noise;  /* N */
  double counter_noise;  /* m */
} bt__instruments;

extern const bt__record bt__instruments_record;

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

/* Read all INSTRUMENTS.  */
bt_readings bt__instruments_read (const bt__instruments *instruments, const bt__truth *truth);

/* A standard normal number that follows from SEED, STEP and CHANNEL alone.  */
double bt__noise (int64_t seed, int64_t step, int64_t channel);

#endif
