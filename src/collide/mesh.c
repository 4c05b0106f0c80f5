/* Triangle soups: checked, placed, sorted into the order of their tree's leaves.

   A soup may come from any file, so every number is checked before use: vertices finite and within
   1e12 of the origin, corners within the vertices, at most as many triangles as a tree can hold.
   Nothing is asked of the topology: triangles may be open, cross or have no area, and a mesh has no
   inside.

   After the tree is built, corners and numbers of triangles are stored in the order of the leaves,
   so that the few triangles of a leaf lie side by side in memory.  The number of a triangle in the
   soup is kept as its id; a question answers with both slot (place in leaf order) and id.

   A height field becomes two triangles to each field of four posts, cut along the diagonal from
   south-west to north-east.  A triangle with a post of NaN is left out: there the bed has a hole.
   Ids count all triangles of the grid, also those left out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "collide/mesh.h"
#include "collide/mesh_keep.h"

/* Farther from the origin than this no geometry holds in doubles.  */
#define FAR 1e12

enum
{
  SHARED = 50000,  /* triangles, from which on threads pay */
  MOST_WORKERS = 4 /* of more, each would wait for memory */
};

static bt_vec3
turned_by_place (const bt__place *place, bt_vec3 d)
{
  double c = cos (place->heading), s = sin (place->heading);
  return bt__vec (c * d.x + s * d.y, c * d.y - s * d.x, d.z);
}

static bt_vec3
placed (const bt__place *place, bt_vec3 p)
{
  return bt__add (place->at, turned_by_place (place, bt__scale (place->scale, p)));
}

void
bt__mesh_free (bt__mesh *m)
{
  if (!m)
    return;
  bt__bvh_free (&m->tree);
  free (m->v);
  free (m->corner);
  free (m->id);
  free (m->next_corner);
  free (m->next_edge);
  free (m->folds);
  free (m);
}

/* ---- Checks ---- */

static bt_status
check_place (const bt__place *p, bt_error *error)
{
  if (p && !(bt__is_finite (p->at) && isfinite (p->heading) && p->scale > 0 && isfinite (p->scale)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a mesh cannot be placed at (%g, %g, %g), heading %g, scale %g: all must be "
                     "finite, the scale positive",
                     p->at.x, p->at.y, p->at.z, p->heading, p->scale);
  return BT_OK;
}

static bt_status
check_soup (const bt__soup *s, bt_error *error)
{
  if (s->triangles == 0 || s->vertices == 0)
    return bt__fail (error, BT_ERR_DOMAIN, "a mesh has %u vertices and %u triangles: it is empty",
                     (unsigned)s->vertices, (unsigned)s->triangles);
  if (s->triangles > BT__BVH_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a mesh has %u triangles; at most %d are allowed",
                     (unsigned)s->triangles, BT__BVH_MAX);
  for (uint32_t i = 0; i < s->vertices; i++)
    if (!(bt__largest (s->v[i]) <= FAR) || !bt__is_finite (s->v[i]))
      return bt__fail (error, BT_ERR_DOMAIN,
                       "vertex %u of a mesh is (%g, %g, %g); it must be finite, within %g",
                       (unsigned)i, s->v[i].x, s->v[i].y, s->v[i].z, FAR);
  for (uint32_t i = 0; i < s->triangles; i++)
    for (int k = 0; k < 3; k++)
      if (s->corner[i][k] >= s->vertices)
        return bt__fail (error, BT_ERR_DOMAIN,
                         "triangle %u of a mesh has corner %u; its vertices are 0 to %u",
                         (unsigned)i, (unsigned)s->corner[i][k], (unsigned)(s->vertices - 1));
  return BT_OK;
}

/* ---- Making ---- */

static void
box_of_triangle (const void *user, uint32_t i, bt__aabb *box)
{
  const bt__mesh *m = user;
  bt_vec3 a = m->v[m->corner[i][0]], b = m->v[m->corner[i][1]], c = m->v[m->corner[i][2]];
#define LEAST(x, y) ((x) < (y) ? (x) : (y))
#define MOST(x, y) ((x) > (y) ? (x) : (y))
#define OF_ALL(pick, k) pick (pick (a.k, b.k), c.k)
  box->lo = bt__vec (OF_ALL (LEAST, x), OF_ALL (LEAST, y), OF_ALL (LEAST, z));
  box->hi = bt__vec (OF_ALL (MOST, x), OF_ALL (MOST, y), OF_ALL (MOST, z));
}

static int
copy_soup (bt__mesh *m, const bt__soup *s, const bt__place *place)
{
  m->vertices = s->vertices;
  m->triangles = s->triangles;
  m->v = malloc (s->vertices * sizeof *m->v);
  m->corner = malloc (s->triangles * sizeof *m->corner);
  m->id = malloc (s->triangles * sizeof *m->id);
  if (!m->v || !m->corner || !m->id)
    return 0;
  for (uint32_t i = 0; i < s->vertices; i++)
    m->v[i] = place ? placed (place, s->v[i]) : s->v[i];
  memcpy (m->corner, s->corner, s->triangles * sizeof *m->corner);
  return 1;
}

/* The tree of M, its corners in the order of the leaves, and their neighbours.  */
static bt_status
make_tree (bt__mesh *m, const bt__soup *soup, bt__workers *workers, bt__asker *asker,
           bt_error *error)
{
  bt_status status = bt__bvh_reserve (&m->tree, m->triangles, error);
  if (status)
    return status;
  m->tree.asker = asker;
  m->tree.workers = workers;
  bt__bvh_build (&m->tree, m->triangles, box_of_triangle, m);
  m->tree.asker = NULL;
  m->tree.workers = NULL;
  status = bt__stopped (asker, error);
  if (status)
    return status;
  bt__bvh_trim (&m->tree);
  return bt__mesh_sort (m, soup, workers, asker, error);
}

/* The tree of M and its neighbours, from disk or made.  */
static bt_status
find_tree (bt__mesh *m, const bt__soup *soup, bt__workers *workers, bt__asker *asker,
           bt_error *error)
{
  if (m->triangles < BT__KEEP_FROM)
    return make_tree (m, soup, workers, asker, error);
  uint64_t key = bt__keep_key (m, soup);
  if (bt__keep_load (m, soup, key))
    return BT_OK;
  bt_status status = make_tree (m, soup, workers, asker, error);
  if (!status)
    bt__keep_save (m, key);
  return status;
}

/* Return the workers that make SOUP, or NULL: the caller alone does.  */
static bt__workers *
workers_for (const bt__soup *soup)
{
  int n = soup->workers;
  if (n == 0 && soup->triangles >= SHARED)
    n = bt__processors () < MOST_WORKERS ? bt__processors () : MOST_WORKERS;
  return n > 1 ? bt__workers_new (n) : NULL;
}

bt_status
bt__mesh_new (const bt__soup *soup, const bt__place *place, bt__asker *asker, bt__mesh **out,
              bt_error *error)
{
  bt_status status = check_place (place, error);
  if (!status)
    status = check_soup (soup, error);
  if (status)
    return status;
  bt__mesh *m = calloc (1, sizeof *m);
  bt__workers *workers = workers_for (soup);
  if (!m || !copy_soup (m, soup, place))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a mesh of %u triangles",
                       (unsigned)soup->triangles);
  if (!status)
    status = find_tree (m, soup, workers, asker, error);
  bt__workers_free (workers);
  if (status)
    {
      bt__mesh_free (m);
      return status;
    }
  *out = m;
  return BT_OK;
}

