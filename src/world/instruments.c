/* Readings of a pilot: instruments, transponders along a tether, camera; the sonar is in sonar.c.

   This file gathers the truth of the present state for the pure functions of vehicle/instruments.h,
   which add noise and faults.  A parted tether takes telemetry away.
   Transponders are points at equal arc lengths with noise from separate channels: two tethers of a
   vehicle differ.

   The camera sees a point of a tether if the point lies within sight and angles, and a ray from bow
   to point meets no obstacle; the tether is looked at every 0.1 m.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/instruments.h>

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "collide/ray.h"
#include "math/vec.h"
#include "vehicle/instruments.h"
#include "world/hull.h"
#include "world/line.h"
#include "world/obstacles.h"

const char *
bt_fault_name (bt_fault fault)
{
  switch (fault)
    {
    case BT_FAULT_COMPASS:
      return "compass";
    case BT_FAULT_DEPTH:
      return "depth";
    case BT_FAULT_SPEED:
      return "speed";
    case BT_FAULT_ALTITUDE:
      return "altitude";
    case BT_FAULT_TENSION:
      return "tension";
    case BT_FAULT_TELEMETRY:
      return "telemetry";
    case BT_FAULT_THRUSTER:
      return "thruster";
    }
  return NULL;
}

static bt__quat
attitude_of (const bt__vehicle *v)
{
  return v->rigid ? v->body.attitude : bt__quat_of (v->heading, v->pitch, v->roll);
}

/* What the winch and the ship know.  */
static void
look_at_ship (const bt_dive *dive, int tether, bt__truth *truth)
{
  bt__line line;
  if (tether < 0)
    return;
  line = bt__line_of (dive, dive->now, tether);
  truth->ship = bt__line_node (&line, 0);
  truth->tension = bt__line_tension (&line, 0);
  truth->payout = bt__line_out (&line);
}

bt_status
bt_dive_instruments (const bt_dive *dive, int i, bt_readings *readings, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_VEHICLE, i, error);
  const bt__vehicle *v = bt__dive_vehicle (dive, dive->now, i);
  bt__truth truth = { .step = dive->now->step, .time = bt__state_time (dive->now) };
  bt__instruments in;
  int tether;
  if (status != BT_OK)
    return status;
  in = v->instruments;
  tether = dive->model->led[i];
  truth.position = v->position;
  truth.velocity = v->velocity;
  truth.attitude = attitude_of (v);
  truth.turned = v->heading;
  truth.turned_from = v->heading0;
  truth.altitude = bt__dive_altitude (dive, dive->now, v->position, NULL);
  look_at_ship (dive, tether, &truth);
  if (tether >= 0 && bt__dive_tether (dive, dive->now, tether)->parted)
    in.faults |= BT_FAULT_TELEMETRY;
  *readings = bt__instruments_read (&in, &truth);
  return BT_OK;
}

int64_t
bt_dive_faults (const bt_dive *dive, int i, int64_t *lost)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, dive->now, i);
  *lost = 0;
  if (bt__check_part (dive, BT_PART_VEHICLE, i, NULL) != BT_OK)
    return 0;
  *lost = v->lost;
  return v->instruments.faults | (v->lost ? BT_FAULT_THRUSTER : 0);
}

int
bt_dive_thrusts (const bt_dive *dive, int i, double *thrust)
{
  int n;
  if (bt__check_part (dive, BT_PART_VEHICLE, i, NULL) != BT_OK
      || !bt__dive_vehicle (dive, dive->now, i)->rigid)
    return 0;
  n = (int)dive->model->types[i].n;
  memcpy (thrust, bt__dive_vehicle (dive, dive->now, i)->body.thrust, (size_t)n * sizeof *thrust);
  return n;
}

/* ---- Transponders ---- */

/* Beyond the channels of a vehicle's own instruments and of its sonar.  */
#define TRANSPONDERS ((int64_t)1 << 32)

static int64_t
seed_of (const bt_dive *dive, int tether)
{
  for (int k = 1; k >= 0; k--)
    {
      int vehicle = dive->model->ends[tether][k].vehicle;
      if (vehicle >= 0)
        return bt__dive_vehicle (dive, dive->now, vehicle)->instruments.seed;
    }
  return 1;
}

