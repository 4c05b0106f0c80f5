/* The view of a dive: the sea, vehicles, anchors, the current; tethers and obstacles have files of
   their own.  Uses the public face of the engine alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"
#include "render/scene.h"

const char *
bt__paint_name (bt__paint paint)
{
  static const char *const names[BT__PAINTS] = { "plain", "tension", "curvature", "model" };
  return (unsigned)paint < BT__PAINTS ? names[paint] : NULL;
}

void
bt__scene_add (bt__scene *s, const bt_thing *thing)
{
  if (s->status == BT_OK)
    s->status = bt_view_add (s->view, thing, s->error);
}

/* ---- Vehicles ---- */

static bt_vehicle_view
vehicle_of (bt__scene *s, int i)
{
  bt_vehicle_view v = { .position = { 0, 0, 0 } };
  if (s->status == BT_OK)
    s->status = bt_dive_vehicle (s->dive, i, &v, s->error);
  return v;
}

/* Breadth, length and height of a BlueROV2 in its heavy configuration, m: of a vehicle without a
   size of its own.  */
static const bt_vec3 usual_size = { 0.575, 0.457, 0.254 };

static bt_thing
vehicle_thing (bt__scene *s, int i)
{
  bt_vehicle_view v = vehicle_of (s, i);
  bt_thing t = bt_thing_of (BT_THING_VEHICLE);
  t.at = v.position;
  t.heading = v.heading;
  t.pitch = v.pitch;
  t.roll = v.roll;
  t.size = v.size.y > 0 ? v.size : usual_size;
  t.framing = BT_FRAME_MUST;
  return t;
}

static void
add_vehicles (bt__scene *s)
{
  int n = bt_dive_count (s->dive, BT_PART_VEHICLE);
  for (int i = 0; i < n; i++)
    {
      bt_thing t = vehicle_thing (s, i);
      t.text = n > 1 ? bt_dive_name (s->dive, BT_PART_VEHICLE, i) : NULL;
      bt__scene_add (s, &t);
    }
}

/* ---- What tethers come from ---- */

/* True if a boat of LENGTH at AT would be in an obstacle: under ice, or inside a jacket.  */
static int
is_built_over (bt__scene *s, bt_vec3 at, double length)
{
  int n = bt_dive_count (s->dive, BT_PART_OBSTACLE), found = 0;
  double r = length / 2;
  for (int i = 0; i < n && !found; i++)
    {
      bt_obstacle_view o;
      found = bt_dive_obstacle (s->dive, i, &o, NULL) == BT_OK && o.kind != BT_OBSTACLE_SEABED
              && at.x + r > o.low.x && at.x - r < o.high.x && at.y + r > o.low.y
              && at.y - r < o.high.y && o.high.z > -1 && o.low.z < 1;
    }
  return found;
}

/* Add a boat with the stern over the tether's end and the bow turned away; return false without
   room.  */
static int
add_boat (bt__scene *s, bt_vec3 end, bt_vec3 middle)
{
  bt_thing t = bt_thing_of (BT_THING_SHIP), line = bt_thing_of (BT_THING_LINES);
  bt_vec3 away = bt__unit_or (bt__vec (end.x - middle.x, end.y - middle.y, 0), bt__vec (0, 1, 0));
  bt_vec3 drop[2] = { { end.x, end.y, 0.3 }, end };
  t.size.y = fmin (fmax (0.13 * bt__distance (s->low, s->high), 2.5), 9);
  t.at = bt__axpy (bt__vec (end.x, end.y, 0), 0.52 * t.size.y, away);
  t.heading = atan2 (away.x, away.y);
  t.framing = BT_FRAME_MUST;
  if (is_built_over (s, t.at, t.size.y))
    return 0;
  bt__scene_add (s, &t);
  line.points = drop;
  line.n = 2;
  line.radius = 0.01;
  line.color = (bt_color){ 0.45F, 0.47F, 0.5F };
  bt__scene_add (s, &line);
  return 1;
}

static void
add_anchor (bt__scene *s, bt_vec3 end)
{
  bt_thing t = bt_thing_of (BT_THING_ANCHOR);
  t.at = end;
  t.size.y = fmin (fmax (0.03 * bt__distance (s->low, s->high), 0.06), 0.6);
  t.framing = BT_FRAME_MUST;
  bt__scene_add (s, &t);
}

/* A tether that begins just below the surface of deep water hangs from a boat.  */
static void
add_anchors (bt__scene *s)
{
  bt_vec3 middle = bt__scale (0.5, bt__add (s->low, s->high));
  for (int i = 0; s->status == BT_OK && i < bt_dive_count (s->dive, BT_PART_TETHER); i++)
    {
      bt_vec3 end;
      s->status = bt_tether_point (s->dive, i, 0, &end, s->error);
      if (s->status != BT_OK)
        return;
      if (!(end.z > -4 && s->sea.depth > 8 && add_boat (s, end, middle)))
        add_anchor (s, end);
    }
}

/* ---- The current ---- */

enum
{
  ARROWS = 5
};

static bt_vec3
current_at (bt__scene *s, bt_vec3 p)
{
  bt_vec3 v = { 0, 0, 0 };
  if (s->status == BT_OK)
    s->status = bt_dive_current_at (s->dive, p, &v, s->error);
  return v;
}

