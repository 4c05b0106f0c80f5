/* Lines that others computed or measured: see outside.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "testbed/outside.h"
#include "testbed/reference.h"
#include "testbed/rig.h"

/* ---- Numbers ---- */

static void
parse (outside_table *t, char *line)
{
  char *end;
  t->columns = 0;
  for (char *p = line; t->columns < OUTSIDE_COLUMNS; p = end + 1)
    {
      t->at[t->rows][t->columns++] = strtod (p, &end);
      if (end == p || *end != ',')
        break;
    }
  t->rows++;
}

int
outside_load (const char *file, int columns, outside_table *t)
{
  char line[16384];
  int whole = 1;
  FILE *f = bench_open_reference (file);
  t->rows = 0;
  while (f && t->rows < OUTSIDE_ROWS && fgets (line, sizeof line, f))
    if ((line[0] >= '0' && line[0] <= '9') || line[0] == '-')
      {
        parse (t, line);
        whole &= t->columns >= columns;
      }
  if (f)
    fclose (f);
  return whole && t->rows > 0;
}

/* Close R and return how its case ended.  */
static outside_result
ended (rig *r)
{
  return rig_close (r) ? OUTSIDE_DONE : OUTSIDE_FAILED;
}

/* ---- MoorDyn ---- */

static const bt_tether_props moordyn_line = {
  .diameter = 0.01, .mass = 0.0805033117, .ea = 2e5, .ba = 50, .cdn = 1.2, .cdt = 0.02, .ca = 1
};

static void
open_moordyn (rig *r, bt_tether_props line, int n, bt_vec3 middle, bt_vec3 end)
{
  bt_vec3 shape[3] = { { 0, 0, -100 }, middle, end };
  rig_open (r, line, 1025, n, shape, 3, 100);
}

/* Beside a current of half a knot or so.  */
static void
let_flow (rig *r)
{
  r->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { bt__vec (0, 0.5, 0) } };
}

outside_result
outside_moordyn_rest (int which, int n, outside_shape *shape)
{
  static outside_table data;
  rig r;
  bt_tether_props line = moordyn_line;
  if (!outside_load (which ? "moordyn/B.csv" : "moordyn/A.csv", 5, &data))
    return OUTSIDE_NO_DATA;
  line.mass = which ? line.mass : 0.12;
  line.wet_weight = which ? 0 : 0.387462511750;
  open_moordyn (&r, line, n, bt__vec (30, which ? 30 : 0, which ? -100 : -140),
                bt__vec (which ? 70 : 60, 0, -100));
  if (which)
    let_flow (&r);
  rig_settle (&r);
  shape->rows = data.rows;
  for (int k = 0; r.good && k < data.rows; k++)
    {
      const double *row = data.at[k];
      int i = (int)(row[0] / 100 * n + 0.5);
      shape->s[k] = row[0];
      shape->ours[k] = bt__dynamic_x (r.d)[i];
      shape->pull[k] = bt__dynamic_node_tension (r.d, i);
      shape->theirs[k] = bt__vec (row[1], row[2], row[3]);
      shape->their_pull[k] = row[4];
    }
  return ended (&r);
}

outside_result
outside_moordyn_theirs (outside_flight *f)
{
  static outside_table data;
  if (!outside_load ("moordyn/C.csv", 3 + 3 * OUTSIDE_STATIONS, &data)
      || data.rows != OUTSIDE_HALVES)
    return OUTSIDE_NO_DATA;
  f->rows = OUTSIDE_HALVES;
  for (int k = 0; k < OUTSIDE_HALVES; k++)
    {
      const double *row = data.at[k];
      f->t[k] = row[0];
      f->pull[k][0] = row[1];
      f->pull[k][1] = row[2];
      for (int i = 0; i < OUTSIDE_STATIONS; i++)
        f->at[k][i] = bt__vec (row[3 + 3 * i], row[4 + 3 * i], row[5 + 3 * i]);
    }
  return OUTSIDE_DONE;
}

bt_vec3
outside_moordyn_led (double t)
{
  double u = fmin (t / 10, 1);
  double a = 10 * (1 - cos (0.1 * t)) * u * u * u * (10 - 15 * u + 6 * u * u);
  return bt__vec (70 + 0.8 * a, 0, -100 + 0.6 * a);
}

