/* The string led along: a live view of the taut string, and a forecast.

   Live: bt_tether_follow leads the ends of a string kept from call to call to the ends of the
   tether, two steps of relaxation a call, and seeds the string anew from the tether's own shape
   every 300 calls or when an end cannot be led.  A string 0.5 % shorter after seeding has slipped
   off an obstacle that cannot hold the line.

   Forecast: bt_tether_foresee moves a predicted vehicle (predicted.h) on by half a second at a time
   and leads two lines after the vehicle: a copy of the taut string for bends, turns and tautness,
   and a trailing line from the tether's present shape (aware/trail.h) for what a slack line will
   touch.  The vehicle is stopped at obstacles, and held on a leash about the last bend of the
   string where friction holds the line: by the length beyond the bend if the tether pulls and lies
   straight there, or by the length paid out once the string is longer.

   The forecast knows neither current on the line, nor weight, nor the winch.  At most 64 obstacles
   are told apart.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aware/trail.h"
#include "aware/turns.h"
#include "base/error.h"
#include "math/vec.h"
#include "world/predicted.h"
#include "world/watch.h"

enum
{
  LED_STEPS = 2, /* of a string whose end has moved a little */
  SEED_STEPS = 400,
  SEED_EVERY = 300, /* calls */
  AHEAD_STEPS = 6,
  LOOKS = 5,   /* at what holds the line, in AHEAD */
  OBJECTS = 64 /* told apart in a forecast */
};

#define SLIP 0.005      /* of its length: a string shorter by more has slipped */
#define AHEAD 0.5       /* s between looks ahead */
#define TOUCH_ANGLE 0.1 /* radians: a string with more bend touches */
#define LEASH_PULL 10.0 /* N: less is the drag of a slack line */
#define LEASH_BOW 1.02  /* of its chord: a line that is held is no longer */
#define HOLD_REACH 0.05 /* m */
#define SKIN 1.3        /* of its core: the trailing line touches nearer obstacles */

/* ---- Live ---- */

/* Seed the live string from the tether; return true if the old string has slipped.  Without FORCE
   the new string is taken only if it is shorter.  */
static int
seed (const bt_dive *dive, bt__awareness *g, int force)
{
  struct bt__watch *w = dive->watch;
  double before = g->live->n < 2 ? 0 : g->live->length;
  g->followed = 0;
  if (force)
    g->live->n = 0;
  int slipped = bt__taut_reseed (w->taut, &g->config, g->live, g->shortest, g->node, g->n,
                                 SEED_STEPS, SLIP, &w->count);
  g->has_free = 0; /* the string of the free way was borrowed */
  return slipped || (before > 0 && g->live->length < (1 - SLIP) * before);
}

bt_status
bt_tether_follow (const bt_dive *dive, int i, bt_follow *out, bt_error *error)
{
  bt__awareness *g;
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
  status = bt__stopped (bt__asker_of (dive), error);
  if (status != BT_OK)
    g->live->n = 0; /* to be seeded again */
  return status;
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
  const bt__awareness *g;
  bt__string *string;
  bt__trail trail; /* the line as it lies: it may touch more than the string */
  bt__holds holds;
  object object[OBJECTS];
  uint32_t objects, touches, bumps;
  uint32_t touched[OBJECTS], met[OBJECTS]; /* by the line as it lies, by the vehicle */
  double radius;                           /* m, of the vehicle */
  bt_vec3 held;                            /* where the line is held by friction ... */
  double leash;                            /* m: ... on what is left; INFINITY: it is not */
  int reined;                              /* the leash is that of what is out */
  int taut;
  bt_foresight *out;
  int max, n;
} forecast;

static void
tell_foresight (forecast *f, bt_foresight_kind kind, uint32_t place, double seconds, double turns)
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

static int
is_among (const uint32_t *list, uint32_t n, uint32_t place)
{
  for (uint32_t k = 0; k < n; k++)
    if (list[k] == place)
      return 1;
  return 0;
}

static object *
find_object (forecast *f, uint32_t place)
{
  for (uint32_t k = 0; k < f->objects; k++)
    if (f->object[k].place == place)
      return &f->object[k];
  return NULL;
}

