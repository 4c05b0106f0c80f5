/* Building the tree: the items are parted by the surface area heuristic over bins (Wald 2007), the
   largest part of a node first, until the node has its eight children; then each child in turn.

   Below DEEP levels parts are halved: no arrangement of boxes makes the tree deep.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <float.h>
#include <stdlib.h>

#include "base/error.h"
#include "collide/bvh.h"

enum
{
  BINS = 16,
  LEAF = 4,
  DEEP = 24,
  ITEMS_A_QUESTION = 1 << 16
};

typedef struct bounds
{
  float lo[3], hi[3];
} bounds;

typedef struct part
{
  uint32_t first, n;
  bounds box, middles; /* of the items, of twice their centres */
} part;

/* ---- Memory ---- */

void
bt__bvh_trim (bt__bvh *tree)
{
  free (tree->item);
  tree->item = NULL;
}

void
bt__bvh_free (bt__bvh *tree)
{
  bt__bvh_trim (tree);
  free (tree->node);
  free (tree->order);
  *tree = (bt__bvh){ 0 };
}

bt_status
bt__bvh_reserve (bt__bvh *tree, uint32_t n, bt_error *error)
{
  if (n > BT__BVH_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "%u things to collide with; at most %d are allowed",
                     (unsigned)n, BT__BVH_MAX);
  /* A node below the root is made for more than LEAF items and has more than LEAF children.  */
  uint32_t nodes = n / LEAF + 2;
  *tree = (bt__bvh){ .room = n, .node_room = nodes };
  tree->node = malloc (nodes * sizeof *tree->node);
  tree->order = malloc (((size_t)n + 1) * sizeof *tree->order);
  tree->item = malloc (((size_t)n + 1) * sizeof *tree->item);
  if (tree->node && tree->order && tree->item)
    return BT_OK;
  bt__bvh_free (tree);
  return bt__fail (error, BT_ERR_LIMIT, "no memory for a tree of %u boxes", (unsigned)n);
}

/* ---- Boxes ---- */

static inline float
smaller (float a, float b)
{
  return a < b ? a : b;
}

static inline float
larger (float a, float b)
{
  return a > b ? a : b;
}

static const bounds nothing = { { FLT_MAX, FLT_MAX, FLT_MAX }, { -FLT_MAX, -FLT_MAX, -FLT_MAX } };

static inline void
include (bounds *b, const float lo[3], const float hi[3])
{
  for (int k = 0; k < 3; k++)
    {
      b->lo[k] = smaller (b->lo[k], lo[k]);
      b->hi[k] = larger (b->hi[k], hi[k]);
    }
}

static inline float
area (const bounds *b)
{
  float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}

static inline void
double_centre (const bt__bvh_item *item, float c[3])
{
  for (int k = 0; k < 3; k++)
    c[k] = item->lo[k] + item->hi[k];
}

static void
measure_boxes (const bt__bvh *tree, part *p)
{
  p->box = p->middles = nothing;
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      float c[3];
      double_centre (tree->item + i, c);
      include (&p->box, tree->item[i].lo, tree->item[i].hi);
      include (&p->middles, c, c);
    }
}

/* ---- Parting ---- */

typedef struct bin
{
  bounds box;
  uint32_t n;
} bin;

typedef struct cut
{
  int axis, at; /* items in bins below AT go left */
  float from, scale;
} cut;

static inline int
item_bin (float c, float from, float scale)
{
  int b = (int)((c - from) * scale);
  return b < BINS ? b : BINS - 1;
}

static void
fill_item_bins (const bt__bvh *tree, const part *p, int axis, float from, float scale,
                bin bins[BINS])
{
  for (int i = 0; i < BINS; i++)
    bins[i] = (bin){ nothing, 0 };
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      const bt__bvh_item *item = tree->item + i;
      bin *b = bins + item_bin (item->lo[axis] + item->hi[axis], from, scale);
      include (&b->box, item->lo, item->hi);
      b->n++;
    }
}

