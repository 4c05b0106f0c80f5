/* Hauling by the instant rule, the way home, the loop that unwinds, the string to another place.

   This file binds the geometry of aware/haul.c to a dive: the dead vehicle is a body with its
   type's mass, volume and surge drag, its hull's size and a friction of 0.4; a kinematic vehicle
   without drag takes 60 N s/m and 100 N s2/m2.  The least pull that counts as coming home is the
   drag at 0.2 m/s.

   The instant rule asks in turn: capstan friction and hang-up along the taut string, surfaces that
   face each other beside the string, and gaps on the way home too narrow for the body.  A fork of
   the dive that hauls is the judge; the rule answers at once.

   Ways are for a vehicle that flies and turns as it likes: they keep half the hull's diagonal and
   15 cm more from obstacles where there is room, and are feasible if the clearance is at least half
   the diagonal.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/ways.h"

#define BODY_FRICTION 0.4 /* of a hull on obstacles: caught most in trials */
#define LEAST_SPEED 0.2   /* m/s: slower is not coming home */
#define LEAST_RADIUS 0.05 /* m: of a way, for a vehicle that is a point */
#define GAP_ROOM 0.02     /* m, beyond the radius: of what is hauled through a gap */
#define WAY_ROOM 0.15     /* m, beyond the reach of the hull: corners are not flown exactly */

/* A string whose end is led somewhere: m at a time, pieces at most, and steps after each and after
   the last.  */
#define LEAD 0.25
enum
{
  LEAD_MOST = 256,
  LED_STEPS = 2,
  SETTLE_STEPS = 400
};

/* Drag assumed for a kinematic vehicle, linear and quadratic: N s/m, N s2/m2.  */
#define DRAG1 60.0
#define DRAG2 100.0

/* ---- The body ---- */

bt_status
bt__vehicle_at_end (const bt_dive *dive, int i, int *vehicle, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status != BT_OK)
    return status;
  *vehicle = dive->model->ends[i][1].vehicle;
  if (*vehicle < 0)
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "no vehicle is at the far end of `%s' that could be hauled or fly",
                     dive->model->tethers[i].name);
  return BT_OK;
}

static double
hull_radius (const bt_dive *dive, int vehicle)
{
  bt_vec3 size = dive->model->vehicles[vehicle].size;
  return 0.5 * cbrt (size.x * size.y * size.z);
}

double
bt__way_reach (const bt_dive *dive, int vehicle)
{
  return 0.5 * bt__norm (dive->model->vehicles[vehicle].size);
}

double
bt__way_room (double reach)
{
  return fmax (reach, LEAST_RADIUS) + WAY_ROOM;
}

/* Weight in the present water, N; 0 for a vehicle without mass.  */
static double
weight_of (const bt_dive *dive, int vehicle)
{
  const bt__vehicle_type *type = &dive->model->types[vehicle];
  bt_water water = bt__dive_water (dive, dive->now);
  return (type->mass - water.density * type->volume) * water.gravity;
}

static bt__haul_body
body_of (const bt_dive *dive, int vehicle, double winch, double grip)
{
  const bt__hydro *hydro = &dive->model->types[vehicle].hydro;
  double linear = hydro->linear[BT__SURGE], quadratic = hydro->quadratic[BT__SURGE];
  int slips = linear == 0 && quadratic == 0;
  bt_vec3 size = dive->model->vehicles[vehicle].size;
  bt__haul_body body = { .radius = hull_radius (dive, vehicle),
                         .reach = 0.5 * fmax (size.x, fmax (size.y, size.z)),
                         .friction = BODY_FRICTION,
                         .weight = weight_of (dive, vehicle),
                         .drag1 = slips ? DRAG1 : linear,
                         .drag2 = slips ? DRAG2 : quadratic,
                         .winch = winch,
                         .grip = grip };
  body.least = body.drag1 * LEAST_SPEED + body.drag2 * LEAST_SPEED * LEAST_SPEED;
  return body;
}

int
bt__obstacle_at (const bt_dive *dive, uint32_t place)
{
  return place == UINT32_MAX ? -1 : (int)dive->model->scene->object[place].id;
}

/* ---- The instant rule ---- */

/* Tell in P if the body does not fit through a gap on the way home.  */
static bt_status
look_for_wedges (const bt_dive *dive, bt__awareness *g, const bt__haul_body *body, bt__prospect *p,
                 bt_error *error)
{
  bt__string *home = bt__watch_string (dive);
  if (!home)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a way home");
  bt__route way = bt__way_home (dive->watch->taut, &g->config, g->taut, body->radius + GAP_ROOM,
                                home, &dive->watch->count);
  bt__haul_wedge (&way, body, p);
  free (home);
  return bt__stopped (bt__asker_of (dive), error);
}

