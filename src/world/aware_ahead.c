/* What a tether is doing: the string led along, for a live view and for a forecast.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aware/turns.h"
#include "base/error.h"
#include "math/vec.h"
#include "world/watch.h"

enum
{
  LED_STEPS = 2, /* of a string whose end has moved a little */
  SEED_STEPS = 400,
  SEED_EVERY = 300, /* calls */
  AHEAD_STEPS = 6,
  OBJECTS = 64 /* told apart in a forecast */
};

#define SLIP 0.005      /* of its length: a string that is so much shorter has slipped */
#define AHEAD 0.5       /* s between looks ahead */
#define TOUCH_ANGLE 0.1 /* radians: a string that bends so much touches */
#define HOLD_REACH 0.05 /* m */
#define TAUT 1e-3       /* share of what is out: no more is slack */

/* ---- Live ---- */

/* Seed the live string from the tether; return nonzero if one was there and has slipped.  Without
   FORCE only a shorter one is taken.  */
static int
seed (const bt_dive *dive, bt__gaze *g, int force)
{
  struct bt__watch *w = dive->watch;
  double before = g->live->n < 2 ? 0 : g->live->length;
  g->followed = 0;
  if (force)
    g->live->n = 0;
  int slipped = bt__taut_reseed (w->taut, &g->config, g->live, g->shortest, g->node, g->n,
                                 SEED_STEPS, SLIP, &w->count);
  g->has_free = 0; /* its string was borrowed */
  return slipped || (before > 0 && g->live->length < (1 - SLIP) * before);
}

