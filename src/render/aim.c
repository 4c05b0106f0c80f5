/* Cameras that aim themselves: directions by name, distances by what must be in the picture.

   The things to be seen are points (framing.c).  Without perspective the picture is the box around
   the points as seen along the chosen direction.  With perspective the camera is moved back, and
   up or down, until every point is inside: for a point q from the middle, right r, ahead f, tangent
   t to one side of the picture, the camera's axis shifted by s and back by d, q.r - s <= t (q.f +
   d).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/view.h>

#include "base/error.h"
#include "math/vec.h"
#include "render/framing.h"
#include "render/sight.h"

#define DEGREE (BT__PI / 180)

static const bt_vec3 east = { 1, 0, 0 }, north = { 0, 1, 0 }, above = { 0, 0, 1 };

const char *
bt_aim_name (bt_aim aim)
{
  static const char *const names[BT_AIM_COUNT]
      = { "chase", "pilot", "top", "side", "north", "east", "overview", "plan" };
  return (unsigned)aim < BT_AIM_COUNT ? names[aim] : NULL;
}

/* ---- Fitting ---- */

typedef struct fit
{
  bt_vec3 middle, axis[3];  /* right, up, ahead */
  double low[3], high[3];   /* extent along the axes */
  double side[2][2];        /* with perspective: tangents to the left and right, below and above */
  double least[2], most[2]; /* where the edges of the picture must be in the plane of the middle */
} fit;

static void
fit_point (void *user, bt_vec3 p)
{
  fit *f = user;
  bt_vec3 q = bt__sub (p, f->middle);
  double ahead = bt__dot (q, f->axis[2]);
  for (int i = 0; i < 3; i++)
    {
      double x = bt__dot (q, f->axis[i]);
      f->low[i] = fmin (f->low[i], x);
      f->high[i] = fmax (f->high[i], x);
      if (i == 2)
        continue;
      f->least[i] = fmin (f->least[i], x + f->side[i][0] * ahead);
      f->most[i] = fmax (f->most[i], x - f->side[i][1] * ahead);
    }
}

static void
fit_start (fit *f, bt_vec3 ahead, bt_vec3 up)
{
  f->axis[2] = bt__unit_or (ahead, north);
  f->axis[0] = bt__unit_or (bt__cross (f->axis[2], up), east);
  f->axis[1] = bt__cross (f->axis[0], f->axis[2]);
  for (int i = 0; i < 3; i++)
    f->low[i] = INFINITY, f->high[i] = -INFINITY;
  for (int i = 0; i < 2; i++)
    f->least[i] = INFINITY, f->most[i] = -INFINITY;
}

static void
centre (fit *f)
{
  for (int i = 0; i < 3; i++)
    f->middle = bt__axpy (f->middle, (f->low[i] + f->high[i]) / 2, f->axis[i]);
}

/* The share of the picture around the things to be seen: all round; above and below in a level
   view, where titles and depths stand; and above in one with perspective, under the title.  */
#define MARGIN 1.16
#define HEADROOM 1.36
#define UNDER_TITLE 1.26

static void
aim_level (bt_view *view, bt_vec3 ahead, bt_vec3 up, double aspect)
{
  fit f = { .middle = { 0, 0, 0 } };
  double width, height;
  fit_start (&f, ahead, up);
  bt__framed_points (view, fit_point, &f);
  centre (&f);
  width = f.high[0] - f.low[0];
  height = f.high[1] - f.low[1];
  view->camera = (bt_camera){ .at = f.middle, .up = f.axis[1] };
  view->camera.height = fmax (fmax (HEADROOM * height, MARGIN * width / aspect), 1);
  view->camera.from = bt__axpy (f.middle, -fmax (1, (f.high[2] - f.low[2]) / 2 + 0.5), f.axis[2]);
}

/* Of a camera BACK behind the middle, the picture's edges in the plane of the middle are at -side
   [0] * back and side[1] * back of the camera's axis.  Up and down the axis may be shifted: the
   picture spans least to most if back is at least their distance by the sum of the tangents.  */
static void
aim_perspective (bt_view *view, bt_vec3 ahead, double angle, double aspect)
{
  double half = tan (angle / 2), back = 1.5, wide = half * aspect / MARGIN, low, high;
  fit f = { .side = { { wide, wide }, { half / MARGIN, half / UNDER_TITLE } } };
  fit_start (&f, ahead, above);
  bt__framed_points (view, fit_point, &f);
  centre (&f);
  fit_start (&f, ahead, above);
  bt__framed_points (view, fit_point, &f);
  back = fmax (back, fmax (f.most[0], -f.least[0]) / wide);
  back = fmax (back, (f.most[1] - f.least[1]) / (f.side[1][0] + f.side[1][1]));
  low = f.least[1] + f.side[1][0] * back;
  high = f.most[1] - f.side[1][1] * back;
  f.middle = bt__axpy (f.middle, (low + high) / 2, f.axis[1]);
  view->camera = (bt_camera){ .at = f.middle, .up = above, .angle = angle };
  view->camera.from = bt__axpy (f.middle, -back, f.axis[2]);
}

