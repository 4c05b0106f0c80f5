/* Operations on the sea and on what drifts in it: current, waves, obstacles adrift.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/ops.h"
#include "world/obstacles.h"

int
bt_current_pack (const bt_current *current, double *args)
{
  int rows = current->kind == BT_CURRENT_PROFILE ? (int)current->n : 1, n = 0;
  args[n++] = (double)current->kind;
  args[n++] = current->turn_rate;
  args[n++] = current->exponent;
  args[n++] = current->period;
  for (int i = 0; i < rows; i++)
    {
      args[n++] = current->z[i];
      args[n++] = current->velocity[i].x;
      args[n++] = current->velocity[i].y;
      args[n++] = current->velocity[i].z;
    }
  return n;
}

/* Check that every number is finite, also a number unused by the kind of current or wave.  */
static bt_status
check_finite (const double *args, int n, const char *what, bt_error *error)
{
  for (int i = 0; i < n; i++)
    if (!isfinite (args[i]))
      return bt__fail (error, BT_ERR_DOMAIN, "number %d of %s is %g; all are finite", i + 1, what,
                       args[i]);
  return BT_OK;
}

bt_status
bt_current_unpack (const double *args, int n, bt_current *current, bt_error *error)
{
  int kind = n > 4 && n <= BT_CURRENT_ARGS && args[0] >= 0 && args[0] <= BT_CURRENT_GRID
                 ? (int)args[0]
                 : -1;
  if (kind < 0 || kind != args[0] || n % 4 != 0)
    return bt__fail (error, BT_ERR_FORMAT, "these %d numbers are not a current", n);
  if (check_finite (args, n, "a current", error) != BT_OK)
    return BT_ERR_DOMAIN;
  memset (current, 0, sizeof *current);
  current->kind = kind;
  current->turn_rate = args[1];
  current->exponent = args[2];
  current->period = args[3];
  current->n = kind == BT_CURRENT_PROFILE ? (n - 4) / 4 : 0;
  for (int i = 0; i < (n - 4) / 4; i++)
    {
      const double *row = args + 4 + 4 * i;
      current->z[i] = row[0];
      current->velocity[i] = bt__vec (row[1], row[2], row[3]);
    }
  return bt_current_check (current, error);
}

int
bt_waves_pack (const bt_wave_def *waves, double *args)
{
  double all[BT_WAVES_ARGS]
      = { (double)waves->kind, waves->height,     waves->period,       waves->toward,  waves->phase,
          waves->gamma,        waves->components, (double)waves->seed, waves->accuracy };
  memcpy (args, all, sizeof all);
  return BT_WAVES_ARGS;
}

bt_status
bt_waves_unpack (const double *args, int n, bt_wave_def *waves, bt_error *error)
{
  if (n != BT_WAVES_ARGS
      || !(args[0] >= BT_WAVE_NONE && args[0] <= BT_WAVE_JONSWAP && fabs (args[7]) <= 1e15))
    return bt__fail (error, BT_ERR_FORMAT, "these numbers are not waves");
  if (check_finite (args, n, "waves", error) != BT_OK)
    return BT_ERR_DOMAIN;
  *waves = (bt_wave_def){ .kind = (int64_t)args[0],
                          .height = args[1],
                          .period = args[2],
                          .toward = args[3],
                          .phase = args[4],
                          .gamma = args[5],
                          .components = args[6],
                          .seed = (int64_t)args[7],
                          .accuracy = args[8] };
  return BT_OK;
}

/* Waves in the present sea.  */
bt_status
bt__op_waves (const bt__call *c)
{
  bt_wave_def def;
  bt_waves waves;
  bt_status status = bt_waves_unpack (c->args, c->n, &def, c->error);
  if (status != BT_OK)
    return status;
  if (def.kind == BT_WAVE_NONE)
    memset (&def, 0, sizeof def);
  status = bt_waves_make (&def, c->state->depth, c->state->gravity, &waves, c->error);
  if (status != BT_OK)
    return status;
  c->state->wave = def;
  c->state->waves = waves;
  bt__mark_all_stale (c);
  return BT_OK;
}

bt_status
bt__op_current (const bt__call *c)
{
  bt_current current;
  bt_status status = bt_current_unpack (c->args, c->n, &current, c->error);
  if (status != BT_OK)
    return status;
  if (current.kind == BT_CURRENT_FUNCTION && !c->dive->function)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED, "this dive has no function for its current");
  if (current.kind == BT_CURRENT_GRID && !c->dive->model->sea.grid)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "this world's sea has no grid: a dive takes one from its world alone");
  c->state->current = current;
  bt__mark_all_stale (c);
  return BT_OK;
}

/* Only an obstacle with a track has a scene of its own, and so can move.  */
bt_status
bt__op_drift (const bt__call *c)
{
  int k = bt__model_carried (c->dive->model, c->subject);
  bt__mover_state *mover;
  if (check_finite (c->args, c->n, "a drift", c->error) != BT_OK)
    return BT_ERR_DOMAIN;
  for (int i = 0; i < 3; i++)
    if (bt__check_range (c, i, "a part of a drift, m/s,", -BT__DRIFT_MAX, BT__DRIFT_MAX) != BT_OK)
      return BT_ERR_DOMAIN;
  if (k < 0)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "`%s' stands fast: what can drift has a track in its world, such as "
                     "(track (0 X Y Z)) for one that waits at X Y Z",
                     bt_dive_name (c->dive, BT_PART_OBSTACLE, c->subject));
  mover = &bt__dive_movers (c->dive, c->state)[k];
  mover->adrift = 1;
  mover->drift = bt__point_of (c);
  return BT_OK;
}
