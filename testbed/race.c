/* See race.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "testbed/calibration.h"
#include "testbed/race.h"
#include "testbed/rig.h"
#include "testbed/scene.h"

enum
{
  HALF = 30,                          /* steps in half a second */
  ROWS = (OUTSIDE_HALVES + 1) * HALF, /* of a track, one a step, and some to spare */
  CONVERGED = 400
};

/* Taut at the end of a step of a dive.  */
static bt_vec3
run_out (double t)
{
  return bt__vec (fmin (85 + 1.5 * t, 100.025), 0, -50);
}

static bt_vec3
level (double t)
{
  (void)t;
  return bt__vec (30, 0, -50);
}

#define LINE .diameter = 0.01, .ea = 2e5, .cdn = 1.2, .cdt = 0.02, .ca = 1
const race races[RACES] = {
  [RACE_LED] = { .name = "led",
                 .line = { LINE, .ba = 50, .mass = 0.0805033117 },
                 .length = 100,
                 .anchor = { 0, 0, -100 },
                 .flow = { 0, 0.5, 0 },
                 .rows = OUTSIDE_HALVES,
                 .led = outside_moordyn_led },
  [RACE_RAMP] = { .name = "ramp",
                  .line = { LINE, .ba = 20, .mass = 0.0805033117 },
                  .length = 100,
                  .anchor = { 0, 0, -50 },
                  .flow = { -0.2, 0.2, 0.1 },
                  .rows = 41,
                  .led = run_out },
  [RACE_LET_GO] = { .name = "let go",
                    .line = { LINE, .ba = 5, .mass = 0.12, .wet_weight = 0.387462511750 },
                    .length = 30,
                    .anchor = { 0, 0, -50 },
                    .rows = 61,
                    .loose = 1,
                    .led = level },
};

/* ---- By a chain ---- */

static void
open_chain (const race *r, const outside_setting *how, rig *c)
{
  bt_vec3 end = r->led (0), middle = bt__scale (0.5, bt__add (r->anchor, end));
  bt_vec3 shape[3] = { r->anchor, middle, end };
  if (!r->loose)
    shape[1] = bt__axpy (middle, 0.3 * r->length / bt__norm (r->flow), r->flow);
  rig_open (c, r->line, RACE_DENSITY, how->intervals, shape, 3, r->length);
  c->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { r->flow } };
  if (r->loose)
    c->in.end[1] = (bt__dynamic_end){ .free = 1 };
  else
    rig_settle (c);
  c->in.order = how->order;
  c->in.tolerance = how->tolerance;
}

outside_result
race_by_chain (const race *r, const outside_setting *how, outside_flight *f, double *seconds)
{
  rig c;
  double h = 0.5 / how->per, spent = 0;
  open_chain (r, how, &c);
  f->rows = r->rows;
  for (int k = 0; c.good && k < r->rows; k++)
    {
      double start = bench_now ();
      for (int i = 1; i <= how->per && k > 0; i++)
        {
          c.in.end[1].at = r->led (((k - 1) * how->per + i) * h);
          rig_step (&c, h);
        }
      spent += bench_now () - start;
      f->t[k] = 0.5 * k;
      for (int i = 0; i < OUTSIDE_STATIONS; i++)
        f->at[k][i] = bt__dynamic_point (c.d, r->length * i / (OUTSIDE_STATIONS - 1));
      for (int e = 0; e < 2; e++)
        f->pull[k][e] = bt__dynamic_node_tension (c.d, e ? (int)c.d->n : 0);
    }
  if (seconds)
    *seconds = spent / (0.5 * (r->rows - 1));
  return rig_close (&c) ? OUTSIDE_DONE : OUTSIDE_FAILED;
}

outside_result
race_converged (const race *r, outside_flight *best)
{
  static outside_flight coarse, fine;
  const outside_setting half = { CONVERGED / 2, 120, 2, 1e-9 }, whole = { CONVERGED, 240, 2, 1e-9 };
  if (race_by_chain (r, &half, &coarse, NULL) != OUTSIDE_DONE
      || race_by_chain (r, &whole, &fine, NULL) != OUTSIDE_DONE)
    return OUTSIDE_FAILED;
  outside_extrapolate (&coarse, &fine, best);
  return OUTSIDE_DONE;
}

