/* A mesh's triangles in the order of the leaves of its tree, and their neighbours: rings of corners
   and of edges.

   All corners of triangles at one point form a ring, and all edges of triangles between the same
   two points form a ring, whatever the number of triangles there.  Points are the same if their
   coordinates are: a soup may give each triangle its own vertices.  A hash table names each vertex
   after the first vertex at its place.  Edges are sorted by their lower end; the edges of one lower
   end are joined by a list of higher ends, cleared afterwards.  Time grows with the number of
   edges, however many meet in one point.

   Workers share two tasks, the order of corners and the names of points; then two more, rings of
   corners and rings of edges; then the folds of ranges of triangles.

   An edge is a fold unless exactly two triangles share it and lie in one plane.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "collide/mesh.h"

enum
{
  ITEMS_A_QUESTION = 8192, /* between two questions whether to go on */
  FOLD_TASKS = 16
};

#define NONE UINT32_MAX

typedef struct low_edge
{
  uint32_t edge, high; /* 3 slot + i; its higher end */
} low_edge;

typedef struct joining
{
  bt__mesh *mesh;
  const bt__soup *soup;
  bt__asker *asker; /* asked by worker 0, who is the caller */
  atomic_int ended; /* true from when the asker said so */
  uint32_t *table;  /* vertices, by a hash of their places */
  size_t mask;      /* its entries less one, a power of two */
  uint32_t *point;  /* by vertex: the first vertex at its place */
  uint32_t *corner; /* by point: the first of a ring of corners, or NONE */
  uint32_t *first;  /* by point: the first of a ring of edges, or NONE */
  uint32_t *end;    /* by point: end in EDGE of the edges with this lower end */
  low_edge *edge;
} joining;

/* Is the work of worker W to be left at item I?  */
static int
is_left (joining *j, int w, uint32_t i)
{
  if (i % ITEMS_A_QUESTION)
    return 0;
  if (w == 0 && bt__ask (j->asker))
    atomic_store_explicit (&j->ended, 1, memory_order_relaxed);
  return atomic_load_explicit (&j->ended, memory_order_relaxed);
}

/* ---- Points ---- */