/* ---- Directions ---- */

static const bt_thing *
first_of (const bt_view *view, bt_thing_kind kind)
{
  for (size_t i = 0; i < view->n; i++)
    if (view->things[i].kind == kind)
      return &view->things[i];
  return NULL;
}

static bt_vec3
level_part (bt_vec3 v, bt_vec3 fallback)
{
  return bt__unit_or (bt__vec (v.x, v.y, 0), fallback);
}

/* Level and across the first tube: the tube bulges most clearly in the direction of least spread of
   its points.  */
static bt_vec3
across (const bt_view *view)
{
  const bt_thing *t = first_of (view, BT_THING_TUBE);
  double xx = 0, xy = 0, yy = 0, angle;
  bt_vec3 mean = { 0, 0, 0 }, d;
  if (!t || t->n < 2)
    return north;
  for (size_t i = 0; i < t->n; i++)
    mean = bt__axpy (mean, 1.0 / (double)t->n, t->points[i]);
  for (size_t i = 0; i < t->n; i++)
    {
      d = bt__sub (t->points[i], mean);
      xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    }
  if (hypot (xx - yy, 2 * xy) <= 1e-9 * (xx + yy))
    return north;
  angle = atan2 (2 * xy, xx - yy) / 2; /* of the longest extent, from east */
  d = bt__vec (-sin (angle), cos (angle), 0);
  return d.y < -1e-9 || (fabs (d.y) <= 1e-9 && d.x < 0) ? bt__scale (-1, d) : d;
}

/* The share of tubes and vehicles in sight of the camera.  */
static double
share_seen (const bt_view *view)
{
  enum
  {
    SPOTS = 12 /* of a tube; the weight of a vehicle */
  };
  int all = 0, seen = 0;
  for (size_t i = 0; i < view->n; i++)
    {
      const bt_thing *t = &view->things[i];
      int tube = t->kind == BT_THING_TUBE && t->n > 0;
      if (t->framing != BT_FRAME_MUST || (!tube && t->kind != BT_THING_VEHICLE))
        continue;
      for (int k = 0; k < (tube ? SPOTS : 1); k++)
        {
          bt_vec3 p = tube ? t->points[(t->n - 1) * (size_t)k / (SPOTS - 1)] : t->at;
          int weight = tube ? 1 : SPOTS;
          all += weight;
          seen += bt__hidden (view, view->camera.from, p) ? 0 : weight;
        }
    }
  return all ? (double)seen / all : 1;
}

static void
aim_about (bt_view *view, double turn, double dip, double aspect)
{
  bt_vec3 a = across (view);
  bt_vec3 level
      = bt__vec (a.x * cos (turn) + a.y * sin (turn), a.y * cos (turn) - a.x * sin (turn), 0);
  bt_vec3 ahead = bt__axpy (bt__scale (cos (dip), level), -sin (dip), above);
  aim_perspective (view, ahead, 42 * DEGREE, aspect);
}

/* From above and aside: across the tube, a little turned.  Where solids such as ice hide most of
   the dive, the first direction with most of the dive in sight, or else the best direction.
   Between the two shares the camera stays: a film does not jump.  */
static void
aim_overview (bt_view *view, double aspect)
{
  static const double dips[] = { 24, 4, -14, 55 }, least = 0.4, enough = 0.7;
  double best, best_turn = 28 * DEGREE, best_dip = 24 * DEGREE;
  aim_about (view, best_turn, best_dip, aspect);
  best = share_seen (view);
  if (best >= least)
    return;
  for (size_t d = 0; d < sizeof dips / sizeof *dips && best < enough; d++)
    for (int k = 0; k < 4 && best < enough; k++)
      {
        double turn = (28 + 90 * k) * DEGREE, dip = dips[d] * DEGREE, share;
        aim_about (view, turn, dip, aspect);
        share = share_seen (view);
        if (share > best + 1e-9)
          best = share, best_turn = turn, best_dip = dip;
      }
  aim_about (view, best_turn, best_dip, aspect);
}

static void
aim_chase (bt_view *view, const bt_thing *rov)
{
  bt_vec3 ahead = level_part (bt__vec (sin (rov->heading), cos (rov->heading), 0), north);
  double d = 4 * rov->size.y;
  view->camera = (bt_camera){ .up = above, .angle = 55 * DEGREE };
  view->camera.from = bt__axpy (bt__axpy (rov->at, -d, ahead), 0.42 * d, above);
  view->camera.from = bt__axpy (view->camera.from, 0.22 * d, bt__cross (ahead, above));
  view->camera.at = bt__axpy (rov->at, 0.35 * d, ahead);
}

