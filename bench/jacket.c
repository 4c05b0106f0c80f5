/* See jacket.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "collide/pair.h"
#include "rivals.h"

#define COARSEST 200.0 /* m: of facets as long as every tube, hexagonal ones */

int
jacket_new (jacket *j, uint32_t most)
{
  *j = (jacket){ .room = most + most / 2 };
  j->v = malloc ((size_t)j->room * sizeof *j->v);
  j->corner = malloc ((size_t)j->room * sizeof *j->corner);
  if (j->v && j->corner)
    return 1;
  jacket_free (j);
  return 0;
}

int
rival_measure (const bt_vec3 v[3], bt_vec3 a, bt_vec3 b, double reach)
{
#define APART(k)                                                                                   \
  (fmin (a.k, b.k) - reach > fmax (fmax (v[0].k, v[1].k), v[2].k)                                  \
   || fmax (a.k, b.k) + reach < fmin (fmin (v[0].k, v[1].k), v[2].k))
  if (APART (x) || APART (y) || APART (z))
    return 0;
#undef APART
  bt__triangle t = { { v[0], v[1], v[2] } };
  bt__link link = { a, b };
  bt__witness w;
  bt__pair_triangle (&t, &link, &w);
  return w.distance <= reach;
}

void
jacket_free (jacket *j)
{
  free (j->v);
  free (j->corner);
  *j = (jacket){ 0 };
}

/* A tube from A to B in facets of about SIZE.  */
static void
add_tube (jacket *s, bt_vec3 a, bt_vec3 b, double r, double size)
{
  bt_vec3 axis = bt__sub (b, a), e = bt__across (axis);
  bt_vec3 f = bt__unit_or (bt__cross (axis, e), e);
  uint32_t around = (uint32_t)fmax (6, ceil (2 * BT__PI * r / size));
  uint32_t along = (uint32_t)fmax (1, ceil (bt__norm (axis) / size)), base = s->vertices;
  s->wanted += 2.0 * around * along;
  if (s->wanted > s->room)
    return;
  for (uint32_t j = 0; j <= along; j++)
    for (uint32_t i = 0; i < around; i++)
      {
        double w = 2 * BT__PI * i / around;
        bt_vec3 p = bt__axpy (a, (double)j / along, axis);
        s->v[s->vertices++] = bt__axpy (bt__axpy (p, r * cos (w), e), r * sin (w), f);
      }
  for (uint32_t j = 0; j < along; j++)
    for (uint32_t i = 0; i < around; i++)
      {
        uint32_t p = base + j * around + i, q = base + j * around + (i + 1) % around;
        uint32_t *t = s->corner[s->triangles++], *u = s->corner[s->triangles++];
        t[0] = p;
        t[1] = u[0] = q;
        t[2] = u[2] = p + around;
        u[1] = q + around;
      }
}

static void
add_jacket (jacket *s, double size)
{
  static const double side[4][2] = { { -30, -30 }, { 30, -30 }, { 30, 30 }, { -30, 30 } };
  s->vertices = s->triangles = 0;
  s->wanted = 0;
  for (int k = 0; k < 4; k++)
    {
      const double *p = side[k], *q = side[(k + 1) % 4];
      add_tube (s, bt__vec (p[0], p[1], -100), bt__vec (p[0], p[1], 0), 0.6, size);
      for (int level = 0; level < 5; level++)
        {
          double z = -100 + 20 * level, top = z + 20;
          add_tube (s, bt__vec (p[0], p[1], z), bt__vec (q[0], q[1], z), 0.3, size);
          add_tube (s, bt__vec (p[0], p[1], z), bt__vec (q[0], q[1], top), 0.2, size);
          add_tube (s, bt__vec (p[0], p[1], top), bt__vec (q[0], q[1], z), 0.2, size);
        }
    }
}

void
jacket_make (jacket *s, uint32_t wanted)
{
  double lo = 0.01, hi = COARSEST;
  for (int i = 0; i < 40; i++)
    {
      double size = sqrt (lo * hi);
      add_jacket (s, size);
      if (s->wanted >= wanted)
        lo = size;
      else
        hi = size;
    }
  add_jacket (s, hi);
}

/* Spans that sag between a start, a brace of the face y = -30, one of the face x = 30 and an end.
 */
void
jacket_drape (bt_vec3 x[JACKET_LINKS + 1], double shift)
{
  const bt_vec3 over[4] = {
    { -70.672, -76, -14 }, { -11 + shift, -30, -39.69 }, { 30, 9 + shift, -59.69 }, { 68, 40, -71 }
  };
  for (int i = 0; i <= JACKET_LINKS; i++)
    {
      double u = 3.0 * i / JACKET_LINKS;
      int k = u < 2 ? (int)u : 2;
      double w = u - k;
      x[i] = bt__axpy (over[k], w, bt__sub (over[k + 1], over[k]));
      x[i].z -= 24 * w * (1 - w);
    }
}

void
jacket_lie (bt_vec3 x[JACKET_LINKS + 1], double shift)
{
  for (int i = 0; i <= JACKET_LINKS; i++)
    {
      double u = (double)i / JACKET_LINKS;
      x[i] = bt__vec (-70 + 140 * u + shift, -30.25, -20 - 60 * u * u - 6 * sin (7 * u) + shift);
    }
}

void
jacket_wrap (bt_vec3 x[JACKET_LINKS + 1], double shift)
{
  for (int i = 0; i <= JACKET_LINKS; i++)
    {
      double u = (double)i / JACKET_LINKS, w = 12 * BT__PI * u;
      x[i] = bt__vec (-30 + 0.632 * cos (w), -30 + 0.632 * sin (w), -53 + 6 * u + shift);
    }
}
