/* The neighbours of a mesh's triangles: rings of corners and of edges.

   All corners of triangles at one point form a ring, and all edges of triangles between the same
   two points form a ring, whatever the number of triangles there.  Points are the same if their
   coordinates are: a soup may give each triangle its own vertices.  A hash table names each vertex
   after the first vertex at its place.  Edges are sorted by their lower end; the edges of one lower
   end are joined by a list of higher ends, cleared afterwards.  Time grows with the number of
   edges, however many meet in one point.

   An edge is a fold unless exactly two triangles share it and lie in one plane.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "collide/mesh.h"

enum
{
  ITEMS_A_QUESTION = 8192 /* between two questions whether to go on */
};

#define NONE UINT32_MAX

typedef struct low_edge
{
  uint32_t edge, high; /* 3 slot + i; its higher end */
} low_edge;

typedef struct joining
{
  bt__mesh *mesh;
  uint32_t *point; /* by vertex: the first vertex at its place */
  uint32_t *first; /* by point: the first of a ring, or NONE */
  uint32_t *end;   /* by point: end in EDGE of the edges with this lower end */
  low_edge *edge;
} joining;

static int
is_interrupted (bt__asker *asker, uint32_t i)
{
  return i % ITEMS_A_QUESTION == 0 && bt__ask (asker);
}

/* ---- Points ---- */

static int
is_same_point (bt_vec3 a, bt_vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Return the entry of TABLE, of MASK + 1 entries, a vertex of M at P or NONE.  */
static uint32_t *
find_point (const bt__mesh *m, uint32_t *table, size_t mask, bt_vec3 p)
{
  bt_vec3 key = bt__vec (p.x + 0.0, p.y + 0.0, p.z + 0.0); /* -0 is 0 */
  size_t at = bt__hash (&key, sizeof key, 0) & mask;
  while (table[at] != NONE && !is_same_point (m->v[table[at]], p))
    at = (at + 1) & mask;
  return table + at;
}

/* True if there was memory.  */
static int
name_points (joining *j)
{
  const bt__mesh *m = j->mesh;
  size_t size = 16;
  while (size < 2 * (size_t)m->vertices)
    size *= 2;
  uint32_t *table = malloc (size * sizeof *table);
  if (!table)
    return 0;
  memset (table, 0xff, size * sizeof *table);
  for (uint32_t v = 0; v < m->vertices; v++)
    {
      uint32_t *entry = find_point (m, table, size - 1, m->v[v]);
      if (*entry == NONE)
        *entry = v;
      j->point[v] = *entry;
    }
  free (table);
  return 1;
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

/* Join the corners of SLOT, and count its edges at their lower ends.  An edge without length is a
   ring of its own.  */
static void
join_corners (joining *j, uint32_t slot)
{
  bt__mesh *m = j->mesh;
  for (uint32_t i = 0, c = 3 * slot; i < 3; i++, c++)
    {
      uint32_t ends[2];
      add_to_ring (m->next_corner, j->first + j->point[m->corner[slot][i]], c);
      m->next_edge[c] = c;
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
join_edges (joining *j, const low_edge *edge, uint32_t n)
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

/* True if it was finished.  */
static int
join_all (joining *j, bt__asker *asker)
{
  const bt__mesh *m = j->mesh;
  memset (j->first, 0xff, m->vertices * sizeof *j->first);
  for (uint32_t slot = 0; slot < m->triangles; slot++)
    {
      if (is_interrupted (asker, slot))
        return 0;
      join_corners (j, slot);
    }
  memset (j->first, 0xff, m->vertices * sizeof *j->first);
  add_up (j);
  for (uint32_t slot = 0; slot < m->triangles; slot++)
    {
      if (is_interrupted (asker, slot))
        return 0;
      sort_edges (j, slot);
    }
  for (uint32_t v = 0, begin = 0; v < m->vertices; begin = j->end[v++])
    {
      if (is_interrupted (asker, v))
        return 0;
      join_edges (j, j->edge + begin, j->end[v] - begin);
    }
  return 1;
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
      m->folds[slot] |= (uint8_t)(1 << i);
      if (two)
        m->folds[other / 3] |= (uint8_t)(1 << other % 3);
    }
}

static int
find_all_folds (bt__mesh *m, bt__asker *asker)
{
  for (uint32_t slot = 0; slot < m->triangles; slot++)
    {
      if (is_interrupted (asker, slot))
        return 0;
      find_folds (m, slot);
    }
  return 1;
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
  j->point = malloc (m->vertices * sizeof *j->point);
  j->first = malloc (m->vertices * sizeof *j->first);
  j->end = calloc (m->vertices, sizeof *j->end);
  j->edge = malloc (corners * sizeof *j->edge);
  return m->next_corner && m->next_edge && m->folds && j->point && j->first && j->end && j->edge;
}

bt_status
bt__mesh_find_rings (bt__mesh *m, bt__asker *asker, bt_error *error)
{
  joining j = { .mesh = m };
  bt_status status = BT_OK;
  if (!reserve_rings (&j) || !name_points (&j))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for the edges of %u triangles",
                       (unsigned)m->triangles);
  else if (!join_all (&j, asker) || !find_all_folds (m, asker))
    status = bt__stopped (asker, error);
  free (j.point);
  free (j.first);
  free (j.end);
  free (j.edge);
  return status;
}
