/* Words of lines among anything, meshes too: labels on the faces of voxels.

   Method: the edge-path group of a cell complex.  The complex has a vertex for each cell with a
   clear middle, an edge for each clear step between neighbouring cells, and a face for each square
   of four steps through which no obstacle goes.  The fundamental group of the complex stands for
   the group of the water.  The steps of a spanning tree get the empty word as a label.  A square
   with one unlabelled step determines the label of the step; a step determined by no square is a
   new generator.  A square whose labels do not cancel is a relation; relations are simplified as in
   tietze.h.

   A line is followed by cells in sight of the line, and every triangle between line and cells is
   tested, so the word of the cells is the word of the line.  A line in a gap too narrow for cells
   is lost.  Gaps narrower than a cell may be closed: equal words always mean that the lines can be
   deformed into each other; unequal words mean the contrary in the complex only.  Moving obstacles
   are left out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_VOXEL_H
#define BT_AWARE_VOXEL_H

#include "aware/word.h"
#include "base/ask.h"
#include "collide/scene.h"

typedef struct bt__voxels bt__voxels;

enum
{
  BT__VOXELS_MAX = 1 << 22
};

typedef struct bt__voxel_config
{
  const bt__scene *scene;
  const bt__switches *on;
  bt_vec3 lo, hi; /* the water: nothing is outside */
  double cell;
} bt__voxel_config;

typedef struct bt__voxel_report
{
  uint32_t cells, clear;        /* all of them, those in the water */
  uint32_t generators, dropped; /* left, and as many more before simplifying */
  uint32_t leftover;            /* relations left */
} bt__voxel_report;

/* Make *OUT, asking ASKER (NULL: nobody) whether to go on.  BT_ERR_INTERRUPTED; BT_ERR_DOMAIN if
   the box or the cell makes no sense; BT_ERR_LIMIT if there are too many cells or memory runs out.
 */
bt_status bt__voxels_new (const bt__voxel_config *config, bt__asker *asker, bt__voxels **out,
                          bt_error *error);

void bt__voxels_free (bt__voxels *voxels); /* NULL is nothing */

/* Put the word of the polyline P of N points into *WORD; lost if it cannot be followed.  No
   allocation.  */
void bt__voxels_word (const bt__voxels *voxels, const bt_vec3 *p, uint32_t n, bt__word *word,
                      bt__count *count);

#endif
