/* Setting a plane problem into space: the load, the plane of the bend, the depth rule.

   The thesis (sections 2.2 to 2.4) rotates the world until the current lies along an axis and the
   far end in a plane, solves the plane problem, and rotates back.  The same curve follows without
   angles: the curve lies in the plane spanned by the chord and the direction of the load.  The sag
   factor turns the direction of the load from the current toward the vertical.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/shape_job.h"

/* A chord closer to the direction of the load than this share of the length defines no plane.  */
#define ALONG 1e-12

static const bt_vec3 up = { 0, 0, 1 }, down = { 0, 0, -1 };

/* ---- The load ---- */

/* Measure the mean current along the chord.  Only its horizontal part bends the line.  */
bt_status
bt__shape_measure_load (bt__shape_job *j)
{
  const bt_tether_props *p = j->props;
  bt_vec3 mean = bt_water_mean_velocity (j->in->water, j->in->a, j->in->b);
  double speed = hypot (mean.x, mean.y);
  j->drag = 0.5 * j->in->water->density * p->cdn * p->diameter * speed * speed;
  j->load = hypot (j->drag, p->wet_weight);
  j->speed = speed;
  if (!isfinite (speed) || !isfinite (j->load))
    return bt__fail (j->error, BT_ERR_DIVERGED,
                     "the current along the tether gives a load of %g N/m at %g m/s", j->load,
                     speed);
  j->current = speed > 0 ? bt__vec (mean.x / speed, mean.y / speed, 0) : bt__vec (0, 0, 0);
  return BT_OK;
}

static int
is_flowing (const bt__shape_job *j)
{
  return j->current.x != 0 || j->current.y != 0;
}

/* The direction of the last load, else straight down.  */
bt_vec3
bt__shape_remembered (const bt__shape_job *j)
{
  return bt__unit_or (j->memory->load_direction, down);
}

/* The load's level part, all of it with the linear depth rule.  Without a current: the last
   direction, else to the left of the chord, else east.  */
static bt_vec3
level_direction (const bt__shape_job *j)
{
  if (is_flowing (j))
    return j->current;
  bt_vec3 last = j->memory->load_direction, c = j->chord;
  bt_vec3 aside = bt__unit_or (bt__vec (-c.y, c.x, 0), bt__vec (1, 0, 0));
  last.z = 0;
  return bt__norm (last) > 1e-6 ? bt__unit_or (last, aside) : aside;
}

/* The angle of the load over the horizontal: from the real forces, or by thesis 2.4.2, whose
   relative current magnitude ends at 1: beyond the maximum allowed current nothing sags.  */
static double
sag_angle (const bt__shape_job *j)
{
  const bt_tether_props *p = j->props;
  if (p->sag_buoyancy == BT_SAG_AUTO)
    return atan2 (-p->wet_weight, j->drag);
  return p->sag_buoyancy * (1 - fmin (j->speed / p->max_current, 1)) * (BT__PI / 2);
}

/* A given buoyancy sags in still water too, where the level part of the load is the last one's.
   With neither current nor buoyancy nothing says where to.  */
static bt_vec3
sagging_direction (const bt__shape_job *j)
{
  double weight = j->props->wet_weight, buoyancy = j->props->sag_buoyancy;
  if (is_flowing (j) || (buoyancy != BT_SAG_AUTO && buoyancy != 0))
    {
      double phi = sag_angle (j);
      return bt__axpy (bt__scale (cos (phi), level_direction (j)), sin (phi), up);
    }
  if (buoyancy == BT_SAG_AUTO && weight != 0)
    return weight > 0 ? down : up;
  return bt__shape_remembered (j);
}

/* ---- The plane ---- */

/* A unit vector square to the unit vector D: the part of WISH that is, else a horizontal one.  */
bt_vec3
bt__shape_square_to (bt_vec3 d, bt_vec3 wish)
{
  bt_vec3 part = bt__off_axis (d, wish);
  if (bt__norm (part) > 1e-3)
    return bt__unit_or (part, part);
  bt_vec3 level = bt__vec (-d.y, d.x, 0);
  return bt__norm (level) > 1e-6 ? bt__unit_or (level, level) : bt__vec (1, 0, 0);
}

/* Span the plane of CHORD and the load's direction.  */
void
bt__shape_span_plane (bt__shape_job *j, bt_vec3 chord)
{
  bt_vec3 d = j->direction, side = bt__off_axis (d, chord);
  j->v = -bt__dot (chord, d);
  j->h = bt__norm (side);
  if (j->h > ALONG * fmax (j->in->length, bt__norm (chord)))
    j->shape->across = bt__scale (1 / j->h, side);
  else
    {
      j->h = 0;
      j->shape->across = bt__shape_square_to (d, j->memory->across);
    }
  j->shape->against = bt__scale (-1, d);
  j->shape->load = j->load;
}

/* The plane problem of the depth rule.  The linear rule shares depth out along the arc length, and
   sqrt (length^2 - depth^2) is left for the plane.  */
void
bt__shape_pose (bt__shape_job *j)
{
  bt__shape *s = j->shape;
  double length = j->in->length;
  int level = j->props->depth_rule != BT_DEPTH_SAG;
  j->direction = level ? level_direction (j) : sagging_direction (j);
  s->plane_length = length;
  bt_vec3 chord = j->chord;
  if (level)
    {
      double depth = chord.z;
      chord.z = 0;
      if (j->props->depth_rule == BT_DEPTH_LINEAR)
        {
          s->rise.z = depth / length;
          s->plane_length = sqrt (fmax ((length - depth) * (length + depth), 0));
        }
    }
  bt__shape_span_plane (j, chord);
}

/* ---- Straight ---- */

void
bt__shape_be_straight (bt__shape_job *j, double tension)
{
  bt__shape *s = j->shape;
  s->form = BT__FORM_STRAIGHT;
  s->plane_length = j->in->length;
  s->rise = bt__vec (0, 0, 0);
  s->t1 = s->t2 = tension;
}

/* True if no slack is left.  */
int
bt__shape_is_taut (const bt__shape_job *j)
{
  /* A vehicle held at the end is at the length but for rounding.  */
  return bt__norm (j->chord) >= j->in->length * (1 - 1e-12);
}

/* True if the plane problem has no slack, by the exact excess.  */
int
bt__shape_is_plane_taut (const bt__shape_job *j)
{
  double s = j->shape->plane_length;
  return bt__shape_is_taut (j) || !(s >= BT__PLANE_TINY) || bt__plane_excess (j->h, j->v, s) <= 0;
}
