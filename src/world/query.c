/* Questions to a dive: pure reads of its present state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/dive.h"

void
bt_dive_sea (const bt_dive *dive, bt_sea_view *view)
{
  *view = (bt_sea_view){ dive->now->depth, dive->now->density, dive->now->gravity };
}

void
bt_dive_profile (const bt_dive *dive, bt_profile *profile)
{
  *profile = dive->profile;
  profile->shape_solves = dive->counts.solves;
  profile->search_iterations = dive->counts.search_iterations;
  profile->shots = dive->counts.shots;
  profile->marches = dive->counts.marches;
  profile->relaxations = dive->counts.relaxations;
  profile->unsettled = dive->counts.unsettled;
}

bt_status
bt_dive_current_at (const bt_dive *dive, bt_vec3 p, bt_vec3 *velocity, bt_error *error)
{
  bt_water water = bt__dive_water (dive, dive->now);
  bt_vec3 v = bt_water_velocity (&water, p);
  if (!bt__is_finite (p))
    return bt__fail (error, BT_ERR_DOMAIN, "a place has finite coordinates");
  if (!bt__is_finite (v))
    return bt__fail (error, BT_ERR_DIVERGED, "the current at (%g %g %g) is not finite", p.x, p.y, p.z);
  *velocity = v;
  return BT_OK;
}

/* ---- Vehicles ---- */

bt_status
bt_dive_vehicle (const bt_dive *dive, int i, bt_vehicle_view *view, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_VEHICLE, i, error);
  const bt__vehicle *v = bt__dive_vehicle (dive, dive->now, i);
  double heading;
  if (status != BT_OK)
    return status;
  heading = fmod (v->heading, 2 * BT__PI);
  *view = (bt_vehicle_view){ .position = v->position,
                             .velocity = v->velocity,
                             .heading = heading < 0 ? heading + 2 * BT__PI : heading,
                             .pitch = v->pitch,
                             .roll = v->roll,
                             .turns = (v->heading - v->heading0) / (2 * BT__PI),
                             .arrived = v->goal == BT__GOAL_NONE,
                             .held = v->held != 0 };
  memcpy (view->sticks, v->sticks, sizeof view->sticks);
  memcpy (view->speeds, v->speeds, sizeof view->speeds);
  return BT_OK;
}

/* ---- Tethers ---- */

/* A tether with its node arrays, ready to be asked.  */
typedef struct asked
{
  const bt__tether *tether;
  const bt_vec3 *nodes, *tensions;
} asked;

static bt_status
ask (const bt_dive *dive, int i, asked *a, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status == BT_OK)
    *a = (asked){ bt__dive_tether (dive, dive->now, i), bt__dive_nodes (dive, dive->now, i),
                  bt__dive_tensions (dive, dive->now, i) };
  return status;
}

static double
tension_at (const asked *a, double s)
{
  return bt__shape_tension (&a->tether->shape, a->nodes, a->tensions, s);
}

/* The far end is pulled back along the tether.  */
static bt_vec3
end_force (const asked *a)
{
  double s = a->tether->shape.length;
  bt_vec3 t = bt__shape_tangent (&a->tether->shape, a->nodes, a->tensions, s);
  return bt__scale (-tension_at (a, s), t);
}

/* How many points show a shape that has no nodes of its own.  */
static int
natural_points (const bt__tether *tether)
{
  switch (tether->shape.form)
    {
    case BT__FORM_STRAIGHT:
      return 2;
    case BT__FORM_V:
      return 3;
    default:
      return (int)tether->props.nodes + 1;
    }
}

bt_status
bt_dive_tether (const bt_dive *dive, int i, bt_tether_view *view, bt_error *error)
{
  asked a;
  bt_status status = ask (dive, i, &a, error);
  if (status != BT_OK)
    return status;
  *view = (bt_tether_view){ .props = a.tether->props,
                            .length = a.tether->length,
                            .chord = bt__distance (a.tether->shape.a, a.tether->shape.b),
                            .tension_anchor = tension_at (&a, 0),
                            .tension_end = tension_at (&a, a.tether->shape.length),
                            .tension_max = a.tether->tension_max,
                            .force = end_force (&a),
                            .vehicle = dive->model->ends[i][1].vehicle,
                            .taut = a.tether->taut != 0,
                            .spooling = a.tether->winch_rate != 0,
                            .settled = a.tether->settled != 0,
                            .nodes = natural_points (a.tether) };
  return BT_OK;
}

