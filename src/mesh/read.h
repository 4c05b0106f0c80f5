/* Reading a mesh file with limits of one's own, for tests.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_READ_H
#define BT_MESH_READ_H

#include <bight/mesh.h>

#include "mesh/reader.h"

bt_status bt__mesh_read_within (const char *file, bt_mesh_up up, const bt__reader_limits *limits,
                                bt_mesh_data **out, bt_error *error);

#endif
