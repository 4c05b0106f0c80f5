/* The values allowed in the block of a moving line from outside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "tether/dynamic.h"

/* A line far from everything may go any way before it is looked at.  */
static const bt__member drift[] = {
  BT__WITHIN (bt__dynamic_drift, way, -BT__HUGE, INFINITY),
  BT__WITHIN (bt__dynamic_drift, turned, -BT__HUGE, INFINITY),
  BT__WITHIN (bt__dynamic_drift, apart, -BT__HUGE, INFINITY),
};
static const bt__record drift_record = BT__RECORD (bt__dynamic_drift, "drift", drift);

static const bt__member dynamic[] = {
  BT__WITHIN (bt__dynamic, n, 1, BT__MANY),
  BT__WITHIN (bt__dynamic, n_max, 1, BT__MANY),
  BT__TRUTH (bt__dynamic, history),
  BT__WITHIN (bt__dynamic, h, 0, BT__FAR),
  BT__WITHIN (bt__dynamic, piece, 0, BT__FAR),
  BT__WITHIN (bt__dynamic, owed, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__dynamic, pull, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__dynamic, most, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__dynamic, left, -BT__HUGE, BT__HUGE),
  BT__OF (bt__dynamic, step, drift_record),
  BT__OF (bt__dynamic, spare, drift_record),
  BT__WITHIN (bt__dynamic, fastest, 0, INFINITY),
  BT__ANY (bt__dynamic, seen),
  BT__WITHIN (bt__dynamic, wait, 0, BT__MANY),
  BT__WITHIN (bt__dynamic, least, 1, BT__LEAST_INTERVALS),
  BT__WITHIN (bt__dynamic, rounded, 0, 1),
  BT__TRUTH (bt__dynamic, gripped),
  BT__WITHIN (bt__dynamic, grip, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__dynamic, twist, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__dynamic, torque, -BT__HUGE, BT__HUGE),
};
const bt__record bt__dynamic_record = BT__RECORD (bt__dynamic, "chain", dynamic);

/* What is in use of an array behind the head.  */
typedef struct row
{
  const char *what;
  const double *at;
  size_t n;
  double low, high;
} row;

static bt_status
judge_arrays (bt__judge *judge, const bt__dynamic *d)
{
  size_t nodes = 3 * ((size_t)d->n + 1), intervals = (size_t)d->n;
  const row rows[] = {
    { "places", &bt__dynamic_x (d)->x, nodes, -BT__FAR, BT__FAR },
    { "velocities", &bt__dynamic_v (d)->x, nodes, -BT__FAR, BT__FAR },
    { "motions", &bt__dynamic_dx (d)->x, nodes, -BT__FAR, BT__FAR },
    { "former velocities", &bt__dynamic_vp (d)->x, nodes, -BT__FAR, BT__FAR },
    { "loads", &bt__dynamic_load (d)->x, nodes, -BT__HUGE, BT__HUGE },
    { "tensions", bt__dynamic_tension (d), intervals, -BT__HUGE, BT__HUGE },
    { "rest lengths", bt__dynamic_rest (d), intervals, 0, BT__FAR },
    { "stretches", bt__dynamic_stretch (d), intervals, 0, BT__HUGE },
    { "changes of stretch", bt__dynamic_dstretch (d), intervals, -BT__HUGE, BT__HUGE },
    { "chords", &bt__dynamic_chord (d)->x, 3 * intervals, -BT__FAR, BT__FAR },
  };
  bt_status status = BT_OK;
  for (size_t k = 0; k < sizeof rows / sizeof *rows && status == BT_OK; k++)
    status
        = bt__judge_reals (judge, rows[k].what, rows[k].at, rows[k].n, rows[k].low, rows[k].high);
  return status;
}

static int
has_lengths (const bt__dynamic *d)
{
  const double *rest = bt__dynamic_rest (d);
  int64_t j = 0;
  while (j < d->n && rest[j] > 0)
    j++;
  return j == d->n;
}

bt_status
bt__dynamic_judge (bt__judge *judge, const bt__dynamic *d, int room)
{
  bt_status status = bt__judge_records (judge, &bt__dynamic_record, d, 1);
  if (status == BT_OK)
    status = bt__judge_count (judge, "intervals of room", d->n_max, room, room);
  if (status == BT_OK)
    status = bt__judge_count (judge, "intervals", d->n, 1, room);
  if (status == BT_OK)
    status = judge_arrays (judge, d);
  if (status == BT_OK)
    status = bt__judge_that (judge, has_lengths (d), "every interval of its chain has a length");
  return status;
}
