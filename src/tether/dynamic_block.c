/* The moving line: the block and its life.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "tether/dynamic.h"

enum
{
  NODE_ARRAYS = 5,     /* x, v, dx, vp, load */
  INTERVAL_ARRAYS = 4, /* tension, rest, stretch, dstretch; and chord, of vectors */
  VECTOR = sizeof (bt_vec3) / sizeof (double)
};

static size_t
node_size (int64_t n_max)
{
  return (size_t)(n_max + 1) * VECTOR;
}

size_t
bt__dynamic_size (int n_max)
{
  size_t doubles = NODE_ARRAYS * node_size (n_max) + (size_t)n_max * (INTERVAL_ARRAYS + VECTOR);
  return sizeof (bt__dynamic) + doubles * sizeof (double);
}

/* N from outside may be any number.  */
void
bt__dynamic_in_use (int64_t n, int room, bt__range out[BT__DYNAMIC_RANGES])
{
  const size_t vector = sizeof (bt_vec3), number = sizeof (double);
  size_t intervals = n < 0 ? 0 : n > room ? (size_t)room : (size_t)n;
  size_t at = sizeof (bt__dynamic);
  int k = 0;
  out[k++] = (bt__range){ 0, at };
  for (int i = 0; i < NODE_ARRAYS; i++, at += (size_t)(room + 1) * vector)
    out[k++] = (bt__range){ at, (intervals + 1) * vector };
  for (int i = 0; i < INTERVAL_ARRAYS; i++, at += (size_t)room * number)
    out[k++] = (bt__range){ at, intervals * number };
  out[k] = (bt__range){ at, intervals * vector };
}

static bt_vec3 *
node_array (const bt__dynamic *d, int k)
{
  return (bt_vec3 *)((double *)(d + 1) + (size_t)k * node_size (d->n_max));
}

static double *
interval_array (const bt__dynamic *d, int k)
{
  return (double *)(d + 1) + NODE_ARRAYS * node_size (d->n_max) + (size_t)(k * d->n_max);
}

bt_vec3 *
bt__dynamic_x (const bt__dynamic *d)
{
  return node_array (d, 0);
}

bt_vec3 *
bt__dynamic_v (const bt__dynamic *d)
{
  return node_array (d, 1);
}

bt_vec3 *
bt__dynamic_dx (const bt__dynamic *d)
{
  return node_array (d, 2);
}

bt_vec3 *
bt__dynamic_vp (const bt__dynamic *d)
{
  return node_array (d, 3);
}

bt_vec3 *
bt__dynamic_load (const bt__dynamic *d)
{
  return node_array (d, 4);
}

double *
bt__dynamic_tension (const bt__dynamic *d)
{
  return interval_array (d, 0);
}

double *
bt__dynamic_rest (const bt__dynamic *d)
{
  return interval_array (d, 1);
}

double *
bt__dynamic_stretch (const bt__dynamic *d)
{
  return interval_array (d, 2);
}

double *
bt__dynamic_dstretch (const bt__dynamic *d)
{
  return interval_array (d, 3);
}

bt_vec3 *
bt__dynamic_chord (const bt__dynamic *d)
{
  return (bt_vec3 *)interval_array (d, INTERVAL_ARRAYS);
}

/* Lay N + 1 points X evenly along SHAPE.  */
static void
resample (const bt_vec3 *shape, int m, double length, int n, bt_vec3 *x)
{
  double behind = 0, piece = bt__distance (shape[0], shape[1]);
  for (int i = 0, k = 0; i <= n; i++)
    {
      double s = length * i / n;
      while (k < m - 2 && behind + piece < s)
        {
          behind += piece;
          k++;
          piece = bt__distance (shape[k], shape[k + 1]);
        }
      double u = piece > 0 ? fmin ((s - behind) / piece, 1) : 0;
      x[i] = bt__axpy (bt__scale (1 - u, shape[k]), u, shape[k + 1]);
    }
  x[n] = shape[m - 1];
}

static bt_status
check_shape (int n_max, int n, const bt_vec3 *shape, int m, double length, bt_error *error)
{
  if (n < 1 || n > n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the line has room for 1 to %d", n, n_max);
  if (!(length > 0 && isfinite (length)))
    return bt__fail (error, BT_ERR_DOMAIN, "a line of %g m; its length must be positive", length);
  if (m < 2)
    return bt__fail (error, BT_ERR_DOMAIN, "a line laid along %d points; it takes two", m);
  for (int i = 0; i < m; i++)
    if (!bt__is_finite (shape[i]))
      return bt__fail (error, BT_ERR_DOMAIN, "point %d of the line is not at a finite place", i);
  return BT_OK;
}

bt_status
bt__dynamic_init (bt__dynamic *d, int n_max, int n, const bt_vec3 *shape, int m, double length,
                  double ea, bt_error *error)
{
  bt_status status = check_shape (n_max, n, shape, m, length, error);
  if (status)
    return status;
  memset (d, 0, bt__dynamic_size (n_max));
  d->n = n;
  d->n_max = n_max;
  d->least = BT__LEAST_INTERVALS;
  d->piece = length / n;
  double along = 0;
  for (int i = 0; i + 1 < m; i++)
    along += bt__distance (shape[i], shape[i + 1]);
  bt_vec3 *x = bt__dynamic_x (d);
  if (m == n + 1)
    memcpy (x, shape, (size_t)m * sizeof *x);
  else
    resample (shape, m, along, n, x);
  for (int j = 0; j < n; j++)
    {
      double e = bt__distance (x[j], x[j + 1]) / d->piece;
      bt__dynamic_rest (d)[j] = d->piece;
      bt__dynamic_stretch (d)[j] = e;
      bt__dynamic_tension (d)[j] = e > 1 ? bt__stiffness (ea) * (e - 1) : 0;
    }
  return BT_OK;
}

void
bt__dynamic_still (bt__dynamic *d)
{
  size_t size = (size_t)(d->n + 1) * sizeof (bt_vec3);
  memset (bt__dynamic_v (d), 0, size);
  memset (bt__dynamic_dx (d), 0, size);
  memset (bt__dynamic_vp (d), 0, size);
  memset (bt__dynamic_dstretch (d), 0, (size_t)d->n * sizeof (double));
  d->history = 0;
}

/* Four sums side by side, which need not wait for each other.  */
double
bt__dynamic_length (const bt__dynamic *d)
{
  const double *rest = bt__dynamic_rest (d);
  double a = d->owed, b = 0, c = 0, e = 0;
  int64_t j = 0;
  for (; j + 3 < d->n; j += 4)
    {
      a += rest[j];
      b += rest[j + 1];
      c += rest[j + 2];
      e += rest[j + 3];
    }
  for (; j < d->n; j++)
    a += rest[j];
  return a + b + (c + e);
}