static void
aim_pilot (bt_view *view, const bt_thing *rov)
{
  bt_vec3 axis[3];
  bt_body_axes (rov->heading, rov->pitch, rov->roll, axis);
  view->camera = (bt_camera){ .up = axis[2], .angle = 64 * DEGREE };
  view->camera.from = bt__axpy (rov->at, 0.52 * rov->size.y, axis[1]);
  view->camera.at = bt__axpy (view->camera.from, 6, axis[1]);
  view->ghost = 0;
  view->lamp = fmax (view->lamp, 0.8);
}

static bt_status
aim_by_vehicle (bt_view *view, bt_aim aim, bt_error *error)
{
  const bt_thing *rov = first_of (view, BT_THING_VEHICLE);
  if (!rov)
    return bt__fail (
        error, BT_ERR_DEF,
        "the view %s is a vehicle's, and this dive has none: give its world one, as in "
        "(rov (named minnow) (at 0 0 -5)), or choose another view",
        bt_aim_name (aim));
  (aim == BT_AIM_CHASE ? aim_chase : aim_pilot) (view, rov);
  return BT_OK;
}

bt_status
bt_view_aim (bt_view *view, bt_aim aim, double aspect, bt_error *error)
{
  if (!bt_aim_name (aim))
    return bt__fail (error, BT_ERR_NAME, "there is no view number %d", (int)aim);
  if (aim == BT_AIM_CHASE || aim == BT_AIM_PILOT)
    return aim_by_vehicle (view, aim, error);
  if (!bt__frames_any (view))
    bt__frame_obstacles (view);
  if (!bt__frames_any (view))
    return bt__fail (error, BT_ERR_DEF,
                     "there is nothing to look at: no vehicle, no tether and no obstacle");
  if (aim == BT_AIM_TOP) /* a high sun: shadows fall near their objects */
    view->sun = bt__unit_or (bt__vec (0.1, -0.08, 1), above);
  if (aim == BT_AIM_OVERVIEW)
    aim_overview (view, aspect);
  else if (aim == BT_AIM_TOP || aim == BT_AIM_PLAN)
    aim_level (view, bt__vec (0, 0, -1), north, aspect);
  else
    aim_level (view,
               aim == BT_AIM_NORTH  ? north
               : aim == BT_AIM_EAST ? east
                                    : across (view),
               above, aspect);
  return BT_OK;
}

bt_status
bt_view_look (bt_view *view, bt_vec3 from, bt_vec3 at, bt_error *error)
{
  bt_vec3 way = bt__sub (at, from);
  if (!bt__is_finite (from) || !bt__is_finite (at) || bt__norm (way) < 1e-6)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a camera looks from one point at another, not at itself");
  view->camera = (bt_camera){ .from = from, .at = at, .up = above, .angle = 50 * DEGREE };
  if (hypot (way.x, way.y) < 1e-6 * bt__norm (way))
    view->camera.up = north;
  return BT_OK;
}

bt_status
bt_view_move (bt_view *view, const bt_vec3 *at, double extent, double zoom, double aspect,
              bt_error *error)
{
  bt_camera *c = &view->camera;
  bt_vec3 way = bt__sub (c->from, c->at);
  double across = 2 * tan (c->angle / 2) * aspect * bt__norm (way), factor = 1 / zoom;
  if (!(zoom > 0) || !(extent >= 0) || !isfinite (zoom) || !isfinite (extent)
      || (at && !bt__is_finite (*at)))
    return bt__fail (error, BT_ERR_DOMAIN, "a camera moves to a point, nearer by a number above 0");
  if (c->angle <= 0)
    across = c->height * aspect;
  if (extent > 0)
    factor *= extent / across;
  c->at = at ? *at : c->at;
  c->height *= factor;
  c->from = bt__axpy (c->at, c->angle > 0 ? factor : 1, way);
  return BT_OK;
}

bt_status
bt_view_turn (bt_view *view, double turn, double dip, bt_error *error)
{
  const double steepest = 85 * DEGREE;
  bt_camera *c = &view->camera;
  bt_vec3 way = bt__sub (c->from, c->at);
  double far = bt__norm (way), along, up;
  if (!isfinite (turn) || !isfinite (dip) || !(far > 0))
    return bt__fail (error, BT_ERR_DOMAIN, "a camera turns by angles, not by %g and %g", turn, dip);
  along = atan2 (way.x, way.y) + turn;
  up = fmin (fmax (asin (way.z / far) + dip, -steepest), steepest);
  c->from
      = bt__axpy (c->at, far, bt__vec (sin (along) * cos (up), cos (along) * cos (up), sin (up)));
  c->up = above;
  return BT_OK;
}
