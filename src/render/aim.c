/* Cameras that aim themselves: directions by name, distances by what must be in the picture.

   The things to be seen are gathered as points.  Without perspective the picture is the box around
   the points as seen along the chosen direction.  With perspective the camera is moved back until
   every point is inside: for a point q from the middle, right r, ahead f, half angle a, to |q.r| /
   tan (a) - q.f behind the middle.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/view.h>

#include "base/error.h"
#include "math/vec.h"
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

/* ---- What must be seen ---- */

typedef void visit_point (void *user, bt_vec3 p);

static void
visit_ball (bt_vec3 p, double r, visit_point *visit, void *user)
{
  for (int i = 0; i < 8; i++)
    visit (user, bt__add (p, bt__vec (i & 1 ? r : -r, i & 2 ? r : -r, i & 4 ? r : -r)));
}

static void
visit_box (const bt_thing *t, bt_vec3 size, visit_point *visit, void *user)
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
visit_points (const bt_thing *t, visit_point *visit, void *user)
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
visit_thing (const bt_thing *t, visit_point *visit, void *user)
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
  visit_point *visit;
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

static void
visit_all (const bt_view *view, visit_point *visit, void *user)
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

/* ---- Fitting ---- */

typedef struct fit
{
  bt_vec3 middle, axis[3]; /* right, up, ahead */
  double tangent[2];       /* of half the picture's angles; 0: no perspective */
  double low[3], high[3];  /* without perspective: extent along the axes */
  double back;             /* with: how far back of the middle */
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
      if (i < 2 && f->tangent[i] > 0)
        f->back = fmax (f->back, fabs (x) / f->tangent[i] - ahead);
    }
}

static void
fit_start (fit *f, bt_vec3 ahead, bt_vec3 up)
{
  f->axis[2] = bt__unit_or (ahead, north);
  f->axis[0] = bt__unit_or (bt__cross (f->axis[2], up), east);
  f->axis[1] = bt__cross (f->axis[0], f->axis[2]);
  f->back = 0.1;
  for (int i = 0; i < 3; i++)
    f->low[i] = INFINITY, f->high[i] = -INFINITY;
}

static void
centre (fit *f)
{
  for (int i = 0; i < 3; i++)
    f->middle = bt__axpy (f->middle, (f->low[i] + f->high[i]) / 2, f->axis[i]);
}

/* The share of the picture around the things to be seen: all round, and above and below in a level
   view, where the titles stand.  */
#define MARGIN 1.16
#define HEADROOM 1.36

static void
aim_level (bt_view *view, bt_vec3 ahead, bt_vec3 up, double aspect)
{
  fit f = { .middle = { 0, 0, 0 } };
  double width, height;
  fit_start (&f, ahead, up);
  visit_all (view, fit_point, &f);
  centre (&f);
  width = f.high[0] - f.low[0];
  height = f.high[1] - f.low[1];
  view->camera = (bt_camera){ .at = f.middle, .up = f.axis[1] };
  view->camera.height = fmax (fmax (HEADROOM * height, MARGIN * width / aspect), 1);
  view->camera.from = bt__axpy (f.middle, -fmax (1, (f.high[2] - f.low[2]) / 2 + 0.5), f.axis[2]);
}

static void
aim_perspective (bt_view *view, bt_vec3 ahead, double angle, double aspect)
{
  fit f = { .middle = { 0, 0, 0 } };
  fit_start (&f, ahead, above);
  visit_all (view, fit_point, &f);
  centre (&f);
  fit_start (&f, ahead, above);
  f.tangent[1] = tan (angle / 2) / MARGIN;
  f.tangent[0] = f.tangent[1] * aspect;
  visit_all (view, fit_point, &f);
  view->camera = (bt_camera){ .at = f.middle, .up = above, .angle = angle };
  view->camera.from = bt__axpy (f.middle, -fmax (f.back, 1.5), f.axis[2]);
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
    return bt__fail (error, BT_ERR_DEF, "the view %s is a vehicle's, and this dive has none: give its world one, as in "
                     "(rov (named minnow) (at 0 0 -5)), or choose another view",
                     bt_aim_name (aim));
  (aim == BT_AIM_CHASE ? aim_chase : aim_pilot) (view, rov);
  return BT_OK;
}

/* Let obstacles be what must be seen, in a view without vehicle and tether.  */
static void
frame_obstacles (bt_view *view)
{
  for (size_t i = 0; i < view->n; i++)
    if (view->things[i].framing == BT_FRAME_NEAR && view->things[i].kind != BT_THING_ARROW)
      view->things[i].framing = BT_FRAME_MUST;
}

bt_status
bt_view_aim (bt_view *view, bt_aim aim, double aspect, bt_error *error)
{
  if (!bt_aim_name (aim))
    return bt__fail (error, BT_ERR_NAME, "there is no view number %d", (int)aim);
  if (aim == BT_AIM_CHASE || aim == BT_AIM_PILOT)
    return aim_by_vehicle (view, aim, error);
  if (!must_box (view).any)
    frame_obstacles (view);
  if (!must_box (view).any)
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
  c->from = bt__axpy (
      c->at, far, bt__vec (sin (along) * cos (up), cos (along) * cos (up), sin (up)));
  c->up = above;
  return BT_OK;
}
