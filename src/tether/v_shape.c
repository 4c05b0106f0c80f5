/* The V: the thesis' simplest bent line, two straight links (section 2.2).

   Both links lean against the load by the same angle theta with H = S cos theta; equation 2-1
   shares the length so that the far end is met.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/statics.h>

#include "tether/plane.h"

static bt_v_shape
straight (double h, double v, double s)
{
  return (bt_v_shape){ s / 2, s / 2, { h / 2, v / 2 } };
}

/* Equation 2-1.  The clamp is for the last rounding before taut.  */
static bt_v_shape
bent (double h, double v, double s)
{
  double sine = sqrt ((s - h) * (s + h)) / s;
  double l1 = fmin (fmax (s / 2 - v / (2 * sine), 0), s);
  return (bt_v_shape){ l1, s - l1, { l1 * (h / s), -l1 * sine } };
}

bt_status
bt_v_shape_solve (double h, double v, double s, bt_v_shape *shape, bt_error *error)
{
  bt_status status = bt__plane_check (h, v, s, error);
  if (status)
    return status;
  *shape = bt__plane_excess (h, v, s) > 0 ? bent (h, v, s) : straight (h, v, s);
  return BT_OK;
}
