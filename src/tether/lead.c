/* A line led by its two ends: see bight/lead.h.

   The ends go through the rows of a track by the cubic through four rows, in steps that divide the
   time between two rows evenly.  A flat floor is a contact constraint at every node that is near
   the floor, with Coulomb friction that remembers from step to step how far a node was dragged.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include <bight/lead.h>
#include <bight/model.h>

#include "base/error.h"
#include "math/vec.h"
#include "tether/dynamic_contact.h"

#define TOLERANCE 1e-9    /* of the length: derivatives are made of differences of results */
#define FLOOR_SINK 1e-4   /* m: how far its own weight presses a node into the floor */
#define FLOOR_SLIP 1e-3   /* m of drag from where friction is whole */
#define FLOOR_NEAR 4.0    /* diameters above the floor within which a node has a constraint */
#define SETTLE_STEP 0.05  /* s: the first step of settling */
#define SETTLE_MOST 300.0 /* s: steps of settling grow no longer than this */

enum
{
  SETTLE_STEPS = 600,
  SETTLE_LONG = 8 /* steps of the greatest length after which a line has settled */
};

typedef struct led
{
  const bt_lead_line *line;
  const bt_lead_track *track;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__dynamic_report report;
  bt__dynamic *d;
  bt__dynamic_work *work;
  bt__asker asker;
  bt__constraint *rows; /* of the floor: one for each node */
  bt_vec3 *stick;       /* m: drag of each node at the start of the step */
  bt__dynamic_set *sets;
  bt_vec3 along[2], side[2]; /* of clamps: the direction that the track tells, the first director */
  int64_t stuck;             /* intervals that STICK is of */
  int room;                  /* intervals there is memory for */
} led;

/* ---- The track ---- */

/* The row of TRACK at which the cubic for time T begins.  */
static int
first_of_four (const bt_lead_track *track, double t)
{
  int low = 0, high = track->rows - 1;
  while (high - low > 1)
    {
      int middle = (low + high) / 2;
      if (track->t[middle] <= t)
        low = middle;
      else
        high = middle;
    }
  return (int)fmax (0, fmin (low - 1, track->rows - 4));
}

/* The weights with which up to four rows from *FIRST on give what the track has at time T; return
   how many rows there are.  Before the first row and after the last the track stands still.  */
static int
row_weights (const bt_lead_track *track, double t, int *first, double weights[4])
{
  int n = track->rows < 4 ? track->rows : 4, k = first_of_four (track, t);
  t = fmin (fmax (t, track->t[0]), track->t[track->rows - 1]);
  for (int i = 0; i < n; i++)
    {
      weights[i] = 1;
      for (int j = 0; j < n; j++)
        if (j != i)
          weights[i] *= (t - track->t[k + j]) / (track->t[k + i] - track->t[k + j]);
    }
  *first = k;
  return n;
}

static bt_vec3
mix_rows (const bt_vec3 *rows, int n, const double *weights)
{
  bt_vec3 p = bt__vec (0, 0, 0);
  for (int i = 0; i < n; i++)
    p = bt__axpy (p, weights[i], rows[i]);
  return p;
}

static double
out_at (const led *l, double t)
{
  double weights[4], out = 0;
  int k, n = row_weights (l->track, t - l->track->clock, &k, weights);
  if (!l->track->out)
    return l->line->length;
  for (int i = 0; i < n; i++)
    out += weights[i] * l->track->out[k + i];
  return out;
}

/* Turn the clamp of end E to ALONG.  Its directors go with it, and the line leaves it by a tilt. */
static void
lead_clamp (led *l, int e, bt_vec3 along)
{
  bt__dynamic_end *end = &l->in.end[e];
  const double *tilt = l->line->tilt[e];
  bt_vec3 there = bt__unit_or (along, bt__vec (0, 0, 1)), *was = &l->along[e], *side = &l->side[e];
  *side = end->clamped ? bt__set_carry (*side, *was, there) : bt__set_side (there);
  *was = there;
  bt_vec3 leaves = bt__axpy (there, tan (tilt[0]), *side);
  leaves = bt__axpy (leaves, tan (tilt[1]), bt__cross (there, *side));
  end->direction = tilt[0] != 0 || tilt[1] != 0 ? bt__unit_or (leaves, there) : there;
  end->side = bt__set_carry (*side, there, end->direction);
  end->clamped = 1;
}

