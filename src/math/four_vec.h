/* Four vectors in space side by side, in lanes of GNU C.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MATH_FOUR_VEC_H
#define BT_MATH_FOUR_VEC_H

#include "math/four.h"
#include "math/vec.h"

typedef struct bt__four_vec
{
  bt__four x, y, z;
} bt__four_vec;

static BT__HOT bt__four
bt__four_dot (bt__four_vec a, bt__four_vec b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* A + K B.  */
static BT__HOT bt__four_vec
bt__four_axpy (bt__four_vec a, bt__four k, bt__four_vec b)
{
  return (bt__four_vec){ a.x + k * b.x, a.y + k * b.y, a.z + k * b.z };
}

static BT__HOT bt__four_vec
bt__four_scale (bt__four k, bt__four_vec a)
{
  return (bt__four_vec){ k * a.x, k * a.y, k * a.z };
}

static BT__HOT bt_vec3
bt__four_lane (bt__four_vec a, int lane)
{
  return bt__vec (a.x[lane], a.y[lane], a.z[lane]);
}

#endif