static int
is_same_point (bt_vec3 a, bt_vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Return the entry of J's table with a vertex at P or NONE.  */
static uint32_t *
find_point (const joining *j, bt_vec3 p)
{
  bt_vec3 key = bt__vec (p.x + 0.0, p.y + 0.0, p.z + 0.0); /* -0 is 0 */
  size_t at = bt__hash (&key, sizeof key, 0) & j->mask;
  while (j->table[at] != NONE && !is_same_point (j->mesh->v[j->table[at]], p))
    at = (at + 1) & j->mask;
  return j->table + at;
}

static void
name_points (joining *j, int w)
{
  const bt__mesh *m = j->mesh;
  memset (j->table, 0xff, (j->mask + 1) * sizeof *j->table);
  for (uint32_t v = 0; v < m->vertices && !is_left (j, w, v); v++)
    {
      uint32_t *entry = find_point (j, m->v[v]);
      if (*entry == NONE)
        *entry = v;
      j->point[v] = *entry;
    }
}

/* ---- Order ---- */

void
bt__mesh_put_in_order (bt__mesh *m, const bt__soup *s)
{
  for (uint32_t i = 0; i < m->triangles; i++)
    {
      uint32_t from = m->tree.order[i];
      memcpy (m->corner[i], s->corner[from], sizeof *m->corner);
      m->id[i] = s->id ? s->id[from] : from;
    }
}

static void
find_box (bt__mesh *m)
{
  bt_vec3 first = m->v[m->corner[0][0]];
  bt__aabb b = { first, first };
  for (uint32_t i = 0; i < m->triangles; i++)
    for (int k = 0; k < 3; k++)
      b = bt__box_with (b, m->v[m->corner[i][k]]);
  m->box = b;
}

static void
sort_or_name (void *user, int w, int task)
{
  joining *j = user;
  if (task == 0)
    name_points (j, w);
  else
    {
      bt__mesh_put_in_order (j->mesh, j->soup);
      find_box (j->mesh);
    }
}

/* ---- Rings ---- */

/* Put I into the ring of *FIRST in NEXT; alone, I becomes *FIRST.  */
static void
add_to_ring (uint32_t *next, uint32_t *first, uint32_t i)
{
  next[i] = i;
  if (*first == NONE)
    *first = i;
  else
    {
      next[i] = next[*first];
      next[*first] = i;
    }
}

/* The ends of edge I of triangle SLOT, the lower first.  */
static void
find_ends (const joining *j, uint32_t slot, uint32_t i, uint32_t ends[2])
{
  const uint32_t *corner = j->mesh->corner[slot];
  uint32_t a = j->point[corner[i]], b = j->point[corner[(i + 1) % 3]];
  ends[0] = a < b ? a : b;
  ends[1] = a < b ? b : a;
}

static void
join_corners (joining *j, int w)
{
  bt__mesh *m = j->mesh;
  memset (j->corner, 0xff, m->vertices * sizeof *j->corner);
  for (uint32_t slot = 0; slot < m->triangles && !is_left (j, w, slot); slot++)
    for (uint32_t i = 0; i < 3; i++)
      add_to_ring (m->next_corner, j->corner + j->point[m->corner[slot][i]], 3 * slot + i);
}

/* Count the edges of SLOT at their lower ends.  An edge without length is a ring of its own.  */
static void
count_edges (joining *j, uint32_t slot)
{
  for (uint32_t i = 0; i < 3; i++)
    {
      uint32_t ends[2];
      j->mesh->next_edge[3 * slot + i] = 3 * slot + i;
      find_ends (j, slot, i, ends);
      j->end[ends[0]] += ends[0] != ends[1];
    }
}

static void
sort_edges (joining *j, uint32_t slot)
{
  for (uint32_t i = 0; i < 3; i++)
    {
      uint32_t ends[2];
      find_ends (j, slot, i, ends);
      if (ends[0] != ends[1])
        j->edge[j->end[ends[0]]++] = (low_edge){ 3 * slot + i, ends[1] };
    }
}

/* Join N edges of one lower end.  */
static void
join_some (joining *j, const low_edge *edge, uint32_t n)
{
  for (uint32_t i = 0; i < n; i++)
    add_to_ring (j->mesh->next_edge, j->first + edge[i].high, edge[i].edge);
  for (uint32_t i = 0; i < n; i++)
    j->first[edge[i].high] = NONE;
}

/* Replace the number of edges of each point by the place of its first edge.  */
static void
add_up (joining *j)
{
  uint32_t sum = 0;
  for (uint32_t v = 0; v < j->mesh->vertices; v++)
    {
      uint32_t n = j->end[v];
      j->end[v] = sum;
      sum += n;
    }
}

static void
join_edges (joining *j, int w)
{
  const bt__mesh *m = j->mesh;
  memset (j->first, 0xff, m->vertices * sizeof *j->first);
  for (uint32_t slot = 0; slot < m->triangles && !is_left (j, w, slot); slot++)
    count_edges (j, slot);
  add_up (j);
  for (uint32_t slot = 0; slot < m->triangles; slot++)
    {
      if (is_left (j, w, slot))
        return;
      sort_edges (j, slot);
    }
  for (uint32_t v = 0, begin = 0; v < m->vertices && !is_left (j, w, v); begin = j->end[v++])
    join_some (j, j->edge + begin, j->end[v] - begin);
}

static void
join (void *user, int w, int task)
{
  if (task == 0)
    join_edges (user, w);
  else
    join_corners (user, w);
}

/* ---- Folds ---- */

/* The direction from edge EDGE of M into its triangle, in the plane of the triangle and across the
   edge; zero without area.  */
static bt_vec3
into_triangle (const bt__mesh *m, uint32_t edge)
{
  bt__triangle t = bt__mesh_triangle (m, edge / 3);
  uint32_t i = edge % 3;
  bt_vec3 a = t.v[i], e = bt__sub (t.v[(i + 1) % 3], a), c = bt__sub (t.v[(i + 2) % 3], a);
  bt_vec3 in = bt__axpy (c, -bt__dot (c, e) / bt__dot (e, e), e);
  return bt__unit_or (in, bt__vec (0, 0, 0));
}

static int
is_fold (const bt__mesh *m, uint32_t edge, uint32_t other)
{
  bt_vec3 sum = bt__add (into_triangle (m, edge), into_triangle (m, other));
  return !(bt__dot (sum, sum) <= BT__MESH_FLAT * BT__MESH_FLAT);
}

/* Another worker may look at another edge of triangle SLOT.  */
static void
set_fold (bt__mesh *m, uint32_t slot, uint32_t i)
{
  __atomic_fetch_or (m->folds + slot, (uint8_t)(1 << i), __ATOMIC_RELAXED);
}

/* Each pair of edges is looked at once, for both.  */
static void
find_folds (bt__mesh *m, uint32_t slot)
{
  for (uint32_t i = 0, edge = 3 * slot; i < 3; i++, edge++)
    {
      uint32_t other = m->next_edge[edge];
      int two = other != edge && m->next_edge[other] == edge;
      if (two && other < edge)
        continue;
      if (two && !is_fold (m, edge, other))
        continue;
      set_fold (m, slot, i);
      if (two)
        set_fold (m, other / 3, other % 3);
    }
}

/* The folds of one of FOLD_TASKS ranges of triangles.  */
static void
find_folds_of_range (void *user, int w, int task)
{
  joining *j = user;
  uint64_t n = j->mesh->triangles;
  uint32_t slot = (uint32_t)(n * (uint64_t)task / FOLD_TASKS),
           end = (uint32_t)(n * ((uint64_t)task + 1) / FOLD_TASKS);
  for (; slot < end && !is_left (j, w, slot); slot++)
    find_folds (j->mesh, slot);
}

/* ---- All ---- */

static int
reserve_rings (joining *j)
{
  bt__mesh *m = j->mesh;
  size_t corners = 3 * (size_t)m->triangles;
  m->next_corner = malloc (corners * sizeof *m->next_corner);
  m->next_edge = malloc (corners * sizeof *m->next_edge);
  m->folds = calloc (m->triangles, 1);
  j->mask = 16;
  while (j->mask < 2 * (size_t)m->vertices)
    j->mask *= 2;
  j->table = malloc (j->mask * sizeof *j->table);
  j->mask--;
  j->point = malloc (m->vertices * sizeof *j->point);
  j->corner = malloc (m->vertices * sizeof *j->corner);
  j->first = malloc (m->vertices * sizeof *j->first);
  j->end = calloc (m->vertices, sizeof *j->end);
  j->edge = malloc (corners * sizeof *j->edge);
  return m->next_corner && m->next_edge && m->folds && j->table && j->point && j->corner && j->first
         && j->end && j->edge;
}

static void
do_all (joining *j, bt__workers *workers)
{
  bt__workers_run (workers, 2, sort_or_name, NULL, j);
  if (!j->ended)
    bt__workers_run (workers, 2, join, NULL, j);
  if (!j->ended)
    bt__workers_run (workers, FOLD_TASKS, find_folds_of_range, NULL, j);
}

bt_status
bt__mesh_sort (bt__mesh *m, const bt__soup *soup, bt__workers *workers, bt__asker *asker,
               bt_error *error)
{
  joining j = { .mesh = m, .soup = soup, .asker = asker };
  bt_status status = BT_OK;
  if (reserve_rings (&j))
    do_all (&j, workers);
  else
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for the edges of %u triangles",
                       (unsigned)m->triangles);
  free (j.table);
  free (j.point);
  free (j.corner);
  free (j.first);
  free (j.end);
  free (j.edge);
  return status ? status : bt__stopped (asker, error);
}
