/* Reading a mesh file.  The library of formats runs in bight-mesh-reader, a separate process; this
   file takes the answer.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <unistd.h>

#include "base/error.h"
#include "mesh/file.h"
#include "mesh/read.h"
#include "mesh/stream.h"

/* A million triangles take a second and half a gigabyte.  */
static const bt__reader_limits usual = { 180, 60, 8192 };
static const uint64_t most_bytes = 2000000000;
static const bt__reader mesh_reader = { "bight-mesh-reader", "BIGHT_MESH_READER", "the mesh reader",
                                        "mesh files", "assimp (Debian package: libassimp-dev)" };

bt_status
bt__mesh_read_within (const char *file, bt_mesh_up up, const bt__reader_limits *limits,
                      bt_mesh_data **out, bt_error *error)
{
  char *const arguments[] = { (char *)(up == BT_MESH_UP_Y ? "y" : "z"), NULL };
  int fd;
  uint64_t size;
  bt__child child;
  bt_error why;
  *out = NULL;
  bt_status s = bt__file_open (file, most_bytes, &fd, &size, error);
  if (s != BT_OK)
    return s;
  close (fd); /* the file can be read, which is all that is asked here */
  s = bt__reader_start (&mesh_reader, file, arguments, limits, &child, error);
  if (s != BT_OK)
    return s;
  s = bt__mesh_take (&(bt__answer){ bt__child_read_as, &child, mesh_reader.title }, out, &why);
  if (s != BT_OK)
    bt__fail (error, s, "%s: %s", bt__file_tail (file), why.text);
  s = bt__reader_end (&mesh_reader, file, &child, s, error);
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
