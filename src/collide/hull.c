/* Convex hulls by Qhull (Barber, Dobkin, Huhdanpaa 1996), its faces cut into triangles.

   Qhull works in coordinates about the middle of the points and of size 1, where its tolerances
   mean the same at every scale; the hull keeps the given points.  Faces that Qhull merges may leave
   a vertex a rounding outside a plane: the offset of a face is raised to hold them all.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdio.h>
#include <stdlib.h>

#include <libqhull_r/qhull_ra.h>

#include "base/error.h"
#include "collide/hull.h"

void
bt__hull_free (bt__hull *h)
{
  if (!h)
    return;
  free (h->v);
  free (h->face);
  free (h->edge);
  free (h->corner);
  free (h->first);
  free (h->other);
  free (h);
}

/* ---- Support ---- */

static bt_vec3
support_all (const bt__hull *h, bt_vec3 d, int *hint)
{
  double most = -INFINITY;
  for (int i = 0; i < h->vertices; i++)
    {
      double at = bt__dot (h->v[i], d);
      if (at > most)
        {
          most = at;
          *hint = i;
        }
    }
  return h->v[*hint];
}

/* Walk to a better neighbour while there is one: a convex solid has no other summit.  */
bt_vec3
bt__hull_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__hull *h = shape;
  if (h->vertices <= BT__HULL_CLIMB)
    return support_all (h, d, hint);
  int at = *hint, before = -1;
  double most = bt__dot (h->v[at], d);
  while (at != before)
    {
      before = at;
      for (int i = h->first[before]; i < h->first[before + 1]; i++)
        {
          double there = bt__dot (h->v[h->other[i]], d);
          if (there > most)
            {
              most = there;
              at = h->other[i];
            }
        }
    }
  *hint = at;
  return h->v[at];
}

/* ---- Qhull ---- */

typedef struct middle
{
  bt_vec3 at;
  double size;
} middle;

static middle
middle_of_points (const bt_vec3 *p, int n)
{
  bt_vec3 lo = p[0], hi = p[0];
  for (int i = 1; i < n; i++)
    {
      lo = bt__vec (fmin (lo.x, p[i].x), fmin (lo.y, p[i].y), fmin (lo.z, p[i].z));
      hi = bt__vec (fmax (hi.x, p[i].x), fmax (hi.y, p[i].y), fmax (hi.z, p[i].z));
    }
  bt_vec3 half = bt__scale (0.5, bt__sub (hi, lo));
  return (middle){ bt__scale (0.5, bt__add (lo, hi)), bt__largest (half) };
}

/* The faces of QH as corners, numbers of points, seen from outside counter-clockwise.  */
static int
take_faces (qhT *qh, int (*corner)[3])
{
  facetT *facet;
  vertexT *vertex, **vertexp;
  int n = 0;
  FORALLfacets
  {
    int k = 0, *c = corner[n++];
    FOREACHvertex_ (facet->vertices) if (k < 3) c[k++] = qh_pointid (qh, vertex->point);
    if (facet->toporient == qh_ORIENTclock)
      {
        int swap = c[0];
        c[0] = c[1];
        c[1] = swap;
      }
  }
  return n;
}

/* Run Qhull over the N COORDINATES; return its faces in *CORNER (the caller's to free), their
   number: 0 if there is no hull, -1 if there is no memory.

   What Qhull has to say goes to a stream in memory, which keeps the beginning and drops the rest:
   without a stream Qhull would speak to stderr, and a process that may write no file has no
   /dev/null.  */
static int
run_qhull (double *coordinates, int n, int (**corner)[3])
{
  char options[] = "qhull Qt Pp", said[256];
  qhT qh;
  int faces = 0, left, total;
  FILE *nowhere = fmemopen (said, sizeof said, "w");
  if (!nowhere)
    return -1;
  qh_zero (&qh, nowhere);
  if (!qh_new_qhull (&qh, 3, n, coordinates, 0, options, NULL, nowhere))
    {
      *corner = malloc ((size_t)qh.num_facets * sizeof **corner);
      faces = *corner ? take_faces (&qh, *corner) : -1;
    }
  qh_freeqhull (&qh, !qh_ALL);
  qh_memfreeshort (&qh, &left, &total);
  fclose (nowhere);
  return faces;
}

/* ---- Tables ---- */

/* Number the points that are corners; the corners get the new numbers.  */
static int
take_vertices (bt__hull *h, const bt_vec3 *points, int n)
{
  int *number = malloc ((size_t)n * sizeof *number);
  h->v = malloc ((size_t)(3 * h->faces) * sizeof *h->v);
  if (!number || !h->v)
    {
      free (number);
      return 0;
    }
  for (int i = 0; i < n; i++)
    number[i] = -1;
  for (int i = 0; i < 3 * h->faces; i++)
    {
      int *c = &h->corner[i / 3][i % 3];
      if (number[*c] < 0)
        {
          number[*c] = h->vertices;
          h->v[h->vertices++] = points[*c];
        }
      *c = number[*c];
    }
  free (number);
  return 1;
}

