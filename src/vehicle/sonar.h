/* A sonar: a fan of beams, each as far as what it meets first.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_SONAR_H
#define BT_VEHICLE_SONAR_H

#include "collide/ray.h"
#include "vehicle/frame.h"

enum
{
  BT__BEAMS = 120
};

typedef struct bt__sonar
{
  bt_vec3 at;    /* m: of the head, from the centre of gravity, own axes */
  double sector; /* rad: of the fan, in the plane of the own x and y, about ahead */
  double tilt;   /* rad: of that plane about the own x, bow up positive */
  double range;  /* m */
  double noise;  /* m */
  int64_t seed;
} bt__sonar;

/* Write to RANGE the distance of the first echo of each of BEAMS beams, from port to starboard, m;
   INFINITY where nothing comes back.  Without noise good to 1e-9 m (see collide/ray.h).  */
void bt__sonar_sweep (const bt__sonar *sonar, bt_vec3 position, bt__quat attitude, int64_t step,
                      const bt__scene *scene, const bt__switches *on, const bt__mover *mover,
                      uint32_t movers, int beams, double *range, bt__count *count);

#endif
