/* Lazy Theta* (Nash, Koenig and Tovey 2010).  A cell first inherits the parent of the cell from
   which it was reached, untested.  When the cell is expanded, the line of sight to the parent is
   tested once; if the sight is blocked, the best neighbour in sight becomes the parent.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/free.h"
#include "base/error.h"

#define NOWHERE UINT32_MAX

struct bt__free
{
  bt__free_config c;
  bt_vec3 anchor;
  uint32_t nx, ny, nz, cells, root; /* root: the number of the anchor, after all cells */
  double *g;                        /* m from the anchor */
  uint32_t *parent;
  uint32_t *heap, *place; /* open cells, least g first; where a cell is in it */
  uint32_t open;
  uint8_t *closed;
};

/* ---- The grid ---- */

static uint32_t
cell_number (const bt__free *t, int i, int j, int k)
{
  if (i < 0 || j < 0 || k < 0 || i >= (int)t->nx || j >= (int)t->ny || k >= (int)t->nz)
    return NOWHERE;
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

static bt_vec3
point_of (const bt__free *t, uint32_t cell)
{
  if (cell == t->root)
    return t->anchor;
  uint32_t i = cell % t->nx, j = cell / t->nx % t->ny, k = cell / t->nx / t->ny;
  return bt__axpy (t->c.lo, t->c.cell, bt__vec (i + 0.5, j + 0.5, k + 0.5));
}

static int
sees_past (const bt__free_config *c, bt_vec3 a, bt_vec3 b, double clear, bt__count *count)
{
  bt__link link = { a, b };
  bt__near near;
  return !bt__scene_nearest (c->scene, c->on, &link, clear, &near, count);
}

static int
sees (const bt__free *t, bt_vec3 a, bt_vec3 b, double clear, bt__count *count)
{
  return sees_past (&t->c, a, b, clear, count);
}

int
bt__free_sees (const bt__free_config *config, bt_vec3 a, bt_vec3 b, bt__count *count)
{
  return sees_past (config, a, b, config->clear, count);
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
  t->place[top] = NOWHERE;
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
  bt_vec3 from = point_of (t, parent);
  for (uint32_t i = 0; i < n; i++)
    {
      uint32_t cell = near[i];
      if (t->closed[cell] || !(base < t->g[cell]))
        continue;
      double g = base + bt__distance (from, point_of (t, cell));
      if (!(g < t->g[cell]))
        continue;
      t->g[cell] = g;
      t->parent[cell] = parent;
      rise_in_heap (t, t->place[cell] == NOWHERE ? t->open++ : t->place[cell], cell);
    }
}

/* Call the neighbours of P within RADIUS cells, into OUT; return their number.  */
static uint32_t
neighbours (const bt__free *t, bt_vec3 p, int radius, uint32_t *out)
{
  int at[3];
  uint32_t n = 0;
  indices (t, p, at);
  for (int k = -radius; k <= radius; k++)
    for (int j = -radius; j <= radius; j++)
      for (int i = -radius; i <= radius; i++)
        {
          uint32_t cell = cell_number (t, at[0] + i, at[1] + j, at[2] + k);
          if (cell != NOWHERE)
            out[n++] = cell;
        }
  return n;
}

/* CELL does not see its parent: give it the best closed neighbour that it sees.  */
static int
find_parent (bt__free *t, uint32_t cell, const uint32_t *near, uint32_t n, bt__count *count)
{
  bt_vec3 p = point_of (t, cell);
  t->g[cell] = INFINITY;
  for (uint32_t i = 0; i < n; i++)
    if (near[i] != cell && t->closed[near[i]])
      {
        bt_vec3 q = point_of (t, near[i]);
        double g = t->g[near[i]] + bt__distance (p, q);
        if (g < t->g[cell] && sees (t, p, q, t->c.clear, count))
          {
            t->g[cell] = g;
            t->parent[cell] = near[i];
          }
      }
  return t->g[cell] < INFINITY;
}

int
bt__free_grow (bt__free *t, bt_vec3 anchor, bt__asker *asker, bt__count *count)
{
  uint32_t near[27], n;
  t->anchor = anchor;
  t->open = 0;
  memset (t->closed, 0, t->cells);
  memset (t->place, 0xff, t->cells * sizeof *t->place);
  for (uint32_t i = 0; i < t->cells; i++)
    t->g[i] = INFINITY;
  n = neighbours (t, anchor, 1, near);
  offer (t, near, n, t->root);
  while (t->open > 0 && !bt__ask (asker))
    {
      uint32_t cell = pop (t), parent = t->parent[cell];
      bt_vec3 p = point_of (t, cell);
      n = neighbours (t, p, 1, near);
      if (!sees (t, point_of (t, parent), p, t->c.clear, count)
          && !find_parent (t, cell, near, n, count))
        continue;
      t->closed[cell] = 1;
      offer (t, near, n, t->parent[cell]);
    }
  return t->open == 0;
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
  if (t && t->g && t->parent && t->heap && t->place && t->closed)
    {
      *out = t;
      return BT_OK;
    }
  bt__free_free (t);
  return bt__fail (error, BT_ERR_LIMIT, "no memory for a grid of %g cells", n[0] * n[1] * n[2]);
}

void
bt__free_free (bt__free *t)
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

/* ---- Asking ---- */

enum
{
  WIDE = 2,
  CANDIDATES = 2 * 125
};

typedef struct candidates
{
  uint32_t n, cell[CANDIDATES];
  double g[CANDIDATES]; /* the way to P through it, if P sees it */
} candidates;

static void
add_candidate (const bt__free *t, candidates *c, uint32_t cell, bt_vec3 p)
{
  for (uint32_t i = 0; i < c->n; i++)
    if (c->cell[i] == cell)
      return;
  double base = cell == t->root ? 0 : t->g[cell];
  c->cell[c->n] = cell;
  c->g[c->n++] = base + bt__distance (point_of (t, cell), p);
}

/* Return the candidate in sight of P with the shortest way through it; NOWHERE if none is in sight.
 */
static uint32_t
best_in_sight (const bt__free *t, candidates *c, bt_vec3 p, double clear, bt__count *count)
{
  while (c->n > 0)
    {
      uint32_t best = 0;
      for (uint32_t i = 1; i < c->n; i++)
        if (c->g[i] < c->g[best])
          best = i;
      uint32_t cell = c->cell[best];
      if (sees (t, point_of (t, cell), p, clear, count))
        return cell;
      c->cell[best] = c->cell[--c->n];
      c->g[best] = c->g[c->n];
    }
  return NOWHERE;
}

static uint32_t
last_corner (const bt__free *t, bt_vec3 p, double clear, int radius, bt__count *count)
{
  uint32_t near[125], n = neighbours (t, p, radius, near);
  candidates c = { .n = 0 };
  for (uint32_t i = 0; i < n; i++)
    if (t->closed[near[i]])
      {
        add_candidate (t, &c, t->parent[near[i]], p);
        add_candidate (t, &c, near[i], p);
      }
  return best_in_sight (t, &c, p, clear, count);
}

/* Put into WAY (BT__FREE_WAY_MAX points of room) the corners of a way from the anchor to P; return
   their number, 0 if none was found.  */
static uint32_t
trace_way (const bt__free *t, bt_vec3 p, bt_vec3 *way, bt__count *count)
{
  uint32_t corner = NOWHERE, n = 0;
  if (sees (t, t->anchor, p, t->c.clear, count))
    corner = t->root;
  for (int radius = 1; corner == NOWHERE && radius <= WIDE; radius++)
    corner = last_corner (t, p, t->c.clear, radius, count);
  if (corner == NOWHERE) /* P itself is near something */
    corner = last_corner (t, p, 0.2 * t->c.clear, WIDE, count);
  if (corner == NOWHERE)
    return 0;
  for (uint32_t at = corner; n < BT__FREE_WAY_MAX; at = t->parent[at])
    {
      way[n++] = point_of (t, at);
      if (at == t->root)
        break;
    }
  if (n == BT__FREE_WAY_MAX) /* P needs room too */
    return 0;
  for (uint32_t i = 0; i < n / 2; i++)
    {
      bt_vec3 swap = way[i];
      way[i] = way[n - 1 - i];
      way[n - 1 - i] = swap;
    }
  way[n] = p;
  return n + 1;
}

double
bt__string_length (const bt__taut_config *config, const bt__string *s, bt__count *count)
{
  bt__corner hold[512];
  bt__holds list = { hold, 0, 512, 0 };
  bt__holds_find (config->scene, config->on, s->x, s->n, config->core, 0.05, &list, count);
  return bt__holds_length (&list, s->x, s->n);
}

int
bt__free_way (const bt__free *t, bt_vec3 from, bt_vec3 p, bt__string *string, bt__count *count)
{
  bt_vec3 room[BT__FREE_WAY_MAX + 1] = { from };
  uint32_t ahead = bt__distance (from, t->anchor) > 0, n = trace_way (t, p, room + 1, count);
  return n > 0 && bt__string_lay (string, room + 1 - ahead, n + ahead);
}

double
bt__free_tighten (bt__taut *taut, const bt__taut_config *config, uint32_t steps, bt__string *way,
                  bt__count *count)
{
  if (way->n > 2)
    bt__taut_relax (taut, config, way, steps, count);
  return bt__string_length (config, way, count);
}
