/* Building the tree: the items are parted by the surface area heuristic over bins (Wald 2007), the
   largest part of a node first, until the node has its eight children; then each child in turn.

   Below DEEP levels parts are halved: no arrangement of boxes makes the tree deep.

   A tree of a million items takes some twenty passes over the items: each pass handles all axes of
   a box in one vector of four floats.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <float.h>
#include <stdlib.h>

#if defined __SSE2__
#include <emmintrin.h>
#endif

#include "base/error.h"
#include "collide/bvh.h"

enum
{
  BINS = 16,
  LEAF = 4,
  MANY = 4096,
  DEEP = 24,
  ITEMS_A_QUESTION = 1 << 16
};

typedef struct bounds
{
  bt__quad lo, hi;
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
larger (float a, float b)
{
  return a > b ? a : b;
}

/* Of each two the smaller, B if neither is.  */
static inline bt__quad
smaller_of_each (bt__quad a, bt__quad b)
{
#if defined __SSE2__
  return _mm_min_ps (a, b);
#else
  for (int k = 0; k < 4; k++)
    a[k] = a[k] < b[k] ? a[k] : b[k];
  return a;
#endif
}

static inline bt__quad
larger_of_each (bt__quad a, bt__quad b)
{
#if defined __SSE2__
  return _mm_max_ps (a, b);
#else
  for (int k = 0; k < 4; k++)
    a[k] = a[k] > b[k] ? a[k] : b[k];
  return a;
#endif
}

static const bounds nothing
    = { { FLT_MAX, FLT_MAX, FLT_MAX, 0 }, { -FLT_MAX, -FLT_MAX, -FLT_MAX, 0 } };

static inline void
include (bounds *b, bt__quad lo, bt__quad hi)
{
  b->lo = smaller_of_each (b->lo, lo);
  b->hi = larger_of_each (b->hi, hi);
}

static inline float
area (const bounds *b)
{
  bt__quad size = b->hi - b->lo;
  float x = size[0], y = size[1], z = size[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}

static void
measure_boxes (const bt__bvh *tree, part *p)
{
  bounds box = nothing, middles = nothing;
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      const bt__bvh_item *item = tree->item + i;
      bt__quad centre = item->lo + item->hi;
      include (&box, item->lo, item->hi);
      include (&middles, centre, centre);
    }
  p->box = box;
  p->middles = middles;
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
clear_bins (bin bins[BINS])
{
  for (int i = 0; i < BINS; i++)
    bins[i] = (bin){ nothing, 0 };
}

static inline void
put_into_bin (bin *b, const bt__bvh_item *item)
{
  include (&b->box, item->lo, item->hi);
  b->n++;
}

/* The bins of one axis.  */
static void
fill_bins (const bt__bvh *tree, const part *p, int axis, float scale, bin bins[BINS])
{
  float from = p->middles.lo[axis];
  clear_bins (bins);
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      const bt__bvh_item *item = tree->item + i;
      bt__quad centre = item->lo + item->hi;
      put_into_bin (bins + item_bin (centre[axis], from, scale), item);
    }
}

/* The bins of all axes.  */
static void
fill_all_bins (const bt__bvh *tree, const part *p, bt__quad scale, bin bins[3][BINS])
{
  bt__quad from = p->middles.lo;
  for (int k = 0; k < 3; k++)
    clear_bins (bins[k]);
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      const bt__bvh_item *item = tree->item + i;
      bt__quad centre = item->lo + item->hi;
      for (int k = 0; k < 3; k++)
        put_into_bin (bins[k] + item_bin (centre[k], from[k], scale[k]), item);
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

/* Return bins per length along each axis, SIZE being the extent of the middles.  The scale is 0
   along an axis without extent and, in a part of N > MANY items, along all axes but the longest:
   the cut of a large part matters less and costs more time.  */
static bt__quad
bin_scales (bt__quad size, uint32_t n)
{
  bt__quad scale = { 0, 0, 0, 0 };
  int longest = 0;
  for (int k = 0; k < 3; k++)
    longest = size[k] > size[longest] ? k : longest;
  for (int k = 0; k < 3; k++)
    if (size[k] > 0 && (n <= MANY || k == longest))
      {
        float s = (float)BINS * 0.999f / size[k];
        scale[k] = s < FLT_MAX ? s : 0;
      }
  return scale;
}

static int
find_cut (const bt__bvh *tree, const part *p, cut *out)
{
  bt__quad scale = bin_scales (p->middles.hi - p->middles.lo, p->n);
  float best = FLT_MAX;
  bin bins[3][BINS];
  if (p->n <= MANY)
    fill_all_bins (tree, p, scale, bins);
  for (int k = 0; k < 3; k++)
    {
      int at = 0;
      if (!(scale[k] > 0))
        continue;
      if (p->n > MANY)
        fill_bins (tree, p, k, scale[k], bins[k]);
      float cost = best_cut (bins[k], &at);
      if (cost < best)
        {
          best = cost;
          *out = (cut){ k, at, p->middles.lo[k], scale[k] };
        }
    }
  return best < FLT_MAX;
}

static void
exchange (bt__bvh *tree, uint32_t i, uint32_t j)
{
  bt__bvh_item item = tree->item[i];
  uint32_t number = tree->order[i];
  tree->item[i] = tree->item[j];
  tree->order[i] = tree->order[j];
  tree->item[j] = item;
  tree->order[j] = number;
}

static uint32_t
move_apart (bt__bvh *tree, const part *p, const cut *c)
{
  uint32_t i = p->first, j = p->first + p->n;
  while (i < j)
    {
      bt__quad centre = tree->item[i].lo + tree->item[i].hi;
      if (item_bin (centre[c->axis], c->from, c->scale) < c->at)
        i++;
      else
        exchange (tree, i, --j);
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
  tree->item[i] = (bt__bvh_item){ { below (lo.x), below (lo.y), below (lo.z), 0 },
                                  { above (hi.x), above (hi.y), above (hi.z), 0 } };
  tree->order[i] = i;
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
}
