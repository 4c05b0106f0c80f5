/* Cables that two robot arms swing in air: see outside.h.

   The arms hold the two markers at either end, which give the place and the direction of the
   clamped ends.  The markers sit on the outside of a cable that bends between them, so that their
   chords are never longer than the cable: a marker's place along it is the sum of the longest
   chords before it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "testbed/outside.h"
#include "testbed/rig.h"

enum
{
  MARKERS_MOST = 20
};

#define AIR 1.2 /* kg/m3 */

/* A cable's markers: how many, and how far along from the second each is, m.  */
typedef struct markers
{
  int n;
  double along[MARKERS_MOST];
} markers;

static bt_vec3
marker (const double *row, int k)
{
  return bt__vec (row[1 + 3 * k], row[2 + 3 * k], row[3 + 3 * k]);
}

static markers
markers_of (const outside_table *data)
{
  markers m = { (data->columns - 1) / 3, { 0 } };
  for (int k = 2; k < m.n - 1; k++)
    {
      double chord = 0;
      for (int i = 0; i < data->rows; i++)
        chord = fmax (chord, bt__distance (marker (data->at[i], k), marker (data->at[i], k - 1)));
      m.along[k] = m.along[k - 1] + chord;
    }
  return m;
}

/* Clamp the ends of R, in *M, where they are SHARE of the way from one row to the next.  */
static void
hold_ends (rig *r, const markers *m, const double *from, const double *to, double share)
{
  for (int end = 0; end < 2; end++)
    {
      int k = end ? m->n - 2 : 1, outer = end ? m->n - 1 : 0;
      bt_vec3 at[2];
      for (int i = 0; i < 2; i++)
        {
          bt_vec3 a = marker (from, i ? outer : k), b = marker (to, i ? outer : k);
          at[i] = bt__axpy (a, share, bt__sub (b, a));
        }
      bt_vec3 out = bt__sub (at[1], at[0]);
      r->in.end[end].at = at[0];
      r->in.end[end].clamped = 1;
      r->in.end[end].direction = bt__unit_or (bt__scale (end ? 1 : -1, out), bt__vec (0, 0, 1));
    }
}

/* The speeds of the markers between the first two rows, spread along the line of R.  */
static void
set_off (rig *r, const markers *m, const outside_table *data)
{
  double h = data->at[1][0] - data->at[0][0], s = 0;
  int k = 2;
  for (int i = 0; i <= r->d->n; i++)
    {
      while (k < m->n - 2 && s > m->along[k])
        k++;
      double share = fmin (1, (s - m->along[k - 1]) / (m->along[k] - m->along[k - 1]));
      bt_vec3 v[2];
      for (int e = 0; e < 2; e++)
        v[e] = bt__scale (
            1 / h, bt__sub (marker (data->at[1], k - 1 + e), marker (data->at[0], k - 1 + e)));
      bt__dynamic_v (r->d)[i] = bt__axpy (v[0], share, bt__sub (v[1], v[0]));
      s += i < r->d->n ? bt__dynamic_rest (r->d)[i] : 0;
    }
}

static double
miss_of_markers (const rig *r, const markers *m, const double *row)
{
  double sum = 0;
  for (int k = 2; k < m->n - 2; k++)
    sum += bt__distance (bt__dynamic_point (r->d, m->along[k]), marker (row, k));
  return sum / (m->n - 4);
}

outside_result
outside_cable (const char *file, const outside_swing *how, outside_history *h)
{
  static outside_table data;
  bt_vec3 shape[MARKERS_MOST];
  rig r;
  if (!outside_load (file, 1 + 3 * 7, &data) || data.columns > 1 + 3 * MARKERS_MOST)
    return OUTSIDE_NO_DATA;
  markers m = markers_of (&data);
  bt_tether_props line = { .diameter = 0.01,
                           .mass = how->mass,
                           .wet_weight = 9.81 * how->mass,
                           .ea = 1e4,
                           .ei = how->stiffness * how->mass,
                           .cdn = 1.2,
                           .ca = 1 };
  for (int k = 1; k < m.n - 1; k++)
    shape[k - 1] = marker (data.at[0], k);
  rig_open (&r, line, AIR, how->intervals, shape, m.n - 2, m.along[m.n - 2]);
  set_off (&r, &m, &data);
  h->rows = data.rows;
  for (int k = 0; r.good && k < data.rows; k++)
    {
      const double *row = data.at[k], *before = data.at[k > 0 ? k - 1 : 0];
      hold_ends (&r, &m, row, row, 0);
      for (int i = 1; k > 0 && i <= how->per; i++)
        {
          hold_ends (&r, &m, before, row, (double)i / how->per);
          rig_step (&r, (row[0] - before[0]) / how->per);
        }
      h->t[k] = row[0];
      h->ours[k] = 1000 * miss_of_markers (&r, &m, row);
      h->theirs[k] = 0;
    }
  return rig_close (&r) ? OUTSIDE_DONE : OUTSIDE_FAILED;
}
