/* Lazy Theta* (Nash, Koenig and Tovey 2010).  A cell first inherits the parent of the cell from
   which it was reached, untested.  When the cell is expanded, the line of sight to the parent is
   tested once; if the sight is blocked, the best neighbour in sight becomes the parent.

   A question grows the tree only until the cells about the place asked for are closed: a closed
   cell's parent and distance are final, and nothing else is looked at, so answers do not depend on
   what was asked before.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/free_job.h"
#include "base/error.h"

/* m: two links that end at one point are measured so much alike.  */
#define ROUNDING 1e-9

/* ---- The grid ---- */

static uint32_t
cell_number (const bt__free *t, int i, int j, int k)
{
  if (i < 0 || j < 0 || k < 0 || i >= (int)t->nx || j >= (int)t->ny || k >= (int)t->nz)
    return BT__NOWHERE;
  return (uint32_t)i + t->nx * ((uint32_t)j + t->ny * (uint32_t)k);
}

static void
indices (const bt__free *t, bt_vec3 p, int out[3])
{
  bt_vec3 d = bt__scale (1 / t->c.cell, bt__sub (p, t->c.lo));
  out[0] = (int)bt__clamp (floor (d.x), 0, t->nx - 1);
  out[1] = (int)bt__clamp (floor (d.y), 0, t->ny - 1);
  out[2] = (int)bt__clamp (floor (d.z), 0, t->nz - 1);
}

bt_vec3
bt__free_point (const bt__free *t, uint32_t cell)
{
  if (cell == t->root)
    return t->anchor;
  uint32_t i = cell % t->nx, j = cell / t->nx % t->ny, k = cell / t->nx / t->ny;
  return bt__axpy (t->c.lo, t->c.cell, bt__vec (i + 0.5, j + 0.5, k + 0.5));
}

int
bt__free_sees (const bt__free_config *config, bt_vec3 a, bt_vec3 b, double clear, bt__count *count)
{
  bt__link link = { a, b };
  return !bt__scene_within (config->scene, config->on, &link, clear, count);
}

/* ---- The open cells: a heap ---- */

static int
comes_before (const bt__free *t, uint32_t a, uint32_t b)
{
  return t->g[a] != t->g[b] ? t->g[a] < t->g[b] : a < b;
}

static void
put_in_heap (bt__free *t, uint32_t at, uint32_t cell)
{
  t->heap[at] = cell;
  t->place[cell] = at;
}

static void
rise_in_heap (bt__free *t, uint32_t at, uint32_t cell)
{
  for (; at > 0 && comes_before (t, cell, t->heap[(at - 1) / 2]); at = (at - 1) / 2)
    put_in_heap (t, at, t->heap[(at - 1) / 2]);
  put_in_heap (t, at, cell);
}

static void
sink (bt__free *t, uint32_t at, uint32_t cell)
{
  for (uint32_t child = 2 * at + 1; child < t->open; child = 2 * at + 1)
    {
      if (child + 1 < t->open && comes_before (t, t->heap[child + 1], t->heap[child]))
        child++;
      if (!comes_before (t, t->heap[child], cell))
        break;
      put_in_heap (t, at, t->heap[child]);
      at = child;
    }
  put_in_heap (t, at, cell);
}

static uint32_t
pop (bt__free *t)
{
  uint32_t top = t->heap[0];
  t->place[top] = BT__NOWHERE;
  if (--t->open > 0)
    sink (t, 0, t->heap[t->open]);
  return top;
}

/* ---- Growing ---- */

/* Give PARENT to each of the N open cells NEAR for which the way by PARENT is shorter.  */
static void
offer (bt__free *t, const uint32_t *near, uint32_t n, uint32_t parent)
{
  double base = parent == t->root ? 0 : t->g[parent];
  bt_vec3 from = bt__free_point (t, parent);
  for (uint32_t i = 0; i < n; i++)
    {
      uint32_t cell = near[i];
      if (t->closed[cell] || !(base < t->g[cell]))
        continue;
      double g = base + bt__distance (from, bt__free_point (t, cell));
      if (!(g < t->g[cell]))
        continue;
      t->g[cell] = g;
      t->parent[cell] = parent;
      rise_in_heap (t, t->place[cell] == BT__NOWHERE ? t->open++ : t->place[cell], cell);
    }
}

uint32_t
bt__free_neighbours (const bt__free *t, bt_vec3 p, int radius, uint32_t *out)
{
  int at[3];
  uint32_t n = 0;
  indices (t, p, at);
  for (int k = -radius; k <= radius; k++)
    for (int j = -radius; j <= radius; j++)
      for (int i = -radius; i <= radius; i++)
        {
          uint32_t cell = cell_number (t, at[0] + i, at[1] + j, at[2] + k);
          if (cell != BT__NOWHERE)
            out[n++] = cell;
        }
  return n;
}