static void
lead_ends (led *l, double t)
{
  double weights[4];
  int k, n = row_weights (l->track, t - l->track->clock, &k, weights);
  for (int e = 0; e < 2; e++)
    {
      bt__dynamic_end *end = &l->in.end[e];
      end->at = mix_rows (l->track->end[e] + k, n, weights);
      if (!l->line->clamped)
        continue;
      lead_clamp (l, e, mix_rows (l->track->direction[e] + k, n, weights));
    }
}

/* ---- The floor ---- */

static int
floor_rows (led *l)
{
  const bt_lead_line *line = l->line;
  const bt_vec3 *x = bt__dynamic_x (l->d);
  double offset = line->floor + line->props.diameter / 2, share = line->length / line->intervals;
  double stiffness = (1 + fabs (line->props.wet_weight) * share) / FLOOR_SINK / 10;
  int n = 0;
  for (int64_t i = 0; i <= l->d->n; i++)
    {
      bt__constraint *r = &l->rows[n];
      if (x[i].z > offset + FLOOR_NEAR * line->props.diameter)
        {
          l->stick[i] = bt__vec (0, 0, 0);
          continue;
        }
      *r = (bt__constraint){ .node = i < l->d->n ? i : i - 1,
                             .s = i < l->d->n ? 0 : 1,
                             .normal = { 0, 0, 1 },
                             .offset = offset,
                             .stiffness = stiffness,
                             .friction = line->props.friction,
                             .slip = FLOOR_SLIP,
                             .stick = l->stick[i] };
      n++;
    }
  return n;
}

static void
keep_sticking (led *l, int n)
{
  for (int k = 0; k < n; k++)
    {
      const bt__constraint *r = &l->rows[k];
      double drag = bt__norm (r->drag);
      int64_t i = r->node + (r->s > 0);
      l->stick[i] = r->active == 0 ? bt__vec (0, 0, 0)
                                   : bt__scale (fmin (1, FLOOR_SLIP / fmax (drag, 1e-12)), r->drag);
    }
}

static bt_status
step_on_floor (led *l, bt_error *error)
{
  bt_status status = bt__dynamic_begin (l->d, l->work, &l->in, &l->report, error);
  if (l->stuck != l->d->n)
    for (int64_t i = 0; i <= l->d->n; i++)
      l->stick[i] = bt__vec (0, 0, 0);
  l->stuck = l->d->n;
  if (status != BT_OK)
    return status;
  int n = floor_rows (l);
  bt__dynamic_iterate (l->work, l->rows, n, NULL, &l->report);
  status = bt__dynamic_finish (l->d, l->work, NULL, &l->report, error);
  if (status == BT_OK)
    keep_sticking (l, n);
  if (status == BT_OK && l->in.pay != 0)
    bt__dynamic_wind (l->d, l->work, &l->in);
  return status;
}

/* ---- Steps ---- */

static bt_status
step_by (led *l, double h, bt_error *error)
{
  l->in.h = h;
  l->water.time += h;
  return isfinite (l->line->floor) ? step_on_floor (l, error)
                                   : bt__dynamic_step (l->d, l->work, &l->in, &l->report, error);
}

/* Let the line come to rest where its ends are: backward Euler steps that grow, without inertia in
   the end.  */
