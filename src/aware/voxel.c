/* The grid of voxels: which cells, steps and squares are clear.

   The cell complex of voxel.h is built from distances alone.  Each cell keeps the distance from its
   middle to the nearest obstacle, up to twice the cell size.  A step between neighbouring cells is
   a segment between their middles, and a square the four middles round an edge of the grid.  Every
   point of a step lies within half a cell of a middle, and every point of a square within 0.7072
   cells of a middle: most steps and squares are known to be clear from the distances of the cells.
   Only the remaining ones are tested against the scene, a square as a convex body by GJK
   (collide/gjk.c).

   The test of squares is essential: a ring thinner than a cell may leave all four sides of a square
   clear and still pass through the square.  With sides alone the ring would vanish from the
   fundamental group, and a line through the ring would have the empty word.

   Clear means farther than 1e-6 m from every obstacle that counts.  One byte per cell keeps the
   three steps (bits 0 to 2) and the three squares (bits 3 to 5) with the cell at their lower
   corner.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/voxel_job.h"
#include "base/error.h"
#include "base/hash.h"

#define CLEAR 1e-6 /* m: nearer than that blocks */

/* ---- Cells ---- */

uint32_t
bt__voxel_next (const bt__voxels *v, uint32_t cell, int axis, int way)
{
  uint32_t stride = axis == 0 ? 1 : axis == 1 ? v->n[0] : v->n[0] * v->n[1];
  uint32_t at = cell / stride % v->n[axis];
  if (way > 0 ? at + 1 == v->n[axis] : at == 0)
    return BT__NOWHERE;
  return way > 0 ? cell + stride : cell - stride;
}

bt_vec3
bt__voxel_middle (const bt__voxels *v, uint32_t cell)
{
  uint32_t i = cell % v->n[0], j = cell / v->n[0] % v->n[1], k = cell / v->n[0] / v->n[1];
  return bt__axpy (v->c.lo, v->c.cell, bt__vec (i + 0.5, j + 0.5, k + 0.5));
}

uint32_t
bt__voxel_of (const bt__voxels *v, bt_vec3 p)
{
  bt_vec3 d = bt__scale (1 / v->c.cell, bt__sub (p, v->c.lo));
  uint32_t i = (uint32_t)bt__clamp (floor (d.x), 0, v->n[0] - 1);
  uint32_t j = (uint32_t)bt__clamp (floor (d.y), 0, v->n[1] - 1);
  uint32_t k = (uint32_t)bt__clamp (floor (d.z), 0, v->n[2] - 1);
  return i + v->n[0] * (j + v->n[1] * k);
}

/* ---- What is clear ---- */

typedef struct corners
{
  bt_vec3 p[4];
  int n;
} corners;

static bt_vec3
support_square (const void *shape, bt_vec3 direction, int *hint)
{
  const corners *c = shape;
  int best = 0;
  for (int i = 1; i < c->n; i++)
    if (bt__dot (c->p[i], direction) > bt__dot (c->p[best], direction))
      best = i;
  *hint = best;
  return c->p[best];
}

static int
is_square_clear (const bt__voxels *v, const corners *c, bt__count *count)
{
  bt_vec3 middle = bt__vec (0, 0, 0);
  double radius = 0;
  for (int i = 0; i < c->n; i++)
    middle = bt__axpy (middle, 1.0 / c->n, c->p[i]);
  for (int i = 0; i < c->n; i++)
    radius = fmax (radius, bt__distance (middle, c->p[i]));
  bt__convex body = { support_square, c };
  bt__near near;
  bt__gap gap;
  return !bt__scene_nearest_to_body (v->c.scene, v->c.on, &body, middle, radius, CLEAR, &near, &gap,
                                     count);
}

int
bt__voxel_sees (const bt__voxels *v, bt_vec3 a, bt_vec3 b, bt_vec3 c, bt__count *count)
{
  corners t = { { a, b, c, c }, 3 };
  return is_square_clear (v, &t, count);
}

static void
measure_cells (bt__voxels *v, bt__count *count)
{
  double cap = 2 * v->c.cell;
  for (uint32_t i = 0; i < v->cells && !bt__ask (v->asker); i++)
    {
      bt_vec3 p = bt__voxel_middle (v, i);
      bt__link link = { p, p };
      bt__near near;
      int found = bt__scene_nearest (v->c.scene, v->c.on, &link, cap, &near, count);
      v->clear[i] = (float)(found ? near.w.distance - CLEAR : 0.999 * cap);
      v->report.clear += v->clear[i] > 0;
    }
}

/* True if the step between the cells A and B is clear.  Every point of a step is within half a cell
   of the middle of A or of B.  */
static int
step_is_clear (const bt__voxels *v, uint32_t a, uint32_t b, bt__count *count)
{
  if (!(v->clear[a] > 0) || !(v->clear[b] > 0))
    return 0;
  if (v->clear[a] > 0.5 * v->c.cell && v->clear[b] > 0.5 * v->c.cell)
    return 1;
  bt__link link = { bt__voxel_middle (v, a), bt__voxel_middle (v, b) };
  return !bt__scene_within (v->c.scene, v->c.on, &link, CLEAR, count);
}

