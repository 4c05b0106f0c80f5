/* The lee of a pile: how much of a current is left behind it.  The model stands in bight/sea.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/sea.h>

#include "math/vec.h"

/* In diameters.  */
#define CLOSE 3.0
#define FADES 40.0
#define GONE 60.0
#define DEFICIT 0.5
#define WIDE 6.0      /* standard widths beyond which nothing is left ... */
#define FARTHEST 13.5 /* ... and what they come to at the farthest, in diameters */

/* 0 to 1 as S goes from A to B.  */
static double
smooth (double s, double a, double b)
{
  double u = fmax (0, fmin (1, (s - a) / (b - a)));
  return u * u * (3 - 2 * u);
}

bt_wake
bt_wake_of (bt_vec3 a, bt_vec3 b, double radius)
{
  bt_vec3 axis = bt__sub (b, a);
  return (bt_wake){ a, bt__unit_or (axis, bt__vec (0, 0, 1)), bt__norm (axis), radius };
}

/* The share at S downstream and SIDE2 across, squared, both in diameters.  */
static double
level_share (double s, double side2)
{
  double c = s > CLOSE ? sqrt (CLOSE / s) : 1, width = 0.5 / c;
  double fade = smooth (s, -0.5, 0.5) * (1 - smooth (s, FADES, GONE));
  return DEFICIT * c * fade * exp (-side2 / (2 * width * width));
}

double
bt_wake_share (const bt_wake *wake, bt_vec3 ambient, bt_vec3 p)
{
  double d = 2 * wake->radius;
  bt_vec3 from = bt__sub (p, wake->a);
  double along = bt__dot (from, wake->axis), beyond = fmax (-along, along - wake->length);
  if (beyond >= d)
    return 1;
  /* The cheap tests come first, for most water is in no lee.  */
  double down = bt__dot (ambient, wake->axis), whole2 = bt__dot (ambient, ambient);
  double across2 = whole2 - down * down;
  double way = bt__dot (from, ambient) - along * down; /* s by the speed across */
  if (!(across2 > 1e-12 * whole2) || (way < 0 && way * way >= 0.25 * d * d * across2))
    return 1;
  double s2 = way * way / across2, side2 = bt__dot (from, from) - along * along - s2;
  if (s2 >= GONE * GONE * d * d || side2 > FARTHEST * FARTHEST * d * d)
    return 1;
  double s = copysign (sqrt (s2), way) / d;
  side2 = fmax (0, side2) / (d * d);
  if (side2 > WIDE * WIDE / 4 * fmax (1, s / CLOSE))
    return 1;
  /* A current along the axis leaves no lee: by the share that goes across.  */
  double ends = smooth (beyond, d, 0);
  return 1 - ends * sqrt (across2 / whole2) * level_share (s, side2);
}
