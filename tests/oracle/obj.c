/* See obj.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "obj.h"
#include "testbed/reference.h"

enum
{
  MOST = 400000
};

typedef struct model
{
  bt_vec3 *v;
  uint32_t (*corner)[3];
  uint32_t vertices, triangles;
} model;

/* The first number of each corner of a line "f a/b/c ...", fans of what has more than three.  */
static void
read_face (model *m, const char *line)
{
  uint32_t first = 0, last = 0, n = 0;
  for (const char *at = strchr (line, ' '); at && m->triangles < MOST; at = strchr (at + 1, ' '))
    {
      long k = strtol (at, NULL, 10);
      if (k < 1)
        continue;
      uint32_t c = (uint32_t)(k - 1);
      if (n >= 2)
        memcpy (m->corner[m->triangles++], (uint32_t[]){ first, last, c }, sizeof *m->corner);
      first = n++ ? first : c;
      last = c;
    }
}

static int
read_obj (model *m, FILE *f)
{
  char line[1024];
  *m = (model){ 0 };
  m->v = malloc (MOST * sizeof *m->v);
  m->corner = malloc (MOST * sizeof *m->corner);
  while (m->v && m->corner && fgets (line, sizeof line, f))
    if (line[0] == 'v' && line[1] == ' ' && m->vertices < MOST)
      {
        bt_vec3 *p = m->v + m->vertices;
        m->vertices += sscanf (line + 1, "%lf %lf %lf", &p->x, &p->y, &p->z) == 3;
      }
    else if (line[0] == 'f')
      read_face (m, line);
  return m->triangles > 0;
}

static FILE *
open_mesh (const char *name)
{
  char path[100];
  snprintf (path, sizeof path, "meshes/%s", name);
  return bench_open_reference (path);
}

int
obj_is_here (const char *name)
{
  FILE *f = open_mesh (name);
  if (f)
    fclose (f);
  return f != NULL;
}

bt__mesh *
obj_mesh (const char *name)
{
  FILE *f = open_mesh (name);
  model m;
  bt_error error;
  bt__mesh *mesh = NULL;
  if (!f)
    return NULL;
  assert_true (read_obj (&m, f));
  fclose (f);
  bt__soup soup = { m.vertices, m.triangles, m.v, (const uint32_t (*)[3])m.corner, NULL, 0 };
  if (bt__mesh_new (&soup, NULL, NULL, &mesh, &error))
    fail_msg ("%s: %s", name, error.text);
  free (m.v);
  free (m.corner);
  return mesh;
}
