/* Conservative advancement (Mirtich 1996), of a segment against one convex part, with a planar
   advance.

   Two bounds on the next share of the move are known after each measurement of the distance:

   - No point of the segment may move farther than the present gap, distance less core radius; the
   speed is that of the faster end, and 0.9 of the bound is taken.

   - The part is convex, so at any time the part lies behind the plane through its nearest point
   across the shortest way, and the segment before the plane.  So each end may go 0.9 of the way to
   the plane moved by the core radius; an end that moves along the plane or away from the plane is
   not bounded at all, and segments slide over a surface in one advance.

   The larger bound is taken and the distance measured anew, until the move is over or the segment
   is within 2 % of the core radius of the core.  If neither end reaches the plane before the end of
   the move, the whole move is safe without another measurement.

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
  bt__link link = { bt__axpy (c->link.a, t, c->da), bt__axpy (c->link.b, t, c->db) };
  if (!c->motion)
    return link;
  bt__frame f = bt__motion_at (c->motion, t * c->share);
  return (bt__link){ bt__to_local (&f, link.a), bt__to_local (&f, link.b) };
}

/* The ends' moves against the part, in the part's frame at the start of the motion.  */
static void
relative (const bt__cast *c, bt_vec3 *da, bt_vec3 *db)
{
  *da = c->da;
  *db = c->db;
  if (!c->motion)
    return;
  bt_vec3 travel = bt__scale (c->share, c->motion->travel);
  *da = bt__into (&c->motion->from, bt__sub (*da, travel));
  *db = bt__into (&c->motion->from, bt__sub (*db, travel));
}

static int
turns (const bt__cast *c)
{
  return c->motion && c->motion->angle != 0 && c->share > 0;
}

/* How far an end at height G over the plane, moving V against it, may go: a share of the move.  */
static double
to_plane (double g, double v, double core)
{
  if (v >= 0)
    return INFINITY;
  return g > BT__CAST_FLOOR * core ? BT__CAST_SAFETY * g / -v : 0;
}

/* With the link at LINK and its nearest point W: the next share, at least; INFINITY if the plane
   stays behind until the end, LEFT from now.  */
static double
planar (const bt__cast *c, const bt__link *link, const bt__witness *w, bt_vec3 da, bt_vec3 db,
        double left)
{
  double va = bt__dot (w->normal, da), vb = bt__dot (w->normal, db);
  double ga = bt__dot (w->normal, bt__sub (link->a, w->point)) - c->core;
  double gb = bt__dot (w->normal, bt__sub (link->b, w->point)) - c->core;
  if ((va >= 0 || ga + va * left >= 0) && (vb >= 0 || gb + vb * left >= 0))
    return INFINITY;
  return fmin (to_plane (ga, va, c->core), to_plane (gb, vb, c->core));
}

double
bt__cast_run (const bt__cast *c, bt__count *count)
{
  bt_vec3 da, db;
  bt__witness w = c->near->w;
  relative (c, &da, &db);
  int turning = turns (c);
  double speed = fmax (bt__norm (da), bt__norm (db)), t = 0;
  if (turning)
    speed += c->motion->angle * c->share * c->radius;
  if (w.distance - c->core > speed)
    return 1;
  count->casts++;
  for (int i = 0; i < STEPS_MAX; i++)
    {
      double gap = w.distance - c->core;
      bt__link link = link_at_share (c, t);
      if (i > 0 && gap < BT__CAST_NEAR * c->core)
        return t;
      double step = gap > BT__CAST_FLOOR * c->core ? BT__CAST_SAFETY * gap / speed : 0;
      if (!turning)
        step = fmax (step, planar (c, &link, &w, da, db, 1 - t));
      if (!(step > 0))
        return t;
      if (t + step >= 1)
        return 1;
      t += step;
      link = link_at_share (c, t);
      bt__scene_pair (c->scene, c->near, &link, &w);
      count->cast_steps++;
    }
  return t;
}