/* Note that the line touches PLACE; foretell a new contact if SECONDS have passed.  */
static void
note_touch (forecast *f, uint32_t place, double seconds)
{
  if (is_among (f->touched, f->touches, place) || f->touches == OBJECTS)
    return;
  f->touched[f->touches++] = place;
  if (seconds > 0)
    tell_foresight (f, BT_FORESEE_TOUCH, place, seconds, turns_about (f, place));
}

/* Note the obstacles touched by the line as it lies, from link K on.  */
static void
note_trail (forecast *f, uint32_t k, double seconds)
{
  bt__near near;
  const bt__taut_config *c = &f->g->config;
  for (; k + 1 < f->trail.n; k++)
    if (bt__trail_meet (&f->trail, k, c->scene, c->on, SKIN * c->core, &near,
                        &f->dive->watch->count))
      note_touch (f, near.object, seconds);
}

/* Note the obstacles at which the string bends; foretell a new one if SECONDS have passed.  */
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
      object *known = find_object (f, place);
      double turns = turns_about (f, place);
      int halves = (int)floor (2 * fabs (turns));
      if (known)
        {
          if (halves > known->halves)
            tell_foresight (f, BT_FORESEE_TURN, place, seconds, turns);
          known->halves = halves;
        }
      else if (f->objects < OBJECTS)
        {
          f->object[f->objects++] = (object){ place, halves };
          if (seconds > 0)
            note_touch (f, place, seconds);
        }
    }
}

static void
note_taut (forecast *f, double seconds)
{
  int taut = bt__is_taut (f->string->length, f->g->out);
  if (taut && !f->taut)
    tell_foresight (f, BT_FORESEE_TAUT, UINT32_MAX, seconds, 0);
  f->taut = taut;
}

/* ---- The vehicle ahead ---- */

/* Stop PREDICTED, coming from FROM, at the first obstacle within RADIUS of its path; foretell a new
   collision if SECONDS have passed.  */
static void
note_bump (forecast *f, bt__predicted *predicted, bt_vec3 from, double seconds)
{
  bt__near near;
  bt__link way = { from, predicted->v.position };
  if (f->g->open
      || !bt__scene_nearest (f->g->config.scene, f->g->config.on, &way, f->radius, &near,
                             &f->dive->watch->count))
    return;
  if (!is_among (f->met, f->bumps, near.object))
    {
      if (f->bumps < OBJECTS)
        f->met[f->bumps++] = near.object;
      if (seconds > 0)
        tell_foresight (f, BT_FORESEE_BUMP, near.object, seconds, 0);
    }
  bt_vec3 n = near.w.normal, on = near.w.point, to = way.b;
  double in = f->radius - bt__dot (bt__sub (to, on), n);
  bt__predicted_stop (predicted, in > 0 ? bt__axpy (to, in, n) : to, n);
}

/* A line with slack elsewhere may still pull: friction, or its own turns, hold the line at the last
   bend, and the vehicle circles the bend.  Set the leash if this is so for tether I: the tether
   pulls and is straight from the bend on.  */
static void
look_for_leash (forecast *f, int i, bt_vec3 vehicle)
{
  const bt__awareness *g = f->g;
  bt__line line = bt__line_of (f->dive, f->dive->now, i);
  uint32_t nearest = 0;
  double along = 0;
  f->leash = INFINITY;
  if (f->holds.n == 0 || bt__norm (bt__line_pull (&line, 1)) < LEASH_PULL)
    return;
  f->held = f->string->x[f->holds.at[f->holds.n - 1].node];
  for (uint32_t k = 1; k < g->n; k++)
    if (bt__distance (g->node[k], f->held) <= bt__distance (g->node[nearest], f->held))
      nearest = k;
  for (uint32_t k = nearest; k + 1 < g->n; k++)
    along += bt__distance (g->node[k], g->node[k + 1]);
  if (along < LEASH_BOW * bt__distance (g->node[nearest], g->node[g->n - 1]))
    f->leash = bt__distance (f->held, vehicle);
}

static void
hold_on_leash (const forecast *f, bt__predicted *predicted)
{
  bt_vec3 way = bt__sub (predicted->v.position, f->held);
  double far = bt__norm (way);
  if (far > f->leash)
    bt__predicted_stop (predicted, bt__axpy (f->held, f->leash / far, way),
                        bt__scale (-1 / far, way));
}

