/* bight-bench-render: what pictures cost, as CSV rows.

   A pier of ten piles with a vehicle and its tether, made by hand: the first picture of a process,
   which compiles the shaders; a still of 1280 by 720 at 2 x 2 samples, without PNG; a frame of a
   film, 640 by 360 at as many samples; a frame of the live view, 120 by 40 characters, from the
   view's things to the bytes for a terminal, while the vehicle swims.  Times are CPU, of all
   threads.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "testbed/calibration.h"
#include "math/vec.h"
#include "options.h"
#include "pilot/screen.h"
#include "render/render.h"
#include "row.h"

enum
{
  COLUMNS = 120,
  ROWS = 40,
  PICTURES_MAX = 1000,
  NODES = 81
};

typedef struct bench
{
  bench_table table;
  long stills, frames;
  bt__renderer *renderer;
} bench;

static void
fail (const bt_error *error)
{
  fprintf (stderr, "bight-bench-render: %s\n", error->text);
  exit (1);
}

static void
check (bt_status status, const bt_error *error)
{
  if (status != BT_OK)
    fail (error);
}

static void
row (bench *b, const char *name, const char *setting, double seconds, const char *counters)
{
  bench_put (&b->table,
             &(bench_row){ name, "render", setting, "cpu", NAN, NULL, 0, seconds, counters });
}

/* ---- The pier ---- */

static void
add (bt_view *view, const bt_thing *thing)
{
  bt_error error;
  check (bt_view_add (view, thing, &error), &error);
}

static void
add_pier (bt_view *view)
{
  bt_thing ground = bt_thing_of (BT_THING_LEVEL), deck = bt_thing_of (BT_THING_BOX);
  ground.at.z = -9;
  ground.color = (bt_color){ 0.72F, 0.66F, 0.5F };
  add (view, &ground);
  for (int i = 0; i < 10; i++)
    {
      bt_thing pile = bt_thing_of (BT_THING_CYLINDER);
      pile.from = bt__vec (4 * (i % 2), 4 * (i / 2), 1);
      pile.to = bt__vec (4 * (i % 2), 4 * (i / 2), -9);
      pile.radius = 0.3;
      pile.framing = BT_FRAME_NEAR;
      add (view, &pile);
    }
  deck.at = bt__vec (2, 8, 1.2);
  deck.size = bt__vec (6, 20, 0.4);
  add (view, &deck);
}

/* The vehicle swims along a circle, the tether sags behind it.  */
static void
add_dive (bt_view *view, double t)
{
  bt_thing rov = bt_thing_of (BT_THING_VEHICLE), line = bt_thing_of (BT_THING_TUBE);
  bt_vec3 points[NODES], from = { -2, -14, -1 };
  rov.at = bt__vec (6 * sin (0.1 * t), -8 + 3 * cos (0.1 * t), -4);
  rov.heading = 0.1 * t + BT__PI / 2;
  rov.size = bt__vec (0.575, 0.457, 0.254);
  rov.framing = BT_FRAME_MUST;
  add (view, &rov);
  for (int i = 0; i < NODES; i++)
    {
      double s = (double)i / (NODES - 1);
      points[i] = bt__axpy (bt__scale (1 - s, from), s, rov.at);
      points[i].z -= 6 * s * (1 - s);
    }
  line.points = points;
  line.n = NODES;
  line.radius = 0.004;
  line.color = (bt_color){ 1, 0.8F, 0.1F };
  line.framing = BT_FRAME_MUST;
  add (view, &line);
}

static bt_view *
new_view (double t, bt_aim aim, double aspect)
{
  bt_view *view;
  bt_error error;
  check (bt_view_new (&view, &error), &error);
  view->time = t;
  add_pier (view);
  add_dive (view, t);
  check (bt_view_aim (view, aim, aspect, &error), &error);
  return view;
}

/* ---- What is measured ---- */

/* Draw once and return the CPU seconds.  */
static double
draw (const bench *b, const bt_view *view, const bt__drawing *drawing, bt__picture *picture)
{
  bt_error error;
  double begun = bench_now ();
  check (bt__render (b->renderer, view, drawing, picture, &error), &error);
  return bench_now () - begun;
}

