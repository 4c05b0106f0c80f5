/* A current from a table: points of a grid in space and time, linear between.

   Rows x y z t u v w may come in any order.  The coordinates that occur along each axis, sorted,
   are the lines of the grid; every crossing of lines must have exactly one row; the error for a
   missing or double row names the point.  Coordinates must be below 1e12 in size, speeds at most 20
   m/s.

   A question finds the interval on each of the four lines by bisection and interpolates linearly in
   each direction, a sum over sixteen corners at most.  Beyond the first and the last line the
   velocity of the boundary holds.  A grid is immutable and counted by reference.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/sea.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sea/grid.h"

#define SPEED_MAX 20.0

enum
{
  AXES = 4, /* x y z t */
  POINTS_MAX = 1 << 26
};

struct bt_current_grid
{
  atomic_int references;
  size_t n[AXES];
  double *line[AXES]; /* the coordinates that occur, rising */
  bt_vec3 *v;         /* x fastest, then y, z, t */
};

static bt_status
no_memory (bt_error *error)
{
  return bt__fail (error, BT_ERR_LIMIT, "no memory for the grid of a current");
}

static int
by_value (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The interval around VALUE on GRID's axis A, and the share of the interval.  */
static size_t
locate (const bt_current_grid *grid, int a, double value, double *share)
{
  const double *line = grid->line[a];
  size_t low = 0, high = grid->n[a] - 1;
  *share = 0;
  if (high == 0 || !(value > line[0]))
    return 0;
  while (high - low > 1)
    {
      size_t middle = (low + high) / 2;
      if (line[middle] <= value)
        low = middle;
      else
        high = middle;
    }
  *share = fmin (1, (value - line[low]) / (line[high] - line[low]));
  return low;
}

/* ---- Making one ---- */

static bt_status
collect_lines (bt_current_grid *grid, const double (*rows)[7], size_t n, bt_error *error)
{
  for (int a = 0; a < AXES; a++)
    {
      double *line = malloc (n * sizeof *line);
      size_t kept = 1;
      if (!line)
        return no_memory (error);
      grid->line[a] = line;
      for (size_t i = 0; i < n; i++)
        line[i] = rows[i][a];
      qsort (line, n, sizeof *line, by_value);
      for (size_t i = 1; i < n; i++)
        if (line[i] > line[kept - 1])
          line[kept++] = line[i];
      grid->n[a] = kept;
    }
  return BT_OK;
}

static size_t
grid_place (const bt_current_grid *grid, const double *row)
{
  size_t place = 0;
  for (int a = AXES - 1; a >= 0; a--)
    {
      double share;
      size_t i = locate (grid, a, row[a], &share);
      place = place * grid->n[a] + i + (share > 0.5);
    }
  return place;
}

static bt_status
missing (const bt_current_grid *grid, size_t place, bt_error *error)
{
  double at[AXES];
  for (int a = 0; a < AXES; a++)
    {
      at[a] = grid->line[a][place % grid->n[a]];
      place /= grid->n[a];
    }
  return bt__fail (error, BT_ERR_FORMAT,
                   "the grid of a current has no row for x %g, y %g, z %g, t %g; it wants one for "
                   "every point, here %zu x %zu x %zu x %zu",
                   at[0], at[1], at[2], at[3], grid->n[0], grid->n[1], grid->n[2], grid->n[3]);
}

static bt_status
fill (bt_current_grid *grid, const double (*rows)[7], size_t n, size_t points, bt_error *error)
{
  for (size_t i = 0; i < points; i++)
    grid->v[i].x = NAN;
  for (size_t i = 0; i < n; i++)
    {
      const double *r = rows[i];
      bt_vec3 *v = grid->v + grid_place (grid, r);
      if (!isnan (v->x))
        return bt__fail (error, BT_ERR_FORMAT,
                         "the grid of a current has two rows for x %g, y %g, z %g, t %g", r[0],
                         r[1], r[2], r[3]);
      *v = bt__vec (r[4], r[5], r[6]);
    }
  for (size_t i = 0; i < points; i++)
    if (isnan (grid->v[i].x))
      return missing (grid, i, error);
  return BT_OK;
}

static bt_status
check_grid_rows (const double (*rows)[7], size_t n, bt_error *error)
{
  if (n == 0)
    return bt__fail (error, BT_ERR_FORMAT, "the grid of a current has no rows");
  for (size_t i = 0; i < n; i++)
    {
      double speed = bt__norm (bt__vec (rows[i][4], rows[i][5], rows[i][6]));
      for (int a = 0; a < AXES; a++)
        if (!(fabs (rows[i][a]) < 1e12))
          return bt__fail (error, BT_ERR_DOMAIN, "row %zu of the grid of a current lies at %g",
                           i + 1, rows[i][a]);
      if (!(speed <= SPEED_MAX))
        return bt__fail (error, BT_ERR_DOMAIN,
                         "row %zu of the grid of a current flows at %g m/s; at most %g m/s is "
                         "allowed",
                         i + 1, speed, SPEED_MAX);
    }
  return BT_OK;
}

static bt_status
build (bt_current_grid *grid, const double (*rows)[7], size_t n, bt_error *error)
{
  double points = 1;
  bt_status status = collect_lines (grid, rows, n, error);
  if (status != BT_OK)
    return status;
  for (int a = 0; a < AXES; a++)
    points *= (double)grid->n[a];
  if (points > POINTS_MAX)
    return bt__fail (error, BT_ERR_FORMAT,
                     "%zu rows do not make the grid of a current: their coordinates make %zu x %zu "
                     "x %zu x %zu points",
                     n, grid->n[0], grid->n[1], grid->n[2], grid->n[3]);
  grid->v = malloc ((size_t)points * sizeof *grid->v);
  if (!grid->v)
    return no_memory (error);
  return fill (grid, rows, n, (size_t)points, error);
}

bt_status
bt_current_grid_new (const double (*rows)[7], size_t n, bt_current_grid **out, bt_error *error)
{
  bt_status status = check_grid_rows (rows, n, error);
  if (status != BT_OK)
    return status;
  bt_current_grid *grid = calloc (1, sizeof *grid);
  if (!grid)
    return no_memory (error);
  atomic_init (&grid->references, 1);
  status = build (grid, rows, n, error);
  if (status != BT_OK)
    bt_current_grid_free (grid);
  else
    *out = grid;
  return status;
}

bt_current_grid *
bt_current_grid_retain (bt_current_grid *grid)
{
  if (grid)
    atomic_fetch_add (&grid->references, 1);
  return grid;
}

void
bt_current_grid_free (bt_current_grid *grid)
{
  if (!grid || atomic_fetch_sub (&grid->references, 1) > 1)
    return;
  for (int a = 0; a < AXES; a++)
    free (grid->line[a]);
  free (grid->v);
  free (grid);
}

/* ---- Asking ---- */

bt_vec3
bt_current_grid_velocity (const bt_current_grid *grid, bt_vec3 p, double t)
{
  const double at[AXES] = { p.x, p.y, p.z, t };
  size_t first = 0, step = 1, stride[AXES];
  double share[AXES];
  bt_vec3 sum = { 0, 0, 0 };
  if (!bt__is_finite (p) || !isfinite (t))
    return bt__vec (NAN, NAN, NAN);
  for (int a = 0; a < AXES; a++)
    {
      first += step * locate (grid, a, at[a], &share[a]);
      stride[a] = step;
      step *= grid->n[a];
    }
  for (int corner = 0; corner < 1 << AXES; corner++)
    {
      double weight = 1;
      size_t i = first;
      for (int a = 0; a < AXES; a++)
        {
          int end = corner >> a & 1;
          weight *= end ? share[a] : 1 - share[a];
          i += end ? stride[a] : 0;
        }
      if (weight > 0)
        sum = bt__axpy (sum, weight, grid->v[i]);
    }
  return sum;
}

int
bt_current_grid_is_unsteady (const bt_current_grid *grid)
{
  return grid->n[3] > 1;
}

uint64_t
bt__current_grid_hash (const bt_current_grid *grid, uint64_t seed)
{
  size_t points = 1;
  for (int a = 0; a < AXES; a++)
    {
      seed = bt__hash (grid->line[a], grid->n[a] * sizeof (double), seed);
      points *= grid->n[a];
    }
  return bt__hash (grid->v, points * sizeof (bt_vec3), seed);
}
