/* Trees of large meshes, kept on disk from one process to the next.

   A file holds the nodes and the order of the tree and the rings of neighbours, not the triangles
   themselves.  The file's name is a hash of the placed vertices and corners.  The environment
   variable BIGHT_TREES names the folder, an empty BIGHT_TREES none; without the variable the folder
   is bight/trees in XDG_CACHE_HOME or in ~/.cache.

   A file missing, cut short, damaged, of a different version or user counts as none; a tree without
   room on disk is not kept.  No failure is reported.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_MESH_KEEP_H
#define BT_COLLIDE_MESH_KEEP_H

#include "collide/mesh.h"

enum
{
  BT__KEEP_FROM = 20000 /* triangles; fewer are sooner made than found */
};

/* Return the key of M, its vertices placed, its corners as SOUP has them.  */
uint64_t bt__keep_key (const bt__mesh *m, const bt__soup *soup);

/* Fill the tree, the neighbours, the box and the order of M, whose vertices, corners and ids are
   allocated, from the file of KEY; return true if the file is found and sound.
   Else M is as before, with the corners of SOUP.  */
int bt__keep_load (bt__mesh *m, const bt__soup *soup, uint64_t key);

/* Write the file of KEY, whole or not at all; files not used for longest go when all together are
   larger than a gigabyte.  */
void bt__keep_save (const bt__mesh *m, uint64_t key);

#endif