/* ---- Height fields ---- */

static bt_status
check_grid (const bt__grid *g, bt_error *error)
{
  if (!(g->nx >= 2 && g->ny >= 2 && g->dx > 0 && g->dy > 0 && isfinite (g->x) && isfinite (g->y)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a height field of %u by %u posts %g by %g m apart; it needs two posts each "
                     "way and positive distances",
                     (unsigned)g->nx, (unsigned)g->ny, g->dx, g->dy);
  if ((uint64_t)g->nx * g->ny > BT__BVH_MAX / 2)
    return bt__fail (error, BT_ERR_LIMIT, "a height field of %u by %u posts is too large",
                     (unsigned)g->nx, (unsigned)g->ny);
  return BT_OK;
}

/* Add the triangles of the field at post (I, J) that have all their corners; return their number.
 */
static uint32_t
add_field (const bt__grid *g, uint32_t i, uint32_t j, uint32_t (*corner)[3], uint32_t *id)
{
  uint32_t a = i + j * g->nx, b = a + 1, c = a + g->nx, d = c + 1, n = 0;
  uint32_t both[2][3] = { { a, b, d }, { a, d, c } };
  for (uint32_t k = 0; k < 2; k++)
    {
      const uint32_t *t = both[k];
      if (isnan (g->z[t[0]]) || isnan (g->z[t[1]]) || isnan (g->z[t[2]]))
        continue;
      memcpy (corner[n], t, sizeof *corner);
      id[n++] = 2 * (i + j * (g->nx - 1)) + k;
    }
  return n;
}

bt_status
bt__mesh_from_grid (const bt__grid *g, const bt__place *place, bt__asker *asker, bt__mesh **out,
                    bt_error *error)
{
  bt_status status = check_grid (g, error);
  if (status)
    return status;
  size_t posts = (size_t)g->nx * g->ny, room = 2 * posts;
  bt_vec3 *v = malloc (posts * sizeof *v);
  uint32_t (*corner)[3] = malloc (room * sizeof *corner), *id = malloc (room * sizeof *id), n = 0;
  if (!v || !corner || !id)
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a height field of %u by %u posts",
                       (unsigned)g->nx, (unsigned)g->ny);
  else
    {
      for (size_t i = 0; i < posts; i++)
        v[i] = bt__vec (g->x + g->dx * (double)(i % g->nx), g->y + g->dy * (double)(i / g->nx),
                        isnan (g->z[i]) ? 0 : g->z[i]);
      for (uint32_t j = 0; j + 1 < g->ny; j++)
        for (uint32_t i = 0; i + 1 < g->nx; i++)
          n += add_field (g, i, j, corner + n, id + n);
      bt__soup soup = { (uint32_t)posts, n, v, (const uint32_t (*)[3])corner, id, 0 };
      status = bt__mesh_new (&soup, place, asker, out, error);
    }
  free (v);
  free (corner);
  free (id);
  return status;
}
