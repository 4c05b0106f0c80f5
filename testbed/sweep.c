/* A link sweeps a ruled patch, here two triangles.  A skeleton segment crosses that with sign as
   often as it crosses the patch, unless an end of it lies between the two: so a hit is looked at
   again in 256 shorter moves.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "testbed/sweep.h"

enum
{
  FINE = 256
};

__extension__ typedef __float128 quad;

/* ---- Orientation ---- */

static int
exact_orient (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  quad ax = (quad)a.x - d.x, ay = (quad)a.y - d.y, az = (quad)a.z - d.z;
  quad bx = (quad)b.x - d.x, by = (quad)b.y - d.y, bz = (quad)b.z - d.z;
  quad cx = (quad)c.x - d.x, cy = (quad)c.y - d.y, cz = (quad)c.z - d.z;
  quad det = ax * (by * cz - bz * cy) + bx * (cy * az - cz * ay) + cx * (ay * bz - az * by);
  return (det > 0) - (det < 0);
}

int
sweep_orient (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  double ax = a.x - d.x, ay = a.y - d.y, az = a.z - d.z;
  double bx = b.x - d.x, by = b.y - d.y, bz = b.z - d.z;
  double cx = c.x - d.x, cy = c.y - d.y, cz = c.z - d.z;
  double det = ax * (by * cz - bz * cy) + bx * (cy * az - cz * ay) + cx * (ay * bz - az * by);
  double size = fabs (ax) * (fabs (by * cz) + fabs (bz * cy))
                + fabs (bx) * (fabs (cy * az) + fabs (cz * ay))
                + fabs (cx) * (fabs (ay * bz) + fabs (az * by));
  if (fabs (det) > 16 * DBL_EPSILON * size)
    return det > 0 ? 1 : -1;
  return exact_orient (a, b, c, d);
}

/* 0 counts as positive, always the same way.  */
static int
side (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  return sweep_orient (a, b, c, d) < 0 ? -1 : 1;
}

/* The sign with which segment S goes through triangle P, Q, R, or 0.  */
static int
through (bt_vec3 p, bt_vec3 q, bt_vec3 r, const sweep_segment *s)
{
  int a = side (p, q, r, s->a), b = side (p, q, r, s->b);
  if (a == b)
    return 0;
  int u = side (s->a, s->b, p, q), v = side (s->a, s->b, q, r), w = side (s->a, s->b, r, p);
  return u == v && v == w ? a : 0;
}

/* ---- Patches ---- */

static bt_vec3
between (bt_vec3 a, bt_vec3 b, double t)
{
  return (bt_vec3){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z) };
}

static int
patch (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d, const sweep_segment *s)
{
  return through (a, b, d, s) + through (a, d, c, s);
}

/* The boxes of the patch and of S are apart.  */
static int
is_far (const bt_vec3 *from, const bt_vec3 *to, const sweep_segment *s)
{
#define APART(k)                                                                                   \
  (fmax (fmax (from[0].k, from[1].k), fmax (to[0].k, to[1].k)) < fmin (s->a.k, s->b.k)             \
   || fmin (fmin (from[0].k, from[1].k), fmin (to[0].k, to[1].k)) > fmax (s->a.k, s->b.k))
  return APART (x) || APART (y) || APART (z);
#undef APART
}

static int
link_crossings (const bt_vec3 *from, const bt_vec3 *to, const sweep_segment *s)
{
  if (is_far (from, to, s)
      || (through (from[0], from[1], to[1], s) == 0 && through (from[0], to[1], to[0], s) == 0))
    return 0;
  int sum = 0;
  bt_vec3 a = from[0], b = from[1];
  for (int i = 1; i <= FINE; i++)
    {
      bt_vec3 c = between (from[0], to[0], (double)i / FINE),
              d = between (from[1], to[1], (double)i / FINE);
      sum += patch (a, b, c, d, s);
      a = c;
      b = d;
    }
  return sum;
}

int
sweep_crossings (const bt_vec3 *from, const bt_vec3 *to, int n, const sweep_segment *s)
{
  int sum = 0;
  for (int i = 0; i + 1 < n; i++)
    sum += abs (link_crossings (from + i, to + i, s));
  return sum;
}

int
sweep_sheet (const bt_vec3 *from, const bt_vec3 *to, int n, const sweep_triangle *t)
{
  int sum = 0;
  const bt_vec3 *v = t->v;
  for (int k = 0; k < 3; k++)
    sum += sweep_crossings (from, to, n, &(sweep_segment){ v[k], v[(k + 1) % 3] });
  for (int i = 0; i < n; i++)
    {
      sum += abs (through (v[0], v[1], v[2], &(sweep_segment){ from[i], to[i] }));
      if (i + 1 < n)
        sum += abs (through (v[0], v[1], v[2], &(sweep_segment){ to[i], to[i + 1] }));
    }
  return sum;
}

/* ---- Linking ---- */

static bt_vec3
minus (bt_vec3 a, bt_vec3 b)
{
  return (bt_vec3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static double
dot (bt_vec3 a, bt_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Half the solid angle of the triangle of directions A, B, C (van Oosterom, Strackee 1983).  */
static double
half_angle (bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  bt_vec3 n = { b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x };
  double x = sqrt (dot (a, a)), y = sqrt (dot (b, b)), z = sqrt (dot (c, c));
  return atan2 (dot (a, n), x * y * z + dot (a, b) * z + dot (b, c) * x + dot (c, a) * y);
}

static bt_vec3
loop_point (const bt_vec3 *from, const bt_vec3 *to, int n, int i)
{
  i %= 2 * n;
  return i < n ? from[i] : to[2 * n - 1 - i];
}

double
sweep_linking (const bt_vec3 *from, const bt_vec3 *to, int n, const bt_vec3 *ring, int m)
{
  double sum = 0;
  for (int i = 0; i < 2 * n; i++)
    for (int j = 0; j < m; j++)
      {
        bt_vec3 p = loop_point (from, to, n, i), q = loop_point (from, to, n, i + 1);
        bt_vec3 a = minus (ring[j], p), b = minus (ring[j], q);
        bt_vec3 c = minus (ring[(j + 1) % m], q), d = minus (ring[(j + 1) % m], p);
        sum += half_angle (a, b, c) + half_angle (c, d, a);
      }
  return sum / (2 * 3.14159265358979323846);
}
