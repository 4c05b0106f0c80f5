/* Case C of MoorDyn in a dive: see outside.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "testbed/outside.h"
#include "testbed/scene.h"

enum
{
  HALF = 30,                         /* steps in half a second */
  ROWS = (OUTSIDE_HALVES + 1) * HALF /* of the track, one a step, and some to spare */
};

static bt_dive *
begin (const outside_diving *how)
{
  static scene s;
  static double rows[4 * ROWS];
  bt_error error;
  scene_clear (&s);
  s.world.sea.depth = 200;
  scene_current (&s, bt__vec (0, 0.5, 0));
  scene_vehicle (&s, outside_moordyn_led (0))->pull = 1e6;
  bt_tether_def *line = scene_line (&s, bt__vec (0, 0, -100), 100, how->nodes);
  const bt_tether_props *p = &outside_moordyn_line;
  line->props.diameter = p->diameter;
  line->props.mass = p->mass;
  line->props.wet_weight = 0;
  line->props.ea = p->ea;
  line->props.ba = p->ba;
  line->props.cdn = p->cdn;
  line->props.cdt = p->cdt;
  line->props.ca = p->ca;
  line->props.model = how->model;
  line->props.accuracy = how->accuracy;
  line->props.tension_accuracy = how->tension_accuracy;
  bt_dive *dive = scene_begin (&s.world);
  for (int k = 0; k < ROWS; k++)
    {
      double *row = rows + 4 * k, t = k / 60.0;
      bt_vec3 at = outside_moordyn_led (t);
      row[0] = t, row[1] = at.x, row[2] = at.y, row[3] = at.z;
    }
  scene_must (bt_vehicle_follow (dive, 0, &(bt_rows){ rows, ROWS, 4 }, &error), &error);
  return dive;
}

static void
tell (const bt_dive *dive, outside_flight *f, int k)
{
  bt_tether_view view;
  bt_error error;
  f->t[k] = 0.5 * k;
  scene_must (bt_tether_points (dive, 0, OUTSIDE_STATIONS, f->at[k], &error), &error);
  scene_must (bt_dive_tether (dive, 0, &view, &error), &error);
  f->pull[k][0] = view.tension_anchor;
  f->pull[k][1] = view.tension_end;
}

outside_result
outside_moordyn_dive (const outside_diving *how, outside_flight *f, double *seconds)
{
  bt_dive *dive = begin (how);
  double spent = 0;
  f->rows = OUTSIDE_HALVES;
  tell (dive, f, 0);
  for (int k = 1; k < OUTSIDE_HALVES; k++)
    {
      spent += HALF * scene_run (dive, HALF);
      tell (dive, f, k);
    }
  bt_dive_free (dive);
  if (seconds)
    *seconds = spent / (0.5 * (OUTSIDE_HALVES - 1));
  return OUTSIDE_DONE;
}
