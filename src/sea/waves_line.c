/* Waves at the nodes of a line: nodes near each other share a power series.

   Nodes follow each other along a line: a run of nodes lies within a small box in the plane of the
   waves' way and the vertical.  A run goes on while the series about the middle of the box
   (waves_series.h) is as accurate as was asked, in shares of the speed of all components together
   at the surface.  Half of the accuracy is for the terms left out, bounded by the reach of a level
   (bt__waves_reaches); a quarter for components left out at a depth, and a quarter for the share of
   the bottom in the components left out.

   Alone, a node is asked as bt_waves_motion asks; so are all where no accuracy is given, and where
   the components are no more than go side by side.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "sea/waves_line.h"
#include "math/vec.h"
#include "sea/waves_series.h"

#define LEVEL_FIRST 0.5 /* by the greatest wave number: the depth of the second level */
#define LEVEL_RATIO 1.5 /* of the depths of two levels that follow each other */
#define FEW 2           /* nodes that cost less alone */
#define TOGETHER 8      /* nodes that are added to a run at once */

/* k times the depth from which on a component does not count.  */
static double
felt_to (const bt_waves *w)
{
  return log (4 / w->accuracy);
}

/* ---- How far a series reaches ---- */

/* A bound on the terms left out of a series at 1 m from its centre, at DEPTH: twice the sum of the
   components' sizes by k^N / N!, of velocities (ORDER 0) or accelerations (1).  What the bottom
   adds to a component is no more than the component.  */
static double
rest_at_one (const bt_waves *w, double depth, int order)
{
  double sum = 0;
  for (int i = 0; i < w->n; i++)
    sum += w->speed[i] * pow (w->omega[i], order) * pow (w->k[i], BT__WAVES_ORDER)
           * exp (-w->k[i] * depth) * (w->bed[i] > 0 ? 2 : 1);
  return 2 * sum / tgamma (BT__WAVES_ORDER + 1);
}

static double
sum_at_surface (const bt_waves *w, int order)
{
  double sum = 0;
  for (int i = 0; i < w->n; i++)
    sum += w->speed[i] * pow (w->omega[i], order);
  return sum;
}

/* The distance from the centre within which a series holds for places of DEPTH or more.  Within k
   reach <= (N + 1) / 2 the terms left out are at most twice the first term left out.  */
static double
reach_at (const bt_waves *w, double depth)
{
  double felt = felt_to (w), least = w->k[0];
  for (int i = 0; i < w->n && w->k[i] * depth < felt; i++)
    least = w->k[i];
  double reach = 0.5 * (BT__WAVES_ORDER + 1) / least;
  for (int order = 0; order < 2; order++)
    {
      double asked = 0.5 * w->accuracy * sum_at_surface (w, order);
      double rest = rest_at_one (w, depth, order);
      if (rest > 1e-100 * asked)
        reach = fmin (reach, pow (asked / rest, 1.0 / BT__WAVES_ORDER));
    }
  return reach;
}

void
bt__waves_reaches (bt_waves *w)
{
  double depth = 0;
  for (int j = 0; w->accuracy > 0 && w->n > BT__FOUR && j < BT_WAVES_LEVELS; j++)
    {
      w->reach[j] = reach_at (w, depth);
      depth = j ? depth * LEVEL_RATIO : LEVEL_FIRST / w->k[w->n - 1];
    }
}

/* ---- Runs of nodes ---- */

/* The box about a run of nodes, and the level below which the whole run lies.  */
typedef struct run
{
  double low, top, back, front; /* m: heights, and ways along */
  double depth;                 /* m: of the level */
  int level;
} run;

static double
way_of (const bt_waves *w, bt_vec3 p)
{
  return w->east * p.x + w->north * p.y;
}

static double
height_of (const bt_waves *w, bt_vec3 p)
{
  return p.z < 0 ? bt__clamp (p.z, -w->depth, 0) : 0;
}

/* The N places P in the plane of the waves: way, height, and a number that is finite if P is.  */
static void
lay_out (const bt_waves *w, const bt_vec3 *p, size_t n, bt_vec3 *laid)
{
  for (size_t i = 0; i < n; i++)
    laid[i] = bt__vec (way_of (w, p[i]), height_of (w, p[i]), p[i].x + p[i].y + p[i].z);
}

static run
run_of_one (const bt_waves *w, bt_vec3 laid)
{
  double z = laid.y, way = laid.x, next = LEVEL_FIRST / w->k[w->n - 1];
  run r = { z, z, way, way, 0, 0 };
  while (r.level < BT_WAVES_LEVELS - 1 && -z >= next)
    {
      r.depth = next;
      next *= LEVEL_RATIO;
      r.level++;
    }
  return r;
}