void
outside_extrapolate (const outside_flight *coarse, const outside_flight *fine, outside_flight *best)
{
  *best = *fine;
  for (int k = 0; k < fine->rows; k++)
    {
      for (int i = 0; i < OUTSIDE_STATIONS; i++)
        best->at[k][i]
            = bt__axpy (fine->at[k][i], 1.0 / 3, bt__sub (fine->at[k][i], coarse->at[k][i]));
      for (int e = 0; e < 2; e++)
        best->pull[k][e] += (fine->pull[k][e] - coarse->pull[k][e]) / 3;
    }
}

double
outside_apart (const outside_flight *a, const outside_flight *b, int every, double *pull)
{
  double sum = 0, difference = 0, scale = 0;
  int points = 0;
  for (int k = 0; k < b->rows; k++)
    {
      for (int i = 0; i < OUTSIDE_STATIONS; i += every, points++)
        {
          bt_vec3 d = bt__sub (a->at[k][i], b->at[k][i]);
          sum += bt__dot (d, d);
        }
      for (int e = 0; e < 2; e++)
        {
          double d = a->pull[k][e] - b->pull[k][e];
          difference += d * d;
          scale += b->pull[k][e] * b->pull[k][e];
        }
    }
  if (pull)
    *pull = sqrt (difference / scale);
  return sqrt (sum / points);
}

/* ---- Lowe and Langley ---- */

#define JUMPER_STEP 0.05 /* s */

/* How long it is flown before the history begins, s: three periods of the end, six waves.  */
#define JUMPER_BEFORE 81.0
#define JUMPER_WAVES 60.0

/* m: their waves are those of deep water, k = w^2 / g, although the sea is 100 m deep.  */
#define WAVES_DEPTH 1000.0

static double
between (const outside_table *data, double t)
{
  int k = 1;
  while (k < data->rows - 1 && data->at[k][0] < t)
    k++;
  const double *a = data->at[k - 1], *b = data->at[k];
  return a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0]);
}

static void
open_jumper (rig *r, int n, double cd, double density)
{
  const double g = 9.807;
  bt_vec3 shape[3] = { { 0, 0, -5 }, { -40, 0, -95 }, { -100, 0, -55 } };
  bt_tether_props line
      = { .diameter = 0.396, .mass = 165, .ea = 5e8, .ei = 120.8e3, .cdn = cd, .ca = 1 };
  line.wet_weight = (165 - density * BT__PI * 0.396 * 0.396 / 4) * g;
  rig_open (r, line, density, n, shape, 3, 170);
  r->water.gravity = g;
  r->water.depth = 100;
  r->in.tolerance = 1e-7;
}

/* Where the top is at T, begun softly at -BEFORE.  */
static bt_vec3
swung (int which, double t, double before)
{
  double ramp = fmin ((t + before) / 27, 1), a = 10 * ramp * sin (2 * BT__PI * t / 27);
  return bt__vec (which == 1 ? a : 0, which == 2 ? a : 0, -5);
}

outside_result
outside_jumper (int which, int n, double cd, outside_history *history)
{
  static outside_table data;
  const bt_wave_def swell = { .kind = BT_WAVE_AIRY, .height = 10, .period = 10 };
  bt_waves waves;
  bt_sea sea = { .waves = &waves };
  char file[80];
  rig r;
  snprintf (file, sizeof file, "published/lowe_langley_2006_case%d.csv", which);
  if (!outside_load (file, 2, &data))
    return OUTSIDE_NO_DATA;
  open_jumper (&r, n, cd, 1000);
  rig_settle (&r);
  if (r.good)
    {
      history->rest[0] = r.d->pull[0].x / -1e3;
      history->rest[1] = r.d->pull[0].z / -1e3;
    }
  const double before = which == 6 ? JUMPER_WAVES : JUMPER_BEFORE, h = JUMPER_STEP;
  if (which == 6 && bt_waves_make (&swell, WAVES_DEPTH, r.water.gravity, &waves, NULL) == BT_OK)
    r.water.sea = &sea;
  r.water.time = -before;
  history->rows = 0;
  long last = lround ((data.at[data.rows - 1][0] + before) / h);
  for (long i = 1; r.good && i < last && history->rows < OUTSIDE_ROWS; i++)
    {
      double t = (double)i * h - before;
      if (which != 6)
        r.in.end[0].at = swung (which, t, before);
      rig_step (&r, h);
      if (t < data.at[0][0] || i % 2)
        continue;
      history->t[history->rows] = t;
      history->ours[history->rows] = bt__dynamic_node_tension (r.d, 0) / 1e3;
      history->theirs[history->rows++] = between (&data, t);
    }
  return ended (&r);
}
