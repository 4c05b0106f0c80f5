/* The answer of bight-mesh-reader to bight: one mesh.  Writer and reader are of one build on one
   machine: numbers have the form of the machine.

   head | vertices: x y z, m, z up, doubles | corners: three of 32 bits | checksum, 64 bits

   The checksum is bt__hash of the three parts in turn, each from the hash of the part before.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_STREAM_H
#define BT_MESH_STREAM_H

#include <stddef.h>
#include <stdint.h>

#include <bight/mesh.h>

#include "mesh/answer.h"

#define BT__MESH_MAGIC "bt-mesh\n"

enum
{
  BT__MESH_VERSION = 1
};

typedef struct bt__mesh_head
{
  char magic[8];
  uint32_t version;
  uint32_t vertices;  /* at most 3 * triangles */
  uint32_t triangles; /* 1 to BT_MESH_TRIANGLES_MAX */
  uint32_t spare;     /* 0 */
} bt__mesh_head;

/* Take one mesh, with nothing behind, from ANSWER into *OUT (NULL on failure).  The mesh is
   complete and checked, whatever the bytes.  BT_ERR_FORMAT tells the fault, BT_ERR_VERSION a reader
   of another build, BT_ERR_LIMIT a lack of memory.  */
bt_status bt__mesh_take (const bt__answer *answer, bt_mesh_data **out, bt_error *error);

#endif
