/* Legs of a tour: ways on which a tether goes from one free way to another.

   A tether that lies by the free way of its vehicle's place is wound about nothing.  After a flight
   back along the free way to the anchor and out along the free way of the next place, the tether
   lies by the next place's free way.  The two ways together can be drawn tight between their ends
   without changing the homotopy class, and so can the flight: the tight way, pushed out for the
   hull, is the leg.  A tour of such legs ends unwound whatever the order of its places, and a leg
   costs no more than the two free ways.  S. Kim, S. Bhattacharya and V. Kumar (2014) plan for a
   tethered robot by the same classes; here no search over classes is needed, because the same class
   is kept at every place.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/ways.h"

/* The strings of one leg, of the room of all strings of the watch.  */
typedef struct leg_strings
{
  bt__string *from, *to, *loop, *copy;
} leg_strings;

static int
make_leg_strings (const bt_dive *dive, leg_strings *s)
{
  *s = (leg_strings){ bt__watch_string (dive), bt__watch_string (dive), bt__watch_string (dive),
                      bt__watch_string (dive) };
  return s->from && s->to && s->loop && s->copy;
}

static void
free_leg_strings (leg_strings *s)
{
  free (s->from);
  free (s->to);
  free (s->loop);
  free (s->copy);
}

static bt_status
check_leg_end (const bt_vec3 *p, bt_error *error)
{
  if (p && (!isfinite (p->x) || !isfinite (p->y) || !isfinite (p->z)))
    return bt__fail (error, BT_ERR_DOMAIN, "a point has three finite numbers");
  return BT_OK;
}

/* The free way to *P, or the taut string that the tether has where P is NULL, into WAY; *FOUND
   tells success.  */
static bt_status
lay_leg_way (const bt_dive *dive, int i, bt__awareness *g, const bt_vec3 *p, bt__string *way,
             int *found, bt_error *error)
{
  double length;
  if (!p)
    {
      *found = bt__string_lay (way, g->taut->x, g->taut->n);
      return BT_OK;
    }
  bt_status status = bt__watch_lay_way (dive, i, g, *p, way, found, error);
  return status == BT_OK && *found ? bt__watch_tighten_way (dive, g, way, &length, error) : status;
}

/* The leg from the end of S->from to the anchor.  */
static bt_route
home_leg (const bt_dive *dive, const bt__awareness *g, double reach, leg_strings *s)
{
  bt__route way = bt__way_home (dive->watch->taut, &g->config, s->from, bt__way_room (reach),
                                s->loop, &dive->watch->count);
  return (bt_route){ .needed = 1,
                     .feasible = way.clearance >= reach && way.length > 0,
                     .length = way.length,
                     .clearance = way.clearance,
                     .obstacle = bt__obstacle_at (dive, way.object),
                     .longest = s->from->length };
}

/* The leg from the end of S->from to that of S->to, with at most OUT m of tether.  */
static bt_route
leg_between (const bt_dive *dive, const bt__awareness *g, double out, double reach, leg_strings *s)
{
  bt__unwind u
      = bt__unwind_plan (dive->watch->taut, &g->config, s->from, s->to, bt__way_room (reach), out,
                         reach, s->loop, s->copy, &dive->watch->count);
  return (bt_route){ .needed = u.needed,
                     .feasible = !u.needed || u.feasible,
                     .length = u.way.length,
                     .clearance = u.needed ? u.way.clearance : INFINITY,
                     .obstacle = bt__obstacle_at (dive, u.way.object),
                     .longest = u.longest,
                     .left = u.left };
}

static bt_status
leg_among (const bt_dive *dive, int i, bt__awareness *g, const bt_vec3 *from, const bt_vec3 *to,
           double reach, leg_strings *s, bt_vec3 *points, int max, int *n, bt_route *out,
           bt_error *error)
{
  int starts, ends = 1;
  bt_status status = lay_leg_way (dive, i, g, from, s->from, &starts, error);
  if (status == BT_OK && to)
    status = lay_leg_way (dive, i, g, to, s->to, &ends, error);
  if (status != BT_OK || !starts || !ends)
    return status;
  *out = to ? leg_between (dive, g, bt__watch_longest (dive, i), reach, s)
            : home_leg (dive, g, reach, s);
  *n = bt__put_points (s->loop, points, max);
  return bt__stopped (bt__asker_of (dive), error);
}

/* In open water a leg is straight, and the tether longest at one of its ends.  */
static void
open_leg (const bt_dive *dive, int i, const bt__awareness *g, const bt_vec3 *from,
          const bt_vec3 *to, bt_vec3 *points, int max, int *n, bt_route *out)
{
  bt_vec3 anchor = g->node[0];
  bt_vec3 end[2] = { from ? *from : g->node[g->n - 1], to ? *to : anchor };
  for (*n = 0; *n < 2 && *n < max; ++*n)
    points[*n] = end[*n];
  out->needed = 1;
  out->clearance = INFINITY;
  out->length = bt__distance (end[0], end[1]);
  out->left = bt__distance (end[1], anchor);
  out->longest = fmax (bt__distance (end[0], anchor), out->left);
  out->feasible = out->longest <= bt__watch_longest (dive, i);
}

bt_status
bt_tether_leg (const bt_dive *dive, int i, const bt_vec3 *from, const bt_vec3 *to, bt_vec3 *points,
               int max, int *n, bt_route *out, bt_error *error)
{
  bt__awareness *g;
  int vehicle;
  leg_strings s;
  *n = 0;
  *out = (bt_route){ .clearance = INFINITY, .obstacle = -1 };
  bt_status status = bt__vehicle_at_end (dive, i, &vehicle, error);
  if (status == BT_OK && bt__dive_tether (dive, dive->now, i)->parted)
    status = bt__fail (error, BT_ERR_UNSUPPORTED,
                       "`%s' has parted: no way of its vehicle leads the rest of it",
                       dive->model->tethers[i].name);
  if (status == BT_OK)
    status = check_leg_end (from, error);
  if (status == BT_OK)
    status = check_leg_end (to, error);
  if (status == BT_OK)
    status = bt__watch_taut (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  if (g->open)
    {
      open_leg (dive, i, g, from, to, points, max, n, out);
      return BT_OK;
    }
  status = make_leg_strings (dive, &s) ? leg_among (
               dive, i, g, from, to, bt__way_reach (dive, vehicle), &s, points, max, n, out, error)
                                       : bt__fail (error, BT_ERR_LIMIT, "no memory for a leg");
  free_leg_strings (&s);
  return status;
}
