/* gltf FILE: what assimp's reader finds in an animated scene, a line each, for tests/series.sh: the points of joints and
   bodies at each key, and how far a rebuilt vertex of a tube in its first pose is from the mesh.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

static const struct aiNodeAnim *
channel_of (const struct aiAnimation *a, const char *name)
{
  for (unsigned i = 0; i < a->mNumChannels; i++)
    if (strcmp (a->mChannels[i]->mNodeName.data, name) == 0)
      return a->mChannels[i];
  return NULL;
}

/* The place of key K of the channel, and its time in seconds.  */
static void
tell_key (const struct aiAnimation *a, const struct aiNodeAnim *c, unsigned k)
{
  const struct aiVectorKey *key = &c->mPositionKeys[k];
  printf ("key %s %u %.5f %.5f %.5f %.5f\n", c->mNodeName.data, k, key->mTime / a->mTicksPerSecond,
          (double)key->mValue.x, (double)key->mValue.y, (double)key->mValue.z);
}

/* The largest distance from the vertices that a bone holds to the place of its joint's first key: the tube's radius.  */
static double
reach (const struct aiScene *scene, const struct aiMesh *mesh)
{
  double most = 0;
  for (unsigned b = 0; b < mesh->mNumBones; b++)
    {
      const struct aiBone *bone = mesh->mBones[b];
      for (unsigned w = 0; w < bone->mNumWeights; w++)
        {
          struct aiVector3D v = mesh->mVertices[bone->mWeights[w].mVertexId];
          aiTransformVecByMatrix4 (&v, &bone->mOffsetMatrix);
          double d = sqrt ((double)v.x * v.x + (double)v.y * v.y + (double)v.z * v.z);
          if (bone->mWeights[w].mWeight > 0 && d > most)
            most = d;
        }
    }
  (void)scene;
  return most;
}

int
main (int argc, char **argv)
{
  const struct aiScene *scene = argc == 2 ? aiImportFile (argv[1], aiProcess_ValidateDataStructure) : NULL;
  if (!scene || scene->mNumAnimations != 1)
    {
      printf ("unread %s\n", aiGetErrorString ());
      return 1;
    }
  const struct aiAnimation *a = scene->mAnimations[0];
  for (unsigned i = 0; i < a->mNumChannels; i++)
    for (unsigned k = 0; k < a->mChannels[i]->mNumPositionKeys; k++)
      tell_key (a, a->mChannels[i], k);
  for (unsigned m = 0; m < scene->mNumMeshes; m++)
    {
      const struct aiMesh *mesh = scene->mMeshes[m];
      if (mesh->mNumBones && channel_of (a, mesh->mBones[0]->mName.data))
        printf ("tube %u bones, radius %.4f\n", mesh->mNumBones, reach (scene, mesh));
    }
  aiReleaseImport (scene);
  return 0;
}