/* Return the cost of the best cut of BINS, its place in *AT.  */
static float
best_cut (const bin bins[BINS], int *at)
{
  float right[BINS], best = FLT_MAX;
  bounds b = nothing;
  uint32_t n = 0;
  for (int i = BINS - 1; i > 0; i--)
    {
      include (&b, bins[i].box.lo, bins[i].box.hi);
      n += bins[i].n;
      right[i] = n ? (float)n * area (&b) : FLT_MAX;
    }
  b = nothing;
  n = 0;
  for (int i = 1; i < BINS; i++)
    {
      include (&b, bins[i - 1].box.lo, bins[i - 1].box.hi);
      n += bins[i - 1].n;
      float cost = n && right[i] < FLT_MAX ? (float)n * area (&b) + right[i] : FLT_MAX;
      if (cost < best)
        {
          best = cost;
          *at = i;
        }
    }
  return best;
}

/* Try the cuts of a small part along all axes, of a part of more than 4096 items along the longest
   axis alone: the cut of a large part matters less and costs more time.  */
static int
find_cut (const bt__bvh *tree, const part *p, cut *out)
{
  float best = FLT_MAX, size[3];
  int longest = 0;
  for (int k = 0; k < 3; k++)
    {
      size[k] = p->middles.hi[k] - p->middles.lo[k];
      longest = size[k] > size[longest] ? k : longest;
    }
  for (int k = 0; k < 3; k++)
    {
      bin bins[BINS];
      int at = 0;
      if (!(size[k] > 0) || (p->n > 4096 && k != longest))
        continue;
      float scale = (float)BINS * 0.999f / size[k];
      if (!(scale < FLT_MAX))
        continue;
      fill_item_bins (tree, p, k, p->middles.lo[k], scale, bins);
      float cost = best_cut (bins, &at);
      if (cost < best)
        {
          best = cost;
          *out = (cut){ k, at, p->middles.lo[k], scale };
        }
    }
  return best < FLT_MAX;
}

static uint32_t
move_apart (bt__bvh *tree, const part *p, const cut *c)
{
  uint32_t i = p->first, j = p->first + p->n;
  while (i < j)
    {
      bt__bvh_item *item = tree->item + i;
      if (item_bin (item->lo[c->axis] + item->hi[c->axis], c->from, c->scale) < c->at)
        i++;
      else
        {
          bt__bvh_item swap = *item;
          *item = tree->item[--j];
          tree->item[j] = swap;
        }
    }
  return i - p->first;
}

/* Split part P in two parts, neither empty.  */
static void
split (bt__bvh *tree, part *p, part *other, int halve)
{
  cut c;
  uint32_t left = p->n / 2;
  if (!halve && find_cut (tree, p, &c))
    left = move_apart (tree, p, &c);
  if (left == 0 || left == p->n)
    left = p->n / 2;
  *other = (part){ .first = p->first + left, .n = p->n - left };
  p->n = left;
  measure_boxes (tree, p);
  measure_boxes (tree, other);
}

/* ---- Nodes ---- */

/* Return the largest part of more than LEAST items, to be split next, or -1.  */
static int
largest_part (const part *parts, int n, uint32_t least, int halve)
{
  int best = -1;
  float most = -1;
  for (int i = 0; i < n; i++)
    {
      float size = halve ? (float)parts[i].n : area (&parts[i].box);
      if (parts[i].n > least && size > most)
        {
          most = size;
          best = i;
        }
    }
  return best;
}

static int
spread_parts (bt__bvh *tree, part parts[BT__BVH_WIDE], int halve)
{
  int n = 1;
  for (uint32_t least = LEAF;; least = 1)
    {
      for (int i; n < BT__BVH_WIDE && (i = largest_part (parts, n, least, halve)) >= 0; n++)
        split (tree, parts + i, parts + n, halve);
      if (least == 1)
        return n;
    }
}