/* ---- In a dive ---- */

/* Put into S the vehicle at the far end, strong enough for any line; the track comes later.  */
static void
put_vehicle (const race *r, scene *s)
{
  scene_vehicle (s, r->led (0))->pull = 1e6;
}

static void
follow (const race *r, bt_dive *dive)
{
  static double rows[4 * ROWS];
  bt_error error;
  for (int k = 0; k < ROWS; k++)
    {
      double *row = rows + 4 * k, t = k / 60.0;
      bt_vec3 at = r->led (t);
      row[0] = t, row[1] = at.x, row[2] = at.y, row[3] = at.z;
    }
  scene_must (bt_vehicle_follow (dive, 0, &(bt_rows){ rows, ROWS, 4 }, &error), &error);
}

/* Lay LENGTH metres of the line of R; a loose line is laid weightless, hence unstretched.  */
static bt_dive *
lay (const race *r, const race_dive *how, double length)
{
  static scene s;
  scene_clear (&s);
  s.world.sea.depth = 200;
  scene_current (&s, r->flow);
  if (!r->loose)
    put_vehicle (r, &s);
  bt_tether_def *line = scene_line (&s, r->anchor, length, how->nodes);
  if (r->loose)
    line->to = (bt_end){ .at = bt__axpy (r->anchor, length / r->length,
                                         bt__sub (r->led (0), r->anchor)) };
  bt_tether_props *p = &line->props;
  p->diameter = r->line.diameter;
  p->mass = r->line.mass;
  p->wet_weight = r->loose ? 0 : r->line.wet_weight;
  p->ea = r->line.ea;
  p->ba = r->line.ba;
  p->cdn = r->line.cdn;
  p->cdt = r->line.cdt;
  p->ca = r->line.ca;
  p->model = how->model;
  p->accuracy = how->accuracy;
  p->tension_accuracy = how->tension_accuracy;
  return scene_begin (&s.world);
}

/* Cut the line of DIVE at its far end; return how much is left at the anchor, m.  */
static double
cut (bt_dive *dive, double length)
{
  bt_tether_view view;
  bt_error error;
  scene_must (bt_tether_cut (dive, 0, length, &error), &error);
  scene_must (bt_dive_tether (dive, 0, &view, &error), &error);
  return view.length;
}

/* A cut takes a part of an interval; as much more is laid.  */
static bt_dive *
lay_loose (const race *r, const race_dive *how)
{
  bt_error error;
  bt_dive *trial = lay (r, how, r->length);
  double length = r->length * r->length / cut (trial, r->length);
  bt_dive_free (trial);
  bt_dive *dive = lay (r, how, length);
  cut (dive, length);
  scene_must (bt_part_alter (dive, BT_PART_TETHER, 0, "wet-weight", r->line.wet_weight, &error),
              &error);
  return dive;
}

/* What is told of a line that was cut is told of the part at the anchor, but for the force on what
   the other part hangs from.  */
static void
tell (const race *r, const bt_dive *dive, outside_flight *f, int k)
{
  bt_tether_view view;
  bt_error error;
  f->t[k] = 0.5 * k;
  scene_must (bt_tether_points (dive, 0, OUTSIDE_STATIONS, f->at[k], &error), &error);
  scene_must (bt_dive_tether (dive, 0, &view, &error), &error);
  f->pull[k][0] = view.tension_anchor;
  f->pull[k][1] = view.tension_end;
  if (r->loose)
    scene_must (bt_tether_tension (dive, 0, view.length, &f->pull[k][1], &error), &error);
}

void
race_in_dive (const race *r, const race_dive *how, outside_flight *f, double *seconds)
{
  bt_dive *dive = r->loose ? lay_loose (r, how) : lay (r, how, r->length);
  double spent = 0;
  if (!r->loose)
    follow (r, dive);
  f->rows = r->rows;
  tell (r, dive, f, 0);
  for (int k = 1; k < r->rows; k++)
    {
      spent += HALF * scene_run (dive, HALF);
      tell (r, dive, f, k);
    }
  bt_dive_free (dive);
  *seconds = spent / (0.5 * (r->rows - 1));
}
