/* A dive begins, and steps.

   The whole step stands in bt__step_aside: vehicles move, winches turn, taut tethers hold, changed
   tethers are solved, and only then does the new state become the present.  A step in which all
   that is known already is taken in place (glide.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/share.h"
#include "world/obstacles.h"
#include "world/watch.h"

/* ---- Begin ---- */

static double
radians (double degrees)
{
  return degrees * (BT__PI / 180);
}

static void
launch_instruments (bt__instruments *in, const bt_vehicle_def *def)
{
  *in = (bt__instruments){ .seed = (int64_t)def->seed,
                           .compass_noise = radians (def->compass_noise),
                           .depth_noise = def->depth_noise,
                           .speed_noise = def->speed_noise,
                           .altitude_noise = def->altitude_noise,
                           .range_noise = def->range_noise,
                           .bearing_noise = radians (def->bearing_noise),
                           .tension_noise = def->tension_noise,
                           .counter_noise = def->counter_noise };
}

static void
launch (bt__vehicle *v, const bt_vehicle_def *def)
{
  v->position = def->at;
  v->heading = v->heading0 = radians (def->heading);
  v->pitch = radians (def->pitch);
  v->roll = radians (def->roll);
  v->speeds[0] = def->surge_speed;
  v->speeds[1] = def->sway_speed;
  v->speeds[2] = def->heave_speed;
  v->speeds[3] = radians (def->yaw_rate);
  v->pull = def->pull;
  launch_instruments (&v->instruments, def);
}

/* What VALUE of speed a steady FORCE makes against drag: lin v + quad v v = force.  */
static double
terminal_speed (double force, double linear, double quadratic)
{
  double root = sqrt (linear * linear + 4 * quadratic * force);
  return force > 0 && linear + root > 0 ? fmin (100, 2 * force / (linear + root)) : 0;
}

/* One with mass does at full stick what its thrust makes of it.  */
static void
launch_body (bt__vehicle *v, const bt__vehicle_type *type, const bt__rig *rig)
{
  v->rigid = 1;
  v->volts = type->volts;
  v->pilot.holds = BT__HOLD_LEVEL;
  v->pull = rig->most[BT__SURGE];
  for (int k = 0; k < 3; k++)
    v->speeds[k] = terminal_speed (rig->most[k], type->hydro.linear[k], type->hydro.quadratic[k]);
  bt__rigid_place (&v->body, v->position, v->heading, v->pitch, v->roll);
  bt__mirror_body (v);
  v->heading0 = v->heading;
}

static void
fill (const bt_dive *dive, bt__state *state)
{
  const bt_model *model = dive->model;
  state->depth = model->sea.depth;
  state->density = model->sea.density;
  state->gravity = model->sea.gravity;
  state->current = model->sea.current;
  state->wake = model->sea.wake != 0;
  state->wave = model->sea.waves;
  state->waves = model->waves;
  for (int i = 0; i < model->n_vehicles; i++)
    {
      bt__vehicle *v = bt__dive_vehicle (dive, state, i);
      launch (v, &model->vehicles[i]);
      if (model->vehicles[i].mass > 0)
        launch_body (v, &model->types[i], &model->rigs[i]);
    }
  for (int i = 0; i < model->n_tethers; i++)
    {
      bt__tether *tether = bt__dive_tether (dive, state, i);
      tether->props = model->tethers[i].props;
      tether->length = model->tethers[i].length;
      tether->stale = 1;
      tether->slack_at = -1;
    }
  bt__obstacles_init (dive, state);
}

/* Put the parts of DIVE in their places, and lay its tethers.  */
static bt_status
begin (bt_dive *dive, bt_error *error)
{
  bt_status status = bt__dive_ready (dive, error);
  if (status != BT_OK)
    return status;
  fill (dive, bt__dive_begin (dive));
  bt__hold_at_tethers (dive, dive->next, dive->next);
  if (bt__has_obstacles (dive))
    bt__rest_movers (dive, dive->next);
  status = bt__resolve_tethers (dive, dive->next, 0, error);
  if (status != BT_OK)
    return status;
  bt__dive_commit (dive);
  return bt__watch_prepare (dive, error);
}

bt_status
bt_dive_new_polled (bt_model *model, bt_current_function function, void *user, bt_poll poll,
                    void *poll_user, bt_dive **out, bt_error *error)
{
  bt_dive *dive;
  bt_status status;
  if (model->sea.current.kind == BT_CURRENT_FUNCTION && !function)
    return bt__fail (error, BT_ERR_DEF, "this world's current is a function, and none was given");
  status = bt__dive_alloc (model, &dive, error);
  if (status != BT_OK)
    return status;
  dive->function = function;
  dive->user = user;
  bt_dive_set_poll (dive, poll, poll_user);
  status = begin (dive, error);
  if (status == BT_OK)
    *out = dive;
  else
    bt_dive_free (dive);
  return status;
}

bt_status
bt_dive_new (bt_model *model, bt_current_function function, void *user, bt_dive **out,
             bt_error *error)
{
  return bt_dive_new_polled (model, function, user, NULL, NULL, out, error);
}

/* ---- Step ---- */

