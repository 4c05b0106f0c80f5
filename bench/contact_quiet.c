/* See contact_quiet.h.

   A line of 0.5 N/m sinks to what lies below it, and has a minute and a half to come to rest.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/calibration.h"
#include "contact_quiet.h"
#include "testbed/contact_scene.h"

enum
{
  LINKS = 100,
  FALL = 3600, /* steps over a beam */
  REST = 5400, /* and on a bed, of which ... */
  LAST = 600   /* ... the last are looked at */
};

static const double frame = 1.0 / 60;

typedef enum bed
{
  PLANE,
  FLAT,
  ROUGH,
  BEDS
} bed;

static const char *const bed_names[BEDS] = { "plane", "flat mesh", "rough mesh" };

typedef struct stage
{
  reef place;
  rope line;
} stage;

static int
lay (stage *s, const bt_vec3 *shape, double length)
{
  if (!reef_raise (&s->place) || !rope_open (&s->line, &s->place, LINKS, shape, 3, length, 0.3))
    return 0;
  s->line.line.wet_weight = 0.5;
  s->line.line.mass += 0.5 / 9.81;
  return 1;
}

static void
clear (stage *s)
{
  rope_close (&s->line);
  reef_close (&s->place);
}

static double
energy (const rope *line)
{
  bt__dynamic_energy e = bt__dynamic_energies (line->d, &line->in);
  return e.kinetic + e.strain + e.gravity;
}

static int
fall_over_a_beam (bench_table *table)
{
  static stage s;
  const bt_vec3 shape[] = { { 0, 0, -3 }, { 10, 0, -3 }, { 20, 0, -3 } };
  double most = 0, before = INFINITY, start = bench_now ();
  if (!reef_open (&s.place))
    return 0;
  reef_cylinder (&s.place, bt__vec (10, -5, -5), bt__vec (10, 5, -5), 0.3);
  if (!lay (&s, shape, 24))
    return 0;
  for (int i = 0; i < FALL; i++)
    {
      rope_step (&s.line, frame, 0);
      double now = energy (&s.line);
      most = fmax (most, now - before);
      before = now;
    }
  char counters[80];
  snprintf (counters, sizeof counters, "slip=%.3g m/s;speed=%.3g m/s", s.line.touch.speed,
            s.line.report.speed);
  bench_put (table,
             &(bench_row){ "quiet", "dynamic", "a line falls over a beam", "J gained in a step",
                           most, "closed form", 0, (bench_now () - start) / FALL, counters });
  clear (&s);
  return 1;
}

static int
rest_on (bench_table *table, bed what, uint64_t seed)
{
  static stage s;
  const bt_vec3 shape[] = { { 0, 0, -9 }, { 9.5, 3.1, -9.8 }, { 19, 6.2, -9 } };
  dice d = dice_new (seed);
  double slip = 0, start = bench_now ();
  if (!reef_open (&s.place))
    return 0;
  if (what == PLANE)
    reef_plane (&s.place, -10);
  else
    reef_bottom (&s.place, &d, -10, 0.5, 110, what == ROUGH ? 0.1 : 0);
  if (!lay (&s, shape, 24))
    return 0;
  for (int i = 0; i < REST; i++)
    {
      rope_step (&s.line, frame, 0);
      if (i >= REST - LAST)
        slip = fmax (slip, s.line.touch.speed);
    }
  char setting[80], counters[120];
  snprintf (setting, sizeof setting, "at rest on a %s %lu", bed_names[what], (unsigned long)seed);
  snprintf (counters, sizeof counters, "touches=%d;speed=%.3g m/s;unsolved=%.3g",
            s.line.touch.touches, s.line.report.speed, (double)s.line.unconverged / REST);
  bench_put (table,
             &(bench_row){ "quiet", "dynamic", setting, "m/s of slip at the most in 10 s", slip,
                           "closed form", 0, (bench_now () - start) / REST, counters });
  clear (&s);
  return 1;
}

int
contact_quiet (bench_table *table, int quick)
{
  if (!fall_over_a_beam (table) || !rest_on (table, PLANE, 1) || !rest_on (table, FLAT, 1))
    return 0;
  for (uint64_t seed = 1; seed <= (quick ? 1 : 24); seed++)
    if (!rest_on (table, ROUGH, seed))
      return 0;
  return 1;
}
