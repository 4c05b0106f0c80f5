/* Questions to a dive: pure reads of its present state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/contexts.h"
#include "world/line.h"

void
bt_dive_sea (const bt_dive *dive, bt_sea_view *view)
{
  *view = (bt_sea_view){ dive->now->depth, dive->now->density, dive->now->gravity, dive->now->wave,
                         dive->now->wake != 0 };
}

void
bt_dive_current (const bt_dive *dive, bt_current *current)
{
  *current = dive->now->current;
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
  profile->links_asked = dive->contact_work.count.links;
  profile->boxes_visited = dive->contact_work.count.nodes;
  profile->pairs_measured = dive->contact_work.count.pairs;
  profile->links_clear = dive->contact_work.count.skipped_clear;
  profile->casts = dive->contact_work.count.casts;
  profile->span_solves = dive->contact_work.thesis.solves;
  profile->span_skips = dive->contact_work.thesis.skips;
  if (dive->contexts)
    profile->threads += (uint64_t)bt__workers_started (dive->contexts->workers);
}

bt_status
bt_dive_current_at (const bt_dive *dive, bt_vec3 p, bt_vec3 *velocity, bt_error *error)
{
  bt_water water = bt__dive_water (dive, dive->now);
  bt_vec3 v = bt_water_velocity (&water, p);
  if (!bt__is_finite (p))
    return bt__fail (error, BT_ERR_DOMAIN, "a place has finite coordinates");
  if (!bt__is_finite (v))
    return bt__fail (error, BT_ERR_DIVERGED, "the current at (%g %g %g) is not finite", p.x, p.y,
                     p.z);
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
                             .attachment = bt__attachment (dive, dive->now, i),
                             .size = dive->model->vehicles[i].size,
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

static bt_status
ask_line (const bt_dive *dive, int i, bt__line *line, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status == BT_OK)
    *line = bt__line_of (dive, dive->now, i);
  return status;
}

static int
line_is_stuck (const bt__line *line)
{
  return line->split ? line->split->stuck != BT__STUCK_NOT : line->tether->stuck != 0;
}

/* The straight distance between the ends of LINE: a parted one ends where it has parted.  */
static double
end_distance (const bt__line *line)
{
  const bt__shape *shape = &line->tether->shape;
  bt_vec3 end = line->tether->parted ? bt__line_node (line, bt__line_nodes (line) - 1) : shape->b;
  return bt__distance (shape->a, end);
}

bt_status
bt_dive_tether (const bt_dive *dive, int i, bt_tether_view *view, bt_error *error)
{
  bt__line line;
  const bt__tether *t;
  bt_status status = ask_line (dive, i, &line, error);
  if (status != BT_OK)
    return status;
  t = line.tether;
  *view = (bt_tether_view){ .props = t->props,
                            .length = bt__line_out (&line),
                            .drum = dive->model->tethers[i].drum,
                            .target = t->winch_rate != 0 ? t->winch_target : t->length,
                            .chord = end_distance (&line),
                            .tension_anchor = bt__line_tension (&line, 0),
                            .tension_end = bt__norm (bt__line_pull (&line, 1)),
                            .tension_max = bt__line_tension_max (&line),
                            .accuracy = bt__accuracy (t),
                            .tension_error = line.chain ? t->unsure : 0,
                            .twist = line.chain ? line.chain->twist : 0,
                            .torque_anchor = line.chain ? line.chain->torque[0] : 0,
                            .torque_end = line.chain ? line.chain->torque[1] : 0,
                            .force = bt__line_pull (&line, 1),
                            .vehicle = dive->model->ends[i][1].vehicle,
                            .taut = t->taut != 0,
                            .parted = t->parted != 0,
                            .spooling = t->winch_rate != 0 || !bt__line_has_followed (&line),
                            .stuck = line_is_stuck (&line),
                            .blocked = t->blocked != 0,
                            .settled = t->settled != 0,
                            .asleep = t->quiet >= BT__SLEEP_AFTER,
                            .nodes = bt__line_nodes (&line) };
  return BT_OK;
}

bt_status
bt_tether_error_estimate (const bt_dive *dive, int i, double *estimate, bt_error *error)
{
  bt__line line;
  bt_status status = ask_line (dive, i, &line, error);
  if (status == BT_OK)
    *estimate = bt__line_error (&line);
  return status;
}

static bt_status
ask_at (const bt_dive *dive, int i, double s, bt__line *line, bt_error *error)
{
  bt_status status = ask_line (dive, i, line, error);
  double length = status == BT_OK ? bt__line_length (line) : 0;
  if (status == BT_OK && !(s >= 0 && s <= fmax (length, line->tether->length)))
    return bt__fail (error, BT_ERR_DOMAIN, "an arc length lies in 0 to %g m, which are out, not %g",
                     length, s);
  return status;
}

bt_status
bt_tether_point (const bt_dive *dive, int i, double s, bt_vec3 *point, bt_error *error)
{
  bt__line line;
  bt_status status = ask_at (dive, i, s, &line, error);
  if (status == BT_OK)
    *point = bt__line_point (&line, s);
  return status;
}