static int
agree (bt_dive *dive, bt__state *next)
{
  int vehicles = bt__vehicles_agree (dive, next);
  int hulls = bt__hulls_agree (dive, next);
  return vehicles && hulls && bt__around_agrees (dive);
}

/* A try is taken back: no step of a line was taken since BEFORE was counted, the work stays.  */
static void
forget_try (bt_dive *dive, const bt_profile *before)
{
  dive->profile.chain_steps = before->chain_steps;
  dive->profile.chain_unconverged = before->chain_unconverged;
}

/* Step the copy; after ROUND tries at it tethers, vehicles and obstacles did not fit together.  */
static bt_status
try_once (bt_dive *dive, int round, bt_error *error)
{
  bt__state *next = bt__dive_begin (dive);
  bt_status status;
  next->step++;
  if (round == 0)
    bt__unpin_vehicles (dive, next);
  bt__move_vehicles (dive, next);
  status = bt__steer_bodies (dive, next, error);
  if (status == BT_OK)
    status = bt__step_bodies (dive, next, error);
  if (status != BT_OK)
    return status;
  if (round == BT__TRIES)
    bt__stall_where_held (dive, next);
  bt__turn_winches (dive, next);
  bt__hold_at_tethers (dive, dive->now, next);
  bt__aim_hulls (dive, round);
  if (bt__has_obstacles (dive))
    bt__aim_movers (dive, next, round);
  if (bt__has_obstacles (dive) || round > 0)
    bt__pin_vehicles (dive, next, round);
  return bt__resolve_tethers (dive, next, 1, error);
}

/* The same, shared out over the threads of DIVE if there are several.  A refused attempt is
   repeated by one thread (share.c).  All is repeated while lines ahead of the present were met
   (chain_apart.c).  */
static bt_status
try_step (bt_dive *dive, int round, const bt_profile *before, bt_error *error)
{
  bt_status status;
  do
    {
      forget_try (dive, before);
      if (dive->contexts)
        bt__share_begin (dive);
      status = try_once (dive, round, error);
      if (dive->contexts && bt__share_refused (dive) && status != BT_ERR_INTERRUPTED)
        {
          forget_try (dive, before);
          status = try_once (dive, round, error);
        }
    }
  while (status == BT_OK && bt__bar_stretches (dive));
  return status;
}

/* What a step had to do with bodies, waves and lee.  */
static void
count_work (bt_dive *dive)
{
  const bt_model *model = dive->model;
  bt__state *state = dive->next;
  uint64_t bodies = 0, places = 0;
  for (int i = 0; i < model->n_vehicles; i++)
    bodies += bt__dive_vehicle (dive, state, i)->rigid != 0;
  for (int i = 0; i < model->n_tethers; i++)
    {
      const bt__tether *tether = bt__dive_tether (dive, state, i);
      if (bt__is_awake (tether))
        places += (uint64_t)bt__chain_in_use (dive, state, i)->n + 1;
    }
  dive->profile.body_steps += bodies;
  dive->profile.wave_samples += state->waves.n > 0 ? bodies + places : 0;
  dive->profile.lee_samples += state->wake && model->lees ? bodies + places : 0;
}

bt_status
bt__step_aside (bt_dive *dive, bt_error *error)
{
  memset (dive->contact_work.barred, 0, (size_t)dive->model->n_tethers);
  bt_profile before = dive->profile;
  bt_status status = try_step (dive, 0, &before, error);
  for (int round = 1; status == BT_OK && round <= BT__TRIES && !agree (dive, dive->next); round++)
    status = try_step (dive, round, &before, error);
  bt__settle_movers (dive, dive->next);
  bt__note_all_partings (dive, dive->next);
  if (status != BT_OK)
    return status;
  bt__note_all_stuck (dive, dive->next);
  bt__watch_props (dive, dive->next);
  count_work (dive);
  bt__dive_commit (dive);
  if (bt__has_obstacles (dive))
    status = bt__note_windings (dive, error);
  if (status != BT_OK)
    bt__dive_commit (dive); /* the state before it is the present again */
  else
    dive->profile.steps++;
  return status;
}

int64_t
bt_dive_steps (const bt_dive *dive)
{
  return dive->now->step;
}

double
bt_dive_time (const bt_dive *dive)
{
  return bt__state_time (dive->now);
}

double
bt_dive_time_step (const bt_dive *dive)
{
  (void)dive;
  return BT__TIME_STEP;
}

double
bt_dive_carried (const bt_dive *dive)
{
  return dive->wished;
}

void
bt_dive_carry (bt_dive *dive, double seconds)
{
  dive->wished = seconds;
}

bt_status
bt_dive_whole_steps (bt_dive *dive, double seconds, int64_t *steps, bt_error *error)
{
  double wished, whole;
  if (!(seconds >= 0 && seconds <= 1e9))
    return bt__fail (error, BT_ERR_DOMAIN, "a time to run is 0 to 1e9 s, not %g", seconds);
  wished = dive->wished + seconds;
  /* Ten times 0.1 s must be 60 steps though 0.1 has no exact double.  */
  whole = floor (wished / BT__TIME_STEP + 1e-6);
  dive->wished = wished - whole * BT__TIME_STEP;
  *steps = (int64_t)whole;
  return BT_OK;
}