static bt_status
settle_led (led *l, bt_error *error)
{
  bt_status status = BT_OK;
  double h = SETTLE_STEP;
  for (int i = 0, long_ones = 0; i < SETTLE_STEPS && long_ones < SETTLE_LONG; i++)
    {
      status = step_by (l, h, error);
      if (status != BT_OK || bt__ask (&l->asker))
        return status;
      bt__dynamic_still (l->d);
      long_ones += h >= SETTLE_MOST && l->report.converged;
      h = l->report.converged ? fmin (1.3 * h, SETTLE_MOST) : fmax (h / 4, 0.01);
    }
  return status;
}

/* The same, and without twist: what a set twists alone is twisted from there.  */
static bt_status
rest_led (led *l, bt_error *error)
{
  bt_tether_props limp = l->line->props;
  limp.gj = 0;
  l->in.line = &limp;
  bt_status status = settle_led (l, error);
  l->in.line = &l->line->props;
  return status == BT_OK && bt__twists (&l->in) && l->in.n_sets > 0 ? settle_led (l, error)
                                                                    : status;
}

/* The velocities of START, spread along the line.  */
static void
set_going (led *l, const bt_lead_start *start)
{
  double s = 0;
  int k = 1;
  for (int64_t i = 0; i <= l->d->n; i++)
    {
      while (k < start->n - 1 && s > start->s[k])
        k++;
      double span = start->s[k] - start->s[k - 1];
      double share = span > 0 ? fmin (fmax ((s - start->s[k - 1]) / span, 0), 1) : 0;
      bt__dynamic_v (l->d)[i]
          = bt__axpy (start->v[k - 1], share, bt__sub (start->v[k], start->v[k - 1]));
      s += i < l->d->n ? bt__dynamic_rest (l->d)[i] : 0;
    }
}

/* Lay the line in a bow below its ends, or along START.  */
static bt_status
lay_led (led *l, const bt_lead_start *start, bt_error *error)
{
  double t = l->track->t[0];
  double length = out_at (l, t);
  lead_ends (l, t);
  bt_vec3 a = l->in.end[0].at, b = l->in.end[1].at;
  bt_vec3 bow[3] = { a, bt__scale (0.5, bt__add (a, b)), b };
  double span = bt__distance (a, b);
  bow[1].z -= (l->line->props.wet_weight < 0 ? -0.45 : 0.45)
              * sqrt (fmax (length * length - span * span, 1e-6 * length * length));
  if (isfinite (l->line->floor))
    bow[1].z = fmax (bow[1].z, l->line->floor + l->line->props.diameter);
  return bt__dynamic_init (l->d, l->room, l->line->intervals, start->n ? start->at : bow,
                           start->n ? start->n : 3, length, l->line->props.ea, error);
}

/* From row K - 1 to row K.  */
static bt_status
go_to_row (led *l, int k, bt_error *error)
{
  double t = l->track->t[k - 1], span = l->track->t[k] - t;
  int steps = (int)fmin (ceil (span / l->line->step - 1e-9), 1e6);
  bt_status status = BT_OK;
  for (int i = 1; i <= steps && status == BT_OK && !bt__ask (&l->asker); i++)
    {
      double h = span / steps, now = t + i * h;
      lead_ends (l, now);
      l->in.pay = l->track->out ? (out_at (l, now) - out_at (l, now - h)) / h : 0;
      status = step_by (l, h, error);
    }
  return status;
}

static bt_status
lead_all (led *l, const bt_lead_start *start, const double *marks, int n, bt_vec3 *places,
          bt_vec3 *pulls, bt_error *error)
{
  int rows = l->track->last > 0 ? l->track->last : l->track->rows;
  l->in.sets = l->sets;
  l->in.n_sets
      = bt__place_sets (l->line->sets, l->line->n_sets, out_at (l, l->track->t[0]), 0, l->sets);
  bt_status status = lay_led (l, start, error);
  if (status == BT_OK && start->n == 0)
    status = rest_led (l, error);
  else if (status == BT_OK)
    set_going (l, start);
  l->water.time = l->track->t[0];
  for (int k = 0; k < rows && status == BT_OK; k++)
    {
      l->asker.share = (double)k / rows;
      if (k > 0)
        status = go_to_row (l, k, error);
      for (int i = 0; i < n; i++)
        places[k * n + i] = bt__dynamic_point (l->d, marks[i]);
      for (int e = 0; e < 2; e++)
        pulls[2 * k + e] = l->d->pull[e];
      if (l->asker.stopped)
        return bt__stopped (&l->asker, error);
    }
  return status;
}

