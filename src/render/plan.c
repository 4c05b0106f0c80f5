/* A plan: the scene from above as a drawing on paper, obstacles as outlines, the vehicle as an
   arrow head.  The layout follows the plan view of the trainer in D. Manowitz's thesis.  An outline
   is the convex hull of the projected points of a body: eight corners of a box, rims of a cylinder.
   No graphics library is needed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "render/text.h"

typedef struct sheet
{
  bt__pen pen;
  const bt_view *view;
  bt__optics optics;
  double ppm; /* pixels a metre */
} sheet;

static void
to_paper (const sheet *s, bt_vec3 p, double *x, double *y)
{
  bt__project (&s->optics, p, s->pen.width, s->pen.height, x, y);
}

static void
line_to (sheet *s, bt_vec3 p)
{
  double x, y;
  to_paper (s, p, &x, &y);
  cairo_line_to (s->pen.cr, x, y);
}

/* ---- Outlines: hulls of what a body's points cover ---- */

enum
{
  RIM = 36,
  MOST = 2 * RIM
};

typedef struct spot
{
  double x, y;
} spot;

static int
by_place (const void *a, const void *b)
{
  const spot *p = a, *q = b;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  return p->y < q->y ? -1 : p->y > q->y;
}

static double
turn (spot a, spot b, spot c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* The path of the convex hull of N spots, by A. M. Andrew's chains (1979).  */
static void
hull_path (cairo_t *cr, spot *p, int n)
{
  spot hull[2 * MOST + 1];
  int k = 0;
  qsort (p, (size_t)n, sizeof *p, by_place);
  for (int i = 0; i < n; i++)
    {
      while (k >= 2 && turn (hull[k - 2], hull[k - 1], p[i]) <= 0)
        k--;
      hull[k++] = p[i];
    }
  for (int i = n - 2, low = k + 1; i >= 0; i--)
    {
      while (k >= low && turn (hull[k - 2], hull[k - 1], p[i]) <= 0)
        k--;
      hull[k++] = p[i];
    }
  for (int i = 0; i < k; i++)
    cairo_line_to (cr, hull[i].x, hull[i].y);
  cairo_close_path (cr);
}

static int
add_spot (const sheet *s, spot *p, int n, bt_vec3 at)
{
  to_paper (s, at, &p[n].x, &p[n].y);
  return n + 1;
}

/* A rim about AXIS; level for a ball.  */
static int
add_rim (const sheet *s, spot *p, int n, bt_vec3 at, bt_vec3 axis, double r)
{
  bt_vec3 helper = fabs (axis.z) < 0.9 ? bt__vec (0, 0, 1) : bt__vec (1, 0, 0);
  bt_vec3 u = bt__unit_or (bt__cross (helper, axis), bt__vec (1, 0, 0)), v = bt__cross (axis, u);
  for (int i = 0; i < RIM; i++)
    {
      double t = 2 * BT__PI * i / RIM;
      n = add_spot (s, p, n, bt__axpy (bt__axpy (at, r * cos (t), u), r * sin (t), v));
    }
  return n;
}

static int
box_spots (const sheet *s, spot *p, const bt_thing *t)
{
  bt__pose pose = bt__pose_of (t->at, t->heading, t->pitch, t->roll);
  int n = 0;
  for (int i = 0; i < 8; i++)
    n = add_spot (s, p, n,
                  bt__pose_point (&pose, (i & 1 ? 0.5 : -0.5) * t->size.x,
                                  (i & 2 ? 0.5 : -0.5) * t->size.y,
                                  (i & 4 ? 0.5 : -0.5) * t->size.z));
  return n;
}

static int
body_spots (const sheet *s, spot *p, const bt_thing *t)
{
  bt_vec3 up = bt__vec (0, 0, 1);
  bt_vec3 axis = bt__unit_or (bt__sub (t->to, t->from), up);
  switch (t->kind)
    {
    case BT_THING_BOX:
      return box_spots (s, p, t);
    case BT_THING_SPHERE:
      return add_rim (s, p, 0, t->at, up, t->radius);
    case BT_THING_CYLINDER:
      return add_rim (s, p, add_rim (s, p, 0, t->from, axis, t->radius), t->to, axis, t->radius);
    case BT_THING_CAPSULE:
      return add_rim (s, p, add_rim (s, p, 0, t->from, up, t->radius), t->to, up, t->radius);
    default:
      return 0;
    }
}

static void
draw_body (sheet *s, const bt_thing *t)
{
  spot p[MOST];
  int n = body_spots (s, p, t);
  if (!n)
    return;
  hull_path (s->pen.cr, p, n);
  cairo_set_source_rgb (s->pen.cr, 0.80, 0.80, 0.77);
  cairo_fill_preserve (s->pen.cr);
  cairo_set_source_rgb (s->pen.cr, 0.25, 0.25, 0.25);
  cairo_set_line_width (s->pen.cr, fmax (1, 0.07 * s->pen.letter));
  cairo_stroke (s->pen.cr);
}

static void
outline_mesh (sheet *s, const bt_thing *t)
{
  bt__pose pose = bt__pose_of (t->at, t->heading, t->pitch, t->roll);
  cairo_set_source_rgb (s->pen.cr, 0.72, 0.72, 0.69);
  cairo_set_line_width (s->pen.cr, 0.5);
  for (size_t i = 0; i < t->triangles; i++)
    {
      for (int k = 0; k < 3; k++)
        {
          bt_vec3 q = bt__scale (t->scale, t->points[t->corner[i][k]]);
          line_to (s, bt__pose_point (&pose, q.x, q.y, q.z));
        }
      cairo_close_path (s->pen.cr);
      cairo_fill_preserve (s->pen.cr);
      cairo_stroke (s->pen.cr);
    }
}

/* ---- What moves ---- */

static void
draw_tube (sheet *s, const bt_thing *t)
{
  cairo_t *cr = s->pen.cr;
  double width = fmax (2 * t->radius * s->ppm, fmax (1.5, 0.14 * s->pen.letter));
  int painted = t->values && s->view->scale.name;
  for (size_t i = 0; i < t->n; i++)
    line_to (s, t->points[i]);
  cairo_set_source_rgb (cr, 0.12, 0.12, 0.14);
  cairo_set_line_width (cr, painted ? width + 1.6 : width);
  cairo_stroke (cr);
  cairo_set_line_width (cr, width);
  for (size_t i = 1; painted && i < t->n; i++)
    {
      line_to (s, t->points[i - 1]);
      line_to (s, t->points[i]);
      bt__pen_color (&s->pen, bt__scale_color (&s->view->scale, t->values[i]));
      cairo_stroke (cr);
    }
}

/* An arrow head LENGTH pixels long about the point T is at, toward its heading.  */
static void
draw_vehicle (sheet *s, const bt_thing *t)
{
  static const double ahead[] = { 0.6, -0.5, -0.25, -0.5 }, aside[] = { 0, 0.4, 0, -0.4 };
  double length = fmax (t->size.y * s->ppm, 1.7 * s->pen.letter), x, y;
  double c = cos (t->heading), d = sin (t->heading);
  to_paper (s, t->at, &x, &y);
  for (int i = 0; i < 4; i++)
    cairo_line_to (s->pen.cr, x + length * (ahead[i] * d + aside[i] * c),
                   y - length * (ahead[i] * c - aside[i] * d));
  cairo_close_path (s->pen.cr);
  bt__pen_color (&s->pen, t->color);
  cairo_fill_preserve (s->pen.cr);
  cairo_set_source_rgb (s->pen.cr, 0.1, 0.1, 0.1);
  cairo_set_line_width (s->pen.cr, fmax (1, 0.07 * s->pen.letter));
  cairo_stroke (s->pen.cr);
}

static void
draw_square (sheet *s, const bt_thing *t)
{
  double side = 0.8 * s->pen.letter, x, y;
  to_paper (s, t->at, &x, &y);
  cairo_rectangle (s->pen.cr, x - side / 2, y - side / 2, side, side);
  cairo_set_source_rgb (s->pen.cr, 0.1, 0.1, 0.1);
  cairo_fill (s->pen.cr);
}

/* A boat as its deck, pointed at the bow.  */
static void
draw_ship (sheet *s, const bt_thing *t)
{
  static const double y[] = { -0.5, 0.1, 0.5, 0.1, -0.5 }, x[] = { 0.14, 0.155, 0, -0.155, -0.14 };
  bt__pose pose = bt__pose_of (t->at, t->heading, 0, 0);
  for (int i = 0; i < 5; i++)
    line_to (s, bt__pose_point (&pose, t->size.y * x[i], t->size.y * y[i], 0));
  cairo_close_path (s->pen.cr);
  cairo_set_source_rgb (s->pen.cr, 0.9, 0.9, 0.9);
  cairo_fill_preserve (s->pen.cr);
  cairo_set_source_rgb (s->pen.cr, 0.1, 0.1, 0.1);
  cairo_set_line_width (s->pen.cr, fmax (1, 0.07 * s->pen.letter));
  cairo_stroke (s->pen.cr);
}

static void
draw_mark (sheet *s, const bt_thing *t)
{
  double x, y;
  to_paper (s, t->at, &x, &y);
  cairo_new_sub_path (s->pen.cr);
  cairo_arc (s->pen.cr, x, y, 0.4 * s->pen.letter, 0, 2 * BT__PI);
  bt__pen_color (&s->pen, t->color);
  cairo_set_line_width (s->pen.cr, fmax (1.2, 0.12 * s->pen.letter));
  cairo_stroke (s->pen.cr);
}

static void
outline_arrow (sheet *s, const bt_thing *t)
{
  cairo_t *cr = s->pen.cr;
  double x0, y0, x1, y1, length, head, ux, uy;
  to_paper (s, t->from, &x0, &y0);
  to_paper (s, t->to, &x1, &y1);
  length = hypot (x1 - x0, y1 - y0);
  if (length < 1)
    return;
  ux = (x1 - x0) / length, uy = (y1 - y0) / length;
  head = fmin (0.7 * s->pen.letter, length / 2);
  cairo_set_source_rgb (cr, 0.15, 0.5, 0.75);
  cairo_set_line_width (cr, fmax (1, 0.09 * s->pen.letter));
  cairo_move_to (cr, x0, y0);
  cairo_line_to (cr, x1 - head * ux, y1 - head * uy);
  cairo_stroke (cr);
  cairo_move_to (cr, x1, y1);
  cairo_line_to (cr, x1 - head * (ux + 0.4 * uy), y1 - head * (uy - 0.4 * ux));
  cairo_line_to (cr, x1 - head * (ux - 0.4 * uy), y1 - head * (uy + 0.4 * ux));
  cairo_close_path (cr);
  cairo_fill (cr);
}

static void
draw_lines (sheet *s, const bt_thing *t)
{
  cairo_set_source_rgba (s->pen.cr, 0.3, 0.3, 0.5, 0.6);
  cairo_set_line_width (s->pen.cr, 0.8);
  for (size_t i = 0; i + 1 < t->n; i += 2)
    {
      line_to (s, t->points[i]);
      line_to (s, t->points[i + 1]);
      cairo_stroke (s->pen.cr);
    }
}

/* ---- The sheet ---- */

/* Lines of round coordinates.  */
static void
draw_grid (sheet *s)
{
  const bt__optics *o = &s->optics;
  double step = bt__round_step (2 * o->half_width / 6);
  cairo_set_source_rgb (s->pen.cr, 0.87, 0.9, 0.92);
  cairo_set_line_width (s->pen.cr, fmax (0.7, 0.04 * s->pen.letter));
  for (double x = step * ceil ((o->eye.x - o->half_width) / step); x < o->eye.x + o->half_width;
       x += step)
    {
      line_to (s, bt__vec (x, o->eye.y - o->half_height, 0));
      line_to (s, bt__vec (x, o->eye.y + o->half_height, 0));
      cairo_stroke (s->pen.cr);
    }
  for (double y = step * ceil ((o->eye.y - o->half_height) / step); y < o->eye.y + o->half_height;
       y += step)
    {
      line_to (s, bt__vec (o->eye.x - o->half_width, y, 0));
      line_to (s, bt__vec (o->eye.x + o->half_width, y, 0));
      cairo_stroke (s->pen.cr);
    }
}

static void
draw_thing (sheet *s, const bt_thing *t, int layer)
{
  switch (t->kind)
    {
    case BT_THING_MESH:
      if (layer == 0)
        outline_mesh (s, t);
      break;
    case BT_THING_LINES:
      if (layer == 1)
        draw_lines (s, t);
      break;
    case BT_THING_ARROW:
      if (layer == 1)
        outline_arrow (s, t);
      break;
    case BT_THING_TUBE:
      if (layer == 1)
        draw_tube (s, t);
      break;
    case BT_THING_VEHICLE:
      if (layer == 2)
        draw_vehicle (s, t);
      break;
    case BT_THING_SHIP:
      if (layer == 0)
        draw_ship (s, t);
      break;
    case BT_THING_ANCHOR:
      if (layer == 2)
        draw_square (s, t);
      break;
    case BT_THING_MARK:
      if (layer == 2)
        draw_mark (s, t);
      break;
    default:
      if (layer == 0)
        draw_body (s, t);
    }
}

static void
draw_sheet (sheet *s, int transparent)
{
  if (!transparent)
    {
      cairo_set_source_rgb (s->pen.cr, 1, 1, 1);
      cairo_paint (s->pen.cr);
    }
  draw_grid (s);
  for (int layer = 0; layer < 3; layer++)
    for (size_t i = 0; i < s->view->n; i++)
      draw_thing (s, &s->view->things[i], layer);
}

bt_status
bt__plan (const bt_view *view, const bt__drawing *d, bt__picture *picture, bt_error *error)
{
  sheet s = { .view = view };
  bt_status status = bt__check_size (d->width, d->height, error);
  if (status != BT_OK || (status = bt__picture_new (picture, d->width, d->height, error)) != BT_OK)
    return status;
  s.optics = bt__optics_of (&view->camera, (double)d->width / d->height);
  s.ppm = d->width / (2 * s.optics.half_width);
  status = bt__pen_open (&s.pen, picture, 1, error);
  if (status == BT_OK)
    {
      draw_sheet (&s, d->transparent);
      status = bt__pen_close (&s.pen, error);
    }
  if (status != BT_OK)
    bt__picture_free (picture);
  return status;
}
