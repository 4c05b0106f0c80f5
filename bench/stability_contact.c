/* Campaigns among obstacles: a line of 100 intervals towed through a jacket by an end that darts
   from aim to aim and turns about, or with a vehicle of 20 kg there; every step is judged for
   crossings by one who knows nothing of the engine.  A case is 600 steps in a jacket of its own.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "calibration.h"
#include "contact_scene.h"
#include "stability.h"

enum
{
  LINKS = 100,
  STEPS = 600,
  REFUSED = 0,
  NOT_FINITE,
  CROSSING,
  FAULTS
};

static const char *const fault_names[FAULTS] = { "refused", "not finite", "crossing" };
static const double frame = 1.0 / 60;
static reef place;
static rope line;

/* Drive the free end toward TARGET.  */
static void
thrust (bt_vec3 target, double speed)
{
  bt_vec3 way = bt__sub (target, bt__dynamic_x (line.d)[line.d->n]);
  bt_vec3 want = bt__scale (speed / fmax (bt__norm (way), 1), way);
  bt_vec3 f = bt__scale (200, bt__sub (want, bt__dynamic_v (line.d)[line.d->n]));
  double size = bt__norm (f);
  line.in.end[1].body.force = size > 600 ? bt__scale (600 / size, f) : f;
}

/* Fly case NUMBER; zero if it could not be laid.  */
static int
fly (stability_log *l, long number)
{
  static const bt_vec3 shape[]
      = { { -14, 0, -5 }, { -16, -20, -8 }, { -12, -20, -8 }, { -9, 0, -8 } };
  uint64_t seed = (uint64_t)(l->plan->seed * 1000003 + number) + 1;
  dice d = dice_new (seed);
  bt_vec3 target = { 0, 0, -8 };
  int body = dice_below (&d, 2);
  double speed = exp (dice_between (&d, log (0.1), log (5)));
  if (!reef_jacket (&place, seed) || !rope_open (&line, &place, LINKS, shape, 4, 60, 0.3))
    return 0;
  if (body)
    line.in.end[1] = (bt__dynamic_end){ .free = 1, .body = { .mass = 20, .quadratic = 60 } };
  for (int i = 0; i < STEPS && !line.nan && !line.refused; i++)
    {
      if (dice_below (&d, 120) == 0)
        target = bt__vec (dice_between (&d, -9, 9), dice_between (&d, -9, 9),
                          dice_between (&d, -28, -1));
      if (dice_below (&d, 60) == 0)
        target = bt__scale (-1, target);
      if (body)
        thrust (target, speed);
      else
        rope_tow (&line, target, speed, frame);
      double start = bench_now ();
      rope_step (&line, frame, 0);
      l->cpu += bench_now () - start;
      rope_judge (&line);
    }
  return 1;
}

static void
close_case (void)
{
  rope_close (&line);
  reef_close (&place);
}

int
stability_contact (const stability_plan *plan, bench_table *table, stability_log *l)
{
  long truncated = 0;
  stability_begin (l, plan, "steps", fault_names, FAULTS, "fastest m/s");
  for (long number; (number = stability_next (l)) >= 0;)
    {
      if (!fly (l, number))
        return 0;
      l->steps += line.steps;
      l->solves += line.solves;
      l->unsolved += line.unconverged;
      l->worst = fmax (l->worst, line.fastest);
      truncated += line.truncated;
      if (line.refused)
        stability_fault (l, number, REFUSED);
      if (line.nan)
        stability_fault (l, number, NOT_FINITE);
      if (line.crossings)
        stability_fault (l, number, CROSSING);
      close_case ();
    }
  bench_put (table,
             &(bench_row){ "contact", "dynamic", "all", "share of steps cut by the guard",
                           (double)truncated / fmax ((double)l->steps, 1), NULL, 0, 0, NULL });
  return 1;
}
