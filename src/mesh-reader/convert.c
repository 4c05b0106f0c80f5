/* From a scene of assimp to one soup of triangles.  The walk through the nodes moves each mesh to
   its place in double precision.  Corners with equal coordinates, bit for bit, are welded by a hash
   table (open addressing, never more than half full).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "mesh-reader/convert.h"

enum
{
  DEPTH_MAX = 500 /* of nodes within nodes */
};

/* Three rows of a matrix that moves points: turn, stretch and shift.  */
typedef struct motion
{
  double m[3][4];
} motion;

typedef struct walk
{
  const struct aiScene *scene;
  bt__soup_made *soup;
  bt_error *error;
} walk;

/* ---- Motions ---- */

static motion
motion_of (const struct aiMatrix4x4 *a)
{
  return (motion){ { { a->a1, a->a2, a->a3, a->a4 },
                     { a->b1, a->b2, a->b3, a->b4 },
                     { a->c1, a->c2, a->c3, a->c4 } } };
}

/* The motion that does INNER first, then OUTER.  */
static motion
compose (const motion *outer, const motion *inner)
{
  motion c;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++)
      {
        c.m[i][j] = j == 3 ? outer->m[i][3] : 0;
        for (int k = 0; k < 3; k++)
          c.m[i][j] += outer->m[i][k] * inner->m[k][j];
      }
  return c;
}

static double
move_row (const double row[4], const struct aiVector3D *p)
{
  /* Adding 0 makes -0 the same place as 0.  */
  return row[0] * p->x + row[1] * p->y + row[2] * p->z + row[3] + 0.0;
}

static bt_vec3
move (const motion *t, const struct aiVector3D *p)
{
  return (bt_vec3){ move_row (t->m[0], p), move_row (t->m[1], p), move_row (t->m[2], p) };
}

/* ---- Room ---- */

static bt_status
no_memory (bt_error *error)
{
  return bt__fail (error, BT_ERR_LIMIT, "there is no memory for so large a mesh");
}

/* Make *ARRAY of *ROOM elements of SIZE bytes hold WANTED.  True when it does.  */
static int
grow (void **array, uint32_t *room, uint64_t wanted, size_t size)
{
  if (wanted <= *room)
    return 1;
  uint64_t more = 2 * (uint64_t)*room > wanted ? 2 * (uint64_t)*room : wanted;
  void *grown = realloc (*array, more * size);
  if (!grown)
    return 0;
  *array = grown;
  *room = (uint32_t)more;
  return 1;
}

/* The slot of the place P: where it is, or where it goes.  */
static uint32_t *
find_slot (const bt__soup_made *soup, const bt_vec3 *p)
{
  uint32_t i = (uint32_t)bt__hash (p, sizeof *p, 0) & (soup->slots - 1);
  while (soup->slot[i] && memcmp (soup->vertex + soup->slot[i] - 1, p, sizeof *p) != 0)
    i = (i + 1) & (soup->slots - 1);
  return soup->slot + i;
}

/* Make the table of places twice as large as VERTICES can fill.  */
static int
widen_table (bt__soup_made *soup, uint64_t vertices)
{
  uint32_t slots = soup->slots ? soup->slots : 64;
  while (slots < 2 * vertices)
    slots *= 2;
  if (slots == soup->slots)
    return 1;
  uint32_t *slot = calloc (slots, sizeof *slot);
  if (!slot)
    return 0;
  free (soup->slot);
  soup->slot = slot;
  soup->slots = slots;
  for (uint32_t v = 0; v < soup->vertices; v++)
    *find_slot (soup, soup->vertex + v) = v + 1;
  return 1;
}

/* Make room for what MESH can add: no more vertices than it has, or its corners.  */
static bt_status
make_room (bt__soup_made *soup, const struct aiMesh *mesh, bt_error *error)
{
  uint64_t triangles = (uint64_t)soup->triangles + mesh->mNumFaces;
  uint64_t corners = 3 * (uint64_t)mesh->mNumFaces;
  uint64_t vertices
      = soup->vertices + (corners < mesh->mNumVertices ? corners : mesh->mNumVertices);
  if (triangles > BT_MESH_TRIANGLES_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "it has more than %d triangles, the most allowed",
                     BT_MESH_TRIANGLES_MAX);
  if (!grow ((void **)&soup->corner, &soup->room_triangles, triangles, sizeof *soup->corner)
      || !grow ((void **)&soup->vertex, &soup->room_vertices, vertices, sizeof *soup->vertex)
      || !widen_table (soup, vertices))
    return no_memory (error);
  return BT_OK;
}

/* ---- Meshes ---- */

