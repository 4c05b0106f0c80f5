/* Whether a tree and the rings of a mesh can be used: see mesh_sound.h.

   An open ring would hold a search for ever, a deep tree overflow the stack of a query, an item
   missing in the leaves let a line through.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "collide/mesh_sound.h"

enum
{
  DEEPEST = (BT__BVH_STACK - 1) / (BT__BVH_WIDE - 1)
};

/* ---- Numbers, each once ---- */

typedef struct marks
{
  uint64_t *word;
  uint32_t n;
} marks;

static int
marks_new (marks *s, uint32_t n)
{
  *s = (marks){ calloc ((size_t)n / 64 + 1, sizeof (uint64_t)), n };
  return s->word != NULL;
}

/* Mark I; return false if I is too large or marked before.  */
static inline int
mark (marks *s, uint32_t i)
{
  uint64_t bit = (uint64_t)1 << (i % 64);
  if (i >= s->n || s->word[i / 64] & bit)
    return 0;
  s->word[i / 64] |= bit;
  return 1;
}

/* True if AT has each number below N.  */
static int
has_each_once (const uint32_t *at, uint32_t n)
{
  marks seen;
  int good = marks_new (&seen, n);
  for (uint32_t i = 0; i < n && good; i++)
    good = mark (&seen, at[i]);
  free (seen.word);
  return good;
}

/* ---- The tree ---- */

/* DEPTH: of each node, 0 before a parent was seen; the root's is 1.  */
typedef struct climb
{
  const bt__bvh *tree;
  uint8_t *depth;
  marks items;
  uint32_t found; /* items in leaves */
} climb;

static int
box_is_sound (const bt__bvh_node *node, int i)
{
  for (int k = 0; k < 3; k++)
    if (!isfinite (node->centre[k][i]) || !isfinite (node->half[k][i]) || node->half[k][i] < 0)
      return 0;
  return 1;
}

static int
leaf_is_sound (climb *c, uint32_t first, uint32_t count)
{
  if (count > c->tree->n)
    return 0;
  for (uint32_t i = 0; i < count; i++)
    if (!mark (&c->items, first + i))
      return 0;
  c->found += count;
  return 1;
}

static int
is_missing (const bt__bvh_node *node, int i)
{
  return node->half[0][i] < 0 && node->half[1][i] < 0 && node->half[2][i] < 0
         && node->centre[0][i] == 0 && node->centre[1][i] == 0 && node->centre[2][i] == 0
         && node->first[i] == 0 && node->count[i] == 0;
}

/* A parent stands before its children.  */
static int
child_is_sound (climb *c, uint32_t at, int i)
{
  const bt__bvh_node *node = c->tree->node + at;
  uint32_t first = node->first[i];
  if (is_missing (node, i))
    return 1;
  if (!box_is_sound (node, i))
    return 0;
  if (node->count[i] > 0)
    return leaf_is_sound (c, first, node->count[i]);
  if (first <= at || first >= c->tree->nodes || c->depth[first] || c->depth[at] >= DEEPEST)
    return 0;
  c->depth[first] = (uint8_t)(c->depth[at] + 1);
  return 1;
}

static int
nodes_are_sound (climb *c)
{
  c->depth[0] = 1;
  for (uint32_t at = 0; at < c->tree->nodes; at++)
    for (int i = 0; i < BT__BVH_WIDE; i++)
      if (c->depth[at] == 0 || !child_is_sound (c, at, i))
        return 0;
  return c->found == c->tree->n;
}

int
bt__tree_is_sound (const bt__bvh *tree)
{
  climb c = { .tree = tree, .depth = calloc (tree->nodes, 1) };
  int good = marks_new (&c.items, tree->n) && c.depth && nodes_are_sound (&c)
             && has_each_once (tree->order, tree->n);
  free (c.depth);
  free (c.items.word);
  return good;
}

/* ---- Rings ---- */

static inline bt_vec3
corner_point (const bt__mesh *m, uint32_t c)
{
  return m->v[m->corner[c / 3][c % 3]];
}

static inline int
is_same (bt_vec3 a, bt_vec3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

static inline uint32_t
corner_after (uint32_t c)
{
  return c % 3 == 2 ? c - 2 : c + 1;
}

static int
neighbours_are_sound (const bt__mesh *m, uint32_t c)
{
  uint32_t other = m->next_edge[c];
  bt_vec3 a = corner_point (m, c);
  if (!is_same (a, corner_point (m, m->next_corner[c])))
    return 0;
  if (other == c)
    return 1;
  bt_vec3 b = corner_point (m, corner_after (c)), from = corner_point (m, other),
          to = corner_point (m, corner_after (other));
  return (is_same (a, from) && is_same (b, to)) || (is_same (a, to) && is_same (b, from));
}

int
bt__rings_are_sound (const bt__mesh *m)
{
  uint32_t corners = 3 * m->triangles;
  if (!has_each_once (m->next_corner, corners) || !has_each_once (m->next_edge, corners))
    return 0;
  for (uint32_t c = 0; c < corners; c++)
    if (!neighbours_are_sound (m, c))
      return 0;
  for (uint32_t i = 0; i < m->triangles; i++)
    if (m->folds[i] > 7)
      return 0;
  return 1;
}