/* A mutant of the tests takes squares for clear whose sides are.  */
#ifndef BT__SQUARE_IS_CLEAR
#define BT__SQUARE_IS_CLEAR(v, c, count) is_square_clear (v, c, count)
#endif

/* The square across AXIS from CELL, along B and then C.  */
static int
square_is_clear (const bt__voxels *v, uint32_t cell, int axis, bt__count *count)
{
  int b = (axis + 1) % 3, c = (axis + 2) % 3;
  uint32_t x = bt__voxel_next (v, cell, b, 1), y = bt__voxel_next (v, cell, c, 1);
  if (x == BT__NOWHERE || y == BT__NOWHERE)
    return 0;
  uint32_t z = bt__voxel_next (v, x, c, 1);
  if (!(v->open[cell] >> b & 1) || !(v->open[cell] >> c & 1) || !(v->open[x] >> c & 1)
      || !(v->open[y] >> b & 1))
    return 0;
  float least = fminf (fminf (v->clear[cell], v->clear[x]), fminf (v->clear[y], v->clear[z]));
  if (least > 0.7072 * v->c.cell)
    return 1;
  corners s = { { bt__voxel_middle (v, cell), bt__voxel_middle (v, x), bt__voxel_middle (v, y),
                  bt__voxel_middle (v, z) },
                4 };
  return BT__SQUARE_IS_CLEAR (v, &s, count);
}

static void
open_steps (bt__voxels *v, bt__count *count)
{
  for (uint32_t i = 0; i < v->cells && !bt__ask (v->asker); i++)
    for (int a = 0; a < 3; a++)
      {
        uint32_t j = bt__voxel_next (v, i, a, 1);
        if (j != BT__NOWHERE && step_is_clear (v, i, j, count))
          v->open[i] |= (uint8_t)(1 << a);
      }
  for (uint32_t i = 0; i < v->cells && !bt__ask (v->asker); i++)
    for (int a = 0; a < 3; a++)
      if (square_is_clear (v, i, a, count))
        v->open[i] |= (uint8_t)(8 << a);
}

/* ---- Making ---- */

static bt_status
size_grid (bt__voxels *v, bt_error *error)
{
  bt_vec3 size = bt__sub (v->c.hi, v->c.lo);
  double n[3] = { ceil (size.x / v->c.cell - 1e-9), ceil (size.y / v->c.cell - 1e-9),
                  ceil (size.z / v->c.cell - 1e-9) };
  if (!(v->c.cell > 0) || !(n[0] >= 1) || !(n[1] >= 1) || !(n[2] >= 1))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "voxels of %g m in %g by %g by %g m; all must be positive", v->c.cell, size.x,
                     size.y, size.z);
  if (!(n[0] * n[1] * n[2] <= BT__VOXELS_MAX))
    return bt__fail (error, BT_ERR_LIMIT, "%g voxels; %d at most: take larger ones",
                     n[0] * n[1] * n[2], BT__VOXELS_MAX);
  for (int a = 0; a < 3; a++)
    v->n[a] = (uint32_t)n[a];
  v->cells = v->n[0] * v->n[1] * v->n[2];
  return BT_OK;
}

bt_status
bt__voxels_new (const bt__voxel_config *config, bt__asker *asker, bt__voxels **out, bt_error *error)
{
  bt__voxels *v = calloc (1, sizeof *v);
  bt__count count = { 0 };
  *out = NULL;
  if (!v)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for voxels");
  v->c = *config;
  v->asker = asker;
  bt_status status = size_grid (v, error);
  if (!status)
    {
      size_t n = v->cells;
      v->clear = malloc (n * sizeof *v->clear);
      v->label = malloc (3 * n * sizeof *v->label);
      v->open = calloc (n, 1);
      v->queue = malloc (3 * n * sizeof *v->queue);
      if (!v->clear || !v->label || !v->open || !v->queue)
        status = bt__fail (error, BT_ERR_LIMIT, "no memory for %u voxels", (unsigned)v->cells);
    }
  if (!status)
    {
      measure_cells (v, &count);
      open_steps (v, &count);
      status = bt__stopped (v->asker, error);
    }
  if (!status)
    {
      status = bt__voxels_label (v, error);
      v->asker = v->group.asker = NULL;
    }
  if (status)
    {
      bt__voxels_free (v);
      return status;
    }
  free (v->queue);
  v->queue = NULL;
  v->report.cells = v->cells;
  v->world = bt__hash (v->clear, v->cells * sizeof *v->clear, 2);
  v->world = bt__hash (v->n, sizeof v->n, v->world);
  *out = v;
  return BT_OK;
}

void
bt__voxels_free (bt__voxels *v)
{
  if (!v)
    return;
  bt__group_free (&v->group);
  free (v->clear);
  free (v->label);
  free (v->open);
  free (v->queue);
  free (v->pool.letter);
  free (v->pool.start);
  free (v->pool.slot);
  free (v);
}
