/* Surface and velocity of waves at a place: the sums over the components, four at a time.

   A component of amplitude a, theta = k (x . way) - omega t + phase, over depth d has the surface a
   cos theta and below the surface the velocity a omega (C cos theta along the way, S sin theta up),
   C and S the hyperbolic cosine and sine of k (z + d) by sinh (k d) (R. G. Dean and R. A.
   Dalrymple, Water Wave Mechanics for Engineers and Scientists, ch. 3): with B = e^(-2 k d), C, S =
   (e^(k z) +- B e^(-k z)) / (1 - B).

   In a header because waves.c and its test compile the sums for more than one machine.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SEA_WAVES_SUM_H
#define BT_SEA_WAVES_SUM_H

#include <bight/sea.h>

#include "math/four.h"

#define BT__UNFELT 16.0 /* k times the depth at which a component is 1e-7 of itself */

/* Along the way of the waves and up.  */
typedef struct bt__orbit
{
  double along, up;   /* m/s; of the surface: m */
  double along2, up2; /* m/s2 */
} bt__orbit;

/* Sine and cosine of theta of components I to I + 3 at WAY metres along and T.  */
static BT__HOT void
bt__waves_turn (const bt_waves *w, int i, double way, double t, bt__four *s, bt__four *c)
{
  bt__four k = bt__four_load (w->k + i), omega = bt__four_load (w->omega + i);
  bt__four_sincos (k * way - omega * t + bt__four_load (w->phase + i), s, c);
}

/* The motion of the water at WAY, T and Z metres up, not above 0 nor below the bottom.  */
static BT__HOT bt__orbit
bt__waves_orbit (const bt_waves *w, double way, double z, double t)
{
  bt__four along = { 0 }, up = { 0 }, along2 = { 0 }, up2 = { 0 };
  for (int i = 0; i < w->n && w->k[i] * -z < BT__UNFELT; i += BT__FOUR)
    {
      bt__four s, c, fall, climb, kz = bt__four_load (w->k + i) * z;
      bt__four_mask felt = kz > -BT__UNFELT;
      bt__waves_turn (w, i, way, t, &s, &c);
      bt__four_exp (bt__four_where (felt, kz), &fall, &climb);
      bt__four speed = bt__four_where (felt, bt__four_load (w->speed + i));
      bt__four omega = bt__four_load (w->omega + i);
      climb *= bt__four_load (w->bed + i);
      bt__four level = speed * (fall + climb), rise = speed * (fall - climb);
      along += level * c;
      up += rise * s;
      along2 += level * omega * s;
      up2 -= rise * omega * c;
    }
  return (bt__orbit){ bt__four_sum (along), bt__four_sum (up), bt__four_sum (along2),
                      bt__four_sum (up2) };
}

/* Where what rests at WAY on the surface is at T.  */
static BT__HOT bt__orbit
bt__waves_surface (const bt_waves *w, double way, double t)
{
  bt__four along = { 0 }, up = { 0 };
  for (int i = 0; i < w->n; i += BT__FOUR)
    {
      bt__four s, c, amplitude = bt__four_load (w->amplitude + i);
      bt__four bed = bt__four_load (w->bed + i);
      bt__waves_turn (w, i, way, t, &s, &c);
      along -= amplitude * (1 + bed) / (1 - bed) * s;
      up += amplitude * c;
    }
  return (bt__orbit){ bt__four_sum (along), bt__four_sum (up), 0, 0 };
}

#endif
