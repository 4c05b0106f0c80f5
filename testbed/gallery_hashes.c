/* Print a line for each world of gallery.h: its name, the hash of the state in which a dive begins,
   and the hash after each of two legs that the first vehicle drives.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <inttypes.h>
#include <stdio.h>

#include "testbed/gallery.h"
#include "testbed/scene.h"

enum
{
  LEG = 30 /* steps */
};

int
main (void)
{
  static const bt_sticks leg[] = { { .surge = 0.5, .heave = 0.25 }, { .sway = -0.5, .yaw = 0.5 } };
  const char *name;
  for (int i = 0; (name = gallery_name (i)); i++)
    {
      bt_dive *dive = gallery_begin (name);
      bt_error error;
      printf ("%s %" PRIu64, name, bt_dive_hash (dive));
      for (size_t k = 0; k < sizeof leg / sizeof *leg; k++)
        {
          scene_must (bt_vehicle_drive (dive, 0, leg + k, &error), &error);
          scene_run (dive, LEG);
          printf (" %" PRIu64, bt_dive_hash (dive));
        }
      puts ("");
      bt_dive_free (dive);
    }
  return 0;
}