static void
add_current_arrow (bt__scene *s, bt_vec3 at, bt_vec3 v, double metres, int told)
{
  bt_thing t = bt_thing_of (BT_THING_ARROW);
  char text[40];
  t.to = at;
  t.from = bt__axpy (at, -metres, v);
  t.framing = BT_FRAME_NEAR;
  snprintf (text, sizeof text, "%.2f m/s", bt__norm (v));
  t.text = told ? text : NULL;
  bt__scene_add (s, &t);
}

/* A column of arrows up-current of the tethers, as long as the water is fast; the fastest says how
   fast.  */
static void
add_current (bt__scene *s)
{
  bt_vec3 middle = bt__scale (0.5, bt__add (s->low, s->high)), v[ARROWS], at[ARROWS], upstream;
  double span = fmax (bt__distance (s->low, s->high), 2), most = 0;
  double reach, top, bottom;
  int n = s->high.z - s->low.z < 0.05 * span ? 1 : ARROWS, fastest = 0;
  top = fmin (s->high.z, -0.02 * span);
  bottom = fmin (s->low.z, top);
  upstream = bt__unit_or (current_at (s, middle), bt__vec (0, 0, 0));
  reach = 0.04 * span
          + 0.5
                * (fabs (upstream.x) * (s->high.x - s->low.x)
                   + fabs (upstream.y) * (s->high.y - s->low.y));
  for (int i = 0; i < n; i++)
    {
      at[i] = bt__axpy (middle, -reach, upstream);
      at[i].z = n == 1 ? middle.z : top + (bottom - top) * i / (n - 1);
      v[i] = current_at (s, at[i]);
      if (bt__norm (v[i]) > most)
        most = bt__norm (v[i]), fastest = i;
    }
  for (int i = 0; i < n; i++)
    if (bt__norm (v[i]) > 0.02 * most && most > 1e-3)
      add_current_arrow (s, at[i], v[i], 0.14 * span / most, i == fastest);
}

/* ---- Words ---- */

static void
add_note (bt__scene *s)
{
  char text[160];
  int n = snprintf (text, sizeof text, "t = %.1f s", bt_dive_time (s->dive));
  if (bt_dive_count (s->dive, BT_PART_VEHICLE) > 0)
    {
      bt_vehicle_view v = vehicle_of (s, 0);
      n += snprintf (text + n, sizeof text - (size_t)n, "   depth %.1f m   heading %03d\xc2\xb0",
                     -v.position.z + 0.0, (int)lround (v.heading * 180 / BT__PI) % 360);
    }
  if (bt_dive_count (s->dive, BT_PART_TETHER) == 1)
    {
      bt_tether_view t;
      if (bt_dive_tether (s->dive, 0, &t, NULL) == BT_OK)
        snprintf (text + n, sizeof text - (size_t)n, "   tether %.1f m   tension %.3g N", t.length,
                  t.tension_max < 5e-4 ? 0.0 : t.tension_max); /* a slack line's rounding is none */
    }
  s->view->note = bt_view_text (s->view, text);
}

/* ---- Another fate ---- */

static void
add_pale_tether (bt__scene *s, int i)
{
  bt_thing line = bt_thing_of (BT_THING_TUBE);
  bt_tether_view t = { .nodes = 0 };
  bt_vec3 *points;
  s->status = bt_dive_tether (s->dive, i, &t, s->error);
  points = s->status == BT_OK ? calloc ((size_t)t.nodes, sizeof *points) : NULL;
  if (!points)
    return;
  s->status = bt_tether_points (s->dive, i, 0, points, s->error);
  line.points = points;
  line.n = (size_t)t.nodes;
  line.radius = t.props.diameter / 2;
  line.color = (bt_color){ 0.72F, 0.92F, 1 };
  bt__scene_add (s, &line);
  free (points);
}

bt_status
bt__scene_ghost (const bt_dive *dive, bt_view *view, bt_error *error)
{
  bt__scene s = { .dive = dive, .view = view, .status = BT_OK, .error = error };
  for (int i = 0; s.status == BT_OK && i < bt_dive_count (dive, BT_PART_TETHER); i++)
    add_pale_tether (&s, i);
  for (int i = 0; s.status == BT_OK && i < bt_dive_count (dive, BT_PART_VEHICLE); i++)
    {
      bt_thing t = vehicle_thing (&s, i);
      t.framing = BT_FRAME_NOT;
      bt__scene_add (&s, &t);
    }
  return s.status;
}

/* ---- The whole ---- */

bt_status
bt__scene_of_dive (const bt_dive *dive, const bt__show *show, bt_view *view, bt_error *error)
{
  bt__scene s = { .dive = dive, .view = view, .show = *show, .status = BT_OK, .error = error };
  bt_dive_sea (dive, &s.sea);
  view->time = bt_dive_time (dive);
  bt__scene_obstacles (&s);
  bt__scene_tethers (&s);
  add_vehicles (&s);
  if (s.any)
    {
      add_anchors (&s);
      if (show->more & BT__SHOW_FLOW)
        bt__scene_flow (&s);
      else
        add_current (&s);
    }
  bt__scene_more (&s);
  if (s.status == BT_OK)
    add_note (&s);
  free (s.points);
  free (s.values);
  return s.status;
}
