/* Preparing a picture: the triangles of a view, and the reach of camera and light.

   Things become triangles in an order that drawing relies on: solids, which cast shadows; then
   signs such as arrows, marks and lines, which cast none; ground last, since solids hide most of it
   by then.

   The box about the vertices of solids and signs, cut at a multiple of the distance looked at,
   frames the shadow map.  Near and far depth of the camera come from all vertices, so depth buffers
   use their digits where the scene is.  A visibility of 0 in the view is replaced by a multiple of
   the distance looked at.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "render/job.h"

/* Bodies that cast shadows; signs to be read, without shadows; ground, mostly hidden by bodies.  */
enum
{
  SOLID,
  SIGN,
  GROUND
};

static int
sort_of (const bt_thing *t)
{
  if (t->kind == BT_THING_LEVEL || t->kind == BT_THING_FIELD || t->ground)
    return GROUND;
  return t->kind == BT_THING_ARROW || t->kind == BT_THING_MARK || t->kind == BT_THING_LINES ? SIGN
                                                                                            : SOLID;
}

double
bt__visibility (const bt__job *j)
{
  const bt_camera *c = &j->view->camera;
  double away = bt__distance (c->from, c->at);
  if (j->view->visibility > 0)
    return j->view->visibility;
  return j->optics.perspective ? fmax (26, 3.8 * away) : fmax (40, 3.5 * c->height);
}

/* The extent of level ground, m: beyond the visibility of the water.  */
static double
reach_of (const bt__job *j)
{
  double away = bt__distance (j->view->camera.from, j->view->camera.at);
  return 1.6 * bt__visibility (j) + away + (j->optics.perspective ? 0 : 4 * j->optics.half_width);
}

static void
gather_things (bt__job *j, int sort)
{
  const bt_view *view = j->view;
  for (size_t i = 0; i < view->n; i++)
    {
      const bt_thing *t = &view->things[i];
      if (t->kind == BT_THING_LEVEL)
        j->level = t->at.z;
      if (sort_of (t) == sort)
        bt__add_thing (&j->soup, view, t, reach_of (j));
    }
}

/* Measure the ball about all vertices but those of the ground, cut off far from the camera: the
   frame of the light.  */
static void
measure (bt__job *j)
{
  const bt__soup *s = &j->soup;
  double away = bt__distance (j->view->camera.from, j->view->camera.at);
  double most = fmax (20, 6 * away) + (j->optics.perspective ? 0 : j->view->camera.height);
  double low[3] = { 0, 0, 0 }, high[3] = { 0, 0, 0 };
  for (size_t i = 0; i < s->n; i++)
    for (int k = 0; k < 3 && s->vertex[i].stuff.shading != BT__GROUND; k++)
      {
        double x = fmin (fmax ((double)s->vertex[i].at[k], -most), most);
        low[k] = fmin (low[k], x);
        high[k] = fmax (high[k], x);
      }
  bt_vec3 a = bt__vec (low[0], low[1], low[2]), b = bt__vec (high[0], high[1], high[2]);
  j->middle = bt__add (s->origin, bt__scale (0.5, bt__add (a, b)));
  j->radius = fmax (1, bt__distance (a, b) / 2 * 1.05);
}

static void
set_depths (bt__job *j)
{
  double nearest = INFINITY, farthest = -INFINITY;
  bt_vec3 offset = bt__sub (j->soup.origin, j->optics.eye);
  for (size_t i = 0; i < j->soup.n; i++)
    {
      const float *p = j->soup.vertex[i].at;
      bt_vec3 q = bt__add (bt__vec ((double)p[0], (double)p[1], (double)p[2]), offset);
      double z = bt__dot (q, j->optics.ahead);
      farthest = fmax (farthest, z);
      if (z > 0 || !j->optics.perspective)
        nearest = fmin (nearest, z);
    }
  if (!(farthest > nearest))
    nearest = 1, farthest = 2;
  j->optics.near = j->optics.perspective ? fmin (fmax (0.4 * nearest, 0.04), 2) : nearest - 1;
  j->optics.far = farthest + 1 + 1e-3 * fabs (farthest);
  if (j->optics.perspective)
    j->optics.far = fmax (j->optics.far, 2 * j->optics.near);
}

double
bt__grid_step (const bt__job *j)
{
  double across = 2 * j->optics.half_width, step, power;
  if (j->optics.perspective)
    across *= bt__distance (j->view->camera.from, j->view->camera.at);
  step = across / 9;
  power = pow (10, floor (log10 (step)));
  step /= power;
  return power * (step < 1.5 ? 1 : step < 3.5 ? 2 : step < 7.5 ? 5 : 10);
}

void
bt__prepare (bt__job *j)
{
  j->level = -1e30;
  gather_things (j, SOLID);
  j->n_cast = j->soup.n_index;
  gather_things (j, SIGN);
  j->n_solid = j->soup.n_index;
  if (!j->drawing.transparent)
    gather_things (j, GROUND); /* last: most of it is hidden by then */
  measure (j);
  set_depths (j);
}
