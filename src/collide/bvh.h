/* A tree of boxes, eight to a node, over anything that has a box: triangles, obstacles, movers.

   Boxes are floats about the tree's own origin, rounded outwards; a query may report too much,
   never too little.  A query allocates nothing.  The tree of obstacles is built once; one for
   movers is reserved once and rebuilt as often as they move.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_BVH_H
#define BT_COLLIDE_BVH_H

#include <stdint.h>

#include <bight/status.h>

#include "base/ask.h"
#include "base/workers.h"
#include "collide/pair.h"

enum
{
  BT__BVH_WIDE = 8,
  BT__BVH_STACK = 512, /* the tree is never deeper than 7 entries a level fill */
  BT__BVH_MAX = 1 << 28
};

typedef struct bt__aabb
{
  bt_vec3 lo, hi;
} bt__aabb;

/* BOX with P in it.  */
static inline bt__aabb
bt__box_with (bt__aabb box, bt_vec3 p)
{
  box.lo.x = p.x < box.lo.x ? p.x : box.lo.x;
  box.lo.y = p.y < box.lo.y ? p.y : box.lo.y;
  box.lo.z = p.z < box.lo.z ? p.z : box.lo.z;
  box.hi.x = p.x > box.hi.x ? p.x : box.hi.x;
  box.hi.y = p.y > box.hi.y ? p.y : box.hi.y;
  box.hi.z = p.z > box.hi.z ? p.z : box.hi.z;
  return box;
}

/* True if boxes A and B are within GAP of each other.  */
static inline int
bt__boxes_are_near (const bt__aabb *a, const bt__aabb *b, double gap)
{
  return a->lo.x <= b->hi.x + gap && b->lo.x <= a->hi.x + gap && a->lo.y <= b->hi.y + gap
         && b->lo.y <= a->hi.y + gap && a->lo.z <= b->hi.z + gap && b->lo.z <= a->hi.z + gap;
}

/* Eight children: where count is 0 first is a node, else the first of count items in leaf order.  A
   missing child has a negative half size.  */
typedef struct bt__bvh_node
{
  float centre[3][BT__BVH_WIDE], half[3][BT__BVH_WIDE];
  uint32_t first[BT__BVH_WIDE];
  uint32_t count[BT__BVH_WIDE];
} bt__bvh_node;

/* x, y, z, 0: the box of an item while the tree is built.  */
typedef float bt__quad __attribute__ ((vector_size (16)));
typedef struct bt__bvh_item
{
  bt__quad lo, hi;
} bt__bvh_item;

typedef struct bt__bvh
{
  bt_vec3 origin;
  double extent; /* no box reaches farther from the origin along an axis */
  uint32_t n;    /* items */
  uint32_t nodes;
  bt__bvh_node *node;
  uint32_t *order; /* leaf order to item number */
  bt__bvh_item *item;
  uint32_t room, node_room;
  bt__asker *asker;     /* while it is built, or NULL; left, the tree is good for nothing */
  bt__workers *workers; /* that build it, or NULL: the caller alone */
} bt__bvh;

/* Work done by queries, added up.  */
typedef struct bt__count
{
  uint64_t links, nodes, pairs;          /* asked, visited, measured */
  uint64_t skipped_empty, skipped_clear; /* links not asked: nothing there; known to be clear */
  uint64_t casts, cast_steps;
} bt__count;

typedef void (*bt__box_of) (const void *user, uint32_t i, bt__aabb *box);

/* Prepare TREE (zeroed) for up to N items.  BT_ERR_LIMIT.  */
bt_status bt__bvh_reserve (bt__bvh *tree, uint32_t n, bt_error *error);

/* Build TREE over N items, at most as many as reserved; the boxes must be finite.  No allocation.
 */
void bt__bvh_build (bt__bvh *tree, uint32_t n, bt__box_of box, const void *user);

/* Give back what only a rebuild needs.  */
void bt__bvh_trim (bt__bvh *tree);

void bt__bvh_free (bt__bvh *tree);

/* Measure item SLOT (in leaf order) and return the reach from there on: a search for the nearest
   lowers it, others return it unchanged.  */
typedef double (*bt__visit) (void *user, uint32_t slot, double reach);

/* Visit every item whose box is within REACH of LINK; with NEAREST nearer boxes first.  COUNT may
   not be NULL.  Return the last reach.  */
double bt__bvh_query (const bt__bvh *tree, const bt__link *link, double reach, int nearest,
                      bt__visit visit, void *user, bt__count *count);

/* Visit every item whose box the ray from FROM along DIRECTION, unit, meets before REACH, nearer
   boxes first.  Return the last reach.  */
double bt__bvh_ray (const bt__bvh *tree, bt_vec3 from, bt_vec3 direction, double reach,
                    bt__visit visit, void *user, bt__count *count);

#endif