bt_status
bt_tether_follow (const bt_dive *dive, int i, bt_follow *out, bt_error *error)
{
  bt__gaze *g;
  bt_status status = bt__watch_look (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  *out = (bt_follow){ .length = g->taut_length, .nodes = 2 };
  if (g->open)
    return BT_OK;
  if (!g->live && !(g->live = bt__watch_string (dive)))
    return bt__fail (error, BT_ERR_LIMIT, "no memory to follow a string");
  int led = g->live->n >= 2
            && bt__taut_step (dive->watch->taut, &g->config, g->live, g->node[0], g->node[g->n - 1],
                              LED_STEPS, &dive->watch->count);
  if (!led || ++g->followed >= SEED_EVERY)
    out->slipped = seed (dive, g, !led);
  out->length = bt__string_length (&g->config, g->live, &dive->watch->count);
  out->nodes = (int)g->live->n;
  return BT_OK;
}

/* ---- The vehicle ahead ---- */

/* Where a vehicle will be that goes on as it goes.  */
typedef struct ghost
{
  bt_vec3 at, velocity;
  double heading, yaw; /* radians, radians/s */
} ghost;

/* By its sticks if it goes where it is told, to its goal if it has one, else as it moves now.  */
static ghost
ghost_of (const bt__vehicle *v)
{
  ghost ghost = { v->position, v->velocity, v->heading, v->sticks[3] * v->speeds[3] };
  double ahead = v->sticks[0] * v->speeds[0], aside = v->sticks[1] * v->speeds[1];
  double s = sin (v->heading), c = cos (v->heading);
  if (v->goal == BT__GOAL_POINT || v->goal == BT__GOAL_FLY)
    ghost.yaw = 0;
  else if (!v->rigid && v->goal == BT__GOAL_NONE)
    ghost.velocity
        = bt__vec (ahead * s + aside * c, ahead * c - aside * s, v->sticks[2] * v->speeds[2]);
  return ghost;
}

static void
go_to_goal (const bt__vehicle *v, ghost *g, double seconds)
{
  bt_vec3 way = bt__sub (v->target, g->at);
  double left = bt__norm (way), step = v->target_speed * seconds;
  g->at = left > step ? bt__axpy (g->at, step / left, way) : v->target;
}

/* On by SECONDS; velocity turns with the heading, clockwise.  */
static void
go_on (const bt__vehicle *v, ghost *g, double seconds)
{
  if (v->goal == BT__GOAL_POINT || v->goal == BT__GOAL_FLY)
    {
      go_to_goal (v, g, seconds);
      return;
    }
  double turn = g->yaw * seconds, s = sin (0.5 * turn), c = cos (0.5 * turn);
  bt_vec3 u = g->velocity;
  for (int half = 0; half < 2; half++)
    {
      u = bt__vec (u.x * c + u.y * s, u.y * c - u.x * s, u.z);
      if (half == 0)
        g->at = bt__axpy (g->at, seconds, u);
    }
  g->velocity = u;
  g->heading += turn;
}

/* ---- The forecast ---- */

typedef struct object
{
  uint32_t place;
  int halves; /* of turns about it */
} object;

typedef struct forecast
{
  const bt_dive *dive;
  const bt__gaze *g;
  bt__string *string;
  bt__holds holds;
  object object[OBJECTS];
  uint32_t objects;
  int taut;
  bt_foresight *out;
  int max, n;
} forecast;

static void
tell (forecast *f, bt_foresight_kind kind, uint32_t place, double seconds, double turns)
{
  int id = place == UINT32_MAX ? -1 : (int)f->dive->model->scene->object[place].id;
  if (f->n < f->max)
    f->out[f->n++] = (bt_foresight){ kind, id, seconds, turns };
}

static double
turns_about (const forecast *f, uint32_t place)
{
  bt__axis axis;
  if (!bt__axis_of (&f->dive->model->scene->object[place], &axis))
    return 0;
  return bt__turns (&axis, f->string->x, f->string->n);
}

static object *
find (forecast *f, uint32_t place)
{
  for (uint32_t k = 0; k < f->objects; k++)
    if (f->object[k].place == place)
      return &f->object[k];
  return NULL;
}

/* Note what the string bends at, telling of what is new if SECONDS have passed.  */
static void
note_holds (forecast *f, double seconds)
{
  bt__holds_find (f->g->config.scene, f->g->config.on, f->string->x, f->string->n,
                  f->g->config.core, HOLD_REACH, &f->holds, &f->dive->watch->count);
  for (uint32_t k = 0; k < f->holds.n; k++)
    {
      uint32_t place = f->holds.at[k].object;
      if (bt__holds_wrap (&f->holds, place) < TOUCH_ANGLE)
        continue;
      object *known = find (f, place);
      double turns = turns_about (f, place);
      int halves = (int)floor (2 * fabs (turns));
      if (known)
        {
          if (halves > known->halves)
            tell (f, BT_FORESEE_TURN, place, seconds, turns);
          known->halves = halves;
        }
      else if (f->objects < OBJECTS)
        {
          f->object[f->objects++] = (object){ place, halves };
          if (seconds > 0)
            tell (f, BT_FORESEE_TOUCH, place, seconds, turns);
        }
    }
}

static void
note_taut (forecast *f, double seconds)
{
  int taut = f->string->length >= (1 - TAUT) * f->g->out;
  if (taut && !f->taut)
    tell (f, BT_FORESEE_TAUT, UINT32_MAX, seconds, 0);
  f->taut = taut;
}

/* What stands within RADIUS of the way from A to B, UINT32_MAX: nothing.  */
static uint32_t
in_the_way (const forecast *f, bt_vec3 a, bt_vec3 b, double radius)
{
  bt__near near;
  bt__link way = { a, b };
  int hit = bt__scene_nearest (f->g->config.scene, f->g->config.on, &way, radius, &near,
                               &f->dive->watch->count);
  return hit ? near.object : UINT32_MAX;
}

/* Lead the string on by a look ahead; zero when it ends here.  */
static int
look_ahead (forecast *f, const bt__vehicle *v, ghost *ghost, double radius, double t)
{
  bt_vec3 from = ghost->at;
  go_on (v, ghost, AHEAD);
  uint32_t bump = f->g->open ? UINT32_MAX : in_the_way (f, from, ghost->at, radius);
  if (bump != UINT32_MAX && in_the_way (f, from, from, radius) == UINT32_MAX)
    {
      tell (f, BT_FORESEE_BUMP, bump, t, 0);
      return 0;
    }
  if (f->g->open)
    {
      f->string->x[1] = ghost->at;
      f->string->length = bt__distance (f->string->x[0], ghost->at);
    }
  else if (!bt__taut_step (f->dive->watch->taut, &f->g->config, f->string, f->string->x[0],
                           ghost->at, AHEAD_STEPS, &f->dive->watch->count))
    {
      tell (f, BT_FORESEE_BUMP, bump, t, 0);
      return 0;
    }
  else
    note_holds (f, t);
  note_taut (f, t);
  return !f->taut;
}

static bt_status
run_ahead (forecast *f, int vehicle, double seconds)
{
  const bt__vehicle *v = bt__dive_vehicle (f->dive, f->dive->now, vehicle);
  bt_vec3 size = f->dive->model->vehicles[vehicle].size;
  double radius = fmax (0.5 * cbrt (size.x * size.y * size.z), 2 * f->g->config.core);
  ghost ghost = ghost_of (v);
  f->taut = f->string->length >= (1 - TAUT) * f->g->out;
  if (!f->g->open)
    note_holds (f, 0);
  for (int k = 1; k * AHEAD <= seconds + 1e-9; k++)
    if (!look_ahead (f, v, &ghost, radius, k * AHEAD))
      break;
  return BT_OK;
}

bt_status
bt_tether_foresee (const bt_dive *dive, int i, double seconds, bt_foresight *out, int max, int *n,
                   bt_error *error)
{
  bt__gaze *g;
  bt_vec3 ends[2];
  bt_status status = bt__watch_gaze (dive, i, &g, error);
  *n = 0;
  if (status == BT_OK && !(seconds >= 0 && seconds <= 3600))
    status = bt__fail (error, BT_ERR_DOMAIN, "a forecast is of 0 to 3600 s, not %g", seconds);
  if (status != BT_OK || dive->model->ends[i][1].vehicle < 0)
    return status;
  forecast f = { .dive = dive, .g = g, .out = out, .max = max };
  uint32_t room = g->open ? 2 : dive->watch->room;
  f.string = calloc (1, bt__string_size (room));
  f.holds = (bt__holds){ calloc (room, sizeof (bt__corner)), 0, room, 0 };
  if (f.string && f.holds.at)
    {
      ends[0] = g->node[0];
      ends[1] = g->node[g->n - 1];
      f.string->room = room;
      bt__string_lay (f.string, g->open ? ends : g->taut->x, g->open ? 2 : g->taut->n);
      status = run_ahead (&f, dive->model->ends[i][1].vehicle, seconds);
    }
  else
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a forecast");
  *n = f.n;
  free (f.string);
  free (f.holds.at);
  return status;
}
