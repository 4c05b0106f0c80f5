/* The boxes of the trees over obstacles' triangles, level by level, for pictures of them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/obstacle.h>

#include "world/obstacles.h"

/* A walk down the tree to LEVEL; the boxes from number FIRST on go to OUT while there is room.  */
typedef struct walk
{
  const bt_dive *dive;
  const bt__bvh *tree;
  int level, carried;
  size_t first, room, n;
  bt_tree_box *out;
} walk;

static void
give_box (walk *w, bt_vec3 centre, bt_vec3 half)
{
  if (w->first > 0)
    {
      w->first--;
      return;
    }
  if (w->carried >= 0)
    centre = bt__to_world (&bt__dive_movers (w->dive, w->dive->now)[w->carried].frame, centre);
  w->out[w->n++] = (bt_tree_box){ centre, half };
}

/* Child K of NODE as a box.  */
static void
give_child (walk *w, const bt__bvh_node *node, int k)
{
  bt_vec3 from = bt__vec ((double)node->centre[0][k], (double)node->centre[1][k],
                          (double)node->centre[2][k]);
  bt_vec3 half
      = bt__vec ((double)node->half[0][k], (double)node->half[1][k], (double)node->half[2][k]);
  give_box (w, bt__add (w->tree->origin, from), half);
}

static void
descend_tree (walk *w, uint32_t at, int depth)
{
  const bt__bvh_node *node = w->tree->node + at;
  for (int k = 0; k < BT__BVH_WIDE && w->n < w->room; k++)
    if (node->half[0][k] < 0)
      continue;
    else if (node->count[k] > 0 || depth == w->level)
      give_child (w, node, k);
    else
      descend_tree (w, node->first[k], depth + 1);
}

static int
depth_of (const bt__bvh *tree, uint32_t at)
{
  const bt__bvh_node *node = tree->node + at;
  int most = 0;
  for (int k = 0; k < BT__BVH_WIDE; k++)
    if (node->half[0][k] >= 0 && node->count[k] == 0)
      {
        int deep = depth_of (tree, node->first[k]);
        most = deep > most ? deep : most;
      }
  return most + 1;
}

/* The mesh of obstacle I, or NULL.  */
static const bt__mesh *
mesh_of_obstacle (const bt_dive *dive, int i)
{
  const bt__obstacle *shape;
  if (bt__check_part (dive, BT_PART_OBSTACLE, i, NULL) != BT_OK)
    return NULL;
  shape = bt__model_shape (dive->model, i);
  return shape->kind == BT__OBSTACLE_MESH ? shape->shape.mesh : NULL;
}

int
bt_obstacle_levels (const bt_dive *dive, int i)
{
  const bt__mesh *mesh = mesh_of_obstacle (dive, i);
  return mesh ? 1 + depth_of (&mesh->tree, 0) : 0;
}

size_t
bt_obstacle_boxes (const bt_dive *dive, int i, int level, size_t first, size_t n,
                   bt_tree_box *boxes)
{
  const bt__mesh *mesh = mesh_of_obstacle (dive, i);
  walk w = { .dive = dive, .level = level, .first = first, .room = n, .out = boxes };
  if (!mesh || level < 0 || n == 0)
    return 0;
  w.tree = &mesh->tree;
  w.carried = bt__model_carried (dive->model, i);
  if (level > 0)
    descend_tree (&w, 0, 1);
  else
    give_box (&w, bt__scale (0.5, bt__add (mesh->box.lo, mesh->box.hi)),
              bt__scale (0.5, bt__sub (mesh->box.hi, mesh->box.lo)));
  return w.n;
}
