/* Three-vector arithmetic, inline.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MATH_VEC_H
#define BT_MATH_VEC_H

#include <math.h>
#include <stdint.h>

#include <bight/vec.h>

#define BT__PI 3.14159265358979323846

/* X within LO and HI; no calls, as fmin and fmax are.  */
static inline double
bt__clamp (double x, double lo, double hi)
{
  return x < lo ? lo : x > hi ? hi : x;
}

static inline bt_vec3
bt__vec (double x, double y, double z)
{
  return (bt_vec3){ x, y, z };
}

static inline bt_vec3
bt__add (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline bt_vec3
bt__sub (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline bt_vec3
bt__scale (double k, bt_vec3 a)
{
  return bt__vec (k * a.x, k * a.y, k * a.z);
}

/* A + K B.  */
static inline bt_vec3
bt__axpy (bt_vec3 a, double k, bt_vec3 b)
{
  return bt__vec (a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}

/* The point between P[0] and P[1] at the share S.  */
static inline bt_vec3
bt__between (const bt_vec3 *p, double s)
{
  return bt__axpy (bt__scale (1 - s, p[0]), s, p[1]);
}

static inline double
bt__dot (bt_vec3 a, bt_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The part of V across the unit vector AXIS.  */
static inline bt_vec3
bt__off_axis (bt_vec3 axis, bt_vec3 v)
{
  return bt__axpy (v, -bt__dot (axis, v), axis);
}

static inline bt_vec3
bt__cross (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double
bt__norm (bt_vec3 a)
{
  return sqrt (bt__dot (a, a));
}

static inline double
bt__distance (bt_vec3 a, bt_vec3 b)
{
  return bt__norm (bt__sub (a, b));
}

/* The length of the polyline of the N points P.  */
static inline double
bt__length (const bt_vec3 *p, uint32_t n)
{
  double sum = 0;
  for (uint32_t i = 0; i + 1 < n; i++)
    sum += bt__distance (p[i], p[i + 1]);
  return sum;
}

static inline int
bt__is_finite (bt_vec3 a)
{
  return isfinite (a.x) && isfinite (a.y) && isfinite (a.z);
}

/* A / |A|, or FALLBACK when A has no direction.  */
static inline bt_vec3
bt__unit_or (bt_vec3 a, bt_vec3 fallback)
{
  double n = bt__norm (a);
  return n > 0 && isfinite (n) ? bt__scale (1 / n, a) : fallback;
}

#endif