static void
set_child (bt__bvh_node *node, int i, const part *p)
{
  for (int k = 0; k < 3; k++)
    {
      float lo = p->box.lo[k], hi = p->box.hi[k], c = 0.5f * lo + 0.5f * hi;
      node->centre[k][i] = c;
      node->half[k][i] = larger (hi - c, c - lo) * 1.000001f + FLT_MIN;
    }
  node->first[i] = p->first;
  node->count[i] = p->n;
}

static void
set_missing (bt__bvh_node *node, int i)
{
  for (int k = 0; k < 3; k++)
    {
      node->centre[k][i] = 0;
      node->half[k][i] = -1e30f;
    }
  node->first[i] = node->count[i] = 0;
}

static void
make_node (bt__bvh *tree, uint32_t at, const part *whole, int depth)
{
  part parts[BT__BVH_WIDE] = { *whole };
  int n = bt__ask (tree->asker) ? 0 : spread_parts (tree, parts, depth > DEEP);
  bt__bvh_node *node = tree->node + at;
  for (int i = 0; i < BT__BVH_WIDE; i++)
    if (i < n)
      set_child (node, i, parts + i);
    else
      set_missing (node, i);
  for (int i = 0; i < n; i++)
    if (parts[i].n > LEAF)
      {
        uint32_t child = tree->nodes++;
        node->first[i] = child;
        node->count[i] = 0;
        make_node (tree, child, parts + i, depth + 1);
      }
}

/* ---- Items ---- */

static bt__aabb
whole_box (bt__asker *asker, uint32_t n, bt__box_of box, const void *user)
{
  bt__aabb all = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
  for (uint32_t i = 0; i < n; i++)
    {
      bt__aabb b;
      if (i % ITEMS_A_QUESTION == 0 && bt__ask (asker))
        break;
      box (user, i, &b);
      all.lo = bt__vec (fmin (all.lo.x, b.lo.x), fmin (all.lo.y, b.lo.y), fmin (all.lo.z, b.lo.z));
      all.hi = bt__vec (fmax (all.hi.x, b.hi.x), fmax (all.hi.y, b.hi.y), fmax (all.hi.z, b.hi.z));
    }
  return all;
}

static inline float
below (double x)
{
  float f = (float)x;
  return (double)f > x ? nextafterf (f, -FLT_MAX) : f;
}

static inline float
above (double x)
{
  float f = (float)x;
  return (double)f < x ? nextafterf (f, FLT_MAX) : f;
}

static void
set_item (bt__bvh *tree, uint32_t i, const bt__aabb *b)
{
  bt_vec3 lo = bt__sub (b->lo, tree->origin), hi = bt__sub (b->hi, tree->origin);
  tree->item[i] = (bt__bvh_item){ { below (lo.x), below (lo.y), below (lo.z) },
                                  { above (hi.x), above (hi.y), above (hi.z) },
                                  i };
}

void
bt__bvh_build (bt__bvh *tree, uint32_t n, bt__box_of box, const void *user)
{
  tree->n = n;
  tree->nodes = 0;
  if (n == 0)
    return;
  bt__aabb all = whole_box (tree->asker, n, box, user), b;
  tree->origin = bt__scale (0.5, bt__add (all.lo, all.hi));
  tree->extent = bt__largest (bt__sub (all.hi, all.lo));
  for (uint32_t i = 0; i < n; i++)
    {
      if (i % ITEMS_A_QUESTION == 0 && bt__ask (tree->asker))
        return;
      box (user, i, &b);
      set_item (tree, i, &b);
    }
  part whole = { .n = n };
  measure_boxes (tree, &whole);
  tree->nodes = 1;
  make_node (tree, 0, &whole, 0);
  for (uint32_t i = 0; i < n; i++)
    tree->order[i] = tree->item[i].index;
}
