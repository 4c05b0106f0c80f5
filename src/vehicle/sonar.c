/* A sonar: a fan of beams over a sector, tilted against the own axes.

   Beam i of n points to sector (i / (n - 1) - 1/2) from ahead.  What is solid is met by a ray along
   the axis of the beam (collide/ray.h).  A line is thinner than beams are apart, so that a ray
   would miss it: it is heard where it passes through the cone of a beam, as far as its nearest
   point there.  A point of a segment lies in the cone of half angle h about d if p.d >= |p| cos h;
   the nearest one is the foot of the perpendicular, an end of the segment, or a root of (p.d)^2 =
   |p|^2 cos^2 h, which is quadratic along the segment.

   A beam reads the range of its first echo with Gaussian noise, or infinity.  Each beam draws noise
   from a channel of its own, apart from the channels of the other instruments.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "collide/ray_pair.h"
#include "math/vec.h"
#include "vehicle/instruments.h"
#include "vehicle/sonar.h"

enum
{
  FIRST_CHANNEL = 1000 /* apart from the other instruments' noise */
};

/* The direction of the axis of beam I of N.  */
static bt_vec3
beam (const bt__sonar *sonar, int i, int n)
{
  double angle = n > 1 ? sonar->sector * ((double)i / (n - 1) - 0.5) : 0;
  double ahead = cos (angle);
  bt_vec3 d = bt__scale (sin (angle), sonar->head.x);
  d = bt__axpy (d, ahead * cos (sonar->tilt), sonar->head.y);
  d = bt__axpy (d, ahead * sin (sonar->tilt), sonar->head.z);
  return bt__unit_or (d, bt__vec (0, 1, 0));
}

/* The range of the first solid on RAY, or INFINITY.  */
static double
first_solid (const bt__echoing *around, bt__ray ray, bt__count *count)
{
  bt__ray_hit hit;
  bt__entry entry;
  double first = INFINITY;
  if (bt__ray_cast (around->scene, around->on, around->mover, around->movers, &ray, &hit, count))
    first = ray.range = hit.range;
  for (int k = 0; k < around->bodies; k++)
    if (bt__ray_obstacle (&around->body[k], ray.from, ray.direction, ray.range, &entry))
      first = ray.range = entry.range;
  return first;
}

void
bt__sonar_sweep (const bt__sonar *sonar, const bt__echoing *around, int beams, double *range,
                 bt__count *count)
{
  bt__ray ray = { .from = sonar->head.origin, .range = sonar->range };
  for (int i = 0; i < beams; i++)
    {
      ray.direction = beam (sonar, i, beams);
      range[i] = first_solid (around, ray, count);
    }
}

/* A segment as the head sees it, from A on along WAY.  */
typedef struct seen_segment
{
  bt_vec3 a, way;
} seen_segment;

static bt_vec3
segment_point (const seen_segment *s, double t)
{
  return bt__axpy (s->a, t, s->way);
}

/* Keep in *BEST the point of S at T if that is nearer.  */
static void
keep_nearer (const seen_segment *s, double t, bt_vec3 *best)
{
  bt_vec3 p = segment_point (s, t);
  if (t >= 0 && t <= 1 && bt__norm (p) < bt__norm (*best))
    *best = p;
}

static double
foot_of (const seen_segment *s)
{
  double square = bt__dot (s->way, s->way);
  return square > 0 ? fmax (0, fmin (1, -bt__dot (s->a, s->way) / square)) : 0;
}

/* Set *BEST to the nearest point of S in the cone about AXIS, unit, with the cosine COSINE of the
   half angle, if one is nearer than *BEST.  */
static void
nearest_in_cone (const seen_segment *s, bt_vec3 axis, double cosine, bt_vec3 *best)
{
  const double inside[3] = { foot_of (s), 0, 1 };
  double c2 = cosine * cosine, pa = bt__dot (s->a, axis), pw = bt__dot (s->way, axis);
  double a = pw * pw - c2 * bt__dot (s->way, s->way), b = pa * pw - c2 * bt__dot (s->a, s->way);
  double c = pa * pa - c2 * bt__dot (s->a, s->a), d = b * b - a * c;
  for (int k = 0; k < 3; k++)
    {
      bt_vec3 p = segment_point (s, inside[k]);
      if (bt__dot (p, axis) >= bt__norm (p) * cosine)
        keep_nearer (s, inside[k], best);
    }
  if (a == 0 || d < 0)
    return;
  for (int k = -1; k <= 1; k += 2)
    {
      double t = (-b + k * sqrt (d)) / a;
      if (pa + t * pw > 0)
        keep_nearer (s, t, best);
    }
}

/* True if nothing solid is before the point P, seen from the head.  */
static int
is_heard (const bt__sonar *sonar, const bt__echoing *around, bt_vec3 p, bt__count *count)
{
  bt__ray ray = { sonar->head.origin, bt__unit_or (p, bt__vec (0, 1, 0)), bt__norm (p) };
  return first_solid (around, ray, count) == INFINITY;
}

void
bt__sonar_hear_line (const bt__sonar *sonar, const bt__echoing *around, const bt__capsule *line,
                     int beams, double *range, bt__count *count)
{
  seen_segment s = { bt__sub (line->a, sonar->head.origin), bt__sub (line->b, line->a) };
  double cosine = cos (sonar->width / 2);
  if (bt__norm (segment_point (&s, foot_of (&s))) - line->radius > sonar->range)
    return;
  for (int i = 0; i < beams; i++)
    {
      double reach = fmin (range[i], sonar->range) + line->radius;
      bt_vec3 best = { INFINITY, 0, 0 };
      nearest_in_cone (&s, beam (sonar, i, beams), cosine, &best);
      if (bt__norm (best) < reach && is_heard (sonar, around, best, count))
        range[i] = fmax (0, bt__norm (best) - line->radius);
    }
}

void
bt__sonar_add_noise (const bt__sonar *sonar, int64_t step, int beams, double *range)
{
  for (int i = 0; sonar->noise > 0 && i < beams; i++)
    if (isfinite (range[i]))
      range[i]
          = fmax (0, range[i] + sonar->noise * bt__noise (sonar->seed, step, FIRST_CHANNEL + i));
}
