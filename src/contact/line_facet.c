/* The contact constraints of a mesh's triangle: face, nearest place, and ghost edges.

   Nodes over the face are borne by the face.  A link is borne at its nearest place, unless the
   surrounding surface hides the edge there, because a neighbouring triangle is nearer (a ghost
   edge).  A link over a crest is borne at the crest as well, even if another place is nearer: a
   link lying on two edges of a triangle would see-saw on a single edge.  An edge between two
   triangles in a plane is no crest.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_row.h"

#define GHOST 1e-6 /* sine of the angle at which a neighbour counts as nearer */
#define CREST 1e-3 /* sine of the angle at which the surface falls away beyond an edge, ... */
#define LEVEL 0.05 /* ... and up to which it may rise before it */

/* ---- Edges that a mesh hides ---- */

/* True if triangle T rises to the side of normal N from its corner I.  */
static int
rises_from_corner (const bt__triangle *t, uint32_t i, bt_vec3 n)
{
  for (uint32_t k = 1; k < 3; k++)
    {
      bt_vec3 e = bt__sub (t->v[(i + k) % 3], t->v[i]);
      if (bt__dot (n, e) > GHOST * bt__norm (e))
        return 1;
    }
  return 0;
}

/* The height to which triangle T rises to the side of normal N from its edge I, per metre across
   the edge: the sine of an angle.  */
static double
rise_from_edge (const bt__triangle *t, uint32_t i, bt_vec3 n)
{
  bt_vec3 a = t->v[i], e = bt__sub (t->v[(i + 1) % 3], a), c = bt__sub (t->v[(i + 2) % 3], a);
  bt_vec3 in = bt__axpy (c, -bt__dot (c, e) / bt__dot (e, e), e);
  return bt__dot (n, in) / bt__norm (in);
}

static const bt__mesh *
mesh_near (const bt__line_job *k, const bt__near *near)
{
  return bt__line_scene (k, near)->object[near->object].shape.mesh;
}

/* True if the nearest point W of the triangle NEAR is on an edge or corner where another triangle
   is nearer.  */
static int
is_ghost (const bt__line_job *k, const bt__near *near, const bt__witness *w)
{
  if (w->feature == 0)
    return 0;
  const bt__mesh *mesh = mesh_near (k, near);
  int at_corner = w->feature > 3;
  const uint32_t *next = at_corner ? mesh->next_corner : mesh->next_edge;
  uint32_t own = 3 * near->slot + (uint32_t)(w->feature - (at_corner ? 4 : 1));
  for (uint32_t at = next[own]; at != own; at = next[at])
    {
      bt__triangle t = bt__mesh_triangle (mesh, at / 3);
      if (at / 3 != near->slot
          && (at_corner ? rises_from_corner (&t, at % 3, w->normal)
                        : rise_from_edge (&t, at % 3, w->normal) > GHOST))
        return 1;
    }
  return 0;
}

/* True if the surface of MESH falls away from edge EDGE on either side, as seen from normal N.  */
static int
is_crest (const bt__mesh *mesh, uint32_t edge, bt_vec3 n)
{
  double most = -INFINITY, least = INFINITY;
  uint32_t at = edge;
  do
    {
      bt__triangle t = bt__mesh_triangle (mesh, at / 3);
      double rise = rise_from_edge (&t, at % 3, n);
      most = fmax (most, rise);
      least = fmin (least, rise);
      at = mesh->next_edge[at];
    }
  while (at != edge && most <= LEVEL);
  return most <= LEVEL && (mesh->next_edge[edge] == edge || least < -CREST);
}

/* ---- Rows ---- */

/* The unit normal of T; zero without area.  */
static bt_vec3
face_normal (const bt__triangle *t)
{
  return bt__unit_or (bt__cross (bt__sub (t->v[1], t->v[0]), bt__sub (t->v[2], t->v[0])),
                      bt__vec (0, 0, 0));
}

/* True if node AT is over the face of T, whose unit normal is N, HEIGHT from it, on the side of
   NORMAL.  */
