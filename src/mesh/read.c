/* Reading a mesh file.  The library of formats runs in bight-mesh-reader, a separate process; this
   file takes the answer.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include "mesh/read.h"
#include "mesh/stream.h"

/* A million triangles take a second and half a gigabyte.  */
static const bt__reader_limits usual = { 180, 60, 8192 };
static const bt__reader mesh_reader = { "bight-mesh-reader",
                                        "BIGHT_MESH_READER",
                                        "the mesh reader",
                                        "mesh files",
                                        "assimp (Debian package: libassimp-dev)",
                                        2000000000 };

static bt_status
take_mesh (const bt__answer *answer, void *into, bt_error *error)
{
  return bt__mesh_take (answer, into, error);
}

bt_status
bt__mesh_read_within (const char *file, bt_mesh_up up, const bt__reader_limits *limits,
                      bt_mesh_data **out, bt_error *error)
{
  char *const arguments[] = { (char *)(up == BT_MESH_UP_Y ? "y" : "z"), NULL };
  *out = NULL;
  bt_status s = bt__reader_ask (&mesh_reader, file, arguments, limits, take_mesh, out, error);
  if (s != BT_OK)
    {
      bt_mesh_data_free (*out);
      *out = NULL;
    }
  return s;
}

bt_status
bt_mesh_read (const char *file, bt_mesh_up up, bt_mesh_data **out, bt_error *error)
{
  return bt__mesh_read_within (file, up, &usual, out, error);
}