static bt_status
check_led (const bt_lead_line *line, const bt_lead_track *track, const bt_lead_start *start,
           bt_error *error)
{
  int rising = track->rows >= 2;
  for (int k = 1; rising && k < track->rows; k++)
    rising = track->t[k] > track->t[k - 1] && isfinite (track->t[k]);
  if (!rising || track->last > track->rows)
    return bt__fail (error, BT_ERR_DOMAIN, "a track has two rows or more, their times rising");
  if (line->intervals < BT__LEAST_INTERVALS || line->intervals > BT_LEAD_INTERVALS)
    return bt__fail (error, BT_ERR_LIMIT, "a line has %d to %d intervals, not %d",
                     BT__LEAST_INTERVALS, BT_LEAD_INTERVALS, line->intervals);
  double least = bt_tether_least_mass (&line->props, line->density, line->gravity);
  if (!(line->props.mass >= least * (1 - 1e-9)))
    return bt__fail (error, BT_ERR_DOMAIN, "a line of %g kg/m is too light: at least %.3g",
                     line->props.mass, least);
  if (!(line->step > 0) || (start->n != 0 && start->n < 2))
    return bt__fail (error, BT_ERR_DOMAIN, "a step is longer than 0 s, a start has two places");
  return BT_OK;
}

/* Intervals there must be room for: as many more as line is paid out, and as many again.  */
static int
led_room (const bt_lead_line *line, const bt_lead_track *track)
{
  double most = 0;
  for (int k = 0; track->out && k < track->rows; k++)
    most = fmax (most, track->out[k]);
  double share = track->out ? 2 * most / fmax (track->out[0], 1e-6) : 1;
  return (int)fmin (BT_LEAD_INTERVALS, line->intervals * fmax (share, 1) + (track->out ? 8 : 0));
}

bt_status
bt_lead (const bt_lead_line *line, const bt_lead_track *track, const bt_lead_start *start,
         const double *marks, int n, bt_vec3 *places, bt_vec3 *pulls, bt_poll poll, void *user,
         bt_error *error)
{
  led l = { .line = line, .track = track, .asker = { .poll = poll, .user = user } };
  bt_status status = check_led (line, track, start, error);
  if (status != BT_OK)
    return status;
  l.current.kind = bt__norm (line->current) > 0 ? BT_CURRENT_UNIFORM : BT_CURRENT_STILL;
  l.current.velocity[0] = line->current;
  l.water = (bt_water){ line->density, line->gravity, 1e4, 0, &l.current, NULL, NULL, NULL };
  l.in = (bt__dynamic_input){ .line = &line->props, .water = &l.water, .tolerance = TOLERANCE };
  l.room = led_room (line, track);
  l.d = malloc (bt__dynamic_size (l.room));
  l.work = bt__dynamic_work_new (l.room);
  l.rows = calloc ((size_t)l.room + 1, sizeof *l.rows);
  l.stick = calloc ((size_t)l.room + 1, sizeof *l.stick);
  l.sets = calloc ((size_t)line->n_sets + 1, sizeof *l.sets);
  if (l.d && l.work && l.rows && l.stick && l.sets)
    {
      bt__dynamic_ask (l.work, &l.asker);
      status = lead_all (&l, start, marks, n, places, pulls, error);
      if (status == BT_OK)
        status = bt__stopped (&l.asker, error);
    }
  else
    status = bt__fail (error, BT_ERR_LIMIT, "memory is out");
  free (l.d);
  bt__dynamic_work_free (l.work);
  free (l.rows);
  free (l.stick);
  free (l.sets);
  return status;
}