static int
is_over (const bt__triangle *t, bt_vec3 n, bt_vec3 at, double *height, bt_vec3 *normal)
{
  double h = bt__dot (n, bt__sub (at, t->v[0]));
  for (int i = 0; i < 3; i++)
    {
      bt_vec3 e = bt__sub (t->v[(i + 1) % 3], t->v[i]);
      if (!(bt__dot (bt__cross (n, e), bt__sub (at, t->v[i])) >= 0))
        return 0;
    }
  *height = fabs (h);
  *normal = h < 0 ? bt__scale (-1, n) : n;
  return bt__dot (n, n) > 0;
}

/* Where LINK passes over the edge of T from corner E, to *W; zero if it does not.  */
static int
pass_edge (const bt__triangle *t, int e, const bt__link *link, bt__witness *w)
{
  bt_vec3 along = bt__sub (link->b, link->a), edge = bt__sub (t->v[(e + 1) % 3], t->v[e]);
  double u;
  bt__closest_segments (bt__sub (link->a, t->v[e]), along, edge, &w->s, &u);
  if (!(w->s > 0 && w->s < 1 && u > 0 && u < 1))
    return 0;
  w->point = bt__axpy (t->v[e], u, edge);
  bt_vec3 away = bt__sub (bt__along (link, w->s), w->point);
  w->distance = bt__norm (away);
  w->normal = bt__unit_or (away, bt__vec (0, 0, 0));
  w->feature = e + 1;
  return 1;
}

/* A link rests on at most two edges of a triangle; the nearest edge has a constraint already: on
   that alone it would see-saw.  */
static void
touch_crests (bt__line_job *k, uint32_t j, const bt__pass *p, const bt__triangle *t, int has)
{
  const bt__mesh *mesh = mesh_near (k, p->near);
  unsigned folds = mesh->folds[p->near->slot];
  double touch = k->config->radius + k->margin;
  for (int e = 0; e < 3 && folds; e++)
    {
      uint32_t edge = 3 * p->near->slot + (uint32_t)e;
      bt__witness now, w;
      if (has == e + 1 || !(folds >> e & 1) || !bt__line_takes_row (k)
          || !pass_edge (t, e, &p->from, &now) || now.distance >= touch
          || !is_crest (mesh, edge, now.normal))
        continue;
      int other = !pass_edge (t, e, &p->to, &w) || !(w.distance > k->core)
                  || !(bt__dot (w.normal, now.normal) > BT__ROW_TURNED);
      bt__row_set (k, k->rows, j, other ? now.s : w.s, p->near, other ? &now : &w, now.distance);
      bt__row_take (k, 2 * bt__row_lies_along (k, &p->from, &now));
    }
}

/* A triangle: nodes over its face, else the nearest place of the link, and edges it passes.  */
void
bt__row_facet (bt__line_job *k, uint32_t j, const bt__near *near)
{
  bt__triangle t = bt__mesh_triangle (mesh_near (k, near), near->slot);
  bt__pass p = bt__row_pass (k, j, near);
  bt_vec3 n = face_normal (&t);
  double nearest = near->w.distance + BT__ROW_NEAREST * k->config->radius;
  int over = 0, is_nearest = 0;
  for (int e = 0; e < 2; e++)
    {
      bt_vec3 at = e ? p.from.b : p.from.a;
      bt__witness w = { 0 };
      if (!is_over (&t, n, at, &w.distance, &w.normal))
        continue;
      over++;
      is_nearest |= w.distance <= nearest;
      w.point = bt__axpy (at, -w.distance, w.normal);
      if (w.distance >= k->config->radius + k->margin || !bt__line_takes_row (k))
        continue;
      bt__row_set (k, k->rows, j, e, near, &w, w.distance);
      bt__row_take (k, 1);
    }
  if (over == 2)
    return;
  if (!is_nearest && !is_ghost (k, near, &near->w))
    bt__row_between (k, j, &p, 0);
  touch_crests (k, j, &p, &t, is_nearest ? 0 : near->w.feature);
}
