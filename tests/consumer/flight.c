/* A C11 program that builds a world, flies in it, asks and prints: the one that the manual's
   chapter "C library" shows.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <bight/bight.h>

int
main (void)
{
  bt_sea_def sea;
  bt_vehicle_def rov;
  bt_tether_def tether;
  bt_model *model;
  bt_dive *dive;
  bt_tether_view line;
  bt_vec3 middle;
  bt_error error;

  bt_def_init (bt_head_find ("sea"), &sea);
  bt_def_init (bt_head_find ("rov"), &rov);
  bt_def_init (bt_head_find ("tether"), &tether);
  bt_def_set_vehicle_type (&rov, "bluerov2-heavy", NULL);
  bt_def_set_tether_type (&tether, "fathom", NULL);
  sea.current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.2, 0, 0 } } };
  strcpy (rov.name, "minnow");
  strcpy (tether.name, "line");
  strcpy (tether.to.part, "minnow");
  rov.at = (bt_vec3){ 0, 20, -5 };
  tether.length = 30;
  tether.props.model = BT_MODEL_DYNAMIC;

  bt_world world
      = { .sea = sea, .vehicles = &rov, .n_vehicles = 1, .tethers = &tether, .n_tethers = 1 };
  if (bt_model_new (&world, &model, &error) || bt_dive_new (model, NULL, NULL, &dive, &error)
      || bt_vehicle_fly_to (dive, 0, &(bt_flight){ .to = { 10, 25, -8 }, .speed = 0.5 }, &error)
      || bt_tether_pay_out (dive, 0, &(bt_spooling){ .length = 5, .rate = 0.5 }, &error))
    return fprintf (stderr, "%s\n", error.text), 1;
  while (bt_dive_time (dive) < 60)
    if (bt_dive_step (dive, &error))
      return fprintf (stderr, "%s\n", error.text), 1;
  bt_dive_tether (dive, 0, &line, NULL);
  bt_tether_point (dive, 0, line.length / 2, &middle, NULL);
  printf ("%.0f m out, %.1f N, its middle %.0f m east\n", line.length, line.tension_max, middle.x);
  bt_dive_free (dive);
  bt_model_release (model);
  return fabs (line.length - 35) < 0.01 ? 0 : 1;
}
