/* Building the tree: the items are parted by the surface area heuristic over bins (Wald 2007), the
   largest part of a node first, until the node has its eight children; then each child in turn.

   Below DEEP levels parts are halved: no arrangement of boxes makes the tree deep.

   A tree of a million items takes some twenty passes over the items: each pass handles all axes of
   a box in one vector of four floats.

   A tree of SHARED items or more is shared out among workers: the caller splits parts of more than
   a TASK_SHAREth of all items; each smaller part is a task, made in separate nodes.  All nodes are
   then numbered as if one thread had made the tree, parents before children: the tree has the same
   bits for any number of workers.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <float.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

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
  SHARED = 1 << 15,
  TASK_SHARE = 16,
  TOP_NODES = 32, /* at most, that the caller makes before parts are shared out */
  ITEM_RANGES = 32
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
  uint32_t nodes = n / LEAF + 2 + (n >= SHARED ? TOP_NODES : 0);
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

static inline void
measure_item (part *p, const bt__bvh_item *item)
{
  bt__quad centre = item->lo + item->hi;
  include (&p->box, item->lo, item->hi);
  include (&p->middles, centre, centre);
}

static void
measure_boxes (const bt__bvh *tree, part *p)
{
  part all = { .box = nothing, .middles = nothing };
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    measure_item (&all, tree->item + i);
  p->box = all.box;
  p->middles = all.middles;
}

/* ---- Parting ---- */

typedef struct bin
{
  bounds box;
  uint32_t n;
} bin;

/* Unused bins are not initialised: most bins of most parts are unused.  */
typedef struct bins
{
  bin at[BINS];
  unsigned used; /* bit i: bin i has items */
} bins;

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

static inline void
put_into_bin (bins *all, int i, const bt__bvh_item *item)
{
  bin *b = all->at + i;
  if (all->used >> i & 1)
    {
      include (&b->box, item->lo, item->hi);
      b->n++;
    }
  else
    {
      *b = (bin){ { item->lo, item->hi }, 1 };
      all->used |= 1U << i;
    }
}

/* The bins of one axis.  */
static void
fill_bins (const bt__bvh *tree, const part *p, int axis, float scale, bins *out)
{
  float from = p->middles.lo[axis];
  out->used = 0;
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      const bt__bvh_item *item = tree->item + i;
      bt__quad centre = item->lo + item->hi;
      put_into_bin (out, item_bin (centre[axis], from, scale), item);
    }
}

/* The bins of all axes.  */
static void
fill_all_bins (const bt__bvh *tree, const part *p, bt__quad scale, bins out[3])
{
  bt__quad from = p->middles.lo;
  for (int k = 0; k < 3; k++)
    out[k].used = 0;
  for (uint32_t i = p->first; i < p->first + p->n; i++)
    {
      const bt__bvh_item *item = tree->item + i;
      bt__quad centre = item->lo + item->hi;
      for (int k = 0; k < 3; k++)
        put_into_bin (out + k, item_bin (centre[k], from[k], scale[k]), item);
    }
}

/* Return the cost of the best cut of ALL, the place in *AT; FLT_MAX if all items are in a single
   bin.  A cut is tried after each used bin.  */