bt_status
bt_tether_prospect_by (const bt_dive *dive, int i, double winch, double grip, bt_prospect *out,
                       bt_error *error)
{
  bt__awareness *g;
  int vehicle;
  bt_status status = bt__vehicle_at_end (dive, i, &vehicle, error);
  if (status == BT_OK && bt__dive_tether (dive, dive->now, i)->parted)
    status = bt__fail (error, BT_ERR_UNSUPPORTED, "`%s' has parted: nothing hangs from its winch",
                       dive->model->tethers[i].name);
  if (status == BT_OK && !(winch > 0))
    status = bt__fail (error, BT_ERR_DOMAIN, "a winch pulls with more than 0 N, not %g", winch);
  if (status == BT_OK && !(grip > 0 && grip <= 1))
    status = bt__fail (error, BT_ERR_DOMAIN,
                       "the share of the angle that is to hold is above 0 and at most 1, not %g",
                       grip);
  if (status == BT_OK)
    status = bt__watch_taut (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  bt__haul_body body = body_of (dive, vehicle, winch, grip);
  bt__prospect p = bt__haul_prospect (&g->holds, &body);
  if (!g->open && body.radius > 0)
    {
      bt__haul_crotch (&g->config, g->taut, &body, &p, &dive->watch->count);
      status = look_for_wedges (dive, g, &body, &p, error);
    }
  *out = (bt_prospect){ .answer = (bt_haul_answer)p.answer,
                        .reason = (bt_haul_reason)p.reason,
                        .object = bt__obstacle_at (dive, p.object),
                        .s = p.s,
                        .pull = p.pull,
                        .speed = p.speed };
  return status;
}

bt_status
bt_tether_prospect (const bt_dive *dive, int i, double winch, bt_prospect *out, bt_error *error)
{
  return bt_tether_prospect_by (dive, i, winch, BT_HAUL_GRIP, out, error);
}

/* ---- Ways ---- */

int
bt__put_points (const bt__string *s, bt_vec3 *points, int max)
{
  for (uint32_t k = 0; k < s->n && (int)k < max; k++)
    points[k] = s->x[k];
  return (int)s->n < max ? (int)s->n : max;
}

bt_status
bt_tether_taut_string (const bt_dive *dive, int i, bt_vec3 *points, int max, int *n,
                       bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_taut (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  if (!g->open)
    *n = bt__put_points (g->taut, points, max);
  else
    for (*n = 0; *n < 2 && *n < max; ++*n)
      points[*n] = g->node[*n ? g->n - 1 : 0];
  return BT_OK;
}

/* Lead the end of STRING straight to P, by pieces of at most LEAD.  Return 0 where that is not
 * free. */
static int
lead_to (const bt_dive *dive, const bt__awareness *g, bt__string *string, bt_vec3 p)
{
  bt_vec3 from = string->x[string->n - 1];
  uint32_t pieces = (uint32_t)fmin (ceil (bt__distance (from, p) / LEAD), LEAD_MOST);
  for (uint32_t k = 1; k <= pieces; k++)
    {
      bt_vec3 end = k < pieces ? bt__axpy (from, (double)k / pieces, bt__sub (p, from)) : p;
      if (!bt__taut_step (dive->watch->taut, &g->config, string, string->x[0], end,
                          k < pieces ? LED_STEPS : SETTLE_STEPS, &dive->watch->count))
        return 0;
    }
  return 1;
}

/* The obstacle nearest to the straight way from the end of G's tether to P, or -1.  */
static int
in_the_way (const bt_dive *dive, const bt__awareness *g, bt_vec3 p)
{
  bt__link link = { g->node[g->n - 1], p };
  bt__near near;
  return bt__scene_nearest (g->config.scene, g->config.on, &link, g->config.core, &near,
                            &dive->watch->count)
             ? bt__obstacle_at (dive, near.object)
             : -1;
}

static bt_status
taut_among (const bt_dive *dive, const bt__awareness *g, bt_vec3 p, bt_vec3 *points, int max,
            int *n, double *length, int *obstacle, bt_error *error)
{
  bt__string *string = bt__watch_string (dive);
  bt_status status = BT_OK;
  if (!string)
    return bt__fail (error, BT_ERR_LIMIT, "no memory to lead a string");
  if (!bt__string_lay (string, g->taut->x, g->taut->n) || !lead_to (dive, g, string, p))
    {
      *obstacle = in_the_way (dive, g, p);
      status = bt__fail (
          error, BT_ERR_UNSUPPORTED, "the straight way there is not free: `%s' is in it",
          *obstacle < 0 ? "something" : bt_dive_name (dive, BT_PART_OBSTACLE, *obstacle));
    }
  else
    {
      *length = bt__string_length (&g->config, string, &dive->watch->count);
      *n = bt__put_points (string, points, max);
    }
  free (string);
  return status == BT_OK ? bt__stopped (bt__asker_of (dive), error) : status;
}

bt_status
bt_tether_taut_to (const bt_dive *dive, int i, bt_vec3 p, bt_vec3 *points, int max, int *n,
                   double *length, int *obstacle, bt_error *error)
{
  bt__awareness *g;
  *n = 0;
  *obstacle = -1;
  if (!isfinite (p.x) || !isfinite (p.y) || !isfinite (p.z))
    return bt__fail (error, BT_ERR_DOMAIN, "a point has three finite numbers");
  bt_status status = bt__watch_taut (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  if (!g->open)
    return taut_among (dive, g, p, points, max, n, length, obstacle, error);
  *length = bt__distance (g->node[0], p);
  for (; *n < 2 && *n < max; ++*n)
    points[*n] = *n ? p : g->node[0];
  return BT_OK;
}

/* In open water the way home is the chord.  */
static void
straight_home (const bt__awareness *g, bt_vec3 *points, int max, int *n, bt_route *out)
{
  bt_vec3 ends[2] = { g->node[g->n - 1], g->node[0] };
  for (int k = 0; k < 2 && k < max; k++)
    points[k] = ends[k];
  *n = max < 2 ? max : 2;
  *out = (bt_route){ .needed = 1,
                     .feasible = 1,
                     .length = g->taut_length,
                     .clearance = INFINITY,
                     .obstacle = -1,
                     .longest = g->taut_length };
}

bt_status
bt_tether_way_home (const bt_dive *dive, int i, bt_vec3 *points, int max, int *n, bt_route *out,
                    bt_error *error)
{
  bt__awareness *g;
  int vehicle;
  bt_status status = bt__vehicle_at_end (dive, i, &vehicle, error);
  if (status == BT_OK)
    status = bt__watch_taut (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  if (g->open)
    {
      straight_home (g, points, max, n, out);
      return BT_OK;
    }
  double reach = bt__way_reach (dive, vehicle), want = bt__way_room (reach);
  bt__string *home = bt__watch_string (dive);
  if (!home)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a way home");
  bt__route way
      = bt__way_home (dive->watch->taut, &g->config, g->taut, want, home, &dive->watch->count);
  *n = bt__put_points (home, points, max);
  *out = (bt_route){ .needed = 1,
                     .feasible = way.clearance >= reach && way.length > 0,
                     .length = way.length,
                     .clearance = way.clearance,
                     .obstacle = bt__obstacle_at (dive, way.object),
                     .longest = g->taut_length };
  free (home);
  return bt__stopped (bt__asker_of (dive), error);
}

/* The plan of G's loop into LOOP.  */
static bt_route
plan (const bt_dive *dive, const bt__awareness *g, double reach, bt__string *loop, bt__string *copy)
{
  struct bt__watch *w = dive->watch;
  bt__unwind u = bt__unwind_plan (w->taut, &g->config, g->taut, g->shortest, bt__way_room (reach),
                                  g->out, reach, loop, copy, &w->count);
  return (bt_route){ .needed = u.needed,
                     .feasible = u.feasible,
                     .length = u.way.length,
                     .clearance = u.way.clearance,
                     .obstacle = bt__obstacle_at (dive, u.way.object),
                     .longest = u.longest,
                     .left = u.left };
}

bt_status
bt_tether_unwind_plan (const bt_dive *dive, int i, bt_vec3 *points, int max, int *n, bt_route *out,
                       bt_error *error)
{
  bt__awareness *g;
  int vehicle;
  bt_status status = bt__vehicle_at_end (dive, i, &vehicle, error);
  if (status == BT_OK)
    status = bt__watch_free (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  *n = 0;
  *out = (bt_route){ .feasible = 1, .clearance = INFINITY, .obstacle = -1, .left = g->taut_length };
  if (g->open || g->taut_length <= g->free_length)
    return BT_OK;
  bt__string *loop = bt__watch_string (dive), *copy = bt__watch_string (dive);
  if (loop && copy)
    *out = plan (dive, g, bt__way_reach (dive, vehicle), loop, copy);
  else
    status = bt__fail (error, BT_ERR_LIMIT, "no memory for a plan");
  if (status == BT_OK && out->needed)
    *n = bt__put_points (loop, points, max);
  free (loop);
  free (copy);
  return status == BT_OK ? bt__stopped (bt__asker_of (dive), error) : status;
}
