/* The current as streamlines: where the water of this moment goes, and how fast.

   A streamline is integrated by the midpoint rule from seeds in rows across the stream, above,
   amidst and below the tethers.  A line is followed as long as the extent of the tethers times a
   constant, and ends where the water is slow.  Speed is told by colour with a bar, unless the
   colours of the picture have another meaning already.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "render/scene.h"

enum
{
  LEVELS = 3,
  SEEDS = 7, /* in a row */
  POINTS = 81
};

static const double broad = 1.2, length = 1.7; /* of a row, of a line; of the extent */

typedef struct flow
{
  bt__scene *s;
  bt_vec3 middle, ahead, aside; /* of the tethers; along the stream there, and across */
  double span, slow;            /* m; m/s at which a line ends */
  double most;                  /* m/s: the fastest water on any line */
} flow;

static bt_vec3
water_at (flow *f, bt_vec3 p)
{
  bt_vec3 v = { 0, 0, 0 };
  if (f->s->status == BT_OK)
    f->s->status = bt_dive_current_at (f->s->dive, p, &v, f->s->error);
  return v;
}

/* The height of a row: from just below the surface down to the deepest point of the tethers.  */
static double
level_of (const flow *f, int level)
{
  double top = fmin (f->s->high.z, -0.02 * f->span), low = fmin (f->s->low.z, top);
  if (top - low < 0.1 * f->span)
    low = top - 0.1 * f->span;
  low = fmax (low, -f->s->sea.depth + 0.02 * f->span);
  return top + (low - top) * level / (LEVELS - 1);
}

static bt_vec3
stream_seed (const flow *f, int level, int k)
{
  double across = broad * f->span * ((double)k / (SEEDS - 1) - 0.5);
  bt_vec3 p = bt__axpy (bt__axpy (f->middle, -0.5 * length * f->span, f->ahead), across, f->aside);
  p.z = level_of (f, level);
  return p;
}

/* Follow the water from P on; return how many points there are, with the speed at each.  */
static size_t
follow_water (flow *f, bt_vec3 p, bt_vec3 point[POINTS], double speed[POINTS])
{
  double step = length * f->span / (POINTS - 1);
  for (size_t n = 0; n < POINTS; n++)
    {
      bt_vec3 v = water_at (f, p), half;
      double fast = bt__norm (v);
      if (f->s->status != BT_OK || fast < f->slow)
        return n;
      point[n] = p;
      speed[n] = fast;
      f->most = fmax (f->most, fast);
      half = bt__axpy (p, 0.5 * step / fast, v);
      v = water_at (f, half);
      if (bt__norm (v) < f->slow)
        return n + 1;
      p = bt__axpy (p, step / bt__norm (v), v);
    }
  return POINTS;
}

/* An arrow head in the middle of N points: which way the water goes.  */
static void
add_way (flow *f, const bt_vec3 *point, size_t n, bt_color color)
{
  bt_thing head = bt_thing_of (BT_THING_ARROW);
  size_t k = n / 2;
  head.from = point[k - 1];
  head.to = bt__axpy (head.from, 0.06 * f->span,
                      bt__unit_or (bt__sub (point[k], point[k - 1]), f->ahead));
  head.color = color;
  head.radius = 0.003 * f->span;
  bt__scene_add (f->s, &head);
}

static void
add_stream (flow *f, bt_vec3 seed, int painted)
{
  bt_vec3 point[POINTS];
  double speed[POINTS];
  bt_thing line = bt_thing_of (BT_THING_TUBE);
  size_t n = follow_water (f, seed, point, speed);
  if (n < 3)
    return;
  line.color = bt_thing_of (BT_THING_ARROW).color;
  line.points = point;
  line.values = painted ? speed : NULL;
  line.n = n;
  line.radius = 0.001 * f->span;
  bt__scene_add (f->s, &line);
  add_way (f, point, n, line.color);
}

void
bt__scene_flow (bt__scene *s)
{
  bt_scale *scale = &s->view->scale;
  flow f = { .s = s, .span = fmax (bt__distance (s->low, s->high), 2) };
  int painted = !scale->name;
  bt_vec3 v;
  f.middle = bt__scale (0.5, bt__add (s->low, s->high));
  v = water_at (&f, f.middle);
  f.slow = fmax (0.02 * bt__norm (v), 1e-3);
  f.ahead = bt__unit_or (bt__vec (v.x, v.y, 0), bt__vec (0, 1, 0));
  f.aside = bt__vec (f.ahead.y, -f.ahead.x, 0);
  for (int level = 0; level < LEVELS; level++)
    for (int k = 0; k < SEEDS; k++)
      add_stream (&f, stream_seed (&f, level, k), painted);
  if (painted && f.most > 0)
    *scale = (bt_scale){ .name = "current", .unit = "m/s", .high = f.most, .cool = 1 };
}
