/* A link's axis against a convex solid.  Outside: the GJK distance.  Inside: the nearest face of
   the Minkowski sum of solid and segment; the candidates, all of them measured, are the faces of
   the solid and the edges of its outline seen along the link.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/gjk.h"
#include "collide/hull.h"

static bt_vec3
link_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__link *link = shape;
  *hint = bt__dot (d, bt__sub (link->b, link->a)) > 0;
  return *hint ? link->b : link->a;
}

static double
place_on_link (const bt__link *link, bt_vec3 p)
{
  bt_vec3 d = bt__sub (link->b, link->a);
  return bt__share (bt__dot (bt__sub (p, link->a), d), bt__dot (d, d));
}

static void
try_faces (const bt__hull *h, const bt__link *link, bt__witness *best)
{
  for (int i = 0; i < h->faces; i++)
    {
      bt_vec3 n = h->face[i].normal;
      double a = bt__dot (n, link->a), b = bt__dot (n, link->b);
      double depth = h->face[i].offset - (a < b ? a : b);
      if (depth < -best->distance)
        *best = (bt__witness){ -depth, b < a, n, n, i };
    }
}

static void
try_outline (const bt__hull *h, const bt__link *link, bt__witness *best)
{
  bt_vec3 d = bt__sub (link->b, link->a);
  for (int i = 0; i < h->edges; i++)
    {
      const bt__hull_edge *edge = h->edge + i;
      bt_vec3 m = h->face[edge->face[0]].normal, n = h->face[edge->face[1]].normal;
      if (bt__dot (m, d) * bt__dot (n, d) > 0)
        continue;
      bt_vec3 from = h->v[edge->v[0]], e = bt__sub (h->v[edge->v[1]], from);
      bt_vec3 out = bt__cross (e, d), sum = bt__add (m, n);
      double size = bt__norm (out);
      if (!(size > 1e-12 * bt__norm (e) * bt__norm (d)))
        continue;
      out = bt__scale (bt__dot (out, sum) < 0 ? -1 / size : 1 / size, out);
      double depth = bt__dot (out, bt__sub (from, link->a)), s, t;
      if (!(depth < -best->distance))
        continue;
      bt__closest_segments (bt__sub (link->a, from), d, e, &s, &t);
      *best = (bt__witness){ -depth, s, out, out, h->faces + i };
    }
}

static void
leave_hull (const bt__hull *h, const bt__link *link, bt__witness *out)
{
  out->distance = -INFINITY;
  try_faces (h, link, out);
  try_outline (h, link, out);
  if (out->distance > 0)
    out->distance = -0.0;
  out->point = bt__axpy (bt__along (link, out->s), -out->distance, out->normal);
}

void
bt__pair_hull (const bt__hull *hull, const bt__link *link, bt__witness *out)
{
  bt__convex a = { link_support, link }, b = { bt__hull_support, hull };
  bt__gap gap;
  bt__gjk (&a, &b, &gap);
  if (!(gap.distance > 1e-13 * (bt__largest (link->a) + bt__largest (hull->v[0]))))
    {
      leave_hull (hull, link, out);
      return;
    }
  out->s = place_on_link (link, gap.a);
  out->point = gap.b;
  out->distance = gap.distance;
  out->normal = bt__unit_or (bt__sub (gap.a, gap.b), bt__vec (0, 0, 1));
  out->feature = gap.hint[1];
}
