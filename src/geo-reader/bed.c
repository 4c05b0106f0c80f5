/* A bathymetry on a grid of local metres.

   The grid is chosen along x and y about the origin, as wide as the file or the wanted reach, with
   posts as far apart as the cells of the file near the middle.  Each post is mapped to a column and
   row of the file (place.c); its height is bilinear between the centres of the four cells around,
   and NaN if one of the cells with a share has no number.  Only the window of the file under the
   grid is read.  Without a reach, no side is longer than the distance over which lengths in local
   metres are right to 0.1 %.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "geo-reader/geo.h"

enum
{
  SIDE = 64,                            /* points along each side of the file's outline */
  WINDOW_MAX = 4 * BT_HEIGHTS_POSTS_MAX /* cells of the file that are read */
};

/* m: without a reach, no side of the grid is longer; lengths are right to 0.1 % at its ends.  */
static const double side_max = 5e5;

typedef struct job
{
  const bt__geo_wish *wish;
  bt_error *error;
  GDALRasterBandH band;
  bt__geo_map map;
  bt__geo_head *head;
  double *column, *row; /* of the file, for each post; not finite: nowhere */
  int first[2], n[2];   /* the window of the file that is read */
  float *cell;          /* its numbers; NaN: none */
} job;

static bt_status
no_grid_memory (job *j)
{
  return bt__fail (j->error, BT_ERR_LIMIT, "there is no memory for so large a grid");
}

/* ---- Which grid ---- */

typedef struct box
{
  double low[2], high[2];
} box;

/* The box of the centres of cells along the four sides of the file, in local metres; not finite
   where a part of the outline has no local place.  */
static box
outline_box (const job *j)
{
  double x[4 * SIDE], y[4 * SIDE], w = j->map.columns - 1, h = j->map.rows - 1;
  box b = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
  for (int i = 0; i < SIDE; i++)
    {
      double s = (double)i / SIDE;
      double p[4][2] = { { s * w, 0 }, { w, s * h }, { (1 - s) * w, h }, { 0, (1 - s) * h } };
      for (int k = 0; k < 4; k++)
        {
          x[k * SIDE + i] = p[k][0];
          y[k * SIDE + i] = p[k][1];
        }
    }
  bt__geo_cells_to_local (&j->map, 4 * SIDE, x, y);
  for (int i = 0; i < 4 * SIDE; i++)
    {
      int fine = isfinite (x[i]) && isfinite (y[i]);
      b.low[0] = fmin (b.low[0], fine ? x[i] : -INFINITY);
      b.low[1] = fmin (b.low[1], fine ? y[i] : -INFINITY);
      b.high[0] = fmax (b.high[0], fine ? x[i] : INFINITY);
      b.high[1] = fmax (b.high[1], fine ? y[i] : INFINITY);
    }
  return b;
}

/* The box wanted for posts: the whole file, or the part within reach.  */
static bt_status
wanted_box (job *j, box *b)
{
  double reach = j->wish->bed.reach;
  *b = outline_box (j);
  for (int a = 0; a < 2 && reach > 0; a++)
    {
      b->low[a] = fmax (b->low[a], -reach);
      b->high[a] = fmin (b->high[a], reach);
    }
  if (reach > 0 && (b->low[0] >= b->high[0] || b->low[1] >= b->high[1]))
    return bt__fail (j->error, BT_ERR_FORMAT, "nothing of it is within %g m of the origin", reach);
  for (int a = 0; a < 2; a++)
    if (!(b->high[a] - b->low[a] <= side_max))
      return bt__fail (j->error, BT_ERR_LIMIT,
                       "it is more than %.0f km wide; (reach 5000) reads 5 km on each side of the "
                       "origin",
                       side_max / 1e3);
  return BT_OK;
}

/* The spacing of the file's cells along x and y, m, near the middle of the wanted box.  */
static void
spacing (const job *j, const box *b, double step[2])
{
  double x[3] = { (b->low[0] + b->high[0]) / 2 }, y[3] = { (b->low[1] + b->high[1]) / 2 };
  bt__geo_local_to_cells (&j->map, 1, x, y);
  x[1] = x[0] + 1;
  y[1] = y[0];
  x[2] = x[0];
  y[2] = y[0] + 1;
  bt__geo_cells_to_local (&j->map, 3, x, y);
  double along = hypot (x[1] - x[0], y[1] - y[0]), across = hypot (x[2] - x[0], y[2] - y[0]);
  int turned = fabs (y[1] - y[0]) > fabs (x[1] - x[0]);
  step[0] = turned ? across : along;
  step[1] = turned ? along : across;
}

