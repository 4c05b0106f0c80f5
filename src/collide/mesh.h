/* Triangle soups: any triangles at all, open, crossing, without area; two-sided, no inside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_MESH_H
#define BT_COLLIDE_MESH_H

#include "collide/bvh.h"

/* Where a shape stands in the world: scaled about its own origin, turned by HEADING (radians,
   clockwise seen from above: 0 leaves it, pi / 2 brings its north to the east), then moved.  */
typedef struct bt__place
{
  bt_vec3 at;
  double heading, scale;
} bt__place;

typedef struct bt__mesh
{
  uint32_t vertices, triangles;
  bt_vec3 *v;
  uint32_t (*corner)[3]; /* in leaf order */
  uint32_t *id;          /* in leaf order */
  uint32_t *next_corner; /* by 3 slot + i: the next corner at the same point, in a ring */
  uint32_t *next_edge;   /* by 3 slot + i, the edge from corner i: the next between the same points,
                            in a ring */
  uint8_t *folds;        /* bit i: edge i is not one of two triangles in a plane */
  bt__aabb box;
  bt__bvh tree;
} bt__mesh;

#define BT__MESH_FLAT 1e-3 /* sine of the angle up to which two triangles are in a plane */

typedef struct bt__soup
{
  uint32_t vertices, triangles;
  const bt_vec3 *v;
  const uint32_t (*corner)[3];
  const uint32_t *id; /* NULL: 0, 1, 2 ... */
  int workers;        /* that make the mesh, always of the same bits; 0: as many as pay */
} bt__soup;

/* Copy SOUP, placed by PLACE (NULL: as it is), into *OUT with its tree, asking ASKER (NULL: nobody)
   whether to go on.  BT_ERR_DOMAIN if SOUP is empty, a number is not finite, a corner exceeds the
   number of vertices, the scale is not positive; BT_ERR_LIMIT; BT_ERR_INTERRUPTED.  */
bt_status bt__mesh_new (const bt__soup *soup, const bt__place *place, bt__asker *asker,
                        bt__mesh **out, bt_error *error);

/* A height field as a mesh: NX by NY posts DX and DY apart, the first at (X, Y), rows to the north;
   triangles 2 (i + j (NX - 1)) and the next are of the field east and north of post (i, j).  */
typedef struct bt__grid
{
  uint32_t nx, ny;
  double x, y, dx, dy;
  const double *z; /* nx * ny, east fastest; NaN: no bottom there */
} bt__grid;

bt_status bt__mesh_from_grid (const bt__grid *grid, const bt__place *place, bt__asker *asker,
                              bt__mesh **out, bt_error *error);

void bt__mesh_free (bt__mesh *mesh); /* NULL is nothing */

/* mesh_rings.c: the triangles of SOUP into M in the order of its tree's leaves, their box and their
   neighbours, by WORKERS (NULL: by the caller alone); the result does not depend on the
   number of workers.
   BT_ERR_LIMIT; BT_ERR_INTERRUPTED.  */
bt_status bt__mesh_sort (bt__mesh *mesh, const bt__soup *soup, bt__workers *workers,
                         bt__asker *asker, bt_error *error);

/* The corners and ids of M, from SOUP, in the order of its tree's leaves.  */
void bt__mesh_put_in_order (bt__mesh *mesh, const bt__soup *soup);

static inline bt__triangle
bt__mesh_triangle (const bt__mesh *m, uint32_t slot)
{
  const uint32_t *c = m->corner[slot];
  return (bt__triangle){ { m->v[c[0]], m->v[c[1]], m->v[c[2]] } };
}

#endif
