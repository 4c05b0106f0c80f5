/* The bottom below a place: the bed, an obstacle on the bed, or else the stated depth of the sea.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/instruments.h>

#include "base/error.h"
#include "collide/ray.h"
#include "math/vec.h"
#include "world/obstacles.h"

/* Nothing is lower than this.  */
static double
lowest (const bt_dive *dive, const bt__surroundings *around)
{
  double z = dive->model->lowest;
  for (uint32_t k = 0; k < around->movers; k++)
    z = fmin (z, around->mover[k].motion.from.origin.z - around->mover[k].radius);
  return z;
}

static int
obstacle_hit (const bt_model *model, const bt__ray_hit *hit)
{
  return hit->mover == BT__NO_MOVER ? (int)model->scene->object[hit->object].id
                                    : model->carried[hit->mover].obstacle;
}

double
bt__altitude_among (const bt_dive *dive, bt__state *state, const bt__surroundings *around,
                    bt_vec3 p, int *obstacle)
{
  bt__ray down = { p, { 0, 0, -1 }, 0 };
  bt__count unused = { 0 };
  bt__ray_hit hit;
  int found = 0;
  if (dive->model->n_obstacles > 0)
    {
      /* A ray that ends exactly at the lowest bottom may miss the bottom by rounding.  */
      down.range = fmax (0, p.z - lowest (dive, around)) + 1;
      found = bt__ray_cast (around->scene, around->on, around->mover, around->movers, &down, &hit,
                            &unused);
    }
  if (obstacle)
    *obstacle = found ? obstacle_hit (dive->model, &hit) : BT__NO_OBSTACLE;
  return found ? hit.range : p.z + state->depth;
}

double
bt__dive_altitude (const bt_dive *dive, bt__state *state, bt_vec3 p, int *obstacle)
{
  bt__surroundings around = { 0 };
  if (dive->model->n_obstacles > 0)
    around = bt__all_standing (dive, state);
  return bt__altitude_among (dive, state, &around, p, obstacle);
}

double
bt__dive_altitude_max (const bt_dive *dive, bt__state *state)
{
  double low = dive->model->lowest;
  return fmax (state->depth, isfinite (low) ? -low : 0);
}

bt_status
bt_dive_altitude (const bt_dive *dive, bt_vec3 p, double *altitude, int *obstacle, bt_error *error)
{
  if (!bt__is_finite (p))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "an altitude is asked for at a place that is not finite");
  *altitude = bt__dive_altitude (dive, dive->now, p, obstacle);
  return BT_OK;
}