/* CELL does not see its parent: give it the best closed neighbour that it sees.  */
static int
find_parent (bt__free *t, uint32_t cell, const uint32_t *near, uint32_t n, bt__count *count)
{
  bt_vec3 p = bt__free_point (t, cell);
  t->g[cell] = INFINITY;
  for (uint32_t i = 0; i < n; i++)
    if (near[i] != cell && t->closed[near[i]])
      {
        bt_vec3 q = bt__free_point (t, near[i]);
        double g = t->g[near[i]] + bt__distance (p, q);
        if (g < t->g[cell] && bt__free_sees (&t->c, p, q, t->c.clear, count))
          {
            t->g[cell] = g;
            t->parent[cell] = near[i];
          }
      }
  return t->g[cell] < INFINITY;
}

/* Close the open cell nearest to the anchor, if something closed is in its sight.  */
static void
grow_by_a_cell (bt__free *t, bt__count *count)
{
  uint32_t near[27], cell = pop (t), parent = t->parent[cell];
  bt_vec3 p = bt__free_point (t, cell);
  uint32_t n = bt__free_neighbours (t, p, 1, near);
  if (!bt__free_sees (&t->c, bt__free_point (t, parent), p, t->c.clear, count)
      && !find_parent (t, cell, near, n, count))
    return;
  t->closed[cell] = 1;
  offer (t, near, n, t->parent[cell]);
}

/* True if CELL lies in or so near an obstacle that nothing can see the cell.  */
static int
is_out_of_sight (const bt__free *t, uint32_t cell, bt__count *count)
{
  bt_vec3 p = bt__free_point (t, cell);
  return !bt__free_sees (&t->c, p, p, t->c.clear - ROUNDING, count);
}

int
bt__free_grow_to (bt__free *t, const uint32_t *near, uint32_t n, bt__asker *asker, bt__count *count)
{
  for (uint32_t i = 0; i < n; i++)
    if (!t->closed[near[i]] && !is_out_of_sight (t, near[i], count))
      while (t->open > 0 && !t->closed[near[i]])
        {
          if (bt__ask (asker))
            return 0;
          grow_by_a_cell (t, count);
        }
  return 1;
}

void
bt__free_sprout (bt__free *t)
{
  uint32_t near[27];
  t->sprouted = 1;
  t->open = 0;
  memset (t->closed, 0, t->cells);
  memset (t->place, 0xff, t->cells * sizeof *t->place);
  for (uint32_t i = 0; i < t->cells; i++)
    t->g[i] = INFINITY;
  offer (t, near, bt__free_neighbours (t, t->anchor, 1, near), t->root);
}

void
bt__free_plant (bt__free *t, bt_vec3 anchor)
{
  t->anchor = anchor;
  t->sprouted = 0;
}

static void
release (bt__free *t)
{
  if (!t)
    return;
  free (t->g);
  free (t->parent);
  free (t->heap);
  free (t->place);
  free (t->closed);
  free (t);
}

bt_status
bt__free_new (const bt__free_config *config, bt__free **out, bt_error *error)
{
  bt_vec3 size = bt__sub (config->hi, config->lo);
  double n[3] = { ceil (size.x / config->cell), ceil (size.y / config->cell),
                  ceil (size.z / config->cell) };
  *out = NULL;
  if (!(config->cell > 0) || !(n[0] >= 1) || !(n[1] >= 1) || !(n[2] >= 1) || !(config->clear >= 0))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a grid of cells of %g m over %g by %g by %g m; all must "
                     "be positive",
                     config->cell, size.x, size.y, size.z);
  if (!(n[0] * n[1] * n[2] <= BT__FREE_CELLS_MAX))
    return bt__fail (error, BT_ERR_LIMIT, "a grid of %g cells; %d at most: take larger cells",
                     n[0] * n[1] * n[2], BT__FREE_CELLS_MAX);
  bt__free *t = calloc (1, sizeof *t);
  if (t)
    {
      t->c = *config;
      t->nx = (uint32_t)n[0];
      t->ny = (uint32_t)n[1];
      t->nz = (uint32_t)n[2];
      t->root = t->cells = t->nx * t->ny * t->nz;
      t->g = malloc (t->cells * sizeof *t->g);
      t->parent = malloc (t->cells * sizeof *t->parent);
      t->heap = malloc (t->cells * sizeof *t->heap);
      t->place = malloc (t->cells * sizeof *t->place);
      t->closed = calloc (t->cells, 1);
    }
  if (t && t->g && t->parent && t->heap && t->place && t->closed
      && pthread_mutex_init (&t->lock, NULL) == 0)
    {
      *out = t;
      return BT_OK;
    }
  release (t);
  return bt__fail (error, BT_ERR_LIMIT, "no memory for a grid of %g cells", n[0] * n[1] * n[2]);
}

void
bt__free_free (bt__free *t)
{
  if (t)
    pthread_mutex_destroy (&t->lock);
  release (t);
}
