/* The inside of the voxels: the grid, and the labels of its steps.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_VOXEL_JOB_H
#define BT_AWARE_VOXEL_JOB_H

#include "aware/tietze.h"
#include "aware/voxel.h"

#define BT__NOWHERE UINT32_MAX

enum
{
  BT__UNKNOWN = -1 /* label of a step that has none */
};

/* Words by number, each once; 0 is the one without letters.  */
typedef struct bt__pool
{
  int32_t *letter;
  uint32_t *start, *slot; /* word i is from start[i] to start[i + 1] - 1; slots of the table */
  uint32_t n, room, letters, letter_room, slots;
  int failed;
} bt__pool;

struct bt__voxels
{
  bt__asker *asker; /* while it is made */
  bt__voxel_config c;
  uint32_t n[3], cells;
  float *clear;    /* m from each middle to anything, up to twice the cell; 0 or less: blocked */
  int32_t *label;  /* of the step from cell i along axis a, 3 i + a: a word */
  uint8_t *open;   /* bit a: that step is clear; bit 3 + a: the square across axis a is */
  uint32_t *queue; /* cells or steps, while building */
  bt__pool pool;
  bt__group group;
  bt__voxel_report report;
  uint64_t world;
};

/* The cell next to CELL along AXIS (0 to 2), WAY 1 or -1; BT__NOWHERE outside.  */
uint32_t bt__voxel_next (const bt__voxels *v, uint32_t cell, int axis, int way);

bt_vec3 bt__voxel_middle (const bt__voxels *v, uint32_t cell);

/* The cell of P, or the nearest to it.  */
uint32_t bt__voxel_of (const bt__voxels *v, bt_vec3 p);

/* True if nothing is in the triangle A, B, C.  */
int bt__voxel_sees (const bt__voxels *v, bt_vec3 a, bt_vec3 b, bt_vec3 c, bt__count *count);

/* Label the steps; the grid is there.  */
bt_status bt__voxels_label (bt__voxels *v, bt_error *error);

#endif