static float
best_cut (const bins *all, int *at)
{
  float right[BINS], best = FLT_MAX; /* the costs of a used bin and all after it */
  bounds b = nothing;
  uint32_t n = 0;
  for (unsigned used = all->used; used;)
    {
      int i = 31 - __builtin_clz (used);
      used ^= 1U << i;
      include (&b, all->at[i].box.lo, all->at[i].box.hi);
      n += all->at[i].n;
      right[i] = (float)n * area (&b);
    }
  b = nothing;
  n = 0;
  for (unsigned used = all->used; used & (used - 1);)
    {
      int i = __builtin_ctz (used);
      used &= used - 1;
      include (&b, all->at[i].box.lo, all->at[i].box.hi);
      n += all->at[i].n;
      float cost = (float)n * area (&b) + right[__builtin_ctz (used)];
      if (cost < best)
        {
          best = cost;
          *at = i + 1;
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
  bins axis[3];
  if (p->n <= MANY)
    fill_all_bins (tree, p, scale, axis);
  for (int k = 0; k < 3; k++)
    {
      int at = 0;
      if (!(scale[k] > 0))
        continue;
      if (p->n > MANY)
        fill_bins (tree, p, k, scale[k], axis + k);
      float cost = best_cut (axis + k, &at);
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

/* Cut part P at C: items left of C stay in P, the rest become OTHER.  Both parts are measured while
   items come to their places.  */
static void
move_apart (bt__bvh *tree, part *p, part *other, const cut *c)
{
  uint32_t i = p->first, end = p->first + p->n, j = end;
  part left = { .box = nothing, .middles = nothing }, right = left;
  while (i < j)
    {
      const bt__bvh_item *item = tree->item + i;
      bt__quad centre = item->lo + item->hi;
      if (item_bin (centre[c->axis], c->from, c->scale) < c->at)
        {
          measure_item (&left, item);
          i++;
        }
      else
        {
          measure_item (&right, item);
          exchange (tree, i, --j);
        }
    }
  *other = (part){ i, end - i, right.box, right.middles };
  *p = (part){ p->first, i - p->first, left.box, left.middles };
}

static void
halve (bt__bvh *tree, part *p, part *other)
{
  uint32_t left = p->n / 2;
  *other = (part){ .first = p->first + left, .n = p->n - left };
  p->n = left;
  measure_boxes (tree, p);
  measure_boxes (tree, other);
}

/* Split part P in two parts, neither empty.  */
static void
split (bt__bvh *tree, part *p, part *other, int deep)
{
  cut c;
  if (!deep && find_cut (tree, p, &c))
    move_apart (tree, p, other, &c);
  else
    halve (tree, p, other);
}

/* ---- Nodes ---- */

/* Return the largest part of more than LEAST items, to be split next, or -1.  */
static int
largest_part (const part *parts, int n, uint32_t least, int deep)
{
  int best = -1;
  float most = -1;
  for (int i = 0; i < n; i++)
    {
      float size = deep ? (float)parts[i].n : area (&parts[i].box);
      if (parts[i].n > least && size > most)
        {
          most = size;
          best = i;
        }
    }
  return best;
}

static int
spread_parts (bt__bvh *tree, part parts[BT__BVH_WIDE], int deep)
{
  int n = 1;
  for (uint32_t least = LEAF;; least = 1)
    {
      for (int i; n < BT__BVH_WIDE && (i = largest_part (parts, n, least, deep)) >= 0; n++)
        split (tree, parts + i, parts + n, deep);
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
      node->half[k][i] = -1e17f; /* met by nothing; times STEEP of bvh_ray.c still a number */
    }
  node->first[i] = node->count[i] = 0;
}

static int
spread_in_node (bt__bvh *tree, bt__bvh_node *node, part parts[BT__BVH_WIDE], int depth)
{
  int n = spread_parts (tree, parts, depth > DEEP);
  for (int i = 0; i < BT__BVH_WIDE; i++)
    if (i < n)
      set_child (node, i, parts + i);
    else
      set_missing (node, i);
  return n;
}

/* Where one worker makes nodes.  */
typedef struct builder
{
  bt__bvh *tree;
  bt__bvh_node *node;
  uint32_t nodes;    /* made in NODE */
  int is_caller;     /* true: this worker asks the tree's asker */
  atomic_int *ended; /* true from when the asker said so */
} builder;

static int
is_ended (builder *b)
{
  if (b->is_caller && bt__ask (b->tree->asker))
    atomic_store_explicit (b->ended, 1, memory_order_relaxed);
  return atomic_load_explicit (b->ended, memory_order_relaxed);
}

/* Make the nodes of WHOLE in B, numbered from B->nodes on.  */
static void
make_nodes (builder *b, const part *whole, int depth)
{
  part parts[BT__BVH_WIDE] = { *whole };
  bt__bvh_node *node = b->node + b->nodes++;
  int n = spread_in_node (b->tree, node, parts, depth);
  for (int i = 0; i < n && !is_ended (b); i++)
    if (parts[i].n > LEAF)
      {
        node->first[i] = b->nodes;
        node->count[i] = 0;
        make_nodes (b, parts + i, depth + 1);
      }
}

/* ---- Shared out ---- */

typedef struct task
{
  part whole;
  int depth;
  uint32_t at, nodes; /* in the nodes of the tree, until they are numbered */
} task;

/* A child is a leaf, a node of the top or the nodes of a task.  */
typedef struct top_node
{
  bt__bvh_node node;
  int below[BT__BVH_WIDE], task[BT__BVH_WIDE]; /* -1: none */
} top_node;

typedef struct top
{
  bt__bvh *tree;
  uint32_t large; /* parts of more items are split by the caller */
  int nodes, tasks;
  atomic_int ended;
  top_node node[TOP_NODES];
  task task[TOP_NODES * BT__BVH_WIDE];
} top;

static int
add_task (top *t, const part *whole, int depth)
{
  t->task[t->tasks] = (task){ .whole = *whole, .depth = depth };
  return t->tasks++;
}

/* Return the number in T of the node of WHOLE.  */
static int
make_top (top *t, const part *whole, int depth)
{
  int number = t->nodes++;
  top_node *self = t->node + number;
  part parts[BT__BVH_WIDE] = { *whole };
  int n = bt__ask (t->tree->asker) ? 0 : spread_in_node (t->tree, &self->node, parts, depth);
  for (int i = 0; i < BT__BVH_WIDE; i++)
    self->below[i] = self->task[i] = -1;
  for (int i = 0; i < n; i++)
    if (parts[i].n > t->large && t->nodes < TOP_NODES)
      self->below[i] = make_top (t, parts + i, depth + 1);
    else if (parts[i].n > LEAF)
      self->task[i] = add_task (t, parts + i, depth + 1);
  return number;
}

/* A part of N items has at most (N - 1) / LEAF nodes, since a node below the root has more than
   LEAF children.  So the nodes of all tasks have room in sequence, and numbering the nodes moves
   none to a higher place.  */
static void
place_tasks (top *t)
{
  uint32_t at = (uint32_t)t->nodes;
  for (int k = 0; k < t->tasks; k++)
    {
      t->task[k].at = at;
      at += t->task[k].whole.n / LEAF;
    }
}

static void
do_task (void *user, int w, int k)
{
  top *t = user;
  task *job = t->task + k;
  builder b = {
    .tree = t->tree, .node = t->tree->node + job->at, .is_caller = w == 0, .ended = &t->ended
  };
  if (!is_ended (&b))
    make_nodes (&b, &job->whole, job->depth);
  job->nodes = b.nodes;
}

/* Move the nodes of JOB to the end of the numbered nodes; return the number of the first.  */
static uint32_t
number_task (bt__bvh *tree, const task *job)
{
  uint32_t first = tree->nodes;
  bt__bvh_node *node = tree->node + first;
  memmove (node, tree->node + job->at, job->nodes * sizeof *node);
  for (uint32_t j = 0; j < job->nodes; j++)
    for (int i = 0; i < BT__BVH_WIDE; i++)
      if (node[j].count[i] == 0 && node[j].half[0][i] > 0)
        node[j].first[i] += first;
  tree->nodes += job->nodes;
  return first;
}

static uint32_t
number_top (top *t, int number)
{
  const top_node *self = t->node + number;
  uint32_t at = t->tree->nodes++;
  bt__bvh_node *node = t->tree->node + at;
  *node = self->node;
  for (int i = 0; i < BT__BVH_WIDE; i++)
    if (self->below[i] >= 0 || self->task[i] >= 0)
      {
        node->count[i] = 0;
        node->first[i] = self->below[i] >= 0 ? number_top (t, self->below[i])
                                             : number_task (t->tree, t->task + self->task[i]);
      }
  return at;
}

static void
make_shared (bt__bvh *tree, const part *whole)
{
  top t = { .tree = tree, .large = tree->n / TASK_SHARE };
  make_top (&t, whole, 0);
  place_tasks (&t);
  bt__workers_run (tree->workers, t.tasks, do_task, NULL, &t);
  if (!bt__ask (tree->asker))
    number_top (&t, 0);
}

static void
make_alone (bt__bvh *tree, const part *whole)
{
  atomic_int ended = 0;
  builder b = { .tree = tree, .node = tree->node, .is_caller = 1, .ended = &ended };
  make_nodes (&b, whole, 0);
  tree->nodes = b.nodes;
}

/* ---- Items ---- */

/* The boxes of all items, by ranges: first the box of each range, then, about the middle
   of all, the items of each range.  */
typedef struct setting
{
  bt__bvh *tree;
  bt__box_of box;
  const void *user;
  atomic_int ended;
  int ranges;
  bt__aabb all[ITEM_RANGES];
  part part[ITEM_RANGES];
} setting;

/* The items FROM to END of range K; return false if worker W is to leave it.  */
static int
find_range (setting *s, int w, int k, uint32_t *from, uint32_t *end)
{
  uint64_t n = s->tree->n, ranges = (uint64_t)s->ranges;
  *from = (uint32_t)(n * (uint64_t)k / ranges);
  *end = (uint32_t)(n * ((uint64_t)k + 1) / ranges);
  if (w == 0 && bt__ask (s->tree->asker))
    atomic_store_explicit (&s->ended, 1, memory_order_relaxed);
  return !atomic_load_explicit (&s->ended, memory_order_relaxed);
}

static inline double
lesser (double a, double b)
{
  return a < b ? a : b;
}

static inline double
greater (double a, double b)
{
  return a > b ? a : b;
}

static void
include_box (bt__aabb *all, const bt__aabb *b)
{
  all->lo = bt__vec (lesser (b->lo.x, all->lo.x), lesser (b->lo.y, all->lo.y),
                     lesser (b->lo.z, all->lo.z));
  all->hi = bt__vec (greater (b->hi.x, all->hi.x), greater (b->hi.y, all->hi.y),
                     greater (b->hi.z, all->hi.z));
}

static const bt__aabb nowhere
    = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

static void
measure_range (void *user, int w, int k)
{
  setting *s = user;
  uint32_t i, end;
  s->all[k] = nowhere;
  if (find_range (s, w, k, &i, &end))
    for (; i < end; i++)
      {
        bt__aabb b;
        s->box (s->user, i, &b);
        include_box (s->all + k, &b);
      }
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

static void
set_range (void *user, int w, int k)
{
  setting *s = user;
  uint32_t i, end;
  s->part[k] = (part){ .box = nothing, .middles = nothing };
  if (find_range (s, w, k, &i, &end))
    for (; i < end; i++)
      {
        bt__aabb b;
        s->box (s->user, i, &b);
        set_item (s->tree, i, &b);
        measure_item (s->part + k, s->tree->item + i);
      }
}

/* Set all items of TREE, and WHOLE.  Return false if it is to be left.  */
static int
set_items (bt__bvh *tree, bt__box_of box, const void *user, part *whole)
{
  setting s = { .tree = tree, .box = box, .user = user };
  s.ranges = tree->n >= SHARED ? ITEM_RANGES : 1;
  bt__workers_run (tree->workers, s.ranges, measure_range, NULL, &s);
  for (int k = 1; k < s.ranges; k++)
    include_box (s.all, s.all + k);
  tree->origin = bt__scale (0.5, bt__add (s.all[0].lo, s.all[0].hi));
  tree->extent = bt__largest (bt__sub (s.all[0].hi, s.all[0].lo));
  bt__workers_run (tree->workers, s.ranges, set_range, NULL, &s);
  *whole = (part){ .n = tree->n, .box = nothing, .middles = nothing };
  for (int k = 0; k < s.ranges; k++)
    {
      include (&whole->box, s.part[k].box.lo, s.part[k].box.hi);
      include (&whole->middles, s.part[k].middles.lo, s.part[k].middles.hi);
    }
  return !s.ended;
}

void
bt__bvh_build (bt__bvh *tree, uint32_t n, bt__box_of box, const void *user)
{
  part whole;
  tree->n = n;
  tree->nodes = 0;
  if (n == 0 || !set_items (tree, box, user, &whole))
    return;
  if (n >= SHARED)
    make_shared (tree, &whole);
  else
    make_alone (tree, &whole);
}
