/* Static tethers that stretch, at vehicles without mass: a vehicle pulls with no more than its
   pull.

   A static model solves the shape between given ends, whatever force that takes.  Where the force
   on a vehicle is more than the vehicle's pull, the vehicle gives way along the force, as the end
   of a moving line does (contact/line_ends.c): the step is tried again from the present, with the
   end a little nearer, until the tether pulls with the vehicle's pull.  The force falls as the end
   comes nearer, steeply where the tether is nearly straight, so that false position and halving
   take turns.

   The models of the thesis do not stretch.  Their tethers end a vehicle's way where they are
   straight, and then pull with its pull by definition; just before, their tension has no bound.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"

enum
{
  TRIES = 30
};

#define NEAR 1e-3 /* of the vehicle's pull: a tether that pulls less by so little will do */
#define ROUNDING 1e-9
#define FIRST 1e-5 /* of the tether's length: what is tried first, and then ... */
#define WIDER 4.0  /* ... so many times more */
#define MOST 1.0   /* m: as far as an end slips in a step */

/* End K of tether I, which slips ALONG the force at the place WANTED.  */
typedef struct slip
{
  int i, k;
  const bt__ends *ends;
  bt_vec3 along; /* unit */
  bt__form_move *go;
  bt__present present;
  bt__ends at;      /* of the last try */
  double way, over; /* m: the way of the last try, N: how much too hard the tether then pulls */
} slip;

/* How much harder than its vehicle can pull tether I pulls at end K, N; *PULL is the force.  */
static double
overpull (const bt_dive *dive, bt__state *state, int i, int k, bt_vec3 *pull)
{
  if (!bt__slips_at (dive, state, i, k))
    return -INFINITY;
  bt__line line = bt__line_of (dive, state, i);
  *pull = bt__line_pull (&line, k);
  return bt__norm (*pull) - bt__most_pull_at (dive, state, i, k) * (1 + ROUNDING);
}

static bt_status
try_way (bt_dive *dive, bt__state *state, slip *s, double way, bt_error *error)
{
  bt_vec3 pull;
  s->way = way;
  s->at = *s->ends;
  if (s->k)
    s->at.b = bt__axpy (s->at.b, way, s->along);
  else
    s->at.a = bt__axpy (s->at.a, way, s->along);
  bt__go_back (dive, state, s->i, &s->present);
  bt_status status = s->go (dive, state, s->i, &s->at, error);
  s->over = overpull (dive, state, s->i, s->k, &pull);
  return status;
}

/* The way to try after the N-th try: between LOW, where the tether pulls too hard by OVER[0], and
   HIGH, where it pulls too little by -OVER[1].  */
static double
way_between (int n, double low, double high, const double *over)
{
  double share = over[0] / (over[0] - over[1]);
  if (n % 2 || !(share > 0.01 && share < 0.99))
    share = low > 0 ? sqrt (low * high) / high : 0.25;
  return low + fmin (fmax (share, 0.01), 0.99) * (high - low);
}

/* Find how far the end of S must slip.  Where no way is found on which the tether pulls little
   enough, the end slips as far as it may.  */
static bt_status
find_way (bt_dive *dive, bt__state *state, slip *s, double over0, bt_error *error)
{
  double most = bt__most_pull_at (dive, state, s->i, s->k), over[2] = { over0, NAN };
  double low = 0, high = NAN, way = FIRST * bt__dive_tether (dive, state, s->i)->length;
  bt_status status = BT_OK;
  for (int n = 0; n < TRIES; n++)
    {
      status = try_way (dive, state, s, fmin (way, MOST), error);
      if (status != BT_OK || (s->over <= 0 && s->over >= -NEAR * most)
          || (s->over > 0 && s->way >= MOST))
        return status;
      *(s->over > 0 ? &low : &high) = s->way;
      over[!(s->over > 0)] = s->over;
      way = isnan (high) ? WIDER * s->way : way_between (n, low, high, over);
    }
  return s->over > 0 && !isnan (high) ? try_way (dive, state, s, high, error) : status;
}

static bt_status
slip_end (bt_dive *dive, bt__state *state, slip *s, double over, bt_vec3 pull, bt_error *error)
{
  s->along = bt__unit_or (pull, bt__vec (0, 0, 0));
  bt_status status = find_way (dive, state, s, over, error);
  if (status != BT_OK)
    return status;
  int vehicle = dive->model->ends[s->i][s->k].vehicle;
  bt_vec3 here = bt__attachment (dive, state, vehicle), wanted = s->k ? s->ends->b : s->ends->a;
  if (bt__distance (here, wanted) <= 0) /* no obstacle has stopped it before */
    bt__bring_end (dive, state, s->i, s->k, s->k ? s->at.b : s->at.a);
  return BT_OK;
}

bt_status
bt__slip_to_ends (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt__form_move *go,
                  bt_error *error)
{
  if (!bt__is_spring (bt__dive_tether (dive, state, i)))
    return go (dive, state, i, ends, error);
  if (!bt__slips_at (dive, state, i, 0) && !bt__slips_at (dive, state, i, 1))
    return go (dive, state, i, ends, error);
  bt__ends at = *ends;
  slip s = { .i = i, .ends = &at, .go = go };
  bt__keep_present (dive, state, i, &s.present);
  bt_status status = go (dive, state, i, ends, error);
  for (s.k = 0; s.k < 2 && status == BT_OK; s.k++)
    {
      bt_vec3 pull;
      double over = overpull (dive, state, i, s.k, &pull);
      if (!(over > 0))
        continue;
      status = slip_end (dive, state, &s, over, pull, error);
      at = s.at;
    }
  return status;
}
