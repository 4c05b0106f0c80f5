/* Whether a tree and the rings of a mesh, as read from a file, can be used.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_MESH_SOUND_H
#define BT_COLLIDE_MESH_SOUND_H

#include "collide/mesh.h"

/* True if the nodes of TREE are a tree no deeper than a query's stack, all boxes are finite, and
   leaves and order have each item once.  */
int bt__tree_is_sound (const bt__bvh *tree);

/* True if the rings of M, with corners in order, are closed: rings of corners at equal points,
   rings of edges between equal points.  */
int bt__rings_are_sound (const bt__mesh *m);

#endif
