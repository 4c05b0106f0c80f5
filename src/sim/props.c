/* Tethers near turning thrusters: a line in a propeller ends a dive.  The event `prop-danger' is
   raised when a tether comes within 0.12 m of the middle of a thruster pushing with more than 1 N,
   and can be raised again after all tethers have been 0.18 m away.  The last 0.3 m of a tether at
   the vehicle do not count.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/sim.h"
#include "world/line.h"

#define NEAR 0.12      /* m from the middle of a thruster */
#define AWAY 0.18      /* m: a tether farther away is gone */
#define TURNS 1.0      /* N: the force of a turning thruster */
#define OWN_LENGTH 0.3 /* m of tether near the vehicle in any case */

/* The squared distance of P from the line between A and B.  */
static double
apart2 (bt_vec3 p, bt_vec3 a, bt_vec3 b)
{
  bt_vec3 way = bt__sub (b, a), to = bt__sub (p, a);
  double k = bt__clamp (bt__dot (to, way) / fmax (bt__dot (way, way), 1e-300), 0, 1);
  bt_vec3 d = bt__axpy (to, -k, way);
  return bt__dot (d, d);
}

/* Where the thrusters that turn are.  */
typedef struct props
{
  bt_vec3 at[BT__THRUSTERS_MAX];
  int n;
} props;

static props
turning_props (const bt__vehicle_type *type, const bt__vehicle *v)
{
  props p = { .n = 0 };
  for (int k = 0; k < type->n; k++)
    if (fabs (v->body.thrust[k]) > TURNS)
      p.at[p.n++] = bt__rigid_point (&v->body, type->thruster[k].at);
  return p;
}

/* The squared distance, m2, between the link from A to B and the nearest of P.  */
static double
nearest_prop (const props *p, bt_vec3 a, bt_vec3 b)
{
  double least = INFINITY;
  for (int k = 0; k < p->n; k++)
    least = fmin (least, apart2 (p->at[k], a, b));
  return least;
}

/* True if the square of a distance, D2, is of less than REACH and a link whose square is LINK2.
   Most links of a line are far: what no link reaches is told without a root.  */
static inline int
is_near (double d2, double reach, double link2)
{
  return d2 <= 2.001 * (reach * reach + link2) && sqrt (d2) < reach + sqrt (link2);
}

/* The squared distance, m2, between tether I and the nearest of P, thrusters of V.  */
static double
nearest_on (const bt_dive *dive, bt__state *state, int i, const bt__vehicle_type *type,
            const bt__vehicle *v, const props *p)
{
  bt__line line = bt__line_of (dive, state, i);
  const bt_vec3 *x = line.chain ? bt__dynamic_x (line.chain) : NULL; /* asked without a call */
  int n = bt__line_nodes (&line);
  double reach = bt__norm (type->size) + AWAY, least = INFINITY;
  bt_vec3 a = bt__line_node (&line, 0), end = bt__line_node (&line, n - 1);
  for (int k = 1; k < n; k++)
    {
      bt_vec3 b = x ? x[k] : bt__line_node (&line, k);
      bt_vec3 along = bt__sub (b, a), to = bt__sub (b, v->position);
      if (is_near (bt__dot (to, to), reach, bt__dot (along, along))
          && bt__distance (a, end) > OWN_LENGTH)
        least = fmin (least, nearest_prop (p, a, k == n - 1 ? a : b));
      a = b;
    }
  return least;
}

void
bt__watch_props (const bt_dive *dive, bt__state *state)
{
  for (int vehicle = 0; vehicle < dive->model->n_vehicles; vehicle++)
    {
      bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
      const bt__vehicle_type *type = &dive->model->types[vehicle];
      double least = INFINITY;
      if (!v->rigid)
        continue;
      props turning = turning_props (type, v);
      for (int i = 0; i < dive->model->n_tethers; i++)
        if (bt__dive_tether (dive, state, i)->quiet < BT__SLEEP_AFTER)
          least = turning.n > 0 ? fmin (least, nearest_on (dive, state, i, type, v, &turning))
                                : least;
        else if (v->props)
          least = 0; /* a sleeping tether stays near */
      if (least < NEAR * NEAR && !v->props)
        bt__raise_event (state, BT_EVENT_PROP_DANGER, vehicle);
      v->props = least < NEAR * NEAR || (v->props && least < AWAY * AWAY);
    }
}