bt_status
bt_tether_tangent (const bt_dive *dive, int i, double s, bt_vec3 *tangent, bt_error *error)
{
  bt__line line;
  bt_status status = ask_at (dive, i, s, &line, error);
  if (status == BT_OK)
    *tangent = bt__line_tangent (&line, s);
  return status;
}

bt_status
bt_tether_tension (const bt_dive *dive, int i, double s, double *tension, bt_error *error)
{
  bt__line line;
  bt_status status = ask_at (dive, i, s, &line, error);
  if (status == BT_OK)
    *tension = bt__line_tension (&line, s);
  return status;
}

/* The arc length of point K of N, exact at both ends.  */
static double
share (const bt__line *line, int k, int n)
{
  double length = bt__line_length (line);
  return k == n - 1 ? length : length * k / (n - 1);
}

static bt_status
ask_many (const bt_dive *dive, int i, int n, bt__line *line, int *points, bt_error *error)
{
  bt_status status = ask_line (dive, i, line, error);
  if (status != BT_OK)
    return status;
  if (n != 0 && n < 2)
    return bt__fail (error, BT_ERR_DOMAIN, "a polyline has at least 2 points, not %d", n);
  *points = n ? n : bt__line_nodes (line);
  return BT_OK;
}

bt_status
bt_tether_points (const bt_dive *dive, int i, int n, bt_vec3 *points, bt_error *error)
{
  bt__line line;
  int count = 0;
  bt_status status = ask_many (dive, i, n, &line, &count, error);
  for (int k = 0; k < count; k++)
    points[k] = n ? bt__line_point (&line, share (&line, k, n)) : bt__line_node (&line, k);
  return status;
}

int
bt_tether_tail (const bt_dive *dive, int i, bt_vec3 *points, int max)
{
  bt__line line, tail;
  int n;
  if (ask_line (dive, i, &line, NULL) != BT_OK || !line.tether->parted)
    return 0;
  tail = bt__line_tail (&line);
  n = bt__line_nodes (&tail);
  for (int k = 0; k < n && k < max; k++)
    points[k] = bt__line_node (&tail, k);
  return n;
}

bt_status
bt_tether_tensions (const bt_dive *dive, int i, int n, double *tensions, bt_error *error)
{
  bt__line line;
  int count = 0;
  bt_status status = ask_many (dive, i, n, &line, &count, error);
  for (int k = 0; k < count; k++)
    tensions[k]
        = n ? bt__line_tension (&line, share (&line, k, n)) : bt__line_node_tension (&line, k);
  return status;
}

#define STRAIGHT 1e-9 /* rad: what rounding turns a straight line by */

/* The radius of the circle through A, B and C; infinite where they are on a straight line.  */
static double
circle (bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  bt_vec3 u = bt__sub (b, a), v = bt__sub (c, b);
  double twice = bt__norm (bt__cross (u, v)), sides = bt__norm (u) * bt__norm (v);
  return twice > STRAIGHT * sides ? sides * bt__distance (a, c) / (2 * twice) : INFINITY;
}

bt_status
bt_tether_tightest_bend (const bt_dive *dive, int i, double *radius, bt_error *error)
{
  bt__line line;
  bt_status status = ask_line (dive, i, &line, error);
  bt_vec3 p[3];
  if (status != BT_OK)
    return status;
  *radius = INFINITY;
  for (int k = 0; k < bt__line_nodes (&line); k++)
    {
      p[k % 3] = bt__line_node (&line, k);
      if (k >= 2)
        *radius = fmin (*radius, circle (p[(k + 1) % 3], p[(k + 2) % 3], p[k % 3]));
    }
  return BT_OK;
}

bt_status
bt_tether_energy (const bt_dive *dive, int i, bt_energy *energy, bt_error *error)
{
  bt__line line;
  bt_status status = ask_line (dive, i, &line, error);
  if (status != BT_OK)
    return status;
  if (!line.chain)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "only a moving line has its energies counted");
  *energy = bt__line_energy (dive, dive->now, i);
  return BT_OK;
}

bt_status
bt_tether_equilibria (const bt_dive *dive, int i, int max, bt_vec3 *shapes, int *found,
                      bt_error *error)
{
  bt__line line;
  const bt__tether *t;
  bt_water water = bt__dive_water (dive, dive->now);
  bt_status status = ask_line (dive, i, &line, error);
  if (status != BT_OK)
    return status;
  t = line.tether;
  if (t->props.model != BT_MODEL_STEADY)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "only the model `steady' looks for equilibria");
  status = bt__dive_ready ((bt_dive *)dive, error);
  if (status != BT_OK)
    return status;
  status = bt_steady_equilibria (dive->tools.steady,
                                 &(bt_line){ t->length, t->props.diameter, t->props.wet_weight,
                                             t->props.ea, t->props.cdn, t->props.cdt },
                                 &water, t->shape.a, t->shape.b, (int)t->props.nodes, max, shapes,
                                 found, error);
  return status == BT_OK ? bt__stopped (bt__asker_of (dive), error) : status;
}