bt_status
bt_dive_transponders (const bt_dive *dive, int i, int n, double sigma, bt_vec3 *points,
                      bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  int64_t seed, first = (i + 1) * TRANSPONDERS, step = dive->now->step;
  if (status != BT_OK)
    return status;
  if (n < 2 || !(sigma >= 0 && isfinite (sigma)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "%d transponders with a noise of %g m; two or more, and 0 m or more, are "
                     "allowed",
                     n, sigma);
  status = bt_tether_points (dive, i, n, points, error);
  if (status != BT_OK || sigma == 0)
    return status;
  seed = seed_of (dive, i);
  for (int64_t k = 0; k < n; k++)
    {
      int64_t channel = first + 3 * k;
      bt_vec3 off = { bt__noise (seed, step, channel), bt__noise (seed, step, channel + 1),
                      bt__noise (seed, step, channel + 2) };
      points[k] = bt__axpy (points[k], sigma, off);
    }
  return BT_OK;
}

/* ---- Camera ---- */

typedef struct lens
{
  const bt_eye *camera;
  bt_vec3 eye;
  bt__quat attitude;
  bt__surroundings around;
} lens;

/* Return the distance of P, or INFINITY if P is outside the picture.  */
static double
distance_in_view (const lens *l, bt_vec3 p)
{
  bt_vec3 way = bt__turn_in (l->attitude, bt__sub (p, l->eye));
  double c = cos (l->camera->tilt), s = sin (l->camera->tilt);
  double ahead = c * way.y + s * way.z, up = c * way.z - s * way.y, far = bt__norm (way);
  bt__ray ray = { .from = l->eye, .range = far };
  bt__count unused = { 0 };
  bt__ray_hit hit;
  if (far > l->camera->sight || !(ahead > 0) || fabs (way.x) > ahead * tan (l->camera->width / 2)
      || fabs (up) > ahead * tan (l->camera->height / 2))
    return INFINITY;
  ray.direction = bt__unit_or (bt__sub (p, l->eye), bt__vec (0, 1, 0));
  ray.range = far * (1 - 1e-9);
  return bt__ray_cast (l->around.scene, l->around.on, l->around.mover, l->around.movers, &ray, &hit,
                       &unused)
             ? INFINITY
             : far;
}

#define LOOK_EVERY 0.1 /* m of tether */

bt_status
bt_dive_sight (const bt_dive *dive, int i, const bt_eye *camera, int tether, bt_sighting *sighting,
               bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_VEHICLE, i, error);
  const bt__vehicle *v = bt__dive_vehicle (dive, dive->now, i);
  double half = BT__PI / 2, length;
  bt__line line;
  lens l;
  if (status == BT_OK)
    status = bt__check_part (dive, BT_PART_TETHER, tether, error);
  if (status != BT_OK)
    return status;
  if (!(camera->width > 0 && camera->width / 2 < half && camera->height > 0
        && camera->height / 2 < half && camera->sight > 0 && isfinite (camera->tilt)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a camera sees less than 180 degrees, and some metres far");
  l = (lens){ .camera = camera,
              .attitude = attitude_of (v),
              .around = { .scene = dive->model->scene } };
  l.eye = bt__vehicle_bow (&dive->model->vehicles[i], v);
  if (dive->model->n_obstacles > 0)
    l.around = bt__standing (dive, dive->now, BT_PART_VEHICLE, i);
  line = bt__line_of (dive, dive->now, tether);
  length = bt__line_length (&line);
  *sighting = (bt_sighting){ 0, INFINITY };
  int n = (int)fmin (fmax (ceil (length / LOOK_EVERY), 1), 10000);
  for (int k = 0; k < n; k++)
    {
      double far = distance_in_view (&l, bt__line_point (&line, length * (k + 0.5) / n));
      sighting->nearest = fmin (sighting->nearest, far);
      sighting->length += isfinite (far) ? length / n : 0;
    }
  return BT_OK;
}
