/* The text of an ESRI ASCII grid, apart from the file it is in.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_GRID_H
#define BT_MESH_GRID_H

#include <stddef.h>

#include <bight/mesh.h>

/* Read TEXT, N bytes and a further NUL, into *OUT as bt_heights_read does.  NAME begins every
   error.  */
bt_status bt__grid_parse (const char *name, const char *text, size_t n, bt_heights_data **out,
                          bt_error *error);

#endif
