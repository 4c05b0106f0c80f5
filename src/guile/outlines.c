/* Obstacles as lines to draw: edges of boxes, rings of what is round, triangles of the rest.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "guile/guile.h"

enum
{
  RING = 24,           /* corners of a circle */
  TRIANGLES_MAX = 2000 /* of one obstacle; of larger ones so many are picked */
};

static bt_vec3
at (const bt_vec3 *o, double a, bt_vec3 u, double b, bt_vec3 v, double c, bt_vec3 w)
{
  return (bt_vec3){ o->x + a * u.x + b * v.x + c * w.x, o->y + a * u.y + b * v.y + c * w.y,
                    o->z + a * u.z + b * v.z + c * w.z };
}

static SCM
with_line (const bt_vec3 *p, int n, SCM list)
{
  return scm_cons (bt__from_points (p, n), list);
}

/* Two square rings and the edges between them.  */
static SCM
box_lines (const bt_obstacle_view *v, SCM list)
{
  static const double x[] = { -.5, .5, .5, -.5, -.5 }, y[] = { -.5, -.5, .5, .5, -.5 };
  bt_vec3 low[5], high[5];
  for (int k = 0; k < 5; k++)
    {
      low[k] = at (&v->centre, x[k] * v->size.x, v->axes[0], y[k] * v->size.y, v->axes[1],
                   -.5 * v->size.z, v->axes[2]);
      high[k] = at (&v->centre, x[k] * v->size.x, v->axes[0], y[k] * v->size.y, v->axes[1],
                    .5 * v->size.z, v->axes[2]);
    }
  for (int k = 0; k < 4; k++)
    list = with_line ((bt_vec3[]){ low[k], high[k] }, 2, list);
  return with_line (low, 5, with_line (high, 5, list));
}

static SCM
ring (bt_vec3 centre, double radius, bt_vec3 u, bt_vec3 v, SCM list)
{
  bt_vec3 p[RING + 1], none = { 0, 0, 0 };
  for (int k = 0; k <= RING; k++)
    {
      double angle = 2 * 3.14159265358979323846 * k / RING;
      p[k] = at (&centre, radius * cos (angle), u, radius * sin (angle), v, 0, none);
    }
  return with_line (p, RING + 1, list);
}

static SCM
sphere_lines (const bt_obstacle_view *v, SCM list)
{
  list = ring (v->centre, v->radius, v->axes[0], v->axes[1], list);
  list = ring (v->centre, v->radius, v->axes[1], v->axes[2], list);
  return ring (v->centre, v->radius, v->axes[0], v->axes[2], list);
}

/* Two unit vectors across D and each other.  */
static void
across (bt_vec3 d, bt_vec3 *u, bt_vec3 *v)
{
  double flat = hypot (d.x, d.y), length = sqrt (d.x * d.x + d.y * d.y + d.z * d.z);
  *u = flat > 0 ? (bt_vec3){ -d.y / flat, d.x / flat, 0 } : (bt_vec3){ 1, 0, 0 };
  d = (bt_vec3){ d.x / length, d.y / length, d.z / length };
  *v = (bt_vec3){ d.y * u->z - d.z * u->y, d.z * u->x - d.x * u->z, d.x * u->y - d.y * u->x };
}

static SCM
tube_lines (const bt_obstacle_view *view, SCM list)
{
  bt_vec3 u, v, none = { 0, 0, 0 };
  bt_vec3 d = { view->to.x - view->from.x, view->to.y - view->from.y, view->to.z - view->from.z };
  across (d, &u, &v);
  for (int k = 0; k < 4; k++)
    {
      double a = k == 0 ? view->radius : k == 1 ? -view->radius : 0;
      double b = k == 2 ? view->radius : k == 3 ? -view->radius : 0;
      bt_vec3 ends[2]
          = { at (&view->from, a, u, b, v, 0, none), at (&view->to, a, u, b, v, 0, none) };
      list = with_line (ends, 2, list);
    }
  return ring (view->from, view->radius, u, v, ring (view->to, view->radius, u, v, list));
}

static SCM
triangle_lines (bt_dive *dive, int i, const bt_obstacle_view *view, SCM list)
{
  size_t every = view->triangles / TRIANGLES_MAX + 1;
  for (size_t k = 0; k < view->triangles; k += every)
    {
      bt_facet facet;
      if (bt_obstacle_triangles (dive, i, k, 1, &facet) == 1)
        list = with_line (
            (bt_vec3[]){ facet.corner[0], facet.corner[1], facet.corner[2], facet.corner[0] }, 4,
            list);
    }
  return list;
}

static SCM
outline (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  int i = scm_to_int (index);
  bt_obstacle_view view;
  bt_error error;
  bt__check ("look", bt_dive_obstacle (dive, i, &view, &error), &error);
  switch (view.kind)
    {
    case BT_OBSTACLE_SEABED:
      return SCM_EOL;
    case BT_OBSTACLE_BOX:
      return box_lines (&view, SCM_EOL);
    case BT_OBSTACLE_SPHERE:
      return sphere_lines (&view, SCM_EOL);
    case BT_OBSTACLE_CYLINDER:
    case BT_OBSTACLE_CAPSULE:
      return tube_lines (&view, SCM_EOL);
    default:
      return triangle_lines (dive, i, &view, SCM_EOL);
    }
}

void
bt__define_outlines (void)
{
  static const bt__procedure table[] = {
    { "%outline", 2, 0, (scm_t_subr)outline,
      "Return polylines that outline obstacle INDEX of DIVE as it is now; none of the seabed." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