/* R with COUNT places more.  */
static run
run_with (run r, const bt_vec3 *laid, size_t count)
{
  for (size_t i = 0; i < count; i++)
    {
      double z = laid[i].y, way = laid[i].x;
      r.low = z < r.low ? z : r.low;
      r.top = z > r.top ? z : r.top;
      r.back = way < r.back ? way : r.back;
      r.front = way > r.front ? way : r.front;
    }
  while (r.level > 0 && -r.top < r.depth)
    {
      r.level--;
      r.depth = r.level ? r.depth / LEVEL_RATIO : 0;
    }
  return r;
}

static int
is_within_reach (const bt_waves *w, const run *r)
{
  double high = r->top - r->low, wide = r->front - r->back, reach = 2 * w->reach[r->level];
  return high * high + wide * wide <= reach * reach;
}

static int
are_finite (const bt_vec3 *laid, size_t count)
{
  double sum = 0;
  for (size_t i = 0; i < count; i++)
    sum += laid[i].z;
  return isfinite (sum);
}

/* The number of the N places LAID, from the first on, with a common series in the box *R.  Places
   are added by TOGETHER at a time, then by half as many, and so on.  */
static size_t
run_from (const bt_waves *w, const bt_vec3 *laid, size_t n, run *r)
{
  size_t count = 1, more = TOGETHER;
  *r = run_of_one (w, laid[0]);
  if (!are_finite (laid, 1))
    return 1;
  while (count < n)
    {
      more = more < n - count ? more : n - count;
      run wider = run_with (*r, laid + count, more);
      if (is_within_reach (w, &wider) && are_finite (laid + count, more))
        {
          *r = wider;
          count += more;
        }
      else if (more > 1)
        more /= 2;
      else
        break;
    }
  return count;
}

/* VELOCITY has the places as they are laid out.  */
static BT__WIDE void
orbits_in_run (const bt_waves *w, const run *r, double felt, double t, size_t n, bt_vec3 *velocity,
               bt_vec3 *acceleration)
{
  bt__waves_centre at
      = { 0.5 * (r->back + r->front), 0.5 * (r->low + r->top), t, r->low, r->top, felt };
  bt__waves_terms terms;
  bt__waves_series s;
  bt__waves_terms_find (w, &at, &terms);
  bt__waves_series_make (&terms, &s);
  for (size_t i = 0; i < n; i++)
    {
      bt__orbit o = bt__waves_series_at (&s, velocity[i].y - at.z, velocity[i].x - at.way);
      velocity[i] = (bt_vec3){ o.along * w->east, o.along * w->north, o.up };
      acceleration[i] = (bt_vec3){ o.along2 * w->east, o.along2 * w->north, o.up2 };
    }
}

void
bt_waves_motions (const bt_waves *w, const bt_vec3 *p, size_t n, double t, bt_vec3 *velocity,
                  bt_vec3 *acceleration)
{
  int shared = w->accuracy > 0 && w->n > BT__FOUR && isfinite (t);
  double felt = shared ? felt_to (w) : 0;
  if (shared)
    lay_out (w, p, n, velocity);
  for (size_t i = 0, count; i < n; i += count)
    {
      run r;
      count = shared ? run_from (w, velocity + i, n - i, &r) : 1;
      if (count > FEW)
        orbits_in_run (w, &r, felt, t, count, velocity + i, acceleration + i);
      else
        for (size_t k = i; k < i + count; k++)
          bt_waves_motion (w, p[k], t, velocity + k, acceleration + k);
    }
}

/* ---- The surface ---- */

static BT__WIDE void
heights_in_run (const bt_waves *w, double middle, double t, const bt_vec3 *p, size_t n,
                double *height)
{
  double c[BT__WAVES_ORDER];
  bt__waves_height_make (w, middle, t, c);
  for (size_t i = 0; i < n; i++)
    height[i] = bt__waves_height_at (c, w->east * p[i].x + w->north * p[i].y - middle);
}

/* The number of the N places P, from the first on, with a common series of the surface about
   *MIDDLE.  The share of the surface left out is at most the share of the velocity left out: short
   waves lose most, and count more in the velocity.  */
static size_t
level_run (const bt_waves *w, const bt_vec3 *p, size_t n, double *middle)
{
  size_t count = 1;
  double back = way_of (w, p[0]), front = back;
  while (count < n)
    {
      double way = way_of (w, p[count]), low = way < back ? way : back;
      double high = way > front ? way : front;
      if (!(high - low <= 2 * w->reach[0]) || !isfinite (way))
        break;
      back = low;
      front = high;
      count++;
    }
  *middle = 0.5 * (back + front);
  return count;
}

void
bt__waves_elevations (const bt_waves *w, const bt_vec3 *p, size_t n, double t, double *height)
{
  int shared = w->accuracy > 0 && w->n > BT__FOUR && isfinite (t);
  for (size_t i = 0, count; i < n; i += count)
    {
      double middle = 0;
      count = shared ? level_run (w, p + i, n - i, &middle) : 1;
      if (count > FEW)
        heights_in_run (w, middle, t, p + i, count, height + i);
      else
        for (size_t k = i; k < i + count; k++)
          height[k] = bt_waves_elevation (w, p[k].x, p[k].y, t);
    }
}