static void
measure_stills (bench *b, const char *name, int width, bt_aim aim)
{
  const bt__drawing still = { .width = width, .height = width * 9 / 16, .samples = 2 };
  double x[PICTURES_MAX];
  char setting[60];
  for (int i = 0; i < b->stills; i++)
    {
      bt_view *view = new_view (i, aim, 16.0 / 9);
      bt__picture picture;
      x[i] = draw (b, view, &still, &picture);
      bt__picture_free (&picture);
      bt_view_free (view);
    }
  snprintf (setting, sizeof setting, "view=%s", bt_aim_name (aim));
  row (b, name, setting, bench_median (x, (int)b->stills), "");
}

/* One frame of the live view; *BYTES grows by what would be written.  */
static double
fly_frame (const bench *b, bt_aim aim, int i, bt__screen *screen, size_t *bytes)
{
  const bt__drawing quick = { .width = COLUMNS, .height = 2 * ROWS, .samples = 1, .quick = 1 };
  double begun = bench_now ();
  bt_view *view = new_view (i / 30.0, aim, (double)COLUMNS / (2 * ROWS));
  bt__picture picture;
  const char *out;
  draw (b, view, &quick, &picture);
  bt__screen_picture (screen, picture.pixels);
  *bytes += bt__screen_changes (screen, i == 0, &out, NULL);
  bt__picture_free (&picture);
  bt_view_free (view);
  return bench_now () - begun;
}

static void
measure_flight (bench *b, bt_aim aim)
{
  double x[PICTURES_MAX];
  size_t bytes = 0;
  bt__screen *screen;
  bt_error error;
  char setting[60], counters[60];
  check (bt__screen_new (COLUMNS, ROWS, BT__PALETTE_TRUE, 0, &screen, &error), &error);
  for (int i = 0; i < b->frames; i++)
    x[i] = fly_frame (b, aim, i, screen, &bytes);
  bt__screen_free (screen);
  snprintf (setting, sizeof setting, "view=%s", bt_aim_name (aim));
  snprintf (counters, sizeof counters, "bytes=%zu", bytes / (size_t)b->frames);
  row (b, "frame-120x40", setting, bench_median (x, (int)b->frames), counters);
}

static void
measure_first (bench *b)
{
  const bt__drawing small = { .width = 640, .height = 360, .samples = 1 };
  bt_error error;
  bt__picture picture;
  double begun = bench_now ();
  check (bt__renderer_new (NULL, &b->renderer, &error), &error);
  bt_view *view = new_view (0, BT_AIM_OVERVIEW, 16.0 / 9);
  draw (b, view, &small, &picture);
  row (b, "first-picture", "640x360", bench_now () - begun, "");
  bt__picture_free (&picture);
  bt_view_free (view);
}

int
main (int argc, char **argv)
{
  static const bt_aim aims[] = { BT_AIM_CHASE, BT_AIM_PILOT, BT_AIM_TOP, BT_AIM_SIDE };
  static bench b = { .stills = 5, .frames = 60 };
  const bench_option options[] = {
    { "stills", &b.stills, 1, PICTURES_MAX, 2, "stills of each view" },
    { "frames", &b.frames, 2, PICTURES_MAX, 15, "frames of each flight" },
  };
  const bench_program program = { "render", "Measure what pictures cost", options, 2 };
  int status = bench_options (&program, argc, argv);
  if (status != BENCH_GO_ON)
    return status;
  bench_open (&b.table);
  measure_first (&b);
  for (size_t i = 0; i < 2; i++)
    {
      measure_stills (&b, "still-1280x720-2x2", 1280, i ? BT_AIM_CHASE : BT_AIM_OVERVIEW);
      measure_stills (&b, "film-640x360-2x2", 640, i ? BT_AIM_CHASE : BT_AIM_OVERVIEW);
    }
  for (size_t i = 0; i < sizeof aims / sizeof *aims; i++)
    measure_flight (&b, aims[i]);
  bt__renderer_free (b.renderer);
  return bench_close (&b.table);
}
