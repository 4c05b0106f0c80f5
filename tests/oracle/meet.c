/* See meet.h.

   Four points that go straight lie in a plane at the roots of a cubic.  Its signs at many times are
   told exactly (sweep_orient); between two of them the root is halved down to, and there the two
   links cross or do not, in the projection along the common plane's normal.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "meet.h"

#include <math.h>

#include "math/vec.h"
#include "testbed/sweep.h"

enum
{
  TIMES = 48,
  HALVINGS = 50
};

static bt_vec3
at (const bt_vec3 *from, const bt_vec3 *to, double t)
{
  return bt__axpy (*from, t, bt__sub (*to, *from));
}

typedef struct four
{
  bt_vec3 from[4], to[4];
} four;

static int
side (const four *f, double t)
{
  bt_vec3 v[4];
  for (int i = 0; i < 4; i++)
    v[i] = at (f->from + i, f->to + i, t);
  return sweep_orient (v[0], v[1], v[2], v[3]);
}

/* The square of the distance of two segments by clamped alternation, which needs no cases.  */
static double
square_between (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  bt_vec3 u = bt__sub (b, a), v = bt__sub (d, c);
  double uu = bt__dot (u, u), vv = bt__dot (v, v), uv = bt__dot (u, v), best = INFINITY;
  double det = uu * vv - uv * uv;
  bt_vec3 r = bt__sub (a, c);
  double starts[3]
      = { 0, 1, det > 1e-14 * uu * vv ? (uv * bt__dot (v, r) - vv * bt__dot (u, r)) / det : 0.5 };
  for (int k = 0; k < 3; k++)
    {
      double s = fmin (fmax (starts[k], 0), 1), t = 0;
      for (int i = 0; i < 4; i++)
        {
          t = fmin (fmax ((s * uv + bt__dot (v, r)) / fmax (vv, 1e-300), 0), 1);
          s = fmin (fmax ((t * uv - bt__dot (u, r)) / fmax (uu, 1e-300), 0), 1);
        }
      bt_vec3 gap = bt__axpy (bt__axpy (r, s, u), -t, v);
      best = fmin (best, bt__dot (gap, gap));
    }
  return best;
}

/* Nonzero if the links, in a plane at T, cross there.  */
static int
crosses_at (const four *f, double t)
{
  bt_vec3 v[4];
  for (int i = 0; i < 4; i++)
    v[i] = at (f->from + i, f->to + i, t);
  double size = bt__distance (v[0], v[1]) + bt__distance (v[2], v[3]);
  return square_between (v[0], v[1], v[2], v[3]) < 1e-16 * size * size;
}

static long
crossings_of (const four *f)
{
  long count = 0;
  int before = side (f, 0);
  for (int i = 1; i <= TIMES; i++)
    {
      double lo = (i - 1.0) / TIMES, hi = (double)i / TIMES;
      int after = side (f, hi);
      if (after != before)
        {
          for (int k = 0; k < HALVINGS; k++)
            {
              double mid = 0.5 * (lo + hi);
              if (side (f, mid) == before)
                lo = mid;
              else
                hi = mid;
            }
          count += crosses_at (f, hi);
        }
      before = after;
    }
  return count;
}

/* Nonzero if the paths of the links I of P and J of Q keep apart by their boxes.  */
static int
far_apart (const four *f)
{
  bt_vec3 lo[2], hi[2];
  for (int k = 0; k < 2; k++)
    {
      lo[k] = hi[k] = f->from[2 * k];
      for (int i = 0; i < 4; i++)
        {
          bt_vec3 p = i & 1 ? f->to[2 * k + i / 2] : f->from[2 * k + i / 2];
          lo[k] = bt__vec (fmin (lo[k].x, p.x), fmin (lo[k].y, p.y), fmin (lo[k].z, p.z));
          hi[k] = bt__vec (fmax (hi[k].x, p.x), fmax (hi[k].y, p.y), fmax (hi[k].z, p.z));
        }
    }
  return lo[0].x > hi[1].x || lo[1].x > hi[0].x || lo[0].y > hi[1].y || lo[1].y > hi[0].y
         || lo[0].z > hi[1].z || lo[1].z > hi[0].z;
}

long
meet_crossings (const bt_vec3 *p_from, const bt_vec3 *p_to, int n, const bt_vec3 *q_from,
                const bt_vec3 *q_to, int m)
{
  long count = 0;
  for (int i = 0; i + 1 < n; i++)
    for (int j = p_from == q_from ? i + 2 : 0; j + 1 < m; j++)
      {
        four f = { { p_from[i], p_from[i + 1], q_from[j], q_from[j + 1] },
                   { p_to[i], p_to[i + 1], q_to[j], q_to[j + 1] } };
        if (!far_apart (&f))
          count += crossings_of (&f);
      }
  return count;
}

double
meet_distance (const bt_vec3 *p, const bt_vec3 *q)
{
  return sqrt (square_between (p[0], p[1], q[0], q[1]));
}

double
meet_clearance (const bt_vec3 *p, int n, const bt_vec3 *q, int m, int apart, double cap)
{
  double best = cap * cap;
  for (int i = 0; i + 1 < n; i++)
    for (int j = p == q ? i + 1 + apart : 0; j + 1 < m; j++)
      {
        double size = 0.5 * (bt__distance (p[i], p[i + 1]) + bt__distance (q[j], q[j + 1]));
        bt_vec3 a = bt__scale (0.5, bt__add (p[i], p[i + 1])),
                b = bt__scale (0.5, bt__add (q[j], q[j + 1]));
        if (bt__distance (a, b) <= size + cap)
          best = fmin (best, square_between (p[i], p[i + 1], q[j], q[j + 1]));
      }
  return sqrt (best);
}
