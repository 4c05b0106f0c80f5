/* Asking the tree: a capsule, the link with the reach for a radius, against eight boxes at a time.

   The tree is a bounding volume hierarchy of axis-aligned boxes with eight children to a node,
   stored axis by axis: a loop over the eight uses the vector units.  The overlap test uses
   separating axes: the three axes of the box and their cross products with the link.  Instead of
   the distance from link to box, the box is grown by the reach; a grown box is a little larger than
   the set of points within reach, so a query may report too much, never too little.  Rounding has
   the same sign: floats lose at most SLACK of the largest coordinate, and the boxes are grown by as
   much.

   A query for the nearest part visits children nearest first and shrinks the reach with each answer
   of the caller; a query for all parts within reach keeps the reach.  The stack is a fixed array.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <float.h>

#if defined __SSE2__
#include <emmintrin.h>
#endif

#include "collide/bvh.h"
#include "math/wide.h"

#define SLACK 1e-6

/* The link about the tree's origin: middle, half of the direction, and what the tests need.  */
typedef struct probe
{
  float c[3], d[3], a[3]; /* a: |d|, with slack */
  float across[3];        /* the length of d across each axis */
  float slack, cross_slack;
} probe;

static void
probe_of_link (const bt__bvh *tree, const bt__link *link, probe *p)
{
  bt_vec3 a = bt__sub (link->a, tree->origin), b = bt__sub (link->b, tree->origin);
  bt_vec3 c = bt__scale (0.5, bt__add (a, b)), d = bt__scale (0.5, bt__sub (b, a));
  double big = tree->extent + bt__largest (a) + bt__largest (b), length = bt__norm (d);
  double cv[3] = { c.x, c.y, c.z }, dv[3] = { d.x, d.y, d.z };
  for (int k = 0; k < 3; k++)
    {
      double e = dv[(k + 1) % 3], f = dv[(k + 2) % 3];
      p->c[k] = (float)cv[k];
      p->d[k] = (float)dv[k];
      p->a[k] = (float)fabs (dv[k]);
      p->across[k] = (float)(sqrt (e * e + f * f) * (1 + SLACK));
    }
  p->slack = (float)(SLACK * big);
  p->cross_slack = (float)(8 * SLACK * big * length);
}

/* In bit k of the answer: box k may be within REACH.  In NEAR: how far each box is from the link's
   own box, at least.  */
static BT__HOT unsigned
boxes_within (const bt__bvh_node *node, const probe *p, float reach, int nearest,
              float near[BT__BVH_WIDE])
{
  float apart[BT__BVH_WIDE]; /* the largest gap of all axes: positive, no contact */
  float m[3][BT__BVH_WIDE];
  float face = reach + p->slack;
  for (int i = 0; i < BT__BVH_WIDE; i++)
    {
      float x = node->centre[0][i] - p->c[0], y = node->centre[1][i] - p->c[1],
            z = node->centre[2][i] - p->c[2];
      float gx = __builtin_fabsf (x) - node->half[0][i] - p->a[0];
      float gy = __builtin_fabsf (y) - node->half[1][i] - p->a[1];
      float gz = __builtin_fabsf (z) - node->half[2][i] - p->a[2];
      float g = gx > gy ? gx : gy;
      m[0][i] = x;
      m[1][i] = y;
      m[2][i] = z;
      near[i] = g > gz ? g : gz;
      apart[i] = near[i] - face;
    }
  if (nearest)
    for (int i = 0; i < BT__BVH_WIDE; i++)
      near[i] -= p->slack;
  for (int k = 0; k < 3; k++)
    {
      const int e = (k + 1) % 3, f = (k + 2) % 3;
      float more = reach * p->across[k] + p->cross_slack, de = p->d[e], df = p->d[f];
      for (int i = 0; i < BT__BVH_WIDE; i++)
        {
          float g = __builtin_fabsf (m[e][i] * df - m[f][i] * de) - node->half[e][i] * p->a[f]
                    - node->half[f][i] * p->a[e] - more;
          apart[i] = g > apart[i] ? g : apart[i];
        }
    }
  unsigned hits = 0;
#if defined __SSE2__
  __m128 zero = _mm_setzero_ps ();
  unsigned low = (unsigned)_mm_movemask_ps (_mm_cmpgt_ps (_mm_loadu_ps (apart), zero));
  unsigned high = (unsigned)_mm_movemask_ps (_mm_cmpgt_ps (_mm_loadu_ps (apart + 4), zero));
  hits = ~(low | high << 4) & 0xff;
#else
  for (int i = 0; i < BT__BVH_WIDE; i++)
    hits |= (unsigned)!(apart[i] > 0) << i;
#endif
  return hits;
}

typedef struct entry
{
  uint32_t node;
  float near;
} entry;

/* Bring the nearest of the children of one node, pushed from BASE on, to the top.  */
static BT__HOT int
push_within (entry *stack, int base, int depth, entry e, int nearest)
{
  int at = depth;
  if (nearest)
    for (; at > base && stack[at - 1].near < e.near; at--)
      stack[at] = stack[at - 1];
  stack[at] = e;
  return depth + 1;
}

/* LINK is farther than REACH from the cube about all of TREE.  */
static BT__HOT int
is_outside (const bt__bvh *tree, const bt__link *link, double reach)
{
  double half = 0.5000001 * tree->extent + reach + 1e-15 * bt__largest (tree->origin);
  bt_vec3 a = bt__sub (link->a, tree->origin), b = bt__sub (link->b, tree->origin);
  return (a.x > half && b.x > half) || (a.x < -half && b.x < -half) || (a.y > half && b.y > half)
         || (a.y < -half && b.y < -half) || (a.z > half && b.z > half)
         || (a.z < -half && b.z < -half);
}

static float
as_float (double reach)
{
  return reach < 1e20 ? (float)(reach * (1 + SLACK)) : 1e20f;
}

BT__WIDE double
bt__bvh_query (const bt__bvh *tree, const bt__link *link, double reach, int nearest,
               bt__visit visit, void *user, bt__count *count)
{
  entry stack[BT__BVH_STACK];
  probe p;
  int depth = 0;
  if (tree->n == 0 || !(reach >= 0) || is_outside (tree, link, reach))
    return reach;
  probe_of_link (tree, link, &p);
  stack[depth++] = (entry){ 0, 0 };
  while (depth > 0)
    {
      entry e = stack[--depth];
      if (nearest && e.near > as_float (reach))
        continue;
      const bt__bvh_node *node = tree->node + e.node;
      float near[BT__BVH_WIDE];
      unsigned hits = boxes_within (node, &p, as_float (reach), nearest, near);
      int base = depth;
      count->nodes++;
      for (; hits; hits &= hits - 1)
        {
          int i = __builtin_ctz (hits);
          uint32_t first = node->first[i], n = node->count[i];
          if (nearest && near[i] > as_float (reach))
            continue;
          if (n == 0 && first > 0) /* else a missing child, met by a link that is not finite */
            depth = push_within (stack, base, depth, (entry){ first, near[i] }, nearest);
          for (uint32_t k = 0; k < n; k++)
            reach = visit (user, first + k, reach);
        }
    }
  return reach;
}
