/* The neighbours of a mesh's triangles: rings of corners and of edges.

   All corners of triangles at one point form a ring, and all edges of triangles between the same
   two points form a ring, whatever the number of triangles there.  Points are the same if their
   coordinates are: a soup may give each triangle its own vertices.  Both rings are found in one
   pass over the triangles, with a hash table of points and another of pairs of points.

   An edge is a fold unless exactly two triangles share it and lie in one plane.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "collide/mesh.h"

enum
{
  TRIANGLES_A_QUESTION = 8192 /* between two questions whether to go on */
};

#define NONE UINT32_MAX

/* Open addressing: an entry is a vertex of the soup, or an edge, or NONE.  */
typedef struct table
{
  uint32_t *entry;
  size_t mask;
} table;

static int
table_new (table *t, size_t items)
{
  size_t size = 16;
  while (size < 2 * items)
    size *= 2;
  t->mask = size - 1;
  t->entry = malloc (size * sizeof *t->entry);
  if (t->entry)
    memset (t->entry, 0xff, size * sizeof *t->entry);
  return t->entry != NULL;
}

static int
is_same_point (bt_vec3 a, bt_vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Return the first vertex of M that was asked for at the place of vertex V.  */
static uint32_t
point_of (const bt__mesh *m, table *t, uint32_t v)
{
  bt_vec3 p = m->v[v], key = bt__vec (p.x + 0.0, p.y + 0.0, p.z + 0.0); /* -0 is 0 */
  size_t at = bt__hash (&key, sizeof key, 0) & t->mask;
  while (t->entry[at] != NONE && !is_same_point (m->v[t->entry[at]], p))
    at = (at + 1) & t->mask;
  if (t->entry[at] == NONE)
    t->entry[at] = v;
  return t->entry[at];
}

/* Put I into the ring of FIRST.  */
static void
add_to_ring (uint32_t *next, uint32_t first, uint32_t i)
{
  next[i] = next[first];
  next[first] = i;
}

/* The points of edge E of triangle SLOT, the smaller first; POINT is by corner.  */
static void
ends_of_edge (const uint32_t *point, uint32_t edge, uint32_t ends[2])
{
  uint32_t e = edge % 3, a = point[edge], b = point[edge - e + (e + 1) % 3];
  ends[0] = a < b ? a : b;
  ends[1] = a < b ? b : a;
}

static void
join_edge (bt__mesh *m, table *t, const uint32_t *point, uint32_t edge)
{
  uint32_t ends[2], its[2];
  ends_of_edge (point, edge, ends);
  m->next_edge[edge] = edge;
  if (ends[0] == ends[1])
    return;
  size_t at = bt__hash (ends, sizeof ends, 0) & t->mask;
  for (; t->entry[at] != NONE; at = (at + 1) & t->mask)
    {
      ends_of_edge (point, t->entry[at], its);
      if (its[0] == ends[0] && its[1] == ends[1])
        break;
    }
  if (t->entry[at] == NONE)
    t->entry[at] = edge;
  else
    add_to_ring (m->next_edge, t->entry[at], edge);
}

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
is_fold (const bt__mesh *m, uint32_t edge)
{
  uint32_t other = m->next_edge[edge];
  if (other == edge || m->next_edge[other] != edge)
    return 1;
  bt_vec3 sum = bt__add (into_triangle (m, edge), into_triangle (m, other));
  return !(bt__dot (sum, sum) <= BT__MESH_FLAT * BT__MESH_FLAT);
}

/* ---- All ---- */

static int
reserve_rings (bt__mesh *m, table *points, table *edges, uint32_t **point)
{
  size_t corners = 3 * (size_t)m->triangles;
  m->next_corner = malloc (corners * sizeof *m->next_corner);
  m->next_edge = malloc (corners * sizeof *m->next_edge);
  m->folds = calloc (m->triangles, 1);
  *point = malloc (corners * sizeof **point);
  return m->next_corner && m->next_edge && m->folds && *point && table_new (points, m->vertices)
         && table_new (edges, corners);
}

static void
join_triangle (bt__mesh *m, table *points, table *edges, uint32_t *point, uint32_t slot,
               uint32_t *of_point)
{
  for (uint32_t i = 0, c = 3 * slot; i < 3; i++, c++)
    {
      uint32_t v = point_of (m, points, m->corner[slot][i]);
      point[c] = v;
      m->next_corner[c] = c;
      if (of_point[v] == NONE)
        of_point[v] = c;
      else
        add_to_ring (m->next_corner, of_point[v], c);
    }
  for (uint32_t i = 0; i < 3; i++)
    join_edge (m, edges, point, 3 * slot + i);
}

/* True if it was finished.  */
static int
join_all (bt__mesh *m, bt__asker *asker, table *points, table *edges, uint32_t *point,
          uint32_t *of_point)
{
  memset (of_point, 0xff, m->vertices * sizeof *of_point);
  for (uint32_t slot = 0; slot < m->triangles; slot++)
    {
      if (slot % TRIANGLES_A_QUESTION == 0 && bt__ask (asker))
        return 0;
      join_triangle (m, points, edges, point, slot, of_point);
    }
  for (uint32_t slot = 0; slot < m->triangles; slot++)
    {
      if (slot % TRIANGLES_A_QUESTION == 0 && bt__ask (asker))
        return 0;
      for (uint32_t e = 0; e < 3; e++)
        m->folds[slot] |= (uint8_t)(is_fold (m, 3 * slot + e) << e);
    }
  return 1;
}

bt_status
bt__mesh_find_rings (bt__mesh *m, bt__asker *asker, bt_error *error)
{
  table points = { NULL, 0 }, edges = { NULL, 0 };
  uint32_t *point = NULL, *of_point = malloc (m->vertices * sizeof *of_point);
  bt_status status = BT_OK;
  if (!of_point || !reserve_rings (m, &points, &edges, &point))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for the edges of %u triangles",
                       (unsigned)m->triangles);
  else if (!join_all (m, asker, &points, &edges, point, of_point))
    status = bt__stopped (asker, error);
  free (points.entry);
  free (edges.entry);
  free (point);
  free (of_point);
  return status;
}
