/* What a camera that aims itself must have in the picture, as points.

   A thing that must be seen gives all its points.  A near thing gives points clipped to the box
   about what must be seen, grown by a share of the box: of a long wall the nearest part is framed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "render/framing.h"

static void
visit_ball (bt_vec3 p, double r, bt__visit_point *visit, void *user)
{
  for (int i = 0; i < 8; i++)
    visit (user, bt__add (p, bt__vec (i & 1 ? r : -r, i & 2 ? r : -r, i & 4 ? r : -r)));
}

static void
visit_box (const bt_thing *t, bt_vec3 size, bt__visit_point *visit, void *user)
{
  bt_vec3 axis[3];
  bt_body_axes (t->heading, t->pitch, t->roll, axis);
  for (int i = 0; i < 8; i++)
    {
      bt_vec3 p = bt__axpy (t->at, (i & 1 ? 0.5 : -0.5) * size.x, axis[0]);
      p = bt__axpy (p, (i & 2 ? 0.5 : -0.5) * size.y, axis[1]);
      visit (user, bt__axpy (p, (i & 4 ? 0.5 : -0.5) * size.z, axis[2]));
    }
}

static void
visit_points (const bt_thing *t, bt__visit_point *visit, void *user)
{
  bt_vec3 axis[3];
  bt_body_axes (t->heading, t->pitch, t->roll, axis);
  for (size_t i = 0; i < t->n; i++)
    if (t->kind == BT_THING_MESH)
      {
        bt_vec3 q = bt__scale (t->scale, t->points[i]), p = bt__axpy (t->at, q.x, axis[0]);
        visit (user, bt__axpy (bt__axpy (p, q.y, axis[1]), q.z, axis[2]));
      }
    else
      visit (user, t->points[i]);
}

/* Call VISIT for points that span T.  */
static void
visit_thing (const bt_thing *t, bt__visit_point *visit, void *user)
{
  switch (t->kind)
    {
    case BT_THING_TUBE:
    case BT_THING_MESH:
    case BT_THING_LINES:
      visit_points (t, visit, user);
      break;
    case BT_THING_BOX:
      visit_box (t, t->size, visit, user);
      break;
    case BT_THING_CYLINDER:
    case BT_THING_CAPSULE:
      visit_ball (t->from, t->radius, visit, user);
      visit_ball (t->to, t->radius, visit, user);
      break;
    case BT_THING_SPHERE:
      visit_ball (t->at, t->radius, visit, user);
      break;
    case BT_THING_ARROW:
      visit (user, t->from);
      visit (user, t->to);
      break;
    case BT_THING_VEHICLE:
    case BT_THING_SHIP:
      visit_ball (t->at, 0.6 * t->size.y, visit, user);
      break;
    case BT_THING_ANCHOR:
    case BT_THING_LABEL:
    case BT_THING_MARK:
      visit (user, t->at);
      break;
    default:
      break;
    }
}

typedef struct box
{
  bt_vec3 low, high;
  int any;
} box;

static void
widen_box (void *user, bt_vec3 p)
{
  box *b = user;
  if (!b->any)
    b->low = b->high = p;
  b->any = 1;
  b->low = bt__vec (fmin (b->low.x, p.x), fmin (b->low.y, p.y), fmin (b->low.z, p.z));
  b->high = bt__vec (fmax (b->high.x, p.x), fmax (b->high.y, p.y), fmax (b->high.z, p.z));
}

static int
apart (const box *a, const box *b, double gap)
{
  return a->low.x > b->high.x + gap || b->low.x > a->high.x + gap || a->low.y > b->high.y + gap
         || b->low.y > a->high.y + gap || a->low.z > b->high.z + gap || b->low.z > a->high.z + gap;
}

static box
box_of (const bt_thing *t)
{
  box b = { { 0, 0, 0 }, { 0, 0, 0 }, 0 };
  visit_thing (t, widen_box, &b);
  return b;
}

/* The box of what must be in the picture.  */
static box
must_box (const bt_view *view)
{
  box b = { { 0, 0, 0 }, { 0, 0, 0 }, 0 };
  for (size_t i = 0; i < view->n; i++)
    if (view->things[i].framing == BT_FRAME_MUST)
      visit_thing (&view->things[i], widen_box, &b);
  return b;
}

/* Call VISIT for all points of things that must be seen, and for the points of near things, clipped
   to the box ALL grown by GAP.  */
typedef struct clip
{
  box all;
  double gap;
  bt__visit_point *visit;
  void *user;
} clip;

static void
visit_clipped (void *user, bt_vec3 p)
{
  const clip *c = user;
  const box *b = &c->all;
  p = bt__vec (fmin (fmax (p.x, b->low.x - c->gap), b->high.x + c->gap),
               fmin (fmax (p.y, b->low.y - c->gap), b->high.y + c->gap),
               fmin (fmax (p.z, b->low.z - c->gap), b->high.z + c->gap));
  c->visit (c->user, p);
}

static double
box_gap (const box *a, const box *b)
{
  double x = fmax (fmax (a->low.x - b->high.x, b->low.x - a->high.x), 0);
  double y = fmax (fmax (a->low.y - b->high.y, b->low.y - a->high.y), 0);
  double z = fmax (fmax (a->low.z - b->high.z, b->low.z - a->high.z), 0);
  return sqrt (x * x + y * y + z * z);
}

/* The distance from the box ALL within which near things are framed: a sixth of its size, or enough
   to show the nearest thing if the picture grows to three times the size at most.  */
static double
reach_about (const bt_view *view, const box *all)
{
  double size = bt__distance (all->low, all->high), reach = size / 6, least = INFINITY, more = 0;
  for (size_t i = 0; i < view->n; i++)
    {
      box b;
      double gap;
      if (view->things[i].framing != BT_FRAME_NEAR || view->things[i].kind == BT_THING_ARROW
          || (b = box_of (&view->things[i]), !b.any) || !((gap = box_gap (all, &b)) < least))
        continue;
      least = gap;
      more = gap + fmin (bt__distance (b.low, b.high), size / 2);
    }
  return least > reach && least < size ? more : reach;
}

void
bt__framed_points (const bt_view *view, bt__visit_point *visit, void *user)
{
  clip c = { must_box (view), 0, visit, user };
  c.gap = reach_about (view, &c.all);
  for (size_t i = 0; i < view->n; i++)
    {
      const bt_thing *t = &view->things[i];
      box b;
      if (t->framing == BT_FRAME_MUST)
        visit_thing (t, visit, user);
      else if (t->framing == BT_FRAME_NEAR && (b = box_of (t), b.any) && !apart (&b, &c.all, c.gap))
        visit_thing (t, visit_clipped, &c);
    }
}

int
bt__frames_any (const bt_view *view)
{
  return must_box (view).any;
}

void
bt__frame_obstacles (bt_view *view)
{
  for (size_t i = 0; i < view->n; i++)
    if (view->things[i].framing == BT_FRAME_NEAR && view->things[i].kind != BT_THING_ARROW)
      view->things[i].framing = BT_FRAME_MUST;
}
