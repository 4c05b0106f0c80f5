/* Conservative advancement (Mirtich 1996), of a segment against one convex part or against another
   segment on its way, with a planar advance.

   Two bounds on the next share of the move are known after each measurement of the distance:

   - No point of the segment may move farther than the present gap, distance less core radius; the
   speed is that of the faster end, and 0.9 of the bound is taken.

   - The part is convex, so at any time the part lies behind the plane through its nearest point
   across the shortest way, and the segment before the plane.  So each end may go 0.9 of the way to
   the plane moved by the core radius; an end that moves along the plane or away from the plane is
   not bounded at all, and segments slide over a surface in one advance.  Of two segments each end
   of the first is held against each end of the second.

   The larger bound is taken and the distance measured anew, until the move is over or the segment
   has come within 2 % of the core radius of the core and comes nearer: a segment that starts so
   near may part.  If neither end reaches the plane before the end of the move, the whole move is
   safe without another measurement.

   The planes of a part that turns do not stand still: only the first bound serves, with the turn's
   speed at the scene's radius added to the speed of the segment.

   Result: a lower bound of the time of impact, as a share of the move: so far the segment stays the
   core radius away from the part; 1 for the whole move.  Rounding is covered by stopping at 1e-4 of
   the core radius.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/cast.h"

enum
{
  STEPS_MAX = 200
};

/* ---- Motions ---- */

static bt_vec3
turned_about (bt_vec3 v, bt_vec3 axis, double angle)
{
  double c = cos (angle), s = sin (angle);
  bt_vec3 out = bt__axpy (bt__scale (c, v), s, bt__cross (axis, v));
  return bt__axpy (out, (1 - c) * bt__dot (axis, v), axis);
}

bt__frame
bt__motion_at (const bt__motion *m, double t)
{
  bt__frame f = m->from;
  f.origin = bt__axpy (f.origin, t, m->travel);
  if (m->angle != 0)
    {
      f.x = turned_about (f.x, m->axis, t * m->angle);
      f.y = turned_about (f.y, m->axis, t * m->angle);
      f.z = turned_about (f.z, m->axis, t * m->angle);
    }
  return f;
}

/* The sum of the cross products of the axes before and after is 2 sin (angle) axis; of their dot
   products, 1 + 2 cos (angle).  */
bt__motion
bt__motion_between (const bt__frame *from, const bt__frame *to)
{
  bt__motion m = { .from = *from, .travel = bt__sub (to->origin, from->origin) };
  bt_vec3 sum = bt__add (bt__cross (from->x, to->x),
                         bt__add (bt__cross (from->y, to->y), bt__cross (from->z, to->z)));
  double trace = bt__dot (from->x, to->x) + bt__dot (from->y, to->y) + bt__dot (from->z, to->z);
  m.angle = atan2 (bt__norm (sum), trace - 1);
  m.axis = bt__unit_or (sum, bt__vec (0, 0, 1));
  if (m.angle < 1e-15)
    m.angle = 0;
  return m;
}

/* ---- The cast ---- */

/* The link after the share T, in the frame of the part.  */
static bt__link
link_at_share (const bt__cast *c, double t)
{
  bt__link link = bt__link_moved (&c->link, c->d[0], c->d[1], t);
  if (!c->motion)
    return link;
  bt__frame f = bt__motion_at (c->motion, t * c->share);
  return bt__link_into (&f, link);
}

/* The other link after the share T; of a part its nearest point.  */
static bt__link
other_at_share (const bt__cast *c, double t)
{
  return c->scene ? (bt__link){ c->w.point, c->w.point }
                  : bt__link_moved (&c->other, c->other_d[0], c->other_d[1], t);
}

static void
measure (bt__cast *c, double t, bt__count *count)
{
  bt__link link = link_at_share (c, t), other = other_at_share (c, t);
  if (c->scene)
    bt__scene_pair (c->scene, c->near, &link, &c->w);
  else
    bt__pair_links (&other, &link, &c->w);
  count->cast_steps++;
}

/* The ends' moves against the part to D, in the part's frame at the start of the motion.  */
static void
relative (const bt__cast *c, bt_vec3 d[2])
{
  for (int e = 0; e < 2; e++)
    d[e] = c->motion ? bt__into (&c->motion->from,
                                 bt__sub (c->d[e], bt__scale (c->share, c->motion->travel)))
                     : c->d[e];
}

static int
turns (const bt__cast *c)
{
  return c->motion && c->motion->angle != 0 && c->share > 0;
}

/* The number of pairs of ends, the link's end I & 1 and the other link's end I >> 1; a part has
 * one.
 */
static int
ends_of (const bt__cast *c)
{
  return c->scene ? 2 : 4;
}

/* The greatest of the ends' moves D against those of the other.  */
static double
speed_of (const bt__cast *c, const bt_vec3 d[2])
{
  double most = 0;
  for (int i = 0; i < ends_of (c); i++)
    {
      bt_vec3 v = bt__sub (d[i & 1], c->other_d[i >> 1]);
      most = fmax (most, bt__dot (v, v));
    }
  return sqrt (most) + (turns (c) ? c->motion->angle * c->share * c->radius : 0);
}

/* The next share after T, at least, of the ends' moves D; INFINITY if the plane between stays there
   until the end.  */
static double
planar (const bt__cast *c, double t, const bt_vec3 d[2])
{
  bt__link link = link_at_share (c, t), other = other_at_share (c, t);
  double best = INFINITY;
  for (int i = 0; i < ends_of (c); i++)
    {
      bt_vec3 p = i & 1 ? link.b : link.a, q = i >> 1 ? other.b : other.a;
      double v = bt__dot (c->w.normal, bt__sub (d[i & 1], c->other_d[i >> 1]));
      double g = bt__dot (c->w.normal, bt__sub (p, q)) - c->core;
      if (v >= 0 || g + v * (1 - t) >= 0)
        continue;
      best = fmin (best, g > BT__CAST_FLOOR * c->core ? BT__CAST_SAFETY * g / -v : 0);
    }
  return best;
}

double
bt__cast_run (bt__cast *c, bt__count *count)
{
  bt_vec3 d[2];
  relative (c, d);
  double speed = speed_of (c, d), t = 0, gap = -INFINITY;
  if (c->core == 0 || c->w.distance - c->core > speed)
    return 1;
  count->casts++;
  for (int i = 0; i < STEPS_MAX; i++)
    {
      double before = gap;
      gap = c->w.distance - c->core;
      if (i > 0 && gap < BT__CAST_NEAR * c->core && gap <= before)
        return t;
      double step = gap > BT__CAST_FLOOR * c->core ? BT__CAST_SAFETY * gap / speed : 0;
      if (!turns (c))
        step = fmax (step, planar (c, t, d));
      if (!(step > 0))
        return t;
      if (t + step >= 1)
        return 1;
      t += step;
      measure (c, t, count);
    }
  return t;
}

double
bt__cast_core (double core, double times, const bt_vec3 *x, uint32_t n)
{
  double far = 0;
  for (uint32_t i = 0; i < n; i++)
    far = fmax (far, bt__largest (x[i]));
  return core * (1 + times * BT__MARGIN) + times * BT__ROUNDING * far;
}
