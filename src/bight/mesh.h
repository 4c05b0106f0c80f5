/* Obstacles from files: triangles of a mesh file, heights of an ESRI ASCII grid.  What comes back
   is whole and checked, or it does not come.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_MESH_H
#define BIGHT_MESH_H

#include <bight/model.h>

BT_BEGIN_DECLS

enum
{
  BT_MESH_TRIANGLES_MAX = 10000000,   /* of one mesh */
  BT_HEIGHTS_POSTS_MAX = BT_POSTS_MAX /* of one grid */
};

/* The axis that points up in the numbers of a mesh file.  glTF's is y; OBJ, STL and PLY do not say;
   what a Collada file declares is not asked.  */
typedef enum bt_mesh_up
{
  BT_MESH_UP_Z = 0,
  BT_MESH_UP_Y /* its x stays, its y becomes z, its z becomes -y */
} bt_mesh_up;

/* Triangles that own their memory.  MESH lends them to a bt_obstacle_def.  Corners that had the
   very same place are one vertex; triangles without area are kept; there is at least one.  */
typedef struct bt_mesh_data
{
  bt_vec3 *vertex; /* m, z up */
  uint32_t (*corner)[3];
  bt_triangles mesh; /* the same, in the order of the file; ids 0, 1, 2 ... */
} bt_mesh_data;

/* Read the mesh in FILE (OBJ, STL, PLY, glTF, Collada and any other format of assimp) into *OUT:
   faces as triangles, placed by the file's nodes; points and lines are left out.  Coordinates pass
   through single precision: 24 bits.  A separate process reads the file: a file that crashes or
   exhausts the reader is an error like any other. *OUT is freed by bt_mesh_data_free, and NULL on
   failure.  BT_ERR_IO when FILE cannot be read, is a folder or empty.  BT_ERR_FORMAT when FILE is
   no mesh, has no triangle or a number that is not finite, or crashes the reader.  BT_ERR_LIMIT
   when FILE is too large, takes too long, or memory is short.  BT_ERR_UNSUPPORTED when bight was
   built without mesh files.  */
bt_status bt_mesh_read (const char *file, bt_mesh_up up, bt_mesh_data **out, bt_error *error);
void bt_mesh_data_free (bt_mesh_data *data); /* NULL is nothing */

/* A height field that owns its memory.  HEIGHTS lends it to a bt_obstacle_def.  */
typedef struct bt_heights_data
{
  double *z; /* m */
  bt_heights heights;
} bt_heights_data;

/* Read the ESRI ASCII grid in FILE into *OUT: heights in metres, z up, posts at the centres of its
   cells, NODATA_value as NaN, the first row (the northernmost) last.  *OUT is freed by
   bt_heights_data_free, and NULL on failure: BT_ERR_IO when FILE cannot be read, is a folder or
   empty; BT_ERR_FORMAT names the line and what was expected there; BT_ERR_LIMIT.  */
bt_status bt_heights_read (const char *file, bt_heights_data **out, bt_error *error);
void bt_heights_data_free (bt_heights_data *data); /* NULL is nothing */

BT_END_DECLS

#endif
