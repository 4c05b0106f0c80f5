/* bight-mesh-reader CPU-SECONDS MEGABYTES FILE UP: read a mesh file of any format known to assimp
   and write the mesh to standard output in the form of src/mesh/stream.h. bight runs a process for
   each mesh file of a world: assimp and damaged files cannot harm the dive.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include "mesh-reader/convert.h"
#include "mesh-reader/enclosed.h"
#include "mesh-reader/whole.h"
#include "mesh/reader.h"
#include "mesh/stream.h"

/* The bytes of a file, which may be changed; NULL where it cannot be mapped.  */
typedef struct mapped
{
  char *bytes;
  size_t n;
} mapped;

/* A PLY is all in one file; others name files beside them.  */
static const struct aiScene *
import (const char *file, const mapped *m)
{
  struct aiPropertyStore *wishes = aiCreatePropertyStore ();
  /* Up is what we are told, in the numbers of the file.  */
  aiSetImportPropertyInteger (wishes, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  if (m->bytes && m->n <= UINT_MAX && bt__is_ply (m->bytes, m->n))
    {
      size_t first = bt__ply_without_comments (m->bytes, m->n);
      return aiImportFileFromMemoryWithProperties (m->bytes + first, (unsigned)(m->n - first),
                                                   aiProcess_Triangulate, "ply", wishes);
    }
  if (m->bytes)
    munmap (m->bytes, m->n);
  return aiImportFileExWithProperties (file, aiProcess_Triangulate, NULL, wishes);
}

static int
write_soup (FILE *to, const bt__soup_made *soup)
{
  bt__mesh_head head = { "", BT__MESH_VERSION, soup->vertices, soup->triangles, 0 };
  uint64_t sum = 0;
  memcpy (head.magic, BT__MESH_MAGIC, sizeof head.magic);
  return bt__enclosed_put (to, &head, sizeof head, &sum)
         && bt__enclosed_put (to, soup->vertex, soup->vertices * sizeof *soup->vertex, &sum)
         && bt__enclosed_put (to, soup->corner, soup->triangles * sizeof *soup->corner, &sum)
         && bt__enclosed_finish (to, sum);
}

static int
complain_of_import (void)
{
  const char *why = aiGetErrorString ();
  if (!why || !*why)
    return bt__enclosed_complain (BT__READER_EXIT_FORMAT, "it is not a mesh");
  if (strstr (why, "bad_alloc"))
    return bt__enclosed_complain (BT__READER_EXIT_LIMIT,
                                  "reading it takes more memory than is allowed");
  if (strstr (why, "No suitable reader"))
    return bt__enclosed_complain (BT__READER_EXIT_FORMAT,
                                  "it is in no format that the mesh reader knows");
  return bt__enclosed_complain (BT__READER_EXIT_FORMAT, why);
}

/* A private copy of FILE, of which only what is changed takes memory.  What cannot be mapped is
   left for the import to refuse.  */
static mapped
map_file (const char *file)
{
  struct stat st;
  mapped m = { NULL, 0 };
  int fd = open (file, O_RDONLY);
  if (fd >= 0 && fstat (fd, &st) == 0 && st.st_size > 0)
    {
      void *bytes = mmap (NULL, (size_t)st.st_size, PROT_READ | PROT_WRITE, MAP_PRIVATE, fd, 0);
      if (bytes != MAP_FAILED)
        m = (mapped){ bytes, (size_t)st.st_size };
    }
  if (fd >= 0)
    close (fd);
  return m;
}

static int
run (const char *up, const char *file, FILE *to)
{
  bt__soup_made soup;
  bt_error error;
  mapped m = map_file (file);
  if (m.bytes && bt__whole (m.bytes, m.n, &error) != BT_OK)
    return bt__enclosed_complain_of (&error);
  const struct aiScene *scene = import (file, &m);
  if (!scene)
    return complain_of_import ();
  bt_mesh_up axis = strcmp (up, "y") == 0 ? BT_MESH_UP_Y : BT_MESH_UP_Z;
  if (bt__soup_from_scene (scene, axis, &soup, &error) != BT_OK)
    return bt__enclosed_complain_of (&error);
  if (!write_soup (to, &soup))
    return bt__enclosed_complain (BT__READER_EXIT_IO, "the triangles cannot be handed over");
  return BT__READER_EXIT_OK;
}

int
main (int argc, char **argv)
{
  if (argc != 5 || (strcmp (argv[4], "y") != 0 && strcmp (argv[4], "z") != 0))
    return bt__enclosed_complain (
        EXIT_FAILURE, "usage: bight-mesh-reader CPU-SECONDS MEGABYTES FILE y|z >TRIANGLES");
  FILE *to = bt__enclosed_output ();
  if (!to)
    return bt__enclosed_complain (BT__READER_EXIT_IO, "there is no standard output");
  bt__enclosed_limit (argv[1], argv[2]);
  int status = run (argv[4], argv[3], to);
  fflush (stderr);
  _exit (status); /* the memory goes with the process */
}
