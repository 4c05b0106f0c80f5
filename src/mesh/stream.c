/* Taking a mesh from the reader's stream.

   The reader ran a foreign library on a foreign file, so nothing is believed.  In this order:
   magic, version and counts of the head, before memory is allocated for them; the body, which must
   be as long as announced, and a checksum over head and body, with nothing behind; then every
   coordinate must be finite and every corner an existing vertex.  Only a mesh that passed all
   checks is returned.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "mesh/stream.h"

void
bt_mesh_data_free (bt_mesh_data *data)
{
  if (!data)
    return;
  free (data->vertex);
  free (data->corner);
  free (data);
}

static bt_status
check_head (const bt__mesh_head *head, bt_error *error)
{
  if (memcmp (head->magic, BT__MESH_MAGIC, sizeof head->magic) != 0 || head->spare != 0)
    return bt__fail (error, BT_ERR_FORMAT, "the mesh reader's answer is not a mesh");
  if (head->version != BT__MESH_VERSION)
    return bt__fail (error, BT_ERR_VERSION,
                     "the mesh reader is of another build: its version is %u, wanted is %d",
                     (unsigned)head->version, BT__MESH_VERSION);
  if (head->triangles == 0 || head->triangles > BT_MESH_TRIANGLES_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a mesh of %u triangles; 1 to %d are allowed",
                     (unsigned)head->triangles, BT_MESH_TRIANGLES_MAX);
  if (head->vertices == 0 || head->vertices > 3 * head->triangles)
    return bt__fail (error, BT_ERR_FORMAT,
                     "the mesh reader's answer has %u vertices; 1 to 3 for each of the %u "
                     "triangles are allowed",
                     (unsigned)head->vertices, (unsigned)head->triangles);
  return BT_OK;
}

static bt_mesh_data *
new_data (const bt__mesh_head *head)
{
  bt_mesh_data *data = calloc (1, sizeof *data);
  if (!data)
    return NULL;
  data->vertex = malloc (head->vertices * sizeof *data->vertex);
  data->corner = malloc (head->triangles * sizeof *data->corner);
  if (!data->vertex || !data->corner)
    {
      bt_mesh_data_free (data);
      return NULL;
    }
  data->mesh = (bt_triangles){ .vertex = data->vertex,
                               .vertices = head->vertices,
                               .corner = (const uint32_t (*)[3])data->corner,
                               .triangles = head->triangles };
  return data;
}

/* Take the body announced by HEAD into DATA; check the checksum and the end of the stream.  */
static bt_status
take_mesh_body (const bt__answer *answer, const bt__mesh_head *head, bt_mesh_data *data,
                bt_error *error)
{
  size_t vertices = head->vertices * sizeof *data->vertex;
  size_t corners = head->triangles * sizeof *data->corner;
  bt_status s = bt__answer_take (answer, data->vertex, vertices, "vertices", error);
  if (s == BT_OK)
    s = bt__answer_take (answer, data->corner, corners, "corners", error);
  if (s != BT_OK)
    return s;
  uint64_t sum = bt__hash (head, sizeof *head, 0);
  sum = bt__hash (data->vertex, vertices, sum);
  return bt__answer_finish (answer, bt__hash (data->corner, corners, sum), error);
}

static bt_status
check_body (const bt_triangles *mesh, bt_error *error)
{
  for (size_t i = 0; i < mesh->vertices; i++)
    {
      bt_vec3 p = mesh->vertex[i];
      if (!isfinite (p.x) || !isfinite (p.y) || !isfinite (p.z))
        return bt__fail (error, BT_ERR_FORMAT, "vertex %zu is (%g, %g, %g); it must be finite", i,
                         p.x, p.y, p.z);
    }
  for (size_t i = 0; i < mesh->triangles; i++)
    for (int k = 0; k < 3; k++)
      if (mesh->corner[i][k] >= mesh->vertices)
        return bt__fail (error, BT_ERR_FORMAT,
                         "triangle %zu has corner %u; the vertices are 0 to "
                         "%zu",
                         i, (unsigned)mesh->corner[i][k], mesh->vertices - 1);
  return BT_OK;
}

bt_status
bt__mesh_take (const bt__answer *answer, bt_mesh_data **out, bt_error *error)
{
  bt__mesh_head head;
  bt_mesh_data *data;
  *out = NULL;
  bt_status s = bt__answer_take (answer, &head, sizeof head, "head", error);
  if (s == BT_OK)
    s = check_head (&head, error);
  if (s != BT_OK)
    return s;
  data = new_data (&head);
  if (!data)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a mesh of %u triangles",
                     (unsigned)head.triangles);
  s = take_mesh_body (answer, &head, data, error);
  if (s == BT_OK)
    s = check_body (&data->mesh, error);
  if (s == BT_OK)
    *out = data;
  else
    bt_mesh_data_free (data);
  return s;
}
