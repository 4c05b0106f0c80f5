/* From a scene of assimp to one soup of triangles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_READER_CONVERT_H
#define BT_MESH_READER_CONVERT_H

#include <assimp/scene.h>

#include <bight/mesh.h>

/* A soup that grows: its first VERTICES and TRIANGLES are in use.  Free both arrays.  */
typedef struct bt__soup_made
{
  bt_vec3 *vertex;
  uint32_t (*corner)[3];
  uint32_t vertices, triangles;
  uint32_t room_vertices, room_triangles;
  uint32_t *slot; /* of the table of places: a vertex + 1, or 0 */
  uint32_t slots; /* a power of two */
} bt__soup_made;

/* Put every triangle of SCENE into *SOUP, which is overwritten and to be released with
   bt__soup_free even on failure: nodes in order, placed by their transforms, UP turned to z,
   corners at equal places welded to a vertex.  Nothing is assumed of SCENE but arrays of the stated
   lengths.  BT_ERR_FORMAT, BT_ERR_LIMIT.  */
bt_status bt__soup_from_scene (const struct aiScene *scene, bt_mesh_up up, bt__soup_made *soup,
                               bt_error *error);
void bt__soup_free (bt__soup_made *soup);

#endif
