/* A sonar: a fan of rays (collide/ray.h) over a sector, tilted against the own axes.

   Beam i of n points to sector (i / (n - 1) - 1/2) from ahead.  A beam reads the range of its first
   hit with Gaussian noise, or infinity.  Each beam draws noise from a channel of its own, apart
   from the channels of the other instruments.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "vehicle/instruments.h"
#include "vehicle/sonar.h"

enum
{
  FIRST_CHANNEL = 1000 /* apart from the other instruments' noise */
};

/* The direction of beam I of N, own axes.  */
static bt_vec3
beam (const bt__sonar *sonar, int i, int n)
{
  double angle = n > 1 ? sonar->sector * ((double)i / (n - 1) - 0.5) : 0;
  double ahead = cos (angle);
  return bt__vec (sin (angle), ahead * cos (sonar->tilt), ahead * sin (sonar->tilt));
}

void
bt__sonar_sweep (const bt__sonar *sonar, bt_vec3 position, bt__quat attitude, int64_t step,
                 const bt__scene *scene, const bt__switches *on, const bt__mover *mover,
                 uint32_t movers, int beams, double *range, bt__count *count)
{
  bt__ray ray = { .range = sonar->range };
  ray.from = bt__add (position, bt__turn_out (attitude, sonar->at));
  for (int i = 0; i < beams; i++)
    {
      bt__ray_hit hit;
      ray.direction
          = bt__unit_or (bt__turn_out (attitude, beam (sonar, i, beams)), bt__vec (0, 1, 0));
      range[i] = INFINITY;
      if (!bt__ray_cast (scene, on, mover, movers, &ray, &hit, count))
        continue;
      range[i] = hit.range;
      if (sonar->noise > 0)
        range[i]
            = fmax (0, hit.range + sonar->noise * bt__noise (sonar->seed, step, FIRST_CHANNEL + i));
    }
}