/* Find or make the vertex of the soup where T moves the corner C.  */
static bt_status
weld (bt__soup_made *soup, const struct aiVector3D *c, const motion *t, uint32_t *vertex,
      bt_error *error)
{
  bt_vec3 p = move (t, c);
  if (!isfinite (p.x) || !isfinite (p.y) || !isfinite (p.z))
    return bt__fail (error, BT_ERR_FORMAT, "it has a corner at (%g, %g, %g), which is no place",
                     (double)c->x, (double)c->y, (double)c->z);
  uint32_t *slot = find_slot (soup, &p);
  if (!*slot)
    {
      soup->vertex[soup->vertices++] = p;
      *slot = soup->vertices;
    }
  *vertex = *slot - 1;
  return BT_OK;
}

/* Put one triangle FACE of MESH, moved by T, into the soup.  WELDED knows the vertices of MESH that
   are there already, as number + 1.  */
static bt_status
put_face (walk *w, const struct aiMesh *mesh, const struct aiFace *face, const motion *t,
          uint32_t *welded)
{
  uint32_t *corner = w->soup->corner[w->soup->triangles];
  for (int k = 0; k < 3; k++)
    {
      uint32_t v = face->mIndices[k];
      if (v >= mesh->mNumVertices)
        return bt__fail (w->error, BT_ERR_FORMAT,
                         "it has a face with corner %u of a mesh of %u vertices", (unsigned)v,
                         (unsigned)mesh->mNumVertices);
      if (welded[v])
        {
          corner[k] = welded[v] - 1;
          continue;
        }
      bt_status s = weld (w->soup, mesh->mVertices + v, t, corner + k, w->error);
      if (s != BT_OK)
        return s;
      welded[v] = corner[k] + 1;
    }
  w->soup->triangles++;
  return BT_OK;
}

static bt_status
put_mesh (walk *w, const struct aiMesh *mesh, const motion *t)
{
  if (!mesh->mVertices || !mesh->mFaces)
    return BT_OK;
  bt_status s = make_room (w->soup, mesh, w->error);
  if (s != BT_OK)
    return s;
  uint32_t *welded = calloc (mesh->mNumVertices ? mesh->mNumVertices : 1, sizeof *welded);
  if (!welded)
    return no_memory (w->error);
  for (uint32_t i = 0; s == BT_OK && i < mesh->mNumFaces; i++)
    if (mesh->mFaces[i].mNumIndices == 3)
      s = put_face (w, mesh, mesh->mFaces + i, t, welded);
  free (welded);
  return s;
}

/* ---- Nodes ---- */

static bt_status
put_node (walk *w, const struct aiNode *node, const motion *outer, int depth)
{
  if (depth > DEPTH_MAX)
    return bt__fail (w->error, BT_ERR_LIMIT, "its nodes are nested more than %d deep", DEPTH_MAX);
  motion local = motion_of (&node->mTransformation), t = compose (outer, &local);
  for (uint32_t i = 0; i < node->mNumMeshes; i++)
    {
      uint32_t k = node->mMeshes[i];
      if (k >= w->scene->mNumMeshes)
        return bt__fail (w->error, BT_ERR_FORMAT, "a node of it wants mesh %u of %u", (unsigned)k,
                         (unsigned)w->scene->mNumMeshes);
      bt_status s = put_mesh (w, w->scene->mMeshes[k], &t);
      if (s != BT_OK)
        return s;
    }
  for (uint32_t i = 0; i < node->mNumChildren; i++)
    {
      bt_status s = put_node (w, node->mChildren[i], &t, depth + 1);
      if (s != BT_OK)
        return s;
    }
  return BT_OK;
}

bt_status
bt__soup_from_scene (const struct aiScene *scene, bt_mesh_up up, bt__soup_made *soup,
                     bt_error *error)
{
  static const motion z_up = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };
  static const motion y_up = { { { 1, 0, 0, 0 }, { 0, 0, -1, 0 }, { 0, 1, 0, 0 } } };
  walk w = { scene, soup, error };
  *soup = (bt__soup_made){ 0 };
  bt_status s = scene->mRootNode
                    ? put_node (&w, scene->mRootNode, up == BT_MESH_UP_Y ? &y_up : &z_up, 0)
                    : BT_OK;
  if (s == BT_OK && soup->triangles == 0)
    return bt__fail (error, BT_ERR_FORMAT, "it has no triangle");
  return s;
}

void
bt__soup_free (bt__soup_made *soup)
{
  free (soup->vertex);
  free (soup->corner);
  free (soup->slot);
  *soup = (bt__soup_made){ 0 };
}
