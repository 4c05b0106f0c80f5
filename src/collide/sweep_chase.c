/* Conservative advancement (Mirtich 1996) of one convex body against another, both on their way.

   Let N be the unit vector along the shortest distance.  The gap along N is the least n . p over
   the body less the largest n . p over the part.  After a time T a point has moved by T times its
   velocity, to within r (w t)^2 / 2 for a turn w t about the origin; the gap along N is then at
   least

   h(t) = min over body (n . p + t n . v(p)) - max over part (the same) - (r w^2 + r' w'^2) t^2 / 2,

   the linear terms being supports in the direction n + t (n x w).  H is concave: if h is at least
   the wanted gap now and at T, so it is in between; and if h is large enough at one time and too
   small at a later time, the chord between the two gives a later time with h large enough.
   Touching bodies may part, slide and turn away.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "collide/cast.h"
#include "collide/sweep_job.h"

enum
{
  STEPS_MAX = 64,
  CHORDS = 4,
  HALVINGS = 12
};

#define HOLD 1.005   /* gaps: where a body is stopped */
#define CREEP 1e-5   /* of the gap: what a body that was stopped may yield, for rounding */
#define LITTLE 0.005 /* of the gap: a way not worth another step */

bt_vec3
bt__placed_support (const void *shape, bt_vec3 d, int *hint)
{
  const bt__placed *p = shape;
  bt_vec3 local = bt__into (&p->frame, d);
  return bt__to_world (&p->frame, p->core->support (p->core->shape, local, hint));
}

bt__motion
bt__motion_cut (const bt__motion *m, double share)
{
  bt__motion out = *m;
  out.travel = bt__scale (share, m->travel);
  out.angle = share * m->angle;
  return out;
}

/* ---- Where they are ---- */

static void
measure_plane (const bt__chase *c, const bt__placed *body, bt__apart *out)
{
  int hint = 0;
  bt_vec3 n = c->plane->normal, p = bt__placed_support (body, bt__scale (-1, n), &hint);
  double height = bt__dot (n, p) - c->plane->offset;
  *out = (bt__apart){ height - c->body.round, bt__axpy (p, -height, n), n };
}

static void
measure_gap (const bt__chase *c, double t, bt__apart *out)
{
  bt__placed a = { &c->body.core, bt__motion_at (&c->body.motion, t) };
  bt__placed b = { &c->part.core, bt__motion_at (&c->part.motion, t) };
  bt__gap gap;
  if (c->plane)
    {
      measure_plane (c, &a, out);
      return;
    }
  bt__gjk (&(bt__convex){ bt__placed_support, &a }, &(bt__convex){ bt__placed_support, &b }, &gap);
  bt_vec3 n = bt__unit_or (bt__sub (gap.a, gap.b), bt__vec (0, 0, 0));
  if (!(gap.distance > 0))
    n = bt__vec (0, 0, 0);
  *out = (bt__apart){ gap.distance - c->body.round - c->part.round,
                      bt__axpy (gap.b, c->part.round, n), n };
}

/* ---- How they stay apart ---- */

/* Body and part at one time, to tell the later height of the body over the part along N.  */
typedef struct outlook
{
  const bt__chase *chase;
  bt__frame a, b; /* of the body, of the part */
  bt_vec3 n;
} outlook;

/* The least of SIGN n . p over FLIER, standing at FRAME, the time T later.  */
static double
least_support (const bt__flier *x, const bt__frame *frame, bt_vec3 n, double sign, double t)
{
  int hint = 0;
  double turn = t * x->motion.angle;
  bt_vec3 aside = bt__cross (n, x->motion.axis), down = bt__axpy (n, turn, aside);
  bt_vec3 d = bt__into (frame, bt__scale (-sign, down));
  double own = -bt__dot (d, x->core.support (x->core.shape, d, &hint));
  double origin = bt__dot (n, frame->origin) + t * bt__dot (n, x->motion.travel);
  return sign * origin + own - x->round - 0.5 * x->radius * bt__norm (aside) * turn * turn;
}

static double
height_in (const outlook *o, double t)
{
  const bt__chase *c = o->chase;
  double body = least_support (&c->body, &o->a, o->n, 1, t);
  return body + (c->plane ? -c->plane->offset : least_support (&c->part, &o->b, o->n, -1, t));
}

/* The longest time, at most LEFT, for which the two stay LIMIT apart: found from below.  HERE is
   the height now, at least LIMIT.  */
static double
time_apart (const outlook *o, double here, double limit, double left)
{
  double good = 0, over = here - limit, bad = left, under = height_in (o, left) - limit;
  if (under >= 0)
    return left;
  for (int i = 0; i < HALVINGS && good == 0; i++)
    {
      double t = 0.5 * bad, h = height_in (o, t) - limit;
      if (h < 0)
        {
          bad = t;
          under = h;
        }
      else
        {
          good = t;
          over = h;
        }
    }
  for (int i = 0; i < CHORDS && over > 0; i++)
    {
      good += (bad - good) * over / (over - under);
      over = height_in (o, good) - limit;
    }
  return good;
}

static double
size_of (const bt__chase *c)
{
  return bt__largest (c->body.motion.from.origin) + bt__largest (c->body.motion.travel)
         + c->body.radius;
}

/* Return the gap to keep for a body at height HERE over the part.  A body stopped earlier stays
   where it was; a body nearer than the gap comes no nearer.  */
static double
limit_from (double here, double goal, double gap)
{
  return fmin (fmin (HOLD * goal, fmax (goal, here - CREEP * gap)), here);
}

double
bt__chase_run (const bt__chase *c, double most, bt__apart *out, bt__count *count)
{
  double t = 0, goal = c->gap * (1 + BT__MARGIN) + BT__ROUNDING * size_of (c), limit = 0;
  double least_step = LITTLE * c->gap
                      / (bt__motion_way (&c->body.motion, c->body.radius)
                         + bt__motion_way (&c->part.motion, c->part.radius));
  count->casts++;
  for (int i = 0; i < STEPS_MAX; i++)
    {
      outlook o = {
        c, bt__motion_at (&c->body.motion, t), bt__motion_at (&c->part.motion, t), { 0, 0, 0 }
      };
      measure_gap (c, t, out);
      count->cast_steps++;
      o.n = out->normal;
      if (bt__dot (o.n, o.n) == 0)
        return t;
      double here = height_in (&o, 0);
      if (i == 0)
        limit = limit_from (here, goal, c->gap);
      if (here < limit)
        return t;
      double step = time_apart (&o, here, limit, most - t);
      if (t + step >= most)
        return most;
      t += step;
      if (!(step > least_step))
        break;
    }
  measure_gap (c, t, out);
  return t;
}
