/* Meshes of the reference data, read from OBJ: enough of the format for those files.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_OBJ_H
#define BT_ORACLE_OBJ_H

#include "collide/mesh.h"

/* Nonzero if the reference data has the mesh NAME.  */
int obj_is_here (const char *name);

/* The mesh NAME of the reference data; NULL when it is not here.  */
bt__mesh *obj_mesh (const char *name);

#endif
