/* Bytes as the answer of the mesh reader.  The first byte helps past what chance would never guess:
   bit 0 puts a right magic and version in front, bit 1 a right checksum at the end.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "mesh/stream.h"
#include "targets.h"

typedef struct tape
{
  const uint8_t *at;
  size_t left;
} tape;

static size_t
play (void *user, void *to, size_t n)
{
  tape *t = user;
  size_t k = n < t->left ? n : t->left;
  memcpy (to, t->at, k);
  t->at += k;
  t->left -= k;
  return k;
}

static void
set_head (uint8_t *answer)
{
  bt__mesh_head head;
  memcpy (&head, answer, sizeof head);
  memcpy (head.magic, BT__MESH_MAGIC, sizeof head.magic);
  head.version = BT__MESH_VERSION;
  head.spare = 0;
  head.triangles &= 0xff;
  head.vertices &= 0xff;
  memcpy (answer, &head, sizeof head);
}

/* Put the checksum where the head says it is.  */
static void
set_sum (uint8_t *answer, size_t n)
{
  bt__mesh_head head;
  memcpy (&head, answer, sizeof head);
  uint64_t v = 24 * (uint64_t)head.vertices, c = 12 * (uint64_t)head.triangles;
  if (sizeof head + v + c + 8 > n)
    return;
  uint64_t sum = bt__hash (answer, sizeof head, 0);
  sum = bt__hash (answer + sizeof head, v, sum);
  sum = bt__hash (answer + sizeof head + v, c, sum);
  memcpy (answer + sizeof head + v + c, &sum, 8);
}

static void
check (const bt_mesh_data *data)
{
  const bt_triangles *m = &data->mesh;
  fuzz_check (m->triangles > 0 && m->triangles <= BT_MESH_TRIANGLES_MAX && m->vertices > 0);
  for (size_t i = 0; i < m->vertices; i++)
    fuzz_check (isfinite (m->vertex[i].x) && isfinite (m->vertex[i].y)
                && isfinite (m->vertex[i].z));
  for (size_t i = 0; i < 3 * m->triangles; i++)
    fuzz_check (m->corner[i / 3][i % 3] < m->vertices);
}

void
fuzz_mesh_stream (const uint8_t *bytes, size_t n)
{
  bt_mesh_data *data;
  bt_error e;
  if (n < 1 + sizeof (bt__mesh_head))
    return;
  uint8_t *answer = malloc (n - 1);
  if (!answer)
    return;
  memcpy (answer, bytes + 1, n - 1);
  if (bytes[0] & 1)
    set_head (answer);
  if (bytes[0] & 2)
    set_sum (answer, n - 1);
  tape t = { answer, n - 1 };
  bt_status s = bt__mesh_take (&(bt__answer){ play, &t, "the mesh reader" }, &data, &e);
  fuzz_check ((s == BT_OK) == (data != NULL));
  if (data)
    check (data);
  bt_mesh_data_free (data);
  free (answer);
}
