/* Bytes as a mesh file, through assimp itself, as bight-mesh-reader does it.  The first byte is the
   format it is said to be.  What this finds is mostly assimp's own.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <assimp/cimport.h>
#include <assimp/postprocess.h>

#include "mesh-reader/convert.h"
#include "mesh-reader/whole.h"
#include "targets.h"

void
fuzz_mesh_file (const uint8_t *bytes, size_t n)
{
  static const char *const formats[] = { "obj", "stl", "ply", "gltf", "dae", "off" };
  bt__soup_made soup;
  bt_error e;
  if (n < 2 || bt__whole ((const char *)bytes + 1, n - 1, &e) != BT_OK)
    return;
  const struct aiScene *scene
      = aiImportFileFromMemory ((const char *)bytes + 1, (unsigned)(n - 1), aiProcess_Triangulate,
                                formats[bytes[0] % (sizeof formats / sizeof *formats)]);
  if (!scene)
    return;
  bt__soup_from_scene (scene, BT_MESH_UP_Z, &soup, &e);
  bt__soup_free (&soup);
  aiReleaseImport (scene);
}
