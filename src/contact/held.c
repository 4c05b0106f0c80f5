/* The polyline of a model that knows no contact.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/held.h"
#include "math/vec.h"

static void
aim (const bt__polyline *line, bt__polyline_work *w, const bt__shape *shape, const bt_vec3 *nodes,
     const bt_vec3 *tensions)
{
  int64_t links = line->n - 1;
  for (int64_t i = 0; i <= links; i++)
    {
      w->arc[i] = shape->length * (double)i / (double)links;
      w->want[i] = bt__shape_point (shape, nodes, tensions, w->arc[i]);
    }
  w->want[0] = shape->a;
  w->want[links] = shape->b;
}

void
bt__held_step (bt__polyline *line, const bt__way *way, const bt__shape *shape, const bt_vec3 *nodes,
               const bt_vec3 *tensions, bt__held_report *report)
{
  bt__hit hit;
  bt__polyline_let_pass (line, way);
  aim (line, way->work, shape, nodes, tensions);
  report->share = bt__polyline_move (line, way, &hit);
  report->held = report->share < 1;
  report->object = report->held ? bt__hit_object (way, &hit) : -1;
  int on_mesh = report->object >= 0 && hit.near.triangle != BT__NO_TRIANGLE;
  report->triangle = on_mesh ? (int64_t)hit.near.triangle : -1;
  report->a = bt__polyline_x (line)[0];
  report->b = bt__polyline_x (line)[line->n - 1];
}

/* ---- What it touches ---- */

static bt__touch
touch_of (const bt__polyline *line, const bt__scene *scene, const bt__near *near)
{
  const double *u = bt__polyline_u ((bt__polyline *)line) + near->link;
  int mesh = near->triangle != BT__NO_TRIANGLE;
  return (bt__touch){ .object = scene->object[near->object].id,
                      .triangle = mesh ? (int64_t)near->triangle : -1,
                      .state = BT__TOUCH_STICK,
                      .s = u[0] + near->w.s * (u[1] - u[0]),
                      .point = near->w.point,
                      .normal = near->w.normal };
}

int
bt__held_touches (const bt__polyline *line, const bt__way *way, double diameter, bt__touch *touch,
                  int room)
{
  const bt__scene *scene = way->around->scene;
  bt__nears list = { way->work->near, 0, BT__PARTS_MAX, INFINITY };
  if (scene->n == 0)
    return 0;
  bt__scene_near_line (scene, way->around->on, bt__polyline_x ((bt__polyline *)line),
                       (uint32_t)line->n, diameter / 2, &list, way->count);
  bt__nears_by_object (&list);
  for (uint32_t i = 0; i < list.n && (int)i < room; i++)
    touch[i] = touch_of (line, scene, list.at + i);
  return (int)list.n;
}
