/* Bytes as a scene of assimp: up to four meshes, eight nodes, faces of up to five corners, any
   numbers in all of them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh-reader/convert.h"
#include "targets.h"

enum
{
  MESHES = 4,
  NODES = 8,
  FACES = 20,
  VERTICES = 20,
  CORNERS = 5
};

typedef struct tape
{
  const uint8_t *at;
  size_t left;
} tape;

typedef struct stage
{
  struct aiScene scene;
  struct aiMesh mesh[MESHES], *meshes[MESHES];
  struct aiFace face[MESHES][FACES];
  unsigned corner[MESHES][FACES][CORNERS];
  struct aiVector3D *vertex[MESHES]; /* as long as it says, and no longer */
  struct aiNode node[NODES], *children[NODES][NODES];
  unsigned meshes_of[NODES][MESHES];
} stage;

static unsigned
take (tape *t, unsigned below)
{
  if (t->left == 0)
    return 0;
  t->left--;
  return *t->at++ % below;
}

/* Small whole numbers, mostly; any float at times.  */
static float
take_float (tape *t)
{
  float f = (float)take (t, 9) - 4;
  if (take (t, 8) == 0 && t->left >= sizeof f)
    {
      memcpy (&f, t->at, sizeof f);
      t->at += sizeof f;
      t->left -= sizeof f;
    }
  return f;
}

static void
make_mesh (tape *t, stage *s, unsigned m)
{
  struct aiMesh *mesh = s->mesh + m;
  s->meshes[m] = mesh;
  mesh->mNumVertices = take (t, VERTICES);
  mesh->mNumFaces = take (t, FACES);
  s->vertex[m] = malloc (mesh->mNumVertices * sizeof *s->vertex[m] + 1);
  mesh->mVertices = take (t, 16) ? s->vertex[m] : NULL;
  mesh->mFaces = take (t, 16) ? s->face[m] : NULL;
  for (unsigned i = 0; s->vertex[m] && i < mesh->mNumVertices; i++)
    s->vertex[m][i] = (struct aiVector3D){ take_float (t), take_float (t), take_float (t) };
  for (unsigned i = 0; i < mesh->mNumFaces; i++)
    {
      unsigned wild = take (t, 16) == 0;
      s->face[m][i].mNumIndices = take (t, 4) ? 3 : take (t, CORNERS + 1);
      s->face[m][i].mIndices = s->corner[m][i];
      for (int k = 0; k < CORNERS; k++)
        s->corner[m][i][k]
            = take (t, 256) * (wild ? 0x1010101u : 1) % (wild ? ~0u : mesh->mNumVertices + 1);
    }
}

static void
make_node (tape *t, stage *s, unsigned i)
{
  struct aiNode *node = s->node + i;
  float *a = &node->mTransformation.a1;
  for (int k = 0; k < 16; k++)
    a[k] = take_float (t);
  node->mMeshes = s->meshes_of[i];
  node->mNumMeshes = take (t, MESHES + 1);
  for (unsigned k = 0; k < node->mNumMeshes; k++)
    s->meshes_of[i][k] = take (t, MESHES + 1);
  node->mChildren = s->children[i];
  if (i > 0)
    {
      struct aiNode *parent = s->node + take (t, i);
      parent->mChildren[parent->mNumChildren++] = node;
    }
}

static void
check (const bt__soup_made *soup)
{
  fuzz_check (soup->triangles > 0 && soup->vertices > 0);
  for (uint32_t i = 0; i < soup->vertices; i++)
    {
      const bt_vec3 *p = soup->vertex + i;
      fuzz_check (isfinite (p->x) && isfinite (p->y) && isfinite (p->z));
      for (uint32_t k = 0; k < i; k++)
        fuzz_check (p->x != soup->vertex[k].x || p->y != soup->vertex[k].y
                    || p->z != soup->vertex[k].z);
    }
  for (uint32_t i = 0; i < 3 * soup->triangles; i++)
    fuzz_check (soup->corner[i / 3][i % 3] < soup->vertices);
}

void
fuzz_mesh_convert (const uint8_t *bytes, size_t n)
{
  tape t = { bytes, n };
  bt__soup_made soup;
  bt_error e;
  stage *s = calloc (1, sizeof *s);
  if (!s)
    return;
  bt_mesh_up up = take (&t, 2) ? BT_MESH_UP_Y : BT_MESH_UP_Z;
  s->scene.mNumMeshes = take (&t, MESHES + 1);
  s->scene.mMeshes = s->meshes;
  unsigned nodes = take (&t, NODES + 1);
  s->scene.mRootNode = nodes ? s->node : NULL;
  for (unsigned m = 0; m < s->scene.mNumMeshes; m++)
    make_mesh (&t, s, m);
  for (unsigned i = 0; i < nodes; i++)
    make_node (&t, s, i);
  if (bt__soup_from_scene (&s->scene, up, &soup, &e) == BT_OK)
    check (&soup);
  bt__soup_free (&soup);
  for (unsigned m = 0; m < MESHES; m++)
    free (s->vertex[m]);
  free (s);
}