static bt_status
ask_at (const bt_dive *dive, int i, double s, asked *a, bt_error *error)
{
  bt_status status = ask (dive, i, a, error);
  if (status == BT_OK && !(s >= 0 && s <= a->tether->length))
    return bt__fail (error, BT_ERR_DOMAIN, "an arc length lies in 0 to %g m, which are out, not %g",
                     a->tether->length, s);
  return status;
}

bt_status
bt_tether_point (const bt_dive *dive, int i, double s, bt_vec3 *point, bt_error *error)
{
  asked a;
  bt_status status = ask_at (dive, i, s, &a, error);
  if (status == BT_OK)
    *point = bt__shape_point (&a.tether->shape, a.nodes, a.tensions, s);
  return status;
}

bt_status
bt_tether_tangent (const bt_dive *dive, int i, double s, bt_vec3 *tangent, bt_error *error)
{
  asked a;
  bt_status status = ask_at (dive, i, s, &a, error);
  if (status == BT_OK)
    *tangent = bt__shape_tangent (&a.tether->shape, a.nodes, a.tensions, s);
  return status;
}

bt_status
bt_tether_tension (const bt_dive *dive, int i, double s, double *tension, bt_error *error)
{
  asked a;
  bt_status status = ask_at (dive, i, s, &a, error);
  if (status == BT_OK)
    *tension = tension_at (&a, s);
  return status;
}

/* The arc length of point K of N, exact at both ends.  */
static double
share (const asked *a, int k, int n)
{
  return k == n - 1 ? a->tether->shape.length : a->tether->shape.length * k / (n - 1);
}

/* The arc length of the K-th of the model's own N points: the V has one at its bend.  */
static double
natural_share (const asked *a, int k, int n)
{
  const bt__shape *shape = &a->tether->shape;
  if (shape->form == BT__FORM_V && k == 1)
    return shape->v.l1 * (shape->length / (shape->v.l1 + shape->v.l2));
  return share (a, k, n);
}

/* The arc lengths asked for by N: equally spaced, or the model's own when N is zero.  */
typedef struct sampling
{
  asked a;
  int n;
  double (*share) (const asked *a, int k, int n);
} sampling;

static bt_status
ask_many (const bt_dive *dive, int i, int n, sampling *many, bt_error *error)
{
  bt_status status = ask (dive, i, &many->a, error);
  if (status != BT_OK)
    return status;
  if (n != 0 && n < 2)
    return bt__fail (error, BT_ERR_DOMAIN, "a polyline has at least 2 points, not %d", n);
  many->n = n ? n : natural_points (many->a.tether);
  many->share = n ? share : natural_share;
  return BT_OK;
}

bt_status
bt_tether_points (const bt_dive *dive, int i, int n, bt_vec3 *points, bt_error *error)
{
  sampling m;
  bt_status status = ask_many (dive, i, n, &m, error);
  for (int k = 0; status == BT_OK && k < m.n; k++)
    points[k] = bt__shape_point (&m.a.tether->shape, m.a.nodes, m.a.tensions,
                                 m.share (&m.a, k, m.n));
  return status;
}

bt_status
bt_tether_tensions (const bt_dive *dive, int i, int n, double *tensions, bt_error *error)
{
  sampling m;
  bt_status status = ask_many (dive, i, n, &m, error);
  for (int k = 0; status == BT_OK && k < m.n; k++)
    tensions[k] = tension_at (&m.a, m.share (&m.a, k, m.n));
  return status;
}

bt_status
bt_tether_equilibria (const bt_dive *dive, int i, int max, bt_vec3 *shapes, int *found,
                      bt_error *error)
{
  asked a;
  bt_water water = bt__dive_water (dive, dive->now);
  bt_status status = ask (dive, i, &a, error);
  if (status != BT_OK)
    return status;
  if (a.tether->props.model != BT_MODEL_STEADY)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "only the model `steady' looks for equilibria");
  return bt_steady_equilibria (
      dive->tools.steady,
      &(bt_line){ a.tether->length, a.tether->props.diameter, a.tether->props.wet_weight,
                  a.tether->props.ea, a.tether->props.cdn, a.tether->props.cdt },
      &water, a.tether->shape.a, a.tether->shape.b, (int)a.tether->props.nodes, max, shapes, found,
      error);
}
