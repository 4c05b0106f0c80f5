/* Cables that two robot arms swing in air.  Of a cable its bending stiffness by mass is not told:
   it is found on the first half of a swing, and the second half is what is held against it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/outside.h"
#include "validation.h"

#define HALF 2.5 /* s */
#define SOFTEST 1e-3
#define STIFFEST 1.0
#define MASS 0.05 /* kg/m: in air it hardly matters */

/* SPREAD: the standard deviation in mm of what the chords of a cable add up to, within a swing.  */
static const struct
{
  const char *name, *file;
  double spread;
} cables[] = {
  { "cable-1", "real/deform_dlo1_eval55.csv", 8.9 },
  { "cable-2", "real/deform_dlo2_eval104.csv", 5.6 },
  { "cable-3", "real/deform_dlo3_eval106.csv", 2.8 },
  { "cable-4", "real/deform_dlo4_eval35.csv", 10.1 },
  { "cable-5", "real/deform_dlo5_eval18.csv", 8.0 },
};

static double
mean_of (const outside_history *h, int second)
{
  double sum = 0;
  int n = 0;
  for (int k = 0; k < h->rows; k++)
    if ((h->t[k] >= HALF) == second)
      {
        sum += h->ours[k];
        n++;
      }
  return sum / n;
}

/* Swing cable K with N intervals of STIFFNESS.  */
static outside_result
swing (int k, double stiffness, int n, outside_history *h)
{
  return outside_cable (cables[k].file, &(outside_swing){ stiffness, MASS, n, n / 10 }, h);
}

/* The stiffness with which the first half of cable K's swing is nearest.  */
static outside_result
find_stiffness (int k, double *best)
{
  static outside_history h;
  double least = HUGE_VAL;
  for (double s = SOFTEST; s < STIFFEST; s *= sqrt (2))
    {
      outside_result result = swing (k, s, 40, &h);
      if (result != OUTSIDE_DONE)
        return result;
      if (mean_of (&h, 0) < least)
        {
          least = mean_of (&h, 0);
          *best = s;
        }
    }
  return OUTSIDE_DONE;
}

static void
put_cable (validation *v, int k)
{
  static outside_history h, coarse, soft;
  const char *name = cables[k].name, *axes = "mean distance mm over time s";
  double stiffness = 0;
  char setting[64];
  if (!validation_counts (v, name, find_stiffness (k, &stiffness), cables[k].file)
      || swing (k, stiffness, 80, &h) != OUTSIDE_DONE
      || swing (k, stiffness, 40, &coarse) != OUTSIDE_DONE
      || swing (k, 0, 80, &soft) != OUTSIDE_DONE)
    return;
  snprintf (setting, sizeof setting, "EI by mass %.2g m4/s2, found in the first half", stiffness);
  validation_row (v, name, setting, "mean distance mm, second half", mean_of (&h, 1),
                  "motion capture", cables[k].spread,
                  fabs (mean_of (&h, 1) - mean_of (&coarse, 1)) / 3);
  validation_varied (v, name, "first half", "mean distance mm, first half", mean_of (&h, 0),
                     "motion capture");
  validation_varied (v, name, "EI 0", "mean distance mm, second half", mean_of (&soft, 1),
                     "motion capture");
  for (int i = 0; i < h.rows; i += 5)
    validation_point (v, name, axes, "bight", h.t[i], h.ours[i]);
  for (int i = 0; i < soft.rows; i += 5)
    validation_point (v, name, axes, "without bending", soft.t[i], soft.ours[i]);
}

void
validation_cables (validation *v)
{
  v->model = "dynamic";
  for (int k = 0; k < (int)(sizeof cables / sizeof *cables); k++)
    put_cable (v, k);
}
