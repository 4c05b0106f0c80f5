/* One moving line by itself: see rig.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "testbed/rig.h"

void
rig_open (rig *r, bt_tether_props line, double density, int n, const bt_vec3 *shape, int m,
          double length)
{
  *r = (rig){ .line = line };
  r->d = malloc (bt__dynamic_size (RIG_MAX));
  r->work = bt__dynamic_work_new (RIG_MAX);
  r->water = (bt_water){ density, 9.81, 1000, 0, &r->current, NULL, NULL, NULL };
  r->in = (bt__dynamic_input){ .line = &r->line, .water = &r->water, .tolerance = 1e-9 };
  r->in.end[0].at = shape[0];
  r->in.end[1].at = shape[m - 1];
  r->good = r->d && r->work
            && bt__dynamic_init (r->d, RIG_MAX, n, shape, m, length, line.ea, &r->error) == BT_OK;
}

int
rig_close (rig *r)
{
  free (r->d);
  bt__dynamic_work_free (r->work);
  return r->good;
}

void
rig_step (rig *r, double h)
{
  r->in.h = h;
  r->water.time += h;
  r->good = r->good && bt__dynamic_step (r->d, r->work, &r->in, &r->report, &r->error) == BT_OK;
  r->steps++;
  r->solves += r->report.solves;
  r->unconverged += !r->report.converged;
}

/* Backward Euler steps that grow, without inertia in the end.  Beyond some hundred seconds the
   frozen tangents no longer converge where drag turns the line.  */
void
rig_settle (rig *r)
{
  double tolerance = r->in.tolerance, time = r->water.time, h = 0.05;
  r->in.tolerance = 1e-9;
  for (int i = 0, long_ones = 0; r->good && i < 600 && long_ones < 40; i++)
    {
      rig_step (r, h);
      bt__dynamic_still (r->d);
      long_ones += h >= 300 && r->report.converged;
      h = r->report.converged ? fmin (1.3 * h, 300) : fmax (h / 4, 0.01);
    }
  r->in.tolerance = tolerance;
  r->water.time = time;
}
