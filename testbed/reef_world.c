/* The obstacles of a world of the gallery, for engine and judge: see reef_world.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "model/model.h"
#include "testbed/contact_scene.h"
#include "testbed/gallery.h"

#define FACET 0.7 /* m: the longest side of a facet of a box */

enum
{
  SKIN_VERTICES = 20000
};

/* Triangles of one surface that grows.  */
typedef struct skin
{
  bt_vec3 v[SKIN_VERTICES];
  uint32_t corner[2 * SKIN_VERTICES][3];
  uint32_t vertices, triangles;
} skin;

/* Add the parallelogram at O with sides A and B, in facets.  */
static void
add_face (skin *k, bt_vec3 o, bt_vec3 a, bt_vec3 b)
{
  int m = (int)ceil (bt__norm (a) / FACET), n = (int)ceil (bt__norm (b) / FACET);
  uint32_t first = k->vertices, row = (uint32_t)m + 1;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= m; i++)
      k->v[k->vertices++] = bt__axpy (bt__axpy (o, (double)i / m, a), (double)j / n, b);
  for (uint32_t j = 0; j < (uint32_t)n; j++)
    for (uint32_t i = 0; i < (uint32_t)m; i++)
      {
        uint32_t p = first + j * row + i, *t = k->corner[k->triangles++],
                 *u = k->corner[k->triangles++];
        t[0] = p;
        t[1] = u[0] = p + 1;
        t[2] = u[2] = p + row;
        u[1] = p + row + 1;
      }
}

/* Add the six sides of the box DEF.  */
static void
add_box (skin *k, const bt_obstacle_def *def)
{
  bt__frame f = bt__turned (def->at, def->heading, def->pitch, def->roll);
  bt_vec3 o = bt__to_world (&f, bt__scale (-0.5, def->size));
  bt_vec3 a = bt__scale (def->size.x, f.x), b = bt__scale (def->size.y, f.y),
          c = bt__scale (def->size.z, f.z);
  add_face (k, o, a, b);
  add_face (k, o, b, c);
  add_face (k, o, c, a);
  add_face (k, bt__add (o, c), a, b);
  add_face (k, bt__add (o, a), b, c);
  add_face (k, bt__add (o, b), c, a);
}

/* Add the boxes of W, as one surface.  */
static int
add_boxes (reef *r, const bt_world *w)
{
  static skin k;
  k.vertices = k.triangles = 0;
  for (int i = 0; i < w->n_obstacles; i++)
    if (w->obstacles[i].kind == BT_OBSTACLE_BOX)
      add_box (&k, w->obstacles + i);
  bt__soup soup = { k.vertices, k.triangles, k.v, (const uint32_t (*)[3])k.corner, NULL, 0 };
  return k.triangles == 0 || reef_soup (r, &soup);
}

/* Add the bed DEF of a sea of DEPTH.  */
static int
add_bed (reef *r, const bt_obstacle_def *def, double depth)
{
  const bt_heights *h = &def->grid;
  bt__grid g = { (uint32_t)h->nx, (uint32_t)h->ny, h->x, h->y, h->dx, h->dy, h->z };
  if (h->z)
    return reef_grid (r, &g);
  reef_plane (r, -depth);
  return 1;
}

int
reef_world (reef *r, const char *name)
{
  gallery_world *w = gallery_open (name);
  int good = reef_open (r) && add_boxes (r, &w->world);
  for (int i = 0; good && i < w->world.n_obstacles; i++)
    {
      const bt_obstacle_def *def = w->obstacle + i;
      if (def->kind == BT_OBSTACLE_SEABED)
        good = add_bed (r, def, w->world.sea.depth);
      else if (def->kind == BT_OBSTACLE_CYLINDER)
        reef_cylinder (r, def->from, def->to, def->radius);
      else if (def->kind == BT_OBSTACLE_CAPSULE)
        reef_wire (r, def->from, def->to, def->radius);
      else
        good = def->kind == BT_OBSTACLE_BOX;
    }
  gallery_close (w);
  return good && reef_raise (r);
}
