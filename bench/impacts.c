/* See impacts.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "impacts.h"
#include "testbed/calibration.h"
#include "testbed/impact.h"

enum
{
  NODES = 64
};

/* Put the row of IMPACT flown by MODEL, called NAME.  */
static void
fly (bench_table *table, const impact *i, int model, const char *name, int quiet)
{
  static scene s;
  char setting[48];
  impact_scene (&s, i, NODES);
  s.tether[0].props.model = model;
  bt_dive *dive = impact_begin (&s);
  double exact = impact_exact (i), start = bench_now ();
  double off = impact_found (dive, impact_time (i)) / exact - 1,
         seconds = (bench_now () - start) / impact_time (i);
  bt_dive_free (dive);
  snprintf (setting, sizeof setting, "EA=%g L=%g", i->ea, i->length);
  if (quiet)
    printf ("peak, %s, %s: %+.2f %% of %.4g N, to be within 2 %%\n", setting, name, 100 * off,
            exact);
  else
    bench_put (table, &(bench_row){ "impact", name, setting, "relative error of the peak",
                                    fabs (off), "exact wave", 0, seconds, NULL });
}

void
bench_impacts (bench_table *table, int quiet)
{
  for (int k = 0; k < IMPACTS; k++)
    {
      fly (table, &impacts[k], BT_MODEL_DYNAMIC, "dynamic", quiet);
      fly (table, &impacts[k], BT_MODEL_AUTO, "auto", quiet);
    }
}
