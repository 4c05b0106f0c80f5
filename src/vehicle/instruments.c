/* Instruments: pure functions of the truth, the step, a seed and the faults (instruments.h).

   Noise is Gaussian by the method of Box and Muller, from a hash of seed, step and channel (the
   finaliser of SplitMix64).  No generator is kept in the state, so a replay of the same steps reads
   the same values, in any order of reading.  Faults: a compass drifts with time, a depth sensor
   shows its frozen value, speed and altitude read NaN, tension reads 0; without telemetry only
   range, bearing, tension and payout, which the ship measures, remain.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "vehicle/instruments.h"

/* Where each draws its noise.  */
enum
{
  COMPASS,
  DEPTH,
  SPEED,
  ALTITUDE = SPEED + 3,
  RANGE,
  BEARING,
  TENSION,
  COUNTER
};

static uint64_t
mixed (uint64_t z)
{
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

/* In (0, 1].  */
static double
part (uint64_t z)
{
  return ((double)(z >> 11) + 1) / 9007199254740992.0;
}

double
bt__noise (int64_t seed, int64_t step, int64_t channel)
{
  uint64_t z = mixed ((uint64_t)seed + 0x9e3779b97f4a7c15u);
  z = mixed (z + (uint64_t)step * 0xd1b54a32d192ed03u);
  z = mixed (z + (uint64_t)channel * 0x8cb92ba72f3d8dd7u);
  double radius = sqrt (-2 * log (part (z)));
  return radius * cos (2 * BT__PI * part (mixed (z + 0x9e3779b97f4a7c15u)));
}

typedef struct reader
{
  const bt__instruments *of;
  const bt__truth *truth;
} reader;

static double
noisy (reader r, double value, double sigma, int channel)
{
  return sigma > 0 ? value + sigma * bt__noise (r.of->seed, r.truth->step, channel) : value;
}

static int
is_broken (reader r, int64_t fault)
{
  return (r.of->faults & fault) != 0;
}

static double
once_round (double angle)
{
  double a = fmod (angle, 2 * BT__PI);
  return a < 0 ? a + 2 * BT__PI : a;
}

static void
read_attitude (reader r, bt_readings *out)
{
  double off = 0;
  if (is_broken (r, BT_FAULT_COMPASS))
    off = r.of->drift * fmax (0, r.truth->time - r.of->since);
  double heading = bt__twist_of (r.truth->attitude) + off;
  out->heading = once_round (noisy (r, heading, r.of->compass_noise, COMPASS));
  out->pitch = bt__pitch_of (r.truth->attitude);
  out->roll = bt__roll_of (r.truth->attitude);
  out->turns = (r.truth->turned - r.truth->turned_from + off) / (2 * BT__PI);
}

static void
read_motion (reader r, bt_readings *out)
{
  bt_vec3 v = bt__turn_in (r.truth->attitude, r.truth->velocity);
  double depth = is_broken (r, BT_FAULT_DEPTH) ? r.of->frozen : -r.truth->position.z;
  out->depth = noisy (r, depth, r.of->depth_noise, DEPTH);
  out->ahead = noisy (r, v.y, r.of->speed_noise, SPEED);
  out->aside = noisy (r, v.x, r.of->speed_noise, SPEED + 1);
  out->up = noisy (r, v.z, r.of->speed_noise, SPEED + 2);
  if (is_broken (r, BT_FAULT_SPEED))
    out->ahead = out->aside = out->up = NAN;
  out->altitude = noisy (r, r.truth->altitude, r.of->altitude_noise, ALTITUDE);
  if (is_broken (r, BT_FAULT_ALTITUDE))
    out->altitude = NAN;
}

static void
read_ship (reader r, bt_readings *out)
{
  bt_vec3 way = bt__sub (r.truth->ship, r.truth->position);
  double bearing = noisy (r, atan2 (way.x, way.y), r.of->bearing_noise, BEARING);
  out->range = fmax (0, noisy (r, bt__norm (way), r.of->range_noise, RANGE));
  out->bearing = once_round (bearing);
}

bt_readings
bt__instruments_read (const bt__instruments *instruments, const bt__truth *truth)
{
  reader r = { instruments, truth };
  bt_readings out;
  read_attitude (r, &out);
  read_motion (r, &out);
  read_ship (r, &out);
  if (is_broken (r, BT_FAULT_TELEMETRY))
    out = (bt_readings){
      NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, out.range, out.bearing, 0, 0
    };
  double tension = is_broken (r, BT_FAULT_TENSION) ? 0 : truth->tension;
  out.tension = noisy (r, tension, instruments->tension_noise, TENSION);
  out.payout = noisy (r, truth->payout, instruments->counter_noise, COUNTER);
  return out;
}