static bt_status
choose_grid (job *j)
{
  box b;
  double step[2], n[2];
  bt_status s = wanted_box (j, &b);
  if (s != BT_OK)
    return s;
  spacing (j, &b, step);
  for (int a = 0; a < 2; a++)
    {
      if (!(step[a] > 1e-6 && step[a] < side_max))
        return bt__fail (j->error, BT_ERR_FORMAT, "its cells are %g m by %g m large", step[0],
                         step[1]);
      n[a] = fmax (2, floor ((b.high[a] - b.low[a]) / step[a] * (1 + 1e-9)) + 1);
    }
  if (n[0] * n[1] > BT_HEIGHTS_POSTS_MAX)
    return bt__fail (j->error, BT_ERR_LIMIT,
                     "it has %.0f by %.0f heights; at most %d in all are read: (reach %.0f) reads "
                     "as many about the origin",
                     n[0], n[1], BT_HEIGHTS_POSTS_MAX,
                     floor (0.45 * sqrt ((double)BT_HEIGHTS_POSTS_MAX * step[0] * step[1])));
  *j->head = (bt__geo_head){ .columns = (uint32_t)n[0],
                             .rows = (uint32_t)n[1],
                             .x = b.low[0] + (b.high[0] - b.low[0] - (n[0] - 1) * step[0]) / 2,
                             .y = b.low[1] + (b.high[1] - b.low[1] - (n[1] - 1) * step[1]) / 2,
                             .dx = step[0],
                             .dy = step[1] };
  return BT_OK;
}

/* ---- Where in the file ---- */

/* Clamp *AT to the centres 0 to N - 1 of cells; nowhere beyond the edges.  */
static void
clamp_cell (double *at, int n)
{
  if (!(*at >= -0.5 - 1e-6 && *at <= n - 0.5 + 1e-6))
    *at = NAN;
  else
    *at = fmin (fmax (*at, 0), n - 1);
}

static bt_status
locate_posts (job *j)
{
  const bt__geo_head *h = j->head;
  size_t n = (size_t)h->columns * h->rows;
  j->column = malloc (n * sizeof *j->column);
  j->row = malloc (n * sizeof *j->row);
  if (!j->column || !j->row)
    return no_grid_memory (j);
  for (uint32_t r = 0; r < h->rows; r++)
    {
      double *x = j->column + (size_t)r * h->columns, *y = j->row + (size_t)r * h->columns;
      for (uint32_t c = 0; c < h->columns; c++)
        {
          x[c] = h->x + c * h->dx;
          y[c] = h->y + r * h->dy;
        }
      bt__geo_local_to_cells (&j->map, (int)h->columns, x, y);
      for (uint32_t c = 0; c < h->columns; c++)
        {
          clamp_cell (x + c, j->map.columns);
          clamp_cell (y + c, j->map.rows);
        }
    }
  return BT_OK;
}

static void
span (const double *at, const double *other, size_t n, int size, int *first, int *count)
{
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < n; i++)
    if (!isnan (at[i]) && !isnan (other[i]))
      {
        low = fmin (low, at[i]);
        high = fmax (high, at[i]);
      }
  *first = low <= high ? (int)floor (low) : 0;
  *count = low <= high ? (int)fmin (ceil (high), size - 1) - *first + 1 : 0;
}

/* ---- What is there ---- */

static bt_status
read_window (job *j)
{
  size_t n = (size_t)j->head->columns * j->head->rows;
  span (j->column, j->row, n, j->map.columns, j->first, j->n);
  span (j->row, j->column, n, j->map.rows, j->first + 1, j->n + 1);
  double cells = (double)j->n[0] * j->n[1];
  if (cells == 0)
    return bt__fail (j->error, BT_ERR_FORMAT, "nothing of it is near the origin");
  if (cells > WINDOW_MAX)
    return bt__fail (j->error, BT_ERR_LIMIT, "%.0f of its numbers would be read; at most %d are",
                     cells, WINDOW_MAX);
  j->cell = malloc ((size_t)cells * sizeof *j->cell);
  if (!j->cell)
    return no_grid_memory (j);
  if (GDALRasterIO (j->band, GF_Read, j->first[0], j->first[1], j->n[0], j->n[1], j->cell, j->n[0],
                    j->n[1], GDT_Float32, 0, 0)
      != CE_None)
    return bt__fail (j->error, BT_ERR_FORMAT, "it is damaged: its numbers cannot all be read");
  return BT_OK;
}

