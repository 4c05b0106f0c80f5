/* The stream from bight-mesh-reader to bight: one mesh.  Both programs are of one build on one
   machine, so numbers have the machine's representation.

     head | vertices: x y z, m, z up, doubles | corners: three of 32 bits | checksum, 64 bits

   The checksum is bt__hash of the three parts in turn, each from the hash of the part before.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_STREAM_H
#define BT_MESH_STREAM_H

#include <stddef.h>
#include <stdint.h>

#include <bight/mesh.h>

#define BT__MESH_MAGIC "bt-mesh\n"

enum
{
  BT__MESH_VERSION = 1
};

/* Exit statuses of the reader; all but the first come with one line on standard error.  */
enum
{
  BT__MESH_EXIT_OK = 0,
  BT__MESH_EXIT_FORMAT = 10,
  BT__MESH_EXIT_LIMIT,
  BT__MESH_EXIT_IO
};

typedef struct bt__mesh_head
{
  char magic[8];
  uint32_t version;
  uint32_t vertices;  /* at most 3 * triangles */
  uint32_t triangles; /* 1 to BT_MESH_TRIANGLES_MAX */
  uint32_t spare;     /* 0 */
} bt__mesh_head;

/* Where bytes come from.  READ returns how many it got, fewer than N only at the end.  */
typedef struct bt__mesh_source
{
  size_t (*read) (void *user, void *to, size_t n);
  void *user;
} bt__mesh_source;

/* Take one mesh from SOURCE, and nothing after it, into *OUT (NULL on failure).  The mesh is
   complete and checked, whatever the bytes.  BT_ERR_FORMAT tells the fault, BT_ERR_VERSION a reader
   of another build, BT_ERR_LIMIT a lack of memory.  */
bt_status bt__mesh_take (const bt__mesh_source *source, bt_mesh_data **out, bt_error *error);

#endif
