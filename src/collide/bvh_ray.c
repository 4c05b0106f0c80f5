/* A ray through the tree, nearer boxes first: slabs (Kay and Kajiya 1986), eight boxes at a time.

   The boxes are grown by SLACK of the largest coordinate, more than the sum of all roundings of
   floats in the test.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/bvh.h"

#define SLACK 2e-6
#define STEEP 1e20f /* no slope is steeper: its box is met everywhere or nowhere */

/* About the tree's origin.  */
typedef struct probe
{
  float from[3], slope[3], slack; /* slope: 1 / direction */
} probe;

typedef struct entry
{
  uint32_t node;
  float enter;
} entry;

static float
slope_of (double d)
{
  return fabs (d) > 1.0 / (double)STEEP ? (float)(1 / d) : signbit (d) ? -STEEP : STEEP;
}

static void
probe_of_ray (const bt__bvh *tree, bt_vec3 from, bt_vec3 direction, probe *p)
{
  bt_vec3 o = bt__sub (from, tree->origin);
  *p = (probe){ { (float)o.x, (float)o.y, (float)o.z },
                { slope_of (direction.x), slope_of (direction.y), slope_of (direction.z) },
                (float)(SLACK * (tree->extent + bt__largest (o))) };
}

/* In bit k of the answer: box k is met before REACH; in ENTER: where.  */
static unsigned
boxes_met (const bt__bvh_node *node, const probe *p, float reach, float enter[BT__BVH_WIDE])
{
  float leave[BT__BVH_WIDE];
  unsigned hits = 0;
  for (int i = 0; i < BT__BVH_WIDE; i++)
    {
      enter[i] = 0;
      leave[i] = reach;
    }
  for (int k = 0; k < 3; k++)
    {
      float from = p->from[k], slope = p->slope[k], steep = __builtin_fabsf (slope);
      for (int i = 0; i < BT__BVH_WIDE; i++)
        {
          float middle = (node->centre[k][i] - from) * slope;
          float half = (node->half[k][i] + p->slack) * steep;
          float in = middle - half, out = middle + half;
          enter[i] = in > enter[i] ? in : enter[i];
          leave[i] = out < leave[i] ? out : leave[i];
        }
    }
  for (int i = 0; i < BT__BVH_WIDE; i++)
    hits |= (unsigned)(enter[i] <= leave[i]) << i;
  return hits;
}

/* Bring the nearest of the children of one node, pushed from BASE on, to the top.  */
static int
push_met (entry *stack, int base, int depth, entry e)
{
  int at = depth;
  for (; at > base && stack[at - 1].enter < e.enter; at--)
    stack[at] = stack[at - 1];
  stack[at] = e;
  return depth + 1;
}

double
bt__bvh_ray (const bt__bvh *tree, bt_vec3 from, bt_vec3 direction, double reach, bt__visit visit,
             void *user, bt__count *count)
{
  entry stack[BT__BVH_STACK];
  probe p;
  int depth = 0;
  if (tree->n == 0 || !(reach >= 0))
    return reach;
  probe_of_ray (tree, from, direction, &p);
  stack[depth++] = (entry){ 0, 0 };
  while (depth > 0)
    {
      entry e = stack[--depth];
      float enter[BT__BVH_WIDE], most = (float)(reach * (1 + SLACK));
      if (e.enter > most)
        continue;
      const bt__bvh_node *node = tree->node + e.node;
      unsigned hits = boxes_met (node, &p, most, enter);
      int base = depth;
      count->nodes++;
      for (; hits; hits &= hits - 1)
        {
          int i = __builtin_ctz (hits);
          uint32_t first = node->first[i], n = node->count[i];
          if (n == 0 && first > 0)
            depth = push_met (stack, base, depth, (entry){ first, enter[i] });
          for (uint32_t k = 0; k < n; k++)
            reach = visit (user, first + k, reach);
        }
    }
  return reach;
}
