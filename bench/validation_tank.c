/* A rope in a tank led by a vehicle.  Their markers lie on turned catenaries; our line is held
   against them as it is, and drawn by their rule.  What could be left is tried one by one: drag, a
   vertical, a current, a wake that remembers, stiffness, a set.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/outside.h"
#include "validation.h"

/* mm: the cameras' 2.2, and 2.0 of a vertical that scatters by 0.42 degrees.  */
#define DRAWN_SURE 3.0

/* The frames of a kind, means in mm.  */
typedef struct frames
{
  int count;
  double off, drawn, misses, doubt, plain;
  double apart; /* MISSES against DOUBT, frame by frame */
} frames;

static frames
frames_of (const outside_tank *t, int moving, double surer_than)
{
  frames f = { 0 };
  for (int k = 0; k < t->rows; k++)
    if ((t->plain[k] > OUTSIDE_MOVING) == moving && t->doubt[k] < surer_than)
      {
        f.count++;
        f.off += t->off[k];
        f.drawn += t->drawn[k];
        f.misses += t->misses[k];
        f.doubt += t->doubt[k];
        f.plain += t->plain[k];
        f.apart += fabs (t->misses[k] - t->doubt[k]);
      }
  double n = f.count;
  return (frames){ f.count,     f.off / n,   f.drawn / n, f.misses / n,
                   f.doubt / n, f.plain / n, f.apart / n };
}

static void
put_frames (validation *v, const char *what, frames f)
{
  char setting[64];
  snprintf (setting, sizeof setting, "%s: %d frames", what, f.count);
  validation_row (v, "tank", setting, "mean distance mm", f.off, "motion capture", f.doubt, NAN);
  validation_row (v, "tank", setting, "mean distance mm, drawn as theirs", f.drawn,
                  "motion capture", DRAWN_SURE, NAN);
}

static void
draw_tank (validation *v, const outside_tank *t)
{
  const char *axes = "mean distance mm over time s",
             *other = "beside its turned catenary mm over time s";
  for (int k = 0; k < t->rows; k++)
    validation_point (v, "tank", axes, "bight", t->t[k], t->off[k]);
  for (int k = 0; k < t->rows; k++)
    validation_point (v, "tank", axes, "bight, drawn as theirs", t->t[k], t->drawn[k]);
  for (int k = 0; k < t->rows; k++)
    validation_point (v, "tank", axes, "catenary in still water", t->t[k], t->plain[k]);
  for (int k = 0; k < t->rows; k++)
    validation_point (v, "tank", axes, "the measurement's own uncertainty", t->t[k], t->doubt[k]);
  for (int k = 0; k < t->rows; k++)
    validation_point (v, "tank", other, "bight", t->t[k], t->misses[k]);
  for (int k = 0; k < t->rows; k++)
    validation_point (v, "tank", other, "markers", t->t[k], t->doubt[k]);
}

/* The drift makes the rope before it moves as near as the vertical does: to 1.2 mm.  */
static const struct
{
  const char *name;
  outside_rope rope;
} ropes[] = {
  { "Cd 1.2", { .cd = 1.2 } },
  { "Cd 1.4", { .cd = 1.4 } },
  { "vertical as it hung", { .cd = 1.3, .plumb = 1 } },
  { "vertical as it hung, Cd 1.2", { .cd = 1.2, .plumb = 1 } },
  { "vertical as it hung, Cd 1.1", { .cd = 1.1, .plumb = 1 } },
  { "current that bends it as it hung", { .cd = 1.3, .drift = { -0.0788, -0.0250, 0 } } },
  { "wake of .15 over 3 diameters", { .cd = 1.3, .wake = 0.15, .fades = 3 } },
  { "wake of .3 over 10 diameters", { .cd = 1.3, .wake = 0.3, .fades = 10 } },
  { "wake of .3 over 30 diameters", { .cd = 1.3, .wake = 0.3, .fades = 30 } },
  { "wake of .3 over 100 diameters", { .cd = 1.3, .wake = 0.3, .fades = 100 } },
  { "EI 1e-4", { .cd = 1.3, .ei = 1e-4 } },
  { "EI 1e-4, set of 1/m", { .cd = 1.3, .ei = 1e-4, .curvature = 1 } },
  { "EI 1e-4, set of 4/m", { .cd = 1.3, .ei = 1e-4, .curvature = 4 } },
};

static void
vary (validation *v, const char *name, const outside_tank *tank)
{
  static const char *const kinds[] = { "moving", "sure" };
  for (int sure = 0; sure < 2; sure++)
    {
      frames f = frames_of (tank, 1, sure ? 20 : HUGE_VAL);
      char setting[64];
      snprintf (setting, sizeof setting, "%s, %s", kinds[sure], name);
      validation_varied (v, "tank", setting, "mean distance mm", f.off, "motion capture");
      validation_varied (v, "tank", setting, "mean distance mm, drawn as theirs", f.drawn,
                         "motion capture");
    }
}

void
validation_tank (validation *v)
{
  static outside_tank tank;
  if (!validation_counts (v, "tank", outside_in_tank (&outside_plain_rope, &tank),
                          "real/toulon_cable6_surge_0p6_0031.csv"))
    return;
  frames moving = frames_of (&tank, 1, HUGE_VAL);
  put_frames (v, "moving", moving);
  put_frames (v, "moving, sure to 20 mm", frames_of (&tank, 1, 20));
  put_frames (v, "at rest", frames_of (&tank, 0, HUGE_VAL));
  validation_row (v, "tank", "moving, each beside its turned catenary", "mean difference mm",
                  moving.apart, "motion capture", 0, NAN);
  validation_varied (v, "tank", "moving, ours beside its turned catenary", "mean distance mm",
                     moving.misses, "motion capture");
  validation_varied (v, "tank", "moving, a catenary in still water", "mean distance mm",
                     moving.plain, "motion capture");
  draw_tank (v, &tank);
  for (size_t k = 0; k < sizeof ropes / sizeof *ropes && !v->quick; k++)
    if (outside_in_tank (&ropes[k].rope, &tank) == OUTSIDE_DONE)
      vary (v, ropes[k].name, &tank);
}