static void
set_face_plane (const bt__hull *h, int i, bt_vec3 inner)
{
  const int *c = h->corner[i];
  bt_vec3 a = h->v[c[0]], e = bt__sub (h->v[c[1]], a), f = bt__sub (h->v[c[2]], a);
  bt_vec3 n = bt__unit_or (bt__cross (e, f), bt__unit_or (bt__sub (a, inner), bt__vec (0, 0, 1)));
  if (bt__dot (n, bt__sub (a, inner)) < 0)
    n = bt__scale (-1, n);
  int hint = c[0];
  double offset = fmax (bt__dot (n, bt__hull_support (h, n, &hint)), bt__dot (n, a));
  h->face[i] = (bt__hull_face){ n, offset };
}

static int
by_vertices (const void *a, const void *b)
{
  const bt__hull_edge *e = a, *f = b;
  int first = (e->v[0] > f->v[0]) - (e->v[0] < f->v[0]);
  int second = (e->v[1] > f->v[1]) - (e->v[1] < f->v[1]);
  return first ? first : second ? second : (e->face[0] > f->face[0]) - (e->face[0] < f->face[0]);
}

/* Join the two sides of every edge: list the sides of all faces and sort the list, so that the two
   sides of an edge are neighbours.  */
static int
take_edges (bt__hull *h)
{
  int n = 3 * h->faces, edges = 0;
  h->edge = malloc ((size_t)n * sizeof *h->edge);
  if (!h->edge)
    return 0;
  for (int i = 0; i < n; i++)
    {
      int a = h->corner[i / 3][i % 3], b = h->corner[i / 3][(i + 1) % 3], f = i / 3;
      h->edge[i] = (bt__hull_edge){ { a < b ? a : b, a < b ? b : a }, { f, f } };
    }
  qsort (h->edge, (size_t)n, sizeof *h->edge, by_vertices);
  for (int i = 0; i < n; i++)
    {
      bt__hull_edge e = h->edge[i];
      if (i + 1 < n && h->edge[i + 1].v[0] == e.v[0] && h->edge[i + 1].v[1] == e.v[1])
        e.face[1] = h->edge[++i].face[0];
      h->edge[edges++] = e;
    }
  h->edges = edges;
  return 1;
}

static int
take_neighbours (bt__hull *h)
{
  h->first = calloc ((size_t)h->vertices + 2, sizeof *h->first);
  h->other = malloc ((size_t)(2 * h->edges) * sizeof *h->other);
  if (!h->first || !h->other)
    return 0;
  for (int i = 0; i < h->edges; i++)
    for (int k = 0; k < 2; k++)
      h->first[h->edge[i].v[k] + 2]++;
  for (int i = 2; i < h->vertices + 2; i++)
    h->first[i] += h->first[i - 1];
  for (int i = 0; i < h->edges; i++)
    for (int k = 0; k < 2; k++)
      h->other[h->first[h->edge[i].v[k] + 1]++] = h->edge[i].v[1 - k];
  return 1;
}

static int
take_tables (bt__hull *h, const bt_vec3 *points, int n)
{
  h->face = malloc ((size_t)h->faces * sizeof *h->face);
  if (!h->face || !take_vertices (h, points, n) || !take_edges (h) || !take_neighbours (h))
    return 0;
  bt_vec3 inner = { 0, 0, 0 };
  for (int i = 0; i < h->vertices; i++)
    inner = bt__axpy (inner, 1.0 / h->vertices, h->v[i]);
  for (int i = 0; i < h->faces; i++)
    set_face_plane (h, i, inner);
  return 1;
}

static bt_status
check_points (const bt_vec3 *points, int n, bt_error *error)
{
  if (n < 4 || n > BT__HULL_POINTS_MAX)
    return bt__fail (error, n < 4 ? BT_ERR_DOMAIN : BT_ERR_LIMIT,
                     "a convex shape has %d points; it needs 4 to %d", n, BT__HULL_POINTS_MAX);
  for (int i = 0; i < n; i++)
    if (!bt__is_finite (points[i]))
      return bt__fail (error, BT_ERR_DOMAIN, "point %d of a convex shape is not finite", i);
  return BT_OK;
}

bt_status
bt__hull_new (const bt_vec3 *points, int n, bt__hull **out, bt_error *error)
{
  bt_status status = check_points (points, n, error);
  if (status)
    return status;
  middle m = middle_of_points (points, n);
  bt__hull *h = calloc (1, sizeof *h);
  double *x = malloc ((size_t)n * 3 * sizeof *x);
  if (!h || !x)
    {
      free (h);
      free (x);
      return bt__fail (error, BT_ERR_LIMIT, "no memory for a convex shape of %d points", n);
    }
  for (int i = 0; i < n; i++)
    {
      bt_vec3 p = bt__scale (m.size > 0 ? 1 / m.size : 1, bt__sub (points[i], m.at));
      x[3 * i] = p.x;
      x[3 * i + 1] = p.y;
      x[3 * i + 2] = p.z;
    }
  h->faces = run_qhull (x, n, &h->corner);
  free (x);
  if (h->faces >= 0 && h->faces < 4)
    status = bt__fail (error, BT_ERR_DOMAIN,
                       "the %d points of a convex shape have no volume: they are in one plane", n);
  else if (h->faces < 0 || !take_tables (h, points, n))
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a convex shape of %d points", n);
  if (status)
    bt__hull_free (h);
  else
    *out = h;
  return status;
}