/* Hold the VEHICLE at the string's last bend if the string is longer than the line paid out.  */
static void
rein_in (forecast *f, bt_vec3 vehicle)
{
  double over = f->string->length - f->g->out;
  if (over <= 0 && f->reined)
    f->leash = INFINITY;
  f->reined = over > 0;
  if (over <= 0)
    return;
  f->held = f->string->x[f->holds.n > 0 ? f->holds.at[f->holds.n - 1].node : 0];
  f->leash = fmax (bt__distance (f->held, vehicle) - over, 0);
}

/* Lead the string on by one look ahead; return 0 if the end cannot be led.  */
static int
lead_string (forecast *f, bt__predicted *predicted, double t)
{
  bt_vec3 from = predicted->v.position;
  for (int k = 0; k < LOOKS; k++)
    {
      bt__predicted_go_on (predicted, AHEAD / LOOKS);
      hold_on_leash (f, predicted);
    }
  note_bump (f, predicted, from, t);
  if (!f->g->open)
    note_trail (f, bt__trail_lead (&f->trail, predicted->v.position), t);
  if (f->g->open)
    {
      f->string->x[1] = predicted->v.position;
      f->string->length = bt__distance (f->string->x[0], predicted->v.position);
    }
  else if (bt__taut_step (f->dive->watch->taut, &f->g->config, f->string, f->string->x[0],
                          predicted->v.position, AHEAD_STEPS, &f->dive->watch->count))
    note_holds (f, t);
  else
    return 0;
  note_taut (f, t);
  rein_in (f, predicted->v.position);
  return 1;
}

static void
run_ahead (forecast *f, int i, double seconds)
{
  int vehicle = f->dive->model->ends[i][1].vehicle;
  bt_vec3 size = f->dive->model->vehicles[vehicle].size;
  bt__predicted predicted = bt__predicted_of (f->dive, vehicle);
  f->radius = fmax (0.5 * fmax (size.x, size.y), 2 * f->g->config.core);
  f->taut = bt__is_taut (f->string->length, f->g->out);
  if (!f->g->open)
    {
      note_holds (f, 0);
      note_trail (f, 0, 0);
    }
  note_bump (f, &predicted, predicted.v.position, 0);
  look_for_leash (f, i, predicted.v.position);
  for (int k = 1; k * AHEAD <= seconds + 1e-9; k++)
    if (bt__ask (bt__asker_of (f->dive)) || !lead_string (f, &predicted, k * AHEAD))
      break;
}

bt_status
bt_tether_foresee (const bt_dive *dive, int i, double seconds, bt_foresight *out, int max, int *n,
                   bt_error *error)
{
  bt__awareness *g;
  bt_vec3 ends[2];
  bt_status status = bt__watch_taut (dive, i, &g, error);
  *n = 0;
  if (status == BT_OK && !(seconds >= 0 && seconds <= 3600))
    status = bt__fail (error, BT_ERR_DOMAIN, "a forecast is of 0 to 3600 s, not %g", seconds);
  if (status != BT_OK || dive->model->ends[i][1].vehicle < 0)
    return status;
  forecast f = { .dive = dive, .g = g, .out = out, .max = max };
  uint32_t room = g->open ? 2 : dive->watch->room;
  f.string = calloc (1, bt__string_size (room));
  f.holds = (bt__holds){ calloc (room, sizeof (bt__corner)), 0, room, 0 };
  f.trail = (bt__trail){ calloc (g->n, sizeof (bt_vec3)), calloc (g->n, sizeof (double)), 0 };
  if (f.string && f.holds.at && f.trail.x && f.trail.link)
    {
      bt__trail_lay (&f.trail, g->node, g->n);
      ends[0] = g->node[0];
      ends[1] = g->node[g->n - 1];
      f.string->room = room;
      bt__string_lay (f.string, g->open ? ends : g->taut->x, g->open ? 2 : g->taut->n);
      run_ahead (&f, i, seconds);
    }
  else
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a forecast");
  *n = f.n;
  free (f.string);
  free (f.holds.at);
  free (f.trail.x);
  free (f.trail.link);
  return status == BT_OK ? bt__stopped (bt__asker_of (dive), error) : status;
}
