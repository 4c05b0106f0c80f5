/* See skip_scenes.h.

   A vehicle without mass on a moving line of 100 intervals in still water.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "testbed/skip_scenes.h"
#include "math/vec.h"

#define LENGTH 40.0

static const bt_vec3 anchor = { -1, -12, 0 }, start = { 0, 12, -20 };

/* A line that sinks: one that floats comes to the surface.  */
static bt_tether_def *
add_line (scene *s, bt_vec3 from)
{
  bt_tether_def *line = scene_line (s, from, LENGTH, SKIP_NODES);
  line->props.mass = 0.05;
  return line;
}

static bt_tether_def *
add_bare (scene *s)
{
  scene_clear (s);
  scene_vehicle (s, start);
  return add_line (s, anchor);
}

static void
draw_bare (scene *s)
{
  add_bare (s);
}

static void
draw_vehicle_alone (scene *s)
{
  add_bare (s);
  s->world.n_tethers = 0;
}

static void
draw_current (scene *s)
{
  add_bare (s);
  scene_current (s, bt__vec (0.3, 0, 0));
}

static void
draw_waves (scene *s)
{
  add_bare (s);
  scene_waves (s);
}

static void
draw_far (scene *s)
{
  add_bare (s);
  scene_bar (s, bt__vec (500, 0, -30), bt__vec (500, 0, 0), 1);
}

static void
draw_many_far (scene *s)
{
  add_bare (s);
  for (int i = 0; i < SCENE_BARS; i++)
    scene_bar (s, bt__vec (500 + 10 * i, 0, -30), bt__vec (500 + 10 * i, 0, 0), 1);
}

/* Beside the line, out of its reach.  */
static void
draw_near (scene *s)
{
  add_bare (s);
  scene_bar (s, bt__vec (-8, 0, -40), bt__vec (-8, 0, 0), 0.5);
}

/* A heavy line hangs over a level bar.  */
static void
draw_touched (scene *s)
{
  add_bare (s)->props.mass = 0.06;
  scene_bar (s, bt__vec (-20, 0, -14), bt__vec (20, 0, -14), 0.5);
}

static void
draw_lee (scene *s)
{
  draw_near (s);
  scene_current (s, bt__vec (0.3, 0, 0));
  s->world.sea.wake = 1;
}

static void
draw_body (scene *s)
{
  bt_error error;
  add_bare (s);
  scene_must (bt_def_set_vehicle_type (s->vehicle, "bluerov2-heavy", &error), &error);
}

static void
draw_two (scene *s)
{
  add_bare (s);
  scene_vehicle (s, bt__add (start, bt__vec (200, 0, 0)));
  add_line (s, bt__add (anchor, bt__vec (200, 0, 0)));
}

static void
draw_catenary (scene *s)
{
  add_bare (s)->props.model = BT_MODEL_CATENARY;
}

const skip_case skip_cases[SKIP_CASES] = {
  { "bare", draw_bare, 1, PART_MOVING_LINE, 0 },
  { "without line", draw_vehicle_alone, 1, 0, 0 },
  { "and a current", draw_current, 1, PART_MOVING_LINE, 0 },
  { "and waves", draw_waves, 1, PART_MOVING_LINE | PART_WAVES, 0 },
  { "and an obstacle 500 m away", draw_far, 1, PART_MOVING_LINE | PART_OBSTACLES, 0 },
  { "and 64 obstacles so far", draw_many_far, 1, PART_MOVING_LINE | PART_OBSTACLES, 0 },
  { "and an obstacle beside it", draw_near, 1, PART_MOVING_LINE | PART_OBSTACLES, 0 },
  { "and a bar it lies on", draw_touched, 1, PART_MOVING_LINE | PART_OBSTACLES, 0 },
  { "and a current with a lee", draw_lee, 1, PART_MOVING_LINE | PART_OBSTACLES | PART_LEE, 0 },
  { "and mass of the vehicle", draw_body, 1, PART_MOVING_LINE | PART_BODY, 0 },
  { "asleep", draw_bare, 0, PART_MOVING_LINE, 1 },
  { "and a second line", draw_two, 2, PART_MOVING_LINE, 0 },
  { "and a second line asleep", draw_two, 1, PART_MOVING_LINE, 1 },
  { "catenary", draw_catenary, 1, PART_STATIC_LINE, 0 },
  { "catenary, vehicle still", draw_catenary, 0, PART_STATIC_LINE, 0 },
};

bt_dive *
skip_begin (const skip_case *c, int warm)
{
  static scene s;
  bt_tether_view view = { 0 };
  bt_error error;
  c->draw (&s);
  bt_dive *dive = scene_begin (&s.world);
  for (int i = 0; i < 600 && c->asleep && !view.asleep; i++)
    {
      scene_run (dive, 60);
      scene_must (bt_dive_tether (dive, bt_dive_count (dive, BT_PART_TETHER) - 1, &view, &error),
                  &error);
    }
  scene_fly (dive, c->flown, 0, warm);
  return dive;
}

uint64_t
skip_stray_work (const bt_dive *dive, const skip_case *c)
{
  bt_profile p;
  bt_dive_profile (dive, &p);
  return part_work (&p, PART_ALL & ~c->parts);
}
