/* Inside the tree of free ways: the grid, and how far it has grown.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_FREE_JOB_H
#define BT_AWARE_FREE_JOB_H

#include <pthread.h>

#include "aware/free.h"

#define BT__NOWHERE UINT32_MAX

enum
{
  BT__FREE_WIDE = 2,
  BT__FREE_NEAR_MOST = 125 /* cells within BT__FREE_WIDE */
};

struct bt__free
{
  bt__free_config c;
  bt_vec3 anchor;
  uint32_t nx, ny, nz, cells, root; /* root: the number of the anchor, after all cells */
  double *g;                        /* m from the anchor */
  uint32_t *parent;
  uint32_t *heap, *place; /* open cells, least g first; where a cell is in it */
  uint32_t open;
  uint8_t *closed;
  int sprouted;
  pthread_mutex_t lock; /* of all that grows: threads may ask one tree */
};

bt_vec3 bt__free_point (const bt__free *tree, uint32_t cell);

/* Call the neighbours of P within RADIUS cells, into OUT; return their number.  */
uint32_t bt__free_neighbours (const bt__free *tree, bt_vec3 p, int radius, uint32_t *out);

/* Open the first cells, about the anchor.  */
void bt__free_sprout (bt__free *tree);

/* Grow TREE until each of the N cells NEAR is closed or never will be; return false if left.  */
int bt__free_grow_to (bt__free *tree, const uint32_t *near, uint32_t n, bt__asker *asker,
                      bt__count *count);

#endif
