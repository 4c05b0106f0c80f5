/* Obstacles for the rooms above: by name, by shape, and the frame of a kinematic obstacle on its
   track at a time.  Positions are linear between the rows of a track, headings turn the shorter
   way; before the first and after the last row the obstacle stands still.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "model/model.h"

int
bt__model_obstacle (const bt_model *model, const char *name)
{
  for (int i = 0; i < model->n_obstacles; i++)
    if (strncmp (model->obstacles[i].name, name, BT_NAME_SIZE) == 0)
      return i;
  return BT__NO_OBSTACLE;
}

int
bt__model_carried (const bt_model *model, int i)
{
  return model->where[i] < 0 ? -1 - model->where[i] : -1;
}

const bt__obstacle *
bt__model_shape (const bt_model *model, int i)
{
  int k = bt__model_carried (model, i);
  return k >= 0 ? model->carried[k].body->object : model->scene->object + model->where[i];
}

/* ---- Frames ---- */

/* Sine and cosine of an angle in degrees, exact for quarter turns.  */
static void
sine_and_cosine (double degrees, double *s, double *c)
{
  static const double sines[4] = { 0, 1, 0, -1 };
  double quarters = degrees / 90;
  int whole = quarters == floor (quarters) && fabs (quarters) < 1e9;
  int k = whole ? (int)(((int64_t)quarters % 4 + 4) % 4) : 0;
  *s = whole ? sines[k] : sin (degrees * (BT__PI / 180));
  *c = whole ? sines[(k + 1) % 4] : cos (degrees * (BT__PI / 180));
}

bt__frame
bt__turned (bt_vec3 at, double heading, double pitch, double roll)
{
  double sh, ch, sp, cp, sr, cr;
  bt__frame level, f;
  sine_and_cosine (heading, &sh, &ch);
  sine_and_cosine (pitch, &sp, &cp);
  sine_and_cosine (roll, &sr, &cr);
  level = (bt__frame){ at, { ch, -sh, 0 }, { sh, ch, 0 }, { 0, 0, 1 } };
  f.origin = at;
  f.x = bt__out_of (&level, bt__vec (cr, sr * sp, -sr * cp));
  f.y = bt__out_of (&level, bt__vec (0, cp, sp));
  f.z = bt__out_of (&level, bt__vec (sr, -cr * sp, cr * cp));
  return f;
}

/* The row that the time T follows, 0 to n - 2.  */
static int
row_before (const bt__carried *c, double t)
{
  int low = 0, high = c->n - 1;
  while (high - low > 1)
    {
      int middle = (low + high) / 2;
      if (c->row[middle][0] <= t)
        low = middle;
      else
        high = middle;
    }
  return low;
}

static bt__frame
frame_of_row (const double *row)
{
  return bt__turned (bt__vec (row[1], row[2], row[3]), row[4], 0, 0);
}

bt__frame
bt__carried_frame (const bt_model *model, int k, double t)
{
  const bt__carried *c = &model->carried[k];
  const double *a, *b;
  double row[5], u;
  if (!(t > c->row[0][0]))
    return frame_of_row (c->row[0]);
  if (t >= c->row[c->n - 1][0])
    return frame_of_row (c->row[c->n - 1]);
  a = c->row[row_before (c, t)];
  b = a + 5;
  u = (t - a[0]) / (b[0] - a[0]);
  for (int i = 1; i < 4; i++)
    row[i] = a[i] + u * (b[i] - a[i]);
  row[4] = a[4] + u * remainder (b[4] - a[4], 360);
  return frame_of_row (row);
}

/* ---- Boxes ---- */

/* The box about B, a box in FRAME.  */
static bt__aabb
turned_box (const bt__aabb *b, const bt__frame *frame)
{
  bt_vec3 centre = bt__to_world (frame, bt__scale (0.5, bt__add (b->lo, b->hi)));
  bt_vec3 half = bt__scale (0.5, bt__sub (b->hi, b->lo));
  bt_vec3 x = bt__scale (half.x, frame->x), y = bt__scale (half.y, frame->y),
          z = bt__scale (half.z, frame->z);
  half = bt__vec (fabs (x.x) + fabs (y.x) + fabs (z.x), fabs (x.y) + fabs (y.y) + fabs (z.y),
                  fabs (x.z) + fabs (y.z) + fabs (z.z));
  return (bt__aabb){ bt__sub (centre, half), bt__add (centre, half) };
}

/* Exact for what has no corners.  */
bt__aabb
bt__framed_box (const bt__obstacle *shape, const bt__frame *frame)
{
  bt__obstacle moved = *shape;
  bt__box *box = &moved.shape.box;
  bt__cylinder *c = &moved.shape.cylinder;
  bt__capsule *p = &moved.shape.capsule;
  bt__aabb own;
  switch (shape->kind)
    {
    case BT__OBSTACLE_PLANE:
      return bt__obstacle_box (shape);
    case BT__OBSTACLE_BOX:
      box->frame
          = (bt__frame){ bt__to_world (frame, box->frame.origin), bt__out_of (frame, box->frame.x),
                         bt__out_of (frame, box->frame.y), bt__out_of (frame, box->frame.z) };
      return bt__obstacle_box (&moved);
    case BT__OBSTACLE_SPHERE:
      moved.shape.sphere.centre = bt__to_world (frame, moved.shape.sphere.centre);
      return bt__obstacle_box (&moved);
    case BT__OBSTACLE_CYLINDER:
      c->centre = bt__to_world (frame, c->centre);
      c->axis = bt__out_of (frame, c->axis);
      return bt__obstacle_box (&moved);
    case BT__OBSTACLE_CAPSULE:
      p->a = bt__to_world (frame, p->a);
      p->b = bt__to_world (frame, p->b);
      return bt__obstacle_box (&moved);
    default:
      own = bt__obstacle_box (shape);
      return turned_box (&own, frame);
    }
}
