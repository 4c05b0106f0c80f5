/* A sonar: a fan of beams, each as far as what it meets first.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_SONAR_H
#define BT_VEHICLE_SONAR_H

#include "collide/ray.h"

enum
{
  BT__BEAMS = 120
};

typedef struct bt__sonar
{
  bt__frame head; /* where it is, and the vehicle's own axes: x to starboard, y ahead, z up */
  double sector;  /* rad: of the fan, in the plane of x and y, about ahead */
  double tilt;    /* rad: of that plane about x, bow up positive */
  double range;   /* m */
  double width;   /* rad: of a beam, a cone, for what is thinner than beams are apart; 0: of none */
  double noise;   /* m */
  int64_t seed;
} bt__sonar;

/* What is solid about a sonar: obstacles, and other bodies, none of them a mesh.  */
typedef struct bt__echoing
{
  const bt__scene *scene;
  const bt__switches *on; /* of SCENE's objects */
  const bt__mover *mover;
  uint32_t movers;
  const bt__obstacle *body;
  int bodies;
} bt__echoing;

/* Write to RANGE the distance of the first solid on the axis of each of BEAMS beams, from port to
   starboard, m; INFINITY where there is none.  Good to 1e-9 m (see collide/ray.h).  */
void bt__sonar_sweep (const bt__sonar *sonar, const bt__echoing *around, int beams, double *range,
                      bt__count *count);

/* Make RANGE less, for each of BEAMS beams, where a thin straight piece of line, LINE, is nearer:
   as far as the nearest point of LINE in the cone of the beam, if nothing solid AROUND is before
   that point.  */
void bt__sonar_hear_line (const bt__sonar *sonar, const bt__echoing *around,
                          const bt__capsule *line, int beams, double *range, bt__count *count);

/* Add to what RANGE holds of each of BEAMS beams the noise of SONAR in step STEP.  */
void bt__sonar_add_noise (const bt__sonar *sonar, int64_t step, int beams, double *range);

#endif