/* True if the numbers of BAND are depths, as the file says.  */
static int
says_depth (GDALRasterBandH band)
{
  const char *positive = GDALGetMetadataItem (band, "positive", NULL);
  const char *standard = GDALGetMetadataItem (band, "standard_name", NULL);
  if (positive)
    return strcasecmp (positive, "down") == 0;
  return standard
         && (strcmp (standard, "depth") == 0
             || strncmp (standard, "sea_floor_depth", strlen ("sea_floor_depth")) == 0);
}

/* From the file's numbers to heights.  */
static bt_status
turn_to_heights (job *j)
{
  int has_none = 0, told;
  double none = GDALGetRasterNoDataValue (j->band, &has_none);
  double scale = GDALGetRasterScale (j->band, &told), offset = GDALGetRasterOffset (j->band, &told);
  int down = j->wish->bed.sign == BT_GEO_DOWN
             || (j->wish->bed.sign == BT_GEO_AS_TOLD && says_depth (j->band));
  size_t n = (size_t)j->n[0] * (size_t)j->n[1];
  for (size_t i = 0; i < n; i++)
    {
      float v = j->cell[i];
      if (isinf (v) || (has_none && v == (float)none))
        v = NAN;
      j->cell[i] = (float)((scale * v + offset) * (down ? -1 : 1));
      if (fabsf (j->cell[i]) > 1e5F)
        return bt__fail (j->error, BT_ERR_FORMAT,
                         "a height of %g m; it must be within 100 km of the sea surface, or the "
                         "number that stands for none",
                         (double)j->cell[i]);
    }
  return BT_OK;
}

/* The height at column U and row V of the file; NaN if a cell with a share has no number.  */
static double
height_at (const job *j, double u, double v)
{
  if (isnan (u) || isnan (v))
    return NAN;
  int c = (int)floor (u), r = (int)floor (v);
  double share[2] = { u - c, v - r }, z = 0;
  for (int k = 0; k < 4; k++)
    {
      double weight = (k & 1 ? share[0] : 1 - share[0]) * (k & 2 ? share[1] : 1 - share[1]);
      if (weight > 0)
        z += weight
             * j->cell[(size_t)(r + (k >> 1) - j->first[1]) * (size_t)j->n[0]
                       + (size_t)(c + (k & 1) - j->first[0])];
    }
  return z;
}

/* Put the heights where the rows of the file were found.  */
static bt_status
sample_posts (job *j)
{
  size_t n = (size_t)j->head->columns * j->head->rows, there = 0, dry = 0;
  for (size_t i = 0; i < n; i++)
    {
      double z = height_at (j, j->column[i], j->row[i]);
      there += !isnan (z);
      dry += z > 0;
      j->column[i] = z;
    }
  if (there == 0)
    return bt__fail (j->error, BT_ERR_FORMAT, "it has no height anywhere near the origin");
  if (dry == there && j->wish->bed.sign == BT_GEO_AS_TOLD)
    return bt__fail (j->error, BT_ERR_FORMAT,
                     "all its heights are above the sea surface; (positive down) says that they "
                     "are depths, (positive up) that they are meant");
  return BT_OK;
}

bt_status
bt__geo_bed_make (const bt__geo_wish *wish, bt__geo_made *made, bt_error *error)
{
  job j = { .wish = wish, .error = error, .head = &made->head };
  GDALDatasetH raster = bt__geo_open_bed (wish, error);
  if (!raster)
    return BT_ERR_FORMAT;
  j.band = GDALGetRasterBand (raster, 1);
  bt_status s = bt__geo_map_make (raster, wish, &j.map, error);
  static bt_status (*const parts[]) (job *)
      = { choose_grid, locate_posts, read_window, turn_to_heights, sample_posts };
  for (size_t i = 0; s == BT_OK && i < sizeof parts / sizeof *parts; i++)
    s = parts[i](&j);
  made->numbers = s == BT_OK ? j.column : NULL;
  if (s != BT_OK)
    free (j.column);
  free (j.row);
  free (j.cell);
  bt__geo_map_free (&j.map);
  GDALClose (raster);
  return s;
}
