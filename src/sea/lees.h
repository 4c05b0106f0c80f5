/* The wakes of a sea in a tree of boxes, as wake.c asks them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SEA_LEES_H
#define BT_SEA_LEES_H

#include <stdint.h>

#include <bight/sea.h>

enum
{
  BT__WAKES_WIDE = 4,
  BT__LEAF_BLOCKS = 4 /* blocks of wakes in a leaf, at most */
};

/* A block of wakes side by side; an unused place has a radius of 0.  */
typedef struct bt__wakes
{
  double a[3][BT__WAKES_WIDE], axis[3][BT__WAKES_WIDE];
  double length[BT__WAKES_WIDE], radius[BT__WAKES_WIDE];
} bt__wakes;

/* A node of the tree, in preorder.  Outside the box from LOW to HIGH no wake below the node leaves
   a lee, whatever the current; the walk then goes on at the node SKIP.  */
typedef struct bt__lee_node
{
  double low[3], high[3]; /* m */
  uint32_t first, blocks; /* of a leaf: its blocks of wakes; an inner node has none */
  uint32_t skip;
} bt__lee_node;

struct bt_lees
{
  uint32_t nodes, blocks;
  bt__lee_node *node;
  bt__wakes *block;
};

/* How far from the axis, in diameters, a wake can leave a lee: A lee ends 60 diameters downstream
   with a half width of 13.4 diameters (wake.c), hence at a distance of 61.5 diameters.  */
#define BT__LEE_REACH 62.0

/* Make WAKE number I, below BT__WAKES_WIDE, of BLOCK, which was zero.  */
void bt__wakes_put (bt__wakes *block, size_t i, const bt_wake *wake);

#endif
